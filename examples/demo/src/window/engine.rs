//! The engine's thread: animates, traces, denoises, and fills the two panes. It never waits for the window, nor the window for it.

use std::collections::BTreeMap;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Instant;

use ash::vk;
use atrous::config::Preset;

use super::clock::Clock;
use super::content::Content;
use super::filter::Filter;
use super::panes::{PaneWriter, Panes, Source};
use super::settings::Settings;
use super::shared::{Shared, Wanted};
use crate::error::Result;
use crate::gpu::Gpu;
use crate::{PathTracer, Scene, SceneOptions, TracerOptions};

/// Frames from one histogram to the next.
const HISTOGRAM_EVERY: u64 = 4;

/// The thread. Dropping it waits for the frame that is being made.
pub struct EngineThread {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl EngineThread {
    /// Starts; `wake` is called after every frame.
    pub fn start(gpu: &Gpu, extent: vk::Extent2D, shared: &Arc<Shared>, wake: impl Fn() + Send + 'static) -> Self {
        let (gpu, worker) = (gpu.clone(), shared.clone());
        let work = move || {
            if let Err(error) = run(&gpu, extent, &worker, &wake) {
                worker.say(true, error.to_string());
            }
            worker.report().stopped = true;
            wake();
        };
        Self { shared: shared.clone(), thread: Some(std::thread::spawn(work)) }
    }
}

impl Drop for EngineThread {
    fn drop(&mut self) {
        self.shared.want(|wanted| wanted.quit = true);
        if let Some(thread) = self.thread.take() {
            // It reports its own errors; a panic was printed.
            let _ = thread.join();
        }
    }
}

fn run(gpu: &Gpu, extent: vk::Extent2D, shared: &Shared, wake: &dyn Fn()) -> Result<()> {
    let mut engine = Engine::new(gpu, extent, shared)?;
    let mut seen = 0;
    loop {
        let busy = engine.is_accumulating();
        let idle = |w: &Wanted| w.settings.paused && w.steps == 0 && w.version == seen && !busy;
        let wanted = shared.take(idle);
        if wanted.quit {
            return Ok(());
        }
        seen = wanted.version;
        engine.work(shared, &wanted)?;
        wake();
    }
}

struct Engine {
    gpu: Gpu,
    scene: Arc<Scene>,
    scene_name: String,
    // Before the tracer, whose images they read.
    filters: BTreeMap<&'static str, Filter>,
    tracer: PathTracer,
    panes: Arc<Panes>,
    writer: PaneWriter,
    clock: Clock,
    taa: bool,
    frames: u64,
    /// Frames since the tracer was made: its random numbers.
    seed: u32,
}

impl Engine {
    fn new(gpu: &Gpu, extent: vk::Extent2D, shared: &Shared) -> Result<Self> {
        let settings = shared.take(|_| false).settings;
        let scene = Arc::new(Scene::load(&settings.scene, &SceneOptions::default())?);
        let tracer = PathTracer::new(gpu, &scene, extent, TracerOptions { jitter: settings.taa, ..Default::default() })?;
        let panes = Arc::new(Panes::new(gpu, extent)?);
        shared.report().panes = Some(panes.clone());
        Ok(Self {
            gpu: gpu.clone(),
            scene,
            scene_name: settings.scene,
            filters: BTreeMap::new(),
            tracer,
            panes,
            writer: PaneWriter::new(gpu)?,
            clock: Clock::default(),
            taa: settings.taa,
            frames: 0,
            seed: 0,
        })
    }

    /// Whether there is work while time stands still.
    fn is_accumulating(&self) -> bool {
        false
    }

    fn work(&mut self, shared: &Shared, wanted: &Wanted) -> Result<()> {
        let start = Instant::now();
        self.follow(shared, &wanted.settings)?;
        let advance = !wanted.settings.paused || wanted.steps > 0;
        self.frame(wanted, advance)?;
        self.frames += 1;
        self.publish(shared, wanted, start)
    }

    /// Another scene, or another kind of picture.
    fn follow(&mut self, shared: &Shared, settings: &Settings) -> Result<()> {
        if settings.scene == self.scene_name && settings.taa == self.taa {
            return Ok(());
        }
        let options = TracerOptions { jitter: settings.taa, ..Default::default() };
        let made = match settings.scene == self.scene_name {
            true => Ok(self.scene.clone()),
            false => Scene::load(&settings.scene, &SceneOptions::default()).map(Arc::new),
        };
        let made = made.and_then(|scene| Ok((PathTracer::new(&self.gpu, &scene, self.tracer.extent(), options)?, scene)));
        // Tried once: a scene that does not load is not tried again until another one is asked for.
        self.scene_name.clone_from(&settings.scene);
        self.taa = settings.taa;
        match made {
            Ok((tracer, scene)) => {
                self.filters.clear();
                (self.tracer, self.scene) = (tracer, scene);
                (self.clock, self.seed) = (Clock::default(), 0);
            }
            Err(error) => shared.say(true, error.to_string()),
        }
        Ok(())
    }

