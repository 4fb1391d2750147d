//! A device that notes what the executor records, instead of recording it: barriers, work, and where images and buffers lie.

use crate::support::intercepted::Intercepted;
use ash::vk;
use ash::vk::Handle;
use atrous::executor::HeadlessDevice;
use atrous::Device;
use std::collections::BTreeMap;
use std::ffi::{c_void, CStr};
use std::sync::{Arc, Mutex, PoisonError};

/// Stage and access mask of one side of a barrier.
pub type Side = (vk::PipelineStageFlags2, vk::AccessFlags2);

/// One barrier; of all memory where it has no handle.
#[derive(Clone, Copy, Debug)]
pub struct Barrier {
    pub handle: Option<u64>,
    pub from: Side,
    pub to: Side,
}

/// What was recorded, in order.
#[derive(Clone, Debug)]
pub enum Event {
    /// The barriers of one call.
    Barriers(Vec<Barrier>),
    /// A dispatch, a clear, an update or a fill.
    Work,
    /// A copy out of an image or a buffer.
    Copy(u64),
}

/// Bytes of device memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    memory: u64,
    offset: u64,
    size: u64,
}

impl Place {
    pub fn overlaps(&self, other: &Self) -> bool {
        self.memory == other.memory && self.offset < other.offset + other.size && other.offset < self.offset + self.size
    }
}

#[derive(Default)]
struct Log {
    /// The device that calls are passed on to.
    gpu: Option<Arc<HeadlessDevice>>,
    events: Vec<Event>,
    sizes: BTreeMap<u64, u64>,
    places: BTreeMap<u64, Place>,
    pipelines: u64,
}

static LOG: Mutex<Option<Log>> = Mutex::new(None);

fn with_log<T>(body: impl FnOnce(&mut Log) -> T) -> T {
    body(LOG.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_default())
}

fn real() -> Arc<HeadlessDevice> {
    with_log(|log| log.gpu.clone()).expect("Recorder::new gave it")
}

/// The device.
pub struct Recorder(Intercepted);

impl Recorder {
    pub fn new() -> Self {
        static ALONE: Mutex<()> = Mutex::new(());
        // SAFETY: the functions have the signatures of those that they stand for.
        Self(unsafe {
            Intercepted::new(&ALONE, |gpu| with_log(|log| *log = Log { gpu: Some(gpu), ..Log::default() }), replacement)
        })
    }

    /// The handles for an executor.
    pub fn host(&self) -> Device<'_> {
        self.0.host()
    }

    /// What was recorded since this was called last.
    pub fn take(&self) -> Vec<Event> {
        with_log(|log| std::mem::take(&mut log.events))
    }

    /// Where an image or a buffer lies; `None` for one of a host.
    pub fn place(&self, handle: u64) -> Option<Place> {
        with_log(|log| log.places.get(&handle).copied())
    }
}

fn note(event: Event) {
    with_log(|log| log.events.push(event));
}

fn note_place(handle: u64, memory: vk::DeviceMemory, offset: u64) {
    with_log(|log| {
        let size = log.sizes.get(&handle).copied().unwrap_or_default();
        log.places.insert(handle, Place { memory: memory.as_raw(), offset, size });
    });
}

unsafe extern "system" fn barriers(_: vk::CommandBuffer, info: *const vk::DependencyInfo<'_>) {
    /// # Safety
    /// As many elements follow the pointer, unless it is null.
    unsafe fn list<'a, T>(first: *const T, count: u32) -> &'a [T] {
        if first.is_null() {
            return &[];
        }
        // SAFETY: the caller of the Vulkan function gave so many elements.
        unsafe { std::slice::from_raw_parts(first, count as usize) }
    }
    // SAFETY: the caller gives a valid structure, with as many barriers as it says.
    let (globals, images, buffers) = unsafe {
        let info = &*info;
        (
            list(info.p_memory_barriers, info.memory_barrier_count),
            list(info.p_image_memory_barriers, info.image_memory_barrier_count),
            list(info.p_buffer_memory_barriers, info.buffer_memory_barrier_count),
        )
    };
    macro_rules! barrier {
        ($b:expr, $handle:expr) => {
            Barrier { handle: $handle, from: ($b.src_stage_mask, $b.src_access_mask), to: ($b.dst_stage_mask, $b.dst_access_mask) }
        };
    }
    let globals = globals.iter().map(|b| barrier!(b, None));
    let images = images.iter().map(|b| barrier!(b, Some(b.image.as_raw())));
    let buffers = buffers.iter().map(|b| barrier!(b, Some(b.buffer.as_raw())));
    note(Event::Barriers(globals.chain(images).chain(buffers).collect()));
}

unsafe extern "system" fn dispatch(_: vk::CommandBuffer, _: u32, _: u32, _: u32) {
    note(Event::Work);
}

unsafe extern "system" fn update(_: vk::CommandBuffer, _: vk::Buffer, _: u64, _: u64, _: *const c_void) {
    note(Event::Work);
}

unsafe extern "system" fn fill(_: vk::CommandBuffer, _: vk::Buffer, _: u64, _: u64, _: u32) {
    note(Event::Work);
}

unsafe extern "system" fn clear(
    _: vk::CommandBuffer,
    _: vk::Image,
    _: vk::ImageLayout,
    _: *const vk::ClearColorValue,
    _: u32,
    _: *const vk::ImageSubresourceRange,
) {
    note(Event::Work);
}

