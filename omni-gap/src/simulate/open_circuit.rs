//! The battery of one run, as it would read without load.
//!
//! ```text
//! vbat = V_oc − R·I_bus,   I_bus ∝ Σ u_j·i_j          least squares over the run: V_oc is where no power is drawn
//! ```
//!
//! Where no currents are logged Σ u_j² stands for the power; where neither is, the mean is all there is.

use crate::log::{Channel, Group, Run};
use std::borrow::Cow;

/// V_oc of a run (V).
pub(super) fn open_circuit_voltage(run: &Run, vbat: &Channel) -> f64 {
    // at an instant of another clock the last current and voltage stand for those that nobody measured
    let (volts, amps) = (held(&run.u), held(&run.i));
    let sample = |group: &[Cow<Channel>], j: usize, row: usize| group.get(j).and_then(|channel| channel.get(row).ok());
    let wheels = run.u.as_ref().map_or(0, |group| group.channels.len());
    let power = |row: usize| -> f64 {
        let of = |j: usize| {
            let u = sample(&volts, j, row).unwrap_or(0.0);
            u * if run.i.is_some() { sample(&amps, j, row).unwrap_or(0.0) } else { u }
        };
        (0..wheels).map(of).sum()
    };
    let (mut n, mut sum, mut drawn) = (0.0, 0.0, 0.0);
    for (row, volts) in vbat.present() {
        (n, sum, drawn) = (n + 1.0, sum + volts, drawn + power(row));
    }
    let (mean, mean_drawn) = (sum / f64::max(n, 1.0), drawn / f64::max(n, 1.0));
    let (mut spread, mut shared) = (0.0, 0.0);
    for (row, volts) in vbat.present() {
        let d = power(row) - mean_drawn;
        (spread, shared) = (spread + d * d, shared + d * (volts - mean));
    }
    // vbat = mean + slope·(P − P̄), read at P = 0
    if spread > 0.0 { mean - shared / spread * mean_drawn } else { mean }
}

fn held(group: &Option<Group>) -> Vec<Cow<'_, Channel>> {
    group.iter().flat_map(|group| &group.channels).map(Channel::held).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_voltage_without_load_is_found_under_any_load() {
        let amps: Vec<f64> = (0..200).map(|k| f64::from(k % 7)).collect();
        let vbat = Channel::from_values(amps.iter().map(|i| 11.3 - 0.2 * 6.0 * i / 12.0));
        let group = |values: Vec<f64>| Some(Group::from_columns(vec![values]));
        let run = Run { u: group(vec![6.0; 200]), i: group(amps.clone()), ..Run::default() };
        assert!((open_circuit_voltage(&run, &vbat) - 11.3).abs() < 1e-9);
        // without currents a load that goes with the voltage is found too, any other is the mean's
        let run = Run { u: group(amps.iter().map(|i| i.sqrt()).collect()), ..Run::default() };
        assert!((open_circuit_voltage(&run, &vbat) - 11.3).abs() < 1e-9);
        let mean = vbat.present().map(|(_, v)| v).sum::<f64>() / 200.0;
        assert!((open_circuit_voltage(&Run::default(), &vbat) - mean).abs() < 1e-9);
    }
}
