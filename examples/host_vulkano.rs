//! The denoiser inside the task graph of `vulkano-taskgraph`, which places barriers and submits: every pass is a task with the accesses
//! that it declares. A history is two virtual images, which are mapped to its copies by the parity of the frame. A resource of that
//! graph may not be in two frames in flight, so there is one.
//!
//! Prints a checksum of every denoised frame: `cargo run --example host_vulkano`.

use ash::vk::Handle;
use atrous::{Access, Binding, Config, Denoiser, Device, FrameContext, FrameParams, Lifetime, Phase, ResourceDecl};
use atrous::{Declaration, Setup, Shape, Tuning, UseFrame};
use atrous_synthetic as synthetic;
use std::sync::Arc;
use vulkano::buffer::{Buffer, BufferCreateInfo, BufferUsage, Subbuffer};
use vulkano::device::{DeviceCreateInfo, DeviceFeatures, Queue, QueueCreateInfo, QueueFlags};
use vulkano::format::Format;
use vulkano::image::{view::ImageView, Image, ImageCreateInfo, ImageUsage};
use vulkano::instance::{Instance, InstanceCreateInfo};
use vulkano::memory::allocator::{AllocationCreateInfo, DeviceLayout, MemoryTypeFilter};
use vulkano::{Version, VulkanLibrary, VulkanObject};
use vulkano_taskgraph::command_buffer::{CopyBufferToImageInfo, CopyImageToBufferInfo, RecordingCommandBuffer};
use vulkano_taskgraph::graph::{CompileInfo, ExecutableTaskGraph, NodeId, ResourceMap, TaskGraph};
use vulkano_taskgraph::resource::{AccessTypes, Flight, HostAccessType, ImageLayoutType, Resources};
use vulkano_taskgraph::{Id, QueueFamilyType, Task, TaskContext, TaskResult};

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

const OPTIMAL: ImageLayoutType = ImageLayoutType::Optimal;
/// Bytes of the largest input: four floats a texel.
const STAGING_BYTES: u64 = (synthetic::EXTENT[0] * synthetic::EXTENT[1] * 16) as u64;

/// The names of the images by their place in [`World::input`].
fn inputs() -> impl Iterator<Item = (usize, &'static str)> {
    synthetic::NAMES.into_iter().chain(["surface_id"]).enumerate()
}

/// The one table that a host with a vocabulary of its own needs.
fn access_types(access: Access, is_buffer: bool) -> AccessTypes {
    match access {
        Access::Sampled => AccessTypes::COMPUTE_SHADER_SAMPLED_READ,
        Access::StorageRead => AccessTypes::COMPUTE_SHADER_STORAGE_READ,
        Access::StorageWrite => AccessTypes::COMPUTE_SHADER_STORAGE_WRITE,
        Access::StorageReadWrite => AccessTypes::COMPUTE_SHADER_STORAGE_READ.union(AccessTypes::COMPUTE_SHADER_STORAGE_WRITE),
        Access::Uniform => AccessTypes::COMPUTE_SHADER_UNIFORM_READ,
        // A buffer with `CLEAR_TRANSFER_WRITE` is a panic.
        Access::Clear if is_buffer => AccessTypes::COPY_TRANSFER_WRITE,
        Access::Clear => AccessTypes::CLEAR_TRANSFER_WRITE.union(AccessTypes::COPY_TRANSFER_WRITE),
    }
}

/// A resource of the host.
enum Resource {
    Image(Id<Image>, Arc<ImageView>),
    Buffer(Id<Buffer>, Arc<Buffer>),
}

/// What tasks see of a frame.
struct World {
    denoiser: Denoiser,
    frame: Option<FrameContext>,
    /// Texels by input.
    input: Vec<Vec<u8>>,
    /// By `ResourceId`, then copy: two of a history, none of an input that the host does not have.
    resources: Vec<Vec<Resource>>,
}

impl World {
    fn bindings(&self, pass: usize, frame: &FrameContext) -> Vec<Binding> {
        let declaration = self.denoiser.declaration();
        let bind = |u: &atrous::Use| {
            let layout = u.access.image().layout;
            match self.resources[u.resource.0 as usize].get(declaration.copy(u, frame)) {
                Some(Resource::Image(_, view)) => Binding::Image { view: view.handle(), layout },
                Some(Resource::Buffer(_, buffer)) => {
                    Binding::Buffer { buffer: buffer.handle(), offset: 0, range: ash::vk::WHOLE_SIZE }
                }
                None => Binding::Absent,
            }
        };
        declaration.passes()[pass].uses.iter().map(bind).collect()
    }
}

