//! Numbers that no sensor of a small robot gives, in whatever unit: beyond them sums of squares say nothing any more.

use super::Fault;
use crate::log::Run;

/// In volts, amperes, metres, radians or a thousandth of them, no channel comes near this.
const MOST: f64 = 1e7;

pub(super) fn check(run: &Run) -> Vec<Fault> {
    let mut faults = Vec::new();
    for (name, channel) in run.signals() {
        let mut found = channel.present().filter(|(_, value)| value.abs() > MOST);
        let Some((first, value)) = found.next() else { continue };
        let (last, count) = found.fold((first, 1), |(_, count), (row, _)| (row, count + 1));
        let sentence = format!(
            "`{name}` holds {value:e} and {} more number(s) beyond {MOST:e}, expected what a sensor can give.",
            count - 1
        );
        let fix = "Correct the column, or leave fields empty where nothing was measured.";
        faults.push(Fault::of(run, "absurd_value", name, true).at(first, last).says(sentence, fix));
    }
    faults
}
