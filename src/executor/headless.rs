//! A Vulkan device without a window: for tools, benchmarks and tests.

use crate::error::Error;
use crate::record::{Device, SharedPipelines};
use ash::vk;
use std::ffi::{c_void, CStr};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// Use of the Khronos validation layer.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Validation {
    /// No validation.
    #[default]
    Off,
    /// All checks, with synchronisation validation. [`HeadlessDevice::validation_errors`] has the messages. Layers up to 1.3.239 at least
    /// are not to be called by one thread while another opens or drops such a device.
    On,
}

/// Options of a headless device.
#[derive(Clone, Debug, Default)]
pub struct HeadlessOptions {
    /// Index or part of the name of the physical device; `None`: discrete before integrated before software.
    pub device: Option<String>,
    /// Validation.
    pub validation: Validation,
    /// The highest version of Vulkan to use, for tests; `None`: all that is known.
    #[doc(hidden)]
    pub vulkan: Option<u32>,
}

/// Instance, device and one queue with `COMPUTE`.
pub struct HeadlessDevice {
    // Dropped last; the loader must outlive every handle.
    _entry: ash::Entry,
    instance: ash::Instance,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
    errors: Arc<Mutex<Vec<String>>>,
    physical_device: vk::PhysicalDevice,
    device: ash::Device,
    pipelines: SharedPipelines,
    queue: Mutex<vk::Queue>,
    queue_family: u32,
    timestamps: bool,
    timeline_semaphores: bool,
    synchronization2: bool,
    name: String,
}

const VALIDATION_LAYER: &CStr = c"VK_LAYER_KHRONOS_validation";

impl HeadlessDevice {
    /// Opens a device.
    ///
    /// # Errors
    /// [`Error::NoDevice`] names the missing part and lists the devices found.
    pub fn new(options: &HeadlessOptions) -> Result<Self, Error> {
        // SAFETY: the loader's initialisation is as safe as that library's.
        let entry = unsafe { ash::Entry::load() }.map_err(|e| Error::NoDevice(format!("the Vulkan loader was not found ({e})")))?;
        let errors = Arc::new(Mutex::new(Vec::new()));
        let validate = options.validation == Validation::On;
        let version = options.vulkan.unwrap_or(vk::API_VERSION_1_3);
        let instance = create_instance(&entry, validate, version)?;
        let mut this = PartialDevice { instance: Some(instance), messenger: None };
        let instance = this.instance.clone().ok_or_else(|| Error::NoDevice("no instance".into()))?;
        if validate {
            this.messenger = Some(create_messenger(&entry, &instance, &errors)?);
        }
        let (physical_device, name) = choose(&instance, options.device.as_deref())?;
        let opened = create_device(&instance, physical_device, version)?;
        let Opened { device, queue_family, timestamps, timeline_semaphores, synchronization2 } = opened;
        // SAFETY: the family was asked for with one queue.
        let queue = Mutex::new(unsafe { device.get_device_queue(queue_family, 0) });
        let messenger = this.messenger.take();
        this.instance = None;
        Ok(Self {
            _entry: entry,
            instance,
            messenger,
            errors,
            physical_device,
            device,
            pipelines: SharedPipelines::default(),
            queue,
            queue_family,
            timestamps,
            timeline_semaphores,
            synchronization2,
            name,
        })
    }

