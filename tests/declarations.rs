//! `uses` against the SPIR-V, read by a second reader that the build does not use.

use ash::vk;
use atrous::config::{GradientSource, PostProcess, Preset, Signals};
use atrous::{Access, Config, PassDecl, PipelineDecl, Shape};
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
        (Preset::Asvgf, GradientSource::ChangeTest),
        (Preset::Stabilize, GradientSource::ForwardProjected),
        (Preset::Percentile, GradientSource::default()),
        (Preset::Fast, GradientSource::default()),
        (Preset::Best, GradientSource::default()),
        (Preset::Best, GradientSource::ChangeTest),
        (Preset::Eaw, GradientSource::default()),
        (Preset::Volume, GradientSource::default()),
    ];
    for (signals, (preset, gradient_source)) in Signals::ALL.into_iter().flat_map(|s| presets.map(|p| (s, p))) {
        for object_normal in [false, true] {
            let post_process = PostProcess::ToneMapTaa;
            let options = Config { debug_view: true, firefly_filter: true, volume: object_normal, ..Config::new([66, 36]) };
            let config = Config { signals, object_normal, post_process, preset, gradient_source, ..options };
            let declaration = config.declare().expect("valid");
            for pass in declaration.passes() {
                let Some(pipeline) = pass.pipeline() else { continue };
                let shapes: Vec<_> = pass.uses.iter().map(|u| declaration.resource(u.resource).shape).collect();
                check(pass, &shapes, &pipeline);
                modules += 1;
            }
        }
    }
    assert!(modules > 40, "{modules}");
}

fn check(pass: &PassDecl, shapes: &[Shape], pipeline: &PipelineDecl<'_>) {
    let module = ShaderModule::load_u8_data(pipeline.spirv).expect("SPIR-V");
    let mut bindings = module.enumerate_descriptor_bindings(None).expect("bindings");
    bindings.sort_by_key(|b| b.binding);
    for block in module.enumerate_push_constant_blocks(None).expect("push constants") {
        assert!(block.size <= 128, "{}: {} bytes of push constants", pass.name, block.size);
        // This reader rounds up, as a uniform block would be.
        assert_eq!(block.size, pipeline.push_bytes.next_multiple_of(16), "{}", pass.name);
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
    for binding in &bindings {
        let (_, ty) = pipeline.bindings.iter().find(|(number, _)| *number == binding.binding).expect(&pass.name);
        let expected = match binding.descriptor_type {
            Kind::SampledImage => vk::DescriptorType::SAMPLED_IMAGE,
            Kind::StorageImage => vk::DescriptorType::STORAGE_IMAGE,
            Kind::StorageBuffer => vk::DescriptorType::STORAGE_BUFFER,
            Kind::UniformBuffer => vk::DescriptorType::UNIFORM_BUFFER,
            other => panic!("{}: {other:?}", pass.name),
        };
        assert!(binding.set == 0 && *ty == expected, "{}: binding {}", pass.name, binding.binding);
    }
    // Bit i of the mask of wired bindings is what stands at binding i.
    for wired in pipeline.constants.iter().filter(|constant| constant.name == "WIRED") {
        assert_eq!(wired.bits, numbers.iter().fold(0, |bits, number| bits | 1 << number), "{}", pass.name);
    }
}
