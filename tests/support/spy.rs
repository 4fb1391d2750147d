//! The device of the tests with functions between that count what is created and destroyed, and that can refuse a call.

use super::intercepted::Intercepted;
use ash::vk;
use ash::vk::Handle;
use atrous::executor::HeadlessDevice;
use atrous::Device;
use std::collections::{BTreeMap, HashSet};
use std::ffi::{c_void, CStr};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread::ThreadId;
use std::time::Duration;

/// The device.
pub struct Spy(Intercepted);

#[derive(Default)]
struct Log {
    /// The device that calls are passed on to.
    gpu: Option<Arc<HeadlessDevice>>,
    /// Calls that succeeded, by the name of what they make.
    created: BTreeMap<&'static str, u32>,
    destroyed: BTreeMap<&'static str, u32>,
    /// The call that is refused, of those that are still to come.
    refused: Option<(&'static str, u32)>,
    /// Caches of the calls that made pipelines.
    caches: Vec<vk::PipelineCache>,
    threads: HashSet<ThreadId>,
    /// Calls that make pipelines wait until there are so many at once.
    together: usize,
    arrived: usize,
}

/// What a refused call returns.
pub const REFUSED: vk::Result = vk::Result::ERROR_OUT_OF_HOST_MEMORY;

static LOG: Mutex<Option<Log>> = Mutex::new(None);
static ARRIVED: Condvar = Condvar::new();

fn with_log<T>(body: impl FnOnce(&mut Log) -> T) -> T {
    body(LOG.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_default())
}

fn real() -> Arc<HeadlessDevice> {
    with_log(|log| log.gpu.clone()).expect("Spy::new gave it")
}

impl Spy {
    pub fn new() -> Self {
        static ALONE: Mutex<()> = Mutex::new(());
        // SAFETY: the functions have the signatures of those that they stand for.
        Self(unsafe {
            Intercepted::new(&ALONE, |gpu| with_log(|log| *log = Log { gpu: Some(gpu), ..Log::default() }), replacement)
        })
    }

    /// The handles for a denoiser.
    pub fn host(&self, pipeline_cache: vk::PipelineCache) -> Device<'_> {
        Device { pipeline_cache, ..self.0.host() }
    }

    /// Objects that were created so far, by kind.
    pub fn created(&self) -> BTreeMap<&'static str, u32> {
        with_log(|log| log.created.clone())
    }

    /// Objects that exist, by kind.
    pub fn live(&self) -> BTreeMap<&'static str, u32> {
        let live = |log: &mut Log| {
            let of_kind = |(&kind, count): (&&'static str, &u32)| (kind, count - log.destroyed.get(kind).unwrap_or(&0));
            log.created.iter().map(of_kind).filter(|(_, count)| *count > 0).collect()
        };
        with_log(live)
    }

    /// Refuses one call that makes an object of this kind, behind `after` more of them.
    pub fn refuse(&self, kind: &'static str, after: u32) {
        with_log(|log| log.refused = Some((kind, after)));
    }

    /// Whether the call came that was to be refused.
    pub fn has_refused(&self) -> bool {
        with_log(|log| log.refused.take().is_none())
    }

    /// Has calls that make pipelines wait for each other, until there are so many.
    pub fn make_together(&self, threads: usize) {
        with_log(|log| log.together = threads);
    }

    /// The cache of each call that made a pipeline.
    pub fn caches(&self) -> Vec<vk::PipelineCache> {
        with_log(|log| log.caches.clone())
    }

    /// Threads that made pipelines.
    pub fn threads(&self) -> usize {
        with_log(|log| log.threads.len())
    }
}

/// Whether this call of the kind is the one to be refused.
fn is_refused(kind: &'static str) -> bool {
    with_log(|log| match &mut log.refused {
        Some((refused, 0)) if *refused == kind => {
            log.refused = None;
            true
        }
        Some((refused, after)) if *refused == kind => {
            *after -= 1;
            false
        }
        _ => false,
    })
}

fn count_created(kind: &'static str) {
    with_log(|log| *log.created.entry(kind).or_default() += 1);
}

fn count_destroyed(kind: &'static str, handle: impl Handle) {
    if !handle.is_null() {
        with_log(|log| *log.destroyed.entry(kind).or_default() += 1);
    }
}

