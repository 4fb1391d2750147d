//! Reflection of SPIR-V modules. One reader for the crate's own shaders and for a host's.

use crate::interface::{entry_point, instructions};
use crate::module::{
    BindingAccess, BindingKind, Component, PushMember, Scalar, Shader, ShaderBinding, SpecialisationConstant, TexelFormat,
};
use spirq::constant::ConstantValue;
use spirq::spirv::ExecutionMode;
use spirq::ty::{DescriptorType, Type};
use spirq::var::Variable;

/// Makes a shader of a module that has its names. `code` is what runs: the same module, or one that was optimised after it lost
/// them.
///
/// # Errors
/// Names what a pass cannot be made of.
pub fn reflect(stage: &str, name: &str, code: Vec<u8>, named: &[u32], optional: &[String]) -> Result<Shader, String> {
    let entry_point = entry_point(named).map_err(|problem| format!("{name}: {problem}"))?;
    let (mut bindings, mut members, mut constants) = (Vec::new(), Vec::new(), Vec::new());
    for variable in &entry_point.vars {
        match variable {
            Variable::Descriptor { name: of, desc_bind, desc_ty, ty, nbind } => {
                let of = of.clone().ok_or_else(|| format!("{name}: binding {} has no name", desc_bind.bind()))?;
                if desc_bind.set() != 0 {
                    return Err(format!("{name}: `{of}` is in descriptor set {}; only set 0 is allowed", desc_bind.set()));
                }
                if *nbind != 1 {
                    return Err(format!("{name}: `{of}` is an array of {nbind} bindings; give each a binding of its own"));
                }
                let kind = kind(desc_ty, ty).map_err(|problem| format!("{name}: `{of}` is {problem}"))?;
                let optional = optional.contains(&of);
                bindings.push(ShaderBinding { number: desc_bind.bind(), name: of.into(), kind, optional });
            }
            Variable::PushConstant { ty, .. } => members.extend(push_members(name, ty)?),
            Variable::SpecConstant { name: of, spec_id, ty } => {
                let of = of.clone().ok_or_else(|| format!("{name}: specialisation constant {spec_id} has no name"))?;
                let default = default_of(named, *spec_id).ok_or_else(|| format!("{name}: `{of}` has no default"))?;
                constants.push(SpecialisationConstant { scalar: scalar(name, &of, ty)?, name: of.into(), id: *spec_id, default });
            }
            _ => {}
        }
    }
    bindings.sort_by_key(|b| b.number);
    members.sort_by_key(|m| m.offset);
    constants.sort_by_key(|c| c.id);
    let local_size = entry_point.exec_modes.iter().find(|mode| mode.exec_mode == ExecutionMode::LocalSize);
    let sides: Option<Vec<u32>> = local_size.and_then(|mode| mode.operands.iter().map(|c| number(&c.value)).collect());
    let workgroup = sides.and_then(|sides| sides.try_into().ok()).ok_or_else(|| format!("{name}: no fixed size of workgroups"))?;
    let shader = Shader {
        stage: stage.to_owned().into(),
        name: name.to_owned().into(),
        spirv: code.into(),
        workgroup,
        bindings: bindings.into(),
        members: members.into(),
        constants: constants.into(),
    };
    shader.check()?;
    Ok(shader)
}

fn kind(descriptor: &DescriptorType, ty: &Type) -> Result<BindingKind, String> {
    Ok(match (descriptor, ty) {
        (DescriptorType::UniformBuffer(), _) => BindingKind::UniformBuffer,
        (DescriptorType::StorageBuffer(by), _) => BindingKind::StorageBuffer(access(by)),
        (DescriptorType::StorageImage(by), Type::StorageImage(image)) => {
            BindingKind::StorageImage(texel_format(&format!("{:?}", image.fmt))?, access(by))
        }
        (DescriptorType::SampledImage(), Type::SampledImage(image)) => match image.scalar_ty.to_string().as_str() {
            "f32" => BindingKind::SampledImage(Component::Float),
            "u32" => BindingKind::SampledImage(Component::Uint),
            other => return Err(format!("a sampled image of {other}; texture2D and utexture2D are allowed")),
        },
        (other, _) => return Err(format!("of the kind {other:?}; sampled images, storage images and buffers are allowed")),
    })
}

fn access(by: &spirq::ty::AccessType) -> BindingAccess {
    use spirq::ty::AccessType as A;
    match by {
        A::ReadOnly => BindingAccess::ReadOnly,
        A::WriteOnly => BindingAccess::WriteOnly,
        A::ReadWrite => BindingAccess::ReadWrite,
    }
}

fn texel_format(name: &str) -> Result<TexelFormat, String> {
    use TexelFormat as F;
    let all = [F::Rgba32f, F::Rgba16f, F::R32f, F::Rgba8, F::Rgba32ui, F::Rgba16ui, F::R32ui];
    let found = all.into_iter().find(|format| format!("{format:?}") == name);
    found.ok_or_else(|| format!("a storage image of format {name}; {all:?} need no device feature"))
}

fn push_members(name: &str, ty: &Type) -> Result<Vec<PushMember>, String> {
    let Type::Struct(block) = ty else { return Err(format!("{name}: push constants that are no block")) };
    let member = |m: &spirq::ty::StructMember| {
        let of = m.name.clone().ok_or_else(|| format!("{name}: a push constant has no name"))?;
        let offset = m.offset.ok_or_else(|| format!("{name}: push constant `{of}` has no offset"))? as u32;
        Ok(PushMember { scalar: scalar(name, &of, &m.ty)?, name: of.into(), offset })
    };
    block.members.iter().map(member).collect()
}

fn scalar(name: &str, of: &str, ty: &Type) -> Result<Scalar, String> {
    match ty.to_string().as_str() {
        "bool" => Ok(Scalar::Bool),
        "i32" => Ok(Scalar::Int),
        "u32" => Ok(Scalar::Uint),
        "f32" => Ok(Scalar::Float),
        other => Err(format!("{name}: `{of}` is of type {other}; bool, int, uint and float are allowed")),
    }
}

fn number(value: &ConstantValue) -> Option<u32> {
    match value {
        ConstantValue::U32(n) => Some(*n),
        _ => None,
    }
}

/// The bits that a specialisation constant has where nothing sets it.
fn default_of(spirv: &[u32], spec_id: u32) -> Option<u32> {
    const DECORATE: u32 = 71;
    const SPEC_ID: u32 = 1;
    const TRUE: u32 = 48;
    const FALSE: u32 = 49;
    const CONSTANT: u32 = 50;
    let decorated = |i: &&[u32]| i[0] & 0xffff == DECORATE && i.len() == 4 && i[2] == SPEC_ID && i[3] == spec_id;
    let id = instructions(spirv).find(|i| decorated(&i))?[1];
    instructions(spirv).find_map(|i| match (i[0] & 0xffff, i.len()) {
        (TRUE, 3) if i[2] == id => Some(1),
        (FALSE, 3) if i[2] == id => Some(0),
        (CONSTANT, 4) if i[2] == id => Some(i[3]),
        _ => None,
    })
}
