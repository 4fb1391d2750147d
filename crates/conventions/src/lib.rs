//! Test of the guides of two consecutive frames against the declared [`Conventions`], on demand.
//!
//! A wrong sign, unit, axis or matrix is the most common mistake of an integration, and all of them
//! look alike: ghosts, blur, boiling. So each encoding that differs from the declared one by a
//! single mistake is tested on the pixels of static geometry:
//!
//! - the **depth** of this frame, reprojected with the matrices, must be the depth of the previous frame;
//! - the **motion** must lead where depth and matrices lead, z of it to the depth there;
//! - the **normals** must be those of the surface that the depth makes.
//!
//! A pixel votes for the encoding that explains it where the declared one does not. A mistake is
//! named if it gets at least four of five votes. Moving objects, disocclusions and values that are
//! not finite are outvoted or have no vote. Frames that show no difference are reported as
//! inconclusive, and so are matrices if the camera stands still, whatever its jitter. Take two
//! frames between which the camera moves **and turns**, in a scene with slanted surfaces, with a
//! few pixels of motion, and with jitter on if the engine has jitter.
//!
//! The executor does so itself in the first frames, with `ExecutorOptions::check_guides` and `check_frames` of the feature `executor`.
//!
//! It runs on the CPU in a fraction of a second and needs no device. For frames of an engine, make
//! a capture (`Executor::capture`, feature `capture`) and run `cargo run --release -p
//! atrous-denoise -- FOLDER --check`. Or call it directly:
//!
//! ```
//! use atrous::config::{Conventions, MotionDirection, MotionUnit};
//! use atrous::reference::Image;
//! use atrous::FrameParams;
//! use atrous_conventions::{check, Guides, Verdict};
//! # use atrous_synthetic as synthetic;
//!
//! // What the engine reads back of two frames, four floats a texel.
//! # let frames = [1, 3].map(synthetic::Frame::new);
//! # let params = |i: usize| FrameParams {
//! #     view_from_world: synthetic::view_from_world([1, 3][i]),
//! #     clip_from_view: synthetic::clip_from_view(),
//! #     ..FrameParams::new(synthetic::EXTENT)
//! # };
//! # let image = |i: usize, name: usize| Image::from_texels(synthetic::EXTENT, frames[i].images[name].clone());
//! # let motion = Image::from_texels(synthetic::EXTENT, frames[1].images[2].iter().map(|m| m.map(|x| 2.0 * x)).collect())?;
//! let (depth, normal) = ([image(0, 0)?, image(1, 0)?], [image(0, 1)?, image(1, 1)?]);
//! let previous = Guides { params: params(0), depth: &depth[0], normal: Some(&normal[0]), motion: None, surface_id: None };
//! let current = Guides { params: params(1), depth: &depth[1], normal: Some(&normal[1]), motion: Some(&motion), surface_id: None };
//!
//! let declared = Conventions { motion_direction: MotionDirection::CurrentMinusPrevious, ..Conventions::default() };
//! let report = check(&declared, &previous, &current)?;
//! println!("{report}");
//! assert_eq!(report.motion.verdict, Verdict::Mistake);
//! assert_eq!(report.motion.mistake, "the motion has the opposite sign");
//! assert_eq!(report.conventions.motion_direction, MotionDirection::PreviousMinusCurrent);
//! # Ok::<(), atrous::Error>(())
//! ```

#![forbid(unsafe_code)]
// A host's input is answered by an error. Tests may panic.
#![cfg_attr(not(test), deny(clippy::unwrap_used, clippy::expect_used, clippy::panic))]

mod contest;
mod evidence;
#[cfg(feature = "executor")]
mod first_frames;
mod geometry;
mod motion_depth;
mod readings;
mod report;
mod trial;

#[cfg(test)]
mod tests;

#[cfg(feature = "executor")]
pub use first_frames::check_frames;
pub use report::{Evidence, Finding, Measure, Report, Verdict};

use atrous::config::Conventions;
use atrous::reference::Image;
use atrous::{Error, FrameParams};
use evidence::Pair;
use geometry::Geometry;
use glam::IVec2;
use trial::Trial;

