// atrous.h for C++17: handles that destroy what they own, choices as enumerations with a scope, views of arrays. A thin layer: each
// method is the function of its name, and returns its status. Nothing throws.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <memory>
#include <type_traits>

#include "atrous.h"

namespace atrous {

// choices: begin

enum class Depth : uint32_t {
    Linear = ATROUS_DEPTH_LINEAR,
    Device = ATROUS_DEPTH_DEVICE,
    RayLength = ATROUS_DEPTH_RAY_LENGTH,
};
inline void set(AtrousConfig& config, Depth value) { config.depth = static_cast<uint32_t>(value); }

enum class Normal : uint32_t {
    Xyz = ATROUS_NORMAL_XYZ,
    XyzUnorm = ATROUS_NORMAL_XYZ_UNORM,
    Octahedral = ATROUS_NORMAL_OCTAHEDRAL,
    OctahedralUnorm = ATROUS_NORMAL_OCTAHEDRAL_UNORM,
};
inline void set(AtrousConfig& config, Normal value) { config.normal = static_cast<uint32_t>(value); }

enum class NormalSpace : uint32_t {
    World = ATROUS_NORMAL_SPACE_WORLD,
    View = ATROUS_NORMAL_SPACE_VIEW,
};
inline void set(AtrousConfig& config, NormalSpace value) { config.normal_space = static_cast<uint32_t>(value); }

enum class MotionUnit : uint32_t {
    Pixels = ATROUS_MOTION_UNIT_PIXELS,
    Uv = ATROUS_MOTION_UNIT_UV,
    Ndc = ATROUS_MOTION_UNIT_NDC,
};
inline void set(AtrousConfig& config, MotionUnit value) { config.motion_unit = static_cast<uint32_t>(value); }

enum class MotionDirection : uint32_t {
    PreviousMinusCurrent = ATROUS_MOTION_DIRECTION_PREVIOUS_MINUS_CURRENT,
    CurrentMinusPrevious = ATROUS_MOTION_DIRECTION_CURRENT_MINUS_PREVIOUS,
};
inline void set(AtrousConfig& config, MotionDirection value) { config.motion_direction = static_cast<uint32_t>(value); }

enum class MotionDepth : uint32_t {
    None = ATROUS_MOTION_DEPTH_NONE,
    Difference = ATROUS_MOTION_DEPTH_DIFFERENCE,
    Absolute = ATROUS_MOTION_DEPTH_ABSOLUTE,
};
inline void set(AtrousConfig& config, MotionDepth value) { config.motion_depth = static_cast<uint32_t>(value); }

enum class ViewForward : uint32_t {
    NegativeZ = ATROUS_VIEW_FORWARD_NEGATIVE_Z,
    PositiveZ = ATROUS_VIEW_FORWARD_POSITIVE_Z,
};
inline void set(AtrousConfig& config, ViewForward value) { config.view_forward = static_cast<uint32_t>(value); }

enum class Roughness : uint32_t {
    Linear = ATROUS_ROUGHNESS_LINEAR,
    Alpha = ATROUS_ROUGHNESS_ALPHA,
};
inline void set(AtrousConfig& config, Roughness value) { config.roughness = static_cast<uint32_t>(value); }

enum class RoughnessChannel : uint32_t {
    R = ATROUS_ROUGHNESS_CHANNEL_R,
    G = ATROUS_ROUGHNESS_CHANNEL_G,
    B = ATROUS_ROUGHNESS_CHANNEL_B,
    A = ATROUS_ROUGHNESS_CHANNEL_A,
};
inline void set(AtrousConfig& config, RoughnessChannel value) { config.roughness_channel = static_cast<uint32_t>(value); }

enum class Preset : uint32_t {
    Svgf = ATROUS_PRESET_SVGF,
    Asvgf = ATROUS_PRESET_ASVGF,
    Stabilize = ATROUS_PRESET_STABILIZE,
    Percentile = ATROUS_PRESET_PERCENTILE,
    Eaw = ATROUS_PRESET_EAW,
    Volume = ATROUS_PRESET_VOLUME,
    Fast = ATROUS_PRESET_FAST,
    Best = ATROUS_PRESET_BEST,
};
inline void set(AtrousConfig& config, Preset value) { config.preset = static_cast<uint32_t>(value); }

enum class Signals : uint32_t {
    Together = ATROUS_SIGNALS_TOGETHER,
    Apart = ATROUS_SIGNALS_APART,
    Specular = ATROUS_SIGNALS_SPECULAR,
    Mixed = ATROUS_SIGNALS_MIXED,
};
inline void set(AtrousConfig& config, Signals value) { config.signals = static_cast<uint32_t>(value); }

enum class AdaptiveRule : uint32_t {
    ChangeTest = ATROUS_ADAPTIVE_RULE_CHANGE_TEST,
    Percentiles = ATROUS_ADAPTIVE_RULE_PERCENTILES,
};
inline void set(AtrousConfig& config, AdaptiveRule value) { config.adaptive_rule = static_cast<uint32_t>(value); }

enum class GradientSource : uint32_t {
    ForwardProjected = ATROUS_GRADIENT_SOURCE_FORWARD_PROJECTED,
    Reshaded = ATROUS_GRADIENT_SOURCE_RESHADED,
    Sparse = ATROUS_GRADIENT_SOURCE_SPARSE,
    Confidence = ATROUS_GRADIENT_SOURCE_CONFIDENCE,
    ChangeTest = ATROUS_GRADIENT_SOURCE_CHANGE_TEST,
};
inline void set(AtrousConfig& config, GradientSource value) { config.gradient_source = static_cast<uint32_t>(value); }

enum class Sampling : uint32_t {
    Full = ATROUS_SAMPLING_FULL,
    OneOf2x2 = ATROUS_SAMPLING_ONE_OF_2X2,
    OneOf4x4 = ATROUS_SAMPLING_ONE_OF_4X4,
};
inline void set(AtrousConfig& config, Sampling value) { config.sampling = static_cast<uint32_t>(value); }

enum class PostProcess : uint32_t {
    None = ATROUS_POST_PROCESS_NONE,
    ToneMap = ATROUS_POST_PROCESS_TONE_MAP,
    ToneMapTaa = ATROUS_POST_PROCESS_TONE_MAP_TAA,
};
inline void set(AtrousConfig& config, PostProcess value) { config.post_process = static_cast<uint32_t>(value); }

enum class EawWeights : uint32_t {
    Radiance = ATROUS_EAW_WEIGHTS_RADIANCE,
    Normal = ATROUS_EAW_WEIGHTS_NORMAL,
    Position = ATROUS_EAW_WEIGHTS_POSITION,
};

enum class Phase : uint32_t {
    BeforeLighting = ATROUS_PHASE_BEFORE_LIGHTING,
    AfterLighting = ATROUS_PHASE_AFTER_LIGHTING,
    PostProcess = ATROUS_PHASE_POST_PROCESS,
};

enum class Reset : uint32_t {
    None = ATROUS_RESET_NONE,
    Created = ATROUS_RESET_CREATED,
    CameraCut = ATROUS_RESET_CAMERA_CUT,
    Resize = ATROUS_RESET_RESIZE,
    SceneLoad = ATROUS_RESET_SCENE_LOAD,
    OriginShift = ATROUS_RESET_ORIGIN_SHIFT,
    ExposureJump = ATROUS_RESET_EXPOSURE_JUMP,
};

enum class View : uint32_t {
    None = ATROUS_VIEW_NONE,
    HistoryLength = ATROUS_VIEW_HISTORY_LENGTH,
    Deviation = ATROUS_VIEW_DEVIATION,
    MeanAndDeviation = ATROUS_VIEW_MEAN_AND_DEVIATION,
    Gradient = ATROUS_VIEW_GRADIENT,
    Lambda = ATROUS_VIEW_LAMBDA,
    Alpha = ATROUS_VIEW_ALPHA,
    Percentiles = ATROUS_VIEW_PERCENTILES,
    Fireflies = ATROUS_VIEW_FIREFLIES,
    Disocclusion = ATROUS_VIEW_DISOCCLUSION,
    Motion = ATROUS_VIEW_MOTION,
    Normal = ATROUS_VIEW_NORMAL,
    Depth = ATROUS_VIEW_DEPTH,
    SurfaceId = ATROUS_VIEW_SURFACE_ID,
    BadValues = ATROUS_VIEW_BAD_VALUES,
    HitDistance = ATROUS_VIEW_HIT_DISTANCE,
    LobeAngle = ATROUS_VIEW_LOBE_ANGLE,
    VirtualMotion = ATROUS_VIEW_VIRTUAL_MOTION,
    ReflectionHistory = ATROUS_VIEW_REFLECTION_HISTORY,
    Visibility = ATROUS_VIEW_VISIBILITY,
    Penumbra = ATROUS_VIEW_PENUMBRA,
};
// choices: end

// A struct of atrous.h, all zeros but for its size.
template <typename T>
T sized() {
    T value{};
    value.struct_size = sizeof value;
    return value;
}

// An array of yours, as std::span is one: made of anything with data() and size(), or of an array.
template <typename T>
class Span {
public:
    Span() = default;
    Span(T* data, size_t size) : data_(data), size_(size) {}
    template <size_t N>
    Span(T (&array)[N]) : data_(array), size_(N) {}
    template <typename C, typename = decltype(std::declval<C&>().data())>
    Span(C&& container) : data_(container.data()), size_(container.size()) {}

