//! # Images: errands that build an image and let it run

use std::ffi::OsString;

use crate::line::Line;
use crate::{steps, tool};

/// The emulator, and the images for it.
fn emulated_images() -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    Line::of(steps::EMULATED_IMAGES).announced()
}

/// The image in QEMU, in the loop with a robot.
pub fn pil(_: &[OsString]) -> Result<(), String> {
    emulated_images()?;
    steps::IN_LOOP.into_iter().try_for_each(|command| Line::of(command).announced())
}

/// A robot without a board.
pub fn robot(address: &[OsString]) -> Result<(), String> {
    emulated_images()?;
    address.iter().fold(Line::of(steps::ROBOT), Line::word).announced()
}

/// The image on a slow processor.
pub fn margin(_: &[OsString]) -> Result<(), String> {
    emulated_images()?;
    Line::of(steps::MARGIN).announced()
}

/// A modern robot on many seeds, a few of them in the image.
pub fn modern(_: &[OsString]) -> Result<(), String> {
    emulated_images()?;
    Line::of(steps::MODERN).announced()
}

/// What is typed on the first morning.
pub fn morning(_: &[OsString]) -> Result<(), String> {
    emulated_images()?;
    steps::MORNING.iter().try_for_each(|command| Line::of(command).announced())
}

/// Bits and instructions of the images.
pub fn emulate(_: &[OsString]) -> Result<(), String> {
    emulated_images()?;
    Line::of(steps::EMULATE).announced()
}

/// The board's image, measured.
pub fn image(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    Line::of(steps::BOARD_IMAGE).announced()?;
    Line::of(steps::CHECK_IMAGE).announced()
}

/// The board's image on a model of its chip.
pub fn chip(_: &[OsString]) -> Result<(), String> {
    tool::ensure(tool::TOOLS)?;
    [steps::BOARD_IMAGE, steps::BOARD_TESTS, steps::CHIP]
        .into_iter()
        .try_for_each(|command| Line::of(command).announced())
}
