//! Compares the wires of a node with the interface of its shader, and finds the source of
//! everything.

use super::pass::{Pass, Value, Wire};
use super::Image;
use crate::contract::{
    component_of, Access, Dispatch, ImageFormat, Lifetime, Parameter, PassDecl, ResourceDecl, Shape, Slot, Tuning, Use, UseFrame,
    Work,
};
use crate::shaders::{vk_format, BindingKind, PushMember, Scalar, Shader, ShaderBinding, LEVEL, PRESENT, SET_FOR_ALL, WIRED};
use std::any::Any;
use std::sync::Arc;

/// Images that the graph itself binds where a shader has them.
pub(super) struct Automatic {
    pub frame: Image,
    pub statistics: Image,
}

/// A mismatch between a pass and its shader.
pub(super) struct Mismatch {
    /// The binding, constant or parameter.
    pub port: String,
    /// The given value, the allowed ones, and the remedy.
    pub problem: String,
}

fn mismatch<T>(port: &str, problem: String) -> Result<T, Mismatch> {
    Err(Mismatch { port: port.to_owned(), problem })
}

impl Automatic {
    fn of(&self, binding: &str) -> Option<Wire> {
        match binding {
            "frame" => Some(Wire { image: self.frame, frame: UseFrame::Current }),
            "statistics" => Some(Wire { image: self.statistics, frame: UseFrame::Current }),
            _ => None,
        }
    }
}

/// The declaration of a pass.
pub(super) fn declare(pass: &Pass, automatic: &Automatic, resources: &[ResourceDecl]) -> Result<PassDecl, Mismatch> {
    pass.shader.check().or_else(|problem| mismatch("shader", problem))?;
    check_wires(pass, automatic)?;
    let (uses, slots) = match_bindings(pass, automatic, resources)?;
    let constants = match_constants(pass, &slots)?;
    let parameters = match_parameters(pass)?;
    let Pass { name, phase, shader, grid, cpu, .. } = pass.clone();
    let cpu = cpu.map(|stage| Arc::new(stage) as Arc<dyn Any + Send + Sync>);
    let dispatch = Dispatch { shader, constants, slots, parameters, grid, cpu };
    Ok(PassDecl { name, phase, uses, work: Work::Dispatch(dispatch) })
}

/// Every name is a binding of the shader, once.
fn check_wires(pass: &Pass, automatic: &Automatic) -> Result<(), Mismatch> {
    for (i, (name, _)) in pass.wires.iter().enumerate() {
        let (shader, known) = (&pass.shader.name, binding_names(&pass.shader));
        if automatic.of(name).is_some() {
            return mismatch(name, "it is bound by the graph itself; leave it out".to_owned());
        }
        if pass.shader.binding(name).is_none() {
            return mismatch(name, format!("it is no binding of {shader}; allowed are {known}"));
        }
        if pass.wires[..i].iter().any(|(other, _)| other == name) {
            return mismatch(name, format!("it is bound twice; give each binding of {shader} one image: {known}"));
        }
    }
    Ok(())
}

/// Uses in the order of the numbers of bindings, and the content of each binding.
fn match_bindings(pass: &Pass, automatic: &Automatic, resources: &[ResourceDecl]) -> Result<(Vec<Use>, Vec<Slot>), Mismatch> {
    let shader = &*pass.shader;
    let (mut uses, mut wired) = (Vec::new(), Vec::new());
    for binding in shader.bindings.iter() {
        let asked = pass.wires.iter().find(|(name, _)| *name == binding.name).map(|(_, wire)| *wire);
        let Some(wire) = asked.or_else(|| automatic.of(&binding.name)) else {
            if !binding.optional {
                let problem = format!("nothing is bound; {} needs {}", shader.name, binding_names(shader));
                return mismatch(&binding.name, problem);
            }
            wired.push(None);
            continue;
        };
        let id = wire.image.id;
        let resource = &resources[id.0 as usize];
        check_fit(binding, wire, resource)?;
        let new = Use { resource: id, frame: wire.frame, access: Access::of(binding.kind) };
        // Nothing orders what happens inside of a pass.
        let is_met = |u: &Use| u.resource == id && u.frame == new.frame && (u.access.writes() || new.access.writes());
        if uses.iter().any(is_met) {
            let problem = format!("`{}` is bound in the same pass already, and written; bind another image", resource.name);
            return mismatch(&binding.name, problem);
        }
        wired.push(Some(uses.len()));
        uses.push(new);
    }
    let use_at = |other: &ShaderBinding| shader.bindings.iter().zip(&wired).find(|(b, _)| b.number == other.number)?.1.as_ref();
    let slot = |(binding, wired): (&ShaderBinding, &Option<usize>)| {
        // A binding that is always there stands in for itself.
        let stand_in = shader.stand_in(binding).filter(|_| binding.optional).unwrap_or(binding);
        Slot { wired: *wired, stand_in: use_at(stand_in).copied().unwrap_or(0) }
    };
    let slots = shader.bindings.iter().zip(&wired).map(slot).collect();
    Ok((uses, slots))
}