    /// The handles for [`crate::Denoiser`] and [`super::Executor`]. All that are made with them share pipelines.
    pub fn host(&self) -> Device<'_> {
        let pipeline_cache = vk::PipelineCache::null();
        let Self { instance, physical_device, device, pipelines, .. } = self;
        Device { instance, physical_device: *physical_device, device, pipeline_cache, pipelines: Some(pipelines) }
    }

    /// Name and driver of the device.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The device.
    pub fn device(&self) -> &ash::Device {
        &self.device
    }

    /// The queue, locked: Vulkan wants it to be used from one thread at a time.
    pub fn queue(&self) -> MutexGuard<'_, vk::Queue> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The family of the queue.
    pub fn queue_family(&self) -> u32 {
        self.queue_family
    }

    /// Whether timeline semaphores are enabled: if the device has Vulkan 1.2.
    pub fn has_timeline_semaphores(&self) -> bool {
        self.timeline_semaphores
    }

    /// Whether synchronization2 is enabled: if the device has Vulkan 1.3. Without it barriers are
    /// those of Vulkan 1.0: [`super::ExecutorOptions::legacy_barriers`].
    pub fn has_synchronization2(&self) -> bool {
        self.synchronization2
    }

    /// Whether the queue can write timestamps.
    pub fn has_timestamps(&self) -> bool {
        self.timestamps
    }

    /// Errors and warnings of the validation layer so far, each starting with its message id.
    pub fn validation_errors(&self) -> Vec<String> {
        self.errors.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    /// Where [`Self::validation_errors`] come from: the last ones come when the device is dropped.
    #[doc(hidden)]
    pub fn validation_log(&self) -> Arc<Mutex<Vec<String>>> {
        self.errors.clone()
    }

    /// The device with other functions instead of its own, by name: for tests of calls.
    ///
    /// # Safety
    /// Each has the signature and the behaviour of the function that it replaces.
    #[doc(hidden)]
    pub unsafe fn device_with(&self, replacement: impl Fn(&CStr) -> Option<*const c_void>) -> ash::Device {
        let (own, handle) = (self.instance.fp_v1_0().get_device_proc_addr, self.device.handle());
        let load = |name: &CStr| {
            // SAFETY: the handle is live, and a function is as large as a pointer.
            replacement(name).unwrap_or_else(|| unsafe { std::mem::transmute(own(handle, name.as_ptr())) })
        };
        // SAFETY: the functions are those of the device, or stand for them.
        unsafe { ash::Device::load_with(load, handle) }
    }

    /// Puts functions instead of those of the device: for tests of calls that fail.
    ///
    /// # Safety
    /// Obligations of [`Self::device_with`].
    #[doc(hidden)]
    pub unsafe fn replace_functions(&mut self, replacement: impl Fn(&CStr) -> Option<*const c_void>) {
        // SAFETY: the functions stand for those of the device.
        self.device = unsafe { self.device_with(replacement) };
    }

    /// Whether validation runs, and with it debug labels.
    pub(crate) fn validates(&self) -> bool {
        self.messenger.is_some()
    }
}

impl Drop for HeadlessDevice {
    fn drop(&mut self) {
        // SAFETY: ours; what was created from them borrows or shares this value and is gone.
        unsafe {
            let _ = self.device.device_wait_idle();
            drop(std::mem::take(&mut self.pipelines));
            self.device.destroy_device(None);
            if let Some((functions, messenger)) = &self.messenger {
                functions.destroy_debug_utils_messenger(*messenger, None);
            }
            self.instance.destroy_instance(None);
        }
    }
}

/// Destroys the instance when opening a device fails half-way.
struct PartialDevice {
    instance: Option<ash::Instance>,
    messenger: Option<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT)>,
}

impl Drop for PartialDevice {
    fn drop(&mut self) {
        // SAFETY: both are ours, and no device was kept.
        unsafe {
            if let Some((functions, messenger)) = &self.messenger {
                functions.destroy_debug_utils_messenger(*messenger, None);
            }
            if let Some(instance) = &self.instance {
                instance.destroy_instance(None);
            }
        }
    }
}

