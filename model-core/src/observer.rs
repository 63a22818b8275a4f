//! # Observer: how fast a wheel turns, between two edges of its halls and before the first one
//!
//! ```text
//! q ← q + ω̂·Δt/δ − edges passed                   where the rotor is believed to be in its sector, 0 … 1 of it
//! ω̂ ← ω̂ + Δω                                      the wheel is believed to do what its reference does
//! y = ω̂·t₀/δ from the side of the last edge       as long as the next one is not late
//! y = q held within 0 … 1                         else: nothing is known but the sector
//! q ← q + 2·w·Δt·(y − q),   ω̂ ← ω̂ + w²·Δt·δ·(y − q)
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | ω̂ | [`Observed::speed`] | rad/s | speed of the wheel's shaft |
//! | q | `place` | 1 | place in the sector between two edges, forward |
//! | δ | `sector` | rad | from one edge to the next, at the wheel's shaft |
//! | Δω | `change` | rad/s | how much faster the wheel was to become in the last turn |
//! | t₀ | `since_edge` | s | since the last edge |
//! | w | [`BANDWIDTH`] | rad/s | how fast a wheel is believed that does something else |
//! | Δt | `dt` | s | one motion turn |
//!
//! Edge times alone tell the mean speed of the last sectors, and so what was true half of that time ago: under
//! acceleration the lag is that of three edges, 2 % to 3 % of the slope of a ramp, and a wheel that starts is at
//! rest until its second edge. The reference tells how the wheel was to accelerate; edges only have to correct that.
//! A wheel that does just what it should shows no lag at all, one that does not is followed with the bandwidth.
//!
//! An edge is late if the rotor would have passed it at the speed believed in. Then, and after a reversal, only
//! the sector is known: a rotor that is held is pulled back into it, and its speed with it. That needs no special case
//! for a blocked wheel and none for a start.
//!
//! Neglects: that feedback, too, accelerates the wheel; misplaced switches, which show as a ripple of some percent
//! of a sector. Fails when: a wheel passes edges that are not counted; it then begins anew with the speed of the edge times.
//!
//! How to choose w: above the feedback's own bandwidth by a factor of three or more, and below that of the ripple of
//! misplaced switches at the speeds that matter, one a sector.
//!
//! Source: a Luenberger observer of second order with both poles at −w; the dead zone is the sector.

/// w [rad/s]
pub const BANDWIDTH: f32 = 160.0;

/// Periods of the halls without an edge after which a wheel that is to stand does stand: 50 ms.
const REST: u16 = crate::halls::REST;

/// Further off than so many sectors nothing is left of what was believed.
const LOST: f32 = 3.0;

/// What is the same for all wheels.
#[derive(Clone, Copy, Debug)]
pub struct Observer {
    /// Δt [s]
    dt: f32,
    /// Sectors over an angle in a turn: Δt/δ [s/rad]
    sectors: f32,
    /// Sectors over an angle in a period of the halls [s/rad]
    sectors_a_period: f32,
    /// 2·w·Δt [1]
    to_place: f32,
    /// w²·Δt·δ [rad/s]
    to_speed: f32,
}

/// What is believed of one wheel; the default knows nothing and begins with its next turn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observed {
    /// ω̂ [rad/s]
    pub speed: f32,
    place: f32,
    edges: i32,
    backwards: bool,
    begun: bool,
}

/// What the halls say of one wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Told {
    /// Edges since the start
    pub edges: i32,
    /// Periods since the last one
    pub since_edge: u16,
    /// Speed by edge times alone [rad/s]
    pub speed: f32,
}

impl Observer {
    /// For sectors of an angle at the wheel's shaft [rad], turns and periods of the halls of these lengths [s].
    pub fn new(sector: f32, dt: f32, period: f32) -> Self {
        Self {
            dt,
            sectors: dt / sector,
            sectors_a_period: period / sector,
            to_place: 2.0 * BANDWIDTH * dt,
            to_speed: BANDWIDTH * BANDWIDTH * dt * sector,
        }
    }

    /// Length of a turn [s].
    pub fn dt(&self) -> f32 {
        self.dt
    }

    /// One turn: the wheel was to become faster by `change` [rad/s] in it, and is to turn with `wanted` [rad/s] now.
    #[inline]
    pub fn turn(&self, wheel: &mut Observed, told: Told, change: f32, wanted: f32) {
        let passed = told.edges.wrapping_sub(wheel.edges);
        wheel.edges = told.edges;
        if passed != 0 {
            wheel.backwards = passed < 0;
        }
        // q ← q + ω̂·Δt/δ − edges passed, at the mean speed of the turn
        let place = wheel.place + (wheel.speed + 0.5 * change) * self.sectors - passed as f32;
        let within = place.clamp(0.0, 1.0);
        let rests = told.since_edge >= REST && wanted == 0.0;
        if !wheel.begun || rests || (place - within).abs() > LOST {
            let speed = if rests { 0.0 } else { told.speed };
            *wheel = Observed { speed, place: 0.5, begun: true, ..*wheel };
            return;
        }
        let speed = wheel.speed + change;
        // y = ω̂·t₀/δ, an edge being half a period older on average than when it is seen
        let beyond = (f32::from(told.since_edge) + 0.5) * self.sectors_a_period * speed.abs();
        let onward = if wheel.backwards { speed < 0.0 } else { speed > 0.0 };
        let seen = match onward && beyond <= 1.0 && told.since_edge < REST {
            true if wheel.backwards => 1.0 - beyond,
            true => beyond,
            false => within,
        };
        let off = seen - place;
        wheel.place = place + self.to_place * off;
        wheel.speed = speed + self.to_speed * off;
    }
}

#[cfg(test)]
mod tests;
