//! A pass against its shader.

use super::*;
use crate::contract::{Grid, Lifetime, Parameter, Tuning};
use crate::graph::resources::HOST_COLOUR;
use crate::shaders::{self, Scalar};
use std::sync::Arc;

/// Images for a level of the à-trous filter.
struct Images {
    guide: Image,
    luminance_history: Image,
    input: Image,
    output: Image,
    maybe: Image,
}

impl Images {
    fn new(g: &mut Graph) -> Self {
        Self {
            guide: g.input_image("guide", PACKED_64, 1, false),
            luminance_history: g.input_image("luminance_history", PACKED_64, 1, false),
            input: g.input_image("from", HDR, 1, false),
            output: g.named_image("to", "", HDR, 1, Lifetime::Transient),
            maybe: g.input_image("maybe", HOST_COLOUR, 1, true),
        }
    }

    /// A level of the filter, in an order that is not that of the shader.
    fn pass(&self) -> Pass {
        Pass::new("mine", &shaders::ATROUS_SIGNALS_1)
            .bind("output_0", self.output)
            .bind("input_0", self.input)
            .bind("guide", self.guide)
            .level(3)
    }

    /// The modulation without its optional bindings.
    fn modulation(&self) -> Pass {
        Pass::new("mine", &shaders::MODULATE_FLOAT_0)
            .bind("denoised_radiance", self.output)
            .bind("guide", self.guide)
            .bind("filtered_0", self.input)
    }
}

fn finish(edit: impl FnOnce(Pass, &Images) -> Pass) -> Result<crate::Declaration, Error> {
    finish_with(|images| edit(images.pass(), images))
}

fn finish_with(pass: impl FnOnce(&Images) -> Pass) -> Result<crate::Declaration, Error> {
    let mut g = Graph::new([16, 16]);
    let images = Images::new(&mut g);
    g.add(pass(&images));
    g.finish()
}

fn problem(edit: impl FnOnce(Pass, &Images) -> Pass, port: &str, wanted: &[&str]) {
    let message = finish(edit).expect_err("it does not fit").to_string();
    assert_names(&message, &["node `mine`", &format!("port `{port}`")]);
    assert_names(&message, wanted);
}

#[test]
fn an_image_that_a_pass_writes_is_bound_once() {
    let both = |from: fn(&Images) -> Image, to: fn(&Images) -> Image| {
        finish_with(|images| {
            let pass = Pass::new("mine", &shaders::ATROUS_SIGNALS_1).bind("output_0", to(images)).bind("input_0", from(images));
            pass.bind("guide", images.guide).level(3)
        })
    };
    both(|images| images.input, |images| images.output).expect("two images");
    let message = both(|images| images.output, |images| images.output).expect_err("one image").to_string();
    assert_names(&message, &["node `mine`", "port `output_0`", "`to` is bound in the same pass already", "another image"]);
}

#[test]
fn bindings_are_ordered_by_number_and_an_unwired_one_has_no_use() {
    let declaration = finish_with(Images::modulation).expect("it fits");
    let pass = &declaration.passes()[1];
    let bindings: Vec<_> = pass.bindings().collect();
    assert_eq!(bindings, [(0, "frame"), (1, "statistics"), (2, "guide"), (5, "denoised_radiance"), (6, "filtered_0")]);
    assert_eq!(pass.use_of("filtered_0").map(|u| u.access), Some(crate::Access::Sampled));
    assert_eq!(pass.use_of("denoised_radiance").map(|u| u.access), Some(crate::Access::StorageWrite));
    assert!(pass.use_of("albedo").is_none());
    let dispatch = pass.dispatch().expect("a dispatch");
    let filtered = pass.bindings().position(|(_, name)| name == "filtered_0");
    assert_eq!(Some(dispatch.slots[3].stand_in), filtered, "filtered_0 stands in for albedo");
    assert_eq!(dispatch.constants, [(0, 0b0110_0111), (30, 64)], "WIRED and CONVENTIONS");
    assert!(matches!(dispatch.grid, Grid::Pixels));
}

