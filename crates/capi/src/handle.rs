//! The tables behind the opaque handles.
//!
//! Recordings share a denoiser: they take the reader's side of its lock, so that none waits for another. Calls that change it
//! take the writer's side.

use crate::graph::GraphState;
use crate::status::{AtrousStatus, Failure};
use crate::tracker::TrackerState;
use atrous::executor::Executor;
use atrous::{Denoiser, FrameContext, SharedPipelines, Tuning};
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, PoisonError, RwLock};

/// A denoiser. Opaque: the pointer is a number that is never followed, so that a wrong one is an error and not a crash.
pub struct AtrousDenoiser {
    _private: (),
}

/// A denoiser with its images, barriers and memory. Opaque, as AtrousDenoiser is.
pub struct AtrousExecutor {
    _private: (),
}

/// The states of the images and buffers of a denoiser. Opaque, as AtrousDenoiser is.
pub struct AtrousTracker {
    _private: (),
}

/// A graph of your own that is being built. Opaque, as AtrousDenoiser is.
pub struct AtrousGraph {
    _private: (),
}

/// Pipelines that the denoisers of a device share. Opaque, as AtrousDenoiser is.
pub struct AtrousPipelines {
    _private: (),
}

/// The object behind a handle of a denoiser.
pub(super) struct State {
    pub denoiser: Denoiser,
    pub tuning: Tuning,
    /// Counts resizes; a frame of an earlier generation is refused.
    pub generation: u64,
    /// The frame that was begun last, by slot.
    pub frames: Vec<Option<FrameContext>>,
}

/// The object behind a handle of an executor.
pub(super) struct ExecutorState {
    pub executor: Executor,
    pub tuning: Tuning,
    /// The frame that was begun last.
    pub newest: Option<FrameContext>,
    /// The first phase of that frame that may be recorded next.
    pub next_phase: u32,
}

/// An opaque type of the header, and the objects that its handles stand for.
pub(super) trait Opaque: Sized + 'static {
    type Object;
    /// The word for it in errors, and the function that makes one.
    const NAME: (&'static str, &'static str);
    fn table() -> &'static RwLock<Table<Self::Object>>;
}

/// Live objects by the number of their handle.
pub(super) type Table<T> = BTreeMap<usize, Arc<RwLock<T>>>;

/// A table of its own for each type of handle.
macro_rules! opaque {
    ($($handle:ty: $object:ty, $name:literal, $maker:literal;)+) => {$(
        impl Opaque for $handle {
            type Object = $object;
            const NAME: (&'static str, &'static str) = ($name, $maker);
            fn table() -> &'static RwLock<Table<$object>> {
                static TABLE: RwLock<Table<$object>> = RwLock::new(Table::new());
                &TABLE
            }
        }
    )+};
}

opaque! {
    AtrousDenoiser: State, "denoiser", "atrous_create";
    AtrousExecutor: ExecutorState, "executor", "atrous_executor_create";
    AtrousTracker: TrackerState, "tracker", "atrous_tracker_create";
    AtrousGraph: GraphState, "graph", "atrous_graph_create";
    AtrousPipelines: SharedPipelines, "store of pipelines", "atrous_pipelines_create";
}

/// A number that no handle of any type had before, so that none passes for one of a different type. Allocators return no odd ones.
fn new_key() -> usize {
    static NEXT: AtomicUsize = AtomicUsize::new(3);
    NEXT.fetch_add(2, Ordering::Relaxed)
}

pub(super) fn insert<H: Opaque>(object: H::Object) -> *mut H {
    let key = new_key();
    let mut table = H::table().write().unwrap_or_else(PoisonError::into_inner);
    table.insert(key, Arc::new(RwLock::new(object)));
    key as *mut H
}

fn invalid<H: Opaque>(handle: *const H) -> Failure {
    let (name, maker) = H::NAME;
    let message = if handle.is_null() {
        format!("the {name} is NULL; give what {maker} returned")
    } else {
        format!("this is no live {name}: it was destroyed, or the pointer is not one that {maker} returned")
    };
    Failure { status: AtrousStatus::InvalidHandle, message }
}

pub(super) fn remove<H: Opaque>(handle: *const H) -> Result<(), Failure> {
    let removed = H::table().write().unwrap_or_else(PoisonError::into_inner).remove(&(handle as usize));
    removed.map(drop).ok_or_else(|| invalid(handle))
}

fn find<H: Opaque>(handle: *const H) -> Result<Arc<RwLock<H::Object>>, Failure> {
    let table = H::table().read().unwrap_or_else(PoisonError::into_inner);
    table.get(&(handle as usize)).cloned().ok_or_else(|| invalid(handle))
}

fn panicked<T>(_: PoisonError<T>) -> Failure {
    Failure {
        status: AtrousStatus::Panicked,
        message: "an earlier call panicked, and its state is not to be trusted; destroy it".to_owned(),
    }
}

/// Runs `body` on the object of a handle, beside others that read it.
pub(super) fn read<H: Opaque, T>(handle: *const H, body: impl FnOnce(&H::Object) -> Result<T, Failure>) -> Result<T, Failure> {
    let object = find(handle)?;
    let object = object.read().map_err(panicked)?;
    body(&object)
}

/// Runs `body` on the object of a handle, alone.
pub(super) fn change<H: Opaque, T>(
    handle: *const H,
    body: impl FnOnce(&mut H::Object) -> Result<T, Failure>,
) -> Result<T, Failure> {
    let object = find(handle)?;
    let mut object = object.write().map_err(panicked)?;
    body(&mut object)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::{Condvar, Mutex};
    use std::time::Duration;

    /// A type of handle without a device.
    struct Probe;

    /// A different one.
    struct Other;

    opaque! {
        Probe: u32, "probe", "insert";
        Other: u32, "other", "insert";
    }

    #[test]
    fn no_handle_passes_for_one_of_a_different_type() {
        for _ in 0..4 {
            let (probe, other) = (insert::<Probe>(1), insert::<Other>(2));
            assert!(read(probe.cast::<Other>(), |object| Ok(*object)).is_err(), "{probe:?}");
            assert!(read(other.cast::<Probe>(), |object| Ok(*object)).is_err(), "{other:?}");
        }
    }

    #[test]
    fn four_readers_of_one_object_meet() {
        let (arrived, all) = (Mutex::new(0), Condvar::new());
        let handle = insert::<Probe>(7) as usize;
        let meet = || {
            read(handle as *const Probe, |object| {
                let mut count = arrived.lock().expect("no panic");
                *count += 1;
                all.notify_all();
                // Far longer than any thread needs: where one waits for another, this ends it.
                let (count, waited) = all.wait_timeout_while(count, Duration::from_secs(20), |count| *count < 4).expect("no panic");
                drop(count);
                Ok((*object, waited.timed_out()))
            })
        };
        std::thread::scope(|scope| {
            let threads: Vec<_> = (0..4).map(|_| scope.spawn(meet)).collect();
            for thread in threads {
                assert_eq!(thread.join().expect("no panic").expect("a live handle"), (7, false));
            }
        });
        let before = change(handle as *const Probe, |object| Ok(std::mem::replace(object, 8))).expect("a live handle");
        assert_eq!((before, read(handle as *const Probe, |object| Ok(*object)).expect("a live handle")), (7, 8));
        remove(handle as *const Probe).expect("a live handle");
        let gone = read(handle as *const Probe, |object| Ok(*object)).expect_err("destroyed");
        assert!(gone.message.contains("this is no live probe"), "{}", gone.message);
    }
}
