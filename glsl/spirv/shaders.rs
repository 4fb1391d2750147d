const _: () = assert!(std::mem::offset_of!(FrameConstants, clip_from_view) == 0);
const _: () = assert!(std::mem::offset_of!(FrameConstants, world_from_clip) == 64);
const _: () = assert!(std::mem::offset_of!(FrameConstants, world_from_view) == 128);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_clip_from_world) == 192);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_view_from_world) == 256);
const _: () = assert!(std::mem::offset_of!(FrameConstants, world_from_previous_sample) == 320);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sample_from_world) == 384);
const _: () = assert!(std::mem::offset_of!(FrameConstants, render_extent) == 448);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_render_extent) == 456);
const _: () = assert!(std::mem::offset_of!(FrameConstants, jitter) == 464);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_jitter) == 472);
const _: () = assert!(std::mem::offset_of!(FrameConstants, frame_index) == 480);
const _: () = assert!(std::mem::offset_of!(FrameConstants, flags) == 484);
const _: () = assert!(std::mem::offset_of!(FrameConstants, exposure_ratio) == 488);
const _: () = assert!(std::mem::offset_of!(FrameConstants, background_depth) == 492);
const _: () = assert!(std::mem::offset_of!(FrameConstants, alpha) == 496);
const _: () = assert!(std::mem::offset_of!(FrameConstants, alpha_moments) == 500);
const _: () = assert!(std::mem::offset_of!(FrameConstants, max_history_length) == 504);
const _: () = assert!(std::mem::offset_of!(FrameConstants, spatial_variance_frames) == 508);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_l) == 512);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_n) == 516);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_z) == 520);
const _: () = assert!(std::mem::offset_of!(FrameConstants, depth_tolerance) == 524);
const _: () = assert!(std::mem::offset_of!(FrameConstants, normal_tolerance) == 528);
const _: () = assert!(std::mem::offset_of!(FrameConstants, edge_falloff) == 532);
const _: () = assert!(std::mem::offset_of!(FrameConstants, percentile_low) == 536);
const _: () = assert!(std::mem::offset_of!(FrameConstants, percentile_up) == 540);
const _: () = assert!(std::mem::offset_of!(FrameConstants, percentile_range) == 544);
const _: () = assert!(std::mem::offset_of!(FrameConstants, adaptivity) == 548);
const _: () = assert!(std::mem::offset_of!(FrameConstants, change_threshold) == 552);
const _: () = assert!(std::mem::offset_of!(FrameConstants, firefly_bias) == 556);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_rt) == 560);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_rt_n) == 564);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sigma_rt_x) == 568);
const _: () = assert!(std::mem::offset_of!(FrameConstants, volume_alpha) == 572);
const _: () = assert!(std::mem::offset_of!(FrameConstants, volume_sigma_l) == 576);
const _: () = assert!(std::mem::offset_of!(FrameConstants, volume_sigma_z) == 580);
const _: () = assert!(std::mem::offset_of!(FrameConstants, volume_depth_tolerance) == 584);
const _: () = assert!(std::mem::offset_of!(FrameConstants, exposure) == 588);
const _: () = assert!(std::mem::offset_of!(FrameConstants, taa_alpha) == 592);
const _: () = assert!(std::mem::offset_of!(FrameConstants, taa_gamma) == 596);
const _: () = assert!(std::mem::offset_of!(FrameConstants, tone_curve) == 600);
const _: () = assert!(std::mem::offset_of!(FrameConstants, stratum_size) == 604);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_clip_w_scale) == 608);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_clip_w_offset) == 612);
const _: () = assert!(std::mem::offset_of!(FrameConstants, gradient_scale) == 616);
pub(crate) static ADAPTIVE_ALPHA_SOURCE_0: Shader = Shader { name: "adaptive_alpha_source_0", spirv: include_bytes!("adaptive_alpha_source_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "gradient", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "history_confidence", kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static ADAPTIVE_ALPHA_SOURCE_1: Shader = Shader { name: "adaptive_alpha_source_1", spirv: include_bytes!("adaptive_alpha_source_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "confidence", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "history_confidence", kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly) },
    ] };
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
pub(crate) static ATROUS_SIGNALS_1_VOLUME_1: Shader = Shader { name: "atrous_signals_1_volume_1", spirv: include_bytes!("atrous_signals_1_volume_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "input_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
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
pub(crate) static BLOCK_PERCENTILES_VOLUME_0: Shader = Shader { name: "block_percentiles_volume_0", spirv: include_bytes!("block_percentiles_volume_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "block_percentiles", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static BLOCK_PERCENTILES_VOLUME_1: Shader = Shader { name: "block_percentiles_volume_1", spirv: include_bytes!("block_percentiles_volume_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "irradiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "block_percentiles", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static DEBUG_VIEW: Shader = Shader { name: "debug_view", spirv: include_bytes!("debug_view.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "moments_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_percentiles_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_percentiles_1", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "history_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "history_confidence", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "debug_view", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
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
pub(crate) static EAW_SIGNALS_1: Shader = Shader { name: "eaw_signals_1", spirv: include_bytes!("eaw_signals_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "input_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static EAW_SIGNALS_2: Shader = Shader { name: "eaw_signals_2", spirv: include_bytes!("eaw_signals_2.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "input_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "input_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "output_1", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static FIREFLY_VOLUME_0: Shader = Shader { name: "firefly_volume_0", spirv: include_bytes!("firefly_volume_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "block_percentiles", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
    ] };
pub(crate) static FIREFLY_VOLUME_1: Shader = Shader { name: "firefly_volume_1", spirv: include_bytes!("firefly_volume_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "block_percentiles", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
    ] };
pub(crate) static FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_0: Shader = Shader { name: "forward_project_resolve_0_forward_motion_0", spirv: include_bytes!("forward_project_resolve_0_forward_motion_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_candidates", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "claims", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadWrite) },
    ] };
pub(crate) static FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_1: Shader = Shader { name: "forward_project_resolve_0_forward_motion_1", spirv: include_bytes!("forward_project_resolve_0_forward_motion_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_candidates", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "forward_motion", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "claims", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadWrite) },
    ] };
pub(crate) static FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0_SURFACE_ID_0: Shader = Shader { name: "forward_project_resolve_1_forward_motion_0_surface_id_0", spirv: include_bytes!("forward_project_resolve_1_forward_motion_0_surface_id_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_candidates", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "claims", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "gradient_samples", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "candidates", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0_SURFACE_ID_1: Shader = Shader { name: "forward_project_resolve_1_forward_motion_0_surface_id_1", spirv: include_bytes!("forward_project_resolve_1_forward_motion_0_surface_id_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_candidates", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "claims", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "gradient_samples", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "candidates", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_id", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1_SURFACE_ID_0: Shader = Shader { name: "forward_project_resolve_1_forward_motion_1_surface_id_0", spirv: include_bytes!("forward_project_resolve_1_forward_motion_1_surface_id_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_candidates", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "forward_motion", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "claims", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "gradient_samples", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "candidates", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1_SURFACE_ID_1: Shader = Shader { name: "forward_project_resolve_1_forward_motion_1_surface_id_1", spirv: include_bytes!("forward_project_resolve_1_forward_motion_1_surface_id_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_candidates", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "instance_transforms", kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly) },
        ShaderBinding { name: "forward_motion", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "claims", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "gradient_samples", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "candidates", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "surface_id", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static GRADIENT_SIGNALS_1_SOURCE_0: Shader = Shader { name: "gradient_signals_1_source_0", spirv: include_bytes!("gradient_signals_1_source_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "gradient_guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "noisy_luminance", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "previous_luminance", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "gradient_samples", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static GRADIENT_SIGNALS_2_SOURCE_0: Shader = Shader { name: "gradient_signals_2_source_0", spirv: include_bytes!("gradient_signals_2_source_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "gradient_guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "noisy_luminance", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "previous_luminance", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "gradient_samples", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static GRADIENT_SIGNALS_1_SOURCE_1: Shader = Shader { name: "gradient_signals_1_source_1", spirv: include_bytes!("gradient_signals_1_source_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "gradient_guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "noisy_luminance", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "previous_luminance", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "reshaded_radiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static GRADIENT_SIGNALS_2_SOURCE_1: Shader = Shader { name: "gradient_signals_2_source_1", spirv: include_bytes!("gradient_signals_2_source_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "gradient_guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "noisy_luminance", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "previous_luminance", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "reshaded_radiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
    ] };
pub(crate) static GRADIENT_SIGNALS_1_SOURCE_2: Shader = Shader { name: "gradient_signals_1_source_2", spirv: include_bytes!("gradient_signals_1_source_2.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "gradient_guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "sparse_gradient", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static GRADIENT_SIGNALS_2_SOURCE_2: Shader = Shader { name: "gradient_signals_2_source_2", spirv: include_bytes!("gradient_signals_2_source_2.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "albedo", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "noisy_1", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "gradient_guide", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
        ShaderBinding { name: "sparse_gradient", kind: BindingKind::SampledImage(Component::Float) },
    ] };
pub(crate) static GRADIENT_ATROUS: Shader = Shader { name: "gradient_atrous", spirv: include_bytes!("gradient_atrous.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "gradient_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "depth_gradient", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "gradient_in", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "gradient_out", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
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
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1: Shader = Shader { name: "temporal_accumulation_signals_1_object_normal_0_adaptive_1", spirv: include_bytes!("temporal_accumulation_signals_1_object_normal_0_adaptive_1.spv"),
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
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1: Shader = Shader { name: "temporal_accumulation_signals_1_object_normal_1_adaptive_1", spirv: include_bytes!("temporal_accumulation_signals_1_object_normal_1_adaptive_1.spv"),
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
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1: Shader = Shader { name: "temporal_accumulation_signals_2_object_normal_0_adaptive_1", spirv: include_bytes!("temporal_accumulation_signals_2_object_normal_0_adaptive_1.spv"),
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
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1: Shader = Shader { name: "temporal_accumulation_signals_2_object_normal_1_adaptive_1", spirv: include_bytes!("temporal_accumulation_signals_2_object_normal_1_adaptive_1.spv"),
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
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_VOLUME_1: Shader = Shader { name: "temporal_accumulation_signals_1_object_normal_0_volume_1", spirv: include_bytes!("temporal_accumulation_signals_1_object_normal_0_volume_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "previous_guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "volume_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "history_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "previous_moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "irradiance_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite) },
        ShaderBinding { name: "moments_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static TONE_MAP_VOLUME_0: Shader = Shader { name: "tone_map_volume_0", spirv: include_bytes!("tone_map_volume_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "denoised_radiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "tone_mapped", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static TONE_MAP_VOLUME_1: Shader = Shader { name: "tone_map_volume_1", spirv: include_bytes!("tone_map_volume_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "denoised_radiance", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "denoised_volume", kind: BindingKind::SampledImage(Component::Float) },
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
pub(crate) static VARIANCE_SIGNALS_1_FADE_1_VOLUME_1: Shader = Shader { name: "variance_signals_1_fade_1_volume_1", spirv: include_bytes!("variance_signals_1_fade_1_volume_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "accumulated_0", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "moments_0", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "estimated_0", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
    ] };
pub(crate) static VOLUME_MOTION_RESOLVE_0: Shader = Shader { name: "volume_motion_resolve_0", spirv: include_bytes!("volume_motion_resolve_0.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "previous_points", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "guide", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "claims", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadWrite) },
    ] };
pub(crate) static VOLUME_MOTION_RESOLVE_1: Shader = Shader { name: "volume_motion_resolve_1", spirv: include_bytes!("volume_motion_resolve_1.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "previous_points", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "surface_motion", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "claims", kind: BindingKind::SampledImage(Component::Uint) },
        ShaderBinding { name: "volume_motion", kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly) },
    ] };
pub(crate) static VOLUME_POINTS: Shader = Shader { name: "volume_points", spirv: include_bytes!("volume_points.spv"),
    bindings: &[
        ShaderBinding { name: "frame", kind: BindingKind::UniformBuffer },
        ShaderBinding { name: "statistics", kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite) },
        ShaderBinding { name: "noisy_volume", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "scattering_depth", kind: BindingKind::SampledImage(Component::Float) },
        ShaderBinding { name: "radiance", kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly) },
        ShaderBinding { name: "volume_points", kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly) },
    ] };
#[cfg(test)]
pub(crate) static ALL: &[&Shader] = &[&ADAPTIVE_ALPHA_SOURCE_0, &ADAPTIVE_ALPHA_SOURCE_1, &ADAPTIVE_HISTORY_SIGNALS_1_RULE_0, &ADAPTIVE_HISTORY_SIGNALS_2_RULE_0, &ADAPTIVE_HISTORY_SIGNALS_1_RULE_1, &ADAPTIVE_HISTORY_SIGNALS_2_RULE_1, &ATROUS_SIGNALS_1, &ATROUS_SIGNALS_2, &ATROUS_SIGNALS_1_BOX_1, &ATROUS_SIGNALS_2_BOX_1, &ATROUS_SIGNALS_1_VOLUME_1, &BLOCK_DIFFERENCE, &BLOCK_PERCENTILES_VOLUME_0, &BLOCK_PERCENTILES_VOLUME_1, &DEBUG_VIEW, &DEMODULATE_SIGNALS_1, &DEMODULATE_SIGNALS_2, &EAW_SIGNALS_1, &EAW_SIGNALS_2, &FIREFLY_VOLUME_0, &FIREFLY_VOLUME_1, &FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_0, &FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_1, &FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0_SURFACE_ID_0, &FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0_SURFACE_ID_1, &FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1_SURFACE_ID_0, &FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1_SURFACE_ID_1, &GRADIENT_SIGNALS_1_SOURCE_0, &GRADIENT_SIGNALS_2_SOURCE_0, &GRADIENT_SIGNALS_1_SOURCE_1, &GRADIENT_SIGNALS_2_SOURCE_1, &GRADIENT_SIGNALS_1_SOURCE_2, &GRADIENT_SIGNALS_2_SOURCE_2, &GRADIENT_ATROUS, &IMPORT_SURFACE_ID_0_OBJECT_NORMAL_0, &IMPORT_SURFACE_ID_1_OBJECT_NORMAL_0, &IMPORT_SURFACE_ID_0_OBJECT_NORMAL_1, &IMPORT_SURFACE_ID_1_OBJECT_NORMAL_1, &MODULATE_SIGNALS_1, &MODULATE_SIGNALS_2, &TAA, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_0_ADAPTIVE_1_REPAIR_1, &TEMPORAL_ACCUMULATION_SIGNALS_2_OBJECT_NORMAL_1_ADAPTIVE_1_REPAIR_1, &TEMPORAL_ACCUMULATION_SIGNALS_1_OBJECT_NORMAL_0_VOLUME_1, &TONE_MAP_VOLUME_0, &TONE_MAP_VOLUME_1, &VARIANCE_SIGNALS_1, &VARIANCE_SIGNALS_2, &VARIANCE_SIGNALS_1_FADE_1, &VARIANCE_SIGNALS_2_FADE_1, &VARIANCE_SIGNALS_1_FADE_1_VOLUME_1, &VOLUME_MOTION_RESOLVE_0, &VOLUME_MOTION_RESOLVE_1, &VOLUME_POINTS, ];
