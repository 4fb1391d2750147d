// Reflection: a Lambertian base under a GGX coat, or GGX metal. Directions point away from the surface, world space.
// [Walter et al. 2007] GGX, [Heitz 2018] sampling of visible normals, [Ashikhmin and Shirley 2000] the (1-F)(1-F) base.
#ifndef BSDF_GLSL
#define BSDF_GLSL
#include "surface.glsl"

vec3 fresnel(vec3 f0, float cosine) {
    float m = clamp(1.0 - cosine, 0.0, 1.0);
    float m2 = m * m;
    // Grazing reflectance fades with f0, so that a pure diffuser (f0 = 0) has no coat at all.
    return f0 + (clamp(50.0 * max(f0.r, max(f0.g, f0.b)), 0.0, 1.0) - f0) * (m2 * m2 * m);
}

mat3 basis(vec3 n) {
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}

float ggx_distribution(float alpha, float cosine) {
    float a2 = alpha * alpha;
    float d = cosine * cosine * (a2 - 1.0) + 1.0;
    return a2 / (PI * d * d);
}

float smith_lambda(float alpha, float cosine) {
    float c2 = cosine * cosine;
    return 0.5 * (sqrt(1.0 + alpha * alpha * max(1.0 - c2, 0.0) / max(c2, 1.0e-8)) - 1.0);
}

// Probability of sampling the coat rather than the base.
float specular_probability(Surface s, float view_cosine) {
    float coat = luminance(fresnel(s.f0, view_cosine));
    float base = luminance(s.diffuse);
    return coat + base > 0.0 ? coat / (coat + base) : 0.0;
}

// What a surface reflects: in all, and the part of it that the coat or the metal does.
struct Reflected {
    vec3 all;
    vec3 specular;
};

Reflected scaled(Reflected r, vec3 by) { return Reflected(r.all * by, r.specular * by); }

// Value times cosine of the light, and the density with which sample_bsdf gives that direction.
Reflected evaluate_bsdf(Surface s, vec3 view, vec3 light, out float density) {
    density = 0.0;
    Reflected result = Reflected(vec3(0.0), vec3(0.0));
    float nl = dot(s.normal, light);
    float nv = dot(s.normal, view);
    if (nl <= 0.0 || nv <= 0.0 || dot(s.geometric_normal, light) <= 0.0) return result;
    float probability = specular_probability(s, nv);
    vec3 base = s.diffuse * INV_PI * (1.0 - fresnel(s.f0, nv)) * (1.0 - fresnel(s.f0, nl));
    density = (1.0 - probability) * nl * INV_PI;
    if (probability > 0.0) {
        float alpha = s.roughness * s.roughness;
        vec3 h = normalize(view + light);
        float d = ggx_distribution(alpha, clamp(dot(s.normal, h), 0.0, 1.0));
        float lambda_v = smith_lambda(alpha, nv);
        float lambda_l = smith_lambda(alpha, nl);
        result.specular = fresnel(s.f0, dot(view, h)) * (d / (4.0 * nl * nv * (1.0 + lambda_v + lambda_l))) * nl;
        density += probability * d / (4.0 * nv * (1.0 + lambda_v));
    }
    result.all = base * nl + result.specular;
    return result;
}

vec3 sample_visible_normal(vec3 view, float alpha, vec2 u) {
    vec3 v = normalize(vec3(alpha * view.xy, view.z));
    float length2 = dot(v.xy, v.xy);
    vec3 t1 = length2 > 0.0 ? vec3(-v.y, v.x, 0.0) * inversesqrt(length2) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(v, t1);
    float r = sqrt(u.x);
    float phi = 2.0 * PI * u.y;
    float p1 = r * cos(phi);
    float half_sum = 0.5 * (1.0 + v.z);
    float p2 = mix(sqrt(max(1.0 - p1 * p1, 0.0)), r * sin(phi), half_sum);
    vec3 h = p1 * t1 + p2 * t2 + sqrt(max(1.0 - p1 * p1 - p2 * p2, 0.0)) * v;
    return normalize(vec3(alpha * h.xy, max(h.z, 1.0e-6)));
}

// A direction, its value times cosine over density as `weight` (0: absorbed), and its density. The number that
// chooses the layer is stretched and used again, so that a path vertex needs one pair of random numbers.
vec3 sample_bsdf(Surface s, vec3 view, vec2 u, out Reflected weight, out float density) {
    mat3 frame_of_normal = basis(s.normal);
    float probability = specular_probability(s, dot(s.normal, view));
    vec3 light;
    if (u.x < probability) {
        u.x /= probability;
        vec3 h = sample_visible_normal(view * frame_of_normal, s.roughness * s.roughness, u);
        light = reflect(-view, frame_of_normal * h);
    } else {
        u.x = (u.x - probability) / max(1.0 - probability, 1.0e-6);
        float r = sqrt(u.x);
        float phi = 2.0 * PI * u.y;
        light = frame_of_normal * vec3(r * cos(phi), r * sin(phi), sqrt(max(1.0 - u.x, 0.0)));
    }
    Reflected value = evaluate_bsdf(s, view, light, density);
    weight = scaled(value, vec3(density > 1.0e-8 ? 1.0 / density : 0.0));
    return light;
}

// What a denoiser divides diffuse light by.
vec3 diffuse_albedo(Surface s) { return s.diffuse * (1.0 - s.f0); }

// What a denoiser divides specular light by: the directional albedo of the coat or metal, after the fit of Karis 2014
// ("Physically based shading on mobile"). Near enough, and never exact: modulation undoes it.
vec3 specular_albedo(Surface s, float view_cosine) {
    vec4 r = s.roughness * vec4(-1.0, -0.0275, -0.572, 0.022) + vec4(1.0, 0.0425, 1.04, -0.04);
    float a = min(r.x * r.x, exp2(-9.28 * view_cosine)) * r.x + r.y;
    vec2 ab = vec2(-1.04, 1.04) * a + r.zw;
    float coat = clamp(50.0 * max(s.f0.r, max(s.f0.g, s.f0.b)), 0.0, 1.0);
    return coat * max(s.f0 * ab.x + ab.y, 0.0);
}

#endif
