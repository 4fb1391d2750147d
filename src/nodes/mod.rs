//! The stages as nodes: which shader, which resources, how each is touched. A node adds its passes to a [`Builder`]; nothing is allocated.

mod adaptive_alpha;
mod adaptive_history;
mod atrous;
mod block_difference;
mod block_percentiles;
mod debug_view;
mod demodulate;
mod eaw;
mod firefly;
mod forward_project;
mod gradient;
mod gradient_atrous;
mod import;
mod modulate;
mod start_frame;
mod taa;
mod temporal_accumulation;
mod tone_map;
mod variance;
mod volume_motion;
mod volume_points;

pub(crate) use adaptive_alpha::{adaptive_alpha, host_confidence};
pub(crate) use adaptive_history::{change_test, percentile_rule};
pub(crate) use atrous::{atrous, volume_atrous, Filtered, Kernel};
pub(crate) use block_difference::block_difference;
pub(crate) use block_percentiles::{block_percentiles, volume_percentiles, BLOCK_SIZE};
pub(crate) use debug_view::{debug_view, Shown};
pub(crate) use demodulate::demodulate;
pub(crate) use eaw::eaw;
pub(crate) use firefly::{firefly, volume_firefly};
pub(crate) use forward_project::forward_project;
pub(crate) use gradient::{gradient, Gradients, Strata};
pub(crate) use gradient_atrous::gradient_atrous;
pub(crate) use import::{import, Guides};
pub(crate) use modulate::modulate;
pub(crate) use start_frame::{start_frame, Frame, STATISTICS_COUNT};
pub(crate) use taa::taa;
pub(crate) use temporal_accumulation::{temporal_accumulation, volume_accumulation, Adaptation};
pub(crate) use tone_map::tone_map;
pub(crate) use variance::{variance, volume_variance, Estimate};
pub(crate) use volume_motion::volume_motion;
pub(crate) use volume_points::{volume_points, Volume};

use crate::config::Signals;
use crate::contract::{
    Access, Component, Declaration, Grid, ImageFormat, Lifetime, PassDecl, Phase, ResourceDecl, ResourceId, Shape, Use, UseFrame,
    Work,
};
use crate::shaders::Shader;
use ash::vk;

/// Linear HDR colour with a fourth value.
pub(crate) const HDR: ImageFormat = ImageFormat::Exactly(vk::Format::R16G16B16A16_SFLOAT);
/// 64 packed bits. Four times 16 and not twice 32, since that one needs no device feature as a storage image.
pub(crate) const PACKED_64: ImageFormat = ImageFormat::Exactly(vk::Format::R16G16B16A16_UINT);
/// 32 packed bits.
pub(crate) const PACKED_32: ImageFormat = ImageFormat::Exactly(vk::Format::R32_UINT);
/// Colour of a host.
pub(crate) const HOST_COLOUR: ImageFormat = ImageFormat::Any(Component::Float, vk::Format::R16G16B16A16_SFLOAT);
/// One float of a host.
pub(crate) const HOST_SCALAR: ImageFormat = ImageFormat::Any(Component::Float, vk::Format::R32_SFLOAT);
/// One id of a host.
pub(crate) const HOST_ID: ImageFormat = ImageFormat::Any(Component::Uint, vk::Format::R32_UINT);

/// Inputs without which a preset with gradients has none.
pub(crate) const GRADIENT_INPUTS: [&str; 2] = ["reshaded_radiance", "sparse_gradient"];

/// Collects resources and passes.
pub(crate) struct Builder {
    declaration: Declaration,
}

impl Builder {
    pub fn new(allocated_extent: [u32; 2]) -> Self {
        Self { declaration: Declaration { allocated_extent, resources: Vec::new(), passes: Vec::new() } }
    }

    /// An image with one texel per pixel.
    pub fn image(&mut self, name: &str, format: ImageFormat, lifetime: Lifetime) -> ResourceId {
        self.resource(name, Shape::Image { format, divisor: 1 }, lifetime)
    }

    /// An image with one texel per block of pixels.
    pub fn block_image(&mut self, name: &str, format: ImageFormat, lifetime: Lifetime) -> ResourceId {
        self.resource(name, Shape::Image { format, divisor: BLOCK_SIZE }, lifetime)
    }

