//! The tracker: the barriers before each pass, for an engine that does not track its resources itself.

use crate::convert::flag;
use crate::handle::{self, AtrousDenoiser, AtrousTracker};
use crate::pointers::{check_size, read, write};
use crate::record::frame_of;
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::{AtrousBarriers, AtrousBinding, AtrousFrame, AtrousState};
use ash::vk::{Buffer, DependencyInfo, Handle, Image, ImageAspectFlags, ImageView};
use atrous::{
    Barrier, Barriers2, Binding, Declaration, FrameContext, LegacyBarriers, PhysicalResource, ResourceId, ResourceState,
    Subresource, Tracker,
};

/// The object behind a handle of a tracker.
pub(super) struct TrackerState {
    tracker: Tracker,
    /// Images and buffers by resource, then copy.
    physical: Vec<[Option<PhysicalResource>; 2]>,
    /// Copies of each resource: those of the declaration, and one of an input.
    copies: Vec<u32>,
    passes: u32,
    /// The denoiser that it was made for, and how often that was resized before.
    denoiser: *const AtrousDenoiser,
    generation: u64,
    arguments: Arguments,
    bindings: Vec<Binding>,
}

// SAFETY: the pointer is the number of a handle, and is never followed.
unsafe impl Send for TrackerState {}
// SAFETY: as above; all else is data.
unsafe impl Sync for TrackerState {}

/// The barriers of the last call, as arguments of the one or of the other function of Vulkan.
enum Arguments {
    Synchronization2(Barriers2),
    Legacy(LegacyBarriers),
}

impl TrackerState {
    fn new(denoiser: *const AtrousDenoiser, declaration: &Declaration, generation: u64, is_legacy: bool) -> Self {
        let arguments = match is_legacy {
            true => Arguments::Legacy(LegacyBarriers::default()),
            false => Arguments::Synchronization2(Barriers2::default()),
        };
        Self {
            tracker: Tracker::new(declaration),
            physical: vec![[None; 2]; declaration.resources().len()],
            copies: declaration.resources().iter().map(|resource| resource.lifetime.copies().max(1) as u32).collect(),
            passes: declaration.passes().len() as u32,
            denoiser,
            generation,
            arguments,
            bindings: Vec::new(),
        }
    }

    fn resource(&self, resource: u32) -> Result<ResourceId, Failure> {
        let count = self.copies.len();
        let missing = || Failure::argument(format!("resource {resource} does not exist; there are {count}"));
        self.copies.get(resource as usize).map(|_| ResourceId(resource)).ok_or_else(missing)
    }

    fn copy(&self, resource: u32, copy: u32) -> Result<(ResourceId, usize), Failure> {
        let id = self.resource(resource)?;
        let copies = self.copies[id.0 as usize];
        let missing = || Failure::argument(format!("copy {copy} of resource {resource} does not exist; it has {copies}, from 0"));
        (copy < copies).then_some((id, copy as usize)).ok_or_else(missing)
    }

    fn set_physical(&mut self, resource: u32, copy: u32, physical: Option<PhysicalResource>) -> Result<(), Failure> {
        let (id, copy) = self.copy(resource, copy)?;
        self.physical[id.0 as usize][copy] = physical;
        Ok(())
    }

    fn pass(&self, pass: u32) -> Result<usize, Failure> {
        let missing = || Failure::argument(format!("pass {pass} does not exist; there are {}", self.passes));
        (pass < self.passes).then_some(pass as usize).ok_or_else(missing)
    }

    /// # Safety
    /// `frame` is null or points to a struct that begins with its size.
    unsafe fn frame(&self, frame: *const AtrousFrame) -> Result<FrameContext, Failure> {
        // SAFETY: `frame` is null or points to a struct that begins with its size, readable for that many bytes.
        let frame = unsafe { read("frame", frame)? };
        handle::read(self.denoiser, |state| {
            if state.generation != self.generation {
                let message = "this tracker was made before atrous_resize; make one for the new images".to_owned();
                return Err(Failure { status: AtrousStatus::StaleFrame, message });
            }
            frame_of(state, &frame).copied()
        })
    }

