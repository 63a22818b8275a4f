//! Which curves show most: of each signal group the one that holds most of what is left, the plainest first.
//!
//! All curves of the menu are looked at, over every wheel alone and over all together. A curve that is shown has to be rarer than
//! chance by the number of curves that were looked at (Bonferroni), so that one is shown in a share `false_alarm` of the
//! recordings where there is none, at the most.

use super::beats::of_windows;
use super::bins::{Bin, Held, Sample};
use super::curve::curve;
use super::map::floor;
use super::model::{Feature, Form, Quantity, Shape};
use super::order::{Beats, strongest};
use super::sampled::sample;
use super::settings::ShapeSettings;
use super::window::Window;
use super::windows::Windowed;

/// Features of a wheel's quantities.
const OF_WHEELS: [Feature; 8] = [
    Feature::WheelSpeed,
    Feature::Current,
    Feature::CurrentSize,
    Feature::WheelAcceleration,
    Feature::WheelAngle,
    Feature::Heading,
    Feature::Time,
    Feature::BatteryDrop,
];

/// Features of the body's quantities, beside the speed along their own axis.
const OF_BODY: [Feature; 4] = [Feature::Heading, Feature::Turning, Feature::Time, Feature::BatteryDrop];

/// What is laid over which features.
fn menu() -> Vec<(Quantity, Vec<Feature>)> {
    let of_body = |own: Feature| std::iter::once(own).chain(OF_BODY).collect::<Vec<_>>();
    let (v, vn, w) = (Feature::SpeedAhead, Feature::SpeedLeft, Feature::YawRate);
    vec![
        (Quantity::Current, OF_WHEELS.to_vec()),
        (Quantity::NeededForce, OF_WHEELS.to_vec()),
        (Quantity::WheelSpeed, OF_WHEELS.to_vec()),
        (Quantity::NeededForceAhead, of_body(v)),
        (Quantity::NeededForceLeft, of_body(vn)),
        (Quantity::NeededTorque, of_body(w)),
        (Quantity::Drag, vec![Feature::Place]),
        (Quantity::SpeedAhead, of_body(v)),
        (Quantity::SpeedLeft, of_body(vn)),
        (Quantity::TurningRate, of_body(w)),
        (Quantity::Gyro, of_body(w)),
        (Quantity::Battery, vec![Feature::TotalCurrent, Feature::Time]),
    ]
}

/// Whether each wheel has its own.
fn is_of_wheels(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Current | Quantity::NeededForce | Quantity::WheelSpeed)
}

/// A curve that was looked at.
#[derive(Clone, Debug)]
struct Seen {
    quantity: Quantity,
    feature: Feature,
    wheel: Option<usize>,
    bins: Vec<Bin>,
    held: Held,
}

/// All curves and maps of the menu that have enough samples, of a robot with so many wheels.
fn looked_at(windowed: &Windowed, wheels: usize, settings: &ShapeSettings) -> Vec<Seen> {
    let mut seen = Vec::new();
    for (quantity, features) in menu() {
        let long = matches!(quantity, Quantity::SpeedAhead | Quantity::SpeedLeft | Quantity::TurningRate);
        let windows = if long { &windowed.long } else { &windowed.short };
        let alone = (0..wheels).filter(|_| is_of_wheels(quantity)).map(Some);
        let places: Vec<Option<usize>> = std::iter::once(None).chain(alone).collect();
        for (feature, wheel) in features.iter().flat_map(|feature| places.iter().map(move |wheel| (*feature, *wheel))) {
            let all = match wheel {
                Some(wheel) => wheel..wheel + 1,
                None => 0..if is_of_wheels(quantity) { wheels } else { 1 },
            };
            let laid = |window| all.clone().filter_map(move |j| laid_over(window, feature, (quantity, j)));
            let bins = match feature {
                Feature::Place => floor(windows, settings),
                _ => curve(windows.iter().flat_map(laid).collect(), settings),
            };
            seen.extend(bins.map(|bins| {
                // what is the same everywhere is no map
                let held = if feature == Feature::Place { Held::of_differences(&bins) } else { Held::of(&bins) };
                Seen { quantity, feature, wheel, held, bins }
            }));
        }
    }
    seen
}

fn laid_over(window: &Window, feature: Feature, (quantity, wheel): (Quantity, usize)) -> Option<Sample> {
    sample(window, window.when.feature(feature, wheel), (quantity, wheel))
}

/// The shapes that show most, of a robot with so many wheels, the plainest first.
pub(super) fn chosen(windowed: &Windowed, wheels: usize, settings: &ShapeSettings) -> Vec<Shape> {
    let mut seen = looked_at(windowed, wheels, settings);
    let looked_at = seen.len() as f64;
    seen.retain(|seen| seen.held.chance * looked_at < settings.false_alarm && seen.held.share > settings.least_share);
    seen.sort_by(|a, b| b.held.plain.total_cmp(&a.held.plain));
    let mut chosen: Vec<Seen> = Vec::new();
    for one in seen {
        if !chosen.iter().any(|other| other.quantity.group() == one.quantity.group()) {
            chosen.push(one);
        }
    }
    let mut shapes: Vec<(f64, Shape)> = chosen.iter().map(|seen| (seen.held.plain, seen.told(looked_at))).collect();
    let of_wheels =
        [Quantity::Current, Quantity::NeededForce].into_iter().flat_map(|q| (0..wheels).map(move |j| (q, j)));
    let slow = of_wheels.map(|of| of_windows(&windowed.short, of, settings.window_s));
    let beats: Vec<Beats> = windowed.beats.iter().cloned().chain(slow).collect();
    shapes.extend(strongest(&beats, settings));
    shapes.sort_by(|a, b| b.0.total_cmp(&a.0));
    shapes.truncate(settings.most);
    shapes.into_iter().map(|(_, shape)| shape).collect()
}

impl Seen {
    fn told(&self, looked_at: f64) -> Shape {
        Shape {
            form: if self.feature == Feature::Place { Form::Map } else { Form::Curve },
            feature: self.feature,
            unit: self.feature.unit().to_owned(),
            quantity: self.quantity,
            quantity_unit: self.quantity.unit().to_owned(),
            group: self.quantity.group().name().to_owned(),
            wheel: self.wheel,
            chance: (self.held.chance * looked_at).min(1.0),
            share: self.held.share,
            alarm_level: None,
            lines: Vec::new(),
            bins: self.bins.iter().map(Bin::told).collect(),
        }
    }
}
