//! # Wheel slip: the floor holds only so much
//!
//! ```text
//! f = μ·N · sin(C · atan(x − E·(x − atan x)))        x = B·s
//! s = r·ω − (cos α·v + sin α·vn + d·ω)
//! ```
//!
//! A wheel pushes on the floor with at most μ·N. Near that limit its rim runs away from the floor: speed is lost, the
//! wheel spins up, and odometry counts a way that was never gone. The curve is Pacejka's formula without its offsets.
//! With C = 1 it rises to the limit, with C above 1 it falls again after a peak. E says how sharp its knee is: at E = 0 and
//! C = 1 it is f = μ·N·x/√(1 + x²), which takes long to come to the limit; below 0 it is a straight line for longer and
//! then bends sooner.
//!
//! While it slips a wheel is held by its own inertia alone, J·dω/dt = τ − r·f: it takes some milliseconds to spin up and
//! to be caught again.
//!
//! symbol  code                    unit     meaning
//! ------  ----------------------  -------  -----------------------------------------------------
//! μ       `friction_coefficient`  1        largest force over normal force; 0 stands for no limit
//! N       `load`                  N        normal force
//! B       `stiffness`             1/(m/s)  slope at the origin over the limit, at C = 1
//! C       `shape`                 1        1 rises to the limit, above 1 falls after a peak
//! E       `curvature`             1        0: a round knee; below 0: a sharper one
//! s       `slip`                  m/s      rim speed minus speed of the floor below the wheel
//! J       `inertia_at_wheel`      kg·m²    inertia of rotor, gear and wheel at the wheel shaft
//!
//! J is that of `rotor_inertia` where the model has it, else what stands here; on a shaft that yields it is the rotor's,
//! and the wheel has none.
//!
//! A coefficient of zero stands for a contact that holds any force: the nominal model. The way there leads over large
//! coefficients, not over small ones, so a fit starts from the typical value and says nothing near zero.
//!
//! Fails when: the rollers' own grip along the axle matters; when the floor changes from place to place.
//! How to measure it: hold the robot with a spring balance, raise the current until a wheel spins, divide by its load.
//! Source: The magic formula without its offsets: Pacejka, Tire and Vehicle Dynamics, 2012, ch. 4; sizes: rubber on
//! carpet to rubber on hard floor, μ 0.2 to 0.8.

use crate::effects::card::{Card, LookAlike, Param, Physics, Role, Scope, Seam, Undone};
use crate::effects::seams::{Contact, EffectContext};
use crate::effects::shows::{Channel, Parity, Regime, Shows};
use crate::effects::{Catalogued, Hooks, Needs};
use crate::number::scalar::Real;

/// The effect's page as data.
pub const CARD: Card = Card {
    id: "wheel_slip",
    title: "Slip of the wheels",
    summary: "A wheel that pushes too hard slips, so that it turns faster than the robot moves.",
    equation: "f = μ·N · sin(C · atan(x − E·(x − atan x))), x = B·s",
    source: "the magic formula without its offsets: Pacejka, Tire and Vehicle Dynamics, 2012, ch. 4; sizes: rubber on carpet to rubber on hard floor, μ 0.2 to 0.8",
    seams: &[Seam::Contact],
    scope: Scope::Wheels,
    params: &[
        Param {
            key: "friction_coefficient",
            symbol: "μ",
            unit: "1",
            absent: 0.0,
            typical: 0.35,
            within: (0.0, 2.0),
            role: Role::Size,
        },
        Param {
            key: "curve_stiffness",
            symbol: "B",
            unit: "1/(m/s)",
            absent: 30.0,
            typical: 30.0,
            within: (5.0, 200.0),
            role: Role::Shape,
        },
        Param {
            key: "curve_shape",
            symbol: "C",
            unit: "1",
            absent: 1.0,
            typical: 1.0,
            within: (0.8, 1.4),
            role: Role::Fixed,
        },
        Param {
            key: "inertia_at_wheel_kg_m2",
            symbol: "J",
            unit: "kg·m²",
            absent: 0.0,
            typical: 7e-5,
            within: (0.0, 0.02),
            role: Role::Shape,
        },
        Param {
            key: "curve_curvature",
            symbol: "E",
            unit: "1",
            absent: 0.0,
            typical: -1.0,
            within: (-2.0, 0.0),
            role: Role::Fixed,
        },
    ],
    needs_current: false,
    shows: Shows { channels: &[Channel::WheelSpeed], regime: Regime::Current, parity: Parity::Odd, order: None },
    signature: "wheels faster than the body; wheels disagree with each other",
    look_alikes: &[
        LookAlike { with: "creep", settled_by: "drive gently: creep stays at small forces, slip does not" },
        LookAlike {
            with: "current_limit",
            settled_by: "lock a wheel and raise its voltage slowly: a limit stops the current, a floor that lets go does not",
        },
    ],
    code: 8,
    undone: Undone::No("no current makes the floor hold more; lower the largest acceleration"),
    physics: Physics { corner_at_absent: true, is_limit: true, ..Physics::PASSIVE },
};

