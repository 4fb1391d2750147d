//! Status codes, the message of the last error, and the wall that panics do not pass.

use ash::vk;
use atrous::Error;
use std::cell::RefCell;
use std::ffi::{c_char, CStr, CString};
use std::panic::{catch_unwind, AssertUnwindSafe};

/// The result of a function of the C ABI.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(u32)]
pub enum AtrousStatus {
    /// Success.
    Ok = 0,
    /// A pointer is null, a struct_size is wrong, or a value is out of range.
    InvalidArgument = 1,
    /// The handle is null, was destroyed, or never was one.
    InvalidHandle = 2,
    /// The frame was not begun, or was begun before the last resize.
    StaleFrame = 3,
    /// The bindings do not fit the pass in number or kind.
    BadBindings = 4,
    /// The device lacks a feature or a format.
    UnsupportedDevice = 5,
    /// Memory ran out.
    OutOfMemory = 6,
    /// A different Vulkan call failed.
    VulkanError = 7,
    /// A bug in atrous: it panicked. Destroy your denoiser.
    Panicked = 8,
    /// Passes of the previous frame were left out: see atrous_set_checks.
    LeftOut = 9,
    /// The GPU still works on the frame slot: see complete_frames of AtrousFrameParams.
    InFlight = 10,
}

/// The reason of a failed call.
#[derive(Debug)]
pub(super) struct Failure {
    pub status: AtrousStatus,
    pub message: String,
}

impl Failure {
    pub fn argument(message: impl Into<String>) -> Self {
        Self { status: AtrousStatus::InvalidArgument, message: message.into() }
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        let status = match &error {
            Error::Unsupported { .. } | Error::NoDevice(_) => AtrousStatus::UnsupportedDevice,
            Error::OutOfMemory { .. } => AtrousStatus::OutOfMemory,
            Error::Vulkan { result: vk::Result::ERROR_OUT_OF_HOST_MEMORY | vk::Result::ERROR_OUT_OF_DEVICE_MEMORY, .. } => {
                AtrousStatus::OutOfMemory
            }
            Error::Vulkan { .. } => AtrousStatus::VulkanError,
            Error::LeftOut { .. } => AtrousStatus::LeftOut,
            Error::InFlight { .. } => AtrousStatus::InFlight,
            Error::Binding { .. } | Error::Bindings { .. } | Error::NotBound(_) | Error::WrongKind { .. } => {
                AtrousStatus::BadBindings
            }
            _ => AtrousStatus::InvalidArgument,
        };
        Self { status, message: error.to_string() }
    }
}

thread_local! {
    static LAST_ERROR: RefCell<CString> = RefCell::default();
}

/// Runs the body of a function of the C ABI: keeps the message of a failure, and turns a panic into one.
pub(super) fn guard(body: impl FnOnce() -> Result<(), Failure>) -> AtrousStatus {
    let failure = match catch_unwind(AssertUnwindSafe(body)) {
        Ok(Ok(())) => return AtrousStatus::Ok,
        Ok(Err(failure)) => failure,
        Err(panic) => {
            let text = panic.downcast_ref::<String>().map(String::as_str).or_else(|| panic.downcast_ref::<&str>().copied());
            let message = format!("atrous panicked: {}. This is a bug; destroy the denoiser", text.unwrap_or("no message"));
            Failure { status: AtrousStatus::Panicked, message }
        }
    };
    let message = CString::new(failure.message.replace('\0', "?")).unwrap_or_default();
    // Not there any more while its thread ends: then nobody can ask for it either.
    let _ = LAST_ERROR.try_with(|last| last.replace(message));
    failure.status
}

/// The message of the last failed call on your thread, empty before the first. It is valid until the next failure on that thread.
#[no_mangle]
pub extern "C" fn atrous_last_error() -> *const c_char {
    const NONE: &CStr = c"";
    LAST_ERROR.try_with(|last| last.borrow().as_ptr()).unwrap_or(NONE.as_ptr())
}

/// The name of a status, for logs; never null.
#[no_mangle]
pub extern "C" fn atrous_status_name(status: u32) -> *const c_char {
    const NAMES: [&CStr; 11] = [
        c"ok",
        c"invalid argument",
        c"invalid handle",
        c"stale frame",
        c"bad bindings",
        c"unsupported device",
        c"out of memory",
        c"Vulkan error",
        c"panicked",
        c"passes left out",
        c"frame slot in flight",
    ];
    NAMES.get(status as usize).copied().unwrap_or(c"unknown status").as_ptr()
}
