//! # Losses: how the telegrams with commands of a run fared
//!
//! ```text
//! ρ: odds of a loss, before the share p of losses is known
//! P(lost) = p·ρ/(p·ρ + 1 − p)
//! ```
//!
//! p is the share that makes all rows together most likely (expectation maximisation). A change that is heard late every time
//! is no loss: where more seem lost than an effect of the catalogue may lose, none is taken for lost.

use std::ops::Range;

use model_core::effects::EffectKind;
use model_core::effects::telegram::{Delivery, Telegram};

/// Steps towards the most likely share.
const STEPS: usize = 30;
/// Twice the logarithm of the likelihood that losses have to gain [1]: noise alone gains as much once in ten million.
const CERTAIN: f64 = 30.0;

/// How the telegrams of a run fared, row by row.
#[derive(Clone, Debug)]
pub enum Losses<const N: usize> {
    /// As the record shows.
    Shown(ShownLosses<N>),
    /// Nobody knows, since nothing was recorded yet.
    Drawn(DrawnLosses<N>),
}

/// The fate of telegrams that were not sent yet.
#[derive(Clone, Debug)]
pub struct DrawnLosses<const N: usize> {
    /// Drawn evenly between 0 and 1, a number a row
    pub(super) chances: Vec<f64>,
    /// What a record would show
    pub(super) would_show: ShownLosses<N>,
}

/// Which telegrams a record shows as lost.
#[derive(Clone, Debug)]
pub struct ShownLosses<const N: usize> {
    /// Of all wheels together
    pub(super) all: Odds,
    /// Of each wheel alone
    pub(super) each: [Odds; N],
}

impl<const N: usize> Default for ShownLosses<N> {
    fn default() -> Self {
        Self { all: Odds::default(), each: std::array::from_fn(|_| Odds::default()) }
    }
}

impl<const N: usize> ShownLosses<N> {
    fn part(&self, rows: Range<usize>) -> Self {
        Self { all: self.all.part(rows.clone()), each: self.each.each_ref().map(|odds| odds.part(rows.clone())) }
    }
}

/// Nothing is known to be lost.
impl<const N: usize> Default for Losses<N> {
    fn default() -> Self {
        Self::Shown(ShownLosses::default())
    }
}

/// Odds of a loss, row by row.
#[derive(Clone, Debug, Default)]
pub(super) struct Odds {
    /// ρ; zero where nothing tells, empty where nothing ever does
    pub of_row: Vec<f32>,
    /// p, the share of telegrams that are lost; zero: none is taken for lost
    pub share: f64,
}

impl Odds {
    /// Takes a share; of one that loses nothing, no row is kept.
    pub fn settle(&mut self, share: f64) {
        if share > 0.0 {
            self.share = share;
        } else {
            *self = Self::default();
        }
    }

    /// One over the share of lost telegrams, where this one was lost; zero where it was heard.
    fn evidence(&self, row: usize) -> f64 {
        match self.of_row.get(row) {
            // P(lost)/p = ρ/(p·ρ + 1 − p)
            Some(odds) if self.share > 0.0 => f64::from(*odds) / (self.share * f64::from(*odds) + 1.0 - self.share),
            _ => 0.0,
        }
    }

    /// Telegrams whose loss would have shown.
    fn told(&self) -> usize {
        self.of_row.iter().filter(|odds| **odds > 0.0).count()
    }

    fn part(&self, rows: Range<usize>) -> Self {
        Self { of_row: self.of_row.get(rows).unwrap_or_default().to_vec(), share: self.share }
    }
}

/// The share of telegrams that is most likely lost [1]; zero where noise would do as well, or where too many seem lost.
pub(super) fn most_likely_share<'a>(runs: impl Iterator<Item = &'a Odds> + Clone) -> f64 {
    let [card] = EffectKind::CommandLoss.card().params else { unreachable!("the share alone sizes it") };
    let odds = || runs.clone().flat_map(|run| &run.of_row).map(|odds| f64::from(*odds)).filter(|odds| *odds > 0.0);
    let telling = runs.clone().map(Odds::told).sum::<usize>().max(1) as f64;
    // p ← mean of P(lost)
    let step = |p: f64, _| odds().map(|odds| p * odds / (p * odds + 1.0 - p)).sum::<f64>() / telling;
    let share = (0..STEPS).fold(card.typical, step);
    let gained: f64 = odds().map(|odds| 2.0 * (share * (odds - 1.0)).ln_1p()).sum();
    if gained < CERTAIN || share > card.within.1 { 0.0 } else { share }
}

impl<const N: usize> Losses<N> {
    /// How the telegram of a row fared.
    pub fn telegram(&self, row: usize) -> Telegram<N> {
        match self {
            Self::Drawn(drawn) => Telegram::drawn(drawn.chances[row]),
            Self::Shown(ShownLosses { all, each }) => Telegram {
                all: Delivery::Shown(all.evidence(row)),
                each: std::array::from_fn(|j| Delivery::Shown(each[j].evidence(row))),
            },
        }
    }

    /// In how many telegrams a loss would have shown, for all wheels or for one alone.
    pub fn told(&self, wheel: Option<usize>) -> usize {
        let (Self::Shown(shown) | Self::Drawn(DrawnLosses { would_show: shown, .. })) = self;
        wheel.map_or(&shown.all, |j| &shown.each[j]).told()
    }

    /// Those of some rows.
    pub fn part(&self, rows: Range<usize>) -> Self {
        match self {
            Self::Drawn(DrawnLosses { chances, would_show }) => {
                Self::Drawn(DrawnLosses { chances: chances[rows.clone()].to_vec(), would_show: would_show.part(rows) })
            }
            Self::Shown(shown) => Self::Shown(shown.part(rows)),
        }
    }
}
