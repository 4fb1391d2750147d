//! What the passes of a frame read and wrote, to give it to their twins.

use ::atrous::config::{Preset, Signals};
use ::atrous::executor::Session;
use ::atrous::reference::{Image, BLOCK_SIZE};
use ::atrous::{Access, Config, Error, FrameContext, Shape, Tuning, UseFrame};
use half::f16;
use std::collections::BTreeMap;

/// Texels by name and copy.
pub type Resources = BTreeMap<(String, UseFrame), Vec<u8>>;

/// What one pass was given and what it wrote.
pub struct Captured<'a> {
    pub frame: &'a FrameContext,
    pub config: &'a Config,
    pub tuning: &'a Tuning,
    pub inputs: Resources,
    pub outputs: BTreeMap<String, Vec<u8>>,
}

impl Captured<'_> {
    pub(super) fn bytes(&self, name: &str, frame: UseFrame) -> &[u8] {
        self.inputs.get(&(name.to_owned(), frame)).unwrap_or_else(|| panic!("{name} {frame:?} was not captured"))
    }

    pub(super) fn image<T: Clone + Default + bytemuck::Pod>(&self, bytes: &[u8]) -> Image<T> {
        image_of(bytes, self.config.allocated_extent)
    }

    fn block_image<T: Clone + Default + bytemuck::Pod>(&self, bytes: &[u8]) -> Image<T> {
        let extent = self.config.allocated_extent.map(|side| side.div_ceil(BLOCK_SIZE));
        Image::from_texels(extent, bytemuck::allocation::pod_collect_to_vec(bytes)).expect("extent")
    }

    pub fn block_uints(&self, name: &str) -> Image<u32> {
        self.block_image(self.bytes(name, UseFrame::Current))
    }

    pub fn block_packed(&self, name: &str) -> Image<[u16; 4]> {
        self.block_image(self.bytes(name, UseFrame::Current))
    }

    pub fn written_blocks<T: Clone + Default + bytemuck::Pod>(&self, name: &str) -> Image<T> {
        self.block_image(&self.outputs[name])
    }

    pub fn has(&self, name: &str) -> bool {
        self.inputs.contains_key(&(name.to_owned(), UseFrame::Current))
    }

    /// A host's image, which a session keeps as four floats.
    pub fn host(&self, name: &str) -> Image<[f32; 4]> {
        self.image(self.bytes(name, UseFrame::Current))
    }

    pub fn optional_host(&self, name: &str) -> Option<Image<[f32; 4]>> {
        self.has(name).then(|| self.host(name))
    }

    pub fn optional_buffer(&self, name: &str) -> Option<&[u8]> {
        self.inputs.get(&(name.to_owned(), UseFrame::Current)).map(Vec::as_slice)
    }

    pub fn uints(&self, name: &str, frame: UseFrame) -> Image<u32> {
        self.image(self.bytes(name, frame))
    }

    pub fn packed(&self, name: &str, frame: UseFrame) -> Image<[u16; 4]> {
        self.image(self.bytes(name, frame))
    }

    pub fn halves(&self, name: &str, frame: UseFrame) -> Image<[f32; 4]> {
        self.packed(name, frame).map(|t| t.map(|b| f16::from_bits(b).to_f32()))
    }

    pub fn written_uints(&self, name: &str) -> Image<u32> {
        self.image(&self.outputs[name])
    }

    pub fn written_packed(&self, name: &str) -> Image<[u16; 4]> {
        self.image(&self.outputs[name])
    }

    pub fn written_halves(&self, name: &str) -> Image<[f32; 4]> {
        self.written_packed(name).map(|t| t.map(|b| f16::from_bits(b).to_f32()))
    }

    /// The suffixes of the signals' resources.
    pub fn suffixes(&self) -> &'static [&'static str] {
        match self.config.signals {
            _ if self.config.preset == Preset::Stabilize => &[""],
            Signals::Apart => &["_direct", "_indirect"],
            _ => &[""],
        }
    }

    pub fn signals(&self, name: &str, frame: UseFrame) -> Vec<Image<[f32; 4]>> {
        self.suffixes().iter().map(|s| self.halves(&format!("{name}{s}"), frame)).collect()
    }

    pub fn packed_signals(&self, name: &str, frame: UseFrame) -> Vec<Image<[u16; 4]>> {
        self.suffixes().iter().map(|s| self.packed(&format!("{name}{s}"), frame)).collect()
    }
}

pub fn image_of<T: Clone + Default + bytemuck::Pod>(bytes: &[u8], extent: [u32; 2]) -> Image<T> {
    Image::from_texels(extent, bytemuck::allocation::pod_collect_to_vec(bytes)).expect("extent")
}

/// What a pass touches, of the accesses that are wanted.
pub fn capture(s: &mut Session, pass: usize, want: fn(Access) -> bool) -> Result<Resources, Error> {
    let declaration = s.executor().denoiser().declaration().clone();
    let mut captured = BTreeMap::new();
    for u in declaration.passes()[pass].uses.iter().filter(|u| want(u.access)) {
        let resource = declaration.resource(u.resource);
        if matches!(resource.shape, Shape::Image { .. }) || ["instance_transforms", "statistics"].contains(&resource.name.as_str())
        {
            // An optional input that nothing is bound to has no bytes.
            if let Ok(bytes) = s.download_bytes(&resource.name, u.frame) {
                captured.insert((resource.name.clone(), u.frame), bytes);
            }
        }
    }
    Ok(captured)
}
