//! `new`: a robot file to start from.

mod drawing;
mod ready_made;
mod starter;

use std::io::{BufRead, IsTerminal, Write};
use std::path::{Path, PathBuf};

use omni_gap::Error;
use omni_gap::known_effects;
use omni_gap::log::{RobotFile, write_whole};

use super::answer::{AnswerForm, FilesWritten};
use super::cli_error::CliError;
use super::console::{Console, wrapped};
use super::done::{DONE, Done};
use super::output_path;
use super::prompt::prompt;
use drawing::drawing;
use ready_made::ReadyMade;
use starter::{Layout, Starter};

/// Begin a session for a robot of one's own: a robot file with a drawing of it, in which guesses are marked as guesses
#[derive(Debug, clap::Args)]
pub struct New {
    /// The folder to make; robot.toml and runs/ will be in it
    #[arg(value_name = "SESSION")]
    folder: PathBuf,

    /// A robot that is described already, to be changed by the other options
    #[arg(long, value_name = "ROBOT", value_parser = ready_made::named, conflicts_with_all = ["layout", "angles"])]
    like: Option<&'static ReadyMade>,

    /// How the wheels stand
    #[arg(long, value_enum)]
    layout: Option<Layout>,

    /// Drive angles of the wheels instead, in degrees: where each rolls, from straight ahead to the left
    #[arg(
        long,
        value_name = "DEG,DEG,DEG",
        value_delimiter = ',',
        allow_hyphen_values = true,
        conflicts_with = "layout"
    )]
    angles: Option<Vec<f64>>,

    #[command(flatten)]
    starter: Starter,

    #[command(flatten)]
    form: AnswerForm,
}

impl New {
    /// Does it.
    pub fn run(&self, console: &Console) -> Done {
        let path = self.folder.join("robot.toml");
        if path.exists() {
            return Err(Error::output(&path, "there is one already", "Name another folder, or change that file").into());
        }
        output_path::folder(&self.folder, &["robot.toml"])?;
        let text = match self.like {
            Some(robot) => self.starter.changed(robot.text)?,
            None => self.text()?,
        };
        let robot = RobotFile::parse(&text, &path, &known_effects())?;
        let drawing = drawing(&robot.wheel);
        let runs = self.folder.join("runs");
        std::fs::create_dir_all(&runs).map_err(|why| Error::output(&runs, why.to_string(), "Name another folder"))?;
        write_whole(&path, format!("{}{text}", commented(&drawing)).as_bytes())?;
        let answer = FilesWritten::of(vec![path]);
        self.form.say(console, &(drawing + &next_steps(&self.folder, &text)), &answer)?;
        Ok(DONE)
    }

    /// A robot file of what was given, and of what is answered where somebody sits at the terminal.
    fn text(&self) -> Result<String, CliError> {
        let (mut layout, mut starter) = (self.layout, self.starter.clone());
        if std::io::stdin().is_terminal() {
            let (mut input, mut output) = (std::io::stdin().lock(), std::io::stderr());
            if layout.is_none() && self.angles.is_none() {
                let question = "How do the wheels stand: three, plus, x or mecanum";
                layout = Some(asked(question, &mut input, &mut output)?);
            }
            let is_mecanum = layout == Some(Layout::Mecanum);
            starter.ask(is_mecanum, &mut |question| asked(question, &mut input, &mut output))?;
        }
        let angles = match (&self.angles, layout) {
            (Some(angles), _) if matches!(angles.len(), 3 | 4) => angles.clone(),
            (Some(_), _) => {
                return Err(CliError::Unclear("--angles needs three angles or four, one for each wheel: 150,270,30"));
            }
            (None, Some(layout)) => layout.angles_deg(),
            (None, None) => return Err(CliError::Unclear(HOW)),
        };
        starter.text(&angles, layout == Some(Layout::Mecanum))
    }
}

const HOW: &str = "how do the wheels stand? Give --layout three, plus, x or mecanum, or --angles, or --like a robot that is \
    described already";

/// One answer; asked again while it cannot be read.
fn asked<T: std::str::FromStr>(
    question: &str,
    input: &mut impl BufRead,
    output: &mut impl Write,
) -> Result<T, CliError> {
    loop {
        let line = prompt(&format!("{question}? "), input, output).ok_or(CliError::Unclear(
            "the answers ended early; `omni-gap new --help` lists the options that give them",
        ))?;
        match line.parse() {
            Ok(answer) => return Ok(answer),
            Err(_) => {
                let _ = writeln!(output, "`{line}` cannot be read.");
            }
        }
    }
}

fn commented(text: &str) -> String {
    text.lines().map(|line| format!("# {line}").trim_end().to_owned() + "\n").collect::<String>() + "\n"
}

fn next_steps(folder: &Path, text: &str) -> String {
    let guesses = text.lines().filter(|line| line.contains("# a guess")).count();
    let mut said = format!("\nwritten to {}\n", folder.join("robot.toml").display());
    if guesses > 0 {
        said += &wrapped(
            0,
            &format!("{guesses} of its numbers are guesses, with a wide uncertainty: replace what you know."),
        );
    }
    let shown = folder.display();
    said += &format!(
        "\nNext: put recordings into {shown}/runs, then\n  omni-gap map {shown}/runs/LOG --robot {shown}/robot.toml --out \
         {shown}/columns.toml\n  omni-gap check {shown}\n  omni-gap diagnose {shown} --out REPORT\n"
    );
    said
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_that_cannot_be_read_is_asked_for_again() {
        let mut said = Vec::new();
        let answer: f64 = asked("Mass in kg", &mut "two\n2.5\n".as_bytes(), &mut said).unwrap();
        assert_eq!(answer, 2.5);
        assert_eq!(String::from_utf8(said).unwrap(), "Mass in kg? `two` cannot be read.\nMass in kg? ");
        assert!(asked::<f64>("Mass", &mut "".as_bytes(), &mut Vec::new()).is_err());
    }
}
