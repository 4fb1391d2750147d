//! Two views of one frame: a denoiser each, in one command buffer, and one set of transients for both.

use super::schedules::memory::{region, Memory, Stored};
use super::support::rig::UPLOADED;
use super::support::{assert_valid, gpu, scene::Scene, session, upload};
use ash::vk;
use atrous::config::Preset;
use atrous::{
    Barriers2, Binding, Config, Declaration, Denoiser, FrameContext, FrameParams, Lifetime, Phase, PhysicalResource, ResourceId,
    ResourceState, Shape, Tracker, Tuning,
};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("two_views_with_one_set_of_transients_have_the_bits_of_each_alone", two_views_have_the_bits_of_each_alone),
    ("images_of_another_format_with_views_of_the_declared_one_do", images_of_another_format_with_views_of_the_declared_one_do),
];

const EXTENT: [u32; 2] = [67, 35];
/// An input that is left out: where a surface was is then told by the matrices of the frame before, which each view has for itself.
const LEFT_OUT: &str = "motion";

/// A view: histories, inputs and outputs of its own.
struct View {
    denoiser: Denoiser,
    tracker: Tracker,
    resources: Vec<Vec<PhysicalResource>>,
}

impl View {
    /// Takes the transients of another view in the place of its own.
    fn new(declaration: &Declaration, memory: &mut Memory, other: Option<&Self>) -> Self {
        let ids = (0..declaration.resources().len() as u32).map(ResourceId);
        let resources = ids.map(|id| match other.filter(|_| declaration.resource(id).lifetime == Lifetime::Transient) {
            Some(other) => other.resources[id.0 as usize].clone(),
            None => made(declaration, memory, id),
        });
        let resources = resources.collect();
        // SAFETY: the device is live and outlives the denoiser.
        let denoiser = unsafe { Denoiser::new(gpu().host(), declaration.clone()) }.expect("denoiser");
        let mut tracker = Tracker::new(declaration);
        tracker.leave_out(declaration.find(LEFT_OUT).expect(LEFT_OUT));
        Self { denoiser, tracker, resources }
    }

    fn image(&self, id: ResourceId) -> vk::Image {
        let PhysicalResource::Image { image, .. } = self.resources[id.0 as usize][0] else { panic!("an image") };
        image
    }

    /// # Safety
    /// The command buffer is recording.
    unsafe fn barriers(&mut self, cmd: vk::CommandBuffer, pass: usize, frame: &FrameContext) {
        let mut barriers = Barriers2::default();
        barriers.set(self.tracker.barriers(pass, frame), |id, copy| self.resources[id.0 as usize].get(copy).copied());
        // SAFETY: as this function's own; everything is live, and as the tracker says.
        unsafe { gpu().device().cmd_pipeline_barrier2(cmd, &barriers.dependency_info()) };
    }

    /// # Safety
    /// The command buffer is recording.
    unsafe fn access(&mut self, cmd: vk::CommandBuffer, id: ResourceId, next: ResourceState, discard: bool) {
        let mut barriers = Barriers2::default();
        barriers.set(self.tracker.access(id, 0, next, discard), |id, copy| self.resources[id.0 as usize].get(copy).copied());
        // SAFETY: as this function's own; everything is live, and as the tracker says.
        unsafe { gpu().device().cmd_pipeline_barrier2(cmd, &barriers.dependency_info()) };
    }

