//! Foreign kinds: what may be hidden in a robot though no entry of the diagnosis's catalogue describes it, so that the right
//! answer is that it is unknown.
//!
//! Each says which entry comes closest and why that is not it. Once is a size that small robots have; sizes go by the
//! robot's own numbers.

use core::f64::consts::TAU;

use nalgebra::Vector2;

use crate::contact::GRAVITY;
use crate::drawn::Drawn;
use crate::misread::{Counts, Lean};
use crate::oddities::converter::Converter;
use crate::oddities::drive::Foldback;
use crate::oddities::floor::{Planks, Ridge};
use crate::oddities::gusts::Gusts;
use crate::oddities::load::Load;
use crate::oddities::spells::Spells;
use crate::oddities::towed::Towed;
use crate::oddities::wheel::{Hub, LostPhase, Tooth};
use crate::robot::Wheel;
use crate::rotated::rotated;
use crate::setup::Setup;
use crate::shaft::Shaft;

/// Something that makes a robot differ, and that nobody has a name for.
#[derive(Clone, Copy, Debug)]
pub struct Foreign {
    /// What it is called here; no report can say it.
    pub id: &'static str,
    /// In one sentence.
    pub says: &'static str,
    /// Kept for sessions that nobody looks at before the end: no kind that is not fresh is of its nature.
    pub fresh: bool,
    /// Puts it into a setup, so many times the typical size, more than 0; the seed draws where and when.
    pub put: fn(&mut Setup, f64, u64),
}

/// All that there are.
pub const FOREIGN: &[Foreign] = &[
    // No entry has a second mass: `cog_offset` is rigid, `mass` and `inertia` answer at once.
    Foreign {
        id: "swinging_load",
        says: "A part of the mass swings on a spring of 2.5 Hz, as water in a tank does.",
        fresh: false,
        put: swinging_load,
    },
    // `floor_tilt` and `cable_pull` push the same way for ever; this goes by the time.
    Foreign {
        id: "gusts",
        says: "Wind pushes the robot, now this way and now that, between 0.3 and 3 times a second.",
        fresh: false,
        put: |at, x, seed| {
            let weight = at.robot.chassis.mass * GRAVITY;
            at.robot.oddities.gusts = Some(Gusts::drawn(0.03 * x * weight, (0.3, 3.0), seed));
        },
    },
    // `wheel_slip` has a limit too, but there the wheel turns with its motor; `current_limit` shows in the current.
    Foreign {
        id: "slipping_hub",
        says: "One wheel's hub is loose on its shaft and turns on it beyond a torque.",
        fresh: false,
        put: slipping_hub,
    },
    // `motor_mismatch` and `commutation_ripple` are there all the time; `command_loss` keeps the last voltage.
    Foreign {
        id: "lost_phase",
        says: "One motor's phase has a bad contact: for tenths of a second it pushes at some angles and not at others.",
        fresh: false,
        put: |at, x, seed| {
            let spells = Spells::drawn((0.05 * x, 0.2 * x), (0.3, 1.2), seed);
            at.robot.oddities.lost_phase = Some(LostPhase { wheel: wheel_by(at, seed), pole_pairs: 7.0, spells });
        },
    },
    // `dead_time` takes away and never adds, and goes by the current; `command_deadband` has one step, at zero.
    Foreign {
        id: "coarse_command",
        says: "The drives know sixteen levels of voltage each way and take the nearest.",
        fresh: false,
        put: |at, x, _| at.robot.oddities.levels = at.robot.battery.nominal / 16.0 * x,
    },
    // `current_sensor_gain` and `current_sensor_offset` read a motor's own current.
    Foreign {
        id: "current_crosstalk",
        says: "Each current sensor reads some of the next motor's current.",
        fresh: false,
        put: |at, x, _| at.sensors.misread.crosstalk = 0.08 * x,
    },
    // `camera_scale` grows with the distance and `camera_perspective` with its square to one side; this with its cube.
    Foreign {
        id: "lens_distortion",
        says: "The camera's lens bends straight lines, more the farther they are from the middle.",
        fresh: false,
        put: |at, x, _| at.sensors.misread.distortion = -0.08 * x,
    },
    // `cogging`, `roller_ripple` and `wheel_eccentricity` are one sinusoid each; this is a pulse that twenty of them make.
    Foreign {
        id: "damaged_tooth",
        says: "A bent tooth jams in one wheel's gear once a turn.",
        fresh: false,
        put: |at, x, seed| {
            let wheel = wheel_by(at, seed);
            // the torque where it is steepest is E/w·e^(−½)
            let (energy, width) = (0.2 * x * stall_torque(&at.robot.wheels[wheel], at.robot.battery.nominal), 0.12);
            let angle = Drawn::new(seed).between(0.0, TAU);
            at.robot.oddities.tooth = Some(Tooth { wheel, energy, at: angle, width });
        },
    },
    // `floor_patch` takes energy and is round; `floor_tilt` is the same everywhere. This gives back what it took.
    Foreign {
        id: "ridge",
        says: "A cable lies below the carpet along a line, and each wheel climbs over it.",
        fresh: true,
        put: |at, x, seed| {
            let across = rotated(Drawn::new(seed).between(0.0, TAU), Vector2::x());
            at.robot.oddities.ridge = Some(Ridge { across, at: 0.15, height: 0.004 * x, width: 0.02 });
        },
    },
    // `supply_sag` stays as long as its current does; this is over after a moment, and swings back beyond where it was.
    Foreign {
        id: "slow_converter",
        says: "A converter with a slow loop feeds the bridges: its voltage swings at 15 Hz whenever their current changes.",
        fresh: true,
        put: |at, x, _| {
            let impedance = 0.6 * x * at.robot.wheels[0].motor.resistance;
            at.robot.oddities.converter = Some(Converter::swinging(TAU * 15.0, 0.15, impedance));
        },
    },
    // `regeneration_asymmetry` costs a fixed voltage at every command; `command_deadband` is of speed drives.
    Foreign {
        id: "coasting_drive",
        says: "Below a small voltage the drives let go of their motors instead of braking them.",
        fresh: true,
        put: |at, x, _| at.robot.oddities.coasts_below = 0.06 * x * at.robot.battery.nominal,
    },
    // `marker_offset` stays where it is on the robot; `camera_latency` goes with the speed and not with its change.
    Foreign {
        id: "leaning_body",
        says: "The body leans on springs as it gains speed, and the marker on its top with it.",
        fresh: true,
        put: |at, x, _| at.sensors.misread.lean = Some(Lean { gives: 0.004 * x, frequency: TAU * 3.0, damping: 0.15 }),
    },
    // `encoder_scale` is the same share at any speed, and `encoder_lag` goes with the change of speed.
    Foreign {
        id: "lost_counts",
        says: "Encoders lose a part of their counts above a speed.",
        fresh: true,
        put: |at, x, _| {
            let wheel = &at.robot.wheels[0];
            let free = at.robot.battery.nominal / (wheel.gear_ratio * wheel.motor.emf_constant);
            at.sensors.misread.counts = Some(Counts { from: 0.2 * free, lost: 0.2 * x });
        },
    },
    // `cable_pull` leads to one place for ever; `coulomb_friction` turns round at once.
    Foreign {
        id: "towed_weight",
        says: "A weight drags behind on a string, which is slack for a while whenever the robot turns round.",
        fresh: true,
        put: |at, x, seed| {
            let hitch = rotated(Drawn::new(seed).between(0.0, TAU), Vector2::new(0.08, 0.0));
            let friction = 0.3 * x * at.robot.chassis.friction.coulomb.xy().mean();
            at.robot.oddities.towed = Some(Towed { hitch, length: 0.2, friction, stiffness: 300.0 });
        },
    },
    // `friction_ellipse` and `coulomb_friction` go by the body's axes; `carpet_nap` costs nothing one way.
    Foreign {
        id: "planks",
        says: "The floor is of planks: across their joints it takes more force than along them, both ways.",
        fresh: true,
        put: |at, x, seed| {
            let across = rotated(Drawn::new(seed).between(0.0, TAU), Vector2::x());
            let friction = 0.5 * x * at.robot.chassis.friction.coulomb.xy().mean();
            at.robot.oddities.planks = Some(Planks { across, friction, onset_speed: 0.03 });
        },
    },
    // `winding_heating` weakens a motor little by little; `current_limit` goes by the current of the moment.
    Foreign {
        id: "thermal_foldback",
        says: "A drive that has carried much current gives four fifths of its voltage until it has cooled down.",
        fresh: true,
        put: |at, x, _| {
            let stalled = at.robot.battery.nominal / at.robot.wheels[0].motor.resistance;
            let trips = (0.25 * stalled).powi(2) / x;
            at.robot.oddities.foldback = Some(Foldback { time: 0.5, trips, resets: 0.6 * trips, share: 0.8 });
        },
    },
];

