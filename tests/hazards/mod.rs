//! The commands that the executor records, against the uses that were declared: every access is ordered after each earlier one to the
//! same bytes of memory that it conflicts with. Validation finds no missing barrier between two writes, nor in a read-modify-write,
//! nor between images that share memory.

mod recorder;

use super::graphs::random;
use super::support::soak;
use ash::vk;
use ash::vk::Handle;
use atrous::config::{PostProcess, Preset, Signals};
use atrous::executor::{Executor, ExecutorOptions, HostImage};
use atrous::{
    Access, Config, Declaration, FrameContext, FrameParams, Lifetime, PassDecl, Phase, ResourceDecl, ResourceId, ResourceState,
    Setup, Shape, Subresource, Tuning, Use, UseFrame,
};
use atrous_harness::DeviceTest;
use recorder::{Barrier, Event, Place, Recorder, Side};

pub const TESTS: &[DeviceTest] = &[
    ("every_preset_is_free_of_hazards", every_preset_is_free_of_hazards),
    ("every_random_graph_is_free_of_hazards", every_random_graph_is_free_of_hazards),
    ("barriers_that_are_left_out_are_found", barriers_that_are_left_out_are_found),
];

const EXTENT: [u32; 2] = [33, 21];

/// An access in the past.
struct Past {
    what: String,
    handle: u64,
    place: Option<Place>,
    scope: Side,
    writes: bool,
    /// What barriers have ordered after it so far, and whether they reach other images in the same memory.
    ordered: Vec<(Side, bool)>,
    /// Other images in the same memory that were written after it: what comes after that write comes after this.
    written_over: Vec<u64>,
}

/// An access that comes next.
struct Next {
    what: String,
    handle: u64,
    scope: Side,
    writes: bool,
}

impl Past {
    fn order(&mut self, barrier: &Barrier) {
        if barrier.handle.is_some_and(|handle| handle != self.handle) {
            return;
        }
        let (own_stage, own_mask) = self.scope;
        let (stage, mask) = barrier.from;
        let directly = stage.contains(own_stage) && (!self.writes || mask.contains(own_mask));
        // An execution dependency chains; the write was made available by the first link.
        if directly || self.ordered.iter().any(|(to, _)| stage.contains(to.0)) {
            self.ordered.push((barrier.to, barrier.handle.is_none()));
        }
    }

    /// Whether a use through this handle comes after it.
    fn is_before(&self, next: Side, handle: u64, barriers: &[Barrier]) -> bool {
        let is_alias = handle != self.handle;
        let reaches = |(to, global): &(Side, bool)| (*global || !is_alias) && to.0.contains(next.0) && to.1.contains(next.1);
        // The transition of an image writes its memory: it too must come after what was done through others.
        let waits = |b: &Barrier| b.handle == Some(handle) && b.from.0.contains(self.scope.0);
        self.ordered.iter().any(reaches) && (!is_alias || barriers.iter().any(waits))
    }

    fn is_met(&self, handle: u64, place: Option<Place>) -> bool {
        let overlaps = || self.place.zip(place).is_some_and(|(a, b)| a.overlaps(&b));
        self.handle == handle || !self.written_over.contains(&handle) && overlaps()
    }
}

/// An executor on the recorder, and the handle of every resource and copy.
struct Checked {
    // Declared first, so that it is dropped first.
    executor: Executor,
    handles: Vec<[u64; 2]>,
    past: Vec<Past>,
    recorder: Recorder,
}

impl Checked {
    fn new(declaration: Declaration, options: ExecutorOptions) -> Self {
        let recorder = Recorder::new();
        let options = ExecutorOptions { extra_image_usage: vk::ImageUsageFlags::TRANSFER_SRC, ..options };
        // SAFETY: the device is live, has synchronization2, and outlives the executor; nothing is ever submitted.
        let executor = unsafe { Executor::new(recorder.host(), declaration, options) }.expect("an executor");
        let mut this = Self { executor, handles: Vec::new(), past: Vec::new(), recorder };
        this.find_handles();
        this
    }

