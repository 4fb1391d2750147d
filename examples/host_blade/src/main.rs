//! An engine on `blade-graphics`: its G-buffer is one texture with a layer for each input, and every texture stays in `GENERAL`.
//!
//! Blade's own path tracer needs ray queries; here copies fill the layers, so that it runs on any device. Prints a checksum of every
//! denoised frame. `scripts/test.sh --blade` builds and runs it.

mod denoise;

use atrous::FrameParams;
use atrous_synthetic as synthetic;
use blade_graphics as gpu;
use denoise::{Denoise, Layer};

const SIZE: gpu::Extent = gpu::Extent { width: synthetic::EXTENT[0], height: synthetic::EXTENT[1], depth: 1 };
const TEXELS: u64 = (synthetic::EXTENT[0] * synthetic::EXTENT[1]) as u64;
/// Bytes of an input in the staging buffer.
const STAGED: u64 = TEXELS * 16;

struct Engine {
    context: gpu::Context,
    encoder: gpu::CommandEncoder,
    textures: Vec<gpu::Texture>,
    views: Vec<gpu::TextureView>,
    staging: gpu::Buffer,
    result: gpu::Buffer,
}

impl Engine {
    fn new() -> Result<Self, gpu::NotSupportedError> {
        // SAFETY: nothing else uses the device of this context.
        let context = unsafe { gpu::Context::init(gpu::ContextDesc::default())? };
        let encoder =
            context.create_command_encoder(gpu::CommandEncoderDesc { name: "frame", buffer_count: 2, manual_barriers: false });
        let buffer = |name, size| context.create_buffer(gpu::BufferDesc { name, size, memory: gpu::Memory::Shared });
        let (staging, result) = (buffer("staging", STAGED * 6), buffer("result", TEXELS * 8));
        Ok(Self { context, encoder, textures: Vec::new(), views: Vec::new(), staging, result })
    }

    /// A texture, and a view of each of its layers.
    fn texture(&mut self, name: &str, format: gpu::TextureFormat, layers: u32, usage: gpu::TextureUsage) -> Vec<Layer> {
        let texture = self.context.create_texture(gpu::TextureDesc {
            name,
            format,
            size: SIZE,
            array_layer_count: layers,
            mip_level_count: 1,
            sample_count: 1,
            dimension: gpu::TextureDimension::D2,
            usage: usage | gpu::TextureUsage::COPY,
            external: None,
        });
        self.textures.push(texture);
        let layer = |layer: u32| {
            let one = std::num::NonZeroU32::new(1);
            let subresources = gpu::TextureSubresources {
                base_mip_level: 0,
                mip_level_count: one,
                base_array_layer: layer,
                array_layer_count: one,
            };
            let dimension = gpu::ViewDimension::D2;
            let desc = gpu::TextureViewDesc { name, format, dimension, subresources: &subresources };
            let view = self.context.create_texture_view(texture, desc);
            self.views.push(view);
            Layer { texture, view, layer, format, extent: synthetic::EXTENT }
        };
        (0..layers).map(layer).collect()
    }

    fn fill(&mut self, inputs: &[Layer]) {
        let mut transfer = self.encoder.transfer("G-buffer");
        for (input, i) in inputs.iter().zip(0..) {
            let row = SIZE.width * if input.format == gpu::TextureFormat::R32Uint { 4 } else { 16 };
            transfer.copy_buffer_to_texture(self.staging.at(i * STAGED), row, input.piece(), SIZE);
        }
    }

    /// Fills the inputs, denoises, and reads the output.
    fn frame(&mut self, index: u32, inputs: &[Layer], output: &Layer, denoise: &mut Denoise) -> Result<String, atrous::Error> {
        let frame = synthetic::Frame::new(index);
        let ids = frame.surface_id.iter().flat_map(|id| id.to_le_bytes()).collect();
        let staged = frame.images.iter().map(|texels| synthetic::bytes(texels)).chain([ids]);
        for (bytes, i) in staged.zip(0..) {
            // SAFETY: the buffer is mapped, and the work that read it is complete.
            unsafe { self.staging.data().add(i * STAGED as usize).copy_from_nonoverlapping(bytes.as_ptr(), bytes.len()) };
        }
        self.encoder.start();
        if index == 0 {
            self.textures.iter().for_each(|texture| self.encoder.init_texture(*texture));
        }
        self.fill(inputs);
        let params = FrameParams {
            frame_slot: index % 2,
            view_from_world: synthetic::view_from_world(index),
            clip_from_view: synthetic::clip_from_view(),
            ..FrameParams::new(synthetic::EXTENT)
        };
        denoise.record(&self.encoder, &params, inputs, output)?;
        self.encoder.transfer("read").copy_texture_to_buffer(output.piece(), self.result.into(), SIZE.width * 8, SIZE);
        let done = self.context.submit(&mut self.encoder);
        assert!(matches!(self.context.wait_for(&done, !0), Ok(true)), "the device is lost");
        // SAFETY: the buffer is mapped and this large, and the copy into it is complete.
        let bytes = unsafe { std::slice::from_raw_parts(self.result.data(), TEXELS as usize * 8) };
        Ok(synthetic::report(index, bytes))
    }
}

impl Drop for Engine {
    fn drop(&mut self) {
        self.views.iter().for_each(|view| self.context.destroy_texture_view(*view));
        self.textures.iter().for_each(|texture| self.context.destroy_texture(*texture));
        [self.staging, self.result].into_iter().for_each(|buffer| self.context.destroy_buffer(buffer));
        self.context.destroy_command_encoder(&mut self.encoder);
    }
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut engine = Engine::new().map_err(|error| format!("no device for Blade: {error:?}"))?;
    let mut inputs = engine.texture("G-buffer", gpu::TextureFormat::Rgba32Float, 5, gpu::TextureUsage::RESOURCE);
    inputs.extend(engine.texture("ids", gpu::TextureFormat::R32Uint, 1, gpu::TextureUsage::RESOURCE));
    let output =
        engine.texture("output", gpu::TextureFormat::Rgba16Float, 1, gpu::TextureUsage::STORAGE | gpu::TextureUsage::RESOURCE);
    let mut denoise = Denoise::new(&engine.context, synthetic::EXTENT)?;
    for index in 0..synthetic::FRAMES {
        println!("{}", engine.frame(index, &inputs, &output[0], &mut denoise)?);
    }
    drop(denoise);
    Ok(())
}
