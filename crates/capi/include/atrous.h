/* atrous: the passes of a real-time path-tracing denoiser, for the frame graph of a Vulkan engine.
 *
 * Made from crates/capi by cbindgen: `ATROUS_UPDATE_HEADER=1 cargo test -p atrous-capi --test header` renews it, and a test compares.
 * Set struct_size to sizeof(struct) in every struct before it is passed, to read and to fill alike. Structs only grow, at their
 * end: an older header's struct takes defaults, a newer one's must be zero where this library does not know it.
 * Threads: any may call. Calls that only read a denoiser, atrous_record among them, run side by side: record different passes, or
 * one pass in different frame slots, from as many threads as you like. Calls that change it wait until those are done, and calls
 * of one executor wait for each other.
 * docs/contract.md has the contract, docs/hosts/cpp.md an engine that uses it. */

#ifndef ATROUS_H
#define ATROUS_H

#include <stdint.h>
#include "vulkan/vulkan_core.h"

#define ATROUS_VERSION_MAJOR 0
#define ATROUS_VERSION_MINOR 1
#define ATROUS_VERSION_PATCH 0
// The version of this header, packed as Vulkan packs versions; atrous_version() has that of the library.
#define ATROUS_VERSION ((ATROUS_VERSION_MAJOR << 22) | (ATROUS_VERSION_MINOR << 12) | ATROUS_VERSION_PATCH)

// Inputs, by the names of their resources.

// guide, number: linear, device (reversed, infinite, orthographic) or length of the ray
#define ATROUS_INPUT_DEPTH "depth"

// guide, vector: xyz or octahedral; world or view space
#define ATROUS_INPUT_NORMAL "normal"

// guide, vector, optional: in pixels, UV or NDC, of either sign; z may hold depth
#define ATROUS_INPUT_MOTION "motion"

// guide, id: unless Config::surface_id is false: stable per instance; 0 is the background
#define ATROUS_INPUT_SURFACE_ID "surface_id"

// guide, buffer of 3×4 matrices, optional: previous from current world space by surface_id, three rows of four floats each
#define ATROUS_INPUT_INSTANCE_TRANSFORMS "instance_transforms"

// guide, vector: with Config::object_normal: lets a turning object keep its history
#define ATROUS_INPUT_OBJECT_NORMAL "object_normal"

// guide, id: with Config::material_class: 0 to 15, an entry of FrameParams::materials
#define ATROUS_INPUT_MATERIAL_CLASS "material_class"

// guide, number, optional: 0 to 1, perceptual or GGX's α; without it, or at −1, surfaces are rough. Signals::Specular and Mixed read it
#define ATROUS_INPUT_ROUGHNESS "roughness"

// composition, colour, optional: radiance is divided by it and multiplied again, so textures stay sharp
#define ATROUS_INPUT_ALBEDO "albedo"

// composition, colour, optional: added after the filter
#define ATROUS_INPUT_EMISSION "emission"

// signal, colour: all light in one signal, linear (Signals::Together, Mixed)
#define ATROUS_INPUT_NOISY_RADIANCE "noisy_radiance"

// signal, colour: direct light, linear (Signals::Apart)
#define ATROUS_INPUT_NOISY_DIRECT "noisy_direct"

// signal, colour: indirect light, linear (Signals::Apart)
#define ATROUS_INPUT_NOISY_INDIRECT "noisy_indirect"

// signal, colour: light scattered by the base of surfaces, linear (Signals::Specular); albedo is then that of the base
#define ATROUS_INPUT_NOISY_DIFFUSE "noisy_diffuse"

// signal, colour: light reflected by coat or metal, linear (Signals::Specular)
#define ATROUS_INPUT_NOISY_SPECULAR "noisy_specular"

// composition, colour, optional: the share of light from everywhere that coat or metal reflects
#define ATROUS_INPUT_SPECULAR_ALBEDO "specular_albedo"

// composition, colour, optional: instead of specular_albedo: reflectance at normal incidence
#define ATROUS_INPUT_SPECULAR_F0 "specular_f0"

// guide, number, optional: distance from the surface to the hit of the specular path, scene units; 0 or infinite: nothing was hit. Without it, or at −1, the light tells how reflections move
#define ATROUS_INPUT_SPECULAR_HIT_DISTANCE "specular_hit_distance"

// guide, id, optional: the surface_id at that hit: with instance_transforms, moving things in mirrors, and moving mirrors, are followed
#define ATROUS_INPUT_SPECULAR_HIT_ID "specular_hit_id"

// guide, vector, optional: before that id, where finite: previous − current place of the hit, world space
#define ATROUS_INPUT_SPECULAR_MOTION "specular_motion"

// change, vector: with Config::forward_motion, for gradients: motion of deforming surfaces from the previous frame to this one
#define ATROUS_INPUT_FORWARD_MOTION "forward_motion"

// change, colour, optional: with GradientSource::Reshaded: the paths of the previous frame, traced again in this scene
#define ATROUS_INPUT_RESHADED_RADIANCE "reshaded_radiance"

// change, vector, optional: with GradientSource::Sparse: differences that you took yourself
#define ATROUS_INPUT_SPARSE_GRADIENT "sparse_gradient"

// change, number: with GradientSource::Confidence: 1 keeps history, 0 drops it
#define ATROUS_INPUT_CONFIDENCE "confidence"

// signal, colour: for Stabilize: the output of the other denoiser
#define ATROUS_INPUT_OTHER_DENOISED_RADIANCE "other_denoised_radiance"

// signal, colour: with Config::volume: light that fog or smoke scatters towards the camera
#define ATROUS_INPUT_NOISY_VOLUME "noisy_volume"

// guide, number, optional: with Config::volume: linear depth of a point that contributes much, for example chosen by transmittance; gives the volume its own motion
#define ATROUS_INPUT_SCATTERING_DEPTH "scattering_depth"

// signal, number: with Config::ambient_occlusion: 1 where a ray, drawn by the cosine, hit nothing, else 0
#define ATROUS_INPUT_NOISY_AMBIENT "noisy_ambient"

// guide, number: distance of that hit, scene units; 0 or infinite: none
#define ATROUS_INPUT_AMBIENT_DISTANCE "ambient_distance"

// signal, colour: with Config::visibility: 0 (occluded) to 1 (lit), by one shadow ray; red alone, unless Config::coloured_visibility. Leave this light out of the noisy radiance
#define ATROUS_INPUT_NOISY_VISIBILITY "noisy_visibility"

// signal, colour: with Config::visibility: 0 (occluded) to 1 (lit), by one shadow ray; red alone, unless Config::coloured_visibility. Leave this light out of the noisy radiance
#define ATROUS_INPUT_NOISY_VISIBILITY_1 "noisy_visibility_1"

// signal, colour: with Config::visibility: 0 (occluded) to 1 (lit), by one shadow ray; red alone, unless Config::coloured_visibility. Leave this light out of the noisy radiance
#define ATROUS_INPUT_NOISY_VISIBILITY_2 "noisy_visibility_2"

// signal, colour: with Config::visibility: 0 (occluded) to 1 (lit), by one shadow ray; red alone, unless Config::coloured_visibility. Leave this light out of the noisy radiance
#define ATROUS_INPUT_NOISY_VISIBILITY_3 "noisy_visibility_3"

// guide, number: distance of the occluder along the shadow ray, scene units; 0 or infinite: none
#define ATROUS_INPUT_OCCLUDER_DISTANCE "occluder_distance"

// guide, number: distance of the occluder along the shadow ray, scene units; 0 or infinite: none
#define ATROUS_INPUT_OCCLUDER_DISTANCE_1 "occluder_distance_1"

// guide, number: distance of the occluder along the shadow ray, scene units; 0 or infinite: none
#define ATROUS_INPUT_OCCLUDER_DISTANCE_2 "occluder_distance_2"

// guide, number: distance of the occluder along the shadow ray, scene units; 0 or infinite: none
#define ATROUS_INPUT_OCCLUDER_DISTANCE_3 "occluder_distance_3"

// guide, id, optional: the surface_id of the occluder: with instance_transforms and FrameParams::lights, moving shadows are followed
#define ATROUS_INPUT_OCCLUDER_ID "occluder_id"

// guide, id, optional: the surface_id of the occluder: with instance_transforms and FrameParams::lights, moving shadows are followed
#define ATROUS_INPUT_OCCLUDER_ID_1 "occluder_id_1"

// guide, id, optional: the surface_id of the occluder: with instance_transforms and FrameParams::lights, moving shadows are followed
#define ATROUS_INPUT_OCCLUDER_ID_2 "occluder_id_2"

// guide, id, optional: the surface_id of the occluder: with instance_transforms and FrameParams::lights, moving shadows are followed
#define ATROUS_INPUT_OCCLUDER_ID_3 "occluder_id_3"

// guide, vector, optional: before ids, where finite: previous − current place of the occluding point, world space
#define ATROUS_INPUT_OCCLUDER_MOTION "occluder_motion"

// guide, vector, optional: before ids, where finite: previous − current place of the occluding point, world space
#define ATROUS_INPUT_OCCLUDER_MOTION_1 "occluder_motion_1"

// guide, vector, optional: before ids, where finite: previous − current place of the occluding point, world space
#define ATROUS_INPUT_OCCLUDER_MOTION_2 "occluder_motion_2"

// guide, vector, optional: before ids, where finite: previous − current place of the occluding point, world space
#define ATROUS_INPUT_OCCLUDER_MOTION_3 "occluder_motion_3"

// composition, colour, optional: the reflected light without occluders, albedo included; denoised_radiance then has the product
#define ATROUS_INPUT_UNSHADOWED_DIRECT "unshadowed_direct"

