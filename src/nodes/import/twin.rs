//! The stage `import`: the host's depth, normals and motion into one packed encoding. The only stage that knows the host's
//! conventions.

use crate::nodes::demodulate::twin::is_apart;
use crate::reference::bindings::Bindings;
use crate::reference::compare::{Reading, Rule, Tolerance, Unit};
use crate::reference::conventions::{normal_encoding, normals_are_in_view_space, roughness_channel};
use crate::reference::guide::{fold_id, pack_guide, Surface};
use crate::reference::octahedral::{decode_normal, octahedral10};
use crate::reference::projection::Projections;
use crate::reference::reflection::is_roughness;
use crate::reference::reprojection::{previous_normal, reproject, transform_of, HostMotion, InstanceTransform};
use crate::reference::rules::{rule, STATISTICS, STEP};
use crate::reference::statistics::count;
use crate::reference::surface_motion::pack_surface_motion;
use crate::reference::{render_rect::RenderRect, Image};
use crate::{Counter, Statistics};
use crate::{Error, FrameConstants};
use glam::{IVec2, UVec2, Vec2, Vec3};
use std::borrow::Cow;

#[cfg(test)]
mod motion_tests;
#[cfg(test)]
mod tests;

/// Normals that are shorter have no direction.
const SMALLEST_LENGTH_SQUARED: f32 = 1e-8;

/// Guides of the host; images have the allocated extent.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ImportInputs<'a> {
    /// x: depth, in the encoding of [`crate::config::Conventions`].
    pub depth: &'a Image<[f32; 4]>,
    /// xyz or octahedral xy, in the encoding and space of the conventions.
    pub normal: &'a Image<[f32; 4]>,
    /// xy: motion, z: depth of 2.5D motion; in the unit and sign of the conventions. Without it motion follows from the matrices.
    pub motion: Option<&'a Image<[f32; 4]>>,
    /// xyz in object space: the history test's normals for a turning object.
    pub object_normal: Option<&'a Image<[f32; 4]>>,
    /// Stable per instance, 0 is the background.
    pub surface_id: Option<&'a Image<u32>>,
    /// Linear reflectance, which light is divided by.
    pub albedo: Option<&'a Image<[f32; 4]>>,
    /// Roughness, 0 to 1, or −1 where it is not known, in the channel of the conventions.
    pub roughness: Option<&'a Image<[f32; 4]>>,
    /// Transforms of the host's instances by surface id; instances beyond the end, and those with an entry that is not finite, did
    /// not move.
    pub instance_transforms: Option<&'a [InstanceTransform]>,
}

impl<'a> ImportInputs<'a> {
    /// Inputs that every host gives, without anything optional.
    pub(crate) const fn new(depth: &'a Image<[f32; 4]>, normal: &'a Image<[f32; 4]>) -> Self {
        Self {
            depth,
            normal,
            motion: None,
            object_normal: None,
            surface_id: None,
            albedo: None,
            roughness: None,
            instance_transforms: None,
        }
    }
}

impl ImportInputs<'_> {
    fn id(&self, p: IVec2) -> Option<u32> {
        self.surface_id.map(|ids| ids.at(p))
    }

    fn transform(&self, id: Option<u32>) -> Option<&InstanceTransform> {
        transform_of(self.instance_transforms?, id?)
    }
}

/// Guides as the filters read them.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct ImportOutputs {
    /// Depth with its gradient, normal and id, see [`crate::reference::guide::unpack_guide`].
    pub guide: Image<[u16; 4]>,
    /// Motion and expected previous depth and normal, see [`crate::reference::surface_motion::unpack_surface_motion`].
    pub surface_motion: Image<[u16; 4]>,
    /// Object-space normals, see [`crate::reference::octahedral10`]; where the host gives them.
    pub object_normal_guide: Option<Image<u32>>,
    /// Bad depths, normals and motions.
    pub statistics: Statistics,
}

#[derive(Clone, Copy, Default)]
struct Texel {
    guide: [u16; 4],
    surface_motion: [u16; 4],
    is_depth_bad: bool,
    is_normal_bad: bool,
    is_roughness_bad: bool,
    is_motion_bad: bool,
}

