//! Configurations with anything in their fields, and graphs whose nodes are given any image that there is.

use crate::{Choices, Outcome};
use atrous::config::{Config, Conventions, EawWeights};
use atrous::graph::{
    Accumulated, Confidence, Estimate, Feedback, Gradient, Graph, Guides, History, Image, Irradiance, Percentiles, Port, Radiance,
    Value,
};
use atrous::nodes::*;
use atrous::reference::Engine;
use atrous::{Choice, Component, Declaration, Error, FrameParams, ImageFormat, Lifetime, Shape, Tuning};
use std::collections::BTreeSet;

/// Declares a configuration or a graph of the bytes, and runs it on the CPU where it is small.
pub fn attack(bytes: &[u8]) -> Outcome {
    let mut choices = Choices::new(bytes);
    let declared = if choices.one_in(3) { configured(&mut choices) } else { composed(&mut choices) };
    match declared {
        Ok(declaration) => {
            assert_is_sound(&declaration);
            let small = declaration.allocated_extent().iter().all(|side| *side <= 12) && declaration.passes().len() <= 40;
            if !small {
                return Outcome::Large;
            }
            run(declaration);
            Outcome::Used
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            Outcome::Refused
        }
    }
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
    }
}

fn configured(choices: &mut Choices<'_>) -> Result<Declaration, Error> {
    let config = Config {
        allocated_extent: extent(choices),
        frames_in_flight: number(choices, 2),
        preset: choice(choices),
        signals: choice(choices),
        levels: choices.one_in(2).then(|| number(choices, 3)),
        volume: choices.one_in(2),
        visibility: choices.one_in(2),
        firefly_filter: choices.one_in(2),
        adaptive_rule: choice(choices),
        block_sort: choice(choices),
        eaw_weights: EawWeights::from_bits(number(choices, 7)).unwrap_or_default(),
        sampling: choice(choices),
        stratum_size: number(choices, 3),
        gradient_source: choice(choices),
        forward_motion: choices.one_in(2),
        surface_id: choices.one_in(2),
        object_normal: choices.one_in(2),
        post_process: choice(choices),
        debug_view: choices.one_in(2),
        conventions: conventions(choices),
    };
    let declaration = config.declare()?;
    let text = serde_json::to_string(&config).expect("it is valid");
    let read: Config = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{error}: {text}"));
    assert!(read.declare().is_ok_and(|read| read.passes().len() == declaration.passes().len()), "not what was written: {text}");
    Ok(declaration)
}

/// Everything that nodes have given so far.
#[derive(Default)]
struct Shelf {
    guides: Vec<Guides>,
    radiance: Vec<Radiance>,
    irradiance: Vec<Irradiance>,
    histories: Vec<History>,
    accumulated: Vec<Accumulated>,
    estimates: Vec<Estimate>,
    confidence: Vec<Confidence>,
    gradients: Vec<Gradient>,
    percentiles: Vec<Percentiles>,
    images: Vec<Image>,
}

/// One of a list, mostly the last.
fn any<T: Copy>(choices: &mut Choices<'_>, list: &[T]) -> Option<T> {
    let at = if choices.one_in(4) { choices.below(list.len()) } else { list.len().checked_sub(1)? };
    list.get(at).copied()
}

impl Shelf {
    fn add_images<K>(&mut self, port: &Port<K>) {
        self.images.extend(port.images());
    }

    /// The port of a list, or now and then any image in its place.
    fn port<K>(&self, choices: &mut Choices<'_>, list: &[Port<K>]) -> Option<Port<K>> {
        let at = if choices.one_in(4) { choices.below(list.len()) } else { list.len().wrapping_sub(1) };
        match any(choices, &self.images).filter(|_| choices.one_in(24)) {
            Some(image) => Some(Port::of(image)),
            None => list.get(at).copied(),
        }
    }

