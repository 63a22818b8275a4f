//! How oddities act within a step: forces on the body, windings that carry nothing, and what is remembered after it.

use nalgebra::{Vector2, Vector3};

use crate::contact::GRAVITY;
use crate::oddities::load::{Carrier, Swung};
use crate::robot::Wheel;
use crate::rotated::rotated;
use crate::shaft::Shaft;
use crate::simulation::Simulation;
use crate::surroundings::Place;
use crate::twist_at::twist_at;

impl Simulation {
    /// What oddities add to a force on the body along its axes and about the point that is followed [N, N, N·m], where the
    /// body is at a place in the middle of the step.
    pub(crate) fn with_odd_forces(&self, mut force: Vector3<f64>, at: &Place) -> Vector3<f64> {
        if !self.odd {
            return force;
        }
        let odd = &self.robot.oddities;
        // a force in the world acts at an arm along the body's axes
        let mut push = |arm: Vector2<f64>, world: Vector2<f64>| {
            let along = rotated(-at.heading, world);
            force += twist_at(arm).transpose() * Vector3::new(along.x, along.y, 0.0);
        };
        if let Some(swung) = self.swung(at) {
            push(at.centre + rotated(-at.heading, swung.off), -swung.force);
        }
        if let Some(towed) = odd.towed {
            let arm = at.centre + towed.hitch;
            let weight = towed.hitch + self.state.memory.dragged;
            push(arm, towed.pull(weight, at.position + rotated(at.heading, arm)));
        }
        if let Some(gusts) = &odd.gusts {
            push(at.centre, gusts.at(odd.clock + self.state.time + 0.5 * self.step));
        }
        if let Some(planks) = odd.planks {
            push(at.centre, planks.push(carrier(at).1));
        }
        if let Some(ridge) = odd.ridge {
            let weight = self.weighing() * GRAVITY / self.feet.len() as f64;
            for foot in &self.feet {
                let arm = at.centre_of_mass + foot;
                push(arm, ridge.push(at.position + rotated(at.heading, arm), weight));
            }
        }
        force
    }

    /// The middle of the step of a load that swings, if there is one.
    fn swung(&self, at: &Place) -> Option<Swung> {
        let load = self.robot.oddities.load?;
        let (centre, velocity) = carrier(at);
        let gravity = GRAVITY * self.robot.surroundings.downhill;
        let by = Carrier { centre, velocity, turning: at.twist.z, gravity };
        Some(load.swung(&self.state.memory.swing, &by, self.step))
    }

    /// What a load, a string, a ridge and a tooth hold [J].
    pub(crate) fn odd_energy(&self) -> f64 {
        let (odd, state) = (&self.robot.oddities, &self.state);
        let in_world = |from_centre| state.position + rotated(state.heading, from_centre - self.point);
        let of_load = odd.load.map_or(0.0, |load| load.energy(&state.memory.swing, in_world(Vector2::zeros())));
        let of_string = odd.towed.map_or(0.0, |towed| {
            let pull = towed.pull(towed.hitch + state.memory.dragged, in_world(towed.hitch));
            0.5 * pull.norm_squared() / towed.stiffness
        });
        let of_ridge = odd.ridge.map_or(0.0, |ridge| {
            let height = |wheel: &Wheel| ridge.height_at(in_world(wheel.contact));
            let wheels = &self.robot.wheels;
            self.weighing() * GRAVITY / wheels.len() as f64 * wheels.iter().map(height).sum::<f64>()
        });
        let of_tooth = odd.tooth.map_or(0.0, |tooth| tooth.energy_at(state.turned[tooth.wheel].x));
        of_load + of_string + of_ridge + of_tooth
    }

    /// What presses on the floor: the chassis, and a load that swings on it [kg].
    pub(crate) fn weighing(&self) -> f64 {
        self.robot.chassis.mass + self.robot.oddities.load.map_or(0.0, |load| load.mass)
    }

    /// What is left of the voltages of wheel j's motor [1] in the middle of the step, under what its bridge hears [V].
    pub(crate) fn leaves(&self, j: usize, heard: f64) -> f64 {
        if !self.odd {
            return 1.0;
        }
        let (rotor, half) = (self.rotor(j), 0.5 * self.step);
        let turned = self.state.turned[j][rotor] + half * self.middle.shafts[j][rotor];
        let angle = self.robot.wheels[j].gear_ratio * turned;
        self.robot.oddities.leaves(j, heard, (self.state.time + half, angle))
    }

    /// Remembers what oddities have done in the step that is taken, before anything else of it is.
    pub(crate) fn remember(&mut self, drawn: f64) {
        if !self.odd {
            return;
        }
        let step = self.step;
        let at = self.place();
        let swung = self.swung(&at);
        for j in 0..self.robot.wheels.len() {
            if self.leaves(j, self.middle.heard[j]) == 0.0 {
                // what an inductance held is lost where a winding is opened
                self.state.currents[j] = 0.0;
            }
        }
        let (odd, memory) = (&self.robot.oddities, &mut self.state.memory);
        if let Some(middle) = swung {
            memory.swing = memory.swing.after(&middle, step);
        }
        if let Some(towed) = odd.towed {
            let (half, arm) = (0.5 * step, at.centre + towed.hitch);
            let end = at.position + half * rotated(at.heading, at.twist.xy());
            let hitch = end + rotated(at.heading + half * at.twist.z, arm);
            memory.dragged = towed.dragged(towed.hitch + memory.dragged, hitch) - towed.hitch;
        }
        if let Some(converter) = odd.converter {
            memory.converting = converter.after(&memory.converting, drawn, step);
        }
        if let Some(foldback) = odd.foldback {
            for (strain, current) in memory.strains.iter_mut().zip(&self.middle.currents) {
                *strain = foldback.strained(*strain, *current, step);
            }
        }
        if let Some(hub) = odd.hub
            && let Shaft::Elastic { stiffness, .. } = self.robot.wheels[hub.wheel].shaft
        {
            let turned = self.state.turned[hub.wheel] + step * self.middle.shafts[hub.wheel];
            memory.slipped = hub.slipped(memory.slipped, turned.x - turned.y, stiffness);
        }
    }
}

/// The robot's centre in the world [m], and its velocity there [m/s].
fn carrier(at: &Place) -> (Vector2<f64>, Vector2<f64>) {
    let along = twist_at(at.centre) * at.twist;
    (at.position + rotated(at.heading, at.centre), rotated(at.heading, along.xy()))
}
