/* atrous: the passes of a real-time path-tracing denoiser, for the frame graph of a Vulkan engine.
 *
 * Made from crates/capi by cbindgen: `ATROUS_UPDATE_HEADER=1 cargo test -p atrous-capi --test header` renews it, and a test compares.
 * Set struct_size to sizeof(struct) in every struct before it is passed, to read and to fill alike.
 * docs/contract.md has the contract, docs/hosts/cpp.md an engine that uses it. */

#ifndef ATROUS_H
#define ATROUS_H

#include <stdint.h>
#include "vulkan/vulkan_core.h"

// Bytes of a name, with its null.
#define ATROUS_NAME_SIZE 64

// Largest number of uses that a pass has.
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
  // The device lacks something.
  ATROUS_STATUS_UNSUPPORTED_DEVICE = 5,
  // Memory ran out.
  ATROUS_STATUS_OUT_OF_MEMORY = 6,
  // A different Vulkan call failed.
  ATROUS_STATUS_VULKAN_ERROR = 7,
  // A bug in atrous: it panicked. Destroy the denoiser.
  ATROUS_STATUS_PANICKED = 8,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum AtrousStatus AtrousStatus;
#else
typedef uint32_t AtrousStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A denoiser. Opaque: the pointer is a number that is never followed, so that a wrong one is an error and not a crash.
typedef struct AtrousDenoiser AtrousDenoiser;

// Choices that are made once; `atrous_config_default` fills it. Where a number is a choice, its name in files and logs follows in
// parentheses.
typedef struct AtrousConfig {
  // sizeof(AtrousConfig).
  uint32_t struct_size;
  // Width of the allocated images, pixels.
  uint32_t width;
  // Height of the allocated images, pixels.
  uint32_t height;
  // Frames that you record before you wait for the oldest, 1 to 8.
  uint32_t frames_in_flight;
  // Filter, 7 by default: 0 (svgf), 1 (asvgf), 2 (stabilize), 3 (percentile), 4 (eaw), 5 (volume), 6 (fast), 7 (best).
  uint32_t preset;
  // Signals: 0 (together), 1 (apart), 2 (specular). Together one image, `noisy_radiance`; apart two, `noisy_direct` and
  // `noisy_indirect`; specular two, `noisy_diffuse` and `noisy_specular`.
  uint32_t signals;
  // À-trous levels, 1 to 10; 0 (default): the preset's, 4 for `best` and `fast`, 5 for the others.
  uint32_t levels;
  // 1: you have a volume, `noisy_volume`, which is filtered beside the surfaces; the preset
  // `volume` always has one.
  uint32_t volume;
  // 1: you have the visibility of one light apart, `noisy_visibility` with `occluder_distance`.
  uint32_t visibility;
  // 1: fireflies are removed before accumulation; the percentile preset always does.
  uint32_t firefly_filter;
  // The rule by which the preset `percentile` detects changes of light: 0 (change_test), 1
  // (percentiles).
  uint32_t adaptive_rule;
  // The method that finds percentiles: 0 (counting), 1 (odd_even).
  uint32_t block_sort;
  // Edge-stopping functions of EAW. Bit 0: radiance; bit 1: normal; bit 2: position.
  uint32_t eaw_weights;
  // Share of the pixels that have a sample in a frame; the others are NaN in the noisy images: 0 (full), 1 (one_of_2x2), 2 (one_of_4x4).
  uint32_t sampling;
  // Side of the strata of temporal gradients, 2 to 4 pixels.
  uint32_t stratum_size;
  // Source of gradients: 0 (forward_projected), 1 (reshaded), 2 (sparse), 3 (confidence).
  uint32_t gradient_source;
  // 1: you have an image of forward motion.
  uint32_t forward_motion;
  // 1: you have an image of surface ids.
  uint32_t surface_id;
  // 1: you have object-space normals.
  uint32_t object_normal;
  // Post-process: 0 (none), 1 (tone_map), 2 (tone_map_taa).
  uint32_t post_process;
  // Encoding of depth: 0 (linear), 1 (device), 2 (ray_length). Device is what a depth buffer holds.
  uint32_t depth;
  // Encoding of normals: 0 (xyz), 1 (xyz_unorm), 2 (octahedral), 3 (octahedral_unorm). Unorm: v·0.5 + 0.5.
  uint32_t normal;
  // Space of the normals: 0 (world), 1 (view).
  uint32_t normal_space;
  // Unit of the motion: 0 (pixels), 1 (uv), 2 (ndc).
  uint32_t motion_unit;
  // Sign of the motion: 0 (previous_minus_current), 1 (current_minus_previous).
  uint32_t motion_direction;
  // 1: y of the motion points up.
  uint32_t motion_y_up;
  // 1: the motion includes the change of jitter.
  uint32_t motion_jittered;
  // Meaning of z of the motion: 0 (none), 1 (difference), 2 (absolute). Difference: previous depth − depth; absolute: previous
  // depth.
  uint32_t motion_depth;
  // Direction in which the camera looks in view space: 0 (negative_z), 1 (positive_z).
  uint32_t view_forward;
  // Linear depths from here on are background.
  float background_depth;
  // 1: a last pass `debug_view`.
  uint32_t debug_view;
  // Encoding of roughness: 0 (linear), 1 (alpha). Linear: perceptual; alpha: that of GGX, its square.
  uint32_t roughness;
} AtrousConfig;

