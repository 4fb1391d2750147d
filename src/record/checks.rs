//! Checks of a host's bindings that no descriptor shows: layouts, images, and the copies of histories.

use crate::contract::{
    Access, Binding, Declaration, FrameContext, Lifetime, PassDecl, ResourceDecl, ResourceState, Shape, UseFrame,
};
use crate::error::Error;
use ash::vk::{self, Handle};
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Checks that tell you mistakes which Vulkan does not see, as errors of
/// [`Denoiser::record`](crate::Denoiser::record) and of
/// [`Denoiser::begin_frame`](crate::Denoiser::begin_frame). They cost some microseconds a frame.
///
/// Checked are the layout of each binding, that the current and the previous copy of a history are two images which you exchange
/// in each frame, that no pass is left out, and, where you give [`FrameParams::complete_frames`](crate::FrameParams::complete_frames),
/// that no slot is in flight.
#[derive(Clone, Debug)]
pub struct Checks {
    /// Whether they are made. Initially: in debug builds.
    pub on: bool,
    /// Your images by their views, as far as you tell them: format, extent and usage of what you bind are then checked as well. Tell
    /// of a view again if its handle is used for another one.
    pub images: BTreeMap<vk::ImageView, ImageDescription>,
}

impl Default for Checks {
    fn default() -> Self {
        Self { on: cfg!(debug_assertions), images: BTreeMap::new() }
    }
}

/// An image as you created it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ImageDescription {
    /// Format of the view.
    pub format: vk::Format,
    /// Width and height.
    pub extent: [u32; 2],
    /// Usage.
    pub usage: vk::ImageUsageFlags,
}

/// The handles of the two copies of a history, 0 where not known.
type Copies = [u64; 2];

/// The copies that were bound, by resource: of the newest frame, and of the one before.
#[derive(Default)]
pub(crate) struct Histories(Mutex<BTreeMap<u32, (u64, Copies, Copies)>>);

impl Histories {
    pub(crate) fn forget(&self) {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).clear();
    }

    /// Notes a copy, and tells a mistake.
    fn bound(&self, resource: u32, frame: u64, copy: UseFrame, handle: u64) -> Option<String> {
        let mut all = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let (newest, now, before) = all.entry(resource).or_insert((frame, [0; 2], [0; 2]));
        if *newest != frame {
            *before = if newest.wrapping_add(1) == frame { *now } else { [0; 2] };
            (*newest, *now) = (frame, [0; 2]);
        }
        now[copy as usize] = handle;
        if now[0] == now[1] {
            return Some(format!(
                "the current and the previous copy are one and the same, {handle:#x}; give each an image of its own"
            ));
        }
        (now == before && !now.contains(&0)).then(|| {
            format!(
                "frame {frame} has the copies of the frame before, {:#x} as current and {:#x} as previous; exchange them in each frame, as \
                 Declaration::copy says",
                now[0], now[1]
            )
        })
    }
}

/// Whether the bindings of a pass, which fit it in number and kind, are what its uses say.
pub(crate) fn check(
    checks: &Checks,
    histories: &Histories,
    declaration: &Declaration,
    frame: &FrameContext,
    pass: &PassDecl,
    bindings: &[Binding],
) -> Result<(), Error> {
    for (u, binding) in pass.uses.iter().zip(bindings) {
        let resource = declaration.resource(u.resource);
        let (handle, problem) = match *binding {
            Binding::Absent => continue,
            Binding::Buffer { buffer, .. } => (buffer.as_raw(), None),
            Binding::Image { view, layout } => {
                let described = checks.images.get(&view);
                let wrong = || described.and_then(|image| wrong_image(declaration, resource, u.access, image));
                (view.as_raw(), wrong_layout(u.access, layout).or_else(wrong))
            }
        };
        let is_pair = resource.lifetime == Lifetime::History;
        let copies = || if is_pair { histories.bound(u.resource.0, frame.index, u.frame, handle) } else { None };
        if let Some(problem) = problem.or_else(copies) {
            return Err(Error::Binding { pass: pass.name.clone(), resource: resource.name.clone(), problem });
        }
    }
    Ok(())
}

fn wrong_layout(access: Access, layout: vk::ImageLayout) -> Option<String> {
    let declared = access.image().layout;
    let given = ResourceState::new(vk::PipelineStageFlags2::NONE, vk::AccessFlags2::NONE, layout);
    let is_sampled = access == Access::Sampled && given.is_sampled_in_place();
    let fits = layout == declared || layout == vk::ImageLayout::GENERAL || is_sampled;
    (!fits).then(|| {
        format!(
            "it is bound in the layout {layout:?}; bring it to {declared:?} or GENERAL by a barrier, and name that in the binding"
        )
    })
}