    /// Makes arguments of what `found` gives, and writes where they lie.
    ///
    /// # Safety
    /// `barriers` is null or points to a struct that begins with its size, writable for that many bytes.
    unsafe fn give<'t>(
        &'t mut self,
        barriers: *mut AtrousBarriers,
        found: impl FnOnce(&'t mut Tracker) -> &'t [Barrier],
    ) -> Result<(), Failure> {
        // SAFETY: `barriers` is null or points to a struct that begins with its size.
        unsafe { check_size("barriers", barriers)? };
        let Self { tracker, physical, arguments, .. } = self;
        let object = |id: ResourceId, copy: usize| physical.get(id.0 as usize)?.get(copy).copied()?;
        let found = found(tracker);
        let value = match arguments {
            Arguments::Synchronization2(arguments) => {
                arguments.set(found, object);
                AtrousBarriers { dependency_info: lasting(arguments.dependency_info()), ..AtrousBarriers::NONE }
            }
            Arguments::Legacy(arguments) => {
                arguments.set(found, object);
                AtrousBarriers::of(arguments)
            }
        };
        // SAFETY: `barriers` was found to be of a possible size above, and it is writable.
        unsafe { write("barriers", barriers, || Ok(value)) }
    }
}

/// Its lists live in the tracker until the next call on that.
fn lasting(info: DependencyInfo<'_>) -> DependencyInfo<'static> {
    DependencyInfo {
        memory_barrier_count: info.memory_barrier_count,
        p_memory_barriers: info.p_memory_barriers.cast(),
        buffer_memory_barrier_count: info.buffer_memory_barrier_count,
        p_buffer_memory_barriers: info.p_buffer_memory_barriers.cast(),
        image_memory_barrier_count: info.image_memory_barrier_count,
        p_image_memory_barriers: info.p_image_memory_barriers.cast(),
        ..AtrousBarriers::NONE.dependency_info
    }
}

impl AtrousBarriers {
    const NONE: Self = Self {
        struct_size: size_of::<Self>() as u32,
        memory_count: 0,
        buffer_count: 0,
        image_count: 0,
        dependency_info: DependencyInfo {
            s_type: ash::vk::StructureType::DEPENDENCY_INFO,
            p_next: std::ptr::null(),
            dependency_flags: ash::vk::DependencyFlags::empty(),
            memory_barrier_count: 0,
            p_memory_barriers: std::ptr::null(),
            buffer_memory_barrier_count: 0,
            p_buffer_memory_barriers: std::ptr::null(),
            image_memory_barrier_count: 0,
            p_image_memory_barriers: std::ptr::null(),
            _marker: std::marker::PhantomData,
        },
        src_stage: ash::vk::PipelineStageFlags::TOP_OF_PIPE,
        dst_stage: ash::vk::PipelineStageFlags::BOTTOM_OF_PIPE,
        memory: std::ptr::null(),
        buffers: std::ptr::null(),
        images: std::ptr::null(),
    };

    fn of(legacy: &LegacyBarriers) -> Self {
        Self {
            memory_count: legacy.memory.len() as u32,
            buffer_count: legacy.buffers.len() as u32,
            image_count: legacy.images.len() as u32,
            src_stage: legacy.src_stage,
            dst_stage: legacy.dst_stage,
            memory: legacy.memory.as_ptr(),
            buffers: legacy.buffers.as_ptr(),
            images: legacy.images.as_ptr(),
            ..Self::NONE
        }
    }
}

impl From<AtrousState> for ResourceState {
    fn from(given: AtrousState) -> Self {
        Self::new(given.stage, given.access, given.layout).owned_by(given.queue_family)
    }
}

/// A state of the host.
///
/// # Safety
/// `state` is null or points to an AtrousState.
unsafe fn state_of(what: &str, state: *const AtrousState) -> Result<ResourceState, Failure> {
    if state.is_null() {
        return Err(Failure::argument(format!("{what} is NULL; give an AtrousState")));
    }
    // SAFETY: not null, so it points to a state.
    Ok(unsafe { state.read_unaligned() }.into())
}

/// Creates a tracker for the resources of a denoiser: it remembers the last use of each image and buffer, and gives the barriers
/// before the next one. Nothing has content yet, and there are no inputs. It needs no device and records nothing. Make a new one
/// after atrous_resize. With `legacy_barriers` 1 you get arguments of vkCmdPipelineBarrier, with 0 of vkCmdPipelineBarrier2.
///
/// # Safety
/// `tracker` is null or points to a pointer.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_create(
    denoiser: *const AtrousDenoiser,
    legacy_barriers: u32,
    tracker: *mut *mut AtrousTracker,
) -> AtrousStatus {
    guard(|| {
        if tracker.is_null() {
            return Err(Failure::argument("tracker is NULL; give a pointer to where the handle goes"));
        }
        // SAFETY: `tracker` is not null and writable for a pointer.
        unsafe { tracker.write_unaligned(std::ptr::null_mut()) };
        let is_legacy = flag("legacy_barriers", legacy_barriers)?;
        let made = handle::read(denoiser, |state| {
            Ok(TrackerState::new(denoiser, state.denoiser.declaration(), state.generation, is_legacy))
        })?;
        // SAFETY: `tracker` is not null and writable for a pointer.
        unsafe { tracker.write_unaligned(handle::insert(made)) };
        Ok(())
    })
}

