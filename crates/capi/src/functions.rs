//! Functions of the C ABI but recording: creation, declarations, tuning, frames.

use crate::convert::{self, flag};
use crate::device::{checks, load};
use crate::graph::declaration_of;
use crate::handle::{self, AtrousDenoiser, State};
use crate::pointers::{check_size, read, write};
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::*;
use crate::AtrousConfig;
use atrous::contract::ResourceId;
use atrous::{Denoiser, Placement, Tuning, UseFrame};
use std::ffi::{c_char, CStr};

/// Fills a configuration with defaults for an extent.
///
/// # Safety
/// `config` is null or points to an AtrousConfig with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_config_default(config: *mut AtrousConfig, width: u32, height: u32) -> AtrousStatus {
    // SAFETY: `config` is null or points to a struct that begins with its size, writable for that many bytes.
    guard(|| unsafe { write("config", config, || Ok(AtrousConfig::default_for([width, height]))) })
}

/// Fills the parameters of a frame with defaults: identity matrices, no jitter, no reset.
///
/// # Safety
/// `params` is null or points to an AtrousFrameParams with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_frame_params_default(params: *mut AtrousFrameParams, width: u32, height: u32) -> AtrousStatus {
    // SAFETY: `params` is null or points to a struct that begins with its size, writable for that many bytes.
    guard(|| unsafe { write("params", params, || Ok(AtrousFrameParams::default_for([width, height]))) })
}

/// Creates a denoiser: pipelines and descriptor pools, no memory.
///
/// # Safety
/// Pointers are null or valid with their struct_size set; handles are live, belong together and outlive the denoiser.
#[no_mangle]
pub unsafe extern "C" fn atrous_create(info: *const AtrousCreateInfo, denoiser: *mut *mut AtrousDenoiser) -> AtrousStatus {
    guard(|| {
        if denoiser.is_null() {
            return Err(Failure::argument("denoiser is NULL; give a pointer to where the handle goes"));
        }
        // SAFETY: `denoiser` is not null and writable for a pointer; `info` and its `config` are null or point to structs that
        // begin with their size; the host keeps the handles in them alive.
        unsafe {
            denoiser.write_unaligned(std::ptr::null_mut());
            let info = read("info", info)?;
            denoiser.write_unaligned(handle::insert(create(&info)?));
        }
        Ok(())
    })
}

/// # Safety
/// Obligations of [`atrous_create`].
unsafe fn create(info: &AtrousCreateInfo) -> Result<State, Failure> {
    // SAFETY: `config` is null or points to a struct that begins with its size; the handles are live and belong together, and the host
    // keeps them alive until `atrous_destroy`.
    let (denoiser, preset) = unsafe {
        let (declaration, preset) = declaration_of(info)?;
        let host = load(info)?;
        let mut denoiser = Denoiser::new(host.device(), declaration)?;
        denoiser.checks.on = checks(info)?.unwrap_or(denoiser.checks.on);
        if flag("debug_labels", info.debug_labels)? {
            denoiser.name_objects(host.device());
        }
        (denoiser, preset)
    };
    let frames = vec![None; denoiser.declaration().setup().frames_in_flight as usize];
    Ok(State { denoiser, tuning: Tuning::for_preset(preset), generation: 0, frames })
}

/// Destroys a denoiser. Your handle is invalid from then on, and stays so.
///
/// # Safety
/// GPU work that was recorded with it is complete; the device is live.
#[no_mangle]
pub unsafe extern "C" fn atrous_destroy(denoiser: *mut AtrousDenoiser) -> AtrousStatus {
    guard(|| handle::remove(denoiser))
}

/// Declares everything for a new extent, and keeps the pipelines. Your history starts over. Begin
/// your frames again: those begun before are refused. Nothing changes on the device, so your
/// recorded work may still be in flight, as long as its images live. A refused extent changes
/// nothing.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_resize(denoiser: *mut AtrousDenoiser, width: u32, height: u32) -> AtrousStatus {
    guard(|| {
        handle::change(denoiser, |state| {
            state.denoiser.resize([width, height])?;
            state.generation += 1;
            state.frames.fill(None);
            Ok(())
        })
    })
}

