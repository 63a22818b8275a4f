//! Experiment 2: with the bridges open nothing but friction acts.
//!
//! ```text
//! dv/dt = −(B/M)·v − (C/M)·sign(v)                          on each axis (eq. 24–26)
//! x(t) = x₀ + v₀·t − (B/M)·∫(x − x₀) dt − (C/M)·sign(v)·t²/2   the same, integrated twice
//! (1/J)·(B_ω·∫(θ − θ₀) dt + C_ω·sign(ω)·t²/2)                with B_ω, C_ω of experiment 1 (eq. 27)
//! ```
//!
//! The line is fitted to where the robot was, not to its acceleration: of a camera's centimetre, two differences would
//! leave nothing but noise. Every decay has an x₀ and v₀ of its own, which are taken out first.

use nalgebra::{Matrix2, Vector2};

use super::bins::{Bin, bins};
use super::regress::{Estimate, Rows, jackknife};
use crate::simulate::{AXES, AlignedRun, Model};

/// Length of a stretch over which a velocity is taken [s]
const STRETCH: f64 = 0.04;
/// Below this share of the speed at which a decay began it is not used: the end is near, and with it the stop.
const SLOWEST: f64 = 0.1;
/// A decay that began below this share of the others' speed is another kind of decay.
const PLAINLY_SLOWER: f64 = 0.8;
/// Over this time speeds are averaged to tell how slow it has become [s]
const LOOK: f64 = 0.2;

/// A decay on one axis: (x, ∫x dt, ±t²/2) at each time, what belongs to its start taken out.
struct Decay {
    axis: usize,
    points: Vec<[f64; 3]>,
}

/// B_v, C_v, B_vn, C_vn [N·s/m, N] from the coast-downs along v and vn.
pub fn coast<const N: usize>(model: &Model<N>, runs: &[&AlignedRun<N>]) -> [Option<[Estimate; 2]>; 2] {
    let mass = model.plant().robot().mass;
    let decays = decays(model, runs);
    [0, 1].map(|axis| {
        let decays = along(&decays, axis);
        jackknife(decays.len(), |without| {
            let mut rows = Rows::<2>::default();
            for [x, viscous, coulomb] in points(&decays, without) {
                rows.push(*x, [-viscous, -coulomb], [-viscous, -coulomb]);
            }
            Some(rows.least_squares()?.map(|per_mass| per_mass * mass))
        })
    })
}

/// J [kg·m²] from the coast-downs about ω, with B_ω [N·m·s] and C_ω [N·m] of experiment 1.
pub fn coast_inertia<const N: usize>(
    model: &Model<N>,
    runs: &[&AlignedRun<N>],
    viscous: f64,
    coulomb: f64,
) -> Option<Estimate> {
    let decays = decays(model, runs);
    let decays = along(&decays, 2);
    let [inertia] = jackknife(decays.len(), |without| {
        let mut rows = Rows::<1>::default();
        for [x, by_viscous, by_coulomb] in points(&decays, without) {
            let torque = -(viscous * by_viscous + coulomb * by_coulomb);
            rows.push(*x, [torque], [torque]);
        }
        rows.least_squares().map(|[per_inertia]| [1.0 / per_inertia])
    })?;
    Some(inertia)
}

/// The decays on one axis, run by run; runs without one are left out.
fn along(decays: &[Vec<Decay>], axis: usize) -> Vec<Vec<&Decay>> {
    let own = decays.iter().map(|run| run.iter().filter(|d| d.axis == axis).collect::<Vec<_>>());
    own.filter(|run| !run.is_empty()).collect()
}

fn points<'a>(decays: &'a [Vec<&Decay>], without: Option<usize>) -> impl Iterator<Item = &'a [f64; 3]> {
    let kept = decays.iter().enumerate().filter(move |(run, _)| Some(*run) != without);
    kept.flat_map(|(_, run)| run).flat_map(|d| &d.points)
}

fn decays<const N: usize>(model: &Model<N>, runs: &[&AlignedRun<N>]) -> Vec<Vec<Decay>> {
    let wheels = model.plant().robot().wheels;
    let mut all: Vec<Vec<Course>> = runs
        .iter()
        .map(|run| {
            let Some(axis) = AXES.iter().position(|axis| run.name.split('-').nth(1) == Some(axis)) else {
                return Vec::new();
            };
            let bins = bins(run, &wheels, STRETCH);
            let stretches = bins.chunk_by(|a, b| a.open == Some(true) && b.open == Some(true) && a.rows.1 == b.rows.0);
            stretches.filter(|s| s[0].open == Some(true)).filter_map(|s| course(s, axis)).collect()
        })
        .collect();
    for axis in 0..AXES.len() {
        end_together(all.iter_mut().flatten().filter(|c| c.axis == axis).collect());
    }
    let decay = |c: &Course| Decay { axis: c.axis, points: without_start(&c.points) };
    all.iter().map(|run| run.iter().filter(|c| c.points.len() > 4).map(decay).collect()).collect()
}