// Parameters of a frame; `atrous_frame_params_default` fills it.
typedef struct AtrousFrameParams {
  // sizeof(AtrousFrameParams).
  uint32_t struct_size;
  // Frame slot, below frames_in_flight; GPU work recorded earlier with the same slot is complete.
  uint32_t frame_slot;
  // The reason why the history is dropped: 0 (none), 1 (created), 2 (camera_cut), 3 (resize), 4
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
  // 0 (none), 1 (history_length), 2 (variance), 3 (moments), 4 (gradient), 5 (lambda), 6 (alpha), 7 (percentiles), 8
  // (fireflies), 9 (disocclusion), 10 (motion), 11 (normal), 12 (depth), 13 (surface_id), 14 (bad_values),
  // 15 (hit_distance), 16 (lobe_angle), 17 (virtual_motion), 18 (reflection_history), 19 (visibility), 20 (penumbra).
  uint32_t debug_view;
} AtrousFrameParams;

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
  // Configuration; read during the call alone.
  const struct AtrousConfig *config;
  // Your pipeline cache, or null. Used during the call alone, on several threads, so it must not
  // be externally synchronised.
  VkPipelineCache pipeline_cache;
} AtrousCreateInfo;

// A small buffer of bytes that a name is copied into.
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
  // 1: an input that may be left out.
  uint32_t optional;
  // 0: exactly `format`; 1: any floating-point or normalised format; 2: any unsigned integer format.
  uint32_t format_class;
  // Format to create the image with.
  VkFormat format;
  // Width of the image.
  uint32_t width;
  // Height of the image.
  uint32_t height;
  // Usage that passes need of the image; OR in your own.
  VkImageUsageFlags image_usage;
  // Usage that passes need of the buffer; OR in your own.
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
  // sizeof(AtrousPass), set by the host.
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

// Bytes, known before any is spent; before a device's own alignment.
typedef struct AtrousMemory {
  // sizeof(AtrousMemory), set by the host.
  uint32_t struct_size;
  // Survives the frame.
  uint64_t history;
  // Transients, aliased by lifetime.
  uint64_t transient;
  // Transients if none is aliased.
  uint64_t transient_unaliased;
  // Outputs.
  uint64_t output;
} AtrousMemory;

// A number of the tuning, for user interfaces.
typedef struct AtrousTuningField {
  // sizeof(AtrousTuningField), set by the host.
  uint32_t struct_size;
  // Smallest legal value.
  float min;
  // Largest legal value.
  float max;
  // Default of the default preset; others differ in some.
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

// The binding for a use. An image: `image`, `view` and `layout`. A buffer: `buffer`, `offset`, `range`. All null: an optional
// input that is absent.
typedef struct AtrousBinding {
  // The image of the view: a transfer write has no use for a view.
  VkImage image;
  // 2D view of mip 0, layer 0.
  VkImageView view;
  // Layout that the image is in when the pass runs.
  VkImageLayout layout;
  // Buffer.
  VkBuffer buffer;
  // Offset in bytes.
  uint64_t offset;
  // Bytes, or VK_WHOLE_SIZE.
  uint64_t range;
} AtrousBinding;

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

// Whether guides and conventions agree. Verdicts: 0 as declared; 1 a mistake; 2 not as declared, and nothing known fits; 3 the
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

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// The message of the last call on this thread that failed; empty before the first. Valid until the next call on this thread fails.
const char *atrous_last_error(void);

// The name of a status, for logs; never null.
const char *atrous_status_name(uint32_t status);

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

// Destroys a denoiser. The handle is invalid from then on, and stays so.
//
// # Safety
// GPU work that was recorded with it is complete; the device is live.
AtrousStatus atrous_destroy(struct AtrousDenoiser *denoiser);

// Declares everything for new extents, and keeps pipelines. History starts over, and frames begun
// before are refused. Nothing changes on the device: recorded work may still be in flight, as long
// as its images live. A refused extent changes nothing.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_resize(struct AtrousDenoiser *denoiser,
                           uint32_t width,
                           uint32_t height);

// Gives the numbers of resources and passes. Either pointer may be null.
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

// Bytes that the declared resources take.
//
// # Safety
// `memory` is null or points to an AtrousMemory with its struct_size set.
AtrousStatus atrous_memory(const struct AtrousDenoiser *denoiser, struct AtrousMemory *memory);

// A number of the tuning by its index; invalid argument beyond the last.
//
// # Safety
// `field` is null or points to an AtrousTuningField with its struct_size set.
AtrousStatus atrous_tuning_field(uint32_t index, struct AtrousTuningField *field);

// Sets a number of the tuning from the next frame on; it never drops the history.
//
// # Safety
// `name` is null or a null-terminated string.
AtrousStatus atrous_set_tuning(struct AtrousDenoiser *denoiser, const char *name, float value);

// Makes the next frame drop all history. Call it after you re-created images.
//
// # Safety
// None beyond those of a call through C.
AtrousStatus atrous_invalidate(struct AtrousDenoiser *denoiser);

// Starts a frame. `frame` goes to every atrous_record of it.
//
// # Safety
// Pointers are null or valid with their struct_size set.
AtrousStatus atrous_begin_frame(struct AtrousDenoiser *denoiser,
                                const struct AtrousFrameParams *params,
                                struct AtrousFrame *frame);

// Records one pass: no barrier, no allocation, no submission. `bindings` stand in the order of the pass's uses.
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

// Tests whether depth, matrices, motion and normals of two consecutive frames agree with the
// conventions in `config`, and names the likely mistake. Needs no denoiser and no device.
//
// # Safety
// Pointers are null or valid with their struct_size set; images have as many texels as their extent says.
AtrousStatus atrous_check_conventions(const struct AtrousConfig *config,
                                      const struct AtrousGuides *previous,
                                      const struct AtrousGuides *current,
                                      struct AtrousConventionReport *report);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* ATROUS_H */
