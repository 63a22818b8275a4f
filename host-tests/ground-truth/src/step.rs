//! One step: all velocities at its end, found together by what is known of its middle; then everything else.

use nalgebra::{Matrix2, Vector2, Vector3};

use crate::contact::{Grip, loads};
use crate::holds::of_wheel;
use crate::rotated::rotated;
use crate::shaft::{Shaft, Twisted};
use crate::simulation::{Middle, Simulation};
use crate::state::State;
use crate::surroundings::Place;
use crate::twist_at::twist_at;

/// Times that a step is looked at; in the later ones what depends on its middle is known.
const PASSES: usize = 2;

/// Parts of a step in which friction turns round.
const PARTS: f64 = 8.0;

/// What a shaft has at least [kg·m²]: a wheel without inertia, whose bridge is open, would move by any speed.
const LEAST_INERTIA: f64 = 1e-10;

impl Simulation {
    /// One step; where friction turns round in it or lets go, in parts.
    pub(crate) fn advance(&mut self) {
        self.control();
        let Self { before, state, impulses, .. } = self;
        before.state.clone_from(state);
        before.impulses.clone_from(impulses);
        self.find();
        if !self.turns_round() {
            return self.take();
        }
        self.state.clone_from(&self.before.state);
        self.impulses.clone_from(&self.before.impulses);
        let whole = self.step;
        self.step = whole / PARTS;
        self.impulses.iter_mut().for_each(|impulse| *impulse /= PARTS);
        for _ in 0..PARTS as usize {
            self.find();
            self.take();
        }
        self.step = whole;
        self.impulses.iter_mut().for_each(|impulse| *impulse *= PARTS);
    }

    /// Lets a drive that controls speed look, where it is time for that.
    fn control(&mut self) {
        let (time, delay) = (self.state.time, self.delay());
        let Some(drive) = self.robot.drive.filter(|drive| drive.looks(&self.state.driving, time)) else { return };
        // nothing is heard of the middle of a step yet: its place is free
        self.commands.at(time - delay, &mut self.middle.heard);
        let State { driving, shafts, .. } = &mut self.state;
        drive.look(driving, time, &self.middle.heard, shafts.iter().map(|shafts| shafts.x));
    }

    /// Finds the velocities at the end of a step.
    fn find(&mut self) {
        if self.robot.drive.is_some() {
            self.middle.heard.clone_from(&self.state.driving.volts);
        } else {
            let (from, delay) = (self.state.time, self.delay());
            self.commands.mean((from - delay, from + self.step - delay), &mut self.middle.heard);
        }
        self.robot.oddities.hear(&self.state.memory, &mut self.middle.heard);
        self.middle.twist = self.state.twist + 0.5 * self.step * self.state.twist_rate;
        self.middle.shafts.clone_from(&self.state.shafts);
        self.middle.currents.clone_from(&self.state.currents);
        for _ in 0..PASSES {
            self.push_body();
            self.turn_shafts();
            self.limit();
            self.velocities.solve(&self.constraints, &mut self.impulses);
            self.find_middle();
        }
    }

    /// True if a constraint does not do what it did in the step before: slide one way, the other, or hold.
    fn turns_round(&mut self) -> bool {
        let mut any = false;
        for (slides, (constraint, impulse)) in self.slides.iter_mut().zip(self.constraints.iter().zip(&self.impulses)) {
            let now = constraint.slides(*impulse);
            any |= *slides != now;
            *slides = now;
        }
        any
    }

    /// What moves the body without any constraint: (M + Δt/2·B)·V⁺ = (M − Δt/2·B)·V + Δt·F.
    fn push_body(&mut self) {
        let (step, half) = (self.step, 0.5 * self.step);
        let damped = self.chassis.inertia + half * self.chassis.viscous;
        let kept = self.chassis.inertia - half * self.chassis.viscous;
        let place = self.place();
        let mut pull = self.robot.surroundings.pull(&place);
        if let Some(forces) = &self.robot.surroundings.unrest {
            pull += twist_at(place.centre).transpose() * forces.at(self.state.time + half);
        }
        let pull = self.with_odd_forces(pull, &place);
        let force = pull + self.chassis.apparent(self.middle.twist);
        let v = &mut self.velocities;
        v.body_mobility = damped.try_inverse().expect("a body with mass and inertia");
        v.body = v.body_mobility * (kept * self.state.twist + step * force);

        let rate = (self.middle.twist - self.state.twist) / half;
        // M·a = M·V̇ − what is apparent
        let by_floor = self.chassis.inertia * rate - self.chassis.apparent(self.middle.twist);
        let mass = self.weighing();
        loads(&self.feet, mass, self.robot.chassis.height, by_floor.xy() / mass, &mut self.middle.loads);
        for (load, wheel) in self.middle.loads.iter_mut().zip(&self.robot.wheels) {
            *load *= wheel.load_factor;
        }
    }

