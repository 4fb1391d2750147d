//! One frame as the library takes it.

use crate::camera::Camera;
use crate::error::{Result, ToolError};
use crate::exr_header::ExrHeader;
use crate::frame_files::FrameFiles;
use crate::frame_images::{rgb, Channels, Texels};
use crate::frame_source::{self, First};
use crate::gaps;
use crate::lobes::{self, Told};
use crate::memory;
use crate::negative;
use crate::paths::Through;
use crate::range::Excess;
use crate::raster::Raster;
use crate::roles::Role;
use crate::sampling::Pattern;
use crate::setup::{is_about_previous, Setup};
use crate::smooth::smooth;
use atrous::config::Preset;
use atrous::reference::InstanceTransform;
use atrous::{FrameParams, Input, ResetReason, Tuning};
use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::path::Path;

/// Largest file with transforms that is read: ten million instances.
const MAX_TRANSFORMS: u64 = 10_000_000 * size_of::<InstanceTransform>() as u64;

/// Images with the noise that is filtered.
pub(crate) const NOISY: [&str; 5] = ["noisy_radiance", "noisy_direct", "noisy_indirect", "noisy_diffuse", "noisy_specular"];

/// Inputs of a frame.
#[derive(Debug)]
pub struct FrameInputs {
    /// Number in the name of the file.
    pub number: u64,
    /// What it counts as: the number that the choice of re-shaded pixels depends on.
    pub index: u64,
    /// Per-frame parameters.
    pub params: FrameParams,
    /// Input images by the names that the library has for them.
    pub images: BTreeMap<&'static str, Texels>,
    /// Tunables.
    pub tuning: Tuning,
    /// Transforms by surface id, previous from current world space.
    pub instance_transforms: Option<Vec<InstanceTransform>>,
    /// Surface ids.
    pub surface_id: Option<Vec<u32>>,
    /// What is seen through flat glass, where that is known.
    pub through: Option<Through>,
    /// Classes of materials.
    pub material_class: Option<Vec<u32>>,
    /// Surface ids of what is seen in the surfaces.
    pub hit_id: Option<Vec<u32>>,
    /// Surface ids of what casts the shadows.
    pub occluder_ids: [Option<Vec<u32>>; 4],
    /// The noisy radiance with everything in it, for scores and pictures.
    pub noisy: Vec<[f32; 3]>,
    /// Alpha of the beauty, which is passed through.
    pub alpha: Option<Vec<f32>>,
    /// The converged image.
    pub reference: Option<Vec<[f32; 3]>>,
    /// Values that were not finite and became 0, by role.
    pub replaced: BTreeMap<Role, usize>,
    /// Light that is beyond the range of the filter.
    pub excess: Excess,
    /// Pixels with negative light.
    pub negative: usize,
    /// Header of the file with the colour.
    pub header: ExrHeader,
}

/// The channels of a frame that the setup takes.
pub fn channels<'a>(files: &FrameFiles, setup: &'a Setup) -> Result<(Channels<'a>, ExrHeader)> {
    let reshaded = setup.config.preset.has_gradients();
    let is_wanted = |role: Role| reshaded || !is_about_previous(role);
    let roles = setup.mapping.roles.iter().filter(|(role, _)| is_wanted(**role));
    let wanted: BTreeSet<&str> = roles.flat_map(|(_, names)| names).map(String::as_str).collect();
    let first =
        First { extent: setup.config.allocated_extent, light: setup.config.light_extent, reading: memory::reading_limit(setup) };
    let planes = frame_source::read(files, &first, |name| wanted.contains(name))?;
    // The reference may be sparse: rendering it takes long.
    let optional = |role: Role| is_about_previous(role) || role == Role::Reference;
    setup.mapping.check(&files.colour, &planes.header, optional)?;
    Ok((Channels { setup, samples: planes.samples, replaced: BTreeMap::new() }, planes.header))
}

