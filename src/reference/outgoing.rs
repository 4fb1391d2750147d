//! Light in the unit of the host, as the image that goes out holds it. Twin of `glsl/include/outgoing.glsl`.

use super::binary16::{store, LARGEST_HALF};
use super::bindings::Bindings;
use crate::error::Error;

/// What an image that goes out can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Outgoing {
    Halves,
    Floats,
}

impl Outgoing {
    /// That of the shader's variant.
    pub(crate) fn of(b: &Bindings) -> Result<Self, Error> {
        Ok(if b.is_on("WIDE")? { Self::Floats } else { Self::Halves })
    }

    /// The brightest light.
    pub(crate) fn brightest(self) -> f32 {
        match self {
            Self::Halves => LARGEST_HALF,
            Self::Floats => 3e38,
        }
    }

    /// A component as the image keeps it.
    pub(crate) fn store(self, x: f32) -> f32 {
        match self {
            Self::Halves => store(x),
            // `clamp` would pass a NaN on.
            Self::Floats if x.is_nan() => 0.0,
            Self::Floats => x.clamp(0.0, self.brightest()),
        }
    }

    /// Whether the image cannot hold a light.
    pub(crate) fn is_too_bright(self, light: [f32; 3]) -> bool {
        light.iter().any(|c| *c > self.brightest())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn floats_hold_what_halves_do_not() {
        assert_eq!([1e7, 1e-9].map(|x| Outgoing::Floats.store(x)), [1e7, 1e-9]);
        assert_eq!([1e7, 1e-9].map(|x| Outgoing::Halves.store(x)), [LARGEST_HALF, 0.0]);
        assert_eq!([f32::NAN, -1.0, f32::INFINITY].map(|x| Outgoing::Floats.store(x)), [0.0, 0.0, 3e38]);
        assert!(Outgoing::Halves.is_too_bright([0.0, 1e7, 0.0]) && !Outgoing::Floats.is_too_bright([0.0, 1e7, 0.0]));
    }
}
