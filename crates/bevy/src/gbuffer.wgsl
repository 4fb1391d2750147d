// Albedo of both lobes, roughness and normals from Bevy's deferred G-buffer.
// Layout: bevy_pbr 0.20, src/deferred: base colour as its 2.2nd root and roughness; emission; reflectance, metallic, occlusion, clearcoat;
// octahedral normal of 24 bits and flags.

@group(0) @binding(0) var gbuffer: texture_2d<u32>;
@group(0) @binding(1) var depth: texture_depth_2d;
@group(0) @binding(2) var albedo: texture_storage_2d<rgba16float, write>;
@group(0) @binding(3) var normal: texture_storage_2d<rgba16float, write>;
// Albedo of the specular lobe.
@group(0) @binding(4) var specular: texture_storage_2d<rgba16float, write>;
// Perceptual.
@group(0) @binding(5) var roughness: texture_storage_2d<r32float, write>;

fn octahedral_normal(bits: u32) -> vec3<f32> {
    let folded = vec2(f32(bits & 0xfffu), f32((bits >> 12u) & 0xfffu)) / 4095.0 * 2.0 - 1.0;
    let z = 1.0 - abs(folded.x) - abs(folded.y);
    let fold = max(-z, 0.0);
    return normalize(vec3(folded - select(vec2(-fold), vec2(fold), folded >= vec2(0.0)), z));
}

@compute @workgroup_size(8, 8)
fn unpack(@builtin(global_invocation_id) id: vec3<u32>) {
    if any(id.xy >= textureDimensions(gbuffer)) { return; }
    // 0 is the background of a reversed depth buffer.
    if textureLoad(depth, id.xy, 0) == 0.0 {
        textureStore(albedo, id.xy, vec4(1.0));
        textureStore(normal, id.xy, vec4(0.5, 0.5, 1.0, 0.0));
        textureStore(specular, id.xy, vec4(0.0));
        textureStore(roughness, id.xy, vec4(1.0));
        return;
    }
    let texel = textureLoad(gbuffer, id.xy, 0);
    let packed_base = unpack4x8unorm(texel.r);
    let base = pow(packed_base.rgb, vec3(2.2));
    let properties = unpack4x8unorm(texel.b);
    let reflectance = properties.r;
    let metallic = properties.g;
    // A dielectric reflects 16 % of the squared reflectance when seen head-on.
    let diffuse = base * (1.0 - metallic);
    let reflected = mix(vec3(0.16 * reflectance * reflectance), base, metallic);
    textureStore(albedo, id.xy, vec4(diffuse, 0.0));
    textureStore(specular, id.xy, vec4(min(reflected, 1.0 - diffuse), 0.0));
    textureStore(roughness, id.xy, vec4(packed_base.a));
    textureStore(normal, id.xy, vec4(octahedral_normal(texel.a) * 0.5 + 0.5, 0.0));
}
