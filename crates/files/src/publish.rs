//! Writing: under a name that nobody else has, then one rename. A reader never sees half a file, a failure keeps what was there, and
//! programs that write to one folder at once do not touch each other's files.

use std::fs::File;
use std::io::{Error, ErrorKind, Result};
use std::path::Path;
use tempfile::{Builder, NamedTempFile};

/// The treatment of a file that has the name already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Existing {
    /// It stays, and writing fails with [`ErrorKind::AlreadyExists`].
    Kept,
    /// The new file takes its place. A link is replaced, not followed.
    Replaced,
}

/// Makes the file `path` of what `write` writes.
///
/// # Errors
/// Errors of `write` and of the system; [`ErrorKind::AlreadyExists`] with [`Existing::Kept`].
pub fn publish(path: &Path, existing: Existing, write: impl FnOnce(&mut File) -> Result<()>) -> Result<()> {
    if path.file_name().is_none() {
        return Err(Error::new(ErrorKind::InvalidInput, "it is not the name of a file"));
    }
    let mut part = temporary(path.parent().unwrap_or(Path::new("")))?;
    write(part.as_file_mut())?;
    // Some file systems find out only now that they are full.
    part.as_file().sync_all()?;
    let persisted = match existing {
        Existing::Kept => part.persist_noclobber(path),
        Existing::Replaced => part.persist(path),
    };
    persisted.map(drop).map_err(|e| e.error)
}

/// Proves that files can be made in a folder.
///
/// # Errors
/// Errors of the system.
pub fn check_writable(folder: &Path) -> Result<()> {
    temporary(folder).map(drop)
}

fn temporary(folder: &Path) -> Result<NamedTempFile> {
    let mut builder = Builder::new();
    builder.prefix(".atrous-").suffix(".part");
    // What comes out is for others to read, as far as the user's mask lets them.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // The kind alone: the user never heard of the temporary name that the crate tells besides.
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    builder.tempfile_in(folder).map_err(|error| error.kind().into())
}
