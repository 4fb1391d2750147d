//! Physical images and buffers of a declaration, with their tracker. Knows no device.

use super::HostImage;
use crate::contract::texel::Texel;
use crate::contract::Binding;
use crate::contract::{
    component_of, Component, Declaration, FrameContext, PhysicalResource, ResourceId, ResourceState, Span, Subresource, Tracker,
};
use crate::error::Error;
use ash::vk;

/// A physical image with its view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StoredImage {
    pub image: vk::Image,
    pub view: vk::ImageView,
    pub format: vk::Format,
    pub extent: [u32; 2],
    /// Every aspect of the format: barriers name all of them.
    pub aspects: vk::ImageAspectFlags,
    pub subresource: Subresource,
}

impl StoredImage {
    pub(crate) fn new(image: vk::Image, view: vk::ImageView, format: vk::Format, extent: [u32; 2]) -> Self {
        let aspects = Texel::of(format).map_or(vk::ImageAspectFlags::COLOR, |texel| texel.aspects());
        Self { image, view, format, extent, aspects, subresource: Subresource::FIRST }
    }

    pub(crate) fn of_host(host: &HostImage) -> Self {
        Self { subresource: host.subresource, ..Self::new(host.image, host.view, host.format, host.extent) }
    }

    /// Whether texels are unsigned integers.
    pub(crate) fn is_uint(&self) -> bool {
        component_of(self.format) == Some(Component::Uint)
    }

    /// Bytes of a texel in a copy of the image of this resource.
    pub(crate) fn texel_bytes(&self, resource: &str) -> Result<u64, Error> {
        let texel = Texel::of(self.format).ok_or_else(|| {
            let allowed = format!("for a copy {}", crate::contract::texel::ACCEPTED);
            Error::Format { resource: resource.to_owned(), given: self.format, allowed }
        })?;
        Ok(texel.bytes() as u64)
    }
}

/// A physical image or buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Object {
    Image(StoredImage),
    Buffer { buffer: vk::Buffer, size: u64 },
}

impl Object {
    /// The image, where it is one.
    pub(crate) fn image(&self) -> Option<&StoredImage> {
        match self {
            Self::Image(image) => Some(image),
            Self::Buffer { .. } => None,
        }
    }

    pub(crate) fn physical(&self) -> PhysicalResource {
        match *self {
            Self::Image(StoredImage { image, view, aspects, subresource, .. }) => {
                PhysicalResource::Image { image, view, aspects, subresource }
            }
            Self::Buffer { buffer, .. } => PhysicalResource::buffer(buffer),
        }
    }
}

/// Objects by resource, then copy.
pub(crate) struct Objects(Vec<[Option<Object>; 2]>);

impl Objects {
    pub(crate) fn physical(&self, id: ResourceId, copy: usize) -> Option<PhysicalResource> {
        self.get(id, copy).map(Object::physical)
    }

    fn get(&self, id: ResourceId, copy: usize) -> Option<&Object> {
        self.0.get(id.0 as usize)?.get(copy)?.as_ref()
    }
}

/// Every physical image and buffer of a declaration.
pub(crate) struct Storages {
    objects: Objects,
    tracker: Tracker,
    /// The states in which the host lends its bound resources, by resource; `None` for a resource
    /// of our own.
    lent: Vec<Option<[ResourceState; 2]>>,
    /// Objects of resources in whose place the host bound one, by resource: an output of our own, and its state.
    own: Vec<Option<(Object, ResourceState)>>,
    /// Whether an image of the host was bound before a resize, and nothing since, by resource.
    lost: Vec<bool>,
}

impl Storages {
    pub(crate) fn new(declaration: &Declaration, stay_in_general: bool) -> Self {
        let count = declaration.resources().len();
        let mut tracker = Tracker::new(declaration);
        tracker.stay_in_general = stay_in_general;
        Self {
            objects: Objects(vec![[None, None]; count]),
            tracker,
            lent: vec![None; count],
            own: vec![None; count],
            lost: vec![false; count],
        }
    }

    /// Takes over the bindings of a host from before a resize: buffers, whose sizes do not depend on the extent. Images are lost.
    pub(crate) fn take_over(&mut self, before: &Self) {
        for (index, &lent) in before.lent.iter().enumerate() {
            let id = ResourceId(index as u32);
            match (lent, before.object(id, 0)) {
                (Some(states), Some(&object @ Object::Buffer { .. })) => self.bind(id, object, states),
                (lent, _) => self.lost[index] = lent.is_some() || before.lost[index],
            }
        }
    }

    /// Whether the host has to bind a resource again, or to unbind it, after a resize.
    pub(crate) fn is_lost(&self, id: ResourceId) -> bool {
        self.lost[id.0 as usize]
    }

    /// Whether an object is the host's.
    pub(crate) fn is_lent(&self, id: ResourceId) -> bool {
        self.lent[id.0 as usize].is_some()
    }

    /// Stores an object of our own, with undefined content.
    pub(crate) fn set(&mut self, id: ResourceId, copy: usize, object: Object) {
        self.objects.0[id.0 as usize][copy] = Some(object);
    }

    /// Notes transients that overlap in memory: `offsets` is where each span was placed.
    pub(crate) fn share(&mut self, ids: &[ResourceId], spans: &[Span], offsets: &[u64]) {
        let overlaps = |i: usize, j: usize| offsets[i] < offsets[j] + spans[j].size && offsets[j] < offsets[i] + spans[i].size;
        for i in 0..ids.len() {
            (0..i).filter(|&j| overlaps(i, j)).for_each(|j| self.tracker.alias(ids[i], ids[j]));
        }
    }

    pub(crate) fn object(&self, id: ResourceId, copy: usize) -> Option<&Object> {
        self.objects.get(id, copy)
    }

    pub(crate) fn state(&self, id: ResourceId, copy: usize) -> ResourceState {
        self.tracker.state(id, copy).unwrap_or(ResourceState::UNDEFINED)
    }

    /// The tracker, and the objects that its barriers are for.
    pub(crate) fn split(&mut self) -> (&mut Tracker, &Objects) {
        (&mut self.tracker, &self.objects)
    }

    /// Binds an object of the host, in the state that each phase finds and the one that it leaves.
    pub(crate) fn bind(&mut self, id: ResourceId, object: Object, states: [ResourceState; 2]) {
        let (index, state) = (id.0 as usize, self.state(id, 0));
        self.lost[index] = false;
        let slot = &mut self.objects.0[index][0];
        if self.lent[index].is_none() {
            self.own[index] = slot.map(|own| (own, state));
        }
        (*slot, self.lent[index]) = (Some(object), Some(states));
        self.tracker.share(id, states[0], states[1]);
    }

    pub(crate) fn unbind(&mut self, id: ResourceId) {
        let index = id.0 as usize;
        self.lost[index] = false;
        if self.lent[index].take().is_none() {
            return;
        }
        let own = self.own[index].take();
        self.objects.0[index][0] = own.map(|(object, _)| object);
        match own {
            Some((_, state)) => self.tracker.set_state(id, 0, state),
            None => self.tracker.leave_out(id),
        }
    }

    /// Forgets recorded work that will never run.
    pub(crate) fn forget(&mut self) {
        self.tracker.forget();
        self.own.iter_mut().flatten().for_each(|(_, state)| *state = ResourceState::UNKNOWN);
    }

    /// The bindings of a pass, behind its barriers.
    pub(crate) fn bindings(&self, pass: usize, frame: &FrameContext, bindings: &mut Vec<Binding>) {
        self.tracker.bindings(pass, frame, |id, copy| self.objects.physical(id, copy), bindings);
    }
}
