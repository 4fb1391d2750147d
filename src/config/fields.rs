//! The one table of the fields of [`super::Config`] and [`super::Conventions`].

use crate::error::Error;

/// Gives every field of [`crate::Config`] and [`crate::config::Conventions`] to a macro, which makes the structs here and the struct of
/// the C ABI elsewhere. No part of the public interface.
///
/// A row: documentation, attributes behind `@`, name, `filter` where it chooses one and `host` where it says something of the host,
/// kind, type and default. The struct of C has the groups in their order, and only grows: a new field goes to the end of the last
/// group, or to a group behind it.
#[doc(hidden)]
#[macro_export]
macro_rules! config_fields {
    ($then:ident) => {
        $then! {
            config {
                /// Frames that you record before you wait for the oldest, 1 to 8. Default: 2.
                frames_in_flight: host number u32 = 2;
                /// Filter. Default: [`Preset::Best`].
                preset: filter choice Preset = Preset::default();
                /// Signals. Together: one image, `noisy_radiance`. Apart: `noisy_direct` and `noisy_indirect`.
                /// Specular: `noisy_diffuse` and `noisy_specular`. Mixed: `noisy_radiance`, by `roughness`. Default:
                /// [`Signals::Together`].
                signals: host choice Signals = Signals::default();
                /// À-trous levels, 1 to 10; none: those of the preset, [`Preset::levels`]. Default: none.
                levels: filter number_or_none Option<u32> = None;
                /// Whether you give a volume (fog, smoke) apart, as the input `noisy_volume`. The filter gives it
                /// motion of its own \[PSVGF\] and writes `denoised_volume`. The volume is the light that the medium
                /// itself scatters towards the camera. The radiance of surfaces is the light that reaches the camera
                /// through the medium. Their sum is the picture, which the post-process shows. Costs 40 bytes per
                /// pixel, and 8 of the output. Default: false.
                ///
                /// The optional input `scattering_depth` gives the volume a place: the linear depth of one point per
                /// pixel that contributes much, in scene units along the view axis. For example, take the distance that
                /// you sampled by transmittance. 0, infinite or NaN means none. The filter follows the point to the
                /// next frame. Without the input a volume moves as the surfaces behind it.
                volume: host flag bool = false;
                /// Number of lights, such as the sun, whose visibility you give apart: 0 to 4. The input
                /// `noisy_visibility` goes from 0 (occluded) to 1 (lit), usually one of the two. The input
                /// `occluder_distance` is the distance from the surface to the occluder along the shadow ray (scene
                /// units; 0 or infinite: none, or not known). The output is `denoised_visibility`. Set the size of the
                /// light with [`crate::Tuning::light_radius`]. The names of further lights end in `_1` to `_3`. Costs 12
                /// bytes per pixel for one light, the outputs included, and 66 for four. Default: 0.
                ///
                /// Multiply each of your lights by its output. Or give the optional input `unshadowed_direct`, the light
                /// of the surface without an occluder, times albedo and BSDF. `denoised_radiance` then contains the
                /// product. Either way, leave that light out of your noisy radiance.
                visibility: host number u32 = 0;
                /// Whether outliers of the input are scaled down to the usual brightness around them, before they reach
                /// the history \[PSVGF\]. [`Preset::Percentile`] always does so. Default: false.
                firefly_filter: filter flag bool = false;
                /// How the preset `Percentile` detects changes of light. Default: [`AdaptiveRule::ChangeTest`].
                adaptive_rule: filter choice AdaptiveRule = AdaptiveRule::default();
                /// Side of the strata of temporal gradients, 2 to 4 pixels. Default: 3 \[ASVGF\]. Only for presets with gradients.
                stratum_size: filter number u32 = 3;
                /// Source of the temporal gradients. Only for presets with gradients. If you cannot shade again, take
                /// [`GradientSource::ChangeTest`]: fewer passes and bytes. Default: [`GradientSource::ForwardProjected`].
                gradient_source: filter choice GradientSource = GradientSource::default();
                /// Whether you have an image `forward_motion`, for deforming surfaces. It has the motion of every pixel
                /// of the previous frame to this frame. Only for forward-projected gradients. Default: false.
                forward_motion: host flag bool = false;
                /// Edge-stopping functions of the preset `Eaw`. Default: all three.
                eaw_weights: filter weights EawWeights = EawWeights::default();
                /// Share of the pixels with a sample in each frame, for checkerboards and tracing at half the rate.
                /// Make the other pixels NaN in your noisy images. Costs 8 bytes per pixel and signal until history is
                /// read, and one pass per signal. Not for [`Preset::Stabilize`] and volumes, which need a sample in
                /// every pixel. Default: [`Sampling::Full`].
                sampling: filter choice Sampling = Sampling::default();
                /// Whether you have an image of surface ids. Default: true.
                surface_id: host flag bool = true;
                /// Whether you have object-space normals. With them a turning object keeps its history. Costs 8 bytes
                /// per pixel. Default: false.
                object_normal: host flag bool = false;
                /// Post-process. Default: [`PostProcess::None`].
                post_process: host choice PostProcess = PostProcess::default();
                /// Whether `denoised_radiance` and `denoised_volume` have 32-bit floats (R32G32B32A32_SFLOAT) instead
                /// of halves. Your light may have any unit, and halves hold only 1e-4 to 65504 of it. Costs 8 bytes per
                /// pixel of each, and one pass for a volume. Default: false.
                float_output: host flag bool = false;
                /// Whether you want a last pass `debug_view`, which shows the state of each pixel: see
                /// [`crate::DebugView`]. It keeps the shown images alive to the end, so you cannot alias these
                /// transients. You may leave the pass out of a frame. Default: false.
                debug_view: host flag bool = false;
                /// Width and height of the picture that you show, 1 to 3 times those of the rendered one, each by itself.
                /// The post-process then gathers the jittered frames at this size. Its result is `display`, or
                /// `upscaled_radiance` with [`PostProcess::None`]. Costs 16 bytes per pixel of the output, and 8 of the
                /// result. None: the picture has the size that you rendered. Default: none.
                output_extent: host extent_or_none Option<[u32; 2]> = None;
            }
            conventions {
                /// Encoding of depth. Default: [`DepthEncoding::Linear`].
                depth: host choice DepthEncoding = DepthEncoding::default();
                /// Linear depth from which on a pixel is background, above 0. 1e15 and beyond always are. Default:
                /// infinity, which a file has as `"inf"`.
                @[cfg_attr(feature = "serde", serde(with = "super::serde_forms::distance"))]
                background_depth: host distance f32 = f32::INFINITY;
                /// Encoding of normals. Default: [`NormalEncoding::Xyz`].
                normal: host choice NormalEncoding = NormalEncoding::default();
                /// Space of the normals. Default: [`NormalSpace::World`].
                normal_space: host choice NormalSpace = NormalSpace::default();
                /// Unit of the motion. Default: [`MotionUnit::Uv`].
                motion_unit: host choice MotionUnit = MotionUnit::default();
                /// Sign of the motion. Default: [`MotionDirection::PreviousMinusCurrent`].
                motion_direction: host choice MotionDirection = MotionDirection::default();
                /// Whether y of the motion points up. A file has it as `motion_y`, `"up"` or `"down"`. Default: false.
                @[cfg_attr(feature = "serde", serde(rename = "motion_y", alias = "motion_y_up", with = "super::serde_forms::up"))]
                motion_y_up: host flag bool = false;
                /// Whether the motion includes the change of jitter. Default: false.
                motion_jittered: host flag bool = false;
                /// Meaning of z of the motion. Default: [`MotionDepth::None`].
                motion_depth: host choice MotionDepth = MotionDepth::default();
                /// Direction in which the camera looks. Default: [`ViewForward::NegativeZ`].
                view_forward: host choice ViewForward = ViewForward::default();
                /// Encoding of roughness. Default: [`RoughnessEncoding::Linear`].
                roughness: host choice RoughnessEncoding = RoughnessEncoding::default();
            }
            later_conventions {
                /// Factor of the motion's x and y, above 0. For example 50, if you store pixels times 0.02. Default: 1.0.
                motion_scale: host factor f32 = 1.0;
                /// Channel of `roughness` that holds it, for example alpha behind a reflectance. Default: [`Channel::R`].
                roughness_channel: host choice Channel = Channel::default();
                /// Whether your light comes divided by `albedo`, as irradiance: all noisy signals but `noisy_specular` and
                /// `noisy_volume`, and `other_denoised_radiance`. The filter then multiplies by the albedo, and does not divide.
                /// Default: false.
                demodulated: host flag bool = false;
            }
            later_config {
                /// Whether you want the output `reactive_mask` for an upscaler of your own. Red is the share of a pixel that is
                /// new: history was lost, is short, or light changed. Green is the share of its light that is emitted. Only for
                /// presets with a history. Costs 8 bytes per pixel and one pass. Default: false.
                reactive_mask: host flag bool = false;
                /// Width and height of your noisy images, each that of the rendered picture or half of it, which is even
                /// then. Guides, albedo and emission keep the rendered size, and so does the result. In each frame say which
                /// pixel you traced: [`crate::FrameParams::light_offset`]. Hit and occluder distances and ids, confidence,
                /// gradients and forward motion have the size of the light. None: it has the rendered size. Default: none.
                light_extent: host extent_or_none Option<[u32; 2]> = None;
                /// Whether the visibility of lights has a colour, for stained glass and leaves: red, green and blue of
                /// `noisy_visibility` and `denoised_visibility`. Costs about twice the memory of grey ones. Default:
                /// false.
                coloured_visibility: filter flag bool = false;
                /// Whether you give ambient occlusion apart. The input `noisy_ambient` is 0 where a ray into the hemisphere,
                /// drawn by the cosine, hit something, and 1 where it did not. The input `ambient_distance` is the distance
                /// of that hit (scene units; 0 or infinite: none). The output is `denoised_ambient`: multiply your ambient
                /// light by it. Costs 12 bytes per pixel, the output included. Default: false.
                ambient_occlusion: host flag bool = false;
                /// Width and height of your images, where the picture is a part of them: of an atlas, or of two views side by side.
                /// Inputs and outputs with a texel per pixel then have this size, and in each frame you say where the picture
                /// begins: [`crate::FrameParams::viewport_origin`]. What lies outside is neither read nor written. Keep the old
                /// content of outputs that you share. None: they have the allocated extent. Default: none.
                image_extent: host extent_or_none Option<[u32; 2]> = None;
                /// Whether you give a class of materials per pixel, as the input `material_class`: 0 to 15. Each class has an entry in
                /// [`crate::FrameParams::materials`]: factors of tolerances and of the filter's strength, and a longest history. They hold
                /// where surfaces are accumulated and in the levels of the filter, not in [`Preset::Eaw`]. Costs no memory. Default:
                /// false.
                material_class: host flag bool = false;
            }
        }
    };
}

