//! The history of the light of surfaces, along their motion alone or along that of reflections, too.

use super::specular::{estimated, Reflected, Specular, SpecularEstimate};
use crate::config::{Config, Signals};
use crate::graph::{Accumulated, Difference, Estimate, Feedback, Graph, Guides, History, Irradiance, Port, Reflection};
use crate::nodes::{Accumulation, SpecularAccumulation, SpecularHistory, Usual};

/// Made before the nodes that read the previous frame.
pub(super) struct Past {
    pub history: History,
    /// With [`Signals::Mixed`].
    mixed: Option<SpecularHistory>,
    /// With [`Signals::Specular`].
    pub reflected: Option<Reflected>,
}

/// Light without outliers, and its departure from its history.
pub(super) struct Compared {
    pub irradiance: Irradiance,
    pub difference: Difference,
    pub usual: Option<Usual>,
}

/// Light with its past and its deviation, before the spatial filter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Estimated {
    pub estimate: Estimate,
    /// That of specular light is apart.
    pub history: History,
    pub specular: Option<SpecularEstimate>,
    mixed: Option<Reflection>,
}

impl Estimated {
    /// Reflections in surfaces, if the light has any.
    pub(super) fn reflection(&self) -> Option<Reflection> {
        self.specular.map(|specular| specular.reflection).or(self.mixed)
    }
}

impl Past {
    pub(super) fn new(
        g: &mut Graph,
        config: &Config,
        irradiance: &Irradiance,
        reflected: Option<Irradiance>,
        feedback: Feedback,
    ) -> Self {
        let mixed = (config.signals == Signals::Mixed).then(|| g.specular_history(irradiance, feedback));
        let history = mixed.map_or_else(|| g.history(irradiance, feedback), |mixed| mixed.history);
        let reflected = reflected.map(|irradiance| Reflected::new(g, irradiance, feedback));
        Self { history, mixed, reflected }
    }

    /// The firefly filter, if it is on, and the departure of what it leaves from the history, in the same pass; that of specular light, too.
    pub(super) fn compared(&mut self, g: &mut Graph, guides: &Guides, irradiance: Irradiance, filters_fireflies: bool) -> Compared {
        let history = &self.history;
        if !filters_fireflies {
            return Compared { irradiance, difference: g.block_difference(guides, &irradiance, history), usual: None };
        }
        let both = match &self.reflected {
            Some(reflected) => g.pair(&irradiance, &reflected.irradiance),
            None => irradiance,
        };
        let mut percentiles = g.block_percentiles(guides, &both);
        if let (Some(reflected), &[diffuse, specular]) = (&mut self.reflected, percentiles.images()) {
            let Reflected { irradiance, history, difference } = reflected;
            let (filtered, compared, _) = g.firefly_and_difference(guides, irradiance, &Port::of(specular), &history.history, true);
            (*irradiance, *difference, percentiles) = (filtered, Some(compared), Port::of(diffuse));
        }
        let (irradiance, difference, limits) = g.firefly_and_difference(guides, &irradiance, &percentiles, history, false);
        Compared { irradiance, difference, usual: Some(Usual { percentiles, limits }) }
    }

    /// The light with its past, specular light by the parameters of `specular`, which has the estimator of both.
    pub(super) fn estimated(
        &self,
        g: &mut Graph,
        guides: &Guides,
        config: &Config,
        irradiance: &Irradiance,
        accumulation: Accumulation,
        specular: Specular,
    ) -> Estimated {
        let (accumulated, mixed) = self.accumulated(g, guides, irradiance, accumulation);
        let estimate = g.variance(guides, &accumulated, &self.history, specular.variance);
        let specular = self.reflected.map(|reflected| estimated(g, guides, config, &reflected, specular));
        Estimated { estimate, history: self.history, specular, mixed }
    }

    /// With [`Signals::Mixed`] also the reflections in surfaces.
    fn accumulated(
        &self,
        g: &mut Graph,
        guides: &Guides,
        irradiance: &Irradiance,
        accumulation: Accumulation,
    ) -> (Accumulated, Option<Reflection>) {
        let Some(mixed) = &self.mixed else {
            return (g.temporal_accumulation(guides, irradiance, &self.history, accumulation), None);
        };
        let Accumulation { confidence, sharp, alpha, alpha_moments, light_ratio, .. } = accumulation;
        let parameters = SpecularAccumulation { confidence, sharp, alpha, alpha_moments, mixed: true, light_ratio };
        let found = g.specular_accumulation(guides, irradiance, mixed, parameters);
        (found.accumulated, Some(found.reflection))
    }
}