    /// Binds handles of nothing as inputs, and asks for copies of all else, which name its handle.
    fn find_handles(&mut self) {
        let declaration = self.executor.denoiser().declaration().clone();
        let mut next = 1 << 60;
        for resource in declaration.resources() {
            next += 1;
            self.handles.push([next, next]);
            if let (Lifetime::Input { .. }, Shape::Image { .. }) = (resource.lifetime, resource.shape) {
                self.executor.bind_image(&resource.name, host_image(resource, next)).expect("an input");
            }
        }
        let params = FrameParams::new(declaration.allocated_extent());
        let frame = self.executor.begin_frame(&params, &Tuning::default()).expect("a frame");
        for (index, resource) in declaration.resources().iter().enumerate() {
            for which in [UseFrame::Current, UseFrame::Previous] {
                let copy = if resource.lifetime == Lifetime::History { frame.history_copy(which) } else { 0 };
                if matches!(resource.lifetime, Lifetime::Input { .. }) || declaration.life(ResourceId(index as u32)).is_none() {
                    continue;
                }
                let (cmd, target) = (vk::CommandBuffer::null(), vk::Buffer::null());
                // SAFETY: the recorder records nothing, so that null handles are never used.
                unsafe { self.executor.record_copy(cmd, &frame, &resource.name, which, target) }.expect("a copy");
                let copied = self.recorder.take().into_iter().find_map(|event| match event {
                    Event::Copy(handle) => Some(handle),
                    _ => None,
                });
                self.handles[index][copy] = copied.expect("a handle");
            }
        }
    }

    /// Records a frame and gives its hazards.
    fn frame(&mut self, index: u32) -> Vec<String> {
        let declaration = self.executor.denoiser().declaration().clone();
        let slot = index % declaration.setup().frames_in_flight;
        let params = FrameParams { frame_slot: slot, ..FrameParams::new(declaration.allocated_extent()) };
        let frame = self.executor.begin_frame(&params, &Tuning::default()).expect("a frame");
        for phase in Phase::ALL {
            // SAFETY: the recorder records nothing, so that the null handle is never used.
            unsafe { self.executor.record(vk::CommandBuffer::null(), &frame, phase) }.expect("recorded");
        }
        let counters = self.handles[declaration.find("statistics").expect("in every graph").0 as usize][0];
        let mut events = self.recorder.take().into_iter();
        let mut hazards = Vec::new();
        // The views are left out, since the frame has none.
        for pass in declaration.passes().iter().filter(|pass| !pass.name.starts_with("debug_view")) {
            let cleared = pass.uses.iter().filter(|u| u.access == Access::Clear).count();
            let (mut work, mut barriers) = (0, Vec::new());
            while work < cleared.max(1) {
                match events.next().expect("work of the pass") {
                    Event::Barriers(more) => {
                        self.past.iter_mut().for_each(|past| more.iter().for_each(|barrier| past.order(barrier)));
                        barriers.extend(more);
                    }
                    Event::Work => work += 1,
                    Event::Copy(handle) => {
                        assert_eq!((handle, &*pass.name), (counters, "start_frame"), "nobody asked for another copy");
                        let ResourceState { stage, access, .. } = ResourceState::COPY_SOURCE;
                        let next = Next { what: "the copy of the counters".into(), handle, scope: (stage, access), writes: false };
                        hazards.extend(self.missing(&next, &barriers));
                        self.done(next);
                    }
                }
            }
            hazards.extend(self.pass(&declaration, &frame, &pass.name, &pass.uses, &barriers));
        }
        events.filter_map(|e| if let Event::Barriers(more) = e { Some(more) } else { None }).flatten().for_each(|barrier| {
            self.past.iter_mut().for_each(|past| past.order(&barrier));
        });
        hazards
    }

    fn pass(
        &mut self,
        declaration: &Declaration,
        frame: &FrameContext,
        name: &str,
        uses: &[Use],
        barriers: &[Barrier],
    ) -> Vec<String> {
        let handle = |u: &Use| self.handles[u.resource.0 as usize][declaration.copy(u, frame)];
        let next = |u: &Use| Next {
            what: format!("{name} ({:?} of {})", u.access, declaration.resource(u.resource).name),
            handle: handle(u),
            scope: (u.access.scope().stage, u.access.scope().access),
            writes: u.access.writes(),
        };
        let uses: Vec<_> = uses.iter().map(next).collect();
        let hazards = uses.iter().flat_map(|next| self.missing(next, barriers)).collect();
        uses.into_iter().for_each(|next| self.done(next));
        hazards
    }

