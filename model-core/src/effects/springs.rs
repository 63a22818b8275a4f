//! Springs in series on the way from the rotor to the wheel.

use super::card::{Param, Role};
use super::seams::Shaft;
use crate::number::scalar::Real;

/// The number of a card: T, damping over stiffness.
pub const DAMPING_TIME: Param = Param {
    key: "damping_time_s",
    symbol: "T",
    unit: "s",
    absent: 2e-4,
    typical: 2e-4,
    within: (0.0, 0.01),
    role: Role::Fixed,
};

/// The number of a card: J, inertia of the rotor where no effect says it.
pub const ROTOR_INERTIA: Param = Param {
    key: "rotor_inertia_kg_m2",
    symbol: "J",
    unit: "kg·m²",
    absent: 6e-5,
    typical: 6e-5,
    within: (1e-6, 2e-3),
    role: Role::Fixed,
};

/// A spring with a damper beside it, and the rotor that it needs.
#[derive(Clone, Copy, Debug)]
pub struct Spring<T> {
    /// Twist over torque [rad/(N·m)]
    pub compliance: T,
    /// Damping over stiffness [s]
    pub damping_time: T,
    /// Inertia of the rotor, where no effect says it [kg·m²]
    pub rotor: T,
}

impl<T: Real> Spring<T> {
    /// Puts it into a shaft, behind what is there.
    ///
    /// Springs share a torque and add their twists: 1/k = Σ 1/k_n. With dampers beside them they add 1/(k_n + c_n·s), of
    /// which c/k² = Σ c_n/k_n² keeps the first two terms: what is slow against their own damping.
    #[inline]
    pub fn join(&self, x: &mut Shaft<T>) {
        let Self { compliance, damping_time, rotor } = *self;
        let (zero, one) = (T::zero(), T::one());
        let there = x.stiffness > zero;
        let (mut twist, mut lag) = (compliance, compliance * damping_time);
        if there {
            let per_stiffness = one / x.stiffness;
            twist += per_stiffness;
            // c/k²
            lag += x.damping * per_stiffness * per_stiffness;
        }
        x.stiffness = one / twist;
        x.damping = lag * x.stiffness * x.stiffness;
        x.rotor = x.rotor.max(rotor);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SOFT: Spring<f64> = Spring { compliance: 0.05, damping_time: 2e-4, rotor: 6e-5 };
    const TEETH: Spring<f64> = Spring { compliance: 0.005, damping_time: 5e-4, rotor: 5e-5 };

    fn joined(springs: &[Spring<f64>]) -> Shaft<f64> {
        let mut x = Shaft::default();
        springs.iter().for_each(|spring| spring.join(&mut x));
        x
    }

    #[test]
    fn alone_it_is_itself() {
        let x = joined(&[SOFT]);
        assert!((x.stiffness - 20.0).abs() < 1e-12 && (x.damping - 20.0 * 2e-4).abs() < 1e-15);
        assert_eq!(x.rotor, 6e-5);
    }

    #[test]
    fn two_give_way_by_the_sum_in_any_order() {
        let (one, other) = (joined(&[SOFT, TEETH]), joined(&[TEETH, SOFT]));
        let torque = 0.3;
        assert!((torque / one.stiffness - (torque * 0.05 + torque * 0.005)).abs() < 1e-15);
        assert!((one.stiffness - other.stiffness).abs() < 1e-12 && (one.damping - other.damping).abs() < 1e-15);
        assert_eq!((one.rotor, other.rotor), (6e-5, 6e-5));
    }

    #[test]
    fn of_one_material_they_are_one_spring_of_it() {
        let x = joined(&[SOFT, Spring { compliance: 0.02, ..SOFT }]);
        assert!((x.damping / x.stiffness - 2e-4).abs() < 1e-17);
    }

    #[test]
    fn slow_twisting_loses_what_the_two_lose() {
        // a torque that grows by 1 N·m/s twists each spring at 1/k_n, and its damper takes c_n/k_n² of power
        let x = joined(&[SOFT, TEETH]);
        let lost = x.damping / (x.stiffness * x.stiffness);
        assert!((lost - (0.05 * 2e-4 + 0.005 * 5e-4)).abs() < 1e-18);
    }
}
