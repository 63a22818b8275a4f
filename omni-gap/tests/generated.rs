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

#[test]
fn every_command_answers_or_refuses_whatever_it_is_given() {
    let cases = std::env::var("GENERATED_SESSIONS").ok().and_then(|text| text.parse().ok()).unwrap_or(SESSIONS);
    let config = Config { cases, max_shrink_iters: 64, failure_persistence: None, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    runner.run(&spoiled(), |session| answers_or_refuses(&session)).unwrap_or_else(|why| panic!("{why}"));
}
