//! The engine over frames of a plane that faces the camera.

mod frames;
mod host_stages;
mod input_table;
mod inputs;
mod memory;
mod sequences;
mod specular;
mod volumes;

use super::super::luminance_history::luminance_history_of;
use super::super::test_scene::{embed, svgf_tuning};
use super::super::{unpack_luminance_history, LuminanceHistory};
use super::*;
use crate::config::Config;

/// A host with a plane at depth 4, in images that may be larger than a frame.
struct Host {
    engine: Engine,
}

impl Host {
    fn new(config: &Config) -> Self {
        Self { engine: Engine::new(config.declare().expect("valid")).expect("twins").keep_transients() }
    }

    /// Gives every input that is declared, of those that a plane has; outside the render extent there is poison.
    fn upload(&mut self, render_extent: [u32; 2], noisy: &Image<[f32; 4]>) {
        let allocated = self.engine.declaration.allocated_extent();
        let plane = |texel| Image::new(render_extent, texel);
        for (name, image) in [
            ("depth", &plane([4.0; 4])),
            ("normal", &plane([0.0, 0.0, 1.0, 0.0])),
            ("noisy_radiance", noisy),
            ("noisy_direct", noisy),
            ("noisy_indirect", noisy),
            ("noisy_volume", noisy),
            ("scattering_depth", &plane([2.0; 4])),
        ] {
            if self.engine.declaration.find(name).is_some() {
                self.engine.upload(name, embed(image, allocated, [f32::NAN; 4]).texels()).expect(name);
            }
        }
    }

    fn frame(&mut self, params: &FrameParams, noisy: &Image<[f32; 4]>) -> FrameContext {
        self.upload(params.render_extent, noisy);
        self.engine.run(params, &svgf_tuning()).expect("frame")
    }

    /// Runs a frame of the inputs that there are, with a look at what stands after each pass.
    fn frame_by_pass(&mut self, params: &FrameParams, mut look: impl FnMut(&Engine, &FrameContext, usize)) {
        let engine = &mut self.engine;
        let frame = engine.state.begin(engine.declaration.setup(), params, &svgf_tuning()).expect("usable");
        engine.frame = Some(frame);
        for pass in 0..engine.declaration.passes().len() {
            engine.step(&frame, pass).expect("runs");
            look(engine, &frame, pass);
        }
    }

    /// Four floats a pixel.
    fn image(&self, name: &str) -> Image<[f32; 4]> {
        let extent = self.engine.texels(name, UseFrame::Current).expect(name).extent();
        Image::from_texels(extent, self.engine.download(name).expect(name)).expect("as many as its extent says")
    }

    /// History of luminance of the first signal.
    fn luminance_history(&self) -> Image<LuminanceHistory> {
        match self.engine.texels("luminance_history", UseFrame::Current).expect("luminance_history") {
            Texels::Uint(image) => luminance_history_of(image),
            other => panic!("luminance_history are {}", other.kind()),
        }
    }

    /// The output of every pass in the last frame, but for the constants, which count frames.
    fn everything(&self) -> Vec<(String, Texels)> {
        let is_ours = |r: &&crate::ResourceDecl| !matches!(r.lifetime, Lifetime::Input { .. }) && r.name != "frame_constants";
        let names = self.engine.declaration.resources().iter().filter(is_ours).map(|r| r.name.clone());
        names.filter_map(|name| self.engine.texels(&name, UseFrame::Current).cloned().ok().map(|t| (name, t))).collect()
    }
}
