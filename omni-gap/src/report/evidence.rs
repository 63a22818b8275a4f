//! Evidence in words: what a shape of the residual says, as a person would point it out.

use super::number::{NBSP, figures, num};
use crate::engine::findings::{Feature, Form, Quantity, Shape, ShapeBin};

/// What is less than this of a residual is little of it [1]
const LITTLE: f64 = 0.3;

/// What a shape is over, in the middle of a sentence.
pub(super) fn feature(feature: Feature) -> &'static str {
    match feature {
        Feature::WheelSpeed => "wheel speed",
        Feature::Current => "current",
        Feature::CurrentSize => "current without its sign",
        Feature::WheelAcceleration => "wheel acceleration",
        Feature::WheelAngle => "wheel angle within a turn",
        Feature::SpeedAhead => "speed ahead",
        Feature::SpeedLeft => "speed to the left",
        Feature::YawRate => "yaw rate",
        Feature::Heading => "heading",
        Feature::Turning => "speed ahead times yaw rate",
        Feature::Time => "time since the run began",
        Feature::TotalCurrent => "current of all motors",
        Feature::BatteryDrop => "what the load takes off the battery",
        Feature::Place => "place on the floor",
        Feature::Order => "order of the wheel’s turn",
    }
}

/// The heading of a shape: what of which wheel, over what.
pub(super) fn heading(shape: &Shape) -> String {
    format!("{}, over {}", subject(shape), feature(shape.feature))
}

/// What is told of the residual.
fn subject(shape: &Shape) -> String {
    let wheel = |one: &str| match shape.wheel {
        Some(j) => format!("{one} of wheel{NBSP}{j}"),
        None => format!("{one}, all wheels together"),
    };
    match shape.quantity {
        Quantity::Current => wheel("Current"),
        Quantity::NeededForce => wheel("Force that the motion needs at the rim"),
        Quantity::WheelSpeed => wheel("Speed"),
        Quantity::NeededForceAhead => "Force ahead that the motion needs".to_owned(),
        Quantity::NeededForceLeft => "Force to the left that the motion needs".to_owned(),
        Quantity::NeededTorque => "Torque that the turning needs".to_owned(),
        Quantity::Drag => "Force against the motion".to_owned(),
        Quantity::SpeedAhead => "Speed ahead by the pose".to_owned(),
        Quantity::SpeedLeft => "Speed to the left by the pose".to_owned(),
        Quantity::TurningRate => "Yaw rate by the pose".to_owned(),
        Quantity::Gyro => "Yaw rate by the gyro".to_owned(),
        Quantity::Battery => "Bus voltage under load".to_owned(),
    }
}

/// What a shape says, in one or two sentences.
pub(super) fn sentence(shape: &Shape) -> String {
    match (shape.form, telling(shape)) {
        (Form::Spectrum, _) => spectrum(shape),
        (_, None) => String::new(),
        (Form::Map, Some(bin)) => {
            let [low, high] = bin.y.unwrap_or_default().map(end);
            let (x, to) = (end(bin.low), end(bin.high));
            format!("Where x is {x} to {to} m and y {low} to {high} m, {}", says(shape, bin))
        }
        (Form::Curve, Some(bin)) => {
            let at = bin_in_words(shape.feature, &end(bin.low), &end(bin.high));
            format!("{at}, {}", says(shape, bin))
        }
    }
}

/// An end of a bin: finer than two figures is of no use.
fn end(x: f64) -> String {
    figures(x, 2)
}

/// The bin that a person would point at: of those surely away from zero the one farthest away, on the positive side of the
/// feature where both sides tell.
fn telling(shape: &Shape) -> Option<&ShapeBin> {
    let sure = |bin: &&ShapeBin| bin.before_ci95[0] * bin.before_ci95[1] > 0.0;
    let far = |a: &&ShapeBin, b: &&ShapeBin| a.before.abs().total_cmp(&b.before.abs());
    let farthest = shape.bins.iter().filter(sure).max_by(far)?;
    let positive = shape.bins.iter().filter(sure).filter(|bin| bin.at > 0.0).max_by(far);
    Some(positive.filter(|bin| bin.before.abs() > LITTLE * farthest.before.abs()).unwrap_or(farthest))
}

