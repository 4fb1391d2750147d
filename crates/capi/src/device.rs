//! The device of a host: its functions, and whether it can run a configuration.

use crate::convert::flag;
use crate::graph::declaration_of;
use crate::pipelines::shared;
use crate::pointers::read;
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::AtrousCreateInfo;
use crate::GetInstanceProcAddr;
use ash::vk::{Handle, PipelineCache};
use atrous::{Device, LoadedDevice, Requirements, SharedPipelines};
use std::ffi::c_void;

/// The device of a host, with its pipelines.
pub(super) struct HostDevice {
    loaded: LoadedDevice,
    pipeline_cache: PipelineCache,
    pipelines: Option<SharedPipelines>,
}

impl HostDevice {
    pub(super) fn device(&self) -> Device<'_> {
        Device { pipeline_cache: self.pipeline_cache, pipelines: self.pipelines.as_ref(), ..self.loaded.device() }
    }
}

/// # Safety
/// Obligations of [`crate::atrous_create`].
pub(super) unsafe fn load(info: &AtrousCreateInfo) -> Result<HostDevice, Failure> {
    let get_instance_proc_addr = functions_of(info)?;
    if info.device.is_null() {
        return Err(null("device"));
    }
    // SAFETY: instance, physical device and device are not null, are live and belong together, and the host keeps them alive until
    // the object is destroyed.
    let loaded = unsafe {
        let handles = [info.instance.as_raw(), info.physical_device.as_raw(), info.device.as_raw()];
        Device::from_raw(get_instance_proc_addr as *const c_void, handles[0], handles[1], handles[2])?
    };
    Ok(HostDevice { loaded, pipeline_cache: info.pipeline_cache, pipelines: shared(info)? })
}

fn functions_of(info: &AtrousCreateInfo) -> Result<ash::vk::PFN_vkGetInstanceProcAddr, Failure> {
    let nulls = [("instance", info.instance.is_null()), ("physical_device", info.physical_device.is_null())];
    match nulls.iter().find(|(_, is_null)| *is_null) {
        Some((name, _)) => Err(null(name)),
        None => GetInstanceProcAddr::ok_or_else(info.get_instance_proc_addr, || null("get_instance_proc_addr")),
    }
}

/// Whether checks are made, if the host says it.
pub(super) fn checks(info: &AtrousCreateInfo) -> Result<Option<bool>, Failure> {
    if info.reserved != 0 {
        return Err(Failure::argument(format!("reserved is {}; set it to 0", info.reserved)));
    }
    match info.checks {
        0 => Ok(None),
        1 => Ok(Some(true)),
        2 => Ok(Some(false)),
        other => Err(Failure::argument(format!("checks is {other}; allowed: 0 (in debug builds), 1 (on), 2 (off)"))),
    }
}

fn null(name: &str) -> Failure {
    Failure::argument(format!("info->{name} is NULL; give the host's own"))
}

/// Tells whether a device can run a configuration or a graph, and creates nothing. The status is that of success, or of an unsupported device:
/// then atrous_last_error lists everything that is missing, for example a limit with its value. With a null `device` it looks at the
/// physical device alone, before you create one. `executor` 1: the needs of an executor as well.
///
/// # Safety
/// Pointers are null or valid with their struct_size set; handles are live and belong together, `device` may be null.
#[no_mangle]
pub unsafe extern "C" fn atrous_check_requirements(info: *const AtrousCreateInfo, executor: u32) -> AtrousStatus {
    guard(|| {
        // SAFETY: `info` and its `config` are null or point to structs that begin with their size.
        let (info, declaration) = unsafe {
            let info = read("info", info)?;
            (info, declaration_of(&info)?.0)
        };
        let legacy = flag("legacy_barriers", info.legacy_barriers)?;
        let is_executor = flag("executor", executor)? && !legacy;
        let requirements = Requirements::new(&declaration);
        let get_instance_proc_addr = functions_of(&info)?;
        // SAFETY: instance, physical device and, unless it is null, device are live and belong together.
        unsafe {
            if info.device.is_null() {
                let instance = ash::Instance::load(&ash::StaticFn { get_instance_proc_addr }, info.instance);
                return match is_executor {
                    true => Ok(requirements.check_executor(&instance, info.physical_device)?),
                    false => Ok(requirements.check(&instance, info.physical_device)?),
                };
            }
            let loaded = load(&info)?;
            requirements.check_device(loaded.device())?;
            if is_executor {
                requirements.check_executor_device(loaded.device())?;
            }
            Ok(())
        }
    })
}
