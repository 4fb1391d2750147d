//! Structs of the C ABI: sizes, null pointers, garbage in choices, images of odd floats. Of what needs a device, all that comes before
//! the device is asked.

use crate::{Choices, Outcome};
use atrous_capi::*;
use std::ffi::CStr;
use std::ptr::{null, null_mut};

/// Calls the functions with structs of the bytes.
pub fn attack(bytes: &[u8]) -> Outcome {
    let mut choices = Choices::new(bytes);
    let status = match choices.below(4) {
        0 => create(&mut choices),
        1 => defaults(&mut choices),
        2 => handles(&mut choices),
        _ => conventions(&mut choices),
    };
    if status == AtrousStatus::Ok {
        return Outcome::Used;
    }
    // SAFETY: the text lives until the next failure on this thread.
    let message = unsafe { CStr::from_ptr(atrous_last_error()) };
    assert!(status != AtrousStatus::Panicked && !message.is_empty(), "{status:?}: {message:?}");
    Outcome::Refused
}

/// A struct of a host as it may come: null, whole, or so short that nothing but its size is there. Nothing is behind it.
struct Given {
    bytes: Option<Vec<u8>>,
    before: Vec<u8>,
}

impl Given {
    fn new<T: Copy>(value: T, choices: &mut Choices<'_>) -> Self {
        let is_short = choices.one_in(12);
        let mut bytes = vec![0; size_of::<T>()];
        // SAFETY: there are as many bytes as the value has, wherever they are.
        unsafe { bytes.as_mut_ptr().cast::<T>().write_unaligned(value) };
        if is_short {
            bytes.truncate(4);
            bytes.shrink_to_fit();
            let size = choices.odd();
            // No size that a header has, or may have later: then there would have to be as many bytes.
            bytes[..4].copy_from_slice(&if (8..1 << 16).contains(&size) { 0 } else { size }.to_le_bytes());
        }
        let bytes = (!choices.one_in(24)).then_some(bytes);
        Self { before: bytes.clone().unwrap_or_default(), bytes }
    }

    fn pointer<T>(&mut self) -> *mut T {
        self.bytes.as_mut().map_or(null_mut(), |bytes| bytes.as_mut_ptr().cast())
    }

    fn assert_unchanged(&self, status: AtrousStatus) {
        let is_same = self.bytes.as_ref().is_none_or(|bytes| *bytes == self.before);
        assert!(status == AtrousStatus::Ok || is_same, "{status:?}, and something was written");
    }
}

/// Replaces some of the 32-bit fields behind the size.
fn spoil<T: Copy>(value: &mut T, choices: &mut Choices<'_>) {
    const { assert!(size_of::<T>().is_multiple_of(4)) };
    let words = std::ptr::from_mut(value).cast::<u32>();
    for _ in 0..choices.below(4) {
        let at = 1 + choices.below(size_of::<T>() / 4 - 1);
        let word = if choices.one_in(2) { choices.odd() } else { choices.odd_float().to_bits() };
        // SAFETY: the value has more words than that, and those that are used here are numbers alone.
        unsafe { words.add(at).write_unaligned(word) };
    }
}

fn config(choices: &mut Choices<'_>) -> AtrousConfig {
    // SAFETY: a struct of numbers.
    let mut config: AtrousConfig = unsafe { std::mem::zeroed() };
    config.struct_size = size_of::<AtrousConfig>() as u32;
    // SAFETY: a live struct with its size.
    assert_eq!(unsafe { atrous_config_default(&mut config, 1 + choices.below(6) as u32, 5) }, AtrousStatus::Ok);
    if choices.one_in(2) {
        spoil(&mut config, choices);
    }
    config
}

fn params(choices: &mut Choices<'_>) -> AtrousFrameParams {
    // SAFETY: a struct of numbers.
    let mut params: AtrousFrameParams = unsafe { std::mem::zeroed() };
    params.struct_size = size_of::<AtrousFrameParams>() as u32;
    // SAFETY: a live struct with its size.
    assert_eq!(unsafe { atrous_frame_params_default(&mut params, 1 + choices.below(6) as u32, 5) }, AtrousStatus::Ok);
    if choices.one_in(2) {
        spoil(&mut params, choices);
    }
    params
}

