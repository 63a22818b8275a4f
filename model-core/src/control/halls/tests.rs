use super::*;
use core::f64::consts::{FRAC_PI_3, FRAC_PI_6};

/// Resolution of an angle told in 2⁻¹⁶ turns [rad].
const FINE: f64 = TAU / 65_536.0;

/// Three switches and a rotor; `placed` is how far each edge stands ahead of its place [rad].
struct Rotor {
    angle: f64,
    placed: [f64; 6],
}

impl Rotor {
    fn at(angle: f64) -> Self {
        Self { angle, placed: [0.0; 6] }
    }

    fn code(&self) -> HallCode {
        let turns = libm::floor(self.angle / TAU);
        let within = self.angle - turns * TAU;
        // the edges into sectors 1 ..= 5 and 0 again; before the edge into 0 of this turn it is still sector 5
        let passed = (0..6).filter(|k| within >= *k as f64 * FRAC_PI_3 - FRAC_PI_6 + self.placed[*k]).count();
        let again = within >= 6.0 * FRAC_PI_3 - FRAC_PI_6 + self.placed[0];
        HallCode::of_sector(if again || passed == 0 { if again { 0 } else { 5 } } else { passed as u8 - 1 })
    }

    fn halls(&self) -> HallDecoder {
        HallDecoder::new(self.code()).expect("a place of the rotor")
    }
}

/// The angle by which `a` is ahead of `b` [rad], the shorter way.
fn ahead(a: f64, b: f64) -> f64 {
    let turns = (a - b) / TAU;
    (turns - libm::round(turns)) * TAU
}

fn at_sector(sector: u8) -> HallDecoder {
    HallDecoder::new(HallCode::of_sector(sector)).expect("a sector")
}

fn turn(halls: &mut HallDecoder, sector: u8) {
    halls.update(HallCode::of_sector(sector)).expect("a neighbour");
}

/// Goes on for so many periods without an edge.
fn wait(halls: &mut HallDecoder, periods: u32) {
    for _ in 0..periods {
        turn(halls, halls.sector());
    }
}

#[test]
fn a_code_is_that_of_three_switches_that_are_each_on_for_half_a_turn() {
    for k in 0..3600 {
        let angle = (f64::from(k) + 0.5) * TAU / 3600.0;
        let on = |shift: f64| u8::from(libm::cos(angle - shift) > 0.0);
        let code = on(0.0) | on(TAU / 3.0) << 1 | on(2.0 * TAU / 3.0) << 2;
        assert_eq!(HallCode::of_angle(angle), HallCode(code), "{angle}");
        assert_eq!(Rotor::at(angle).code(), HallCode(code), "{angle}");
    }
}

#[test]
fn the_order_of_the_codes_is_1_3_2_6_4_5_and_each_is_its_sector() {
    for (k, code) in [1, 3, 2, 6, 4, 5].into_iter().enumerate() {
        assert_eq!(HallCode(code).sector(), Some(k as u8));
        assert_eq!(HallCode::of_angle(k as f64 * FRAC_PI_3), HallCode(code));
    }
    for code in (0..=255).filter(|code| !(1..=6).contains(code)) {
        assert_eq!(HallCode(code).sector(), None);
        assert_eq!(HallDecoder::new(HallCode(code)), Err(HallFault::Illegal));
    }
}

#[test]
fn every_edge_counts_one_in_its_sense() {
    for start in 0..6 {
        let mut halls = at_sector(start);
        for n in 1..=30 {
            turn(&mut halls, (start + n) % 6);
            assert_eq!((halls.edges(), halls.sector()), (i32::from(n), (start + n) % 6));
        }
        for n in (0..30).rev() {
            turn(&mut halls, (start + n) % 6);
            assert_eq!((halls.edges(), halls.sector()), (i32::from(n), (start + n) % 6));
        }
    }
}

#[test]
fn the_count_wraps_at_the_end_of_its_range() {
    let mut halls = at_sector(0);
    halls.edges = i32::MAX;
    turn(&mut halls, 1);
    assert_eq!(halls.edges(), i32::MIN);
    turn(&mut halls, 0);
    assert_eq!(halls.edges(), i32::MAX);
}

