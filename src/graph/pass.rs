//! One dispatch of a node: its shader with images on the shader's bindings, by their GLSL names.

use super::{Graph, Image};
use crate::contract::{Access, Dispatch, Grid, Lifetime, Member, PassDecl, Phase, ResourceId, Shape, Use, UseFrame, Work};
use crate::shaders::{BindingKind, ShaderBinding, ShaderRef};
use crate::Tuning;

/// Where a number of a node comes from.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Value {
    /// The field of [`Tuning`] that has the name of the parameter: it may change from frame to frame.
    #[default]
    Own,
    /// Another field of [`Tuning`], by name.
    Tunable(&'static str),
    /// This number in every frame.
    Fixed(f32),
}

/// An image on a binding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Wire {
    image: Image,
    frame: UseFrame,
}

/// One dispatch that is being described.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    pub node: String,
    pub name: String,
    pub phase: Phase,
    pub shader: ShaderRef,
    pub level: u32,
    pub grid: Grid,
    pub constants: Vec<(String, u32)>,
    pub values: Vec<(String, Value)>,
    pub wires: Vec<(String, Wire)>,
}

impl Pass {
    /// A dispatch of one invocation a pixel, after lighting.
    pub fn new(node: &str, shader: impl Into<ShaderRef>) -> Self {
        Self {
            node: node.to_owned(),
            name: node.to_owned(),
            phase: Phase::AfterLighting,
            shader: shader.into(),
            level: 0,
            grid: Grid::Pixels,
            constants: Vec::new(),
            values: Vec::new(),
            wires: Vec::new(),
        }
    }

    /// A name of its own, for one of several passes of a node.
    pub fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    pub fn phase(self, phase: Phase) -> Self {
        Self { phase, ..self }
    }

    pub fn level(self, level: u32) -> Self {
        Self { level, ..self }
    }

    pub fn grid(self, grid: Grid) -> Self {
        Self { grid, ..self }
    }

    /// A specialisation constant.
    pub fn constant(mut self, name: &str, value: u32) -> Self {
        self.constants.push((name.to_owned(), value));
        self
    }

    /// Where a member of the push constants comes from, where it is not the tunable of its name.
    pub fn value(mut self, member: &str, value: Value) -> Self {
        self.values.push((member.to_owned(), value));
        self
    }

    /// An image of this frame, read or written as the shader says.
    pub fn bind(mut self, binding: &str, image: Image) -> Self {
        self.wires.push((binding.to_owned(), Wire { image, frame: UseFrame::Current }));
        self
    }

    /// An image of this frame, where there is one.
    pub fn bind_some(self, binding: &str, image: Option<Image>) -> Self {
        match image {
            Some(image) => self.bind(binding, image),
            None => self,
        }
    }

    /// What the image held one frame ago.
    pub fn previous(mut self, binding: &str, image: Image) -> Self {
        self.wires.push((binding.to_owned(), Wire { image, frame: UseFrame::Previous }));
        self
    }

    /// One image for each signal, on the bindings `name_0` and `name_1`.
    pub fn each(self, binding: &str, images: &[Image]) -> Self {
        images.iter().enumerate().fold(self, |pass, (i, image)| pass.bind(&format!("{binding}_{i}"), *image))
    }

    /// The previous image for each signal, on the bindings `name_0` and `name_1`.
    pub fn each_previous(self, binding: &str, images: &[Image]) -> Self {
        images.iter().enumerate().fold(self, |pass, (i, image)| pass.previous(&format!("{binding}_{i}"), *image))
    }
}

impl Graph {
    /// The name of an instance of a node, which is in the graph once.
    pub(crate) fn node(&mut self, base: &str, label: &str) -> String {
        let name = self.scoped(base, label);
        if !self.nodes.insert(name.clone()) {
            let problem = "it is in the graph already for the same signal; put the second one into a `Graph::scope`, or give its signal a name of its own";
            self.fail(&name, "name", problem.to_owned());
        }
        name
    }

    /// The first pass of every graph. By `vkCmdUpdateBuffer`, so that no host-visible memory and no copy per slot is needed.
    pub(super) fn start_frame(&mut self) {
        use crate::contract::STATISTICS_COUNT;
        self.constants = self.buffer("frame_constants", size_of::<crate::FrameConstants>() as u64, Lifetime::Transient);
        self.statistics = self.buffer("statistics", STATISTICS_COUNT * 4, Lifetime::Output);
        let uses = [self.constants, self.statistics]
            .map(|resource| Use { resource, frame: UseFrame::Current, access: Access::Clear })
            .to_vec();
        self.push_pass("start_frame", "start_frame".to_owned(), Phase::BeforeLighting, uses, Work::StartFrame);
    }

    /// Fills an image of unsigned integers with zeros.
    pub(crate) fn clear(&mut self, node: &str, name: String, phase: Phase, image: Image) {
        let uses = vec![Use { resource: image.id, frame: UseFrame::Current, access: Access::Clear }];
        self.push_pass(node, name, phase, uses, Work::Clear);
    }

    /// Adds a dispatch: matches its images with the bindings of the shader.
    pub(crate) fn add(&mut self, pass: Pass) {
        if let Some((uses, dispatch)) = self.resolve(&pass) {
            self.push_pass(&pass.node, pass.name, pass.phase, uses, Work::Dispatch(Box::new(dispatch)));
        }
    }

    fn push_pass(&mut self, node: &str, name: String, phase: Phase, uses: Vec<Use>, work: Work) {
        for u in &uses {
            let resource = &mut self.resources[u.resource.0 as usize];
            match resource.shape {
                Shape::Image { .. } => resource.image_usage |= u.access.image_usage(),
                Shape::Buffer { .. } => resource.buffer_usage |= u.access.buffer_usage(),
            }
            if u.frame == UseFrame::Previous && resource.lifetime == Lifetime::Transient {
                resource.lifetime = Lifetime::History;
            }
            if u.access.writes() {
                self.states[u.resource.0 as usize].version += 1;
            }
        }
        self.passes.push(PassDecl { name, phase, uses, work });
        self.owners.push(node.to_owned());
    }
}