/// The form of the curve, whatever its limit.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CurveShape<T> {
    /// B, slope at the origin over the limit, at C = 1 [1/(m/s)]
    pub stiffness: T,
    /// C, 1 rises to the limit, above 1 falls after a peak [1]
    pub shape: T,
    /// E, 0 for a round knee, below 0 for a sharper one [1]
    pub curvature: T,
}

/// Force on the floor [N] and its slope [N/(m/s)], of a contact that holds at most `limit` [N].
#[inline]
pub fn traction<T: Real>(limit: T, form: &CurveShape<T>, slip: T) -> (T, T) {
    let [force, slope, _] = curve(limit, form, slip);
    (force, slope)
}

/// The same, and by how much the slope changes with the slip speed [N, N/(m/s), N/(m/s)²].
///
/// At a shape of exactly 1 and a curvature of exactly 0 closed forms are taken, which know no derivative by these two.
#[inline(always)]
pub fn curve<T: Real>(limit: T, form: &CurveShape<T>, slip: T) -> [T; 3] {
    let &CurveShape { stiffness, shape, curvature } = form;
    let one = T::one();
    let x = stiffness * slip;
    let [y, dy, ddy] = bent(x, curvature);
    let square = one + y * y;
    if shape == one {
        // f = μ·N · y/√(1 + y²),  ∂f/∂s = μ·N·B·y′/(1 + y²)^(3/2),
        // ∂²f/∂s² = μ·N·B²/(1 + y²)^(3/2) · (y″ − 3·y·y′²/(1 + y²))
        let per_root = one / square.sqrt();
        let force = limit * per_root;
        let per_square = per_root * per_root;
        let slope = force * stiffness * per_square;
        let bend = slope * stiffness * (ddy - T::lit(3.0) * y * dy * dy * per_square);
        return [force * y, slope * dy, bend];
    }
    // f = μ·N · sin θ,  θ = C · atan y,  θ′ = C·y′/(1 + y²),  θ″ = C·(y″ − 2·y·y′²/(1 + y²))/(1 + y²)
    // ∂f/∂s = μ·N·B · cos θ · θ′,  ∂²f/∂s² = μ·N·B² · (cos θ · θ″ − sin θ · θ′²)
    let (sin, cos) = (shape * y.atan2(one)).sin_cos();
    let per_square = one / square;
    let turns = shape * dy * per_square;
    let turns_more = shape * per_square * (ddy - T::lit(2.0) * y * dy * dy * per_square);
    let steep = limit * stiffness;
    [limit * sin, steep * cos * turns, steep * stiffness * (cos * turns_more - sin * turns * turns)]
}

/// What the knee makes of x = B·s, with its first and second derivative by x.
///
/// ```text
/// y = x − E·(x − atan x)      y′ = 1 − E·x²/(1 + x²)      y″ = −2·E·x/(1 + x²)²
/// ```
#[inline(always)]
fn bent<T: Real>(x: T, curvature: T) -> [T; 3] {
    let (zero, one) = (T::zero(), T::one());
    if curvature == zero {
        return [x, one, zero];
    }
    let per_square = one / (one + x * x);
    let excess = x * x * per_square;
    [
        x - curvature * (x - x.atan2(one)),
        one - curvature * excess,
        -(T::lit(2.0) * curvature * x * per_square * per_square),
    ]
}

