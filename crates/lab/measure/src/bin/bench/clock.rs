//! What time is measured by, and what a submission without work costs by it.

use ash::vk;
use atrous::executor::HeadlessDevice;
use cpu_time::ProcessTime;
use serde::{Deserialize, Serialize};
use std::error::Error;
use std::sync::Arc;

#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Clock {
    /// Timestamps of the device around each pass.
    GpuTimestamps,
    /// CPU time of all threads of this process while a pass, submitted by itself, is waited for. On a device that is the CPU it is
    /// steady where time on a wall clock is not.
    ProcessCpuTime,
}

impl Clock {
    /// Timestamps, where the device has them.
    pub fn timestamps(gpu: &HeadlessDevice) -> Result<Self, Box<dyn Error>> {
        if !gpu.has_timestamps() {
            return Err(format!("the queue of {} has no timestamps, so its passes cannot be timed", gpu.name()).into());
        }
        Ok(Self::GpuTimestamps)
    }

    pub fn title(self) -> &'static str {
        match self {
            Self::GpuTimestamps => "GPU timestamps",
            Self::ProcessCpuTime => "CPU time of the process",
        }
    }
}

/// Whether a device is the CPU.
pub fn is_cpu(gpu: &HeadlessDevice) -> bool {
    let host = gpu.host();
    // SAFETY: instance and physical device are live and belong together.
    let properties = unsafe { host.instance.get_physical_device_properties(host.physical_device) };
    properties.device_type == vk::PhysicalDeviceType::CPU
}

/// A command buffer without commands, submitted and waited for as a pass is.
pub struct EmptySubmission {
    gpu: Arc<HeadlessDevice>,
    pool: vk::CommandPool,
    cmd: vk::CommandBuffer,
    fence: vk::Fence,
}

impl EmptySubmission {
    pub fn new(gpu: &Arc<HeadlessDevice>) -> Result<Self, vk::Result> {
        let device = gpu.device();
        let (pool, cmd, fence) = (vk::CommandPool::null(), vk::CommandBuffer::null(), vk::Fence::null());
        let mut this = Self { gpu: gpu.clone(), pool, cmd, fence };
        let info = vk::CommandPoolCreateInfo::default()
            .queue_family_index(gpu.queue_family())
            .flags(vk::CommandPoolCreateFlags::RESET_COMMAND_BUFFER);
        // SAFETY: the device is live; what was created is destroyed with `this`.
        unsafe {
            this.pool = device.create_command_pool(&info, None)?;
            let info = vk::CommandBufferAllocateInfo::default().command_pool(this.pool).command_buffer_count(1);
            this.cmd = device.allocate_command_buffers(&info)?.first().copied().unwrap_or_default();
            this.fence = device.create_fence(&vk::FenceCreateInfo::default(), None)?;
        }
        Ok(this)
    }

    /// The command buffer: idle whenever this is not borrowed mutably.
    pub fn command_buffer(&self) -> vk::CommandBuffer {
        self.cmd
    }

    /// CPU time of one, milliseconds.
    pub fn milliseconds(&mut self) -> Result<f64, vk::Result> {
        let start = ProcessTime::now();
        let device = self.gpu.device();
        // SAFETY: command buffer and fence are ours and idle, since every submission is waited for.
        unsafe {
            let info = vk::CommandBufferBeginInfo::default().flags(vk::CommandBufferUsageFlags::ONE_TIME_SUBMIT);
            device.begin_command_buffer(self.cmd, &info)?;
            device.end_command_buffer(self.cmd)?;
            let commands = [self.cmd];
            let submit = vk::SubmitInfo::default().command_buffers(&commands);
            device.queue_submit(*self.gpu.queue(), &[submit], self.fence)?;
            device.wait_for_fences(&[self.fence], true, u64::MAX)?;
            device.reset_fences(&[self.fence])?;
        }
        Ok(start.elapsed().as_secs_f64() * 1e3)
    }
}

impl Drop for EmptySubmission {
    fn drop(&mut self) {
        // SAFETY: ours and idle; null handles are ignored.
        unsafe {
            self.gpu.device().destroy_fence(self.fence, None);
            self.gpu.device().destroy_command_pool(self.pool, None);
        }
    }
}
