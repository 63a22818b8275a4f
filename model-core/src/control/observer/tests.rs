use super::*;

/// Sector at the wheel's shaft with 8 pole pairs and a gear of 5 [rad]
const SECTOR: f64 = core::f64::consts::TAU / 240.0;
const DT: f64 = 1e-3;

/// A wheel, its counted edges, and what is believed of it.
struct Wheel {
    angle: f64,
    speed: f64,
    edges: i32,
    since_edge: u16,
    observed: WheelEstimate,
}

impl Wheel {
    fn at(angle: f64, speed: f64) -> Self {
        Self { angle, speed, edges: 0, since_edge: REST, observed: WheelEstimate::default() }
    }

    /// A turn of twenty periods: accelerates with `a` [rad/s²], was to do so with `wanted`.
    fn turn(&mut self, a: f64, wanted: f64, reference: f64) {
        let halls = HallReading { edges: self.edges, since_edge: self.since_edge, speed: self.speed as f32 };
        let observer = SpeedObserver::new(SECTOR as f32, DT as f32, 50e-6);
        observer.update(&mut self.observed, halls, (wanted * DT) as f32, reference as f32);
        for _ in 0..20 {
            self.speed += a * 50e-6;
            self.angle += self.speed * 50e-6;
            let edges = libm::floor(self.angle / SECTOR) as i32;
            self.since_edge = if edges == self.edges { self.since_edge.saturating_add(1) } else { 0 };
            self.edges = edges;
        }
    }

    fn error(&self) -> f64 {
        f64::from(self.observed.speed) - self.speed
    }
}

#[test]
fn a_wheel_that_starts_as_its_reference_does_is_followed_before_its_first_edge() {
    for a in [15.0, -15.0, 90.0] {
        let mut wheel = Wheel::at(0.5 * SECTOR, 0.0);
        for k in 0..500 {
            wheel.turn(a, if k == 0 { 0.0 } else { a }, a * DT * f64::from(k));
            // the turn that has just passed is not told yet: a·Δt, and the resolution of an edge time, a period of the sector
            let most = a.abs() * DT + 0.05 * wheel.speed.abs() + 0.02;
            assert!(wheel.error().abs() < most, "{} at {} rad/s", wheel.error(), wheel.speed);
        }
    }
}

#[test]
fn a_wheel_that_does_something_else_is_found_out() {
    let mut wheel = Wheel::at(0.0, 20.0);
    (0..100).for_each(|_| wheel.turn(0.0, 0.0, 20.0));
    assert!(wheel.error().abs() < 0.4, "{}", wheel.error());
    // it slows down though nothing told it to, and settles
    (0..50).for_each(|_| wheel.turn(-100.0, 0.0, 20.0));
    (0..60).for_each(|_| wheel.turn(0.0, 0.0, 20.0));
    assert!(wheel.error().abs() < 0.4, "{}", wheel.error());
}

#[test]
fn a_wheel_that_is_held_is_believed_to_stand() {
    let mut wheel = Wheel::at(0.5 * SECTOR, 0.0);
    let mut reference = 0.0;
    for _ in 0..200 {
        reference += 50.0 * DT;
        wheel.turn(0.0, 50.0, reference);
    }
    // what is believed while the reference still runs away: its change over the time in which the sector pulls back
    assert!(wheel.error().abs() < 50.0 * 2.0 / f64::from(BANDWIDTH), "{}", wheel.error());
    (0..300).for_each(|_| wheel.turn(0.0, 0.0, reference));
    assert!(wheel.error().abs() < 0.3, "{}", wheel.error());
}

#[test]
fn a_reversal_is_followed() {
    let mut wheel = Wheel::at(0.3 * SECTOR, 3.0);
    (0..50).for_each(|_| wheel.turn(0.0, 0.0, 3.0));
    for k in 0..300 {
        wheel.turn(-20.0, if k == 0 { 0.0 } else { -20.0 }, 3.0 - 20.0 * DT * f64::from(k));
        // half a sector may be unknown around the reversal, and what that is in speed fades with the bandwidth
        assert!(wheel.error().abs() < 0.8, "{} at {} rad/s", wheel.error(), wheel.speed);
    }
    assert!(wheel.error().abs() < 0.2, "{}", wheel.error());
}

#[test]
fn a_wheel_that_stands_and_is_to_stand_has_no_speed() {
    let mut wheel = Wheel::at(0.3 * SECTOR, 0.2);
    (0..20).for_each(|_| wheel.turn(0.0, 0.0, 0.2));
    wheel.speed = 0.0;
    (0..60).for_each(|_| wheel.turn(0.0, 0.0, 0.0));
    assert_eq!(wheel.observed.speed, 0.0);
}

#[test]
fn edges_that_cannot_be_begin_anew_with_the_speed_of_edge_times() {
    let observer = SpeedObserver::new(SECTOR as f32, DT as f32, 50e-6);
    let mut wheel = WheelEstimate::default();
    let halls = HallReading { edges: 0, since_edge: 3, speed: 1.0 };
    observer.update(&mut wheel, halls, 0.0, 1.0);
    observer.update(&mut wheel, HallReading { edges: 1000, speed: 7.0, ..halls }, 0.0, 1.0);
    assert_eq!(wheel.speed, 7.0);
    // no number comes of a count that wraps
    observer.update(&mut wheel, HallReading { edges: i32::MIN, speed: 7.0, ..halls }, 0.0, 1.0);
    assert!(wheel.speed.is_finite());
}