    fn frame(&mut self, wanted: &Wanted, advance: bool) -> Result<()> {
        let settings = &wanted.settings;
        let (now, before) = self.clock.tick(&self.scene, settings, wanted.view, advance);
        self.tracer.begin_moment(self.seed, &now, &before)?;
        self.seed += 1;
        let contents = [settings.left, settings.right];
        let gpu = self.gpu.clone();
        gpu.submit(|cmd| {
            self.tracer.record_gbuffer(cmd);
            // The filters have their own.
            if contents.iter().all(|c| c.preset().is_none()) {
                self.tracer.record_lighting(cmd);
            }
            Ok(())
        })?;
        for preset in presets(contents) {
            let name = super::content::name_of(preset);
            if !self.filters.contains_key(name) {
                self.filters.insert(name, Filter::new(&gpu, &self.tracer, preset, self.taa)?);
            }
            let view = contents.iter().find_map(|c| c.view().filter(|_| c.preset() == Some(preset)));
            if let Some(filter) = self.filters.get_mut(name) {
                filter.frame(&gpu, &mut self.tracer, settings.tuning(preset), view, wanted.reset)?;
            }
        }
        self.fill(contents)
    }

    /// Fills both panes from what the last frame left.
    fn fill(&mut self, contents: [Content; 2]) -> Result<()> {
        for (side, content) in contents.into_iter().enumerate() {
            let filter = content.preset().and_then(|p| self.filters.get_mut(super::content::name_of(p)));
            let outputs = self.tracer.outputs();
            let source = match (content, filter) {
                (Content::Debug(_, view), Some(filter)) => {
                    // The first of two views was recorded with the frame.
                    if side == 1 && contents[0].preset() == content.preset() && contents[0].view().is_some() {
                        filter.show(&self.gpu, view)?;
                    }
                    Source::of(&filter.debug)
                }
                (Content::Filtered(_), Some(filter)) if self.taa => Source::of(&filter.display),
                (Content::Filtered(_), Some(filter)) => Source::of(&filter.radiance),
                _ => Source { images: [&outputs.scattered, &outputs.emission, &outputs.emission], weights: [1.0, 1.0, 0.0] },
            };
            self.writer.write(&self.gpu, &self.panes, side, &source)?;
        }
        Ok(())
    }

    /// Whether what a pane shows went through a tone map already.
    fn is_mapped(&self, content: Content) -> bool {
        match content {
            Content::Debug(..) => true,
            Content::Filtered(_) => self.taa,
            Content::Noisy | Content::Reference => false,
        }
    }

    fn publish(&mut self, shared: &Shared, wanted: &Wanted, start: Instant) -> Result<()> {
        let settings = &wanted.settings;
        let histogram = match [settings.right, settings.left].into_iter().find_map(Content::preset) {
            Some(preset) if settings.panel && self.frames % HISTOGRAM_EVERY == 1 => {
                let filter = self.filters.get_mut(super::content::name_of(preset));
                Some(filter.map(Filter::histogram).transpose()?.flatten())
            }
            _ => None,
        };
        let current = self.filters.values().filter(|f| f.is_current(&self.tracer)).map(Filter::report).collect();
        let view = self.clock.view();
        let mut report = shared.report();
        report.frames = self.frames;
        report.shown = Some([settings.left, settings.right]);
        report.display_referred =
            [settings.left, settings.right].iter().rev().fold(0, |bits, c| bits << 1 | u32::from(self.is_mapped(*c)));
        report.milliseconds = 1e3 * start.elapsed().as_secs_f32();
        report.filters = current;
        report.view = view;
        report.scene.clone_from(&self.scene.name);
        if let Some(histogram) = histogram {
            report.histogram = histogram;
        }
        Ok(())
    }
}

/// The filters that have to run, each once.
fn presets(contents: [Content; 2]) -> Vec<Preset> {
    let mut presets: Vec<Preset> = Vec::new();
    for preset in contents.into_iter().filter_map(Content::preset) {
        if !presets.contains(&preset) {
            presets.push(preset);
        }
    }
    // A-SVGF first: it has some samples shaded again, and the noisy picture is of the last one.
    presets.sort_by_key(|preset| *preset != Preset::Asvgf);
    presets
}