// composition, colour, optional: the reflected light without occluders, albedo included; denoised_radiance then has the product
#define ATROUS_INPUT_UNSHADOWED_DIRECT_1 "unshadowed_direct_1"

// composition, colour, optional: the reflected light without occluders, albedo included; denoised_radiance then has the product
#define ATROUS_INPUT_UNSHADOWED_DIRECT_2 "unshadowed_direct_2"

// composition, colour, optional: the reflected light without occluders, albedo included; denoised_radiance then has the product
#define ATROUS_INPUT_UNSHADOWED_DIRECT_3 "unshadowed_direct_3"

// Choices, by the names of the fields that take them.

typedef enum AtrousDepth {
  ATROUS_DEPTH_LINEAR = 0,
  ATROUS_DEPTH_DEVICE = 1,
  ATROUS_DEPTH_RAY_LENGTH = 2,
} AtrousDepth;

typedef enum AtrousNormal {
  ATROUS_NORMAL_XYZ = 0,
  ATROUS_NORMAL_XYZ_UNORM = 1,
  ATROUS_NORMAL_OCTAHEDRAL = 2,
  ATROUS_NORMAL_OCTAHEDRAL_UNORM = 3,
} AtrousNormal;

typedef enum AtrousNormalSpace {
  ATROUS_NORMAL_SPACE_WORLD = 0,
  ATROUS_NORMAL_SPACE_VIEW = 1,
} AtrousNormalSpace;

typedef enum AtrousMotionUnit {
  ATROUS_MOTION_UNIT_PIXELS = 0,
  ATROUS_MOTION_UNIT_UV = 1,
  ATROUS_MOTION_UNIT_NDC = 2,
} AtrousMotionUnit;

typedef enum AtrousMotionDirection {
  ATROUS_MOTION_DIRECTION_PREVIOUS_MINUS_CURRENT = 0,
  ATROUS_MOTION_DIRECTION_CURRENT_MINUS_PREVIOUS = 1,
} AtrousMotionDirection;

typedef enum AtrousMotionDepth {
  ATROUS_MOTION_DEPTH_NONE = 0,
  ATROUS_MOTION_DEPTH_DIFFERENCE = 1,
  ATROUS_MOTION_DEPTH_ABSOLUTE = 2,
} AtrousMotionDepth;

typedef enum AtrousViewForward {
  ATROUS_VIEW_FORWARD_NEGATIVE_Z = 0,
  ATROUS_VIEW_FORWARD_POSITIVE_Z = 1,
} AtrousViewForward;

typedef enum AtrousRoughness {
  ATROUS_ROUGHNESS_LINEAR = 0,
  ATROUS_ROUGHNESS_ALPHA = 1,
} AtrousRoughness;

typedef enum AtrousRoughnessChannel {
  ATROUS_ROUGHNESS_CHANNEL_R = 0,
  ATROUS_ROUGHNESS_CHANNEL_G = 1,
  ATROUS_ROUGHNESS_CHANNEL_B = 2,
  ATROUS_ROUGHNESS_CHANNEL_A = 3,
} AtrousRoughnessChannel;

typedef enum AtrousPreset {
  ATROUS_PRESET_SVGF = 0,
  ATROUS_PRESET_ASVGF = 1,
  ATROUS_PRESET_STABILIZE = 2,
  ATROUS_PRESET_PERCENTILE = 3,
  ATROUS_PRESET_EAW = 4,
  ATROUS_PRESET_VOLUME = 5,
  ATROUS_PRESET_FAST = 6,
  ATROUS_PRESET_BEST = 7,
} AtrousPreset;

typedef enum AtrousSignals {
  ATROUS_SIGNALS_TOGETHER = 0,
  ATROUS_SIGNALS_APART = 1,
  ATROUS_SIGNALS_SPECULAR = 2,
  ATROUS_SIGNALS_MIXED = 3,
} AtrousSignals;

typedef enum AtrousAdaptiveRule {
  ATROUS_ADAPTIVE_RULE_CHANGE_TEST = 0,
  ATROUS_ADAPTIVE_RULE_PERCENTILES = 1,
} AtrousAdaptiveRule;

typedef enum AtrousGradientSource {
  ATROUS_GRADIENT_SOURCE_FORWARD_PROJECTED = 0,
  ATROUS_GRADIENT_SOURCE_RESHADED = 1,
  ATROUS_GRADIENT_SOURCE_SPARSE = 2,
  ATROUS_GRADIENT_SOURCE_CONFIDENCE = 3,
  ATROUS_GRADIENT_SOURCE_CHANGE_TEST = 4,
} AtrousGradientSource;

typedef enum AtrousSampling {
  ATROUS_SAMPLING_FULL = 0,
  ATROUS_SAMPLING_ONE_OF_2X2 = 1,
  ATROUS_SAMPLING_ONE_OF_4X4 = 2,
} AtrousSampling;

typedef enum AtrousPostProcess {
  ATROUS_POST_PROCESS_NONE = 0,
  ATROUS_POST_PROCESS_TONE_MAP = 1,
  ATROUS_POST_PROCESS_TONE_MAP_TAA = 2,
} AtrousPostProcess;

typedef enum AtrousEawWeights {
  ATROUS_EAW_WEIGHTS_RADIANCE = 1,
  ATROUS_EAW_WEIGHTS_NORMAL = 2,
  ATROUS_EAW_WEIGHTS_POSITION = 4,
} AtrousEawWeights;

typedef enum AtrousPhase {
  ATROUS_PHASE_BEFORE_LIGHTING = 0,
  ATROUS_PHASE_AFTER_LIGHTING = 1,
  ATROUS_PHASE_POST_PROCESS = 2,
} AtrousPhase;

typedef enum AtrousReset {
  ATROUS_RESET_NONE = 0,
  ATROUS_RESET_CREATED = 1,
  ATROUS_RESET_CAMERA_CUT = 2,
  ATROUS_RESET_RESIZE = 3,
  ATROUS_RESET_SCENE_LOAD = 4,
  ATROUS_RESET_ORIGIN_SHIFT = 5,
  ATROUS_RESET_EXPOSURE_JUMP = 6,
} AtrousReset;

typedef enum AtrousView {
  ATROUS_VIEW_NONE = 0,
  ATROUS_VIEW_HISTORY_LENGTH = 1,
  ATROUS_VIEW_DEVIATION = 2,
  ATROUS_VIEW_MEAN_AND_DEVIATION = 3,
  ATROUS_VIEW_GRADIENT = 4,
  ATROUS_VIEW_LAMBDA = 5,
  ATROUS_VIEW_ALPHA = 6,
  ATROUS_VIEW_PERCENTILES = 7,
  ATROUS_VIEW_FIREFLIES = 8,
  ATROUS_VIEW_DISOCCLUSION = 9,
  ATROUS_VIEW_MOTION = 10,
  ATROUS_VIEW_NORMAL = 11,
  ATROUS_VIEW_DEPTH = 12,
  ATROUS_VIEW_SURFACE_ID = 13,
  ATROUS_VIEW_BAD_VALUES = 14,
  ATROUS_VIEW_HIT_DISTANCE = 15,
  ATROUS_VIEW_LOBE_ANGLE = 16,
  ATROUS_VIEW_VIRTUAL_MOTION = 17,
  ATROUS_VIEW_REFLECTION_HISTORY = 18,
  ATROUS_VIEW_VISIBILITY = 19,
  ATROUS_VIEW_PENUMBRA = 20,
} AtrousView;

// Indices of atrous_executor_statistics, and of the words in the buffer `statistics`.

typedef enum AtrousCounter {
  ATROUS_COUNTER_DEPTH = 0,
  ATROUS_COUNTER_NORMAL = 1,
  ATROUS_COUNTER_MOTION = 2,
  ATROUS_COUNTER_RADIANCE = 3,
  ATROUS_COUNTER_ALBEDO = 4,
  ATROUS_COUNTER_EMISSION = 5,
  ATROUS_COUNTER_FORWARD_MOTION = 6,
  ATROUS_COUNTER_SCATTERING_DEPTH = 7,
  ATROUS_COUNTER_ROUGHNESS = 8,
  ATROUS_COUNTER_HIT_DISTANCE = 9,
  ATROUS_COUNTER_VISIBILITY = 10,
  ATROUS_COUNTER_OCCLUDER_DISTANCE = 11,
  ATROUS_COUNTER_HISTORY_KEPT = 12,
  ATROUS_COUNTER_LOST_OFF_SCREEN = 13,
  ATROUS_COUNTER_LOST_SURFACE_ID = 14,
  ATROUS_COUNTER_LOST_DEPTH = 15,
  ATROUS_COUNTER_LOST_NORMAL = 16,
  ATROUS_COUNTER_SATURATED = 17,
  ATROUS_COUNTER_HIT_ID = 18,
  ATROUS_COUNTER_OCCLUDER_ID = 19,
  ATROUS_COUNTER_OCCLUDER_MOTION = 20,
  ATROUS_COUNTER_SPECULAR_MOTION = 21,
  ATROUS_COUNTER_MATERIAL_CLASS = 22,
  ATROUS_COUNTER_REPEATED_SAMPLE = 23,
} AtrousCounter;

#define ATROUS_COUNTER_COUNT 24

// Nodes for atrous_graph_node with their arguments, of which those in brackets have defaults: Graph and nodes in the
// documentation of the crate say what each means. A choice is given by its name.

// radiance(name)
#define ATROUS_NODE_RADIANCE "radiance"

// transient(name, format, [divisor])
#define ATROUS_NODE_TRANSIENT "transient"

