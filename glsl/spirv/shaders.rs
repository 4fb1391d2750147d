const _: () = assert!(std::mem::offset_of!(FrameConstants, background_depth) == 428);
const _: () = assert!(std::mem::offset_of!(FrameConstants, clip_from_view) == 0);
const _: () = assert!(std::mem::offset_of!(FrameConstants, exposure_ratio) == 424);
const _: () = assert!(std::mem::offset_of!(FrameConstants, eye) == 448);
const _: () = assert!(std::mem::offset_of!(FrameConstants, filter_exposure) == 440);
const _: () = assert!(std::mem::offset_of!(FrameConstants, flags) == 420);
const _: () = assert!(std::mem::offset_of!(FrameConstants, frame_index) == 416);
const _: () = assert!(std::mem::offset_of!(FrameConstants, guide_extent) == 864);
const _: () = assert!(std::mem::offset_of!(FrameConstants, guide_jitter) == 880);
const _: () = assert!(std::mem::offset_of!(FrameConstants, inverse_filter_exposure) == 444);
const _: () = assert!(std::mem::offset_of!(FrameConstants, jitter) == 400);
const _: () = assert!(std::mem::offset_of!(FrameConstants, light_offset) == 904);
const _: () = assert!(std::mem::offset_of!(FrameConstants, light_ratio) == 896);
const _: () = assert!(std::mem::offset_of!(FrameConstants, lights) == 464);
const _: () = assert!(std::mem::offset_of!(FrameConstants, materials) == 592);
const _: () = assert!(std::mem::offset_of!(FrameConstants, motion_scale) == 920);
const _: () = assert!(std::mem::offset_of!(FrameConstants, output_extent) == 848);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_clip_from_world) == 128);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_clip_w_offset) == 436);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_clip_w_scale) == 432);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_guide_extent) == 872);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_guide_jitter) == 888);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_jitter) == 408);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_lights) == 528);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_output_extent) == 856);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_render_extent) == 392);
const _: () = assert!(std::mem::offset_of!(FrameConstants, previous_view_from_world) == 192);
const _: () = assert!(std::mem::offset_of!(FrameConstants, render_extent) == 384);
const _: () = assert!(std::mem::offset_of!(FrameConstants, sample_from_world) == 320);
const _: () = assert!(std::mem::offset_of!(FrameConstants, viewport_origin) == 912);
const _: () = assert!(std::mem::offset_of!(FrameConstants, world_from_previous_sample) == 256);
const _: () = assert!(std::mem::offset_of!(FrameConstants, world_from_view) == 64);
pub(crate) static ATROUS_SIGNALS_1: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_1"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static ATROUS_SIGNALS_2: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_2"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_2.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("input_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("output_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static ATROUS_SIGNALS_1_SPECULAR_1: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_1_specular_1"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_1_specular_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("reflection"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("specular_blur"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static ATROUS_SIGNALS_2_SPECULAR_1: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_2_specular_1"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_2_specular_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("input_1"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("output_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("reflection"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("specular_blur"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static ATROUS_SIGNALS_1_MATERIAL_1: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_1_material_1"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_1_material_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("material_class"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static ATROUS_SIGNALS_2_MATERIAL_1: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_2_material_1"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_2_material_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("input_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("output_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("material_class"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static ATROUS_SIGNALS_1_SPECULAR_1_MATERIAL_1: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_1_specular_1_material_1"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_1_specular_1_material_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("reflection"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("material_class"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("specular_blur"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static ATROUS_SIGNALS_2_SPECULAR_1_MATERIAL_1: Shader = Shader {
    stage: Cow::Borrowed("atrous"), name: Cow::Borrowed("atrous_signals_2_specular_1_material_1"), spirv: Cow::Borrowed(include_bytes!("atrous_signals_2_specular_1_material_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("input_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("input_1"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("output_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("reflection"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("material_class"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("specular_blur"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("KERNEL"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OURS"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 5, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static BLOCK_DIFFERENCE: Shader = Shader {
    stage: Cow::Borrowed("block_difference"), name: Cow::Borrowed("block_difference"), spirv: Cow::Borrowed(include_bytes!("block_difference.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("irradiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("previous_luminance_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("block_difference"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 0, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
    ]),
};
pub(crate) static BLOCK_PERCENTILES: Shader = Shader {
    stage: Cow::Borrowed("block_percentiles"), name: Cow::Borrowed("block_percentiles"), spirv: Cow::Borrowed(include_bytes!("block_percentiles.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("block_percentiles_0"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("irradiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("block_percentiles_1"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("percentile_low"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("percentile_up"), offset: 8, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 1, scalar: Scalar::Bool, default: 0 },
    ]),
};
pub(crate) static CHANGE_TEST_RATIO_0: Shader = Shader {
    stage: Cow::Borrowed("change_test"), name: Cow::Borrowed("change_test_ratio_0"), spirv: Cow::Borrowed(include_bytes!("change_test_ratio_0.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("history_confidence"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("block_difference_0"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("block_difference_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("steadiness"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("adaptivity"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("change_threshold"), offset: 8, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("BOTH"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static CHANGE_TEST_RATIO_1: Shader = Shader {
    stage: Cow::Borrowed("change_test"), name: Cow::Borrowed("change_test_ratio_1"), spirv: Cow::Borrowed(include_bytes!("change_test_ratio_1.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("history_confidence"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("block_difference_0"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("block_difference_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("steadiness"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("light_ratio"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("adaptivity"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("change_threshold"), offset: 8, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("BOTH"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static CLEAR_CLAIMS: Shader = Shader {
    stage: Cow::Borrowed("clear_claims"), name: Cow::Borrowed("clear_claims"), spirv: Cow::Borrowed(include_bytes!("clear_claims.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("claims"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
    ]),
};
pub(crate) static DEBUG_VIEW: Shader = Shader {
    stage: Cow::Borrowed("debug_view"), name: Cow::Borrowed("debug_view"), spirv: Cow::Borrowed(include_bytes!("debug_view.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("luminance_history_0"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("luminance_history_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("block_percentiles_0"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("block_percentiles_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("history_0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("history_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("history_confidence"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("gradient"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("noisy_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("noisy_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("debug_view"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 16, name: Cow::Borrowed("reflection"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 17, name: Cow::Borrowed("visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 18, name: Cow::Borrowed("firefly_limits_0"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 19, name: Cow::Borrowed("firefly_limits_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 20, name: Cow::Borrowed("specular_hit_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 21, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 22, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 23, name: Cow::Borrowed("specular_motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("view"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("present"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("alpha"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static DEMODULATE_LUMINANCE_0: Shader = Shader {
    stage: Cow::Borrowed("demodulate"), name: Cow::Borrowed("demodulate_luminance_0"), spirv: Cow::Borrowed(include_bytes!("demodulate_luminance_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("noisy_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("noisy_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("irradiance_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("specular_f0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("specular_hit_distance"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 8, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SAMPLING"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("COAT"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static DEMODULATE_LUMINANCE_1: Shader = Shader {
    stage: Cow::Borrowed("demodulate"), name: Cow::Borrowed("demodulate_luminance_1"), spirv: Cow::Borrowed(include_bytes!("demodulate_luminance_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("noisy_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("noisy_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("irradiance_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("noisy_luminance"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("compared_0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("compared_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("noisy_red_blue"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("specular_f0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("specular_hit_distance"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("candidates"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 8, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SAMPLING"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("COAT"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static EAW_SIGNALS_1: Shader = Shader {
    stage: Cow::Borrowed("eaw"), name: Cow::Borrowed("eaw_signals_1"), spirv: Cow::Borrowed(include_bytes!("eaw_signals_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("eaw_sigma_radiance"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("eaw_sigma_normal"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("eaw_sigma_position"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("RADIANCE"), id: 1, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("NORMAL"), id: 2, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("POSITION"), id: 3, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("SAMPLING"), id: 4, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static EAW_SIGNALS_2: Shader = Shader {
    stage: Cow::Borrowed("eaw"), name: Cow::Borrowed("eaw_signals_2"), spirv: Cow::Borrowed(include_bytes!("eaw_signals_2.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("input_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("output_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("input_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("output_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("eaw_sigma_radiance"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("eaw_sigma_normal"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("eaw_sigma_position"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("RADIANCE"), id: 1, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("NORMAL"), id: 2, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("POSITION"), id: 3, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("SAMPLING"), id: 4, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static FILL_HOLES: Shader = Shader {
    stage: Cow::Borrowed("fill_holes"), name: Cow::Borrowed("fill_holes"), spirv: Cow::Borrowed(include_bytes!("fill_holes.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("holed"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("filled"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("RADIUS"), id: 1, scalar: Scalar::Int, default: 1 },
    ]),
};
pub(crate) static FILTER_EXPOSURE: Shader = Shader {
    stage: Cow::Borrowed("filter_exposure"), name: Cow::Borrowed("filter_exposure"), spirv: Cow::Borrowed(include_bytes!("filter_exposure.spv")), workgroup: [128, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("previous_exposure"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("noisy_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("noisy_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("noisy_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("exposure"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static FIREFLY_DIFFERENCE_0: Shader = Shader {
    stage: Cow::Borrowed("firefly"), name: Cow::Borrowed("firefly_difference_0"), spirv: Cow::Borrowed(include_bytes!("firefly_difference_0.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("firefly_limits"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("irradiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("firefly_spread"), offset: 0, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 2, scalar: Scalar::Bool, default: 0 },
    ]),
};
pub(crate) static FIREFLY_DIFFERENCE_1: Shader = Shader {
    stage: Cow::Borrowed("firefly"), name: Cow::Borrowed("firefly_difference_1"), spirv: Cow::Borrowed(include_bytes!("firefly_difference_1.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("firefly_limits"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("irradiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("history"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("previous_luminance_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("block_difference"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 10, name: Cow::Borrowed("block_percentiles"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("previous_firefly_limits"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("firefly_spread"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("percentile_range"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("firefly_bias"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 2, scalar: Scalar::Bool, default: 0 },
    ]),
};
pub(crate) static FIREFLY_LIMITS_RETURNING_0: Shader = Shader {
    stage: Cow::Borrowed("firefly_limits"), name: Cow::Borrowed("firefly_limits_returning_0"), spirv: Cow::Borrowed(include_bytes!("firefly_limits_returning_0.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("firefly_limits"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("block_percentiles"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("irradiance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("percentile_range"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("firefly_bias"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
    ]),
};
pub(crate) static FIREFLY_LIMITS_RETURNING_1: Shader = Shader {
    stage: Cow::Borrowed("firefly_limits"), name: Cow::Borrowed("firefly_limits_returning_1"), spirv: Cow::Borrowed(include_bytes!("firefly_limits_returning_1.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("firefly_limits"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("block_percentiles"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("irradiance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("previous_firefly_limits"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("percentile_range"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("firefly_bias"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 8, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
    ]),
};
pub(crate) static FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_0: Shader = Shader {
    stage: Cow::Borrowed("forward_project"), name: Cow::Borrowed("forward_project_resolve_0_forward_motion_0"), spirv: Cow::Borrowed(include_bytes!("forward_project_resolve_0_forward_motion_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("previous_candidates"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("claims"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadWrite), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_1: Shader = Shader {
    stage: Cow::Borrowed("forward_project"), name: Cow::Borrowed("forward_project_resolve_0_forward_motion_1"), spirv: Cow::Borrowed(include_bytes!("forward_project_resolve_0_forward_motion_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("previous_candidates"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("claims"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("forward_motion"), kind: BindingKind::SampledImage(Component::Float), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0: Shader = Shader {
    stage: Cow::Borrowed("forward_project"), name: Cow::Borrowed("forward_project_resolve_1_forward_motion_0"), spirv: Cow::Borrowed(include_bytes!("forward_project_resolve_1_forward_motion_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("previous_candidates"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("claims"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("gradient_samples"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("candidates"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 10, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1: Shader = Shader {
    stage: Cow::Borrowed("forward_project"), name: Cow::Borrowed("forward_project_resolve_1_forward_motion_1"), spirv: Cow::Borrowed(include_bytes!("forward_project_resolve_1_forward_motion_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("previous_candidates"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("claims"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("gradient_samples"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("candidates"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 10, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("forward_motion"), kind: BindingKind::SampledImage(Component::Float), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static GRADIENT: Shader = Shader {
    stage: Cow::Borrowed("gradient"), name: Cow::Borrowed("gradient"), spirv: Cow::Borrowed(include_bytes!("gradient.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("noisy_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("noisy_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("gradient"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("gradient_guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("gradient_samples"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("reshaded_radiance"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("sparse_gradient"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("previous_luminance"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("previous_red_blue"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("light_before"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("light_now"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SOURCE"), id: 1, scalar: Scalar::Uint, default: 2 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static GRADIENT_ATROUS_RATIO_0: Shader = Shader {
    stage: Cow::Borrowed("gradient_atrous"), name: Cow::Borrowed("gradient_atrous_ratio_0"), spirv: Cow::Borrowed(include_bytes!("gradient_atrous_ratio_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("gradient_guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("gradient_in"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("gradient_out"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
    ]),
};
pub(crate) static GRADIENT_ATROUS_RATIO_1: Shader = Shader {
    stage: Cow::Borrowed("gradient_atrous"), name: Cow::Borrowed("gradient_atrous_ratio_1"), spirv: Cow::Borrowed(include_bytes!("gradient_atrous_ratio_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("gradient_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("gradient_in"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("gradient_out"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("before_in"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("now_in"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("before_out"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("now_out"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("sigma_l"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("LAST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
    ]),
};
pub(crate) static HISTORY_CONFIDENCE_SOURCE_0: Shader = Shader {
    stage: Cow::Borrowed("history_confidence"), name: Cow::Borrowed("history_confidence_source_0"), spirv: Cow::Borrowed(include_bytes!("history_confidence_source_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("gradient"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("history_confidence"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("light_ratio"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("other_confidence"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("steadiness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("gradient_scale"), offset: 4, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static HISTORY_CONFIDENCE_SOURCE_1: Shader = Shader {
    stage: Cow::Borrowed("history_confidence"), name: Cow::Borrowed("history_confidence_source_1"), spirv: Cow::Borrowed(include_bytes!("history_confidence_source_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("confidence"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("history_confidence"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static HISTORY_CONFIDENCE_SOURCE_2: Shader = Shader {
    stage: Cow::Borrowed("history_confidence"), name: Cow::Borrowed("history_confidence_source_2"), spirv: Cow::Borrowed(include_bytes!("history_confidence_source_2.spv")), workgroup: [64, 1, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("gradient"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("history_confidence"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("light_ratio"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("block_difference_0"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("block_difference_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("gradient_scale"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("adaptivity"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("change_threshold"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("BOTH"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static IMPORT_SURFACE_ID_0_OBJECT_NORMALS_0: Shader = Shader {
    stage: Cow::Borrowed("import"), name: Cow::Borrowed("import_surface_id_0_object_normals_0"), spirv: Cow::Borrowed(include_bytes!("import_surface_id_0_object_normals_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("surface_motion"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static IMPORT_SURFACE_ID_1_OBJECT_NORMALS_0: Shader = Shader {
    stage: Cow::Borrowed("import"), name: Cow::Borrowed("import_surface_id_1_object_normals_0"), spirv: Cow::Borrowed(include_bytes!("import_surface_id_1_object_normals_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("surface_motion"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 12, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static IMPORT_SURFACE_ID_0_OBJECT_NORMALS_1: Shader = Shader {
    stage: Cow::Borrowed("import"), name: Cow::Borrowed("import_surface_id_0_object_normals_1"), spirv: Cow::Borrowed(include_bytes!("import_surface_id_0_object_normals_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("surface_motion"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 10, name: Cow::Borrowed("object_normal"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("object_normal_guide"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static IMPORT_SURFACE_ID_1_OBJECT_NORMALS_1: Shader = Shader {
    stage: Cow::Borrowed("import"), name: Cow::Borrowed("import_surface_id_1_object_normals_1"), spirv: Cow::Borrowed(include_bytes!("import_surface_id_1_object_normals_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("surface_motion"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 10, name: Cow::Borrowed("object_normal"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("object_normal_guide"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 12, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static MODULATE_FLOAT_0: Shader = Shader {
    stage: Cow::Borrowed("modulate"), name: Cow::Borrowed("modulate_float_0"), spirv: Cow::Borrowed(include_bytes!("modulate_float_0.spv")), workgroup: [32, 4, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("emission"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filtered_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("filtered_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("specular_f0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("irradiance_history_0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("irradiance_history_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 17, name: Cow::Borrowed("luminance_history_0"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 18, name: Cow::Borrowed("luminance_history_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("APART"), id: 4, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static MODULATE_FLOAT_1: Shader = Shader {
    stage: Cow::Borrowed("modulate"), name: Cow::Borrowed("modulate_float_1"), spirv: Cow::Borrowed(include_bytes!("modulate_float_1.spv")), workgroup: [32, 4, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("emission"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filtered_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("filtered_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("specular_f0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("irradiance_history_0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("irradiance_history_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 17, name: Cow::Borrowed("luminance_history_0"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 18, name: Cow::Borrowed("luminance_history_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("APART"), id: 4, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static MODULATE_FLOAT_0_UPSAMPLED_1: Shader = Shader {
    stage: Cow::Borrowed("modulate"), name: Cow::Borrowed("modulate_float_0_upsampled_1"), spirv: Cow::Borrowed(include_bytes!("modulate_float_0_upsampled_1.spv")), workgroup: [32, 4, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("emission"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filtered_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("filtered_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("specular_f0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("GATHERS"), id: 2, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("APART"), id: 4, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static MODULATE_FLOAT_1_UPSAMPLED_1: Shader = Shader {
    stage: Cow::Borrowed("modulate"), name: Cow::Borrowed("modulate_float_1_upsampled_1"), spirv: Cow::Borrowed(include_bytes!("modulate_float_1_upsampled_1.spv")), workgroup: [32, 4, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("emission"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filtered_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("filtered_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("specular_f0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("GATHERS"), id: 2, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("APART"), id: 4, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static PERCENTILE_RULE: Shader = Shader {
    stage: Cow::Borrowed("percentile_rule"), name: Cow::Borrowed("percentile_rule"), spirv: Cow::Borrowed(include_bytes!("percentile_rule.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("history_confidence"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("block_percentiles_0"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("history_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("block_percentiles_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("history_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("percentile_range"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("adaptivity"), offset: 12, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static REACTIVE_MASK: Shader = Shader {
    stage: Cow::Borrowed("reactive_mask"), name: Cow::Borrowed("reactive_mask"), spirv: Cow::Borrowed(include_bytes!("reactive_mask.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("luminance_history_0"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("luminance_history_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("history_confidence"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("radiance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("emission"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("reactive_mask"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static SAMPLE_ALBEDO: Shader = Shader {
    stage: Cow::Borrowed("sample_albedo"), name: Cow::Borrowed("sample_albedo"), spirv: Cow::Borrowed(include_bytes!("sample_albedo.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("gradient_samples"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("candidates"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("previous_candidate_albedo_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("candidate_albedo_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("irradiance_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("specular_f0"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("previous_candidate_albedo_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("candidate_albedo_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SPECULAR"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("COAT"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static SHADOWED_LIGHT_FLOAT_0: Shader = Shader {
    stage: Cow::Borrowed("shadowed_light"), name: Cow::Borrowed("shadowed_light_float_0"), spirv: Cow::Borrowed(include_bytes!("shadowed_light_float_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("denoised_visibility"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("unshadowed_direct"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("unshadowed_direct_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("unshadowed_direct_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("unshadowed_direct_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("denoised_visibility_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("denoised_visibility_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("denoised_visibility_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("COLOURED"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static SHADOWED_LIGHT_FLOAT_1: Shader = Shader {
    stage: Cow::Borrowed("shadowed_light"), name: Cow::Borrowed("shadowed_light_float_1"), spirv: Cow::Borrowed(include_bytes!("shadowed_light_float_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("denoised_visibility"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba32f, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("unshadowed_direct"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("unshadowed_direct_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("unshadowed_direct_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("unshadowed_direct_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("denoised_visibility_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("denoised_visibility_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("denoised_visibility_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("COLOURED"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static SPECULAR_ACCUMULATION: Shader = Shader {
    stage: Cow::Borrowed("specular_accumulation"), name: Cow::Borrowed("specular_accumulation"), spirv: Cow::Borrowed(include_bytes!("specular_accumulation.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("noisy"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("roughness"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("history_confidence"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("history"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("previous_luminance_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 10, name: Cow::Borrowed("previous_reflection"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("accumulated"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 12, name: Cow::Borrowed("new_luminance"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("reflection"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 14, name: Cow::Borrowed("specular_hit_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 17, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 18, name: Cow::Borrowed("specular_motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 19, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 20, name: Cow::Borrowed("specular_albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 21, name: Cow::Borrowed("material_class"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 22, name: Cow::Borrowed("light_ratio"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("alpha"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("alpha_moments"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("max_history_length"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("normal_tolerance"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("FILTERED"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("SHARP"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MIXED"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("BESIDE_DIFFUSE"), id: 4, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_1: Shader = Shader {
    stage: Cow::Borrowed("temporal_accumulation"), name: Cow::Borrowed("temporal_accumulation_signals_1"), spirv: Cow::Borrowed(include_bytes!("temporal_accumulation_signals_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("volume_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("object_normal"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("previous_object_normal"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("history_confidence"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("history_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("previous_luminance_history_0"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 12, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("new_luminance_0"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 18, name: Cow::Borrowed("light_ratio"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 19, name: Cow::Borrowed("material_class"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("alpha"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("alpha_moments"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("max_history_length"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("normal_tolerance"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("REPAIR"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("SHARP"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_ACCUMULATION_SIGNALS_2: Shader = Shader {
    stage: Cow::Borrowed("temporal_accumulation"), name: Cow::Borrowed("temporal_accumulation_signals_2"), spirv: Cow::Borrowed(include_bytes!("temporal_accumulation_signals_2.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("volume_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("object_normal"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("previous_object_normal"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("history_confidence"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("history_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("previous_luminance_history_0"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 12, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("new_luminance_0"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 14, name: Cow::Borrowed("history_1"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 15, name: Cow::Borrowed("previous_luminance_history_1"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 16, name: Cow::Borrowed("irradiance_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 17, name: Cow::Borrowed("new_luminance_1"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 18, name: Cow::Borrowed("light_ratio"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 19, name: Cow::Borrowed("material_class"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("alpha"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("alpha_moments"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("max_history_length"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("normal_tolerance"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("REPAIR"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("SHARP"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("STRATUM_SIZE"), id: 8, scalar: Scalar::Uint, default: 3 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_UPSCALE_FLOAT_0: Shader = Shader {
    stage: Cow::Borrowed("temporal_upscale"), name: Cow::Borrowed("temporal_upscale_float_0"), spirv: Cow::Borrowed(include_bytes!("temporal_upscale_float_0.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("radiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("radiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("previous_upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("upscaled_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("tone_curve"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("exposure"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_alpha"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_gamma"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SHOWN"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_UPSCALE_FLOAT_1: Shader = Shader {
    stage: Cow::Borrowed("temporal_upscale"), name: Cow::Borrowed("temporal_upscale_float_1"), spirv: Cow::Borrowed(include_bytes!("temporal_upscale_float_1.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("radiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("radiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("previous_upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("upscaled_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba32f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("tone_curve"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("exposure"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_alpha"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_gamma"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SHOWN"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_UPSCALE_FLOAT_0_SURFACE_ID_0: Shader = Shader {
    stage: Cow::Borrowed("temporal_upscale"), name: Cow::Borrowed("temporal_upscale_float_0_surface_id_0"), spirv: Cow::Borrowed(include_bytes!("temporal_upscale_float_0_surface_id_0.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("radiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("previous_upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("upscaled_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("radiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("tone_curve"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("exposure"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_alpha"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_gamma"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SHOWN"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_UPSCALE_FLOAT_0_SURFACE_ID_1: Shader = Shader {
    stage: Cow::Borrowed("temporal_upscale"), name: Cow::Borrowed("temporal_upscale_float_0_surface_id_1"), spirv: Cow::Borrowed(include_bytes!("temporal_upscale_float_0_surface_id_1.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("radiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("previous_upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("upscaled_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("radiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("tone_curve"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("exposure"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_alpha"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_gamma"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SHOWN"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_UPSCALE_FLOAT_1_SURFACE_ID_0: Shader = Shader {
    stage: Cow::Borrowed("temporal_upscale"), name: Cow::Borrowed("temporal_upscale_float_1_surface_id_0"), spirv: Cow::Borrowed(include_bytes!("temporal_upscale_float_1_surface_id_0.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("radiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("previous_upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("upscaled_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("radiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("tone_curve"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("exposure"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_alpha"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_gamma"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SHOWN"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TEMPORAL_UPSCALE_FLOAT_1_SURFACE_ID_1: Shader = Shader {
    stage: Cow::Borrowed("temporal_upscale"), name: Cow::Borrowed("temporal_upscale_float_1_surface_id_1"), spirv: Cow::Borrowed(include_bytes!("temporal_upscale_float_1_surface_id_1.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("radiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 6, name: Cow::Borrowed("previous_upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("upscale_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("upscaled_radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("radiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("tone_curve"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("exposure"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_alpha"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("taa_gamma"), offset: 16, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("SHOWN"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("WIDE"), id: 9, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static TONE_MAP: Shader = Shader {
    stage: Cow::Borrowed("tone_map"), name: Cow::Borrowed("tone_map"), spirv: Cow::Borrowed(include_bytes!("tone_map.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("radiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("radiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 3, name: Cow::Borrowed("tone_mapped"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("tone_curve"), offset: 4, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("exposure"), offset: 8, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OUTPUT"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static UPSAMPLE_NUMBER_0: Shader = Shader {
    stage: Cow::Borrowed("upsample"), name: Cow::Borrowed("upsample_number_0"), spirv: Cow::Borrowed(include_bytes!("upsample_number_0.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("filtered_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filtered_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("upsampled_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("upsampled_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("APART"), id: 4, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static UPSAMPLE_NUMBER_1: Shader = Shader {
    stage: Cow::Borrowed("upsample"), name: Cow::Borrowed("upsample_number_1"), spirv: Cow::Borrowed(include_bytes!("upsample_number_1.spv")), workgroup: [32, 2, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("depth"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("filtered_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filtered_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 5, name: Cow::Borrowed("upsampled_0"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("upsampled_1"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("normal"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("surface_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("albedo"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("APART"), id: 4, scalar: Scalar::Bool, default: 1 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VARIANCE_SIGNALS_1: Shader = Shader {
    stage: Cow::Borrowed("variance"), name: Cow::Borrowed("variance_signals_1"), spirv: Cow::Borrowed(include_bytes!("variance_signals_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("new_luminance_0"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("luminance_history_0"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("estimate_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("spatial_variance_frames"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("alpha"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sample_frames"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("ESTIMATOR"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("FILLED"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 4, scalar: Scalar::Bool, default: 0 },
    ]),
};
pub(crate) static VARIANCE_SIGNALS_2: Shader = Shader {
    stage: Cow::Borrowed("variance"), name: Cow::Borrowed("variance_signals_2"), spirv: Cow::Borrowed(include_bytes!("variance_signals_2.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("new_luminance_0"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("irradiance_0"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("luminance_history_0"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("estimate_0"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("new_luminance_1"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("irradiance_1"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("luminance_history_1"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 10, name: Cow::Borrowed("estimate_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("volume_sigma_z"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("spatial_variance_frames"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("alpha"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sample_frames"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("ESTIMATOR"), id: 1, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("VOLUME"), id: 2, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("FILLED"), id: 3, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("MARKED"), id: 4, scalar: Scalar::Bool, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_ACCUMULATION_MANY_0_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_accumulation"), name: Cow::Borrowed("visibility_accumulation_many_0_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_accumulation_many_0_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("previous_visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("visibility_history"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("occluder_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("occluder_motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("light_radius"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_alpha"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("normal_tolerance"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("present"), offset: 24, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("AMBIENT"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_ACCUMULATION_MANY_0_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_accumulation"), name: Cow::Borrowed("visibility_accumulation_many_0_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_accumulation_many_0_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("previous_visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("visibility_history"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("sample_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 12, name: Cow::Borrowed("previous_history_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("history_colours"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 14, name: Cow::Borrowed("occluder_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("occluder_motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("light_radius"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_alpha"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("normal_tolerance"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("present"), offset: 24, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("AMBIENT"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_ACCUMULATION_MANY_1_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_accumulation"), name: Cow::Borrowed("visibility_accumulation_many_1_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_accumulation_many_1_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("previous_visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("visibility_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("occluder_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("occluder_id_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 13, name: Cow::Borrowed("occluder_id_2"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 14, name: Cow::Borrowed("occluder_id_3"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("occluder_motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("occluder_motion_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 17, name: Cow::Borrowed("occluder_motion_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 18, name: Cow::Borrowed("occluder_motion_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 19, name: Cow::Borrowed("occluder_distance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 20, name: Cow::Borrowed("occluder_distance_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 21, name: Cow::Borrowed("occluder_distance_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("light_radius"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_1"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_2"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_3"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_alpha"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("normal_tolerance"), offset: 24, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 28, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 32, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("present"), offset: 36, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("AMBIENT"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_ACCUMULATION_MANY_1_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_accumulation"), name: Cow::Borrowed("visibility_accumulation_many_1_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_accumulation_many_1_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("previous_guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("previous_visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 8, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 9, name: Cow::Borrowed("instance_transforms"), kind: BindingKind::StorageBuffer(BindingAccess::ReadOnly), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("visibility_history"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 11, name: Cow::Borrowed("sample_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 12, name: Cow::Borrowed("previous_history_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 13, name: Cow::Borrowed("history_colours"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 14, name: Cow::Borrowed("occluder_id"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 15, name: Cow::Borrowed("occluder_id_1"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 16, name: Cow::Borrowed("occluder_id_2"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 17, name: Cow::Borrowed("occluder_id_3"), kind: BindingKind::SampledImage(Component::Uint), optional: true },
        ShaderBinding { number: 18, name: Cow::Borrowed("occluder_motion"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 19, name: Cow::Borrowed("occluder_motion_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 20, name: Cow::Borrowed("occluder_motion_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 21, name: Cow::Borrowed("occluder_motion_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 22, name: Cow::Borrowed("occluder_distance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 23, name: Cow::Borrowed("occluder_distance_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 24, name: Cow::Borrowed("occluder_distance_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("light_radius"), offset: 0, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_1"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_2"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_3"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_alpha"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("depth_tolerance"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("normal_tolerance"), offset: 24, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 28, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 32, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("present"), offset: 36, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("AMBIENT"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_0_MANY_0_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_0_many_0_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_0_many_0_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("filter_out"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_1_MANY_0_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_1_many_0_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_1_many_0_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_visibility"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_0_MANY_0_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_0_many_0_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_0_many_0_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("filter_out"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filter_in_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("filter_out_colours"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_1_MANY_0_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_1_many_0_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_1_many_0_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_visibility"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filter_in_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 20, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_0_MANY_1_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_0_many_1_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_0_many_1_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("filter_out"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_1"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_2"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_3"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 24, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 28, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 32, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_1_MANY_1_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_1_many_1_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_1_many_1_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_visibility"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("denoised_visibility_1"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("denoised_visibility_2"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("denoised_visibility_3"), kind: BindingKind::StorageImage(TexelFormat::R32f, BindingAccess::WriteOnly), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_1"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_2"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_3"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 24, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 28, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 32, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("present"), offset: 36, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_0_MANY_1_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_0_many_1_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_0_many_1_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("filter_out"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filter_in_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("filter_out_colours"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_1"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_2"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_3"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 24, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 28, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 32, scalar: Scalar::Float },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_FILTER_LAST_1_MANY_1_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_filter"), name: Cow::Borrowed("visibility_filter_last_1_many_1_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_filter_last_1_many_1_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("visibility_history"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("filter_in"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("denoised_visibility"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("filter_in_colours"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("denoised_visibility_1"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("denoised_visibility_2"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("denoised_visibility_3"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("level"), offset: 0, scalar: Scalar::Uint },
        PushMember { name: Cow::Borrowed("light_radius"), offset: 4, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_1"), offset: 8, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_2"), offset: 12, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("light_radius_3"), offset: 16, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("penumbra_blur"), offset: 20, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("visibility_sigma"), offset: 24, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_n"), offset: 28, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("sigma_z"), offset: 32, scalar: Scalar::Float },
        PushMember { name: Cow::Borrowed("present"), offset: 36, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("FIRST"), id: 1, scalar: Scalar::Bool, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_SAMPLES_MANY_0_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_samples"), name: Cow::Borrowed("visibility_samples_many_0_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_samples_many_0_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("noisy_visibility"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_SAMPLES_MANY_0_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_samples"), name: Cow::Borrowed("visibility_samples_many_0_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_samples_many_0_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("noisy_visibility"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("sample_colours"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_SAMPLES_MANY_1_COLOUR_0: Shader = Shader {
    stage: Cow::Borrowed("visibility_samples"), name: Cow::Borrowed("visibility_samples_many_1_colour_0"), spirv: Cow::Borrowed(include_bytes!("visibility_samples_many_1_colour_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("noisy_visibility"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("noisy_visibility_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 7, name: Cow::Borrowed("noisy_visibility_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("noisy_visibility_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("occluder_distance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("occluder_distance_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("occluder_distance_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VISIBILITY_SAMPLES_MANY_1_COLOUR_1: Shader = Shader {
    stage: Cow::Borrowed("visibility_samples"), name: Cow::Borrowed("visibility_samples_many_1_colour_1"), spirv: Cow::Borrowed(include_bytes!("visibility_samples_many_1_colour_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("noisy_visibility"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("occluder_distance"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("visibility_samples"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 6, name: Cow::Borrowed("sample_colours"), kind: BindingKind::StorageImage(TexelFormat::Rgba32ui, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 7, name: Cow::Borrowed("noisy_visibility_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 8, name: Cow::Borrowed("noisy_visibility_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 9, name: Cow::Borrowed("noisy_visibility_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 10, name: Cow::Borrowed("occluder_distance_1"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 11, name: Cow::Borrowed("occluder_distance_2"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 12, name: Cow::Borrowed("occluder_distance_3"), kind: BindingKind::SampledImage(Component::Float), optional: true },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("LIGHTS"), id: 2, scalar: Scalar::Uint, default: 4 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
        SpecialisationConstant { name: Cow::Borrowed("CONVENTIONS"), id: 30, scalar: Scalar::Uint, default: 0 },
    ]),
};
pub(crate) static VOLUME_MOTION_RESOLVE_0: Shader = Shader {
    stage: Cow::Borrowed("volume_motion"), name: Cow::Borrowed("volume_motion_resolve_0"), spirv: Cow::Borrowed(include_bytes!("volume_motion_resolve_0.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("previous_points"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("guide"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("claims"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::ReadWrite), optional: false },
    ]),
    members: Cow::Borrowed(&[
    ]),
    constants: Cow::Borrowed(&[
    ]),
};
pub(crate) static VOLUME_MOTION_RESOLVE_1: Shader = Shader {
    stage: Cow::Borrowed("volume_motion"), name: Cow::Borrowed("volume_motion_resolve_1"), spirv: Cow::Borrowed(include_bytes!("volume_motion_resolve_1.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("previous_points"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("surface_motion"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("claims"), kind: BindingKind::SampledImage(Component::Uint), optional: false },
        ShaderBinding { number: 4, name: Cow::Borrowed("volume_motion"), kind: BindingKind::StorageImage(TexelFormat::R32ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
    ]),
    constants: Cow::Borrowed(&[
    ]),
};
pub(crate) static VOLUME_POINTS: Shader = Shader {
    stage: Cow::Borrowed("volume_points"), name: Cow::Borrowed("volume_points"), spirv: Cow::Borrowed(include_bytes!("volume_points.spv")), workgroup: [8, 8, 1],
    bindings: Cow::Borrowed(&[
        ShaderBinding { number: 0, name: Cow::Borrowed("frame"), kind: BindingKind::UniformBuffer, optional: false },
        ShaderBinding { number: 1, name: Cow::Borrowed("statistics"), kind: BindingKind::StorageBuffer(BindingAccess::ReadWrite), optional: false },
        ShaderBinding { number: 2, name: Cow::Borrowed("noisy_volume"), kind: BindingKind::SampledImage(Component::Float), optional: false },
        ShaderBinding { number: 3, name: Cow::Borrowed("scattering_depth"), kind: BindingKind::SampledImage(Component::Float), optional: true },
        ShaderBinding { number: 4, name: Cow::Borrowed("radiance"), kind: BindingKind::StorageImage(TexelFormat::Rgba16f, BindingAccess::WriteOnly), optional: false },
        ShaderBinding { number: 5, name: Cow::Borrowed("volume_points"), kind: BindingKind::StorageImage(TexelFormat::Rgba16ui, BindingAccess::WriteOnly), optional: false },
    ]),
    members: Cow::Borrowed(&[
        PushMember { name: Cow::Borrowed("present"), offset: 0, scalar: Scalar::Uint },
    ]),
    constants: Cow::Borrowed(&[
        SpecialisationConstant { name: Cow::Borrowed("WIRED"), id: 0, scalar: Scalar::Uint, default: 4294967295 },
        SpecialisationConstant { name: Cow::Borrowed("OF_HOST"), id: 29, scalar: Scalar::Uint, default: 0 },
    ]),
};
#[cfg(test)]
pub(crate) static ALL: &[&Shader] = &[&ATROUS_SIGNALS_1, &ATROUS_SIGNALS_2, &ATROUS_SIGNALS_1_SPECULAR_1, &ATROUS_SIGNALS_2_SPECULAR_1, &ATROUS_SIGNALS_1_MATERIAL_1, &ATROUS_SIGNALS_2_MATERIAL_1, &ATROUS_SIGNALS_1_SPECULAR_1_MATERIAL_1, &ATROUS_SIGNALS_2_SPECULAR_1_MATERIAL_1, &BLOCK_DIFFERENCE, &BLOCK_PERCENTILES, &CHANGE_TEST_RATIO_0, &CHANGE_TEST_RATIO_1, &CLEAR_CLAIMS, &DEBUG_VIEW, &DEMODULATE_LUMINANCE_0, &DEMODULATE_LUMINANCE_1, &EAW_SIGNALS_1, &EAW_SIGNALS_2, &FILL_HOLES, &FILTER_EXPOSURE, &FIREFLY_DIFFERENCE_0, &FIREFLY_DIFFERENCE_1, &FIREFLY_LIMITS_RETURNING_0, &FIREFLY_LIMITS_RETURNING_1, &FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_0, &FORWARD_PROJECT_RESOLVE_0_FORWARD_MOTION_1, &FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_0, &FORWARD_PROJECT_RESOLVE_1_FORWARD_MOTION_1, &GRADIENT, &GRADIENT_ATROUS_RATIO_0, &GRADIENT_ATROUS_RATIO_1, &HISTORY_CONFIDENCE_SOURCE_0, &HISTORY_CONFIDENCE_SOURCE_1, &HISTORY_CONFIDENCE_SOURCE_2, &IMPORT_SURFACE_ID_0_OBJECT_NORMALS_0, &IMPORT_SURFACE_ID_1_OBJECT_NORMALS_0, &IMPORT_SURFACE_ID_0_OBJECT_NORMALS_1, &IMPORT_SURFACE_ID_1_OBJECT_NORMALS_1, &MODULATE_FLOAT_0, &MODULATE_FLOAT_1, &MODULATE_FLOAT_0_UPSAMPLED_1, &MODULATE_FLOAT_1_UPSAMPLED_1, &PERCENTILE_RULE, &REACTIVE_MASK, &SAMPLE_ALBEDO, &SHADOWED_LIGHT_FLOAT_0, &SHADOWED_LIGHT_FLOAT_1, &SPECULAR_ACCUMULATION, &TEMPORAL_ACCUMULATION_SIGNALS_1, &TEMPORAL_ACCUMULATION_SIGNALS_2, &TEMPORAL_UPSCALE_FLOAT_0, &TEMPORAL_UPSCALE_FLOAT_1, &TEMPORAL_UPSCALE_FLOAT_0_SURFACE_ID_0, &TEMPORAL_UPSCALE_FLOAT_0_SURFACE_ID_1, &TEMPORAL_UPSCALE_FLOAT_1_SURFACE_ID_0, &TEMPORAL_UPSCALE_FLOAT_1_SURFACE_ID_1, &TONE_MAP, &UPSAMPLE_NUMBER_0, &UPSAMPLE_NUMBER_1, &VARIANCE_SIGNALS_1, &VARIANCE_SIGNALS_2, &VISIBILITY_ACCUMULATION_MANY_0_COLOUR_0, &VISIBILITY_ACCUMULATION_MANY_0_COLOUR_1, &VISIBILITY_ACCUMULATION_MANY_1_COLOUR_0, &VISIBILITY_ACCUMULATION_MANY_1_COLOUR_1, &VISIBILITY_FILTER_LAST_0_MANY_0_COLOUR_0, &VISIBILITY_FILTER_LAST_1_MANY_0_COLOUR_0, &VISIBILITY_FILTER_LAST_0_MANY_0_COLOUR_1, &VISIBILITY_FILTER_LAST_1_MANY_0_COLOUR_1, &VISIBILITY_FILTER_LAST_0_MANY_1_COLOUR_0, &VISIBILITY_FILTER_LAST_1_MANY_1_COLOUR_0, &VISIBILITY_FILTER_LAST_0_MANY_1_COLOUR_1, &VISIBILITY_FILTER_LAST_1_MANY_1_COLOUR_1, &VISIBILITY_SAMPLES_MANY_0_COLOUR_0, &VISIBILITY_SAMPLES_MANY_0_COLOUR_1, &VISIBILITY_SAMPLES_MANY_1_COLOUR_0, &VISIBILITY_SAMPLES_MANY_1_COLOUR_1, &VOLUME_MOTION_RESOLVE_0, &VOLUME_MOTION_RESOLVE_1, &VOLUME_POINTS, ];