    T* data() const { return data_; }
    uint32_t size() const { return static_cast<uint32_t>(size_); }

private:
    T* data_ = nullptr;
    size_t size_ = 0;
};

template <typename T, AtrousStatus (*destroy)(T*)>
struct Destroy {
    void operator()(T* handle) const { destroy(handle); }
};

class Graph {
public:
    using Arguments = std::initializer_list<AtrousArgument>;

    // Of the configuration: extent, conventions, frames in flight, and the preset whose numbers the tuning begins with.
    [[nodiscard]] AtrousStatus create(const AtrousConfig& config) {
        AtrousGraph* made = nullptr;
        const AtrousStatus status = atrous_graph_create(&config, &made);
        if (status == ATROUS_STATUS_OK) handle_.reset(made);
        return status;
    }
    // For AtrousCreateInfo::graph.
    AtrousGraph* get() const { return handle_.get(); }
    explicit operator bool() const { return bool(handle_); }

    // Arguments are ATROUS_PORT("guides", guides) and its siblings.
    [[nodiscard]] AtrousStatus node(const char* node, Arguments arguments, AtrousPort& result, const char* scope = nullptr) {
        return atrous_graph_node(get(), node, scope, arguments.begin(), static_cast<uint32_t>(arguments.size()), &result);
    }
    [[nodiscard]] AtrousStatus stage(const AtrousStageInfo& info, Arguments arguments, AtrousPort& result) {
        return atrous_graph_stage(get(), &info, arguments.begin(), static_cast<uint32_t>(arguments.size()), &result);
    }
    [[nodiscard]] AtrousStatus stage(const char* name, Span<const uint32_t> spirv, Arguments arguments, AtrousPort& result,
                                     Phase phase = Phase::AfterLighting) {
        AtrousStageInfo info = sized<AtrousStageInfo>();
        info.phase = static_cast<uint32_t>(phase), info.name = name, info.spirv = spirv.data(), info.word_count = spirv.size();
        return stage(info, arguments, result);
    }
    [[nodiscard]] AtrousStatus part(AtrousPort port, const char* part, AtrousPort& result) {
        return atrous_graph_part(get(), port, part, &result);
    }
    [[nodiscard]] AtrousStatus output(const char* name, AtrousPort port) { return atrous_graph_output(get(), name, port); }
    [[nodiscard]] AtrousStatus share_outputs(bool on) { return atrous_graph_share_outputs(get(), on); }

private:
    std::unique_ptr<AtrousGraph, Destroy<AtrousGraph, atrous_graph_destroy>> handle_;
};

// Pipelines that denoisers of one device share: give get() as AtrousCreateInfo::pipelines.
class Pipelines {
public:
    [[nodiscard]] AtrousStatus create() {
        AtrousPipelines* made = nullptr;
        const AtrousStatus status = atrous_pipelines_create(&made);
        if (status == ATROUS_STATUS_OK) handle_.reset(made);
        return status;
    }
    AtrousPipelines* get() const { return handle_.get(); }
    explicit operator bool() const { return bool(handle_); }

