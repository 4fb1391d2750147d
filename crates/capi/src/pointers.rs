//! Structs behind a host's pointers.

use crate::status::Failure;

/// A struct of the host, after its size was checked.
///
/// # Safety
/// `pointer` is null, or points to a u32, and, where that is the size of `T`, to a `T`.
pub(super) unsafe fn read<T: Copy>(what: &str, pointer: *const T) -> Result<T, Failure> {
    // SAFETY: `check_size` refuses null and any other size, so that `pointer` points to a whole `T`.
    unsafe {
        check_size(what, pointer)?;
        Ok(pointer.read_unaligned())
    }
}

/// Whether a struct of the host is as large as this library's.
///
/// # Safety
/// Obligations of [`read`].
pub(super) unsafe fn check_size<T>(what: &str, pointer: *const T) -> Result<(), Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(format!("{what} is NULL; give a pointer to a struct")));
    }
    // SAFETY: struct_size stands first in every struct of the ABI.
    let given = unsafe { pointer.cast::<u32>().read_unaligned() };
    if given as usize != size_of::<T>() {
        let message = format!(
            "{what}: struct_size is {given}, this library has {}; set it to sizeof, and compile against the atrous.h of the library",
            size_of::<T>()
        );
        return Err(Failure::argument(message));
    }
    Ok(())
}

/// Writes `value` to a struct of the host, after its size was checked.
///
/// # Safety
/// Obligations of [`read`], and writable.
pub(super) unsafe fn write<T: Copy>(
    what: &str,
    pointer: *mut T,
    value: impl FnOnce() -> Result<T, Failure>,
) -> Result<(), Failure> {
    // SAFETY: `check_size` refuses null and any other size, so that `pointer` points to a whole `T`, and it is writable.
    unsafe {
        check_size(what, pointer)?;
        pointer.write_unaligned(value()?);
    }
    Ok(())
}