/// Destroys a tracker. Your handle is invalid from then on, and stays so, and with it all that it gave.
///
/// # Safety
/// No other thread reads what it gave.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_destroy(tracker: *mut AtrousTracker) -> AtrousStatus {
    guard(|| handle::remove(tracker))
}

/// Names the image of a copy of a resource, with all aspects of its format: VK_IMAGE_ASPECT_COLOR_BIT, or depth and stencil. It is
/// named once, and not tracked before: an input is there after atrous_tracker_share or atrous_tracker_access. Without an image or a
/// buffer, barriers are left out, and the binding is absent.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_set_image(
    tracker: *mut AtrousTracker,
    resource: u32,
    copy: u32,
    image: Image,
    view: ImageView,
    aspects: ImageAspectFlags,
) -> AtrousStatus {
    guard(|| {
        if image.is_null() != view.is_null() {
            return Err(Failure::argument("one of image and view is VK_NULL_HANDLE; give both, or neither to remove them"));
        }
        let subresource = Subresource::default();
        let physical = (!image.is_null()).then_some(PhysicalResource::Image { image, view, aspects, subresource });
        handle::change(tracker, |state| state.set_physical(resource, copy, physical))
    })
}

/// Names array layer and mip level of the image that atrous_tracker_set_image named; they are 0 until then. The view is of them.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_set_subresource(
    tracker: *mut AtrousTracker,
    resource: u32,
    copy: u32,
    layer: u32,
    level: u32,
) -> AtrousStatus {
    guard(|| {
        handle::change(tracker, |state| {
            let (id, copy) = state.copy(resource, copy)?;
            match &mut state.physical[id.0 as usize][copy] {
                Some(PhysicalResource::Image { subresource, .. }) => *subresource = Subresource { layer, level },
                _ => {
                    let message = "has no image to take a layer of; call atrous_tracker_set_image first";
                    return Err(Failure::argument(format!("copy {copy} of resource {resource} {message}")));
                }
            }
            Ok(())
        })
    })
}

/// With `on` 1 every image is used in VK_IMAGE_LAYOUT_GENERAL from now on, for engines with one layout: images that are there already
/// have barriers of memory alone. With 0, the initial value, each is used in the declared layout.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_stay_in_general(tracker: *mut AtrousTracker, on: u32) -> AtrousStatus {
    guard(|| {
        let on = flag("on", on)?;
        handle::change(tracker, |state| {
            state.tracker.stay_in_general = on;
            Ok(())
        })
    })
}

/// Names the buffer of a copy of a resource, as atrous_tracker_set_image names an image. `size` may be VK_WHOLE_SIZE.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_set_buffer(
    tracker: *mut AtrousTracker,
    resource: u32,
    copy: u32,
    buffer: Buffer,
    offset: u64,
    size: u64,
) -> AtrousStatus {
    guard(|| {
        let physical = (!buffer.is_null()).then_some(PhysicalResource::Buffer { buffer, offset, size });
        handle::change(tracker, |state| state.set_physical(resource, copy, physical))
    })
}

