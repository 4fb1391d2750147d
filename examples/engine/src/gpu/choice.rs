//! Which device, and with which features.

use std::ffi::CStr;
use std::fmt;

use ash::vk;

use super::GpuOptions;
use crate::error::{Doing, Error, Result};

/// A device of this machine.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DeviceInfo {
    /// Its index, good for [`super::GpuOptions::device`].
    pub index: usize,
    /// Its name as the driver gives it.
    pub name: String,
    /// Discrete, integrated, virtual, software or other.
    pub kind: &'static str,
}

impl fmt::Display for DeviceInfo {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {} ({})", self.index, self.name, self.kind)
    }
}

/// The chosen device and what it can do.
pub struct Chosen {
    pub physical_device: vk::PhysicalDevice,
    pub info: DeviceInfo,
    pub queue_family: u32,
    pub limits: vk::PhysicalDeviceLimits,
    pub timestamps: bool,
    pub synchronization2: bool,
    version: u32,
    features: vk::PhysicalDeviceFeatures,
}

/// Every device with a compute queue.
pub fn list(instance: &ash::Instance) -> Result<Vec<DeviceInfo>> {
    Ok(candidates(instance)?.into_iter().map(|candidate| candidate.info).collect())
}

/// The device that `wanted` names, else the best.
pub fn choose(instance: &ash::Instance, options: &GpuOptions) -> Result<Chosen> {
    let wanted = options.device.as_deref();
    let mut all = candidates(instance)?;
    if all.is_empty() {
        return Err(Error::NoDevice);
    }
    for name in &options.device_extensions {
        all.retain(|c| has_extension(instance, c.physical_device, name));
        if all.is_empty() {
            return Err(Error::NoExtension { name: name.to_string_lossy().into_owned() });
        }
    }
    let position = match wanted {
        None => all.iter().enumerate().min_by_key(|(index, c)| (rank(c.info.kind), *index)).map(|(index, _)| index),
        Some(text) => all.iter().position(|c| matches(&c.info, text)),
    };
    match position {
        Some(position) => Ok(all.swap_remove(position)),
        None => Err(Error::DeviceNotFound {
            wanted: wanted.unwrap_or_default().to_string(),
            available: all.iter().map(|c| c.info.to_string()).collect::<Vec<_>>().join("; "),
        }),
    }
}

/// Opens the device with synchronization2 and the storage image features that it has.
pub fn create_device(instance: &ash::Instance, chosen: &Chosen, extensions: &[&CStr]) -> Result<ash::Device> {
    let priorities = [1.0];
    let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(chosen.queue_family).queue_priorities(&priorities)];
    let available = chosen.features;
    let features = vk::PhysicalDeviceFeatures {
        shader_storage_image_extended_formats: available.shader_storage_image_extended_formats,
        shader_storage_image_read_without_format: available.shader_storage_image_read_without_format,
        shader_storage_image_write_without_format: available.shader_storage_image_write_without_format,
        ..Default::default()
    };
    let mut synchronization2 = vk::PhysicalDeviceSynchronization2Features::default().synchronization2(true);
    let mut info = vk::DeviceCreateInfo::default().queue_create_infos(&queues).enabled_features(&features);
    let mut extensions: Vec<_> = extensions.iter().map(|name| name.as_ptr()).collect();
    if chosen.synchronization2 {
        info = info.push_next(&mut synchronization2);
        if chosen.version < vk::API_VERSION_1_3 {
            extensions.push(ash::khr::synchronization2::NAME.as_ptr());
        }
    }
    info = info.enabled_extension_names(&extensions);
    // SAFETY: the physical device is one of this instance's; features and extensions asked for were found on it.
    unsafe { instance.create_device(chosen.physical_device, &info, None) }.doing("create a device")
}

fn matches(info: &DeviceInfo, text: &str) -> bool {
    text.parse() == Ok(info.index) || info.name.to_lowercase().contains(&text.to_lowercase())
}

fn rank(kind: &str) -> u32 {
    match kind {
        "discrete" => 0,
        "integrated" => 1,
        "virtual" => 2,
        "software" => 3,
        _ => 4,
    }
}

fn candidates(instance: &ash::Instance) -> Result<Vec<Chosen>> {
    // SAFETY: the instance is alive.
    let devices = unsafe { instance.enumerate_physical_devices() }.doing("list the devices")?;
    Ok(devices.into_iter().enumerate().filter_map(|(index, device)| inspect(instance, index, device)).collect())
}

fn inspect(instance: &ash::Instance, index: usize, physical_device: vk::PhysicalDevice) -> Option<Chosen> {
    // SAFETY: plain queries of a physical device that this instance has listed.
    let (properties, features, families) = unsafe {
        (
            instance.get_physical_device_properties(physical_device),
            instance.get_physical_device_features(physical_device),
            instance.get_physical_device_queue_family_properties(physical_device),
        )
    };
    if properties.api_version < vk::API_VERSION_1_1 {
        return None;
    }
    let all = vk::QueueFlags::COMPUTE | vk::QueueFlags::GRAPHICS;
    let family = families
        .iter()
        .position(|family| family.queue_flags.contains(all))
        .or_else(|| families.iter().position(|family| family.queue_flags.contains(vk::QueueFlags::COMPUTE)))?;
    let name = properties.device_name_as_c_str().unwrap_or(c"unnamed").to_string_lossy().into_owned();
    let kind = match properties.device_type {
        vk::PhysicalDeviceType::DISCRETE_GPU => "discrete",
        vk::PhysicalDeviceType::INTEGRATED_GPU => "integrated",
        vk::PhysicalDeviceType::VIRTUAL_GPU => "virtual",
        vk::PhysicalDeviceType::CPU => "software",
        _ => "other",
    };
    Some(Chosen {
        physical_device,
        info: DeviceInfo { index, name, kind },
        queue_family: family as u32,
        limits: properties.limits,
        timestamps: families[family].timestamp_valid_bits > 0,
        synchronization2: has_synchronization2(instance, physical_device, properties.api_version),
        version: properties.api_version,
        features,
    })
}

fn has_extension(instance: &ash::Instance, device: vk::PhysicalDevice, name: &CStr) -> bool {
    // SAFETY: a plain query of a physical device of this instance.
    let extensions = unsafe { instance.enumerate_device_extension_properties(device) }.unwrap_or_default();
    extensions.iter().any(|extension| extension.extension_name_as_c_str() == Ok(name))
}

fn has_synchronization2(instance: &ash::Instance, device: vk::PhysicalDevice, version: u32) -> bool {
    if version < vk::API_VERSION_1_3 && !has_extension(instance, device, ash::khr::synchronization2::NAME) {
        return false;
    }
    let mut synchronization2 = vk::PhysicalDeviceSynchronization2Features::default();
    let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut synchronization2);
    // SAFETY: Vulkan 1.1 is there, and the chained structure is known to the device.
    unsafe { instance.get_physical_device_features2(device, &mut features) };
    synchronization2.synchronization2 == vk::TRUE
}