// pair(first, second)
#define ATROUS_NODE_PAIR "pair"

// history(of, [feedback])
#define ATROUS_NODE_HISTORY "history"

// filter_exposure(noisy, [specular, volume])
#define ATROUS_NODE_FILTER_EXPOSURE "filter_exposure"

// gradient(guides, noisy, [source, samples, stratum_size])
#define ATROUS_NODE_GRADIENT "gradient"

// gradient_and_ratio(guides, noisy, [source, samples, stratum_size])
#define ATROUS_NODE_GRADIENT_AND_RATIO "gradient_and_ratio"

// firefly_limits_of_frame(port, percentiles)
#define ATROUS_NODE_FIREFLY_LIMITS_OF_FRAME "firefly_limits_of_frame"

// upsample(guides, filtered)
#define ATROUS_NODE_UPSAMPLE "upsample"

// debug_view(guides, noisy, [albedo, history, deviation, confidence, gradient, reflection, visibility, percentiles, limits])
#define ATROUS_NODE_DEBUG_VIEW "debug_view"

// import([surface_id, object_normal, albedo, material_class])
#define ATROUS_NODE_IMPORT "import"

// forward_project(guides, [stratum_size, forward_motion, surface_id])
#define ATROUS_NODE_FORWARD_PROJECT "forward_project"

// demodulate(guides, noisy, [albedo, sampling, gradient, samples])
#define ATROUS_NODE_DEMODULATE "demodulate"

// fill_holes(guides, irradiance, [sampling])
#define ATROUS_NODE_FILL_HOLES "fill_holes"

// block_percentiles(guides, irradiance)
#define ATROUS_NODE_BLOCK_PERCENTILES "block_percentiles"

// volume_percentiles(guides, radiance)
#define ATROUS_NODE_VOLUME_PERCENTILES "volume_percentiles"

// firefly_limits(guides, irradiance, percentiles)
#define ATROUS_NODE_FIREFLY_LIMITS "firefly_limits"

// firefly(guides, irradiance, limits)
#define ATROUS_NODE_FIREFLY "firefly"

// volume_firefly(guides, radiance, limits)
#define ATROUS_NODE_VOLUME_FIREFLY "volume_firefly"

// block_difference(guides, irradiance, history)
#define ATROUS_NODE_BLOCK_DIFFERENCE "block_difference"

// change_test(difference)
#define ATROUS_NODE_CHANGE_TEST "change_test"

// change_and_steadiness(difference)
#define ATROUS_NODE_CHANGE_AND_STEADINESS "change_and_steadiness"

// gradient_atrous(guides, gradient)
#define ATROUS_NODE_GRADIENT_ATROUS "gradient_atrous"

// history_confidence(gradient, [tested])
#define ATROUS_NODE_HISTORY_CONFIDENCE "history_confidence"

// host_confidence()
#define ATROUS_NODE_HOST_CONFIDENCE "host_confidence"

// percentile_rule(guides, percentiles, history)
#define ATROUS_NODE_PERCENTILE_RULE "percentile_rule"

// temporal_accumulation(guides, irradiance, history, [confidence, repair, sharp, light_ratio, alpha, alpha_moments,
// max_history_length, depth_tolerance, normal_tolerance])
#define ATROUS_NODE_TEMPORAL_ACCUMULATION "temporal_accumulation"

// specular_history(irradiance, [feedback])
#define ATROUS_NODE_SPECULAR_HISTORY "specular_history"

// specular_accumulation(guides, irradiance, history, [confidence, alpha, alpha_moments, sharp, mixed, light_ratio])
#define ATROUS_NODE_SPECULAR_ACCUMULATION "specular_accumulation"

// variance(guides, accumulated, history, [estimator, spatial_variance_frames])
#define ATROUS_NODE_VARIANCE "variance"

// atrous(guides, estimate, [levels, kernel, luminance_weight, feedback, reflection, sigma_l, sigma_n, sigma_z])
#define ATROUS_NODE_ATROUS "atrous"

// eaw(guides, irradiance, [levels, weights, sampling, feedback])
#define ATROUS_NODE_EAW "eaw"

// modulate(guides, filtered, [albedo, mixed, specular, emission, float_output, detail])
#define ATROUS_NODE_MODULATE "modulate"

// tone_map(denoised)
#define ATROUS_NODE_TONE_MAP "tone_map"

// temporal_upscale(guides, radiance, [tone_mapped])
#define ATROUS_NODE_TEMPORAL_UPSCALE "temporal_upscale"

// volume()
#define ATROUS_NODE_VOLUME "volume"

// volume_motion(guides, volume)
#define ATROUS_NODE_VOLUME_MOTION "volume_motion"

// volume_points(volume)
#define ATROUS_NODE_VOLUME_POINTS "volume_points"

// volume_accumulation(guides, radiance, history, motion)
#define ATROUS_NODE_VOLUME_ACCUMULATION "volume_accumulation"

// volume_variance(guides, accumulated, history)
#define ATROUS_NODE_VOLUME_VARIANCE "volume_variance"

// volume_atrous(guides, estimate, [levels, feedback, keeps_exposure])
#define ATROUS_NODE_VOLUME_ATROUS "volume_atrous"

// visibility_samples(guides, [count, coloured, ambient])
#define ATROUS_NODE_VISIBILITY_SAMPLES "visibility_samples"

// visibility_accumulation(guides, samples)
#define ATROUS_NODE_VISIBILITY_ACCUMULATION "visibility_accumulation"

// visibility_filter(guides, accumulated, levels)
#define ATROUS_NODE_VISIBILITY_FILTER "visibility_filter"

// shadowed_light(radiance, visibility)
#define ATROUS_NODE_SHADOWED_LIGHT "shadowed_light"

// Initialisers of AtrousArgument: { ATROUS_PORT("guides", guides), ATROUS_NUMBER("levels", 4) }.

#define ATROUS_PORT(name, port) {(name), ATROUS_ARGUMENT_KIND_PORT, (port), 0, 0}
#define ATROUS_PREVIOUS(name, port) {(name), ATROUS_ARGUMENT_KIND_PREVIOUS, (port), 0, 0}
#define ATROUS_NUMBER(name, number) {(name), ATROUS_ARGUMENT_KIND_NUMBER, 0, (double)(number), 0}
#define ATROUS_TEXT(name, text) {(name), ATROUS_ARGUMENT_KIND_TEXT, 0, 0, (text)}
#define ATROUS_CONSTANT(name, number) {(name), ATROUS_ARGUMENT_KIND_CONSTANT, 0, (double)(number), 0}


// Bytes of a name, with its null.
#define ATROUS_NAME_SIZE 64

// Most uses of a pass.
#define ATROUS_MAX_USES 32

// Bytes of the text of a report, with its null.
#define ATROUS_REPORT_SIZE 4096

// The result of a function of the C ABI.
enum AtrousStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Success.
  ATROUS_STATUS_OK = 0,
  // A pointer is null, a struct_size is wrong, or a value is out of range.
  ATROUS_STATUS_INVALID_ARGUMENT = 1,
  // The handle is null, was destroyed, or never was one.
  ATROUS_STATUS_INVALID_HANDLE = 2,
  // The frame was not begun, or was begun before the last resize.
  ATROUS_STATUS_STALE_FRAME = 3,
  // The bindings do not fit the pass in number or kind.
  ATROUS_STATUS_BAD_BINDINGS = 4,
  // The device lacks a feature or a format.
  ATROUS_STATUS_UNSUPPORTED_DEVICE = 5,
  // Memory ran out.
  ATROUS_STATUS_OUT_OF_MEMORY = 6,
  // A different Vulkan call failed.
  ATROUS_STATUS_VULKAN_ERROR = 7,
  // A bug in atrous: it panicked. Destroy your denoiser.
  ATROUS_STATUS_PANICKED = 8,
  // Passes of the previous frame were left out: see atrous_set_checks.
  ATROUS_STATUS_LEFT_OUT = 9,
  // The GPU still works on the frame slot: see complete_frames of AtrousFrameParams.
  ATROUS_STATUS_IN_FLIGHT = 10,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum AtrousStatus AtrousStatus;
#else
typedef uint32_t AtrousStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The content of an AtrousArgument.
enum AtrousArgumentKind
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // `port`; 0 leaves the argument out.
  ATROUS_ARGUMENT_KIND_PORT = 0,
  // `port`, with its content of the frame before: for a binding of your stage.
  ATROUS_ARGUMENT_KIND_PREVIOUS = 1,
  // `number`; of a flag 0 or 1.
  ATROUS_ARGUMENT_KIND_NUMBER = 2,
  // `text`: the name of a choice, of a tunable, or of an image.
  ATROUS_ARGUMENT_KIND_TEXT = 3,
  // `number`, for a specialisation constant of your stage.
  ATROUS_ARGUMENT_KIND_CONSTANT = 4,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum AtrousArgumentKind AtrousArgumentKind;
#else
typedef uint32_t AtrousArgumentKind;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A denoiser. Opaque: the pointer is a number that is never followed, so that a wrong one is an error and not a crash.
typedef struct AtrousDenoiser AtrousDenoiser;

// A denoiser with its images, barriers and memory. Opaque, as AtrousDenoiser is.
typedef struct AtrousExecutor AtrousExecutor;

// A graph of your own that is being built. Opaque, as AtrousDenoiser is.
typedef struct AtrousGraph AtrousGraph;

// Pipelines that the denoisers of a device share. Opaque, as AtrousDenoiser is.
typedef struct AtrousPipelines AtrousPipelines;

