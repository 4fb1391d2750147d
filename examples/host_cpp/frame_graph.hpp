// The engine's frame graph: passes are added as two lambdas, one that declares and one that records; barriers follow from the declarations.
#pragma once
#include <vulkan/vulkan.h>

#include <functional>
#include <string>
#include <utility>
#include <vector>

// What was last done to an image or buffer.
struct Scope {
    VkPipelineStageFlags2 stage = VK_PIPELINE_STAGE_2_NONE;
    VkAccessFlags2 mask = VK_ACCESS_2_NONE;
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    bool writes = false;
};

// An image or a buffer of the engine, with memory of its own.
struct Physical {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    Scope last;
};

struct Handle {
    Physical* physical = nullptr;
};

class FrameGraph {
public:
    // What a pass declares.
    class Builder {
    public:
        // `keep`: the old contents matter.
        void use(Handle handle, Scope scope, bool keep) { uses_.push_back({handle, scope, keep}); }

    private:
        friend class FrameGraph;
        struct Use {
            Handle handle;
            Scope scope;
            bool keep;
        };
        std::vector<Use> uses_;
    };

    using Setup = std::function<void(Builder&)>;
    using Record = std::function<void(VkCommandBuffer)>;

    void add(std::string name, const Setup& setup, Record record) {
        passes_.push_back({std::move(name), {}, std::move(record)});
        setup(passes_.back().builder);
    }

    // Records every pass behind its barriers, and forgets them.
    void execute(VkCommandBuffer cmd) {
        for (Pass& pass : passes_) {
            for (const Builder::Use& use : pass.builder.uses_) transition(use);
            flush(cmd);
            pass.record(cmd);
        }
        passes_.clear();
    }

private:
    struct Pass {
        std::string name;
        Builder builder;
        Record record;
    };

    void transition(const Builder::Use& use) {
        Physical& physical = *use.handle.physical;
        Scope& last = physical.last;
        const bool relayout = physical.image && last.layout != use.scope.layout;
        if (!last.writes && !use.scope.writes && !relayout) {
            last.stage |= use.scope.stage;
            last.mask |= use.scope.mask;
            return;
        }
        if (physical.image) {
            VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
            barrier.srcStageMask = last.stage, barrier.srcAccessMask = last.mask;
            barrier.dstStageMask = use.scope.stage, barrier.dstAccessMask = use.scope.mask;
            barrier.oldLayout = use.keep ? last.layout : VK_IMAGE_LAYOUT_UNDEFINED, barrier.newLayout = use.scope.layout;
            barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
            barrier.image = physical.image, barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
            images_.push_back(barrier);
        } else {
            VkMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
            barrier.srcStageMask = last.stage, barrier.srcAccessMask = last.mask;
            barrier.dstStageMask = use.scope.stage, barrier.dstAccessMask = use.scope.mask;
            memory_.push_back(barrier);
        }
        last = use.scope;
    }

    void flush(VkCommandBuffer cmd) {
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.imageMemoryBarrierCount = uint32_t(images_.size()), info.pImageMemoryBarriers = images_.data();
        info.memoryBarrierCount = uint32_t(memory_.size()), info.pMemoryBarriers = memory_.data();
        vkCmdPipelineBarrier2(cmd, &info);
        images_.clear();
        memory_.clear();
    }

    std::vector<Pass> passes_;
    std::vector<VkImageMemoryBarrier2> images_;
    std::vector<VkMemoryBarrier2> memory_;
};
