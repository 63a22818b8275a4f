//! # Card: an effect's page as data
//!
//! What a person reads on an effect's page and what the tools need to know about it are the same facts, so they are
//! written once, as a constant beside the law. `omni-gap explain` prints a card, `robot.toml` takes its keys from it,
//! the ranking takes its bounds and look-alikes from it, and the tests hold every card to what it says.

use super::shows::Shows;

/// The most parameters that one effect may have.
pub const MAX_PARAMS: usize = 8;

/// Where on the signal path an effect acts, in signal order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Seam {
    /// Telegram: command that is sent → command that arrives.
    Command,
    /// Drive that controls wheel speed: speed that is set → speed of the wheel.
    SpeedDrive,
    /// Battery: bus current → bus voltage.
    Supply,
    /// Bridge: commanded voltage → terminal voltage.
    Bridge,
    /// Winding: terminal voltage → current → shaft torque.
    Winding,
    /// Shaft: from the rotor to the wheel, rigid or not.
    Shaft,
    /// Gear: motor torque → wheel torque, with the friction and inertia that sit on the wheel shaft.
    Gear,
    /// Contact: wheel torque → force on the floor.
    Contact,
    /// Body: forces → acceleration.
    Body,
    /// Sensors: truth → reading.
    Sense,
}

impl Seam {
    /// All seams in signal order.
    pub const ALL: [Seam; 10] = [
        Seam::Command,
        Seam::SpeedDrive,
        Seam::Supply,
        Seam::Bridge,
        Seam::Winding,
        Seam::Shaft,
        Seam::Gear,
        Seam::Contact,
        Seam::Body,
        Seam::Sense,
    ];

    /// The stage that a report names for this seam.
    pub const fn stage(self) -> Stage {
        match self {
            Seam::Command | Seam::SpeedDrive | Seam::Supply | Seam::Bridge | Seam::Winding => Stage::Electrical,
            Seam::Shaft | Seam::Gear => Stage::Drivetrain,
            Seam::Contact => Stage::Contact,
            Seam::Body => Stage::Body,
            Seam::Sense => Stage::Sensing,
        }
    }
}

/// The five stages of the robot that a report speaks of, in signal order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// Voltage to current.
    Electrical,
    /// Current to torque at the wheel.
    Drivetrain,
    /// Wheel to floor.
    Contact,
    /// Force to motion.
    Body,
    /// Motion to reading.
    Sensing,
}

impl Stage {
    /// All stages in signal order.
    pub const ALL: [Stage; 5] = [Stage::Electrical, Stage::Drivetrain, Stage::Contact, Stage::Body, Stage::Sensing];

    /// The name that files use.
    pub const fn name(self) -> &'static str {
        match self {
            Stage::Electrical => "electrical",
            Stage::Drivetrain => "drivetrain",
            Stage::Contact => "contact",
            Stage::Body => "body",
            Stage::Sensing => "sensing",
        }
    }
}

/// Where an effect sits on the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// On the robot as a whole.
    Robot,
    /// On every wheel alike, or on one wheel alone.
    Wheels,
    /// On one wheel alone: on all of them it would be a nominal parameter, or each of them has a phase of its own.
    OneWheel,
}

impl Scope {
    /// True if an effect can sit on this wheel of so many, or on none in particular.
    pub const fn admits(self, wheel: Option<usize>, wheels: usize) -> bool {
        match (self, wheel) {
            (Scope::Robot, None) | (Scope::Wheels, None) => true,
            (Scope::Robot, Some(_)) | (Scope::OneWheel, None) => false,
            (Scope::Wheels | Scope::OneWheel, Some(wheel)) => wheel < wheels,
        }
    }
}

/// One parameter of an effect.
#[derive(Clone, Copy, Debug)]
pub struct Param {
    /// Its key in `robot.toml`, in snake case, with the unit as suffix where it has one.
    pub key: &'static str,
    /// Its symbol in the equation.
    pub symbol: &'static str,
    /// Its SI unit, "1" where it has none.
    pub unit: &'static str,
    /// The value at which the effect does nothing, whatever the other parameters are; for a parameter that only shapes
    /// the effect, its default.
    pub absent: f64,
    /// A value often met on a small omni robot.
    pub typical: f64,
    /// The lowest and the highest value that make physical sense.
    pub within: (f64, f64),
    /// What the diagnosis does with it.
    pub role: Role,
}

/// What a parameter does in its effect, and so what a fit does with it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// It sizes the effect: at `absent` there is none. Fitted; must stand in `robot.toml`.
    Size,
    /// It shapes the effect. Fitted from `typical`; `typical` where `robot.toml` leaves it out. Of an effect without a size, which is
    /// there or not, a shape that is `absent` does nothing either.
    Shape,
    /// It shapes the effect too weakly to be found in a recording. Held at `typical`, which is also its default.
    Fixed,
}