// The states of the images and buffers of a denoiser. Opaque, as AtrousDenoiser is.
typedef struct AtrousTracker AtrousTracker;

// Your choices; `atrous_config_default` fills them in.
typedef struct AtrousConfig {
  // sizeof(AtrousConfig).
  uint32_t struct_size;
  // Width of your images, pixels.
  uint32_t width;
  // Height of your images, pixels.
  uint32_t height;
  // Encoding of depth. 0 (linear), 1 (device), 2 (ray_length). Default: 0.
  uint32_t depth;
  // Linear depth from which on a pixel is background, above 0. 1e15 and beyond always are. Default: inf.
  float background_depth;
  // Encoding of normals. 0 (xyz), 1 (xyz_unorm), 2 (octahedral), 3 (octahedral_unorm). Default: 0.
  uint32_t normal;
  // Space of the normals. 0 (world), 1 (view). Default: 0.
  uint32_t normal_space;
  // Unit of the motion. 0 (pixels), 1 (uv), 2 (ndc). Default: 1.
  uint32_t motion_unit;
  // Sign of the motion. 0 (previous_minus_current), 1 (current_minus_previous). Default: 0.
  uint32_t motion_direction;
  // Whether y of the motion points up. A file has it as `motion_y`, `"up"` or `"down"`. 0 (false), 1 (true). Default: 0.
  uint32_t motion_y_up;
  // Whether the motion includes the change of jitter. 0 (false), 1 (true). Default: 0.
  uint32_t motion_jittered;
  // Meaning of z of the motion. 0 (none), 1 (difference), 2 (absolute). Default: 0.
  uint32_t motion_depth;
  // Direction in which the camera looks. 0 (negative_z), 1 (positive_z). Default: 0.
  uint32_t view_forward;
  // Encoding of roughness. 0 (linear), 1 (alpha). Default: 0.
  uint32_t roughness;
  // Frames that you record before you wait for the oldest, 1 to 8. Default: 2.
  uint32_t frames_in_flight;
  // Filter. 0 (svgf), 1 (asvgf), 2 (stabilize), 3 (percentile), 4 (eaw), 5 (volume), 6 (fast), 7 (best). Default: 7.
  uint32_t preset;
  // Signals. Together: one image, `noisy_radiance`. Apart: `noisy_direct` and `noisy_indirect`. Specular: `noisy_diffuse`
  // and `noisy_specular`. Mixed: `noisy_radiance`, by `roughness`. 0 (together), 1 (apart), 2 (specular), 3 (mixed).
  // Default: 0.
  uint32_t signals;
  // À-trous levels, 1 to 10; none: those of the preset, `Preset::levels`. 0 is none. Default: 0.
  uint32_t levels;
  // Whether you give a volume (fog, smoke) apart, as the input `noisy_volume`. The filter gives it motion of its own
  // [PSVGF] and writes `denoised_volume`. The volume is the light that the medium itself scatters towards the camera.
  // The radiance of surfaces is the light that reaches the camera through the medium. Their sum is the picture, which
  // the post-process shows. Costs 40 bytes per pixel, and 8 of the output. 0 (false), 1 (true). Default: 0.
  uint32_t volume;
  // Number of lights, such as the sun, whose visibility you give apart: 0 to 4. The input `noisy_visibility` goes from 0
  // (occluded) to 1 (lit), usually one of the two. The input `occluder_distance` is the distance from the surface to the
  // occluder along the shadow ray (scene units; 0 or infinite: none, or not known). The output is `denoised_visibility`.
  // Set the size of the light with `Tuning::light_radius`. The names of further lights end in `_1` to `_3`. Costs 12
  // bytes per pixel for one light, the outputs included, and 66 for four. Default: 0.
  uint32_t visibility;
  // Whether outliers of the input are scaled down to the usual brightness around them, before they reach the history
  // [PSVGF]. `Preset::Percentile` always does so. 0 (false), 1 (true). Default: 0.
  uint32_t firefly_filter;
  // How the preset `Percentile` detects changes of light. 0 (change_test), 1 (percentiles). Default: 0.
  uint32_t adaptive_rule;
  // Side of the strata of temporal gradients, 2 to 4 pixels. Only for presets with gradients. Default: 3.
  uint32_t stratum_size;
  // Source of the temporal gradients. Only for presets with gradients. If you cannot shade again, take
  // `GradientSource::ChangeTest`: fewer passes and bytes. 0 (forward_projected), 1 (reshaded), 2 (sparse), 3
  // (confidence), 4 (change_test). Default: 0.
  uint32_t gradient_source;
  // Whether you have an image `forward_motion`, for deforming surfaces. It has the motion of every pixel of the previous
  // frame to this frame. Only for forward-projected gradients. 0 (false), 1 (true). Default: 0.
  uint32_t forward_motion;
  // Edge-stopping functions of the preset `Eaw`. The sum of any of 1 (radiance), 2 (normal), 4 (position). Default: 7.
  uint32_t eaw_weights;
  // Share of the pixels with a sample in each frame, for checkerboards and tracing at half the rate. Make the other
  // pixels NaN in your noisy images. Costs 8 bytes per pixel and signal until history is read, and one pass per signal.
  // Not for `Preset::Stabilize` and volumes, which need a sample in every pixel. 0 (full), 1 (one_of_2x2), 2
  // (one_of_4x4). Default: 0.
  uint32_t sampling;
  // Whether you have an image of surface ids. 0 (false), 1 (true). Default: 1.
  uint32_t surface_id;
  // Whether you have object-space normals. With them a turning object keeps its history. Costs 8 bytes per pixel. 0
  // (false), 1 (true). Default: 0.
  uint32_t object_normal;
  // Post-process. 0 (none), 1 (tone_map), 2 (tone_map_taa). Default: 0.
  uint32_t post_process;
  // Whether `denoised_radiance` and `denoised_volume` have 32-bit floats (R32G32B32A32_SFLOAT) instead of halves. Your
  // light may have any unit, and halves hold only 1e-4 to 65504 of it. Costs 8 bytes per pixel of each, and one pass for
  // a volume. 0 (false), 1 (true). Default: 0.
  uint32_t float_output;
  // Whether you want a last pass `debug_view`, which shows the state of each pixel: see `DebugView`. It keeps the shown
  // images alive to the end, so you cannot alias these transients. You may leave the pass out of a frame. 0 (false), 1
  // (true). Default: 0.
  uint32_t debug_view;
  // Width and height of the picture that you show, 1 to 3 times those of the rendered one, each by itself. The
  // post-process then gathers the jittered frames at this size. Its result is `display`, or `upscaled_radiance` with
  // `PostProcess::None`. Costs 16 bytes per pixel of the output, and 8 of the result. None: the picture has the size
  // that you rendered. 0, 0 is none. Default: 0, 0.
  uint32_t output_extent[2];
  // Factor of the motion's x and y, above 0. For example 50, if you store pixels times 0.02. Default: 1.0.
  float motion_scale;
  // Channel of `roughness` that holds it, for example alpha behind a reflectance. 0 (r), 1 (g), 2 (b), 3 (a). Default: 0.
  uint32_t roughness_channel;
  // Whether your light comes divided by `albedo`, as irradiance: all noisy signals but `noisy_specular` and
  // `noisy_volume`, and `other_denoised_radiance`. The filter then multiplies by the albedo, and does not divide. 0
  // (false), 1 (true). Default: 0.
  uint32_t demodulated;
  // Whether you want the output `reactive_mask` for an upscaler of your own. Red is the share of a pixel that is new:
  // history was lost, is short, or light changed. Green is the share of its light that is emitted. Only for presets with
  // a history. Costs 8 bytes per pixel and one pass. 0 (false), 1 (true). Default: 0.
  uint32_t reactive_mask;
  // Width and height of your noisy images, each that of the rendered picture or half of it, which is even then. Guides,
  // albedo and emission keep the rendered size, and so does the result. In each frame say which pixel you traced:
  // `FrameParams::light_offset`. Hit and occluder distances and ids, confidence, gradients and forward motion have the
  // size of the light. None: it has the rendered size. 0, 0 is none. Default: 0, 0.
  uint32_t light_extent[2];
  // Whether the visibility of lights has a colour, for stained glass and leaves: red, green and blue of
  // `noisy_visibility` and `denoised_visibility`. Costs about twice the memory of grey ones. 0 (false), 1 (true).
  // Default: 0.
  uint32_t coloured_visibility;
  // Whether you give ambient occlusion apart. The input `noisy_ambient` is 0 where a ray into the hemisphere, drawn by
  // the cosine, hit something, and 1 where it did not. The input `ambient_distance` is the distance of that hit (scene
  // units; 0 or infinite: none). The output is `denoised_ambient`: multiply your ambient light by it. Costs 12 bytes per
  // pixel, the output included. 0 (false), 1 (true). Default: 0.
  uint32_t ambient_occlusion;
  // Width and height of your images, where the picture is a part of them: of an atlas, or of two views side by side.
  // Inputs and outputs with a texel per pixel then have this size, and in each frame you say where the picture begins:
  // `FrameParams::viewport_origin`. What lies outside is neither read nor written. Keep the old content of outputs that
  // you share. None: they have the allocated extent. 0, 0 is none. Default: 0, 0.
  uint32_t image_extent[2];
  // Whether you give a class of materials per pixel, as the input `material_class`: 0 to 15. Each class has an entry in
  // `FrameParams::materials`: factors of tolerances and of the filter's strength, and a longest history. They hold where
  // surfaces are accumulated and in the levels of the filter, not in `Preset::Eaw`. Costs no memory. 0 (false), 1
  // (true). Default: 0.
  uint32_t material_class;
} AtrousConfig;