    /// Uploads the inputs, records all phases, and copies the result out.
    ///
    /// # Safety
    /// The command buffer is recording, and earlier work is complete.
    unsafe fn frame(&mut self, cmd: vk::CommandBuffer, memory: &mut Memory, scene: &Scene, index: u32) -> *const u8 {
        let declaration = self.denoiser.declaration().clone();
        let params = FrameParams { frame_slot: index % 2, ..scene.params(index) };
        let frame = self.denoiser.begin_frame(&params, &Tuning::default()).expect("frame");
        let guides = scene.frame(index, index);
        let ids: &[u8] = bytemuck::cast_slice(&guides.surface_id);
        let images = guides.declared(&declaration).filter(|(name, _)| *name != LEFT_OUT);
        let images = images.map(|(name, texels)| (name, bytemuck::cast_slice(texels)));
        for (name, bytes) in images.chain([("surface_id", ids)]) {
            let id = declaration.find(name).expect(name);
            let staging = memory.mapped(bytes.len() as u64, vk::BufferUsageFlags::TRANSFER_SRC);
            // SAFETY: the buffer is mapped and this large; the image is in this layout behind the barrier.
            unsafe {
                staging.pointer.copy_from_nonoverlapping(bytes.as_ptr(), bytes.len());
                let (stage, access, layout) = UPLOADED;
                self.access(cmd, id, ResourceState::new(stage, access, layout), true);
                gpu().device().cmd_copy_buffer_to_image(cmd, staging.buffer, self.image(id), layout, &[region(EXTENT)]);
            }
        }
        let mut bindings: Vec<Binding> = Vec::new();
        for pass in Phase::ALL.into_iter().flat_map(|phase| declaration.passes_of(phase)) {
            // SAFETY: the barriers bring everything to its declared layout and make earlier writes visible.
            unsafe {
                self.barriers(cmd, pass, &frame);
                let physical = |id: ResourceId, copy: usize| self.resources[id.0 as usize].get(copy).copied();
                self.tracker.bindings(pass, &frame, physical, &mut bindings);
                self.denoiser.record(cmd, &frame, pass, &bindings).expect("recorded");
            }
        }
        let id = declaration.find("denoised_radiance").expect("the output");
        let result = memory.mapped(u64::from(EXTENT[0] * EXTENT[1] * 8), vk::BufferUsageFlags::TRANSFER_DST);
        // SAFETY: the image is in this layout behind the barrier, and the buffer has room for it.
        unsafe {
            self.access(cmd, id, ResourceState::COPY_SOURCE, false);
            let layout = vk::ImageLayout::TRANSFER_SRC_OPTIMAL;
            gpu().device().cmd_copy_image_to_buffer(cmd, self.image(id), layout, result.buffer, &[region(EXTENT)]);
        }
        result.pointer
    }

    /// Goes on where another view left the transients that both have.
    fn takes_transients_over_from(&mut self, other: &Self) {
        let resources = self.denoiser.declaration().resources().iter();
        for (id, _) in (0..).map(ResourceId).zip(resources).filter(|(_, r)| r.lifetime == Lifetime::Transient) {
            self.tracker.set_state(id, 0, other.tracker.state(id, 0).expect("a transient"));
        }
    }
}

fn made(declaration: &Declaration, memory: &mut Memory, id: ResourceId) -> Vec<PhysicalResource> {
    let resource = declaration.resource(id);
    let is_input = matches!(resource.lifetime, Lifetime::Input { .. });
    let one = |_| match resource.shape {
        Shape::Buffer { size } => PhysicalResource::buffer(memory.mapped(size, resource.buffer_usage).buffer),
        Shape::Image { format, .. } => {
            let wide = vk::Format::R32G32B32A32_SFLOAT;
            let format = if is_input && format.accepts(wide) { wide } else { format.preferred() };
            let extent = resource.extent(declaration.setup()).expect("an image");
            let bare = memory.image(format, extent, resource.image_usage);
            let block = memory.allocate(bare.needs, vk::MemoryPropertyFlags::empty());
            match memory.bind(bare, block, 0) {
                Stored::Image { image, view, .. } => PhysicalResource::color(image, view),
                Stored::Buffer { buffer } => PhysicalResource::buffer(buffer),
            }
        }
    };
    (0..resource.lifetime.copies().max(usize::from(is_input))).map(one).collect()
}

