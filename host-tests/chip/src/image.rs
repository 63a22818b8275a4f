//! # Image: what of an ELF is flashed, and which lines of the source its instructions come from

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use object::read::elf::{ElfFile32, ProgramHeader};
use object::{LittleEndian, Object, ObjectSection, ObjectSymbol};

use crate::core::ChipError;

const FLASH_AT: u32 = 0x0800_0000;
const FLASH_END: u32 = 0x0810_0000;

/// An image.
#[derive(Debug)]
pub struct Image {
    /// The bytes from the beginning of the flash on
    pub bytes: Vec<u8>,
    /// The lines that a halfword of the image comes from, itself and what it was inlined into: (file, line)
    lines: Vec<Vec<(String, u32)>>,
    /// The tests that an image for a board has in it: name, and the address that runs it
    pub tests: Vec<(String, u32)>,
}

/// Which lines of the files in a folder were executed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Coverage {
    /// By file: the lines with code, and whether any instruction of it was executed
    pub files: BTreeMap<String, BTreeMap<u32, bool>>,
}

impl Image {
    /// Reads an ELF; lines are kept of files whose path has `of` in it, from there on.
    ///
    /// # Errors
    /// [`ChipError::Image`] where it cannot be read.
    pub fn read(path: &Path, of: &str) -> Result<Self, ChipError> {
        let wrong = |why: &dyn std::fmt::Display| ChipError::Image(format!("{}: {why}", path.display()));
        let file = std::fs::read(path).map_err(|why| wrong(&why))?;
        let elf = ElfFile32::<LittleEndian>::parse(&*file).map_err(|why| wrong(&why))?;
        let mut bytes = Vec::new();
        for segment in elf.elf_program_headers() {
            let at = segment.p_paddr(LittleEndian);
            if segment.p_type(LittleEndian) != object::elf::PT_LOAD || !(FLASH_AT..FLASH_END).contains(&at) {
                continue;
            }
            let data = segment.data(LittleEndian, &*file).map_err(|()| wrong(&"a segment outside the file"))?;
            let from = (at - FLASH_AT) as usize;
            bytes.resize(bytes.len().max(from + data.len()), 0xFF);
            bytes[from..from + data.len()].copy_from_slice(data);
        }
        let lines = lines(&elf, bytes.len(), of).map_err(|why| wrong(&why))?;
        Ok(Self { bytes, lines, tests: tests(&elf) })
    }

    /// Which lines these executed halfwords cover.
    pub fn coverage(&self, executed: &[bool]) -> Coverage {
        let mut coverage = Coverage::default();
        for (lines, executed) in self.lines.iter().zip(executed) {
            for (file, line) in lines {
                *coverage.files.entry(file.clone()).or_default().entry(*line).or_default() |= executed;
            }
        }
        coverage
    }
}

/// For every halfword, the lines that it comes from: its own, and those of the calls that were inlined around it.
fn lines(elf: &ElfFile32<'_, LittleEndian>, len: usize, of: &str) -> Result<Vec<Vec<(String, u32)>>, gimli::Error> {
    let section = |id: gimli::SectionId| -> Result<_, gimli::Error> {
        let data = elf.section_by_name(id.name()).and_then(|section| section.data().ok()).unwrap_or_default();
        Ok(gimli::EndianSlice::new(data, gimli::LittleEndian))
    };
    let context = addr2line::Context::from_dwarf(gimli::Dwarf::load(section)?)?;
    let mut found = vec![Vec::new(); len.div_ceil(2)];
    for (k, lines) in found.iter_mut().enumerate() {
        let address = u64::from(FLASH_AT) + 2 * k as u64;
        let mut frames = context.find_frames(address).skip_all_loads()?;
        let mut seen = BTreeSet::new();
        while let Some(frame) = frames.next()? {
            if let Some(location) = frame.location
                && let (Some(file), Some(line)) = (location.file, location.line)
                && let Some(at) = file.find(of)
                && line > 0
            {
                seen.insert((file[at..].to_owned(), line));
            }
        }
        lines.extend(seen);
    }
    Ok(found)
}

/// The tests of an image: each has a symbol, whose name is a JSON object and whose first word is the address.
fn tests(elf: &ElfFile32<'_, LittleEndian>) -> Vec<(String, u32)> {
    let Some(section) = elf.section_by_name(".embedded_test") else { return Vec::new() };
    let data = section.data().unwrap_or_default();
    let test = |symbol: object::read::elf::ElfSymbol32<'_, '_, LittleEndian>| {
        let said: serde_json::Value = serde_json::from_str(symbol.name().ok()?).ok()?;
        let from = symbol.address() as usize;
        let address = u32::from_le_bytes(data.get(from..from + 4)?.try_into().ok()?);
        Some((said["name"].as_str()?.to_owned(), address))
    };
    elf.symbols().filter_map(test).collect()
}

impl Coverage {
    /// Adds what another run, or another image of the same source, has covered.
    pub fn merge(&mut self, other: &Coverage) {
        for (file, lines) in &other.files {
            let mine = self.files.entry(file.clone()).or_default();
            for (line, executed) in lines {
                *mine.entry(*line).or_default() |= executed;
            }
        }
    }

    /// (executed, all) lines.
    pub fn count(&self) -> (usize, usize) {
        let all = self.files.values().flat_map(BTreeMap::values);
        (all.clone().filter(|executed| **executed).count(), all.count())
    }
}
