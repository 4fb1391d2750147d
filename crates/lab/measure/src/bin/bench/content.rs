//! What is in the inputs.

use atrous::FrameParams;
use atrous_synthetic::moving::{MovingScene, Pixel};
use atrous_synthetic::scene::random;
use std::fmt;
use std::str::FromStr;

/// Frames of inputs that alternate.
pub const FRAMES: u32 = atrous_synthetic::moving::FRAMES;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// A wall seen head-on that stands still, noise included: every pixel has a history and takes every tap, which is the most
    /// work.
    Wall,
    /// A moving camera, surfaces at several depths, holes, and pixels that come into sight in every frame.
    Moving,
}

impl Content {
    pub const ALL: [Self; 2] = [Self::Moving, Self::Wall];

    pub fn name(self) -> &'static str {
        match self {
            Self::Wall => "wall",
            Self::Moving => "moving",
        }
    }

    /// The camera of a frame.
    pub fn params(self, size: [u32; 2], index: u32) -> FrameParams {
        match self {
            Self::Wall => FrameParams::new(size),
            Self::Moving => MovingScene::new(size).params(index),
        }
    }

    /// The inputs of a pixel.
    pub fn pixel(self, size: [u32; 2], index: u32, x: u32, y: u32) -> Pixel {
        match self {
            Self::Moving => MovingScene::new(size).pixel(index, x, y),
            Self::Wall => {
                let noise = |i: u32| [2.0 * random(x, y, i); 3];
                Pixel {
                    depth: 5.0,
                    normal: [0.0, 0.0, 1.0],
                    motion: [0.0; 2],
                    albedo: [0.5; 3],
                    surface_id: 1,
                    direct: noise(0),
                    indirect: noise(1),
                    visibility: random(x, y, 2).round(),
                    volume: noise(0),
                    scattering_depth: 3.0,
                }
            }
        }
    }
}

impl fmt::Display for Content {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Content {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::ALL.into_iter().find(|c| c.name() == name).ok_or_else(|| format!("\"{name}\" is no content; there are: moving, wall"))
    }
}
