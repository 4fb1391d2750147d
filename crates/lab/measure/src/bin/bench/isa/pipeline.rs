//! One pipeline, compiled and asked for its statistics.

use super::device::StatisticsDevice;
use super::report::Shader;
use ash::vk;
use atrous::PipelineDecl;
use std::collections::BTreeMap;
use std::ffi::CStr;

/// Compiles a pipeline as the library does. What is created is left to the end of the process.
pub fn statistics(on: &StatisticsDevice, name: &str, decl: &PipelineDecl<'_>) -> Result<Shader, vk::Result> {
    // SAFETY: the device is live and has the extension; the pipeline is of it, and was made for statistics and representations.
    unsafe {
        let pipeline = create(&on.device, decl)?;
        let info = vk::PipelineExecutableInfoKHR::default().pipeline(pipeline);
        let mut statistics = BTreeMap::new();
        for statistic in on.executables.get_pipeline_executable_statistics(&info)? {
            let name = statistic.name_as_c_str().map_or_else(|_| String::new(), |c| c.to_string_lossy().into_owned());
            let value = match statistic.format {
                vk::PipelineExecutableStatisticFormatKHR::BOOL32 => f64::from(statistic.value.b32),
                vk::PipelineExecutableStatisticFormatKHR::INT64 => statistic.value.i64 as f64,
                vk::PipelineExecutableStatisticFormatKHR::UINT64 => statistic.value.u64 as f64,
                _ => statistic.value.f64,
            };
            // Of a pipeline with several executables the first one is shown.
            statistics.entry(name).or_insert(value);
        }
        let loops = loops_of_nir(&representations(on, &info)?).unwrap_or_else(|| loops_of_spirv(decl.spirv));
        Ok(Shader { name: name.to_owned(), loops, statistics })
    }
}

/// # Safety
/// The device is live, and the declaration is one of a graph.
unsafe fn create(device: &ash::Device, decl: &PipelineDecl<'_>) -> Result<vk::Pipeline, vk::Result> {
    let binding = |&(number, ty): &(u32, vk::DescriptorType)| {
        let binding = vk::DescriptorSetLayoutBinding::default().binding(number).descriptor_type(ty).descriptor_count(1);
        binding.stage_flags(vk::ShaderStageFlags::COMPUTE)
    };
    let bindings: Vec<_> = decl.bindings.iter().map(binding).collect();
    let entry = |(i, constant): (usize, &atrous::PipelineConstant<'_>)| vk::SpecializationMapEntry {
        constant_id: constant.id,
        offset: 4 * i as u32,
        size: 4,
    };
    let entries: Vec<_> = decl.constants.iter().enumerate().map(entry).collect();
    let values: Vec<u8> = decl.constants.iter().flat_map(|constant| constant.bits.to_ne_bytes()).collect();
    let specialisation = vk::SpecializationInfo::default().map_entries(&entries).data(&values);
    let code: Vec<u32> = decl.spirv.chunks_exact(4).map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect();
    let ranges = [vk::PushConstantRange::default().stage_flags(vk::ShaderStageFlags::COMPUTE).size(decl.push_bytes)];
    // SAFETY: the device is live, the code is valid with these bindings, and every info refers to locals.
    unsafe {
        let layouts =
            [device.create_descriptor_set_layout(&vk::DescriptorSetLayoutCreateInfo::default().bindings(&bindings), None)?];
        let info = vk::PipelineLayoutCreateInfo::default().set_layouts(&layouts);
        let info = if decl.push_bytes > 0 { info.push_constant_ranges(&ranges) } else { info };
        let layout = device.create_pipeline_layout(&info, None)?;
        let module = device.create_shader_module(&vk::ShaderModuleCreateInfo::default().code(&code), None)?;
        let stage = vk::PipelineShaderStageCreateInfo::default()
            .stage(vk::ShaderStageFlags::COMPUTE)
            .module(module)
            .name(c"main")
            .specialization_info(&specialisation);
        let flags = vk::PipelineCreateFlags::CAPTURE_STATISTICS_KHR | vk::PipelineCreateFlags::CAPTURE_INTERNAL_REPRESENTATIONS_KHR;
        let info = vk::ComputePipelineCreateInfo::default().flags(flags).layout(layout).stage(stage);
        let pipelines = device.create_compute_pipelines(vk::PipelineCache::null(), &[info], None).map_err(|(_, result)| result)?;
        Ok(pipelines.first().copied().unwrap_or_default())
    }
}

/// The texts that the driver has of the code on its way, by name.
///
/// # Safety
/// The pipeline is live, and was made with `CAPTURE_INTERNAL_REPRESENTATIONS`.
unsafe fn representations(
    on: &StatisticsDevice,
    info: &vk::PipelineExecutableInfoKHR<'_>,
) -> Result<Vec<(String, String)>, vk::Result> {
    let ask = on.executables.fp().get_pipeline_executable_internal_representations_khr;
    let mut count = 0;
    // SAFETY: the first call gives the count, the second one sizes, the third one texts, for which there is room then.
    unsafe {
        ask(on.device.handle(), info, &mut count, std::ptr::null_mut()).result()?;
        let mut found = vec![vk::PipelineExecutableInternalRepresentationKHR::default(); count as usize];
        ask(on.device.handle(), info, &mut count, found.as_mut_ptr()).result()?;
        let mut texts: Vec<Vec<u8>> = found.iter().map(|r| vec![0; r.data_size]).collect();
        for (representation, text) in found.iter_mut().zip(&mut texts) {
            representation.p_data = text.as_mut_ptr().cast();
        }
        ask(on.device.handle(), info, &mut count, found.as_mut_ptr()).result()?;
        let text = |(representation, bytes): (&vk::PipelineExecutableInternalRepresentationKHR<'_>, &Vec<u8>)| {
            let name = representation.name_as_c_str().map_or_else(|_| String::new(), |c| c.to_string_lossy().into_owned());
            let text = CStr::from_bytes_until_nul(bytes).map_or_else(|_| String::new(), |c| c.to_string_lossy().into_owned());
            (name, text)
        };
        Ok(found.iter().zip(&texts).map(text).collect())
    }
}

/// Loops that Mesa's compiler left, `None` where there is no text of it.
fn loops_of_nir(representations: &[(String, String)]) -> Option<u32> {
    let (_, nir) = representations.iter().find(|(name, text)| name.contains("NIR") && !text.is_empty())?;
    Some(nir.lines().filter(|line| line.trim_start().starts_with("loop {")).count() as u32)
}

/// Loops in the module, of which a driver may unroll some.
fn loops_of_spirv(spirv: &[u8]) -> u32 {
    const LOOP_MERGE: u32 = 246;
    let words: Vec<u32> = spirv.chunks_exact(4).map(|b| u32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect();
    let (mut at, mut loops) = (5, 0);
    while let Some(head) = words.get(at) {
        loops += u32::from(head & 0xffff == LOOP_MERGE);
        at += ((head >> 16) as usize).max(1);
    }
    loops
}