/// A task of the graph.
enum Step {
    /// A pass of the denoiser.
    Pass(usize),
    /// Passes of the host that write an input stand here.
    Upload { input: usize, staging: Id<Buffer>, image: Id<Image> },
    /// Passes of the host that read the result stand here.
    Download { image: Id<Image>, result: Id<Buffer> },
}

impl Task for Step {
    type World = World;

    unsafe fn execute(&self, cbf: &mut RecordingCommandBuffer<'_>, tcx: &mut TaskContext<'_>, world: &World) -> TaskResult {
        match *self {
            Step::Pass(pass) => {
                let frame = world.frame.as_ref().expect("begun");
                let bindings = world.bindings(pass, frame);
                // SAFETY: the graph brought every declared access into its layout, behind its barriers.
                unsafe { world.denoiser.record(cbf.handle(), frame, pass, &bindings) }.expect("bindings that fit");
            }
            Step::Upload { input, staging, image } => {
                let bytes = &world.input[input];
                tcx.write_buffer::<[u8]>(staging, ..bytes.len() as u64)?.copy_from_slice(bytes);
                // SAFETY: both are declared accesses of this task.
                unsafe {
                    let copy = CopyBufferToImageInfo { src_buffer: staging, dst_image: image, ..Default::default() };
                    cbf.copy_buffer_to_image(&copy)?;
                }
            }
            Step::Download { image, result } => {
                let copy = CopyImageToBufferInfo { src_image: image, dst_buffer: result, ..Default::default() };
                // SAFETY: both are declared accesses of this task.
                unsafe { cbf.copy_image_to_buffer(&copy)? };
            }
        }
        Ok(())
    }
}

/// Two virtual images of a history: this frame's, the previous frame's.
type Virtual = Option<[Id<Image>; 2]>;

struct Host {
    /// Goes first, and with it the denoiser, before the device.
    world: World,
    graph: ExecutableTaskGraph<World>,
    /// By `ResourceId`.
    histories: Vec<Virtual>,
    resources: Arc<Resources>,
    flight: Id<Flight>,
    result: Id<Buffer>,
}

impl Host {
    fn new() -> Result<Self> {
        let library = VulkanLibrary::new()?;
        let info = InstanceCreateInfo { max_api_version: Some(Version::V1_3), ..Default::default() };
        let instance = Instance::new(library.clone(), info)?;
        let physical_device = instance.enumerate_physical_devices()?.next().ok_or("no Vulkan device")?;
        let families = physical_device.queue_family_properties();
        let family = families.iter().position(|f| f.queue_flags.contains(QueueFlags::COMPUTE)).ok_or("no queue")? as u32;
        let queue_create_infos = vec![QueueCreateInfo { queue_family_index: family, ..Default::default() }];
        let enabled_features = DeviceFeatures { synchronization2: true, ..Default::default() };
        let info = DeviceCreateInfo { queue_create_infos, enabled_features, ..Default::default() };
        let (device, mut queues) = vulkano::device::Device::new(physical_device.clone(), info)?;
        let queue = queues.next().ok_or("no queue")?;
        // vulkano has functions of `ash` and not its `Device`, so they are loaded once more.
        // SAFETY: the handles are live, belong together, and outlive the denoiser.
        let denoiser = unsafe {
            let name = c"vkGetInstanceProcAddr";
            let function = library.get_instance_proc_addr(instance.handle(), name.as_ptr()).ok_or("no loader")?;
            let handles = [instance.handle().as_raw(), physical_device.handle().as_raw(), device.handle().as_raw()];
            let loaded = Device::from_raw(function as *const std::ffi::c_void, handles[0], handles[1], handles[2])?;
            Denoiser::new(loaded.device(), Config { frames_in_flight: 1, ..Config::new(synthetic::EXTENT) }.declare()?)?
        };
        let resources = Resources::new(&device, &Default::default());
        let mut world = World { denoiser, frame: None, input: Vec::new(), resources: Vec::new() };
        for decl in world.denoiser.declaration().resources() {
            let copies = 0..if is_left_out(decl) { 0 } else { decl.lifetime.copies().max(1) };
            world.resources.push(copies.map(|_| create(&resources, decl)).collect::<Result<_>>()?);
        }
        let flight = resources.create_flight(1)?;
        let result = create_staging(&resources, BufferUsage::TRANSFER_DST, MemoryTypeFilter::HOST_RANDOM_ACCESS)?;
        let (graph, histories) = build(&world, &resources, result)?.compile(&queue, flight)?;
        Ok(Self { world, graph, histories, resources, flight, result })
    }

