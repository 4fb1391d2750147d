//! A whole frame in one call, for engines without a frame graph.

use super::{Executor, HostImage};
use crate::contract::{FrameContext, FrameParams, Lifetime, Phase, ResourceId, ResourceState, Shape, Tuning};
use crate::error::Error;
use ash::vk;

/// An image that you lend for one call of [`Executor::denoise`]: an input, or an output to be
/// written.
#[derive(Clone, Copy, Debug)]
pub struct LentImage<'a> {
    /// Name of the resource, for example `depth`.
    pub name: &'a str,
    /// The image, in the state in which the call finds it.
    pub image: HostImage,
    /// The state in which the call leaves it, for your next accesses. `None`: as it was found.
    pub after: Option<ResourceState>,
}

impl<'a> LentImage<'a> {
    /// An image that is left as it was found.
    pub fn new(name: &'a str, image: HostImage) -> Self {
        Self { name, image, after: None }
    }
}

impl Executor {
    /// Denoises a frame on your command buffer: begins the frame and records all its phases.
    /// Histories and transients belong to the executor, and so do outputs that you do not lend;
    /// [`Self::record_copy`] reads them.
    ///
    /// Lend every image anew in each frame: an optional input that you do not lend is left out.
    /// Buffers from [`Self::bind_buffer`] stay. After [`Self::resize`], lend images of the new
    /// extent. If your path tracer re-shades gradient samples, it works between the phases: call
    /// [`Self::begin_frame`] and [`Self::record`] instead.
    ///
    /// # Errors
    /// Errors of [`Self::bind_image`], [`Self::begin_frame`] and [`Self::record`]. A frame that is
    /// refused before it began changes nothing but the bound images.
    ///
    /// # Safety
    /// Obligations of [`Self::record`]; every image is in the state given with it.
    pub unsafe fn denoise(
        &mut self,
        cmd: vk::CommandBuffer,
        params: &FrameParams,
        tuning: &Tuning,
        images: &[LentImage<'_>],
    ) -> Result<FrameContext, Error> {
        for image in images {
            let after = image.after.unwrap_or(image.image.state());
            self.bind_image_until(image.name, image.image, after)?;
        }
        let resources = self.denoiser.declaration().resources();
        for (resource, id) in resources.iter().zip(0..) {
            let is_shared = matches!(resource.lifetime, Lifetime::Input { .. } | Lifetime::Output);
            let is_image = matches!(resource.shape, Shape::Image { .. });
            if is_shared && is_image && !images.iter().any(|image| image.name == resource.name) {
                self.memory.storages.unbind(ResourceId(id));
            }
        }
        let frame = self.begin_frame(params, tuning)?;
        for phase in Phase::ALL {
            // SAFETY: `cmd` is recording outside a render pass on a compute queue; what is lent is live, in the state that was given,
            // and the slot's earlier work is complete.
            unsafe { self.record_passes(cmd, &frame, phase)? };
        }
        // SAFETY: `cmd` is recording outside a render pass, and what the host lent is live.
        unsafe { self.barriers.hand_back(&self.device, cmd, &mut self.memory.storages) };
        Ok(frame)
    }
}
