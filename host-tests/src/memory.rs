//! The memory that a process holds, as Linux tells it.

use std::fs;

/// Resident memory of a process, `self` or its number (VmRSS) [byte]; none where the system does not tell it.
pub fn held_memory(process: &str) -> Option<u64> {
    told(process, "VmRSS:")
}

/// The most of it so far (VmHWM) [byte]; none where the system does not tell it.
pub fn peak_memory(process: &str) -> Option<u64> {
    told(process, "VmHWM:")
}

/// Forgets the most that this process has held; where the system lets it.
pub fn forget_peak() {
    fs::write("/proc/self/clear_refs", "5").ok();
}

fn told(process: &str, name: &str) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with(name))?;
    Some(1024 * line.split_whitespace().nth(1)?.parse::<u64>().ok()?)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn it_is_told_of_this_process_and_not_of_none() {
        for told in [held_memory, peak_memory] {
            assert!(told("self").is_some_and(|bytes| bytes > 1 << 20));
            assert_eq!(told("none"), None);
        }
    }
}
