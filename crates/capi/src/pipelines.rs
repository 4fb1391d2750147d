//! Pipelines that the denoisers of a device share.

use crate::handle::{self, AtrousPipelines};
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::AtrousCreateInfo;
use atrous::SharedPipelines;

/// The pipelines that the host gave, if it did.
pub(super) fn shared(info: &AtrousCreateInfo) -> Result<Option<SharedPipelines>, Failure> {
    if info.pipelines.is_null() {
        return Ok(None);
    }
    handle::read(info.pipelines, |shared| Ok(Some(shared.clone())))
}

/// Creates a store of pipelines for one device, which is empty. Give it in AtrousCreateInfo to denoisers and executors: a second view
/// or another preset creates only those pipelines that none before it had.
///
/// # Safety
/// `pipelines` is null or points to a pointer.
#[no_mangle]
pub unsafe extern "C" fn atrous_pipelines_create(pipelines: *mut *mut AtrousPipelines) -> AtrousStatus {
    guard(|| {
        if pipelines.is_null() {
            return Err(Failure::argument("pipelines is NULL; give a pointer to where the handle goes"));
        }
        // SAFETY: `pipelines` is not null and writable for a pointer.
        unsafe { pipelines.write_unaligned(handle::insert(SharedPipelines::default())) };
        Ok(())
    })
}

/// Forgets its pipelines. Those that a denoiser uses live as long as it does.
///
/// # Safety
/// The device is live.
#[no_mangle]
pub unsafe extern "C" fn atrous_pipelines_clear(pipelines: *mut AtrousPipelines) -> AtrousStatus {
    guard(|| {
        handle::read(pipelines, |shared| {
            shared.clear();
            Ok(())
        })
    })
}

/// Destroys a store of pipelines. Those that a denoiser uses live as long as it does. Your handle is invalid from then on, and stays
/// so.
///
/// # Safety
/// The device is live.
#[no_mangle]
pub unsafe extern "C" fn atrous_pipelines_destroy(pipelines: *mut AtrousPipelines) -> AtrousStatus {
    guard(|| handle::remove(pipelines))
}