#[test]
fn an_optional_binding_that_is_wired_has_a_use_and_a_bit() {
    let declaration = finish_with(|images| images.modulation().bind("albedo", images.maybe)).expect("it fits");
    let pass = &declaration.passes()[1];
    assert_eq!(pass.bindings().nth(3), Some((3, "albedo")));
    assert_eq!(pass.dispatch().expect("a dispatch").constants, [(0, 0b0110_1111), (30, 64)]);
}

#[test]
fn a_constant_is_set_by_its_name() {
    let declaration = finish(|pass, _| pass.constant("OURS", 1).constant("KERNEL", 2)).expect("it fits");
    assert_eq!(declaration.passes()[1].dispatch().expect("a dispatch").constants, [(1, 2), (3, 1)]);
}

#[test]
fn a_wrong_binding_is_named_with_those_that_there_are() {
    let known = "frame, guide, input_0, output_0";
    problem(|pass, i| pass.bind("input", i.input), "input", &["no binding of atrous_signals_1", known]);
    problem(|pass, i| pass.bind("guide", i.guide), "guide", &["bound twice", known]);
    problem(|pass, i| pass.bind("frame", i.guide), "frame", &["bound by the graph itself"]);
    problem(|pass, _| Pass { wires: Vec::new(), ..pass }, "guide", &["nothing is bound", known]);
    let with_optional = "albedo (optional), emission (optional), denoised_radiance, filtered_0, filtered_1 (optional), \
                         specular_albedo (optional), specular_f0 (optional), roughness (optional)";
    problem(|_, i| i.modulation().bind("input", i.input), "input", &["no binding of modulate", with_optional]);
}

#[test]
fn an_image_that_does_not_fit_is_named_with_what_the_shader_has() {
    let rebound = |name: &'static str, wire: fn(Pass, &Images) -> Pass| {
        move |pass: Pass, images: &Images| {
            let wires = pass.wires.iter().filter(|(other, _)| other != name).cloned().collect();
            wire(Pass { wires, ..pass }, images)
        }
    };
    let guide = rebound("guide", |pass, i| pass.bind("guide", i.input));
    problem(|_, i| guide(i.modulation(), i), "guide", &["cannot be `from`", "class Uint", "R16G16B16A16_SFLOAT"]);
    let output = rebound("output_0", |pass, i| pass.bind("output_0", i.guide));
    problem(output, "output_0", &["cannot be `guide`", "R16G16B16A16_SFLOAT"]);
    let maybe = rebound("filtered_0", |pass, i| pass.bind("filtered_0", i.maybe));
    problem(|_, i| maybe(i.modulation(), i), "filtered_0", &["cannot be `maybe`", "cannot do without"]);
    let previous = rebound("guide", |pass, i| pass.previous("guide", i.luminance_history));
    problem(previous, "guide", &["cannot be `luminance_history`", "frame before"]);
}

#[test]
fn neighbours_of_one_kind_are_told_apart_by_name() {
    let declaration = finish_with(|i| i.modulation().bind("emission", i.maybe)).expect("it fits");
    let pass = &declaration.passes()[1];
    let resource = |binding: &str| &declaration.resource(pass.use_of(binding).expect(binding).resource).name;
    assert_eq!((resource("emission").as_str(), resource("filtered_0").as_str()), ("maybe", "from"));
}

#[test]
fn a_wrong_constant_is_named_with_those_that_there_are() {
    problem(|pass, _| pass.constant("KERNELS", 1), "KERNELS", &["no constant of atrous_signals_1", "KERNEL, VOLUME"]);
    for for_all in crate::shaders::SET_FOR_ALL {
        problem(|pass, _| pass.constant(for_all, 3), for_all, &["no constant"]);
    }
    problem(|pass, _| pass.constant("OURS", 1).constant("OURS", 0), "OURS", &["set twice"]);
    problem(|pass, _| pass.constant("OURS", 2), "OURS", &["is 2; a bool is 0 or 1"]);
}

