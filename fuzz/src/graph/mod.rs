//! Configurations with anything in their fields, and graphs whose nodes are given any image that there is. What is accepted is held
//! against what every host takes for granted, and run; and with one mistake more it is refused, by name.

mod mistakes;
mod run;
mod shelf;
mod sound;
mod stages;

use crate::{Choices, Outcome};
use atrous::config::{Config, Conventions, EawWeights};
use atrous::graph::Graph;
use atrous::nodes::Import;
use atrous::{Choice, Declaration, Error, Setup};
use mistakes::{Mistake, MISTAKES};
use shelf::Shelf;

/// Declares a configuration or a graph of the bytes, and runs it on the CPU where it is small.
pub fn attack(bytes: &[u8]) -> Outcome {
    let mut choices = Choices::new(bytes);
    if choices.one_in(3) {
        return configured(&mut choices).map_or_else(refused, |declaration| used(&declaration, None));
    }
    let compose = |share, mistake| composed(&mut choices.clone(), share, mistake);
    let (apart, shared) = match (compose(false, None), compose(true, None)) {
        (Ok(apart), Ok(shared)) => (apart, shared),
        (Err(error), Err(_)) => return refused(error),
        (apart, shared) => panic!("only one of both is refused: {:?}, {:?}", apart.err(), shared.err()),
    };
    sound::assert_each_content_counts(&apart);
    for mistake in &MISTAKES {
        mistake.assert_is_named(compose(false, Some(mistake)).err());
    }
    used(&shared, Some(&apart))
}

fn refused(error: Error) -> Outcome {
    assert!(!error.to_string().is_empty());
    Outcome::Refused
}

/// Runs a declaration where it is small. `apart` is the same graph whose transients do not lie in the images of outputs.
fn used(declaration: &Declaration, apart: Option<&Declaration>) -> Outcome {
    sound::assert_is_sound(declaration);
    let small = declaration.allocated_extent().iter().all(|side| *side <= 12) && declaration.passes().len() <= 40;
    if !small {
        return Outcome::Large;
    }
    run::run(declaration, apart.unwrap_or(declaration));
    Outcome::Used
}

fn choice<T: Choice>(choices: &mut Choices<'_>) -> T {
    choices.one_of(T::ALL)
}

/// Mostly `usual`.
fn number(choices: &mut Choices<'_>, usual: u32) -> u32 {
    if choices.one_in(12) {
        choices.odd()
    } else {
        usual
    }
}

fn extent(choices: &mut Choices<'_>) -> [u32; 2] {
    let side = |choices: &mut Choices<'_>| 1 + choices.below(12) as u32;
    let sides = [side(choices), side(choices)];
    sides.map(|side| number(choices, side))
}

fn conventions(choices: &mut Choices<'_>) -> Conventions {
    Conventions {
        depth: choice(choices),
        background_depth: if choices.one_in(8) { choices.odd_float() } else { f32::INFINITY },
        normal: choice(choices),
        normal_space: choice(choices),
        motion_unit: choice(choices),
        motion_direction: choice(choices),
        motion_y_up: choices.one_in(2),
        motion_jittered: choices.one_in(2),
        motion_depth: choice(choices),
        view_forward: choice(choices),
        roughness: choice(choices),
        motion_scale: if choices.one_in(2) { 1.0 } else { 50.0 },
        roughness_channel: choice(choices),
        demodulated: choices.one_in(2),
    }
}

fn configured(choices: &mut Choices<'_>) -> Result<Declaration, Error> {
    let allocated_extent = extent(choices);
    let config = Config {
        allocated_extent,
        frames_in_flight: number(choices, 2),
        preset: choice(choices),
        signals: choice(choices),
        levels: choices.one_in(2).then(|| number(choices, 3)),
        volume: choices.one_in(2),
        visibility: number(choices, 5),
        firefly_filter: choices.one_in(2),
        adaptive_rule: choice(choices),
        eaw_weights: EawWeights::from_bits(number(choices, 7)).unwrap_or_default(),
        sampling: choice(choices),
        stratum_size: number(choices, 3),
        gradient_source: choice(choices),
        forward_motion: choices.one_in(2),
        surface_id: choices.one_in(2),
        object_normal: choices.one_in(2),
        post_process: choice(choices),
        float_output: choices.one_in(4),
        debug_view: choices.one_in(2),
        output_extent: choices.one_in(2).then(|| extent(choices)),
        light_extent: choices.one_in(4).then(|| allocated_extent.map(|side| side / 2)),
        image_extent: choices.one_in(4).then(|| extent(choices)),
        reactive_mask: choices.one_in(2),
        coloured_visibility: choices.one_in(2),
        ambient_occlusion: choices.one_in(2),
        conventions: conventions(choices),
        material_class: choices.one_in(2),
    };
    let declaration = config.declare()?;
    let text = serde_json::to_string(&config).expect("it is valid");
    let read: Config = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert!(read.declare().is_ok_and(|read| read.passes().len() == declaration.passes().len()), "not what was written: {text}");
    Ok(declaration)
}

/// A graph of the bytes. `share`: whether transients may lie in the images of outputs. `mistake` is made behind everything else.
fn composed(choices: &mut Choices<'_>, share: bool, mistake: Option<&Mistake>) -> Result<Declaration, Error> {
    let extent = extent(choices);
    let mut g = Graph::of(Setup { frames_in_flight: number(choices, 2), ..Setup::new(extent) }).share_outputs(share);
    let guides = g.import(Import {
        surface_id: true,
        object_normal: choices.one_in(2),
        material_class: choices.one_in(2),
        albedo: choices.one_in(2),
    });
    let noisy = g.radiance("noisy_radiance");
    let mut shelf = Shelf::new(guides, noisy);
    if choices.one_in(16) {
        // What another graph has is none of this one's business.
        let mut other = Graph::new(extent);
        shelf.guides.push(other.import(Import::default()));
        shelf.radiance.push(other.radiance("noisy_radiance"));
    }
    for _ in 0..2 + choices.below(14) {
        _ = shelf.grow(&mut g, choices);
    }
    // Modulated, where there is something to modulate.
    if let Some(radiance) = shelf.radiance.last().filter(|radiance| radiance.signals() == 1 && shelf.radiance.len() > 1) {
        g.output("denoised_radiance", radiance);
    }
    if let Some(mistake) = mistake {
        g.scope("planted", |g| mistake.make(g, &guides, &noisy));
    }
    g.finish()
}
