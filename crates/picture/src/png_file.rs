//! PNG files.

use crate::{Picture, PictureError};
use std::fs::{self, File};
use std::io::{BufReader, BufWriter, Error, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

impl Picture {
    /// Writes the picture as an 8-bit sRGB PNG file.
    ///
    /// It is written under a temporary name beside `path` and renamed, so that a reader never sees half a file and a
    /// failure leaves an older file as it was.
    ///
    /// # Errors
    /// [`PictureError::File`] or [`PictureError::Encode`], which name the file.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), PictureError> {
        let path = path.as_ref();
        let part = part_name(path).ok_or_else(|| {
            let source = Error::new(ErrorKind::InvalidInput, "is not the name of a file");
            PictureError::File { path: path.into(), source }
        })?;
        let result = self
            .encode(&part, path)
            .and_then(|()| fs::rename(&part, path).map_err(|source| PictureError::File { path: path.into(), source }));
        if result.is_err() {
            // The error that is returned says more than a failure to tidy up after it would.
            let _ = fs::remove_file(&part);
        }
        result
    }

    /// Reads a PNG file of 8-bit RGB pixels, such as [`Picture::write_png`] writes.
    ///
    /// # Errors
    /// [`PictureError::File`], [`PictureError::Decode`] or [`PictureError::PixelFormat`], which name the file.
    pub fn read_png(path: impl AsRef<Path>) -> Result<Self, PictureError> {
        let path = path.as_ref();
        let file = File::open(path).map_err(|source| PictureError::File { path: path.into(), source })?;
        let decode_error = |source| PictureError::Decode { path: path.into(), source };
        let mut reader = png::Decoder::new(BufReader::new(file)).read_info().map_err(decode_error)?;
        let info = reader.info();
        let (width, height) = (info.width, info.height);
        if (info.color_type, info.bit_depth) != (png::ColorType::Rgb, png::BitDepth::Eight) {
            let given = format!("{:?} with {:?} bits", info.color_type, info.bit_depth);
            return Err(PictureError::PixelFormat { path: path.into(), given });
        }
        let mut picture = Picture::filled(width, height, [0; 3])?.into_pixels();
        reader.next_frame(picture.as_flattened_mut()).map_err(decode_error)?;
        Picture::from_pixels(width, height, picture)
    }

    /// Encodes into the file `part`; errors name `path`, which is the file that the caller knows.
    fn encode(&self, part: &Path, path: &Path) -> Result<(), PictureError> {
        let file_error = |source| PictureError::File { path: path.into(), source };
        let encode_error = |source| PictureError::Encode { path: path.into(), source };
        let mut file = BufWriter::new(File::create(part).map_err(file_error)?);
        let mut encoder = png::Encoder::new(&mut file, self.width(), self.height());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header().map_err(encode_error)?;
        writer.write_image_data(self.pixels().as_flattened()).map_err(encode_error)?;
        writer.finish().map_err(encode_error)?;
        file.flush().map_err(file_error)
    }
}

/// A name in the same folder that no other thread or process writes to.
fn part_name(path: &Path) -> Option<PathBuf> {
    static COUNT: AtomicU32 = AtomicU32::new(0);
    let mut name = std::ffi::OsString::from(".");
    name.push(path.file_name()?);
    name.push(format!(".{}-{}.part", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
    Some(path.with_file_name(name))
}
