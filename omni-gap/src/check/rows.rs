//! The checks that look at one run, row by row.

use super::{
    Fault, absurd, bunched, frozen, held, outliers, pushed, rate, rectified, repeated, saturated, time, time_unit,
};
use crate::log::{RobotFile, Run};

pub(super) fn check(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let mut faults = absurd::check(run);
    faults.extend(time::check(run));
    let clock = faults.iter().any(|fault| fault.code == "clock_runs_back");
    faults.extend(time_unit::by_rows(run).filter(|_| !clock));
    if clock || run.rows() < 10 || faults.iter().any(|fault| fault.fatal && fault.code != "time_gap") {
        return faults;
    }
    let saturated = saturated::check(run, robot);
    let others = |fault: &Fault| saturated.iter().all(|known| known.signal != fault.signal);
    faults.extend(frozen::check(run, robot).into_iter().filter(others));
    faults.extend(saturated);
    faults.extend(outliers::told(run));
    faults.extend(repeated::check(run, robot));
    faults.extend(held::check(run, robot));
    faults.extend(rectified::check(run, robot));
    faults.extend(bunched::check(run, robot));
    faults.extend(pushed::check(run, robot));
    faults.extend(rate::check(run, robot));
    faults
}
