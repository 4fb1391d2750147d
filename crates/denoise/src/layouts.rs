//! Channel names of known renderers, as one table.
//!
//! Sources: the data sets of this project; Blender's passes (Cycles' `primitive_motion_vector` for the sign of `Vector`: previous −
//! current in X and Y, current − next in Z and W, pixels, y up); Mitsuba 3's `aov` integrator (`depth` is the distance along the
//! ray, 0 where nothing is hit); PBRT-v4's `gbuffer` film; Open Image Denoise's example files (`*_hdr`, `*_alb`, `*_nrm`).

use crate::roles::Role;
use atrous::Input;

/// The program that writes channels with these names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layout {
    /// The data sets of this project, and captures of its library.
    Atrous,
    /// Blender multilayer EXR.
    Blender,
    /// Mitsuba 3 with the `aov` integrator.
    Mitsuba,
    /// PBRT-v4 with the `gbuffer` film.
    Pbrt,
    /// Colour, albedo, normal, as Open Image Denoise takes them.
    Plain,
}

impl Layout {
    /// Name for messages.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Atrous => "atrous data set",
            Self::Blender => "Blender",
            Self::Mitsuba => "Mitsuba AOVs",
            Self::Pbrt => "PBRT gbuffer",
            Self::Plain => "plain colour, albedo, normal",
        }
    }
}

/// One way in which a role is stored.
pub struct Entry {
    /// Role.
    pub role: Role,
    /// Layouts with this entry; empty: all.
    pub layouts: &'static [Layout],
    /// Last parts of the layer name, any case; "" is no layer. In order of preference.
    pub layers: &'static [&'static str],
    /// Alternatives for the names of the components.
    pub components: &'static [&'static [&'static str]],
}

const RGB: &[&[&str]] = &[&["R", "G", "B"]];
const XYZ: &[&[&str]] = &[&["X", "Y", "Z"], &["R", "G", "B"]];
const XY: &[&[&str]] = &[&["X", "Y"], &["U", "V"], &["R", "G"]];
const DEPTH: &[&[&str]] = &[&["Z"], &["V"], &["T"], &["D"], &["Y"], &["R"], &["X"]];
/// In colour, or grey.
const VISIBLE: &[&[&str]] = &[&["R", "G", "B"], &["Z"], &["V"], &["Y"], &["R"]];
const ID: &[&[&str]] = &[&["I"], &["X"], &["Y"], &["V"], &["R"]];

const fn entry(
    role: Role,
    layouts: &'static [Layout],
    layers: &'static [&'static str],
    components: &'static [&'static [&'static str]],
) -> Entry {
    Entry { role, layouts, layers, components }
}