/// An effect that can be mistaken for another.
#[derive(Clone, Copy, Debug)]
pub struct LookAlike {
    /// The id of the other effect, or of a nominal parameter.
    pub with: &'static str,
    /// The measurement that tells the two apart, as an instruction to a person.
    pub settled_by: &'static str,
}

/// What the robot's controller does about an effect that its parameters name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undone {
    /// It undoes it in every turn of its loop, with the effect's hooks for that: how.
    By(&'static str),
    /// It counts it into the model once, as the plant does at winding and gear, and has nothing left to undo: how.
    Folded(&'static str),
    /// It cannot: why.
    No(&'static str),
}

impl Undone {
    /// How, or why not.
    pub const fn words(self) -> &'static str {
        match self {
            Undone::By(how) | Undone::Folded(how) => how,
            Undone::No(why) => why,
        }
    }

    /// True if the robot undoes it.
    pub const fn possible(self) -> bool {
        !matches!(self, Undone::No(_))
    }
}

/// What physics says of an effect whatever its size: the tests hold every effect to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Physics {
    /// True if it moves no robot whose motors rest: it takes energy, or keeps it, and never gives any.
    pub passive: bool,
    /// The parameter that is an inertia at the wheel shaft [kg·m²]: there it keeps energy.
    pub inertia: Option<usize>,
    /// The parameters that change their sign in a mirror that swaps left and right.
    pub mirrored: &'static [usize],
    /// The parameter that is a direction in the world [rad].
    pub direction: Option<usize>,
    /// The two parameters that are a place on the robot, along its axes (v, vn) [m].
    pub place: Option<[usize; 2]>,
    /// The two parameters that are a place in the world (x, y) [m].
    pub world_place: Option<[usize; 2]>,
    /// True if the model has a corner where the effect is absent, so that a fit has to start elsewhere: a coefficient of
    /// friction of zero stands for an infinite one, and the plant leaves out a contact's creep while there is none.
    pub corner_at_absent: bool,
    /// True if its size is a limit, of which zero stands for none: the smaller it is, the more of the effect there is.
    pub is_limit: bool,
    /// True if it goes by how long the robot has run: one that has run for longer then moves otherwise.
    pub ages: bool,
    /// The effect without which nothing of a run depends on this one.
    pub shows_beside: Option<&'static str>,
    /// How far two runs of some seconds may part that symmetry makes one: of velocities and poses, in SI units.
    pub apart: f64,
}

impl Physics {
    /// An effect that takes energy and looks the same in a mirror, up to rounding, which friction keeps small.
    pub const PASSIVE: Self = Self {
        passive: true,
        inertia: None,
        mirrored: &[],
        direction: None,
        place: None,
        world_place: None,
        corner_at_absent: false,
        is_limit: false,
        ages: false,
        shows_beside: None,
        apart: 1e-9,
    };

    /// The same of dry friction at the wheels, about their shafts or along them. Its budgets couple the axes; the sweeps over
    /// them stop once nothing moves by more than 1e-6 m/s, and go through the axes in their order, which a turned robot has
    /// otherwise.
    pub const DRY_AT_WHEELS: Self = Self { apart: 1e-4, ..Self::PASSIVE };
}

/// An effect's page as data.
#[derive(Clone, Copy, Debug)]
pub struct Card {
    /// Its name in files: that of its source file.
    pub id: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// One sentence in plain words: what happens on the robot.
    pub summary: &'static str,
    /// The law.
    pub equation: &'static str,
    /// Where the law and the sizes come from.
    pub source: &'static str,
    /// The seams that it touches, in signal order; the first is its home.
    pub seams: &'static [Seam],
    /// Where it sits.
    pub scope: Scope,
    /// Its parameters, in the order in which the hooks receive them; at most [`MAX_PARAMS`].
    pub params: &'static [Param],
    /// True if its drive hook looks at the current, which then has to be solved for.
    pub needs_current: bool,
    /// Where it shows in a recording.
    pub shows: Shows,
    /// How it shows there, as far as that says more.
    pub signature: &'static str,
    /// What it can be mistaken for.
    pub look_alikes: &'static [LookAlike],
    /// Its number in the parameter blocks that robots keep. It stays with the effect for ever; a new one gets the next.
    pub code: u8,
    /// How the robot's controller undoes it, or why it cannot.
    pub undone: Undone,
    /// What it does to energy and symmetry.
    pub physics: Physics,
}

impl Card {
    /// The stage where a report places the effect.
    pub const fn stage(&self) -> Stage {
        self.seams[0].stage()
    }

    /// True if it acts on nothing but a drive that controls wheel speed: only speeds that are set show it.
    pub fn of_speed_drive(&self) -> bool {
        self.seams == [Seam::SpeedDrive]
    }

    /// True if a record shows each time that it happens, so that it is counted: a command that the current does not answer.
    pub fn shows_event_by_event(&self) -> bool {
        self.seams[0] == Seam::Command
    }

    /// The index of a parameter by its key.
    pub fn param(&self, key: &str) -> Option<usize> {
        self.params.iter().position(|p| p.key == key)
    }
}
