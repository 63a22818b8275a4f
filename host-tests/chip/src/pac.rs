//! # PAC: what the register access crate says of registers and fields
//!
//! The crate is generated from the chip's SVD; its source is read, the one that the image is built with. A field has a place
//! (`Bits 5:6`) and may have named values (an `enum`).

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::core::ChipError;

/// A field of a register.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its name
    pub name: String,
    /// Its lowest bit
    pub low: u32,
    /// Its highest bit
    pub high: u32,
    /// Its named values; none where every value is one
    pub values: BTreeMap<u32, String>,
}

/// A register.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Register {
    /// Peripheral and register
    pub name: String,
    /// Its fields, by their lowest bit
    pub fields: BTreeMap<u32, Field>,
}

/// Registers by address; an address may have more than one, as with the modes of compare channels.
#[derive(Clone, Debug, Default)]
pub struct Pac {
    /// Registers by address
    pub registers: BTreeMap<u32, Vec<Register>>,
}

/// What a word says, by the fields of its register.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decoded {
    /// Peripheral and register
    pub register: String,
    /// Fields that are not zero, with their values' names
    pub fields: Vec<String>,
    /// Bits outside all fields
    pub outside: u32,
    /// Fields whose value has no name though others have
    pub nameless: Vec<String>,
}

impl Pac {
    /// Reads the crate that the workspace builds with.
    ///
    /// # Errors
    /// [`ChipError::Image`] where it cannot be found or read.
    pub fn of_workspace() -> Result<Self, ChipError> {
        Self::read(&folder()?)
    }

    /// Reads the peripherals of a chip from its folder.
    fn read(folder: &Path) -> Result<Self, ChipError> {
        let mut pac = Self::default();
        for line in text(&folder.join("mod.rs"))?.lines() {
            // pub type TIM1 = crate::Periph<tim1::RegisterBlock, 0x4001_0000>;
            let Some(said) = line.strip_prefix("pub type ") else { continue };
            let Some((name, said)) = said.split_once(" = crate::Periph<") else { continue };
            let Some((module, base)) = said.trim_end_matches(">;").split_once("::RegisterBlock, ") else { continue };
            let Some(base) = hex(base) else { continue };
            pac.block(&folder.join(module), base, name)?;
        }
        Ok(pac)
    }

    /// Reads a register block, and the blocks within it.
    fn block(&mut self, folder: &Path, base: u32, name: &str) -> Result<(), ChipError> {
        let source = text(&folder.with_extension("rs"))?;
        let mut place = None;
        for line in source.lines().map(str::trim) {
            if let Some(said) = line.strip_prefix("///0x") {
                let (offsets, _) = said.split_once(" - ").unwrap_or((said, ""));
                place = Some(offsets.to_owned());
            } else if let Some(said) = line.strip_prefix("pub const fn ")
                && let Some(offsets) = place.take()
                && let Some((register, _)) = said.split_once('(')
            {
                match offsets.split_once("..") {
                    None => self.register(folder, base + offset(&offsets), name, register, &source)?,
                    // a cluster: a block for each of its parts; arrays of registers stand there one by one too
                    Some((from, to)) if folder.join(register).with_extension("rs").exists() && register == "st" => {
                        for (k, at) in (offset(from)..offset(to)).step_by(0x18).enumerate() {
                            self.block(&folder.join(register), base + at, &format!("{name} S{k}"))?;
                        }
                    }
                    Some(_) => {}
                }
            }
        }
        Ok(())
    }

    fn register(
        &mut self,
        folder: &Path,
        address: u32,
        name: &str,
        register: &str,
        block: &str,
    ) -> Result<(), ChipError> {
        // a register of an array has the type of the array: pub const fn ccr1(&self) -> &CCR {
        let head = format!("pub const fn {register}(&self) -> &");
        let of_array =
            block.split(&head).nth(1).and_then(|rest| rest.split_once(' ')).map(|(kind, _)| kind.to_lowercase());
        let module = of_array.as_deref().unwrap_or(register);
        let mut file = folder.join(module).with_extension("rs");
        if !file.exists() {
            // a register that two peripherals share stands with one of them
            let other = block.lines().find_map(|line| imported(folder, line, module));
            let Some(other) = other else { return Ok(()) };
            file = other;
        }
        let source = text(&file)?;
        let shared: BTreeSet<PathBuf> =
            source.lines().filter_map(|line| imported(file.parent()?, line, line.rsplit("::").nth(1)?)).collect();
        let shared = shared.iter().map(|path| text(path)).collect::<Result<String, _>>()?;
        let name = format!("{name} {}", register.to_uppercase());
        self.registers
            .entry(address)
            .or_default()
            .push(Register { name, fields: fields(&source, &(shared + &source)) });
        Ok(())
    }

