// Bevy's prepass, as it is, in textures that a capture can read: those of Bevy cannot be copied from.

@group(0) @binding(0) var depth: texture_depth_2d;
@group(0) @binding(1) var normal: texture_2d<f32>;
@group(0) @binding(2) var motion: texture_2d<f32>;
@group(0) @binding(3) var copied_depth: texture_storage_2d<r32float, write>;
@group(0) @binding(4) var copied_normal: texture_storage_2d<rgba32float, write>;
@group(0) @binding(5) var copied_motion: texture_storage_2d<rgba16float, write>;

@compute @workgroup_size(8, 8)
fn copy(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(depth)) { return; }
    textureStore(copied_depth, id.xy, vec4(textureLoad(depth, id.xy, 0), 0.0, 0.0, 1.0));
    textureStore(copied_normal, id.xy, textureLoad(normal, id.xy, 0));
    textureStore(copied_motion, id.xy, textureLoad(motion, id.xy, 0));
}
