//! What is known of a device beside what is measured: its driver, and the bandwidth of its memory.

use ash::vk;
use atrous::executor::HeadlessDevice;
use std::ffi::CStr;

/// Bandwidth by data sheet in GB/s, by a part of the name that the driver gives; the first that fits counts.
const BANDWIDTHS: [(&str, f64); 22] = [
    ("H200", 4800.0),
    ("H100", 3350.0),
    ("A100", 1555.0),
    ("RTX 5090", 1792.0),
    ("RTX 5080", 960.0),
    ("RTX 5070", 672.0),
    ("RTX 4090", 1008.0),
    ("RTX 4080", 717.0),
    ("RTX 4070", 504.0),
    ("RTX 4060", 272.0),
    ("RTX 3090", 936.0),
    ("RTX 3080", 760.0),
    ("RTX 3070", 448.0),
    ("RTX 3060", 360.0),
    ("9070", 640.0),
    ("7900 XTX", 960.0),
    ("7800 XT", 624.0),
    ("6900 XT", 512.0),
    ("6800 XT", 512.0),
    ("A770", 560.0),
    ("B580", 456.0),
    ("VANGOGH", 88.0),
];

/// Of the memory, GB/s.
pub fn bandwidth(device: &str) -> Option<f64> {
    BANDWIDTHS.iter().find(|(part, _)| device.contains(part)).map(|(_, gb_per_s)| *gb_per_s)
}

/// Name and version of the driver; empty where Vulkan is older than 1.2.
pub fn driver(gpu: &HeadlessDevice) -> String {
    let host = gpu.host();
    // SAFETY: instance and physical device are live and belong together.
    unsafe { driver_of(host.instance, host.physical_device) }
}

/// # Safety
/// The device was listed by the instance, which is live.
pub unsafe fn driver_of(instance: &ash::Instance, physical: vk::PhysicalDevice) -> String {
    let text = |c: Result<&CStr, _>| c.map_or_else(|_| String::new(), |c| c.to_string_lossy().into_owned());
    // SAFETY: instance and device are live, and what is asked for is in Vulkan 1.2, which the device has where it is asked.
    unsafe {
        if instance.get_physical_device_properties(physical).api_version < vk::API_VERSION_1_2 {
            return String::new();
        }
        let mut driver = vk::PhysicalDeviceDriverProperties::default();
        let mut all = vk::PhysicalDeviceProperties2::default().push_next(&mut driver);
        instance.get_physical_device_properties2(physical, &mut all);
        format!("{} {}", text(driver.driver_name_as_c_str()), text(driver.driver_info_as_c_str()))
    }
}
