//! Time per pass by timestamps, read when a frame slot comes round again, so that nothing waits.

use crate::error::Error;
use crate::record::Device;
use ash::vk;

/// GPU time of one pass.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// Name of the pass.
    pub name: String,
    /// Milliseconds.
    pub milliseconds: f64,
}

pub(crate) struct Profiler {
    device: ash::Device,
    pools: Vec<vk::QueryPool>,
    recorded: Vec<bool>,
    ticks: Vec<u64>,
    newest: Vec<f64>,
    /// Nanoseconds per tick.
    period: f64,
    queries_per_stamp: usize,
    /// Whether the device lacks synchronization2.
    legacy: bool,
}

impl Profiler {
    /// # Safety
    /// Obligations of `Executor::new`.
    pub(crate) unsafe fn new(host: Device<'_>, slots: u32, passes: usize, legacy: bool) -> Result<Self, Error> {
        // SAFETY: instance and physical device are live and belong together.
        let properties = unsafe { host.instance.get_physical_device_properties(host.physical_device) };
        // llvmpipe takes the time when it flushes its scene, which the next timestamp makes it do, if anything was ever drawn on
        // the queue.
        let queries_per_stamp = if properties.device_type == vk::PhysicalDeviceType::CPU { 2 } else { 1 };
        let queries = 2 * passes * queries_per_stamp;
        let mut this = Self {
            device: host.device.clone(),
            pools: Vec::new(),
            recorded: vec![false; slots as usize],
            ticks: vec![0; queries],
            newest: Vec::with_capacity(passes),
            period: f64::from(properties.limits.timestamp_period),
            queries_per_stamp,
            legacy,
        };
        for _ in 0..slots {
            let info = vk::QueryPoolCreateInfo::default().query_type(vk::QueryType::TIMESTAMP).query_count(queries as u32);
            // SAFETY: the device is live, and outlives the pools: the host keeps it until the executor is gone.
            let pool = unsafe { host.device.create_query_pool(&info, None) }.map_err(Error::vulkan("vkCreateQueryPool"))?;
            this.pools.push(pool);
        }
        Ok(this)
    }

    /// Reads the results of the slot's last frame.
    pub(crate) fn collect(&mut self, slot: u32) -> Result<(), Error> {
        if !std::mem::take(&mut self.recorded[slot as usize]) {
            return Ok(());
        }
        // SAFETY: the pool is ours; work of the slot is complete, or the results are not ready and that is reported.
        let result = unsafe {
            self.device.get_query_pool_results(self.pools[slot as usize], 0, &mut self.ticks, vk::QueryResultFlags::TYPE_64)
        };
        match result {
            Ok(()) => {
                self.newest.clear();
                let n = self.queries_per_stamp;
                let milliseconds = |t: &[u64]| t[n].wrapping_sub(t[0]) as f64 * self.period * 1e-6;
                self.newest.extend(self.ticks.chunks_exact(2 * n).map(milliseconds));
                Ok(())
            }
            Err(vk::Result::NOT_READY) => Ok(()),
            Err(result) => Err(Error::Vulkan { call: "vkGetQueryPoolResults", result }),
        }
    }

    /// # Safety
    /// Obligations of `Executor::record`.
    pub(crate) unsafe fn start(&mut self, cmd: vk::CommandBuffer, slot: u32) {
        self.recorded[slot as usize] = true;
        // SAFETY: `cmd` is recording outside a render pass; the pool is ours, and the work that used it last, of this slot, is
        // complete.
        unsafe { self.device.cmd_reset_query_pool(cmd, self.pools[slot as usize], 0, self.ticks.len() as u32) };
    }

    /// # Safety
    /// Obligations of `Executor::record`.
    pub(crate) unsafe fn before_pass(&self, cmd: vk::CommandBuffer, slot: u32, pass: usize) {
        // SAFETY: `cmd` is recording; `start` has reset the queries of this slot, and each is written once.
        unsafe { self.stamp(cmd, slot, 2 * pass as u32) };
    }

    /// # Safety
    /// Obligations of `Executor::record`.
    pub(crate) unsafe fn after_pass(&self, cmd: vk::CommandBuffer, slot: u32, pass: usize) {
        // SAFETY: `cmd` is recording; `start` has reset the queries of this slot, and each is written once.
        unsafe { self.stamp(cmd, slot, 2 * pass as u32 + 1) };
    }

    unsafe fn stamp(&self, cmd: vk::CommandBuffer, slot: u32, stamp: u32) {
        let (pool, n) = (self.pools[slot as usize], self.queries_per_stamp as u32);
        for query in stamp * n..(stamp + 1) * n {
            // SAFETY: `cmd` is recording on a device with synchronization2, or without where `legacy` is set; the pool is ours, and
            // the query was reset in this frame.
            unsafe {
                if self.legacy {
                    self.device.cmd_write_timestamp(cmd, vk::PipelineStageFlags::ALL_COMMANDS, pool, query);
                } else {
                    self.device.cmd_write_timestamp2(cmd, vk::PipelineStageFlags2::ALL_COMMANDS, pool, query);
                }
            }
        }
    }

    pub(crate) fn times<'a>(&self, names: impl Iterator<Item = &'a str>) -> Vec<PassTime> {
        names.zip(&self.newest).map(|(name, &milliseconds)| PassTime { name: name.to_owned(), milliseconds }).collect()
    }
}

impl Drop for Profiler {
    fn drop(&mut self) {
        for &pool in &self.pools {
            // SAFETY: ours, and the owner waits for the GPU first.
            unsafe { self.device.destroy_query_pool(pool, None) };
        }
    }
}