/// Slip of the wheels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WheelSlip<T> {
    /// μ, largest force over normal force; 0 stands for no limit [1]
    pub friction_coefficient: T,
    /// B, slope at the origin over the limit, at C = 1 [1/(m/s)]
    pub curve_stiffness: T,
    /// C, 1 rises to the limit, above 1 falls after a peak [1]
    pub curve_shape: T,
    /// J, of rotor, gear and wheel at the wheel shaft, where nothing else says it [kg·m²]
    pub inertia_at_wheel: T,
    /// E, 0 for a round knee, below 0 for a sharper one [1]
    pub curve_curvature: T,
}

impl<T: Copy> Catalogued<T> for WheelSlip<T> {
    fn of(params: &[T]) -> Option<Self> {
        let &[friction_coefficient, curve_stiffness, curve_shape, inertia_at_wheel, curve_curvature] = params else {
            return None;
        };
        Some(Self { friction_coefficient, curve_stiffness, curve_shape, inertia_at_wheel, curve_curvature })
    }
}

impl<T: Real> Hooks<T> for WheelSlip<T> {
    type State = ();
    const SETTLES_CONTACT: bool = true;
    /// A wheel spins up and is caught again within a few milliseconds.
    const NEEDS: Needs = Needs { steps_per_s: 400, ..Needs::NOTHING };

