//! The denoiser inside the frame graph of `vk-graph`, which owns images, barriers and scheduling: every pass becomes a command with the
//! accesses that it declares, and both copies of a history are bound anew each frame.
//!
//! Prints a checksum of every denoised frame: `cargo run --example host_vk_graph`.

use ash::vk;
use atrous::{
    Access, Binding, Config, Declaration, Denoiser, Device, FrameContext, FrameParams, Phase, ResourceDecl, Setup, Shape, Tuning,
};
use atrous_synthetic as synthetic;
use std::sync::{Arc, Mutex, PoisonError};
use vk_graph::driver::buffer::{Buffer, BufferInfo};
use vk_graph::driver::device::{Device as GraphDevice, DeviceInfo};
use vk_graph::driver::image::{Image, ImageInfo};
use vk_graph::driver::sync::AccessType;
use vk_graph::node::{BufferNode, ImageNode};
use vk_graph::pool::hash::HashPool;
use vk_graph::Graph;

type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

// docs: begin
/// The one table that a host with a vocabulary of its own needs.
fn access_type(access: Access) -> AccessType {
    match access {
        Access::Sampled => AccessType::ComputeShaderReadSampledImageOrUniformTexelBuffer,
        Access::StorageRead => AccessType::ComputeShaderReadOther,
        Access::StorageWrite => AccessType::ComputeShaderWrite,
        Access::StorageReadWrite => AccessType::ComputeShaderReadWrite,
        Access::Uniform => AccessType::ComputeShaderReadUniformBuffer,
        Access::Clear => AccessType::TransferWrite,
    }
}
// docs: end

/// A resource of the host, which outlives the graph of a frame.
enum Resource {
    Image(Arc<Image>),
    Buffer(Arc<Buffer>),
}

/// The same, bound to the graph of a frame.
#[derive(Clone, Copy)]
enum Node {
    Image(ImageNode),
    Buffer(BufferNode),
}

struct Host {
    device: GraphDevice,
    denoiser: Arc<Mutex<Denoiser>>,
    declaration: Declaration,
    /// By `ResourceId`, then copy: two of a history, none of an input that the host does not have.
    resources: Vec<Vec<Resource>>,
}

impl Host {
    fn new() -> Result<Self> {
        let device = GraphDevice::create(DeviceInfo::default())?;
        let host = Device {
            instance: &device.physical.instance,
            physical_device: device.physical.handle,
            device: &device,
            // vk-graph keeps its own to itself.
            pipeline_cache: vk::PipelineCache::null(),
            pipelines: None,
        };
        // SAFETY: the handles are live, belong together, and the denoiser is dropped before the device.
        let denoiser = unsafe { Denoiser::new(host, Config::new(synthetic::EXTENT).declare()?)? };
        let declaration = denoiser.declaration().clone();
        let mut resources = Vec::new();
        for decl in declaration.resources() {
            let is_input = decl.name == "surface_id" || synthetic::NAMES.contains(&decl.name.as_str());
            let copies = 0..if is_input { 1 } else { decl.lifetime.copies() };
            resources.push(copies.map(|_| create(&device, decl)).collect::<Result<Vec<_>>>()?);
        }
        Ok(Self { device, denoiser: Arc::new(Mutex::new(denoiser)), declaration, resources })
    }

    fn frame(&self, index: u32) -> Result<Vec<u8>> {
        let input = synthetic::Frame::new(index);
        let params = FrameParams {
            frame_slot: index % 2,
            view_from_world: synthetic::view_from_world(index),
            clip_from_view: synthetic::clip_from_view(),
            ..FrameParams::new(synthetic::EXTENT)
        };
        let frame = lock(&self.denoiser).begin_frame(&params, &Tuning::default())?;
        let mut graph = Graph::new();
        let nodes: Vec<Vec<Node>> =
            self.resources.iter().map(|copies| copies.iter().map(|r| bind(&mut graph, r)).collect()).collect();
        for (name, texels) in synthetic::NAMES.iter().zip(&input.images).take(4) {
            self.upload(&mut graph, &nodes, name, &synthetic::bytes(texels))?;
        }
        let ids: Vec<u8> = input.surface_id.iter().flat_map(|id| id.to_le_bytes()).collect();
        self.upload(&mut graph, &nodes, "surface_id", &ids)?;
        self.add_phase(&mut graph, &nodes, frame, Phase::BeforeLighting);
        // The host's path tracer stands here.
        self.upload(&mut graph, &nodes, "noisy_radiance", &synthetic::bytes(&input.images[4]))?;
        self.add_phase(&mut graph, &nodes, frame, Phase::AfterLighting);
        let size = u64::from(synthetic::EXTENT[0] * synthetic::EXTENT[1] * 8);
        let result =
            graph.bind_resource(Buffer::create(&self.device, BufferInfo::host_mem(size, vk::BufferUsageFlags::TRANSFER_DST))?);
        let Node::Image(output) = self.node(&nodes, "denoised_radiance")? else { return Err("the output is no image".into()) };
        graph.copy_image_to_buffer(output, result);
        let result = graph.resource(result).clone();
        let mut fence = graph.finalize().queue_submit(&mut HashPool::new(&self.device), 0, 0)?;
        fence.wait()?;
        Ok(result.mapped_slice().to_vec())
    }

