// Random structs from a seed: sizes, null pointers, garbage in choices, arrays with an end. Each call is answered by success or by a
// message, what is refused is not written to, and a good frame works behind all of it.
#pragma once
#include <sys/mman.h>

#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "bad_input.hpp"

// Splitmix64.
class Dice {
public:
    explicit Dice(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        uint64_t v = state_ += 0x9e3779b97f4a7c15u;
        v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9u;
        v = (v ^ (v >> 27)) * 0x94d049bb133111ebu;
        return v ^ (v >> 31);
    }
    uint32_t below(uint32_t end) { return static_cast<uint32_t>(next() % end); }
    bool one_in(uint32_t n) { return below(n) == 0; }

    uint32_t odd() {
        const uint32_t values[] = {0, 1, 2, 3, 7, 8, 9, 16, 255, 65536, 0x7fffffff, 0x80000000, 0xffffffff, static_cast<uint32_t>(next())};
        return values[below(14)];
    }
    float odd_float() {
        const float values[] = {0, -0.0f, 1, -1, 0.5f, 1e-45f, 1e38f, -1e38f, NAN, INFINITY, -INFINITY};
        return values[below(11)];
    }

private:
    uint64_t state_;
};

// Bytes that end where a page begins that must not be touched.
class Fenced {
public:
    explicit Fenced(size_t size) : size_(size), room_((size + page - 1) / page * page) {
        pages_ = static_cast<uint8_t*>(mmap(nullptr, room_ + page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
        mprotect(pages_ + room_, page, PROT_NONE);
    }
    Fenced(const Fenced&) = delete;
    ~Fenced() { munmap(pages_, room_ + page); }

    uint8_t* bytes() { return pages_ + room_ - size_; }
    size_t size() const { return size_; }

private:
    static constexpr size_t page = 4096;
    size_t size_, room_;
    uint8_t* pages_;
};

// A struct of the host as it may come: null, whole, or so short that nothing but its size is there.
template <typename T>
class Given {
public:
    Given(const T& value, Dice& dice) {
        if (dice.one_in(16)) return;
        const bool is_short = dice.one_in(8);
        memory_ = std::make_unique<Fenced>(is_short ? sizeof(uint32_t) : sizeof(T));
        std::memcpy(memory_->bytes(), &value, memory_->size());
        uint32_t size = sizeof(T);
        if (is_short) do size = dice.odd(); while (size >= 8 && size < 65536);  // a size that a header may have is believed
        std::memcpy(memory_->bytes(), &size, sizeof size);
        before_.assign(memory_->bytes(), memory_->bytes() + memory_->size());
    }

    T* pointer() { return memory_ ? reinterpret_cast<T*>(memory_->bytes()) : nullptr; }
    bool is_unchanged() { return !memory_ || std::memcmp(before_.data(), memory_->bytes(), before_.size()) == 0; }

private:
    std::unique_ptr<Fenced> memory_;
    std::vector<uint8_t> before_;
};

// Replaces some of the 32-bit fields behind the size.
template <typename T>
void spoil(T& value, Dice& dice, bool floats) {
    uint32_t words[sizeof(T) / 4];
    std::memcpy(words, &value, sizeof words);
    for (uint32_t i = dice.below(4); i > 0; --i) {
        uint32_t& word = words[1 + dice.below(sizeof(T) / 4 - 1)];
        const float number = dice.odd_float();
        if (floats && dice.one_in(2)) std::memcpy(&word, &number, sizeof word);
        else word = dice.odd();
    }
    std::memcpy(&value, words, sizeof words);
}

class RandomInput {
public:
    RandomInput(const Engine& engine, uint64_t count) : engine_(engine), count_(count) {}

    int run() {
        AtrousConfig config{sizeof config};
        atrous_config_default(&config, 8, 8);
        AtrousCreateInfo info{sizeof info, engine_.instance, engine_.physical_device, engine_.device, vkGetInstanceProcAddr, &config};
        told(atrous_create(&info, &denoiser_), true, "the first denoiser");
        for (round_ = 0; round_ < count_; ++round_) {
            Dice dice(round_);
            switch (dice.below(8)) {
                case 0: create(dice); break;
                case 1: conventions(dice); break;
                case 2: case 3: frames(dice); break;
                case 4: case 5: bindings(dice); break;
                case 6: declarations(dice); break;
                default: handles(dice);
            }
        }
        AtrousFrameParams params{sizeof params};
        AtrousFrame frame{sizeof frame};
        if (atrous_resize(denoiser_, 8, 8) || atrous_frame_params_default(&params, 8, 8) || atrous_begin_frame(denoiser_, &params, &frame) ||
            atrous_destroy(denoiser_))
            fail("a good frame behind all of it");
        std::printf("random input: %llu calls, %llu refused, %llu wrong answers\n", calls_, refused_, wrong_);
        return wrong_ == 0 && refused_ > 0 && refused_ < calls_ ? 0 : 1;
    }

private:
    void fail(const char* what) {
        ++wrong_;
        std::fprintf(stderr, "round %llu, %s: %s\n", static_cast<unsigned long long>(round_), what, atrous_last_error());
    }

    // Whether the call succeeded. A refused one has a message and has changed nothing.
    bool told(AtrousStatus status, bool is_unchanged, const char* what) {
        ++calls_;
        if (status == ATROUS_STATUS_OK) return true;
        ++refused_;
        const bool is_known = status > ATROUS_STATUS_OK && status < ATROUS_STATUS_PANICKED;
        if (!is_known || !*atrous_last_error() || !is_unchanged) fail(what);
        return false;
    }

    void create(Dice& dice) {
        AtrousConfig config{sizeof config};
        atrous_config_default(&config, 1 + dice.below(64), 1 + dice.below(64));
        spoil(config, dice, false);
        Given<AtrousConfig> given(config, dice);
        AtrousCreateInfo info{sizeof info, engine_.instance, engine_.physical_device, engine_.device, vkGetInstanceProcAddr, given.pointer()};
        // Pipelines take a while: most are refused by their handles once everything else was looked at.
        if (!dice.one_in(64)) info.device = VK_NULL_HANDLE;
        if (dice.one_in(4)) info.get_instance_proc_addr = nullptr;
        Given<AtrousCreateInfo> outer(info, dice);
        AtrousDenoiser* made = nullptr;
        const bool is_there = !dice.one_in(16);
        if (told(atrous_create(outer.pointer(), is_there ? &made : nullptr), true, "atrous_create"))
            told(atrous_destroy(made), true, "atrous_destroy");
        else if (made) fail("a refused denoiser has a handle");
    }

    void conventions(Dice& dice) {
        AtrousConfig config{sizeof config};
        AtrousFrameParams params{sizeof params};
        const uint32_t width = 1 + dice.below(6), height = 1 + dice.below(6);
        atrous_config_default(&config, width, height), atrous_frame_params_default(&params, width, height);
        if (dice.one_in(2)) spoil(config, dice, false);
        if (dice.one_in(2)) spoil(params, dice, true);
        Given<AtrousConfig> given(config, dice);
        Given<AtrousFrameParams> of_frame(params, dice);
        Fenced texels(width * height * 16), ids(width * height * 4);
        for (size_t i = 0; i < texels.size(); i += 4) {
            const float number = dice.odd_float();
            std::memcpy(texels.bytes() + i, &number, 4);
        }
        const float* floats = reinterpret_cast<const float*>(texels.bytes());
        const auto some = [&] { return dice.one_in(3) ? nullptr : floats; };
        AtrousGuides guides{sizeof guides, width, height, of_frame.pointer(), some(), some(), some(), nullptr};
        if (dice.one_in(2)) guides.surface_id = reinterpret_cast<const uint32_t*>(ids.bytes());
        // An extent that is larger than the images is none that could be found out; 0 and too large ones are.
        if (dice.one_in(8)) guides.width = dice.one_in(2) ? 0 : 0xffffffff;
        Given<AtrousGuides> previous(guides, dice), current(guides, dice);
        Given<AtrousConventionReport> report(AtrousConventionReport{}, dice);
        const AtrousStatus status = atrous_check_conventions(given.pointer(), previous.pointer(), current.pointer(), report.pointer());
        told(status, report.is_unchanged(), "atrous_check_conventions");
    }

    void frames(Dice& dice) {
        AtrousFrameParams params{sizeof params};
        atrous_frame_params_default(&params, 8, 8);
        spoil(params, dice, true);
        Given<AtrousFrameParams> given(params, dice);
        Given<AtrousFrame> frame(AtrousFrame{}, dice);
        if (told(atrous_begin_frame(denoiser_, given.pointer(), frame.pointer()), frame.is_unchanged(), "atrous_begin_frame"))
            frame_ = *frame.pointer();
    }

    // Handles that nobody made are never followed: the count or the kind of one of them is wrong.
    void bindings(Dice& dice) {
        uint32_t passes = 0;
        told(atrous_counts(denoiser_, nullptr, &passes), true, "atrous_counts");
        AtrousPass pass{sizeof pass};
        const uint32_t index = dice.below(passes);
        told(atrous_pass(denoiser_, index, &pass), true, "atrous_pass");
        std::vector<AtrousBinding> right = bindings_of(denoiser_, pass);
        const bool counts = dice.one_in(2);
        if (!counts) {
            // A view where a buffer belongs, a buffer where a view does, or both at once.
            AtrousBinding& spoilt = right[dice.below(pass.use_count)];
            if (spoilt.buffer && dice.one_in(2)) spoilt.buffer = VK_NULL_HANDLE, spoilt.view = (VkImageView)(uintptr_t)0x10;
            else spoilt.view = (VkImageView)(uintptr_t)0x10, spoilt.buffer = (VkBuffer)(uintptr_t)0x10;
        }
        uint32_t count = pass.use_count, there = count;
        if (counts) do count = dice.odd(); while (count == pass.use_count);
        if (counts) there = dice.below(pass.use_count);
        Fenced array(there * sizeof(AtrousBinding));
        std::memcpy(array.bytes(), right.data(), array.size());
        AtrousFrame frame = frame_;
        frame.struct_size = sizeof frame;
        if (dice.one_in(4)) spoil(frame, dice, false);
        Given<AtrousFrame> given(frame, dice);
        const auto* pointer = dice.one_in(8) ? nullptr : reinterpret_cast<const AtrousBinding*>(array.bytes());
        const uint32_t number = dice.one_in(8) ? dice.odd() | 0x10000 : index;
        if (told(atrous_record(denoiser_, given.pointer(), engine_.cmd, number, pointer, count), given.is_unchanged(), "atrous_record"))
            fail("wrong bindings were recorded");
    }

    void declarations(Dice& dice) {
        Given<AtrousResource> resource(AtrousResource{}, dice);
        told(atrous_resource(denoiser_, dice.below(40), resource.pointer()), resource.is_unchanged(), "atrous_resource");
        Given<AtrousPass> pass(AtrousPass{}, dice);
        told(atrous_pass(denoiser_, dice.odd(), pass.pointer()), pass.is_unchanged(), "atrous_pass");
        Given<AtrousMemory> memory(AtrousMemory{}, dice);
        told(atrous_memory(denoiser_, memory.pointer()), memory.is_unchanged(), "atrous_memory");
        Given<AtrousTuningField> field(AtrousTuningField{}, dice);
        told(atrous_tuning_field(dice.odd(), field.pointer()), field.is_unchanged(), "atrous_tuning_field");
        told(atrous_resize(denoiser_, dice.one_in(2) ? 8 : dice.odd(), dice.one_in(2) ? 8 : dice.odd()), true, "atrous_resize");
        // A name that ends with its page.
        std::string name = dice.one_in(2) ? "alpha" : "";
        for (uint32_t i = dice.below(12); i > 0; --i) name += static_cast<char>(1 + dice.below(255));
        Fenced text(name.size() + 1);
        std::memcpy(text.bytes(), name.c_str(), text.size());
        told(atrous_set_tuning(denoiser_, reinterpret_cast<const char*>(text.bytes()), dice.odd_float()), true, "atrous_set_tuning");
        told(atrous_set_tuning(denoiser_, "alpha", dice.odd_float()), true, "atrous_set_tuning");
    }

    void handles(Dice& dice) {
        auto* handle = reinterpret_cast<AtrousDenoiser*>(static_cast<uintptr_t>(dice.next() >> dice.below(64)));
        if (handle == denoiser_) return;
        AtrousMemory memory{sizeof memory};
        const bool succeeded[] = {
            told(atrous_memory(handle, &memory), true, "atrous_memory"),
            told(atrous_invalidate(handle), true, "atrous_invalidate"),
            told(atrous_resize(handle, 8, 8), true, "atrous_resize"),
            told(atrous_destroy(handle), true, "atrous_destroy"),
        };
        for (const bool each : succeeded)
            if (each) fail("a handle that nobody made was taken");
    }

    const Engine& engine_;
    uint64_t count_, round_ = 0;
    unsigned long long calls_ = 0, refused_ = 0, wrong_ = 0;
    AtrousDenoiser* denoiser_ = nullptr;
    AtrousFrame frame_{};
};