    /// An image with one texel a stratum.
    pub fn stratum_image(&mut self, name: &str, strata: Strata, format: ImageFormat, lifetime: Lifetime) -> ResourceId {
        self.resource(name, Shape::Image { format, divisor: strata.size }, lifetime)
    }

    pub fn buffer(&mut self, name: &str, size: u64, lifetime: Lifetime) -> ResourceId {
        self.resource(name, Shape::Buffer { size }, lifetime)
    }

    /// An input image; the same name twice is the same input.
    pub fn input(&mut self, name: &str, format: ImageFormat, optional: bool) -> ResourceId {
        self.declaration.find(name).unwrap_or_else(|| self.image(name, format, Lifetime::Input { optional }))
    }

    /// The same with one texel a stratum.
    pub fn stratum_input(&mut self, name: &str, strata: Strata, format: ImageFormat, optional: bool) -> ResourceId {
        self.stratum_image(name, strata, format, Lifetime::Input { optional })
    }

    /// Previous from current world space by surface id: three rows of four floats an instance.
    pub fn instance_transforms(&mut self) -> ResourceId {
        const NAME: &str = "instance_transforms";
        const BYTES_EACH: u64 = 48;
        self.declaration.find(NAME).unwrap_or_else(|| self.buffer(NAME, BYTES_EACH, Lifetime::Input { optional: true }))
    }

    fn resource(&mut self, name: &str, shape: Shape, lifetime: Lifetime) -> ResourceId {
        let resource = ResourceDecl {
            name: name.to_owned(),
            shape,
            lifetime,
            image_usage: vk::ImageUsageFlags::empty(),
            buffer_usage: vk::BufferUsageFlags::empty(),
        };
        self.declaration.resources.push(resource);
        ResourceId(self.declaration.resources.len() as u32 - 1)
    }

    /// One dispatch. `uses` stand in the order of the shader's bindings.
    pub fn dispatch(&mut self, name: &'static str, phase: Phase, shader: &'static Shader, level: u32, uses: Vec<Use>) {
        self.pass(name, phase, Work::Dispatch { shader, level, grid: Grid::Pixels }, uses);
    }

    /// One dispatch that covers the pixels of this frame and those of the previous one.
    pub fn dispatch_either(&mut self, name: &'static str, phase: Phase, shader: &'static Shader, uses: Vec<Use>) {
        self.pass(name, phase, Work::Dispatch { shader, level: 0, grid: Grid::Strata(1) }, uses);
    }

    /// A dispatch with one invocation a stratum.
    pub fn dispatch_strata(
        &mut self,
        name: &'static str,
        phase: Phase,
        shader: &'static Shader,
        strata: Strata,
        level: u32,
        uses: Vec<Use>,
    ) {
        self.pass(name, phase, Work::Dispatch { shader, level, grid: Grid::Strata(strata.size) }, uses);
    }

    /// A dispatch that shows the view of the frame. Bit i of `available`: use i does not stand in for another image.
    pub fn dispatch_debug_view(
        &mut self,
        name: &'static str,
        phase: Phase,
        shader: &'static Shader,
        available: u32,
        uses: Vec<Use>,
    ) {
        self.pass(name, phase, Work::DebugView { shader, available }, uses);
    }

    /// Fills an image of unsigned integers with zeros.
    pub fn clear(&mut self, name: &'static str, phase: Phase, image: ResourceId) {
        self.pass(name, phase, Work::Clear, vec![image.cleared()]);
    }

    fn pass(&mut self, name: &'static str, phase: Phase, work: Work, uses: Vec<Use>) {
        self.declaration.passes.push(PassDecl { name: name.to_owned(), phase, uses, work });
    }

    /// The declaration, with the usage flags of every resource.
    pub fn finish(mut self) -> Declaration {
        let Declaration { resources, passes, .. } = &mut self.declaration;
        for u in passes.iter().flat_map(|p| &p.uses) {
            let resource = &mut resources[u.resource.0 as usize];
            match resource.shape {
                Shape::Image { .. } => resource.image_usage |= u.access.image_usage(),
                Shape::Buffer { .. } => resource.buffer_usage |= u.access.buffer_usage(),
            }
        }
        self.declaration
    }
}

