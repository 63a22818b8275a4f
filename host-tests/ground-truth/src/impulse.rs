//! Impulses: what constraints and set-valued friction do within one step.
//!
//! Every force that has a limit, or that is whatever it takes, is an impulse λ along a row h of the velocities V:
//!
//! ```text
//! A·V⁺ = b + Σ h·λ        s = h·V⁺ + γ·λ + β
//! λ = λ_min where s > 0,   λ = λ_max where s < 0,   s = 0 in between
//! ```
//!
//! γ = β = 0 is Coulomb's law (and, without limits, a rigid joint); γ is what yields under the force, β what has yielded
//! before. Nearly always what held in the step before holds now: then one linear system says how much (an active set). Where
//! no such guess proves right, or more than one answer does, it is solved row by row, each impulse cut to its limit at once:
//! projected Gauss–Seidel.

use nalgebra::{DMatrix, DVector, Matrix2, Matrix3, Vector2, Vector3};

/// Rows are gone through until no speed changes by more than this [m/s, rad/s].
const SETTLED: f64 = 1e-11;
/// Or this often: a robot that is braced against itself has more than one answer.
const MOST_SWEEPS: usize = 200;
/// So often it is guessed what holds.
const MOST_GUESSES: usize = 20;
/// By how much more than it does each row is taken to give [1], so that of rows that say the same each takes a part; the next
/// guess takes what that leaves.
const GIVES_MORE: f64 = 1e-8;

/// How fast two surfaces move past each other, as a row over all velocities.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Row {
    /// Over the body's twist.
    pub body: Vector3<f64>,
    /// Over the speed of one wheel: which, and by how much.
    pub wheel: Option<(usize, f64)>,
}

impl Row {
    /// h·V, of a body's twist and the speeds of its wheels and rotors.
    pub fn along(&self, body: &Vector3<f64>, shafts: &[Vector2<f64>]) -> f64 {
        self.body.dot(body) + self.wheel.map_or(0.0, |(wheel, by)| by * shafts[wheel].x)
    }
}

/// A force with a limit, or a rigid joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Constraint {
    /// Where it acts.
    pub row: Row,
    /// γ, by how much it yields to an impulse [m/s per N·s, rad/s per N·m·s]
    pub yields: f64,
    /// β, with what speed it would give way without an impulse, from what it has yielded before [m/s, rad/s]
    pub relaxes: f64,
    /// Between which impulses it can hold [N·s, N·m·s]; any, for a rigid joint
    pub between: (f64, f64),
}

impl Constraint {
    /// Dry friction, or a rigid joint where the limit is infinite.
    pub fn dry(row: Row, limit: f64) -> Self {
        Self { row, yields: 0.0, relaxes: 0.0, between: (-limit, limit) }
    }

    /// Which way it slides under an impulse [N·s, N·m·s]: −1, 1, or 0 where it holds.
    pub fn slides(&self, impulse: f64) -> i8 {
        i8::from(impulse <= self.between.0) - i8::from(impulse >= self.between.1)
    }

    /// True if it can push at all.
    fn may_push(&self) -> bool {
        self.between.0 < self.between.1
    }

    /// Holds up to a limit either way [N·s, N·m·s].
    pub fn hold(&mut self, limit: f64) {
        self.between = (-limit, limit);
    }
}

/// What the velocities are and how they answer to impulses.
#[derive(Clone, Debug, Default)]
pub struct Velocities {
    /// The body's twist [m/s, m/s, rad/s]
    pub body: Vector3<f64>,
    /// Speeds of each wheel and of its rotor, as the wheel would see that behind a rigid gear [rad/s]
    pub shafts: Vec<Vector2<f64>>,
    /// A⁻¹ over the body
    pub body_mobility: Matrix3<f64>,
    /// A⁻¹ over each wheel and its rotor
    pub shaft_mobility: Vec<Matrix2<f64>>,
}