/// Cuts the decays of an axis where they become slow.
///
/// x = v₀·t − a·t²/2 is as slow as that after (1 − share)·v₀/a. Were these each decay's own, noise would choose where it
/// ends, and one kind of noise more often than the other, which shows in the curvature: they are the mean of all, and of
/// all that is used. Only a decay that began plainly slower than the others ends by its own speed.
fn end_together(mut courses: Vec<&mut Course>) {
    for _ in 0..2 {
        let mean = |of: fn(&Course) -> f64| courses.iter().map(|c| of(c)).sum::<f64>() / courses.len().max(1) as f64;
        let (speed, slope) = (mean(|c| c.speed), mean(|c| c.slope));
        for course in &mut courses {
            let speed = if course.speed < PLAINLY_SLOWER * speed { course.speed } else { speed };
            course.used = course.points.partition_point(|p| p[0] <= (1.0 - SLOWEST) * speed / slope);
            if let Some((speed, slope)) = parabola(&course.points[..course.used]) {
                (course.speed, course.slope) = (speed, slope);
            }
        }
    }
    for course in courses {
        course.points.truncate(course.used);
    }
}

/// How a robot coasted: (t, x, ∫x dt, ±t²/2), and the parabola through its fast part.
struct Course {
    axis: usize,
    points: Vec<[f64; 4]>,
    used: usize,
    speed: f64,
    slope: f64,
}

fn course<const N: usize>(stretch: &[Bin<N>], axis: usize) -> Option<Course> {
    let look = (LOOK / stretch[0].dt).round().max(1.0) as usize;
    let speed = |bins: &[Bin<N>]| bins.iter().map(|b| b.twist[axis]).sum::<f64>() / bins.len() as f64;
    let first = speed(&stretch[..look.min(stretch.len())]);
    let fast = |bins: &&[Bin<N>]| speed(bins) * first.signum() > SLOWEST * first.abs();
    let used = stretch.windows(look).take_while(fast).count();
    let (mut t, mut x, mut area) = (0.0, 0.0, 0.0);
    let mut points = vec![[0.0; 4]];
    for bin in stretch {
        let step = bin.twist[axis] * bin.dt;
        area += (x + 0.5 * step) * bin.dt;
        (t, x) = (t + bin.dt, x + step);
        points.push([t, x, area, 0.5 * first.signum() * t * t]);
    }
    let used = used.min(points.len());
    let (speed, slope) = parabola(&points[..used])?;
    Some(Course { axis, points, used, speed, slope })
}

/// v₀ and a of x = x₀ + v₀·t − a·t²/2 through the points, along the motion; `None` where it does not slow down.
fn parabola(points: &[[f64; 4]]) -> Option<(f64, f64)> {
    let mut rows = Rows::<3>::default();
    for [t, x, _, half_square] in points {
        let row = [1.0, *t, -half_square];
        rows.push(*x, row, row);
    }
    let [_, speed, slope] = rows.least_squares()?;
    (slope > 0.0).then_some((speed.abs(), slope))
}

/// (x, ∫x, ±t²/2) less the straight lines in t that fit each best: what x₀ and v₀ can make.
fn without_start(points: &[[f64; 4]]) -> Vec<[f64; 3]> {
    let (mut square, mut cross) = (Matrix2::zeros(), [Vector2::zeros(); 3]);
    for p in points {
        let line = Vector2::new(1.0, p[0]);
        square += line * line.transpose();
        for (k, cross) in cross.iter_mut().enumerate() {
            *cross += line * p[1 + k];
        }
    }
    let lines = cross.map(|c| square.lu().solve(&c).unwrap_or_default());
    let rest = |p: &[f64; 4]| std::array::from_fn(|k| p[1 + k] - lines[k][0] - lines[k][1] * p[0]);
    points.iter().map(rest).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_decay_that_follows_the_law_is_read_exactly() {
        // v = (v₀ + c/b)·e^(−bt) − c/b, and its mean over a stretch
        let (b, c, v0, dt) = (0.4, 1.1, 1.5, 0.02);
        let way = |t: f64| (v0 + c / b) * (1.0 - (-b * t).exp()) / b - c / b * t;
        let bin = |k: usize| Bin::<3> {
            rows: (k, k + 1),
            dt,
            twist: [(way((k + 1) as f64 * dt) - way(k as f64 * dt)) / dt, 0.0, 0.0],
            volts: [0.0; 3],
            open: Some(true),
        };
        let stretch: Vec<_> = (0..60).map(bin).collect();
        let mut rows = Rows::<2>::default();
        let course = course(&stretch, 0).unwrap();
        // the parabola through the whole of it: mean deceleration c + b·v with v between v₀ and the last speed
        assert!(course.slope > c && course.slope < c + b * v0);
        for [x, viscous, coulomb] in without_start(&course.points) {
            rows.push(x, [-viscous, -coulomb], [-viscous, -coulomb]);
        }
        let [found_b, found_c] = rows.least_squares().unwrap();
        // the trapezoid rule of ∫x leaves (b·dt)²/12 and less
        assert!((found_b - b).abs() < 1e-3 && (found_c - c).abs() < 1e-3, "{found_b}, {found_c}");
    }
}
