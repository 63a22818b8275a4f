//! The rich excitation: what it asks of a robot, and what its recordings would show beside random motion as long.

use std::path::Path;

use model_core::geometry::frames::{BodyTwist, Pose};
use model_core::plant::Input;
use omni_gap::api::{Driven, PlannedRich, PlannedRuns, SelftestKnobs, known_effects, rich, selftest};
use omni_gap::engine::findings::SeenCause;
use omni_gap::log::{LimitsFile, RobotFile, Run};
use omni_gap::simulate::{Emphasis, Model, RichPlan, SignalGroup};
use omni_gap::vocabulary::Kind;

const PLAN: RichPlan =
    RichPlan { rate: 200.0, voltage: 8.0, field: 3.0, scripts: 6, duration: 10.0, emphasis: Emphasis::Everything };
const CAMERA: f64 = 60.0;
/// A robot that is faster than this drives, and does not creep [m/s]
const DRIVES: f64 = 0.12;

fn robot(text: &str) -> RobotFile {
    RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).unwrap_or_else(|why| panic!("{why}"))
}

fn three() -> RobotFile {
    robot(include_str!("../robots/feup-3w/robot.toml"))
}

fn four() -> RobotFile {
    robot(include_str!("../robots/feup-4w/robot.toml"))
}

/// What the robot of a file does in one row of a script.
struct Moment {
    volts: f64,
    /// Largest current [A]
    amps: f64,
    pose: Pose<f64>,
    twist: BodyTwist<f64>,
}

impl Moment {
    fn speeds(&self) -> [f64; 3] {
        // a turn counts by what it does at a wheel, some 9 cm out
        [self.twist.v, self.twist.vn, 0.09 * self.twist.w]
    }

    fn speed(&self) -> f64 {
        self.speeds().iter().fold(0.0, |most: f64, x| most.max(x.abs()))
    }
}

fn played<const N: usize>(file: &RobotFile, script: &Run) -> Vec<Moment> {
    let model = Model::<N>::nominal(file, PLAN.voltage);
    let (plant, volts) = (model.plant(), &script.u.as_ref().expect("voltages").channels);
    let mut memory = plant.memory().collect::<Vec<_>>();
    let mut state = plant.start(0.0, Pose::default(), BodyTwist::default());
    let mut moments = Vec::new();
    for row in 0..script.rows() - 1 {
        let u: [f64; N] = std::array::from_fn(|j| volts[j].get(row).expect("a voltage in every row"));
        let (dt, steps) = (script.t_s[row + 1] - script.t_s[row], 5);
        let mut amps = 0.0_f64;
        for _ in 0..steps {
            let reading = plant.step(&mut state, &mut memory, &Input::Voltage(u), dt / f64::from(steps));
            amps = reading.current.iter().fold(amps, |most, i| most.max(i.abs()));
        }
        let volts = u.iter().fold(0.0, |most: f64, u| most.max(u.abs()));
        moments.push(Moment { volts, amps, pose: state.pose, twist: state.twist });
    }
    moments
}

/// The most times in a row that something holds.
fn longest(moments: &[Moment], holds: impl Fn(&Moment) -> bool) -> usize {
    let mut now = 0;
    moments.iter().fold(0, |most, moment| {
        now = if holds(moment) { now + 1 } else { 0 };
        most.max(now)
    })
}

/// What every rich script has to be.
fn is_rich<const N: usize>(file: &RobotFile, plan: &RichPlan) -> PlannedRich {
    let all = rich(file, plan);
    assert!(all.held.is_empty(), "{:?}", all.held);
    let limits = file.limits.unwrap_or_default();
    let mut turned = [0; 3];
    for script in &all.scripts {
        let name = &script.run.name;
        let moments = played::<N>(file, &script.run);
        assert_eq!(script.run.rows(), (plan.duration * plan.rate) as usize);
        let most = |of: &dyn Fn(&Moment) -> f64| moments.iter().map(of).fold(0.0, f64::max);
        assert!(most(&|m| m.volts) <= all.plan.voltage, "{name}");
        assert!(most(&|m| m.volts) > 0.95 * all.plan.voltage, "{name} is not driven to the limit");
        // half of the floor from its middle, and 2 % for rows that are looked at where they end
        assert!(most(&|m| m.pose.x.abs().max(m.pose.y.abs())) <= 0.5 * all.plan.field, "{name} leaves the floor");
        assert!(most(&|m| m.amps) <= 1.02 * limits.current_a.unwrap_or(f64::INFINITY), "{name}: current");
        let speed = |m: &Moment| m.twist.v.hypot(m.twist.vn);
        assert!(most(&speed) <= 1.02 * limits.speed_m_s.unwrap_or(f64::INFINITY), "{name}: speed");
        for (axis, turned) in turned.iter_mut().enumerate() {
            let turns: Vec<bool> =
                moments.iter().map(|m| m.speeds()[axis]).filter(|v| v.abs() > DRIVES).map(|v| v > 0.0).collect();
            *turned += turns.windows(2).filter(|pair| pair[0] != pair[1]).count();
        }
        let row = |seconds: f64| (seconds * plan.rate) as usize;
        let between = &moments[row(0.5)..moments.len() - row(1.0)];
        let rest = longest(between, |m| m.volts == 0.0 && m.speed() < 1e-3);
        assert!(rest >= row(0.15), "{name} stands for {rest} rows");
        let creep = longest(between, |m| m.volts > 0.0 && (1e-3..DRIVES).contains(&m.speed()));
        assert!(creep >= row(0.25), "{name} creeps for {creep} rows");
    }
    assert!(turned.iter().all(|times| *times >= all.scripts.len()), "{turned:?} reversals by axis");
    all
}

