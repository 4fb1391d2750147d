//! An independent look at the barriers: every access that conflicts with an earlier one to the same memory must be ordered after
//! it. Validation does not find a missing barrier between two writes, nor in read-modify-write, nor between images that share
//! memory.

use super::*;
use crate::config::{Config, PostProcess, Preset, Signals};
use crate::contract::{alias, FrameParams, FrameState, Span, Tuning};
use crate::graph::{Feedback, Graph, Value};
use crate::nodes::{Accumulation, Albedo, Atrous, Demodulate, Import, Kernel, Modulate, Variance};

/// One access in the past.
#[derive(Clone)]
struct Event {
    what: String,
    access: Access,
    /// Accesses that barriers have ordered after it so far.
    before: Vec<Ordered>,
}

#[derive(Clone, Copy)]
struct Ordered {
    to: Side,
    /// Whether a global barrier did, which reaches images that share the memory.
    global: bool,
}

/// Stage and access mask of one side of a barrier.
type Side = (vk::PipelineStageFlags2, vk::AccessFlags2);

impl Event {
    fn order(&mut self, from: Side, to: Side, global: bool) {
        let own = self.access.scope();
        let directly = from.0.contains(own.stage) && (!self.access.writes() || from.1.contains(own.access));
        // An execution dependency chains; the write was made available by the first link.
        if directly || self.before.iter().any(|o| from.0.contains(o.to.0)) {
            self.before.push(Ordered { to, global });
        }
    }

    fn is_before(&self, next: Access, through_memory: bool) -> bool {
        let next = next.scope();
        self.before.iter().any(|o| (o.global || !through_memory) && o.to.0.contains(next.stage) && o.to.1.contains(next.access))
    }
}

/// Accesses to each physical image or buffer that are not yet ordered before what comes.
struct Checked {
    declaration: Declaration,
    tracker: Tracker,
    shared: Vec<Vec<usize>>,
    /// Barriers of the pass.
    barriers: Vec<Barrier>,
    /// Events by resource, then copy.
    events: Vec<[Vec<Event>; 2]>,
}

impl Checked {
    fn new(declaration: Declaration) -> Self {
        let mut tracker = Tracker::new(&declaration);
        for id in (0..declaration.resources().len() as u32).map(ResourceId) {
            if let Lifetime::Input { .. } = declaration.resource(id).lifetime {
                tracker.set_state(id, 0, ResourceState::UNDEFINED);
            }
        }
        let shared = share(&declaration, &mut tracker);
        let events = vec![[Vec::new(), Vec::new()]; declaration.resources().len()];
        Self { declaration, tracker, shared, barriers: Vec::new(), events }
    }

    /// Runs one pass; `broken` drops its barriers.
    fn pass(&mut self, frame: &FrameContext, pass: usize, broken: bool) -> Vec<String> {
        self.barriers = self.tracker.barriers(pass, frame).to_vec();
        if broken {
            self.barriers.clear();
        }
        self.apply();
        let decl = self.declaration.passes()[pass].clone();
        let mut hazards = Vec::new();
        for u in &decl.uses {
            hazards.extend(self.conflicts(&decl.name, u, self.declaration.copy(u, frame)));
        }
        for u in &decl.uses {
            let copy = self.declaration.copy(u, frame);
            self.remember(&decl.name, u, copy);
        }
        hazards
    }

    /// Lets every barrier of the pass order what came before it.
    fn apply(&mut self) {
        for (index, copies) in self.events.iter_mut().enumerate() {
            for (copy, events) in copies.iter_mut().enumerate() {
                for barrier in self.barriers.iter().filter(|b| reaches(b, index, copy)) {
                    let side = |state: ResourceState| (state.stage, state.access);
                    let global = barrier.target == BarrierTarget::Memory;
                    events.iter_mut().for_each(|e| e.order(side(barrier.from), side(barrier.to), global));
                }
            }
        }
    }

    fn conflicts(&self, pass: &str, u: &Use, copy: usize) -> Vec<String> {
        let index = u.resource.0 as usize;
        let name = &self.declaration.resource(u.resource).name;
        let own = self.events[index][copy].iter().filter(|e| e.access.writes() || u.access.writes());
        let missing = own.filter(|e| !e.is_before(u.access, false)).map(|e| format!("{pass}: {name} after {}", e.what));
        let alias = self.shared[index].iter().flat_map(|&other| self.events[other][0].iter().map(move |e| (other, e)));
        // The layout transition writes memory: it too must come after what was done through the other image.
        let transition = |e: &Event| {
            let own = BarrierTarget::Image { resource: u.resource, copy };
            self.barriers.iter().any(|b| b.target == own && b.from.stage.contains(e.access.scope().stage))
        };
        let through = alias
            .filter(|(_, e)| !e.is_before(u.access, true) || !transition(e))
            .map(|(other, e)| format!("{pass}: {name} after {} of {}", e.what, self.declaration.resources()[other].name));
        missing.chain(through).collect()
    }

    /// A write is ordered after all that came before, so that nothing before it can conflict any more; aliases of a resource that
    /// starts are dead.
    fn remember(&mut self, pass: &str, u: &Use, copy: usize) {
        let index = u.resource.0 as usize;
        if u.access.writes() {
            self.events[index][copy].clear();
            for other in self.shared[index].clone() {
                self.events[other][0].clear();
            }
        }
        self.events[index][copy].push(Event { what: pass.to_owned(), access: u.access, before: Vec::new() });
    }
}

