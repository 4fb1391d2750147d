//! PNG, in memory and in files.

use crate::pictures::{Picture, PictureError};
use atrous_files::{open_regular, publish, Existing};
use png::EncodingError;
use std::io::{BufReader, BufWriter, ErrorKind, Write};
use std::path::Path;

impl Picture {
    /// Encodes the picture as 8-bit sRGB PNG.
    ///
    /// # Errors
    /// [`PictureError::EncodeInMemory`] if the encoder fails.
    pub fn to_png(&self) -> Result<Vec<u8>, PictureError> {
        let mut bytes = Vec::new();
        self.encode(&mut bytes).map_err(PictureError::EncodeInMemory)?;
        Ok(bytes)
    }

    /// Writes the picture as an 8-bit sRGB PNG file, in the place of an older one.
    ///
    /// A reader never sees half a file, and a failure leaves an older file as it was.
    ///
    /// # Errors
    /// [`PictureError::File`] or [`PictureError::Encode`], which name the file.
    pub fn write_png(&self, path: impl AsRef<Path>) -> Result<(), PictureError> {
        self.publish_png(path.as_ref(), Existing::Replaced)
    }

    /// Writes the picture as [`Self::write_png`] does, unless there is a file of that name.
    ///
    /// # Errors
    /// Errors of [`Self::write_png`], with [`std::io::ErrorKind::AlreadyExists`].
    pub fn write_new_png(&self, path: impl AsRef<Path>) -> Result<(), PictureError> {
        self.publish_png(path.as_ref(), Existing::Kept)
    }

    /// Reads a PNG file of 8-bit RGB pixels, such as [`Picture::write_png`] writes.
    ///
    /// # Errors
    /// [`PictureError::File`], [`PictureError::Decode`] or [`PictureError::PixelFormat`], which name the file.
    pub fn read_png(path: impl AsRef<Path>) -> Result<Self, PictureError> {
        let path = path.as_ref();
        let file = open_regular(path).map_err(|source| PictureError::File { path: path.into(), source })?;
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

    fn publish_png(&self, path: &Path, existing: Existing) -> Result<(), PictureError> {
        let mut refused = None;
        let written = publish(path, existing, |file| {
            let mut file = BufWriter::new(file);
            match self.encode(&mut file) {
                Ok(()) => file.flush(),
                Err(EncodingError::IoError(error)) => Err(error),
                Err(error) => {
                    refused = Some(error);
                    Err(ErrorKind::InvalidData.into())
                }
            }
        });
        written.map_err(|source| match refused {
            Some(source) => PictureError::Encode { path: path.into(), source },
            None => PictureError::File { path: path.into(), source },
        })
    }

    fn encode(&self, file: &mut impl Write) -> Result<(), EncodingError> {
        let mut encoder = png::Encoder::new(file, self.width(), self.height());
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(self.pixels().as_flattened())?;
        writer.finish()
    }
}
