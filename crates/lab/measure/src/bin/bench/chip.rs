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

/// Chips for which the table of shaders was compiled, with their SIMDs and the clock of their data sheet in GHz.
const SIMDS: [(&str, f64, f64); 2] = [("6900 XT", 160.0, 2.25), ("6800 XT", 144.0, 2.25)];

/// The chips that [`bandwidth`] knows.
pub fn names() -> impl Iterator<Item = &'static str> {
    BANDWIDTHS.iter().map(|(name, _)| *name)
}

/// Ends of names of other cards, with other memory.
const OTHER_CARDS: [&str; 7] = [" Ti", " SUPER", " GRE", " Laptop", " Max-Q", " D", " NVL"];

/// Of the memory, GB/s; `None` for a device whose data sheet is not known here.
pub fn bandwidth(device: &str) -> Option<f64> {
    BANDWIDTHS.iter().find(|(part, _)| is_card(device, part)).map(|(_, gb_per_s)| *gb_per_s)
}

/// Cycles of all SIMDs together in a millisecond; `None` for a device for which the table of shaders was not compiled.
pub fn cycles_per_ms(device: &str) -> Option<f64> {
    SIMDS.iter().find(|(part, ..)| is_card(device, part)).map(|(_, simds, ghz)| simds * ghz * 1e6)
}

fn is_card(device: &str, part: &str) -> bool {
    device.find(part).is_some_and(|at| {
        let rest = &device[at + part.len()..];
        !OTHER_CARDS.iter().any(|end| rest.starts_with(end))
    })
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

#[cfg(test)]
mod tests {
    use super::{bandwidth, cycles_per_ms, names, SIMDS};

    #[test]
    fn cycles_are_those_of_all_simds() {
        assert_eq!(cycles_per_ms("AMD Radeon RX 6900 XT (RADV NAVI21)"), Some(3.6e8));
        assert_eq!(cycles_per_ms("AMD Radeon RX 7900 XTX (RADV NAVI31)"), None, "the table is of another family");
        assert!(SIMDS.iter().all(|(name, ..)| names().any(|known| known == *name)), "--chip takes names with a bandwidth alone");
    }

    #[test]
    fn a_card_is_not_taken_for_its_sister() {
        assert_eq!(bandwidth("NVIDIA H100 80GB HBM3"), Some(3350.0));
        assert_eq!(bandwidth("NVIDIA GeForce RTX 4070"), Some(504.0));
        assert_eq!(bandwidth("AMD Radeon RX 7900 XTX (RADV NAVI31)"), Some(960.0));
        for other in
            ["NVIDIA GeForce RTX 4070 Ti", "NVIDIA GeForce RTX 4080 SUPER", "NVIDIA H100 NVL", "llvmpipe (LLVM 15.0.6, 256 bits)"]
        {
            assert_eq!(bandwidth(other), None, "{other}");
        }
    }
}
