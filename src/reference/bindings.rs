//! The bindings of a pass on the CPU: the frame, its parameters, and texels by the names that the shader has.

use super::texels::{Texels, BYTES, COLOUR, PACKED, SCALAR, UINT, WIDE};
use super::{Image, InstanceTransform};
use crate::{DebugView, Error, FrameConstants, Statistics, Tuning};

/// The CPU twin of a stage: reads what the pass reads, and writes what it writes.
pub type Twin = fn(&mut Bindings) -> Result<(), Error>;

/// The bindings of a pass on the CPU, by their names in the GLSL. An input that the graph does not wire, or the host does not give,
/// is not bound. Texels that are read are borrowed, those that are written are collected: a binding that is both reads what was
/// there before.
#[derive(Clone, Debug)]
pub struct Bindings<'a> {
    /// Name of the stage, for messages.
    stage: &'a str,
    /// Constants of the frame.
    pub frame: &'a FrameConstants,
    /// Tunables as the pass sees them: one may come from a tunable of another name, as those of a volume do.
    pub tuning: &'a Tuning,
    /// À-trous level.
    pub level: u32,
    /// The view of the frame.
    pub view: DebugView,
    constants: &'a [(&'a str, u32)],
    reads: Vec<(&'a str, &'a Texels)>,
    writes: Vec<(&'a str, [u32; 2])>,
    written: Vec<(&'a str, Texels)>,
}

impl<'a> Bindings<'a> {
    /// A pass of a stage without anything bound.
    pub(crate) const fn new(stage: &'a str, frame: &'a FrameConstants, tuning: &'a Tuning) -> Self {
        Self {
            stage,
            frame,
            tuning,
            level: 0,
            view: DebugView::HistoryLength,
            constants: &[],
            reads: Vec::new(),
            writes: Vec::new(),
            written: Vec::new(),
        }
    }

    /// Sets the à-trous level.
    #[must_use]
    pub(crate) fn with_level(mut self, level: u32) -> Self {
        self.level = level;
        self
    }

    /// Sets the view.
    #[must_use]
    pub(crate) fn with_view(mut self, view: DebugView) -> Self {
        self.view = view;
        self
    }

    /// Sets the shader's specialisation constants, those with their defaults included.
    #[must_use]
    pub(crate) fn with_constants(mut self, constants: &'a [(&'a str, u32)]) -> Self {
        self.constants = constants;
        self
    }

    /// Binds what the pass reads under a name.
    pub(crate) fn reads(&mut self, name: &'a str, texels: &'a Texels) {
        self.reads.push((name, texels));
    }

    /// Announces that the pass writes an image of this allocated extent, or a buffer of so many bytes in one row.
    pub(crate) fn writes(&mut self, name: &'a str, extent: [u32; 2]) {
        self.writes.push((name, extent));
    }

    /// Texels that were written, by name, in the order of writing.
    pub(crate) fn into_written(self) -> Vec<(&'a str, Texels)> {
        self.written
    }

    /// Whether something is bound under a name, to be read or to be written.
    pub fn has(&self, name: &str) -> bool {
        self.find(name).is_some() || self.writes.iter().any(|w| w.0 == name)
    }

    /// A specialisation constant.
    ///
    /// # Errors
    /// [`Error::Twin`] where the pass has none of this name.
    pub fn constant(&self, name: &str) -> Result<u32, Error> {
        let given = self.constants.iter().find(|c| c.0 == name).map(|c| c.1);
        given.ok_or_else(|| self.error(name, "a specialisation constant", self.constants.iter().map(|c| c.0)))
    }

    /// A specialisation constant that is a switch.
    ///
    /// # Errors
    /// Errors of [`Self::constant`].
    pub(crate) fn is_on(&self, name: &str) -> Result<bool, Error> {
        Ok(self.constant(name)? != 0)
    }

    /// The allocated extent of an image that the pass writes.
    ///
    /// # Errors
    /// [`Error::Twin`] where the pass writes none of this name.
    pub fn extent_of(&self, name: &str) -> Result<[u32; 2], Error> {
        let given = self.writes.iter().find(|w| w.0 == name).map(|w| w.1);
        given.ok_or_else(|| self.error(name, "an image that it writes", self.writes.iter().map(|w| w.0)))
    }

    /// Stores what the twin computed for a binding.
    ///
    /// # Errors
    /// [`Error::Twin`] where the pass writes nothing under this name, or something of another extent.
    pub fn write(&mut self, name: &str, texels: impl Into<Texels>) -> Result<(), Error> {
        let texels = texels.into();
        let &(name, needed) = self
            .writes
            .iter()
            .find(|w| w.0 == name)
            .ok_or_else(|| self.error(name, "nothing that it may write", self.writes.iter().map(|w| w.0)))?;
        if texels.extent() != needed {
            let given = format!("{} of {:?} texels", texels.kind(), texels.extent());
            let needed = format!("{needed:?} texels, as the declaration says");
            return Err(Error::Size { resource: format!("{name} of the CPU twin of {}", self.stage), given, needed });
        }
        self.written.push((name, texels));
        Ok(())
    }

    /// Adds to the counters of the frame.
    ///
    /// # Errors
    /// Errors of [`Self::bytes`] of `statistics`.
    pub(crate) fn count(&mut self, statistics: &Statistics) -> Result<(), Error> {
        let sum = self.statistics()?.plus(statistics);
        self.write("statistics", Texels::Bytes(sum.as_bytes().to_vec()))
    }

    /// The counters of the frame.
    ///
    /// # Errors
    /// Errors of [`Self::bytes`] of `statistics`.
    pub(crate) fn statistics(&self) -> Result<Statistics, Error> {
        Statistics::from_bytes(self.bytes("statistics")?)
    }

    /// The transforms of the host's instances, where they are bound.
    ///
    /// # Errors
    /// Errors of [`Self::bytes`] for something else than a buffer.
    pub(crate) fn instance_transforms(&self) -> Result<Option<Vec<InstanceTransform>>, Error> {
        let of_bytes =
            |bytes: &[u8]| bytes.chunks_exact(size_of::<InstanceTransform>()).map(bytemuck::pod_read_unaligned).collect();
        self.has("instance_transforms").then(|| self.bytes("instance_transforms").map(of_bytes)).transpose()
    }

    /// The number of pixels a side of a stratum.
    ///
    /// # Errors
    /// Errors of [`Self::constant`]; [`Error::Config`] for 0.
    pub(crate) fn stratum_size(&self) -> Result<u32, Error> {
        match self.constant("STRATUM_SIZE")? {
            0 => Err(Error::Config { name: "stratum_size", given: 0, min: 2, max: 4 }),
            size => Ok(size),
        }
    }

    /// Stores an image for every signal, under the names `name_0` and `name_1`.
    ///
    /// # Errors
    /// Errors of [`Self::write`].
    pub(crate) fn write_signals<T: Into<Texels>>(&mut self, name: &str, images: Vec<T>) -> Result<(), Error> {
        images.into_iter().enumerate().try_for_each(|(i, image)| self.write(&format!("{name}_{i}"), image))
    }

    fn find(&self, name: &str) -> Option<&'a Texels> {
        self.reads.iter().find(|r| r.0 == name).map(|r| r.1)
    }

    fn error<'n>(&self, binding: &str, needed: &'static str, known: impl Iterator<Item = &'n str>) -> Error {
        let known: Vec<_> = known.collect();
        let given = if known.is_empty() { "nothing".to_owned() } else { format!("only {}", known.join(", ")) };
        Error::Twin { stage: self.stage.into(), binding: binding.into(), needed, given }
    }

    fn read<T>(&self, name: &str, needed: &'static str, of: fn(&'a Texels) -> Option<&'a T>) -> Result<&'a T, Error>
    where
        T: ?Sized,
    {
        let texels = self.find(name).ok_or_else(|| self.error(name, needed, self.reads.iter().map(|r| r.0)))?;
        let given = || texels.kind().to_owned();
        of(texels).ok_or_else(|| Error::Twin { stage: self.stage.into(), binding: name.into(), needed, given: given() })
    }
}