/// A kind by its name.
pub fn foreign(id: &str) -> Option<&'static Foreign> {
    FOREIGN.iter().find(|foreign| foreign.id == id)
}

impl Setup {
    /// The same when the room's clock shows a time [s] at its beginning: what goes by that meets another part of a drive.
    #[must_use]
    pub fn begun_at(mut self, clock: f64) -> Self {
        self.robot.oddities.clock = clock;
        self
    }
}

/// The wheel that a seed draws.
fn wheel_by(at: &Setup, seed: u64) -> usize {
    Drawn::new(seed).below(at.robot.wheels.len() as u32) as usize
}

/// What a wheel's motor turns it with [N·m] at rest under a voltage [V].
fn stall_torque(wheel: &Wheel, voltage: f64) -> f64 {
    wheel.gear_ratio * wheel.motor.torque_constant * voltage / wheel.motor.resistance
}

fn swinging_load(at: &mut Setup, times: f64, _: u64) {
    let chassis = &mut at.robot.chassis;
    let share = (0.15 * times).min(0.8);
    let mass = share * chassis.mass;
    chassis.mass -= mass;
    // the load goes straight on by itself: held fast, both are the robot as it was
    chassis.transport = (chassis.transport - share) / (1.0 - share);
    let frequency = TAU * 2.5;
    // a twentieth of the damping at which it would not swing
    let damping = 0.05 * 2.0 * mass * frequency;
    at.robot.oddities.load = Some(Load { mass, stiffness: mass * frequency * frequency, damping });
}

fn slipping_hub(at: &mut Setup, times: f64, seed: u64) {
    let (j, nominal) = (wheel_by(at, seed), at.robot.battery.nominal);
    let wheel = &mut at.robot.wheels[j];
    let holds = 0.3 / times * stall_torque(wheel, nominal);
    // little enough to be no cause of its own
    wheel.inertia = wheel.inertia.max(5e-6);
    wheel.motor.rotor_inertia = wheel.motor.rotor_inertia.max(1e-5 / (wheel.gear_ratio * wheel.gear_ratio));
    if wheel.shaft == Shaft::Rigid {
        wheel.shaft = Shaft::Elastic { stiffness: 200.0, damping: 0.04, play: 0.0 };
    }
    at.robot.oddities.hub = Some(Hub { wheel: j, holds });
}
