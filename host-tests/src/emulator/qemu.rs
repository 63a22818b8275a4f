//! # QEMU: an image on `netduinoplus2`, an STM32F405 without peripherals worth the name
//!
//! The image opens two files in the working folder by semihosting; here they are named pipes. Both are opened for
//! reading and writing on this side, so that no open waits for the other; that an image has ended is told by its
//! process.

use std::fs::{File, OpenOptions};
use std::io::{Read, Write};
use std::path::Path;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

use firmware::exchange::{DOWN_FILE, DownFrame, UP_FILE, UpFrame};
use rustix::event::{PollFd, PollFlags, Timespec, poll};
use rustix::fs::{CWD, Mode, mkfifoat};
use tempfile::TempDir;

use super::program::{BoardProgram, RunError};

/// The emulator.
pub const PROGRAM: &str = "qemu-system-arm";

/// What it is called with, before its clock and the image.
pub const OPTIONS: [&str; 9] = [
    "-M",
    "netduinoplus2",
    "-nographic",
    "-monitor",
    "none",
    "-serial",
    "none",
    "-semihosting-config",
    "enable=on,target=native",
];

/// How often a waiting host looks whether the emulator still lives [ms].
const POLL_MS: i64 = 20;

/// The file that what it says goes to.
const CONSOLE_FILE: &str = "said";

/// An image that runs. It is ended when this is dropped.
#[derive(Debug)]
pub struct Qemu {
    child: Child,
    up: File,
    down: File,
    folder: TempDir,
    timeout: Duration,
    exchanges: u64,
}

impl Qemu {
    /// Starts an image. `timeout` is how long it may think about one period. An instruction takes a nanosecond, on every
    /// machine.
    ///
    /// # Errors
    /// [`RunError::NotStarted`] if pipes or process cannot be made.
    pub fn start(image: &Path, timeout: Duration) -> Result<Self, RunError> {
        Self::start_slowed(image, timeout, 0)
    }

    /// The same with instructions that take 2^`shift` nanoseconds.
    ///
    /// # Errors
    /// As those of [`Qemu::start`].
    pub fn start_slowed(image: &Path, timeout: Duration, shift: u8) -> Result<Self, RunError> {
        let image = image.canonicalize().map_err(not_started(format!("the image {}", image.display())))?;
        let mut command = Command::new(PROGRAM);
        command.args(OPTIONS).args(["-icount", &format!("shift={shift},sleep=off")]).arg("-kernel").arg(&image);
        Self::launch(command, timeout)
    }

    fn launch(mut command: Command, timeout: Duration) -> Result<Self, RunError> {
        let folder = tempfile::tempdir().map_err(not_started("a folder for the emulator".into()))?;
        let pipe = |name: &str| {
            let path = folder.path().join(name);
            mkfifoat(CWD, &path, Mode::RUSR | Mode::WUSR)
                .map_err(std::io::Error::from)
                .and_then(|()| OpenOptions::new().read(true).write(true).open(&path))
                .map_err(not_started(format!("the pipe {}", path.display())))
        };
        let (up, down) = (pipe(UP_FILE)?, pipe(DOWN_FILE)?);
        let said =
            File::create(folder.path().join(CONSOLE_FILE)).map_err(not_started("a file for its words".into()))?;
        let also = said.try_clone().map_err(not_started("a file for its words".into()))?;
        let name = command.get_program().to_string_lossy().into_owned();
        let child = command
            .current_dir(folder.path())
            .stdin(Stdio::null())
            .stdout(said)
            .stderr(also)
            .spawn()
            .map_err(not_started(format!("{name} (Debian: apt-get install qemu-system-arm)")))?;
        Ok(Self { child, up, down, folder, timeout, exchanges: 0 })
    }

    /// What the emulator and the image have said so far; bytes of defmt are shown as they can be.
    pub fn console(&self) -> String {
        String::from_utf8_lossy(&self.console_bytes()).into_owned()
    }

    /// The same as bytes, for a decoder of defmt.
    pub fn console_bytes(&self) -> Vec<u8> {
        std::fs::read(self.folder.path().join(CONSOLE_FILE)).unwrap_or_default()
    }

    /// Waits for the end of an image that ends by itself or has been told to.
    ///
    /// # Errors
    /// [`RunError::Silent`] if it does not end in time.
    pub fn wait(&mut self) -> Result<ExitStatus, RunError> {
        let began = Instant::now();
        loop {
            if let Some(status) = self.child.try_wait().map_err(RunError::Exchange)? {
                return Ok(status);
            }
            if began.elapsed() > self.timeout {
                return Err(self.silent(began.elapsed()));
            }
            std::thread::sleep(Duration::from_millis(POLL_MS as u64 / 4));
        }
    }

    /// Tells the image to end, in the period that it has just asked for, and waits until it has.
    ///
    /// # Errors
    /// [`RunError::Silent`] if it does not end in time, [`RunError::Ended`] if it ends with a failure.
    pub fn end(&mut self, last: &DownFrame) -> Result<(), RunError> {
        self.down(&DownFrame { end: true, ..*last })?;
        let status = self.wait()?;
        if status.success() { Ok(()) } else { Err(self.ended(status)) }
    }

