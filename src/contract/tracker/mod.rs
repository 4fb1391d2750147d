//! The barriers of a frame, derived from the declared uses and from the last use of each image and
//! buffer.
//!
//! If your frame graph tracks its resources, you need none of this. Otherwise it is the part that
//! you would have to write yourself. The built-in executor has no other.

mod arguments;
mod barrier;
mod state;

pub use arguments::{Barriers2, LegacyBarriers, PhysicalResource, Subresource};
#[cfg(feature = "executor")]
pub(crate) use barrier::WHOLE;
pub use barrier::{Barrier, BarrierTarget};
pub use state::ResourceState;

use super::{Access, Binding, Declaration, FrameContext, Lifetime, Phase, ResourceId, Shape, Use};
use ash::vk;

/// Remembers the last use of every physical image and buffer of a declaration, and gives the
/// barriers before each pass.
///
/// Inputs are absent until you announce them ([`Self::share`], [`Self::access`]); all else starts
/// with undefined content. Make a new tracker after a resize, or with new images. A barrier is
/// plain data; [`Barriers2`] and [`LegacyBarriers`] make arguments of Vulkan's calls of them.
///
/// ```
/// use atrous::{Barriers2, Config, FrameParams, FrameState, PhysicalResource, ResourceId, Tracker, Tuning};
///
/// let declaration = Config::new([64, 36]).declare()?;
/// let mut tracker = Tracker::new(&declaration);
/// let mut arguments = Barriers2::default();
/// let physical = |_: ResourceId, _copy: usize| None::<PhysicalResource>; // here go the images and buffers of the host
/// let frame = FrameState::default().begin(declaration.setup(), &FrameParams::new([64, 36]), &Tuning::default())?;
/// for pass in 0..declaration.passes().len() {
///     arguments.set(tracker.barriers(pass, &frame), physical);
///     let _info = arguments.dependency_info(); // of vkCmdPipelineBarrier2; then comes Denoiser::record
/// }
/// # Ok::<(), atrous::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tracker {
    /// Uses every image in `GENERAL`, for engines with one layout: an image that is there already has barriers of memory alone.
    /// Default: false.
    pub stay_in_general: bool,
    passes: Vec<TrackedPass>,
    resources: Vec<Tracked>,
    /// The family of the queue that is recorded for.
    queue_family: u32,
    /// Barriers of the last call; kept, so that a steady state allocates nothing.
    found: Vec<Barrier>,
    /// Barriers by which the host's queue acquires after the last [`Self::hand_back`].
    given_back: Vec<Barrier>,
}

#[derive(Clone, Debug)]
struct TrackedPass {
    phase: Phase,
    uses: Vec<Use>,
}

#[derive(Clone, Debug)]
struct Tracked {
    is_image: bool,
    /// Whether it has two copies; the parity of the frame selects the current one.
    is_pair: bool,
    /// Whether there is more in it than the picture, so that its old content is kept.
    is_shared_image: bool,
    /// The pass that a transient starts in.
    starts: Option<usize>,
    /// Transients in the same memory.
    aliases: Vec<ResourceId>,
    /// The states that the host asked for, of a shared resource: the one that each phase finds and
    /// the one that it leaves.
    shared: Option<[ResourceState; 2]>,
    copies: [Copy; 2],
}

#[derive(Clone, Copy, Debug)]
struct Copy {
    state: ResourceState,
    is_there: bool,
    /// Whether it was used since it was handed back.
    touched: bool,
    /// Whether the device may have written it, so that reads have something to wait for.
    was_written: bool,
}

impl Copy {
    fn new(state: ResourceState, is_there: bool) -> Self {
        let was_written = !(state.stage & !vk::PipelineStageFlags2::HOST).is_empty();
        Self { state, is_there, touched: false, was_written }
    }
}

impl Tracker {
    /// Starts with undefined content everywhere, and without inputs.
    pub fn new(declaration: &Declaration) -> Self {
        let passes = declaration.passes().iter().map(|p| TrackedPass { phase: p.phase, uses: p.uses.clone() }).collect();
        let copy = |is_there| Copy::new(ResourceState::UNDEFINED, is_there);
        let mut resources: Vec<_> = (declaration.resources().iter())
            .map(|resource| Tracked {
                is_image: matches!(resource.shape, Shape::Image { .. }),
                is_pair: resource.lifetime == Lifetime::History,
                is_shared_image: resource.is_part_of_image(declaration.setup()),
                starts: None,
                aliases: Vec::new(),
                shared: None,
                copies: [copy(resource.lifetime.copies() > 0), copy(resource.lifetime.copies() > 1)],
            })
            .collect();
        for (id, first, _) in declaration.transients() {
            resources[id.0 as usize].starts = Some(first);
        }
        let (found, given_back) = (Vec::new(), Vec::new());
        Self { stay_in_general: false, passes, resources, queue_family: vk::QUEUE_FAMILY_IGNORED, found, given_back }
    }

