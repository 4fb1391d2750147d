//! One frame as the library takes it.

use crate::camera::Camera;
use crate::error::{Result, ToolError};
use crate::exr_header::ExrHeader;
use crate::frame_files::FrameFiles;
use crate::frame_images::{rgb, Channels, Texels};
use crate::frame_source::{self, First};
use crate::memory;
use crate::roles::Role;
use crate::setup::{is_about_previous, Setup};
use atrous::config::Preset;
use atrous::reference::InstanceTransform;
use atrous::{FrameParams, Tuning};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Largest file with transforms that is read: ten million instances.
const MAX_TRANSFORMS: u64 = 10_000_000 * size_of::<InstanceTransform>() as u64;

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
    /// The noisy radiance with everything in it, for scores and pictures.
    pub noisy: Vec<[f32; 3]>,
    /// Alpha of the beauty, which is passed through.
    pub alpha: Option<Vec<f32>>,
    /// The converged image.
    pub reference: Option<Vec<[f32; 3]>>,
    /// Values that were not finite and became 0, by role.
    pub replaced: BTreeMap<Role, usize>,
    /// Header of the file with the colour.
    pub header: ExrHeader,
}

/// Reads a frame.
pub fn load(files: &FrameFiles, setup: &Setup) -> Result<FrameInputs> {
    let reshaded = setup.config.preset.has_gradients();
    let wanted: BTreeSet<&str> =
        setup.mapping.roles.iter().filter(|r| reshaded || !is_about_previous(*r.0)).flat_map(|r| r.1).map(String::as_str).collect();
    let first = First { extent: setup.config.allocated_extent, reading: memory::reading_limit(setup) };
    let planes = frame_source::read(files, &first, |name| wanted.contains(name))?;
    // The reference may be sparse: rendering it takes long.
    let optional = |role: Role| is_about_previous(role) || role == Role::Reference;
    setup.mapping.check(&files.colour, &planes.header, optional)?;
    let mut channels = Channels { setup, samples: planes.samples, replaced: BTreeMap::new() };
    let camera = setup.camera(files.number);
    let mut images = BTreeMap::new();
    channels.lighting(&mut images);
    channels.guides(camera, &mut images);
    if reshaded {
        channels.reshaded(&mut images);
        channels.gradients(&mut images);
    }
    if setup.config.volume || setup.config.preset == Preset::Volume {
        images.extend(channels.vectors(Role::Volume).map(|v| ("noisy_volume", v)));
        images.extend(channels.vectors(Role::ScatteringDepth).map(|d| ("scattering_depth", d)));
    }
    if setup.config.visibility {
        images.extend(channels.vectors(Role::Visibility).map(|v| ("noisy_visibility", v)));
        images.extend(channels.vectors(Role::OccluderDistance).map(|d| ("occluder_distance", d)));
        images.extend(channels.vectors(Role::UnshadowedDirect).map(|l| ("unshadowed_direct", l)));
    }
    let surface_id = channels.ids(&images);
    let noisy = channels.total(&images);
    let alpha = channels.scalars(Role::Alpha);
    let reference = channels.vectors(Role::Reference).map(rgb);
    let replaced = channels.replaced;
    let params = params(setup, camera);
    if noisy.len() != setup.pixels() {
        return Err(ToolError::exr(&files.colour, "its channels do not cover the picture"));
    }
    let (number, tuning, instance_transforms) = (files.number, setup.tuning(files.number)?, transforms(&files.colour)?);
    let mut inputs = FrameInputs {
        number,
        index: camera.map_or(number, |camera| camera.index),
        params,
        tuning,
        instance_transforms,
        images,
        surface_id,
        noisy,
        alpha,
        reference,
        replaced,
        header: planes.header,
    };
    if let Some(pattern) = setup.sampling {
        pattern.drop_samples(&mut inputs, setup.config.allocated_extent[0] as usize);
    }
    Ok(inputs)
}

fn params(setup: &Setup, camera: Option<&Camera>) -> FrameParams {
    let mut params = FrameParams::new(setup.config.allocated_extent);
    if let Some(camera) = camera {
        params.view_from_world = camera.view_from_world;
        params.clip_from_view = camera.clip_from_view;
        params.jitter = camera.jitter;
        params.exposure_ratio = camera.exposure_ratio;
        params.reset = camera.reset;
        params.reshaded = camera.reshaded;
    }
    params
}

/// The transforms of a captured frame, in a file beside its picture: twelve 32-bit floats an instance, little-endian.
fn transforms(colour: &Path) -> Result<Option<Vec<InstanceTransform>>> {
    let stem = colour.file_stem().unwrap_or_default().to_string_lossy();
    let path = colour.with_file_name(format!("{stem}_instance_transforms.f32"));
    let bytes = match atrous_files::read_regular(&path, MAX_TRANSFORMS) {
        Ok(bytes) => bytes,
        Err(e) if e.kind() == std::io::ErrorKind::NotFound => return Ok(None),
        Err(source) => return Err(ToolError::Read { path, source }),
    };
    if bytes.len() % size_of::<InstanceTransform>() != 0 {
        let problem = format!("has {} bytes, which is no multiple of the 48 of a transform: it is cut off", bytes.len());
        return Err(ToolError::exr(&path, problem));
    }
    let floats: Vec<f32> = bytes.chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    Ok(Some(bytemuck::allocation::pod_collect_to_vec(&floats)))
}