    /// What a word says; none where the address has no register. Of registers that share it, the one whose fields hold it.
    pub fn decode(&self, address: u32, word: u32) -> Option<Decoded> {
        let all = self.registers.get(&address)?.iter().map(|register| register.decode(word));
        all.min_by_key(|decoded| {
            (decoded.outside.count_ones() + decoded.nameless.len() as u32, decoded.register.ends_with("INPUT"))
        })
    }
}

impl Register {
    fn decode(&self, word: u32) -> Decoded {
        let mut outside = word;
        let (mut said, mut nameless) = (Vec::new(), Vec::new());
        for field in self.fields.values() {
            let mask = (((1u64 << (field.high - field.low + 1)) - 1) as u32) << field.low;
            outside &= !mask;
            let value = (word & mask) >> field.low;
            let named = field.values.get(&value);
            if value != 0 {
                let meaning = named.map(|meaning| format!(" {meaning}")).unwrap_or_default();
                said.push(format!("{} = {value}{meaning}", field.name));
            }
            if named.is_none() && !field.values.is_empty() && value != 0 {
                nameless.push(format!("{} = {value}", field.name));
            }
        }
        Decoded { register: self.name.clone(), fields: said, outside, nameless }
    }
}

/// The file of a module that a line imports, from a neighbour in the folder or from another peripheral.
fn imported(folder: &Path, line: &str, module: &str) -> Option<PathBuf> {
    let path = line.strip_prefix("pub use ")?.trim_end_matches(';');
    let path = match path.strip_prefix("super::") {
        Some(path) => folder.join(path.split("::").next()?),
        None => path
            .strip_prefix("crate::stm32f405::")?
            .split("::")
            .take(2)
            .fold(folder.parent()?.to_owned(), |at, part| at.join(part)),
    };
    (path.file_name()? == module).then(|| path.with_extension("rs")).filter(|path| path.exists())
}

/// The fields of a register's file, of its reader and its writer; types may stand in the files that it imports from.
fn fields(source: &str, types: &str) -> BTreeMap<u32, Field> {
    let values = enums(types);
    let kinds = kinds(types);
    let mut fields = BTreeMap::new();
    let mut place = None;
    for line in source.lines().map(str::trim) {
        if let Some(said) = line.strip_prefix("///Bit") {
            // Bit 0 - …, Bits 5:6 - …
            let range = said.trim_start_matches('s').trim_start();
            let range = range.split_once(' ').map_or(range, |(range, _)| range);
            let (low, high) = range.split_once(':').unwrap_or((range, range));
            place = low.parse().ok().zip(high.parse().ok());
        } else if let Some(said) = line.strip_prefix("pub fn ")
            && let Some((low, high)) = place.take()
            && let Some((name, rest)) = said.split_once('(')
        {
            let kind = rest.split("-> ").nth(1).and_then(|kind| kind.split(['<', ' ']).next()).unwrap_or_default();
            let named = kinds.get(kind).and_then(|kind| values.get(kind)).cloned().unwrap_or_default();
            let field: &mut Field =
                fields.entry(low).or_insert(Field { name: name.to_uppercase(), low, high, values: BTreeMap::new() });
            field.values.extend(named);
        }
    }
    fields
}

