//! The Vulkan instance, with validation and a place for its messages.

use std::ffi::{c_void, CStr};
use std::sync::{Arc, Mutex};

use ash::vk;

use crate::error::{Doing, Error, Result};

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";
/// More messages than this tell nothing new.
const MESSAGE_LIMIT: usize = 200;

type Messages = Mutex<Vec<String>>;

/// What the validation layers said. Outlives the instance.
#[derive(Clone, Default)]
pub struct MessageLog(Arc<Messages>);

impl MessageLog {
    /// So far.
    pub fn messages(&self) -> Vec<String> {
        self.0.lock().map(|messages| messages.clone()).unwrap_or_default()
    }
}

/// An instance that destroys itself.
pub struct Instance {
    pub raw: ash::Instance,
    pub entry: ash::Entry,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    // The messenger holds the address of what is in it.
    pub log: MessageLog,
}

impl Instance {
    pub fn new(validation: bool, wanted: &[&'static CStr]) -> Result<Self> {
        // SAFETY: the system's Vulkan loader is trusted to initialise as specified.
        let entry = unsafe { ash::Entry::load() }?;
        let mut layers = Vec::new();
        let mut extensions: Vec<_> = wanted.iter().map(|name| name.as_ptr()).collect();
        require_extensions(&entry, wanted)?;
        if validation {
            require_layer(&entry)?;
            layers.push(VALIDATION_LAYER.as_ptr());
            extensions.push(ash::ext::debug_utils::NAME.as_ptr());
            extensions.push(ash::ext::validation_features::NAME.as_ptr());
        }
        let version = highest_version(&entry)?;
        let application = vk::ApplicationInfo::default().application_name(c"atrous demo").api_version(version);
        let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
        let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
        let mut info = vk::InstanceCreateInfo::default()
            .application_info(&application)
            .enabled_layer_names(&layers)
            .enabled_extension_names(&extensions);
        let log = MessageLog::default();
        let mut messenger_info = messenger_info(&log.0);
        if validation {
            info = info.push_next(&mut features).push_next(&mut messenger_info);
        }
        // SAFETY: the layers and extensions named were found; everything pointed to outlives the call.
        let created = unsafe { entry.create_instance(&info, None) };
        // This is how a loader without any driver answers.
        if created.as_ref().err() == Some(&vk::Result::ERROR_INCOMPATIBLE_DRIVER) {
            return Err(Error::NoDevice);
        }
        let raw = created.doing("create an instance")?;
        let mut instance = Self { raw, entry, messenger: None, log };
        if validation {
            let functions = ash::ext::debug_utils::Instance::new(&instance.entry, &instance.raw);
            let info = self::messenger_info(&instance.log.0);
            // SAFETY: the extension is enabled, and the log lives until the messenger is destroyed.
            let handle = unsafe { functions.create_debug_utils_messenger(&info, None) }.doing("create a debug messenger")?;
            instance.messenger = Some((functions, handle));
        }
        Ok(instance)
    }

    pub fn has_extension(name: &CStr) -> Result<bool> {
        // SAFETY: the system's Vulkan loader is trusted to initialise as specified.
        let entry = unsafe { ash::Entry::load() }?;
        Ok(extensions(&entry)?.iter().any(|e| e.extension_name_as_c_str() == Ok(name)))
    }
}

fn extensions(entry: &ash::Entry) -> Result<Vec<vk::ExtensionProperties>> {
    // SAFETY: a plain query of the loader.
    unsafe { entry.enumerate_instance_extension_properties(None) }.doing("list the instance's extensions")
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: everything made from the instance is gone, since the device's owner drops this last.
        unsafe {
            if let Some((functions, handle)) = self.messenger.take() {
                functions.destroy_debug_utils_messenger(handle, None);
            }
            self.raw.destroy_instance(None);
        }
        // What the layers say of leaks comes too late for anyone to ask.
        for message in
            self.log.messages().iter().filter(|message| message.contains("OBJ ERROR") || message.contains("DestroyDevice"))
        {
            eprintln!("{message}");
        }
    }
}

/// 1.3 where the loader has it, since the denoiser's built-in executor wants synchronization2.
fn highest_version(entry: &ash::Entry) -> Result<u32> {
    // SAFETY: a plain query of the loader.
    let found = unsafe { entry.try_enumerate_instance_version() }.doing("query the loader's version")?;
    Ok(found.unwrap_or(vk::API_VERSION_1_0).clamp(vk::API_VERSION_1_1, vk::API_VERSION_1_3))
}

fn require_layer(entry: &ash::Entry) -> Result<()> {
    // SAFETY: a plain query of the loader.
    let layers = unsafe { entry.enumerate_instance_layer_properties() }.doing("list the layers")?;
    let found = layers.iter().any(|layer| layer.layer_name_as_c_str() == Ok(VALIDATION_LAYER));
    found.then_some(()).ok_or(Error::NoValidationLayer)
}

fn require_extensions(entry: &ash::Entry, wanted: &[&'static CStr]) -> Result<()> {
    let found = extensions(entry)?;
    let missing = wanted.iter().find(|&&name| !found.iter().any(|e| e.extension_name_as_c_str() == Ok(name)));
    match missing {
        Some(name) => Err(Error::NoExtension { name: name.to_string_lossy().into_owned() }),
        None => Ok(()),
    }
}

fn messenger_info(messages: &Messages) -> vk::DebugUtilsMessengerCreateInfoEXT<'static> {
    vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING)
        .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION)
        .pfn_user_callback(Some(on_message))
        .user_data(std::ptr::from_ref(messages).cast_mut().cast())
}

unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _kind: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user_data: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layers pass valid callback data for the time of the call, and `user_data` is the `Messages`
    // of an `Instance` that still lives.
    let (text, messages) = unsafe {
        let text = (*data).message_as_c_str().unwrap_or(c"(no text)").to_string_lossy().into_owned();
        (text, &*user_data.cast::<Messages>())
    };
    if let Ok(mut messages) = messages.lock() {
        if messages.len() < MESSAGE_LIMIT {
            messages.push(text);
        }
    }
    vk::FALSE
}
