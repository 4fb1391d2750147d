//! Specialisation constants that no node sets: the host's conventions, and the class of the device.

use crate::contract::{Declaration, Work};
use crate::frame_constants::Flags;
use crate::shaders::{CONVENTIONS, MASKED_BRANCHES};
use ash::vk;

impl Declaration {
    /// The declaration with these constants set for every pass whose shader has them, as [`crate::Denoiser::new`] sets them: for
    /// tools that compile [`crate::PassDecl::pipeline`] by themselves.
    pub fn specialised(mut self, device_type: vk::PhysicalDeviceType) -> Self {
        let conventions = Flags::of(&self.setup().conventions, false);
        let values = [(CONVENTIONS, conventions), (MASKED_BRANCHES, u32::from(device_type == vk::PhysicalDeviceType::CPU))];
        for pass in &mut self.passes {
            let Work::Dispatch(dispatch) = &mut pass.work else { continue };
            for (name, value) in values {
                let Some(constant) = dispatch.shader.constant(name) else { continue };
                let id = constant.id;
                dispatch.constants.retain(|(other, _)| *other != id);
                dispatch.constants.push((id, value));
            }
        }
        self
    }
}
