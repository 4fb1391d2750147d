//! Vulkan calls that fail on demand: functions that stand between a device and whoever calls it.
//!
//! One device at a time has them, since functions of C know of no test.

#![allow(unsafe_code)]

use ash::vk;
use std::collections::BTreeMap;
use std::ffi::{c_void, CStr};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// A call that is to fail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Function, as `vkQueueSubmit`.
    pub call: &'static str,
    /// Calls of it that come before and succeed.
    pub after: u32,
    /// What it returns. After `ERROR_DEVICE_LOST` every call that may return that does.
    pub result: vk::Result,
}

#[derive(Default)]
struct State {
    real: Option<ash::Device>,
    seen: BTreeMap<&'static str, u32>,
    faults: Vec<Fault>,
    is_lost: bool,
}

static STATE: Mutex<Option<State>> = Mutex::new(None);

fn with<T>(body: impl FnOnce(&mut State) -> T) -> T {
    body(STATE.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert_default())
}

fn real() -> ash::Device {
    with(|state| state.real.clone()).expect("Faults::new was given the device")
}

/// The faults of the one device that has these functions.
pub struct Faults {
    _alone: MutexGuard<'static, ()>,
}

impl Faults {
    /// `device` has the functions that are called where none is to fail. Another one is waited for.
    pub fn new(device: &ash::Device) -> Self {
        static ALONE: Mutex<()> = Mutex::new(());
        let alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
        with(|state| *state = State { real: Some(device.clone()), ..State::default() });
        Self { _alone: alone }
    }

    /// Counts calls anew, and has these fail. A device that was lost is there again.
    pub fn set(&self, faults: &[Fault]) {
        with(|state| *state = State { real: state.real.take(), faults: faults.to_vec(), ..State::default() });
    }

    /// Whether all calls came that were to fail.
    pub fn are_spent(&self) -> bool {
        with(|state| state.faults.is_empty())
    }

    /// Calls of each function since the last [`Self::set`].
    pub fn seen(&self) -> BTreeMap<&'static str, u32> {
        with(|state| state.seen.clone())
    }
}

/// What a function returns in the place of its own result; `None`: it is called.
fn refusal(call: &'static str, can_lose: bool) -> Option<vk::Result> {
    with(|state| {
        *state.seen.entry(call).or_default() += 1;
        if state.is_lost && can_lose {
            return Some(vk::Result::ERROR_DEVICE_LOST);
        }
        let due = state.faults.iter().position(|fault| fault.call == call && fault.after == 0);
        state.faults.iter_mut().filter(|fault| fault.call == call && fault.after > 0).for_each(|fault| fault.after -= 1);
        let result = state.faults.remove(due?).result;
        state.is_lost = result == vk::Result::ERROR_DEVICE_LOST;
        Some(result)
    })
}

macro_rules! functions {
    ($($table:ident $call:literal $function:ident ($($argument:ident: $type:ty),*) $how:ident;)*) => {
        $(
            unsafe extern "system" fn $function(device: vk::Device, $($argument: $type),*) -> vk::Result {
                // SAFETY: what was given is passed on.
                let pass_on = || unsafe { (real().$table().$function)(device, $($argument),*) };
                functions!(@ $how $call pass_on)
            }
        )*

        /// The function that stands for one of this name.
        pub fn replacement(name: &CStr) -> Option<*const c_void> {
            let name = name.to_str().ok()?;
            $(if name == $call { return Some($function as *const c_void); })*
            match name {
                "vkQueueSubmit" => Some(queue_submit as *const c_void),
                "vkQueueWaitIdle" => Some(queue_wait_idle as *const c_void),
                "vkBeginCommandBuffer" => Some(begin_command_buffer as *const c_void),
                "vkEndCommandBuffer" => Some(end_command_buffer as *const c_void),
                _ => None,
            }
        }
    };
    // It does nothing where it fails.
    (@ plain $call:literal $pass_on:ident) => { refusal($call, false).unwrap_or_else($pass_on) };
    // A lost device fails it.
    (@ lost $call:literal $pass_on:ident) => { refusal($call, true).unwrap_or_else($pass_on) };
    // A lost device has completed everything, which the layers that follow it have to see.
    (@ waits $call:literal $pass_on:ident) => {
        match refusal($call, true) {
            Some(vk::Result::ERROR_DEVICE_LOST) => {
                let _ = $pass_on();
                vk::Result::ERROR_DEVICE_LOST
            }
            Some(result) => result,
            None => $pass_on(),
        }
    };
}

type Allocator = *const vk::AllocationCallbacks<'static>;