/// Whether a binding can take a copy of a resource.
fn check_fit(binding: &ShaderBinding, wire: Wire, resource: &ResourceDecl) -> Result<(), Mismatch> {
    let (name, given) = (&binding.name, &resource.name);
    let refused = |why: String| mismatch(name, format!("it cannot be `{given}`: {why}"));
    match (binding.kind, resource.shape) {
        (BindingKind::SampledImage(component), Shape::Image { format, .. }) => {
            if component_of(format.preferred()) != Some(component) {
                return refused(format!("the shader samples components of the class {component:?}, and the image has {format}"));
            }
        }
        (BindingKind::StorageImage(texel, _), Shape::Image { format, .. }) => {
            if format != ImageFormat::Exactly(vk_format(texel)) {
                return refused(format!("the shader has the format {:?}, and the image has {format}", vk_format(texel)));
            }
        }
        (BindingKind::UniformBuffer | BindingKind::StorageBuffer(_), Shape::Buffer { .. }) => {}
        (_, Shape::Image { .. }) => return refused("it is an image, and the shader has a buffer".into()),
        (_, Shape::Buffer { .. }) => return refused("it is a buffer, and the shader has an image".into()),
    }
    if resource.lifetime == (Lifetime::Input { optional: true }) && !binding.optional {
        return refused("a host may leave it out, and the shader cannot do without; make the input a required one".into());
    }
    if wire.frame == UseFrame::Previous && !resource.lifetime.is_history() {
        return refused("it keeps nothing of the frame before; only a history does".into());
    }
    if wire.frame == UseFrame::Previous && Access::of(binding.kind).writes() {
        return refused("the shader writes it, and the copy of the frame before is only read".into());
    }
    Ok(())
}

/// Identifiers and bits, by identifier; `WIRED` among them, where the shader has it.
fn match_constants(pass: &Pass, slots: &[Slot]) -> Result<Vec<(u32, u32)>, Mismatch> {
    let shader = &*pass.shader;
    let mut constants = Vec::new();
    for (i, (name, value)) in pass.constants.iter().enumerate() {
        let Some(constant) = shader.constant(name).filter(|c| !SET_FOR_ALL.contains(&&*c.name)) else {
            let known: Vec<_> = shader.constants.iter().map(|c| &*c.name).filter(|name| !SET_FOR_ALL.contains(name)).collect();
            return mismatch(name, format!("it is no constant of {}; allowed are {}", shader.name, list(&known)));
        };
        if pass.constants[..i].iter().any(|(other, _)| other == name) {
            return mismatch(name, "the constant is set twice; set it once".to_owned());
        }
        if constant.scalar == Scalar::Bool && *value > 1 {
            return mismatch(name, format!("the constant is {value}; a bool is 0 or 1"));
        }
        constants.push((constant.id, *value));
    }
    if let Some(wired) = shader.constant(WIRED) {
        let given = shader.bindings.iter().zip(slots).filter(|(_, slot)| slot.wired.is_some());
        constants.push((wired.id, given.fold(0, |bits, (binding, _)| bits | 1 << binding.number)));
    }
    constants.sort_unstable();
    Ok(constants)
}

/// The source of each push constant, in their order.
fn match_parameters(pass: &Pass) -> Result<Vec<Parameter>, Mismatch> {
    let shader = &*pass.shader;
    for (i, (name, _)) in pass.parameters.iter().enumerate() {
        if !shader.has_member(name) || name == PRESENT || name == LEVEL {
            let known: Vec<_> = shader.members.iter().map(|m| &*m.name).filter(|name| ![PRESENT, LEVEL].contains(name)).collect();
            return mismatch(name, format!("it is no parameter of {}; allowed are {}", shader.name, list(&known)));
        }
        if pass.parameters[..i].iter().any(|(other, _)| other == name) {
            return mismatch(name, "the parameter is set twice; set it once".to_owned());
        }
    }
    if pass.level.is_some() && !shader.has_member(LEVEL) {
        return mismatch(LEVEL, format!("{} has no push constant of this name; leave the level out", shader.name));
    }
    shader.members.iter().map(|member| parameter(pass, member)).collect()
}

/// The push constant that has the number of the view, in a pass that shows one.
const VIEW: &str = "view";

fn parameter(pass: &Pass, member: &PushMember) -> Result<Parameter, Mismatch> {
    let name = &*member.name;
    let (parameter, scalar) = match name {
        PRESENT => (Parameter::Present, Scalar::Uint),
        LEVEL => match pass.level {
            None => return mismatch(LEVEL, format!("{} has this push constant; give the pass a level", pass.shader.name)),
            Some(level) => (Parameter::Fixed(level), Scalar::Uint),
        },
        VIEW if pass.shows_view => (Parameter::View, Scalar::Uint),
        _ => match pass.parameters.iter().find(|(other, _)| other == name) {
            Some((_, Value::Fixed(number))) => (Parameter::Fixed(number.to_bits()), Scalar::Float),
            Some((_, Value::Tunable(tunable))) => tunable_of(tunable, name)?,
            Some((_, Value::Own)) | None => tunable_of(name, name)?,
        },
    };
    if member.scalar != scalar {
        let problem = format!("the push constant is a {:?} in {}; it must be a {scalar:?}", member.scalar, pass.shader.name);
        return mismatch(name, problem);
    }
    Ok(parameter)
}

fn tunable_of(tunable: &str, member: &str) -> Result<(Parameter, Scalar), Mismatch> {
    let scalar = if tunable == Tuning::TONE_CURVE { Scalar::Uint } else { Scalar::Float };
    match Tuning::index(tunable) {
        Some(index) => Ok((Parameter::Tuning(index), scalar)),
        None => {
            let known: Vec<_> = Tuning::FIELDS.iter().map(|field| field.name).chain([Tuning::TONE_CURVE]).collect();
            let problem = format!("it comes from `{tunable}`, which is no tunable; give it a number, or one of {}", list(&known));
            mismatch(member, problem)
        }
    }
}

fn binding_names(shader: &Shader) -> String {
    let name = |b: &ShaderBinding| if b.optional { format!("{} (optional)", b.name) } else { b.name.to_string() };
    let names: Vec<_> = shader.bindings.iter().map(name).collect();
    list(&names)
}

fn list<T: AsRef<str>>(names: &[T]) -> String {
    if names.is_empty() {
        return "none".to_owned();
    }
    names.iter().map(AsRef::as_ref).collect::<Vec<_>>().join(", ")
}