/// An input as captures have it, and, where its layer is common, other programs.
const fn of(role: Role, input: Input, components: &'static [&'static [&'static str]]) -> Entry {
    match input.layer {
        Some(layer) => entry(role, if layer.is_common { &[] } else { &[Layout::Atrous] }, layer.names, components),
        None => panic!("an input without a layer"),
    }
}

use Layout::{Atrous, Blender, Mitsuba, Pbrt, Plain};

/// All layouts. The first that fits wins.
pub const ENTRIES: &[Entry] = &[
    entry(Role::Noisy, &[Atrous], &["noisy"], RGB),
    // `Noisy Image` is the unfiltered render where Blender's own denoiser has already been over `Combined`.
    entry(Role::Noisy, &[Blender], &["noisy image", "combined"], RGB),
    entry(
        Role::Noisy,
        &[],
        &["", "color", "colour", "hdr", "beauty", "rgba", "img", "image", "my_image", "combined", "noisy"],
        RGB,
    ),
    of(Role::Lighting, Input::NOISY_RADIANCE, RGB),
    of(Role::Direct, Input::NOISY_DIRECT, RGB),
    of(Role::Indirect, Input::NOISY_INDIRECT, RGB),
    of(Role::Diffuse, Input::NOISY_DIFFUSE, RGB),
    of(Role::Specular, Input::NOISY_SPECULAR, RGB),
    of(Role::SpecularAlbedo, Input::SPECULAR_ALBEDO, RGB),
    of(Role::HitDistance, Input::SPECULAR_HIT_DISTANCE, DEPTH),
    of(Role::HitId, Input::SPECULAR_HIT_ID, ID),
    entry(Role::PathLength, &[Blender], &["denoising depth"], DEPTH),
    of(Role::HitMotion, Input::SPECULAR_MOTION, XYZ),
    entry(Role::DemodulatedSpecularDirect, &[Blender], &["glossdir", "glossy direct"], RGB),
    entry(Role::DemodulatedSpecularIndirect, &[Blender], &["glossind", "glossy indirect"], RGB),
    entry(Role::SpecularAlbedo, &[Blender], &["glosscol", "glossy color"], RGB),
    of(Role::Emission, Input::EMISSION, RGB),
    entry(Role::Emission, &[Blender], &["emit", "emission"], RGB),
    entry(Role::Environment, &[Blender], &["env", "environment"], RGB),
    entry(Role::DemodulatedDirect, &[Blender], &["diffdir", "diffuse direct"], RGB),
    entry(Role::DiffuseColour, &[Blender], &["diffcol", "diffuse color"], RGB),
    entry(Role::Albedo, &[Blender], &["denoising albedo", "diffcol", "diffuse color"], RGB),
    of(Role::Albedo, Input::ALBEDO, RGB),
    entry(Role::Normal, &[Blender], &["normal", "denoising normal"], XYZ),
    entry(Role::Normal, &[Mitsuba], &["sh_normal", "nn", "shading_normal", "normal", "normals", "geo_normal"], XYZ),
    entry(Role::Normal, &[Pbrt], &["ns", "n"], XYZ),
    of(Role::Normal, Input::NORMAL, XYZ),
    of(Role::ObjectNormal, Input::OBJECT_NORMAL, XYZ),
    entry(Role::Depth, &[Blender], &["depth", "z", "denoising depth"], DEPTH),
    of(Role::Depth, Input::DEPTH, DEPTH),
    entry(Role::Position, &[], &["position", "pos", "p"], XYZ),
    entry(Role::Motion, &[Blender], &["vector"], XY),
    of(Role::Motion, Input::MOTION, XY),
    entry(Role::MotionDepth, &[Atrous], &["mv"], &[&["Z"]]),
    entry(Role::PreviousDepth, &[Atrous], &["prevz"], DEPTH),
    entry(Role::Id, &[Blender], &["indexob", "object index"], ID),
    entry(Role::Id, &[Mitsuba], &["shape_index", "shape_idx", "shape", "idx"], ID),
    of(Role::Id, Input::SURFACE_ID, ID),
    of(Role::MaterialClass, Input::MATERIAL_CLASS, ID),
    of(Role::Roughness, Input::ROUGHNESS, DEPTH),
    entry(Role::Reference, &[], &["ref", "reference"], RGB),
    entry(Role::ReshadeDirect, &[Atrous], &["reshade_direct"], RGB),
    entry(Role::ReshadeIndirect, &[Atrous], &["reshade_indirect"], RGB),
    entry(Role::ReshadeEmission, &[Atrous], &["reshade_emission"], RGB),
    of(Role::Reshaded, Input::RESHADED_RADIANCE, RGB),
    of(Role::ForwardMotion, Input::FORWARD_MOTION, XYZ),
    of(Role::SparseGradient, Input::SPARSE_GRADIENT, XY),
    of(Role::Confidence, Input::CONFIDENCE, DEPTH),
    of(Role::Volume, Input::NOISY_VOLUME, RGB),
    entry(Role::Volume, &[Blender], &["volumedir", "volume direct"], RGB),
    entry(Role::VolumeIndirect, &[Blender], &["volumeind", "volume indirect"], RGB),
    of(Role::ScatteringDepth, Input::SCATTERING_DEPTH, DEPTH),
    of(Role::Ambient, Input::NOISY_AMBIENT, DEPTH),
    of(Role::AmbientDistance, Input::AMBIENT_DISTANCE, DEPTH),
    of(Role::Visibility(0), Input::NOISY_VISIBILITY[0], VISIBLE),
    of(Role::OccluderDistance(0), Input::OCCLUDER_DISTANCE[0], DEPTH),
    of(Role::OccluderId(0), Input::OCCLUDER_ID[0], ID),
    of(Role::OccluderMotion(0), Input::OCCLUDER_MOTION[0], XYZ),
    of(Role::UnshadowedDirect(0), Input::UNSHADOWED_DIRECT[0], RGB),
    of(Role::Visibility(1), Input::NOISY_VISIBILITY[1], VISIBLE),
    of(Role::OccluderDistance(1), Input::OCCLUDER_DISTANCE[1], DEPTH),
    of(Role::OccluderId(1), Input::OCCLUDER_ID[1], ID),
    of(Role::OccluderMotion(1), Input::OCCLUDER_MOTION[1], XYZ),
    of(Role::UnshadowedDirect(1), Input::UNSHADOWED_DIRECT[1], RGB),
    of(Role::Visibility(2), Input::NOISY_VISIBILITY[2], VISIBLE),
    of(Role::OccluderDistance(2), Input::OCCLUDER_DISTANCE[2], DEPTH),
    of(Role::OccluderId(2), Input::OCCLUDER_ID[2], ID),
    of(Role::OccluderMotion(2), Input::OCCLUDER_MOTION[2], XYZ),
    of(Role::UnshadowedDirect(2), Input::UNSHADOWED_DIRECT[2], RGB),
    of(Role::Visibility(3), Input::NOISY_VISIBILITY[3], VISIBLE),
    of(Role::OccluderDistance(3), Input::OCCLUDER_DISTANCE[3], DEPTH),
    of(Role::OccluderId(3), Input::OCCLUDER_ID[3], ID),
    of(Role::OccluderMotion(3), Input::OCCLUDER_MOTION[3], XYZ),
    of(Role::UnshadowedDirect(3), Input::UNSHADOWED_DIRECT[3], RGB),
    of(Role::OtherDenoised, Input::OTHER_DENOISED_RADIANCE, RGB),
];

/// What tells a layout: last parts of layers, whole channels, and the start of an attribute's text.
/// One of them proves nothing: names are copied, and `P` is a position to many.
struct Marks {
    layout: Layout,
    /// Without one of these layers it is another layout. Empty: none is needed.
    needed: &'static [&'static str],
    layers: &'static [&'static str],
    channels: &'static [&'static str],
    attribute: &'static str,
}