fn bin_in_words(of: Feature, low: &str, high: &str) -> String {
    let unit = of.unit();
    match of {
        Feature::WheelSpeed => format!("At {low} to {high} {unit} of the wheel"),
        Feature::Current => format!("At {low} to {high} {unit}"),
        Feature::CurrentSize => format!("At {low} to {high} {unit} either way"),
        Feature::WheelAcceleration => format!("Where the wheel speeds up by {low} to {high} {unit}"),
        Feature::WheelAngle => format!("At wheel angles of {low} to {high} {unit}"),
        Feature::SpeedAhead => format!("At {low} to {high} {unit} ahead"),
        Feature::SpeedLeft => format!("At {low} to {high} {unit} to the left"),
        Feature::YawRate => format!("At yaw rates of {low} to {high} {unit}"),
        Feature::Heading => format!("At headings of {low} to {high} {unit}"),
        Feature::Turning => format!("Where speed ahead times yaw rate is {low} to {high} {unit}"),
        Feature::Time => format!("From {low} to {high} {unit} into a run"),
        Feature::TotalCurrent => format!("Where all motors together draw {low} to {high} {unit}"),
        Feature::BatteryDrop => format!("Where the battery’s voltage changes by {low} to {high} {unit} under load"),
        Feature::Place | Feature::Order => format!("From {low} to {high} {unit}"),
    }
}

/// What the measurement says beyond both models.
fn says(shape: &Shape, bin: &ShapeBin) -> String {
    let unit = &shape.quantity_unit;
    let size = format!("{}{NBSP}{unit}", num(bin.before.abs()));
    let more = bin.before > 0.0;
    let needs = if more { "more" } else { "less" };
    let lies = if more { "above" } else { "below" };
    let wheel = |one: &str| shape.wheel.map_or(format!("a {one}"), |j| format!("{one}{NBSP}{j}"));
    let nominal = if is_refitted(shape) {
        "the nominal model says, even with its numbers re-fitted"
    } else {
        "the nominal model says"
    };
    let said = match shape.quantity {
        Quantity::NeededForce => format!("{} needs {size} {needs} than {nominal}", wheel("wheel")),
        Quantity::NeededForceAhead => format!("the robot needs {size} {needs} force ahead than {nominal}"),
        Quantity::NeededForceLeft => format!("the robot needs {size} {needs} force to the left than {nominal}"),
        Quantity::NeededTorque => format!("the robot needs {size} {needs} torque to the left than {nominal}"),
        Quantity::Drag => format!("the robot needs {size} {needs} to move than {nominal}"),
        Quantity::Current => {
            let whose =
                shape.wheel.map_or("a motor’s current".to_owned(), |j| format!("the current of wheel{NBSP}{j}"));
            format!("{whose} lies {size} {lies} what {nominal}")
        }
        Quantity::WheelSpeed => format!("{}’s speed lies {size} {lies} what {nominal}", wheel("wheel")),
        Quantity::SpeedAhead => format!("with wheels that turn so, the speed ahead lies {size} {lies} what {nominal}"),
        Quantity::SpeedLeft => {
            format!("with wheels that turn so, the speed to the left lies {size} {lies} what {nominal}")
        }
        Quantity::TurningRate => format!("with wheels that turn so, the yaw rate lies {size} {lies} what {nominal}"),
        Quantity::Gyro => format!("the gyro’s yaw rate lies {size} {lies} what {nominal}"),
        Quantity::Battery => format!("the bus voltage lies {size} {lies} what {nominal}"),
    };
    let within = bin.corrected_ci95[0] <= 0.0 && bin.corrected_ci95[1] >= 0.0;
    let tells = bin.before - bin.corrected;
    let corrected = if !is_explained(shape) {
        "no cause of the catalogue explains it".to_owned()
    } else if within || bin.corrected.abs() <= LITTLE * bin.before.abs() {
        "the corrected model says so too".to_owned()
    } else if tells * bin.before > LITTLE * bin.before.powi(2) {
        format!("the corrected model says {}{NBSP}{unit} of it", num(tells.abs()))
    } else {
        "the corrected model does not say so either".to_owned()
    };
    format!("{said}; {corrected}.")
}

