//! References, kept as EXR files: they take most of the time, and depend on the scene and the path tracer alone.

use std::collections::hash_map::DefaultHasher;
use std::fmt::{self, Write};
use std::hash::{Hash, Hasher};
use std::io::Cursor;
use std::path::PathBuf;

use crate::Result;
use atrous_engine::{PathTracer, Scene};
use exr::prelude::{read_first_rgba_layer_from_file, Image, SpecificChannels, Vec2, WritableImage};

use super::settings::Settings;
use crate::files::write;

/// In the seed of the second half of a reference: no frame has it.
const OTHER_HALF: u32 = 1 << 31;

/// Positions in the pixel of a reference of display size: all of the tracer's sequence.
const JITTERS: u32 = 16;

/// References in a folder, which exists.
pub struct References {
    folder: PathBuf,
    /// Paths for each pixel.
    samples: u32,
}

impl References {
    /// Those with as many samples as the settings say.
    pub fn new(folder: PathBuf, settings: &Settings) -> Self {
        Self { folder, samples: settings.reference_spp }
    }

    /// The reference of a frame, in two halves with independent noise: from their files, or rendered into them. Overwrites the tracer's frame.
    ///
    /// # Errors
    /// A lost device, or a file that cannot be written.
    pub fn of_frame(&self, tracer: &mut PathTracer, scene: &Scene, frame: u32) -> Result<[Vec<[f32; 3]>; 2]> {
        let samples = self.samples.div_ceil(2);
        let mut half = |seed| self.rendered(tracer, scene, frame, seed, samples);
        Ok([half(frame)?, half(frame | OTHER_HALF)?])
    }

    /// The reference of a frame with the random numbers of another, and with twice as many paths: what differs between two with the same numbers
    /// is light, not noise. Nothing moves in it.
    ///
    /// # Errors
    /// As [`Self::of_frame`].
    pub fn seeded(&self, tracer: &mut PathTracer, scene: &Scene, frame: u32, seed: u32) -> Result<Vec<[f32; 3]>> {
        self.rendered(tracer, scene, frame, seed, 2 * self.samples)
    }

    /// The mean over the pixel, in two halves with independent noise. The tracer jitters.
    ///
    /// # Errors
    /// As [`Self::of_frame`].
    pub fn of_display(&self, tracer: &mut PathTracer, scene: &Scene, frame: u32) -> Result<[Vec<[f32; 3]>; 2]> {
        let samples = self.samples.div_ceil(2 * JITTERS);
        let mut half = |other: u32| -> Result<Vec<[f32; 3]>> {
            // Seeds are frames, so that each has another jitter.
            let parts = (0..JITTERS).map(|position| self.rendered(tracer, scene, frame, position | other, samples));
            Ok(mean(&parts.collect::<Result<Vec<_>>>()?))
        };
        Ok([half(0)?, half(OTHER_HALF)?])
    }

    fn rendered(&self, tracer: &mut PathTracer, scene: &Scene, frame: u32, seed: u32, samples: u32) -> Result<Vec<[f32; 3]>> {
        let [width, height] = [tracer.extent().width, tracer.extent().height].map(|side| side as usize);
        let content = content(scene, frame);
        let jitter = if tracer.jitters() { "_jittered" } else { "" };
        let name = format!("{}_{frame:04}_{seed:04}_{width}x{height}_{samples}_{content:016x}{jitter}.exr", scene.name);
        let path = self.folder.join(name);
        // A file that cannot be read, or is of another size, is rendered again: it was cut off, or is not ours.
        if let Some(kept) = read(&path).filter(|kept| kept.len() == width * height) {
            return Ok(kept);
        }
        let moment = scene.moment(frame);
        tracer.begin_moment(seed, &moment, &moment)?;
        let reference = tracer.render_reference(samples, |_, _| ())?.radiance();
        let pixel = |at: Vec2<usize>| <(f32, f32, f32)>::from(reference[at.y() * width + at.x()]);
        let mut bytes = Cursor::new(Vec::new());
        let written = Image::from_channels((width, height), SpecificChannels::rgb(pixel)).write().to_buffered(&mut bytes);
        written.map_err(|e| atrous_engine::Error::Folder { path: path.clone(), problem: e.to_string() })?;
        write(&path, bytes.get_ref())?;
        Ok(reference)
    }
}

/// A hash of what a picture depends on: the scene at a frame, and the code of the path tracer. Noise has no part in it: the seed of a reference is
/// as good as any other.
pub fn content(scene: &Scene, frame: u32) -> u64 {
    struct Text(DefaultHasher);
    impl Write for Text {
        fn write_str(&mut self, text: &str) -> fmt::Result {
            self.0.write(text.as_bytes());
            Ok(())
        }
    }
    let mut text = Text(DefaultHasher::new());
    atrous_engine::REFERENCES.hash(&mut text.0);
    let moment = scene.moment(frame);
    let instances: Vec<_> = scene.instances.iter().map(|instance| (instance.mesh, instance.material)).collect();
    let things = (&scene.meshes, &scene.materials, &scene.textures, instances, scene.transforms(moment.object_time));
    let light =
        (scene.emissions(frame), scene.light_scale(frame), scene.lamps_at(moment.object_time), scene.environment, scene.medium);
    // Numbers print with all their digits.
    let _ = write!(text, "{:?} {things:?} {light:?}", moment.view);
    text.0.finish()
}

fn mean(parts: &[Vec<[f32; 3]>]) -> Vec<[f32; 3]> {
    let pixel = |i: usize| [0, 1, 2].map(|c| parts.iter().map(|part| part[i][c]).sum::<f32>() / parts.len() as f32);
    (0..parts.first().map_or(0, Vec::len)).map(pixel).collect()
}

fn read(path: &PathBuf) -> Option<Vec<[f32; 3]>> {
    let image = read_first_rgba_layer_from_file(
        path,
        |size, _| (size.width(), vec![[0.0; 3]; size.width() * size.height()]),
        |(width, pixels): &mut (usize, Vec<[f32; 3]>), at, (r, g, b, _): (f32, f32, f32, f32)| {
            pixels[at.y() * *width + at.x()] = [r, g, b];
        },
    );
    Some(image.ok()?.layer_data.channel_data.pixels.1)
}