/// Counts resources and passes. You may leave either pointer null.
///
/// # Safety
/// Pointers are null or valid.
#[no_mangle]
pub unsafe extern "C" fn atrous_counts(denoiser: *const AtrousDenoiser, resources: *mut u32, passes: *mut u32) -> AtrousStatus {
    guard(|| {
        handle::read(denoiser, |state| {
            let declaration = state.denoiser.declaration();
            for (to, count) in [(resources, declaration.resources().len()), (passes, declaration.passes().len())] {
                if !to.is_null() {
                    // SAFETY: not null, so it points to a u32 that may be written.
                    unsafe { to.write_unaligned(count as u32) };
                }
            }
            Ok(())
        })
    })
}

/// Declares a resource.
///
/// # Safety
/// `resource` is null or points to an AtrousResource with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_resource(
    denoiser: *const AtrousDenoiser,
    index: u32,
    resource: *mut AtrousResource,
) -> AtrousStatus {
    guard(|| {
        handle::read(denoiser, |state| {
            let declaration = state.denoiser.declaration();
            let count = declaration.resources().len();
            let value = || match (index as usize) < count {
                true => Ok(convert::resource(declaration, ResourceId(index))),
                false => Err(Failure::argument(format!("resource {index} does not exist; there are {count}"))),
            };
            // SAFETY: `resource` is null or points to a struct that begins with its size, writable for that many bytes.
            unsafe { write("resource", resource, value) }
        })
    })
}

/// Declares a pass. Passes run in the order of their indices.
///
/// # Safety
/// `pass` is null or points to an AtrousPass with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_pass(denoiser: *const AtrousDenoiser, index: u32, pass: *mut AtrousPass) -> AtrousStatus {
    guard(|| {
        handle::read(denoiser, |state| {
            let declaration = state.denoiser.declaration();
            let missing = || Failure::argument(format!("pass {index} does not exist; there are {}", declaration.passes().len()));
            // SAFETY: `pass` is null or points to a struct that begins with its size, writable for that many bytes.
            unsafe { write("pass", pass, || convert::pass(declaration, index as usize).ok_or_else(missing)) }
        })
    })
}

/// Counts the bytes of the declared resources.
///
/// # Safety
/// `memory` is null or points to an AtrousMemory with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_memory(denoiser: *const AtrousDenoiser, memory: *mut AtrousMemory) -> AtrousStatus {
    guard(|| {
        handle::read(denoiser, |state| {
            let m = state.denoiser.declaration().memory();
            let value = AtrousMemory {
                struct_size: size_of::<AtrousMemory>() as u32,
                history: m.history,
                transient: m.transient,
                transient_unaliased: m.transient_unaliased,
                output: m.output,
            };
            // SAFETY: `memory` is null or points to a struct that begins with its size, writable for that many bytes.
            unsafe { write("memory", memory, || Ok(value)) }
        })
    })
}

/// Places transients in memory of yours, so that those share it whose lives do not overlap. You give resource, size and alignment of
/// each, as vkGetImageMemoryRequirements has them; you get each offset, and in `size` the bytes needed in all. Create such images
/// with VK_IMAGE_CREATE_ALIAS_BIT, and call atrous_tracker_alias for each pair that overlaps.
///
/// # Safety
/// `size` is null or points to a number; `placements` points to `count` of them.
#[no_mangle]
pub unsafe extern "C" fn atrous_place_transients(
    denoiser: *const AtrousDenoiser,
    placements: *mut AtrousPlacement,
    count: u32,
    size: *mut u64,
) -> AtrousStatus {
    guard(|| {
        if placements.is_null() || size.is_null() {
            return Err(Failure::argument("placements or size is NULL; give an array, and a pointer to where the size goes"));
        }
        handle::read(denoiser, |state| {
            let declaration = state.denoiser.declaration();
            let most = declaration.resources().len();
            if count as usize > most {
                return Err(Failure::argument(format!("count is {count}; there are {most} resources")));
            }
            // SAFETY: there are `count` of them, and i is below that.
            let at = |i: usize| unsafe { placements.add(i) };
            let given = (0..count as usize).map(|i| {
                // SAFETY: the pointer is that of an element.
                let AtrousPlacement { resource, size, alignment, .. } = unsafe { at(i).read_unaligned() };
                match (resource as usize) < most {
                    true => Ok(Placement { resource: ResourceId(resource), size, alignment, offset: 0 }),
                    false => Err(Failure::argument(format!("resource {resource} does not exist; there are {most}"))),
                }
            });
            let mut placed = given.collect::<Result<Vec<_>, _>>()?;
            let total = declaration.place(&mut placed)?;
            for (i, Placement { resource, size, alignment, offset }) in placed.into_iter().enumerate() {
                // SAFETY: the pointer is that of an element, which may be written.
                unsafe { at(i).write_unaligned(AtrousPlacement { resource: resource.0, reserved: 0, size, alignment, offset }) };
            }
            // SAFETY: not null, so it points to a number that may be written.
            unsafe { size.write_unaligned(total) };
            Ok(())
        })
    })
}