/// Readers for each kind: one, one that may be absent, and one for every signal.
macro_rules! readers {
    ($($(#[doc = $doc:literal])+ $read:ident, $optional:ident, $signals:ident: $kind:ident, $variant:ident, $ty:ty;)+) => {
        impl<'a> Bindings<'a> {
            $(
                $(#[doc = $doc])+
                ///
                /// # Errors
                /// [`Error::Twin`] where nothing is bound under the name, or something else.
                pub fn $read(&self, name: &str) -> Result<&'a $ty, Error> {
                    self.read(name, $kind, |texels| match texels {
                        Texels::$variant(image) => Some(image),
                        _ => None,
                    })
                }

                $(#[doc = $doc])+
                /// `None` where nothing is bound under the name.
                ///
                /// # Errors
                /// [`Error::Twin`] where something else is bound.
                pub fn $optional(&self, name: &str) -> Result<Option<&'a $ty>, Error> {
                    self.find(name).map(|_| self.$read(name)).transpose()
                }

                $(#[doc = $doc])+
                /// One for each signal: `name_0`, and `name_1` where it is bound.
                ///
                /// # Errors
                /// [`Error::Twin`] where nothing is bound as `name_0`, or something else as either.
                pub fn $signals(&self, name: &str) -> Result<Vec<&'a $ty>, Error> {
                    let first = self.$read(&format!("{name}_0"))?;
                    let second = self.$optional(&format!("{name}_1"))?;
                    Ok(std::iter::once(first).chain(second).collect())
                }
            )+
        }
    };
}

readers! {
    /// An image of four floats.
    colour, optional_colour, colours: COLOUR, Colour, Image<[f32; 4]>;
    /// An image of one float.
    scalar, optional_scalar, scalars: SCALAR, Scalar, Image<f32>;
    /// An image of 64 packed bits.
    packed, optional_packed, packed_signals: PACKED, Packed, Image<[u16; 4]>;
    /// An image of 32 bits.
    uint, optional_uint, uints: UINT, Uint, Image<u32>;
    /// An image of four times 32 bits.
    wide, optional_wide, wides: WIDE, Wide, Image<[u32; 4]>;
    /// The bytes of a buffer.
    bytes, optional_bytes, buffers: BYTES, Bytes, [u8];
}

impl From<Image<[f32; 4]>> for Texels {
    fn from(image: Image<[f32; 4]>) -> Self {
        Self::Colour(image)
    }
}

impl From<Image<f32>> for Texels {
    fn from(image: Image<f32>) -> Self {
        Self::Scalar(image)
    }
}

impl From<Image<[u16; 4]>> for Texels {
    fn from(image: Image<[u16; 4]>) -> Self {
        Self::Packed(image)
    }
}

impl From<Image<u32>> for Texels {
    fn from(image: Image<u32>) -> Self {
        Self::Uint(image)
    }
}

impl From<Image<[u32; 4]>> for Texels {
    fn from(image: Image<[u32; 4]>) -> Self {
        Self::Wide(image)
    }
}

#[cfg(test)]
mod tests;
