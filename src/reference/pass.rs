//! One pass of a declaration on the CPU: its twin, with texels by the names of the shader's bindings.

use super::bindings::Bindings;
use super::engine::zeroed;
use super::stage::{compare_host_stage, CpuStage};
use super::texels::Texels;
use crate::contract::{Declaration, Dispatch, FrameContext, Parameter, PassDecl, Shape, TexelGrid, Tuning, Use};
use crate::error::Error;
use crate::shaders::LEVEL;

impl Dispatch {
    /// The stage on the CPU, as the graph gave it.
    fn on_cpu(&self) -> Option<&CpuStage> {
        self.cpu.as_deref()?.downcast_ref()
    }

    /// Every specialisation constant by name, with the value that the pass has.
    fn named_constants(&self) -> Vec<(&str, u32)> {
        let value = |id: u32| self.constants.iter().find(|c| c.0 == id).map(|c| c.1);
        self.shader.constants.iter().map(|c| (&*c.name, value(c.id).unwrap_or(c.default))).collect()
    }

    /// The tunables as the push constants have them: a pass may have another number under a name.
    fn tuning(&self, frame: &FrameContext) -> Tuning {
        let mut tuning = frame.tuning;
        for (member, parameter) in self.shader.members.iter().zip(&self.parameters) {
            let bits = match *parameter {
                Parameter::Fixed(bits) => bits,
                Parameter::Tuning(index) => frame.tuning.bits(index),
                Parameter::Present | Parameter::View => continue,
            };
            if let Some(index) = Tuning::index(&member.name) {
                tuning.set_bits(index, bits);
            }
        }
        tuning
    }

    /// The push constant `level`.
    fn level(&self) -> u32 {
        let level = self.shader.members.iter().zip(&self.parameters).find(|(member, _)| member.name == LEVEL);
        match level.map(|(_, parameter)| *parameter) {
            Some(Parameter::Fixed(level)) => level,
            _ => 0,
        }
    }
}

/// The output of a twin: uses of the pass, by index, with their texels.
pub type TwinOutputs = Vec<(usize, Texels)>;

