//! Requirements on a device, checked before anything is created.

use super::device::Device;
use crate::contract::{Declaration, Lifetime, Shape};
use crate::error::Error;
use crate::shaders::BindingKind;
use ash::vk;

/// The needs of the passes of a declaration. All of them are mandatory in Vulkan 1.1, so a check
/// fails only on devices that are older, have no compute queue, or are too small for the extent,
/// and on formats of your own stages.
#[derive(Clone, Debug)]
pub struct Requirements {
    declaration: Declaration,
}

impl Requirements {
    /// The requirements of a declaration.
    pub fn new(declaration: &Declaration) -> Self {
        Self { declaration: declaration.clone() }
    }

    /// Checks the needs of the nodes: Vulkan 1.1, compute, limits and formats.
    ///
    /// # Errors
    /// [`Error::Unsupported`] lists everything that is missing.
    ///
    /// # Safety
    /// `instance` is live and `physical_device` belongs to it.
    pub unsafe fn check(&self, instance: &ash::Instance, physical_device: vk::PhysicalDevice) -> Result<(), Error> {
        // SAFETY: the instance is live, and the physical device is one of its own.
        let (properties, families) = unsafe {
            (
                instance.get_physical_device_properties(physical_device),
                instance.get_physical_device_queue_family_properties(physical_device),
            )
        };
        let mut missing = Vec::new();
        if properties.api_version < vk::API_VERSION_1_1 {
            missing.push(format!("Vulkan 1.1 (it has {})", version(properties.api_version)));
        }
        if !families.iter().any(|f| f.queue_flags.contains(vk::QueueFlags::COMPUTE)) {
            missing.push("a queue with COMPUTE".to_owned());
        }
        self.list_limits(&properties.limits, &mut missing);
        for resource in self.declaration.resources() {
            let Shape::Image { format, .. } = resource.shape else { continue };
            if matches!(resource.lifetime, Lifetime::Input { .. }) {
                continue;
            }
            // SAFETY: the instance is live, and the physical device is one of its own.
            let features = unsafe { instance.get_physical_device_format_properties(physical_device, format.preferred()) }
                .optimal_tiling_features;
            let uses = self
                .declaration
                .passes()
                .iter()
                .flat_map(|p| &p.uses)
                .filter(|u| self.declaration.resource(u.resource).name == resource.name);
            let needed = uses.fold(vk::FormatFeatureFlags::empty(), |all, u| all | u.access.format_feature());
            if !features.contains(needed) {
                missing.push(format!("format {format} with {:?} for `{}`", needed & !features, resource.name));
            }
        }
        nothing_is(missing)
    }

    /// Checks the limits of a device alone, which a different extent may exceed.
    pub(crate) fn check_limits(&self, limits: &vk::PhysicalDeviceLimits) -> Result<(), Error> {
        let mut missing = Vec::new();
        self.list_limits(limits, &mut missing);
        nothing_is(missing)
    }

    fn list_limits(&self, limits: &vk::PhysicalDeviceLimits, missing: &mut Vec<String>) {
        let most = |want: fn(BindingKind) -> bool| {
            let count = |p: &crate::PassDecl| p.shader().map_or(0, |s| s.bindings.iter().filter(|b| want(b.kind)).count());
            self.declaration.passes().iter().map(count).max().unwrap_or(0) as u32
        };
        let setup = self.declaration.setup();
        let side = setup.allocated_extent.into_iter().chain(setup.largest_output()).max().unwrap_or(1);
        let workgroups = || self.declaration.passes().iter().filter_map(|p| p.shader()).map(|shader| shader.workgroup);
        let invocations = workgroups().map(|sides| sides.iter().product()).max().unwrap_or(1);
        let narrowest = workgroups().map(|[x, y, _]| x.min(y)).min().unwrap_or(1).max(1);
        let needs = [
            ("maxImageDimension2D", limits.max_image_dimension2_d, side),
            (
                "maxPerStageDescriptorSampledImages",
                limits.max_per_stage_descriptor_sampled_images,
                most(|k| matches!(k, BindingKind::SampledImage(_))),
            ),
            (
                "maxPerStageDescriptorStorageImages",
                limits.max_per_stage_descriptor_storage_images,
                most(|k| matches!(k, BindingKind::StorageImage(..))),
            ),
            (
                "maxPerStageDescriptorStorageBuffers",
                limits.max_per_stage_descriptor_storage_buffers,
                most(|k| matches!(k, BindingKind::StorageBuffer(_))),
            ),
            ("maxComputeWorkGroupInvocations", limits.max_compute_work_group_invocations, invocations),
            ("maxComputeWorkGroupCount[0]", limits.max_compute_work_group_count[0], side.div_ceil(narrowest)),
        ];
        for (name, has, needed) in needs {
            if has < needed {
                missing.push(format!("{name} of {needed} (it has {has})"));
            }
        }
    }