    /// The passes of a phase as commands of the graph.
    fn add_phase(&self, graph: &mut Graph, nodes: &[Vec<Node>], frame: FrameContext, phase: Phase) {
        for (index, pass) in self.declaration.passes().iter().enumerate().filter(|(_, pass)| pass.phase == phase) {
            let mut command = graph.begin_cmd().debug_name(pass.name.as_str());
            let mut bound = Vec::new();
            for u in &pass.uses {
                let node = nodes[u.resource.0 as usize].get(self.declaration.copy(u, &frame)).copied();
                match node {
                    Some(Node::Image(image)) => command.set_resource_access(image, access_type(u.access)),
                    Some(Node::Buffer(buffer)) => command.set_resource_access(buffer, access_type(u.access)),
                    None => {} // an optional input
                }
                bound.push((node, u.access));
            }
            let denoiser = self.denoiser.clone();
            command.record_cmd(move |command| {
                let bindings: Vec<Binding> = bound
                    .iter()
                    .map(|&(node, access)| match node {
                        Some(Node::Image(image)) => {
                            let (image, layout) = (command.resource(image), access.image().layout);
                            Binding::Image { view: image.view(image.info.into_image_view()).expect("a view"), layout }
                        }
                        Some(Node::Buffer(buffer)) => {
                            Binding::Buffer { buffer: command.resource(buffer).handle, offset: 0, range: vk::WHOLE_SIZE }
                        }
                        None => Binding::Absent,
                    })
                    .collect();
                // SAFETY: vk-graph placed the barriers of every declared access before this command.
                unsafe { lock(&denoiser).record(command.handle, &frame, index, &bindings) }.expect("bindings that fit");
            });
        }
    }

    fn node(&self, nodes: &[Vec<Node>], name: &str) -> Result<Node> {
        let id = self.declaration.find(name).ok_or("no such resource")?;
        Ok(*nodes[id.0 as usize].first().ok_or("not allocated")?)
    }

    fn upload(&self, graph: &mut Graph, nodes: &[Vec<Node>], name: &str, bytes: &[u8]) -> Result<()> {
        let Node::Image(image) = self.node(nodes, name)? else { return Err("the input is no image".into()) };
        let buffer = graph.bind_resource(Buffer::create_from_slice(&self.device, vk::BufferUsageFlags::TRANSFER_SRC, bytes)?);
        graph.copy_buffer_to_image(buffer, image);
        Ok(())
    }
}

fn lock(denoiser: &Mutex<Denoiser>) -> std::sync::MutexGuard<'_, Denoiser> {
    denoiser.lock().unwrap_or_else(PoisonError::into_inner)
}

fn bind(graph: &mut Graph, resource: &Resource) -> Node {
    match resource {
        Resource::Image(image) => Node::Image(graph.bind_resource(image)),
        Resource::Buffer(buffer) => Node::Buffer(graph.bind_resource(buffer)),
    }
}

fn create(device: &GraphDevice, decl: &ResourceDecl) -> Result<Resource> {
    Ok(match (decl.shape, decl.extent(&Setup::new(synthetic::EXTENT))) {
        (Shape::Image { format, .. }, Some([width, height])) => {
            let is_float_input = synthetic::NAMES.contains(&decl.name.as_str());
            let format = if is_float_input { vk::Format::R32G32B32A32_SFLOAT } else { format.preferred() };
            let usage = decl.image_usage | vk::ImageUsageFlags::TRANSFER_DST | vk::ImageUsageFlags::TRANSFER_SRC;
            Resource::Image(Arc::new(Image::create(device, ImageInfo::image_2d(width, height, format, usage))?))
        }
        (Shape::Buffer { size }, _) => {
            Resource::Buffer(Arc::new(Buffer::create(device, BufferInfo::device_mem(size, decl.buffer_usage))?))
        }
        (Shape::Image { .. }, None) => return Err("an image without an extent".into()),
    })
}

/// Runs the sequence and prints a checksum of every frame.
fn main() -> Result<()> {
    let host = Host::new()?;
    for index in 0..synthetic::FRAMES {
        println!("{}", synthetic::report(index, &host.frame(index)?));
    }
    // The denoiser goes before the device that it was created on; every frame was waited for.
    let Host { device, denoiser, .. } = host;
    drop(denoiser);
    drop(device);
    Ok(())
}