fn spectrum(shape: &Shape) -> String {
    let Some(line) = shape.lines.first() else { return String::new() };
    let Some(bin) = shape.bins.iter().find(|bin| bin.at as usize == line.order) else { return String::new() };
    let times = match line.order {
        1 => "Once".to_owned(),
        order => format!("{order} times"),
    };
    let name = line.name.as_ref().filter(|_| line.order > 1).map(|name| format!(" ({name})")).unwrap_or_default();
    let subject = match shape.quantity {
        Quantity::NeededForce => "the force that it needs",
        Quantity::Current => "its motor’s current",
        _ => "its speed",
    };
    let unit = &shape.quantity_unit;
    let wheel = shape.wheel.map(|j| format!(" of wheel{NBSP}{j}")).unwrap_or_default();
    let size = |x: f64| format!("{}{NBSP}{unit}", num(x));
    let level = shape.alarm_level.unwrap_or_default();
    let corrected = if !is_explained(shape) {
        "no cause of the catalogue explains it".to_owned()
    } else if bin.corrected < level {
        format!("the corrected model leaves no more than chance does ({})", size(bin.corrected))
    } else {
        format!("the corrected model leaves {}", size(bin.corrected))
    };
    format!(
        "{times} a turn{wheel}{name}, {subject} swings by {} either way beyond the nominal model; {corrected}.",
        size(bin.before)
    )
}

/// Whether the causes were added to a model with other numbers than the file's.
pub(super) fn is_refitted(shape: &Shape) -> bool {
    shape.bins.iter().any(|bin| bin.before != bin.nominal)
}

/// Whether the corrected model is another than the one that causes are added to.
pub(super) fn is_explained(shape: &Shape) -> bool {
    shape.bins.iter().any(|bin| bin.before != bin.corrected)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::sample_evidence::{carpet, rollers, stribeck};

    fn plain(shape: &Shape) -> String {
        sentence(shape).replace(NBSP, " ")
    }

    #[test]
    fn a_curve_is_told_by_its_plainest_bin_on_the_positive_side() {
        // of the sample: 0.1 N + 0.4 N·exp(−(3/4)²) at 3 rad/s
        let said = "At 1.5 to 4.5 rad/s of the wheel, a wheel needs 0.328 N more than the nominal model says; \
                    the corrected model says so too.";
        assert_eq!(plain(&stribeck()), said);
    }

    #[test]
    fn what_the_corrected_model_leaves_is_told() {
        let mut shape = stribeck();
        let (mut half, mut all) = (shape.clone(), shape.clone());
        let leaves = |shape: &mut Shape, share: f64| {
            for bin in &mut shape.bins {
                bin.corrected = share * bin.before;
                bin.corrected_ci95 = [bin.corrected - 1e-3, bin.corrected + 1e-3];
            }
        };
        leaves(&mut half, 0.5);
        leaves(&mut all, 0.9);
        assert!(plain(&half).ends_with("the corrected model says 0.164 N of it."), "{}", plain(&half));
        assert!(plain(&all).ends_with("the corrected model does not say so either."), "{}", plain(&all));
        shape.wheel = Some(2);
        assert!(plain(&shape).contains(", wheel 2 needs"), "{}", plain(&shape));
    }

    #[test]
    fn a_spectrum_is_told_by_its_strongest_line_and_what_that_is() {
        let said = "13 times a turn of wheel 1 (Ripple of one wheel's rollers), the force that it needs swings by 0.300 N \
                    either way beyond the nominal model; the corrected model leaves no more than chance does (0.0200 N).";
        assert_eq!(plain(&rollers()), said);
    }

    #[test]
    fn a_map_is_told_by_its_plainest_cell_and_a_gap_that_nothing_explains_is_told_so() {
        let said = "Where x is 1.5 to 2.0 m and y 0.50 to 1.0 m, the robot needs 1.20 N more to move than the nominal \
                    model says; no cause of the catalogue explains it.";
        assert_eq!(plain(&carpet()), said);
    }

    #[test]
    fn numbers_that_were_refitted_first_are_told_so() {
        let mut shape = stribeck();
        shape.bins.iter_mut().for_each(|bin| bin.nominal += 1.0);
        let said = "needs 0.328 N more than the nominal model says, even with its numbers re-fitted; the corrected model says so too.";
        assert!(plain(&shape).ends_with(said), "{}", plain(&shape));
    }
}
