//! The board's own test, on a board: `cargo fw-test`. Bridges stay open and nothing turns by itself.
//!
//! The model's bits are in `hil_parity.rs`, an image of their own. Those tests that need a wire or a hand are in `by_hand.rs`: `cargo fw-hand`, after `firmware/HARDWARE.md` has been read.
#![no_std]
#![no_main]

mod on_board;

use panic_probe as _;

#[cfg(test)]
#[embedded_test::tests]
mod tests {
    use crate::on_board::{self, group, wait};
    use cortex_m::peripheral::NVIC;
    use defmt::{assert, assert_eq, info};
    use firmware::board::{self, Parts, pac::Interrupt};
    use firmware::codes::{Codes, MOTORS, PERIODS_PER_SECOND};
    use firmware::motion::MotionOutput;
    use firmware::offsets;
    use firmware::protection::TripLimits;
    use firmware::registers::timing;
    use firmware::winding_config::WindingConfig;
    use firmware::winding_signals::MotorSetpoints;
    use firmware::windings::Windings;
    use model_core::control::calibration::{AdcCode, Calibration};
    use model_core::control::current_loop::CurrentLoop;
    use model_core::control::halls::HallCode;

    /// The hall codes of a rotor that goes forward.
    const FORWARD: [u8; 6] = [1, 3, 2, 6, 4, 5];
    /// Cycles that polling for the end of a group may be late by.
    const POLL: u32 = 60;

    #[init]
    fn init() -> Parts {
        on_board::parts()
    }

    #[test]
    fn parts_come_up_asleep(_parts: Parts) {
        wait(1_000);
        assert_eq!(board::counters(), [0; MOTORS], "no timer has counted");
        assert!(!NVIC::is_pending(Interrupt::ADC), "no converter was triggered");
    }

    #[test]
    fn registers_hold_what_was_worked_out(mut parts: Parts) {
        parts.bridges.start();
        wait(200);
        for reading in board::readings() {
            assert_eq!(reading.is, reading.should, "{}", reading.name);
        }
    }

    #[test]
    fn one_group_ends_in_every_period(mut parts: Parts) {
        parts.bridges.start();
        group(&mut parts);
        let (mut last, mut worst) = (board::ticks(), 0);
        for _ in 0..PERIODS_PER_SECOND {
            group(&mut parts);
            let now = board::ticks();
            worst = worst.max(now.wrapping_sub(last).abs_diff(timing::PERIOD));
            last = now;
        }
        info!("groups are a period apart, {} cycles at worst", worst);
        assert!(worst <= 2 * POLL);
    }

    #[test]
    fn the_last_rank_ends_where_it_was_worked_out_to(mut parts: Parts) {
        parts.bridges.start();
        let (mut first, mut last) = (u32::MAX, 0);
        for _ in 0..1_000 {
            let (_, seen) = group(&mut parts);
            (first, last) = (first.min(seen), last.max(seen));
        }
        info!("groups end {} to {} cycles after the top, worked out {}", first, last, timing::TOP_TO_END);
        // the latency of the trigger is known to a cycle of the converters or two, 8 cycles each
        assert!(first + 16 >= timing::TOP_TO_END && last <= timing::TOP_TO_END + POLL);
    }

    #[test]
    fn every_timer_runs_one_rank_behind_the_one_before(mut parts: Parts) {
        parts.bridges.start();
        for _ in 0..100 {
            group(&mut parts);
            // all go down now; reading one after the other costs some cycles each
            let counts = board::counters();
            for pair in counts.windows(2) {
                let behind = pair[1] as i32 - pair[0] as i32;
                let off = behind - timing::RANK as i32;
                assert!((-24..=24).contains(&off), "{} cycles behind, worked out {}", behind, timing::RANK);
            }
        }
    }

    #[test]
    fn compare_counts_are_taken_at_the_latch_and_not_before(mut parts: Parts) {
        parts.bridges.start();
        for step in 1..100_u16 {
            let duty = f32::from(step) / 128.0;
            group(&mut parts);
            let [_, before] = board::pending();
            // the bridges stay open
            parts.bridges.drive(&[[duty, 0.5, 1.0 - duty]; MOTORS], 0);
            while board::cycles() < timing::PERIOD - timing::LATCH_BEFORE_TOP - 100 {}
            let [requested, got] = board::pending();
            assert_eq!(got, before, "not before the latch");
            while board::cycles() > 1_000 {}
            let [_, got] = board::pending();
            assert_eq!(got, requested, "after it");
        }
    }

