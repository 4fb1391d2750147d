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
    let id = instructions(spirv).find(decorated)?[1];
    instructions(spirv).find_map(|i| match (i[0] & 0xffff, i.len()) {
        (TRUE, 3) if i[2] == id => Some(1),
        (FALSE, 3) if i[2] == id => Some(0),
        (CONSTANT, 4) if i[2] == id => Some(i[3]),
        _ => None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEAD: &str = "#version 450
        #extension GL_EXT_samplerless_texture_functions : require
        layout(local_size_x = 16, local_size_y = 4) in;
        layout(constant_id = 0) const uint WIRED = 0xffffffffu;
        layout(constant_id = 3) const bool BOX = true;
        const int RADIUS = BOX ? 1 : 2;
        layout(push_constant) uniform Push { uint present; float sigma_l; } push;
        layout(set = 0, binding = 2) uniform texture2D first;
        layout(set = 0, binding = 7) uniform texture2D second;
        layout(set = 0, binding = 4, r32f) uniform writeonly image2D result;";
    const MAIN: &str = "void main() {
            vec4 value = texelFetch(first, ivec2(RADIUS), 0) * push.sigma_l;
            if ((WIRED & push.present) != 0u) value += texelFetch(second, ivec2(0), 0);
            imageStore(result, ivec2(0), value);
        }";

    fn reflected(source: &str, optional: &[&str]) -> Result<Shader, String> {
        let mut options = shaderc::CompileOptions::new().expect("options");
        options.set_target_env(shaderc::TargetEnv::Vulkan, shaderc::EnvVersion::Vulkan1_1 as u32);
        let compiler = shaderc::Compiler::new().expect("shaderc");
        let compiled = compiler.compile_into_spirv(source, shaderc::ShaderKind::Compute, "mine", "main", Some(&options));
        let compiled = compiled.expect("GLSL");
        let optional: Vec<_> = optional.iter().map(|name| (*name).to_owned()).collect();
        reflect("mine", "mine_1", compiled.as_binary_u8().to_vec(), compiled.as_binary(), &optional)
    }

    #[test]
    fn a_module_tells_its_bindings_members_constants_and_workgroup() {
        let shader = reflected(&format!("{HEAD} {MAIN}"), &["second"]).expect("a shader");
        assert_eq!((&*shader.stage, &*shader.name, shader.workgroup), ("mine", "mine_1", [16, 4, 1]));
        let bindings: Vec<_> = shader.bindings.iter().map(|b| (b.number, &*b.name, b.kind, b.optional)).collect();
        let sampled = BindingKind::SampledImage(Component::Float);
        let written = BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly);
        assert_eq!(bindings, [(2, "first", sampled, false), (4, "result", written, false), (7, "second", sampled, true)]);
        let members: Vec<_> = shader.members.iter().map(|m| (&*m.name, m.offset, m.scalar)).collect();
        assert_eq!(members, [("present", 0, Scalar::Uint), ("sigma_l", 4, Scalar::Float)]);
        let constants: Vec<_> = shader.constants.iter().map(|c| (&*c.name, c.id, c.scalar, c.default)).collect();
        assert_eq!(constants, [("WIRED", 0, Scalar::Uint, u32::MAX), ("BOX", 3, Scalar::Bool, 1)]);
    }

    #[test]
    fn what_a_pass_cannot_be_made_of_is_named() {
        let edits = [
            ("first;", "first;", "result", "no other binding of its kind"),
            ("binding = 7", "binding = 32", "second", "numbers are 0 to 31"),
            ("binding = 7", "binding = 2", "second", "another one has its number"),
            ("set = 0, binding = 7", "set = 1, binding = 7", "second", "descriptor set 1"),
            ("float sigma_l", "float sigma_l; float many[31]", "second", "`many` is of type"),
            ("uint present", "layout(offset = 124) uint present", "second", "132 bytes of push constants"),
            ("uint present;", "uint bits;", "second", "needs the constant WIRED and the push constant `present`"),
            ("uniform texture2D second", "uniform itexture2D second", "second", "sampled image of i32"),
            ("r32f) uniform writeonly image2D", "rg32f) uniform writeonly image2D", "second", "Rg32f"),
        ];
        for (old, new, optional, problem) in edits {
            let main = if new.contains("bits") { MAIN.replace("present", "bits") } else { MAIN.to_owned() };
            let main = if new.contains("itexture2D") {
                main.replace("texelFetch(second, ivec2(0), 0)", "vec4(texelFetch(second, ivec2(0), 0))")
            } else {
                main
            };
            let error = reflected(&format!("{} {main}", HEAD.replacen(old, new, 1)), &[optional]).expect_err(problem);
            assert!(error.contains(problem) && error.starts_with("mine_1"), "{error}");
        }
    }
}
