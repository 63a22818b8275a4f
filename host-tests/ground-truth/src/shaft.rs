//! Between gear and wheel: nothing, a spring, or a spring behind some play.
//!
//! ```text
//! τ = k·z + c·ż        z: by how much the wheel is ahead, beyond the play
//! ```
//!
//! By the midpoint rule its torque is linear in the speed s½ between wheel and rotor in the middle of a step:
//!
//! ```text
//! τ½ = k·z + (k·Δt/2 + c)·s½
//! ```

/// What connects a gear and its wheel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shaft {
    /// The rotor turns as the wheel does.
    Rigid,
    /// A spring with a damper beside it, behind some play, at the wheel.
    Elastic {
        /// k [N·m/rad]
        stiffness: f64,
        /// c [N·m·s]
        damping: f64,
        /// Between its flanks the rotor turns free [rad]
        play: f64,
    },
}

/// The torque of a shaft over one step: what it holds the wheel back with.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Twisted {
    /// With no speed between wheel and rotor [N·m]
    pub still: f64,
    /// For each speed between them [N·m·s]
    pub per_speed: f64,
}

impl Shaft {
    /// An angle between wheel and rotor [rad] less the play: how far the spring is twisted.
    pub fn twist(&self, angle: f64) -> f64 {
        match self {
            Self::Rigid => 0.0,
            Self::Elastic { play, .. } => angle - angle.clamp(-0.5 * play, 0.5 * play),
        }
    }

    /// Over a step [s] from an angle between wheel and rotor [rad], at about a speed between them [rad/s]. A flank pushes and
    /// never pulls.
    pub fn twisted(&self, angle: f64, speed: f64, step: f64) -> Twisted {
        let &Self::Elastic { stiffness, damping, play } = self else { return Twisted::default() };
        let middle = self.twist(angle + 0.5 * step * speed);
        if play > 0.0 && middle == 0.0 {
            return Twisted::default();
        }
        // z in the middle is that at the beginning and half a step on, or what of that is beyond the flank
        let still = stiffness * (middle - 0.5 * step * speed);
        let twisted = Twisted { still, per_speed: 0.5 * stiffness * step + damping };
        let pulls = (still + twisted.per_speed * speed) * middle < 0.0;
        if play > 0.0 && pulls { Twisted::default() } else { twisted }
    }

    /// [J] at an angle between wheel and rotor [rad]
    pub fn energy(&self, angle: f64) -> f64 {
        match self {
            Self::Rigid => 0.0,
            Self::Elastic { stiffness, .. } => 0.5 * stiffness * self.twist(angle).powi(2),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 1e-3;

    fn shaft(play: f64) -> Shaft {
        Shaft::Elastic { stiffness: 20.0, damping: 0.01, play }
    }

    fn torque(of: Shaft, angle: f64, speed: f64) -> f64 {
        let Twisted { still, per_speed } = of.twisted(angle, speed, STEP);
        still + per_speed * speed
    }

    #[test]
    fn a_spring_and_a_damper_push_with_what_they_are_twisted_in_the_middle() {
        for (angle, speed) in [(0.03, 0.0), (0.0, 2.0), (-0.02, 5.0)] {
            let expected = 20.0 * (angle + 0.5 * STEP * speed) + 0.01 * speed;
            assert!((torque(shaft(0.0), angle, speed) - expected).abs() < 1e-12);
        }
        assert_eq!(torque(Shaft::Rigid, 1.0, 1.0), 0.0);
    }

    #[test]
    fn between_its_flanks_a_shaft_holds_nothing_and_beyond_them_it_never_pulls() {
        let play = shaft(0.02);
        assert_eq!([torque(play, 0.0, 3.0), torque(play, -0.009, 0.0)], [0.0; 2]);
        assert!((torque(play, 0.03, 0.0) - 20.0 * 0.02).abs() < 1e-12);
        assert!((torque(play, 0.0099, 1.0) - (20.0 * 0.0004 + 0.01)).abs() < 1e-12, "it meets the flank on the way");
        assert_eq!(torque(play, 0.0101, -1.0), 0.0, "it leaves the flank faster than the spring follows");
        assert!((play.energy(0.03) - 0.5 * 20.0 * 0.02 * 0.02).abs() < 1e-15);
    }
}
