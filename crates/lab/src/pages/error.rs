//! Errors in what a page is made of, and of its file.

use crate::pictures::PictureError;
use std::path::PathBuf;

/// The reason why a page could not be made or written.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PageError {
    /// The pictures of a comparison have different sizes.
    #[error("{name:?} is {}x{} pixels, but the first picture is {}x{}: all that are compared must have the same size", given[0], given[1], expected[0], expected[1])]
    PictureSize {
        /// Name of the picture that differs.
        name: String,
        /// Its width and height, pixels.
        given: [u32; 2],
        /// Width and height of the first picture, pixels.
        expected: [u32; 2],
    },
    /// Two pictures of a comparison have one name, so that nobody can tell which one is chosen.
    #[error("there are two pictures with the name {0:?} in one comparison")]
    SameName(String),
    /// A comparison has fewer than two pictures.
    #[error("comparison {caption:?} has {given} pictures, but at least 2 are needed")]
    TooFewPictures {
        /// Caption of the comparison.
        caption: String,
        /// Pictures that it has, heat maps included.
        given: usize,
    },
    /// A comparison has no picture of that name.
    #[error("there is no picture with the name {0:?} in the comparison")]
    NoPicture(String),
    /// The range of a heat map is empty, or not finite.
    #[error("a heat map cannot show the range from {low} to {high}: both must be finite, and the second larger")]
    Range {
        /// Value of the first colour.
        low: f32,
        /// Value of the last colour.
        high: f32,
    },
    /// Curves have no finite value.
    #[error("curves {0:?} have no finite value to draw")]
    NothingToPlot(String),
    /// A row of a table does not have one cell for each column.
    #[error("row {name:?} has {given} cells, but the table has {columns} columns beside the names of rows")]
    Row {
        /// Name of the row.
        name: String,
        /// Cells given.
        given: usize,
        /// Columns that the table has.
        columns: usize,
    },
    /// A table has no column of that name.
    #[error("the table has no column {0:?}")]
    NoColumn(String),
    /// A picture could not be made or encoded.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The file could not be written.
    #[error("{}: {source}", path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// Error of the system.
        source: std::io::Error,
    },
}
