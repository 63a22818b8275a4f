//! Speed-driven: the wheel speeds are imposed, as measured or as a drive makes them of the speeds that are set.
//!
//! A body on rigid wheels has no choice: its twist is the least-squares twist of the rim speeds, along the directions in
//! which the wheels really drive. Where contacts creep or slip, the floor's force follows from the slip, and the body
//! moves by its dynamics.

use super::model::Plant;
use super::source::Source;
use super::state::{Reading, State};
use super::step::{Done, Push, Turned};
use super::traction::Floor;
use crate::effects::EffectSet;
use crate::effects::card::Seam;
use crate::effects::seams::{Contact, SpeedDrive};
use crate::geometry::frames::BodyTwist;
use crate::number::linalg::{accumulate_outer, add_scaled, solve3};
use crate::number::scalar::Real;

impl<const N: usize, T: Real, E: EffectSet<T>> Plant<N, T, E> {
    /// What the drives of the wheels make of the speeds that are set [rad/s].
    pub(super) fn speed_drives(
        &self,
        state: &State<N, T>,
        memory: &[E::State],
        set: &[T; N],
        dt: T,
    ) -> [SpeedDrive<T>; N] {
        let mut at = self.at(state, dt);
        let mut drives = set.map(SpeedDrive::following);
        for active in self.effects.at(Seam::SpeedDrive) {
            for j in (0..N).filter(|j| active.on(*j)) {
                self.enter_wheel(&mut at, state, j, (state.wheel_speed[j], self.rim_speed(state, j)));
                active.effect.speed_drive(&memory[active.memory(j)], &at, &mut drives[j]);
            }
        }
        drives
    }

    /// Takes one step of `dt` [s] with the wheels turning as their drives make them, and returns the reading at its beginning.
    pub(super) fn step_speed_driven(
        &self,
        state: &mut State<N, T>,
        memory: &mut [E::State],
        drives: &[SpeedDrive<T>; N],
        dt: T,
    ) -> Reading<N, T> {
        let mut at = self.at(state, dt);
        let contact = self.contacts(&mut at, state, memory);
        let zero = T::zero();
        let rolling = |speed: fn(&SpeedDrive<T>) -> T| {
            self.rolling(&contact, core::array::from_fn(|j| contact[j].radius * speed(&drives[j])))
        };
        let yields = contact.iter().all(|c| !c.rolls());
        let mean = rolling(|drive| drive.mean);
        // without an effect a drive follows at once: the wheels turn alike throughout the step
        let at_instant = |speed| if self.effects.none_at(Seam::SpeedDrive) { mean } else { rolling(speed) };
        if !yields {
            state.twist = mean;
            at.twist = mean;
        }
        let mut truth = Reading {
            current: [zero; N],
            wheel_speed: drives.map(|drive| drive.before),
            pose: state.pose,
            gyro: if yields { state.twist.w } else { at_instant(|drive| drive.before).w },
        };
        let next = if yields {
            let x = state.twist.to_array();
            let mut push = Push::of([zero; 3], [[zero; 3]; 3]);
            for (j, (c, drive)) in contact.iter().zip(drives).enumerate() {
                let (force, slope) = Floor::of(c).force(drive.mean * c.radius - c.rim_speed(state.twist));
                // twice the slope: the floor's force is stiff, and this makes the step implicit in it
                c.add_force(&mut push.body.force, force);
                c.add_rate(&mut push.body.rate, slope.times(T::Plain::lit(2.0)));
                if c.rollers_drag() {
                    push.add_rollers(j, c, x);
                }
            }
            BodyTwist::from_array(self.move_body(&mut at, state, memory, &mut push, dt))
        } else {
            mean
        };
        state.wheel_speed = drives.map(|drive| drive.after);
        state.slip = [zero; N];
        if yields {
            for (j, c) in contact.iter().enumerate() {
                state.slip[j] = state.wheel_speed[j] - c.rim_speed(next) * c.per_radius;
            }
        }
        // no current is known that would make heat
        let turned = Turned { heat: self.needs.heat.then_some([zero; N]), ..Turned::default() };
        let source = Source::Speed(drives);
        let done = Done { next, contact: &contact, source: &source, bus: self.robot.supply, turned: &turned };
        self.finish(&mut at, state, memory, &done, &mut truth);
        if !yields {
            state.twist = at_instant(|drive| drive.after);
        }
        truth
    }

    /// The twist that comes nearest to these speeds of the wheels [rad/s], if they roll.
    pub fn twist_of_wheel_speeds(&self, speed: [T; N]) -> BodyTwist<T> {
        let contact = self.usual_contacts();
        self.rolling(contact, core::array::from_fn(|j| contact[j].radius * speed[j]))
    }

    /// The twist that comes nearest to these rim speeds [m/s].
    fn rolling(&self, contact: &[Contact<T>; N], rim: [T; N]) -> BodyTwist<T> {
        let as_built = |(c, built): (&Contact<T>, &Contact<T>)| {
            c.fixed_direction && c.row == built.row && (c.row[2] - built.row[2]).is_nothing()
        };
        if contact.iter().zip(&self.contact).all(as_built) {
            return self.robot.wheels.twist(rim);
        }
        // (v, vn, ω) = (GᵀG)⁻¹·Gᵀ·v⃗
        let (mut gram, mut sum) = ([[T::zero(); 3]; 3], [T::zero(); 3]);
        for (c, rim) in contact.iter().zip(rim) {
            accumulate_outer(&mut gram, T::one(), c.row);
            sum = add_scaled(sum, rim, c.row);
        }
        BodyTwist::from_array(solve3(&gram, sum))
    }
}