/// Your guides for one frame. Images have one extent, at least the render extent, and the encodings
/// of the conventions.
#[derive(Clone, Copy, Debug)]
pub struct Guides<'a> {
    /// Matrices, jitter, render extent. `frame_slot` does not matter; the current frame must not be a reset.
    pub params: FrameParams,
    /// x: depth.
    pub depth: &'a Image<[f32; 4]>,
    /// xyz, or octahedral xy. Only those of the current frame are read.
    pub normal: Option<&'a Image<[f32; 4]>>,
    /// xy, and z by `Conventions::motion_depth`. Only that of the current frame is read.
    pub motion: Option<&'a Image<[f32; 4]>>,
    /// 0 is the background. Without it edges are found by depth alone.
    pub surface_id: Option<&'a Image<u32>>,
}

/// Guides that own their images, if you load or copy them. Fields as in [`Guides`].
#[derive(Clone, Debug)]
#[allow(missing_docs)]
pub struct OwnedGuides {
    pub params: FrameParams,
    pub depth: Image<[f32; 4]>,
    pub normal: Option<Image<[f32; 4]>>,
    pub motion: Option<Image<[f32; 4]>>,
    pub surface_id: Option<Image<u32>>,
}

impl OwnedGuides {
    /// The guides as [`check`] takes them.
    pub fn borrow(&self) -> Guides<'_> {
        let Self { params, depth, normal, motion, surface_id } = self;
        let (normal, motion, surface_id) = (normal.as_ref(), motion.as_ref(), surface_id.as_ref());
        Guides { params: *params, depth, normal, motion, surface_id }
    }
}

/// The texel of a pixel; zero outside the image.
fn at<T: Copy + Default>(image: &Image<T>, p: IVec2) -> T {
    image.get(p.x, p.y).copied().unwrap_or_default()
}

impl Guides<'_> {
    fn id(&self, p: IVec2) -> Option<u32> {
        self.surface_id.map(|ids| at(ids, p))
    }

    fn validate(&self, frame: &str) -> Result<(), Error> {
        let [width, height] = self.depth.extent();
        let render = self.params.render_extent;
        let images = [("normal", self.normal.map(Image::extent)), ("motion", self.motion.map(Image::extent))];
        let ids = [("surface_id", self.surface_id.map(Image::extent))];
        for (name, extent) in images.into_iter().chain(ids) {
            if let Some([w, h]) = extent.filter(|e| *e != [width, height]) {
                return Err(Error::Size {
                    resource: format!("{name} of the {frame} frame"),
                    given: format!("{w}x{h} texels"),
                    needed: format!("{width}x{height} texels, as depth has"),
                });
            }
        }
        if render[0] > width || render[1] > height {
            return Err(Error::RenderExtent { render, allocated: [width, height] });
        }
        Ok(())
    }
}

/// Tests whether depth, matrices, motion and normals of two consecutive frames agree with the
/// declared conventions, and names the likely mistake.
///
/// # Errors
/// [`Error::Size`] or [`Error::RenderExtent`] for images that do not fit together; [`Error::FrameParams`] or [`Error::Extent`] for
/// parameters that [`atrous::Denoiser::begin_frame`] would refuse as well, and for a current frame that is a reset.
pub fn check(conventions: &Conventions, previous: &Guides, current: &Guides) -> Result<Report, Error> {
    previous.validate("previous")?;
    current.validate("current")?;
    if current.params.reset.is_some() {
        let problem = "drops the history in the current frame; give two frames of one shot";
        return Err(Error::FrameParams { name: "reset", problem });
    }
    let pair = Pair::new(previous, current);
    let trial = |geometry| Trial::new(geometry, &pair);
    let declared = trial(Geometry::declared(conventions, &previous.params, &current.params))?;
    // An alternative whose matrices have no inverse is none.
    let alternatives: Vec<_> = declared.geometry.alternatives().into_iter().filter_map(|g| trial(g).ok()).collect();
    let (geometry, fitting) = trial::geometry_finding(&declared, &alternatives);
    let fitting = fitting.unwrap_or(&declared);
    let (motion, motion_reading) = fitting.motion_finding(conventions);
    let (motion_depth, z_of_motion) = fitting.motion_depth_finding(conventions);
    let (normals, normal_reading) = fitting.normals_finding(conventions);
    let conventions = normal_reading.apply(&motion_reading.apply(&fitting.geometry.conventions));
    let conventions = Conventions { motion_depth: z_of_motion, ..conventions };
    Ok(Report { geometry, motion, motion_depth, normals, conventions })
}