// The device of the passes. Handles stay yours.
typedef struct AtrousCreateInfo {
  // sizeof(AtrousCreateInfo).
  uint32_t struct_size;
  // Instance of the device.
  VkInstance instance;
  // Physical device of the device.
  VkPhysicalDevice physical_device;
  // Device.
  VkDevice device;
  // `vkGetInstanceProcAddr` of the loader that made the instance.
  PFN_vkGetInstanceProcAddr get_instance_proc_addr;
  // Configuration; read during the call alone. NULL if you give a graph.
  const struct AtrousConfig *config;
  // Your pipeline cache, or null. Used during the call alone, on several threads, so it must not
  // be externally synchronised.
  VkPipelineCache pipeline_cache;
  // Of an executor: 1: barriers by vkCmdPipelineBarrier, for devices without synchronization2.
  uint32_t legacy_barriers;
  // 1: names every object, and an executor labels every pass. VK_EXT_debug_utils is enabled on the
  // instance.
  uint32_t debug_labels;
  // A graph of your own instead of a configuration, or NULL; read during the call alone.
  const struct AtrousGraph *graph;
  // Checks of bindings and frames, see atrous_set_checks: 0, in debug builds of the library; 1, on; 2, off.
  uint32_t checks;
  // Of an executor: 1 checks the guides of the first frames, as atrous_check_conventions does, and logs its findings once:
  // atrous_set_log. It takes a good part of a second a frame, and ends with the first answer. The images of your guides need the
  // usage TRANSFER_SRC.
  uint32_t check_guides;
  // Of an executor: 1 uses every image in VK_IMAGE_LAYOUT_GENERAL, for engines with one layout: images that are there already
  // have barriers of memory alone.
  uint32_t stay_in_general;
  // 0.
  uint32_t reserved;
  // Pipelines that denoisers of this device share, or NULL.
  const struct AtrousPipelines *pipelines;
} AtrousCreateInfo;

// Parameters of a frame; `atrous_frame_params_default` fills it.
typedef struct AtrousFrameParams {
  // sizeof(AtrousFrameParams).
  uint32_t struct_size;
  // Frame slot, below frames_in_flight; GPU work recorded earlier with the same slot is complete.
  uint32_t frame_slot;
  // Your reason to drop the history: 0 (none), 1 (created), 2 (camera_cut), 3 (resize), 4
  // (scene_load), 5 (origin_shift), 6 (exposure_jump). You need not report 1.
  uint32_t reset;
  // Width rendered this frame, anchored top left.
  uint32_t render_width;
  // Height rendered this frame.
  uint32_t render_height;
  // World to view, column-major.
  float view_from_world[16];
  // View to Vulkan clip space, unjittered, column-major.
  float clip_from_view[16];
  // Offset of the samples from the pixel centres, pixels.
  float jitter[2];
  // Exposure of this frame divided by that of the previous one.
  float exposure_ratio;
  // 1: you re-shade this frame's `gradient_samples`.
  uint32_t reshaded;
  // The view of the pass `debug_view`; without one you leave the pass out.
  //
  // 0 (none), 1 (history_length), 2 (deviation), 3 (mean_and_deviation), 4 (gradient), 5 (lambda), 6 (alpha), 7 (percentiles), 8
  // (fireflies), 9 (disocclusion), 10 (motion), 11 (normal), 12 (depth), 13 (surface_id), 14 (bad_values),
  // 15 (hit_distance), 16 (lobe_angle), 17 (virtual_motion), 18 (reflection_history), 19 (visibility), 20 (penumbra).
  uint32_t debug_view;
  // Number of frames whose GPU work is complete, of those that you began: for example the value of a timeline semaphore that each
  // frame raises by 1. With atrous_set_checks, a slot whose last frame is not among them is refused. UINT64_MAX: you do not say.
  uint64_t complete_frames;
  // Four numbers for each light whose visibility you give, its place in world space: x, y, z, 1 of a lamp, or x, y, z, 0 towards a
  // sun. 0: not known.
  float lights[16];
  // With AtrousConfig.light_extent, the rendered pixel of each cell that light was traced for: 0, or 1 along a halved axis.
  uint32_t light_offset[2];
  // With AtrousConfig.image_extent, the pixel of your images at which this picture begins.
  uint32_t viewport_origin[2];
  // Width and height of the picture that you show, anchored top left: at most AtrousConfig.output_extent, and 1 to 3 times what is
  // rendered. They may differ from frame to frame. 0, 0: all of it.
  uint32_t output_extent[2];
  // With AtrousConfig.material_class, four numbers for each of 16 classes: factors of tolerated differences of depth and of normals,
  // factor of sigma_l, each 0.01 to 100, and the longest history, 1 to 1024 frames. Default: 1, 1, 1, 1024.
  float materials[64];
} AtrousFrameParams;

// A buffer for a name.
typedef char AtrousName[ATROUS_NAME_SIZE];

// A resource that you allocate or give.
typedef struct AtrousResource {
  // sizeof(AtrousResource), set by you.
  uint32_t struct_size;
  // 0: image; 1: buffer.
  uint32_t kind;
  // 0: input; 1: output; 2: transient; 3: history of two copies; 4: history in place.
  uint32_t lifetime;
  // Number of copies that you allocate: 2 of a history, 0 of an input.
  uint32_t copies;
  // 1: an input that you may leave out.
  uint32_t optional;
  // 0: exactly `format`; 1: any floating-point or normalised format; 2: any unsigned integer format.
  uint32_t format_class;
  // Format for your image.
  VkFormat format;
  // Width of the image.
  uint32_t width;
  // Height of the image.
  uint32_t height;
  // Usage of the image by the passes; OR in your own.
  VkImageUsageFlags image_usage;
  // Usage of the buffer by the passes; OR in your own.
  VkBufferUsageFlags buffer_usage;
  // Index of the first pass that uses it.
  uint32_t first_pass;
  // Index of the last pass that uses it. Transients may share memory if these ranges do not
  // overlap.
  uint32_t last_pass;
  // Bytes of one copy, texels alone.
  uint64_t bytes;
  // Stable key.
  AtrousName name;
} AtrousResource;

// The use of a resource by a pass.
typedef struct AtrousUse {
  // Index of the resource.
  uint32_t resource;
  // 1: the copy of the previous frame.
  uint32_t previous;
  // 0: sampled; 1: storage read; 2: storage write of every texel; 3: storage read and write; 4: uniform; 5: transfer write.
  uint32_t access;
  // 1: old content matters; 0: you may discard it.
  uint32_t reads;
  // 1: content changes.
  uint32_t writes;
  // Layout of an image; VK_IMAGE_LAYOUT_GENERAL is always legal instead.
  VkImageLayout layout;
  // Stage of synchronization2.
  VkPipelineStageFlags2 stage;
  // Access mask of synchronization2.
  VkAccessFlags2 access_mask;
  // Stage for vkCmdPipelineBarrier.
  VkPipelineStageFlags legacy_stage;
  // Access mask for vkCmdPipelineBarrier.
  VkAccessFlags legacy_access_mask;
} AtrousUse;

// A pass: the smallest thing to schedule. Every barrier belongs between passes.
typedef struct AtrousPass {
  // sizeof(AtrousPass), set by you.
  uint32_t struct_size;
  // 0: before lighting; 1: after lighting; 2: post-process.
  uint32_t phase;
  // Uses, and thereby bindings.
  uint32_t use_count;
  // The first `use_count` are set.
  struct AtrousUse uses[ATROUS_MAX_USES];
  // Name for labels and profiles.
  AtrousName name;
} AtrousPass;

// Bytes of the declared resources, before you allocate any. Your device may add alignment.
typedef struct AtrousMemory {
  // sizeof(AtrousMemory), set by you.
  uint32_t struct_size;
  // Histories, which survive the frame.
  uint64_t history;
  // Transients, if you alias them by lifetime.
  uint64_t transient;
  // Transients, if you alias none.
  uint64_t transient_unaliased;
  // Outputs.
  uint64_t output;
} AtrousMemory;

// A transient that you place in memory of your own.
typedef struct AtrousPlacement {
  // Index of the resource.
  uint32_t resource;
  // 0.
  uint32_t reserved;
  // Bytes that its image needs.
  uint64_t size;
  // Alignment that its image needs.
  uint64_t alignment;
  // Where it goes: set by atrous_place_transients.
  uint64_t offset;
} AtrousPlacement;

// A number of the tuning, for user interfaces.
typedef struct AtrousTuningField {
  // sizeof(AtrousTuningField), set by you.
  uint32_t struct_size;
  // Smallest legal value.
  float min;
  // Largest legal value.
  float max;
  // Default in the default preset. Other presets may differ.
  float default_value;
  // Name for atrous_set_tuning.
  AtrousName name;
} AtrousTuningField;

// A frame that was begun. Plain data: copy it as you like.
typedef struct AtrousFrame {
  // sizeof(AtrousFrame), set by you before `atrous_begin_frame`.
  uint32_t struct_size;
  // The frame slot of AtrousFrameParams.
  uint32_t frame_slot;
  // Number of the frame, from 0.
  uint64_t index;
  // Counts resizes.
  uint64_t generation;
  // The current copy of a resource with two copies: 0 or 1. The other one is the previous.
  uint32_t current_copy;
  // Whether and why history is dropped this frame: as in AtrousFrameParams, and 1 for the first frame.
  uint32_t reset;
} AtrousFrame;

// What a node of a graph returned; 0 is none.
typedef uint32_t AtrousPort;

