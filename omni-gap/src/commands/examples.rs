//! What a command is called with, for its help.

/// Examples of each command, one a line.
pub const EXAMPLES: [(&str, &[&str]); 24] = [
    ("demo", &["demo"]),
    (
        "diagnose",
        &[
            "diagnose my-robot --out report",
            "diagnose my-robot --also my-robot-two --without wheel_slip",
            "diagnose logs/*.csv --robot robot.toml --columns columns.toml --json",
        ],
    ),
    ("compare", &["compare before after --out compared", "compare my-robot --sim simulator.csv"]),
    ("fleet", &["fleet logs --out season", "fleet report season"]),
    ("next", &["next my-robot --duration 20 --out next"]),
    ("check", &["check my-robot", "check logs/run.csv --robot robot.toml --columns columns.toml"]),
    (
        "new",
        &[
            "new my-robot --layout plus --distance 0.09 --radius 0.03 --mass 2.4 --gear 5 --kv 380 --supply 12",
            "new my-robot --like robotino --mass 14",
        ],
    ),
    ("map", &["map drive.csv --robot robot.toml --out columns.toml", "map bag.mcap --robot robot.toml --yes"]),
    ("experiment", &["experiment robot.toml --out morning", "experiment robot.toml --rich --out scripts"]),
    (
        "identify",
        &["identify my-robot --out fitted.toml", "identify morning/session --experiment all --out fitted.toml"],
    ),
    ("predict", &["predict robot.toml run.csv --horizon 0.5 --out predicted.csv"]),
    ("validate", &["validate my-robot --out validation"]),
    ("simulate", &["simulate robot.toml --input run.csv --seed 1 --out simulated.csv"]),
    ("sensitivity", &["sensitivity robot.toml --out sensitivity"]),
    (
        "selftest",
        &[
            "selftest robot.toml",
            "selftest robot.toml --script run.csv --sensors w,pose --camera-rate 25 --out selftest",
        ],
    ),
    ("explain", &["explain", "explain wheel_slip --out slip.svg", "explain columns"]),
    ("export", &["export robot.toml --out block.bin", "export report/corrected_robot.toml --out robot.xml"]),
    ("record", &["record --from /dev/ttyACM0 --robot robot.toml --seconds 20 --out my-robot"]),
    (
        "robot",
        &[
            "robot status --to /dev/ttyACM0",
            "robot send report/corrected_robot.toml --to /dev/ttyACM0",
            "robot gyro robot.toml my-robot/runs/turned.rec --turns 10",
            "robot drive --leg 0.3,0,0,2 --leg 0,0,1,2 --to tcp:127.0.0.1:7000",
            "robot drive --leg 0.3,0,0,2 --to /dev/ttyACM0 --robot robot.toml --out my-robot --name ahead",
            "robot record --from /dev/ttyACM0 --robot robot.toml --out my-robot",
        ],
    ),
    (
        "watch",
        &[
            "watch --from /dev/ttyACM0 --robot my-robot/fitted.toml",
            "watch --from tcp:192.168.1.7:7000 --robot fitted.toml --window 2",
            "watch --from my-robot/runs/run.rec --robot fitted.toml --json",
        ],
    ),
    ("convert", &["convert robot.toml run.rec --out run.csv"]),
    ("completions", &["completions bash"]),
    ("man", &["man ~/.local/share/man/man1"]),
    ("schema", &["schema diagnose"]),
];

/// A program whose commands show their examples below their help.
pub fn with_examples(program: clap::Command) -> clap::Command {
    EXAMPLES.iter().fold(program, |program, (name, lines)| {
        let text: Vec<String> = lines.iter().map(|line| format!("  omni-gap {line}")).collect();
        program.mut_subcommand(name, |command| command.after_help(format!("Examples:\n{}", text.join("\n"))))
    })
}

#[cfg(test)]
mod tests {
    use clap::{CommandFactory, Parser};

    use super::*;
    use crate::commands::Cli;

    #[test]
    fn every_command_has_examples_and_each_can_be_typed() {
        for command in Cli::command().get_subcommands() {
            let lines: Vec<&str> = EXAMPLES
                .iter()
                .filter(|(name, _)| *name == command.get_name())
                .flat_map(|(_, lines)| *lines)
                .copied()
                .collect();
            assert!(!lines.is_empty(), "{}", command.get_name());
            for line in lines {
                let words = std::iter::once("omni-gap").chain(line.split(' '));
                Cli::try_parse_from(words).unwrap_or_else(|why| panic!("{line}: {why}"));
                assert!(line.starts_with(command.get_name()), "{line}");
            }
        }
    }

    #[test]
    fn help_shows_them() {
        let mut program = with_examples(Cli::command());
        let help = program.find_subcommand_mut("map").unwrap().render_help().to_string();
        assert!(help.contains("Examples:\n  omni-gap map drive.csv"), "{help}");
    }
}
