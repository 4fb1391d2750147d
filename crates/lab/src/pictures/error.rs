//! Errors in the input of a picture, and of its file.

use crate::pictures::Region;
use std::path::PathBuf;

/// The reason why a picture, a plot or a table could not be made, written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// A picture needs pixels.
    #[error("a picture of {width}x{height} pixels is empty: width and height must be at least 1")]
    Empty {
        /// Width given, pixels.
        width: u32,
        /// Height given, pixels.
        height: u32,
    },
    /// A picture has more pixels than can sensibly be held in memory or shown.
    #[error("a picture of {width}x{height} pixels is too large: {max} pixels are allowed")]
    TooLarge {
        /// Width asked for, pixels.
        width: u64,
        /// Height asked for, pixels.
        height: u64,
        /// Most pixels that are allowed.
        max: u64,
    },
    /// A slice does not have one element for each pixel.
    #[error("{given} elements were given, but {width}x{height} pixels need {needed}")]
    Length {
        /// Width given, pixels.
        width: u32,
        /// Height given, pixels.
        height: u32,
        /// Elements in the slice.
        given: usize,
        /// Elements that width and height ask for.
        needed: u64,
    },
    /// The exposure is no positive number.
    #[error("the exposure is {0}: it must be finite and greater than 0")]
    Exposure(f32),
    /// A region is empty or leaves the picture.
    #[error("{region} is empty or leaves a picture of {width}x{height} pixels")]
    Region {
        /// The region asked for.
        region: Region,
        /// Width of the picture, pixels.
        width: u32,
        /// Height of the picture, pixels.
        height: u32,
    },
    /// Upscaling by 0, or a grid of 0 columns.
    #[error("{0} must be at least 1")]
    Zero(&'static str),
    /// A strip has no panel.
    #[error("a strip needs at least one panel")]
    NoPanel,
    /// The panels of a strip have different sizes.
    #[error("panel {label:?} is {}x{} pixels, but the first panel is {}x{}: all must have the same size", given[0], given[1], expected[0], expected[1])]
    PanelSize {
        /// Label of the panel that differs.
        label: String,
        /// Width and height, pixels.
        given: [u32; 2],
        /// Width and height of the first panel, pixels.
        expected: [u32; 2],
    },
    /// A plot has no finite value.
    #[error("plot {0:?} has no finite value to draw")]
    NothingToPlot(String),
    /// A plot is too small for its axes and legend.
    #[error("a plot of {}x{} pixels has no room for its axes and legend: at least {}x{} are needed", given[0], given[1], needed[0], needed[1])]
    PlotSize {
        /// Width and height asked for, pixels.
        given: [u32; 2],
        /// Least width and height for these series, pixels.
        needed: [u32; 2],
    },
    /// The plotting library could not draw the axes or the lines.
    #[error("plot {title:?} could not be drawn: {message}")]
    Plot {
        /// Title of the plot.
        title: String,
        /// Message of the library.
        message: String,
    },
    /// A row of a table does not have one value for each column.
    #[error("row {name:?} has {given} values, but the table has {columns} columns of values")]
    Row {
        /// Name of the row.
        name: String,
        /// Values given.
        given: usize,
        /// Columns of values that the table has.
        columns: usize,
    },
    /// A file could not be created, written, renamed or opened.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
    /// A picture could not be encoded as PNG in memory.
    #[error("cannot encode a picture: {0}")]
    EncodeInMemory(png::EncodingError),
    /// A PNG file could not be encoded.
    #[error("{}: cannot encode: {source}", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// Error of the encoder.
        source: png::EncodingError,
    },
    /// A file is not a PNG picture that can be read.
    #[error("{}: cannot decode: {source}", path.display())]
    Decode {
        /// The file.
        path: PathBuf,
        /// Error of the decoder.
        source: png::DecodingError,
    },
    /// A PNG file does not hold 8-bit RGB.
    #[error("{}: is {given}, but only 8-bit RGB is read", path.display())]
    PixelFormat {
        /// The file.
        path: PathBuf,
        /// The content of the file.
        given: String,
    },
}
