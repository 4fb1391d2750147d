//! Frames one after the other: what a frame lacks and the one before it has.

use crate::error::Result;
use crate::frame::{self, FrameInputs};
use crate::frame_files::FrameFiles;
use crate::motion::{self, SurfaceMotion};
use crate::raster::Raster;
use crate::roles::Role;
use crate::setup::Setup;
use crate::transmission::Transmission;
use crate::unfiltered::{self, Averages, ALBEDO};
use atrous::config::{Conventions, MotionDepth};
use atrous::FrameParams;

/// Pixels between the motion of a surface and that of the still world from which on it moves by itself.
const MOVES: f32 = 0.5;
/// Relative difference of depths up to which a pixel of the frame before shows the same surface,
/// where there are no ids.
const SAME: f32 = 0.1;

/// Reads frames in order.
pub struct Loader<'a> {
    setup: &'a Setup,
    previous: Option<(u64, FrameParams, SurfaceMotion)>,
    averages: Averages,
}

impl<'a> Loader<'a> {
    /// A loader that has read nothing.
    pub fn new(setup: &'a Setup) -> Self {
        Self { setup, previous: None, averages: Averages::default() }
    }

    /// Reads the next frame.
    ///
    /// # Errors
    /// Errors of [`frame::load`].
    pub fn load(&mut self, files: &FrameFiles) -> Result<FrameInputs> {
        let mut inputs = frame::load(files, self.setup)?;
        let averages = unfiltered::is_averaged(&inputs, self.setup);
        if averages || self.setup.carries_depth || inputs.through.is_some() {
            self.carry(&mut inputs, averages);
        }
        blacken_rims(&mut inputs, self.setup);
        Ok(inputs)
    }

    /// Brings the frame before into this one: averages what no filter smooths where `averages`, and gives motion its depth where it needs one.
    fn carry(&mut self, inputs: &mut FrameInputs, averages: bool) {
        let previous = self.previous.take().filter(|(number, ..)| number + self.setup.step == inputs.number);
        let before = previous.as_ref().map_or(inputs.params, |(_, params, _)| *params);
        motion::see_through(inputs, &before, &without_depth(self.setup));
        let surface = motion::of_frame(inputs, &before, &without_depth(self.setup));
        if previous.is_none() || inputs.params.reset.is_some() || inputs.params.exposure_ratio != 1.0 {
            self.averages.reset();
        }
        if averages {
            self.averages.take(&mut inputs.images, &surface, inputs.params.render_extent, self.setup.has_means);
        }
        if self.setup.carries_depth {
            let still = StillWorld::of(inputs, &before, self.setup);
            let depths = previous_depths(&surface, &still, previous.as_ref().map(|p| &p.2), inputs.params.render_extent);
            for (texel, z) in inputs.images.get_mut("motion").into_iter().flatten().zip(depths) {
                texel[2] = z;
            }
        }
        self.previous = Some((inputs.number, inputs.params, surface));
    }
}

/// Makes the albedo of what light passes through as black at its rim as it is inside. That for denoisers is not black there, and rims are as black
/// already where guides are of the middle of pixels.
fn blacken_rims(inputs: &mut FrameInputs, setup: &Setup) {
    let (Some(ids), Some(base)) = (&inputs.surface_id, inputs.images.get(ALBEDO)) else { return };
    if setup.mapping.is_for_denoisers(Role::Albedo) || !setup.has_means {
        return;
    }
    let rim = Transmission::new(setup, ids, base, &inputs.images).map_or_else(Vec::new, |transmission| transmission.rim());
    let Some(albedo) = inputs.images.get_mut(ALBEDO) else { return };
    rim.into_iter().for_each(|i| albedo[i] = [0.0; 4]);
}

/// The conventions of the files: their motion has no depth.
fn without_depth(setup: &Setup) -> Conventions {
    Conventions { motion_depth: MotionDepth::None, ..setup.config.conventions }
}

/// Motion and previous depths of the surfaces, if none moved by itself.
pub struct StillWorld(SurfaceMotion);

impl StillWorld {
    /// By depth and matrices alone.
    pub fn of(inputs: &FrameInputs, before: &FrameParams, setup: &Setup) -> Self {
        Self(motion::of_still(inputs, before, &without_depth(setup)))
    }
}

/// The depth that each surface had in the frame before: that of the pixel where the motion leads, where
/// it moves by itself; that of the still world otherwise.
pub fn previous_depths(
    surface: &SurfaceMotion,
    still: &StillWorld,
    previous: Option<&SurfaceMotion>,
    [width, height]: [u32; 2],
) -> Vec<f32> {
    let depth = |i: usize| {
        let expected = still.0.previous_depth[i];
        if !surface.is_surface[i] {
            return expected;
        }
        let ([x, y], [sx, sy]) = (surface.motion_px[i], still.0.motion_px[i]);
        let Some(previous) = previous.filter(|_| (x - sx).hypot(y - sy) > MOVES) else { return expected };
        let now = surface.depth[i];
        let is_same = |q: usize| match surface.id[i] {
            // Without ids, all are 0.
            0 => (previous.depth[q] - now).abs() <= SAME * now,
            id => previous.id[q] == id,
        };
        let at = [(i as u32 % width) as f32 + x, (i as u32 / width) as f32 + y];
        mean_around(at, [width, height], |q| is_same(q).then(|| previous.depth[q])).unwrap_or(expected)
    };
    (0..surface.depth.len()).map(depth).collect()
}

/// The mean of the four pixels around a place, as far as they have a value, by their nearness.
fn mean_around(at: [f32; 2], extent: [u32; 2], value: impl Fn(usize) -> Option<f32>) -> Option<f32> {
    let (mut sum, mut weights) = (0.0, 0.0);
    for (i, weight) in Raster::new(extent).taps(at) {
        if let Some(z) = value(i) {
            (sum, weights) = (sum + weight * z, weights + weight);
        }
    }
    (weights > 0.0).then(|| sum / weights)
}
