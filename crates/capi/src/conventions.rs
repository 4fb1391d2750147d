//! The convention self-test: see [`atrous_conventions`].

use crate::pointers::{read, write};
use crate::status::{guard, AtrousStatus, Failure};
use crate::structs::AtrousFrameParams;
use crate::AtrousConfig;
use atrous::reference::Image;
use atrous::{Config, Error};
use atrous_conventions::{check, Finding, OwnedGuides, Report};
use std::ffi::c_char;

/// Bytes of the text of a report, with its null.
pub const ATROUS_REPORT_SIZE: usize = 4096;

/// Your guides for one frame, read back: tightly packed rows of width texels, each four floats.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct AtrousGuides {
    /// sizeof(AtrousGuides).
    pub struct_size: u32,
    /// Width of the images; at least the render width.
    pub width: u32,
    /// Height of the images.
    pub height: u32,
    /// Matrices, jitter and render extent of the frame.
    pub params: *const AtrousFrameParams,
    /// x: depth. width * height * 4 floats.
    pub depth: *const f32,
    /// xyz, or octahedral xy. NULL: none.
    pub normal: *const f32,
    /// xy. NULL: none.
    pub motion: *const f32,
    /// One number a texel, 0 is the background. NULL: none.
    pub surface_id: *const u32,
}

/// Whether your guides and conventions agree. Verdicts: 0 as declared; 1 a mistake; 2 not as declared, and nothing known fits; 3 the
/// frames cannot tell; 4 not given.
#[derive(Clone, Copy)]
#[repr(C)]
pub struct AtrousConventionReport {
    /// sizeof(AtrousConventionReport), set by you.
    pub struct_size: u32,
    /// Verdict on depth, matrices and jitter.
    pub geometry: u32,
    /// Verdict on motion, x and y.
    pub motion: u32,
    /// Verdict on z of the motion.
    pub motion_depth: u32,
    /// Verdict on normals.
    pub normals: u32,
    /// The mistakes, the evidence in pixels and degrees, and the remedies.
    pub text: [c_char; ATROUS_REPORT_SIZE],
}

/// Tests whether depth, matrices, motion and normals of two consecutive frames agree with the
/// conventions in `config`, and names the likely mistake. Needs no denoiser and no device.
///
/// # Safety
/// Pointers are null or valid with their struct_size set; images have as many texels as their extent says.
#[no_mangle]
pub unsafe extern "C" fn atrous_check_conventions(
    config: *const AtrousConfig,
    previous: *const AtrousGuides,
    current: *const AtrousGuides,
    report: *mut AtrousConventionReport,
) -> AtrousStatus {
    guard(|| {
        // SAFETY: each of the pointers is null or points to a struct that begins with its size; the images of the guides have the
        // texels that their extent says.
        unsafe {
            write("report", report, || {
                let conventions = read("config", config)?.to_config()?.conventions;
                let frames = [read_guides("previous", previous)?, read_guides("current", current)?];
                Ok(flat(&check(&conventions, &frames[0].borrow(), &frames[1].borrow())?))
            })
        }
    })
}

/// # Safety
/// Obligations of [`atrous_check_conventions`].
unsafe fn read_guides(what: &str, pointer: *const AtrousGuides) -> Result<OwnedGuides, Failure> {
    // SAFETY: `pointer` is null or points to a struct that begins with its size, and its images are null or have as many texels
    // as the extent says.
    unsafe {
        let given = read(what, pointer)?;
        let extent = [given.width, given.height];
        if extent.iter().any(|side| !(1..=Config::MAX_SIDE).contains(side)) {
            return Err(Error::Extent { what: "width and height of AtrousGuides", given: extent, max: Config::MAX_SIDE }.into());
        }
        if given.depth.is_null() {
            return Err(Failure::argument(format!("{what}->depth is NULL; give the depth of the frame")));
        }
        Ok(OwnedGuides {
            params: read(&format!("{what}->params"), given.params)?.to_params()?,
            depth: image(given.depth.cast(), extent)?.unwrap_or_else(|| Image::new(extent, [0.0; 4])),
            normal: image(given.normal.cast(), extent)?,
            motion: image(given.motion.cast(), extent)?,
            surface_id: image(given.surface_id, extent)?,
        })
    }
}

/// Copies an image of the host, whose alignment is not trusted.
///
/// # Safety
/// `texels` is null, or points to as many texels as the extent has.
unsafe fn image<T: Copy>(texels: *const T, [width, height]: [u32; 2]) -> Result<Option<Image<T>>, Failure> {
    if texels.is_null() {
        return Ok(None);
    }
    let count = width as usize * height as usize;
    // SAFETY: `texels` is not null, so it points to `count` texels, and i is below that.
    let texels = (0..count).map(|i| unsafe { texels.add(i).read_unaligned() }).collect();
    Ok(Some(Image::from_texels([width, height], texels)?))
}

fn flat(report: &Report) -> AtrousConventionReport {
    let verdict = |finding: &Finding| finding.verdict as u32;
    let mut text = [0; ATROUS_REPORT_SIZE];
    for (to, from) in text.iter_mut().zip(report.to_string().bytes()).take(ATROUS_REPORT_SIZE - 1) {
        *to = from as c_char;
    }
    AtrousConventionReport {
        struct_size: size_of::<AtrousConventionReport>() as u32,
        geometry: verdict(&report.geometry),
        motion: verdict(&report.motion),
        motion_depth: verdict(&report.motion_depth),
        normals: verdict(&report.normals),
        text,
    }
}
