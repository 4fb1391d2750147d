//! Writing: under a name that nobody else has, then one rename. A reader never sees half a file, a failure keeps what was there, and
//! programs that write to one folder at once do not touch each other's files.

use std::fs::File;
use std::io::{Error, ErrorKind, Result};
use std::path::Path;
use tempfile::{Builder, NamedTempFile};

/// Names of temporary files begin and end so.
const PREFIX: &str = ".atrous-";
const SUFFIX: &str = ".part";

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

/// Removes the temporary files of runs that ended before they could: those that nobody writes to.
///
/// What cannot be removed stays: it hurts nobody.
pub fn remove_abandoned(folder: &Path) {
    let Ok(entries) = std::fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let is_part = name.starts_with(PREFIX) && name.ends_with(SUFFIX);
        // A link in its place is not followed.
        let is_file = path.symlink_metadata().is_ok_and(|meta| meta.is_file());
        if is_part && is_file && File::open(&path).is_ok_and(|file| lock(&file)) {
            let _ = std::fs::remove_file(&path);
        }
    }
}

/// Locks a file as long as it is open. Whether nobody else had it locked.
fn lock(file: &File) -> bool {
    #[cfg(unix)]
    {
        rustix::fs::flock(file, rustix::fs::FlockOperation::NonBlockingLockExclusive).is_ok()
    }
    // Elsewhere a file that is open cannot be removed.
    #[cfg(not(unix))]
    {
        let _ = file;
        true
    }
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
    builder.prefix(PREFIX).suffix(SUFFIX);
    // What comes out is for others to read, as far as the user's mask lets them.
    #[cfg(unix)]
    builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o666));
    // The kind alone: the user never heard of the temporary name that the crate tells besides.
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    let file = builder.tempfile_in(folder).map_err(|error| Error::from(error.kind()))?;
    lock(file.as_file());
    Ok(file)
}
