//! What the study comes to.

use omni_gap::identify::IDENTIFIED;

use super::study::{Estimates, Morning, NUMBERS, Studied};

/// Statistics of one estimator of one number.
#[derive(Clone, Copy, Debug)]
pub struct Quality {
    /// Mean error, relative.
    pub bias: f64,
    /// Median of the absolute error, relative.
    pub median: f64,
    /// RMS error, relative.
    pub rms: f64,
    /// Share of 90 % intervals that hold the truth.
    pub covered: f64,
    /// Mornings with an estimate.
    pub count: usize,
}

/// Half of a 90 % interval of a Gaussian [σ]
const NINETY: f64 = 1.6449;

impl Quality {
    /// Of number `k`, as an estimator found it.
    pub fn of(mornings: &[Morning], k: usize, pick: impl Fn(&Morning) -> &Estimates) -> Option<Self> {
        let found: Vec<(f64, f64)> = mornings.iter().filter_map(|m| pick(m)[k]).collect();
        if found.is_empty() {
            return None;
        }
        let n = found.len() as f64;
        let mut size: Vec<f64> = found.iter().map(|(x, _)| (x - 1.0).abs()).collect();
        size.sort_by(f64::total_cmp);
        Some(Self {
            bias: found.iter().map(|(x, _)| x - 1.0).sum::<f64>() / n,
            median: size[size.len() / 2],
            rms: (found.iter().map(|(x, _)| (x - 1.0).powi(2)).sum::<f64>() / n).sqrt(),
            covered: found.iter().filter(|(x, std)| (x - 1.0).abs() <= NINETY * std).count() as f64 / n,
            count: found.len(),
        })
    }
}

/// A short look at a case.
pub fn look(studied: &Studied) -> String {
    let case = studied.case;
    let mut text = format!(
        "{} wheels, {}, τ {} s, {} mornings of {} runs, {:.0} s, {} rows; follows {}\n",
        case.wheels,
        case.sensing.word(),
        case.camera_correlation,
        studied.mornings.len(),
        studied.size.0,
        studied.size.1,
        studied.size.2,
        studied.mornings.iter().filter(|m| m.follows).count()
    );
    for k in 0..NUMBERS {
        let q = |pick: fn(&Morning) -> &Estimates| Quality::of(&studied.mornings, k, pick);
        let show = |q: Option<Quality>| {
            q.map_or("–".into(), |q| format!("{:+.2}/{:.2}/{:.0}%", 100.0 * q.bias, 100.0 * q.rms, 100.0 * q.covered))
        };
        let joint = q(|m| &m.joint);
        let table = q(|m| &m.table);
        text += &format!(
            "  {:15} 1,2 {:>18} LS {:>18} IV {:>18} table {:>18} joint {:>18} crb {:.3}% rms/crb {:.2} median ratio {:.3}\n",
            format!("{:?}", IDENTIFIED[k]),
            show(q(|m| &m.first)),
            show(q(|m| &m.least_squares)),
            show(q(|m| &m.instrumental)),
            show(table),
            show(joint),
            100.0 * studied.bound[k],
            joint.map_or(f64::NAN, |j| j.rms / studied.bound[k]),
            joint.zip(table).map_or(f64::NAN, |(j, t)| j.median / t.median),
        );
    }
    text
}
