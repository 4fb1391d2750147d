//! Choices of a configuration: preset, signals, post-process and the variants of single stages.

use crate::choice::choices;

choices! {
    /// Lighting components that are filtered.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Signals {
        /// One image, `noisy_radiance`: direct and indirect light together.
        #[default]
        Together = 0 => "together",
        /// Two, `noisy_direct` and `noisy_indirect`, filtered apart with shared geometry weights, as \[SVGF\] does. Keeps shadow
        /// edges that the sum blurs.
        Apart = 1 => "apart",
        /// Two, `noisy_diffuse` and `noisy_specular`, each with an albedo of its own. What is seen in glossy surfaces is followed where
        /// it moves, behind the surface, by the input `specular_hit_distance`, and filtered as far as the `roughness` blurs it.
        Specular = 2 => "specular",
        /// One image, `noisy_radiance`, with the `roughness` of surfaces: for engines that give diffuse and specular light together.
        /// Smooth surfaces are filtered no wider than they blur, and the light of each frame tells whether it moves as the surface does
        /// or as its reflection. Needs `roughness`.
        Mixed = 3 => "mixed",
    }

    /// Passes behind the denoised radiance.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum PostProcess {
        /// None: you do the tone mapping.
        #[default]
        None = 0 => "none",
        /// Tone map into `display`.
        ToneMap = 1 => "tone_map",
        /// Temporal anti-aliasing, then tone map into `display`.
        ToneMapTaa = 2 => "tone_map_taa",
    }

    /// The filter: a list of nodes.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Preset {
        /// Spatiotemporal variance-guided filtering \[SVGF\].
        Svgf = 0 => "svgf",
        /// Adaptive temporal filtering \[ASVGF\]: temporal gradients of re-shaded samples detect
        /// outdated history.
        Asvgf = 1 => "asvgf",
        /// Drives a temporal accumulation over the output of any other denoiser by the gradients of [`Preset::Asvgf`] \[ASVGF 4\].
        /// One signal.
        Stabilize = 2 => "stabilize",
        /// Percentile-based adaptive SVGF \[PSVGF\]: statistics of blocks detect outdated history.
        /// Needs no input beyond those of SVGF.
        Percentile = 3 => "percentile",
        /// Edge-avoiding à-trous wavelets \[EAW\]. It has no history, so it works on a single
        /// frame.
        Eaw = 4 => "eaw",
        /// A volume alone, without surfaces to filter: `noisy_volume` to `denoised_volume`
        /// \[PSVGF\]. [`crate::Config::volume`] adds the same passes to any other preset.
        Volume = 5 => "volume",
        /// The cheapest filter that follows changing light: SVGF with 4 levels of 9 taps and the
        /// change test of [`Preset::Percentile`]. Needs no input beyond those of SVGF.
        Fast = 6 => "fast",
        /// The filter to start with: [`Preset::Asvgf`] whose history follows changing light, is not
        /// filtered, and stays sharp in motion. Where no gradient is known it has the change test
        /// of [`Preset::Percentile`], so it needs no input beyond those of SVGF.
        #[default]
        Best = 7 => "best",
    }

    /// Share of the pixels that have a sample in a frame. Write NaN into the noisy image for a
    /// pixel without one: it shows its own history, or the samples around it if it has none. Give
    /// each pixel its turn from frame to frame.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum Sampling {
        /// Every one. A value that is not finite is counted, and black in this frame.
        #[default]
        Full = 0 => "full",
        /// At least one of each 2×2, for example a checkerboard: holes look one pixel to each side.
        /// [`Preset::Eaw`]: the first level fills the others.
        OneOf2x2 = 1 => "one_of_2x2",
        /// At least one of each 4×4: holes look three pixels to each side. [`Preset::Eaw`]: the
        /// first two levels fill the others.
        OneOf4x4 = 2 => "one_of_4x4",
    }

    /// The rule by which [`Preset::Percentile`] detects changes of light.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum AdaptiveRule {
        /// The mean difference between a frame and its history over 24×24 pixels, against its
        /// standard error. It detects a light that comes on as well as one that goes out.
        #[default]
        ChangeTest = 0 => "change_test",
        /// The published rule: history outside the percentiles of the noisy frame is dropped. With
        /// one sample per pixel the low percentile is close to 0, so a light that comes on is not
        /// detected.
        Percentiles = 1 => "percentiles",
    }

    /// Source of the knowledge that light changed, for [`Preset::Best`], [`Preset::Asvgf`] and [`Preset::Stabilize`].
    #[derive(Default)]
    #[non_exhaustive]
    pub enum GradientSource {
        /// Your path tracer re-shades one pixel per stratum with the surface and the seed of a
        /// pixel of the previous frame, which the stage `forward_project` picks
        /// (`glsl/host/gradient_sample.glsl`). Costs no extra samples.
        #[default]
        ForwardProjected = 0 => "forward_projected",
        /// An image `reshaded_radiance`: the paths of the previous frame, traced again in the scene
        /// of this frame with the same random numbers, at the pixels of the previous frame. As
        /// dense as you like; write NaN into the pixels that you leave out. A thing that moves by itself
        /// takes no part, since the paths see what is behind it.
        Reshaded = 1 => "reshaded",
        /// An image `sparse_gradient` with one texel per stratum, if you take the differences
        /// yourself: x the change of luminance δ, y the larger of the two luminances Δ. 0, 0 where
        /// there is none.
        Sparse = 2 => "sparse",
        /// An image `confidence` with one texel per pixel, if your engine knows the changes: x from
        /// 1, keep the history, to 0, drop it.
        Confidence = 3 => "confidence",
        /// None: you shade nothing again. Light is compared with its own history by blocks of pixels, as
        /// [`Preset::Fast`] does. There are no passes of gradients.
        ChangeTest = 4 => "change_test",
    }
}

impl Preset {
    /// Whether it asks for the source of changes of light, by [`crate::Config::gradient_source`].
    pub const fn has_gradients(self) -> bool {
        matches!(self, Self::Asvgf | Self::Stabilize | Self::Best)
    }

    /// À-trous levels for images of an extent, unless the configuration sets a number: 5. Those of
    /// [`Self::Fast`] and [`Self::Best`] grow with the picture: 6 from 720 pixels on the shorter side,
    /// for example at 1280×720, and 7 from 1440.
    pub const fn levels(self, extent: [u32; 2]) -> u32 {
        let shorter = if extent[0] < extent[1] { extent[0] } else { extent[1] };
        match (self, shorter) {
            (Self::Best | Self::Fast, 0..720) => 5,
            (Self::Best | Self::Fast, 720..1440) => 6,
            (Self::Best | Self::Fast, _) => 7,
            _ => 5,
        }
    }

    /// Name for people: in tables, menus and pictures.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Svgf => "SVGF",
            Self::Asvgf => "A-SVGF",
            Self::Stabilize => "stabilize",
            Self::Percentile => "percentile",
            Self::Eaw => "EAW",
            Self::Volume => "volume",
            Self::Fast => "fast",
            Self::Best => "best",
        }
    }
}
