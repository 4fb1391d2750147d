//! The inputs that you give: one table, which the graph, captures, the EXR tool, the C header and the docs are made from.

use super::{Component, Counter, ImageFormat};
use ash::vk;

/// The use that the denoiser makes of an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InputRole {
    /// It steers the filters: where a surface was, and which pixels see the same one.
    Guide,
    /// It is filtered.
    Signal,
    /// It is divided out of the light before the filter, or multiplied or added behind it.
    Composition,
    /// It says where light changed.
    Change,
}

impl InputRole {
    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Guide => "guide",
            Self::Signal => "signal",
            Self::Composition => "composition",
            Self::Change => "change",
        }
    }
}

/// What a texel of an input is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum InputKind {
    /// Red, green and blue.
    Colour,
    /// Two or three components.
    Vector,
    /// One number.
    Scalar,
    /// One unsigned integer.
    Id,
    /// A buffer of matrices, three rows of four floats each.
    Transforms,
}

impl InputKind {
    /// Formats that an image of it may have; `None` for a buffer.
    pub const fn format(self) -> Option<ImageFormat> {
        match self {
            Self::Colour | Self::Vector => Some(ImageFormat::Any(Component::Float, vk::Format::R16G16B16A16_SFLOAT)),
            Self::Scalar => Some(ImageFormat::Any(Component::Float, vk::Format::R32_SFLOAT)),
            Self::Id => Some(ImageFormat::Any(Component::Uint, vk::Format::R32_UINT)),
            Self::Transforms => None,
        }
    }

    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Colour => "colour",
            Self::Vector => "vector",
            Self::Scalar => "number",
            Self::Id => "id",
            Self::Transforms => "buffer of 3×4 matrices",
        }
    }
}

/// The layer of EXR files that holds an input.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InputLayer {
    /// Its name in captures, then other names that readers accept, in order of preference.
    pub names: &'static [&'static str],
    /// Names of its components in captures.
    pub components: &'static [&'static str],
    /// Whether these names mean this input in files of any program, and not in captures alone.
    pub is_common: bool,
}

/// An input that you give. [`Input::ALL`] has every one that a [`crate::Config`] can ask for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Input {
    /// Name of the resource.
    pub name: &'static str,
    /// Its content, in Markdown.
    pub doc: &'static str,
    /// The use that is made of it.
    pub role: InputRole,
    /// What a texel is.
    pub kind: InputKind,
    /// Whether you may leave it out where a configuration asks for it.
    pub optional: bool,
    /// The counter of its bad values.
    pub counter: Option<Counter>,
    /// The layer that it has in EXR files; `None` for what has none.
    pub layer: Option<InputLayer>,
    /// Of what each light has that is filtered apart, the number of the light: 0 to 3. Names of further lights end in it.
    pub light: usize,
}

macro_rules! inputs {
    (
        $($(#[doc = $doc:literal])+ $constant:ident = $name:literal: $role:ident $kind:ident, $optional:literal, $counter:expr, $layer:expr;)+
        each light {
            $(
                $(#[doc = $light_doc:literal])+
                $of_lights:ident = $light_name:literal: $light_role:ident $light_kind:ident, $light_optional:literal, $light_counter:expr,
                $light_layer:literal $components:ident;
            )+
        }
    ) => {
        impl Input {
            $($(#[doc = $doc])+ pub const $constant: Self = Self {
                name: $name,
                doc: concat!($($doc),+),
                role: InputRole::$role,
                kind: InputKind::$kind,
                optional: $optional,
                counter: $counter,
                layer: $layer,
                light: 0,
            };)+

            $($(#[doc = $light_doc])+ pub const $of_lights: [Self; 4] = {
                const fn of(light: usize, name: &'static str, layer: &'static [&'static str]) -> Input {
                    Input {
                        name,
                        doc: concat!($($light_doc),+),
                        role: InputRole::$light_role,
                        kind: InputKind::$light_kind,
                        optional: $light_optional,
                        counter: $light_counter,
                        layer: captured(layer, $components),
                        light,
                    }
                }
                [
                    of(0, $light_name, &[$light_layer]),
                    of(1, concat!($light_name, "_1"), &[concat!($light_layer, "_1")]),
                    of(2, concat!($light_name, "_2"), &[concat!($light_layer, "_2")]),
                    of(3, concat!($light_name, "_3"), &[concat!($light_layer, "_3")]),
                ]
            };)+

            /// Every input, in the order of tables.
            pub const ALL: &'static [Self] = &[
                $(Self::$constant,)+
                $(Self::$of_lights[0], Self::$of_lights[1], Self::$of_lights[2], Self::$of_lights[3],)+
            ];
        }
    };
}

const RGB: &[&str] = &["R", "G", "B"];
const XYZ: &[&str] = &["X", "Y", "Z"];
const XY: &[&str] = &["X", "Y"];
const Z: &[&str] = &["Z"];
const I: &[&str] = &["I"];

/// A layer that captures alone have.
const fn captured(names: &'static [&'static str], components: &'static [&'static str]) -> Option<InputLayer> {
    Some(InputLayer { names, components, is_common: false })
}

/// A layer that other programs write, too.
const fn common(names: &'static [&'static str], components: &'static [&'static str]) -> Option<InputLayer> {
    Some(InputLayer { names, components, is_common: true })
}

