//! What every effect does to one short drive on either of the paper's robots: its picture, and the table of the largest
//! changes.

use std::fmt::Write;
use std::path::Path;
use std::sync::LazyLock;

use host_tests::catalogue::sessions::truth;
use model_core::effects::EffectKind;
use omni_gap::known_effects;
use omni_gap::localise::validation::Signal;
use omni_gap::log::RobotFile;
use omni_gap::report::effect_picture;
use omni_gap::simulate::{EffectShown, ShownSignal, effect_shown};
use rayon::prelude::*;

use crate::golden::{self, two_digits};

/// What every effect does, on three wheels and on four.
static SHOWN: LazyLock<[Vec<EffectShown>; 2]> = LazyLock::new(|| {
    [3, 4].map(|wheels| {
        let file = RobotFile::parse(truth(wheels), Path::new("robot.toml"), &known_effects()).expect("a sound file");
        EffectKind::ALL.par_iter().map(|effect| effect_shown(&file, effect.card())).collect()
    })
});

/// The folder of the pictures, seen from the page that shows them.
const FOLDER: &str = "effects";

/// The largest picture [bytes]
const LARGEST: usize = 12_000;

/// The link that shows an effect's picture on a page of `golden/`.
pub fn picture_of(id: &str) -> String {
    format!("![{id}: the same drive without it and with it]({FOLDER}/{id}.svg)")
}

/// Columns of the table: what is measured.
const COLUMNS: [&str; 6] =
    ["current [A]", "wheel speed [rad/s]", "x, y [m]", "heading [rad]", "yaw rate [rad/s]", "bus [V]"];

/// The column in which a signal counts.
fn column(signal: Signal) -> usize {
    match signal {
        Signal::Current(_) => 0,
        Signal::WheelSpeed(_) => 1,
        Signal::X | Signal::Y => 2,
        Signal::Heading => 3,
        Signal::Gyro => 4,
        Signal::Battery => 5,
        Signal::V | Signal::Vn | Signal::Omega => unreachable!("no sensor reads {signal:?}"),
    }
}

/// The largest change in each column; none where nothing is read.
fn largest(shown: &EffectShown) -> [Option<f64>; COLUMNS.len()] {
    let mut largest = [None; COLUMNS.len()];
    for signal in &shown.signals {
        let at = &mut largest[column(Signal::of_channel(signal.channel, shown.wheels))];
        *at = Some(signal.largest_change().max(at.unwrap_or(0.0)));
    }
    largest
}

/// A change as the table writes it; rounding, which may be another one elsewhere, is none.
fn amount(change: f64) -> String {
    two_digits(if change < 1e-9 { 0.0 } else { change })
}

/// The noise of the sensors of each column.
fn noises(shown: &[EffectShown]) -> String {
    let of = |at: usize| {
        let in_it = |signal: &&ShownSignal| column(Signal::of_channel(signal.channel, shown[0].wheels)) == at;
        let signal = shown.iter().flat_map(|shown| &shown.signals).find(in_it).expect("all effects together are read");
        let (name, unit) = COLUMNS[at].split_once(" [").expect("a column has a unit");
        format!("{name} {} {}", signal.noise, unit.trim_end_matches(']'))
    };
    (0..COLUMNS.len()).map(of).collect::<Vec<_>>().join(", ")
}

/// The section of a page that says how much each effect changes.
pub fn section() -> String {
    let mut page = String::from("## What each does at its typical size\n\n");
    page += "The largest change that an effect makes to the drive of the pictures below, at its typical size: each robot alone\n";
    page += "with the effect against the same robot without, both free from the first row on, by sensors without noise. Places\n";
    page += "sum up all that was before. The last columns say where it shows most, in units of the sensor's noise. Effects on\n";
    page += "one wheel sit on wheel 0; drives that control wheel speed tell no currents; what shows beside another effect alone has\n";
    page += "that one in both drives. What is less than a billionth is 0.\n";
    for shown in SHOWN.iter() {
        let Some(first) = shown.first() else { continue };
        let _ = writeln!(page, "\n### {}\n\nNoise: {}.\n", first.robot, noises(shown));
        let _ = writeln!(page, "| effect | {} | shows most in | over its noise |", COLUMNS.join(" | "));
        let _ = writeln!(page, "|{}", "---|".repeat(COLUMNS.len() + 3));
        for shown in shown {
            let cells = largest(shown).map(|change| change.map_or("–".to_owned(), amount)).join(" | ");
            let most = shown.most();
            let signal = COLUMNS[column(Signal::of_channel(most.channel, shown.wheels))];
            let signal = signal.split_once(" [").map_or(signal, |(name, _)| name);
            let _ = writeln!(page, "| `{}` | {cells} | {signal} | {} |", shown.effect.id, two_digits(most.in_noise()));
        }
    }
    page
}

#[test]
fn every_effect_shows_and_none_does_anything_absurd() {
    for shown in SHOWN.iter().flatten() {
        let what = format!("{} on {}", shown.effect.id, shown.robot);
        assert!(shown.most().in_noise() > 0.1, "{what} changes no signal by a tenth of its noise");
        for signal in &shown.signals {
            let name = Signal::of_channel(signal.channel, shown.wheels);
            assert!(signal.largest_change().is_finite(), "{what}: {name:?} is not finite");
            let most = |values: &[f64]| values.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            if matches!(name, Signal::WheelSpeed(_) | Signal::Gyro) {
                let (with, without) = (most(&signal.with), most(&signal.without));
                assert!(without > 0.0 && with < 3.0 * without, "{what}: {name:?} to {with}, without it {without}");
            }
        }
    }
}

#[test]
fn every_effect_has_its_picture_and_no_other_stands_beside_them() {
    let [_, four] = &*SHOWN;
    for shown in four {
        let picture = effect_picture(shown);
        assert!(picture.len() < LARGEST, "{}: {} bytes", shown.effect.id, picture.len());
        golden::holds(&format!("{FOLDER}/{}.svg", shown.effect.id), &picture);
    }
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("golden").join(FOLDER);
    for entry in std::fs::read_dir(folder).expect("the folder of the pictures") {
        let name = entry.expect("a readable folder").file_name().to_string_lossy().into_owned();
        let id = name.strip_suffix(".svg").and_then(EffectKind::find);
        assert!(id.is_some(), "golden/{FOLDER}/{name} is the picture of no effect: remove it");
    }
}
