//! Edge-avoiding à-trous wavelets [EAW]: one frame, no history.

use super::specular::{demodulated, modulate};
use super::{firefly_filter, noisy, Denoised};
use crate::config::Config;
use crate::graph::{Graph, Guides};
use crate::nodes::{Eaw, Intermediates, Modulate};

/// EAW: wavelet levels by radiance, normal and position, without history. \[EAW\]
///
/// It reads `signals`, `levels`, `eaw_weights`, `sampling` and `firefly_filter` of the configuration.
pub fn eaw(g: &mut Graph, guides: &Guides, config: &Config) -> Denoised {
    let &Config { eaw_weights: weights, sampling, .. } = config;
    let levels = config.levels();
    let noisy = noisy(g, config.signals);
    let (irradiance, reflected) = demodulated(g, guides, config, &noisy, None, None);
    let (irradiance, usual) = firefly_filter(g, guides, irradiance, config, config.firefly_filter);
    let filtered = g.eaw(guides, &irradiance, Eaw { levels, weights, sampling, ..Eaw::default() });
    let radiance = match &reflected {
        Some(reflected) => {
            let specular = g.eaw(guides, reflected, Eaw { levels, weights, sampling, ..Eaw::default() });
            let both = g.pair(&filtered, &specular);
            g.modulate(guides, &both, Modulate { specular: true, ..modulate(config) })
        }
        None => g.modulate(guides, &filtered, modulate(config)),
    };
    Denoised { radiance, intermediates: Intermediates { usual, ..Intermediates::new(&noisy) } }
}