/// The named values of every enum.
fn enums(source: &str) -> BTreeMap<String, BTreeMap<u32, String>> {
    let mut found: BTreeMap<String, BTreeMap<u32, String>> = BTreeMap::new();
    let mut inside: Option<String> = None;
    for line in source.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("pub enum ") {
            inside = name.split([' ', '{']).next().map(str::to_owned);
        } else if line == "}" {
            inside = None;
        } else if let Some(name) = &inside
            && let Some((variant, value)) = line.trim_end_matches(',').split_once(" = ")
            && let Ok(value) = value.parse()
        {
            found.entry(name.clone()).or_default().insert(value, variant.to_owned());
        }
    }
    found
}

/// The enum that a reader's or writer's type goes by, where it has one.
fn kinds(source: &str) -> BTreeMap<String, String> {
    let mut found = BTreeMap::new();
    for line in source.lines() {
        // pub type CMS_W<'a, REG> = crate::FieldWriter<'a, REG, 2, CMS, crate::Safe>;
        if let Some((name, said)) = line.strip_prefix("pub type ").and_then(|said| said.split_once(" = crate::")) {
            let name = name.split('<').next().unwrap_or(name);
            let kind = said.trim_end_matches(">;").split(['<', ',']).map(str::trim);
            if let Some(kind) =
                kind.skip(1).find(|kind| kind.starts_with(|c: char| c.is_ascii_uppercase()) && *kind != "REG")
            {
                found.insert(name.to_owned(), kind.to_owned());
            }
        }
    }
    // pub use SMP10_W as SMP11_W;
    for line in source.lines() {
        if let Some((one, other)) = line.strip_prefix("pub use ").and_then(|said| said.split_once(" as "))
            && let Some(kind) = found.get(one).cloned()
        {
            found.insert(other.trim_end_matches(';').to_owned(), kind);
        }
    }
    found
}

fn hex(text: &str) -> Option<u32> {
    u32::from_str_radix(&text.trim_start_matches("0x").replace('_', ""), 16).ok()
}

fn offset(text: &str) -> u32 {
    hex(text).unwrap_or(0)
}

fn text(path: &Path) -> Result<String, ChipError> {
    std::fs::read_to_string(path).map_err(|why| ChipError::Image(format!("{}: {why}", path.display())))
}

/// The folder of the chip in the crate's source, as cargo says where it is.
fn folder() -> Result<PathBuf, ChipError> {
    let wrong = |why: &dyn std::fmt::Display| ChipError::Image(format!("cargo metadata: {why}"));
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut line = Command::new(cargo);
    line.args(["metadata", "--format-version", "1", "--filter-platform", "thumbv7em-none-eabihf"]);
    let said = line.current_dir(env!("CARGO_MANIFEST_DIR")).output().map_err(|why| wrong(&why))?;
    let said: serde_json::Value = serde_json::from_slice(&said.stdout).map_err(|why| wrong(&why))?;
    let packages = said["packages"].as_array().into_iter().flatten();
    let manifest =
        packages.filter(|package| package["name"] == "stm32f4").find_map(|package| package["manifest_path"].as_str());
    let manifest = Path::new(manifest.ok_or_else(|| wrong(&"no crate stm32f4"))?);
    Ok(manifest.with_file_name("src").join("stm32f405"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_and_their_values_are_those_of_the_reference_manual() {
        let pac = Pac::of_workspace().expect("the crate is there");
        // RM0090, TIMx_CR1: CMS is bits 5 and 6, ARPE bit 7; 0b10 is centre-aligned mode 2
        let decoded = pac.decode(0x4001_0000, 0xC1).expect("TIM1 CR1");
        assert_eq!(decoded.register, "TIM1 CR1");
        assert_eq!(decoded.fields, ["CEN = 1 Enabled", "CMS = 2 CenterAligned2", "ARPE = 1 Enabled"]);
        assert_eq!((decoded.outside, decoded.nameless.len()), (0, 0));
        // bit 10 is reserved
        assert_eq!(pac.decode(0x4001_0000, 1 << 10).map(|decoded| decoded.outside), Some(1 << 10));
        // streams of the DMA are blocks within a block
        let stream = pac.decode(0x4002_6000 + 0x10 + 3 * 0x18, 1).expect("DMA1 S3CR");
        assert_eq!((stream.register.as_str(), stream.fields), ("DMA1 S3 CR", vec!["EN = 1 Enabled".to_owned()]));
    }
}