impl Declaration {
    /// Runs the twin of a pass on texels that `read` gives for its uses, and returns what it wrote. `None` where the pass runs no
    /// shader.
    ///
    /// # Errors
    /// [`Error::Twin`] where the stage has no twin, or where an image is missing or of another kind; [`Error::Size`] for another
    /// extent.
    pub fn run_twin<'t>(
        &self,
        frame: &FrameContext,
        pass: usize,
        read: impl Fn(&Use) -> Option<&'t Texels>,
    ) -> Result<Option<TwinOutputs>, Error> {
        let Some((pass, dispatch)) = self.passes().get(pass).and_then(|p| Some((p, p.dispatch()?))) else { return Ok(None) };
        let stage = &*dispatch.shader.stage;
        let twin = dispatch.on_cpu().ok_or_else(|| without_twin(stage))?.twin;
        let (constants, tuning) = (dispatch.named_constants(), dispatch.tuning(frame));
        let names: Vec<&str> = pass.bindings().map(|(_, name)| name).collect();
        let block = names.iter().zip(&pass.uses).find(|(name, _)| **name == "frame").and_then(|(_, u)| read(u));
        // A stage may have written it since the frame began.
        let block = block.and_then(Texels::as_constants).unwrap_or(frame.constants);
        let bindings = Bindings::new(stage, &block, &tuning).with_constants(&constants);
        let mut bindings = bindings.with_level(dispatch.level()).with_view(frame.debug_view.unwrap_or_default());
        let origin = frame.constants.viewport_origin;
        let cut = |u: &Use| read(u).filter(|_| self.is_part(u)).map(|texels| texels.part(origin, self.allocated_extent()));
        let parts: Vec<Option<Texels>> = pass.uses.iter().map(cut).collect();
        for ((name, u), part) in names.iter().zip(&pass.uses).zip(&parts) {
            if let Some(texels) = part.as_ref().or_else(|| read(u)).filter(|_| u.access.reads()) {
                bindings.reads(name, texels);
            }
            if u.access.writes() {
                bindings.writes(name, if self.is_part(u) { self.allocated_extent() } else { self.texel_extent(u) });
            }
        }
        twin(&mut bindings)?;
        let place = |name: &str| names.iter().position(|n| *n == name);
        let written = bindings.into_written().into_iter().filter_map(|(name, texels)| Some((place(name)?, texels)));
        let whole = |(place, picture): (usize, Texels)| {
            let u = &pass.uses[place];
            if !self.is_part(u) {
                return Ok((place, picture));
            }
            // Another picture may lie beside it.
            let mut image = read(u).cloned().map_or_else(|| zeroed(self, u.resource), Ok)?;
            image.put(&picture, origin, frame.render_extent);
            Ok((place, image))
        };
        written.map(whole).collect::<Result<_, Error>>().map(Some)
    }

    /// Whether a use has an image of the host in which the picture is a part.
    fn is_part(&self, u: &Use) -> bool {
        self.resource(u.resource).is_part_of_image(self.setup())
    }

    /// Compares what the GPU and the twin wrote to a use of a pass, by the rules of its stage; of a stage of a host as half floats.
    ///
    /// # Errors
    /// A message that names stage and binding, with the number of texels that differ and the first of them.
    pub fn compare_pass(
        &self,
        frame: &FrameContext,
        pass: &PassDecl,
        index: usize,
        gpu: &Texels,
        twin: &Texels,
    ) -> Result<(), String> {
        let (Some(dispatch), Some((_, binding))) = (pass.dispatch(), pass.bindings().nth(index)) else {
            return Err(format!("pass `{}` has no use {index}", pass.name));
        };
        let constants = dispatch.named_constants();
        let name = &dispatch.shader.stage;
        let shape = self.resource(pass.uses[index].resource).shape;
        let (divisor, pixels) = match shape {
            Shape::Image { texels: TexelGrid::Output, .. } => (1, frame.output_extent),
            Shape::Image { texels: TexelGrid::Rendered(divisor), .. } => (divisor, frame.render_extent),
            Shape::Image { texels: TexelGrid::Light(divisor), .. } => (divisor, frame.constants.render_extent),
            Shape::Buffer { .. } => (1, frame.render_extent),
        };
        let part = |texels: &Texels| texels.part(frame.constants.viewport_origin, self.allocated_extent());
        let cut = self.is_part(&pass.uses[index]).then(|| [part(gpu), part(twin)]);
        let [gpu, twin] = cut.as_ref().map_or([gpu, twin], |[gpu, twin]| [gpu, twin]);
        match dispatch.on_cpu().filter(|stage| !stage.rules.is_empty()) {
            Some(stage) => {
                let compared = stage.compare(binding, &constants, pixels, gpu, twin);
                compared.map_err(|message| format!("{name}: {message}"))
            }
            None => {
                let compared = compare_host_stage(divisor, pixels, gpu, twin);
                compared.map_err(|message| format!("{}, {binding}: {message}", pass.name))
            }
        }
    }

    /// Texels of the allocated extent that a use has; a buffer has its bytes in one row.
    pub(crate) fn texel_extent(&self, u: &Use) -> [u32; 2] {
        let resource = self.resource(u.resource);
        match resource.shape {
            Shape::Image { .. } => resource.extent(self.setup()).unwrap_or([1, 1]),
            Shape::Buffer { size } => [size as u32, 1],
        }
    }

    /// The first dispatch whose stage has no twin.
    pub(crate) fn stage_without_twin(&self) -> Option<Error> {
        let lacks = |pass: &PassDecl| pass.dispatch().filter(|d| d.on_cpu().is_none()).map(|d| without_twin(&d.shader.stage));
        self.passes().iter().find_map(lacks)
    }
}

fn without_twin(stage: &str) -> Error {
    let given = "none; give the stage one by Stage::with_twin".to_owned();
    Error::Twin { stage: stage.to_owned(), binding: "the stage itself".to_owned(), needed: "a function for the CPU", given }
}
