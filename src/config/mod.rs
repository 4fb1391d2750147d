//! What is decided once: extents, preset, signals, and how the host encodes its guides. Changing it re-declares every resource.

use crate::error::Error;

mod conventions;

pub use conventions::{
    Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, ViewForward,
};

/// Which lighting components are filtered.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Signals {
    /// One image, `noisy_radiance`: direct and indirect light together.
    #[default]
    Together,
    /// Two, `noisy_direct` and `noisy_indirect`, filtered apart with shared geometry weights, as \[SVGF\] does. Keeps shadow edges that the sum blurs.
    Apart,
}

/// What is done after the denoised radiance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PostProcess {
    /// Nothing: the host tone maps.
    #[default]
    None,
    /// Tone map into `display`.
    ToneMap,
    /// Tone map, then temporal anti-aliasing into `display`.
    ToneMapTaa,
}

/// Which filter: a list of nodes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// Spatiotemporal variance-guided filtering \[SVGF\].
    #[default]
    Svgf,
    /// Adaptive temporal filtering \[ASVGF\]: temporal gradients of re-shaded samples say where history is out of date.
    Asvgf,
    /// The same gradients drive a temporal accumulation over the output of any other denoiser \[ASVGF 4\]. One signal.
    Stabilize,
    /// Percentile-based adaptive SVGF \[PSVGF\]: statistics of blocks say where history is out of date. Needs nothing of the host that SVGF does not.
    Percentile,
    /// Edge-avoiding à-trous wavelets \[EAW\]: no history at all, so it works on a single frame. Has holes painted in where [`Config::sampling`] says so.
    Eaw,
    /// A volume alone, without surfaces to filter: `noisy_volume` to `denoised_volume` \[PSVGF\]. [`Config::volume`] adds the same passes to another preset.
    Volume,
}

/// The edge-stopping functions of [`Preset::Eaw`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EawWeights {
    /// By radiance.
    pub radiance: bool,
    /// By normal.
    pub normal: bool,
    /// By position.
    pub position: bool,
}

impl EawWeights {
    /// The first `count` of radiance, normal and position, as in Figure 4 and Table 2 of the paper; 0 is the plain wavelet.
    pub const fn first(count: u32) -> Self {
        Self { radiance: count >= 1, normal: count >= 2, position: count >= 3 }
    }
}

impl Default for EawWeights {
    fn default() -> Self {
        Self::first(3)
    }
}

/// How many pixels have a sample, for [`Preset::Eaw`]. A pixel without one is not finite (NaN) in the noisy image.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum Sampling {
    /// Every one. What is not finite is counted and black.
    #[default]
    Full = 0,
    /// One of 2×2; the first level paints in the others.
    OneOf2x2 = 1,
    /// One of 4×4; the first two levels paint in the others.
    OneOf4x4 = 2,
}

/// How [`Preset::Percentile`] finds out that light has changed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum AdaptiveRule {
    /// The mean difference between a frame and its history over 24×24 pixels, against its standard error. Sees a light that comes on as well as one
    /// that goes out.
    #[default]
    ChangeTest,
    /// As published: history outside of the percentiles of the noisy frame is dropped. At one sample a pixel the low percentile is next to 0, so
    /// that a light that comes on is not seen.
    Percentiles,
}

/// How the percentiles of a block are found. The result is the same to the bit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u32)]
pub enum BlockSort {
    /// Every pixel counts those before it: one barrier.
    #[default]
    Counting = 0,
    /// Odd-even transposition as published \[PSVGF\]: 64 rounds with a barrier each. For comparison.
    OddEven = 1,
}

/// Where the temporal gradients of [`Preset::Asvgf`] and [`Preset::Stabilize`] come from.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GradientSource {
    /// The host's path tracer re-shades one pixel a stratum with the surface and the seed of a pixel of the previous frame, which the stage
    /// `forward_project` picks (`glsl/host/gradient_sample.glsl`). Costs no extra samples.
    #[default]
    ForwardProjected,
    /// An image `reshaded_radiance`: the paths of the previous frame, traced again in the scene of this frame with the same random numbers, at
    /// the pixels of the previous frame. As dense as the host likes; pixels that it leaves out are NaN.
    Reshaded,
    /// An image `sparse_gradient` with one texel a stratum, of a host that takes the differences itself: x the change of luminance δ, y the
    /// larger of the two luminances Δ. 0, 0 where there is none.
    Sparse,
    /// An image `confidence` with one texel a pixel, of a host that knows what changed: x from 1, keep the history, to 0, drop it.
    Confidence,
}

