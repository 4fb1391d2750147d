//! Views of the stage `debug_view`.

use super::Declaration;
use crate::choice::choices;

choices! {
    /// A view of `debug_view`, for [`crate::Config::debug_view`]. rgb of the output is
    /// display-referred, linear, 0 to 1; a is the number behind the colour. Surfaces only: the
    /// background is black. A view without data in the preset is a dark chequer.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum DebugView {
        /// Frames accumulated, 0 to 32 in false colours.
        #[default]
        HistoryLength = 0 => "history_length",
        /// Standard deviation of luminance that guides the filter (after its first level), x/(0.25 + x) in false colours.
        Deviation = 1 => "deviation",
        /// Mean of luminance over the history in red, its standard deviation in green, both x/(1 + x). a: the mean.
        MeanAndDeviation = 2 => "mean_and_deviation",
        /// Change of luminance of the re-shaded samples δ, against the larger luminance Δ: red is brighter than before, blue
        /// darker. a: δ.
        Gradient = 3 => "gradient",
        /// λ, how far light changed: 0 (history is kept) to 1 (dropped).
        Lambda = 4 => "lambda",
        /// Weight of the new sample in the accumulated irradiance, 0 to 1.
        Alpha = 5 => "alpha",
        /// Low percentile of the first signal's luminance in red, upper one in green, upper one of the second signal in blue; x/(1
        /// + x). a: the upper one.
        Percentiles = 6 => "percentiles",
        /// Share of the luminance that the firefly filter took away, 0 to 1.
        Fireflies = 7 => "fireflies",
        /// The reason for a missing history. Grey: it is there. Orange: off screen; light blue:
        /// background or a different id; green: depth; yellow: normal; red: reset. a: a
        /// [`crate::reference::Reason`] as a number.
        Disocclusion = 8 => "disocclusion",
        /// Motion: red to the right, green downwards, less blue the longer, logarithmic up to 64 pixels. a: its length, pixels.
        Motion = 9 => "motion",
        /// World-space normal, n·0.5 + 0.5. a: 0.
        Normal = 10 => "normal",
        /// Linear depth, x/(1 + x) in false colours. a: scene units.
        Depth = 11 => "depth",
        /// A colour for every surface id as the filters see it (8 bits). a: the id.
        SurfaceId = 12 => "surface_id",
        /// Values of this frame that were not finite: one bar each, from the top, for depth, normal, motion, radiance, albedo,
        /// emission, forward motion, scattering depth, roughness, hit distance, visibility, distance of the occluder; the logarithm of
        /// their number against that of all pixels. a: the number.
        BadValues = 13 => "bad_values",
        /// Hit distance d of the reflection in a surface, as the filter of specular light has it: d
        /// over the way from the eye in false colours, so that contact is dark; black if unknown.
        /// a: scene units; 65504 beyond the scene.
        HitDistance = 14 => "hit_distance",
        /// Half the angle of the lobe of a surface, 0 to 45 degrees in false colours. a: degrees.
        LobeAngle = 15 => "lobe_angle",
        /// Motion of the image behind a mirroring surface, coloured as [`Self::Motion`]. It is the
        /// motion of the surface where nothing is known of the image. a: its length, pixels.
        VirtualMotion = 16 => "virtual_motion",
        /// The past that specular light was blended with: orange from the surface, blue from the
        /// image behind it, mixed by their shares; red: none. a: the share of the image, 0 to 1, or
        /// −1.
        ReflectionHistory = 17 => "reflection_history",
        /// Visibility of the light over its history, before the filter, 0 to 1 in false colours. a: the same.
        Visibility = 18 => "visibility",
        /// Radius of the penumbra that a shadow has at a pixel, 0 to 16 pixels in false colours; black where no occluder was found.
        /// a: pixels of a surface that faces the camera.
        Penumbra = 19 => "penumbra",
    }
}

impl DebugView {
    /// The binding of the shader without which there is nothing to show, as `NEEDED` in `glsl/debug_view.comp`.
    const fn needs(self) -> Option<&'static str> {
        match self {
            Self::HistoryLength | Self::MeanAndDeviation | Self::Alpha | Self::Disocclusion => Some("luminance_history_0"),
            Self::Percentiles => Some("block_percentiles_0"),
            Self::Fireflies => Some("firefly_limits_0"),
            Self::Deviation => Some("history_0"),
            Self::Lambda => Some("history_confidence"),
            Self::Gradient => Some("gradient"),
            Self::Motion => Some("surface_motion"),
            Self::HitDistance | Self::LobeAngle | Self::VirtualMotion | Self::ReflectionHistory => Some("reflection"),
            Self::Visibility | Self::Penumbra => Some("visibility_history"),
            Self::Normal | Self::Depth | Self::SurfaceId | Self::BadValues => None,
        }
    }
}

impl Declaration {
    /// The views that this denoiser has data for; none without [`crate::Config::debug_view`].
    pub fn debug_views(&self) -> Vec<DebugView> {
        let Some(pass) = self.passes.iter().find(|pass| pass.draws_view()) else { return Vec::new() };
        let shows = |view: &DebugView| view.needs().is_none_or(|binding| pass.use_of(binding).is_some());
        DebugView::ALL.into_iter().filter(shows).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::{Config, Preset, Signals};

    #[test]
    fn a_preset_shows_what_it_has() {
        let views = |preset| Config { preset, debug_view: true, ..Config::new([16, 16]) }.declare().expect("valid").debug_views();
        let guides = [DebugView::Motion, DebugView::Normal, DebugView::Depth, DebugView::SurfaceId, DebugView::BadValues];
        assert_eq!(views(Preset::Eaw), guides);
        assert!(!views(Preset::Svgf).contains(&DebugView::Lambda) && views(Preset::Svgf).contains(&DebugView::Deviation));
        assert!(views(Preset::Asvgf).contains(&DebugView::Gradient) && !views(Preset::Asvgf).contains(&DebugView::Fireflies));
        assert!(
            views(Preset::Percentile).contains(&DebugView::Fireflies) && !views(Preset::Percentile).contains(&DebugView::Gradient)
        );
        assert!(!views(Preset::Stabilize).contains(&DebugView::Deviation) && views(Preset::Stabilize).contains(&DebugView::Alpha));
        let config = Config { signals: Signals::Specular, debug_view: true, ..Config::new([16, 16]) };
        let specular = config.declare().expect("valid").debug_views();
        for view in [DebugView::LobeAngle, DebugView::VirtualMotion, DebugView::ReflectionHistory] {
            assert!(specular.contains(&view) && !views(Preset::Svgf).contains(&view), "{view}");
        }
        let visibility = Config { visibility: 1, debug_view: true, ..Config::new([16, 16]) }.declare().expect("valid");
        for view in [DebugView::Visibility, DebugView::Penumbra] {
            assert!(visibility.debug_views().contains(&view) && !specular.contains(&view), "{view}");
        }
        assert_eq!(Config::new([16, 16]).declare().expect("valid").debug_views(), []);
    }
}