fn create_instance(entry: &ash::Entry, validate: bool, version: u32) -> Result<ash::Instance, Error> {
    let no_device = |what: String| Error::NoDevice(what);
    if validate {
        // SAFETY: the loader is live.
        let layers =
            unsafe { entry.enumerate_instance_layer_properties() }.map_err(Error::vulkan("vkEnumerateInstanceLayerProperties"))?;
        if !layers.iter().any(|l| l.layer_name_as_c_str() == Ok(VALIDATION_LAYER)) {
            return Err(no_device("the Khronos validation layer is not installed (Debian: vulkan-validationlayers)".into()));
        }
    }
    let application = vk::ApplicationInfo::default().application_name(c"atrous").api_version(version);
    let layers = if validate { vec![VALIDATION_LAYER.as_ptr()] } else { vec![] };
    let asking = if validate { layer_extensions(entry)? } else { vec![] };
    let mut extensions: Vec<_> = asking.iter().map(|name| name.as_ptr()).collect();
    if validate {
        extensions.push(vk::EXT_DEBUG_UTILS_NAME.as_ptr());
    }
    let enabled = [vk::ValidationFeatureEnableEXT::SYNCHRONIZATION_VALIDATION];
    let mut features = vk::ValidationFeaturesEXT::default().enabled_validation_features(&enabled);
    let on = vk::TRUE.to_ne_bytes();
    let settings = LAYER_SETTINGS.map(|name| {
        let setting = vk::LayerSettingEXT::default().layer_name(VALIDATION_LAYER).setting_name(name);
        vk::LayerSettingEXT { value_count: 1, ..setting.ty(vk::LayerSettingTypeEXT::BOOL32).values(&on) }
    });
    let mut settings = vk::LayerSettingsCreateInfoEXT::default().settings(&settings);
    let mut info = vk::InstanceCreateInfo::default().application_info(&application).enabled_layer_names(&layers);
    if asking.contains(&vk::EXT_VALIDATION_FEATURES_NAME) {
        info = info.push_next(&mut features);
    }
    if asking.contains(&vk::EXT_LAYER_SETTINGS_NAME) {
        info = info.push_next(&mut settings);
    }
    // SAFETY: every pointer in `info` lives until the call returns.
    let created = unsafe { entry.create_instance(&info.enabled_extension_names(&extensions), None) };
    let created = created.or_else(|error| {
        // A loader that is older than the layer refuses the name of an extension that it does not know. The layer reads its settings
        // without that as well.
        extensions.retain(|name| *name != vk::EXT_LAYER_SETTINGS_NAME.as_ptr());
        let knows_less = error == vk::Result::ERROR_EXTENSION_NOT_PRESENT;
        // SAFETY: as above.
        let again = || unsafe { entry.create_instance(&info.enabled_extension_names(&extensions), None) };
        if knows_less {
            again()
        } else {
            Err(error)
        }
    });
    created.map_err(|e| match e {
        vk::Result::ERROR_INCOMPATIBLE_DRIVER => {
            no_device("no Vulkan driver was found; install one (Debian: mesa-vulkan-drivers has a software one)".into())
        }
        _ => no_device(format!("vkCreateInstance failed with {e}")),
    })
}

/// Switches by which newer validation layers look for hazards: between commands, between submissions, and inside shaders.
const LAYER_SETTINGS: [&CStr; 3] = [c"validate_sync", c"syncval_submit_time_validation", c"syncval_shader_accesses_heuristic"];

/// The extensions by which the validation layer is told to look for hazards, of those that it has: older layers have the first, newer ones
/// the second, some both.
fn layer_extensions(entry: &ash::Entry) -> Result<Vec<&'static CStr>, Error> {
    // SAFETY: the loader is live.
    let offered = unsafe { entry.enumerate_instance_extension_properties(Some(VALIDATION_LAYER)) }
        .map_err(Error::vulkan("vkEnumerateInstanceExtensionProperties"))?;
    let has = |name: &&CStr| offered.iter().any(|extension| extension.extension_name_as_c_str() == Ok(*name));
    let found: Vec<_> = [vk::EXT_VALIDATION_FEATURES_NAME, vk::EXT_LAYER_SETTINGS_NAME].into_iter().filter(has).collect();
    if found.is_empty() {
        let missing = "VK_EXT_validation_features and VK_EXT_layer_settings";
        let problem = format!("the Khronos validation layer has none of {missing}, and looks for no hazards; install a newer one");
        return Err(Error::NoDevice(problem));
    }
    Ok(found)
}

type Errors = Mutex<Vec<String>>;

fn create_messenger(
    entry: &ash::Entry,
    instance: &ash::Instance,
    errors: &Arc<Errors>,
) -> Result<(ash::ext::debug_utils::Instance, vk::DebugUtilsMessengerEXT), Error> {
    let functions = ash::ext::debug_utils::Instance::new(entry, instance);
    let info = vk::DebugUtilsMessengerCreateInfoEXT::default()
        .message_severity(vk::DebugUtilsMessageSeverityFlagsEXT::ERROR | vk::DebugUtilsMessageSeverityFlagsEXT::WARNING)
        .message_type(vk::DebugUtilsMessageTypeFlagsEXT::VALIDATION | vk::DebugUtilsMessageTypeFlagsEXT::PERFORMANCE)
        .pfn_user_callback(Some(on_message))
        .user_data(Arc::as_ptr(errors).cast_mut().cast());
    // SAFETY: the vector lives as long as the device that owns the messenger.
    let messenger =
        unsafe { functions.create_debug_utils_messenger(&info, None) }.map_err(Error::vulkan("vkCreateDebugUtilsMessengerEXT"))?;
    Ok((functions, messenger))
}