    /// Tells that two transients overlap in memory, so that one starts only after the other is
    /// done.
    pub fn alias(&mut self, a: ResourceId, b: ResourceId) {
        for (id, other) in [(a, b), (b, a)] {
            if let Some(resource) = self.resources.get_mut(id.0 as usize).filter(|r| id != other && !r.aliases.contains(&other)) {
                resource.aliases.push(other);
            }
        }
    }

    /// Shares an input or an output with you: each phase finds it in the state `before`, and
    /// [`Self::hand_back`] leaves it in the state `after`. Between the phases it is yours. If
    /// `before` has reads alone, name every stage and access that the content is visible to; a
    /// barrier orders all others behind them.
    pub fn share(&mut self, id: ResourceId, before: ResourceState, after: ResourceState) {
        self.set_state(id, 0, before);
        if let Some(resource) = self.resources.get_mut(id.0 as usize) {
            resource.shared = Some([before, after]);
        }
    }

    /// Leaves an optional input out from now on.
    pub fn leave_out(&mut self, id: ResourceId) {
        if let Some(resource) = self.resources.get_mut(id.0 as usize) {
            (resource.shared, resource.copies[0].is_there) = (None, false);
        }
    }

    /// Tells the state of a copy that you used without the tracker. It is there from now on, and no
    /// longer shared.
    pub fn set_state(&mut self, id: ResourceId, copy: usize, state: ResourceState) {
        if let Some(resource) = self.resources.get_mut(id.0 as usize) {
            resource.shared = None;
            if let Some(copy) = resource.copies.get_mut(copy) {
                *copy = Copy::new(state, true);
            }
        }
    }

    /// Forgets recorded work that will never run, for example because a submission failed. Content
    /// and layout of all unshared resources are then unknown; shared ones are with you.
    pub fn forget(&mut self) {
        for resource in &mut self.resources {
            let state = resource.shared.map_or(ResourceState::UNKNOWN, |[before, _]| before);
            for copy in resource.copies.iter_mut().filter(|copy| copy.is_there) {
                (copy.state, copy.touched) = (state.owned_by(copy.state.queue_family), false);
            }
        }
    }

    /// The state of a copy; `None` for an input that is left out.
    pub fn state(&self, id: ResourceId, copy: usize) -> Option<ResourceState> {
        let copy = self.resources.get(id.0 as usize)?.copies.get(copy)?;
        copy.is_there.then_some(copy.state)
    }

    /// Records for queues of this family from now on, and acquires resources that a different
    /// family owns. `QUEUE_FAMILY_IGNORED`, the initial value, if ownership never changes.
    pub fn set_queue_family(&mut self, queue_family: u32) {
        self.queue_family = queue_family;
    }

    /// The barriers before a pass, for one call. The pass counts as recorded after them.
    pub fn barriers(&mut self, pass: usize, frame: &FrameContext) -> &[Barrier] {
        let Self { passes, resources, found, queue_family, stay_in_general, .. } = self;
        found.clear();
        for u in passes.get(pass).map_or(&[][..], |p| &p.uses) {
            let index = u.resource.0 as usize;
            let copy = copy_of(&resources[index], u, frame);
            if !resources[index].copies[copy].is_there {
                continue;
            }
            if resources[index].starts == Some(pass) {
                take_over(resources, u.resource, ResourceState::of(u.access), found);
            }
            let next = next_state(&resources[index].copies[copy].state, u.access, *stay_in_general).owned_by(*queue_family);
            let discard = !u.access.reads() && !resources[index].is_shared_image;
            transition(&mut resources[index], u.resource, copy, next, discard, found);
        }
        if *stay_in_general {
            found.iter_mut().for_each(Barrier::keep_general);
        }
        found
    }

    /// The bindings of a pass for [`Denoiser::record`](crate::Denoiser::record), in the layouts
    /// that [`Self::barriers`] reached. `physical` gives the image or buffer of a copy of a
    /// resource. The list is yours, so that you can use it again.
    pub fn bindings(
        &self,
        pass: usize,
        frame: &FrameContext,
        physical: impl Fn(ResourceId, usize) -> Option<PhysicalResource>,
        bindings: &mut Vec<Binding>,
    ) {
        bindings.clear();
        for u in self.passes.get(pass).map_or(&[][..], |p| &p.uses) {
            let copy = copy_of(&self.resources[u.resource.0 as usize], u, frame);
            let physical = self.state(u.resource, copy).zip(physical(u.resource, copy));
            bindings.push(physical.map_or(Binding::Absent, |(state, physical)| physical.binding(state.layout)));
        }
    }

    /// The barriers before a use of your own between two passes or after them, for example an
    /// upload, a copy or a draw. Set `discard` if it needs no old content. The resource is there
    /// from now on.
    pub fn access(&mut self, id: ResourceId, copy: usize, next: ResourceState, discard: bool) -> &[Barrier] {
        let Self { resources, found, queue_family, .. } = self;
        found.clear();
        if resources.get(id.0 as usize).is_some_and(|resource| copy < resource.copies.len()) {
            if discard {
                take_over(resources, id, next, found);
            }
            let resource = &mut resources[id.0 as usize];
            resource.copies[copy].is_there = true;
            transition(resource, id, copy, next.owned_by(*queue_family), discard, found);
        }
        found
    }

