//! Names of Vulkan objects, which validation layers and debuggers show, where a host says that it has
//! `VK_EXT_debug_utils`.

use super::device::Device;
use ash::vk;
use std::ffi::CString;

/// Gives names to objects of a device, or does nothing.
pub(crate) struct Names(Option<ash::ext::debug_utils::Device>);

impl Names {
    /// Without `VK_EXT_debug_utils` nothing has a name: layers have the function whether or not the extension is enabled, and complain
    /// of the call.
    pub(crate) fn new(host: Device<'_>, is_enabled: bool) -> Self {
        Self(is_enabled.then(|| ash::ext::debug_utils::Device::new(host.instance, host.device)))
    }

    /// # Safety
    /// The object is live, of the device, and no other thread uses it.
    pub(crate) unsafe fn set<T: vk::Handle + Copy>(&self, object: T, name: &str) {
        let (Some(functions), Ok(name)) = (&self.0, CString::new(format!("atrous: {name}"))) else { return };
        if object.is_null() {
            return;
        }
        let info = vk::DebugUtilsObjectNameInfoEXT::default().object_handle(object).object_name(&name);
        // SAFETY: the object is live, and the name lives through the call. A name that is not kept changes nothing.
        let _ = unsafe { functions.set_debug_utils_object_name(&info) };
    }
}