    #[test]
    fn offsets_lie_near_the_middle(mut parts: Parts) {
        parts.bridges.start();
        let (mut sums, mut least, mut most) = ([[0_u32; 3]; MOTORS], [[u16::MAX; 3]; MOTORS], [[0_u16; 3]; MOTORS]);
        for _ in 0..offsets::PERIODS {
            let (codes, _) = group(&mut parts);
            for motor in 0..MOTORS {
                for phase in 0..3 {
                    let code = codes.phases[motor][phase].0;
                    sums[motor][phase] += u32::from(code);
                    least[motor][phase] = least[motor][phase].min(code);
                    most[motor][phase] = most[motor][phase].max(code);
                }
            }
        }
        for motor in 0..MOTORS {
            for phase in 0..3 {
                let mean = sums[motor][phase] as f32 / offsets::PERIODS as f32;
                let spread = most[motor][phase] - least[motor][phase];
                info!("motor {} phase {}: {} counts, spread {}", motor, phase, mean, spread);
                assert!(
                    (mean - offsets::MIDDLE).abs() < offsets::REACH,
                    "motor {} phase {}: {} counts",
                    motor,
                    phase,
                    mean
                );
                // the converter's own noise is a few counts; 0.1 A is 20
                assert!(spread < 20, "motor {} phase {}: {} counts from least to most", motor, phase, spread);
            }
        }
    }

    #[test]
    fn the_supply_is_steady(mut parts: Parts) {
        parts.bridges.start();
        let (first, _) = group(&mut parts);
        info!("supply: {} V", Calibration::<f32>::of_board(1).bus_voltage(first.bus));
        for _ in 0..1_000 {
            let (codes, _) = group(&mut parts);
            assert!(codes.bus.0.abs_diff(first.bus.0) < 40, "0.35 V");
        }
    }

    #[test]
    fn hall_lines_show_a_rotor_or_none(mut parts: Parts) {
        parts.bridges.start();
        let (codes, _) = group(&mut parts);
        for (motor, HallCode(code)) in codes.halls.into_iter().enumerate() {
            info!("motor {}: hall code {}", motor, code);
            // with nothing connected the pull-ups make it 7
            assert!((1..=7).contains(&code), "motor {}", motor);
        }
    }

    #[test]
    fn a_turn_of_four_windings_fits_its_time(mut parts: Parts) {
        let calibration = Calibration::of_board(7);
        let current_loop = CurrentLoop::new(1.0, 2.0e-4, calibration.amps_per_count, 6_000.0, calibration.period, 0.8);
        let setup = WindingConfig {
            wheels: MOTORS as u8,
            calibration,
            current_loop,
            six_step: false,
            limits: TripLimits { trip_counts: 2_000.0, least_supply: 1.0, most_supply: 35.0 },
            wheel_speed_per_electrical: 100.0,
            wiring: None,
        };
        let ask = MotorSetpoints { current: [1.0; MOTORS], voltage: [2.0; MOTORS], closed: true, enabled: 0b1111 };
        let mut windings = Windings::default();
        windings.apply(&MotionOutput { config: Some(setup), setpoints: ask, ..MotionOutput::default() });

        parts.bridges.start();
        let (mut most, mut driven) = (0, 0_u32);
        for period in 0..4_000_usize {
            group(&mut parts);
            let began = board::ticks();
            let read = parts.bridges.read();
            // codes of motors that turn, in place of those of motors that stand
            let hall = HallCode(FORWARD[period / 17 % 6]);
            let codes =
                Codes { phases: [[AdcCode(2048); 3]; MOTORS], bus: AdcCode(1354), halls: [hall; MOTORS], ..read };
            let drive = windings.tick(&Codes { driver_fault: false, ..codes });
            // whatever was decided: the bridges stay open
            parts.bridges.drive(&drive.duties, 0);
            most = most.max(board::ticks().wrapping_sub(began));
            driven += u32::from(drive.enabled == 0b1111);
        }
        info!("a turn takes {} cycles of {} that it may", most, timing::TURN);
        assert!(driven > 2_000, "all four would have been driven");
        assert!(most < timing::TURN);
    }

    #[test]
    fn the_store_keeps_what_it_is_given(mut parts: Parts) {
        let mut old = [0; 512];
        let stored = parts.flash_store.load();
        let len = stored.len().min(old.len());
        old[..len].copy_from_slice(&stored[..len]);
        assert!(parts.flash_store.save(b"a block of the test"));
        assert_eq!(parts.flash_store.load(), b"a block of the test");
        assert!(parts.flash_store.save(&old[..len]), "what was there before is put back");
        assert_eq!(parts.flash_store.load(), &old[..len]);
    }
}