/// A field of [`super::Config`] or of its conventions, as data: for user interfaces, command lines and documents.
#[derive(Clone, Copy, Debug)]
pub struct ConfigField {
    /// Name of the field.
    pub name: &'static str,
    /// Its documentation, in Markdown.
    pub doc: &'static str,
    /// Whether it chooses the filter. The others describe you, the host: your images, their encodings, and your wishes beside the filter.
    pub is_of_filter: bool,
    /// Names and numbers of its values, where it is a choice.
    pub values: fn() -> Vec<(&'static str, u32)>,
}

impl ConfigField {
    /// The first paragraph of the documentation without links, and without the default.
    pub fn text(&self) -> String {
        let paragraph = self.doc.split("\n\n").next().unwrap_or_default().replace('\n', "");
        let plain = paragraph.replace("crate::", "").replace("[`", "`").replace("`]", "`").replace('\\', "");
        let sentences: Vec<_> =
            plain.trim().trim_end_matches('.').split(". ").filter(|sentence| !sentence.starts_with("Default:")).collect();
        sentences.join(". ") + "."
    }
}

macro_rules! is_of_filter {
    (filter) => {
        true
    };
    (host) => {
        false
    };
}

/// The values of a field, by its kind in the table.
macro_rules! values {
    (choice $type:ty) => {
        || <$type as $crate::Choice>::ALL.iter().map(|value| (value.name(), *value as u32)).collect()
    };
    (flag $type:ty) => {
        || vec![("false", 0), ("true", 1)]
    };
    ($kind:ident $type:ty) => {
        Vec::new
    };
}

/// A value of a field from text, by its kind in the table.
macro_rules! parse {
    (flag $type:ty, $text:expr) => {
        match $text {
            "true" => Ok(true),
            "false" => Ok(false),
            given => Err(Error::Choice { kind: "flag", given: given.to_owned(), allowed: "true, false".to_owned() }),
        }
    };
    (number $type:ty, $text:expr) => {
        fields::number($text)
    };
    (number_or_none $type:ty, $text:expr) => {
        if $text == "none" {
            Ok(None)
        } else {
            fields::number($text).map(Some)
        }
    };
    (extent_or_none $type:ty, $text:expr) => {
        if $text == "none" {
            Ok(None)
        } else {
            fields::extent($text).map(Some)
        }
    };
    ($kind:ident $type:ty, $text:expr) => {
        $text.parse::<$type>()
    };
}

/// Width and height, such as `640x360`.
pub(super) fn extent(text: &str) -> Result<[u32; 2], Error> {
    let sides = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let allowed = "none, or width and height like 640x360".to_owned();
    sides.ok_or_else(|| Error::Choice { kind: "extent", given: text.to_owned(), allowed })
}

pub(super) fn number(text: &str) -> Result<u32, Error> {
    let allowed = "0, 1, 2 and so on".to_owned();
    text.parse().map_err(|_| Error::Choice { kind: "whole number", given: text.to_owned(), allowed })
}

pub(super) use {is_of_filter, parse, values};
