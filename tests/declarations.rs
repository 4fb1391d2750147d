//! `uses` against the SPIR-V, read by a second reader that the build does not use.

use atrous::config::{GradientSource, PostProcess, Preset, Signals};
use atrous::{Access, Config, PassDecl, Shape};
use atrous_harness::DeviceTest;
use spirv_reflect::types::ReflectDescriptorType as Kind;
use spirv_reflect::ShaderModule;

pub const TESTS: &[DeviceTest] = &[("uses_equal_the_spirv_by_a_second_reader", uses_equal_the_spirv_by_a_second_reader)];

fn uses_equal_the_spirv_by_a_second_reader() {
    let mut modules = 0;
    let presets = [
        (Preset::Svgf, GradientSource::default()),
        (Preset::Asvgf, GradientSource::ForwardProjected),
        (Preset::Asvgf, GradientSource::Reshaded),
        (Preset::Asvgf, GradientSource::Sparse),
        (Preset::Asvgf, GradientSource::Confidence),
        (Preset::Stabilize, GradientSource::ForwardProjected),
        (Preset::Percentile, GradientSource::default()),
        (Preset::Eaw, GradientSource::default()),
        (Preset::Volume, GradientSource::default()),
    ];
    for (signals, (preset, gradient_source)) in
        [Signals::Together, Signals::Apart].into_iter().flat_map(|s| presets.map(|p| (s, p)))
    {
        for object_normal in [false, true] {
            let post_process = PostProcess::ToneMapTaa;
            let options = Config { debug_view: true, firefly_filter: true, volume: object_normal, ..Config::new([64, 36]) };
            let config = Config { signals, object_normal, post_process, preset, gradient_source, ..options };
            let declaration = config.declare().expect("valid");
            for pass in declaration.passes() {
                let Some(spirv) = pass.spirv() else { continue };
                let shapes: Vec<_> = pass.uses.iter().map(|u| declaration.resource(u.resource).shape).collect();
                check(pass, &shapes, spirv);
                modules += 1;
            }
        }
    }
    assert!(modules > 40, "{modules}");
}

fn check(pass: &PassDecl, shapes: &[Shape], spirv: &[u8]) {
    let module = ShaderModule::load_u8_data(spirv).expect("SPIR-V");
    let mut bindings = module.enumerate_descriptor_bindings(None).expect("bindings");
    bindings.sort_by_key(|b| b.binding);
    for block in module.enumerate_push_constant_blocks(None).expect("push constants") {
        assert!(block.size <= 128, "{}: {} bytes of push constants", pass.name, block.size);
    }
    let numbers: Vec<u32> = pass.bindings().map(|(number, _)| number).collect();
    assert_eq!(numbers.len(), pass.uses.len(), "{}", pass.name);
    for number in &numbers {
        // The optimiser may drop a binding that a variant does not read, but never add or move one; an optional one may be unwired.
        let Some(binding) = bindings.iter().find(|b| b.binding == *number) else { continue };
        let place = numbers.iter().position(|n| n == number).expect("a use");
        let image = matches!(shapes[place], Shape::Image { .. });
        let expected = match (pass.uses[place].access, image) {
            (Access::Sampled, true) => Kind::SampledImage,
            (Access::StorageRead | Access::StorageWrite | Access::StorageReadWrite, true) => Kind::StorageImage,
            (Access::StorageRead | Access::StorageWrite | Access::StorageReadWrite, false) => Kind::StorageBuffer,
            (Access::Uniform, false) => Kind::UniformBuffer,
            (access, image) => panic!("{}: {access:?} of an image: {image}", pass.name),
        };
        assert!(binding.set == 0 && binding.descriptor_type == expected, "{}: binding {number}", pass.name);
    }
    assert!(bindings.iter().all(|b| b.set == 0), "{}", pass.name);
}