#[test]
fn rich_scripts_excite_all_axes_within_the_limits_and_on_the_floor() {
    let limited = |limits: LimitsFile, file: RobotFile| RobotFile { limits: Some(limits), ..file };
    is_rich::<3>(&three(), &PLAN);
    let all = is_rich::<4>(&four(), &PLAN);
    let again = rich(&four(), &PLAN);
    assert!(all.scripts.iter().zip(&again.scripts).all(|(a, b)| a.run.u == b.run.u), "not the same again");
    is_rich::<4>(&four(), &RichPlan { field: 1.2, rate: 100.0, ..PLAN });
    let weak = limited(LimitsFile { current_a: Some(1.2), ..LimitsFile::default() }, three());
    assert_eq!(is_rich::<3>(&weak, &PLAN).lowered[0].key, "current_A");
    let slow = limited(LimitsFile { speed_m_s: Some(0.8), ..LimitsFile::default() }, four());
    assert_eq!(is_rich::<4>(&slow, &PLAN).lowered[0].key, "speed_m_s");
    let mut askew = three();
    askew.wheel[0].drive_angle_deg += 15.0;
    askew.wheel[1].distance_m *= 1.2;
    is_rich::<3>(&askew, &PLAN);
}

#[test]
fn a_floor_on_which_nothing_keeps_lowers_the_voltage() {
    let all = rich(&four(), &RichPlan { field: 0.08, rate: 100.0, ..PLAN });
    assert_eq!(all.lowered[0].key, "field_m");
    assert!(all.scripts.iter().all(|script| script.floor.side() <= 0.08));
}

/// The size from which on a cause is named, as a multiple of its typical one; of what shows the more the smaller it is,
/// how many times smaller.
fn named_times(cause: &SeenCause) -> f64 {
    cause.named_times.map_or(f64::INFINITY, |times| if cause.shows_below { 1.0 / times } else { times })
}

/// Causes named at their typical size by random motion and by a rich one, and the median over the effects of the size that
/// random motion needs over that which the rich one needs.
fn compared(file: &RobotFile) -> (usize, usize, f64) {
    let slower = RichPlan { rate: 100.0, ..PLAN };
    let RichPlan { rate, voltage, scripts: runs, duration, .. } = slower;
    let logged = vec![SignalGroup::Current, SignalGroup::WheelSpeed, SignalGroup::Pose];
    let scripts = rich(file, &slower).scripts.into_iter().map(|script| script.run).collect();
    let [random, rich] = [Driven::Random { runs, duration, rate, voltage }, Driven::Scripts(scripts)].map(|driven| {
        let plan = PlannedRuns { driven, logged: logged.clone(), camera_rate: CAMERA };
        selftest(file, &plan, &SelftestKnobs::default()).unwrap_or_else(|why| panic!("{why}"))
    });
    assert_eq!(random.numbers, rich.numbers, "as many numbers are measured");
    let named = |causes: &[SeenCause]| causes.iter().filter(|cause| named_times(cause) <= 1.0).count();
    let both = random.causes.iter().zip(&rich.causes).filter(|(random, _)| random.kind == Kind::Effect);
    let mut ratios: Vec<(f64, &str)> = both
        .map(|(random, rich)| (named_times(random) / named_times(rich), rich.cause))
        .filter(|(ratio, _)| !ratio.is_nan())
        .collect();
    ratios.sort_by(|a, b| a.0.total_cmp(&b.0));
    let median = ratios[ratios.len() / 2].0;
    let counts = (named(&random.causes), named(&rich.causes));
    println!("{}: named {} random, {} rich, of {}", file.name, counts.0, counts.1, rich.causes.len());
    println!("size needed by random motion over that needed by the rich one, median of {}: {median:.2}", ratios.len());
    for (ratio, cause) in &ratios {
        println!("  {ratio:6.2}  {cause}");
    }
    (counts.0, counts.1, median)
}

#[test]
fn rich_scripts_name_more_causes_and_smaller_ones_than_random_motion_as_long() {
    for file in [three(), four()] {
        let (random, rich, median) = compared(&file);
        assert!(rich > random, "{}: {rich} causes named, {random} by random motion", file.name);
        assert!(median > 1.1, "{}: {median}", file.name);
    }
}

#[test]
fn scripts_do_most_what_they_are_written_for() {
    let [mut fast, mut reversals, mut slow] = [[0.0; 4]; 3];
    for (k, emphasis) in Emphasis::ALL.into_iter().enumerate() {
        let all = rich(&four(), &RichPlan { emphasis, ..PLAN });
        for script in &all.scripts {
            let moments = played::<4>(&four(), &script.run);
            let out = moments.iter().map(|m| m.pose.x.abs().max(m.pose.y.abs())).fold(0.0, f64::max);
            assert!(out <= 0.5 * PLAN.field, "{emphasis:?}: {out} m out");
            fast[k] += moments.iter().map(|m| m.twist.v.hypot(m.twist.vn)).sum::<f64>();
            slow[k] += moments.iter().filter(|m| m.speed() < DRIVES).count() as f64;
            for axis in 0..3 {
                let signs: Vec<bool> =
                    moments.iter().map(|m| m.speeds()[axis]).filter(|v| v.abs() > DRIVES).map(|v| v > 0.0).collect();
                reversals[k] += signs.windows(2).filter(|pair| pair[0] != pair[1]).count() as f64;
            }
        }
    }
    let most = |of: [f64; 4]| Emphasis::ALL[(0..4).max_by(|a, b| of[*a].total_cmp(&of[*b])).expect("four")];
    assert_eq!(most(fast), Emphasis::Dashes, "{fast:?}");
    assert_eq!(most(reversals), Emphasis::Reversals, "{reversals:?}");
    assert_eq!(most(slow), Emphasis::Creeping, "{slow:?}");
}