/// Never with a device: all else is looked at before.
fn create(choices: &mut Choices<'_>) -> AtrousStatus {
    let mut inner = Given::new(config(choices), choices);
    let info = AtrousCreateInfo {
        struct_size: size_of::<AtrousCreateInfo>() as u32,
        instance: Default::default(),
        physical_device: Default::default(),
        device: Default::default(),
        get_instance_proc_addr: None,
        config: inner.pointer(),
        pipeline_cache: Default::default(),
        pipelines: std::ptr::null(),
        legacy_barriers: choices.odd(),
        debug_labels: 0,
        graph: std::ptr::null(),
        checks: choices.odd(),
        check_guides: choices.odd(),
        stay_in_general: choices.odd(),
        reserved: choices.odd(),
    };
    let mut outer = Given::new(info, choices);
    let mut denoiser = null_mut();
    // SAFETY: pointers are null or to as many bytes as the sizes say.
    let status = unsafe { atrous_create(outer.pointer(), if choices.one_in(8) { null_mut() } else { &mut denoiser }) };
    assert!(status != AtrousStatus::Ok && denoiser.is_null(), "a denoiser without a device");
    status
}

fn defaults(choices: &mut Choices<'_>) -> AtrousStatus {
    let mut config = Given::new(config(choices), choices);
    let mut params = Given::new(params(choices), choices);
    // SAFETY: a struct of numbers.
    let mut field: AtrousTuningField = unsafe { std::mem::zeroed() };
    field.struct_size = size_of::<AtrousTuningField>() as u32;
    let mut field = Given::new(field, choices);
    // SAFETY: pointers are null or to as many bytes as the sizes say.
    let statuses = unsafe {
        [
            atrous_config_default(config.pointer(), choices.odd(), choices.odd()),
            atrous_frame_params_default(params.pointer(), choices.odd(), choices.odd()),
            atrous_tuning_field(choices.odd(), field.pointer()),
        ]
    };
    config.assert_unchanged(statuses[0]);
    params.assert_unchanged(statuses[1]);
    field.assert_unchanged(statuses[2]);
    statuses.into_iter().find(|status| *status != AtrousStatus::Ok).unwrap_or(AtrousStatus::Ok)
}

/// Handles that nobody made.
fn handles(choices: &mut Choices<'_>) -> AtrousStatus {
    let handle = std::ptr::without_provenance_mut(choices.odd() as usize);
    let mut frame = Given::new(params(choices), choices);
    let name = c"alpha";
    // SAFETY: pointers are null or to as many bytes as the sizes say; the handle is looked up, not followed.
    let statuses = unsafe {
        [
            atrous_invalidate(handle),
            atrous_resize(handle, choices.odd(), choices.odd()),
            atrous_set_tuning(handle, if choices.one_in(4) { null() } else { name.as_ptr() }, choices.odd_float()),
            atrous_begin_frame(handle, frame.pointer(), null_mut()),
            atrous_record(handle, null(), Default::default(), choices.odd(), null(), choices.odd()),
            atrous_destroy(handle),
        ]
    };
    assert!(!statuses.contains(&AtrousStatus::Ok), "a handle that nobody made was taken: {statuses:?}");
    statuses[5]
}

fn conventions(choices: &mut Choices<'_>) -> AtrousStatus {
    let [width, height] = [1 + choices.below(6) as u32, 1 + choices.below(6) as u32];
    let count = (width * height) as usize;
    let floats: Vec<f32> = (0..count * 4).map(|_| choices.odd_float()).collect();
    let ids: Vec<u32> = (0..count).map(|_| choices.odd()).collect();
    let (mut config, mut of_frame) = (Given::new(config(choices), choices), Given::new(params(choices), choices));
    let some = |choices: &mut Choices<'_>| if choices.one_in(6) { null() } else { floats.as_ptr() };
    let guides = AtrousGuides {
        struct_size: size_of::<AtrousGuides>() as u32,
        // More than the images have cannot be found out; none at all, and too many for any image can.
        width: if choices.one_in(12) { choices.one_of(&[0, 16385, u32::MAX]) } else { width },
        height,
        params: of_frame.pointer(),
        depth: some(choices),
        normal: some(choices),
        motion: some(choices),
        surface_id: if choices.one_in(3) { null() } else { ids.as_ptr() },
    };
    let (mut previous, mut current) = (Given::new(guides, choices), Given::new(guides, choices));
    // SAFETY: a struct of numbers.
    let mut report: AtrousConventionReport = unsafe { std::mem::zeroed() };
    report.struct_size = size_of::<AtrousConventionReport>() as u32;
    let mut report = Given::new(report, choices);
    // SAFETY: pointers are null or to as many bytes as the sizes say, images to as many texels as the extent has.
    let status = unsafe { atrous_check_conventions(config.pointer(), previous.pointer(), current.pointer(), report.pointer()) };
    report.assert_unchanged(status);
    status
}
