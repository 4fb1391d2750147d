//! The engine's thread: frame by frame what the window wants. It never waits for the window, nor the window for it.

use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Instant;

use super::content::Content;
use super::error_view::Wake;
use super::jobs::Jobs;
use super::legend;
use super::panes::{PaneWriter, Panes};
use super::record::Seen;
#[cfg(feature = "hot-reload")]
use super::reload::ShaderErrors;
use super::settings::Settings;
use super::shared::{Request, Shared, Wanted};
use super::sizes::Sizes;
use super::world::World;
use crate::error::Result;
use atrous_engine::gpu::Gpu;
use atrous_engine::scene::View;

/// Frames from one histogram to the next.
const HISTOGRAM_EVERY: u64 = 4;

/// The thread. Dropping it waits for the frame that is being made.
pub struct EngineThread {
    shared: Arc<Shared>,
    thread: Option<JoinHandle<()>>,
}

impl EngineThread {
    /// Starts; `wake` is called after every frame.
    pub fn start(gpu: &Gpu, sizes: Sizes, shared: &Arc<Shared>, wake: impl Fn() + Send + 'static) -> Self {
        let awake = shared.clone();
        let measured: Wake = Arc::new(move || awake.want(|_| ()));
        let (gpu, worker) = (gpu.clone(), shared.clone());
        let work = move || {
            if let Err(error) = run(&gpu, sizes, &worker, &wake, measured) {
                worker.notify(true, error.to_string());
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

fn run(gpu: &Gpu, sizes: Sizes, shared: &Shared, wake: &dyn Fn(), measured: Wake) -> Result<()> {
    let mut engine = Engine::new(gpu, sizes, shared, measured)?;
    let mut seen = 0;
    loop {
        let busy = engine.is_busy();
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

/// What the last picture was made for.
#[derive(Clone, PartialEq)]
struct Made {
    contents: [Content; 2],
    /// What the numbers of the filters follow from.
    tuning: Settings,
    view: Option<View>,
}

impl Made {
    fn new(settings: &Settings, sizes: &Sizes, view: Option<View>) -> Self {
        let mut tuning = Settings { tuning: settings.tuning.clone(), exposure: settings.exposure, ..Settings::default() };
        if sizes.are_tones_mapped(settings) {
            // Else the tone map is the window's.
            tuning.tone_curve = settings.tone_curve;
        }
        Self { contents: [settings.left, settings.right], tuning, view }
    }
}

struct Engine {
    gpu: Gpu,
    sizes: Sizes,
    world: World,
    panes: Arc<Panes>,
    writer: PaneWriter,
    jobs: Jobs,
    #[cfg(feature = "hot-reload")]
    shader_errors: ShaderErrors,
    made: Option<Made>,
    frames: u64,
    /// Wakes this thread when an error was measured.
    measured: Wake,
}

impl Engine {
    fn new(gpu: &Gpu, sizes: Sizes, shared: &Shared, measured: Wake) -> Result<Self> {
        let settings = shared.settings();
        let world = World::new(gpu, sizes, &settings)?;
        let panes = Arc::new(Panes::new(gpu, sizes.shown())?);
        shared.report().panes = Some(panes.clone());
        let writer = PaneWriter::new(gpu, &panes)?;
        Ok(Self {
            gpu: gpu.clone(),
            sizes,
            world,
            panes,
            writer,
            jobs: Jobs::default(),
            #[cfg(feature = "hot-reload")]
            shader_errors: ShaderErrors::default(),
            made: None,
            frames: 0,
            measured,
        })
    }

    /// Whether there is work while time stands still.
    fn is_busy(&self) -> bool {
        self.world.is_accumulating() || self.jobs.is_flying()
    }

    fn work(&mut self, shared: &Shared, wanted: &Wanted) -> Result<()> {
        let start = Instant::now();
        let settings = &wanted.settings;
        if wanted.requests.contains(&Request::Reload) {
            self.world.forget_scene();
        }
        let reloaded = self.world.follow(shared, settings)?;
        #[cfg(feature = "hot-reload")]
        let reloaded = self.take_shaders(shared, &wanted.recompiled) || reloaded;
        self.jobs.take(shared, &wanted.requests);
        let flown = self.jobs.next_view();
        let made = Made::new(settings, &self.sizes, flown.or(wanted.view));
        let advance = !settings.paused || wanted.steps > 0 || self.jobs.is_flying();
        let stands = !advance && !reloaded && !wanted.reset && self.is_enough(&made);
        if !stands {
            let reset = wanted.reset || self.jobs.is_cut();
            self.world.frame(settings, made.view, advance, reset)?;
            self.frames += 1;
        }
        self.world.accumulate(made.contents.into_iter().any(Content::needs_reference))?;
        self.world.measure_errors(&mut self.writer, made.contents, &self.measured)?;
        self.world.fill(&mut self.writer, &self.panes, made.contents)?;
        let switched = self.made.replace(made.clone()).is_none_or(|last| last.contents != made.contents);
        let (paths, errors) = (self.world.reference_samples(), self.world.errors());
        let seen = Seen {
            panes: &self.panes,
            settings,
            display_referred: display_referred(settings, &self.sizes),
            legends: made.contents.map(|content| legend::of_content(content, paths, &errors)),
        };
        if !stands {
            self.jobs.after_frame(shared, &self.gpu, &seen, self.world.view())?;
        }
        self.jobs.shoot(shared, &self.gpu, &seen)?;
        self.publish(shared, wanted, (!stands).then_some(start), switched)
    }

    /// Puts saved shaders in place, all of them between two frames; whether there are any.
    #[cfg(feature = "hot-reload")]
    fn take_shaders(&mut self, shared: &Shared, recompiled: &[Arc<atrous_engine::hot_reload::Recompiled>]) -> bool {
        let Self { world, writer, shader_errors, .. } = self;
        shader_errors.take(shared, recompiled, |shader| {
            world.replace_shader(shader)?;
            writer.replace_shader(shader)?;
            Ok(())
        })
    }

    /// Whether the last frame has everything for a picture: then time may stand still.
    fn is_enough(&self, made: &Made) -> bool {
        let Some(last) = &self.made else { return false };
        let has = |c: &Content| c.preset().is_none_or(|preset| self.world.has(preset));
        last.tuning == made.tuning && last.view == made.view && made.contents.iter().all(has)
    }

    /// `start`: of the frame, where one was made; `switched`: other filters are shown than before.
    fn publish(&mut self, shared: &Shared, wanted: &Wanted, start: Option<Instant>, switched: bool) -> Result<()> {
        let settings = &wanted.settings;
        let due = settings.panel && (switched || self.frames % HISTOGRAM_EVERY == 1 && start.is_some());
        let histogram = if due { Some(self.world.histogram([settings.right, settings.left])?) } else { None };
        let contents = [settings.left, settings.right];
        let probe = match wanted.probe {
            Some(pixel) => Some(self.world.probe(&self.panes, contents, pixel)?),
            None => None,
        };
        let mut report = shared.report();
        report.frames = self.frames;
        report.shown = Some(contents);
        report.display_referred = display_referred(settings, &self.sizes);
        if let Some(start) = start {
            report.milliseconds = 1e3 * start.elapsed().as_secs_f32();
        }
        report.filters = self.world.reports();
        report.view = self.world.view();
        report.scene = self.world.scene_name().to_owned();
        report.loaded = Some(self.world.loaded().to_owned());
        report.reference_samples = self.world.reference_samples();
        report.errors = self.world.errors();
        report.probe = probe;
        (report.recording, report.path) = self.jobs.state();
        if let Some(histogram) = histogram {
            report.histogram = histogram;
        }
        Ok(())
    }
}

/// Bit 0: what is left went through a tone map already, bit 1: what is right.
fn display_referred(settings: &Settings, sizes: &Sizes) -> u32 {
    let is_mapped = |content| match content {
        Content::Debug(..) | Content::Error(_) => true,
        Content::Filtered(_) => sizes.are_tones_mapped(settings),
        Content::Noisy | Content::Reference => false,
    };
    u32::from(is_mapped(settings.left)) | u32::from(is_mapped(settings.right)) << 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_paused_picture_follows_what_the_filters_make_of_it() {
        let plain = Settings::default();
        let same = Sizes::of(ash::vk::Extent2D { width: 32, height: 18 });
        let made = |settings: &Settings| Made::new(settings, &same, None);
        let linear = Settings { tone_curve: atrous::ToneCurve::Linear, ..plain.clone() };
        assert!(made(&plain) == made(&linear), "the window maps tones");
        let [plain_taa, linear_taa] = [plain.clone(), linear].map(|settings| Settings { taa: true, ..settings });
        assert!(made(&plain_taa) != made(&linear_taa), "the filter maps tones");
        assert!(made(&plain) != made(&Settings { exposure: 2.0, ..plain.clone() }));
        assert!(made(&plain) == made(&Settings { divider: 0.1, magnifier: true, ..plain.clone() }));
    }
}