    [[nodiscard]] AtrousStatus clear() { return atrous_pipelines_clear(get()); }

private:
    std::unique_ptr<AtrousPipelines, Destroy<AtrousPipelines, atrous_pipelines_destroy>> handle_;
};

class Denoiser {
public:
    [[nodiscard]] AtrousStatus create(const AtrousCreateInfo& info) {
        AtrousDenoiser* made = nullptr;
        const AtrousStatus status = atrous_create(&info, &made);
        if (status == ATROUS_STATUS_OK) handle_.reset(made);
        return status;
    }
    AtrousDenoiser* get() const { return handle_.get(); }
    explicit operator bool() const { return bool(handle_); }

    [[nodiscard]] AtrousStatus counts(uint32_t& resources, uint32_t& passes) const { return atrous_counts(get(), &resources, &passes); }
    [[nodiscard]] AtrousStatus resource(uint32_t index, AtrousResource& to) const { return atrous_resource(get(), index, &to); }
    [[nodiscard]] AtrousStatus pass(uint32_t index, AtrousPass& to) const { return atrous_pass(get(), index, &to); }
    [[nodiscard]] AtrousStatus memory(AtrousMemory& to) const { return atrous_memory(get(), &to); }
    [[nodiscard]] AtrousStatus place_transients(Span<AtrousPlacement> placements, uint64_t& size) const {
        return atrous_place_transients(get(), placements.data(), placements.size(), &size);
    }
    [[nodiscard]] AtrousStatus set_tuning(const char* name, float value) { return atrous_set_tuning(get(), name, value); }
    [[nodiscard]] AtrousStatus set_checks(bool on) { return atrous_set_checks(get(), on); }
    [[nodiscard]] AtrousStatus describe_image(VkImageView view, VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage) {
        return atrous_describe_image(get(), view, format, width, height, usage);
    }
    [[nodiscard]] AtrousStatus resize(uint32_t width, uint32_t height) { return atrous_resize(get(), width, height); }
    [[nodiscard]] AtrousStatus invalidate() { return atrous_invalidate(get()); }
    [[nodiscard]] AtrousStatus begin_frame(const AtrousFrameParams& params, AtrousFrame& frame) {
        return atrous_begin_frame(get(), &params, &frame);
    }
    [[nodiscard]] AtrousStatus record(const AtrousFrame& frame, VkCommandBuffer cmd, uint32_t pass, Span<const AtrousBinding> bindings) const {
        return atrous_record(get(), &frame, cmd, pass, bindings.data(), bindings.size());
    }

private:
    std::unique_ptr<AtrousDenoiser, Destroy<AtrousDenoiser, atrous_destroy>> handle_;
};

class Tracker {
public:
    [[nodiscard]] AtrousStatus create(const Denoiser& denoiser, bool legacy_barriers = false) {
        AtrousTracker* made = nullptr;
        const AtrousStatus status = atrous_tracker_create(denoiser.get(), legacy_barriers, &made);
        if (status == ATROUS_STATUS_OK) handle_.reset(made);
        return status;
    }
    AtrousTracker* get() const { return handle_.get(); }
    explicit operator bool() const { return bool(handle_); }

