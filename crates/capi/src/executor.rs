//! A denoiser with images, barriers and memory of its own: one call for each frame.

use crate::device::{checks, load};
use crate::functions::string;
use crate::graph::declaration_of;
use crate::handle::{self, AtrousExecutor, ExecutorState};
use crate::pointers::{check_size, read};
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::{AtrousCreateInfo, AtrousFrameParams, AtrousLentImage};
use ash::vk::{AccessFlags2, Buffer, CommandBuffer, Handle, ImageLayout, PipelineStageFlags2};
use atrous::executor::{Executor, ExecutorOptions, HostImage, LentImage};
use atrous::{
    Counter, DebugView, Error, FrameContext, Lifetime, Phase, ResourceDecl, ResourceState, Shape, Subresource, Tuning, UseFrame,
};
use std::ffi::{c_char, CStr};

impl ExecutorState {
    fn newest(&self) -> Result<FrameContext, Failure> {
        let none = || Failure {
            status: AtrousStatus::StaleFrame,
            message: "no frame yet; call atrous_executor_denoise or atrous_executor_begin_frame".into(),
        };
        self.newest.ok_or_else(none)
    }
}

/// Creates a denoiser with all images but your inputs. The device has synchronization2 enabled, or `legacy_barriers` is 1.
///
/// # Safety
/// Pointers are null or valid with their struct_size set; handles are live, belong together and outlive the executor.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_create(info: *const AtrousCreateInfo, executor: *mut *mut AtrousExecutor) -> AtrousStatus {
    guard(|| {
        if executor.is_null() {
            return Err(Failure::argument("executor is NULL; give a pointer to where the handle goes"));
        }
        // SAFETY: `executor` is not null and writable for a pointer; `info` and its `config` are null or point to structs that
        // begin with their size; the host keeps the handles in them alive.
        unsafe {
            executor.write_unaligned(std::ptr::null_mut());
            let info = read("info", info)?;
            let (declaration, preset) = declaration_of(&info)?;
            let options = ExecutorOptions {
                // An output that the host does not lend can be copied: atrous_executor_record_copy.
                extra_image_usage: ash::vk::ImageUsageFlags::TRANSFER_SRC,
                legacy_barriers: crate::convert::flag("legacy_barriers", info.legacy_barriers)?,
                debug_labels: crate::convert::flag("debug_labels", info.debug_labels)?,
                stay_in_general: crate::convert::flag("stay_in_general", info.stay_in_general)?,
                checks: checks(&info)?,
                check_guides: crate::convert::flag("check_guides", info.check_guides)?.then_some(atrous_conventions::check_frames),
                ..Default::default()
            };
            let host = load(&info)?;
            let made = Executor::new(host.device(), declaration, options)?;
            let state = ExecutorState { executor: made, tuning: Tuning::for_preset(preset), newest: None, next_phase: 0 };
            executor.write_unaligned(handle::insert(state));
        }
        Ok(())
    })
}

/// Destroys an executor and its memory. Your handle is invalid from then on, and stays so.
///
/// # Safety
/// GPU work that was recorded with it is complete; the device is live.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_destroy(executor: *mut AtrousExecutor) -> AtrousStatus {
    guard(|| handle::remove(executor))
}

/// Allocates everything for a new extent, and keeps the pipelines. Your history starts over. A refused extent changes nothing.
///
/// # Safety
/// All GPU work recorded with this executor is complete, and none is left to submit.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_resize(executor: *mut AtrousExecutor, width: u32, height: u32) -> AtrousStatus {
    guard(|| {
        handle::change(executor, |state| {
            // SAFETY: all GPU work recorded with the executor is complete, and none is left to submit.
            unsafe { state.executor.resize([width, height])? };
            state.newest = None;
            Ok(())
        })
    })
}

/// Sets a number of the tuning from the next frame on, as atrous_set_tuning does.
///
/// # Safety
/// `name` is null or a null-terminated string.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_set_tuning(
    executor: *mut AtrousExecutor,
    name: *const c_char,
    value: f32,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `name` is null or a string with a null at its end, which lives through this call.
        let name = unsafe { string("name", name)? };
        handle::change(executor, |state| Ok(state.tuning.set(&name, value)?))
    })
}