fn reaches(barrier: &Barrier, index: usize, of: usize) -> bool {
    match barrier.target {
        BarrierTarget::Memory => true,
        BarrierTarget::Image { resource, copy } | BarrierTarget::Buffer { resource, copy } => {
            (resource.0 as usize, copy) == (index, of)
        }
    }
}

/// Places the transient images as the executor does, and gives who shares memory with whom.
fn share(declaration: &Declaration, tracker: &mut Tracker) -> Vec<Vec<usize>> {
    let is_image = |id: ResourceId| matches!(declaration.resource(id).shape, Shape::Image { .. });
    let transients: Vec<_> = declaration.transients().filter(|t| is_image(t.0)).collect();
    let ids: Vec<_> = transients.iter().map(|t| t.0).collect();
    let size = |id: ResourceId| declaration.resource(id).bytes(declaration.setup());
    let spans: Vec<_> = transients.iter().map(|&(id, first, last)| Span { first, last, size: size(id), alignment: 64 }).collect();
    let (offsets, _) = alias(&spans);
    let mut shared = vec![Vec::new(); declaration.resources().len()];
    for i in 0..ids.len() {
        for j in (0..ids.len()).filter(|&j| j != i) {
            if offsets[i] < offsets[j] + spans[j].size && offsets[j] < offsets[i] + spans[i].size {
                shared[ids[i].0 as usize].push(ids[j].0 as usize);
                tracker.alias(ids[i], ids[j]);
            }
        }
    }
    shared
}

fn frames(declaration: &Declaration, broken: Option<usize>) -> Vec<String> {
    let mut checked = Checked::new(declaration.clone());
    let mut state = FrameState::default();
    let mut hazards = Vec::new();
    for _ in 0..4 {
        let params = FrameParams::new(declaration.allocated_extent());
        let frame = state.begin(declaration.setup(), &params, &Tuning::default()).expect("valid");
        for pass in 0..declaration.passes().len() {
            hazards.extend(checked.pass(&frame, pass, broken == Some(pass)));
        }
    }
    hazards
}

fn configs() -> Vec<Config> {
    let base = Config::new([64, 36]);
    let taa = Config { post_process: PostProcess::ToneMapTaa, ..base };
    let apart = Config { signals: Signals::Apart, object_normal: true, ..taa };
    let presets = Preset::ALL.into_iter().map(|preset| Config { preset, debug_view: true, ..taa });
    let with_volume = Config { preset: Preset::Asvgf, volume: true, firefly_filter: true, ..apart };
    let mut configs = vec![
        base,
        taa,
        apart,
        Config { levels: Some(1), ..base },
        Config { levels: Some(2), ..apart },
        Config { levels: Some(10), ..taa },
    ];
    configs.extend(presets);
    configs.push(with_volume);
    configs
}

fn svgf_with_taa() -> Declaration {
    Config { post_process: PostProcess::ToneMapTaa, ..Config::new([64, 36]) }.declare().expect("valid")
}

/// A graph that no preset has: two filters of one estimate, a second accumulation in place, and a third in a scope.
fn graph_of_a_host(share_outputs: bool) -> Declaration {
    let mut g = Graph::new([64, 36]).share_outputs(share_outputs);
    let guides = g.import(Import { object_normal: true, ..Import::default() });
    let light = g.radiance("noisy_radiance");
    for (feedback, name) in [(Feedback::Filtered, "light"), (Feedback::Accumulated, "again")] {
        g.scope(name, |g| {
            let irradiance = g.demodulate(&guides, &light, Demodulate::default());
            let history = g.history(&irradiance, feedback);
            let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
            let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
            let fed_back = (feedback == Feedback::Filtered).then_some(history);
            let spline = g.atrous(&guides, &estimate, Atrous { feedback: fed_back, ..Atrous::default() });
            let boxes = Atrous { levels: 3, kernel: Kernel::Box, ..Atrous::default() };
            let boxes = g.scope("box", |g| g.atrous(&guides, &estimate, boxes));
            let both = g.pair(&spline, &boxes);
            let radiance = g.modulate(&guides, &both.into(), Modulate::default());
            g.output(&format!("denoised_{name}"), &radiance);
        });
    }
    let noisy = g.radiance("noisy_ao");
    let irradiance = g.demodulate(&guides, &noisy, Demodulate { albedo: Albedo::None, ..Demodulate::default() });
    let history = g.history(&irradiance, Feedback::Accumulated);
    let accumulation = Accumulation { alpha: Value::Fixed(0.05), ..Accumulation::default() };
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, accumulation);
    let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
    let occlusion = g.modulate(&guides, &estimate.into(), Modulate { albedo: false, emission: false, ..Modulate::default() });
    g.output("denoised_ao", &occlusion);
    g.finish().expect("valid")
}

#[test]
fn every_conflict_is_ordered() {
    for config in configs() {
        assert_eq!(frames(&config.declare().expect("valid"), None), [] as [String; 0], "{config:?}");
    }
    for share_outputs in [false, true] {
        assert_eq!(frames(&graph_of_a_host(share_outputs), None), [] as [String; 0]);
    }
}

#[test]
fn a_pass_without_its_barriers_is_found() {
    // Where transients lie in outputs, an earlier barrier of all memory orders one of them.
    for declaration in [svgf_with_taa(), graph_of_a_host(false)] {
        for (pass, decl) in declaration.passes().iter().enumerate() {
            assert!(!frames(&declaration, Some(pass)).is_empty(), "{}", decl.name);
        }
    }
}

#[test]
fn memory_is_shared_at_all() {
    for declaration in [svgf_with_taa(), graph_of_a_host(true)] {
        assert!(Checked::new(declaration).shared.iter().any(|s| !s.is_empty()));
    }
}
