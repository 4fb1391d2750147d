//! Settings that are fixed for every frame of a denoiser.

use super::FrameParams;
use crate::config::{check_extent, check_image_extent, check_light_extent, check_output_extent, Config, Conventions};
use crate::error::Error;

/// The largest [`Setup::frames_in_flight`].
pub(crate) const MAX_FRAMES_IN_FLIGHT: u32 = 8;

/// Settings that are fixed for every frame of a denoiser, with any passes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setup {
    /// Width and height of the allocated images; each frame renders into their top left part.
    pub allocated_extent: [u32; 2],
    /// Width and height of the output; none: those of each frame's render extent. Default: none.
    pub output_extent: Option<[u32; 2]>,
    /// Width and height of allocated images of light; none: those of the guides. Default: none.
    pub light_extent: Option<[u32; 2]>,
    /// Width and height of your images, in which the picture is a part; none: those of the picture. Default: none.
    pub image_extent: Option<[u32; 2]>,
    /// Frames that you record before you wait for the oldest, 1 to 8. Default: 2.
    pub frames_in_flight: u32,
    /// Encodings of your guides. Default: [`Conventions::default`].
    pub conventions: Conventions,
}

impl Setup {
    /// The defaults, for an extent.
    pub fn new(allocated_extent: [u32; 2]) -> Self {
        let conventions = Conventions::default();
        Self { allocated_extent, output_extent: None, light_extent: None, image_extent: None, frames_in_flight: 2, conventions }
    }

    /// Checks every field.
    ///
    /// # Errors
    /// [`Error::Extent`], [`Error::Config`] or [`Error::Conventions`] for the first field that is out of range.
    pub fn validate(&self) -> Result<(), Error> {
        check_extent("Config::allocated_extent", self.allocated_extent)?;
        check_output_extent("Config::output_extent", self.output_extent, self.allocated_extent)?;
        check_light_extent(self.light_extent, self.allocated_extent)?;
        check_image_extent(self)?;
        let (given, min, max) = (self.frames_in_flight, 1, MAX_FRAMES_IN_FLIGHT);
        if !(min..=max).contains(&given) {
            return Err(Error::Config { name: "frames_in_flight", given, min, max });
        }
        self.conventions.validate()
    }

    /// The extent of images of output size.
    pub(crate) fn largest_output(&self) -> [u32; 2] {
        self.output_extent.unwrap_or(self.allocated_extent)
    }

    /// Rendered pixels for each pixel of light, along x and y: 1 or 2.
    pub(crate) fn light_ratio(&self) -> [u32; 2] {
        let light = self.light_extent.unwrap_or(self.allocated_extent);
        [0, 1].map(|i| self.allocated_extent[i] / light[i].max(1))
    }

    /// The pixels of light of a frame.
    pub(crate) fn light_of(&self, render_extent: [u32; 2]) -> [u32; 2] {
        let ratio = self.light_ratio();
        [0, 1].map(|i| render_extent[i].div_ceil(ratio[i].max(1)))
    }

    /// The light for another allocated extent, in the same ratio.
    pub(crate) fn light_for(&self, allocated_extent: [u32; 2]) -> Option<[u32; 2]> {
        self.light_extent.map(|_| self.light_of(allocated_extent))
    }

    /// The output of a frame.
    pub(crate) fn output_of(&self, frame: &FrameParams) -> [u32; 2] {
        frame.output_extent.or(self.output_extent).unwrap_or(frame.render_extent)
    }
}

impl Config {
    /// The settings that are fixed for every frame.
    pub fn setup(&self) -> Setup {
        let &Self { allocated_extent, output_extent, light_extent, image_extent, frames_in_flight, conventions, .. } = self;
        Setup { allocated_extent, output_extent, light_extent, image_extent, frames_in_flight, conventions }
    }
}