/// Forgets recorded work that will never run, for example because a submission failed. The next frame drops all history.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_forget_recorded(executor: *mut AtrousExecutor) -> AtrousStatus {
    guard(|| {
        handle::change(executor, |state| {
            state.executor.forget_recorded();
            Ok(())
        })
    })
}

/// Denoises a frame on your command buffer, with all barriers. Lend every image anew in each frame: an optional input that you do
/// not lend is left out, and an output that you do not lend belongs to the executor.
///
/// # Safety
/// Pointers are null or valid. The command buffer is recording, outside a render pass, for a queue family with compute. Images are
/// live and in their states. GPU work that was recorded earlier with the same frame_slot is complete.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_denoise(
    executor: *mut AtrousExecutor,
    command_buffer: CommandBuffer,
    params: *const AtrousFrameParams,
    images: *const AtrousLentImage,
    image_count: u32,
) -> AtrousStatus {
    guard(|| {
        handle::change(executor, |state| {
            check_image_count(state, image_count)?;
            if command_buffer.is_null() {
                return Err(Failure::argument("command_buffer is NULL; give one that is recording"));
            }
            // SAFETY: `params` is null or points to a struct that begins with its size; `images` is null or points to
            // `image_count` structs that begin with their size, with names that are null or strings.
            let (params, lent) = unsafe { (read("params", params)?.to_params()?, lent_images(images, image_count)?) };
            // SAFETY: the command buffer is recording outside a render pass on a compute queue; lent images are live and in the
            // states that were given, and work recorded earlier with this slot is complete.
            let frame = unsafe { state.executor.denoise(command_buffer, &params, &state.tuning, &lent)? };
            (state.newest, state.next_phase) = (Some(frame), Phase::ALL.len() as u32);
            Ok(())
        })
    })
}

/// Begins a frame whose phases you record one by one, for example with your path tracer between them. Images are lent as to
/// atrous_executor_denoise; each phase finds them in the states that you give here, and leaves them so: after_layout is
/// VK_IMAGE_LAYOUT_UNDEFINED.
///
/// # Safety
/// Pointers are null or valid. Images are live until the frame is recorded.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_begin_frame(
    executor: *mut AtrousExecutor,
    params: *const AtrousFrameParams,
    images: *const AtrousLentImage,
    image_count: u32,
) -> AtrousStatus {
    guard(|| {
        handle::change(executor, |state| {
            check_image_count(state, image_count)?;
            // SAFETY: `params` is null or points to a struct that begins with its size; `images` is null or points to
            // `image_count` structs that begin with their size, with names that are null or strings.
            let (params, lent) = unsafe { (read("params", params)?.to_params()?, lent_images(images, image_count)?) };
            if let Some(image) = lent.iter().find(|image| image.after.is_some()) {
                let message =
                    "has an after_layout; leave it VK_IMAGE_LAYOUT_UNDEFINED, since each phase leaves images as it finds them";
                return Err(Failure::argument(format!("{} {message}", image.name)));
            }
            let resources = state.executor.denoiser().declaration().resources().iter();
            let is_lent = |name: &str| lent.iter().any(|image| image.name == name);
            let is_shared = |resource: &&ResourceDecl| {
                matches!(resource.lifetime, Lifetime::Input { .. } | Lifetime::Output)
                    && matches!(resource.shape, Shape::Image { .. })
            };
            let others = resources.filter(is_shared).filter(|resource| !is_lent(&resource.name));
            let others: Vec<_> = others.map(|resource| resource.name.clone()).collect();
            others.iter().try_for_each(|name| state.executor.unbind(name))?;
            lent.iter().try_for_each(|image| state.executor.bind_image(image.name, image.image))?;
            (state.newest, state.next_phase) = (Some(state.executor.begin_frame(&params, &state.tuning)?), 0);
            Ok(())
        })
    })
}

/// Records an AtrousPhase of the frame that was begun last, with all barriers; each phase once, in their order.
///
/// # Safety
/// The command buffer is recording, outside a render pass, for a queue family with compute, and runs behind those of the phases
/// before. Lent images are live and in their states. GPU work that was recorded earlier with the same frame_slot is complete.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_record(
    executor: *mut AtrousExecutor,
    command_buffer: CommandBuffer,
    phase: u32,
) -> AtrousStatus {
    guard(|| {
        let which = crate::convert::phase(phase)?;
        if command_buffer.is_null() {
            return Err(Failure::argument("command_buffer is NULL; give one that is recording"));
        }
        handle::change(executor, |state| {
            let frame = state.newest()?;
            if phase < state.next_phase {
                let message = format!("phase {phase} of frame {} was recorded, or one behind it; begin a frame", frame.index);
                return Err(Failure { status: AtrousStatus::StaleFrame, message });
            }
            // SAFETY: the command buffer is recording outside a render pass on a compute queue; what is lent is live and in the states
            // that were given, and work recorded earlier with this slot is complete.
            unsafe { state.executor.record(command_buffer, &frame, which)? };
            state.next_phase = phase + 1;
            Ok(())
        })
    })
}