fn wrong_image(declaration: &Declaration, resource: &ResourceDecl, access: Access, image: &ImageDescription) -> Option<String> {
    let (Shape::Image { format, .. }, Some(extent)) = (resource.shape, resource.extent(declaration.setup())) else {
        return None;
    };
    if !format.accepts(image.format) {
        return Some(format!("its image has the format {:?}; it takes {format}", image.format));
    }
    if (0..2).any(|i| image.extent[i] < extent[i]) {
        let ([w, h], [width, height]) = (image.extent, extent);
        return Some(format!("its image has {w}x{h} pixels; it needs {width}x{height}, those of the allocated extent"));
    }
    let needed = access.image_usage();
    (!image.usage.contains(needed)).then(|| format!("its image has the usage {:?}; create it with {needed:?} as well", image.usage))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::config::Config;
    use crate::contract::{FrameParams, FrameState, Tuning, Use};

    struct Host {
        checks: Checks,
        histories: Histories,
        declaration: Declaration,
        state: FrameState,
    }

    impl Host {
        fn new() -> Self {
            let checks = Checks { on: true, images: BTreeMap::new() };
            let declaration = Config::new([64, 36]).declare().expect("valid");
            Self { checks, histories: Histories::default(), declaration, state: FrameState::default() }
        }

        fn begin(&mut self) -> FrameContext {
            let params = FrameParams::new([64, 36]);
            self.state.begin(self.declaration.setup(), &params, &Tuning::default()).expect("a frame")
        }

        /// The handle of a copy of a resource: a number of its own.
        fn handle(u: &Use, copy: usize) -> u64 {
            u64::from(u.resource.0) * 2 + copy as u64 + 1
        }

        /// Every pass of a frame, with its bindings changed; the first problem.
        fn record(&self, frame: &FrameContext, change: impl Fn(&Use, Binding) -> Binding) -> Option<String> {
            let binding = |u: &Use| {
                let (handle, layout) = (Self::handle(u, self.declaration.copy(u, frame)), u.access.image().layout);
                let right = match self.declaration.resource(u.resource).shape {
                    Shape::Buffer { .. } => Binding::Buffer { buffer: vk::Buffer::from_raw(handle), offset: 0, range: 4 },
                    Shape::Image { .. } => Binding::Image { view: vk::ImageView::from_raw(handle), layout },
                };
                change(u, right)
            };
            let record = |pass: &PassDecl| {
                let bindings: Vec<_> = pass.uses.iter().map(binding).collect();
                check(&self.checks, &self.histories, &self.declaration, frame, pass, &bindings).err()
            };
            self.declaration.passes().iter().find_map(record).map(|error| error.to_string())
        }
    }

    fn in_layout(binding: Binding, layout: vk::ImageLayout) -> Binding {
        match binding {
            Binding::Image { view, .. } => Binding::Image { view, layout },
            other => other,
        }
    }

    #[test]
    fn right_bindings_are_told_nothing() {
        let mut host = Host::new();
        for _ in 0..4 {
            let frame = host.begin();
            assert_eq!(host.record(&frame, |_, binding| binding), None);
            assert_eq!(host.record(&frame, |_, binding| in_layout(binding, vk::ImageLayout::GENERAL)), None);
        }
    }

    #[test]
    fn a_layout_in_which_no_shader_reads_is_refused() {
        for layout in [vk::ImageLayout::UNDEFINED, vk::ImageLayout::COLOR_ATTACHMENT_OPTIMAL] {
            let mut host = Host::new();
            let frame = host.begin();
            let problem = host.record(&frame, |_, binding| in_layout(binding, layout)).expect("a problem");
            assert!(problem.contains(&format!("bound in the layout {layout:?}; bring it to ")), "{problem}");
        }
        // Depth may be sampled where it is; nothing may be written there.
        let read_only = vk::ImageLayout::DEPTH_STENCIL_READ_ONLY_OPTIMAL;
        assert_eq!(wrong_layout(Access::Sampled, read_only), None);
        assert!(wrong_layout(Access::StorageWrite, read_only).is_some());
    }

    #[test]
    fn one_image_for_both_copies_is_refused() {
        let mut host = Host::new();
        let frame = host.begin();
        let problem = host.record(&frame, |u, binding| match binding {
            Binding::Image { layout, .. } => Binding::Image { view: vk::ImageView::from_raw(Host::handle(u, 0)), layout },
            other => other,
        });
        let problem = problem.expect("a problem");
        assert!(problem.contains("the current and the previous copy are one and the same"), "{problem}");
    }

    #[test]
    fn copies_that_are_not_exchanged_are_refused() {
        let mut host = Host::new();
        let fixed = |u: &Use, binding| match binding {
            Binding::Image { layout, .. } => {
                Binding::Image { view: vk::ImageView::from_raw(Host::handle(u, u.frame as usize)), layout }
            }
            other => other,
        };
        let frame = host.begin();
        assert_eq!(host.record(&frame, fixed), None);
        let frame = host.begin();
        let problem = host.record(&frame, fixed).expect("a problem");
        assert!(problem.contains("frame 1 has the copies of the frame before"), "{problem}");
        // Behind a frame that was not recorded nothing is known.
        let (_, frame) = (host.begin(), host.begin());
        assert_eq!(host.record(&frame, fixed), None);
    }

    #[test]
    fn an_image_that_was_described_has_to_fit() {
        let id = Host::new().declaration.find("noisy_radiance").expect("an input");
        let good = ImageDescription {
            format: vk::Format::R16G16B16A16_SFLOAT,
            extent: [64, 40],
            usage: vk::ImageUsageFlags::SAMPLED | vk::ImageUsageFlags::STORAGE,
        };
        let cases = [
            (good, None),
            (ImageDescription { format: vk::Format::R32_UINT, ..good }, Some("its image has the format R32_UINT; it takes")),
            (ImageDescription { extent: [64, 35], ..good }, Some("its image has 64x35 pixels; it needs 64x36")),
            (
                ImageDescription { usage: vk::ImageUsageFlags::TRANSFER_DST, ..good },
                Some("its image has the usage TRANSFER_DST; create it"),
            ),
        ];
        for (image, expected) in cases {
            let mut host = Host::new();
            host.checks.images.insert(vk::ImageView::from_raw(u64::from(id.0) * 2 + 1), image);
            let frame = host.begin();
            let problem = host.record(&frame, |_, binding| binding);
            match expected {
                Some(words) => assert!(problem.as_ref().is_some_and(|p| p.contains(words)), "{words}: {problem:?}"),
                None => assert_eq!(problem, None),
            }
        }
    }
}