/// Tells that two transients overlap in memory: the first pass of one then waits for the last pass of the other.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_alias(tracker: *mut AtrousTracker, resource: u32, other: u32) -> AtrousStatus {
    guard(|| {
        handle::change(tracker, |state| {
            let ids = [state.resource(resource)?, state.resource(other)?];
            state.tracker.alias(ids[0], ids[1]);
            Ok(())
        })
    })
}

/// Shares an input or an output with you: each phase finds it in the state `before`, and atrous_tracker_hand_back leaves it in the
/// state `after`. If `before` has reads alone, name every stage and access that the content is visible to.
///
/// # Safety
/// States are null or valid.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_share(
    tracker: *mut AtrousTracker,
    resource: u32,
    before: *const AtrousState,
    after: *const AtrousState,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: each is null or points to a state.
        let (before, after) = unsafe { (state_of("before", before)?, state_of("after", after)?) };
        handle::change(tracker, |state| {
            let id = state.resource(resource)?;
            state.tracker.share(id, before, after);
            Ok(())
        })
    })
}

/// Leaves an optional input out from now on.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_leave_out(tracker: *mut AtrousTracker, resource: u32) -> AtrousStatus {
    guard(|| {
        handle::change(tracker, |state| {
            let id = state.resource(resource)?;
            state.tracker.leave_out(id);
            Ok(())
        })
    })
}

/// Tells the state of a copy that you used without the tracker. It is there from now on, and no longer shared.
///
/// # Safety
/// `state` is null or valid.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_set_state(
    tracker: *mut AtrousTracker,
    resource: u32,
    copy: u32,
    state: *const AtrousState,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `state` is null or points to a state.
        let given = unsafe { state_of("state", state)? };
        handle::change(tracker, |state| {
            let (id, copy) = state.copy(resource, copy)?;
            state.tracker.set_state(id, copy, given);
            Ok(())
        })
    })
}

/// The state of a copy. That of an input which is left out is undefined, without an access.
///
/// # Safety
/// `state` is null or points to an AtrousState.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_state(
    tracker: *const AtrousTracker,
    resource: u32,
    copy: u32,
    state: *mut AtrousState,
) -> AtrousStatus {
    guard(|| {
        if state.is_null() {
            return Err(Failure::argument("state is NULL; give a pointer to an AtrousState"));
        }
        handle::read(tracker, |tracked| {
            let (id, copy) = tracked.copy(resource, copy)?;
            let now = tracked.tracker.state(id, copy).unwrap_or(ResourceState::UNDEFINED);
            let ResourceState { stage, access, layout, queue_family } = now;
            // SAFETY: not null, so it points to a state that may be written.
            unsafe { state.write_unaligned(AtrousState { stage, access, layout, queue_family }) };
            Ok(())
        })
    })
}

/// Records for queues of this family from now on, and acquires resources that another one owns. VK_QUEUE_FAMILY_IGNORED, the
/// initial value, if ownership never changes.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_set_queue_family(tracker: *mut AtrousTracker, queue_family: u32) -> AtrousStatus {
    guard(|| {
        handle::change(tracker, |state| {
            state.tracker.set_queue_family(queue_family);
            Ok(())
        })
    })
}

/// Forgets recorded work that will never run, for example because a submission failed. Call atrous_invalidate as well.
///
/// # Safety
/// None beyond those of a call through C.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_forget(tracker: *mut AtrousTracker) -> AtrousStatus {
    guard(|| {
        handle::change(tracker, |state| {
            state.tracker.forget();
            Ok(())
        })
    })
}

/// The barriers before a pass. Record them at once; the pass counts as recorded after them.
///
/// # Safety
/// Pointers are null or valid with their struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_barriers(
    tracker: *mut AtrousTracker,
    frame: *const AtrousFrame,
    pass: u32,
    barriers: *mut AtrousBarriers,
) -> AtrousStatus {
    guard(|| {
        handle::change(tracker, |state| {
            let pass = state.pass(pass)?;
            // SAFETY: `frame` is null or points to a struct that begins with its size.
            let frame = unsafe { state.frame(frame)? };
            // SAFETY: `barriers` is null or points to a struct that begins with its size, writable for that many bytes.
            unsafe { state.give(barriers, |tracker| tracker.barriers(pass, &frame)) }
        })
    })
}

