//! One step: all velocities at its end, found together by what is known of its middle; then everything else.

use nalgebra::{Vector2, Vector3};

use crate::contact::loads;
use crate::holds::of_wheel;
use crate::impulse::Velocities;
use crate::robot::{Grip, Shaft};
use crate::rotated::rotated;
use crate::simulation::Simulation;

/// Times that a step is looked at; in the later ones what depends on its middle is known.
const PASSES: usize = 2;

/// What a shaft has at least [kg·m²]: a wheel without inertia, whose bridge is open, would move by any speed.
const LEAST_INERTIA: f64 = 1e-10;

impl Simulation {
    pub(crate) fn advance(&mut self, u: &[f64]) {
        self.middle.twist = self.state.twist + 0.5 * self.step * self.state.twist_rate;
        self.middle.shafts.clone_from(&self.state.shafts);
        self.middle.currents.clone_from(&self.state.currents);
        for _ in 0..PASSES {
            self.look(u);
        }
        self.take(u);
    }

    /// One pass: all velocities at the end of the step, with what is known of its middle.
    fn look(&mut self, u: &[f64]) {
        let (step, state, half) = (self.step, &self.state, 0.5 * self.step);
        let bus = self.bus(u, &self.middle.currents);

        // (M + Δt/2·B)·V⁺ = (M − Δt/2·B)·V + Δt·F
        let damped = self.chassis.inertia + half * self.chassis.viscous;
        let kept = self.chassis.inertia - half * self.chassis.viscous;
        let v = &mut self.velocities;
        v.body_mobility = damped.try_inverse().expect("a body with mass and inertia");
        v.body = v.body_mobility * (kept * state.twist + step * self.chassis.apparent(self.middle.twist));

        let rate = (self.middle.twist - state.twist) / half;
        let acceleration = self.acceleration_of_mass(rate);
        let (mass, height) = (self.robot.chassis.mass, self.robot.chassis.height);
        loads(&self.feet, mass, height, acceleration, &mut self.middle.loads);

        let wheels = self.robot.wheels.len();
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let voltage = u[j] * (bus / self.robot.battery.nominal);
            let winding = wheel.motor.winding(voltage, state.currents[j], self.middle.currents[j], step);
            let (l, kt) = (wheel.gear_ratio, wheel.motor.torque_constant);
            let (driven, brake) = (l * kt * winding.stalled, l * l * kt * winding.per_speed);
            let mut turn = |shaft: usize, inertia: f64, damping: f64, torque: f64| {
                let inertia = inertia.max(LEAST_INERTIA);
                let mobility = 1.0 / (inertia + half * damping);
                let v = &mut self.velocities;
                v.shaft_mobility[shaft] = mobility;
                v.shafts[shaft] = mobility * ((inertia - half * damping) * state.shafts[shaft] + step * torque);
            };
            match wheel.shaft {
                Shaft::Rigid => {
                    turn(j, wheel.inertia + wheel.reflected_inertia(), wheel.bearing.viscous + brake, driven);
                    turn(wheels + j, 1.0, 0.0, 0.0);
                }
                Shaft::Elastic { .. } => {
                    turn(j, wheel.inertia, wheel.bearing.viscous, 0.0);
                    turn(wheels + j, wheel.reflected_inertia(), brake, driven);
                }
            }
        }
        self.limit();
        self.velocities.solve(&self.constraints, &mut self.impulses);

        // the middle, for the next pass
        self.middle.twist = 0.5 * (self.state.twist + self.velocities.body);
        for (middle, (before, after)) in
            self.middle.shafts.iter_mut().zip(self.state.shafts.iter().zip(&self.velocities.shafts))
        {
            *middle = 0.5 * (before + after);
        }
        for (j, u) in u.iter().enumerate() {
            let wheel = &self.robot.wheels[j];
            let voltage = self.fed(*u, bus);
            let winding = wheel.motor.winding(voltage, self.state.currents[j], self.middle.currents[j], step);
            self.middle.currents[j] = winding.current(wheel.gear_ratio * self.middle.shafts[self.rotor(j)]);
        }
    }

    /// Acceleration of the centre of mass along the body's axes [m/s²], from how fast the twist changes.
    fn acceleration_of_mass(&self, rate: Vector3<f64>) -> Vector2<f64> {
        // M·a = M·V̇ − what is apparent
        let force = self.chassis.inertia * rate - self.chassis.apparent(self.middle.twist);
        force.xy() / self.robot.chassis.mass
    }

    /// What each constraint can hold in this step, from what is known of its middle.
    fn limit(&mut self) {
        let step = self.step;
        for (constraint, coulomb) in self.constraints.iter_mut().zip(self.robot.chassis.coulomb.iter()) {
            constraint.limit = coulomb * step;
        }
        let middle = Velocities {
            body: self.middle.twist,
            shafts: std::mem::take(&mut self.middle.shafts),
            ..Velocities::default()
        };
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let [floor, rollers, bearing, shaft] = of_wheel(j);
            if let Grip::Slips(slip) = wheel.grip {
                let friction = slip.friction(middle.along(&self.constraints[floor].row));
                // rollers spend a part of what the floor can hold
                let holds = (friction * self.middle.loads[j]).powi(2) - wheel.roller_friction.powi(2);
                self.constraints[floor].limit = holds.max(0.0).sqrt() * step;
                (self.constraints[floor].yields, self.constraints[floor].relaxes) =
                    slip.softness(self.state.strained[j], step);
            }
            self.constraints[rollers].limit = wheel.roller_friction * step;
            self.constraints[bearing].limit = wheel.bearing.dry(middle.shafts[j]) * step;
            if let Shaft::Elastic { stiffness, damping } = wheel.shaft {
                // τ½ = k·(z + Δt/2·s½) + c·s½, λ = −Δt·τ½, s½ = (s + s⁺)/2
                let stiff = stiffness * 0.5 * step + damping;
                let before = self.state.shafts[j] - self.state.shafts[self.robot.wheels.len() + j];
                self.constraints[shaft].yields = 2.0 / (step * stiff);
                self.constraints[shaft].relaxes = before + 2.0 * stiffness * self.state.windup[j] / stiff;
            }
        }
        self.middle.shafts = middle.shafts;
    }

    /// Takes the step that was looked at.
    fn take(&mut self, u: &[f64]) {
        let step = self.step;
        let bus_current: f64 =
            u.iter().zip(&self.middle.currents).map(|(u, i)| u / self.robot.battery.nominal * i).sum();
        let state = &mut self.state;
        state.polarisation = self.robot.battery.polarised(state.polarisation, bus_current, step);
        state.twist_rate = (self.velocities.body - state.twist) / step;
        // ẋ = R(θ)·(v, vn), at the middle of the step
        let heading = state.heading + 0.5 * step * self.middle.twist.z;
        state.position += step * rotated(heading, self.middle.twist.xy());
        state.heading += step * self.middle.twist.z;
        state.twist = self.velocities.body;
        let wheels = self.robot.wheels.len();
        for (j, wheel) in self.robot.wheels.iter().enumerate() {
            let [floor, ..] = of_wheel(j);
            state.turned[j] += step * self.middle.shafts[j];
            state.strained[j] = -self.impulses[floor] / step;
            state.windup[j] += step * (self.middle.shafts[j] - self.middle.shafts[wheels + j]);
            let middle = self.middle.currents[j];
            // i⁺ = 2·i½ − i
            state.currents[j] = if wheel.motor.inductance > 0.0 { 2.0 * middle - state.currents[j] } else { middle };
        }
        state.shafts.clone_from(&self.velocities.shafts);
        state.time += step;
    }
}