/// What a session gives that has the view for itself.
fn alone(config: &Config, scene: &Scene, frames: u32) -> Vec<Vec<u8>> {
    let mut s = session(config);
    let frame = |index: u32| {
        upload(&mut s, &scene.frame(index, index));
        s.unbind(LEFT_OUT).expect(LEFT_OUT);
        s.run(&scene.params(index), &Tuning::default()).expect("frame");
        s.download_bytes("denoised_radiance", atrous::UseFrame::Current).expect("output")
    };
    (0..frames).map(frame).collect()
}

/// Records a command buffer, submits it, and waits.
fn submit(record: impl FnOnce(vk::CommandBuffer)) {
    let gpu = gpu();
    let device = gpu.device();
    let info = vk::CommandPoolCreateInfo::default().queue_family_index(gpu.queue_family());
    // SAFETY: the device is live; the pool is destroyed behind the work that used it.
    unsafe {
        let pool = device.create_command_pool(&info, None).expect("pool");
        let info = vk::CommandBufferAllocateInfo::default().command_pool(pool).command_buffer_count(1);
        let commands = device.allocate_command_buffers(&info).expect("command buffer");
        device.begin_command_buffer(commands[0], &vk::CommandBufferBeginInfo::default()).expect("begin");
        record(commands[0]);
        device.end_command_buffer(commands[0]).expect("end");
        let queue = gpu.queue();
        let submit = [vk::SubmitInfo::default().command_buffers(&commands)];
        device.queue_submit(*queue, &submit, vk::Fence::null()).expect("submit");
        device.queue_wait_idle(*queue).expect("wait");
        device.destroy_command_pool(pool, None);
    }
}

fn two_views_have_the_bits_of_each_alone() {
    two_views(None);
}

/// An allocator whose formats are few: 64 bits are enough, and the views say which.
fn images_of_another_format_with_views_of_the_declared_one_do() {
    two_views(Some(vk::Format::R32G32_UINT));
}

fn two_views(stands_for_rgba16_uint: Option<vk::Format>) {
    const FRAMES: u32 = 4;
    for preset in [Preset::Svgf, Preset::Best] {
        let config = Config { preset, ..Config::new(EXTENT) };
        let declaration = config.declare().expect("valid");
        // Two eyes that go different ways in light of their own.
        let scenes = [Scene { speed: 0.12, ..Scene::new(EXTENT) }, Scene { speed: -0.07, light: 1.5, ..Scene::new(EXTENT) }];
        let mut memory = Memory::new();
        memory.stands_for_rgba16_uint = stands_for_rgba16_uint;
        let left = View::new(&declaration, &mut memory, None);
        let right = View::new(&declaration, &mut memory, Some(&left));
        let mut views = [left, right];
        let expected = scenes.map(|scene| alone(&config, &scene, FRAMES));
        for index in 0..FRAMES {
            let mut results = [std::ptr::null(); 2];
            submit(|cmd| {
                for (i, scene) in scenes.iter().enumerate() {
                    let [left, right] = &mut views;
                    let (view, other) = if i == 0 { (left, right) } else { (right, left) };
                    view.takes_transients_over_from(other);
                    // SAFETY: the command buffer is recording, and earlier frames were waited for.
                    results[i] = unsafe { view.frame(cmd, &mut memory, scene, index) };
                }
            });
            for (i, result) in results.into_iter().enumerate() {
                let expected = &expected[i][index as usize];
                // SAFETY: the buffer is mapped and this large, and the copy into it is complete.
                let given = unsafe { std::slice::from_raw_parts(result, expected.len()) };
                assert!(given == expected.as_slice(), "{preset}: view {i} has other bits in frame {index}");
            }
        }
        print_memory(&declaration);
        drop(views);
    }
    assert_valid();
}

fn print_memory(declaration: &Declaration) {
    let (memory, pixels) = (declaration.memory(), f64::from(EXTENT[0] * EXTENT[1]));
    let of = |bytes: u64| bytes as f64 / pixels;
    println!("two views: 2 x {:.1} B of history and {:.1} B of transients a pixel", of(memory.history), of(memory.transient));
}
