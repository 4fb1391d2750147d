//! The history of the light of surfaces, along their motion alone or along that of reflections, too.

use crate::config::{Config, Signals};
use crate::graph::{Accumulated, Feedback, Graph, Guides, History, Irradiance, Reflection};
use crate::nodes::{Accumulation, SpecularAccumulation, SpecularHistory};

/// Made before the nodes that read the previous frame.
pub(super) struct Past {
    pub history: History,
    /// With [`Signals::Mixed`].
    mixed: Option<SpecularHistory>,
}

impl Past {
    pub(super) fn new(g: &mut Graph, config: &Config, irradiance: &Irradiance, feedback: Feedback) -> Self {
        let mixed = (config.signals == Signals::Mixed).then(|| g.specular_history(irradiance, feedback));
        let history = mixed.map_or_else(|| g.history(irradiance, feedback), |mixed| mixed.history);
        Self { history, mixed }
    }

    /// The light with its past, and with [`Signals::Mixed`] the reflections in surfaces.
    pub(super) fn accumulated(
        &self,
        g: &mut Graph,
        guides: &Guides,
        irradiance: &Irradiance,
        accumulation: Accumulation,
    ) -> (Accumulated, Option<Reflection>) {
        let Some(mixed) = &self.mixed else {
            return (g.temporal_accumulation(guides, irradiance, &self.history, accumulation), None);
        };
        let Accumulation { confidence, sharp, alpha, alpha_moments, .. } = accumulation;
        let parameters = SpecularAccumulation { confidence, sharp, alpha, alpha_moments, mixed: true };
        let found = g.specular_accumulation(guides, irradiance, mixed, parameters);
        (found.accumulated, Some(found.reflection))
    }
}