impl ResourceId {
    const fn used(self, frame: UseFrame, access: Access) -> Use {
        Use { resource: self, frame, access }
    }
    const fn sampled(self) -> Use {
        self.used(UseFrame::Current, Access::Sampled)
    }
    const fn previous(self) -> Use {
        self.used(UseFrame::Previous, Access::Sampled)
    }
    const fn written(self) -> Use {
        self.used(UseFrame::Current, Access::StorageWrite)
    }
    const fn updated(self) -> Use {
        self.used(UseFrame::Current, Access::StorageReadWrite)
    }
    const fn storage(self) -> Use {
        self.used(UseFrame::Current, Access::StorageRead)
    }
    const fn uniform(self) -> Use {
        self.used(UseFrame::Current, Access::Uniform)
    }
    const fn cleared(self) -> Use {
        self.used(UseFrame::Current, Access::Clear)
    }
}

/// The resources of one lighting component.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Signal {
    /// Noisy radiance of the host.
    pub noisy: ResourceId,
    /// Demodulated, then accumulated, then every second level.
    pub ping: ResourceId,
    /// Variance estimate, then the other levels.
    pub pong: ResourceId,
    /// Level 0 of the previous frame.
    pub history: ResourceId,
    /// Mean and standard deviation of luminance, history length, disocclusion reason.
    pub moments: ResourceId,
}

impl Signal {
    /// Declares the resources of every signal.
    pub fn declare(b: &mut Builder, signals: Signals) -> Vec<Self> {
        const TOGETHER: [[&str; 5]; 1] = [["noisy_radiance", "filter_ping", "filter_pong", "irradiance_history", "moments"]];
        const APART: [[&str; 5]; 2] = [
            ["noisy_direct", "filter_ping_direct", "filter_pong_direct", "irradiance_history_direct", "moments_direct"],
            ["noisy_indirect", "filter_ping_indirect", "filter_pong_indirect", "irradiance_history_indirect", "moments_indirect"],
        ];
        let names: &[[&'static str; 5]] = match signals {
            Signals::Together => &TOGETHER,
            Signals::Apart => &APART,
        };
        let declare = |&[noisy, ping, pong, history, moments]: &[&'static str; 5]| Self {
            noisy: b.input(noisy, HOST_COLOUR, false),
            ping: b.image(ping, HDR, Lifetime::Transient),
            pong: b.image(pong, HDR, Lifetime::Transient),
            history: b.image(history, HDR, Lifetime::HistoryInPlace),
            moments: b.image(moments, PACKED_64, Lifetime::History),
        };
        names.iter().map(declare).collect()
    }

    /// The same for a filter without history.
    pub fn declare_without_history(b: &mut Builder, signals: Signals) -> Vec<Self> {
        const TOGETHER: [[&str; 3]; 1] = [["noisy_radiance", "filter_ping", "filter_pong"]];
        const APART: [[&str; 3]; 2] = [
            ["noisy_direct", "filter_ping_direct", "filter_pong_direct"],
            ["noisy_indirect", "filter_ping_indirect", "filter_pong_indirect"],
        ];
        let names: &[[&'static str; 3]] = match signals {
            Signals::Together => &TOGETHER,
            Signals::Apart => &APART,
        };
        let declare = |&[noisy, ping, pong]: &[&'static str; 3]| {
            let noisy = b.input(noisy, HOST_COLOUR, false);
            let (ping, pong) = (b.image(ping, HDR, Lifetime::Transient), b.image(pong, HDR, Lifetime::Transient));
            Self { noisy, ping, pong, history: pong, moments: pong }
        };
        names.iter().map(declare).collect()
    }

    /// The image of another denoiser, accumulated in place: the history of a frame is its own result.
    pub fn declare_stabilized(b: &mut Builder) -> Self {
        let accumulated = b.image("irradiance_history", HDR, Lifetime::History);
        Self {
            noisy: b.input("other_denoised_radiance", HOST_COLOUR, false),
            ping: accumulated,
            pong: accumulated,
            history: accumulated,
            moments: b.image("moments", PACKED_64, Lifetime::History),
        }
    }
}

/// Picks the variant of a shader for one or two signals.
fn by_signals(signals: &[Signal], one: &'static Shader, two: &'static Shader) -> &'static Shader {
    if signals.len() == 1 {
        one
    } else {
        two
    }
}
