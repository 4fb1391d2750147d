//! Random graphs that make sense, on both engines: every pass against its twin, whole frames against each other, memory as it was
//! planned.
//!
//! `ATROUS_GRAPH_SEEDS=40..90` takes other seeds than the twelve that are tested always. A failure names its seed.

pub mod dice;
pub mod inputs;
pub mod random;
mod wild;

use super::parity;
use super::support::{assert_valid, gpu, materials, scene::Scene};
use atrous::config::{Conventions, NormalEncoding};
use atrous::executor::{Session, SessionOptions};
use atrous::graph::Graph;
use atrous::reference::{Engine, Texels};
use atrous::{
    DebugView, Declaration, FrameParams, ImageFormat, Lifetime, ResetReason, ResourceDecl, Setup, Shape, Tuning, UseFrame,
};
use atrous_harness::DeviceTest;
use inputs::Inputs;
use std::collections::BTreeSet;
use std::ops::Range;
use std::panic::{catch_unwind, resume_unwind};

pub const TESTS: &[DeviceTest] = &[
    ("seeds_reach_every_stage", seeds_reach_every_stage),
    ("a_graph_without_transient_images_runs", a_graph_without_transient_images_runs),
    // Two tests, so that two threads share the work.
    ("even_seeds", || for_each_seed(0)),
    ("odd_seeds", || for_each_seed(1)),
    ("wild_inputs_of_even_seeds", || wild_inputs(0)),
    ("wild_inputs_of_odd_seeds", || wild_inputs(1)),
];

/// Not a multiple of a workgroup, a block or a stratum.
const EXTENT: [u32; 2] = [33, 21];
/// The first and the third have no history.
const FRAMES: u32 = 4;
const SEEDS: Range<u32> = 0..12;

fn seeds() -> Range<u32> {
    let Ok(text) = std::env::var("ATROUS_GRAPH_SEEDS") else { return SEEDS };
    let (first, end) = text.split_once("..").expect("ATROUS_GRAPH_SEEDS is `first..end`");
    first.parse().expect("a number")..end.parse().expect("a number")
}

/// Both engines agree on the graphs of the seeds with this remainder of a half.
fn for_each_seed(remainder: u32) {
    check_seeds(remainder, both_engines_agree);
}

/// Every pass agrees with its twin whatever a host gives.
fn wild_inputs(remainder: u32) {
    check_seeds(remainder, passes_agree_on_wild_inputs);
}

fn check_seeds(remainder: u32, check: fn(u32)) {
    for seed in seeds().filter(|seed| seed % 2 == remainder) {
        if let Err(panic) = catch_unwind(|| check(seed)) {
            let passes = catch_unwind(|| pass_names(&random::declare(seed, EXTENT))).unwrap_or_default();
            eprintln!("the graph of seed {seed} failed (ATROUS_GRAPH_SEEDS={seed}..{}): {passes}", seed + 1);
            resume_unwind(panic);
        }
    }
}

fn pass_names(declaration: &Declaration) -> String {
    declaration.passes().iter().map(|pass| pass.name.as_str()).collect::<Vec<_>>().join(", ")
}

/// Stages that need light of a size of its own, or that presets alone have: `parity::light` and `parity::reactive_mask` run them.
const ELSEWHERE: [&str; 2] = ["reactive_mask", "upsample"];

/// Everything else occurs in the graphs that are always tested.
fn seeds_reach_every_stage() {
    let declarations: Vec<_> = SEEDS.map(|seed| random::declare(seed, EXTENT)).collect();
    let stages: BTreeSet<_> = declarations.iter().flat_map(|d| d.passes()).filter_map(|pass| pass.stage()).collect();
    let known: BTreeSet<_> = atrous::nodes::STAGES.iter().copied().filter(|stage| !ELSEWHERE.contains(stage)).collect();
    assert_eq!(stages, known);
    for part in
        ["temporal_accumulation_again", "atrous_other_0", "temporal_accumulation_ao", "forward_project_resolve", "temporal_upscale"]
    {
        assert!(declarations.iter().any(|d| d.passes().iter().any(|pass| pass.name == part)), "no graph has {part}");
    }
}

fn a_graph_without_transient_images_runs() {
    let mut g = Graph::new(EXTENT);
    let noisy = g.radiance("noisy_radiance");
    let display = g.tone_map(&noisy);
    g.output("display", &display);
    let declaration = g.finish().expect("a graph");
    let is_image = |r: &&ResourceDecl| matches!(r.shape, Shape::Image { .. }) && r.lifetime == Lifetime::Transient;
    assert_eq!(declaration.resources().iter().filter(is_image).count(), 0);
    let display = declaration.resource(declaration.find("display").expect("an output"));
    let (mut s, mut engine) = (session(&declaration, false), Engine::new(declaration.clone()).expect("twins"));
    for i in 0..2 {
        let radiance = scene(i).frame(i, i).noisy_radiance;
        s.upload("noisy_radiance", &radiance).expect("an input");
        engine.upload("noisy_radiance", &radiance).expect("an input");
        s.run(&params(0, i), &Tuning::default()).expect("frame");
        engine.run(&params(0, i), &Tuning::default()).expect("frame");
        let bytes = s.download_bytes("display", UseFrame::Current).expect("an output");
        let cpu = engine.texels("display", UseFrame::Current).expect("an output");
        assert_alike(&texels(display, bytes), cpu, &format!("frame {i}"));
    }
    assert_valid();
}

fn session(declaration: &Declaration, keep_transients: bool) -> Session {
    let options = SessionOptions { poison: true, keep_transients, ..Default::default() };
    Session::new(gpu(), declaration.clone(), options).expect("session")
}

