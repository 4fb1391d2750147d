//! Moments of luminance with the history length, packed.

use super::binary16::{from_half_bits, half_bits, store};

/// The reason why a pixel has no history.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[repr(u16)]
pub enum Reason {
    /// No reason: there is a history.
    #[default]
    None = 0,
    /// The surface was outside the previous image.
    OffScreen = 1,
    /// Another surface id, or the background, was there.
    Id = 2,
    /// The depth there was not the expected one.
    Depth = 3,
    /// The normal there was not the expected one.
    Normal = 4,
    /// A reset dropped all history.
    Reset = 5,
}

/// A pixel of `moments*`. Mean and deviation rather than E\[l\] and E\[l²\]: their difference would cancel in half precision.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Moments {
    /// Mean luminance of the irradiance over the history.
    pub mean: f32,
    /// Standard deviation of that luminance over the history, for one sample.
    pub deviation: f32,
    /// Frames accumulated.
    pub history_length: f32,
    /// A [`Reason`] as a number.
    pub reason: u16,
}

/// A texel of `moments*`.
pub fn pack_moments(moments: &Moments) -> [u16; 4] {
    let [mean, deviation, history_length] = [moments.mean, moments.deviation, moments.history_length].map(|x| half_bits(store(x)));
    [mean, deviation, history_length, moments.reason]
}

/// The content of a texel of `moments*`.
pub fn unpack_moments([mean, deviation, history_length, reason]: [u16; 4]) -> Moments {
    Moments {
        mean: from_half_bits(mean),
        deviation: from_half_bits(deviation),
        history_length: from_half_bits(history_length),
        reason,
    }
}

#[cfg(test)]
mod tests {
    use super::super::LARGEST_HALF;
    use super::*;

    #[test]
    fn moments_survive_packing() {
        let moments = Moments { mean: 3.5, deviation: 0.25, history_length: 17.0, reason: Reason::Depth as u16 };
        assert_eq!(unpack_moments(pack_moments(&moments)), moments);
        assert_eq!(unpack_moments(pack_moments(&Moments { mean: f32::INFINITY, ..moments })).mean, LARGEST_HALF);
    }
}
