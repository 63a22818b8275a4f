//! The page of faults, and of kills.

use std::fmt::Write;

use super::fault::Fault;
use super::kills::Kills;
use super::outcome::Outcome;

/// Characters of a message that are shown.
const SHOWN: usize = 260;

/// The page; `killed` is how often at random moments, and how often at files.
pub fn page(faults: &[(&Fault, Outcome)], kills: &[Kills], killed: [usize; 2]) -> String {
    let mut page = String::from(
        "# Faults of the world around the program\n\n\
         Each is staged in a folder of its own (`host-tests/src/fault_injection/`), the command runs as a process. Promised of all: exit code 2 \
         and one message that names what it\nis about, or the answer where nothing is wrong with it; nothing half-written, nothing lost; memory \
         within bounds (of tables: ten times the\ninput). *Memory*: the largest resident as seen while it ran (–: not seen);\n*time*: of the build that the tests have, on two cores.\n\n\
         | fault | command | what happens | memory | time |\n|---|---|---|---|---|\n",
    );
    for (fault, outcome) in faults {
        let cost = |value: Option<f64>, unit: &str, digits: usize| {
            value.map_or("–".to_owned(), |value| format!("{value:.digits$} {unit}"))
        };
        let (memory, time) = (cost(outcome.megabytes, "MB", 0), cost(outcome.seconds, "s", 2));
        let (command, happens) = (cell(&outcome.command), cell(&outcome.happens));
        let _ = writeln!(page, "| {} | {} | {happens} | {memory} | {time} |", cell(fault.what), code(&command));
    }
    let [random, at_files] = killed;
    let _ = write!(
        page,
        "\n## Killed\n\nSIGKILL at random moments of the run ({random} times), and as soon as a file of the output is being written \
         ({at_files} times). After each, every file\nthat is there is whole; the same command, asked again, leaves the same bytes, and nothing \
         that was not finished.\n\n\
         | command | length of a run | tries | killed while it ran | an unfinished file was left | files half-written | other bytes when asked \
         again |\n|---|---|---|---|---|---|---|\n"
    );
    for Kills { command, seconds, tried, killed, unfinished, broken } in kills {
        let [half, others] =
            ["half-written", "bytes are others"].map(|what| broken.iter().filter(|why| why.contains(what)).count());
        let _ =
            writeln!(page, "| `{command}` | {seconds:.2} s | {tried} | {killed} | {unfinished} | {half} | {others} |");
    }
    page
}

fn code(command: &str) -> String {
    if command == "–" { command.to_owned() } else { format!("`{command}`") }
}

/// A text as it stands in a cell: in one line, and no longer than a person reads.
fn cell(text: &str) -> String {
    let text = text.replace('|', "\\|").replace('\n', " ");
    let count = text.chars().count();
    if count <= SHOWN {
        return text;
    }
    let part = |from: usize, to: usize| text.chars().skip(from).take(to - from).collect::<String>();
    format!("{} … {}", part(0, SHOWN / 2), part(count - SHOWN / 2, count))
}