    /// Adds a node. `None` where there is nothing yet to give it.
    fn grow(&mut self, g: &mut Graph, choices: &mut Choices<'_>) -> Option<()> {
        let guides = any(choices, &self.guides)?;
        match choices.below(16) {
            0 => {
                let noisy = g.radiance(choices.one_of(&["noisy_radiance", "noisy_direct", "depth", "", "frame_constants"]));
                self.radiance.push(noisy);
                self.add_images(&noisy);
            }
            1 => {
                let [a, b] = [self.port(choices, &self.radiance)?, self.port(choices, &self.radiance)?];
                self.radiance.push(g.pair(&a, &b));
            }
            2 => {
                let noisy = self.port(choices, &self.radiance)?;
                let gradient = choices.one_in(3).then(|| any(choices, &self.gradients)).flatten();
                let albedo = choices.one_of(&[Albedo::Diffuse, Albedo::None]);
                let irradiance = g.demodulate(&guides, &noisy, Demodulate { albedo, gradient, ..Demodulate::default() });
                self.irradiance.push(irradiance);
                self.add_images(&irradiance);
            }
            3 => {
                let irradiance = self.port(choices, &self.irradiance)?;
                let history = g.history(&irradiance, choices.one_of(&[Feedback::Filtered, Feedback::Accumulated]));
                self.histories.push(history);
                self.images.extend(history.colour().iter().chain(history.moments()));
            }
            4 => {
                let (irradiance, history) = (self.port(choices, &self.irradiance)?, any(choices, &self.histories)?);
                let confidence = choices.one_in(3).then(|| self.port(choices, &self.confidence)).flatten();
                let alpha = choices.one_of(&[Value::Own, Value::Fixed(0.05), Value::Tunable("volume_alpha"), Value::Tunable("no")]);
                let accumulation = Accumulation { confidence, repair: choices.one_in(2), alpha, ..Accumulation::default() };
                self.accumulated.push(g.temporal_accumulation(&guides, &irradiance, &history, accumulation));
            }
            5 => {
                let (accumulated, history) = (any(choices, &self.accumulated)?, any(choices, &self.histories)?);
                let estimator = choices.one_of(&[Estimator::Switched, Estimator::Fading, Estimator::Temporal]);
                let estimate = g.variance(&guides, &accumulated, &history, Variance { estimator, ..Variance::default() });
                self.estimates.push(estimate);
                self.irradiance.push(estimate.into());
            }
            6 => {
                let estimate = self.port(choices, &self.estimates)?;
                let feedback = any(choices, &self.histories).filter(|_| choices.one_in(2));
                let levels = 1 + choices.below(4) as u32;
                let shape = Atrous { levels: number(choices, levels), kernel: choices.one_of(&Kernel::ALL), ..Atrous::default() };
                let filtered = g.atrous(&guides, &estimate, Atrous { feedback, ..shape });
                self.irradiance.push(filtered.into());
                self.add_images(&filtered);
            }
            7 | 8 => {
                let filtered = self.port(choices, &self.irradiance)?;
                let parameters = Modulate { albedo: choices.one_in(2), emission: choices.one_in(2), ..Modulate::default() };
                let radiance = g.modulate(&guides, &filtered, parameters);
                self.radiance.push(radiance);
                self.add_images(&radiance);
            }
            9 => {
                let noisy = self.port(choices, &self.radiance)?;
                let stratum_size = number(choices, 3);
                let gradient = match choices.below(3) {
                    0 => {
                        let project = ForwardProject { stratum_size, forward_motion: false, surface_id: choices.one_in(2) };
                        let samples = g.forward_project(&guides, project);
                        g.gradient(&guides, &noisy, Gradients::ForwardProjected(samples))
                    }
                    1 => g.gradient_and_ratio(&guides, &noisy, Gradients::Reshaded { stratum_size }),
                    _ => g.gradient(&guides, &noisy, Gradients::Sparse { stratum_size }),
                };
                self.gradients.push(gradient);
                self.images.push(gradient.image());
            }
            10 => {
                let gradient = any(choices, &self.gradients)?;
                let parameters = GradientAtrous { smooth_deviation: choices.one_in(2) };
                let gradient = if choices.one_in(2) { g.gradient_atrous(&guides, &gradient, parameters) } else { gradient };
                self.gradients.push(gradient);
                self.confidence.push(g.adaptive_alpha(&gradient));
            }
            11 => {
                let irradiance = self.port(choices, &self.irradiance)?;
                let percentiles = g.block_percentiles(&guides, &irradiance, choice(choices));
                self.percentiles.push(percentiles);
                self.irradiance.push(g.firefly(&guides, &irradiance, &percentiles));
            }
            12 => {
                let (percentiles, history) = (self.port(choices, &self.percentiles)?, any(choices, &self.histories)?);
                self.confidence.push(g.percentile_rule(&guides, &percentiles, &history));
            }
            13 => {
                let irradiance = self.port(choices, &self.irradiance)?;
                let levels = 1 + choices.below(4) as u32;
                let eaw = Eaw { levels: number(choices, levels), feedback: None, sampling: choice(choices), ..Eaw::default() };
                self.irradiance.push(g.eaw(&guides, &irradiance, eaw));
            }
            14 => {
                let radiance = self.port(choices, &self.radiance)?;
                let known = Known { confidence: any(choices, &self.confidence), ..Known::new(&radiance) };
                let display = if choices.one_in(2) { g.tone_map(&radiance) } else { g.debug_view(&guides, &known) };
                let display = if choices.one_in(2) { g.taa(&guides, &display) } else { display };
                g.output(choices.one_of(&["display", "display", "noisy_radiance", ""]), &display);
            }
            _ => {
                let import = Import { surface_id: choices.one_in(2), object_normal: choices.one_in(2) };
                let guides = if choices.one_in(2) { g.import(import) } else { g.scope("again", |g| g.import(import)) };
                self.images.extend([guides.guide, guides.surface_motion, guides.depth_gradient]);
                self.guides.push(guides);
            }
        }
        Some(())
    }
}

