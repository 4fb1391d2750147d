//! Presets: each is a short list of nodes in a function, which you can call in a graph of your own,
//! read, copy and cut.
//!
//! A preset takes the guides of [`Graph::import`] and the noisy signals, and returns [`Denoised`].
//! [`Config::declare`] adds the parts that a [`Config`] asks for: your inputs, a volume, the
//! post-process, the debug view.

mod asvgf;
mod best;
mod eaw;
mod fast;
mod gradients;
mod past;
mod percentile;
mod specular;
mod stabilize;
mod svgf;
mod visibility;
mod volume;

pub use asvgf::asvgf;
pub use best::{best, best_with, Best};
pub use eaw::eaw;
pub use fast::{fast, fast_with};
pub use gradients::{change_of_light, gradient_samples, ChangeOfLight};
pub use percentile::percentile;
pub use specular::{specular, Specular};
pub use stabilize::stabilize;
pub use svgf::svgf;
pub use volume::volume;

use crate::config::{Config, PostProcess, Preset, Signals};
use crate::contract::Declaration;
use crate::error::Error;
use crate::graph::{Graph, Guides, Image, Irradiance, Radiance, Visibility};
use crate::nodes::visibility_filter::OUTPUTS;
use crate::nodes::{Atrous, Import, Intermediates, Kernel, LuminanceWeight, TemporalUpscale, Usual};
use visibility::{ambient, ambient_accumulated, visibility, visibility_accumulated};

/// The outputs of a preset.
#[derive(Clone, Copy, Debug)]
pub struct Denoised {
    /// Denoised radiance.
    pub radiance: Radiance,
    /// Intermediate images, for [`Graph::debug_view`].
    pub intermediates: Intermediates,
}

impl Config {
    /// Declares every resource and pass, without a device.
    ///
    /// # Errors
    /// Errors of [`Config::validate`].
    pub fn declare(&self) -> Result<Declaration, Error> {
        self.graph()?.finish()
    }

    /// The graph of [`Self::declare`], not yet finished.
    ///
    /// # Errors
    /// Errors of [`Config::validate`].
    pub fn graph(&self) -> Result<Graph, Error> {
        self.graph_of(filter_of(self.preset))
    }

    /// [`Self::graph`] with a filter of surfaces other than that of the preset, for example
    /// [`best_with`] with other parts, or one of your own.
    ///
    /// # Errors
    /// Errors of [`Config::validate`].
    pub fn graph_with(&self, filter: impl FnOnce(&mut Graph, &Guides, &Self) -> Denoised) -> Result<Graph, Error> {
        self.graph_of(Some(filter))
    }

    fn graph_of(&self, filter: Option<impl FnOnce(&mut Graph, &Guides, &Self) -> Denoised>) -> Result<Graph, Error> {
        self.validate()?;
        let mut g = Graph::of_config(self);
        let guides = g.import(Import {
            surface_id: self.surface_id,
            object_normal: self.object_normal && self.has_surface_history(),
            material_class: self.material_class && self.has_surface_history(),
            albedo: filter.is_some(),
        });
        filter_exposure(&mut g, self);
        let accumulated = (self.visibility > 0).then(|| visibility_accumulated(&mut g, &guides, self));
        let open = self.ambient_occlusion.then(|| ambient_accumulated(&mut g, &guides));
        let mut surfaces = filter.map(|filter| filter(&mut g, &guides, self));
        if let Some(denoised) = &surfaces {
            outputs(&mut g, denoised);
            self.reactive_mask_of(&mut g, &guides, denoised);
        }
        if let Some(accumulated) = accumulated {
            let visibility = visibility(&mut g, &guides, &accumulated);
            let visibility = upsampled(&mut g, &guides, "visibility", &visibility);
            for (name, image) in OUTPUTS.iter().zip(visibility.images()) {
                g.output(name, &Visibility::of(*image));
            }
            surfaces = surfaces.map(|of| Denoised { radiance: g.shadowed_light(&of.radiance, &visibility), ..of });
        }
        if let Some(open) = open {
            let open = ambient(&mut g, &guides, &open);
            let open = upsampled(&mut g, &guides, "ambient", &open);
            g.output("denoised_ambient", &open);
        }
        let fog = self.has_volume().then(|| {
            let fog = volume(&mut g, &guides, self);
            g.output("denoised_volume", &fog.radiance);
            fog
        });
        let shown = surfaces.or(fog);
        let radiance = match (surfaces, fog) {
            (Some(surfaces), Some(fog)) => Some(g.pair(&surfaces.radiance, &fog.radiance)),
            _ => shown.map(|shown| shown.radiance),
        };
        if let Some(radiance) = radiance {
            post_process(&mut g, &guides, self.post_process, &radiance);
        }
        if let Some(shown) = shown.filter(|_| self.debug_view) {
            let view = g.debug_view(&guides, &Intermediates { visibility: accumulated, ..shown.intermediates });
            g.output("debug_view", &view);
        }
        Ok(g)
    }

