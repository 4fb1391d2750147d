//! Structs behind a host's pointers, of a header that may be older or newer than this library.
//!
//! Structs only grow, at their end. An older header's struct is shorter: fields that it lacks take their defaults. A newer
//! header's struct is longer: it is taken if its unknown part is zero, so that no wish of the host is passed over in silence.

use crate::status::Failure;
use crate::structs::*;
use crate::{AtrousConfig, AtrousConventionReport, AtrousGuides};
use std::mem::{offset_of, zeroed};

/// Bytes that a newer header may have added. A larger size is garbage, and nothing behind it is read.
const MOST_UNKNOWN: usize = 1024;

/// A struct that may grow.
///
/// # Safety
/// It begins with its size, has no padding at its end, and zeros are a value of it.
pub(super) unsafe trait Versioned: Copy {
    /// Its size in the first header.
    const FIRST_SIZE: usize;

    /// Values of fields that an older header lacks.
    fn missing() -> Self {
        // SAFETY: zeros are a value of it.
        unsafe { zeroed() }
    }
}

const fn size_of_field<T, F>(_: fn(&T) -> &F) -> usize {
    size_of::<F>()
}

/// Each struct, with the last field that it had in the first header.
macro_rules! versioned {
    ($($name:ident: $last:ident $(, missing $missing:expr)?;)+) => {$(
        // SAFETY: struct_size stands first, `tests/abi.rs` refuses padding at the end, and the fields are numbers, handles,
        // pointers and an optional function.
        unsafe impl Versioned for $name {
            const FIRST_SIZE: usize = offset_of!($name, $last) + size_of_field(|s: &$name| &s.$last);
            $(fn missing() -> Self {
                $missing
            })?
        }
    )+};
}

versioned! {
    AtrousConfig: debug_view, missing Self::default_for([0; 2]);
    AtrousFrameParams: debug_view, missing Self::default_for([0; 2]);
    AtrousCreateInfo: pipeline_cache;
    AtrousFrame: reset;
    AtrousStageInfo: word_count;
    AtrousResource: name;
    AtrousPass: name;
    AtrousMemory: output;
    AtrousTuningField: name;
    AtrousGuides: surface_id;
    AtrousConventionReport: text;
    AtrousLentImage: after_access;
    AtrousBarriers: images;
}

/// A struct of the host, with defaults for fields that its header lacks.
///
/// # Safety
/// `pointer` is null, or points to a u32, and, where that is a possible size, to as many bytes.
pub(super) unsafe fn read<T: Versioned>(what: &str, pointer: *const T) -> Result<T, Failure> {
    // SAFETY: `check_size` refuses null and impossible sizes, so that there are `given` bytes.
    unsafe {
        let given = check_size(what, pointer)?;
        let tail = (size_of::<T>()..given).find(|&at| pointer.cast::<u8>().add(at).read() != 0);
        if let Some(at) = tail {
            let message = format!(
                "{what}: byte {at} of {given} is not 0, and atrous {} knows {} bytes; leave fields of a newer atrous.h 0, or use its library",
                env!("CARGO_PKG_VERSION"),
                size_of::<T>()
            );
            return Err(Failure::argument(message));
        }
        let mut value = T::missing();
        let bytes = given.min(size_of::<T>());
        std::ptr::from_mut(&mut value).cast::<u8>().copy_from_nonoverlapping(pointer.cast(), bytes);
        Ok(value)
    }
}

/// The size of a host's struct, if a header ever had it or may have it.
///
/// # Safety
/// Obligations of [`read`].
pub(super) unsafe fn check_size<T: Versioned>(what: &str, pointer: *const T) -> Result<usize, Failure> {
    if pointer.is_null() {
        return Err(Failure::argument(format!("{what} is NULL; give a pointer to a struct")));
    }
    // SAFETY: struct_size stands first in every struct of the ABI.
    let given = unsafe { pointer.cast::<u32>().read_unaligned() } as usize;
    if given < T::FIRST_SIZE || given > size_of::<T>() + MOST_UNKNOWN {
        let message = format!(
            "{what}: struct_size is {given}; set it to sizeof, which is {} here and was {} in the first atrous.h",
            size_of::<T>(),
            T::FIRST_SIZE
        );
        return Err(Failure::argument(message));
    }
    Ok(given)
}

/// Writes `value` to as much of a struct as the host's header has, and zeros to what only a newer one has. `struct_size` stays.
///
/// # Safety
/// Obligations of [`read`], and writable.
pub(super) unsafe fn write<T: Versioned>(
    what: &str,
    pointer: *mut T,
    value: impl FnOnce() -> Result<T, Failure>,
) -> Result<(), Failure> {
    // SAFETY: `check_size` refuses null and impossible sizes, so that there are `given` writable bytes.
    unsafe {
        let given = check_size(what, pointer)?;
        let value = value()?;
        let (to, known) = (pointer.cast::<u8>(), given.min(size_of::<T>()));
        let after_size = size_of::<u32>();
        to.add(after_size).copy_from_nonoverlapping(std::ptr::from_ref(&value).cast::<u8>().add(after_size), known - after_size);
        to.add(known).write_bytes(0, given - known);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A struct that grew by `second` since the first header.
    #[derive(Clone, Copy, Debug, PartialEq)]
    #[repr(C)]
    struct Grown {
        struct_size: u32,
        first: u32,
        second: u32,
    }

    // SAFETY: struct_size stands first, all are numbers, and there is no padding.
    unsafe impl Versioned for Grown {
        const FIRST_SIZE: usize = 8;
        fn missing() -> Self {
            Self { struct_size: 0, first: 0, second: 7 }
        }
    }

    /// What the library takes from these words, of which the first is the size.
    fn taken(words: &[u32]) -> Result<Grown, String> {
        // SAFETY: there are as many bytes as the size says, or the size is impossible.
        unsafe { read("grown", words.as_ptr().cast()) }.map_err(|failure| failure.message)
    }

    #[test]
    fn an_older_struct_gets_defaults_and_a_newer_one_has_a_zero_tail() {
        assert_eq!(taken(&[8, 1, 99]), Ok(Grown { struct_size: 8, first: 1, second: 7 }));
        assert_eq!(taken(&[12, 1, 2]), Ok(Grown { struct_size: 12, first: 1, second: 2 }));
        assert_eq!(taken(&[20, 1, 2, 0, 0]), Ok(Grown { struct_size: 20, first: 1, second: 2 }));
        let message = taken(&[20, 1, 2, 0, 3 << 8]).expect_err("an unknown wish");
        assert!(message.contains("byte 17 of 20 is not 0") && message.contains("knows 12 bytes"), "{message}");
        for impossible in [0, 4, 7, 12 + 1025, u32::MAX] {
            let message = taken(&[impossible]).expect_err("impossible");
            assert!(message.contains(&format!("struct_size is {impossible}; set it to sizeof, which is 12")), "{message}");
        }
    }

    #[test]
    fn as_much_is_written_as_the_host_has() {
        let value = || Ok(Grown { struct_size: 0, first: 1, second: 2 });
        for (mut words, written) in [([8, 9, 9, 9], [8, 1, 9, 9]), ([12, 9, 9, 9], [12, 1, 2, 9]), ([16, 9, 9, 9], [16, 1, 2, 0])] {
            // SAFETY: there are at least as many bytes as the size says.
            unsafe { write("grown", words.as_mut_ptr().cast::<Grown>(), value) }.expect("a possible size");
            assert_eq!(words, written);
        }
    }
}
