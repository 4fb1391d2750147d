//! A stage of your own: your compute shader as a pass between ours.

use super::{Graph, Image, Pass, Value};
use crate::contract::{Grid, Lifetime, Phase, UseFrame};
use crate::error::Error;
use crate::reference::{CpuStage, Twin};
use crate::shaders::{vk_format, BindingAccess, BindingKind, Shader, ShaderRef};
use crate::ImageFormat;
use std::collections::BTreeMap;
use std::sync::Arc;

/// A compute shader of yours that runs as a stage.
///
/// The graph reads its interface from the SPIR-V: bindings of descriptor set 0 with their names,
/// push constants, specialisation constants, workgroup size. A uniform block called `frame` is
/// bound to the frame's constants (`glsl/include/frame.glsl`), a storage buffer called `statistics`
/// to the counters. Members of the push constants called `level` and `present`, and those with the
/// name of a tunable, are filled by the recorder. One invocation is dispatched for each pixel of
/// the render extent.
#[derive(Clone, Debug)]
pub struct Stage {
    shader: Arc<Shader>,
    twin: Option<Twin>,
}

impl Stage {
    /// Reads a module. Compile it for Vulkan 1.1 (SPIR-V 1.3) and keep the names (no stripping), since bindings are matched by
    /// name.
    ///
    /// # Errors
    /// [`Error::Stage`] if the module is no compute shader, has a binding without a name or of a
    /// kind that passes cannot have, numbers bindings with a gap or outside set 0, or has more than
    /// 128 bytes of push constants.
    pub fn new(name: &str, spirv: &[u32]) -> Result<Self, Error> {
        let failed = |problem: String| Error::Stage { stage: name.to_owned(), problem };
        let code = spirv.iter().flat_map(|word| word.to_ne_bytes()).collect();
        let shader = atrous_shader::reflect(name, name, code, spirv, &[]).map_err(failed)?;
        Ok(Self { shader: Arc::new(shader), twin: None })
    }

    /// A function that computes the same on the CPU, for [`crate::reference::Engine`] and for the comparison of both.
    pub fn with_twin(self, twin: Twin) -> Self {
        Self { twin: Some(twin), ..self }
    }
}

/// A stage of yours that is being put into a graph; [`StageCall::add`] ends it.
#[derive(Debug)]
#[must_use = "a stage is in the graph when `add` was called"]
pub struct StageCall<'g> {
    graph: &'g mut Graph,
    shader: Arc<Shader>,
    pass: Pass,
    divisor: u32,
}

/// Images that a stage wrote, by the names of its bindings.
#[derive(Clone, Debug)]
pub struct StageOutputs {
    images: BTreeMap<String, Image>,
}

impl StageOutputs {
    /// The image that was written through a binding; `None` where the stage has no such binding that it writes.
    pub fn image(&self, binding: &str) -> Option<Image> {
        self.images.get(binding).copied()
    }

    /// The image that was written through a binding. For any other name it is an image of no graph, which [`Graph::finish`] refuses
    /// where it is read.
    pub fn written(&self, binding: &str) -> Image {
        self.image(binding).unwrap_or(Image::NONE)
    }
}

impl Graph {
    /// Begins a stage of yours. Name each image by its binding in the shader.
    pub fn stage(&mut self, stage: &Stage) -> StageCall<'_> {
        let node = self.node(&stage.shader.name, "");
        let shader = stage.shader.clone();
        let pass = Pass { cpu: stage.twin.map(CpuStage::of_host), ..Pass::new(&node, ShaderRef::Made(shader.clone())) };
        StageCall { graph: self, shader, pass, divisor: 1 }
    }
}

impl StageCall<'_> {
    /// An image of this frame: read, or read and written in place, as the shader says.
    pub fn bind(mut self, binding: &str, image: Image) -> Self {
        self.pass = self.pass.bind(binding, image);
        self
    }

    /// Binds the content that an image had one frame ago. The image has two copies then.
    pub fn previous(mut self, binding: &str, image: Image) -> Self {
        self.pass = self.pass.previous(binding, image);
        self
    }

    /// An image of yours: an input of any float format under this name.
    pub fn input(self, binding: &str, name: &str) -> Self {
        let image = self.graph.host_colour(name);
        self.bind(binding, image)
    }

    /// The phase of the frame. Default: [`Phase::AfterLighting`].
    pub fn phase(mut self, phase: Phase) -> Self {
        self.pass = self.pass.phase(phase);
        self
    }

    /// The member `level` of the push constants. Default: 0.
    pub fn level(mut self, level: u32) -> Self {
        self.pass = self.pass.level(level);
        self
    }

    /// A specialisation constant, by name.
    pub fn constant(mut self, name: &str, value: u32) -> Self {
        self.pass = self.pass.constant(name, value);
        self
    }

    /// A member of the push constants, by name.
    pub fn value(mut self, member: &str, value: Value) -> Self {
        self.pass = self.pass.value(member, value);
        self
    }

    /// One invocation, and one texel of each image that is made, for every `size` × `size` pixels. Default: 1.
    pub fn per_block(mut self, size: u32) -> Self {
        self.divisor = size.max(1);
        self
    }

    /// Adds the stage. Every storage image that it writes and that you did not bind becomes a
    /// transient, of the format in the shader.
    pub fn add(mut self) -> StageOutputs {
        let mut images = BTreeMap::new();
        for binding in self.shader.bindings.iter() {
            let BindingKind::StorageImage(texel, access) = binding.kind else { continue };
            if access == BindingAccess::ReadOnly {
                continue;
            }
            let wired = self.pass.wires.iter().find(|(name, wire)| **name == *binding.name && wire.frame == UseFrame::Current);
            let image = match wired {
                Some((_, wire)) => wire.image,
                None => {
                    let base = format!("{}_{}", self.shader.name, binding.name);
                    let format = ImageFormat::Exactly(vk_format(texel));
                    let image = self.graph.named_image(&base, "", format, self.divisor, Lifetime::Transient);
                    self.pass = self.pass.bind(&binding.name, image);
                    image
                }
            };
            images.insert(binding.name.to_string(), image);
        }
        let pass = if self.divisor > 1 { self.pass.grid(Grid::Strata(self.divisor)) } else { self.pass };
        self.graph.add(pass);
        for image in images.values_mut() {
            *image = self.graph.refreshed(*image);
        }
        StageOutputs { images }
    }
}