    /// Where the body is in the middle of the step.
    pub(crate) fn place(&self) -> Place {
        let (half, twist) = (0.5 * self.step, self.middle.twist);
        let heading = self.state.heading + half * twist.z;
        Place {
            position: self.state.position + half * rotated(heading, twist.xy()),
            heading,
            twist,
            centre: -self.point,
            centre_of_mass: self.chassis.com,
            mass: self.robot.chassis.mass,
        }
    }

    /// What turns the shafts without any constraint: their motors.
    fn turn_shafts(&mut self) {
        let (step, half) = (self.step, 0.5 * self.step);
        let bus = self.bus(&self.middle.heard, &self.middle.currents);
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let (l, near, rotor) = (wheel.gear_ratio, self.middle.currents[j], self.rotor(j));
            let winding = self.winding(j, self.middle.heard[j], (bus, near, l * self.middle.shafts[j][rotor]));
            let angle = l * (self.state.turned[j][rotor] + half * self.middle.shafts[j][rotor]);
            let per_current = l * wheel.motor.torque_per_current(near, angle, self.state.temperatures[j]);
            let cogging = l * crate::harmonics::at(&wheel.motor.cogging, angle);
            let (driven, brake) = (per_current * winding.stalled + cogging, l * per_current * winding.per_speed);
            let (own, reflected) = (wheel.inertia, wheel.reflected_inertia());
            let bearing = wheel.bearing.viscous;
            let wheel_angle = self.state.turned[j].x + half * self.middle.shafts[j].x;
            let bias = self.robot.oddities.over_tooth(j, wheel.bearing.bias(), wheel_angle);
            let (inertia, damping, torque) = match wheel.shaft {
                // the rotor that is apart is nobody's
                Shaft::Rigid => (
                    Vector2::new((own + reflected).max(LEAST_INERTIA), 1.0),
                    Matrix2::new(bearing + brake, 0.0, 0.0, 0.0),
                    Vector2::new(bias + driven, 0.0),
                ),
                Shaft::Elastic { .. } => {
                    let [wheel_angle, rotor_angle] = self.state.turned[j].into();
                    let speed = self.middle.shafts[j].x - self.middle.shafts[j].y;
                    let apart = wheel_angle - rotor_angle - self.robot.oddities.slipped(j, &self.state.memory);
                    let twisted = wheel.shaft.twisted(apart, speed, step);
                    let Twisted { still, per_speed: k } = self.robot.oddities.through_hub(j, twisted, speed);
                    (
                        Vector2::new(own.max(LEAST_INERTIA), reflected.max(LEAST_INERTIA)),
                        Matrix2::new(bearing + k, -k, -k, brake + k),
                        Vector2::new(bias - still, driven + still),
                    )
                }
            };
            // (J + Δt/2·D)·ω⁺ = (J − Δt/2·D)·ω + Δt·τ
            let inertia = Matrix2::from_diagonal(&inertia);
            let mobility = (inertia + half * damping).try_inverse().expect("shafts with inertia");
            self.velocities.shaft_mobility[j] = mobility;
            self.velocities.shafts[j] = mobility * ((inertia - half * damping) * self.state.shafts[j] + step * torque);
        }
    }

    /// What each constraint can hold in this step, from what is known of its middle.
    fn limit(&mut self) {
        self.limit_body();
        let step = self.step;
        let time = self.state.time + 0.5 * step;
        let Middle { twist, shafts, torques, loads, .. } = &self.middle;
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let [floor, rollers, bearing] = of_wheel(j);
            let constraints = &mut self.constraints;
            let angle = self.state.turned[j].x + 0.5 * step * shafts[j].x;
            constraints[floor].row.wheel = Some((j, -wheel.radius_at(angle)));
            match wheel.grip {
                Grip::Rolls => {}
                // s⁺ = c·f⁺, λ = −Δt·f⁺
                Grip::Creeps(creep) => constraints[floor].yields = creep / step,
                Grip::Slips(slip) => {
                    let friction = slip.friction(constraints[floor].row.along(twist, shafts));
                    // rollers spend a part of what the floor can hold
                    let holds = (friction * loads[j]).powi(2) - wheel.roller_friction.powi(2);
                    constraints[floor].hold(holds.max(0.0).sqrt() * step);
                    (constraints[floor].yields, constraints[floor].relaxes) =
                        slip.softness(self.state.strained[j], step);
                }
            }
            let along_axle = constraints[rollers].row.along(twist, shafts).abs();
            constraints[rollers].hold((wheel.roller_friction + wheel.roller_damping * along_axle) * step);
            let gear = wheel.gear_loss(torques[j], shafts[j].x);
            constraints[bearing].hold((wheel.bearing.dry(shafts[j].x, time) + gear) * step);
        }
    }

    fn limit_body(&mut self) {
        let (friction, step) = (&self.robot.chassis.friction, self.step);
        let place = self.place();
        let centre = place.position + rotated(place.heading, place.centre);
        let factor = self.robot.surroundings.friction_at(centre);
        let holds = factor * friction.holds(self.chassis.centre * self.middle.twist);
        for (axis, constraint) in self.constraints.iter_mut().take(3).enumerate() {
            constraint.hold(holds[axis] * step);
            if friction.give > 0.0 && friction.coulomb[axis] > 0.0 {
                // a spring that is full at what the axis holds: s⁺ = (f⁺ − f)/(k·Δt), λ = −Δt·f⁺
                let give = friction.give * if axis == 2 { 1.0 / self.arm } else { 1.0 };
                let soft = give / (friction.coulomb[axis] * step);
                (constraint.yields, constraint.relaxes) = (soft / step, self.state.given[axis] * soft);
            }
        }
    }

    /// The middle as it now seems, for the next pass.
    fn find_middle(&mut self) {
        self.middle.twist = 0.5 * (self.state.twist + self.velocities.body);
        let ends = self.state.shafts.iter().zip(&self.velocities.shafts);
        for (middle, (before, after)) in self.middle.shafts.iter_mut().zip(ends) {
            *middle = 0.5 * (before + after);
        }
        let bus = self.bus(&self.middle.heard, &self.middle.currents);
        for j in 0..self.robot.wheels.len() {
            let (l, rotor) = (self.robot.wheels[j].gear_ratio, self.rotor(j));
            let speed = l * self.middle.shafts[j][rotor];
            let current = self.winding(j, self.middle.heard[j], (bus, self.middle.currents[j], speed)).current(speed);
            let angle = l * (self.state.turned[j][rotor] + 0.5 * self.step * self.middle.shafts[j][rotor]);
            let motor = &self.robot.wheels[j].motor;
            let per_current = l * motor.torque_per_current(current, angle, self.state.temperatures[j]);
            (self.middle.currents[j], self.middle.torques[j]) = (current, per_current * current);
        }
    }

    /// Takes the step that was looked at.
    fn take(&mut self) {
        let step = self.step;
        let drawn = self.drawn(&self.middle.heard, &self.middle.currents);
        let supplied = self.robot.oddities.supplied(drawn, &self.state.memory);
        self.remember(drawn);
        let place = self.place();
        let state = &mut self.state;
        state.polarisation = self.robot.battery.polarised(state.polarisation, supplied, step);
        state.twist_rate = (self.velocities.body - state.twist) / step;
        // ẋ = R(θ)·(v, vn), at the middle of the step
        state.position += step * rotated(place.heading, place.twist.xy());
        state.heading += step * place.twist.z;
        state.twist = self.velocities.body;
        state.given = Vector3::from_fn(|axis, _| -self.impulses[axis] / step);
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let [floor, ..] = of_wheel(j);
            state.strained[j] = -self.impulses[floor] / step;
            let middle = self.middle.currents[j];
            let heat = wheel.motor.warm_resistance(state.temperatures[j]) * middle * middle;
            state.temperatures[j] = wheel.motor.heating.warmed(state.temperatures[j], heat, step);
            // i⁺ = 2·i½ − i
            state.currents[j] = if wheel.motor.inductance > 0.0 { 2.0 * middle - state.currents[j] } else { middle };
        }
        for (turned, speed) in state.turned.iter_mut().zip(&self.middle.shafts) {
            *turned += step * speed;
        }
        state.shafts.clone_from(&self.velocities.shafts);
        state.time += step;
    }
}