#[test]
fn a_steady_rotor_is_followed_in_both_senses() {
    // rad a period, from 3 rad/s to 8,000 rad/s; the lowest takes 349 periods a sector
    for speed in [0.003, 0.02, 0.1, 0.4] {
        for speed in [speed, -speed] {
            let mut rotor = Rotor::at(0.2);
            let mut halls = rotor.halls();
            for n in 0..5000 {
                rotor.angle += speed;
                assert_eq!(halls.update(rotor.code()), Ok(()));
                if n < 1500 || halls.looked_at < 6 {
                    continue;
                }
                // a turn is measured to a period, and the last sector may look late by one more
                let per_turn = TAU / speed.abs();
                let error = halls.electrical_speed::<f64>() / speed - 1.0;
                assert!(error.abs() <= 1.001 / (per_turn - 1.0), "{speed}, {n}: {error}");
                // an edge is read within a period: ±½; the sector's length is measured to 6 %, at most, of 60°
                let off = ahead(halls.angle(), rotor.angle);
                let most = 0.5 * speed.abs() + FRAC_PI_3 / (per_turn - 1.0) + 2.0 * FINE;
                assert!(off.abs() <= most, "{speed}, {n}: {off} of {most}");
                assert!((halls.ahead::<f64>() / speed - 1.0).abs() <= 1.001 / (per_turn - 1.0) + FINE / speed.abs());
            }
            assert_eq!(halls.edges().signum(), if speed > 0.0 { 1 } else { -1 });
        }
    }
}

#[test]
fn edges_off_their_places_drop_out_of_the_mean_of_six() {
    let degree = TAU / 360.0;
    let placed = [4.0, -5.0, 3.0, 5.0, -4.0, 1.0].map(|x| x * degree);
    for speed in [0.01, -0.01] {
        let mut rotor = Rotor { placed, ..Rotor::at(0.2) };
        let mut halls = rotor.halls();
        let (mut worst_speed, mut worst_angle) = (0.0_f64, 0.0_f64);
        for n in 0..20_000 {
            rotor.angle += speed;
            assert_eq!(halls.update(rotor.code()), Ok(()));
            if n < 2000 {
                continue;
            }
            worst_speed = worst_speed.max((halls.electrical_speed::<f64>() / speed - 1.0).abs());
            worst_angle = worst_angle.max(ahead(halls.angle(), rotor.angle).abs());
        }
        // single sectors are up to 17 % off; 628 periods a turn are measured to one of them
        assert!(worst_speed < 1.01 / 627.0, "{worst_speed}");
        // an angle is off by its last edge's place, and by the next one's where that comes late: by 5° and no more
        assert!(worst_angle < 5.0 * degree + 0.5 * 0.01 + 0.2 * degree, "{}", worst_angle / degree);
    }
}

#[test]
fn an_accelerating_rotor_is_never_off_by_a_sector_and_soon_by_little() {
    // from rest at 1,000 ..= 200,000 rad/s² electrical; the last is 20 m/s² at the rim of a small robot and more
    for acceleration in [1.0e3, 1.0e4, 5.0e4, 2.0e5] {
        for sense in [1.0, -1.0] {
            let start = 0.1;
            let mut rotor = Rotor::at(start);
            let mut halls = rotor.halls();
            for n in 1..4000 {
                let t = f64::from(n) * 50.0e-6;
                let speed = acceleration * t * 50.0e-6;
                if speed > 0.4 {
                    break;
                }
                rotor.angle = start + sense * 0.5 * acceleration * t * t;
                assert_eq!(halls.update(rotor.code()), Ok(()));
                let off = ahead(halls.angle(), rotor.angle).abs();
                assert!(off <= FRAC_PI_3 + speed, "{acceleration}, {n}: {off}");
                let turns = (rotor.angle - start).abs() / TAU;
                if turns > 1.0 {
                    // a sector a fifth shorter than the mean is still taken for one of it: 12°, and what it shortens by
                    // while it lasts
                    assert!(off <= 0.25 + speed, "{acceleration}, {n}: {off} after {turns} turns");
                    // a mean from before, and measured to a period of a sector that takes about 1/speed of them
                    let estimated = halls.electrical_speed::<f64>() * sense;
                    assert!(
                        (0.7..1.02 + speed).contains(&(estimated / speed)),
                        "{acceleration}, {n}: {estimated} of {speed}"
                    );
                }
            }
        }
    }
}

#[test]
fn the_angle_is_within_its_sector_whatever_the_codes() {
    let mut halls = at_sector(2);
    let mut seed = 1_u32;
    for _ in 0..200_000 {
        seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let code = match seed >> 24 {
            0..10 => HallCode::of_sector(halls.sector() + 1),
            10..18 => HallCode::of_sector(halls.sector() + 5),
            18 => HallCode((seed >> 16) as u8),
            _ => HallCode::of_sector(halls.sector()),
        };
        let _ = halls.update(code);
        let off = ahead(halls.angle(), f64::from(halls.sector()) * FRAC_PI_3);
        assert!(off.abs() <= FRAC_PI_6 + 2.0 * FINE, "{off}");
        assert!((0.0..TAU).contains(&halls.angle::<f64>()));
        // from any two edges in a row: never more than a sector a period
        assert!(halls.electrical_speed::<f64>().abs() <= FRAC_PI_3);
        assert_eq!(u32::from(halls.sum), halls.took.iter().map(|t| u32::from(*t)).sum());
        assert_eq!(usize::from(halls.looked_at), halls.took.iter().filter(|t| **t != 0).count());
    }
}