    fn frame(&mut self, index: u32) -> Result<Vec<u8>> {
        let input = synthetic::Frame::new(index);
        let ids = input.surface_id.iter().flat_map(|id| id.to_le_bytes()).collect();
        self.world.input = input.images.iter().map(|texels| synthetic::bytes(texels)).chain([ids]).collect();
        let (view_from_world, clip_from_view) = (synthetic::view_from_world(index), synthetic::clip_from_view());
        let params = FrameParams { view_from_world, clip_from_view, ..FrameParams::new(synthetic::EXTENT) };
        let frame = self.world.denoiser.begin_frame(&params, &Tuning::default())?;
        self.world.frame = Some(frame);
        let mut map = ResourceMap::new(&self.graph)?;
        for (copies, history) in self.world.resources.iter().zip(&self.histories) {
            for (use_frame, virtual_image) in [UseFrame::Current, UseFrame::Previous].into_iter().zip(history.iter().flatten()) {
                let Resource::Image(image, _) = &copies[frame.history_copy(use_frame)] else { continue };
                map.insert_image(*virtual_image, *image)?;
            }
        }
        // SAFETY: no other graph runs, and no other frame is in flight.
        unsafe { self.graph.execute(map, &self.world, || {})? };
        self.resources.flight(self.flight)?.wait(None)?;
        let result = Subbuffer::new(self.resources.buffer(self.result)?.buffer().clone());
        let bytes = result.read()?[..(STAGING_BYTES / 2) as usize].to_vec();
        Ok(bytes)
    }
}

/// A graph that is being built: each task behind the one before.
struct Chain {
    graph: TaskGraph<World>,
    last: Option<NodeId>,
    histories: Vec<Virtual>,
}

impl Chain {
    fn push(&mut self, node: NodeId) -> Result<()> {
        if let Some(last) = self.last.replace(node) {
            self.graph.add_edge(last, node)?;
        }
        Ok(())
    }

    /// A pass of the denoiser, with the accesses that it declares.
    fn pass(&mut self, world: &World, declaration: &Declaration, index: usize) -> Result<()> {
        let pass = &declaration.passes()[index];
        let mut node = self.graph.create_task_node(pass.name.clone(), QueueFamilyType::Compute, Step::Pass(index));
        for u in &pass.uses {
            let history = self.histories[u.resource.0 as usize].map(|[current, previous]| match u.frame {
                UseFrame::Current => current,
                UseFrame::Previous => previous,
            });
            match world.resources[u.resource.0 as usize].first() {
                Some(Resource::Image(image, _)) => {
                    node.image_access(history.unwrap_or(*image), access_types(u.access, false), OPTIMAL);
                }
                Some(Resource::Buffer(buffer, _)) => {
                    node.buffer_access(*buffer, access_types(u.access, true));
                }
                None => {} // an optional input
            }
        }
        let node = node.build();
        self.push(node)
    }

    fn upload(&mut self, resources: &Resources, input: usize, image: Id<Image>) -> Result<()> {
        let staging = create_staging(resources, BufferUsage::TRANSFER_SRC, MemoryTypeFilter::HOST_SEQUENTIAL_WRITE)?;
        self.graph.add_host_buffer_access(staging, HostAccessType::Write);
        let task = Step::Upload { input, staging, image };
        let mut node = self.graph.create_task_node("upload", QueueFamilyType::Compute, task);
        node.buffer_access(staging, AccessTypes::COPY_TRANSFER_READ);
        node.image_access(image, AccessTypes::COPY_TRANSFER_WRITE, OPTIMAL);
        let node = node.build();
        self.push(node)
    }

    fn download(&mut self, image: Id<Image>, result: Id<Buffer>) -> Result<()> {
        self.graph.add_host_buffer_access(result, HostAccessType::Read);
        let task = Step::Download { image, result };
        let mut node = self.graph.create_task_node("download", QueueFamilyType::Compute, task);
        node.image_access(image, AccessTypes::COPY_TRANSFER_READ, OPTIMAL);
        node.buffer_access(result, AccessTypes::COPY_TRANSFER_WRITE);
        let node = node.build();
        self.push(node)
    }