    [[nodiscard]] AtrousStatus set_image(uint32_t resource, uint32_t copy, VkImage image, VkImageView view,
                                         VkImageAspectFlags aspects = VK_IMAGE_ASPECT_COLOR_BIT) {
        return atrous_tracker_set_image(get(), resource, copy, image, view, aspects);
    }
    [[nodiscard]] AtrousStatus set_buffer(uint32_t resource, uint32_t copy, VkBuffer buffer, uint64_t offset = 0, uint64_t size = VK_WHOLE_SIZE) {
        return atrous_tracker_set_buffer(get(), resource, copy, buffer, offset, size);
    }
    [[nodiscard]] AtrousStatus alias(uint32_t resource, uint32_t other) { return atrous_tracker_alias(get(), resource, other); }
    [[nodiscard]] AtrousStatus share(uint32_t resource, const AtrousState& before, const AtrousState& after) {
        return atrous_tracker_share(get(), resource, &before, &after);
    }
    [[nodiscard]] AtrousStatus leave_out(uint32_t resource) { return atrous_tracker_leave_out(get(), resource); }
    [[nodiscard]] AtrousStatus set_state(uint32_t resource, uint32_t copy, const AtrousState& state) {
        return atrous_tracker_set_state(get(), resource, copy, &state);
    }
    [[nodiscard]] AtrousStatus state(uint32_t resource, uint32_t copy, AtrousState& to) const {
        return atrous_tracker_state(get(), resource, copy, &to);
    }
    [[nodiscard]] AtrousStatus set_queue_family(uint32_t family) { return atrous_tracker_set_queue_family(get(), family); }
    [[nodiscard]] AtrousStatus forget() { return atrous_tracker_forget(get()); }
    [[nodiscard]] AtrousStatus barriers(const AtrousFrame& frame, uint32_t pass, AtrousBarriers& to) {
        return atrous_tracker_barriers(get(), &frame, pass, &to);
    }
    // `count` becomes the number of bindings.
    [[nodiscard]] AtrousStatus bindings(const AtrousFrame& frame, uint32_t pass, Span<AtrousBinding> to, uint32_t& count) {
        count = to.size();
        return atrous_tracker_bindings(get(), &frame, pass, to.data(), &count);
    }
    [[nodiscard]] AtrousStatus access(uint32_t resource, uint32_t copy, const AtrousState& next, bool discard, AtrousBarriers& to) {
        return atrous_tracker_access(get(), resource, copy, &next, discard, &to);
    }
    [[nodiscard]] AtrousStatus hand_back(AtrousBarriers& to) { return atrous_tracker_hand_back(get(), &to); }
    [[nodiscard]] AtrousStatus given_back(AtrousBarriers& to) { return atrous_tracker_given_back(get(), &to); }
    [[nodiscard]] AtrousStatus releases(const AtrousFrame& frame, uint32_t phase, uint32_t family, AtrousBarriers& to) {
        return atrous_tracker_releases(get(), &frame, phase, family, &to);
    }

private:
    std::unique_ptr<AtrousTracker, Destroy<AtrousTracker, atrous_tracker_destroy>> handle_;
};

class Executor {
public:
    [[nodiscard]] AtrousStatus create(const AtrousCreateInfo& info) {
        AtrousExecutor* made = nullptr;
        const AtrousStatus status = atrous_executor_create(&info, &made);
        if (status == ATROUS_STATUS_OK) handle_.reset(made);
        return status;
    }
    AtrousExecutor* get() const { return handle_.get(); }
    explicit operator bool() const { return bool(handle_); }

