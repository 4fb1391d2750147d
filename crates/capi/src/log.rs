//! What the library says besides its statuses: warnings and the like, to a function of the host.

use crate::status::{guard, AtrousStatus, Failure};
use log::{LevelFilter, Log, Metadata, Record};
use std::ffi::{c_char, c_void, CString};
use std::sync::{Mutex, OnceLock, PoisonError};

/// Your function for messages. It may be called on any thread that calls the library, and must not throw.
pub type AtrousLogCallback = Option<unsafe extern "C" fn(user: *mut c_void, level: u32, message: *const c_char)>;

/// The function of the host, and its argument.
#[derive(Clone, Copy)]
struct Listener {
    callback: unsafe extern "C" fn(*mut c_void, u32, *const c_char),
    user: *mut c_void,
}

// SAFETY: the host promised that its function may be called on any thread, with this argument.
unsafe impl Send for Listener {}

static LISTENER: Mutex<Option<Listener>> = Mutex::new(None);

struct ToHost;

impl Log for ToHost {
    fn enabled(&self, metadata: &Metadata) -> bool {
        metadata.level() <= log::max_level()
    }

    fn log(&self, record: &Record) {
        // Not called under the lock, since the function may set another one.
        let listener = *LISTENER.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(Listener { callback, user }) = listener.filter(|_| self.enabled(record.metadata())) {
            let message = CString::new(record.args().to_string().replace('\0', "?")).unwrap_or_default();
            // SAFETY: the host's function takes its own argument, a level and a string, on any thread.
            unsafe { callback(user, record.level() as u32, message.as_ptr()) };
        }
    }

    fn flush(&self) {}
}

/// Gives you the messages of the library, for example that history is lost in frame after frame. `level` is the most detailed one
/// that you want: 1 errors, 2 warnings as well, 3 information, 4 and 5 details; 0 or a null callback: none. A message is valid
/// during the call. There is one callback for the process.
///
/// # Safety
/// `callback` takes these arguments on any thread and throws nothing. `user` outlives every call of the library that began before
/// you replaced it.
#[no_mangle]
pub unsafe extern "C" fn atrous_set_log(level: u32, callback: AtrousLogCallback, user: *mut c_void) -> AtrousStatus {
    const LEVELS: [LevelFilter; 6] =
        [LevelFilter::Off, LevelFilter::Error, LevelFilter::Warn, LevelFilter::Info, LevelFilter::Debug, LevelFilter::Trace];
    static IS_OURS: OnceLock<bool> = OnceLock::new();
    guard(|| {
        let unknown = || Failure::argument(format!("level is {level}; allowed: 0 (none), 1 (errors) to 5 (every detail)"));
        let filter = *LEVELS.get(level as usize).ok_or_else(unknown)?;
        if !*IS_OURS.get_or_init(|| log::set_logger(&ToHost).is_ok()) {
            return Err(Failure::argument("this process has a logger of its own for the crate `log`; messages go there"));
        }
        *LISTENER.lock().unwrap_or_else(PoisonError::into_inner) = callback.map(|callback| Listener { callback, user });
        log::set_max_level(if callback.is_some() { filter } else { LevelFilter::Off });
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    unsafe extern "C" fn keep(user: *mut c_void, level: u32, message: *const c_char) {
        // SAFETY: the test gives a list, and the library a string.
        let (list, message) = unsafe { (&mut *user.cast::<Vec<String>>(), CStr::from_ptr(message)) };
        list.push(format!("{level} {}", message.to_string_lossy()));
    }

    #[test]
    fn messages_up_to_the_level_reach_the_host() {
        let mut heard: Vec<String> = Vec::new();
        let user = std::ptr::from_mut(&mut heard).cast::<c_void>();
        let set = |level, callback: AtrousLogCallback| {
            // SAFETY: the list outlives the last call; nothing else logs meanwhile.
            unsafe { atrous_set_log(level, callback, user) }
        };
        assert_eq!(set(6, Some(keep)), AtrousStatus::InvalidArgument);
        assert_eq!(set(2, Some(keep)), AtrousStatus::Ok);
        log::error!("a");
        log::warn!("b\0c");
        log::info!("d");
        assert_eq!(set(3, Some(keep)), AtrousStatus::Ok);
        log::info!("e");
        assert_eq!(set(5, None), AtrousStatus::Ok);
        log::error!("f");
        assert_eq!(heard, ["1 a", "2 b?c", "3 e"]);
    }
}