/// Reads a frame.
pub fn load(files: &FrameFiles, setup: &Setup) -> Result<FrameInputs> {
    let (mut channels, header) = channels(files, setup)?;
    let camera = setup.camera(files.number);
    let mut images = BTreeMap::new();
    fill(&mut channels, camera, &mut images);
    let params = FrameParams { light_offset: setup.light_offset(files.number), ..params(setup, camera) };
    let mut surface_id = channels.surface_ids(&images);
    if let Some((beyond, depths)) = setup.beyond.zip(images.get_mut("depth")) {
        let raster = Raster::new(setup.config.allocated_extent);
        gaps::fill(depths, surface_id.as_mut(), raster, setup.config.conventions.background_depth, beyond);
    }
    let instance_transforms = transforms(&files.colour)?;
    let has_camera = camera.is_some();
    let mut through = None;
    if setup.is_all_specular() {
        lobes::take_all(&mut images);
    }
    if setup.has_lobes {
        through = follow_paths(&mut channels, has_camera, &params, surface_id.as_deref(), &mut images);
        let kinds = lobes::part(&mut images, told(&channels, through.as_ref()));
        surface_id = match kinds {
            // Transforms are found by the ids as they are.
            Some(kinds) if instance_transforms.is_none() => Some(lobes::told_apart(surface_id, kinds)),
            _ => surface_id,
        };
    }
    // Lengths of normals tell outlines above.
    for (_, texels) in images.iter_mut().filter(|(name, _)| setup.smoothed.contains(*name)) {
        *texels = smooth(texels, setup.config.allocated_extent[0] as usize);
    }
    let negative = if setup.is_verbatim() { 0 } else { even_out(&mut images, setup) };
    let hit_id = channels.hit_ids(&images);
    if !setup.has_lobes {
        through = follow_paths(&mut channels, has_camera, &params, surface_id.as_deref(), &mut images);
    }
    let occluder_ids = std::array::from_fn(|light| channels.occluder_ids(&images, light));
    let noisy = channels.total(&images);
    let alpha = channels.scalars(Role::Alpha);
    let reference = channels.vectors(Role::Reference).map(rgb);
    let material_class = channels.classes();
    let replaced = channels.replaced;
    if noisy.len() != setup.pixels() {
        return Err(ToolError::exr(&files.colour, "its channels do not cover the picture"));
    }
    let far = setup.config.conventions.background_depth;
    let is_background = |i: usize| {
        let depth = images.get("depth").and_then(|depth: &Texels| depth.get(i)).map_or(1.0, |d| d[0]);
        surface_id.as_ref().is_some_and(|ids| ids.get(i) == Some(&0)) || depth.is_nan() || depth <= 0.0 || depth >= far
    };
    let background: Vec<bool> = (0..setup.pixels()).map(is_background).collect();
    let excess = match setup.is_verbatim() {
        true => Excess::default(),
        false => setup.range.scale(&mut images, |i| background[i]),
    };
    let mut inputs = FrameInputs {
        number: files.number,
        index: camera.map_or(files.number / setup.step, |camera| camera.index),
        params,
        tuning: setup.tuning(files.number)?,
        instance_transforms,
        images,
        surface_id,
        through,
        material_class,
        hit_id,
        occluder_ids,
        noisy,
        alpha,
        reference,
        replaced,
        excess,
        negative,
        header,
    };
    if let Some(pattern) = setup.keep_samples {
        drop_samples(pattern, &mut inputs, setup.config.allocated_extent[0] as usize);
    }
    Ok(inputs)
}

/// What tells surfaces that have no albedo of their own.
pub fn told(channels: &Channels<'_>, through: Option<&Through>) -> Told {
    let setup = channels.setup;
    // Black of an albedo for denoisers is paint.
    let none = || setup.mapping.is_for_denoisers(Role::Albedo).then(|| vec![false; setup.pixels()]);
    Told {
        raster: Raster::new(setup.config.allocated_extent),
        far: setup.config.conventions.background_depth,
        numbers: channels.shapes(),
        windows: through.and_then(|through| through.windows.clone()).or_else(none),
    }
}

/// [`Channels::follow_paths`] where cameras and ids are known.
fn follow_paths(
    channels: &mut Channels<'_>,
    has_camera: bool,
    params: &FrameParams,
    ids: Option<&[u32]>,
    images: &mut BTreeMap<&'static str, Texels>,
) -> Option<Through> {
    channels.follow_paths(params, ids.filter(|_| has_camera)?, images)
}

/// Evens out negative light. Returns the number of its pixels, in the image that has most.
fn even_out(images: &mut BTreeMap<&'static str, Texels>, setup: &Setup) -> usize {
    let width = setup.config.allocated_extent[0] as usize;
    let noisy = images.iter_mut().filter(|(name, _)| NOISY.contains(name));
    noisy.map(|(_, texels)| negative::even_out(texels, width)).max().unwrap_or_default()
}

