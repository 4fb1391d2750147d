//! Every option of a configuration, every input, every parameter and every tunable at once, at any scale, good and bad.

use crate::graphs::dice::Dice;
use crate::support::{assert_finite, assert_valid, session, soak};
use atrous::config::{
    AdaptiveRule, Channel, Conventions, DepthEncoding, EawWeights, GradientSource, MotionDepth, MotionDirection, MotionUnit,
    NormalEncoding, NormalSpace, PostProcess, Preset, RoughnessEncoding, Sampling, Signals, ViewForward,
};
use atrous::executor::Session;
use atrous::{Component, Config, DebugView, FrameParams, ImageFormat, Lifetime, ResetReason, Shape, TexelGrid, Tuning};

/// Drawn from all that there are. No field has a default here: one that is new does not compile until it is drawn as well.
pub fn config(dice: &mut Dice) -> Config {
    let conventions = Conventions {
        depth: dice.one_of(&DepthEncoding::ALL),
        background_depth: dice.one_of(&[f32::INFINITY, 1e3, 1e-3, f32::MAX]),
        normal: dice.one_of(&NormalEncoding::ALL),
        normal_space: dice.one_of(&NormalSpace::ALL),
        motion_unit: dice.one_of(&MotionUnit::ALL),
        motion_direction: dice.one_of(&MotionDirection::ALL),
        motion_y_up: dice.coin(),
        motion_jittered: dice.coin(),
        motion_depth: dice.one_of(&MotionDepth::ALL),
        view_forward: dice.one_of(&ViewForward::ALL),
        roughness: dice.one_of(&RoughnessEncoding::ALL),
        motion_scale: dice.one_of(&[1.0, 1e-30, 0.02, f32::MAX]),
        roughness_channel: dice.one_of(&Channel::ALL),
        demodulated: dice.coin(),
    };
    Config {
        allocated_extent: [1 + dice.below(40), 1 + dice.below(30)],
        frames_in_flight: 1 + dice.below(3),
        preset: dice.one_of(&Preset::ALL),
        signals: dice.one_of(&Signals::ALL),
        levels: dice.coin().then(|| 1 + dice.below(10)),
        volume: dice.coin(),
        visibility: dice.below(5),
        firefly_filter: dice.coin(),
        adaptive_rule: dice.one_of(&AdaptiveRule::ALL),
        stratum_size: 2 + dice.below(3),
        gradient_source: dice.one_of(&GradientSource::ALL),
        forward_motion: dice.coin(),
        eaw_weights: EawWeights::first(dice.below(4)),
        sampling: dice.one_of(&Sampling::ALL),
        surface_id: dice.coin(),
        object_normal: dice.coin(),
        post_process: dice.one_of(&PostProcess::ALL),
        float_output: dice.coin(),
        debug_view: dice.coin(),
        // Its frames render any part of the allocation.
        output_extent: None,
        light_extent: None,
        image_extent: None,
        reactive_mask: dice.coin(),
        material_class: dice.coin(),
        coloured_visibility: dice.coin(),
        ambient_occlusion: dice.coin(),
        conventions,
    }
}

/// A number of any size that a float has.
fn any(dice: &mut Dice) -> f32 {
    const SPECIAL: [f32; 12] =
        [0.0, -0.0, 1.0, f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1.5e-39, 1e-30, 65504.0, 65536.0, f32::MAX, f32::MIN];
    match dice.below(8) {
        0 => dice.one_of(&SPECIAL),
        1 => -of_scale(dice, 1.0),
        2 => {
            let exponent = dice.below(77) as i32 - 38;
            of_scale(dice, 10_f32.powi(exponent))
        }
        _ => of_scale(dice, 1.0),
    }
}

fn of_scale(dice: &mut Dice, scale: f32) -> f32 {
    scale * dice.below(4096) as f32 / 4096.0
}

/// Texels of one input in one frame: a plain one, one of bad pixels, of one value throughout, of a scale, or anything.
fn texels(dice: &mut Dice, count: usize) -> Vec<[f32; 4]> {
    let (kind, value, scale) = (dice.below(6), any(dice), 10_f32.powi(dice.below(17) as i32 - 8));
    let mut texel = |i: usize| match kind {
        0 => [0.5; 4],
        1 if !i.is_multiple_of(7) => [0.5; 4],
        1 | 2 => [value; 4],
        3 => [0; 4].map(|_: i32| of_scale(dice, scale)),
        4 => [0; 4].map(|_: i32| of_scale(dice, 1.0)),
        _ => [0; 4].map(|_: i32| any(dice)),
    };
    (0..count).map(&mut texel).collect()
}

/// A rigid movement far from the origin or near it.
fn view(dice: &mut Dice) -> [[f32; 4]; 4] {
    let (angle, far) = (of_scale(dice, 6.3), 10_f32.powi(dice.below(9) as i32 - 2));
    let (sin, cos) = angle.sin_cos();
    let mut at = || far * (of_scale(dice, 2.0) - 1.0);
    [[cos, 0.0, -sin, 0.0], [0.0, 1.0, 0.0, 0.0], [sin, 0.0, cos, 0.0], [at(), at(), at(), 1.0]]
}

fn clip(dice: &mut Dice) -> [[f32; 4]; 4] {
    let near = 10_f32.powi(dice.below(5) as i32 - 3);
    let (x, y) = (0.5 + of_scale(dice, 2.0), 0.5 + of_scale(dice, 2.0));
    let mut clip = FrameParams::new([1, 1]).clip_from_view;
    if dice.below(4) > 0 {
        // Reversed and infinite.
        clip = [[x, 0.0, 0.0, 0.0], [0.0, -y, 0.0, 0.0], [0.0, 0.0, 0.0, -1.0], [0.0, 0.0, near, 0.0]];
    }
    clip
}