functions! {
    fp_v1_0 "vkAllocateMemory" allocate_memory(info: *const vk::MemoryAllocateInfo<'_>, allocator: Allocator, memory: *mut vk::DeviceMemory) plain;
    fp_v1_0 "vkMapMemory" map_memory(memory: vk::DeviceMemory, offset: u64, size: u64, flags: vk::MemoryMapFlags, data: *mut *mut c_void) plain;
    fp_v1_0 "vkBindImageMemory" bind_image_memory(image: vk::Image, memory: vk::DeviceMemory, offset: u64) plain;
    fp_v1_0 "vkBindBufferMemory" bind_buffer_memory(buffer: vk::Buffer, memory: vk::DeviceMemory, offset: u64) plain;
    fp_v1_0 "vkCreateImage" create_image(info: *const vk::ImageCreateInfo<'_>, allocator: Allocator, image: *mut vk::Image) plain;
    fp_v1_0 "vkCreateImageView" create_image_view(info: *const vk::ImageViewCreateInfo<'_>, allocator: Allocator, view: *mut vk::ImageView) plain;
    fp_v1_0 "vkCreateBuffer" create_buffer(info: *const vk::BufferCreateInfo<'_>, allocator: Allocator, buffer: *mut vk::Buffer) plain;
    fp_v1_0 "vkCreateCommandPool" create_command_pool(info: *const vk::CommandPoolCreateInfo<'_>, allocator: Allocator, pool: *mut vk::CommandPool) plain;
    fp_v1_0 "vkCreateFence" create_fence(info: *const vk::FenceCreateInfo<'_>, allocator: Allocator, fence: *mut vk::Fence) plain;
    fp_v1_0 "vkCreateQueryPool" create_query_pool(info: *const vk::QueryPoolCreateInfo<'_>, allocator: Allocator, pool: *mut vk::QueryPool) plain;
    fp_v1_0 "vkAllocateCommandBuffers" allocate_command_buffers(info: *const vk::CommandBufferAllocateInfo<'_>, commands: *mut vk::CommandBuffer) plain;
    fp_v1_0 "vkAllocateDescriptorSets" allocate_descriptor_sets(info: *const vk::DescriptorSetAllocateInfo<'_>, sets: *mut vk::DescriptorSet) plain;
    fp_v1_1 "vkCreateDescriptorUpdateTemplate" create_descriptor_update_template(info: *const vk::DescriptorUpdateTemplateCreateInfo<'_>, allocator: Allocator, template: *mut vk::DescriptorUpdateTemplate) plain;
    fp_v1_0 "vkResetFences" reset_fences(count: u32, fences: *const vk::Fence) plain;
    fp_v1_0 "vkGetQueryPoolResults" get_query_pool_results(pool: vk::QueryPool, first: u32, count: u32, size: usize, data: *mut c_void, stride: u64, flags: vk::QueryResultFlags) lost;
    fp_v1_0 "vkWaitForFences" wait_for_fences(count: u32, fences: *const vk::Fence, all: vk::Bool32, timeout: u64) waits;
    fp_v1_0 "vkDeviceWaitIdle" device_wait_idle() waits;
}

unsafe extern "system" fn queue_submit(
    queue: vk::Queue,
    count: u32,
    submits: *const vk::SubmitInfo<'_>,
    fence: vk::Fence,
) -> vk::Result {
    // SAFETY: what was given is passed on.
    let pass_on = || unsafe { (real().fp_v1_0().queue_submit)(queue, count, submits, fence) };
    functions!(@ lost "vkQueueSubmit" pass_on)
}

unsafe extern "system" fn queue_wait_idle(queue: vk::Queue) -> vk::Result {
    // SAFETY: what was given is passed on.
    let pass_on = || unsafe { (real().fp_v1_0().queue_wait_idle)(queue) };
    functions!(@ waits "vkQueueWaitIdle" pass_on)
}

unsafe extern "system" fn begin_command_buffer(
    commands: vk::CommandBuffer,
    info: *const vk::CommandBufferBeginInfo<'_>,
) -> vk::Result {
    // SAFETY: what was given is passed on.
    let pass_on = || unsafe { (real().fp_v1_0().begin_command_buffer)(commands, info) };
    functions!(@ plain "vkBeginCommandBuffer" pass_on)
}

/// Ends recording even where it fails: nothing goes on recording behind it.
unsafe extern "system" fn end_command_buffer(commands: vk::CommandBuffer) -> vk::Result {
    // SAFETY: what was given is passed on.
    let result = unsafe { (real().fp_v1_0().end_command_buffer)(commands) };
    refusal("vkEndCommandBuffer", false).unwrap_or(result)
}