/// Binds a buffer of yours, for example ATROUS_INPUT_INSTANCE_TRANSFORMS, until you bind a new one or, with a null `buffer`, none.
/// `stage` and `access` are your own uses before each phase.
///
/// # Safety
/// `name` is null or a null-terminated string. The buffer has `size` bytes and the declared usage, and is live while it is bound.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_bind_buffer(
    executor: *mut AtrousExecutor,
    name: *const c_char,
    buffer: Buffer,
    size: u64,
    stage: PipelineStageFlags2,
    access: AccessFlags2,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `name` is null or a string with a null at its end, which lives through this call.
        let name = unsafe { string("name", name)? };
        handle::change(executor, |state| match buffer.is_null() {
            true => Ok(state.executor.unbind(&name)?),
            false => Ok(state.executor.bind_buffer(&name, buffer, size, stage, access)?),
        })
    })
}

fn check_image_count(state: &ExecutorState, image_count: u32) -> Result<(), Failure> {
    let most = state.executor.denoiser().declaration().resources().len();
    if image_count as usize > most {
        return Err(Failure::argument(format!("image_count is {image_count}; there are {most} resources")));
    }
    Ok(())
}

/// # Safety
/// `images` is null or points to `count` structs, each as large as the size in it, with names that are null or strings.
unsafe fn lent_images<'a>(images: *const AtrousLentImage, count: u32) -> Result<Vec<LentImage<'a>>, Failure> {
    if count == 0 {
        return Ok(Vec::new());
    }
    // SAFETY: `images` is null or points to at least one.
    let stride = unsafe { check_size("images[0]", images)? };
    (0..count as usize)
        .map(|i| {
            let what = format!("images[{i}]");
            // SAFETY: there are `count` of them, all of one size, and each name is null or a string that lives through the call.
            unsafe {
                let at = images.byte_add(i * stride);
                let given = check_size(&what, at)?;
                if given != stride {
                    return Err(Failure::argument(format!(
                        "{what}: struct_size is {given}, and that of images[0] is {stride}; give one size"
                    )));
                }
                let image = read(&what, at)?;
                if image.name.is_null() {
                    return Err(Failure::argument(format!(
                        "{what}.name is NULL; give one of ATROUS_INPUT_* or the name of an output"
                    )));
                }
                let name = CStr::from_ptr(image.name).to_str();
                let name = name.map_err(|error| Failure::argument(format!("{what}.name is not UTF-8: {error}")))?;
                lent(&what, name, &image)
            }
        })
        .collect()
}

fn lent<'a>(what: &str, name: &'a str, given: &AtrousLentImage) -> Result<LentImage<'a>, Failure> {
    if given.image.is_null() || given.view.is_null() {
        return Err(Failure::argument(format!("{what}, {name}, has no image or no view; leave an optional image out of the list")));
    }
    let image = HostImage {
        image: given.image,
        view: given.view,
        subresource: Subresource { layer: given.layer, level: given.level },
        format: given.format,
        extent: [given.width, given.height],
        layout: given.layout,
        stage: given.stage,
        access: given.access,
    };
    let is_moved = given.after_layout != ImageLayout::UNDEFINED;
    let after = is_moved.then(|| ResourceState::new(given.after_stage, given.after_access, given.after_layout));
    Ok(LentImage { name, image, after })
}

