//! One dispatch of a node: its shader with images on the shader's bindings, by their GLSL names.

use super::matching::{self, Automatic};
use super::{Graph, Image};
use crate::contract::{Access, Grid, Lifetime, PassDecl, Phase, Shape, Use, UseFrame, Work};

use crate::reference::Twin;
use crate::shaders::ShaderRef;

/// Source of a number of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum Value {
    /// The field of [`crate::Tuning`] that has the name of the parameter: it may change from frame to frame.
    #[default]
    Own,
    /// Another field of [`crate::Tuning`], by name.
    Tunable(&'static str),
    /// A fixed number, in every frame.
    Fixed(f32),
}

/// A copy of an image, for a binding.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Wire {
    pub image: Image,
    pub frame: UseFrame,
}

/// Source of the push constant `level`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Level {
    /// No such push constant.
    None,
    /// A fixed level.
    Number(u32),
    /// The view of the frame.
    View,
}

/// One dispatch that is being described.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    pub node: String,
    pub name: String,
    pub phase: Phase,
    pub shader: ShaderRef,
    pub level: Level,
    pub grid: Grid,
    pub constants: Vec<(String, u32)>,
    pub parameters: Vec<(String, Value)>,
    pub wires: Vec<(String, Wire)>,
    /// The function of a host's stage for the CPU.
    pub twin: Option<Twin>,
}

impl Pass {
    /// A dispatch of one invocation a pixel, after lighting.
    pub fn new(node: &str, shader: impl Into<ShaderRef>) -> Self {
        Self {
            node: node.to_owned(),
            name: node.to_owned(),
            phase: Phase::AfterLighting,
            shader: shader.into(),
            level: Level::None,
            grid: Grid::Pixels,
            constants: Vec::new(),
            parameters: Vec::new(),
            wires: Vec::new(),
            twin: None,
        }
    }

    /// A name of its own, for one of several passes of a node.
    pub fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    pub fn phase(self, phase: Phase) -> Self {
        Self { phase, ..self }
    }

    /// The push constant `level`.
    pub fn level(self, level: u32) -> Self {
        Self { level: Level::Number(level), ..self }
    }

    /// The view of the frame as the push constant `level`. A frame without a view leaves the pass out.
    pub fn view(self) -> Self {
        Self { level: Level::View, ..self }
    }

    pub fn grid(self, grid: Grid) -> Self {
        Self { grid, ..self }
    }

    /// A specialisation constant.
    pub fn constant(mut self, name: &str, value: u32) -> Self {
        self.constants.push((name.to_owned(), value));
        self
    }

    /// Sets the source of a member of the push constants, where it is not the tunable of its name.
    pub fn value(mut self, member: &str, value: Value) -> Self {
        if value != Value::Own {
            self.parameters.push((member.to_owned(), value));
        }
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

    /// Binds the content that an image had one frame ago.
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
        let constants = self.buffer("frame_constants", size_of::<crate::FrameConstants>() as u64, Lifetime::Transient);
        let statistics = self.buffer("statistics", STATISTICS_COUNT * 4, Lifetime::Output);
        let uses = [constants, statistics].map(|resource| Use { resource, frame: UseFrame::Current, access: Access::Clear });
        self.push_pass(
            "start_frame",
            PassDecl { name: "start_frame".to_owned(), phase: Phase::BeforeLighting, uses: uses.to_vec(), work: Work::StartFrame },
        );
        (self.constants, self.statistics) = (constants, statistics);
    }

    /// Fills an image of unsigned integers with zeros.
    pub(crate) fn clear(&mut self, node: &str, name: String, phase: Phase, image: Image) {
        let uses = vec![Use { resource: image.id, frame: UseFrame::Current, access: Access::Clear }];
        self.push_pass(node, PassDecl { name, phase, uses, work: Work::Clear });
    }

    /// Adds a dispatch: matches its images with the bindings of the shader.
    pub(crate) fn add(&mut self, pass: Pass) {
        for (binding, wire) in &pass.wires {
            if let Some(problem) = self.refusal(wire) {
                return self.fail(&pass.node, binding, problem);
            }
            let resource = &mut self.resources[wire.image.id.0 as usize];
            if wire.frame == UseFrame::Previous && resource.lifetime == Lifetime::Transient {
                resource.lifetime = Lifetime::History;
            }
        }
        let of_name = self.passes.iter().filter_map(|p| p.shader()).find(|shader| shader.name == pass.shader.name);
        if of_name.is_some_and(|other| *other != *pass.shader) {
            // Pipelines, and code that is replaced, are found by this name.
            let problem = format!("another shader is called `{}` as well; give one of them another name", pass.shader.name);
            return self.fail(&pass.node, "shader", problem);
        }
        let automatic = Automatic { frame: self.current(self.constants), statistics: self.current(self.statistics) };
        match matching::declare(&pass, &automatic, &self.resources) {
            Ok(declared) => {
                if let Some((binding, problem)) = pass.wires.iter().find_map(|(binding, wire)| self.stale(binding, wire, &declared))
                {
                    return self.fail(&pass.node, &binding, problem);
                }
                self.push_pass(&pass.node, declared);
            }
            Err(matching::Mismatch { port, problem }) => self.fail(&pass.node, &port, problem),
        }
    }

    /// The reason why an image cannot be wired, whatever the shader does with it.
    fn refusal(&self, wire: &Wire) -> Option<String> {
        match wire.image {
            Image::NONE => {
                Some("there is no such image; the stage that was asked for it writes no binding of that name".to_owned())
            }
            image => {
                (image.graph != self.key).then(|| "the image belongs to another graph; build both parts in one graph".to_owned())
            }
        }
    }

    /// The binding whose image has other content than when the value was made, and the reason.
    fn stale(&self, binding: &str, wire: &Wire, pass: &PassDecl) -> Option<(String, String)> {
        let reads = pass.use_of(binding).is_some_and(|u| u.access.reads());
        let id = wire.image.id;
        if wire.frame == UseFrame::Previous || !reads || wire.image.version == self.states[id.0 as usize].version {
            return None;
        }
        let writes = |p: &&PassDecl| p.uses.iter().any(|u| u.resource == id && u.access.writes());
        let writer = self.passes.iter().zip(&self.owners).rev().find(|(p, _)| writes(p)).map_or("a later node", |(_, node)| node);
        let name = &self.resources[id.0 as usize].name;
        Some((binding.to_owned(), format!("`{name}` was overwritten by `{writer}`; take what that node returned")))
    }

    fn push_pass(&mut self, node: &str, pass: PassDecl) {
        for u in &pass.uses {
            let resource = &mut self.resources[u.resource.0 as usize];
            match resource.shape {
                Shape::Image { .. } => resource.image_usage |= u.access.image_usage(),
                Shape::Buffer { .. } => resource.buffer_usage |= u.access.buffer_usage(),
            }
            if u.access.writes() {
                self.states[u.resource.0 as usize].version += 1;
            }
        }
        self.passes.push(pass);
        self.owners.push(node.to_owned());
    }
}