/// The bindings of a pass for atrous_record, in the layouts that atrous_tracker_barriers reached. `count` says how many your array
/// holds, and becomes the number of the pass's uses; ATROUS_MAX_USES are enough for any.
///
/// # Safety
/// Pointers are null or valid; `bindings` points to `count` of them.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_bindings(
    tracker: *mut AtrousTracker,
    frame: *const AtrousFrame,
    pass: u32,
    bindings: *mut AtrousBinding,
    count: *mut u32,
) -> AtrousStatus {
    guard(|| {
        if bindings.is_null() || count.is_null() {
            return Err(Failure::argument("bindings or count is NULL; give an array and the number of its elements"));
        }
        handle::change(tracker, |state| {
            let pass = state.pass(pass)?;
            // SAFETY: `frame` is null or points to a struct that begins with its size.
            let frame = unsafe { state.frame(frame)? };
            let TrackerState { tracker, physical, bindings: found, .. } = state;
            tracker.bindings(pass, &frame, |id, copy| physical.get(id.0 as usize)?.get(copy).copied()?, found);
            // SAFETY: `count` is not null, so it points to a number; `bindings` is not null and has as many elements as it says.
            unsafe {
                let room = count.read_unaligned() as usize;
                if room < found.len() {
                    let message = format!("bindings has room for {room}, and pass {pass} has {} uses", found.len());
                    return Err(Failure::argument(format!("{message}; give an array of ATROUS_MAX_USES")));
                }
                for (i, binding) in found.iter().enumerate() {
                    bindings.add(i).write_unaligned(binding.into());
                }
                count.write_unaligned(found.len() as u32);
            }
            Ok(())
        })
    })
}

/// The barriers before a use of your own between two passes or after them, for example an upload, a copy or a draw. `discard` 1: it
/// needs no old content. The resource is there from now on.
///
/// # Safety
/// Pointers are null or valid, `barriers` with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_access(
    tracker: *mut AtrousTracker,
    resource: u32,
    copy: u32,
    next: *const AtrousState,
    discard: u32,
    barriers: *mut AtrousBarriers,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: `next` is null or points to a state.
        let next = unsafe { state_of("next", next)? };
        let discard = flag("discard", discard)?;
        handle::change(tracker, |state| {
            let (id, copy) = state.copy(resource, copy)?;
            // SAFETY: `barriers` is null or points to a struct that begins with its size, writable for that many bytes.
            unsafe { state.give(barriers, |tracker| tracker.access(id, copy, next, discard)) }
        })
    })
}

/// The barriers at the end of a phase, which bring shared resources to the state that you asked for. If your queue family differs,
/// they release the ownership, and atrous_tracker_given_back has the barriers for your queue.
///
/// # Safety
/// `barriers` is null or valid with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_hand_back(tracker: *mut AtrousTracker, barriers: *mut AtrousBarriers) -> AtrousStatus {
    guard(|| {
        // SAFETY: `barriers` is null or points to a struct that begins with its size, writable for that many bytes.
        handle::change(tracker, |state| unsafe { state.give(barriers, |tracker| tracker.hand_back()) })
    })
}

/// The acquiring halves of the last atrous_tracker_hand_back, for your queue; none if ownership does not change.
///
/// # Safety
/// `barriers` is null or valid with its struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_given_back(tracker: *mut AtrousTracker, barriers: *mut AtrousBarriers) -> AtrousStatus {
    guard(|| {
        // SAFETY: `barriers` is null or points to a struct that begins with its size, writable for that many bytes.
        handle::change(tracker, |state| unsafe { state.give(barriers, |tracker| tracker.given_back()) })
    })
}