/// What is decided once. [`crate::Tuning`] holds what may change from frame to frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Config {
    /// Width and height that images are allocated with; each frame renders into its top left part.
    pub allocated_extent: [u32; 2],
    /// Frames that the host records before it waits for the oldest, 1 to 8. Default: 2.
    pub frames_in_flight: u32,
    /// Filter.
    pub preset: Preset,
    /// Signals.
    pub signals: Signals,
    /// À-trous levels, 1 to 10. Default: 5, a footprint of 65×65 pixels with the 5×5 kernel.
    pub levels: u32,
    /// Whether the host has a volume (fog, smoke), whose radiance is filtered apart, with motion of its own \[PSVGF\]: an input `noisy_volume`, an output
    /// `denoised_volume`. It is what the medium itself scatters towards the camera; the surfaces' radiance is what reaches the camera through it. The
    /// two add up to the picture, and the post-process has their sum. Costs 40 bytes a pixel, and 8 of the output. Default: false.
    ///
    /// The optional input `scattering_depth` says where: for every pixel the linear depth (scene units, along the view axis, as `guide` has it) of one
    /// point that contributes much, as a distance that was chosen by transmittance does. 0, infinite or NaN: none. It is carried to the next frame to
    /// give the volume its motion; without the input a volume moves as the surfaces behind it.
    pub volume: bool,
    /// Scales outliers of the input down to what is usual around them, before they reach the history \[PSVGF\]. [`Preset::Percentile`] always does.
    /// Default: false.
    pub firefly_filter: bool,
    /// How the preset `Percentile` sees changed light.
    pub adaptive_rule: AdaptiveRule,
    /// How percentiles are found.
    pub block_sort: BlockSort,
    /// Side of the strata of temporal gradients, 2 to 4 pixels. Default: 3 \[ASVGF\]. Only for presets with gradients.
    pub stratum_size: u32,
    /// Where the temporal gradients come from. Only for presets with gradients.
    pub gradient_source: GradientSource,
    /// Whether the host has an image `forward_motion`, for surfaces that deform: at every pixel of the previous frame its motion to this frame.
    /// Only for forward-projected gradients. Default: false.
    pub forward_motion: bool,
    /// Edge-stopping functions of the preset `Eaw`. Default: all three.
    pub eaw_weights: EawWeights,
    /// Whether the input of the preset `Eaw` has holes.
    pub sampling: Sampling,
    /// Whether the host has an image of surface ids. Default: true.
    pub surface_id: bool,
    /// Whether the host has object-space normals, by which a turning object keeps its history. Costs 8 bytes a pixel. Default: false.
    pub object_normal: bool,
    /// Post-process.
    pub post_process: PostProcess,
    /// A last pass `debug_view`, which shows what the denoiser knows of each pixel: see [`crate::DebugView`]. It keeps what it shows until then, which
    /// transients cannot share memory with. A host may leave the pass out of a frame. Default: false.
    pub debug_view: bool,
    /// Encodings.
    pub conventions: Conventions,
}

impl Config {
    /// Largest side of an extent.
    pub const MAX_SIDE: u32 = 16384;

    /// Defaults for an extent.
    pub fn new(allocated_extent: [u32; 2]) -> Self {
        Self {
            allocated_extent,
            frames_in_flight: 2,
            preset: Preset::default(),
            signals: Signals::default(),
            levels: 5,
            volume: false,
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

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::Extent`] or [`Error::Config`] for the first field that is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        check_extent("Config::allocated_extent", self.allocated_extent)?;
        let ranges = [
            ("frames_in_flight", self.frames_in_flight, 1, 8),
            ("levels", self.levels, 1, 10),
            ("stratum_size", self.stratum_size, 2, 4),
        ];
        for (name, given, min, max) in ranges {
            if !(min..=max).contains(&given) {
                return Err(Error::Config { name, given, min, max });
            }
        }
        Ok(())
    }

    /// Whether a volume is filtered.
    pub(crate) fn has_volume(&self) -> bool {
        self.volume || self.preset == Preset::Volume
    }

    /// Whether any pass reads what the previous frame left.
    pub(crate) fn has_history(&self) -> bool {
        self.has_volume() || self.preset != Preset::Eaw
    }

    /// Whether the host's path tracer has to re-shade the pixels that `forward_project` picks.
    pub(crate) fn reshades(&self) -> bool {
        matches!(self.preset, Preset::Asvgf | Preset::Stabilize) && self.gradient_source == GradientSource::ForwardProjected
    }
}

pub(crate) fn check_extent(what: &'static str, given: [u32; 2]) -> Result<(), Error> {
    if given.iter().any(|side| !(1..=Config::MAX_SIDE).contains(side)) {
        return Err(Error::Extent { what, given, max: Config::MAX_SIDE });
    }
    Ok(())
}