    /// Checks as [`Self::check`] does, and that you created instance and device for Vulkan 1.1.
    ///
    /// # Errors
    /// [`Error::Unsupported`] lists everything that is missing.
    ///
    /// # Safety
    /// The handles are live and belong together.
    pub unsafe fn check_device(&self, host: Device<'_>) -> Result<(), Error> {
        // SAFETY: the handles are live and belong together.
        let template = unsafe {
            self.check(host.instance, host.physical_device)?;
            host.instance.get_device_proc_addr(host.device.handle(), c"vkCreateDescriptorUpdateTemplate".as_ptr())
        };
        if template.is_none() {
            let missing =
                "Vulkan 1.1 on this device: the physical device has it, so create the instance with apiVersion 1.1 or later";
            return Err(Error::Unsupported { missing: vec![missing.to_owned()] });
        }
        Ok(())
    }

    /// Checks for synchronization2, from Vulkan 1.3 or `VK_KHR_synchronization2`.
    ///
    /// # Errors
    /// [`Error::Unsupported`].
    ///
    /// # Safety
    /// Obligations of [`Self::check`].
    pub unsafe fn check_executor(&self, instance: &ash::Instance, physical_device: vk::PhysicalDevice) -> Result<(), Error> {
        // SAFETY: the instance is live, and the physical device is one of its own.
        unsafe { self.check(instance, physical_device)? };
        let mut sync2 = vk::PhysicalDeviceSynchronization2Features::default();
        let mut features = vk::PhysicalDeviceFeatures2::default().push_next(&mut sync2);
        // SAFETY: both are live; a device that does not know the structure leaves it alone.
        unsafe { instance.get_physical_device_features2(physical_device, &mut features) };
        if sync2.synchronization2 == vk::FALSE {
            let missing = vec![
                "synchronization2 (Vulkan 1.3 or VK_KHR_synchronization2); drive the passes from your own frame graph instead"
                    .into(),
            ];
            return Err(Error::Unsupported { missing });
        }
        Ok(())
    }

    /// Checks the additional need of the built-in executor: synchronization2, and that your device
    /// has its calls. A device of Vulkan 1.3 has them whether or not the feature was enabled, and
    /// Vulkan cannot be asked: enabling it is up to you.
    ///
    /// # Errors
    /// [`Error::Unsupported`] names the extension or version to create the device with.
    ///
    /// # Safety
    /// The handles are live and belong together.
    pub unsafe fn check_executor_device(&self, host: Device<'_>) -> Result<(), Error> {
        // SAFETY: the handles are live and belong together.
        let barrier = unsafe {
            self.check_executor(host.instance, host.physical_device)?;
            host.instance.get_device_proc_addr(host.device.handle(), c"vkCmdPipelineBarrier2".as_ptr())
        };
        if barrier.is_none() {
            let missing = vec!["synchronization2 on this device: the physical device has it, so create instance and device for \
                 Vulkan 1.3 with the feature enabled; or drive the passes from your own frame graph, which needs Vulkan 1.1 alone"
                .into()];
            return Err(Error::Unsupported { missing });
        }
        Ok(())
    }
}

fn nothing_is(missing: Vec<String>) -> Result<(), Error> {
    if missing.is_empty() {
        Ok(())
    } else {
        Err(Error::Unsupported { missing })
    }
}

fn version(v: u32) -> String {
    format!("{}.{}.{}", vk::api_version_major(v), vk::api_version_minor(v), vk::api_version_patch(v))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;

    #[test]
    fn limits_that_are_too_small_are_named() {
        let requirements = Requirements::new(&Config::new([4000, 3000]).declare().expect("valid"));
        let mut missing = Vec::new();
        requirements.list_limits(&vk::PhysicalDeviceLimits { max_image_dimension2_d: 2048, ..Default::default() }, &mut missing);
        assert!(missing.iter().any(|m| m == "maxImageDimension2D of 4000 (it has 2048)"), "{missing:?}");
    }

    #[test]
    fn the_limits_that_vulkan_guarantees_are_enough() {
        for signals in [crate::config::Signals::Together, crate::config::Signals::Apart] {
            let config = Config { signals, object_normal: true, ..Config::new([4096, 4096]) };
            let guaranteed = vk::PhysicalDeviceLimits {
                max_image_dimension2_d: 4096,
                max_per_stage_descriptor_sampled_images: 16,
                max_per_stage_descriptor_storage_images: 4,
                max_per_stage_descriptor_storage_buffers: 4,
                max_compute_work_group_invocations: 128,
                max_compute_work_group_count: [65535; 3],
                ..Default::default()
            };
            let mut missing = Vec::new();
            Requirements::new(&config.declare().expect("valid")).list_limits(&guaranteed, &mut missing);
            assert!(missing.is_empty(), "{missing:?}");
        }
    }
}