/// Describes a number of the tuning by its index. You get an invalid argument beyond the last.
///
/// # Safety
/// `field` is null or points to an AtrousTuningField with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_tuning_field(index: u32, field: *mut AtrousTuningField) -> AtrousStatus {
    guard(|| {
        let value = || {
            let missing = || Failure::argument(format!("tuning {index} does not exist; there are {}", Tuning::FIELDS.len()));
            let f = Tuning::FIELDS.get(index as usize).ok_or_else(missing)?;
            let struct_size = size_of::<AtrousTuningField>() as u32;
            Ok(AtrousTuningField { struct_size, min: f.min, max: f.max, default_value: f.default, name: convert::name(f.name) })
        };
        // SAFETY: `field` is null or points to a struct that begins with its size, writable for that many bytes.
        unsafe { write("field", field, value) }
    })
}

/// Sets a number of the tuning from the next frame on. You keep the history.
///
/// # Safety
/// `name` is null or a null-terminated string.
#[no_mangle]
pub unsafe extern "C" fn atrous_set_tuning(denoiser: *mut AtrousDenoiser, name: *const c_char, value: f32) -> AtrousStatus {
    guard(|| {
        // SAFETY: `name` is null or a string with a null at its end, which lives through this call.
        let name = unsafe { string("name", name)? };
        handle::change(denoiser, |state| Ok(state.tuning.set(&name, value)?))
    })
}

/// A string of the host.
///
/// # Safety
/// `text` is null or a string with a null at its end, which lives through this call.
pub(super) unsafe fn string(what: &str, text: *const c_char) -> Result<String, Failure> {
    if text.is_null() {
        return Err(Failure::argument(format!("{what} is NULL; give a string")));
    }
    // SAFETY: not null, so it is a string that lives through this call.
    Ok(unsafe { CStr::from_ptr(text) }.to_string_lossy().into_owned())
}

/// Makes the next frame drop all history. Call it after you re-created images.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_invalidate(denoiser: *mut AtrousDenoiser) -> AtrousStatus {
    guard(|| {
        handle::change(denoiser, |state| {
            state.denoiser.invalidate();
            Ok(())
        })
    })
}

/// Starts a frame. Pass `frame` to every atrous_record of that frame.
///
/// # Safety
/// Pointers are null or valid with their struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_begin_frame(
    denoiser: *mut AtrousDenoiser,
    params: *const AtrousFrameParams,
    frame: *mut AtrousFrame,
) -> AtrousStatus {
    guard(|| {
        handle::change(denoiser, |state| {
            // SAFETY: `frame` and `params` are null or point to structs that begin with their size, readable for as long as it
            // says.
            let params = unsafe {
                check_size("frame", frame)?;
                read("params", params)?.to_params()?
            };
            let context = state.denoiser.begin_frame(&params, &state.tuning)?;
            // There is a slot for it, or it would have been refused.
            if let Some(begun) = state.frames.get_mut(context.slot as usize) {
                *begun = Some(context);
            }
            let value = AtrousFrame {
                struct_size: size_of::<AtrousFrame>() as u32,
                frame_slot: context.slot,
                index: context.index,
                generation: state.generation,
                current_copy: context.history_copy(UseFrame::Current) as u32,
                reset: context.reset.map_or(0, |reason| reason as u32),
            };
            // SAFETY: `frame` was found above to be of the right size, and it is writable.
            unsafe { write("frame", frame, || Ok(value)) }
        })
    })
}
