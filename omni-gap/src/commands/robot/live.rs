//! A drive that is watched: by how much robot and model are apart, on the screen of `omni-gap watch` or line by line.

use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{self, Sender};

use omni_gap::Error;
use omni_gap::api::{News, RobotFile, WatchFeed, Watched};
use omni_gap::log::records::capture::Progress;
use omni_gap::watch::Rule;
use omni_gap::wire::line::Line;
use omni_gap::wire::robot::{Driven, Leg, drive};
use omni_gap::wire::source::End;

use crate::commands::cli_error::CliError;
use crate::commands::console::Console;
use crate::commands::watch::lines::{Form, Lines, end};
use crate::commands::watch::screen;
use crate::commands::watch::view::View;

/// Drives leg by leg while a person looks; the line keeps its bytes. Who has seen enough ends the drive.
pub fn driven(
    line: &mut Line,
    legs: &[Leg],
    robot: &RobotFile,
    told_to_end: &AtomicBool,
    console: &Console,
) -> Result<Driven, CliError> {
    let rule = Rule::default();
    let from = line.place().display().to_string();
    let mut work = |each: &mut (dyn FnMut(News) -> bool + Send)| watched(line, legs, robot, told_to_end, each);
    let (driven, watched) = if io::stdout().is_terminal() && !console.is_quiet() {
        screen::shown(View::new(&robot.name, &from, rule), |news| work(&mut |new| news.send(new).is_ok()))??
    } else {
        let mut lines = Lines::new(Form::Text, rule, console);
        // who reads the lines may go away; the drive goes on
        work(&mut |news| lines.say(&news).is_ok())?
    };
    console.say(&end(&watched, rule.window_s))?;
    Ok(driven)
}

/// Drives, and watches what comes: each in its own thread, as a robot does not wait for a window to be judged.
fn watched(
    line: &mut Line,
    legs: &[Leg],
    robot: &RobotFile,
    told_to_end: &AtomicBool,
    each: &mut (dyn FnMut(News) -> bool + Send),
) -> Result<(Driven, Watched), CliError> {
    let mut feed = WatchFeed::new(robot, &line.place(), Rule::default());
    let (bytes, came) = mpsc::channel();
    let enough = AtomicBool::new(false);
    std::thread::scope(|scope| {
        let driver = scope.spawn(|| {
            let bytes: Sender<Vec<u8>> = bytes;
            drive(line, legs, |look| {
                let heard = bytes.send(look.bytes.to_vec()).is_ok();
                heard && !enough.load(Ordering::Relaxed) && !told_to_end.load(Ordering::Relaxed)
            })
        });
        let fed = came.iter().try_for_each(|bytes| {
            let progress = feed.take(&bytes, &mut *each)?;
            enough.fetch_or(progress == Progress::Enough, Ordering::Relaxed);
            Ok::<(), Error>(())
        });
        // without a listener the drive ends
        drop(came);
        let driven = driver.join().unwrap_or_else(|why| std::panic::resume_unwind(why))?;
        fed?;
        Ok((driven, feed.watched(End::Enough)))
    })
}