unsafe extern "system" fn create_compute_pipelines(
    device: vk::Device,
    cache: vk::PipelineCache,
    count: u32,
    infos: *const vk::ComputePipelineCreateInfo<'_>,
    allocator: *const vk::AllocationCallbacks<'_>,
    pipelines: *mut vk::Pipeline,
) -> vk::Result {
    let mut log = LOG.lock().unwrap_or_else(PoisonError::into_inner);
    let entry = log.get_or_insert_default();
    entry.caches.push(cache);
    entry.threads.insert(std::thread::current().id());
    entry.arrived += 1;
    ARRIVED.notify_all();
    // Waiting ends, so that a test fails instead of hanging.
    let alone = |log: &mut Option<Log>| log.as_ref().is_some_and(|log| log.arrived < log.together);
    drop(ARRIVED.wait_timeout_while(log, Duration::from_secs(30), alone).unwrap_or_else(PoisonError::into_inner));
    if is_refused("pipeline") {
        // SAFETY: there is room for so many.
        unsafe { std::slice::from_raw_parts_mut(pipelines, count as usize) }.fill(vk::Pipeline::null());
        return REFUSED;
    }
    // SAFETY: what was given is passed on.
    let result = unsafe { (real().device().fp_v1_0().create_compute_pipelines)(device, cache, count, infos, allocator, pipelines) };
    if result == vk::Result::SUCCESS {
        count_created("pipeline");
    }
    result
}

unsafe extern "system" fn destroy_pipeline(
    device: vk::Device,
    handle: vk::Pipeline,
    allocator: *const vk::AllocationCallbacks<'_>,
) {
    count_destroyed("pipeline", handle);
    // SAFETY: what was given is passed on.
    unsafe { (real().device().fp_v1_0().destroy_pipeline)(device, handle, allocator) }
}

macro_rules! counted {
    ($($kind:literal: $create:ident $create_name:literal $info:ident $handle:ident, $destroy:ident $destroy_name:literal;)*) => {
        $(
            unsafe extern "system" fn $create(
                device: vk::Device,
                info: *const vk::$info<'_>,
                allocator: *const vk::AllocationCallbacks<'_>,
                handle: *mut vk::$handle,
            ) -> vk::Result {
                if is_refused($kind) {
                    return REFUSED;
                }
                // SAFETY: what was given is passed on.
                let result = unsafe { (real().device().fp_v1_0().$create)(device, info, allocator, handle) };
                if result == vk::Result::SUCCESS {
                    count_created($kind);
                }
                result
            }

            unsafe extern "system" fn $destroy(
                device: vk::Device,
                handle: vk::$handle,
                allocator: *const vk::AllocationCallbacks<'_>,
            ) {
                count_destroyed($kind, handle);
                // SAFETY: what was given is passed on.
                unsafe { (real().device().fp_v1_0().$destroy)(device, handle, allocator) }
            }
        )*

        /// The function that stands before one of the device.
        fn replacement(name: &CStr) -> Option<*const c_void> {
            match name.to_bytes() {
                b"vkCreateComputePipelines" => Some(create_compute_pipelines as *const c_void),
                b"vkDestroyPipeline" => Some(destroy_pipeline as *const c_void),
                $(
                    $create_name => Some($create as *const c_void),
                    $destroy_name => Some($destroy as *const c_void),
                )*
                _ => None,
            }
        }
    };
}

counted! {
    "shader module": create_shader_module b"vkCreateShaderModule" ShaderModuleCreateInfo ShaderModule,
        destroy_shader_module b"vkDestroyShaderModule";
    "set layout": create_descriptor_set_layout b"vkCreateDescriptorSetLayout" DescriptorSetLayoutCreateInfo DescriptorSetLayout,
        destroy_descriptor_set_layout b"vkDestroyDescriptorSetLayout";
    "pipeline layout": create_pipeline_layout b"vkCreatePipelineLayout" PipelineLayoutCreateInfo PipelineLayout,
        destroy_pipeline_layout b"vkDestroyPipelineLayout";
    "descriptor pool": create_descriptor_pool b"vkCreateDescriptorPool" DescriptorPoolCreateInfo DescriptorPool,
        destroy_descriptor_pool b"vkDestroyDescriptorPool";
    "image": create_image b"vkCreateImage" ImageCreateInfo Image, destroy_image b"vkDestroyImage";
    "view": create_image_view b"vkCreateImageView" ImageViewCreateInfo ImageView, destroy_image_view b"vkDestroyImageView";
    "buffer": create_buffer b"vkCreateBuffer" BufferCreateInfo Buffer, destroy_buffer b"vkDestroyBuffer";
    "query pool": create_query_pool b"vkCreateQueryPool" QueryPoolCreateInfo QueryPool,
        destroy_query_pool b"vkDestroyQueryPool";
    "memory": allocate_memory b"vkAllocateMemory" MemoryAllocateInfo DeviceMemory, free_memory b"vkFreeMemory";
}