fn params(dice: &mut Dice, config: &Config, frame: u32) -> FrameParams {
    let [width, height] = config.allocated_extent;
    FrameParams {
        light_offset: [0; 2],
        viewport_origin: [0; 2],
        output_extent: None,
        materials: std::array::from_fn(|_| [0.01, 0.01, 0.01, 1.0].map(|least| least * dice.one_of(&[1.0, 100.0, 1000.0])).into()),
        frame_slot: frame % config.frames_in_flight,
        reset: (dice.below(8) == 0).then(|| dice.one_of(&ResetReason::ALL)),
        render_extent: if dice.coin() { [width, height] } else { [1 + dice.below(width), 1 + dice.below(height)] },
        view_from_world: view(dice),
        clip_from_view: clip(dice),
        jitter: [of_scale(dice, 2.0) - 1.0, of_scale(dice, 2.0) - 1.0],
        exposure_ratio: if dice.below(4) == 0 { dice.one_of(&[1e-45, 1e-20, 0.5, 1e4, f32::MAX]) } else { 1.0 },
        reshaded: dice.coin(),
        debug_view: config.debug_view.then(|| dice.one_of(&DebugView::ALL)),
        complete_frames: None,
        lights: [0; 4].map(|_: i32| {
            let far = 10_f32.powi(dice.below(9) as i32 - 2);
            let mut at = || if dice.below(4) == 0 { 0.0 } else { far * (of_scale(dice, 2.0) - 1.0) };
            [at(), at(), at(), f32::from(dice.coin())]
        }),
    }
}

fn tuning(dice: &mut Dice, preset: Preset) -> Tuning {
    let mut tuning = Tuning::for_preset(preset);
    for field in Tuning::FIELDS {
        let value = match dice.below(8) {
            0 => field.min,
            1 => field.max,
            2 => field.min + (field.max - field.min) * of_scale(dice, 1.0),
            _ => continue,
        };
        tuning.set(field.name, value).expect(field.name);
    }
    tuning
}

/// Inputs of floats with their texels, outputs of floats with one a pixel.
fn images(session: &Session) -> (Vec<(String, usize)>, Vec<String>) {
    let declaration = session.executor().denoiser().declaration();
    let (mut inputs, mut outputs) = (Vec::new(), Vec::new());
    for resource in declaration.resources() {
        let Shape::Image { format, texels } = resource.shape else { continue };
        let [width, height] = resource.extent(declaration.setup()).expect("an image");
        match (resource.lifetime, format) {
            (Lifetime::Input { .. }, ImageFormat::Any(Component::Float, _)) => {
                inputs.push((resource.name.clone(), (width * height) as usize))
            }
            (Lifetime::Output, format) if texels == TexelGrid::Rendered(1) && format!("{format}").contains("SFLOAT") => {
                outputs.push(resource.name.clone())
            }
            _ => {}
        }
    }
    (inputs, outputs)
}

fn upload_some(session: &mut Session, dice: &mut Dice, inputs: &[(String, usize)], is_first: bool) {
    for (name, count) in inputs {
        if is_first || dice.coin() {
            session.upload(name, &texels(dice, *count)).expect(name);
        }
    }
    let declaration = session.executor().denoiser().declaration().clone();
    let [width, height] = declaration.allocated_extent();
    let (has_ids, has_transforms) = (declaration.find("surface_id").is_some(), declaration.find("instance_transforms").is_some());
    if has_ids && (is_first || dice.below(4) == 0) {
        let ids: Vec<u32> = (0..width * height).map(|_| dice.one_of(&[0, 1, 1, 1, 2, 300, u32::MAX])).collect();
        session.upload_ids("surface_id", &ids).expect("surface_id");
    }
    if declaration.find("material_class").is_some() && (is_first || dice.below(4) == 0) {
        let classes: Vec<u32> = (0..width * height).map(|_| dice.below(20)).collect();
        session.upload_ids("material_class", &classes).expect("material_class");
    }
    if has_transforms && dice.below(4) == 0 {
        let rows: Vec<u8> = (0..3 * 12).flat_map(|_| any(dice).to_ne_bytes()).collect();
        session.upload_buffer("instance_transforms", &rows).expect("instance_transforms");
    }
}

pub fn any_configuration_survives_chaos() {
    let frames_each = if soak::is_on() { 60 } else { 6 };
    let (mut frames, mut outputs_seen) = (0, 0);
    for seed in 0..soak::times(4) {
        let mut dice = Dice::new(seed);
        let config = config(&mut dice);
        let mut session = session(&config);
        let (inputs, outputs) = images(&session);
        for frame in 0..frames_each {
            upload_some(&mut session, &mut dice, &inputs, frame == 0);
            let params = params(&mut dice, &config, frame);
            session.run(&params, &tuning(&mut dice, config.preset)).unwrap_or_else(|error| panic!("seed {seed}: {error}"));
            for name in &outputs {
                // A view that is not drawn leaves its output as it was.
                if name != "debug_view" || params.debug_view.is_some() {
                    let texels = session.download(name).expect(name);
                    println!("seed {seed}, frame {frame}, {name}");
                    assert_finite(&texels, params.render_extent, config.allocated_extent);
                }
            }
            (frames, outputs_seen) = (frames + 1, outputs_seen + outputs.len());
        }
    }
    println!("{frames} frames, {outputs_seen} outputs, every value finite");
    assert_valid();
}
