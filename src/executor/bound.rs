//! Your images and buffers, for inputs and outputs.

use super::storage::{Object, StoredImage};
use super::Executor;
use crate::contract::{Lifetime, ResourceState, Shape, Subresource};
use crate::error::Error;
use ash::vk;

/// An image of yours, for an input or an output.
#[derive(Clone, Copy, Debug)]
pub struct HostImage {
    /// Image.
    pub image: vk::Image,
    /// 2D view of the subresource.
    pub view: vk::ImageView,
    /// Its layer and mip level: `Subresource::default()` for an image with one of each.
    pub subresource: Subresource,
    /// Format of the view.
    pub format: vk::Format,
    /// Extent of that mip level, at least the allocated one.
    pub extent: [u32; 2],
    /// Its layout before each phase, to which it returns at the end of the phase.
    pub layout: vk::ImageLayout,
    /// Your stages that use it before a phase, and that read it after.
    pub stage: vk::PipelineStageFlags2,
    /// Accesses of those stages.
    pub access: vk::AccessFlags2,
}

impl HostImage {
    /// The state that the host has it in.
    pub(super) fn state(&self) -> ResourceState {
        ResourceState::new(self.stage, self.access, self.layout)
    }
}

impl Executor {
    /// Binds an image of yours to an input or an output, until you bind a new one.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for a resource that is the executor's, [`Error::Format`], [`Error::Size`].
    pub fn bind_image(&mut self, name: &str, image: HostImage) -> Result<(), Error> {
        self.bind_image_until(name, image, image.state())
    }

    /// Binds an image of the host, which is handed back in the state `after`.
    pub(super) fn bind_image_until(&mut self, name: &str, image: HostImage, after: ResourceState) -> Result<(), Error> {
        let declaration = self.denoiser.declaration();
        let id = declaration.named(name)?;
        let resource = declaration.resource(id);
        let (Shape::Image { format, .. }, Some(extent)) = (resource.shape, resource.extent(declaration.setup())) else {
            return Err(Error::WrongKind { resource: name.to_owned(), needed: "an input image or an output image" });
        };
        if !matches!(resource.lifetime, Lifetime::Input { .. } | Lifetime::Output) {
            return Err(Error::WrongKind { resource: name.to_owned(), needed: "an input image or an output image" });
        }
        if !format.accepts(image.format) {
            return Err(Error::Format { resource: name.to_owned(), given: image.format, allowed: format.to_string() });
        }
        if (0..2).any(|i| image.extent[i] < extent[i]) {
            let pixels = |e: [u32; 2]| format!("{}x{} pixels", e[0], e[1]);
            return Err(Error::Size { resource: name.to_owned(), given: pixels(image.extent), needed: pixels(extent) });
        }
        self.memory.storages.bind(id, Object::Image(StoredImage::of_host(&image)), [image.state(), after]);
        Ok(())
    }

    /// Binds a buffer of yours to an input, until you bind a new one. `stage` and `access` are your
    /// own uses before each phase.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for a resource that is no input buffer, [`Error::Size`].
    pub fn bind_buffer(
        &mut self,
        name: &str,
        buffer: vk::Buffer,
        size: u64,
        stage: vk::PipelineStageFlags2,
        access: vk::AccessFlags2,
    ) -> Result<(), Error> {
        let declaration = self.denoiser.declaration();
        let id = declaration.named(name)?;
        let Shape::Buffer { size: needed } = declaration.resource(id).shape else {
            return Err(Error::WrongKind { resource: name.to_owned(), needed: "an input buffer or an output buffer" });
        };
        if !matches!(declaration.resource(id).lifetime, Lifetime::Input { .. } | Lifetime::Output) {
            return Err(Error::WrongKind { resource: name.to_owned(), needed: "an input buffer or an output buffer" });
        }
        if size < needed {
            let (given, needed) = (format!("{size} bytes"), format!("at least {needed} bytes"));
            return Err(Error::Size { resource: name.to_owned(), given, needed });
        }
        let state = ResourceState::new(stage, access, vk::ImageLayout::UNDEFINED);
        self.memory.storages.bind(id, Object::Buffer { buffer, size }, [state; 2]);
        Ok(())
    }

    /// Leaves an optional input out from now on.
    ///
    /// # Errors
    /// [`Error::UnknownResource`].
    pub fn unbind(&mut self, name: &str) -> Result<(), Error> {
        let id = self.denoiser.declaration().named(name)?;
        self.memory.storages.unbind(id);
        Ok(())
    }
}