/// Imports the host's guides of one frame: for each pixel of light those of the pixel that it was traced for.
pub(crate) fn import(frame: &FrameConstants, inputs: &ImportInputs) -> ImportOutputs {
    let (guides, of_guides) = (inputs.depth.extent(), frame.of_guides());
    let extent = [0, 1].map(|i| guides[i] / frame.light_ratio[i].max(1));
    let projections = Projections::new(&of_guides);
    let depths = Image::compute(guides, of_guides.render_extent, |p| {
        projections.linear_depth(p.into(), inputs.depth.at(p)[0], frame.background_depth)
    });
    let texels = Image::compute(extent, frame.render_extent, |p| texel(frame, inputs, &projections, &depths, frame.guide_pixel(p)));
    let mut statistics = Statistics::default();
    statistics[Counter::Depth] = count(texels.texels().iter().map(|t| t.is_depth_bad));
    statistics[Counter::Normal] = count(texels.texels().iter().map(|t| t.is_normal_bad));
    statistics[Counter::Roughness] = count(texels.texels().iter().map(|t| t.is_roughness_bad));
    statistics[Counter::Motion] = count(texels.texels().iter().map(|t| t.is_motion_bad));
    let object_normal_of =
        |normals: &Image<[f32; 4]>, p: IVec2| octahedral10(object_normal(normals.at(frame.guide_pixel(p))).to_array());
    ImportOutputs {
        guide: texels.map(|t| t.guide),
        surface_motion: texels.map(|t| t.surface_motion),
        object_normal_guide: inputs
            .object_normal
            .map(|normals| Image::compute(extent, frame.render_extent, |p| object_normal_of(normals, p))),
        statistics,
    }
}

/// The guide of every rendered pixel: where light has fewer, of the host's images that a pass binds; else of the image `guide`.
pub(crate) fn rendered_guide<'a>(b: &'a Bindings, apart: bool) -> Result<Cow<'a, Image<[u16; 4]>>, Error> {
    let Some(depth) = b.optional_colour("depth")? else { return Ok(Cow::Borrowed(b.packed("guide")?)) };
    let inputs = ImportInputs {
        surface_id: b.optional_uint("surface_id")?,
        albedo: b.optional_colour("albedo")?.filter(|_| apart),
        // Without normals, a pass that reads depth alone.
        ..ImportInputs::new(depth, b.optional_colour("normal")?.unwrap_or(depth))
    };
    let frame = b.frame.of_guides();
    let projections = Projections::new(&frame);
    Ok(Cow::Owned(Image::compute(depth.extent(), frame.render_extent, |p| {
        pack_guide(&surface_of(&frame, &inputs, &projections, p).0)
    })))
}

/// The surface of a pixel of the guides without the gradient of its depth, with whether its normal and its roughness were bad.
pub(crate) fn surface_of(
    frame: &FrameConstants,
    inputs: &ImportInputs,
    projections: &Projections,
    p: IVec2,
) -> (Surface, bool, bool) {
    let id = inputs.id(p);
    let (linear_depth, _) = projections.linear_depth(p.into(), inputs.depth.at(p)[0], frame.background_depth);
    if linear_depth == 0.0 || id == Some(0) {
        return (Surface::default(), false, false);
    }
    let (normal, is_normal_bad) = world_normal(frame, projections, inputs.normal.at(p));
    let roughness = inputs.roughness.map_or(1.0, |r| r.at(p)[roughness_channel(frame)]);
    let surface = Surface {
        linear_depth,
        is_apart: inputs.albedo.is_some_and(|albedo| is_apart(albedo.at(p))),
        normal: normal.to_array(),
        gradient: [0.0; 2],
        // Id 0 is the background's, so that a host without ids has one surface.
        id: id.map_or(1, fold_id),
    };
    (surface, is_normal_bad, !is_roughness(roughness))
}

/// The texel of a pixel of the guides, in pixels of light.
fn texel(frame: &FrameConstants, inputs: &ImportInputs, projections: &Projections, depths: &Image<(f32, bool)>, p: IVec2) -> Texel {
    let (of_guides, ratio) = (frame.of_guides(), UVec2::from(frame.light_ratio).as_vec2());
    let (surface, is_normal_bad, is_roughness_bad) = surface_of(&of_guides, inputs, projections, p);
    let is_depth_bad = depths.at(p).1;
    let transform = if surface.is_background() { None } else { inputs.transform(inputs.id(p)) };
    let host = HostMotion { texel: inputs.motion.map(|m| m.at(p)), transform };
    let reprojection = reproject(&of_guides, projections, p, surface.linear_depth, host);
    let motion = (reprojection.motion / ratio).to_array();
    let is_motion_bad = reprojection.is_bad;
    if surface.is_background() {
        // Motion matters in the background as well: temporal anti-aliasing follows the sky.
        let surface_motion = pack_surface_motion(motion, None);
        return Texel { surface_motion, is_motion_bad, is_depth_bad, ..Texel::default() };
    }
    let expected = previous_normal(surface.normal.into(), transform).to_array();
    let gradient = Vec2::from([IVec2::X, IVec2::Y].map(|axis| depth_difference(&of_guides, depths, p, axis)));
    Texel {
        guide: pack_guide(&Surface { gradient: (gradient * ratio).to_array(), ..surface }),
        surface_motion: pack_surface_motion(motion, Some((reprojection.depth_ratio, expected))),
        is_depth_bad,
        is_normal_bad,
        is_roughness_bad,
        is_motion_bad,
    }
}

