//! Per-frame numbers with ranges and defaults; changing one never drops the history.

use crate::choice::choices;
use crate::config::Preset;
use crate::error::Error;

/// The description of a tunable: for user interfaces and for error messages.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TuningField {
    /// Name of the field in [`Tuning`].
    pub name: &'static str,
    /// Meaning of the tunable, and the effect of raising it.
    pub doc: &'static str,
    /// Unit, empty for a plain number.
    pub unit: &'static str,
    /// Smallest legal value.
    pub min: f32,
    /// Largest legal value.
    pub max: f32,
    /// Default: that of the default preset, as [`Tuning::default`] has it.
    pub default: f32,
}

choices! {
    /// The curve of the tone map.
    #[derive(Default)]
    #[non_exhaustive]
    pub enum ToneCurve {
        /// Fit of the ACES reference curve (Narkowicz 2015).
        #[default]
        Aces = 0 => "aces",
        /// `x / (1 + luminance)`, which keeps hues.
        Reinhard = 1 => "reinhard",
        /// Exposure and clamp alone.
        Linear = 2 => "linear",
    }
}

macro_rules! tuning {
    ($($(#[doc = $doc:literal])+ $name:ident: $unit:literal, $min:literal ..= $max:literal, $default:literal;)+) => {
        /// Per-frame numbers. Every field documents unit, range, default and the effect of raising
        /// it; [`Tuning::FIELDS`] has the same as data. The defaults are those of the default
        /// preset; [`Tuning::for_preset`] has those of every other.
        ///
        /// With the feature `serde`, a field that a file leaves out has its default, whatever the
        /// preset. [`Tuning::validate`] checks the others.
        #[derive(Clone, Copy, Debug, PartialEq)]
        #[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize), serde(default, deny_unknown_fields))]
        pub struct Tuning {
            $($(#[doc = $doc])+ #[doc = concat!("\n\nUnit: ", $unit, ". Range: ", stringify!($min), " to ", stringify!($max), ". Default: ", stringify!($default), ".")] pub $name: f32,)+
            /// Curve of the tone map. Default: [`ToneCurve::Aces`].
            pub tone_curve: ToneCurve,
        }

        impl Tuning {
            /// The documented defaults.
            const DOCUMENTED: Self = Self { $($name: $default,)+ tone_curve: ToneCurve::Aces };

            /// Every number, in order.
            pub const FIELDS: &'static [TuningField] = &[
                $(TuningField { name: stringify!($name), doc: concat!($($doc),+), unit: $unit, min: $min, max: $max, default: $default },)+
            ];

            /// The value of a field by its name.
            pub fn get(&self, name: &str) -> Option<f32> {
                match name { $(stringify!($name) => Some(self.$name),)+ _ => None }
            }

            /// Functions that read the bits of each number, in their order, and of the tone curve behind them.
            const READERS: &'static [fn(&Tuning) -> u32] = &[$(|t| t.$name.to_bits(),)+ |t| t.tone_curve as u32];
            /// Functions that set each number from its bits, in the order of [`Self::READERS`].
            const WRITERS: &'static [fn(&mut Tuning, u32)] = &[$(|t, bits| t.$name = f32::from_bits(bits),)+ |t, bits| t.tone_curve = ToneCurve::try_from(bits).unwrap_or_default()];

            /// Sets a field by its name.
            ///
            /// # Errors
            /// [`Error::UnknownTuning`] for a name that does not exist, [`Error::Tuning`] for a value that is out of range.
            pub fn set(&mut self, name: &str, value: f32) -> Result<(), Error> {
                let mut changed = *self;
                match name { $(stringify!($name) => changed.$name = value,)+ _ => return Err(Error::UnknownTuning(name.to_owned())) }
                changed.validate()?;
                *self = changed;
                Ok(())
            }
        }
    };
}

tuning! {
    /// Smallest weight of the new sample in the accumulated irradiance (SVGF 4.1). Raising it reacts faster to changed light and
    /// leaves more noise.
    alpha: "1", 0.0 ..= 1.0, 0.1;
    /// Smallest weight of the new sample in the moments of luminance, from which the variance comes. Raising it follows changes
    /// faster and makes the filter width unsteady.
    alpha_moments: "1", 0.0 ..= 1.0, 0.1;
    /// Cap of the history length. Raising it matters only while 1/N is above `alpha`; with `alpha` 0 it is the length of the
    /// running mean.
    max_history_length: "frames", 1.0 ..= 1024.0, 256.0;
    /// Pixels with a shorter history take their variance from a 7×7 neighbourhood (SVGF 4.2). Raising it blurs longer after a
    /// disocclusion.
    spatial_variance_frames: "frames", 1.0 ..= 64.0, 4.0;
    /// Luminance edge stopping: tolerated difference in standard deviations of the accumulated mean; in the presets svgf, eaw and
    /// volume of a sample (SVGF eq. 5). Raising it blurs more.
    sigma_l: "standard deviations", 0.0 ..= 128.0, 3.0;
    /// Normal edge stopping: sharpness of exp(−σ (1 − cos)), which is the exponent of the cosine of SVGF eq. 4 for small angles.
    /// Raising it keeps finer relief and leaves more noise on curved surfaces.
    sigma_n: "1", 0.0 ..= 1024.0, 32.0;
    /// Depth edge stopping: tolerated departure from the local plane (SVGF eq. 3). Raising it blurs across depth steps.
    sigma_z: "depth gradients", 0.0 ..= 64.0, 1.0;
    /// Largest relative difference between expected and stored depth of a pixel's history. Raising it keeps more history and risks
    /// ghosts.
    depth_tolerance: "1", 0.0 ..= 1.0, 0.1;
    /// Smallest cosine between expected and stored normal of a pixel's history. Raising it drops more history on curved and bumpy
    /// surfaces.
    normal_tolerance: "1", -1.0 ..= 1.0, 0.85;
    /// Lower percentile of the luminance of 8×8 pixels (PSVGF). With one sample per pixel it is
    /// close to 0 at any setting.
    percentile_low: "share of the pixels", 0.0 ..= 1.0, 0.1;
    /// Upper percentile (PSVGF). Raising it lets the firefly filter pass more, and the published rule keep more history.
    percentile_up: "share of the pixels", 0.0 ..= 1.0, 0.95;
    /// Scale of the range between the percentiles, by which a luminance may leave them (PSVGF). Raising it passes more outliers and
    /// keeps more history.
    percentile_range: "interpercentile ranges", 0.0 ..= 64.0, 2.0;
    /// Share of the history that a change of the light costs; 0: the adaptive rules are off (PSVGF).
    adaptivity: "1", 0.0 ..= 1.0, 1.0;
    /// Change, in standard errors of its mean, from which history gives way; at twice as many it is gone. Raising it reacts to
    /// larger changes alone.
    change_threshold: "standard errors", 0.5 ..= 64.0, 2.5;
    /// Luminance that the firefly filter always lets pass on top of the percentiles (PSVGF). Raising it passes more outliers.
    firefly_bias: "luminance of irradiance", 0.0 ..= 65504.0, 0.0;
    /// Largest part of an outlier that the firefly filter spreads over the 8×8 pixels of its block instead of losing it; 0 loses
    /// all that it cuts off (PSVGF). Raising it keeps more light, and shows as bright blocks where outliers are extreme.
    firefly_spread: "times what is left of the outlier", 0.0 ..= 1024.0, 2.0;
    /// Radiance edge stopping of the first level of (EAW); halved from level to level. Of the size of the brightest light, so that
    /// geometry alone leads the first level. Raising it blurs more.
    eaw_sigma_radiance: "irradiance", 0.0001 ..= 65504.0, 4.0;
    /// Normal edge stopping of (EAW). Raising it blurs over edges and relief.
    eaw_sigma_normal: "length of the difference of two normals", 0.001 ..= 64.0, 0.3;
    /// Position edge stopping of (EAW), as a share of the depth. Raising it blurs over gaps.
    eaw_sigma_position: "depths", 0.001 ..= 64.0, 0.05;
    /// Smallest weight of the new sample in the accumulated radiance of a volume, and in its moments. Raising it reacts faster and
    /// leaves more noise.
    volume_alpha: "1", 0.0 ..= 1.0, 0.1;
    /// Luminance edge stopping of a volume: tolerated difference in standard deviations. Raising it blurs the edges of light shafts
    /// more.
    volume_sigma_l: "standard deviations", 0.0 ..= 128.0, 2.0;
    /// Depth edge stopping of a volume: tolerated difference between the surfaces behind, as a share of the larger depth (PSVGF).
    /// Raising it blurs more over the outlines of surfaces.
    volume_sigma_z: "depths", 0.001 ..= 64.0, 0.1;
    /// Largest difference between the surfaces behind a pixel of a volume and behind its history, as a share of the larger depth
    /// (PSVGF). Raising it keeps more history; at 1 it is not tested.
    volume_depth_tolerance: "depths", 0.0 ..= 1.0, 0.25;
    /// Angular radius of the light whose visibility is filtered; the sun's by default, as it is seen from Earth. Raising it blurs
    /// shadows more, as a larger light does.
    light_radius: "radians", 0.0 ..= 1.5, 0.00465;
    /// Smallest weight of the new sample in the accumulated visibility of a light. Raising it follows moving shadows faster and
    /// leaves more noise.
    visibility_alpha: "1", 0.0 ..= 1.0, 0.1;
    /// Standard deviation of the filter of a visibility. Raising it leaves less noise in penumbrae and widens them.
    penumbra_blur: "radii of the penumbra", 0.0 ..= 4.0, 0.4;
    /// Visibility edge stopping: tolerated difference in standard deviations. Raising it blurs penumbrae more.
    visibility_sigma: "standard deviations", 0.0 ..= 128.0, 3.0;
    /// Scale of the relative change of light λ by which history is dropped (ASVGF eq. 14). At 1, the paper's, half of the old light
    /// stays after a change by a half; at 5 a change by a fifth drops all of it. Raising it lags less and leaves more noise where
    /// light changes a little.
    gradient_scale: "1", 0.0 ..= 16.0, 5.0;
    /// Largest reach of the filter of specular light, in radii of the blur by the lobe of the
    /// surface. Raising it blurs reflections more; 0 filters none but those of the roughest
    /// surfaces.
    specular_blur: "lobe radii", 0.0 ..= 16.0, 2.0;
    /// Scale of the radiance before the tone curve. Raising it brightens the picture.
    exposure: "1", 0.0 ..= 65504.0, 1.0;
    /// Smallest weight of a new sample in temporal upscaling and anti-aliasing, where surfaces move (Karis 2014). Raising it is
    /// sharper and flickers more.
    taa_alpha: "1", 0.01 ..= 1.0, 0.45;
    /// Size of the colour box that clips the history of temporal upscaling and anti-aliasing. Raising it flickers less and ghosts more.
    taa_gamma: "standard deviations", 0.0 ..= 8.0, 6.0;
    /// `light_radius` of the second light. Raising it blurs its shadows more.
    light_radius_1: "radians", 0.0 ..= 1.5, 0.00465;
    /// `light_radius` of the third light. Raising it blurs its shadows more.
    light_radius_2: "radians", 0.0 ..= 1.5, 0.00465;
    /// `light_radius` of the fourth light. Raising it blurs its shadows more.
    light_radius_3: "radians", 0.0 ..= 1.5, 0.00465;
    /// Reach of the filter of ambient occlusion. Raising it leaves less noise and blurs contact more.
    ambient_radius: "distances of the occluder", 0.0 ..= 1.5, 0.5;
    /// Frames over which samples of a pixel repeat, as with the temporal reuse of ReSTIR: N frames are worth N / `sample_frames`. Not in
    /// the presets svgf, eaw, stabilize and volume. Raising it blurs more.
    sample_frames: "frames", 1.0 ..= 64.0, 1.0;
}

/// Those of the default preset.
impl Default for Tuning {
    fn default() -> Self {
        Self::for_preset(Preset::default())
    }
}

impl Tuning {
    /// The name of the one tunable that is no number: a choice of curves.
    pub(crate) const TONE_CURVE: &'static str = "tone_curve";

    /// The index of a tunable, for [`Self::bits`].
    pub(crate) fn index(name: &str) -> Option<usize> {
        let number = Self::FIELDS.iter().position(|field| field.name == name);
        number.or_else(|| (name == Self::TONE_CURVE).then_some(Self::FIELDS.len()))
    }

    /// The bits of a tunable as a shader reads them; 0 where the index is none.
    pub(crate) fn bits(&self, index: usize) -> u32 {
        Self::READERS.get(index).map_or(0, |read| read(self))
    }

    /// Sets a tunable from its bits; nothing where the index is none.
    pub(crate) fn set_bits(&mut self, index: usize, bits: u32) {
        if let Some(write) = Self::WRITERS.get(index) {
            write(self, bits);
        }
    }

    /// Angular radii of the lights whose visibility is filtered.
    pub(crate) fn light_radii(&self) -> [f32; 4] {
        [self.light_radius, self.light_radius_1, self.light_radius_2, self.light_radius_3]
    }

    /// The defaults for a preset.
    ///
    /// | preset | differences from [`Preset::Best`], whose numbers the fields document |
    /// | --- | --- |
    /// | [`Preset::Svgf`] | `alpha` 0.2, `alpha_moments` 0.2, `sigma_l` 4, `sigma_n` 128, `depth_tolerance` 0.02, `normal_tolerance` 0.9, `specular_blur` 1 |
    /// | [`Preset::Asvgf`] | `sigma_n` 128, `depth_tolerance` 0.02, `normal_tolerance` 0.9, `specular_blur` 1 |
    /// | [`Preset::Stabilize`] | `sigma_n` 128, `depth_tolerance` 0.02, `normal_tolerance` 0.9, `specular_blur` 1 |
    /// | [`Preset::Percentile`] | `sigma_n` 128, `depth_tolerance` 0.02, `normal_tolerance` 0.9, `specular_blur` 1 |
    /// | [`Preset::Eaw`] | `alpha` 0.2, `alpha_moments` 0.2, `sigma_l` 4, `sigma_n` 128, `depth_tolerance` 0.02, `normal_tolerance` 0.9, `specular_blur` 1 |
    /// | [`Preset::Volume`] | `alpha` 0.2, `alpha_moments` 0.2, `sigma_l` 4, `sigma_n` 128, `depth_tolerance` 0.02, `normal_tolerance` 0.9, `specular_blur` 1 |
    /// | [`Preset::Fast`] | `sigma_n` 128, `depth_tolerance` 0.02, `normal_tolerance` 0.5, `specular_blur` 1 |
    ///
    /// Presets that detect changes of light can react less by themselves, with an `alpha` of 0.1
    /// (ASVGF).
    pub fn for_preset(preset: Preset) -> Self {
        let svgf = Self {
            alpha: 0.2,
            alpha_moments: 0.2,
            sigma_l: 4.0,
            sigma_n: 128.0,
            sigma_z: 1.0,
            specular_blur: 1.0,
            depth_tolerance: 0.02,
            normal_tolerance: 0.9,
            ..Self::DOCUMENTED
        };
        let adaptive = Self { alpha: 0.1, alpha_moments: 0.1, sigma_l: 3.0, ..svgf };
        match preset {
            Preset::Best => Self::DOCUMENTED,
            Preset::Svgf | Preset::Eaw | Preset::Volume => svgf,
            Preset::Fast => Self { normal_tolerance: 0.5, ..adaptive },
            Preset::Asvgf | Preset::Stabilize | Preset::Percentile => adaptive,
        }
    }

    /// Weights of the new frame. A history that each frame forgets a part of lasts a time of its own at each frame rate.
    const WEIGHTS: [&'static str; 5] = ["alpha", "alpha_moments", "volume_alpha", "visibility_alpha", "taa_alpha"];
    /// The frame rate that numbers are meant for, a second.
    const FRAME_RATE: f32 = 60.0;
    const LONGEST_FRAME: f32 = 10.0;

    /// These numbers for a frame that takes `seconds`, if they are meant for 60 frames a second. Light then fades from the history in
    /// the same time at any frame rate. Apply it anew to your own numbers in each frame.
    ///
    /// It changes the weights of the new frame (`alpha`, `alpha_moments`, `volume_alpha`, `visibility_alpha`, `taa_alpha`) and
    /// `max_history_length`. For example, an `alpha` of 0.1 becomes 0.19 at 30 frames a second, and 0.051 at 120. Fewer frames a
    /// second have fewer samples, so more noise is left.
    ///
    /// # Errors
    /// [`Error::Tuning`] for a time that is not 0 to 10 seconds.
    pub fn for_frame_time(&self, seconds: f32) -> Result<Self, Error> {
        let range = 0.0..=Self::LONGEST_FRAME;
        if !range.contains(&seconds) {
            let (min, max, default) = (*range.start(), *range.end(), 1.0 / Self::FRAME_RATE);
            return Err(Error::Tuning { name: "frame time", value: seconds, min, max, default });
        }
        let frames = seconds * Self::FRAME_RATE;
        let mut scaled = *self;
        for field in Self::FIELDS {
            let Some(value) = self.get(field.name) else { continue };
            let value = match field.name {
                name if Self::WEIGHTS.contains(&name) => 1.0 - (1.0 - value).powf(frames),
                "max_history_length" => value / frames,
                _ => continue,
            };
            scaled.set(field.name, value.clamp(field.min, field.max))?;
        }
        Ok(scaled)
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    /// [`Error::Tuning`] names the first field that is out of range or NaN.
    pub fn validate(&self) -> Result<(), Error> {
        for field in Self::FIELDS {
            let value = self.get(field.name).unwrap_or(field.default);
            if !(field.min..=field.max).contains(&value) {
                return Err(Error::Tuning { name: field.name, value, min: field.min, max: field.max, default: field.default });
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn defaults_are_in_range() {
        for preset in Preset::ALL {
            assert_eq!(Tuning::for_preset(preset).validate(), Ok(()), "{preset}");
        }
    }

    #[test]
    fn a_second_of_frames_forgets_the_same_at_any_rate() {
        for preset in Preset::ALL {
            let meant = Tuning::for_preset(preset);
            for rate in [24.0_f32, 30.0, 60.0, 120.0, 480.0] {
                let tuning = meant.for_frame_time(1.0 / rate).expect("in range");
                assert_eq!(tuning.validate(), Ok(()), "{preset} at {rate}");
                for name in ["alpha", "alpha_moments", "volume_alpha", "visibility_alpha"] {
                    let kept = |tuning: &Tuning, frames: f32| (1.0 - tuning.get(name).expect(name)).powf(0.1 * frames);
                    let (given, needed) = (kept(&tuning, rate), kept(&meant, 60.0));
                    assert!((given - needed).abs() < 1e-4, "{preset}, {name} at {rate}: {given} for {needed}");
                }
                let seconds = tuning.max_history_length / rate;
                assert!((seconds - 256.0 / 60.0).abs() < 0.01 || tuning.max_history_length == 1024.0, "{preset}: {seconds} s");
                let same = Tuning { sigma_l: meant.sigma_l, spatial_variance_frames: meant.spatial_variance_frames, ..tuning };
                assert_eq!(same, tuning, "{preset}: numbers that are no weights");
            }
        }
        let stopped = Tuning::default().for_frame_time(0.0).expect("in range");
        assert_eq!((stopped.alpha, stopped.max_history_length), (0.0, 1024.0));
        assert_eq!(stopped.validate(), Ok(()));
    }

    #[test]
    fn a_frame_time_out_of_range_is_refused() {
        for seconds in [f32::NAN, -0.1, 11.0, f32::INFINITY] {
            let error = Tuning::default().for_frame_time(seconds).expect_err("refused").to_string();
            assert!(error.contains("frame time") && error.contains(&format!("{seconds}")), "{error}");
        }
    }

    #[test]
    fn the_documented_defaults_are_those_of_the_default_preset() {
        let default = Tuning::default();
        assert_eq!(default, Tuning::for_preset(Preset::default()));
        for field in Tuning::FIELDS {
            assert_eq!(default.get(field.name), Some(field.default), "{}", field.name);
        }
        assert_eq!(default.tone_curve, ToneCurve::default());
    }

    #[test]
    fn a_value_out_of_range_is_named_and_not_kept() {
        let mut tuning = Tuning::default();
        for bad in [1.5, -0.1, f32::NAN, f32::INFINITY] {
            let message = tuning.set("alpha", bad).expect_err("out of range").to_string();
            assert!(message.contains("alpha") && message.contains("0 to 1"), "{message}");
        }
        assert_eq!(tuning, Tuning::default());
        assert!(tuning.set("alfa", 0.5).expect_err("unknown").to_string().contains("alfa"));
        tuning.set("alpha", 0.5).expect("in range");
        assert_eq!(tuning.get("alpha"), Some(0.5));
    }
}
