//! The checks that look at one run, row by row.

use super::{Fault, bunched, frozen, pushed, repeated, saturated, time};
use crate::log::{RobotFile, Run};

pub(super) fn check(run: &Run, robot: &RobotFile) -> Vec<Fault> {
    let mut faults = time::check(run);
    if run.rows() < 10 || !run.t_s.windows(2).all(|pair| pair[1] > pair[0]) {
        return faults;
    }
    let saturated = saturated::check(run, robot);
    let others = |fault: &Fault| saturated.iter().all(|known| known.signal != fault.signal);
    faults.extend(frozen::check(run, robot).into_iter().filter(others));
    faults.extend(saturated);
    faults.extend(repeated::check(run, robot));
    faults.extend(bunched::check(run, robot));
    faults.extend(pushed::check(run, robot));
    faults
}
