//! Where the picture lies in the window. All in window pixels.

/// Reaches as far from the divider that a mouse grabs it.
pub const GRAB: f32 = 7.0;

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
    /// The largest place for a picture inside of this one: a whole multiple of its size where one fits, so that every pixel is as large as
    /// every other; else as large as fits.
    pub fn fit(&self, [width, height]: [f32; 2]) -> Self {
        let scale = (self.width / width).min(self.height / height).max(0.0);
        let scale = if scale >= 1.0 { scale.floor() } else { scale };
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
        assert_eq!(room.fit([320.0, 180.0]), Place { x: 30.0, y: 80.0, width: 960.0, height: 540.0 });
        let small = room.fit([2000.0, 1000.0]);
        assert_eq!((small.width, small.height), (1000.0, 500.0));
        assert_eq!(Place::default().fit([320.0, 180.0]).width, 0.0);
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