    [[nodiscard]] AtrousStatus resize(uint32_t width, uint32_t height) { return atrous_executor_resize(get(), width, height); }
    [[nodiscard]] AtrousStatus set_tuning(const char* name, float value) { return atrous_executor_set_tuning(get(), name, value); }
    [[nodiscard]] AtrousStatus forget_recorded() { return atrous_executor_forget_recorded(get()); }
    [[nodiscard]] AtrousStatus denoise(VkCommandBuffer cmd, const AtrousFrameParams& params, Span<const AtrousLentImage> images) {
        return atrous_executor_denoise(get(), cmd, &params, images.data(), images.size());
    }
    [[nodiscard]] AtrousStatus bind_buffer(const char* name, VkBuffer buffer, uint64_t size, VkPipelineStageFlags2 stage, VkAccessFlags2 access) {
        return atrous_executor_bind_buffer(get(), name, buffer, size, stage, access);
    }
    [[nodiscard]] AtrousStatus begin_frame(const AtrousFrameParams& params, Span<const AtrousLentImage> images) {
        return atrous_executor_begin_frame(get(), &params, images.data(), images.size());
    }
    [[nodiscard]] AtrousStatus record(VkCommandBuffer cmd, Phase phase) {
        return atrous_executor_record(get(), cmd, static_cast<uint32_t>(phase));
    }
    [[nodiscard]] AtrousStatus record_copy(VkCommandBuffer cmd, const char* name, VkBuffer buffer, uint64_t size) {
        return atrous_executor_record_copy(get(), cmd, name, buffer, size);
    }
    [[nodiscard]] AtrousStatus record_debug_view(VkCommandBuffer cmd, View view) {
        return atrous_executor_record_debug_view(get(), cmd, static_cast<uint32_t>(view));
    }
    [[nodiscard]] AtrousStatus capture(const char* folder, uint32_t frames) { return atrous_executor_capture(get(), folder, frames); }
    [[nodiscard]] AtrousStatus finish_capture(uint32_t& frames) { return atrous_executor_finish_capture(get(), &frames); }
    [[nodiscard]] AtrousStatus statistics(Span<uint32_t> counters) const {
        return atrous_executor_statistics(get(), counters.data(), counters.size());
    }

private:
    std::unique_ptr<AtrousExecutor, Destroy<AtrousExecutor, atrous_executor_destroy>> handle_;
};

}  // namespace atrous
