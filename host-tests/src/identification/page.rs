//! The page: the promises first, then what was played, every error, and what is said where not everything can be told.
//!
//! It holds no time of day and no duration, so that the same program writes the same page.

use omni_gap::identify::IDENTIFIED;
use omni_gap::simulate::{Sensing, SensorSetup, SpeedSensor};

use super::Results;
use super::case::{CASES, FIELD, VOLTAGE};
use super::identifiability;
use super::missing_group::SEEDS;
use super::no_excitation::STANDS;
use super::prior::{stated, symbol};
use super::promises::{promises, table};
use super::significant_figures::percent;
use super::tables;

/// The whole page.
pub fn page(results: &Results) -> String {
    let mut text = opening();
    if !results.cases.iter().map(|s| s.case).eq(CASES) {
        text += "\n**A shortened look: fewer robots or cases than the study has. Nothing here is a result.**\n";
    }
    text += "\n## What was promised\n\n";
    text += &table(&promises(results));
    text += &explained();
    text += "\n## What was played\n\n";
    text += &tables::played(&results.cases);
    text += &measured();
    text += ERRORS;
    for studied in &results.cases {
        text += &tables::case(studied);
    }
    text += BIAS;
    text += &tables::bias(&results.cases);
    text += &format!(
        "\n## One group missing\n\n\
         Modern sensors, {SEEDS} robots each. With \"identified\" stand the largest error and the largest distance to the truth\n\
         in the number's own σ. Without voltages the measured currents drive the model.\n\n"
    );
    text += &identifiability::words(&results.missing);
    text += "\nKnown only in combination:\n\n";
    text += &identifiability::together(&results.missing);
    text += &format!(
        "\n## Without excitation\n\n\
         A robot that stands does so for {STANDS} s. The others lack the runs along an axis.\n\n"
    );
    text += &identifiability::idle(&results.idle);
    text
}

fn opening() -> String {
    let file = CASES[0].truth();
    let off: Vec<String> =
        IDENTIFIED.iter().map(|p| format!("{} {} %", symbol(*p), whole(&percent(stated(&file, *p))))).collect();
    format!(
        "# How well a robot is identified, measured where the truth is known\n\n\
         Every robot is one of the paper's Table 3, with three wheels or four. A seed draws how wrong its robot file is before\n\
         (one σ: {}) and the\n\
         noise. Mass and geometry are right. The robot plays the paper's experiments, and each estimator is asked for\n\
         its numbers:\n\n\
         - **experiments 1, 2, motor**: steady spin, coast-down, steady motors; R and K_t of the motors, J of the coast-down;\n\
         - **3, least squares** and **3, instrumental**: the step with an initial ramp, by eq. 40 and by eq. 41;\n\
         - **paper's table**: the average of the former and experiment 3 (instrumental), R of experiment 3, as in Table 3;\n\
         - **all together**: the fit of `omni-gap identify` to all runs but the motors'.\n\n\
         `cargo xtask identification` makes this page again. The seeds count up from 1; none was chosen by its result.\n",
        off.join(", ")
    )
}

/// "10" for "10", "3" for "3.0".
fn whole(text: &str) -> &str {
    text.trim_end_matches(".0")
}

fn explained() -> String {
    "\nThe bars are the issue's. \"Paper's sensing\" has white camera errors. The Cramér–Rao bound is the least standard deviation\n\
     that any unbiased estimator can have on these recordings. A bias is plain above 3 of its standard errors.\n"
        .to_owned()
}

/// How it is measured, from the recordings' own settings.
fn measured() -> String {
    let lines: Vec<String> = [Sensing::Paper, Sensing::Modern, Sensing::Halls]
        .into_iter()
        .filter_map(|sensing| Some((CASES.iter().find(|c| c.sensing == sensing)?, sensing)))
        .map(|(case, sensing)| format!("- {}: {}\n", case.measured(), sensors(&sensing.recording(), sensing.rate())))
        .collect();
    format!(
        "\nThe largest voltage is {VOLTAGE} V of a supply of 12 V, the free floor {FIELD} m. Each run begins and ends at rest.\n\
         The plant takes steps of 0.25 ms, ten times shorter than the fit's.\n\n{}\n\
         Errors are Gaussian. Those that are alike over a time are an Ornstein–Uhlenbeck process of the same size.\n",
        lines.concat()
    )
}

fn sensors(how: &SensorSetup, rate: f64) -> String {
    let s = how.sensors;
    let lost = if how.dropouts > 0.0 { format!(", {:.0} % lost", 100.0 * how.dropouts) } else { String::new() };
    let speeds = match how.speed {
        SpeedSensor::None => "no wheel speeds".to_owned(),
        SpeedSensor::Encoder => format!("wheel speeds by encoders {} rad/s", s.wheel_speed_noise_rad_s),
        SpeedSensor::Halls { edges_per_turn } => {
            format!("wheel speeds from the times of {edges_per_turn} hall edges a turn, as told in rows")
        }
    };
    format!(
        "{rate} rows a second; camera {} frames a second{lost}, {} mm and {:.1}°; currents {} A; {speeds}.",
        how.camera_rate,
        1000.0 * s.position_noise_m,
        s.heading_noise_rad.to_degrees(),
        s.current_noise_a,
    )
}

const ERRORS: &str = "\n## The errors\n\n\
    Per number and estimator: the median of the error's size in per cent, and in brackets the bias, its mean. \"RMS over\n\
    bound\" is of all together, ± one standard error. \"Ratio\" is the median of all together over that of the paper's table.\n\
    \"90 % holds\": how many of the 90 % intervals of all together hold the truth.\n\n\
    With hall sensors the bound leaves out that an edge is told no finer than in rows. That biases some numbers, R most\n\
    plainly, by about a hundredth of a per cent: their RMS error is above the bound, and their intervals hold the truth less\n\
    often than they should.\n\n";

const BIAS: &str = "## Bias of least squares and of instrumental variables\n\n\
    Experiment 3 as the paper measured: mean error ± its standard error. \"Less by\" is the size of the first less that of\n\
    the second, over the same robots; one of them is called less biased beyond three standard errors of that. Where the\n\
    standard error is as large as the bias, the bias is not known.\n\n";
