//! Recording a pass.

use crate::convert::flag;
use crate::handle::{self, AtrousDenoiser, State};
use crate::pointers::read;
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::{AtrousBinding, AtrousFrame, ATROUS_MAX_USES};
use ash::vk::{Buffer, CommandBuffer, Format, Handle, Image, ImageLayout, ImageUsageFlags, ImageView};
use atrous::{Binding, Error, FrameContext, ImageDescription};

/// Records one pass. It allocates nothing; you place the barriers and submit. Give the `bindings` in the order of the pass's uses.
///
/// Clobbers the compute pipeline, compute descriptor set 0 and push constants of the command buffer.
///
/// # Safety
/// Pointers are null or valid. The command buffer is recording, outside a render pass, for a queue family with compute. Every
/// binding has its declared format, extent and layout, earlier writes to it are visible, and it outlives the execution. GPU work
/// that was recorded earlier with the same frame_slot is complete.
#[no_mangle]
pub unsafe extern "C" fn atrous_record(
    denoiser: *mut AtrousDenoiser,
    frame: *const AtrousFrame,
    command_buffer: CommandBuffer,
    pass: u32,
    bindings: *const AtrousBinding,
    binding_count: u32,
) -> AtrousStatus {
    guard(|| {
        handle::read(denoiser, |state| {
            // SAFETY: `frame` is null or points to a struct that begins with its size, readable for that many bytes.
            let context = frame_of(state, &unsafe { read("frame", frame)? })?;
            if command_buffer.is_null() {
                return Err(Failure::argument("command_buffer is NULL; give one that is recording"));
            }
            if bindings.is_null() && binding_count > 0 {
                return Err(Failure::argument(format!("bindings is NULL, but binding_count is {binding_count}")));
            }
            // Checked before anything is read, since a wrong count may reach beyond what the host has.
            let count = binding_count as usize;
            check_count(state, pass, count)?;
            let mut bound = [Binding::Absent; ATROUS_MAX_USES];
            for (i, to) in bound.iter_mut().take(count).enumerate() {
                // SAFETY: `bindings` points to `count` of them, and i is below that.
                *to = binding(i, &unsafe { bindings.add(i).read_unaligned() })?;
            }
            let bound = bound.get(..count).unwrap_or_default();
            // SAFETY: the command buffer is recording outside a render pass on a compute queue; the host keeps what is bound alive
            // and in its declared state, and work recorded earlier with this slot is complete.
            unsafe { state.denoiser.record(command_buffer, context, pass as usize, bound)? };
            Ok(())
        })
    })
}

/// Switches checks on (1) or off (0) that tell you mistakes which Vulkan does not see, for some microseconds a frame. They are on
/// from the start where the library is a debug build. atrous_record then refuses a layout that no shader reads, one image for both
/// copies of a history, and copies that you do not exchange; atrous_begin_frame names passes that you left out of the previous frame,
/// and the frame after that drops all history.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_set_checks(denoiser: *mut AtrousDenoiser, on: u32) -> AtrousStatus {
    guard(|| {
        let on = flag("on", on)?;
        handle::change(denoiser, |state| {
            state.denoiser.checks.on = on;
            Ok(())
        })
    })
}

/// Describes an image by its view, so that checks compare its format, extent and usage with those declared wherever you bind the
/// view. Describe a view again if its handle is used for another one.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_describe_image(
    denoiser: *mut AtrousDenoiser,
    view: ImageView,
    format: Format,
    width: u32,
    height: u32,
    usage: ImageUsageFlags,
) -> AtrousStatus {
    guard(|| {
        if view.is_null() {
            return Err(Failure::argument("view is VK_NULL_HANDLE; give the view that you bind"));
        }
        handle::change(denoiser, |state| {
            state.denoiser.checks.images.insert(view, ImageDescription { format, extent: [width, height], usage });
            Ok(())
        })
    })
}

pub(super) fn frame_of<'s>(state: &'s State, given: &AtrousFrame) -> Result<&'s FrameContext, Failure> {
    let stale = |message: String| Failure { status: AtrousStatus::StaleFrame, message };
    if given.generation != state.generation {
        return Err(stale(format!(
            "frame {} was begun before atrous_resize; begin another one, and bind images of the new extent",
            given.index
        )));
    }
    let begun = state.frames.get(given.frame_slot as usize).and_then(Option::as_ref);
    begun.filter(|context| context.index == given.index).ok_or_else(|| {
        stale(format!(
            "frame {} is not the one that was begun last in slot {}; call atrous_begin_frame",
            given.index, given.frame_slot
        ))
    })
}

/// A pass has as many uses as there are bindings.
fn check_count(state: &State, pass: u32, count: usize) -> Result<(), Failure> {
    let passes = state.denoiser.declaration().passes();
    let Some(decl) = passes.get(pass as usize) else {
        return Err(Failure::argument(format!("pass {pass} does not exist; there are {}", passes.len())));
    };
    if decl.uses.len() != count {
        return Err(Error::Bindings { pass: decl.name.clone(), given: count, needed: decl.uses.len() }.into());
    }
    Ok(())
}

impl From<&Binding> for AtrousBinding {
    fn from(binding: &Binding) -> Self {
        let none = Self {
            image: Image::null(),
            view: ImageView::null(),
            layout: ImageLayout::UNDEFINED,
            buffer: Buffer::null(),
            offset: 0,
            range: 0,
        };
        match *binding {
            Binding::Image { view, layout } => Self { view, layout, ..none },
            Binding::Buffer { buffer, offset, range } => Self { buffer, offset, range, ..none },
            Binding::Absent => none,
        }
    }
}

/// The binding that a host means, where its handles mean one thing.
pub(super) fn binding(index: usize, given: &AtrousBinding) -> Result<Binding, Failure> {
    let refused =
        |message: &str| Err(Failure { status: AtrousStatus::BadBindings, message: format!("binding {index} has {message}") });
    let has_image = !given.image.is_null();
    match (has_image || !given.view.is_null(), given.buffer.is_null()) {
        (true, false) => refused("both an image and a buffer; leave the handles of one VK_NULL_HANDLE"),
        (true, true) if given.view.is_null() => refused("an image without a view; give a 2D view of its mip 0 and layer 0"),
        (true, true) => Ok(Binding::Image { view: given.view, layout: given.layout }),
        (false, false) => Ok(Binding::Buffer { buffer: given.buffer, offset: given.offset, range: given.range }),
        (false, true) => Ok(Binding::Absent),
    }
}
