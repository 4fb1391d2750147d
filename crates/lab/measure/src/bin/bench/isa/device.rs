//! A device whose driver tells statistics of pipelines: `VK_KHR_pipeline_executable_properties`.

use crate::chip::driver_of;
use ash::{khr::pipeline_executable_properties as executables, vk};
use std::error::Error;
use std::ffi::CStr;

/// Instance and device, never destroyed: a null device of RADV crashes there. The process is about to end.
pub struct StatisticsDevice {
    // The loader must outlive every handle.
    _entry: ash::Entry,
    pub device: ash::Device,
    pub executables: executables::Device,
    /// Name of the device.
    pub name: String,
    /// Driver with its version.
    pub driver: String,
}

/// Reasons for which there are no statistics.
#[derive(Debug)]
pub enum OpenError {
    /// No device offers them; the devices that there are.
    None(String),
    Other(Box<dyn Error>),
}

impl<E: Into<Box<dyn Error>>> From<E> for OpenError {
    fn from(error: E) -> Self {
        Self::Other(error.into())
    }
}

/// A physical device that may be taken.
struct Candidate {
    physical: vk::PhysicalDevice,
    name: String,
    driver: String,
    offers: bool,
}

impl StatisticsDevice {
    /// Opens the first device that offers statistics, of those whose name contains `wanted`.
    pub fn open(wanted: Option<&str>) -> Result<Self, OpenError> {
        // SAFETY: the loader's initialisation is as safe as that library's; every pointer lives until its call returns.
        unsafe {
            let entry = ash::Entry::load().map_err(|e| format!("the Vulkan loader was not found ({e})"))?;
            let application = vk::ApplicationInfo::default().application_name(c"atrous bench").api_version(vk::API_VERSION_1_2);
            let info = vk::InstanceCreateInfo::default().application_info(&application);
            let instance = match entry.create_instance(&info, None) {
                Ok(instance) => instance,
                Err(vk::Result::ERROR_INCOMPATIBLE_DRIVER) => return Err(OpenError::None("no driver".to_owned())),
                Err(error) => return Err(format!("vkCreateInstance failed with {error}").into()),
            };
            let candidates: Vec<_> = instance.enumerate_physical_devices()?.into_iter().map(|d| candidate(&instance, d)).collect();
            let named = |c: &&Candidate| wanted.is_none_or(|w| c.name.to_lowercase().contains(&w.to_lowercase()));
            let Some(found) = candidates.iter().filter(named).find(|c| c.offers) else {
                let names: Vec<_> = candidates.iter().map(|c| c.name.as_str()).collect();
                return Err(OpenError::None(if names.is_empty() { "none".to_owned() } else { names.join(", ") }));
            };
            let device = create_device(&instance, found.physical)?;
            let executables = executables::Device::new(&instance, &device);
            let Candidate { name, driver, .. } = found;
            let (name, driver) = (name.clone(), driver.clone());
            Ok(Self { _entry: entry, device, executables, name, driver })
        }
    }
}

/// # Safety
/// The device was listed by the instance, which is live.
unsafe fn candidate(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Candidate {
    let text = |c: Result<&CStr, _>| c.map_or_else(|_| String::new(), |c| c.to_string_lossy().into_owned());
    // SAFETY: instance and device are live, and what is asked for is in Vulkan 1.2, which the device has where it is asked.
    unsafe {
        let properties = instance.get_physical_device_properties(physical);
        let name = text(properties.device_name_as_c_str());
        if properties.api_version < vk::API_VERSION_1_2 {
            return Candidate { physical, name, driver: String::new(), offers: false };
        }
        let driver = driver_of(instance, physical);
        let mut feature = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default();
        let extensions = instance.enumerate_device_extension_properties(physical).unwrap_or_default();
        let has_extension = extensions.iter().any(|e| e.extension_name_as_c_str() == Ok(executables::NAME));
        if has_extension {
            instance.get_physical_device_features2(physical, &mut vk::PhysicalDeviceFeatures2::default().push_next(&mut feature));
        }
        Candidate { physical, name, driver, offers: feature.pipeline_executable_info == vk::TRUE }
    }
}

/// # Safety
/// The device was listed by the instance, which is live, and offers the extension.
unsafe fn create_device(instance: &ash::Instance, physical: vk::PhysicalDevice) -> Result<ash::Device, Box<dyn Error>> {
    // SAFETY: instance and device are live; every pointer lives until its call returns.
    unsafe {
        let families = instance.get_physical_device_queue_family_properties(physical);
        let family = families.iter().position(|f| f.queue_flags.contains(vk::QueueFlags::COMPUTE));
        let family = family.ok_or("the device has no queue with COMPUTE")? as u32;
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&[1.0])];
        let extensions = [executables::NAME.as_ptr()];
        let mut feature = vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR::default().pipeline_executable_info(true);
        let info = vk::DeviceCreateInfo::default()
            .queue_create_infos(&queues)
            .enabled_extension_names(&extensions)
            .push_next(&mut feature);
        Ok(instance.create_device(physical, &info, None).map_err(|e| format!("vkCreateDevice failed with {e}"))?)
    }
}
