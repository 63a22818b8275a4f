//! # Observer: how fast a wheel turns, between two edges of its halls and before the first one
//!
//! ```text
//! q ← q + ω̂·Δt/δ − edges passed,  ω̂ ← ω̂ + Δω      the wheel is believed to do what its reference does
//! y = t₀·ω̂/δ from its side                        with an edge, T since the one before
//! y = q held within 0 … 1,  T = Δt                without: nothing is known but the sector
//! p = 1/(1 + w·T + ½·(w·T)²) ≈ e^(−w·T)
//! q ← q + (1 − p²)·(y − q),   ω̂ ← ω̂ + (1 − p)²·δ/T·(y − q)
//! ```
//!
//! | symbol | code | unit | meaning |
//! |---|---|---|---|
//! | ω̂ | [`WheelEstimate::speed`] | rad/s | speed of the wheel's shaft |
//! | q | `position` | 1 | place in the sector between two edges, forward |
//! | δ | `sector` | rad | from one edge to the next, at the wheel's shaft |
//! | Δω | `change` | rad/s | how much faster the wheel was to become in the last turn |
//! | t₀ | `since_edge` | s | how long before the turn the edge was |
//! | T | `turns` | s | since the edge before, or since nothing was known |
//! | w | [`BANDWIDTH`] | rad/s | how fast a wheel is believed that does something else |
//! | Δt | | s | one motion turn |
//!
//! Edge times alone tell the mean speed of the last sectors, and so what was true half of that time ago: under
//! acceleration the lag is that of three edges, 2 % to 3 % of the slope of a ramp, and a wheel that starts is at
//! rest until its second edge. The reference tells how the wheel was to accelerate; edges only have to correct that.
//! A wheel that does just what it should shows no lag at all, one that does not is followed with the bandwidth.
//!
//! Both poles are at −w while edges come faster than that; where they come slower, an edge tells all that it can, the
//! mean speed since the one before. Between edges only the sector is known: a rotor that is held is pulled back into it,
//! and its speed with it. That needs no special case for a blocked wheel and none for a start.
//!
//! Neglects: that feedback, too, accelerates the wheel; misplaced switches, which show as a ripple of some percent
//! of a sector. Fails when: a wheel passes edges that are not counted; it then begins anew with the speed of the edge times.
//!
//! How to choose w: three times the feedback's own bandwidth or more, which is l·K_t·k_p·Σ(d/r)²/J about the vertical, 51
//! rad/s for the paper's robots with 0.3 A·s/rad (at twice, slow starts ring); and not more, because misplaced switches
//! show: by 0.04 V from turn to turn with that feedback, of switches that sit up to 5° off their places.
//!
//! Source: the critically damped g-h filter (Brookner, Tracking and Kalman Filtering Made Easy, 1998, chapter 1) at edges.

/// w [rad/s]
pub const BANDWIDTH: f32 = 160.0;

/// Periods of the halls without an edge after which a wheel that is to stand does stand: 50 ms.
const REST: u16 = crate::control::halls::REST;

/// Further off than so many sectors nothing is left of what was believed.
const LOST: f32 = 3.0;

/// What is the same for all wheels.
#[derive(Clone, Copy, Debug)]
pub struct SpeedObserver {
    /// Sectors in a turn over speed: Δt/δ [s/rad]
    sectors: f32,
    /// Sectors in a period of the halls over speed [s/rad]
    sectors_a_period: f32,
    /// δ/Δt [rad/s]
    speed_of_sector: f32,
    /// w·Δt [1]
    quickness: f32,
}

/// What is believed of one wheel; the default knows nothing and begins with its next turn.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct WheelEstimate {
    /// ω̂ [rad/s]
    pub speed: f32,
    position: f32,
    edges: i32,
    /// Turns since the last edge, or since nothing was known
    turns: u16,
    begun: bool,
}

/// What the halls say of one wheel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HallReading {
    /// Edges since the start
    pub edges: i32,
    /// Periods since the last one
    pub since_edge: u16,
    /// Speed by edge times alone [rad/s]
    pub speed: f32,
}

impl SpeedObserver {
    /// For sectors of an angle at the wheel's shaft [rad], turns and periods of the halls of these lengths [s].
    pub fn new(sector: f32, dt: f32, period: f32) -> Self {
        Self {
            sectors: dt / sector,
            sectors_a_period: period / sector,
            speed_of_sector: sector / dt,
            quickness: BANDWIDTH * dt,
        }
    }

    /// One turn: the wheel was to become faster by `change` [rad/s] in it, and is to turn with `wanted` [rad/s] now.
    // by itself: flash is scarcer than a call
    #[inline(never)]
    pub fn update(&self, wheel: &mut WheelEstimate, halls: HallReading, change: f32, wanted: f32) {
        let passed = halls.edges.wrapping_sub(wheel.edges);
        wheel.edges = halls.edges;
        wheel.turns = wheel.turns.saturating_add(1);
        // q ← q + ω̂·Δt/δ − edges passed, at the mean speed of the turn
        wheel.position += (wheel.speed + 0.5 * change) * self.sectors - passed as f32;
        wheel.speed += change;
        let within = wheel.position.clamp(0.0, 1.0);
        let rests = halls.since_edge >= REST && wanted == 0.0;
        if !wheel.begun || rests || (wheel.position - within).abs() > LOST {
            let speed = if rests { 0.0 } else { halls.speed };
            *wheel = WheelEstimate { speed, position: 0.5, edges: halls.edges, turns: 0, begun: true };
        } else if passed != 0 {
            // y = t₀·ω̂/δ, an edge being half a period older on average than when it is seen
            let beyond = (f32::from(halls.since_edge) + 0.5) * self.sectors_a_period * wheel.speed.abs();
            let measured = if passed > 0 { beyond } else { 1.0 - beyond };
            self.correct(wheel, measured, f32::from(wheel.turns));
            wheel.turns = 0;
        } else if within != wheel.position {
            self.correct(wheel, within, 1.0);
        }
    }

    /// The rotor is where it is `measured`, so many turns after it was last.
    fn correct(&self, wheel: &mut WheelEstimate, measured: f32, turns: f32) {
        // p = 1/(1 + w·T + ½·(w·T)²)
        let x = self.quickness * turns;
        let p = 1.0 / (1.0 + x + 0.5 * x * x);
        let off = measured - wheel.position;
        // q ← q + (1 − p²)·(y − q),  ω̂ ← ω̂ + (1 − p)²·δ/T·(y − q)
        wheel.position += (1.0 - p * p) * off;
        wheel.speed += (1.0 - p) * (1.0 - p) / turns * self.speed_of_sector * off;
    }
}

#[cfg(test)]
mod tests;