    /// Waits until there is something to read.
    fn wait_readable(&mut self) -> Result<(), RunError> {
        let began = Instant::now();
        let glance = Timespec { tv_sec: 0, tv_nsec: POLL_MS * 1_000_000 };
        loop {
            let ready = poll(&mut [PollFd::new(&self.up, PollFlags::IN)], Some(&glance));
            match ready {
                Ok(0) => {}
                Ok(_) => return Ok(()),
                Err(rustix::io::Errno::INTR) => continue,
                Err(why) => return Err(RunError::Exchange(why.into())),
            }
            if let Some(status) = self.child.try_wait().map_err(RunError::Exchange)? {
                // its last words may have come between the two looks
                let left = poll(&mut [PollFd::new(&self.up, PollFlags::IN)], Some(&Timespec::default()));
                return if left == Ok(1) { Ok(()) } else { Err(self.ended(status)) };
            }
            if began.elapsed() > self.timeout {
                return Err(self.silent(began.elapsed()));
            }
        }
    }

    fn ended(&self, status: ExitStatus) -> RunError {
        RunError::Ended { how: status.to_string(), exchanges: self.exchanges, said: self.console() }
    }

    fn silent(&self, waited: Duration) -> RunError {
        RunError::Silent { waited, exchanges: self.exchanges, said: self.console() }
    }
}

fn not_started(what: String) -> impl FnOnce(std::io::Error) -> RunError {
    move |why| RunError::NotStarted { what, why }
}

impl BoardProgram for Qemu {
    fn up(&mut self) -> Result<UpFrame, RunError> {
        let mut bytes = [0; UpFrame::LEN];
        let mut have = 0;
        while have < bytes.len() {
            self.wait_readable()?;
            have += self.up.read(&mut bytes[have..]).map_err(RunError::Exchange)?;
        }
        self.exchanges += 1;
        Ok(UpFrame::from_bytes(&bytes))
    }

    fn down(&mut self, down: &DownFrame) -> Result<(), RunError> {
        // far less than a pipe holds: this does not wait, and what a dead image does not take is found at the next `up`
        self.down.write_all(&down.to_bytes()).map_err(RunError::Exchange)
    }
}

impl Drop for Qemu {
    fn drop(&mut self) {
        // it may have ended by itself
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use firmware::codes::Codes;
    use firmware::exchange::LinkBytes;
    use model_core::control::calibration::AdcCode;
    use model_core::control::halls::HallCode;
    use model_core::link::sensor_codes::SensorCodes;

    fn down() -> DownFrame {
        let phases = [[AdcCode(2048); 3]; 4];
        let codes = Codes { phases, bus: AdcCode(1354), halls: [HallCode(1); 4], driver_fault: false };
        let (link, sensors) = (LinkBytes::default(), SensorCodes::default());
        DownFrame { codes, end: false, crash: None, burn_current: 0, burn_motion: 0, link, sensors }
    }

    /// A shell in the emulator's place.
    fn shell(script: &str, timeout: Duration) -> Qemu {
        let mut command = Command::new("sh");
        command.args(["-c", script]);
        Qemu::launch(command, timeout).expect("a shell")
    }

    #[test]
    fn frames_go_both_ways_and_the_end_is_waited_for() {
        // an up frame of zeros, a down frame read, another up frame, and what is left
        let script = "exec 3>omni-up 4<omni-down; head -c 44 /dev/zero >&3; head -c 58 <&4 >seen; \
                      head -c 44 /dev/zero >&3; head -c 58 <&4 >seen; cat seen";
        let mut qemu = shell(script, Duration::from_secs(20));
        assert_eq!(qemu.up().expect("a frame"), UpFrame::default());
        qemu.down(&down()).expect("taken");
        assert_eq!(qemu.up().expect("a frame"), UpFrame::default());
        qemu.end(&down()).expect("it ends well");
        assert_eq!(qemu.console_bytes(), DownFrame { end: true, ..down() }.to_bytes());
    }

    #[test]
    fn one_that_ends_early_is_told_with_its_last_words() {
        let mut qemu = shell("echo no such machine >&2; exit 3", Duration::from_secs(20));
        let why = qemu.up().expect_err("there is nobody").to_string();
        assert!(why.contains("ended (exit status: 3) after 0 exchanges, unasked; it said: no such machine"), "{why}");
    }

    #[test]
    fn one_that_hangs_is_told_and_ended() {
        let mut qemu = shell("exec sleep 60", Duration::from_millis(100));
        let began = Instant::now();
        let why = qemu.up().expect_err("it sleeps").to_string();
        assert!(why.contains("hangs") && why.contains("it said: nothing"), "{why}");
        drop(qemu);
        // far below the minute that it would have slept
        assert!(began.elapsed() < Duration::from_secs(20));
    }

    #[test]
    fn an_image_that_is_not_there_is_named() {
        let why = Qemu::start(Path::new("no/such.elf"), Duration::ZERO).expect_err("no file").to_string();
        assert!(why.starts_with("the image no/such.elf: "), "{why}");
    }
}
