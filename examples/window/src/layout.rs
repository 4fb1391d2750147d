//! Where the picture lies in the window. All in window pixels.

use serde::{Deserialize, Serialize};

/// Reaches as far from the divider that a mouse grabs it.
pub const GRAB: f32 = 7.0;

/// How much larger than itself the picture is shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Scaling {
    /// By a whole number, so that every pixel is as large as every other; smaller than itself where it does not fit.
    #[default]
    Integer,
    /// As large as the window has room for.
    Fit,
}

impl Scaling {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Integer, Self::Fit];

    /// To show to people, and as it is in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Integer => "integer",
            Self::Fit => "fit",
        }
    }

    /// The other one.
    pub fn other(self) -> Self {
        match self {
            Self::Integer => Self::Fit,
            Self::Fit => Self::Integer,
        }
    }
}

/// A rectangle: corner and size.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Place {
    /// Left.
    pub x: f32,
    /// Top.
    pub y: f32,
    /// Width.
    pub width: f32,
    /// Height.
    pub height: f32,
}

impl Place {
    /// What is left of a window beside a panel of its usual width. A panel that is made wider lies over the picture, and one that is made
    /// narrower leaves a gap: neither moves the picture.
    pub fn beside([width, height]: [f32; 2], usual_panel: f32) -> Self {
        Self { x: 0.0, y: 0.0, width: (width - usual_panel).max(0.0), height: height.max(0.0) }
    }

    /// The largest place for a picture inside of this one.
    pub fn fit(&self, [width, height]: [f32; 2], scaling: Scaling) -> Self {
        let scale = (self.width / width).min(self.height / height).max(0.0);
        let scale = if scale >= 1.0 && scaling == Scaling::Integer { scale.floor() } else { scale };
        let (width, height) = (width * scale, height * scale);
        let centred = |start: f32, room: f32, size: f32| (start + 0.5 * (room - size)).round();
        Self { x: centred(self.x, self.width, width), y: centred(self.y, self.height, height), width, height }
    }

    /// The pixel of a picture in this place, under a point of the window.
    pub fn pixel(&self, [x, y]: [f32; 2], extent: [u32; 2]) -> Option<[u32; 2]> {
        let along = |p: f32, start: f32, size: f32, pixels: u32| {
            let t = (p - start) / size;
            (0.0..1.0).contains(&t).then(|| ((t * pixels as f32) as u32).min(pixels - 1))
        };
        Some([along(x, self.x, self.width, extent[0])?, along(y, self.y, self.height, extent[1])?])
    }

    /// Where a divider is for a mouse at `x`.
    pub fn divider(&self, x: f32) -> f32 {
        if self.width > 0.0 {
            ((x - self.x) / self.width).clamp(0.0, 1.0)
        } else {
            0.5
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_is_enlarged_by_whole_numbers_and_reduced_as_needed() {
        let room = Place { x: 10.0, y: 0.0, width: 1000.0, height: 700.0 };
        assert_eq!(room.fit([320.0, 180.0], Scaling::Integer), Place { x: 30.0, y: 80.0, width: 960.0, height: 540.0 });
        for scaling in Scaling::ALL {
            let small = room.fit([2000.0, 1000.0], scaling);
            assert_eq!((small.width, small.height), (1000.0, 500.0));
            assert_eq!(Place::default().fit([320.0, 180.0], scaling).width, 0.0);
        }
    }

    #[test]
    fn a_picture_that_fits_touches_two_sides() {
        let wide = Place { x: 0.0, y: 0.0, width: 1000.0, height: 400.0 };
        assert_eq!(wide.fit([320.0, 160.0], Scaling::Fit), Place { x: 100.0, y: 0.0, width: 800.0, height: 400.0 });
        let high = Place { height: 900.0, ..wide };
        assert_eq!(high.fit([320.0, 160.0], Scaling::Fit), Place { x: 0.0, y: 200.0, width: 1000.0, height: 500.0 });
    }

    #[test]
    fn the_panel_takes_its_usual_width() {
        assert_eq!(Place::beside([900.0, 500.0], 320.0), Place { x: 0.0, y: 0.0, width: 580.0, height: 500.0 });
        assert_eq!(Place::beside([90.0, 60.0], 320.0).width, 0.0);
    }

    #[test]
    fn a_point_finds_its_pixel() {
        let place = Place { x: 30.0, y: 80.0, width: 960.0, height: 540.0 };
        assert_eq!(place.pixel([30.0, 80.0], [320, 180]), Some([0, 0]));
        assert_eq!(place.pixel([989.9, 619.9], [320, 180]), Some([319, 179]));
        assert_eq!(place.pixel([29.0, 100.0], [320, 180]), None);
        assert_eq!((place.divider(510.0), place.divider(0.0), Place::default().divider(3.0)), (0.5, 0.0, 0.5));
    }
}