unsafe extern "system" fn on_message(
    _severity: vk::DebugUtilsMessageSeverityFlagsEXT,
    _types: vk::DebugUtilsMessageTypeFlagsEXT,
    data: *const vk::DebugUtilsMessengerCallbackDataEXT<'_>,
    user: *mut c_void,
) -> vk::Bool32 {
    // SAFETY: the layer passes valid data, and `user` is the vector that create_messenger named.
    let (data, errors) = unsafe { (&*data, &*user.cast::<Errors>()) };
    let text = |c: Option<&CStr>| c.map_or_else(String::new, |c| c.to_string_lossy().into_owned());
    // SAFETY: strings of the layer are null-terminated and live during the call.
    let (id, message) = unsafe { (text(data.message_id_name_as_c_str()), text(data.message_as_c_str())) };
    if let Ok(mut errors) = errors.lock() {
        errors.push(format!("{id}: {message}"));
    }
    vk::FALSE
}

fn choose(instance: &ash::Instance, wanted: Option<&str>) -> Result<(vk::PhysicalDevice, String), Error> {
    // SAFETY: the instance is live.
    let devices = unsafe { instance.enumerate_physical_devices() }
        .map_err(|e| Error::NoDevice(format!("vkEnumeratePhysicalDevices: {e}")))?;
    let described: Vec<_> = devices
        .into_iter()
        .map(|d| {
            // SAFETY: the device was just listed.
            let p = unsafe { instance.get_physical_device_properties(d) };
            let name = p.device_name_as_c_str().map_or_else(|_| String::new(), |n| n.to_string_lossy().into_owned());
            let rank = match p.device_type {
                vk::PhysicalDeviceType::DISCRETE_GPU => 0,
                vk::PhysicalDeviceType::INTEGRATED_GPU => 1,
                vk::PhysicalDeviceType::VIRTUAL_GPU => 2,
                _ => 3,
            };
            (rank, d, name)
        })
        .collect();
    let names = described.iter().enumerate().map(|(i, d)| format!("{i}: {}", d.2)).collect::<Vec<_>>().join(", ");
    let found = match wanted {
        None => described.iter().min_by_key(|d| d.0),
        Some(wanted) => match wanted.parse::<usize>() {
            Ok(index) => described.get(index),
            Err(_) => described.iter().find(|d| d.2.to_lowercase().contains(&wanted.to_lowercase())),
        },
    };
    match found {
        Some((_, device, name)) => Ok((*device, name.clone())),
        None if described.is_empty() => Err(Error::NoDevice("no driver offers a physical device".into())),
        None => Err(Error::NoDevice(format!("none is called `{}`; there are: {names}", wanted.unwrap_or_default()))),
    }
}

struct Opened {
    device: ash::Device,
    queue_family: u32,
    timestamps: bool,
    timeline_semaphores: bool,
    synchronization2: bool,
}

/// `version` is that of the instance, beyond which no device goes.
fn create_device(instance: &ash::Instance, physical_device: vk::PhysicalDevice, version: u32) -> Result<Opened, Error> {
    // SAFETY: the instance is live and the device was listed by it; every pointer lives until its call returns.
    unsafe {
        let families = instance.get_physical_device_queue_family_properties(physical_device);
        let family = families.iter().position(|f| f.queue_flags.contains(vk::QueueFlags::COMPUTE));
        let family = family.ok_or_else(|| Error::NoDevice("the device has no queue with COMPUTE".into()))?;
        let timestamps = families[family].timestamp_valid_bits > 0;
        let version = instance.get_physical_device_properties(physical_device).api_version.min(version);
        // Mandatory from these versions on.
        let timeline_semaphores = version >= vk::API_VERSION_1_2;
        let synchronization2 = version >= vk::API_VERSION_1_3;
        let priorities = [1.0];
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(family as u32).queue_priorities(&priorities)];
        let mut timeline = vk::PhysicalDeviceTimelineSemaphoreFeatures::default().timeline_semaphore(true);
        let mut sync2 = vk::PhysicalDeviceSynchronization2Features::default().synchronization2(true);
        let mut info = vk::DeviceCreateInfo::default().queue_create_infos(&queues);
        if timeline_semaphores {
            info = info.push_next(&mut timeline);
        }
        if synchronization2 {
            info = info.push_next(&mut sync2);
        }
        let device = instance
            .create_device(physical_device, &info, None)
            .map_err(|e| Error::NoDevice(format!("vkCreateDevice failed with {e}")))?;
        Ok(Opened { device, queue_family: family as u32, timestamps, timeline_semaphores, synchronization2 })
    }
}