// An argument of a node: ATROUS_PORT, ATROUS_NUMBER and so on fill it.
typedef struct AtrousArgument {
  // Name of the argument.
  const char *name;
  // One of AtrousArgumentKind.
  uint32_t kind;
  // A port of the same graph.
  AtrousPort port;
  // A number.
  double number;
  // A text.
  const char *text;
} AtrousArgument;

// A compute shader of yours, for atrous_graph_stage.
typedef struct AtrousStageInfo {
  // sizeof(AtrousStageInfo).
  uint32_t struct_size;
  // 0: before lighting; 1: after lighting; 2: post-process.
  uint32_t phase;
  // The member `level` of the push constants; 0 if there is none.
  uint32_t level;
  // Side of the block of pixels for which one invocation runs and one texel is made; 0 and 1: a pixel.
  uint32_t per_block;
  // Name of the stage.
  const char *name;
  // SPIR-V with its names.
  const uint32_t *spirv;
  // Words of it.
  uint64_t word_count;
} AtrousStageInfo;

// The binding for a use. An image: `image`, `view` and `layout`. A buffer: `buffer`, `offset`, `range`. All null: an optional
// input that is absent.
typedef struct AtrousBinding {
  // The image of the view, or null: no pass needs it.
  VkImage image;
  // 2D view of mip 0, layer 0.
  VkImageView view;
  // Layout of the image when the pass runs.
  VkImageLayout layout;
  // Buffer.
  VkBuffer buffer;
  // Offset in bytes.
  uint64_t offset;
  // Bytes, or VK_WHOLE_SIZE.
  uint64_t range;
} AtrousBinding;

// The last use of an image or buffer, or its next: one side of a barrier.
typedef struct AtrousState {
  // Stages of synchronization2.
  VkPipelineStageFlags2 stage;
  // Accesses of those stages.
  VkAccessFlags2 access;
  // Layout of an image; VK_IMAGE_LAYOUT_UNDEFINED for a buffer, and for content that no one needs.
  VkImageLayout layout;
  // Queue family that owns it. VK_QUEUE_FAMILY_IGNORED if ownership never changes.
  uint32_t queue_family;
} AtrousState;

// Barriers for one call. Their lists belong to the tracker, and are valid until the next call on it.
typedef struct AtrousBarriers {
  // sizeof(AtrousBarriers), set by you.
  uint32_t struct_size;
  // Elements of `memory`.
  uint32_t memory_count;
  // Elements of `buffers`.
  uint32_t buffer_count;
  // Elements of `images`.
  uint32_t image_count;
  // For vkCmdPipelineBarrier2. Of a tracker with legacy_barriers: empty.
  VkDependencyInfo dependency_info;
  // For vkCmdPipelineBarrier, as all below. Of a tracker without legacy_barriers: empty.
  VkPipelineStageFlags src_stage;
  // Stages that wait.
  VkPipelineStageFlags dst_stage;
  // Barriers of all memory.
  const VkMemoryBarrier *memory;
  // Barriers of buffers.
  const VkBufferMemoryBarrier *buffers;
  // Barriers of images.
  const VkImageMemoryBarrier *images;
} AtrousBarriers;

// An image that you lend for one call of `atrous_executor_denoise`: an input, or an output to be written.
typedef struct AtrousLentImage {
  // sizeof(AtrousLentImage), the same in the whole array.
  uint32_t struct_size;
  // Format of the view.
  VkFormat format;
  // Name of the resource, for example ATROUS_INPUT_DEPTH or "denoised_radiance".
  const char *name;
  // Image.
  VkImage image;
  // 2D view of `layer` and `level`.
  VkImageView view;
  // Width of that mip level.
  uint32_t width;
  // Height of that mip level.
  uint32_t height;
  // Its layout as the call finds it.
  VkImageLayout layout;
  // The layout that the call leaves it in. VK_IMAGE_LAYOUT_UNDEFINED: all as it was found.
  VkImageLayout after_layout;
  // Your stages that used it before.
  VkPipelineStageFlags2 stage;
  // Accesses of those stages.
  VkAccessFlags2 access;
  // Your next stages, unless after_layout is VK_IMAGE_LAYOUT_UNDEFINED.
  VkPipelineStageFlags2 after_stage;
  // Accesses of those stages.
  VkAccessFlags2 after_access;
  // Array layer of the view.
  uint32_t layer;
  // Mip level of the view.
  uint32_t level;
} AtrousLentImage;

// Your guides for one frame, read back: tightly packed rows of width texels, each four floats.
typedef struct AtrousGuides {
  // sizeof(AtrousGuides).
  uint32_t struct_size;
  // Width of the images; at least the render width.
  uint32_t width;
  // Height of the images.
  uint32_t height;
  // Matrices, jitter and render extent of the frame.
  const struct AtrousFrameParams *params;
  // x: depth. width * height * 4 floats.
  const float *depth;
  // xyz, or octahedral xy. NULL: none.
  const float *normal;
  // xy. NULL: none.
  const float *motion;
  // One number a texel, 0 is the background. NULL: none.
  const uint32_t *surface_id;
} AtrousGuides;

// Whether your guides and conventions agree. Verdicts: 0 as declared; 1 a mistake; 2 not as declared, and nothing known fits; 3 the
// frames cannot tell; 4 not given.
typedef struct AtrousConventionReport {
  // sizeof(AtrousConventionReport), set by you.
  uint32_t struct_size;
  // Verdict on depth, matrices and jitter.
  uint32_t geometry;
  // Verdict on motion, x and y.
  uint32_t motion;
  // Verdict on z of the motion.
  uint32_t motion_depth;
  // Verdict on normals.
  uint32_t normals;
  // The mistakes, the evidence in pixels and degrees, and the remedies.
  char text[ATROUS_REPORT_SIZE];
} AtrousConventionReport;

// Your function for messages. It may be called on any thread that calls the library, and must not throw.
typedef void (*AtrousLogCallback)(void *user, uint32_t level, const char *message);

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The message of the last failed call on your thread, empty before the first. It is valid until the next failure on that thread.
const char *atrous_last_error(void);

// The name of a status, for logs; never null.
const char *atrous_status_name(uint32_t status);

// Tells whether a device can run a configuration or a graph, and creates nothing. The status is that of success, or of an unsupported device:
// then atrous_last_error lists everything that is missing, for example a limit with its value. With a null `device` it looks at the
// physical device alone, before you create one. `executor` 1: the needs of an executor as well.
//
// # Safety
// Pointers are null or valid with their struct_size set; handles are live and belong together, `device` may be null.
AtrousStatus atrous_check_requirements(const struct AtrousCreateInfo *info,
                                       uint32_t executor);

// Fills a configuration with defaults for an extent.
//
// # Safety
// `config` is null or points to an AtrousConfig with its struct_size set.
AtrousStatus atrous_config_default(struct AtrousConfig *config, uint32_t width, uint32_t height);

// Fills the parameters of a frame with defaults: identity matrices, no jitter, no reset.
//
// # Safety
// `params` is null or points to an AtrousFrameParams with its struct_size set.
AtrousStatus atrous_frame_params_default(struct AtrousFrameParams *params,
                                         uint32_t width,
                                         uint32_t height);

// Creates a denoiser: pipelines and descriptor pools, no memory.
//
// # Safety
// Pointers are null or valid with their struct_size set; handles are live, belong together and outlive the denoiser.
AtrousStatus atrous_create(const struct AtrousCreateInfo *info,
                           struct AtrousDenoiser **denoiser);

// Destroys a denoiser. Your handle is invalid from then on, and stays so.
//
// # Safety
// GPU work that was recorded with it is complete; the device is live.
AtrousStatus atrous_destroy(struct AtrousDenoiser *denoiser);

// Declares everything for a new extent, and keeps the pipelines. Your history starts over. Begin
// your frames again: those begun before are refused. Nothing changes on the device, so your
// recorded work may still be in flight, as long as its images live. A refused extent changes
// nothing.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_resize(struct AtrousDenoiser *denoiser, uint32_t width, uint32_t height);

// Counts resources and passes. You may leave either pointer null.
//
// # Safety
// Pointers are null or valid.
AtrousStatus atrous_counts(const struct AtrousDenoiser *denoiser,
                           uint32_t *resources,
                           uint32_t *passes);

// Declares a resource.
//
// # Safety
// `resource` is null or points to an AtrousResource with its struct_size set.
AtrousStatus atrous_resource(const struct AtrousDenoiser *denoiser,
                             uint32_t index,
                             struct AtrousResource *resource);

// Declares a pass. Passes run in the order of their indices.
//
// # Safety
// `pass` is null or points to an AtrousPass with its struct_size set.
AtrousStatus atrous_pass(const struct AtrousDenoiser *denoiser,
                         uint32_t index,
                         struct AtrousPass *pass);

// Counts the bytes of the declared resources.
//
// # Safety
// `memory` is null or points to an AtrousMemory with its struct_size set.
AtrousStatus atrous_memory(const struct AtrousDenoiser *denoiser, struct AtrousMemory *memory);

// Places transients in memory of yours, so that those share it whose lives do not overlap. You give resource, size and alignment of
// each, as vkGetImageMemoryRequirements has them; you get each offset, and in `size` the bytes needed in all. Create such images
// with VK_IMAGE_CREATE_ALIAS_BIT, and call atrous_tracker_alias for each pair that overlaps.
//
// # Safety
// `size` is null or points to a number; `placements` points to `count` of them.
AtrousStatus atrous_place_transients(const struct AtrousDenoiser *denoiser,
                                     struct AtrousPlacement *placements,
                                     uint32_t count,
                                     uint64_t *size);