unsafe extern "system" fn copy_image(
    _: vk::CommandBuffer,
    image: vk::Image,
    _: vk::ImageLayout,
    _: vk::Buffer,
    _: u32,
    _: *const vk::BufferImageCopy,
) {
    note(Event::Copy(image.as_raw()));
}

unsafe extern "system" fn copy_buffer(_: vk::CommandBuffer, from: vk::Buffer, _: vk::Buffer, _: u32, _: *const vk::BufferCopy) {
    note(Event::Copy(from.as_raw()));
}

unsafe extern "system" fn bind_pipeline(_: vk::CommandBuffer, _: vk::PipelineBindPoint, _: vk::Pipeline) {}

unsafe extern "system" fn bind_sets(
    _: vk::CommandBuffer,
    _: vk::PipelineBindPoint,
    _: vk::PipelineLayout,
    _: u32,
    _: u32,
    _: *const vk::DescriptorSet,
    _: u32,
    _: *const u32,
) {
}

unsafe extern "system" fn push(
    _: vk::CommandBuffer,
    _: vk::PipelineLayout,
    _: vk::ShaderStageFlags,
    _: u32,
    _: u32,
    _: *const c_void,
) {
}

unsafe extern "system" fn write_set(_: vk::Device, _: vk::DescriptorSet, _: vk::DescriptorUpdateTemplate, _: *const c_void) {}

unsafe extern "system" fn image_needs(device: vk::Device, image: vk::Image, needs: *mut vk::MemoryRequirements) {
    // SAFETY: what was given is passed on, and is written by it.
    unsafe {
        (real().device().fp_v1_0().get_image_memory_requirements)(device, image, needs);
        with_log(|log| log.sizes.insert(image.as_raw(), (*needs).size));
    }
}

unsafe extern "system" fn buffer_needs(device: vk::Device, buffer: vk::Buffer, needs: *mut vk::MemoryRequirements) {
    // SAFETY: what was given is passed on, and is written by it.
    unsafe {
        (real().device().fp_v1_0().get_buffer_memory_requirements)(device, buffer, needs);
        with_log(|log| log.sizes.insert(buffer.as_raw(), (*needs).size));
    }
}

unsafe extern "system" fn bind_image(device: vk::Device, image: vk::Image, memory: vk::DeviceMemory, offset: u64) -> vk::Result {
    note_place(image.as_raw(), memory, offset);
    // SAFETY: what was given is passed on.
    unsafe { (real().device().fp_v1_0().bind_image_memory)(device, image, memory, offset) }
}

unsafe extern "system" fn bind_buffer(device: vk::Device, buffer: vk::Buffer, memory: vk::DeviceMemory, offset: u64) -> vk::Result {
    note_place(buffer.as_raw(), memory, offset);
    // SAFETY: what was given is passed on.
    unsafe { (real().device().fp_v1_0().bind_buffer_memory)(device, buffer, memory, offset) }
}

/// Pipelines of no use: nothing runs.
unsafe extern "system" fn create_pipelines(
    _: vk::Device,
    _: vk::PipelineCache,
    count: u32,
    _: *const vk::ComputePipelineCreateInfo<'_>,
    _: *const vk::AllocationCallbacks<'_>,
    pipelines: *mut vk::Pipeline,
) -> vk::Result {
    // SAFETY: there is room for so many.
    for pipeline in unsafe { std::slice::from_raw_parts_mut(pipelines, count as usize) } {
        *pipeline = vk::Pipeline::from_raw(with_log(|log| {
            log.pipelines += 1;
            log.pipelines
        }));
    }
    vk::Result::SUCCESS
}

unsafe extern "system" fn destroy_pipeline(_: vk::Device, _: vk::Pipeline, _: *const vk::AllocationCallbacks<'_>) {}

/// The function that stands in for one of the device.
fn replacement(name: &CStr) -> Option<*const c_void> {
    Some(match name.to_bytes() {
        b"vkCmdPipelineBarrier2" => barriers as *const c_void,
        b"vkCmdDispatch" => dispatch as *const c_void,
        b"vkCmdUpdateBuffer" => update as *const c_void,
        b"vkCmdFillBuffer" => fill as *const c_void,
        b"vkCmdClearColorImage" => clear as *const c_void,
        b"vkCmdCopyImageToBuffer" => copy_image as *const c_void,
        b"vkCmdCopyBuffer" => copy_buffer as *const c_void,
        b"vkCmdBindPipeline" => bind_pipeline as *const c_void,
        b"vkCmdBindDescriptorSets" => bind_sets as *const c_void,
        b"vkCmdPushConstants" => push as *const c_void,
        b"vkUpdateDescriptorSetWithTemplate" => write_set as *const c_void,
        b"vkGetImageMemoryRequirements" => image_needs as *const c_void,
        b"vkGetBufferMemoryRequirements" => buffer_needs as *const c_void,
        b"vkBindImageMemory" => bind_image as *const c_void,
        b"vkBindBufferMemory" => bind_buffer as *const c_void,
        b"vkCreateComputePipelines" => create_pipelines as *const c_void,
        b"vkDestroyPipeline" => destroy_pipeline as *const c_void,
        _ => return None,
    })
}
