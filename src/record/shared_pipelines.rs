//! Pipelines that the denoisers of a device have in common.

use super::names::Names;
use super::pipeline::Pipeline;
use crate::contract::Dispatch;
use crate::error::Error;
use crate::parallel;
use ash::vk;
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// A module by its name and code, and the bits of its specialisation constants by their identifiers.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Key {
    pub shader: Cow<'static, str>,
    pub constants: Vec<(u32, u32)>,
    spirv: Cow<'static, [u8]>,
}

impl Key {
    pub(super) fn new(dispatch: &Dispatch) -> Self {
        let shader = &dispatch.shader;
        Self { shader: shader.name.clone(), constants: dispatch.constants.clone(), spirv: shader.spirv.clone() }
    }
}

/// Pipelines by what they are made of.
pub(super) type Made = BTreeMap<Key, Arc<Pipeline>>;

/// Pipelines that denoisers of one device share: a second view, a preview or another preset creates those alone that no
/// denoiser before it had. Give it in [`Device::pipelines`](super::Device::pipelines). A clone is the same store.
///
/// It keeps each pipeline until you drop it and all denoisers that use it. Drop it before the device.
///
/// ```no_run
/// # fn host<'a>() -> atrous::Device<'a> { unimplemented!() }
/// let pipelines = atrous::SharedPipelines::default(); // beside your device
/// let device = atrous::Device { pipelines: Some(&pipelines), ..host() };
/// let declaration = atrous::Config::new([1920, 1080]).declare()?;
/// // SAFETY: the handles are live, belong together, and outlive the denoisers and the store.
/// let (left, right) = unsafe { (atrous::Denoiser::new(device, declaration.clone())?, atrous::Denoiser::new(device, declaration)?) };
/// # Ok::<(), atrous::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct SharedPipelines(Arc<Mutex<Made>>);

impl SharedPipelines {
    /// Forgets the pipelines. Those that a denoiser uses live as long as it does.
    pub fn clear(&self) {
        self.made().clear();
    }

    /// Pipelines of the dispatches. Those that are missing are created on as many threads as there are cores. None is kept where one
    /// fails.
    ///
    /// # Safety
    /// `device` is live, the only one of this store, and outlives it; `cache` is null or a cache of it that is synchronised internally.
    pub(super) unsafe fn get<'a>(
        &self,
        device: &ash::Device,
        cache: vk::PipelineCache,
        dispatches: impl Iterator<Item = &'a Dispatch>,
    ) -> Result<Made, Error> {
        let wanted: BTreeMap<_, _> = dispatches.map(|dispatch| (Key::new(dispatch), dispatch)).collect();
        let missing: Vec<_> = {
            let made = self.made();
            wanted.iter().filter(|(key, _)| !made.contains_key(key)).collect()
        };
        let device = Arc::new(device.clone());
        // SAFETY: the device is live and outlives the pipeline. Creating takes no lock: the device may be used by several threads,
        // what a call creates is its own, and the cache is synchronised internally.
        let create = |(key, dispatch): &(&Key, &&Dispatch)| unsafe {
            Ok(((*key).clone(), Arc::new(Pipeline::new(&device, cache, dispatch)?)))
        };
        let (created, error) = parallel::run(&missing, parallel::cores(), create);
        if let Some(error) = error {
            return Err(error);
        }
        let mut made = self.made();
        // Another thread may have made the same one meanwhile: the first stays.
        for (key, pipeline) in created {
            made.entry(key).or_insert(pipeline);
        }
        Ok(wanted.into_keys().filter_map(|key| made.get(&key).cloned().map(|pipeline| (key, pipeline))).collect())
    }

    /// # Safety
    /// The names are those of the device.
    pub(super) unsafe fn name(&self, names: &Names, pipelines: &Made) {
        let _one_at_a_time = self.made();
        for (key, pipeline) in pipelines {
            // SAFETY: denoisers that share a pipeline name it under this lock, and what is held here is not destroyed.
            unsafe { pipeline.name(names, &key.shader) };
        }
    }

    fn made(&self) -> MutexGuard<'_, Made> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