#[test]
fn a_wrong_parameter_is_named_with_those_that_there_are() {
    let known = "sigma_l, sigma_n, sigma_z, volume_sigma_z";
    problem(|pass, _| pass.value("sigma", Value::Fixed(1.0)), "sigma", &["no parameter of atrous_signals_1", known]);
    problem(|_, i| i.modulation().value("present", Value::Fixed(1.0)), "present", &["no parameter"]);
    let no_tunable = |pass: Pass, _: &Images| pass.value("sigma_l", Value::Tunable("sigma"));
    problem(no_tunable, "sigma_l", &["comes from `sigma`, which is no tunable", "alpha_moments"]);
    let curve = |pass: Pass, _: &Images| pass.value("sigma_l", Value::Tunable("tone_curve"));
    problem(curve, "sigma_l", &["is a Float", "must be a Uint"]);
    let twice = |pass: Pass, _: &Images| pass.value("sigma_l", Value::Fixed(1.0)).value("sigma_l", Value::Fixed(2.0));
    problem(twice, "sigma_l", &["set twice"]);
    problem(|pass, _| Pass { level: None, ..pass }, "level", &["give the pass a level"]);
}

#[test]
fn a_parameter_comes_from_the_tunable_of_its_name_or_from_what_the_pass_says() {
    let mapped =
        |pass: Pass, _: &Images| pass.value("sigma_l", Value::Tunable("volume_sigma_l")).value("sigma_n", Value::Fixed(0.5));
    let declaration = finish(mapped).expect("it fits");
    let dispatch = declaration.passes()[1].dispatch().expect("a dispatch");
    let of = |name: &str| dispatch.parameters[dispatch.shader.members.iter().position(|m| m.name == name).expect(name)];
    let tuning = Tuning { volume_sigma_l: 7.0, sigma_z: 9.0, ..Tuning::default() };
    let value = |name: &str| match of(name) {
        Parameter::Tuning(index) => f32::from_bits(tuning.bits(index)),
        other => panic!("{name} is {other:?}"),
    };
    assert_eq!((value("sigma_l"), value("sigma_z")), (7.0, 9.0));
    assert_eq!((of("sigma_n"), of("level")), (Parameter::Fixed(0.5_f32.to_bits()), Parameter::Fixed(3)));
    let declaration = finish_with(Images::modulation).expect("it fits");
    assert_eq!(declaration.passes()[1].dispatch().expect("a dispatch").parameters, [Parameter::Present]);
}

#[test]
fn every_tunable_has_an_index_and_bits_that_can_be_set() {
    let tuning = Tuning { tone_curve: crate::ToneCurve::Linear, ..Tuning::default() };
    let mut copy = Tuning { alpha: 0.9, ..Tuning::default() };
    for field in Tuning::FIELDS {
        let index = Tuning::index(field.name).expect(field.name);
        assert_eq!(f32::from_bits(tuning.bits(index)), field.default, "{}", field.name);
        copy.set_bits(index, tuning.bits(index));
    }
    let curve = Tuning::index("tone_curve").expect("a tunable");
    copy.set_bits(curve, tuning.bits(curve));
    assert_eq!((tuning.bits(curve), copy), (2, tuning));
    assert_eq!(Tuning::index("no_such"), None);
}

#[test]
fn a_member_that_is_no_tunable_is_an_error() {
    let mut shader = shaders::ATROUS_SIGNALS_1.clone();
    let members = shader.members.to_mut();
    members[2].name = "sigma_x".into();
    shader.name = "of_a_host".into();
    let shader = Arc::new(shader);
    problem(|pass, _| Pass { shader: shader.into(), ..pass }, "sigma_x", &["comes from `sigma_x`, which is no tunable"]);
    assert_eq!(shaders::ATROUS_SIGNALS_1.members[2].scalar, Scalar::Float);
}

#[test]
fn two_shaders_of_one_name_are_refused() {
    let mut g = Graph::new([16, 16]);
    let images = Images::new(&mut g);
    g.add(images.pass());
    let mut other = shaders::ATROUS_SIGNALS_1.clone();
    other.workgroup = [16, 4, 1];
    g.add(Pass { shader: Arc::new(other).into(), ..images.pass() });
    assert_names(&refusal(g), &["another shader is called `atrous_signals_1`"]);
}
