//! Interfaces of shaders: what a program assumes of one, as reflection finds it, in one line for each thing. The build keeps the
//! lines, and a shader that is compiled later must have the same ones.

use spirq::constant::ConstantValue;
use spirq::entry_point::EntryPoint;
use spirq::{prelude::*, ty::DescriptorType, ty::Type, var::Variable};

/// Places, and what is there; sorted.
pub type Interface = Vec<(String, String)>;

/// The interface of a module that has its names. Those of bindings do not count, since a binding is found by its number; those of a
/// block's members do, since its Rust twin has them.
pub fn interface(spirv: &[u32]) -> Result<Interface, String> {
    let entry_point = entry_point(spirv)?;
    let mut lines = capabilities(spirv);
    for mode in &entry_point.exec_modes {
        let operands: Vec<_> = mode.operands.iter().map(|c| number(&c.value)).collect();
        lines.push((format!("{:?}", mode.exec_mode), operands.join(" x ")));
    }
    for variable in &entry_point.vars {
        match variable {
            Variable::Descriptor { desc_bind, desc_ty, ty, nbind, .. } => {
                let place = format!("set {} binding {}", desc_bind.set(), desc_bind.bind());
                let kind = match (desc_ty, ty) {
                    (_, Type::Struct(_)) => format!("{desc_ty:?}"),
                    (DescriptorType::StorageImage(access), _) => format!("{ty} {access:?}"),
                    _ => ty.to_string(),
                };
                members(&mut lines, &place, ty, 0);
                lines.push((place, if *nbind == 1 { kind } else { format!("{kind}, {nbind} of them") }));
            }
            Variable::PushConstant { ty, .. } => members(&mut lines, "push constants", ty, 0),
            Variable::SpecConstant { spec_id, ty, .. } => {
                lines.push((format!("specialization constant {spec_id}"), ty.to_string()))
            }
            _ => {}
        }
    }
    lines.sort();
    lines.dedup();
    Ok(lines)
}

/// The entry point of a module, as spirq reads it.
pub fn entry_point(spirv: &[u32]) -> Result<EntryPoint, String> {
    let spirv = without_computed_constants(spirv);
    let reflected = ReflectConfig::new().spv(spirv).ref_all_rscs(true).combine_img_samplers(false).reflect();
    reflected.map_err(|e| e.to_string())?.into_iter().next().ok_or_else(|| "there is no entry point".to_owned())
}

/// The module for a reader that cannot compute with specialisation constants: what is computed of them is undefined in it.
fn without_computed_constants(spirv: &[u32]) -> Vec<u32> {
    const SPEC_CONSTANT_OP: u32 = 52;
    const UNDEF: u32 = 1;
    let mut words = spirv.get(..5).unwrap_or_default().to_vec();
    for instruction in instructions(spirv) {
        match instruction {
            [head, ty, id, ..] if head & 0xffff == SPEC_CONSTANT_OP => words.extend([3 << 16 | UNDEF, *ty, *id]),
            other => words.extend(other),
        }
    }
    words
}

/// Every instruction with its operands; ends where a length makes no sense.
pub fn instructions(spirv: &[u32]) -> impl Iterator<Item = &[u32]> {
    let mut left = spirv.get(5..).unwrap_or_default();
    std::iter::from_fn(move || {
        let words = (*left.first()? >> 16) as usize;
        if words == 0 || words > left.len() {
            return None;
        }
        let (instruction, rest) = left.split_at(words);
        left = rest;
        Some(instruction)
    })
}

/// The members of a block, those of structs inside as well.
fn members(lines: &mut Interface, place: &str, ty: &Type, base: usize) {
    match ty {
        Type::Struct(block) => {
            for member in &block.members {
                let at = base + member.offset.unwrap_or(0);
                let name = member.name.as_deref().unwrap_or_default();
                let kind = if holds_struct(&member.ty) { String::new() } else { format!(": {}", member.ty) };
                lines.push((format!("{place} byte {at}"), format!("{name}{kind}")));
                members(lines, &format!("{place} {name}"), &member.ty, at);
            }
        }
        Type::Array(array) => {
            let count = array.nelement.map_or("any number".into(), |n| n.to_string());
            lines.push((format!("{place} elements"), format!("{count} of {} bytes", array.stride.unwrap_or(0))));
            members(lines, place, &array.element_ty, base);
        }
        _ => {}
    }
}

fn holds_struct(ty: &Type) -> bool {
    match ty {
        Type::Struct(_) => true,
        Type::Array(array) => holds_struct(&array.element_ty),
        _ => false,
    }
}

fn number(value: &ConstantValue) -> String {
    match value {
        ConstantValue::U32(n) => n.to_string(),
        other => format!("{other:?}"),
    }
}

/// Capabilities that not every Vulkan device has: what else a shader may use was asked of the device for the shaders of the build.
fn capabilities(spirv: &[u32]) -> Interface {
    // Matrix, Shader, InputAttachment, Sampled1D, Image1D, SampledBuffer, ImageBuffer, ImageQuery, DerivativeControl.
    const EVERYWHERE: [u32; 9] = [0, 1, 40, 43, 44, 46, 47, 50, 51];
    const OP_CAPABILITY: u32 = 17;
    let instructions = spirv.get(5..).unwrap_or_default().chunks_exact(2);
    // The section of capabilities comes first, and each takes two words.
    let declared = instructions.take_while(|i| i[0] == 2 << 16 | OP_CAPABILITY).map(|i| i[1]);
    let special = declared.filter(|c| !EVERYWHERE.contains(c));
    let name = |c: u32| spirq::spirv::Capability::from_u32(c).map_or_else(|| c.to_string(), |c| format!("{c:?}"));
    special.map(|c| (format!("capability {}", name(c)), "needed".into())).collect()
}
