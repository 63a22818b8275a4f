//! What runs say of a number: in a word, and where it is known only together with others.

use model_core::plant::robot::Nominal;
use nalgebra::DMatrix;

use super::information::invert;

/// A relative uncertainty up to which a number counts as known.
pub(super) const KNOWN: f64 = 0.15;
/// A number that would be this uncertain if all others were known has left no trace.
pub(super) const TRACELESS: f64 = 0.5;
/// A part of a direction below this share of its largest part is left out of the sentence.
const PART: f64 = 0.1;

/// What became of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq, schemars::JsonSchema, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Identifiability {
    /// Known on its own.
    Identified,
    /// Seen, but uncertain by more than 15 %.
    Weak,
    /// Known only as a combination with others: they could all move together.
    Combined,
    /// Ended at a bound.
    AtBound,
    /// Has left no trace in these runs.
    NotSeen,
}

impl Identifiability {
    /// The word as it is said.
    pub const fn said(self) -> &'static str {
        match self {
            Self::Identified => "identified",
            Self::Weak => "weak",
            Self::Combined => "only as a combination",
            Self::AtBound => "at its bound",
            Self::NotSeen => "not seen",
        }
    }

    /// Whether the number is one to go on with.
    pub const fn is_known(self) -> bool {
        matches!(self, Self::Identified | Self::Weak)
    }
}

/// The word for number `k` of an information matrix per relative change of each number.
pub(super) fn identifiability_of(information: &DMatrix<f64>, k: usize, at_bound: bool) -> Identifiability {
    // σ if all others were known
    let alone = 1.0 / information[(k, k)].max(f64::MIN_POSITIVE).sqrt();
    if alone > TRACELESS {
        return Identifiability::NotSeen;
    }
    if at_bound {
        return Identifiability::AtBound;
    }
    let seen: Vec<usize> =
        (0..information.ncols()).filter(|j| information[(*j, *j)] * TRACELESS.powi(2) >= 1.0).collect();
    let inverse = invert(&DMatrix::from_fn(seen.len(), seen.len(), |a, b| information[(seen[a], seen[b])]));
    let at = seen.iter().position(|j| *j == k).unwrap_or(0);
    let std = inverse[(at, at)].sqrt();
    match std {
        s if s <= KNOWN => Identifiability::Identified,
        // others make it uncertain, not the noise
        s if s > 3.0 * alone && alone <= KNOWN => Identifiability::Combined,
        _ => Identifiability::Weak,
    }
}

/// Numbers that could all move together without being noticed.
#[derive(Clone, Debug, PartialEq)]
pub struct TradeOff {
    /// The numbers, and by how much each moves (relative) when the first moves by one.
    pub moves: Vec<(Nominal, f64)>,
    /// How uncertain the first is along this direction (relative, one sigma).
    pub std: f64,
    /// The product of powers of two of them that is known, where there are just two, and its relative uncertainty.
    pub known: Option<([(Nominal, f64); 2], f64)>,
}

/// The directions in which a covariance of relative changes is large, as far as combined numbers take part.
pub(super) fn trade_offs(covariance: &DMatrix<f64>, members: &[Nominal], words: &[Identifiability]) -> Vec<TradeOff> {
    let eigen = covariance.clone().symmetric_eigen();
    let mut order: Vec<usize> = (0..members.len()).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*b].total_cmp(&eigen.eigenvalues[*a]));
    let mut found = Vec::new();
    for direction in order.into_iter().filter(|k| eigen.eigenvalues[*k].max(0.0).sqrt() > KNOWN) {
        let column = eigen.eigenvectors.column(direction);
        let most = column.amax();
        let mut parts: Vec<(usize, f64)> =
            (0..members.len()).map(|k| (k, column[k])).filter(|(_, x)| x.abs() > PART * most).collect();
        parts.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        if parts.len() < 2 || !parts.iter().any(|(k, _)| words[*k] == Identifiability::Combined) {
            continue;
        }
        let (first, lead) = parts[0];
        let moves = parts.iter().map(|(k, x)| (members[*k], x / lead)).collect();
        let known = if let [(a, x), (b, y)] = parts[..] {
            // across the direction (x, y) lies (y, −x): a^1·b^(−x/y)
            let power = -x / y;
            let variance = covariance[(a, a)] + 2.0 * power * covariance[(a, b)] + power * power * covariance[(b, b)];
            Some(([(members[a], 1.0), (members[b], power)], variance.max(0.0).sqrt()))
        } else {
            None
        };
        found.push(TradeOff { moves, std: covariance[(first, first)].sqrt(), known });
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Information of measurements, each a row of relative derivatives with its relative noise.
    fn information(rows: &[([f64; 3], f64)]) -> DMatrix<f64> {
        DMatrix::from_fn(3, 3, |a, b| rows.iter().map(|(x, s)| x[a] * x[b] / (s * s)).sum())
    }

    const MEMBERS: [Nominal; 3] = [Nominal::Resistance, Nominal::TorqueConstant, Nominal::Inertia];

    #[test]
    fn a_ratio_alone_is_a_combination_and_is_named() {
        // only K_t/R is measured, to 1 %, R itself hardly; J on its own
        let info = information(&[([-1.0, 1.0, 0.0], 0.01), ([1.0, 0.0, 0.0], 5.0), ([0.0, 0.0, 1.0], 0.02)]);
        let words: Vec<Identifiability> = (0..3).map(|k| identifiability_of(&info, k, false)).collect();
        assert_eq!(words, [Identifiability::Combined, Identifiability::Combined, Identifiability::Identified]);
        let found = trade_offs(&invert(&info), &MEMBERS, &words);
        assert_eq!(found.len(), 1);
        let ([(a, one), (b, power)], std) = found[0].known.unwrap();
        assert_eq!([a, b].map(|p| MEMBERS[..2].contains(&p)), [true, true]);
        assert!(one == 1.0 && (power + 1.0).abs() < 1e-3 && (std - 0.01).abs() < 1e-4, "{power}, {std}");
    }

    #[test]
    fn what_leaves_no_trace_is_not_seen_and_what_leaves_little_is_weak() {
        let info = information(&[([1.0, 0.0, 0.0], 0.01), ([0.0, 1.0, 0.0], 0.3), ([0.0, 0.0, 1.0], 2.0)]);
        let words: Vec<Identifiability> = (0..3).map(|k| identifiability_of(&info, k, false)).collect();
        assert_eq!(words, [Identifiability::Identified, Identifiability::Weak, Identifiability::NotSeen]);
    }
}
