//! A stage of the host on the CPU: without a function, with one, and with one that fails.

use super::super::super::test_scene::*;
use super::super::super::{Bindings, Twin};
use super::*;
use crate::graph::{Feedback, Graph, Port, Stage};
use crate::nodes::{Accumulation, Albedo, Demodulate, Import, Modulate, Variance};
use crate::ResetReason;
use glam::Vec3;

const EXTENT: [u32; 2] = [13, 9];

const HALVE: &str = "#version 450
    #extension GL_EXT_samplerless_texture_functions : require
    layout(local_size_x = 8, local_size_y = 8) in;
    layout(set = 0, binding = 0) uniform texture2D bright;
    layout(set = 0, binding = 1, rgba16f) uniform writeonly image2D halved;
    void main() {
        ivec2 p = ivec2(gl_GlobalInvocationID.xy);
        imageStore(halved, p, 0.5 * texelFetch(bright, p, 0));
    }";

fn stage() -> Stage {
    let compiler = shaderc::Compiler::new().expect("shaderc");
    let spirv = compiler.compile_into_spirv(HALVE, shaderc::ShaderKind::Compute, "halve", "main", None).expect("GLSL");
    Stage::new("halve", spirv.as_binary()).expect("a stage")
}

/// Accumulates, then runs the stage on what was accumulated, with its deviation.
fn declaration(stage: &Stage) -> Declaration {
    let mut g = Graph::new(EXTENT);
    let guides = g.import(Import { surface_id: false, ..Import::default() });
    let noisy = g.radiance("noisy_radiance");
    let irradiance = g.demodulate(&guides, &noisy, Demodulate { albedo: Albedo::None, ..Demodulate::default() });
    let history = g.history(&irradiance, Feedback::Accumulated);
    let accumulated = g.temporal_accumulation(&guides, &irradiance, &history, Accumulation::default());
    let estimate = g.variance(&guides, &accumulated, &history, Variance::default());
    let halved = g.stage(stage).bind("bright", estimate.image()).add().image("halved").expect("it writes it");
    let radiance = g.modulate(&guides, &Port::of(halved), Modulate { albedo: false, emission: false, ..Modulate::default() });
    g.output("dim", &radiance);
    g.finish().expect("valid")
}

fn host(twin: Twin) -> Host {
    Host { engine: Engine::new(declaration(&stage().with_twin(twin))).expect("every stage has a function").keep_transients() }
}

fn halve(b: &mut Bindings) -> Result<(), Error> {
    let halved = b.colour("bright")?.map(|texel| texel.map(|c| 0.5 * c));
    b.write("halved", halved)
}

#[test]
fn a_stage_without_a_function_is_named() {
    let error = Engine::new(declaration(&stage())).expect_err("no function").to_string();
    for part in ["`halve`", "a function for the CPU", "Stage::with_twin"] {
        assert!(error.contains(part), "{error}");
    }
}

#[test]
fn a_function_runs_as_a_stage() {
    let mut host = host(halve);
    for i in 0..3 {
        host.frame(&camera(EXTENT, Vec3::ZERO), &noise(EXTENT, i));
        for (dim, bright) in host.image("dim").texels().iter().zip(host.image("irradiance_history").texels()) {
            assert!((0..3).all(|c| (dim[c] - 0.5 * bright[c]).abs() <= 1e-3 * bright[c]), "{dim:?} {bright:?}");
        }
    }
    assert!(host.luminance_history().texels().iter().all(|m| m.history_length == 3.0));
}

fn fail_in_the_third_frame(b: &mut Bindings) -> Result<(), Error> {
    match b.frame.frame_index {
        2 => Err(Error::NotBound("what the host lost".to_owned())),
        _ => halve(b),
    }
}

#[test]
fn after_an_error_of_a_function_the_next_frame_drops_history() {
    let (mut broken, mut fresh) = (host(fail_in_the_third_frame), host(halve));
    let params = camera(EXTENT, Vec3::ZERO);
    assert_eq!(broken.frame(&params, &noise(EXTENT, 0)).reset, Some(ResetReason::Created));
    assert_eq!(broken.frame(&params, &noise(EXTENT, 1)).reset, None);
    let error = broken.engine.run(&params, &svgf_tuning()).expect_err("the function fails");
    assert_eq!(error, Error::NotBound("what the host lost".to_owned()));
    assert_eq!(broken.frame(&params, &noise(EXTENT, 3)).reset, Some(ResetReason::Created));
    fresh.frame(&params, &noise(EXTENT, 3));
    assert_eq!(broken.everything(), fresh.everything());
    assert_eq!(broken.frame(&params, &noise(EXTENT, 4)).reset, None);
}

#[test]
fn what_a_function_asks_for_and_writes_is_checked() {
    let params = camera(EXTENT, Vec3::ZERO);
    let message = |twin: Twin| {
        let mut host = host(twin);
        host.upload(EXTENT, &noise(EXTENT, 0));
        host.engine.run(&params, &svgf_tuning()).expect_err("refused").to_string()
    };
    let missing = message(|b| b.colour("dark").map(|_| ()));
    assert!(missing.contains("`halve`") && missing.contains("`dark`") && missing.contains("bright"), "{missing}");
    let kind = message(|b| b.packed("bright").map(|_| ()));
    assert!(kind.contains("`bright`") && kind.contains("64 packed bits") && kind.contains("four floats"), "{kind}");
    let extent = message(|b| b.write("halved", Image::new([2, 2], [0.0; 4])));
    assert!(extent.contains("halved") && extent.contains("[2, 2]") && extent.contains("[13, 9]"), "{extent}");
    let constant = message(|b| b.constant("SIZE").map(|_| ()));
    assert!(constant.contains("`SIZE`"), "{constant}");
}