#[test]
fn a_reversal_says_nothing_of_the_speed_until_two_edges_have_followed() {
    let mut halls = at_sector(0);
    for sector in [1, 2, 3, 4] {
        wait(&mut halls, 19);
        turn(&mut halls, sector);
    }
    assert!(halls.electrical_speed::<f64>() > 0.0 && halls.interval() == 120);
    wait(&mut halls, 5);
    turn(&mut halls, 3);
    assert_eq!((halls.electrical_speed::<f64>(), halls.interval(), halls.edges()), (0.0, 0, 3));
    // not even sideways: the middle of the sector
    assert!(ahead(halls.angle(), 3.0 * FRAC_PI_3).abs() <= FINE);
    wait(&mut halls, 39);
    turn(&mut halls, 2);
    assert_eq!(halls.interval(), 240);
    let speed = halls.electrical_speed::<f64>();
    assert!((speed + FRAC_PI_3 / 40.0).abs() < 1e-15, "{speed}");
}

#[test]
fn a_rotor_that_stands_on_an_edge_and_trembles_has_no_speed() {
    let mut halls = at_sector(4);
    for n in 0..1000 {
        turn(&mut halls, [5, 4][n % 2]);
        assert_eq!(halls.electrical_speed::<f64>(), 0.0);
        assert_eq!(halls.edges(), [1, 0][n % 2]);
    }
}

/// A rotor's switches that are undecided within so much of an edge [rad]: each reading is that of another place.
struct Chatter {
    within: f64,
    drawn: u32,
}

impl Chatter {
    /// What is read at an angle [rad].
    fn code(&mut self, angle: f64) -> HallCode {
        // Knuth's linear congruential generator
        self.drawn = self.drawn.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let share = f64::from(self.drawn >> 16) / 32_768.0 - 1.0;
        Rotor::at(angle + share * self.within).code()
    }
}

#[test]
fn switches_that_chatter_are_followed_as_those_that_do_not() {
    let within = 2.0_f64.to_radians();
    for speed in [0.002, -0.002, 0.01, -0.03] {
        let mut chatter = Chatter { within, drawn: 1 };
        let (mut angle, mut crossed_back) = (0.2, 0);
        let mut halls = HallDecoder::new(chatter.code(angle)).expect("a place of the rotor");
        let mut last = HallCode::of_angle(angle);
        for period in 0..20_000 {
            angle += speed;
            let code = chatter.code(angle);
            crossed_back += u32::from(code != last);
            last = code;
            halls.update(code).expect("a neighbour");
            // two edges have followed each other
            if f64::from(period) * speed.abs() < 3.0 * FRAC_PI_3 {
                continue;
            }
            // an edge is crossed early by what the switch is undecided, at both ends of what is measured
            let told: f64 = halls.electrical_speed();
            assert!((told / speed - 1.0).abs() < 2.0 * within / FRAC_PI_3 + 0.03, "{period}: {told} for {speed}");
            let off = ahead(halls.angle(), angle).abs();
            assert!(off < 3.0 * within + speed.abs(), "{period}: off by {off} at {speed}");
        }
        let edges = 20_000.0 * speed / FRAC_PI_3;
        assert!((f64::from(halls.edges()) - edges).abs() <= 1.0, "{} of {edges}", halls.edges());
        if speed.abs() < 0.01 {
            assert!(f64::from(crossed_back) > 3.0 * edges.abs(), "no chatter in this test: {crossed_back} edges read");
        }
    }
}

#[test]
fn a_rotor_that_turns_back_is_believed_after_a_quarter_of_a_sector() {
    let mut halls = at_sector(0);
    for sector in [1, 2, 3, 4] {
        wait(&mut halls, 39);
        turn(&mut halls, sector);
    }
    wait(&mut halls, 4);
    // 40 periods a sector: the code of sector 3 for up to nine periods is no news
    for _ in 0..5 {
        turn(&mut halls, 3);
        assert_eq!((halls.edges(), halls.sector()), (4, 4));
    }
    turn(&mut halls, 3);
    assert_eq!((halls.edges(), halls.sector()), (3, 3));
    assert_eq!(halls.electrical_speed::<f64>(), 0.0);
}

