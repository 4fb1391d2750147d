//! The points: every preset for surfaces as it is, and `best` and `fast` with other spatial filters.

use atrous::config::Preset;
use atrous::nodes::{Atrous, Kernel, LuminanceWeight};
use atrous::presets::{self, Best};
use atrous::{Config, Declaration, Error, Tuning};

/// A spatial filter: what a point changes of a preset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Spatial {
    pub kernel: Kernel,
    pub levels: u32,
}

/// A point.
#[derive(Clone, Debug)]
pub struct Filter {
    pub name: String,
    /// The preset that it is, or that it was made of.
    pub preset: Preset,
    /// `None`: the preset as it is.
    spatial: Option<Spatial>,
}

/// What the presets have that are varied.
const OWN: [(Preset, Spatial); 2] =
    [(Preset::Best, Spatial { kernel: Kernel::Box, levels: 5 }), (Preset::Fast, Spatial { kernel: Kernel::Box, levels: 5 })];

const PRESETS: [Preset; 5] = [Preset::Svgf, Preset::Asvgf, Preset::Percentile, Preset::Fast, Preset::Best];

pub fn all() -> Vec<Filter> {
    let preset = |preset: Preset| Filter { name: preset.name().to_owned(), preset, spatial: None };
    let mut all: Vec<_> = PRESETS.map(preset).into();
    for (preset, own) in OWN {
        for (kernel, taps) in [(Kernel::Spline, 25), (Kernel::Box, 9)] {
            for levels in 3..=5 {
                let spatial = Spatial { kernel, levels };
                let name = format!("{preset} {taps}×{levels}");
                all.extend((spatial != own).then_some(Filter { name, preset, spatial: Some(spatial) }));
            }
        }
    }
    all
}

impl Filter {
    pub fn tuning(&self) -> Tuning {
        Tuning::for_preset(self.preset)
    }

    /// The graph for a host that a configuration describes.
    pub fn declare(&self, host: &Config) -> Result<Declaration, Error> {
        let config = Config { preset: self.preset, levels: None, ..*host };
        match self.spatial {
            Some(spatial) => varied(&config, spatial),
            None => config.declare(),
        }
    }
}

/// [`presets::best`] or [`presets::fast`], with another spatial filter.
fn varied(config: &Config, spatial: Spatial) -> Result<Declaration, Error> {
    let Spatial { kernel, levels } = spatial;
    let varied = |atrous: Atrous| Atrous { kernel, levels, ..atrous };
    let graph = config.graph_with(|g, guides, config| match config.preset {
        Preset::Best => {
            let best = Best::new(config);
            presets::best_with(g, guides, config, Best { spatial: varied(best.spatial), ..best })
        }
        _ => {
            let spatial = Atrous { luminance_weight: LuminanceWeight::OfMeans, ..Atrous::default() };
            presets::fast_with(g, guides, config, varied(spatial))
        }
    });
    graph?.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// So that a change of a preset's own filter is not forgotten here.
    #[test]
    fn what_a_preset_has_gives_the_passes_of_the_preset() {
        for (preset, own) in OWN {
            let config = Config { preset, ..Config::new([64, 36]) };
            let passes = |declaration: Declaration| format!("{:?} {:?}", declaration.passes(), declaration.resources());
            let [varied, whole] = [varied(&config, own), config.declare()].map(|declared| passes(declared.expect("a graph")));
            assert_eq!(varied, whole, "{preset}");
            let other = Spatial { levels: 3, ..own };
            assert_ne!(passes(super::varied(&config, other).expect("a graph")), whole, "{preset}");
        }
    }
}
