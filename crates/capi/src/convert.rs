//! Conversions between the structs of the ABI and those of the crate.

use crate::status::Failure;
use crate::structs::{AtrousFrameParams, AtrousName, AtrousPass, AtrousResource, AtrousUse, ATROUS_NAME_SIZE};
use ash::vk;
use atrous::config::EawWeights;
use atrous::contract::{Component, Declaration, ImageFormat, Lifetime, Phase, ResourceId, Shape, Use, UseFrame};
use atrous::{Choice, FrameParams};
use std::ffi::c_char;

/// The value of a field that is a choice.
pub(super) fn choice<T: Choice>(field: &str, given: u32) -> Result<T, Failure> {
    T::try_from(given).map_err(|_| unknown(field, given, &numbers::<T>(0)))
}

/// The value of a field that may be 0, none.
pub(super) fn choice_or_none<T: Choice>(field: &str, given: u32) -> Result<Option<T>, Failure> {
    match given {
        0 => Ok(None),
        _ => T::try_from(given - shift::<T>()).map(Some).map_err(|_| unknown(field, given, &allowed_or_none::<T>())),
    }
}

/// `0 (svgf), 1 (asvgf), ...`; `shift` is added to every number.
fn numbers<T: Choice>(shift: u32) -> String {
    let one = |value: &T| format!("{} ({})", value.number() + shift, value.name());
    T::ALL.iter().map(one).collect::<Vec<_>>().join(", ")
}

pub(super) fn allowed_or_none<T: Choice>() -> String {
    format!("0 (none), {}", numbers::<T>(shift::<T>()))
}

/// A choice that has a number 0 itself is passed as its number plus 1, where 0 is none.
fn shift<T: Choice>() -> u32 {
    T::ALL.iter().any(|value| value.number() == 0).into()
}

pub(super) fn phase(given: u32) -> Result<Phase, Failure> {
    let missing = || unknown("phase", given, "0 (before lighting), 1 (after lighting), 2 (post-process)");
    Phase::ALL.get(given as usize).copied().ok_or_else(missing)
}

pub(super) fn flag(field: &str, given: u32) -> Result<bool, Failure> {
    match given {
        0 => Ok(false),
        1 => Ok(true),
        _ => Err(unknown(field, given, "0 (no), 1 (yes)")),
    }
}

fn unknown(field: &str, given: u32, allowed: &str) -> Failure {
    Failure::argument(format!("{field} is {given}; allowed: {allowed}"))
}

pub(super) fn eaw_weights(bits: u32) -> Result<EawWeights, Failure> {
    let names = || (0..).zip(EawWeights::NAMES).map(|(bit, name)| format!("{} ({name})", 1 << bit)).collect::<Vec<_>>().join(", ");
    EawWeights::from_bits(bits).ok_or_else(|| unknown("eaw_weights", bits, &format!("the sum of any of {}", names())))
}

fn matrix(m: [f32; 16]) -> [[f32; 4]; 4] {
    std::array::from_fn(|column| std::array::from_fn(|row| m[column * 4 + row]))
}

impl AtrousFrameParams {
    pub(super) fn to_params(self) -> Result<FrameParams, Failure> {
        Ok(FrameParams {
            frame_slot: self.frame_slot,
            reset: choice_or_none("reset", self.reset)?,
            view_from_world: matrix(self.view_from_world),
            clip_from_view: matrix(self.clip_from_view),
            jitter: self.jitter,
            exposure_ratio: self.exposure_ratio,
            reshaded: flag("reshaded", self.reshaded)?,
            debug_view: choice_or_none("debug_view", self.debug_view)?,
            complete_frames: Some(self.complete_frames).filter(|count| *count != u64::MAX),
            lights: matrix(self.lights),
            light_offset: self.light_offset,
            viewport_origin: self.viewport_origin,
            materials: std::array::from_fn(|class| std::array::from_fn(|i| self.materials[4 * class + i]).into()),
            output_extent: (self.output_extent != [0; 2]).then_some(self.output_extent),
            ..FrameParams::new([self.render_width, self.render_height])
        })
    }

