//! A host whose device has less than the executor asks for: the nodes run (`host_ash` is such a host), and the executor says what it misses.

use ash::vk;
use atrous::executor::{Executor, ExecutorOptions, HeadlessDevice, HeadlessOptions, Session, SessionOptions, Validation};
use atrous::{Config, Denoiser, Device, Error, Requirements};
use atrous_synthetic as synthetic;
use std::process::Command;
use std::sync::Arc;

/// A device without any feature, of an instance of this version, on the physical device that the tests use.
fn with_a_plain_device(version: u32, body: impl FnOnce(Device<'_>)) {
    // SAFETY: every pointer lives until its call returns; the device goes before its instance.
    unsafe {
        let entry = ash::Entry::load().expect("a loader");
        let application = vk::ApplicationInfo::default().api_version(version);
        let instance =
            entry.create_instance(&vk::InstanceCreateInfo::default().application_info(&application), None).expect("instance");
        let physical_device = instance.enumerate_physical_devices().expect("devices")[0];
        let families = instance.get_physical_device_queue_family_properties(physical_device);
        let family = families.iter().position(|f| f.queue_flags.contains(vk::QueueFlags::COMPUTE)).expect("compute") as u32;
        let queues = [vk::DeviceQueueCreateInfo::default().queue_family_index(family).queue_priorities(&[1.0])];
        let info = vk::DeviceCreateInfo::default().queue_create_infos(&queues);
        let device = instance.create_device(physical_device, &info, None).expect("device");
        body(Device {
            instance: &instance,
            physical_device,
            device: &device,
            pipeline_cache: vk::PipelineCache::null(),
            pipelines: None,
        });
        device.destroy_device(None);
        instance.destroy_instance(None);
    }
}

/// What is missing is told by functions that are missing. Some drivers, such as NVIDIA's, hand out those of every version.
fn hands_out_everything(host: Device<'_>) -> bool {
    // SAFETY: the handles are live and belong together.
    let function = unsafe { host.instance.get_device_proc_addr(host.device.handle(), c"vkCmdPipelineBarrier2".as_ptr()) };
    if function.is_some() {
        println!("this driver hands out functions of newer versions than were asked for: nothing was checked");
    }
    function.is_some()
}

pub fn a_device_without_synchronization2_runs_the_nodes_and_not_the_executor() {
    with_a_plain_device(vk::API_VERSION_1_1, |host| {
        if hands_out_everything(host) {
            return;
        }
        for config in super::configurations() {
            // SAFETY: the handles are live and belong together.
            unsafe {
                let declaration = config.declare().expect("valid");
                let requirements = Requirements::new(&declaration);
                requirements.check_device(host).expect("the nodes need nothing beyond Vulkan 1.1");
                Denoiser::new(host, declaration.clone()).expect("a denoiser");
                let error = requirements.check_executor_device(host).expect_err("the executor needs more");
                let Error::Unsupported { missing } = &error else { panic!("{error}") };
                assert_eq!(missing.len(), 1, "{missing:?}");
                assert!(missing[0].contains("synchronization2"), "{error}");
                let opened = Executor::new(host, declaration, Default::default());
                assert_eq!(opened.err(), Some(error));
                let options = ExecutorOptions { legacy_barriers: true, ..Default::default() };
                Executor::new(host, config.declare().expect("valid"), options).expect("an executor that does without");
            }
        }
    });
}

/// Barriers, timestamps and semaphores are those that the version has; the picture is the same.
pub fn a_session_runs_on_each_version_of_vulkan() {
    let expected = super::of_executor();
    let versions = [(vk::API_VERSION_1_1, [false; 2]), (vk::API_VERSION_1_2, [true, false]), (vk::API_VERSION_1_3, [true; 2])];
    for (version, features) in versions {
        let options = HeadlessOptions { validation: Validation::On, vulkan: Some(version), ..Default::default() };
        let gpu = Arc::new(HeadlessDevice::new(&options).expect("a device"));
        assert_eq!([gpu.has_timeline_semaphores(), gpu.has_synchronization2()], features);
        let options = SessionOptions { timestamps: true, ..Default::default() };
        let mut s = Session::new(gpu.clone(), Config::new(synthetic::EXTENT).declare().expect("valid"), options).expect("session");
        assert_eq!(super::executor_frames(&mut s), expected, "{features:?}");
        assert_eq!(s.times().is_empty(), !gpu.has_timestamps());
        drop(s);
        assert_eq!(gpu.validation_errors(), [] as [String; 0], "{features:?}");
    }
}

/// Layers and drivers are looked for where the environment says, so it is a process of its own that finds none.
pub fn a_machine_without_a_layer_or_a_driver_is_told_so() {
    let said = |host: &str, missing: &[&str]| {
        let mut command = Command::new(std::env::current_exe().expect("this program"));
        let nowhere = missing.iter().map(|variable| (*variable, "/nowhere"));
        let output = command.env(super::VARIABLE, host).envs(nowhere).output().expect("a process");
        let text = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(!output.status.success() && !text.contains("panicked"), "{host}: {text}");
        text
    };
    let text = said("a validated device", &["VK_LAYER_PATH"]);
    assert!(text.contains("validation layer is not installed (Debian: vulkan-validationlayers)"), "{text}");
    let text = said("a device", &["VK_ICD_FILENAMES", "VK_DRIVER_FILES"]);
    assert!(text.contains("no Vulkan driver was found") && text.contains("mesa-vulkan-drivers"), "{text}");
}

/// A loader of 2023 refuses the extension by which newer layers take their settings. The layer of this machine says here that it has it.
pub fn a_layer_that_is_newer_than_the_loader_validates() {
    let folders =
        ["/usr/share/vulkan/explicit_layer.d", "/usr/local/share/vulkan/explicit_layer.d", "/etc/vulkan/explicit_layer.d"];
    let files = folders.iter().map(|folder| format!("{folder}/VkLayer_khronos_validation.json"));
    let Some(text) = files.filter_map(|file| std::fs::read_to_string(file).ok()).next() else {
        println!("the validation layer is somewhere else: nothing was tried");
        return;
    };
    let mut manifest: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let extensions = manifest["layer"]["instance_extensions"].as_array_mut().expect("a list");
    extensions.push(serde_json::json!({ "name": "VK_EXT_layer_settings", "spec_version": "2" }));
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("layer.json"), manifest.to_string()).expect("written");
    let mut command = Command::new(std::env::current_exe().expect("this program"));
    let output =
        command.env(super::VARIABLE, "a validated device").env("VK_LAYER_PATH", folder.path()).output().expect("a process");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
}

pub fn an_instance_of_vulkan_1_0_is_told_what_to_ask_for() {
    with_a_plain_device(vk::API_VERSION_1_0, |host| {
        if hands_out_everything(host) {
            return;
        }
        // SAFETY: the handles are live and belong together.
        let opened = unsafe { Denoiser::new(host, Config::new([8, 8]).declare().expect("valid")) };
        let message = opened.err().expect("it needs Vulkan 1.1").to_string();
        assert!(message.contains("create the instance with apiVersion 1.1"), "{message}");
    });
}

pub fn a_device_with_everything_is_told_nothing() {
    let gpu = crate::support::gpu();
    let requirements = Requirements::new(&Config::new([66, 36]).declare().expect("valid"));
    // SAFETY: the handles are live and belong together.
    unsafe { requirements.check_executor_device(gpu.host()) }.expect("the executor's own device");
}
