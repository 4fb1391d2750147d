const _: () = assert!(std::mem::offset_of!(FrameConstants, clip_from_view) == 0);
const _: () = assert!(std::mem::offset_of!(FrameConstants, world_from_clip) == 64);
const _: () = assert!(std::mem::offset_of!(FrameConstants, world_from_view) == 128);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_clip_from_world) == 192);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_view_from_world) == 256);
const _: () = assert!(std::mem::offset_of!(FrameConstants, render_extent) == 320);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_render_extent) == 328);
const _: () = assert!(std::mem::offset_of!(FrameConstants, jitter) == 336);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_jitter) == 344);
const _: () = assert!(std::mem::offset_of!(FrameConstants, frame_index) == 352);
const _: () = assert!(std::mem::offset_of!(FrameConstants, flags) == 356);
const _: () = assert!(std::mem::offset_of!(FrameConstants, exposure_ratio) == 360);
const _: () = assert!(std::mem::offset_of!(FrameConstants, background_depth) == 364);
const _: () = assert!(std::mem::offset_of!(FrameConstants, alpha) == 368);
const _: () = assert!(std::mem::offset_of!(FrameConstants, alpha_moments) == 372);
const _: () = assert!(std::mem::offset_of!(FrameConstants, max_history_length) == 376);
const _: () = assert!(std::mem::offset_of!(FrameConstants, spatial_variance_frames) == 380);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_l) == 384);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_n) == 388);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_z) == 392);
const _: () = assert!(std::mem::offset_of!(FrameConstants, depth_tolerance) == 396);
const _: () = assert!(std::mem::offset_of!(FrameConstants, normal_tolerance) == 400);
const _: () = assert!(std::mem::offset_of!(FrameConstants, edge_falloff) == 404);
const _: () = assert!(std::mem::offset_of!(FrameConstants, percentile_low) == 408);
const _: () = assert!(std::mem::offset_of!(FrameConstants, percentile_up) == 412);
const _: () = assert!(std::mem::offset_of!(FrameConstants, percentile_range) == 416);
const _: () = assert!(std::mem::offset_of!(FrameConstants, adaptivity) == 420);
const _: () = assert!(std::mem::offset_of!(FrameConstants, change_threshold) == 424);
const _: () = assert!(std::mem::offset_of!(FrameConstants, firefly_bias) == 428);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_rt) == 432);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_rt_n) == 436);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_rt_x) == 440);
const _: () = assert!(std::mem::offset_of!(FrameConstants, volume_depth_influence) == 444);
const _: () = assert!(std::mem::offset_of!(FrameConstants, reserved) == 448);
const _: () = assert!(std::mem::offset_of!(FrameConstants, exposure) == 452);
const _: () = assert!(std::mem::offset_of!(FrameConstants, taa_alpha) == 456);
const _: () = assert!(std::mem::offset_of!(FrameConstants, taa_gamma) == 460);
const _: () = assert!(std::mem::offset_of!(FrameConstants, tone_curve) == 464);
pub(crate) static ADAPTIVE_HISTORY_SIGNALS_1_RULE_0: Shader = Shader { name: "adaptive_history_signals_1_rule_0", spirv: include_bytes!("adaptive_history_signals_1_rule_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "history_confidence", kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_percentiles_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static ADAPTIVE_HISTORY_SIGNALS_2_RULE_0: Shader = Shader { name: "adaptive_history_signals_2_rule_0", spirv: include_bytes!("adaptive_history_signals_2_rule_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "history_confidence", kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_percentiles_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "block_percentiles_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_1", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static ADAPTIVE_HISTORY_SIGNALS_1_RULE_1: Shader = Shader { name: "adaptive_history_signals_1_rule_1", spirv: include_bytes!("adaptive_history_signals_1_rule_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "history_confidence", kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "block_difference_0", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static ADAPTIVE_HISTORY_SIGNALS_2_RULE_1: Shader = Shader { name: "adaptive_history_signals_2_rule_1", spirv: include_bytes!("adaptive_history_signals_2_rule_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "history_confidence", kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "block_difference_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_difference_1", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
const _: () = assert!(std::mem::offset_of!(PushConstants, level) == 0);
const _: () = assert!(std::mem::offset_of!(PushConstants, present) == 4);
pub(crate) static ATROUS_SIGNALS_1: Shader = Shader { name: "atrous_signals_1", spirv: include_bytes!("atrous_signals_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "input_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static ATROUS_SIGNALS_2: Shader = Shader { name: "atrous_signals_2", spirv: include_bytes!("atrous_signals_2.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "input_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "input_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static ATROUS_SIGNALS_1_BOX_1: Shader = Shader { name: "atrous_signals_1_box_1", spirv: include_bytes!("atrous_signals_1_box_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "input_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static ATROUS_SIGNALS_2_BOX_1: Shader = Shader { name: "atrous_signals_2_box_1", spirv: include_bytes!("atrous_signals_2_box_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "input_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "input_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static BLOCK_DIFFERENCE: Shader = Shader { name: "block_difference", spirv: include_bytes!("block_difference.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "history", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_difference", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static BLOCK_PERCENTILES: Shader = Shader { name: "block_percentiles", spirv: include_bytes!("block_percentiles.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "block_percentiles", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static DEMODULATE_SIGNALS_1: Shader = Shader { name: "demodulate_signals_1", spirv: include_bytes!("demodulate_signals_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static DEMODULATE_SIGNALS_2: Shader = Shader { name: "demodulate_signals_2", spirv: include_bytes!("demodulate_signals_2.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "noisy_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "irradiance_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static FIREFLY: Shader = Shader { name: "firefly", spirv: include_bytes!("firefly.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_percentiles", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
    ] };
pub(crate) static IMPORT_SURFACE_ID_0_OBJECT_NORMAL_0: Shader = Shader { name: "import_surface_id_0_object_normal_0", spirv: include_bytes!("import_surface_id_0_object_normal_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "depth", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "normal", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "motion", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "roughness", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static IMPORT_SURFACE_ID_1_OBJECT_NORMAL_0: Shader = Shader { name: "import_surface_id_1_object_normal_0", spirv: include_bytes!("import_surface_id_1_object_normal_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "depth", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "normal", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "motion", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "roughness", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_id", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static IMPORT_SURFACE_ID_0_OBJECT_NORMAL_1: Shader = Shader { name: "import_surface_id_0_object_normal_1", spirv: include_bytes!("import_surface_id_0_object_normal_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "depth", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "normal", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "motion", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "roughness", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "object_normal", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "object_normal_guide", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static IMPORT_SURFACE_ID_1_OBJECT_NORMAL_1: Shader = Shader { name: "import_surface_id_1_object_normal_1", spirv: include_bytes!("import_surface_id_1_object_normal_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "depth", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "normal", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "motion", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "roughness", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_id", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "object_normal", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "object_normal_guide", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static MODULATE_SIGNALS_1: Shader = Shader { name: "modulate_signals_1", spirv: include_bytes!("modulate_signals_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "emission", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "denoised_radiance", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "filtered_0", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static MODULATE_SIGNALS_2: Shader = Shader { name: "modulate_signals_2", spirv: include_bytes!("modulate_signals_2.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "emission", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "denoised_radiance", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "filtered_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "filtered_1", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static TAA: Shader = Shader { name: "taa", spirv: include_bytes!("taa.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "tone_mapped", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_history", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "taa_history", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "display", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0: Shader = Shader { name: "temporal_accumulation_signals_1_object_normal_0", spirv: include_bytes!("temporal_accumulation_signals_1_object_normal_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1: Shader = Shader { name: "temporal_accumulation_signals_1_object_normal_1", spirv: include_bytes!("temporal_accumulation_signals_1_object_normal_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "object_normal", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_object_normal", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0: Shader = Shader { name: "temporal_accumulation_signals_2_object_normal_0", spirv: include_bytes!("temporal_accumulation_signals_2_object_normal_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "history_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1: Shader = Shader { name: "temporal_accumulation_signals_2_object_normal_1", spirv: include_bytes!("temporal_accumulation_signals_2_object_normal_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "history_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "object_normal", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_object_normal", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1: Shader = Shader { name: "temporal_accumulation_signals_1_object_normal_0_adaptive_1_repair_1", spirv: include_bytes!("temporal_accumulation_signals_1_object_normal_0_adaptive_1_repair_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "history_confidence", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1: Shader = Shader { name: "temporal_accumulation_signals_1_object_normal_1_adaptive_1_repair_1", spirv: include_bytes!("temporal_accumulation_signals_1_object_normal_1_adaptive_1_repair_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "object_normal", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_object_normal", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_confidence", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1: Shader = Shader { name: "temporal_accumulation_signals_2_object_normal_0_adaptive_1_repair_1", spirv: include_bytes!("temporal_accumulation_signals_2_object_normal_0_adaptive_1_repair_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "history_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "history_confidence", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1: Shader = Shader { name: "temporal_accumulation_signals_2_object_normal_1_adaptive_1_repair_1", spirv: include_bytes!("temporal_accumulation_signals_2_object_normal_1_adaptive_1_repair_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "history_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "object_normal", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_object_normal", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_confidence", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static TONE_MAP: Shader = Shader { name: "tone_map", spirv: include_bytes!("tone_map.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "denoised_radiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "tone_mapped", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static VARIANCE_SIGNALS_1: Shader = Shader { name: "variance_signals_1", spirv: include_bytes!("variance_signals_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "accumulated_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "estimated_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static VARIANCE_SIGNALS_2: Shader = Shader { name: "variance_signals_2", spirv: include_bytes!("variance_signals_2.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "accumulated_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "estimated_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "accumulated_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "moments_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "estimated_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static VARIANCE_SIGNALS_1_FADE_1: Shader = Shader { name: "variance_signals_1_fade_1", spirv: include_bytes!("variance_signals_1_fade_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "accumulated_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "estimated_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static VARIANCE_SIGNALS_2_FADE_1: Shader = Shader { name: "variance_signals_2_fade_1", spirv: include_bytes!("variance_signals_2_fade_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "accumulated_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "estimated_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "accumulated_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "moments_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "estimated_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
#[cfg(test)]
pub(crate) static ALL: &[&Shader] = &[&ADAPTIVE_HISTORY_SIGNALS_1_RULE_0, &ADAPTIVE_HISTORY_SIGNALS_2_RULE_0, &ADAPTIVE_HISTORY_SIGNALS_1_RULE_1, &ADAPTIVE_HISTORY_SIGNALS_2_RULE_1, &ATROUS_SIGNALS_1, &ATROUS_SIGNALS_2, &ATROUS_SIGNALS_1_BOX_1, &ATROUS_SIGNALS_2_BOX_1, &BLOCK_DIFFERENCE, &BLOCK_PERCENTILES, &DEMODULATE_SIGNALS_1, &DEMODULATE_SIGNALS_2, &FIREFLY, &IMPORT_SURFACE_ID_0_OBJECT_NORMAL_0, &IMPORT_SURFACE_ID_1_OBJECT_NORMAL_0, &IMPORT_SURFACE_ID_0_OBJECT_NORMAL_1, &IMPORT_SURFACE_ID_1_OBJECT_NORMAL_1, &MODULATE_SIGNALS_1, &MODULATE_SIGNALS_2, &TAA, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1, &TONE_MAP, &VARIANCE_SIGNALS_1, &VARIANCE_SIGNALS_2, &VARIANCE_SIGNALS_1_FADE_1, &VARIANCE_SIGNALS_2_FADE_1, ];
