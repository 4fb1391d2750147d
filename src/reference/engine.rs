//! The CPU engine: runs any declaration, pass by pass, by the twins of its stages.

use super::texels::Texels;
use super::Image;
use crate::contract::{
    Access, DebugView, Declaration, FrameContext, FrameParams, FrameState, ImageFormat, Lifetime, ResourceId, Shape, Statistics,
    Tuning, Use, UseFrame, Work,
};
use crate::error::Error;
use ash::vk;

/// A declaration on the CPU, from slices to slices: what `executor::Session` is on a GPU.
///
/// Slow, and the measure of what a GPU should give.
#[derive(Clone, Debug)]
pub struct Engine {
    declaration: Declaration,
    state: FrameState,
    /// Texels by resource, then copy.
    stored: Vec<[Option<Texels>; 2]>,
    frame: Option<FrameContext>,
    keeps_transients: bool,
}

impl Engine {
    /// An engine without inputs and without history.
    ///
    /// # Errors
    /// [`Error::Twin`] names a stage of a host that has no function for the CPU; [`Error::Format`] an image that no twin can read.
    pub fn new(declaration: Declaration) -> Result<Self, Error> {
        if let Some(error) = declaration.stage_without_twin() {
            return Err(error);
        }
        let mut stored = vec![[None, None]; declaration.resources().len()];
        for (index, resource) in declaration.resources().iter().enumerate() {
            if resource.lifetime.is_history() {
                for copy in stored[index].iter_mut().take(resource.lifetime.copies()) {
                    *copy = Some(zeroed(&declaration, ResourceId(index as u32))?);
                }
            }
        }
        Ok(Self { declaration, state: FrameState::default(), stored, frame: None, keeps_transients: false })
    }

    /// Keeps every transient readable after the frame, at the price of memory.
    pub fn keep_transients(self) -> Self {
        Self { keeps_transients: true, ..self }
    }

    /// The declaration that it runs.
    pub fn declaration(&self) -> &Declaration {
        &self.declaration
    }

    /// Sets an input image from one value a texel of its allocated extent, row by row.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for what is no input image, [`Error::Format`] for an image of ids,
    /// [`Error::Size`] for a wrong number of texels.
    pub fn upload(&mut self, name: &str, texels: &[[f32; 4]]) -> Result<(), Error> {
        let (id, extent) = self.input_image(name, vk::Format::R32G32B32A32_SFLOAT, texels.len())?;
        self.stored[id.0 as usize][0] = Some(Texels::Colour(Image::from_texels(extent, texels.to_vec())?));
        Ok(())
    }

    /// Sets an input image of ids.
    ///
    /// # Errors
    /// Errors of [`Self::upload`], with [`Error::Format`] for an image of floats.
    pub fn upload_ids(&mut self, name: &str, texels: &[u32]) -> Result<(), Error> {
        let (id, extent) = self.input_image(name, vk::Format::R32_UINT, texels.len())?;
        self.stored[id.0 as usize][0] = Some(Texels::Uint(Image::from_texels(extent, texels.to_vec())?));
        Ok(())
    }

    /// Sets an input buffer.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for what is no input buffer, [`Error::Size`] for fewer bytes than it needs.
    pub fn upload_buffer(&mut self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let id = self.input(name)?;
        let Shape::Buffer { size } = self.declaration.resource(id).shape else {
            return Err(Error::WrongKind { resource: name.to_owned(), needed: "an input buffer" });
        };
        if (bytes.len() as u64) < size {
            let (given, needed) = (format!("{} bytes", bytes.len()), format!("at least {size} bytes"));
            return Err(Error::Size { resource: name.to_owned(), given, needed });
        }
        self.stored[id.0 as usize][0] = Some(Texels::Bytes(bytes.to_vec()));
        Ok(())
    }

    /// Leaves an optional input out from now on.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for what is no input.
    pub fn unbind(&mut self, name: &str) -> Result<(), Error> {
        let id = self.input(name)?;
        self.stored[id.0 as usize][0] = None;
        Ok(())
    }

    /// Makes the next frame drop all history.
    pub fn invalidate(&mut self) {
        self.state.invalidate();
    }

    /// The next frame counts as `index`, and drops all history: see [`crate::FrameState::restart_at`].
    pub fn restart_at(&mut self, index: u64) {
        self.state.restart_at(index);
    }

    /// Runs every pass of a frame; `debug_view` in frames with a view.
    ///
    /// # Errors
    /// Errors of [`FrameState::begin`]; [`Error::NotBound`] names a required input that was not given; [`Error::Twin`] what a
    /// function of a host reports, after which the next frame drops all history.
    pub fn run(&mut self, params: &FrameParams, tuning: &Tuning) -> Result<FrameContext, Error> {
        let required = |(i, r): &(usize, &crate::ResourceDecl)| {
            r.lifetime == (Lifetime::Input { optional: false }) && self.stored[*i][0].is_none()
        };
        if let Some((_, missing)) = self.declaration.resources().iter().enumerate().find(required) {
            return Err(Error::NotBound(missing.name.clone()));
        }
        let frame = self.state.begin(self.declaration.setup(), params, tuning)?;
        self.frame = Some(frame);
        for pass in 0..self.declaration.passes().len() {
            if let Err(error) = self.step(&frame, pass) {
                self.state.invalidate();
                return Err(error);
            }
        }
        Ok(frame)
    }

