//! A question to a person at the terminal.

use std::io::{BufRead, Write};

/// What is answered to a question, without the spaces around it; none where nobody answers any more.
pub fn prompt(question: &str, input: &mut impl BufRead, output: &mut impl Write) -> Option<String> {
    let mut line = String::new();
    let read = write!(output, "{question}").and_then(|()| output.flush()).and_then(|()| input.read_line(&mut line));
    (read.unwrap_or(0) > 0).then(|| line.trim().to_owned())
}
