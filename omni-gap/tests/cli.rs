//! The command, run as a process on files.

#[path = "cli/answers.rs"]
mod answers;
#[path = "cli/bad_input.rs"]
mod bad_input;
#[path = "cli/bench.rs"]
mod bench;
#[path = "cli/compare.rs"]
mod compare;
#[path = "cli/experiments.rs"]
mod experiments;
#[path = "cli/explain.rs"]
mod explain;
#[path = "cli/fleet.rs"]
mod fleet;
#[path = "cli/folders.rs"]
mod folders;
#[path = "cli/foreign.rs"]
mod foreign;
#[path = "cli/frames.rs"]
mod frames;
#[path = "cli/json.rs"]
mod json;
#[path = "cli/manners.rs"]
mod manners;
#[path = "cli/map.rs"]
mod map;
#[path = "cli/map_clocks.rs"]
mod map_clocks;
#[path = "cli/new.rs"]
mod new;
#[path = "cli/next.rs"]
mod next;
#[path = "cli/record_vision.rs"]
mod record_vision;
#[path = "cli/robot.rs"]
mod robot;
#[path = "cli/robot_verbs.rs"]
mod robot_verbs;
#[path = "cli/selftest.rs"]
mod selftest;
#[path = "cli/streamed.rs"]
mod streamed;
#[path = "cli/validate.rs"]
mod validate;
#[path = "cli/vision.rs"]
mod vision;
#[path = "cli/watch.rs"]
mod watch;