#[test]
fn an_illegal_code_is_told_and_not_believed() {
    let mut halls = at_sector(0);
    for sector in [1, 2, 3] {
        wait(&mut halls, 9);
        turn(&mut halls, sector);
    }
    let before = halls;
    for code in [0, 7, 8, 255] {
        assert_eq!(halls.update(HallCode(code)), Err(HallFault::Illegal));
    }
    assert_eq!((halls.sector(), halls.edges(), halls.interval()), (3, 3, before.interval()));
    // time has gone on, and the edge that was on its way is taken as it comes
    assert_eq!(halls.since_edge(), 4);
    wait(&mut halls, 5);
    turn(&mut halls, 4);
    assert_eq!((halls.edges(), halls.interval()), (4, 60));
}

#[test]
fn a_skipped_sector_is_told_and_the_new_place_believed() {
    for (to, edges) in [(2, 2), (4, -2), (3, 0)] {
        let mut halls = at_sector(0);
        for sector in [4, 5, 0] {
            wait(&mut halls, 9);
            let _ = halls.update(HallCode::of_sector(sector));
        }
        halls.edges = 0;
        assert_eq!(halls.update(HallCode::of_sector(to)), Err(HallFault::Skipped), "{to}");
        assert_eq!((halls.sector(), halls.edges(), halls.since_edge()), (to, edges, 0));
        assert_eq!((halls.electrical_speed::<f64>(), halls.interval()), (0.0, 0));
        turn(&mut halls, (to + 1) % 6);
        assert_eq!(halls.edges(), edges + 1);
    }
}

#[test]
fn when_the_edges_stop_the_speed_falls_as_the_time_grows_and_is_0_after_50_ms() {
    let mut halls = at_sector(0);
    for sector in [1, 2, 3, 4, 5, 0, 1] {
        wait(&mut halls, 39);
        turn(&mut halls, sector);
    }
    let steady = halls.electrical_speed::<f64>();
    assert!((steady - FRAC_PI_3 / 40.0).abs() < 1e-15, "{steady}");
    for n in 1..REST {
        wait(&mut halls, 1);
        let speed = halls.electrical_speed::<f64>();
        // as it was until the edge is a quarter late, and then no more than a late edge leaves room for
        let most = 1.25 * FRAC_PI_3 / f64::from(n);
        assert!((speed - steady.min(most)).abs() < 1e-15, "{n}: {speed}");
        // the angle goes to the end of the sector and stays there
        let passed = (FRAC_PI_3 * (f64::from(n) + 0.5) / 40.0).min(FRAC_PI_3);
        assert!((ahead(halls.angle(), FRAC_PI_3 - FRAC_PI_6) - passed).abs() <= 2.0 * FINE, "{n}: {passed}");
    }
    wait(&mut halls, 1);
    assert_eq!((halls.electrical_speed::<f64>(), halls.interval(), halls.ahead::<f64>()), (0.0, 0, 0.0));
    assert!(ahead(halls.angle(), FRAC_PI_3).abs() <= FINE);
    wait(&mut halls, 100_000);
    assert_eq!((halls.since_edge(), halls.edges()), (u16::MAX, 7));
    // the first edge after a rest tells no speed, the second does
    turn(&mut halls, 2);
    assert_eq!(halls.interval(), 0);
    wait(&mut halls, 9);
    turn(&mut halls, 3);
    assert_eq!(halls.interval(), 60);
}

#[test]
fn a_rotor_that_was_never_seen_to_turn_is_in_the_middle_of_its_sector() {
    for sector in 0..6 {
        let mut halls = at_sector(sector);
        assert!(ahead(halls.angle(), f64::from(sector) * FRAC_PI_3).abs() <= FINE);
        wait(&mut halls, 3);
        assert_eq!((halls.electrical_speed::<f64>(), halls.edges(), halls.interval()), (0.0, 0, 0));
    }
}

#[test]
fn robot_and_host_are_told_the_same_angle_from_the_recorded_code() {
    let mut rotor = Rotor::at(1.0);
    let mut halls = rotor.halls();
    for _ in 0..3000 {
        rotor.angle += 0.05;
        let _ = halls.update(rotor.code());
        assert_eq!(halls.angle::<f32>(), angle_of_code::<f32>(halls.angle_code()));
        // a rounding of the constant and one of the product
        assert!((f64::from(halls.angle::<f32>()) - halls.angle::<f64>()).abs() <= 8e-7);
        assert!((f64::from(halls.electrical_speed::<f32>()) - halls.electrical_speed::<f64>()).abs() <= 1e-8);
    }
}