/// A moving camera and light that jumps; the third frame drops all history.
fn scene(index: u32) -> Scene {
    Scene { speed: 0.12, light: if index == 3 { 0.3 } else { 1.0 }, ..Scene::new(EXTENT) }
}

fn params(seed: u32, index: u32) -> FrameParams {
    let jitter = [0.3 - 0.1 * index as f32, 0.05 * index as f32];
    let reset = (index == 2).then_some(ResetReason::CameraCut);
    let debug_view = Some(DebugView::ALL[(seed + index * 5) as usize % DebugView::ALL.len()]);
    let exposure_ratio = if index == 1 { 1.5 } else { 1.0 };
    // Without lights: where occluders differ at random, rounding decides which of two samples a shadow is followed by.
    // `parity::moving_shadows` has occluders that do not.
    let usual = FrameParams { materials: materials(), ..scene(index).params(index) };
    FrameParams { jitter, reset, debug_view, exposure_ratio, reshaded: !seed.is_multiple_of(4), ..usual }
}

/// Frames with every transient kept, pass by pass against the twins; frames with aliased transients, which are the same to the bit;
/// and the frames of the CPU, which are like them.
fn both_engines_agree(seed: u32) {
    let declaration = random::declare(seed, EXTENT);
    let (mut kept, mut aliased) = (session(&declaration, true), session(&declaration, false));
    let mut engine = Engine::new(declaration.clone()).expect("twins");
    is_as_it_was_planned(&declaration, &aliased);
    for i in 0..FRAMES {
        let (inputs, params) = (Inputs::new(&declaration, seed, &scene(i), i), params(seed, i));
        inputs.give_session(&mut kept).expect("inputs");
        parity::run(&mut kept, &params, &Tuning::default());
        inputs.give_session(&mut aliased).expect("inputs");
        aliased.run(&params, &Tuning::default()).expect("frame");
        inputs.give_engine(&mut engine).expect("inputs");
        engine.run(&params, &Tuning::default()).expect("frame");
        for output in declaration.resources().iter().filter(|r| r.lifetime == Lifetime::Output) {
            let what = format!("{}, frame {i}", output.name);
            let bytes = aliased.download_bytes(&output.name, UseFrame::Current).expect(&what);
            assert!(bytes == kept.download_bytes(&output.name, UseFrame::Current).expect(&what), "{what}: aliased memory");
            let cpu = engine.texels(&output.name, UseFrame::Current).expect(&what);
            assert_alike(&texels(output, bytes), cpu, &what);
        }
    }
    assert_valid();
}

/// A few frames of wild inputs, pass by pass against the twins; odd seeds have octahedral normals, of which z is not read.
fn passes_agree_on_wild_inputs(seed: u32) {
    let normal = if wild::is_octahedral(seed) { NormalEncoding::Octahedral } else { NormalEncoding::Xyz };
    let declaration = random::declare_with(seed, EXTENT, Conventions { normal, ..Conventions::default() });
    let mut s = session(&declaration, true);
    for i in 0..FRAMES {
        let mut inputs = Inputs::new(&declaration, seed, &scene(i), i);
        inputs.make_wild(seed, i, EXTENT[0]);
        inputs.give_session(&mut s).expect("inputs");
        parity::run(&mut s, &params(seed, i), &Tuning::default());
    }
    assert_valid();
}

fn texels(output: &ResourceDecl, bytes: Vec<u8>) -> Texels {
    match output.shape {
        Shape::Image { format: ImageFormat::Exactly(format), .. } => {
            Texels::from_bytes(format, output.extent(&Setup::new(EXTENT)).expect("an image"), &bytes).expect(&output.name)
        }
        _ => Texels::Bytes(bytes),
    }
}

/// Differences of one stage grow in the next and in the next frame, so a few pixels may differ; packed bits and counters may not.
fn assert_alike(gpu: &Texels, cpu: &Texels, what: &str) {
    if !matches!(gpu, Texels::Colour(_) | Texels::Scalar(_)) {
        assert_eq!(gpu, cpu, "{what}");
        return;
    }
    let (gpu, cpu) = (gpu.to_floats(), cpu.to_floats());
    assert_eq!(gpu.len(), cpu.len(), "{what}");
    let differs =
        |(a, b): &(&[f32; 4], &[f32; 4])| (0..4).any(|c| (a[c] - b[c]).abs() > 0.01 + 0.01 * b[c].abs() || !a[c].is_finite());
    let different: Vec<_> = gpu.iter().zip(&cpu).filter(differs).collect();
    assert!(
        250 * different.len() <= gpu.len(),
        "{what}: {} of {} pixels differ, first {:?}",
        different.len(),
        gpu.len(),
        different[0]
    );
}

/// Memory, the order of the phases, and names.
fn is_as_it_was_planned(declaration: &Declaration, s: &Session) {
    let (planned, allocated) = (declaration.memory(), s.executor().allocated());
    // A device may pad an image.
    assert!(planned.transient <= allocated.transient && planned.transient > 0, "{planned:?}, {allocated:?}");
    assert!(planned.history <= allocated.history && planned.transient <= planned.transient_unaliased, "{planned:?}, {allocated:?}");
    assert!(declaration.passes().windows(2).all(|pair| pair[0].phase <= pair[1].phase), "phases in order");
    let passes: BTreeSet<_> = declaration.passes().iter().map(|pass| &pass.name).collect();
    let resources: BTreeSet<_> = declaration.resources().iter().map(|r| &r.name).collect();
    assert_eq!((passes.len(), resources.len()), (declaration.passes().len(), declaration.resources().len()), "names are unique");
}
