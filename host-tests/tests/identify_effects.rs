//! Identify, of a robot file that carries an effect whose numbers are wrong: it finds the true ones.

use std::path::Path;

use host_tests::catalogue::sessions::truth;
use model_core::effects::EffectKind;
use model_core::effects::card::{Param, Role, Scope};
use omni_gap::api::{Driven, FitRemark, FittedEffectNumber, PlannedRuns, SelfTest, SelftestKnobs, identify, selftest};
use omni_gap::known_effects;
use omni_gap::log::{Change, EffectEntry, RobotFile, corrected};
use omni_gap::simulate::{EffectInstance, SignalGroup};
use omni_gap::synthesize::{Scenario, synthesize};

/// Runs, length of each [s], rows a second [1/s], largest voltage [V].
const RUNS: usize = 6;
const DURATION: f64 = 5.0;
const RATE: f64 = 200.0;
const VOLTAGE: f64 = 8.0;
/// What the file's sizes are of the true ones' departure from absent.
const OFF: f64 = 0.7;
/// From this signature on, beyond what starts and nominal numbers imitate [σ], a size is to be found within five per cent.
const PLAIN: f64 = 60.0;

fn parsed(text: &str) -> RobotFile {
    RobotFile::parse(text, Path::new("robot.toml"), &known_effects()).unwrap_or_else(|why| panic!("{why}"))
}

/// A robot file's text with an effect in it, its sizes at a share of their departure from absent.
fn with_effect(text: &str, effect: &EffectInstance, share: f64) -> String {
    let number = |(p, x): (&Param, &f64)| {
        let x = if p.role == Role::Size { p.absent + share * (x - p.absent) } else { *x };
        (p.key.to_owned(), x)
    };
    let params = effect.card().params.iter().zip(&effect.params).map(number).collect();
    let entry = EffectEntry { id: effect.id.to_owned(), wheel: effect.wheel, params };
    corrected(text, &[Change::Effect(entry)]).unwrap_or_else(|why| panic!("{why}"))
}

/// How far typical effects move such recordings.
fn foretold(file: &RobotFile) -> SelfTest {
    let plan = PlannedRuns {
        driven: Driven::Random { runs: RUNS, duration: DURATION, rate: RATE, voltage: VOLTAGE },
        logged: vec![SignalGroup::Current, SignalGroup::WheelSpeed, SignalGroup::Pose],
        camera_rate: 60.0,
    };
    selftest(file, &plan, &SelftestKnobs::default()).unwrap_or_else(|why| panic!("{why}"))
}

/// What identify makes of recordings of a robot with an effect whose size its file has wrong; the seed stages them.
fn found(wheels: usize, effect: &EffectInstance, seed: u64) -> Vec<FittedEffectNumber> {
    let plan = Scenario { runs: RUNS, duration: DURATION, rate: RATE, voltage: VOLTAGE, seed, ..Scenario::default() };
    let true_text = with_effect(truth(wheels), effect, 1.0);
    let mut session = synthesize(&true_text, &plan, &known_effects()).unwrap_or_else(|why| panic!("{why}"));
    session.robot_text = with_effect(&session.robot_text, effect, OFF);
    session.robot = parsed(&session.robot_text);
    let found = identify(&session).unwrap_or_else(|why| panic!("{why}"));
    // what is written is what is said
    let written = parsed(&found.robot_text);
    for number in &found.effects {
        assert_eq!(written.effects[0].params[number.key], number.fitted, "{}", number.key);
    }
    found.effects
}

#[test]
fn wrong_sizes_of_effects_that_a_file_carries_are_found() {
    let said = foretold(&parsed(truth(4)));
    for (seed, id) in
        (7000..).zip(["supply_sag", "dead_time", "cog_offset", "floor_tilt", "encoder_scale", "presliding"])
    {
        let card = EffectKind::find(id).expect("an id of the catalogue").card();
        let effect = EffectInstance::typical(card, (card.scope == Scope::OneWheel).then_some(1));
        let sigma = said.causes.iter().find(|cause| cause.cause == id).map_or(0.0, |cause| cause.sigma);
        for number in found(4, &effect, seed) {
            let p = card.param(number.key).expect("its own number");
            let (absent, truth) = (card.params[p].absent, effect.params[p]);
            let std = number.std.unwrap_or_else(|| panic!("{id}: {number:?}"));
            assert!((number.fitted - truth).abs() < 3.0 * std, "{number:?}, not {truth}");
            if sigma > PLAIN && card.params[p].role == Role::Size {
                let off = (number.fitted - truth) / (truth - absent);
                assert!(off.abs() < 0.05, "{id}, {sigma} σ: {number:?}, not {truth}");
            }
            assert_ne!(number.remark, FitRemark::NotTold, "{number:?}");
        }
    }
}

#[test]
fn what_recordings_tell_nothing_of_stays_as_the_file_has_it() {
    // nobody logged a gyro
    let effect = EffectInstance::typical(EffectKind::GyroBias.card(), None);
    let [number] = found(4, &effect, 7100).try_into().expect("its one number");
    assert_eq!((number.remark, number.std), (FitRemark::NotTold, None));
    assert_eq!(number.fitted, number.nominal);
}