    /// What an access conflicts with, and is not ordered after.
    fn missing(&self, next: &Next, barriers: &[Barrier]) -> Vec<String> {
        let place = self.recorder.place(next.handle);
        let conflicts = self.past.iter().filter(|p| (p.writes || next.writes) && p.is_met(next.handle, place));
        let missing = conflicts.filter(|p| !p.is_before(next.scope, next.handle, barriers));
        missing.map(|p| format!("{} after {}", next.what, p.what)).collect()
    }

    /// Makes an access one of the past.
    fn done(&mut self, Next { what, handle, scope, writes }: Next) {
        let place = self.recorder.place(handle);
        if writes {
            // All that came before through this handle is ordered before the write, and so before whatever is ordered after it.
            self.past.retain(|p| p.handle != handle);
            self.past.iter_mut().filter(|p| p.is_met(handle, place)).for_each(|p| p.written_over.push(handle));
        }
        self.past.push(Past { what, handle, place, scope, writes, ordered: Vec::new(), written_over: Vec::new() });
    }
}

fn host_image(resource: &ResourceDecl, handle: u64) -> HostImage {
    let Shape::Image { format, .. } = resource.shape else { panic!("{} is an image", resource.name) };
    HostImage {
        image: vk::Image::from_raw(handle),
        view: vk::ImageView::null(),
        subresource: Subresource::default(),
        format: format.preferred(),
        extent: resource.extent(&Setup::new(EXTENT)).expect("an image"),
        layout: vk::ImageLayout::GENERAL,
        stage: vk::PipelineStageFlags2::ALL_COMMANDS,
        access: vk::AccessFlags2::MEMORY_READ | vk::AccessFlags2::MEMORY_WRITE,
    }
}

/// Hazards of as many frames as it takes for each slot and each copy of a history to come round twice.
fn hazards(declaration: &Declaration, options: ExecutorOptions) -> Vec<String> {
    let mut checked = Checked::new(declaration.clone(), options);
    let frames = 2 * declaration.setup().frames_in_flight + 2;
    (0..frames).flat_map(|index| checked.frame(index)).collect()
}

fn assert_free_of_hazards(declaration: &Declaration, what: &str) {
    for stay_in_general in [false, true] {
        let options = ExecutorOptions { stay_in_general, ..Default::default() };
        assert_eq!(hazards(declaration, options), [] as [String; 0], "{what}, stay_in_general: {stay_in_general}");
    }
}

fn every_preset_is_free_of_hazards() {
    for preset in Preset::ALL {
        for (frames_in_flight, signals) in [(1, Signals::Together), (2, Signals::Apart), (3, Signals::Together)] {
            let post_process = PostProcess::ToneMapTaa;
            let config = Config { preset, signals, frames_in_flight, post_process, debug_view: true, ..Config::new(EXTENT) };
            assert_free_of_hazards(&config.declare().expect("valid"), &format!("{config:?}"));
        }
    }
}

fn every_random_graph_is_free_of_hazards() {
    let mut in_flight = [0; 4];
    for seed in 0..soak::times(40) {
        let declaration = random::declare(seed, EXTENT);
        in_flight[declaration.setup().frames_in_flight as usize] += 1;
        assert_free_of_hazards(&declaration, &format!("seed {seed}"));
    }
    assert!(in_flight[1..].iter().all(|&count| count > 0), "graphs by frames in flight: {in_flight:?}");
}

fn barriers_that_are_left_out_are_found() {
    let config = Config { post_process: PostProcess::ToneMapTaa, ..Config::new(EXTENT) };
    for declaration in [config.declare().expect("valid"), random::declare(1, EXTENT), random::declare(6, EXTENT)] {
        let recorded = declaration.passes().iter().enumerate().filter(|(_, pass)| !pass.name.starts_with("debug_view"));
        let is_missed = |(index, _): &(usize, &PassDecl)| {
            hazards(&declaration, ExecutorOptions { omit_barriers_before: Some(*index), ..Default::default() }).is_empty()
        };
        let missed: Vec<_> = recorded.filter(is_missed).map(|(_, pass)| pass.name.as_str()).collect();
        // In a random graph an earlier barrier of all memory may happen to order a pass.
        let allowed = if declaration.config().is_some() { 0 } else { declaration.passes().len() / 10 };
        assert!(missed.len() <= allowed, "barriers that nobody missed: {missed:?} of {}", declaration.passes().len());
    }
}