/// The releasing halves before a phase on a queue of a different family, for the queue that owns the resources, ahead of the
/// semaphore. atrous_tracker_barriers gives the acquiring halves afterwards. None if ownership does not change.
///
/// # Safety
/// Pointers are null or valid with their struct_size set.
#[no_mangle]
pub unsafe extern "C" fn atrous_tracker_releases(
    tracker: *mut AtrousTracker,
    frame: *const AtrousFrame,
    phase: u32,
    queue_family: u32,
    barriers: *mut AtrousBarriers,
) -> AtrousStatus {
    guard(|| {
        let phase = crate::convert::phase(phase)?;
        handle::change(tracker, |state| {
            // SAFETY: `frame` is null or points to a struct that begins with its size.
            let frame = unsafe { state.frame(frame)? };
            let releases = state.tracker.releases(phase, &frame, queue_family);
            // SAFETY: `barriers` is null or points to a struct that begins with its size, writable for that many bytes.
            unsafe { state.give(barriers, |_| &releases) }
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use atrous::{Access, Config};

    /// The barriers of an access to the first image, which a copy has written before.
    fn accessed(is_legacy: bool) -> (TrackerState, AtrousBarriers) {
        let declaration = Config::new([8, 8]).declare().expect("valid");
        let id = declaration.find("depth").expect("an input");
        let mut state = TrackerState::new(std::ptr::null(), &declaration, 0, is_legacy);
        let physical = PhysicalResource::color(Image::from_raw(7), ImageView::from_raw(8));
        state.set_physical(id.0, 0, Some(physical)).expect("there is one copy");
        state.tracker.set_state(id, 0, ResourceState::of(Access::Clear));
        let mut barriers = AtrousBarriers::NONE;
        let next = ResourceState::of(Access::Sampled);
        // SAFETY: the pointer is that of a struct whose size is set.
        unsafe { state.give(&mut barriers, |tracker| tracker.access(id, 0, next, false)) }.expect("a good struct");
        (state, barriers)
    }

    #[test]
    fn barriers_name_the_layer_and_the_mip_level() {
        let (state, _) = accessed(false);
        let id = Config::new([8, 8]).declare().expect("valid").find("depth").expect("an input").0;
        let tracker = handle::insert(state);
        // SAFETY: the handle is live; the pointers are null, or those of structs whose size is set.
        unsafe {
            assert_eq!(atrous_tracker_set_subresource(tracker, id, 0, 3, 1), AtrousStatus::Ok);
            let mut barriers = AtrousBarriers::NONE;
            let (ResourceState { stage, access, layout, .. }, queue_family) = (ResourceState::of(Access::Clear), u32::MAX);
            let to = AtrousState { stage, access, layout, queue_family };
            assert_eq!(atrous_tracker_access(tracker, id, 0, &to, 0, &mut barriers), AtrousStatus::Ok);
            let range = (*barriers.dependency_info.p_image_memory_barriers).subresource_range;
            assert_eq!((range.base_array_layer, range.base_mip_level), (3, 1));
            let none = Image::null();
            assert_eq!(
                atrous_tracker_set_image(tracker, id, 0, none, ImageView::null(), ImageAspectFlags::COLOR),
                AtrousStatus::Ok
            );
            assert_eq!(atrous_tracker_set_subresource(tracker, id, 0, 3, 1), AtrousStatus::InvalidArgument);
            assert_eq!(atrous_tracker_destroy(tracker), AtrousStatus::Ok);
        }
    }

    #[test]
    fn barriers_are_given_in_the_form_that_was_asked_for() {
        use ash::vk::{AccessFlags, ImageLayout, PipelineStageFlags, PipelineStageFlags2};
        let (_lists, new) = accessed(false);
        assert_eq!((new.dependency_info.image_memory_barrier_count, new.image_count), (1, 0));
        // SAFETY: there is one, and it lives in the tracker.
        let barrier = unsafe { *new.dependency_info.p_image_memory_barriers };
        assert_eq!((barrier.image, barrier.new_layout), (Image::from_raw(7), ImageLayout::SHADER_READ_ONLY_OPTIMAL));
        assert_eq!(barrier.dst_stage_mask, PipelineStageFlags2::COMPUTE_SHADER);
        let (_lists, old) = accessed(true);
        assert_eq!(
            (old.dependency_info.image_memory_barrier_count, old.image_count, old.buffer_count, old.memory_count),
            (0, 1, 0, 0)
        );
        assert_eq!((old.src_stage, old.dst_stage), (PipelineStageFlags::TRANSFER, PipelineStageFlags::COMPUTE_SHADER));
        // SAFETY: there is one, and it lives in the tracker.
        let barrier = unsafe { *old.images };
        assert_eq!((barrier.image, barrier.old_layout), (Image::from_raw(7), ImageLayout::TRANSFER_DST_OPTIMAL));
        assert_eq!(barrier.src_access_mask, AccessFlags::TRANSFER_WRITE);
    }
}
