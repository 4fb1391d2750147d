/* A C99 program with a device of its own that denoises one wall, lit by the same light everywhere, by one call a frame: the picture has
 * to be that light. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "atrous.h"

enum { WIDTH = 48, HEIGHT = 32, INPUTS = 4 };

typedef struct Gpu {
    VkInstance instance;
    VkPhysicalDevice physical_device;
    VkDevice device;
    VkQueue queue;
    uint32_t family;
    VkCommandPool pool;
    VkCommandBuffer cmd;
} Gpu;

static void vk(VkResult result, const char* call) {
    if (result == VK_SUCCESS) return;
    fprintf(stderr, "%s: VkResult %d\n", call, (int)result);
    exit(1);
}

static void ok(AtrousStatus status, const char* call) {
    if (status == ATROUS_STATUS_OK) return;
    fprintf(stderr, "%s: %s: %s\n", call, atrous_status_name(status), atrous_last_error());
    exit(1);
}
#define VK(call) vk(call, #call)
#define OK(call) ok(call, #call)

static Gpu open_gpu(void) {
    Gpu gpu;
    memset(&gpu, 0, sizeof gpu);
    VkApplicationInfo application = {.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = VK_API_VERSION_1_3;
    VkInstanceCreateInfo instance = {.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    instance.pApplicationInfo = &application;
    VK(vkCreateInstance(&instance, NULL, &gpu.instance));
    uint32_t count = 1, families = 16;
    vkEnumeratePhysicalDevices(gpu.instance, &count, &gpu.physical_device);
    VkQueueFamilyProperties properties[16];
    vkGetPhysicalDeviceQueueFamilyProperties(gpu.physical_device, &families, properties);
    while (gpu.family + 1 < families && !(properties[gpu.family].queueFlags & VK_QUEUE_COMPUTE_BIT)) ++gpu.family;
    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue = {.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue.queueFamilyIndex = gpu.family, queue.queueCount = 1, queue.pQueuePriorities = &priority;
    VkPhysicalDeviceVulkan13Features features = {.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    features.synchronization2 = VK_TRUE;
    VkDeviceCreateInfo device = {.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    device.pNext = &features, device.queueCreateInfoCount = 1, device.pQueueCreateInfos = &queue;
    VK(vkCreateDevice(gpu.physical_device, &device, NULL, &gpu.device));
    vkGetDeviceQueue(gpu.device, gpu.family, 0, &gpu.queue);
    VkCommandPoolCreateInfo pool = {.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = gpu.family, pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    VK(vkCreateCommandPool(gpu.device, &pool, NULL, &gpu.pool));
    VkCommandBufferAllocateInfo cmd = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    cmd.commandPool = gpu.pool, cmd.commandBufferCount = 1;
    VK(vkAllocateCommandBuffers(gpu.device, &cmd, &gpu.cmd));
    return gpu;
}

static VkDeviceMemory allocate(const Gpu* gpu, VkMemoryRequirements needs, VkMemoryPropertyFlags flags) {
    VkPhysicalDeviceMemoryProperties types;
    vkGetPhysicalDeviceMemoryProperties(gpu->physical_device, &types);
    VkMemoryAllocateInfo info = {.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    info.allocationSize = needs.size;
    while (!(needs.memoryTypeBits >> info.memoryTypeIndex & 1) ||
           (types.memoryTypes[info.memoryTypeIndex].propertyFlags & flags) != flags)
        ++info.memoryTypeIndex;
    VkDeviceMemory memory;
    VK(vkAllocateMemory(gpu->device, &info, NULL, &memory));
    return memory;
}

typedef struct Input {
    const char* name;
    VkFormat format;
    VkClearColorValue value;
    VkImage image;
    VkImageView view;
    VkDeviceMemory memory;
} Input;

static void create(const Gpu* gpu, Input* input) {
    VkImageCreateInfo info = {.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
    info.imageType = VK_IMAGE_TYPE_2D, info.format = input->format;
    info.extent.width = WIDTH, info.extent.height = HEIGHT, info.extent.depth = 1;
    info.mipLevels = info.arrayLayers = 1, info.samples = VK_SAMPLE_COUNT_1_BIT;
    info.usage = VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
    VK(vkCreateImage(gpu->device, &info, NULL, &input->image));
    VkMemoryRequirements needs;
    vkGetImageMemoryRequirements(gpu->device, input->image, &needs);
    input->memory = allocate(gpu, needs, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
    VK(vkBindImageMemory(gpu->device, input->image, input->memory, 0));
    VkImageViewCreateInfo view = {.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
    view.image = input->image, view.viewType = VK_IMAGE_VIEW_TYPE_2D, view.format = input->format;
    view.subresourceRange.aspectMask = VK_IMAGE_ASPECT_COLOR_BIT;
    view.subresourceRange.levelCount = view.subresourceRange.layerCount = 1;
    VK(vkCreateImageView(gpu->device, &view, NULL, &input->view));
}

/* Stands for the renderer: fills the image, and leaves it in VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL. */
static void render(VkCommandBuffer cmd, const Input* input) {
    const VkImageSubresourceRange whole = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkImageMemoryBarrier barrier = {.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER};
    barrier.dstAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT, barrier.newLayout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
    barrier.image = input->image, barrier.subresourceRange = whole;
    vkCmdPipelineBarrier(cmd, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_TRANSFER_BIT, 0, 0, NULL, 0, NULL, 1, &barrier);
    vkCmdClearColorImage(cmd, input->image, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, &input->value, 1, &whole);
}

