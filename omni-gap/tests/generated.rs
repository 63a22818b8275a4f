//! Generated robot files and logs through every command: an error with its mend, or an answer; never a panic, never a
//! number that is none, never a command that does not end.

#[path = "cli/bench.rs"]
#[allow(dead_code)] // the command's other tests use the rest of it
mod bench;
#[path = "generated/commands.rs"]
mod commands;
#[path = "generated/spoil.rs"]
mod spoil;

use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};

use commands::answers_or_refuses;
use spoil::spoiled;

/// Sessions in a run of the tests; `GENERATED_SESSIONS` in the environment asks for more.
const SESSIONS: u32 = 300;

/// As many are tried at a time, each thread's with a seed of its own.
const THREADS: u8 = 2;

#[test]
fn every_command_answers_or_refuses_whatever_it_is_given() {
    let cases: u32 = std::env::var("GENERATED_SESSIONS").ok().and_then(|text| text.parse().ok()).unwrap_or(SESSIONS);
    let cases = cases.div_ceil(THREADS.into());
    std::thread::scope(|scope| {
        for seed in 0..THREADS {
            let config = Config { cases, max_shrink_iters: 64, failure_persistence: None, ..Config::default() };
            let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[seed; 32]);
            let run = |mut runner: TestRunner| runner.run(&spoiled(), |session| answers_or_refuses(&session));
            scope.spawn(move || run(TestRunner::new_with_rng(config, rng)).unwrap_or_else(|why| panic!("{why}")));
        }
    });
}
