//! `watch`: by how much a robot and its model are apart, while it drives.

pub mod lines;
mod picture;
pub mod screen;
mod trend;
pub mod view;

use std::io::{self, IsTerminal};
use std::path::PathBuf;
use std::sync::mpsc::SyncSender;
use std::time::Duration;

use omni_gap::api::{News, Watching, known_effects, watch};
use omni_gap::log::RobotFile;
use omni_gap::watch::Rule;
use omni_gap::wire::source::Source;

use super::cli_error::CliError;
use super::console::Console;
use super::done::{DONE, Done};
use super::given;
pub use lines::Line;
use lines::{Form, Lines};
use view::View;

/// Watch a robot that streams, or a file of records that grows: errors of the model by stage, and an alarm when one leaves its
/// floor
#[derive(Debug, clap::Args)]
pub struct WatchRobot {
    /// Where the frames come from; a file is followed while it grows
    #[arg(long, value_name = "FILE | tcp:HOST:PORT | DEVICE")]
    from: String,

    /// Speed of a serial line
    #[arg(long, value_name = "BAUD", default_value_t = 2_000_000)]
    baud: u32,

    /// The robot's file, best one whose numbers were fitted: `omni-gap identify`
    #[arg(long, value_name = "ROBOT.toml")]
    robot: PathBuf,

    /// Length of the windows that are judged
    #[arg(long, value_name = "SECONDS", default_value_t = Rule::default().window_s, value_parser = window)]
    window: f64,

    /// How long nothing may come before the watch ends
    #[arg(long, value_name = "SECONDS", default_value_t = 5.0, value_parser = given::seconds)]
    patience: f64,

    /// One line a window, as where the output is no terminal
    #[arg(long)]
    plain: bool,

    /// One JSON object a line, a window each, in place of text; `omni-gap schema watch` tells their form
    #[arg(long, conflicts_with = "plain")]
    json: bool,
}

impl WatchRobot {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let robot = RobotFile::load(&self.robot, &known_effects())?;
        let source = Source::named(&self.from);
        let rule = Rule { window_s: self.window, ..Rule::default() };
        let patience = Duration::try_from_secs_f64(self.patience).unwrap_or(Duration::MAX);
        let watching = Watching { source: &source, baud: self.baud, patience, robot: &robot, rule };
        let form = if self.json { Form::Json } else { Form::Text };
        if self.json || self.plain || console.is_quiet() || !io::stdout().is_terminal() {
            return by_line(&watching, Lines::new(form, rule, console));
        }
        // hands on all news until nobody takes them
        let work = |news: SyncSender<News>| watch(&watching, |new| news.send(new).is_ok());
        let watched = screen::shown(View::new(&robot.name, &self.from, rule), work)??;
        console.say(&lines::end(&watched, rule.window_s))?;
        Ok(DONE)
    }
}

/// Says a line a window.
fn by_line(watching: &Watching, mut lines: Lines) -> Done {
    let mut stop: Option<CliError> = None;
    let watched = watch(watching, |news| {
        lines.say(&news).unwrap_or_else(|why| {
            stop = Some(why);
            false
        })
    })?;
    match stop {
        Some(why) => Err(why),
        None => lines.finish(&watched).map(|()| DONE),
    }
}

/// A length of windows [s]: long enough for a restart to be smoothed, short enough that rows of it are kept.
fn window(text: &str) -> Result<f64, String> {
    const LENGTHS_S: std::ops::RangeInclusive<f64> = 0.2..=60.0;
    match text.parse::<f64>() {
        Ok(x) if LENGTHS_S.contains(&x) => Ok(x),
        _ => Err(format!("expected {} to {} seconds, such as 1", LENGTHS_S.start(), LENGTHS_S.end())),
    }
}
