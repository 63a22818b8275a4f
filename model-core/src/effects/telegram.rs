//! Telegrams: a command on its way from the controller that asks for it to the drive that gives it.

/// How a telegram fared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Delivery {
    /// Nobody knows: a number drawn evenly between 0 and 1, by which an effect decides.
    Drawn(f64),
    /// A record shows it: how surely the telegram was lost, over the share of the record's telegrams that were [1]; zero: it
    /// arrived.
    Shown(f64),
}

/// How the telegram with the commands of all wheels fared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Telegram<const N: usize> {
    /// Lost for all wheels or for none.
    pub all: Delivery,
    /// Each wheel's part, where it is lost by itself.
    pub each: [Delivery; N],
}

impl<const N: usize> Telegram<N> {
    /// One whose fate is drawn: a number evenly between 0 and 1, the same for every wheel.
    pub const fn drawn(chance: f64) -> Self {
        Self { all: Delivery::Drawn(chance), each: [Delivery::Drawn(chance); N] }
    }
}

/// Command of one wheel: what is sent in, what arrives out. A voltage [V]; a speed at the wheel shaft [rad/s] where a drive
/// controls it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Command<T> {
    /// What is sent [V] or [rad/s]
    pub sent: T,
    /// What arrives [V] or [rad/s]
    pub arrived: T,
}
