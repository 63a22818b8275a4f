//! A fault that many runs share, told once.

use super::Fault;

/// Runs that are named; of more only the number is told.
const NAMED: usize = 4;

/// Faults of one code and signal in several runs become one, at the first of the runs, which says where else it is.
pub(super) fn grouped(faults: Vec<Fault>) -> Vec<Fault> {
    let mut kept: Vec<(Fault, Vec<String>)> = Vec::new();
    for fault in faults {
        let same = |(first, _): &&mut (Fault, Vec<String>)| {
            first.code == fault.code && first.signal == fault.signal && first.fatal == fault.fatal
        };
        match kept.iter_mut().find(same) {
            Some((_, others)) => others.push(fault.run),
            None => kept.push((fault, Vec::new())),
        }
    }
    kept.into_iter().map(|(fault, others)| describe(fault, &others)).collect()
}

fn describe(mut fault: Fault, others: &[String]) -> Fault {
    fault.sentence += &match others.len() {
        0 => String::new(),
        n if n <= NAMED => format!(" So it is in {} too.", others.join(", ")),
        n => format!(" So it is in {n} more runs: {} and others.", others[..NAMED].join(", ")),
    };
    fault
}