    fn compile(self, queue: &Arc<Queue>, flight_id: Id<Flight>) -> Result<(ExecutableTaskGraph<World>, Vec<Virtual>)> {
        let info = CompileInfo { queues: &[queue], flight_id, ..Default::default() };
        // SAFETY: the queue computes and copies, and every access is one that the images were created for.
        let graph = unsafe { self.graph.compile(&info) }.map_err(|error| error.to_string())?;
        Ok((graph, self.histories))
    }
}

/// The tasks of a frame: guides, the first phase, light, the second phase, and the result.
fn build(world: &World, resources: &Arc<Resources>, result: Id<Buffer>) -> Result<Chain> {
    let declaration = world.denoiser.declaration();
    let mut graph = TaskGraph::new(resources, 128, 128);
    let mut histories = Vec::new();
    for decl in declaration.resources() {
        let is_history = decl.lifetime == Lifetime::History;
        let info = image_info(decl)?.filter(|_| is_history);
        histories.push(info.map(|info| [graph.add_image(&info), graph.add_image(&info)]));
    }
    let mut chain = Chain { graph, last: None, histories };
    let image = |name: &str| -> Result<Id<Image>> {
        let id = declaration.find(name).ok_or("no such resource")?;
        match world.resources[id.0 as usize].first() {
            Some(Resource::Image(image, _)) => Ok(*image),
            _ => Err("not an image".into()),
        }
    };
    for (input, name) in inputs().filter(|(_, name)| *name != "noisy_radiance") {
        chain.upload(resources, input, image(name)?)?;
    }
    for phase in [Phase::BeforeLighting, Phase::AfterLighting] {
        for (input, name) in inputs().filter(|(_, name)| phase == Phase::AfterLighting && *name == "noisy_radiance") {
            chain.upload(resources, input, image(name)?)?; // the host's path tracer stands here
        }
        for pass in declaration.passes_of(phase) {
            chain.pass(world, declaration, pass)?;
        }
    }
    chain.download(image("denoised_radiance")?, result)?;
    Ok(chain)
}

fn is_left_out(decl: &ResourceDecl) -> bool {
    matches!(decl.lifetime, Lifetime::Input { .. }) && !inputs().any(|(_, name)| name == decl.name)
}

/// How to create an image; `None` for a buffer.
fn image_info(decl: &ResourceDecl) -> Result<Option<ImageCreateInfo>> {
    let (Shape::Image { format, .. }, Some([width, height])) = (decl.shape, decl.extent(&Setup::new(synthetic::EXTENT))) else {
        return Ok(None);
    };
    let is_float_input = synthetic::NAMES.contains(&decl.name.as_str());
    let format = if is_float_input { ash::vk::Format::R32G32B32A32_SFLOAT } else { format.preferred() };
    let format = Format::try_from(format).map_err(|()| format!("{format:?} is unknown to vulkano"))?;
    let usage = ImageUsage::from(decl.image_usage) | ImageUsage::TRANSFER_DST | ImageUsage::TRANSFER_SRC;
    Ok(Some(ImageCreateInfo { format, extent: [width, height, 1], usage, ..Default::default() }))
}

fn create(resources: &Resources, decl: &ResourceDecl) -> Result<Resource> {
    let memory = AllocationCreateInfo::default();
    if let Some(info) = image_info(decl)? {
        let id = resources.create_image(info, memory)?;
        let image = resources.image(id)?.image().clone();
        return Ok(Resource::Image(id, ImageView::new_default(image)?));
    }
    let Shape::Buffer { size } = decl.shape else { return Err("an image without an extent".into()) };
    let info = BufferCreateInfo { usage: BufferUsage::from(decl.buffer_usage), ..Default::default() };
    let layout = DeviceLayout::from_size_alignment(size, 16).ok_or("a buffer without a size")?;
    let id = resources.create_buffer(info, memory, layout)?;
    Ok(Resource::Buffer(id, resources.buffer(id)?.buffer().clone()))
}

fn create_staging(resources: &Resources, usage: BufferUsage, memory_type_filter: MemoryTypeFilter) -> Result<Id<Buffer>> {
    let info = BufferCreateInfo { usage, ..Default::default() };
    let memory = AllocationCreateInfo { memory_type_filter, ..Default::default() };
    let layout = DeviceLayout::from_size_alignment(STAGING_BYTES, 16).ok_or("a buffer without a size")?;
    Ok(resources.create_buffer(info, memory, layout)?)
}

/// Runs the sequence and prints a checksum of every frame.
fn main() -> Result<()> {
    let mut host = Host::new()?;
    for index in 0..synthetic::FRAMES {
        println!("{}", synthetic::report(index, &host.frame(index)?));
    }
    Ok(())
}