    /// The barriers at the end of a phase. They bring shared resources to the state that you asked
    /// for. If your queue family differs, they release the ownership, and [`Self::given_back`] has
    /// the barriers for your queue.
    pub fn hand_back(&mut self) -> &[Barrier] {
        let Self { resources, found, given_back, stay_in_general, .. } = self;
        found.clear();
        given_back.clear();
        for (index, resource) in resources.iter_mut().enumerate() {
            let Some([before, after]) = resource.shared else { continue };
            let copy = &mut resource.copies[0];
            if !std::mem::take(&mut copy.touched) {
                continue;
            }
            // Even where only reads met: the host's next write must wait for ours.
            let target = target(resource.is_image, ResourceId(index as u32), 0);
            let barrier = Barrier { target, from: copy.state, to: after, discard: false };
            if barrier.queue_families().is_some() {
                given_back.push(barrier.acquire());
            }
            found.push(barrier.release());
            copy.state = before;
        }
        if *stay_in_general {
            found.iter_mut().for_each(Barrier::keep_general);
        }
        found
    }

    /// The acquiring halves of the last [`Self::hand_back`], for your queue; empty if ownership
    /// does not change.
    pub fn given_back(&self) -> &[Barrier] {
        &self.given_back
    }

    /// The releasing halves before a phase on a queue of a different family: the owner of each
    /// resource records them on its own queue, ahead of the semaphore. [`Self::barriers`] gives the
    /// acquiring halves afterwards. Empty if ownership does not change.
    pub fn releases(&self, phase: Phase, frame: &FrameContext, queue_family: u32) -> Vec<Barrier> {
        let mut ahead = self.clone();
        ahead.queue_family = queue_family;
        let mut releases = Vec::new();
        for pass in (0..self.passes.len()).filter(|&pass| self.passes[pass].phase == phase) {
            let transfers: Vec<_> = ahead.barriers(pass, frame).iter().filter(|b| b.queue_families().is_some()).copied().collect();
            for barrier in transfers {
                let (BarrierTarget::Image { resource, copy } | BarrierTarget::Buffer { resource, copy }) = barrier.target else {
                    continue;
                };
                // Each is acquired once, so that its state in front of the phase is the one that is released.
                let from = self.state(resource, copy).unwrap_or(barrier.from);
                releases.push(Barrier { from, ..barrier }.release());
            }
        }
        releases
    }
}

fn copy_of(resource: &Tracked, u: &Use, frame: &FrameContext) -> usize {
    if resource.is_pair {
        frame.history_copy(u.frame)
    } else {
        0
    }
}

fn target(is_image: bool, resource: ResourceId, copy: usize) -> BarrierTarget {
    if is_image {
        BarrierTarget::Image { resource, copy }
    } else {
        BarrierTarget::Buffer { resource, copy }
    }
}

/// The state behind a use. An image that may be sampled where it is stays there.
fn next_state(now: &ResourceState, access: Access, stay_in_general: bool) -> ResourceState {
    let next = ResourceState::of(access);
    let layout = match access == Access::Sampled && now.is_sampled_in_place() {
        true => now.layout,
        false if stay_in_general => vk::ImageLayout::GENERAL,
        false => next.layout,
    };
    ResourceState { layout, ..next }
}

/// Orders the start of a transient after all uses of its memory through others: a barrier of the
/// image alone does not cover them, and a global one does not come before the image's own layout
/// transition.
fn take_over(resources: &mut [Tracked], id: ResourceId, next: ResourceState, found: &mut Vec<Barrier>) {
    if resources[id.0 as usize].aliases.is_empty() {
        return;
    }
    let mut source = ResourceState::UNDEFINED;
    for other in &resources[id.0 as usize].aliases {
        if let Some(other) = resources.get(other.0 as usize) {
            source.merge(&other.copies[0].state);
        }
    }
    found.push(Barrier { target: BarrierTarget::Memory, from: source, to: next, discard: false });
    let state = &mut resources[id.0 as usize].copies[0].state;
    state.merge(&source);
    state.layout = vk::ImageLayout::UNDEFINED;
}

fn transition(resource: &mut Tracked, id: ResourceId, copy: usize, next: ResourceState, discard: bool, found: &mut Vec<Barrier>) {
    let is_image = resource.is_image;
    let Copy { state, touched, was_written, .. } = &mut resource.copies[copy];
    *touched = true;
    let barrier = Barrier { target: target(is_image, id, copy), from: *state, to: next, discard };
    let relayout = is_image && state.layout != next.layout;
    if state.writes() || next.writes() || relayout || barrier.queue_families().is_some() {
        found.push(barrier.acquire());
        (*state, *was_written) = (next, true);
        return;
    }
    // What was written before is visible to the reads that met so far, and to no others.
    let is_visible = !*was_written || state.is_visible_to(&next);
    state.merge(&next);
    if !is_visible {
        found.push(Barrier { to: *state, ..barrier }.acquire());
    }
}

#[cfg(test)]
mod hazard_tests;
#[cfg(test)]
mod tests;
