//! Robots that are described already.

/// A robot file of the examples.
#[derive(Debug)]
pub struct ReadyMade {
    pub name: &'static str,
    pub text: &'static str,
}

/// All of them.
static READY_MADE: [ReadyMade; 5] = [
    ReadyMade { name: "feup-3w", text: include_str!("../../../robots/feup-3w/robot.toml") },
    ReadyMade { name: "feup-4w", text: include_str!("../../../robots/feup-4w/robot.toml") },
    ReadyMade { name: "robotino", text: include_str!("../../../robots/robotino/robot.toml") },
    ReadyMade { name: "ssl", text: include_str!("../../../robots/ssl2018/robot.toml") },
    ReadyMade { name: "kiwi", text: include_str!("../../../robots/kiwi2026/robot.toml") },
];

/// The robot of this name.
pub fn named(name: &str) -> Result<&'static ReadyMade, String> {
    READY_MADE.iter().find(|robot| robot.name == name).ok_or_else(|| {
        let names: Vec<&str> = READY_MADE.iter().map(|robot| robot.name).collect();
        format!("known are {}; mecanum wheels are --layout mecanum", names.join(", "))
    })
}
