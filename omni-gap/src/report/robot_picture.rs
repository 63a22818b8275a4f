//! The robot from above: where its wheels touch the floor and how they roll, with what the gap sits on marked.

use super::markup::{Markup, Px};
use super::phrases;
use crate::log::WheelFile;
use crate::vocabulary::Axis;

/// Half the side of the picture (px).
const HALF: f64 = 110.0;

/// From the middle to the outermost wheel (px).
const REACH: f64 = 72.0;

/// From the middle to the end of an axis' arrow (px).
const ARROW: f64 = 40.0;

/// From a wheel to its number, outwards (px).
const BESIDE: f64 = 22.0;

/// The least length of a wheel (px).
const LEAST_WHEEL: f64 = 26.0;

/// What is marked on the robot.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Marked {
    /// Wheels by number.
    pub wheels: Vec<usize>,
    /// Body axes.
    pub axes: Vec<Axis>,
}

/// A place on the page of a place in the body's frame, in px: forward (v) is up, and vn is to the left.
fn on_page(v: f64, vn: f64) -> (f64, f64) {
    (-vn, -v)
}

/// Draws the robot.
pub(super) fn robot_picture(m: &mut Markup, wheels: &[WheelFile], marked: &Marked) {
    let view = format!("{0} {0} {1} {1}", -HALF, 2.0 * HALF);
    let label = format!("The robot from above, forward is up; {}", words(marked));
    m.within("svg", &[("class", &"robot"), ("viewBox", &view), ("role", &"img"), ("aria-label", &label)], |m| {
        let outermost = wheels.iter().map(|wheel| wheel.distance_m).fold(f64::MIN_POSITIVE, f64::max);
        let px_per_m = REACH / outermost;
        m.leaf("circle", &[("class", &"body"), ("r", &Px(0.86 * REACH))], "");
        for axis in [Axis::V, Axis::Vn, Axis::W] {
            arrow(m, axis, marked.axes.contains(&axis));
        }
        for (number, wheel) in wheels.iter().enumerate() {
            draw_wheel(m, number, wheel, px_per_m, marked.wheels.contains(&number));
        }
    });
}

/// "marked: wheel 2, forward motion (v)"
pub(super) fn words(marked: &Marked) -> String {
    let wheels = marked.wheels.iter().map(|wheel| format!("wheel {wheel}"));
    let all: Vec<String> = wheels.chain(marked.axes.iter().map(|axis| phrases::axis(*axis).to_owned())).collect();
    if all.is_empty() { "no wheel and no axis is marked".to_owned() } else { format!("marked: {}", all.join(", ")) }
}

fn draw_wheel(m: &mut Markup, number: usize, wheel: &WheelFile, px_per_m: f64, marked: bool) {
    let (v, vn) = wheel.wheel().contact_point();
    let [cos, sin] = wheel.wheel().direction();
    let (x, y) = on_page(v * px_per_m, vn * px_per_m);
    let (along_x, along_y) = on_page(cos, sin);
    let length = (2.0 * wheel.radius_m * px_per_m).clamp(LEAST_WHEEL, 0.9 * REACH);
    let turn =
        format!("translate({} {}) rotate({})", Px(x), Px(y), Px(along_y.atan2(along_x).to_degrees().rem_euclid(360.0)));
    let class = if marked { "wheel most" } else { "wheel" };
    m.within("g", &[("class", &class), ("transform", &turn)], |m| {
        let half = Px(-0.5 * length);
        m.leaf("rect", &[("x", &half), ("y", &-7), ("width", &Px(length)), ("height", &14), ("rx", &4)], "");
        // a head at the end to which the wheel rolls while its speed is positive
        m.leaf("path", &[("d", &format!("M{} -4l5 4l-5 4", Px(0.5 * length - 9.0)))], "");
    });
    let beyond = px_per_m + BESIDE / wheel.distance_m;
    let (x, y) = on_page(v * beyond, vn * beyond);
    let class = if marked { "mid most" } else { "mid" };
    m.leaf("text", &[("class", &class), ("x", &Px(x)), ("y", &Px(y + 4.0))], &number.to_string());
}

/// The arrow of an axis: forward, to the left, or turning left.
fn arrow(m: &mut Markup, axis: Axis, marked: bool) {
    let class = if marked { "axis most" } else { "axis" };
    let a = ARROW;
    let (d, name, (x, y)) = match axis {
        Axis::V => (format!("M0 0V-{a}m-5 7l5 -7l5 7"), "v", (10.0, -a + 2.0)),
        Axis::Vn => (format!("M0 0H-{a}m7 -5l-7 5l7 5"), "vn", (-a + 4.0, 17.0)),
        Axis::W => ("M14 0a14 14 0 0 0 -14 -14m6 -5l-6 5l6 5".to_owned(), "ω", (22.0, -8.0)),
    };
    m.leaf("path", &[("class", &class), ("d", &d)], "");
    m.leaf("text", &[("class", &format!("mid {class}")), ("x", &Px(x)), ("y", &Px(y))], name);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn drawn(marked: &Marked) -> String {
        let wheel = |drive_angle_deg| WheelFile { drive_angle_deg, distance_m: 0.1, radius_m: 0.03 };
        let mut m = Markup::default();
        robot_picture(&mut m, &[90.0, 180.0, 270.0, 0.0].map(wheel), marked);
        m.finish()
    }

    #[test]
    fn the_papers_wheels_stand_ahead_left_behind_and_right() {
        let svg = drawn(&Marked::default());
        // wheel 0 touches ahead and rolls to the left: turned by half a turn from a wheel that rolls to the right
        for place in ["translate(0 -72) rotate(180)", "translate(-72 0) rotate(90)", "translate(0 72) rotate(0)"] {
            assert!(svg.contains(place), "{place}: {svg}");
        }
        assert!(!svg.contains("most"), "{svg}");
    }

    #[test]
    fn what_is_marked_is_marked_and_told() {
        let svg = drawn(&Marked { wheels: vec![2], axes: vec![Axis::W] });
        assert!(svg.contains("marked: wheel 2, turning (w)"), "{svg}");
        assert_eq!(svg.matches("most").count(), 4, "{svg}");
    }
}
