// What an engine has before a denoiser comes: a device, memory, a command buffer.
#pragma once
#include <cstdio>
#include <cstdlib>

#include <vulkan/vulkan.h>

#include <vector>

// An image or a buffer of the engine, with memory of its own.
struct Physical {
    VkImage image = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
};

inline void check(VkResult result, const char* call) {
    if (result == VK_SUCCESS) return;
    std::fprintf(stderr, "%s: VkResult %d\n", call, int(result));
    std::exit(1);
}
#define CHECK(call) check(call, #call)

struct Engine {
    VkInstance instance{};
    VkPhysicalDevice physical_device{};
    VkDevice device{};
    VkQueue queue{};
    uint32_t family = 0;
    VkPipelineCache pipeline_cache{};
    VkCommandPool pool{};
    VkCommandBuffer cmd{};

    // Of Vulkan 1.3, with synchronization2, or of an older version without.
    explicit Engine(uint32_t version = VK_API_VERSION_1_3) {
        VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
        application.apiVersion = version;
        VkInstanceCreateInfo instance_info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
        instance_info.pApplicationInfo = &application;
        CHECK(vkCreateInstance(&instance_info, nullptr, &instance));
        uint32_t count = 1;
        vkEnumeratePhysicalDevices(instance, &count, &physical_device);
        if (count == 0) check(VK_ERROR_INITIALIZATION_FAILED, "no Vulkan device");
        family = compute_family();
        const float priority = 1.0f;
        VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
        queue_info.queueFamilyIndex = family, queue_info.queueCount = 1, queue_info.pQueuePriorities = &priority;
        VkPhysicalDeviceVulkan13Features features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
        features.synchronization2 = VK_TRUE;
        VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
        device_info.pNext = version >= VK_API_VERSION_1_3 ? &features : nullptr, device_info.queueCreateInfoCount = 1, device_info.pQueueCreateInfos = &queue_info;
        CHECK(vkCreateDevice(physical_device, &device_info, nullptr, &device));
        vkGetDeviceQueue(device, family, 0, &queue);
        const VkPipelineCacheCreateInfo cache_info{VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO};
        CHECK(vkCreatePipelineCache(device, &cache_info, nullptr, &pipeline_cache));
        VkCommandPoolCreateInfo pool_info{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool_info.queueFamilyIndex = family, pool_info.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
        CHECK(vkCreateCommandPool(device, &pool_info, nullptr, &pool));
        VkCommandBufferAllocateInfo cmd_info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        cmd_info.commandPool = pool, cmd_info.commandBufferCount = 1;
        CHECK(vkAllocateCommandBuffers(device, &cmd_info, &cmd));
    }

    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    ~Engine() {
        vkDestroyCommandPool(device, pool, nullptr);
        vkDestroyPipelineCache(device, pipeline_cache, nullptr);
        vkDestroyDevice(device, nullptr);
        vkDestroyInstance(instance, nullptr);
    }

    Physical create_image(VkFormat format, uint32_t width, uint32_t height, VkImageUsageFlags usage) const {
        Physical physical;
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D, info.format = format, info.extent = {width, height, 1};
        info.mipLevels = info.arrayLayers = 1, info.samples = VK_SAMPLE_COUNT_1_BIT, info.usage = usage;
        CHECK(vkCreateImage(device, &info, nullptr, &physical.image));
        VkMemoryRequirements needs;
        vkGetImageMemoryRequirements(device, physical.image, &needs);
        physical.memory = allocate(needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        CHECK(vkBindImageMemory(device, physical.image, physical.memory, 0));
        VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        view.image = physical.image, view.viewType = VK_IMAGE_VIEW_TYPE_2D, view.format = format;
        view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
        CHECK(vkCreateImageView(device, &view, nullptr, &physical.view));
        return physical;
    }

    Physical create_buffer(VkDeviceSize size, VkBufferUsageFlags usage, VkMemoryPropertyFlags flags) const {
        Physical physical;
        VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
        info.size = size, info.usage = usage;
        CHECK(vkCreateBuffer(device, &info, nullptr, &physical.buffer));
        VkMemoryRequirements needs;
        vkGetBufferMemoryRequirements(device, physical.buffer, &needs);
        physical.memory = allocate(needs, flags);
        CHECK(vkBindBufferMemory(device, physical.buffer, physical.memory, 0));
        return physical;
    }

    // For copies from the CPU and back to it.
    Physical create_mapped_buffer(VkDeviceSize size, uint8_t** mapped) const {
        const Physical buffer = create_buffer(size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
                                              VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
        CHECK(vkMapMemory(device, buffer.memory, 0, VK_WHOLE_SIZE, 0, reinterpret_cast<void**>(mapped)));
        return buffer;
    }

    void destroy(const Physical& physical) const {
        vkDestroyImageView(device, physical.view, nullptr);
        vkDestroyImage(device, physical.image, nullptr);
        vkDestroyBuffer(device, physical.buffer, nullptr);
        vkFreeMemory(device, physical.memory, nullptr);
    }

    void begin() const {
        VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        CHECK(vkBeginCommandBuffer(cmd, &info));
    }

    // What was copied is visible to the CPU then.
    void submit_and_wait() const {
        const VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER, nullptr, VK_ACCESS_TRANSFER_WRITE_BIT, VK_ACCESS_HOST_READ_BIT};
        vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0, nullptr, 0, nullptr);
        CHECK(vkEndCommandBuffer(cmd));
        submit({cmd});
    }

    // In this order, and waits.
    void submit(const std::vector<VkCommandBuffer>& commands) const {
        VkSubmitInfo info{VK_STRUCTURE_TYPE_SUBMIT_INFO};
        info.commandBufferCount = uint32_t(commands.size()), info.pCommandBuffers = commands.data();
        CHECK(vkQueueSubmit(queue, 1, &info, VK_NULL_HANDLE));
        CHECK(vkQueueWaitIdle(queue));
    }

private:
    uint32_t compute_family() const {
        uint32_t count = 0;
        vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, nullptr);
        std::vector<VkQueueFamilyProperties> families(count);
        vkGetPhysicalDeviceQueueFamilyProperties(physical_device, &count, families.data());
        for (uint32_t i = 0; i < count; ++i)
            if (families[i].queueFlags & VK_QUEUE_COMPUTE_BIT) return i;
        check(VK_ERROR_FEATURE_NOT_PRESENT, "a queue with compute");
        return 0;
    }

    VkDeviceMemory allocate(const VkMemoryRequirements& needs, VkMemoryPropertyFlags flags) const {
        VkPhysicalDeviceMemoryProperties types;
        vkGetPhysicalDeviceMemoryProperties(physical_device, &types);
        VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        info.allocationSize = needs.size;
        while (info.memoryTypeIndex < types.memoryTypeCount &&
               (!(needs.memoryTypeBits >> info.memoryTypeIndex & 1) ||
                (types.memoryTypes[info.memoryTypeIndex].propertyFlags & flags) != flags))
            ++info.memoryTypeIndex;
        VkDeviceMemory memory{};
        CHECK(vkAllocateMemory(device, &info, nullptr, &memory));
        return memory;
    }
};
