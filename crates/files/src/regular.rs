//! Reading: opening a pipe waits for whoever writes to it, a device may have no end, and neither says so.

use std::fs::{File, FileType};
use std::io::{Error, ErrorKind, Read, Result};
use std::path::Path;

fn refused(problem: String) -> Error {
    Error::new(ErrorKind::InvalidInput, problem)
}

/// A word for what is no regular file.
fn kind(file: FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if file.is_fifo() {
            return "a pipe";
        }
        if file.is_socket() {
            return "a socket";
        }
        if file.is_char_device() || file.is_block_device() {
            return "a device";
        }
    }
    if file.is_dir() {
        "a folder"
    } else {
        "something else"
    }
}

/// The length of a regular file, or of the one that a link leads to. The file is not opened.
///
/// # Errors
/// [`ErrorKind::InvalidInput`] for whatever else has this name; errors of the system.
pub fn check_regular(path: &Path) -> Result<u64> {
    let metadata = std::fs::metadata(path)?;
    match metadata.is_file() {
        true => Ok(metadata.len()),
        false => Err(refused(format!("it is {}, and only regular files are read; give a file", kind(metadata.file_type())))),
    }
}

/// Opens a regular file.
///
/// # Errors
/// Errors of [`check_regular`] and of the system.
pub fn open_regular(path: &Path) -> Result<File> {
    check_regular(path)?;
    File::open(path)
}

/// The content of a regular file of at most `limit` bytes.
///
/// # Errors
/// Errors of [`open_regular`]; [`ErrorKind::InvalidInput`] for a longer file; [`ErrorKind::OutOfMemory`].
pub fn read_regular(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let too_long = |length: &str| refused(format!("it has {length} bytes, and {limit} are the most that is read of such a file"));
    let length = check_regular(path)?;
    if length > limit {
        return Err(too_long(&length.to_string()));
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(length as usize).map_err(|_| Error::from(ErrorKind::OutOfMemory))?;
    // A file may grow meanwhile, and those of some file systems do not know their length.
    File::open(path)?.take(limit.saturating_add(1)).read_to_end(&mut bytes)?;
    match bytes.len() as u64 > limit {
        true => Err(too_long("more")),
        false => Ok(bytes),
    }
}

/// The content of a regular file of at most `limit` bytes as text.
///
/// # Errors
/// Errors of [`read_regular`]; [`ErrorKind::InvalidData`] for what is no UTF-8.
pub fn read_text(path: &Path, limit: u64) -> Result<String> {
    let text = String::from_utf8(read_regular(path, limit)?);
    text.map_err(|e| Error::new(ErrorKind::InvalidData, format!("it is no text in UTF-8: {}", e.utf8_error())))
}
