//! The table behind the opaque handles.

use crate::status::{AtrousStatus, Failure};
use atrous::{Denoiser, FrameContext, Tuning};
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A denoiser. Opaque: the pointer is a number that is never followed, so that a wrong one is an error and not a crash.
pub struct AtrousDenoiser {
    _private: (),
}

/// The object behind a handle.
pub(super) struct State {
    pub denoiser: Denoiser,
    pub tuning: Tuning,
    /// Counts resizes; a frame of an earlier generation is refused.
    pub generation: u64,
    /// The frame that was begun last, by slot.
    pub frames: BTreeMap<u32, FrameContext>,
}

struct Table {
    next: usize,
    live: BTreeMap<usize, Arc<Mutex<State>>>,
}

static TABLE: Mutex<Table> = Mutex::new(Table { next: 0, live: BTreeMap::new() });

fn table() -> MutexGuard<'static, Table> {
    TABLE.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Numbers are not used twice, and are not what an allocator returns.
fn key(index: usize) -> usize {
    index * 2 + 1
}

pub(super) fn insert(state: State) -> *mut AtrousDenoiser {
    let mut table = table();
    table.next += 1;
    let key = key(table.next);
    table.live.insert(key, Arc::new(Mutex::new(state)));
    key as *mut AtrousDenoiser
}

fn invalid(handle: *const AtrousDenoiser) -> Failure {
    let message = if handle.is_null() {
        "the denoiser is NULL; give what atrous_create returned".to_owned()
    } else {
        "this is no live denoiser: it was destroyed, or the pointer is not one that atrous_create returned".to_owned()
    };
    Failure { status: AtrousStatus::InvalidHandle, message }
}

pub(super) fn remove(handle: *const AtrousDenoiser) -> Result<(), Failure> {
    let removed = table().live.remove(&(handle as usize));
    removed.map(drop).ok_or_else(|| invalid(handle))
}

/// Runs `body` on the state of a handle.
pub(super) fn with<T>(handle: *const AtrousDenoiser, body: impl FnOnce(&mut State) -> Result<T, Failure>) -> Result<T, Failure> {
    let state = table().live.get(&(handle as usize)).cloned().ok_or_else(|| invalid(handle))?;
    let mut state = state.lock().map_err(|_| Failure {
        status: AtrousStatus::Panicked,
        message: "an earlier call panicked, and its state is not to be trusted; destroy the denoiser".to_owned(),
    })?;
    body(&mut state)
}
