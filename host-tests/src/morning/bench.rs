//! A robot on its bench, and a shell beside it.

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};

use tempfile::TempDir;

/// The programs that a morning takes.
#[derive(Clone, Copy, Debug)]
pub struct Programs<'a> {
    /// `robot`, which serves a robot without a board
    pub robot: &'a Path,
    /// The image that it is to run
    pub image: &'a Path,
    /// `omni-gap`
    pub omni_gap: &'a Path,
}

/// A robot that was switched on, and a folder to work in.
#[derive(Debug)]
pub struct Bench {
    robot: Child,
    keys: ChildStdin,
    device: String,
    path: String,
    folder: TempDir,
}

/// What a shell said.
#[derive(Clone, Debug)]
pub struct Said {
    /// Whether its commands ended well.
    pub success: bool,
    /// Their words, of both kinds.
    pub text: String,
}

impl Bench {
    /// Switches a robot on; the folder has its file, `robot.toml`.
    ///
    /// # Errors
    /// What of it could not be started, in words.
    pub fn new(programs: &Programs, robot_file: &Path) -> Result<Self, String> {
        let folder = tempfile::tempdir().map_err(|why| format!("a folder: {why}"))?;
        let file = folder.path().join("robot.toml");
        std::fs::copy(robot_file, file).map_err(|why| format!("{}: {why}", robot_file.display()))?;
        let mut command = Command::new(programs.robot);
        command.arg(programs.image).arg("pty").stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut robot = command.spawn().map_err(|why| format!("{}: {why}", programs.robot.display()))?;
        let (keys, says) = (robot.stdin.take(), robot.stdout.take());
        let mut line = String::new();
        if let Some(says) = says {
            BufReader::new(says).read_line(&mut line).map_err(|why| format!("the robot: {why}"))?;
        }
        let device =
            line.split_whitespace().find_map(|word| word.strip_suffix(';').filter(|word| word.starts_with('/')));
        let device = device.ok_or_else(|| format!("the robot names no device: {line}"))?.to_owned();
        let programs = programs.omni_gap.parent().map(PathBuf::from).unwrap_or_default();
        let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap_or_default());
        let keys = keys.ok_or("the robot takes no keys")?;
        Ok(Self { robot, keys, device, path, folder })
    }

    /// Types commands.
    ///
    /// # Errors
    /// Where there is no shell.
    pub fn types(&self, commands: &str) -> Result<Said, String> {
        let output = Command::new("sh")
            .args(["-e", "-c", &format!("exec 2>&1\n{commands}")])
            .current_dir(self.folder.path())
            .env("PATH", &self.path)
            .env("ROBOT", &self.device)
            .stdin(Stdio::null())
            .output()
            .map_err(|why| format!("a shell: {why}"))?;
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        Ok(Said { success: output.status.success(), text })
    }

    /// Pulls the plug of the motors' supply for half a second.
    ///
    /// # Errors
    /// Where the robot is gone.
    pub fn pulls_the_plug(&mut self) -> Result<(), String> {
        self.keys.write_all(b"\n").and_then(|()| self.keys.flush()).map_err(|why| format!("the robot: {why}"))
    }
}

impl Drop for Bench {
    fn drop(&mut self) {
        // it may have ended by itself
        let _ = self.robot.kill();
        let _ = self.robot.wait();
    }
}
