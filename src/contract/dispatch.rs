//! Work of a pass: its shader, and the source of everything that it reads. Made once, so that recording looks nothing up.

use super::{Declaration, PassDecl, Use};
use crate::shaders::{Shader, ShaderRef};
use std::any::Any;
use std::sync::Arc;

/// The commands that a pass records.
#[derive(Clone, Debug)]
pub(crate) enum Work {
    /// Uploads [`crate::FrameConstants`] to binding 0 and fills binding 1 with zeros.
    StartFrame,
    /// Runs a shader.
    Dispatch(Dispatch),
}

/// One run of a shader.
#[derive(Clone, Debug)]
pub(crate) struct Dispatch {
    pub shader: ShaderRef,
    /// Identifier and bits of each specialisation constant that is set, by identifier.
    pub constants: Vec<(u32, u32)>,
    /// One for each binding of the shader, in their order.
    pub slots: Vec<Slot>,
    /// One for each member of the push constants, in their order.
    pub parameters: Vec<Parameter>,
    pub grid: Grid,
    /// The stage on the CPU, for the engine that runs it there: the contract carries it and does not look into it.
    pub cpu: Option<Arc<dyn Any + Send + Sync>>,
}

/// The content of a binding of a shader.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot {
    /// The use of the pass; `None`: the graph has nothing for it.
    pub wired: Option<usize>,
    /// The use whose descriptor stands here where there is none: the shader does not read it.
    pub stand_in: usize,
}

/// The source of a push constant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parameter {
    /// Fixed bits, in every frame.
    Fixed(u32),
    /// A tunable of the frame, by its index.
    Tuning(usize),
    /// Bits of the bindings that the host bound.
    Present,
    /// The view of the frame.
    View,
}

/// Invocations of a dispatch.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Grid {
    /// One per pixel of this frame's light.
    Pixels,
    /// One per rendered pixel, which the guides have.
    Guides,
    /// One per stratum of so many pixels a side, of this frame and of the previous one, which is
    /// walked, too.
    Strata(u32),
    /// One a column of so many pixels of this frame.
    Columns(u32),
    /// One a column of so many pixels of the output.
    Output(u32),
}

/// The sizes of a frame that a grid may cover, in pixels.
#[derive(Clone, Copy, Debug)]
pub(crate) struct GridExtents {
    pub light: [u32; 2],
    pub previous_light: [u32; 2],
    pub rendered: [u32; 2],
    pub output: [u32; 2],
}

impl Dispatch {
    /// Workgroups in x and y.
    pub(crate) fn workgroups(&self, extents: &GridExtents) -> [u32; 2] {
        let (now, before) = (extents.light, extents.previous_light);
        let [x, y] = match self.grid {
            Grid::Pixels => now,
            Grid::Guides => extents.rendered,
            Grid::Strata(side) => [now[0].max(before[0]).div_ceil(side), now[1].max(before[1]).div_ceil(side)],
            Grid::Columns(pixels) => [now[0], now[1].div_ceil(pixels)],
            Grid::Output(pixels) => [extents.output[0], extents.output[1].div_ceil(pixels)],
        };
        let [width, height, _] = self.shader.workgroup;
        [x.div_ceil(width), y.div_ceil(height)]
    }
}

impl Declaration {
    /// Invocations of a pass, by its index, in a frame of the allocated extent: of whole workgroups, those beyond the image among them. 0 for
    /// a pass that is no dispatch, and for an index that no pass has.
    pub fn invocations(&self, pass: usize) -> u64 {
        let Some(dispatch) = self.passes.get(pass).and_then(PassDecl::dispatch) else { return 0 };
        let (setup, rendered) = (&self.setup, self.setup.allocated_extent);
        let light = setup.light_of(rendered);
        let extents = GridExtents { light, previous_light: light, rendered, output: setup.largest_output() };
        let sides = dispatch.workgroups(&extents).into_iter().chain(dispatch.shader.workgroup);
        sides.map(u64::from).product()
    }
}

impl PassDecl {
    pub(crate) fn dispatch(&self) -> Option<&Dispatch> {
        match &self.work {
            Work::Dispatch(dispatch) => Some(dispatch),
            Work::StartFrame => None,
        }
    }

    /// Sets a specialisation constant by name, where the shader has it.
    pub(crate) fn set_constant(&mut self, name: &str, bits: u32) {
        let Work::Dispatch(dispatch) = &mut self.work else { return };
        let Some(id) = dispatch.shader.constant(name).map(|constant| constant.id) else { return };
        dispatch.constants.push((id, bits));
        dispatch.constants.sort_unstable();
    }

    pub(crate) fn shader(&self) -> Option<&Shader> {
        self.dispatch().map(|d| &*d.shader)
    }

    /// Whether it draws a view, so that a frame without one leaves it out.
    pub(crate) fn draws_view(&self) -> bool {
        self.dispatch().is_some_and(|d| d.parameters.contains(&Parameter::View))
    }

    /// The stage that a dispatch runs, which is the file of its shader without `.comp`; `None` for a pass that is no dispatch.
    pub fn stage(&self) -> Option<&str> {
        self.shader().map(|s| &*s.stage)
    }

    /// Number and GLSL name of the binding at which each use stands, in the order of the uses; empty for a pass that is no
    /// dispatch.
    pub fn bindings(&self) -> impl Iterator<Item = (u32, &str)> {
        let slots = self.dispatch().into_iter().flat_map(|d| d.slots.iter().zip(d.shader.bindings.iter()));
        slots.filter(|(slot, _)| slot.wired.is_some()).map(|(_, binding)| (binding.number, &*binding.name))
    }

    /// The use that stands at a binding, by its GLSL name.
    pub fn use_of(&self, binding: &str) -> Option<&Use> {
        self.bindings().zip(&self.uses).find(|((_, name), _)| *name == binding).map(|(_, u)| u)
    }
}

#[cfg(test)]
mod tests {
    use crate::Config;

    #[test]
    fn invocations_are_those_of_whole_workgroups_of_the_grid() {
        let of = |config: &Config, name: &str| {
            let declaration = config.declare().expect("valid");
            let pass = declaration.passes().iter().position(|pass| pass.name == name);
            declaration.invocations(pass.unwrap_or(usize::MAX))
        };
        let whole = Config::new([66, 36]);
        assert_eq!(of(&whole, "temporal_accumulation"), 72 * 40);
        let half = Config { light_extent: Some([33, 18]), reactive_mask: true, ..whole };
        assert_eq!((of(&half, "temporal_accumulation"), of(&half, "reactive_mask")), (40 * 24, 72 * 40));
        assert_eq!((of(&whole, "start_frame"), of(&whole, "no pass")), (0, 0));
    }
}