const MARKS: &[Marks] = &[
    Marks {
        layout: Atrous,
        needed: &["noisy"],
        layers: &[
            "noisy",
            "lighting",
            "direct",
            "indirect",
            "diffuse",
            "specular",
            "specular_albedo",
            "emission",
            "albedo",
            "normal",
            "object_normal",
            "depth",
            "prevz",
            "mv",
            "id",
            "roughness",
            "hitdist",
            "ref",
            "visibility",
            "volume",
        ],
        channels: &[],
        attribute: "",
    },
    Marks {
        layout: Blender,
        needed: &["combined", "noisy image"],
        layers: &[
            "combined",
            "noisy image",
            "depth",
            "normal",
            "vector",
            "position",
            "mist",
            "indexob",
            "indexma",
            "diffdir",
            "diffind",
            "diffcol",
            "glossdir",
            "glossind",
            "glosscol",
            "transdir",
            "transind",
            "transcol",
            "volumedir",
            "volumeind",
            "emit",
            "env",
            "ao",
            "denoising albedo",
            "denoising normal",
            "denoising depth",
            "object index",
            "diffuse direct",
            "diffuse color",
            "glossy direct",
            "glossy color",
            "emission",
            "environment",
        ],
        channels: &[],
        attribute: "BlenderMultiChannel",
    },
    Marks {
        layout: Pbrt,
        needed: &[],
        layers: &["ns", "variance", "relativevariance"],
        channels: &["u", "v", "dzdx", "dzdy", "dudx", "dudy", "dvdx", "dvdy"],
        attribute: "",
    },
    Marks {
        layout: Mitsuba,
        needed: &[],
        layers: &["sh_normal", "nn", "geo_normal", "shape_index", "prim_index", "dd", "dd.y", "dp_du", "dp_dv", "duv_dx"],
        channels: &["depth.t", "dd.t", "dd.y.t"],
        attribute: "generatedBy=Mitsuba",
    },
];

/// The layout of these channels: more than one mark tells it. `layers` and `channels` are in lower
/// case; `attributes` are `name=text`.
pub fn recognise(layers: &[String], channels: &[String], attributes: &[String]) -> Layout {
    let has_layer = |w: &str| layers.iter().any(|l| l == w || l.strip_suffix(w).is_some_and(|rest| rest.ends_with('.')));
    let fits = |marks: &&Marks| {
        let layers = marks.layers.iter().filter(|w| has_layer(w)).count();
        let channels = marks.channels.iter().filter(|w| channels.iter().any(|c| c == *w)).count();
        let told = !marks.attribute.is_empty() && attributes.iter().any(|a| a.starts_with(marks.attribute));
        let is_possible = marks.needed.is_empty() || marks.needed.iter().any(|w| has_layer(w));
        is_possible && layers + channels + usize::from(told) > 1
    };
    MARKS.iter().find(fits).map_or(Plain, |marks| marks.layout)
}