    pub(super) fn default_for([render_width, render_height]: [u32; 2]) -> Self {
        let mut identity = [0.0; 16];
        identity.iter_mut().step_by(5).for_each(|v| *v = 1.0);
        Self {
            struct_size: size_of::<Self>() as u32,
            frame_slot: 0,
            reset: 0,
            render_width,
            render_height,
            view_from_world: identity,
            clip_from_view: identity,
            jitter: [0.0; 2],
            exposure_ratio: 1.0,
            reshaded: 0,
            debug_view: 0,
            complete_frames: u64::MAX,
            lights: [0.0; 16],
            light_offset: [0; 2],
            viewport_origin: [0; 2],
            output_extent: [0; 2],
            materials: std::array::from_fn(|i| if i % 4 == 3 { 1024.0 } else { 1.0 }),
        }
    }
}

/// The name with a null behind it; what is too long is cut, and a test checks that none is.
pub(super) fn name(text: &str) -> AtrousName {
    let mut name = [0; ATROUS_NAME_SIZE];
    for (to, from) in name.iter_mut().zip(text.bytes()).take(ATROUS_NAME_SIZE - 1) {
        *to = from as c_char;
    }
    name
}

pub(super) fn resource(declaration: &Declaration, id: ResourceId) -> AtrousResource {
    let decl = declaration.resource(id);
    let setup = declaration.setup();
    let (kind, format_class, format) = match decl.shape {
        Shape::Image { format: ImageFormat::Exactly(format), .. } => (0, 0, format),
        Shape::Image { format: ImageFormat::Any(Component::Float, format), .. } => (0, 1, format),
        Shape::Image { format: ImageFormat::Any(Component::Uint, format), .. } => (0, 2, format),
        Shape::Buffer { .. } => (1, 0, vk::Format::UNDEFINED),
    };
    let [width, height] = decl.extent(setup).unwrap_or_default();
    let (lifetime, optional) = match decl.lifetime {
        Lifetime::Input { optional } => (0, optional),
        Lifetime::Output => (1, false),
        Lifetime::Transient => (2, false),
        Lifetime::History => (3, false),
        Lifetime::HistoryInPlace => (4, false),
    };
    let (first, last) = declaration.life(id).unwrap_or_default();
    AtrousResource {
        struct_size: size_of::<AtrousResource>() as u32,
        kind,
        lifetime,
        copies: decl.lifetime.copies() as u32,
        optional: optional.into(),
        format_class,
        format,
        width,
        height,
        image_usage: decl.image_usage,
        buffer_usage: decl.buffer_usage,
        first_pass: first as u32,
        last_pass: last as u32,
        bytes: decl.bytes(setup),
        name: name(&decl.name),
    }
}

fn one_use(u: &Use) -> AtrousUse {
    let (image, (legacy_stage, legacy_access_mask)) = (u.access.image(), u.access.legacy_scope());
    AtrousUse {
        resource: u.resource.0,
        previous: (u.frame == UseFrame::Previous).into(),
        access: u.access as u32,
        reads: u.access.reads().into(),
        writes: u.access.writes().into(),
        layout: image.layout,
        stage: image.stage,
        access_mask: image.access,
        legacy_stage,
        legacy_access_mask,
    }
}

const NO_USE: AtrousUse = AtrousUse {
    resource: u32::MAX,
    previous: 0,
    access: 0,
    reads: 0,
    writes: 0,
    layout: vk::ImageLayout::UNDEFINED,
    stage: vk::PipelineStageFlags2::NONE,
    access_mask: vk::AccessFlags2::NONE,
    legacy_stage: vk::PipelineStageFlags::empty(),
    legacy_access_mask: vk::AccessFlags::empty(),
};

pub(super) fn pass(declaration: &Declaration, index: usize) -> Option<AtrousPass> {
    let decl = declaration.passes().get(index)?;
    let mut pass = AtrousPass {
        struct_size: size_of::<AtrousPass>() as u32,
        phase: decl.phase as u32,
        use_count: decl.uses.len() as u32,
        uses: [NO_USE; crate::ATROUS_MAX_USES],
        name: name(&decl.name),
    };
    for (to, from) in pass.uses.iter_mut().zip(&decl.uses) {
        *to = one_use(from);
    }
    Some(pass)
}
