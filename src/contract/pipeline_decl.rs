//! The pipeline of a pass as plain data: for tools that reflect it, or compile it by themselves for the statistics of a driver.

use super::PassDecl;
use crate::shaders::descriptor_type;
use ash::vk;

/// The compute pipeline that a dispatch runs.
#[derive(Clone, Debug, PartialEq)]
pub struct PipelineDecl<'a> {
    /// Name of the module: the stage and its variant, for example `atrous_signals_2`.
    pub module: &'a str,
    /// The module, in the order of this machine's bytes. Its entry point is `main`.
    pub spirv: &'a [u8],
    /// Number and type of every binding of descriptor set 0, wired or not.
    pub bindings: Vec<(u32, vk::DescriptorType)>,
    /// Bytes of the push constants, from 0 on.
    pub push_bytes: u32,
    /// Specialisation constants that the pass sets, by identifier; the others have their defaults.
    pub constants: Vec<PipelineConstant<'a>>,
}

/// A specialisation constant of four bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PipelineConstant<'a> {
    /// Name in the GLSL.
    pub name: &'a str,
    /// The `constant_id`.
    pub id: u32,
    /// Bits of the value.
    pub bits: u32,
}

impl PassDecl {
    /// The pipeline of a dispatch; `None` for a pass that is no dispatch.
    pub fn pipeline(&self) -> Option<PipelineDecl<'_>> {
        let dispatch = self.dispatch()?;
        let shader = &dispatch.shader;
        let name = |id: u32| shader.constants.iter().find(|c| c.id == id).map_or("", |c| &*c.name);
        let constant = |&(id, bits): &(u32, u32)| PipelineConstant { name: name(id), id, bits };
        Some(PipelineDecl {
            module: &shader.name,
            spirv: &shader.spirv,
            bindings: shader.bindings.iter().map(|b| (b.number, descriptor_type(b.kind))).collect(),
            push_bytes: shader.push_bytes(),
            constants: dispatch.constants.iter().map(constant).collect(),
        })
    }
}
