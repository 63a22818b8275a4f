//! # ELF: sections, functions and code of an image

use std::collections::BTreeMap;
use std::fmt;

use object::read::elf::{ElfFile32, FileHeader, SectionHeader};
use object::{LittleEndian, Object, ObjectSection, ObjectSymbol, SymbolKind, elf};

/// An image, taken apart.
#[derive(Clone, Debug, Default)]
pub struct Image {
    /// Sections that are loaded or reserved: name, address, bytes, and where they count
    pub sections: Vec<Section>,
    /// Functions by address
    pub functions: BTreeMap<u32, Function>,
    /// Names of all symbols, as they stand in the file
    pub symbols: Vec<String>,
    /// Handlers of the vector table from the reset on: (number in the table, address)
    pub vectors: Vec<(usize, u32)>,
}

/// A section.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// Its name
    pub name: String,
    /// Its bytes
    pub size: u64,
    /// It lies in flash
    pub flash: bool,
    /// It lies in RAM
    pub ram: bool,
}

/// A function.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Function {
    /// Where it begins
    pub address: u32,
    /// Its bytes, data within it included
    pub bytes: Vec<u8>,
    /// Its names, readable
    pub names: Vec<String>,
    /// Parts of it that are data: from, up to [bytes from its beginning]
    pub data: Vec<(u32, u32)>,
}

/// Why an image cannot be read.
#[derive(Debug)]
pub enum Unreadable {
    /// Not an ELF that can be read.
    Elf(object::Error),
    /// An ELF, but not an image for this chip.
    Other(&'static str),
}

impl fmt::Display for Unreadable {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Elf(why) => write!(f, "no readable ELF: {why}"),
            Self::Other(why) => write!(f, "no image for the chip: {why}"),
        }
    }
}

impl std::error::Error for Unreadable {}

impl From<object::Error> for Unreadable {
    fn from(why: object::Error) -> Self {
        Self::Elf(why)
    }
}

impl Image {
    /// Takes an ELF apart.
    ///
    /// # Errors
    /// [`Unreadable`] says what is wrong with it.
    pub fn read(file: &[u8]) -> Result<Self, Unreadable> {
        let elf = ElfFile32::<LittleEndian>::parse(file)?;
        if elf.elf_header().e_machine(LittleEndian) != elf::EM_ARM {
            return Err(Unreadable::Other("it is not for an Arm"));
        }
        let mut image = Self { sections: sections(&elf), ..Self::default() };
        image.vectors = vectors(&elf)?;
        let mut marks = BTreeMap::new();
        let mut found: Vec<(u32, u32, String)> = Vec::new();
        for symbol in elf.symbols() {
            let (Ok(name), address) = (symbol.name(), symbol.address() as u32) else { continue };
            match name.get(..2) {
                // mapping symbols of the Arm ELF: what begins here is code or data
                Some("$t") => drop(marks.insert(address, false)),
                Some("$d") => drop(marks.insert(address, true)),
                _ if symbol.is_undefined() || name.is_empty() => {}
                _ => image.symbols.push(name.to_owned()),
            }
            if symbol.kind() == SymbolKind::Text && address & 1 == 1 {
                found.push((address & !1, symbol.size() as u32, format!("{:#}", rustc_demangle::demangle(name))));
            }
        }
        found.sort();
        for k in 0..found.len() {
            let (address, size, name) = found[k].clone();
            // hand-written code may not say how long it is: it then goes on to the next function
            let next = found[k..].iter().map(|other| other.0).find(|other| *other > address);
            let size = if size > 0 { size } else { next.map_or(0, |next| next - address) };
            let function = image.functions.entry(address).or_default();
            function.address = address;
            function.names.push(name);
            if size as usize > function.bytes.len() {
                function.bytes = code(&elf, address, size)?;
                function.data = data(&marks, address, size);
            }
        }
        if image.functions.is_empty() {
            return Err(Unreadable::Other("it has no functions: have its symbols been stripped?"));
        }
        Ok(image)
    }

    /// Bytes of flash.
    pub fn flash(&self) -> u64 {
        self.sections.iter().filter(|section| section.flash).map(|section| section.size).sum()
    }

    /// Bytes of RAM that are taken before the program begins.
    pub fn ram(&self) -> u64 {
        self.sections.iter().filter(|section| section.ram).map(|section| section.size).sum()
    }

    /// The function that an address lies in.
    pub fn function_at(&self, address: u32) -> Option<&Function> {
        let (_, function) = self.functions.range(..=address).next_back()?;
        (address < function.address + function.bytes.len().max(1) as u32).then_some(function)
    }

    /// The function of this name.
    pub fn function(&self, name: &str) -> Option<&Function> {
        self.functions.values().find(|function| function.names.iter().any(|one| one == name))
    }
}

impl Function {
    /// The name that it is called by here.
    pub fn name(&self) -> &str {
        self.names.first().map_or("?", String::as_str)
    }
}

type Elf<'a> = ElfFile32<'a, LittleEndian>;

/// What is written to flash, and what takes room in RAM; initialised data does both.
fn sections(elf: &Elf<'_>) -> Vec<Section> {
    let mut all = Vec::new();
    for section in elf.sections() {
        let header = section.elf_section_header();
        let flags = header.sh_flags(LittleEndian).0;
        if flags & elf::SHF_ALLOC.0 == 0 || section.size() == 0 {
            continue;
        }
        let name = section.name().unwrap_or("?").to_owned();
        // .uninit and .bss have no bytes in the file
        let flash = header.sh_type(LittleEndian) != elf::SHT_NOBITS;
        // the chip's RAM begins at 0x2000_0000, its core-coupled one at 0x1000_0000, its flash at 0x0800_0000
        let ram = section.address() >= 0x1000_0000;
        all.push(Section { name, size: section.size(), flash, ram });
    }
    all
}

/// Handlers of the vector table.
fn vectors(elf: &Elf<'_>) -> Result<Vec<(usize, u32)>, Unreadable> {
    let table = elf.section_by_name(".vector_table").ok_or(Unreadable::Other("it has no .vector_table"))?;
    let (words, _) = table.data()?.as_chunks::<4>();
    // the first word is the stack pointer
    let handlers = words.iter().enumerate().skip(1).map(|(k, word)| (k, u32::from_le_bytes(*word) & !1));
    Ok(handlers.filter(|(_, address)| *address != 0).collect())
}

fn code(elf: &Elf<'_>, address: u32, size: u32) -> Result<Vec<u8>, Unreadable> {
    for section in elf.sections() {
        if let Some(bytes) = section.data_range(u64::from(address), u64::from(size))? {
            return Ok(bytes.to_vec());
        }
    }
    Ok(Vec::new())
}

/// The parts of a function that its mapping symbols call data.
fn data(marks: &BTreeMap<u32, bool>, address: u32, size: u32) -> Vec<(u32, u32)> {
    let end = address + size;
    let before = marks.range(..=address).next_back().is_some_and(|(_, data)| *data);
    let mut edges = vec![(address, before)];
    edges.extend(marks.range(address + 1..end).map(|(at, data)| (*at, *data)));
    edges.push((end, false));
    let spans = edges.windows(2).filter(|pair| pair[0].1);
    spans.map(|pair| (pair[0].0 - address, pair[1].0 - address)).collect()
}
