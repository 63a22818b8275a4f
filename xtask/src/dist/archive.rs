//! # Archive: files as one `.tar.gz`, and the sums of files
//!
//! The same files make the same bytes: in the order of their names, nobody's, of one time.

use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use flate2::{Compression, GzBuilder};
use sha2::{Digest, Sha256};
use tar::{Builder, Header};

use crate::folder::files;

/// Packs a folder, under its own name.
///
/// # Errors
/// Where something cannot be read or written.
pub fn pack(folder: &Path, archive: &Path, time_s: u64) -> io::Result<()> {
    let packed = GzBuilder::new().write(File::create(archive)?, Compression::best());
    let mut tar = Builder::new(packed);
    let above = folder.parent().unwrap_or(Path::new(""));
    for file in files(folder)? {
        let bytes = fs::read(&file)?;
        let mut header = Header::new_gnu();
        header.set_size(bytes.len() as u64);
        header.set_mode(if is_program(&file)? { 0o755 } else { 0o644 });
        header.set_mtime(time_s);
        tar.append_data(&mut header, file.strip_prefix(above).unwrap_or(&file), bytes.as_slice())?;
    }
    tar.into_inner()?.finish().map(drop)
}

#[cfg(unix)]
fn is_program(file: &Path) -> io::Result<bool> {
    use std::os::unix::fs::PermissionsExt;
    Ok(fs::metadata(file)?.permissions().mode() & 0o111 != 0)
}

#[cfg(not(unix))]
fn is_program(file: &Path) -> io::Result<bool> {
    Ok(file.extension().is_some_and(|suffix| suffix == "exe"))
}

/// The SHA-256 sums of files, as `sha256sum --check` reads them: names without folders.
///
/// # Errors
/// Where a file cannot be read.
pub fn sums(files: &[PathBuf]) -> io::Result<String> {
    let line = |file: &PathBuf| {
        let sum = Sha256::digest(fs::read(file)?);
        Ok(format!("{sum:x}  {}\n", file.file_name().unwrap_or_default().to_string_lossy()))
    };
    files.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let at = std::env::temp_dir().join(format!("omni-gap-archive-{}-{name}", std::process::id()));
        fs::create_dir_all(at.join("some/within")).unwrap();
        at
    }

    #[test]
    fn the_same_files_make_the_same_bytes_whatever_order_and_time_they_were_written_in() {
        let packed = |name: &str, order: [&str; 2]| {
            let at = folder(name);
            for file in order {
                fs::write(at.join("some").join(file), file).unwrap();
            }
            pack(&at.join("some"), &at.join("some.tar.gz"), 7).unwrap();
            let bytes = fs::read(at.join("some.tar.gz")).unwrap();
            fs::remove_dir_all(at).unwrap();
            bytes
        };
        let once = packed("once", ["within/b", "a"]);
        assert_eq!(once, packed("again", ["a", "within/b"]));
        let mut tar = tar::Archive::new(flate2::read::GzDecoder::new(once.as_slice()));
        let paths: Vec<PathBuf> =
            tar.entries().unwrap().map(|entry| entry.unwrap().path().unwrap().into_owned()).collect();
        assert_eq!(paths, [Path::new("some/a"), Path::new("some/within/b")]);
    }

    #[test]
    fn a_sum_is_that_of_the_standard() {
        let at = folder("sums");
        fs::write(at.join("abc"), "abc").unwrap();
        let said = sums(&[at.join("abc")]).unwrap();
        fs::remove_dir_all(at).unwrap();
        // FIPS 180-4, its example of one block
        assert_eq!(said, "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad  abc\n");
    }
}
