//! `man`: the pages of the manual.

use std::path::PathBuf;

use omni_gap::Error;
use omni_gap::log::write_whole;

use super::answer::{AnswerForm, FilesWritten};
use super::console::Console;
use super::done::{DONE, Done};
use super::output_path::{self, NewFolder};

/// Write the pages of the manual, one a command: `omni-gap man ~/.local/share/man/man1`, then `man omni-gap-diagnose`
#[derive(Debug, clap::Args)]
pub struct Man {
    /// The folder to write them into, made if need be
    #[arg(value_name = "DIR")]
    out: PathBuf,

    #[command(flatten)]
    form: AnswerForm,
}

impl Man {
    /// Does it, for a program with these commands.
    pub fn run(&self, mut program: clap::Command, console: &Console) -> Done {
        program.build();
        let commands = std::iter::once(&program).chain(program.get_subcommands());
        let pages: Vec<clap_mangen::Man> = commands.map(|command| clap_mangen::Man::new(command.clone())).collect();
        let names: Vec<String> = pages.iter().map(clap_mangen::Man::get_filename).collect();
        output_path::folder(&self.out, &names.iter().map(String::as_str).collect::<Vec<_>>())?;
        let folder = NewFolder::make_with_files(&self.out)?;
        let mut files = Vec::new();
        for (page, name) in pages.iter().zip(names) {
            let (mut text, file) = (Vec::new(), self.out.join(name));
            page.render(&mut text).map_err(|why| Error::output(&file, why.to_string(), "Name another folder"))?;
            write_whole(&file, &text)?;
            files.push(file);
        }
        folder.keep();
        let said = format!("{} pages written to {}\n", files.len(), self.out.display());
        self.form.say(console, &said, &FilesWritten::of(files))?;
        Ok(DONE)
    }
}