fn fill(channels: &mut Channels<'_>, camera: Option<&Camera>, images: &mut BTreeMap<&'static str, Texels>) {
    let config = &channels.setup.config;
    channels.lighting(images);
    channels.guides(camera, images);
    if config.preset.has_gradients() {
        channels.reshaded(images);
        channels.gradients(images);
    }
    if config.volume || config.preset == Preset::Volume {
        images.extend(channels.volume().map(|v| ("noisy_volume", v)));
        images.extend(channels.vectors(Role::ScatteringDepth).map(|d| ("scattering_depth", d)));
    }
    if config.ambient_occlusion {
        images.extend(channels.vectors(Role::Ambient).map(|v| (Input::NOISY_AMBIENT.name, v)));
        images.extend(channels.vectors(Role::AmbientDistance).map(|d| (Input::AMBIENT_DISTANCE.name, d)));
    }
    for light in 0..config.visibility as usize {
        let given = [
            (Role::Visibility(light), Input::NOISY_VISIBILITY[light]),
            (Role::OccluderDistance(light), Input::OCCLUDER_DISTANCE[light]),
            (Role::OccluderMotion(light), Input::OCCLUDER_MOTION[light]),
            (Role::UnshadowedDirect(light), Input::UNSHADOWED_DIRECT[light]),
        ];
        for (role, input) in given {
            images.extend(channels.vectors(role).map(|texels| (input.name, texels)));
        }
    }
}

/// Brings the result of the filter back to what the file holds.
pub fn finish(inputs: &FrameInputs, setup: &Setup, radiance: &mut [[f32; 3]]) {
    if setup.is_verbatim() {
        return;
    }
    let size = setup.output_size();
    setup.range.restore(radiance, &inputs.excess, size);
    // Where nothing was rendered, nothing is, whatever the filter let in from beside.
    if inputs.alpha_is_coverage() {
        let dark = inputs.noisy.iter().zip(inputs.alpha.iter().flatten()).map(|(noisy, alpha)| *alpha == 0.0 && *noisy == [0.0; 3]);
        let dark: Vec<bool> = dark.collect();
        let dark = size.map_or(dark.clone(), |size| size.enlarged(&dark));
        radiance.iter_mut().zip(dark).filter(|(_, dark)| *dark).for_each(|(pixel, _)| *pixel = [0.0; 3]);
    }
}

impl FrameInputs {
    /// Whether there is no light where alpha is 0. Some write 0 everywhere.
    fn alpha_is_coverage(&self) -> bool {
        let Some(alpha) = &self.alpha else { return false };
        let is_lit = |noisy: &[f32; 3]| noisy.iter().any(|v| *v > 0.0);
        let open: Vec<bool> = self.noisy.iter().zip(alpha).filter(|(_, a)| **a == 0.0).map(|(n, _)| is_lit(n)).collect();
        100 * open.iter().filter(|lit| **lit).count() <= open.len() && alpha.iter().any(|a| *a > 0.0)
    }
}

/// Takes the samples of the pixels that a pattern does not trace out of a frame. Re-shaded samples
/// stay: they are as dense as the renderer likes.
fn drop_samples(pattern: Pattern, inputs: &mut FrameInputs, width: usize) {
    let index = inputs.index;
    let dropped = |i: &usize| !pattern.keeps(index, (i % width) as u64, (i / width) as u64);
    for (_, texels) in inputs.images.iter_mut().filter(|(name, _)| NOISY.contains(name)) {
        (0..texels.len()).filter(dropped).for_each(|i| texels[i] = [f32::NAN; 4]);
    }
    (0..inputs.noisy.len()).filter(dropped).for_each(|i| inputs.noisy[i] = [0.0; 3]);
}

fn params(setup: &Setup, camera: Option<&Camera>) -> FrameParams {
    let mut params = FrameParams::new(setup.config.allocated_extent);
    if let Some(camera) = camera {
        params.view_from_world = camera.view_from_world;
        params.clip_from_view = setup.projection(camera.clip_from_view);
        params.jitter = camera.jitter;
        params.exposure_ratio = camera.exposure_ratio;
        params.reset = camera.reset;
        params.reshaded = camera.reshaded;
        params.lights = camera.lights;
        params.materials = camera.materials;
    }
    if setup.stills {
        params.reset = params.reset.or(Some(ResetReason::CameraCut));
    }
    params
}

/// The transforms of a captured frame, in a file beside its picture: twelve 32-bit floats an instance, little-endian.
fn transforms(colour: &Path) -> Result<Option<Vec<InstanceTransform>>> {
    let stem = colour.file_stem().unwrap_or_default().to_string_lossy();
    let path = colour.with_file_name(format!("{stem}_instance_transforms.f32"));
    let bytes = match atrous_files::read_regular(&path, MAX_TRANSFORMS) {
        Ok(bytes) => bytes,
        // No file can have a name that is too long for one.
        Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::InvalidFilename) => return Ok(None),
        Err(source) => return Err(ToolError::Read { path, source }),
    };
    if bytes.len() % size_of::<InstanceTransform>() != 0 {
        let problem = format!("has {} bytes, which is no multiple of the 48 of a transform: it is cut off", bytes.len());
        return Err(ToolError::exr(&path, problem));
    }
    let floats: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    Ok(Some(bytemuck::allocation::pod_collect_to_vec(&floats)))
}
