//! The configuration of a preset: extents, preset, signals, and the encodings of your guides.
//! Changing it re-declares every resource.

use crate::error::Error;

mod choices;
mod conventions;
mod eaw_weights;
#[cfg(feature = "serde")]
mod serde_forms;
#[cfg(all(test, feature = "serde"))]
mod serde_tests;

pub use choices::{AdaptiveRule, BlockSort, GradientSource, PostProcess, Preset, Sampling, Signals};
pub use conventions::{
    Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, RoughnessEncoding,
    ViewForward,
};
pub use eaw_weights::EawWeights;

/// Choices that you make once for a preset. Numbers that may change from frame to frame are in
/// [`crate::Tuning`].
///
/// With the feature `serde`, a field that a file leaves out has its default. The extent has none:
/// [`Config::validate`] refuses a file without one until you set it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default = "Config::without_extent", deny_unknown_fields))]
pub struct Config {
    /// Width and height of the allocated images, 1 to [`Config::MAX_SIDE`] each; a frame renders
    /// into their top left part. No default.
    pub allocated_extent: [u32; 2],
    /// Frames that you record before you wait for the oldest, 1 to 8. Default: 2.
    pub frames_in_flight: u32,
    /// Filter. Default: [`Preset::Best`].
    pub preset: Preset,
    /// Signals. Default: [`Signals::Together`].
    pub signals: Signals,
    /// À-trous levels, 1 to 10. Default: none, which is the preset's number, [`Preset::levels`].
    pub levels: Option<u32>,
    /// Whether you have a volume (fog, smoke), to be filtered apart, with motion of its own
    /// \[PSVGF\]: an input `noisy_volume`, an output `denoised_volume`. It is the light that the
    /// medium itself scatters towards the camera; the radiance of surfaces is the light that
    /// reaches the camera through it. The two add up to the picture, and the post-process shows
    /// their sum. Costs 40 bytes per pixel, and 8 of the output. Default: false.
    ///
    /// The optional input `scattering_depth` locates it: for every pixel the linear depth (scene
    /// units, along the view axis, as in `guide`) of one point that contributes much, for example a
    /// distance chosen by transmittance. 0, infinite or NaN: none. It is carried to the next frame
    /// to give the volume its motion; without the input a volume moves as the surfaces behind it.
    pub volume: bool,
    /// Whether you give the visibility of one light, such as the sun, apart: an input
    /// `noisy_visibility` from 0 (occluded) to 1 (lit), usually one of the two, with
    /// `occluder_distance`, the distance from the surface to the occluder along the shadow ray
    /// (scene units; 0 or infinite: none, or not known); an output `denoised_visibility`. The
    /// light's size is [`crate::Tuning::light_radius`]. Costs 12 bytes per pixel, the output
    /// included. Default: false.
    ///
    /// Multiply your light by it. Or give the optional input `unshadowed_direct`, the light that
    /// the surface would reflect without an occluder, times albedo and BSDF; `denoised_radiance`
    /// then contains the product. Either way, leave that light out of the noisy radiance.
    pub visibility: bool,
    /// Scales outliers of the input down to the usual brightness around them, before they reach the
    /// history \[PSVGF\]. [`Preset::Percentile`] always does. Default: false.
    pub firefly_filter: bool,
    /// The rule by which the preset `Percentile` detects changes of light. Default:
    /// [`AdaptiveRule::ChangeTest`].
    pub adaptive_rule: AdaptiveRule,
    /// The method that finds percentiles. Default: [`BlockSort::Counting`].
    pub block_sort: BlockSort,
    /// Side of the strata of temporal gradients, 2 to 4 pixels. Default: 3 \[ASVGF\]. Only for presets with gradients.
    pub stratum_size: u32,
    /// Source of the temporal gradients. Only for presets with gradients. Default: [`GradientSource::ForwardProjected`].
    pub gradient_source: GradientSource,
    /// Whether you have an image `forward_motion`, for deforming surfaces: at every pixel of the
    /// previous frame its motion to this frame. Only for forward-projected gradients. Default:
    /// false.
    pub forward_motion: bool,
    /// Edge-stopping functions of the preset `Eaw`. Default: all three.
    pub eaw_weights: EawWeights,
    /// Share of the pixels that have a sample in this frame, for checkerboards and tracing at half
    /// the rate: the others are NaN in the noisy images. Costs 8 bytes per pixel and signal until
    /// history is read, and one pass per signal. Not of [`Preset::Stabilize`] and of volumes, whose
    /// pixels all have one. Default: [`Sampling::Full`].
    pub sampling: Sampling,
    /// Whether you have an image of surface ids. Default: true.
    pub surface_id: bool,
    /// Whether you have object-space normals, by which a turning object keeps its history. Costs 8
    /// bytes per pixel. Default: false.
    pub object_normal: bool,
    /// Post-process. Default: [`PostProcess::None`].
    pub post_process: PostProcess,
    /// A last pass `debug_view`, which shows the state of each pixel: see [`crate::DebugView`]. It
    /// keeps the shown images alive to the end, so that transients cannot share their memory. You
    /// may leave the pass out of a frame. Default: false.
    pub debug_view: bool,
    /// Encodings. Default: those of [`Conventions::default`].
    pub conventions: Conventions,
}