impl Velocities {
    /// At rest, with so many wheels.
    pub fn at_rest(wheels: usize) -> Self {
        let (shafts, shaft_mobility) = (vec![Vector2::zeros(); wheels], vec![Matrix2::zeros(); wheels]);
        Self { shafts, shaft_mobility, ..Self::default() }
    }

    /// V ← V + A⁻¹·Σ h·λ
    fn push<'a>(&mut self, impulses: impl IntoIterator<Item = (&'a Row, f64)>) {
        let mut on_body = Vector3::zeros();
        for (row, impulse) in impulses {
            on_body += row.body * impulse;
            if let Some((wheel, by)) = row.wheel {
                self.shafts[wheel] += self.shaft_mobility[wheel].column(0) * (by * impulse);
            }
        }
        self.body += self.body_mobility * on_body;
    }

    /// h·A⁻¹·h'ᵀ
    fn mobility(&self, row: &Row, other: &Row) -> f64 {
        let of_wheel = match (row.wheel, other.wheel) {
            (Some((wheel, by)), Some((same, too))) if wheel == same => by * too * self.shaft_mobility[wheel].m11,
            _ => 0.0,
        };
        row.body.dot(&(self.body_mobility * other.body)) + of_wheel
    }

    /// Finds the impulses of all constraints and moves the velocities by them; `impulses` begins as a guess.
    pub fn solve(&mut self, constraints: &[Constraint], impulses: &mut [f64]) {
        for (constraint, impulse) in constraints.iter().zip(impulses.iter_mut()) {
            *impulse = impulse.clamp(constraint.between.0, constraint.between.1);
        }
        self.push(constraints.iter().map(|constraint| &constraint.row).zip(impulses.iter().copied()));
        if !self.solve_by_guess(constraints, impulses) {
            self.solve_row_by_row(constraints, impulses);
        }
    }

    /// Holds what is within its limits, lets all else slide, and looks whether that was right; then guesses again. True if a
    /// guess was.
    fn solve_by_guess(&mut self, constraints: &[Constraint], impulses: &mut [f64]) -> bool {
        let may_hold = |(of, impulse): (&Constraint, &f64)| of.may_push() && of.slides(*impulse) == 0;
        let mut holds: Vec<bool> = constraints.iter().zip(impulses.iter()).map(may_hold).collect();
        for _ in 0..MOST_GUESSES {
            let held: Vec<usize> = (0..constraints.len()).filter(|k| holds[*k]).collect();
            let Some(change) = self.holding(constraints, impulses, &held) else { return false };
            self.push(held.iter().zip(change.iter()).map(|(k, change)| {
                let (least, most) = constraints[*k].between;
                let before = impulses[*k];
                impulses[*k] = (before + change).clamp(least, most);
                (&constraints[*k].row, impulses[*k] - before)
            }));
            let mut right = true;
            for (k, of) in constraints.iter().enumerate().filter(|(_, of)| of.may_push()) {
                let (speed, way) = (self.slides(of, impulses[k]), of.slides(impulses[k]));
                // what holds does not slide, and what is at its limit does not slide against its way
                let wrong = if way == 0 { speed.abs() } else { f64::from(-way) * speed } > SETTLED;
                right &= !wrong;
                holds[k] = way == 0 || wrong;
            }
            if right {
                return true;
            }
        }
        false
    }

    /// By how much the impulses of these constraints change so that none of them slides: (h·A⁻¹·hᵀ + γ)·Δλ = −s.
    fn holding(&self, constraints: &[Constraint], impulses: &[f64], held: &[usize]) -> Option<DVector<f64>> {
        let of = |a: usize, b: usize| self.mobility(&constraints[held[a]].row, &constraints[held[b]].row);
        let mut gives = DMatrix::from_fn(held.len(), held.len(), of);
        for (k, of) in held.iter().enumerate() {
            gives[(k, k)] = (gives[(k, k)] + constraints[*of].yields) * (1.0 + GIVES_MORE);
        }
        let slides = DVector::from_fn(held.len(), |k, _| -self.slides(&constraints[held[k]], impulses[held[k]]));
        gives.cholesky().map(|solved| solved.solve(&slides))
    }

    /// s = h·V + γ·λ + β
    fn slides(&self, constraint: &Constraint, impulse: f64) -> f64 {
        constraint.row.along(&self.body, &self.shafts) + constraint.yields * impulse + constraint.relaxes
    }

    fn solve_row_by_row(&mut self, constraints: &[Constraint], impulses: &mut [f64]) {
        for _ in 0..MOST_SWEEPS {
            let mut most = 0.0_f64;
            for (constraint, impulse) in constraints.iter().zip(impulses.iter_mut()) {
                let Constraint { row, yields, between: (least, most_held), .. } = constraint;
                let gives = self.mobility(row, row) + yields;
                let new = (*impulse - self.slides(constraint, *impulse) / gives).clamp(*least, *most_held);
                self.push([(row, new - *impulse)]);
                most = most.max(((new - *impulse) * gives).abs());
                *impulse = new;
            }
            if most < SETTLED {
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A block of 2 kg and a shaft of 0.5 kg·m² whose rim, at 1 m, rubs on it.
    fn block_and_shaft(block: f64, shaft: f64) -> Velocities {
        Velocities {
            body: Vector3::new(block, 0.0, 0.0),
            shafts: vec![Vector2::new(shaft, 0.0)],
            body_mobility: Matrix3::from_diagonal(&Vector3::new(0.5, 0.5, 10.0)),
            shaft_mobility: vec![Matrix2::new(2.0, 0.0, 0.0, 1.0)],
        }
    }

    const RIM: Row = Row { body: Vector3::new(1.0, 0.0, 0.0), wheel: Some((0, -1.0)) };

    #[test]
    fn a_rigid_joint_leaves_one_speed_and_all_momentum() {
        let (mut v, mut impulses) = (block_and_shaft(3.0, 1.0), [0.0]);
        v.solve(&[Constraint::dry(RIM, f64::INFINITY)], &mut impulses);
        // 2·3 + 0.5·1 over 2.5
        assert!((v.body.x - 2.6).abs() < 1e-12 && (v.shafts[0].x - 2.6).abs() < 1e-12, "{v:?}");
        assert!((impulses[0] + 0.8).abs() < 1e-12);
    }

    #[test]
    fn friction_slides_at_its_limit_and_holds_below() {
        for (limit, slides) in [(0.3, true), (5.0, false)] {
            let (mut v, mut impulses) = (block_and_shaft(3.0, 1.0), [0.0]);
            v.solve(&[Constraint::dry(RIM, limit)], &mut impulses);
            assert_eq!(impulses[0] == -limit, slides);
            assert_eq!(RIM.along(&v.body, &v.shafts) > 1e-9, slides);
        }
    }

    #[test]
    fn a_joint_that_yields_moves_as_far_as_its_force_says() {
        let (mut v, mut impulses) = (block_and_shaft(3.0, 1.0), [0.0]);
        v.solve(&[Constraint { yields: 0.25, ..Constraint::dry(RIM, f64::INFINITY) }], &mut impulses);
        // s = 2 + (2.5 + γ)·λ = 0
        assert!((impulses[0] + 2.0 / 2.75).abs() < 1e-12);
        assert!((RIM.along(&v.body, &v.shafts) + 0.25 * impulses[0]).abs() < 1e-12);
    }

    #[test]
    fn a_good_guess_and_a_bad_one_come_to_the_same() {
        let brake = Constraint::dry(Row { wheel: Some((0, 1.0)), ..Row::default() }, 0.2);
        let rows = [Constraint::dry(RIM, 0.9), brake];
        let found = [[0.0, 0.0], [-0.9, 0.2], [40.0, -40.0]].map(|mut impulses| {
            let mut v = block_and_shaft(3.0, -1.0);
            v.solve(&rows, &mut impulses);
            impulses
        });
        assert!(found.iter().flatten().zip(found[0].iter().cycle()).all(|(a, b)| (a - b).abs() < 1e-11), "{found:?}");
    }
}