inputs! {
    /// linear, device (reversed, infinite, orthographic) or length of the ray
    DEPTH = "depth": Guide Scalar, false, Some(Counter::Depth), common(&["depth", "dd", "dd.y", "z"], &["Z"]);
    /// xyz or octahedral; world or view space
    NORMAL = "normal": Guide Vector, false, Some(Counter::Normal), common(&["normal", "nrm", "normals", "n"], XYZ);
    /// in pixels, UV or NDC, of either sign; z may hold depth
    MOTION = "motion": Guide Vector, true, Some(Counter::Motion), common(&["mv", "motion", "motion_vector", "flow"], XYZ);
    /// unless `Config::surface_id` is false: stable per instance; 0 is the background
    SURFACE_ID = "surface_id": Guide Id, false, None,
        common(&["id", "surface_id", "shape_index", "shape", "instance_id"], &["I"]);
    /// previous from current world space by `surface_id`, three rows of four floats each
    INSTANCE_TRANSFORMS = "instance_transforms": Guide Transforms, true, None, None;
    /// with `Config::object_normal`: lets a turning object keep its history
    OBJECT_NORMAL = "object_normal": Guide Vector, false, None, captured(&["object_normal"], XYZ);
    /// with `Config::material_class`: 0 to 15, an entry of `FrameParams::materials`
    MATERIAL_CLASS = "material_class": Guide Id, false, Some(Counter::MaterialClass), captured(&["material_class"], I);
    /// 0 to 1, perceptual or GGX's α; without it, or at −1, surfaces are rough. `Signals::Specular` and `Mixed` read it
    ROUGHNESS = "roughness": Guide Scalar, true, Some(Counter::Roughness), common(&["roughness"], &["Y"]);
    /// radiance is divided by it and multiplied again, so textures stay sharp
    ALBEDO = "albedo": Composition Colour, true, Some(Counter::Albedo),
        common(&["albedo", "alb", "albedo0", "diffuse_albedo"], RGB);
    /// added after the filter
    EMISSION = "emission": Composition Colour, true, Some(Counter::Emission), captured(&["emission"], RGB);
    /// all light in one signal, linear (`Signals::Together`, `Mixed`)
    NOISY_RADIANCE = "noisy_radiance": Signal Colour, false, Some(Counter::Radiance), captured(&["lighting"], RGB);
    /// direct light, linear (`Signals::Apart`)
    NOISY_DIRECT = "noisy_direct": Signal Colour, false, Some(Counter::Radiance), captured(&["direct"], RGB);
    /// indirect light, linear (`Signals::Apart`)
    NOISY_INDIRECT = "noisy_indirect": Signal Colour, false, Some(Counter::Radiance), captured(&["indirect"], RGB);
    /// light scattered by the base of surfaces, linear (`Signals::Specular`); `albedo` is then that of the base
    NOISY_DIFFUSE = "noisy_diffuse": Signal Colour, false, Some(Counter::Radiance), captured(&["diffuse"], RGB);
    /// light reflected by coat or metal, linear (`Signals::Specular`)
    NOISY_SPECULAR = "noisy_specular": Signal Colour, false, Some(Counter::Radiance), captured(&["specular"], RGB);
    /// the share of light from everywhere that coat or metal reflects
    SPECULAR_ALBEDO = "specular_albedo": Composition Colour, true, Some(Counter::Albedo), captured(&["specular_albedo"], RGB);
    /// instead of `specular_albedo`: reflectance at normal incidence
    SPECULAR_F0 = "specular_f0": Composition Colour, true, Some(Counter::Albedo), captured(&["specular_f0"], RGB);
    /// distance from the surface to the hit of the specular path, scene units; 0 or infinite: nothing was hit. Without it, or at
    /// −1, the light tells how reflections move
    SPECULAR_HIT_DISTANCE = "specular_hit_distance": Guide Scalar, true, Some(Counter::HitDistance),
        captured(&["hitdist", "hit_distance"], &["D"]);
    /// the `surface_id` at that hit: with `instance_transforms`, moving things in mirrors, and moving mirrors, are followed
    SPECULAR_HIT_ID = "specular_hit_id": Guide Id, true, Some(Counter::HitId), captured(&["hit_id"], &["I"]);
    /// before that id, where finite: previous − current place of the hit, world space
    SPECULAR_MOTION = "specular_motion": Guide Vector, true, Some(Counter::SpecularMotion), captured(&["specular_motion"], XYZ);
    /// with `Config::forward_motion`, for gradients: motion of deforming surfaces from the previous frame to this one
    FORWARD_MOTION = "forward_motion": Change Vector, false, Some(Counter::ForwardMotion), captured(&["forward_motion"], XYZ);
    /// with `GradientSource::Reshaded`: the paths of the previous frame, traced again in this scene
    RESHADED_RADIANCE = "reshaded_radiance": Change Colour, true, None, captured(&["reshaded"], RGB);
    /// with `GradientSource::Sparse`: differences that you took yourself
    SPARSE_GRADIENT = "sparse_gradient": Change Vector, true, None, captured(&["sparse_gradient"], XY);
    /// with `GradientSource::Confidence`: 1 keeps history, 0 drops it
    CONFIDENCE = "confidence": Change Scalar, false, None, captured(&["confidence"], &["Y"]);
    /// for `Stabilize`: the output of the other denoiser
    OTHER_DENOISED_RADIANCE = "other_denoised_radiance": Signal Colour, false, Some(Counter::Radiance),
        common(&["other_denoised"], RGB);
    /// with `Config::volume`: light that fog or smoke scatters towards the camera
    NOISY_VOLUME = "noisy_volume": Signal Colour, false, Some(Counter::Radiance), captured(&["volume"], RGB);
    /// with `Config::volume`: linear depth of a point that contributes much, for example chosen by transmittance; gives the
    /// volume its own motion
    SCATTERING_DEPTH = "scattering_depth": Guide Scalar, true, Some(Counter::ScatteringDepth),
        captured(&["scattering_depth"], &["Z"]);
    /// with `Config::ambient_occlusion`: 1 where a ray, drawn by the cosine, hit nothing, else 0
    NOISY_AMBIENT = "noisy_ambient": Signal Scalar, false, Some(Counter::Visibility), captured(&["ambient"], Z);
    /// distance of that hit, scene units; 0 or infinite: none
    AMBIENT_DISTANCE = "ambient_distance": Guide Scalar, false, Some(Counter::OccluderDistance),
        captured(&["ambient_distance"], Z);
    each light {
        /// with `Config::visibility`: 0 (occluded) to 1 (lit), by one shadow ray; red alone, unless `Config::coloured_visibility`. Leave
        /// this light out of the noisy radiance
        NOISY_VISIBILITY = "noisy_visibility": Signal Colour, false, Some(Counter::Visibility), "visibility" RGB;
        /// distance of the occluder along the shadow ray, scene units; 0 or infinite: none
        OCCLUDER_DISTANCE = "occluder_distance": Guide Scalar, false, Some(Counter::OccluderDistance), "occluder_distance" Z;
        /// the `surface_id` of the occluder: with `instance_transforms` and `FrameParams::lights`, moving shadows are followed
        OCCLUDER_ID = "occluder_id": Guide Id, true, Some(Counter::OccluderId), "occluder_id" I;
        /// before ids, where finite: previous − current place of the occluding point, world space
        OCCLUDER_MOTION = "occluder_motion": Guide Vector, true, Some(Counter::OccluderMotion), "occluder_motion" XYZ;
        /// the reflected light without occluders, albedo included; `denoised_radiance` then has the product
        UNSHADOWED_DIRECT = "unshadowed_direct": Composition Colour, true, Some(Counter::Radiance), "unshadowed_direct" RGB;
    }
}

impl Input {
    /// Whether it has the pixels of the light, and not those of the guides, where [`crate::Config::light_extent`] sets them apart.
    pub(crate) fn is_of_light(&self) -> bool {
        const OF_LIGHT: [Input; 5] = [
            Input::SPECULAR_HIT_DISTANCE,
            Input::SPECULAR_HIT_ID,
            Input::SPECULAR_MOTION,
            Input::SCATTERING_DEPTH,
            Input::AMBIENT_DISTANCE,
        ];
        const OF_LIGHTS: [[Input; 4]; 3] = [Input::OCCLUDER_DISTANCE, Input::OCCLUDER_ID, Input::OCCLUDER_MOTION];
        let signals = matches!(self.role, InputRole::Signal | InputRole::Change);
        signals || OF_LIGHT.contains(self) || OF_LIGHTS.iter().flatten().any(|input| input == self)
    }

    /// The input of a name.
    pub fn by_name(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().find(|input| input.name == name)
    }
}
