//! A recording as one looks at it for situations: signals over time.

use crate::log::Run;
use crate::simulate::AlignedRun;

/// A recording's signals over its clock.
pub(super) struct Looked<'a> {
    /// Time of each row [s]
    pub t_s: &'a [f64],
    pub signals: Vec<Signal<'a>>,
}

/// One signal.
pub(super) struct Signal<'a> {
    pub name: String,
    /// Whether it is an angle that counts within its turn.
    pub is_heading: bool,
    /// What it says on a row.
    pub at: Box<dyn Fn(usize) -> Option<f64> + Sync + 'a>,
}

impl<'a> From<&'a Run> for Looked<'a> {
    fn from(run: &'a Run) -> Self {
        let signal = |(name, channel): (String, &'a crate::log::Channel)| Signal {
            is_heading: name == "theta_rad",
            name,
            at: Box::new(|row| channel.get(row).ok()),
        };
        Looked { t_s: &run.t_s, signals: run.signals().into_iter().map(signal).collect() }
    }
}

impl<'a, const N: usize> From<&'a AlignedRun<N>> for Looked<'a> {
    fn from(run: &'a AlignedRun<N>) -> Self {
        let channels = AlignedRun::<N>::channels();
        let [.., heading] = channels.pose();
        let measured = (0..channels.count()).map(|c| Signal {
            name: format!("channel {c}"),
            is_heading: c == heading,
            at: Box::new(move |row| run.saw(row, c).then(|| run.measured[row][c])),
        });
        let driving = (0..N).map(|j| Signal {
            name: format!("input {j}"),
            is_heading: false,
            at: Box::new(move |row| run.driven[row].then(|| run.input[row][j])),
        });
        Looked { t_s: &run.t, signals: measured.chain(driving).collect() }
    }
}