fn composed(choices: &mut Choices<'_>) -> Result<Declaration, Error> {
    let extent = extent(choices);
    let mut g = Graph::new(extent).frames_in_flight(number(choices, 2)).share_outputs(choices.one_in(2));
    let guides = g.import(Import { surface_id: true, object_normal: choices.one_in(2) });
    let noisy = g.radiance("noisy_radiance");
    let mut shelf = Shelf { guides: vec![guides], radiance: vec![noisy], ..Shelf::default() };
    if choices.one_in(16) {
        // What another graph has is none of this one's business.
        let mut other = Graph::new(extent);
        shelf.guides.push(other.import(Import { surface_id: true, object_normal: false }));
        shelf.radiance.push(other.radiance("noisy_radiance"));
    }
    for _ in 0..2 + choices.below(14) {
        _ = shelf.grow(&mut g, choices);
    }
    // Modulated, where there is something to modulate.
    if let Some(radiance) = shelf.radiance.last().filter(|radiance| radiance.signals() == 1 && shelf.radiance.len() > 1) {
        g.output("denoised_radiance", radiance);
    }
    g.finish()
}

/// What every host takes for granted.
fn assert_is_sound(declaration: &Declaration) {
    let names: BTreeSet<_> = declaration.resources().iter().map(|r| &r.name).collect();
    assert_eq!(names.len(), declaration.resources().len(), "two resources of one name");
    let passes: BTreeSet<_> = declaration.passes().iter().map(|p| &p.name).collect();
    assert_eq!(passes.len(), declaration.passes().len(), "two passes of one name");
    let mut written: BTreeSet<u32> = BTreeSet::new();
    for pass in declaration.passes() {
        for u in &pass.uses {
            let resource = declaration.resources().get(u.resource.0 as usize).expect("a resource of the declaration");
            if u.access.writes() {
                assert!(!matches!(resource.lifetime, Lifetime::Input { .. }), "{} writes {}", pass.name, resource.name);
            }
            let from_before = matches!(resource.lifetime, Lifetime::Input { .. }) || resource.lifetime.is_history();
            let is_read = u.access.reads() && !from_before;
            assert!(!is_read || written.contains(&u.resource.0), "{} reads {} before it is written", pass.name, resource.name);
        }
        written.extend(pass.uses.iter().filter(|u| u.access.writes()).map(|u| u.resource.0));
    }
    let memory = declaration.memory();
    assert!(memory.transient <= memory.transient_unaliased, "aliasing takes more: {memory:?}");
    assert_eq!(memory.resources.len(), declaration.resources().len());
}

/// Three frames of a lit wall, of which every output is finite.
fn run(declaration: Declaration) {
    let extent = declaration.allocated_extent();
    let mut engine = Engine::new(declaration.clone()).expect("an engine").keep_transients();
    for resource in declaration.resources() {
        let (Lifetime::Input { .. }, Shape::Image { format, .. }) = (resource.lifetime, resource.shape) else { continue };
        let texels = resource.extent(extent).map_or(0, |[width, height]| width as usize * height as usize);
        match format {
            ImageFormat::Any(Component::Uint, _) => engine.upload_ids(&resource.name, &vec![1; texels]),
            _ => engine.upload(&resource.name, &vec![[0.5; 4]; texels]),
        }
        .unwrap_or_else(|error| panic!("{}: {error}", resource.name));
    }
    let views = declaration.debug_views();
    for frame in 0..3 {
        let debug_view = views.get(frame % views.len().max(1)).copied();
        let params = FrameParams { debug_view, reshaded: frame == 1, ..FrameParams::new(extent) };
        engine.run(&params, &Tuning::default()).expect("a frame");
    }
    for resource in declaration.resources().iter().filter(|r| r.lifetime == Lifetime::Output) {
        let texels = engine.download(&resource.name).expect("an output");
        assert!(texels.iter().flatten().all(|v| v.is_finite()), "{} is not finite", resource.name);
    }
}