// Describes a number of the tuning by its index. You get an invalid argument beyond the last.
//
// # Safety
// `field` is null or points to an AtrousTuningField with its struct_size set.
AtrousStatus atrous_tuning_field(uint32_t index, struct AtrousTuningField *field);

// Sets a number of the tuning from the next frame on. You keep the history.
//
// # Safety
// `name` is null or a null-terminated string.
AtrousStatus atrous_set_tuning(struct AtrousDenoiser *denoiser, const char *name, float value);

// Makes the next frame drop all history. Call it after you re-created images.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_invalidate(struct AtrousDenoiser *denoiser);

// Starts a frame. Pass `frame` to every atrous_record of that frame.
//
// # Safety
// Pointers are null or valid with their struct_size set.
AtrousStatus atrous_begin_frame(struct AtrousDenoiser *denoiser,
                                const struct AtrousFrameParams *params,
                                struct AtrousFrame *frame);

// Begins a graph of your own. Of the configuration it takes the extents, the conventions, frames_in_flight, and the preset whose
// numbers the tuning begins with. Give the graph to atrous_create or atrous_executor_create, as often as you like; they tell mistakes
// of the whole, with node and port.
//
// # Safety
// Pointers are null or valid with their struct_size set.
AtrousStatus atrous_graph_create(const struct AtrousConfig *config,
                                 struct AtrousGraph **graph);

// Destroys a graph. Denoisers that were made of it stay.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_graph_destroy(struct AtrousGraph *graph);

// Adds one of ATROUS_NODE_*, with arguments by name. `scope` may be null; else its name follows those of the node's images and
// passes, for a node that appears twice. `result`, which may be null, becomes the port that the node returns, or 0. A refused
// call changes nothing.
//
// # Safety
// Strings are null or end in a null; `arguments` points to `count` of them; `result` is null or points to a port.
AtrousStatus atrous_graph_node(struct AtrousGraph *graph,
                               const char *node,
                               const char *scope,
                               const struct AtrousArgument *arguments,
                               uint32_t count,
                               AtrousPort *result);

// Adds a compute shader of yours as a stage. Its SPIR-V is for Vulkan 1.1 and has its names. Arguments are ports for its bindings
// by their names, numbers or tunables for members of its push constants, and specialisation constants. Each storage image that it
// writes and that you leave out is made for you. `result` becomes a port whose parts are the images that it writes:
// atrous_graph_part. docs/add_a_stage.md has more. A refused call changes nothing.
//
// # Safety
// Pointers are null or valid, `info` with its struct_size set; strings end in a null; `arguments` points to `count` of them;
// `spirv` of `info` points to `word_count` words. The SPIR-V is valid: the output of a compiler.
AtrousStatus atrous_graph_stage(struct AtrousGraph *graph,
                                const struct AtrousStageInfo *info,
                                const struct AtrousArgument *arguments,
                                uint32_t count,
                                AtrousPort *result);

// A part of what a node returned: `first` and `second` of a port of two signals, an image of guides by its name, the image that a
// stage wrote by the name of its binding. An error lists the parts that there are.
//
// # Safety
// `part` is null or ends in a null; `result` is null or points to a port.
AtrousStatus atrous_graph_part(struct AtrousGraph *graph,
                               AtrousPort port,
                               const char *part,
                               AtrousPort *result);

// Makes an image an output of this name, which you allocate and read.
//
// # Safety
// `name` is null or ends in a null.
AtrousStatus atrous_graph_output(struct AtrousGraph *graph, const char *name, AtrousPort port);

// Sets whether transients may lie in the images of outputs before those are written, which saves 8 bytes per pixel: 1, as from the
// start, or 0, if you still read the outputs of the previous frame then.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_graph_share_outputs(struct AtrousGraph *graph,
                                        uint32_t on);

// Creates a store of pipelines for one device, which is empty. Give it in AtrousCreateInfo to denoisers and executors: a second view
// or another preset creates only those pipelines that none before it had.
//
// # Safety
// `pipelines` is null or points to a pointer.
AtrousStatus atrous_pipelines_create(struct AtrousPipelines **pipelines);

// Forgets its pipelines. Those that a denoiser uses live as long as it does.
//
// # Safety
// The device is live.
AtrousStatus atrous_pipelines_clear(struct AtrousPipelines *pipelines);

// Destroys a store of pipelines. Those that a denoiser uses live as long as it does. Your handle is invalid from then on, and stays
// so.
//
// # Safety
// The device is live.
AtrousStatus atrous_pipelines_destroy(struct AtrousPipelines *pipelines);

// Records one pass. It allocates nothing; you place the barriers and submit. Give the `bindings` in the order of the pass's uses.
//
// Clobbers the compute pipeline, compute descriptor set 0 and push constants of the command buffer.
//
// # Safety
// Pointers are null or valid. The command buffer is recording, outside a render pass, for a queue family with compute. Every
// binding has its declared format, extent and layout, earlier writes to it are visible, and it outlives the execution. GPU work
// that was recorded earlier with the same frame_slot is complete.
AtrousStatus atrous_record(struct AtrousDenoiser *denoiser,
                           const struct AtrousFrame *frame,
                           VkCommandBuffer command_buffer,
                           uint32_t pass,
                           const struct AtrousBinding *bindings,
                           uint32_t binding_count);

// Switches checks on (1) or off (0) that tell you mistakes which Vulkan does not see, for some microseconds a frame. They are on
// from the start where the library is a debug build. atrous_record then refuses a layout that no shader reads, one image for both
// copies of a history, and copies that you do not exchange; atrous_begin_frame names passes that you left out of the previous frame,
// and the frame after that drops all history.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_set_checks(struct AtrousDenoiser *denoiser,
                               uint32_t on);

// Describes an image by its view, so that checks compare its format, extent and usage with those declared wherever you bind the
// view. Describe a view again if its handle is used for another one.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_describe_image(struct AtrousDenoiser *denoiser,
                                   VkImageView view,
                                   VkFormat format,
                                   uint32_t width,
                                   uint32_t height,
                                   VkImageUsageFlags usage);

// Creates a tracker for the resources of a denoiser: it remembers the last use of each image and buffer, and gives the barriers
// before the next one. Nothing has content yet, and there are no inputs. It needs no device and records nothing. Make a new one
// after atrous_resize. With `legacy_barriers` 1 you get arguments of vkCmdPipelineBarrier, with 0 of vkCmdPipelineBarrier2.
//
// # Safety
// `tracker` is null or points to a pointer.
AtrousStatus atrous_tracker_create(const struct AtrousDenoiser *denoiser,
                                   uint32_t legacy_barriers,
                                   struct AtrousTracker **tracker);

// Destroys a tracker. Your handle is invalid from then on, and stays so, and with it all that it gave.
//
// # Safety
// No other thread reads what it gave.
AtrousStatus atrous_tracker_destroy(struct AtrousTracker *tracker);

// Names the image of a copy of a resource, with all aspects of its format: VK_IMAGE_ASPECT_COLOR_BIT, or depth and stencil. It is
// named once, and not tracked before: an input is there after atrous_tracker_share or atrous_tracker_access. Without an image or a
// buffer, barriers are left out, and the binding is absent.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_set_image(struct AtrousTracker *tracker,
                                      uint32_t resource,
                                      uint32_t copy,
                                      VkImage image,
                                      VkImageView view,
                                      VkImageAspectFlags aspects);

// Names array layer and mip level of the image that atrous_tracker_set_image named; they are 0 until then. The view is of them.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_set_subresource(struct AtrousTracker *tracker,
                                            uint32_t resource,
                                            uint32_t copy,
                                            uint32_t layer,
                                            uint32_t level);

// With `on` 1 every image is used in VK_IMAGE_LAYOUT_GENERAL from now on, for engines with one layout: images that are there already
// have barriers of memory alone. With 0, the initial value, each is used in the declared layout.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_stay_in_general(struct AtrousTracker *tracker,
                                            uint32_t on);

// Names the buffer of a copy of a resource, as atrous_tracker_set_image names an image. `size` may be VK_WHOLE_SIZE.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_set_buffer(struct AtrousTracker *tracker,
                                       uint32_t resource,
                                       uint32_t copy,
                                       VkBuffer buffer,
                                       uint64_t offset,
                                       uint64_t size);

// Tells that two transients overlap in memory: the first pass of one then waits for the last pass of the other.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_alias(struct AtrousTracker *tracker,
                                  uint32_t resource,
                                  uint32_t other);

// Shares an input or an output with you: each phase finds it in the state `before`, and atrous_tracker_hand_back leaves it in the
// state `after`. If `before` has reads alone, name every stage and access that the content is visible to.
//
// # Safety
// States are null or valid.
AtrousStatus atrous_tracker_share(struct AtrousTracker *tracker,
                                  uint32_t resource,
                                  const struct AtrousState *before,
                                  const struct AtrousState *after);

// Leaves an optional input out from now on.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_leave_out(struct AtrousTracker *tracker, uint32_t resource);

// Tells the state of a copy that you used without the tracker. It is there from now on, and no longer shared.
//
// # Safety
// `state` is null or valid.
AtrousStatus atrous_tracker_set_state(struct AtrousTracker *tracker,
                                      uint32_t resource,
                                      uint32_t copy,
                                      const struct AtrousState *state);

// The state of a copy. That of an input which is left out is undefined, without an access.
//
// # Safety
// `state` is null or points to an AtrousState.
AtrousStatus atrous_tracker_state(const struct AtrousTracker *tracker,
                                  uint32_t resource,
                                  uint32_t copy,
                                  struct AtrousState *state);

