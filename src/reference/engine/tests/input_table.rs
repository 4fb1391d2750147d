//! The table of inputs against what passes do with each.

use super::super::super::test_scene::camera;
use super::*;
use crate::config::{GradientSource, Preset, Signals};
use crate::contract::{Counter, Input, InputKind};
use crate::reference::InstanceTransform;
use glam::Vec3;

const EXTENT: [u32; 2] = [12, 9];

/// A configuration that asks for an input.
fn asking_for(input: &Input) -> Config {
    let specular = Config { preset: Preset::Best, signals: Signals::Specular, ..Config::new(EXTENT) };
    let everything = Config {
        preset: Preset::Asvgf,
        object_normal: true,
        material_class: true,
        forward_motion: true,
        volume: true,
        visibility: 4,
        ambient_occlusion: true,
        ..Config::new(EXTENT)
    };
    let apart = Config { signals: Signals::Apart, ..everything };
    let stabilize = Config { preset: Preset::Stabilize, gradient_source: GradientSource::Reshaded, ..Config::new(EXTENT) };
    let has = |config: &Config| config.declare().is_ok_and(|declaration| declaration.find(input.name).is_some());
    [everything, specular, apart, stabilize].into_iter().find(has).expect(input.name)
}

/// Instances 0 and 1, at rest.
const TRANSFORMS: [InstanceTransform; 2] = [[[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]]; 2];

/// Bad values that two frames count, with all inputs as they should be but for the one that is NaN, or has an id of no instance.
fn counted(counter: Counter, input: &Input, is_bad: bool) -> u32 {
    let config = asking_for(input);
    let mut engine = Engine::new(config.declare().expect("valid")).expect("twins");
    let mut sum = 0;
    for frame in 0..2 {
        // Where the albedo is given, nobody computes it; where a motion is, nobody asks for the id.
        let pairs = [(Input::SPECULAR_F0, Input::SPECULAR_ALBEDO), (Input::SPECULAR_HIT_ID, Input::SPECULAR_MOTION)];
        let is_left_out = |other: &Input| pairs.iter().any(|(of, left_out)| of.name == input.name && left_out.name == other.name);
        for other in Input::ALL.iter().filter(|other| !is_left_out(other)) {
            let Some(id) = engine.declaration.find(other.name) else { continue };
            let Some([width, height]) = engine.declaration.resource(id).extent(engine.declaration.setup()) else {
                engine.upload_buffer(other.name, bytemuck::cast_slice(&TRANSFORMS)).expect(other.name);
                continue;
            };
            let usual = match other.name {
                "depth" => [4.0; 4],
                "normal" | "object_normal" => [0.0, 0.0, 1.0, 0.0],
                "motion" | "forward_motion" => [0.0, 0.0, 4.0, 0.0],
                _ => [0.5; 4],
            };
            let is_bad = is_bad && other.name == input.name;
            let texel = if is_bad { [f32::NAN; 4] } else { usual };
            let count = (width * height) as usize;
            match other.kind {
                InputKind::Id => engine.upload_ids(other.name, &vec![if is_bad { 99 } else { 1 }; count]).expect(other.name),
                _ => engine.upload(other.name, &vec![texel; count]).expect(other.name),
            }
        }
        let params = FrameParams { reshaded: frame > 0, ..camera(EXTENT, Vec3::ZERO) };
        engine.run(&params, &Tuning::for_preset(config.preset)).expect("a frame");
        sum += engine.statistics().expect("a frame")[counter];
    }
    sum
}

#[test]
fn the_bad_values_of_each_input_are_counted_where_the_table_says() {
    for input in Input::ALL {
        let Some(counter) = input.counter else { continue };
        assert_eq!(counted(counter, input, false), 0, "{}", input.name);
        assert!(counted(counter, input, true) > 0, "{} is not counted as {counter}", input.name);
    }
}