    fn contact(&self, _: &(), _: &EffectContext<T>, x: &mut Contact<T>) {
        let Self { friction_coefficient, curve_stiffness, curve_shape, inertia_at_wheel, curve_curvature } = *self;
        if friction_coefficient > T::zero() {
            x.grip = friction_coefficient;
            x.stiffness = curve_stiffness;
            x.shape = curve_shape;
            x.curvature = curve_curvature;
            x.inertia = inertia_at_wheel;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn touched(p: [f64; 5]) -> Contact<f64> {
        let mut x = Contact {
            row: [0.0, 1.0, 0.089],
            radius: 0.0325,
            per_radius: 1.0 / 0.0325,
            load: 5.7,
            creep: 0.01,
            shape: 1.0,
            ..Contact::default()
        };
        WheelSlip::of(&p).expect("as many as on the card").contact(&(), &EffectContext::default(), &mut x);
        x
    }

    fn bits(x: &Contact<f64>) -> [u64; 5] {
        [x.grip, x.stiffness, x.shape, x.inertia, x.curvature].map(f64::to_bits)
    }

    fn form(shape: f64, curvature: f64) -> CurveShape<f64> {
        CurveShape { stiffness: 30.0, shape, curvature }
    }

    /// Every form of the curve, and slips on both sides of its knee.
    fn everywhere(look: impl Fn(&CurveShape<f64>, f64)) {
        for shape in [0.8, 1.0, 1.4] {
            for curvature in [0.0, -1.0, -2.0] {
                for slip in [-0.4, -0.02, 0.0, 0.01, 0.1, 0.7] {
                    look(&form(shape, curvature), slip);
                }
            }
        }
    }

    #[test]
    fn without_a_coefficient_the_contact_holds_any_force_bit_for_bit() {
        assert_eq!(bits(&touched([0.0, 30.0, 1.2, 7e-5, -1.0])), [0.0, 0.0, 1.0, 0.0, 0.0].map(f64::to_bits));
        assert_eq!(bits(&touched([0.35, 30.0, 1.2, 7e-5, -1.0])), [0.35, 30.0, 1.2, 7e-5, -1.0].map(f64::to_bits));
    }

    #[test]
    fn at_small_slip_it_is_a_damper_and_at_large_slip_it_holds_the_limit() {
        for shape in [0.9, 1.0, 1.3] {
            for curvature in [0.0, -1.0, -2.0] {
                let (force, slope) = traction(2.0, &form(shape, curvature), 1e-7);
                assert!((slope - 2.0 * 30.0 * shape).abs() < 1e-6);
                assert!((force - slope * 1e-7).abs() < 1e-12);
            }
        }
        for curvature in [0.0, -1.0, -2.0] {
            let (force, slope) = traction(2.0, &form(1.0, curvature), 100.0);
            assert!((force - 2.0).abs() < 1e-6 && slope.abs() < 1e-6);
        }
    }

    #[test]
    fn the_closed_forms_are_the_formula_at_a_shape_of_one_and_a_curvature_of_zero() {
        for k in -50..=50 {
            let slip = f64::from(k) * 0.01;
            for (shape, curvature) in [(1.0, 0.0), (1.0, -1.5), (1.2, 0.0)] {
                let [force, slope, bend] = curve(2.0, &form(shape, curvature), slip);
                let near = curve(2.0, &form(shape + 1e-12, curvature - 1e-13), slip);
                assert!((force - near[0]).abs() < 1e-10 && (slope - near[1]).abs() < 1e-9);
                assert!((bend - near[2]).abs() < 1e-7, "{shape} {curvature} {slip}");
            }
        }
    }

    #[test]
    fn a_sharper_knee_holds_the_straight_line_for_longer_and_is_at_its_limit_sooner() {
        // at x = 1 and E = −2: y = 1 + 2·(1 − π/4) = 3 − π/2
        let y = 3.0 - core::f64::consts::FRAC_PI_2;
        let (force, _) = traction(1.0, &form(1.0, -2.0), 1.0 / 30.0);
        assert!((force - y / (1.0 + y * y).sqrt()).abs() < 1e-15);
        for k in 1..=60 {
            let x = f64::from(k) * 0.05;
            let force = |curvature: f64| traction(1.0, &form(1.0, curvature), x / 30.0).0;
            assert!(force(-2.0) > force(-1.0) && force(-1.0) > force(0.0));
            // f = x − (E/3 + ½)·x³ + …: down to E = −3/2 it is nowhere above the straight line
            assert!(force(-1.5) < x.min(1.0));
        }
    }

    #[test]
    fn the_slope_is_that_of_the_force() {
        everywhere(|form, slip| {
            let h = 1e-6;
            let difference = (traction(2.0, form, slip + h).0 - traction(2.0, form, slip - h).0) / (2.0 * h);
            assert!((traction(2.0, form, slip).1 - difference).abs() < 1e-5, "{form:?} {slip}");
        });
    }

    #[test]
    fn the_bend_is_the_slope_of_the_slope() {
        everywhere(|form, slip| {
            let h = 1e-6;
            let slope = |slip| traction(2.0, form, slip).1;
            let difference = (slope(slip + h) - slope(slip - h)) / (2.0 * h);
            assert!((curve(2.0, form, slip)[2] - difference).abs() < 1e-3, "{form:?} {slip}");
        });
    }

    #[test]
    fn it_brakes_the_slip_both_ways_and_never_beyond_the_limit() {
        for shape in [0.8, 1.0, 1.4] {
            for curvature in [0.0, -1.0, -2.0] {
                for k in -200..=200 {
                    let slip = f64::from(k) * 0.02;
                    let (force, _) = traction(2.0, &form(shape, curvature), slip);
                    assert!(force * slip >= 0.0 && force.abs() <= 2.0 + 1e-12);
                    assert!((force + traction(2.0, &form(shape, curvature), -slip).0).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn above_a_shape_of_one_it_falls_after_a_peak() {
        let force = |slip: f64| traction(2.0, &form(1.4, 0.0), slip).0;
        // the peak stands where C·atan(B·s) is a quarter turn
        let (sin, cos) = (core::f64::consts::FRAC_PI_2 / 1.4).sin_cos();
        let peak = sin / cos / 30.0;
        assert!((force(peak) - 2.0).abs() < 1e-12);
        assert!(force(0.9 * peak) < force(peak) && force(1.1 * peak) < force(peak));
    }
}
