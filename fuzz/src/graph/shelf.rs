//! Nodes that are given any image that there is.

use super::stages::{COPY, MIX};
use super::{choice, number};
use crate::Choices;
use ash::vk::Format;
use atrous::graph::{
    Accumulated, Confidence, Estimate, Feedback, Gradient, Graph, Guides, History, Image, Irradiance, Percentiles, Port, Radiance,
    Stage, Value,
};
use atrous::nodes::*;
use atrous::Phase;

/// Everything that nodes have given so far.
#[derive(Default)]
pub struct Shelf {
    pub guides: Vec<Guides>,
    pub radiance: Vec<Radiance>,
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
    /// The guides and the radiance that every graph has.
    pub fn new(guides: Guides, noisy: Radiance) -> Self {
        let images = vec![guides.guide, guides.surface_motion, noisy.image()];
        Self { guides: vec![guides], radiance: vec![noisy], images, ..Self::default() }
    }

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

    /// Adds a node, now and then in a scope. `None` where there is nothing yet to give it.
    pub fn grow(&mut self, g: &mut Graph, choices: &mut Choices<'_>) -> Option<()> {
        if choices.one_in(6) {
            let scope = choices.one_of(&["once", "again"]);
            return g.scope(scope, |g| self.add(g, choices));
        }
        self.add(g, choices)
    }

    fn add(&mut self, g: &mut Graph, choices: &mut Choices<'_>) -> Option<()> {
        let guides = any(choices, &self.guides)?;
        match choices.below(20) {
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
                self.images.extend(history.colour().iter().chain(history.luminance_history()));
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
                let parameters = Modulate {
                    albedo: choices.one_in(2),
                    emission: choices.one_in(2),
                    float_output: choices.one_in(4),
                    ..Modulate::default()
                };
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
                let gradient = if choices.one_in(2) { g.gradient_atrous(&guides, &gradient) } else { gradient };
                self.gradients.push(gradient);
                self.confidence.push(g.history_confidence(&gradient, None));
            }
            11 => {
                let irradiance = self.port(choices, &self.irradiance)?;
                let percentiles = g.block_percentiles(&guides, &irradiance);
                self.percentiles.push(percentiles);
                let limits = match choices.one_in(2) {
                    true => g.firefly_limits(&guides, &irradiance, &percentiles),
                    false => g.firefly_limits_of_frame(&irradiance, &percentiles),
                };
                self.irradiance.push(g.firefly(&guides, &irradiance, &limits));
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
                let intermediates = Intermediates { confidence: any(choices, &self.confidence), ..Intermediates::new(&radiance) };
                let radiance = if choices.one_in(2) {
                    g.temporal_upscale(&guides, &radiance, TemporalUpscale { tone_mapped: choices.one_in(2) })
                } else {
                    radiance
                };
                let display = if choices.one_in(2) { g.tone_map(&radiance) } else { g.debug_view(&guides, &intermediates) };
                g.output(choices.one_of(&["display", "display", "noisy_radiance", ""]), &display);
            }
            15 => {
                let format = choices.one_of(&[Format::R16G16B16A16_SFLOAT, Format::R16G16B16A16_SFLOAT, Format::R32_UINT]);
                self.images.push(g.transient("transient", format, choices.one_of(&[1, 1, 1, 3])));
            }
            16 | 17 => self.stage(g, choices, &COPY)?,
            18 => self.stage(g, choices, &MIX)?,
            _ => {
                let import = Import {
                    surface_id: choices.one_in(2),
                    object_normal: choices.one_in(2),
                    albedo: choices.one_in(2),
                    ..Import::default()
                };
                let guides = g.import(import);
                self.images.extend([guides.guide, guides.surface_motion]);
                self.guides.push(guides);
            }
        }
        Some(())
    }

    /// A stage of the host between any two images; it makes the second one where it is not given one.
    fn stage(&mut self, g: &mut Graph, choices: &mut Choices<'_>, stage: &Stage) -> Option<()> {
        let (from, to) = (any(choices, &self.images)?, any(choices, &self.images).filter(|_| choices.one_in(3)));
        let call = g.stage(stage);
        let call = if choices.one_in(6) { call.previous("from", from) } else { call.bind("from", from) };
        let call = match to {
            Some(to) => call.bind("to", to),
            None => call,
        };
        let written = call.phase(choices.one_of(&[Phase::BeforeLighting, Phase::AfterLighting, Phase::AfterLighting])).add();
        let image = written.written("to");
        self.images.push(image);
        match choices.below(3) {
            0 => self.radiance.push(Port::of(image)),
            1 => self.estimates.push(Port::of(image)),
            _ => self.irradiance.push(Port::of(image)),
        }
        Some(())
    }
}
