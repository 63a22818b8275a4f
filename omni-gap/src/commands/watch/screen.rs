//! The terminal: taken, drawn on, and given back whatever happens.

use std::io::{self, Write};
use std::sync::atomic::Ordering;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::time::Duration;

use crossterm::event::{self, Event, KeyCode, KeyEvent, KeyEventKind, KeyModifiers};
use omni_gap::Error;
use omni_gap::api::News;
use ratatui::DefaultTerminal;

use super::picture::draw;
use super::view::View;
use crate::commands::cli_error::CliError;
use crate::commands::told_to_end::{Also, told_to_end};

/// How long a look at the keys and at the news waits.
const LOOK: Duration = Duration::from_millis(50);

/// News that may wait for the screen; who reads waits then.
const WAITING: usize = 64;

/// What a key asks for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Key {
    Quit,
    Pause,
}

/// Shows the news of a work until it ends, or a person has seen enough: nobody then takes news any more.
pub fn shown<T: Send>(view: View, work: impl FnOnce(SyncSender<News>) -> T + Send) -> Result<T, CliError> {
    let (sender, news) = mpsc::sync_channel(WAITING);
    std::thread::scope(|scope| {
        let worker = scope.spawn(|| work(sender));
        let drawn = {
            let mut terminal = Terminal::taken()?;
            drawn(&mut terminal.0, view, news)
        };
        let done = worker.join().unwrap_or_else(|why| std::panic::resume_unwind(why));
        drawn.map_err(refused)?;
        Ok(done)
    })
}

/// The terminal in a state of its own, which ends with this value: on return, on an error, and where a panic unwinds. A panic
/// also finds the hook that `ratatui` leaves, so that its message is read on the terminal as it was.
struct Terminal(DefaultTerminal);

impl Terminal {
    fn taken() -> Result<Self, CliError> {
        ratatui::try_init().map(Self).map_err(refused)
    }
}

impl Drop for Terminal {
    fn drop(&mut self) {
        ratatui::restore();
    }
}

fn refused(why: io::Error) -> CliError {
    Error::output(std::path::Path::new("the terminal"), why.to_string(), "Ask for lines with --plain").into()
}

/// Draws what is new until the news end, a person has seen enough, or the program is told to end.
fn drawn(terminal: &mut DefaultTerminal, mut view: View, news: Receiver<News>) -> io::Result<()> {
    let mut still: Option<View> = None;
    let told = told_to_end(Also::Nothing)?;
    while !told.load(Ordering::Relaxed) {
        terminal.draw(|frame| draw(frame, still.as_ref().unwrap_or(&view)))?;
        match news.recv_timeout(LOOK) {
            Ok(first) => {
                let rings =
                    std::iter::once(first).chain(news.try_iter()).fold(false, |rings, next| view.take(next) | rings);
                if rings {
                    io::stdout().write_all(b"\x07")?;
                    io::stdout().flush()?;
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(()),
        }
        while event::poll(Duration::ZERO)? {
            let Event::Key(key) = event::read()? else { continue };
            match asked(key) {
                Some(Key::Quit) => return Ok(()),
                Some(Key::Pause) => still = still.is_none().then(|| View { paused: true, ..view.clone() }),
                None => {}
            }
        }
    }
    Ok(())
}

/// What a key asks for. A terminal in this state tells Ctrl-C as a key.
fn asked(key: KeyEvent) -> Option<Key> {
    let control = key.modifiers.contains(KeyModifiers::CONTROL);
    match key.code {
        _ if key.kind == KeyEventKind::Release => None,
        KeyCode::Char('c') if control => Some(Key::Quit),
        KeyCode::Char('q') | KeyCode::Esc => Some(Key::Quit),
        KeyCode::Char('p' | ' ') => Some(Key::Pause),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_quit_and_pause() {
        let key = |code, modifiers| asked(KeyEvent::new(code, modifiers));
        for code in [KeyCode::Char('q'), KeyCode::Esc] {
            assert_eq!(key(code, KeyModifiers::NONE), Some(Key::Quit));
        }
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::CONTROL), Some(Key::Quit));
        assert_eq!(key(KeyCode::Char('c'), KeyModifiers::NONE), None);
        assert_eq!(key(KeyCode::Char('p'), KeyModifiers::NONE), Some(Key::Pause));
    }
}
