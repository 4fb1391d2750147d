//! Inputs of a session: images and buffers from slices.

use super::readback::COPIED;
use super::session::Session;
use super::session_objects::OwnedImage;
use super::storage::{Object, StoredImage};
use super::transfer::{region, Staging, UPLOADED};
use crate::contract::{ResourceState, Shape};
use crate::error::Error;
use ash::vk;
use std::sync::Arc;

impl Session {
    /// Sets an input image from one value per texel of the allocated extent, row by row. Unread
    /// components do not matter.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::Format`] for an image of ids, [`Error::Size`] for a wrong number of texels.
    pub fn upload(&mut self, name: &str, texels: &[[f32; 4]]) -> Result<(), Error> {
        self.upload_image(name, vk::Format::R32G32B32A32_SFLOAT, texels.len(), bytemuck::cast_slice(texels))
    }

    /// Sets an input image of ids.
    ///
    /// # Errors
    /// Errors of [`Self::upload`].
    pub fn upload_ids(&mut self, name: &str, texels: &[u32]) -> Result<(), Error> {
        self.upload_image(name, vk::Format::R32_UINT, texels.len(), bytemuck::cast_slice(texels))
    }

    /// Sets an input image from raw texels of the format that its declaration prefers
    /// ([`ImageFormat::preferred`](crate::ImageFormat::preferred)), row by row: for the times and
    /// traffic of a real engine.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for a buffer, [`Error::Size`] for a wrong number of bytes.
    pub fn upload_bytes(&mut self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let declaration = self.executor.denoiser().declaration();
        let resource = declaration.resource(declaration.named(name)?);
        let Shape::Image { format, .. } = resource.shape else {
            return Err(Error::WrongKind { resource: name.to_owned(), needed: "an image" });
        };
        let needed = resource.bytes(declaration.setup());
        if bytes.len() as u64 != needed {
            let (given, needed) = (format!("{} bytes", bytes.len()), format!("{needed} bytes"));
            return Err(Error::Size { resource: name.to_owned(), given, needed });
        }
        let [width, height] = resource.extent(declaration.setup()).unwrap_or([1, 1]);
        self.upload_image(name, format.preferred(), width as usize * height as usize, bytes)
    }

    /// Sets an input buffer.
    ///
    /// # Errors
    /// [`Error::UnknownResource`], [`Error::WrongKind`] for an image, [`Error::Size`].
    pub fn upload_buffer(&mut self, name: &str, bytes: &[u8]) -> Result<(), Error> {
        let declaration = self.executor.denoiser().declaration();
        declaration.named(name)?;
        self.settle()?;
        let size = bytes.len() as u64;
        // SAFETY: the device outlives the session.
        let mut staging = unsafe { Staging::new(self.gpu.host(), size.max(4))? };
        staging.bytes()[..bytes.len()].copy_from_slice(bytes);
        let (stage, access) = (vk::PipelineStageFlags2::HOST, vk::AccessFlags2::HOST_WRITE);
        self.executor.bind_buffer(name, staging.buffer, size, stage, access)?;
        self.buffers.insert(name.to_owned(), staging);
        Ok(())
    }

    /// Leaves an optional input out from now on.
    ///
    /// # Errors
    /// [`Error::UnknownResource`].
    pub fn unbind(&mut self, name: &str) -> Result<(), Error> {
        self.executor.unbind(name)
    }

    fn upload_image(&mut self, name: &str, format: vk::Format, count: usize, bytes: &[u8]) -> Result<(), Error> {
        let (_, extent) = self.executor.denoiser().declaration().image_for(name, format, count)?;
        // What an input set holds as well keeps its content.
        let reusable = |owned: &&Arc<OwnedImage>| owned.format == format && Arc::strong_count(owned) == 1;
        let owned = match self.inputs.get(name).filter(reusable) {
            Some(owned) => owned.clone(),
            // SAFETY: the device outlives the session, and every input set.
            None => Arc::new(unsafe { OwnedImage::new(self.gpu.host(), format, extent)? }),
        };
        let host = owned.uploaded();
        self.stage(bytes.len() as u64)?.bytes()[..bytes.len()].copy_from_slice(bytes);
        let stored = StoredImage::of_host(&host);
        let image = Object::Image(stored);
        self.submit(|session, cmd| {
            let buffer = session.staging.as_ref().map_or(vk::Buffer::null(), |s| s.buffer);
            let device = session.gpu.device();
            // SAFETY: command buffer is recording; image and buffer are live and large enough.
            unsafe {
                // The staging buffer may have been filled by a copy before the host wrote to it.
                let staged = Object::Buffer { buffer, size: vk::WHOLE_SIZE };
                session.barriers.single(device, cmd, staged, [COPIED, ResourceState::COPY_SOURCE], false);
                session.barriers.single(device, cmd, image, [UPLOADED, COPIED], true);
                let layout = vk::ImageLayout::TRANSFER_DST_OPTIMAL;
                device.cmd_copy_buffer_to_image(cmd, buffer, host.image, layout, &[region(&stored, [0; 2], extent)]);
                session.barriers.single(device, cmd, image, [COPIED, UPLOADED], false);
            }
            Ok(())
        })?;
        // Behind the upload: an image that was never written would have no layout to be read in.
        self.executor.bind_image(name, host)?;
        self.inputs.insert(name.to_owned(), owned);
        Ok(())
    }
}
