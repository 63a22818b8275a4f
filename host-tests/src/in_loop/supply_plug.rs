//! The plug of the motors' supply, pulled for a moment by a person.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use crate::virtual_board::{InjectedFault, VirtualBoard};

/// Motion turns for which the plug is out: half a second.
const OUT: u32 = 500;

/// The plug: whoever holds a copy of its handle can pull it.
#[derive(Debug, Default)]
pub struct SupplyPlug {
    pulled: Arc<AtomicBool>,
    out: u32,
}

impl SupplyPlug {
    /// Its handle: true pulls it.
    pub fn handle(&self) -> Arc<AtomicBool> {
        self.pulled.clone()
    }

    /// One motion turn.
    pub fn turn<const N: usize>(&mut self, board: &mut VirtualBoard<N>) {
        if self.pulled.swap(false, Ordering::Relaxed) {
            board.inject(InjectedFault::Bus(0.0));
            self.out = OUT;
        } else if self.out > 0 {
            self.out -= 1;
            if self.out == 0 {
                board.clear_faults();
            }
        }
    }
}