static float half(uint16_t bits) {
    const int exponent = bits >> 10 & 31;
    const float magnitude = exponent == 0 ? ldexpf((float)(bits & 1023), -24) : ldexpf((float)((bits & 1023) | 1024), exponent - 25);
    return bits >> 15 ? -magnitude : magnitude;
}

int main(void) {
    Gpu gpu = open_gpu();
    Input inputs[INPUTS] = {
        {ATROUS_INPUT_DEPTH, VK_FORMAT_R32_SFLOAT, {{5, 0, 0, 0}}, 0, 0, 0},
        {ATROUS_INPUT_NORMAL, VK_FORMAT_R16G16B16A16_SFLOAT, {{0, 0, 1, 0}}, 0, 0, 0},
        {ATROUS_INPUT_NOISY_RADIANCE, VK_FORMAT_R16G16B16A16_SFLOAT, {{0.5f, 0.25f, 0.75f, 1}}, 0, 0, 0},
        {ATROUS_INPUT_SURFACE_ID, VK_FORMAT_R32_UINT, {{0}}, 0, 0, 0},
    };
    inputs[3].value.uint32[0] = 1;
    AtrousConfig config = {.struct_size = sizeof config};
    OK(atrous_config_default(&config, WIDTH, HEIGHT));
    AtrousCreateInfo info = {.struct_size = sizeof info};
    info.instance = gpu.instance, info.physical_device = gpu.physical_device, info.device = gpu.device;
    info.get_instance_proc_addr = vkGetInstanceProcAddr, info.config = &config;
    AtrousExecutor* executor = NULL;
    OK(atrous_executor_create(&info, &executor));

    AtrousLentImage lent[INPUTS];
    memset(lent, 0, sizeof lent);
    for (int i = 0; i < INPUTS; ++i) {
        create(&gpu, &inputs[i]);
        lent[i].struct_size = sizeof lent[i], lent[i].format = inputs[i].format, lent[i].name = inputs[i].name;
        lent[i].image = inputs[i].image, lent[i].view = inputs[i].view, lent[i].width = WIDTH, lent[i].height = HEIGHT;
        lent[i].layout = VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL;
        lent[i].stage = VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, lent[i].access = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    }
    const VkDeviceSize bytes = WIDTH * HEIGHT * 8;
    VkBufferCreateInfo buffer_info = {.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    buffer_info.size = bytes, buffer_info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    VkBuffer buffer;
    VK(vkCreateBuffer(gpu.device, &buffer_info, NULL, &buffer));
    VkMemoryRequirements needs;
    vkGetBufferMemoryRequirements(gpu.device, buffer, &needs);
    VkDeviceMemory memory = allocate(&gpu, needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
    VK(vkBindBufferMemory(gpu.device, buffer, memory, 0));

    for (uint32_t index = 0; index < 4; ++index) {
        VkCommandBufferBeginInfo begin = {.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        VK(vkBeginCommandBuffer(gpu.cmd, &begin));
        for (int i = 0; i < INPUTS; ++i) render(gpu.cmd, &inputs[i]);
        AtrousFrameParams params = {.struct_size = sizeof params};
        OK(atrous_frame_params_default(&params, WIDTH, HEIGHT));
        params.frame_slot = index % 2;
        OK(atrous_executor_denoise(executor, gpu.cmd, &params, lent, INPUTS));
        OK(atrous_executor_record_copy(executor, gpu.cmd, "denoised_radiance", buffer, bytes));
        VK(vkEndCommandBuffer(gpu.cmd));
        VkSubmitInfo submit = {.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO};
        submit.commandBufferCount = 1, submit.pCommandBuffers = &gpu.cmd;
        VK(vkQueueSubmit(gpu.queue, 1, &submit, VK_NULL_HANDLE));
        VK(vkQueueWaitIdle(gpu.queue));
    }
    void* mapped;
    VK(vkMapMemory(gpu.device, memory, 0, VK_WHOLE_SIZE, 0, &mapped));
    float worst = 0.0f;
    for (int i = 0; i < WIDTH * HEIGHT * 4; ++i) {
        uint16_t bits;
        memcpy(&bits, (const char*)mapped + 2 * i, sizeof bits);
        if (i % 4 < 3) worst = fmaxf(worst, fabsf(half(bits) / inputs[2].value.float32[i % 4] - 1.0f));
    }
    printf("atrous %u: the picture differs from the light by at most %.4f of it\n", (unsigned)atrous_version(), (double)worst);

    OK(atrous_executor_destroy(executor));
    for (int i = 0; i < INPUTS; ++i) {
        vkDestroyImageView(gpu.device, inputs[i].view, NULL);
        vkDestroyImage(gpu.device, inputs[i].image, NULL);
        vkFreeMemory(gpu.device, inputs[i].memory, NULL);
    }
    vkDestroyBuffer(gpu.device, buffer, NULL);
    vkFreeMemory(gpu.device, memory, NULL);
    vkDestroyCommandPool(gpu.device, gpu.pool, NULL);
    vkDestroyDevice(gpu.device, NULL);
    vkDestroyInstance(gpu.instance, NULL);
    return worst < 0.004f ? 0 : 1;
}
