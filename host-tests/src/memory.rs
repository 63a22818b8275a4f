//! The most memory that a process has held so far, as Linux tells it.

use std::fs;

/// The largest resident memory so far of a process, `self` or its number (VmHWM) [byte]; none where the system does not tell it.
pub fn peak_memory(process: &str) -> Option<u64> {
    let status = fs::read_to_string(format!("/proc/{process}/status")).ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    Some(1024 * line.split_whitespace().nth(1)?.parse::<u64>().ok()?)
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn it_is_told_of_this_process_and_not_of_none() {
        assert!(peak_memory("self").is_some_and(|bytes| bytes > 1 << 20));
        assert_eq!(peak_memory("none"), None);
    }
}