/// Copies a resource of the newest frame into your buffer, visible to the CPU once the command buffer has run.
///
/// # Safety
/// `name` is null or a string. The command buffer is recording, outside a render pass; the buffer has usage TRANSFER_DST and as many
/// bytes as `buffer_size` says.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_record_copy(
    executor: *mut AtrousExecutor,
    command_buffer: CommandBuffer,
    name: *const c_char,
    buffer: Buffer,
    buffer_size: u64,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `name` is null or a string with a null at its end, which lives through this call.
        let name = unsafe { string("name", name)? };
        if command_buffer.is_null() || buffer.is_null() {
            return Err(Failure::argument("command_buffer or buffer is NULL; give one that is recording, and one to copy to"));
        }
        handle::change(executor, |state| {
            let frame = state.newest()?;
            let needed = state.executor.readback(&name, &frame, UseFrame::Current)?.bytes;
            if buffer_size < needed {
                let (given, needed) = (format!("{buffer_size} bytes"), format!("at least {needed} bytes"));
                return Err(Error::Size { resource: name.clone(), given, needed }.into());
            }
            // SAFETY: the command buffer is recording outside a render pass, and the buffer has room.
            unsafe { state.executor.record_copy(command_buffer, &frame, &name, UseFrame::Current, buffer)? };
            Ok(())
        })
    })
}

/// Draws the resource `debug_view` of the newest frame again, with a different AtrousView, for a submission after that of the frame.
/// The configuration has `debug_view` 1.
///
/// # Safety
/// Obligations of atrous_executor_denoise: images that were lent to the newest frame are live, and in the states that it left.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_record_debug_view(
    executor: *mut AtrousExecutor,
    command_buffer: CommandBuffer,
    view: u32,
) -> AtrousStatus {
    guard(|| {
        let view: Option<DebugView> = crate::convert::choice_or_none("view", view)?;
        if command_buffer.is_null() {
            return Err(Failure::argument("command_buffer is NULL; give one that is recording"));
        }
        handle::change(executor, |state| {
            let frame = FrameContext { debug_view: view, ..state.newest()? };
            state.executor.denoiser().declaration().find("debug_view").ok_or_else(|| {
                Failure::argument("there is no debug view; set debug_view of the configuration to 1, and create the executor anew")
            })?;
            // SAFETY: the command buffer is recording outside a render pass on a compute queue; what is bound is live and in the state
            // in which it was left.
            unsafe { state.executor.record_debug_view(command_buffer, &frame)? };
            Ok(())
        })
    })
}

/// Captures the inputs of the next `frames` frames as an EXR sequence in a folder, which the tool `atrous-denoise` replays. Lent
/// inputs need the usage TRANSFER_SRC. A frame is written when its slot comes round again; atrous_executor_finish_capture writes the
/// last ones, and has the error that ended a capture early.
///
/// # Safety
/// `folder` is null or a null-terminated string, a path in UTF-8.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_capture(
    executor: *mut AtrousExecutor,
    folder: *const c_char,
    frames: u32,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `folder` is null or a string with a null at its end, which lives through this call.
        let folder = unsafe { string("folder", folder)? };
        handle::change(executor, |state| Ok(state.executor.capture(&folder, frames)?))
    })
}

/// Writes the recorded frames of a capture, and ends it. `frames`, which may be null, becomes the number of those written.
///
/// # Safety
/// All GPU work recorded with this executor is complete; `frames` is null or points to a number.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_finish_capture(executor: *mut AtrousExecutor, frames: *mut u32) -> AtrousStatus {
    guard(|| {
        handle::change(executor, |state| {
            // SAFETY: all GPU work recorded with the executor is complete.
            let written = unsafe { state.executor.finish_capture()? };
            if !frames.is_null() {
                // SAFETY: not null, so it points to a number that may be written.
                unsafe { frames.write_unaligned(written) };
            }
            Ok(())
        })
    })
}

/// Counters of the newest frame that was read back, by AtrousCounter: the one before the last with the newest frame's slot. All are
/// 0 until then. `count` says how many your array holds.
///
/// # Safety
/// `counters` is null or points to `count` numbers.
#[no_mangle]
pub unsafe extern "C" fn atrous_executor_statistics(
    executor: *const AtrousExecutor,
    counters: *mut u32,
    count: u32,
) -> AtrousStatus {
    guard(|| {
        if counters.is_null() {
            return Err(Failure::argument("counters is NULL; give an array of ATROUS_COUNTER_COUNT numbers"));
        }
        handle::read(executor, |state| {
            let statistics = state.executor.statistics().unwrap_or_default();
            for (counter, i) in Counter::ALL.iter().zip(0..count as usize) {
                // SAFETY: there are `count` numbers, and i is below that.
                unsafe { counters.add(i).write_unaligned(statistics[*counter]) };
            }
            Ok(())
        })
    })
}