    fn reactive_mask_of(&self, g: &mut Graph, guides: &Guides, denoised: &Denoised) {
        let Intermediates { history, confidence, .. } = denoised.intermediates;
        if let Some(history) = history.filter(|_| self.reactive_mask) {
            let mask = g.reactive_mask(guides, &denoised.radiance, &history, confidence);
            g.output("reactive_mask", &mask);
        }
    }

    /// Whether the preset accumulates surfaces: object-space normals and classes of materials serve that alone.
    fn has_surface_history(&self) -> bool {
        !matches!(self.preset, Preset::Eaw | Preset::Volume)
    }
}

/// The visibility of each light, of every rendered pixel.
fn upsampled(g: &mut Graph, guides: &Guides, scope: &str, visibility: &Visibility) -> Visibility {
    let image = |g: &mut Graph, image: &Image| g.upsample(guides, &Visibility::of(*image)).image();
    let images: Vec<Image> = g.scope(scope, |g| visibility.images().iter().map(|of_light| image(g, of_light)).collect());
    Visibility::of_images(&images).unwrap_or(*visibility)
}

/// The filter of surfaces of a preset; none for [`Preset::Volume`].
fn filter_of(preset: Preset) -> Option<fn(&mut Graph, &Guides, &Config) -> Denoised> {
    Some(match preset {
        Preset::Svgf => svgf,
        Preset::Percentile => percentile,
        Preset::Fast => fast,
        Preset::Eaw => eaw,
        Preset::Asvgf => asvgf,
        Preset::Best => best,
        Preset::Stabilize => stabilize,
        Preset::Volume => return None,
    })
}

/// Makes outputs of the results of a filter of surfaces.
fn outputs(g: &mut Graph, denoised: &Denoised) {
    g.output("denoised_radiance", &denoised.radiance);
    if let Some(confidence) = &denoised.intermediates.confidence {
        g.output("history_confidence", confidence);
    }
}

/// Your noisy radiance: `noisy_radiance`; `noisy_direct` and `noisy_indirect` as a pair; or
/// `noisy_diffuse`, beside which [`specular`] filters the rest.
pub fn noisy(g: &mut Graph, signals: Signals) -> Radiance {
    match signals {
        Signals::Together | Signals::Mixed => g.radiance("noisy_radiance"),
        Signals::Specular => g.radiance("noisy_diffuse"),
        Signals::Apart => {
            let (direct, indirect) = (g.radiance("noisy_direct"), g.radiance("noisy_indirect"));
            g.pair(&direct, &indirect)
        }
    }
}

/// The exposure of the filter, by all light that a configuration has the host give.
pub fn filter_exposure(g: &mut Graph, config: &Config) {
    let mut light = match config.preset {
        Preset::Volume => vec![],
        Preset::Stabilize => vec![g.radiance("other_denoised_radiance")],
        _ => vec![noisy(g, config.signals)],
    };
    if config.signals == Signals::Specular && !matches!(config.preset, Preset::Volume | Preset::Stabilize) {
        light.push(g.radiance("noisy_specular"));
    }
    if config.has_volume() {
        light.push(g.radiance("noisy_volume"));
    }
    g.filter_exposure(&light);
}

/// Brings the radiance to the size of the output, where the graph has one, and maps its tones into the output `display`, as
/// configured. Without a tone map the result is the output `upscaled_radiance`.
pub fn post_process(g: &mut Graph, guides: &Guides, post_process: PostProcess, radiance: &Radiance) {
    let upscales = g.has_output_extent();
    let tone_mapped = post_process != PostProcess::None;
    let radiance = match upscales || post_process == PostProcess::ToneMapTaa {
        true => g.temporal_upscale(guides, radiance, TemporalUpscale { tone_mapped }),
        false => *radiance,
    };
    if tone_mapped {
        let display = g.tone_map(&radiance);
        g.output("display", &display);
    } else if upscales {
        g.output("upscaled_radiance", &radiance);
    }
}

/// Takes outliers out before the history, where that is wanted.
fn firefly_filter(
    g: &mut Graph,
    guides: &Guides,
    irradiance: Irradiance,
    config: &Config,
    is_on: bool,
) -> (Irradiance, Option<Usual>) {
    if !is_on {
        return (irradiance, None);
    }
    let usual = usual_light(g, guides, &irradiance, config);
    (g.firefly(guides, &irradiance, &usual.limits), Some(usual))
}

/// The spatial filter of presets with a 3×3 box.
fn box_filter(config: &Config) -> Atrous {
    Atrous { levels: config.levels(), kernel: Kernel::Box, luminance_weight: LuminanceWeight::OfMeans, ..Atrous::default() }
}

/// Luminances above which light is an outlier. That of light that returns is none, where the preset has a history.
fn usual_light(g: &mut Graph, guides: &Guides, irradiance: &Irradiance, config: &Config) -> Usual {
    let percentiles = g.block_percentiles(guides, irradiance);
    let limits = match config.has_surface_history() {
        true => g.firefly_limits(guides, irradiance, &percentiles),
        false => g.firefly_limits_of_frame(irradiance, &percentiles),
    };
    Usual { percentiles, limits }
}
