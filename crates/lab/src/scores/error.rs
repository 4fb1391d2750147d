//! Errors in the images that are compared.

/// The reason why images could not be compared.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum QualityError {
    /// An image without pixels has no mean error.
    #[error("the image is {width}x{height} pixels: width and height must be at least 1")]
    Empty {
        /// Width given, pixels.
        width: u32,
        /// Height given, pixels.
        height: u32,
    },
    /// A slice does not have one element for each pixel.
    #[error("{plane} has {given} elements, but {width}x{height} pixels need {needed}")]
    Length {
        /// The slice.
        plane: &'static str,
        /// Width given, pixels.
        width: u32,
        /// Height given, pixels.
        height: u32,
        /// Elements in the slice.
        given: usize,
        /// Elements that width and height ask for.
        needed: u64,
    },
    /// A slice contains NaN or infinities.
    #[error("{plane} has {count} values that are not finite, the first at pixel ({x}, {y}): every value must be finite")]
    NonFinite {
        /// The slice.
        plane: &'static str,
        /// Number of values (channels, not pixels) that are NaN or infinite.
        count: usize,
        /// Column of the first such pixel, from the left.
        x: u32,
        /// Row of the first such pixel, from the top.
        y: u32,
    },
    /// Two images that are compared have different sizes.
    #[error("a {}x{} image cannot be compared with a {}x{} image: both must have the same size", left[0], left[1], right[0], right[1])]
    ExtentMismatch {
        /// Width and height of the first image, pixels.
        left: [u32; 2],
        /// Width and height of the other image, pixels.
        right: [u32; 2],
    },
    /// No pixel of the frame shows a surface that the previous frame shows too, as after a camera cut.
    #[error("no pixel shows a surface that the previous frame shows too: there is no change along the motion to measure")]
    NoCommonSurface,
}