/// The world-space unit normal of a texel, with whether it was not finite.
fn world_normal(frame: &FrameConstants, projections: &Projections, v: [f32; 4]) -> (Vec3, bool) {
    let n = decode_normal(normal_encoding(frame), v);
    let n = Vec3::from(if normals_are_in_view_space(frame) { projections.world_direction(n) } else { n });
    // The squared length also is not finite where a component is, or is too large to be squared.
    let length_squared = n.length_squared();
    if length_squared.is_finite() && length_squared >= SMALLEST_LENGTH_SQUARED {
        (n / length_squared.sqrt(), false)
    } else {
        (projections.towards_camera().into(), !length_squared.is_finite())
    }
}

/// The object-space unit normal of a texel; +z where there is none, so that the test compares equal values.
fn object_normal([x, y, z, _]: [f32; 4]) -> Vec3 {
    let n = Vec3::new(x, y, z);
    let length_squared = n.length_squared();
    if length_squared.is_finite() && length_squared >= SMALLEST_LENGTH_SQUARED {
        n / length_squared.sqrt()
    } else {
        Vec3::Z
    }
}

/// ∂z along an axis: of the two one-sided differences the smaller one, since it does not look across an edge. The forward one where
/// both are equal.
fn depth_difference(frame: &FrameConstants, depths: &Image<(f32, bool)>, p: IVec2, axis: IVec2) -> f32 {
    let rect = RenderRect::new(frame.render_extent);
    let z = depths.at(p).0;
    let neighbour = |q: IVec2| (rect.contains(q) && depths.at(q).0 > 0.0).then(|| depths.at(q).0);
    let forward = neighbour(p + axis).map(|next| next - z);
    let backward = neighbour(p - axis).map(|before| z - before);
    match (forward, backward) {
        (Some(f), Some(b)) => {
            if f.abs() <= b.abs() {
                f
            } else {
                b
            }
        }
        (Some(difference), None) | (None, Some(difference)) => difference,
        (None, None) => 0.0,
    }
}

/// As above, with the guide's grid of 1/127, and of depths with a mantissa of 12 bits.
const GUIDE_STEP: Tolerance = Tolerance { relative: 2.5e-4, absolute: 8e-3, ..STEP };

/// A step of the stored sum, and of the stored direction.
const GRADIENT_STEP: Tolerance = Tolerance { relative: 0.26, absolute: 0.032, ..STEP };

const MOTION: Tolerance = Tolerance { relative: 1.5e-3, absolute: 2e-3, outliers: 0.0 };

/// A guide of the host's images.
pub(crate) const GUIDE: Rule = rule("guide", Unit::Pixel, Reading::Guide, GUIDE_STEP);

/// How what it writes is compared with the GPU.
pub(crate) const RULES: &[Rule] = &[
    STATISTICS,
    GUIDE,
    rule("surface_motion", Unit::Pixel, Reading::PreviousNormal, Tolerance { absolute: 2e-2, ..STEP }),
    rule("surface_motion", Unit::Pixel, Reading::SurfaceMotion, MOTION),
    rule("guide", Unit::Pixel, Reading::GuideGradient, GRADIENT_STEP),
    rule("object_normal_guide", Unit::Pixel, Reading::Normal, STEP),
];

/// Runs the stage on the bindings of a pass.
pub(crate) fn twin(b: &mut Bindings) -> Result<(), Error> {
    let transforms = b.instance_transforms()?;
    let inputs = ImportInputs {
        motion: b.optional_colour("motion")?,
        object_normal: b.optional_colour("object_normal")?,
        surface_id: b.optional_uint("surface_id")?,
        albedo: b.optional_colour("albedo")?,
        roughness: b.optional_colour("roughness")?,
        instance_transforms: transforms.as_deref(),
        ..ImportInputs::new(b.colour("depth")?, b.colour("normal")?)
    };
    let outputs = import(b.frame, &inputs);
    b.count(&outputs.statistics)?;
    b.write("guide", outputs.guide)?;
    b.write("surface_motion", outputs.surface_motion)?;
    match outputs.object_normal_guide {
        Some(normals) if b.has("object_normal_guide") => b.write("object_normal_guide", normals),
        _ => Ok(()),
    }
}
