//! Folders and files of the results.

use std::io::Write;
use std::path::Path;

use atrous_engine::Error;
use atrous_files::{publish, Existing};

use crate::Result;

/// Makes a folder.
///
/// # Errors
/// A folder that cannot be made.
pub fn make(folder: &Path) -> Result<()> {
    Ok(std::fs::create_dir_all(folder).map_err(|e| Error::Folder { path: folder.to_owned(), problem: e.to_string() })?)
}

/// Writes a file as a whole, or not at all.
///
/// # Errors
/// A file that cannot be written.
pub fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    let written = publish(path, Existing::Replaced, |file| file.write_all(bytes));
    Ok(written.map_err(|e| Error::Folder { path: path.to_owned(), problem: e.to_string() })?)
}
