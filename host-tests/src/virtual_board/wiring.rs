//! # Wiring: which lead is soldered where, on purpose
//!
//! ```text
//! output x ── winding outputs[x]
//! converter c ── the leg of output converters[c], its code falling with the current where inverted[c]
//! hall line y ── switch halls[y], all lines low where they should be high where halls_inverted
//! ```

/// The six orders of three leads.
const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

/// How many wirings [`BoardWiring::of_number`] knows for each seed.
pub const WIRINGS: usize = 48;

/// Which leads of one motor are soldered where.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BoardWiring {
    /// The winding on each output
    pub outputs: [usize; 3],
    /// The output whose leg each converter measures
    pub converters: [usize; 3],
    /// True where its code falls with the current into the motor
    pub inverted: [bool; 3],
    /// The switch on each hall line
    pub halls: [usize; 3],
    /// The lines are low where the switches are on
    pub halls_inverted: bool,
}

impl Default for BoardWiring {
    /// As the table of pins says.
    fn default() -> Self {
        Self {
            outputs: ORDERS[0],
            converters: ORDERS[0],
            inverted: [false; 3],
            halls: ORDERS[0],
            halls_inverted: false,
        }
    }
}

impl BoardWiring {
    /// A wiring by its number: each order of the outputs with each set of signs; what is left goes on with number and seed.
    pub fn of_number(number: usize, seed: usize) -> Self {
        let (order, signs) = (number % 6, number / 6 % 8);
        Self {
            outputs: ORDERS[order],
            converters: ORDERS[(order + signs + seed) % 6],
            inverted: [0, 1, 2].map(|bit| signs >> bit & 1 == 1),
            halls: ORDERS[(2 * signs + order / 2 + 5 * seed) % 6],
            halls_inverted: (order + signs + seed / 2) % 2 == 1,
        }
    }

    /// What the windings get of what the outputs do.
    pub fn windings(&self, outputs: [f64; 3]) -> [f64; 3] {
        let mut windings = [0.0; 3];
        for (winding, x) in self.outputs.into_iter().zip(outputs) {
            windings[winding] = x;
        }
        windings
    }

    /// What the converters get of the currents of the windings.
    pub fn measured(&self, windings: [f64; 3]) -> [f64; 3] {
        std::array::from_fn(|c| {
            let current = windings[self.outputs[self.converters[c]]];
            if self.inverted[c] { -current } else { current }
        })
    }

    /// What the hall lines read where the switches say this.
    pub fn lines(&self, switches: u8) -> u8 {
        let turned = if self.halls_inverted { 7 } else { 0 };
        turned ^ self.halls.iter().enumerate().fold(0, |code, (y, switch)| code | (switches >> switch & 1) << y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_board_without_mistakes_passes_everything_on() {
        let wiring = BoardWiring::default();
        assert_eq!(
            (wiring.windings([1.0, 2.0, 3.0]), wiring.measured([4.0, 5.0, 6.0])),
            ([1.0, 2.0, 3.0], [4.0, 5.0, 6.0])
        );
        assert!((0..8).all(|code| wiring.lines(code) == code));
        assert_eq!(BoardWiring::of_number(0, 0), wiring);
    }

    #[test]
    fn the_wirings_of_a_seed_are_all_different() {
        for seed in 0..8 {
            let all: Vec<BoardWiring> = (0..WIRINGS).map(|number| BoardWiring::of_number(number, seed)).collect();
            assert!((0..WIRINGS).all(|k| all.iter().skip(k + 1).all(|other| *other != all[k])));
        }
    }

    #[test]
    fn a_converter_reads_the_leg_that_it_sits_at() {
        // output 0 drives winding c, and converter 1 sits at output 0
        let wiring = BoardWiring {
            outputs: [2, 0, 1],
            converters: [1, 0, 2],
            inverted: [false, true, false],
            ..BoardWiring::default()
        };
        assert_eq!(wiring.windings([10.0, 20.0, 30.0]), [20.0, 30.0, 10.0]);
        assert_eq!(wiring.measured([1.0, 2.0, 3.0]), [1.0, -3.0, 2.0]);
        assert_eq!(BoardWiring { halls: [2, 0, 1], halls_inverted: true, ..wiring }.lines(0b001), 0b101);
    }
}