impl Config {
    /// Largest side of an extent.
    pub const MAX_SIDE: u32 = 16384;

    /// The defaults, for an extent.
    pub fn new(allocated_extent: [u32; 2]) -> Self {
        Self {
            allocated_extent,
            frames_in_flight: 2,
            preset: Preset::default(),
            signals: Signals::default(),
            levels: None,
            volume: false,
            visibility: false,
            firefly_filter: false,
            adaptive_rule: AdaptiveRule::default(),
            block_sort: BlockSort::default(),
            eaw_weights: EawWeights::default(),
            sampling: Sampling::default(),
            stratum_size: 3,
            gradient_source: GradientSource::default(),
            forward_motion: false,
            surface_id: true,
            object_normal: false,
            post_process: PostProcess::default(),
            debug_view: false,
            conventions: Conventions::default(),
        }
    }

    /// The configuration that a file starts from.
    #[cfg(feature = "serde")]
    fn without_extent() -> Self {
        Self::new([0; 2])
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::Extent`], [`Error::Config`] or [`Error::Conventions`] for the first field that is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        check_extent("Config::allocated_extent", self.allocated_extent)?;
        let ranges = [
            ("frames_in_flight", self.frames_in_flight, 1, 8),
            ("levels", self.levels(), 1, 10),
            ("stratum_size", self.stratum_size, 2, 4),
        ];
        for (name, given, min, max) in ranges {
            if !(min..=max).contains(&given) {
                return Err(Error::Config { name, given, min, max });
            }
        }
        self.conventions.validate()
    }

    /// À-trous levels: those of the configuration, or those of the preset for the allocated extent.
    pub fn levels(&self) -> u32 {
        self.levels.unwrap_or(self.preset.levels(self.allocated_extent))
    }

    /// Whether a volume is filtered.
    pub(crate) fn has_volume(&self) -> bool {
        self.volume || self.preset == Preset::Volume
    }
}

pub(crate) fn check_extent(what: &'static str, given: [u32; 2]) -> Result<(), Error> {
    if given.iter().any(|side| !(1..=Config::MAX_SIDE).contains(side)) {
        return Err(Error::Extent { what, given, max: Config::MAX_SIDE });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_footprint_of_the_filter_grows_with_the_picture() {
        let levels = |preset, extent| Config { preset, ..Config::new(extent) }.levels();
        let sizes = [[320, 180], [640, 360], [1280, 720], [720, 1280], [1920, 1080], [3840, 2160]];
        for preset in [Preset::Best, Preset::Fast] {
            assert_eq!(sizes.map(|size| levels(preset, size)), [4, 5, 6, 6, 6, 7], "{preset}");
        }
        assert_eq!(sizes.map(|size| levels(Preset::Svgf, size)), [5; 6]);
        assert_eq!(Config { levels: Some(3), ..Config::new([1280, 720]) }.levels(), 3);
    }

    #[test]
    fn levels_are_those_of_the_preset_unless_a_number_is_asked_for() {
        let levels = |preset: Preset, levels: Option<u32>| {
            let declaration = Config { preset, levels, ..Config::new([64, 36]) }.declare().expect("a graph");
            let is_level = |name: &str| name.strip_prefix("atrous_").is_some_and(|level| level.parse::<u32>().is_ok());
            declaration.passes().iter().filter(|pass| is_level(&pass.name)).count()
        };
        assert_eq!([Preset::Svgf, Preset::Best, Preset::Fast].map(|preset| levels(preset, None)), [5, 4, 4]);
        assert_eq!((levels(Preset::Svgf, Some(4)), levels(Preset::Best, Some(5))), (4, 5));
        for given in [0, 11] {
            let error = Config { levels: Some(given), ..Config::new([64, 36]) }.declare().expect_err("out of range");
            assert!(matches!(error, Error::Config { name: "levels", given: g, min: 1, max: 10 } if g == given), "{error}");
        }
    }
}