// Records for queues of this family from now on, and acquires resources that another one owns. VK_QUEUE_FAMILY_IGNORED, the
// initial value, if ownership never changes.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_set_queue_family(struct AtrousTracker *tracker,
                                             uint32_t queue_family);

// Forgets recorded work that will never run, for example because a submission failed. Call atrous_invalidate as well.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_tracker_forget(struct AtrousTracker *tracker);

// The barriers before a pass. Record them at once; the pass counts as recorded after them.
//
// # Safety
// Pointers are null or valid with their struct_size set.
AtrousStatus atrous_tracker_barriers(struct AtrousTracker *tracker,
                                     const struct AtrousFrame *frame,
                                     uint32_t pass,
                                     struct AtrousBarriers *barriers);

// The bindings of a pass for atrous_record, in the layouts that atrous_tracker_barriers reached. `count` says how many your array
// holds, and becomes the number of the pass's uses; ATROUS_MAX_USES are enough for any.
//
// # Safety
// Pointers are null or valid; `bindings` points to `count` of them.
AtrousStatus atrous_tracker_bindings(struct AtrousTracker *tracker,
                                     const struct AtrousFrame *frame,
                                     uint32_t pass,
                                     struct AtrousBinding *bindings,
                                     uint32_t *count);

// The barriers before a use of your own between two passes or after them, for example an upload, a copy or a draw. `discard` 1: it
// needs no old content. The resource is there from now on.
//
// # Safety
// Pointers are null or valid, `barriers` with its struct_size set.
AtrousStatus atrous_tracker_access(struct AtrousTracker *tracker,
                                   uint32_t resource,
                                   uint32_t copy,
                                   const struct AtrousState *next,
                                   uint32_t discard,
                                   struct AtrousBarriers *barriers);

// The barriers at the end of a phase, which bring shared resources to the state that you asked for. If your queue family differs,
// they release the ownership, and atrous_tracker_given_back has the barriers for your queue.
//
// # Safety
// `barriers` is null or valid with its struct_size set.
AtrousStatus atrous_tracker_hand_back(struct AtrousTracker *tracker,
                                      struct AtrousBarriers *barriers);

// The acquiring halves of the last atrous_tracker_hand_back, for your queue; none if ownership does not change.
//
// # Safety
// `barriers` is null or valid with its struct_size set.
AtrousStatus atrous_tracker_given_back(struct AtrousTracker *tracker,
                                       struct AtrousBarriers *barriers);

// The releasing halves before a phase on a queue of a different family, for the queue that owns the resources, ahead of the
// semaphore. atrous_tracker_barriers gives the acquiring halves afterwards. None if ownership does not change.
//
// # Safety
// Pointers are null or valid with their struct_size set.
AtrousStatus atrous_tracker_releases(struct AtrousTracker *tracker,
                                     const struct AtrousFrame *frame,
                                     uint32_t phase,
                                     uint32_t queue_family,
                                     struct AtrousBarriers *barriers);

// Creates a denoiser with all images but your inputs. The device has synchronization2 enabled, or `legacy_barriers` is 1.
//
// # Safety
// Pointers are null or valid with their struct_size set; handles are live, belong together and outlive the executor.
AtrousStatus atrous_executor_create(const struct AtrousCreateInfo *info,
                                    struct AtrousExecutor **executor);

// Destroys an executor and its memory. Your handle is invalid from then on, and stays so.
//
// # Safety
// GPU work that was recorded with it is complete; the device is live.
AtrousStatus atrous_executor_destroy(struct AtrousExecutor *executor);

// Allocates everything for a new extent, and keeps the pipelines. Your history starts over. A refused extent changes nothing.
//
// # Safety
// All GPU work recorded with this executor is complete, and none is left to submit.
AtrousStatus atrous_executor_resize(struct AtrousExecutor *executor,
                                    uint32_t width,
                                    uint32_t height);

// Sets a number of the tuning from the next frame on, as atrous_set_tuning does.
//
// # Safety
// `name` is null or a null-terminated string.
AtrousStatus atrous_executor_set_tuning(struct AtrousExecutor *executor,
                                        const char *name,
                                        float value);

// Forgets recorded work that will never run, for example because a submission failed. The next frame drops all history.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_executor_forget_recorded(struct AtrousExecutor *executor);

// Denoises a frame on your command buffer, with all barriers. Lend every image anew in each frame: an optional input that you do
// not lend is left out, and an output that you do not lend belongs to the executor.
//
// # Safety
// Pointers are null or valid. The command buffer is recording, outside a render pass, for a queue family with compute. Images are
// live and in their states. GPU work that was recorded earlier with the same frame_slot is complete.
AtrousStatus atrous_executor_denoise(struct AtrousExecutor *executor,
                                     VkCommandBuffer command_buffer,
                                     const struct AtrousFrameParams *params,
                                     const struct AtrousLentImage *images,
                                     uint32_t image_count);

// Begins a frame whose phases you record one by one, for example with your path tracer between them. Images are lent as to
// atrous_executor_denoise; each phase finds them in the states that you give here, and leaves them so: after_layout is
// VK_IMAGE_LAYOUT_UNDEFINED.
//
// # Safety
// Pointers are null or valid. Images are live until the frame is recorded.
AtrousStatus atrous_executor_begin_frame(struct AtrousExecutor *executor,
                                         const struct AtrousFrameParams *params,
                                         const struct AtrousLentImage *images,
                                         uint32_t image_count);

// Records an AtrousPhase of the frame that was begun last, with all barriers; each phase once, in their order.
//
// # Safety
// The command buffer is recording, outside a render pass, for a queue family with compute, and runs behind those of the phases
// before. Lent images are live and in their states. GPU work that was recorded earlier with the same frame_slot is complete.
AtrousStatus atrous_executor_record(struct AtrousExecutor *executor,
                                    VkCommandBuffer command_buffer,
                                    uint32_t phase);

// Binds a buffer of yours, for example ATROUS_INPUT_INSTANCE_TRANSFORMS, until you bind a new one or, with a null `buffer`, none.
// `stage` and `access` are your own uses before each phase.
//
// # Safety
// `name` is null or a null-terminated string. The buffer has `size` bytes and the declared usage, and is live while it is bound.
AtrousStatus atrous_executor_bind_buffer(struct AtrousExecutor *executor,
                                         const char *name,
                                         VkBuffer buffer,
                                         uint64_t size,
                                         VkPipelineStageFlags2 stage,
                                         VkAccessFlags2 access);

// Copies a resource of the newest frame into your buffer, visible to the CPU once the command buffer has run.
//
// # Safety
// `name` is null or a string. The command buffer is recording, outside a render pass; the buffer has usage TRANSFER_DST and as many
// bytes as `buffer_size` says.
AtrousStatus atrous_executor_record_copy(struct AtrousExecutor *executor,
                                         VkCommandBuffer command_buffer,
                                         const char *name,
                                         VkBuffer buffer,
                                         uint64_t buffer_size);

// Draws the resource `debug_view` of the newest frame again, with a different AtrousView, for a submission after that of the frame.
// The configuration has `debug_view` 1.
//
// # Safety
// Obligations of atrous_executor_denoise: images that were lent to the newest frame are live, and in the states that it left.
AtrousStatus atrous_executor_record_debug_view(struct AtrousExecutor *executor,
                                               VkCommandBuffer command_buffer,
                                               uint32_t view);

// Captures the inputs of the next `frames` frames as an EXR sequence in a folder, which the tool `atrous-denoise` replays. Lent
// inputs need the usage TRANSFER_SRC. A frame is written when its slot comes round again; atrous_executor_finish_capture writes the
// last ones, and has the error that ended a capture early.
//
// # Safety
// `folder` is null or a null-terminated string, a path in UTF-8.
AtrousStatus atrous_executor_capture(struct AtrousExecutor *executor,
                                     const char *folder,
                                     uint32_t frames);

// Writes the recorded frames of a capture, and ends it. `frames`, which may be null, becomes the number of those written.
//
// # Safety
// All GPU work recorded with this executor is complete; `frames` is null or points to a number.
AtrousStatus atrous_executor_finish_capture(struct AtrousExecutor *executor,
                                            uint32_t *frames);

// Counters of the newest frame that was read back, by AtrousCounter: the one before the last with the newest frame's slot. All are
// 0 until then. `count` says how many your array holds.
//
// # Safety
// `counters` is null or points to `count` numbers.
AtrousStatus atrous_executor_statistics(const struct AtrousExecutor *executor,
                                        uint32_t *counters,
                                        uint32_t count);

// Tests whether depth, matrices, motion and normals of two consecutive frames agree with the
// conventions in `config`, and names the likely mistake. Needs no denoiser and no device.
//
// # Safety
// Pointers are null or valid with their struct_size set; images have as many texels as their extent says.
AtrousStatus atrous_check_conventions(const struct AtrousConfig *config,
                                      const struct AtrousGuides *previous,
                                      const struct AtrousGuides *current,
                                      struct AtrousConventionReport *report);

// Gives you the messages of the library, for example that history is lost in frame after frame. `level` is the most detailed one
// that you want: 1 errors, 2 warnings as well, 3 information, 4 and 5 details; 0 or a null callback: none. A message is valid
// during the call. There is one callback for the process.
//
// # Safety
// `callback` takes these arguments on any thread and throws nothing. `user` outlives every call of the library that began before
// you replaced it.
AtrousStatus atrous_set_log(uint32_t level,
                            AtrousLogCallback callback,
                            void *user);

// The version of the library that runs, packed as ATROUS_VERSION is. A different major version has a different ABI.
uint32_t atrous_version(void);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ATROUS_H */
