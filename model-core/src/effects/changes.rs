//! The last changes of a command that is held between them, with their times.

use super::effect::{Numbers, State};
use crate::number::scalar::Real;

/// The last `SLOTS` of them. Before the first the command was zero; the oldest that is known is taken to have stood for ever.
#[derive(Clone, Copy, Debug)]
pub struct Changes<T, const SLOTS: usize> {
    /// (time, command) of each; the oldest stands at `next`
    ring: [[T; 2]; SLOTS],
    /// Where the next one goes
    next: u8,
}

impl<T: Real, const SLOTS: usize> Changes<T, SLOTS> {
    /// (time at which it began, command), newest first.
    pub fn newest_first(&self) -> impl Iterator<Item = [T; 2]> {
        let (after, before) = self.ring.split_at(usize::from(self.next).min(SLOTS));
        after.iter().rev().chain(before.iter().rev()).copied()
    }

    /// Remembers a command that holds from `time` [s] on, if it is another than the last.
    pub fn remember(&mut self, time: T, command: T) {
        let last = self.newest_first().next().map_or(T::zero(), |[_, command]| command);
        if command == last {
            return;
        }
        let Some(slot) = self.ring.get_mut(usize::from(self.next)) else { return };
        *slot = [time, command];
        self.next += 1;
        if usize::from(self.next) >= SLOTS {
            self.next = 0;
        }
    }
}

impl<T: Real, const SLOTS: usize> Numbers<T> for Changes<T, SLOTS> {
    fn for_each_mut(&mut self, visit: impl FnMut(&mut T)) {
        self.ring.as_flattened_mut().iter_mut().for_each(visit);
    }
}

impl<T: Real, const SLOTS: usize> State<T> for Changes<T, SLOTS> {
    fn start() -> Self {
        Self { ring: [[T::zero(); 2]; SLOTS], next: 0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_stays_the_same_is_no_change_and_the_oldest_is_forgotten_first() {
        let mut changes = Changes::<f64, 3>::start();
        for (time, command) in [(0.0, 0.0), (0.1, 1.0), (0.2, 1.0), (0.3, 2.0), (0.4, 0.0), (0.5, 4.0)] {
            changes.remember(time, command);
        }
        assert!(changes.newest_first().eq([[0.5, 4.0], [0.4, 0.0], [0.3, 2.0]]));
    }
}