    /// Texels of the output `debug_view` for the last frame, with any view.
    ///
    /// # Errors
    /// [`Error::UnknownResource`] for a declaration without that pass; [`Error::NoFrame`] before the first frame; [`Error::NotKept`]
    /// for an engine without [`Self::keep_transients`].
    pub fn debug_view(&mut self, view: DebugView) -> Result<Vec<[f32; 4]>, Error> {
        let frame = self.frame.ok_or_else(|| Error::NoFrame("debug_view".into()))?;
        let frame = FrameContext { debug_view: Some(view), ..frame };
        if let Some(pass) = self.declaration.passes().iter().position(|pass| pass.draws_view()) {
            // An optional binding without its image would pass for something that the graph does not have.
            let shown = self.declaration.passes()[pass].uses.iter().filter(|u| u.access != Access::Uniform && u.access.reads());
            if let Some(freed) = shown.map(|u| u.resource).find(|id| self.is_freed(*id)) {
                return Err(Error::NotKept(self.declaration.resource(freed).name.clone()));
            }
            self.run_pass(&frame, pass)?;
        }
        self.download("debug_view")
    }

    /// Texels of an output or a history of the last frame as floats; after [`Self::keep_transients`] of transients, too.
    ///
    /// # Errors
    /// [`Error::UnknownResource`]; [`Error::NoFrame`] before the first frame; [`Error::NotKept`] for a transient that was not kept; [`Error::NotBound`] for an
    /// absent input.
    pub fn download(&self, name: &str) -> Result<Vec<[f32; 4]>, Error> {
        self.texels(name, UseFrame::Current).map(Texels::to_floats)
    }

    /// Counters of the last frame.
    ///
    /// # Errors
    /// [`Error::NoFrame`] before the first frame.
    pub fn statistics(&self) -> Result<Statistics, Error> {
        let texels = self.texels("statistics", UseFrame::Current)?;
        Statistics::from_bytes(if let Texels::Bytes(bytes) = texels { bytes } else { &[] })
    }

    /// Texels of either copy of a resource in the last frame.
    ///
    /// # Errors
    /// Errors of [`Self::download`].
    pub fn texels(&self, name: &str, which: UseFrame) -> Result<&Texels, Error> {
        let id = self.declaration.named(name)?;
        let frame = self.frame.ok_or_else(|| Error::NoFrame(name.to_owned()))?;
        if self.is_freed(id) {
            return Err(Error::NotKept(name.to_owned()));
        }
        let copy = match self.declaration.resource(id).lifetime {
            Lifetime::History => frame.history_copy(which),
            _ => 0,
        };
        self.stored[id.0 as usize][copy].as_ref().ok_or_else(|| Error::NotBound(name.to_owned()))
    }

    /// One pass of a frame, in their order.
    fn step(&mut self, frame: &FrameContext, pass: usize) -> Result<(), Error> {
        if frame.debug_view.is_some() || !self.declaration.passes()[pass].draws_view() {
            self.run_pass(frame, pass)?;
        }
        self.drop_dead(pass);
        Ok(())
    }

    fn run_pass(&mut self, frame: &FrameContext, pass: usize) -> Result<(), Error> {
        let Self { declaration, stored, .. } = self;
        let place = |u: &Use| (u.resource.0 as usize, declaration.copy(u, frame));
        let uses = &declaration.passes()[pass].uses;
        match &declaration.passes()[pass].work {
            Work::StartFrame => {
                for u in uses {
                    let (resource, copy) = place(u);
                    let is_block = declaration.resource(u.resource).name == "frame_constants";
                    stored[resource][copy] = Some(match is_block {
                        true => Texels::Bytes(bytemuck::bytes_of(&frame.constants).to_vec()),
                        false => zeroed(declaration, u.resource)?,
                    });
                }
            }
            Work::Dispatch(_) => {
                let read = |u: &Use| {
                    let (resource, copy) = place(u);
                    stored[resource][copy].as_ref()
                };
                let written = declaration.run_twin(frame, pass, read)?.unwrap_or_default();
                for (index, texels) in written {
                    let (resource, copy) = place(&uses[index]);
                    stored[resource][copy] = Some(texels);
                }
            }
        }
        Ok(())
    }

    /// Frees the transients that no later pass touches.
    fn drop_dead(&mut self, pass: usize) {
        if self.keeps_transients {
            return;
        }
        let dead: Vec<ResourceId> = self.declaration.transients().filter(|(.., last)| *last == pass).map(|(id, ..)| id).collect();
        for id in dead {
            self.stored[id.0 as usize] = [None, None];
        }
    }

    /// Whether a resource is a transient whose content is gone.
    fn is_freed(&self, id: ResourceId) -> bool {
        self.declaration.resource(id).lifetime == Lifetime::Transient && self.stored[id.0 as usize][0].is_none()
    }

    fn input_image(&self, name: &str, given: vk::Format, count: usize) -> Result<(ResourceId, [u32; 2]), Error> {
        let id = self.input(name)?;
        Ok((id, self.declaration.image_for(name, given, count)?.1))
    }

    fn input(&self, name: &str) -> Result<ResourceId, Error> {
        let id = self.declaration.named(name)?;
        match self.declaration.resource(id).lifetime {
            Lifetime::Input { .. } => Ok(id),
            _ => Err(Error::WrongKind { resource: name.to_owned(), needed: "an input" }),
        }
    }
}

pub(super) fn zeroed(declaration: &Declaration, id: ResourceId) -> Result<Texels, Error> {
    let resource = declaration.resource(id);
    match resource.shape {
        Shape::Buffer { size } => Ok(Texels::Bytes(vec![0; size as usize])),
        Shape::Image { format, .. } => {
            let extent = resource.extent(declaration.setup()).unwrap_or([1, 1]);
            Texels::zeroed(ImageFormat::Exactly(format.preferred()), extent)
        }
    }
}

#[cfg(test)]
mod tests;
