//! Physical images and buffers: what was last done to each, and which share memory. Knows no device.

use super::scope::Scope;
use super::HostImage;
use crate::binding::Binding;
use crate::contract::{component_of, Access, Component, Declaration, ResourceId, Span};
use crate::error::Error;
use ash::vk;
use atrous_texel::Texel;

/// A physical image with its view.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct StoredImage {
    pub image: vk::Image,
    pub view: vk::ImageView,
    pub format: vk::Format,
    pub extent: [u32; 2],
}

impl StoredImage {
    /// Whether texels are unsigned integers.
    pub fn is_uint(&self) -> bool {
        component_of(self.format) == Some(Component::Uint)
    }

    /// Every aspect: barriers name all of them.
    pub fn aspects(&self) -> vk::ImageAspectFlags {
        Texel::of(self.format).map_or(vk::ImageAspectFlags::COLOR, |texel| texel.aspects())
    }

    /// Bytes of a texel in a copy of the image of this resource.
    pub fn texel_bytes(&self, resource: &str) -> Result<u64, Error> {
        let texel = Texel::of(self.format).ok_or_else(|| {
            let allowed = format!("for a copy {}", atrous_texel::ACCEPTED);
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

/// A physical image or buffer with what was last done to it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Storage {
    pub object: Object,
    pub scope: Scope,
    /// State that a host's image or buffer is brought back to; `None` for our own.
    pub home: Option<Scope>,
    /// Whether a barrier changed its state since it was handed back.
    pub touched: bool,
}

impl Storage {
    /// An image or buffer of our own, with undefined content.
    pub fn own(object: Object) -> Self {
        Self { object, scope: Scope::NONE, home: None, touched: false }
    }

    pub fn of_host_image(host: &HostImage) -> Self {
        let &HostImage { image, view, format, extent, stage, access, layout } = host;
        Self::of_host(Object::Image(StoredImage { image, view, format, extent }), Scope { stage, access, layout })
    }

    pub fn of_host_buffer(buffer: vk::Buffer, size: u64, home: Scope) -> Self {
        Self::of_host(Object::Buffer { buffer, size }, home)
    }

    fn of_host(object: Object, home: Scope) -> Self {
        Self { object, scope: home, home: Some(home), touched: false }
    }

    /// The image, where it is one.
    pub fn image(&self) -> Option<&StoredImage> {
        match &self.object {
            Object::Image(image) => Some(image),
            Object::Buffer { .. } => None,
        }
    }
}

/// Every physical image and buffer of a declaration.
pub(crate) struct Storages {
    /// Storages by resource, then copy.
    storages: Vec<[Option<Storage>; 2]>,
    /// Storages of resources to which nothing of the host is bound, by resource: an output of our own, or nothing.
    own: Vec<Option<Storage>>,
    /// Whether an image of the host was bound before a resize, and nothing since, by resource.
    lost: Vec<bool>,
    /// Transients that share memory with a resource, by resource.
    aliases: Vec<Vec<ResourceId>>,
    /// The pass that a transient starts in, by resource.
    first_pass: Vec<Option<usize>>,
}

impl Storages {
    pub fn new(declaration: &Declaration) -> Self {
        let count = declaration.resources().len();
        let mut first_pass = vec![None; count];
        for (id, first, _) in declaration.transients() {
            first_pass[id.0 as usize] = Some(first);
        }
        Self {
            storages: vec![[None, None]; count],
            own: vec![None; count],
            lost: vec![false; count],
            aliases: vec![Vec::new(); count],
            first_pass,
        }
    }

    /// Takes over the bindings of a host from before a resize: buffers, whose sizes do not depend on the extent. Images are lost.
    pub fn take_over(&mut self, before: &Self) {
        for (index, [bound, _]) in before.storages.iter().enumerate() {
            match bound.filter(|storage| storage.home.is_some()) {
                Some(storage) if storage.image().is_none() => self.bind(ResourceId(index as u32), storage),
                bound => self.lost[index] = bound.is_some() || before.lost[index],
            }
        }
    }

    /// Whether the host has to bind a resource again, or to unbind it, after a resize.
    pub fn is_lost(&self, id: ResourceId) -> bool {
        self.lost[id.0 as usize]
    }

    /// Stores an object of our own.
    pub fn set(&mut self, id: ResourceId, copy: usize, storage: Storage) {
        self.storages[id.0 as usize][copy] = Some(storage);
        if copy == 0 {
            self.own[id.0 as usize] = Some(storage);
        }
    }

    /// Notes transients that overlap in memory: `offsets` is where each span was placed.
    pub fn share(&mut self, ids: &[ResourceId], spans: &[Span], offsets: &[u64]) {
        let shares =
            |i: usize, j: usize| i != j && offsets[i] < offsets[j] + spans[j].size && offsets[j] < offsets[i] + spans[i].size;
        for i in 0..ids.len() {
            self.aliases[ids[i].0 as usize] = (0..ids.len()).filter(|&j| shares(i, j)).map(|j| ids[j]).collect();
        }
    }

    pub fn storage(&self, id: ResourceId, copy: usize) -> Option<&Storage> {
        self.storages.get(id.0 as usize)?.get(copy)?.as_ref()
    }

    pub fn storage_mut(&mut self, id: ResourceId, copy: usize) -> Option<&mut Storage> {
        self.storages.get_mut(id.0 as usize)?.get_mut(copy)?.as_mut()
    }

    pub fn bind(&mut self, id: ResourceId, storage: Storage) {
        self.lost[id.0 as usize] = false;
        let slot = &mut self.storages[id.0 as usize][0];
        if let Some(own) = slot.filter(|s| s.home.is_none()) {
            self.own[id.0 as usize] = Some(own);
        }
        *slot = Some(storage);
    }

    pub fn unbind(&mut self, id: ResourceId) {
        self.lost[id.0 as usize] = false;
        self.storages[id.0 as usize][0] = self.own[id.0 as usize];
    }

    pub fn binding(&self, id: ResourceId, copy: usize, access: Access) -> Binding {
        let Some(storage) = self.storage(id, copy) else { return Binding::Absent };
        let layout = storage.scope.layout;
        match storage.object {
            Object::Image(StoredImage { image, .. }) if access == Access::Clear => Binding::ClearedImage { image, layout },
            Object::Image(StoredImage { view, .. }) => Binding::Image { view, layout },
            Object::Buffer { buffer, .. } => Binding::Buffer { buffer, offset: 0, range: vk::WHOLE_SIZE },
        }
    }

    pub fn touched_host_storages(&mut self) -> impl Iterator<Item = &mut Storage> {
        self.storages
            .iter_mut()
            .flatten()
            .flatten()
            .filter_map(|s| (s.home.is_some() && std::mem::take(&mut s.touched)).then_some(s))
    }

    /// Whether a pass is the first of a frame that uses a transient.
    pub fn starts_transient(&self, id: ResourceId, pass: usize) -> bool {
        self.first_pass[id.0 as usize] == Some(pass)
    }

    /// The last access to the memory of a transient through those that share it; `None` where it has its memory alone.
    pub fn scope_of_aliases(&self, id: ResourceId) -> Option<Scope> {
        let aliases = Some(&self.aliases[id.0 as usize]).filter(|a| !a.is_empty())?;
        let mut scope = Scope::NONE;
        for other in aliases {
            if let Some(other) = self.storage(*other, 0) {
                scope.stage |= other.scope.stage;
                scope.access |= other.scope.access;
            }
        }
        Some(scope)
    }
}
