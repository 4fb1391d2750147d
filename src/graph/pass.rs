//! One dispatch of a node: its shader with images on the shader's bindings, by their GLSL names.

use super::Image;
use crate::contract::{Grid, Phase, UseFrame};
use crate::reference::CpuStage;
use crate::shaders::ShaderRef;

/// Source of a number of a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub enum Value {
    /// The field of [`crate::Tuning`] with the name of the parameter. It may change from frame to
    /// frame.
    #[default]
    Own,
    /// A different field of [`crate::Tuning`], by name.
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

/// One dispatch that is being described.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    pub node: String,
    pub name: String,
    pub phase: Phase,
    pub shader: ShaderRef,
    /// The push constant `level`.
    pub level: Option<u32>,
    /// Whether the push constant `view` is the view of the frame. A frame without a view leaves the pass out.
    pub shows_view: bool,
    pub grid: Grid,
    pub constants: Vec<(String, u32)>,
    pub parameters: Vec<(String, Value)>,
    pub wires: Vec<(String, Wire)>,
    /// The stage on the CPU.
    pub cpu: Option<CpuStage>,
}

impl Pass {
    /// A dispatch of one invocation per pixel, after lighting.
    pub(crate) fn new(node: &str, shader: impl Into<ShaderRef>) -> Self {
        Self {
            node: node.to_owned(),
            name: node.to_owned(),
            phase: Phase::AfterLighting,
            shader: shader.into(),
            level: None,
            shows_view: false,
            grid: Grid::Pixels,
            constants: Vec::new(),
            parameters: Vec::new(),
            wires: Vec::new(),
            cpu: None,
        }
    }

    /// A name of its own, for one of several passes of a node.
    pub(crate) fn named(self, name: String) -> Self {
        Self { name, ..self }
    }

    pub(crate) fn phase(self, phase: Phase) -> Self {
        Self { phase, ..self }
    }

    /// The push constant `level`.
    pub(crate) fn level(self, level: u32) -> Self {
        Self { level: Some(level), ..self }
    }

    /// The view of the frame as the push constant `view`. A frame without a view leaves the pass out.
    pub(crate) fn view(self) -> Self {
        Self { shows_view: true, ..self }
    }

    pub(crate) fn grid(self, grid: Grid) -> Self {
        Self { grid, ..self }
    }

    /// A specialisation constant.
    pub(crate) fn constant(mut self, name: &str, value: u32) -> Self {
        self.constants.push((name.to_owned(), value));
        self
    }

    /// The constant `LIGHTS` of a shader of several lights.
    pub(crate) fn lights(self, lights: u32) -> Self {
        match lights {
            1 => self,
            _ => self.constant("LIGHTS", lights),
        }
    }

    /// Sets the source of a member of the push constants, where it is not the tunable of its name.
    pub(crate) fn value(mut self, member: &str, value: Value) -> Self {
        if value != Value::Own {
            self.parameters.push((member.to_owned(), value));
        }
        self
    }

    /// An image of this frame, read or written as the shader says.
    pub(crate) fn bind(mut self, binding: &str, image: Image) -> Self {
        self.wires.push((binding.to_owned(), Wire { image, frame: UseFrame::Current }));
        self
    }

    /// An image of this frame, where there is one.
    pub(crate) fn bind_some(self, binding: &str, image: Option<Image>) -> Self {
        match image {
            Some(image) => self.bind(binding, image),
            None => self,
        }
    }

    /// Binds the content that an image had one frame ago.
    pub(crate) fn previous(mut self, binding: &str, image: Image) -> Self {
        self.wires.push((binding.to_owned(), Wire { image, frame: UseFrame::Previous }));
        self
    }

    /// One image for each signal, on the bindings `name_0` and `name_1`.
    pub(crate) fn each(self, binding: &str, images: &[Image]) -> Self {
        images.iter().enumerate().fold(self, |pass, (i, image)| pass.bind(&format!("{binding}_{i}"), *image))
    }

    /// The previous image for each signal, on the bindings `name_0` and `name_1`.
    pub(crate) fn each_previous(self, binding: &str, images: &[Image]) -> Self {
        images.iter().enumerate().fold(self, |pass, (i, image)| pass.previous(&format!("{binding}_{i}"), *image))
    }
}
