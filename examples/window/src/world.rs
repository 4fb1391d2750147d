//! What the engine shows: a scene, its path tracer, the filters that run, and the reference that grows while everything rests.

use std::sync::Arc;
use std::time::Duration;

use atrous::config::Preset;

use super::clock::Clock;
use super::content::Content;
use super::error_view::ErrorViews;
use super::filter::Filter;
use super::panes::{PaneWriter, Panes, Source};
use super::reference::GrowingReference;
#[cfg(feature = "hot-reload")]
use super::reload::LiveShaders;
use super::settings::Settings;
use super::shared::Shared;
use super::sizes::Sizes;
use crate::error::Result;
use atrous_engine::gpu::Gpu;
#[cfg(feature = "hot-reload")]
use atrous_engine::hot_reload::{Compiled, Owner};
use atrous_engine::scene::View;
use atrous_engine::{PathTracer, Scene, SceneOptions};

/// A reference is good enough with so many paths a pixel.
const REFERENCE_LIMIT: u32 = 16384;
/// Time for paths of the reference in each frame.
const REFERENCE_TIME: Duration = Duration::from_millis(60);

/// What the engine shows.
pub struct World {
    gpu: Gpu,
    scene: Arc<Scene>,
    /// What was asked for last, which may have failed.
    asked: String,
    /// The source of the scene.
    loaded: String,
    // Before the tracer, whose images they read.
    filters: Vec<Filter>,
    /// Where it is shown.
    reference: Option<GrowingReference>,
    /// Where they are shown.
    errors: Option<ErrorViews>,
    tracer: PathTracer,
    sizes: Sizes,
    clock: Clock,
    #[cfg(feature = "hot-reload")]
    shaders: LiveShaders,
    taa: bool,
    /// Counts frames of the tracer: its random numbers.
    seed: u32,
}

impl World {
    /// Loads the scene.
    ///
    /// # Errors
    /// A scene that cannot be loaded, or no memory.
    pub fn new(gpu: &Gpu, sizes: Sizes, settings: &Settings) -> Result<Self> {
        let scene = Arc::new(Scene::load(&settings.scene, &SceneOptions::default())?);
        let tracer = PathTracer::new(gpu, &scene, sizes.rendered, sizes.tracer_options(settings))?;
        Ok(Self {
            gpu: gpu.clone(),
            scene,
            asked: settings.scene.clone(),
            loaded: settings.scene.clone(),
            filters: Vec::new(),
            reference: None,
            errors: None,
            tracer,
            sizes,
            clock: Clock::default(),
            #[cfg(feature = "hot-reload")]
            shaders: LiveShaders::default(),
            taa: settings.taa,
            seed: 0,
        })
    }

    /// Another scene, or another kind of picture; whether there is one. A scene that cannot be loaded is reported, and the old one stays.
    ///
    /// # Errors
    /// A lost device.
    pub fn follow(&mut self, shared: &Shared, settings: &Settings) -> Result<bool> {
        if settings.scene == self.asked && settings.taa == self.taa {
            return Ok(false);
        }
        let scene = match settings.scene == self.asked {
            true => Ok(self.scene.clone()),
            false => Scene::load(&settings.scene, &SceneOptions::default()).map(Arc::new),
        };
        let (extent, options) = (self.sizes.rendered, self.sizes.tracer_options(settings));
        let made = scene.and_then(|scene| Ok((PathTracer::new(&self.gpu, &scene, extent, options)?, scene)));
        self.asked.clone_from(&settings.scene);
        self.taa = settings.taa;
        match made {
            #[cfg_attr(not(feature = "hot-reload"), allow(unused_mut))]
            Ok((mut tracer, scene)) => {
                #[cfg(feature = "hot-reload")]
                self.shaders.put_into(|shader| Ok(tracer.replace_shader(shader)?))?;
                self.filters.clear();
                (self.reference, self.errors) = (None, None);
                // Another kind of picture is of the same moment.
                if !Arc::ptr_eq(&self.scene, &scene) {
                    (self.clock, self.seed) = (Clock::default(), 0);
                    self.loaded.clone_from(&self.asked);
                }
                (self.tracer, self.scene) = (tracer, scene);
                Ok(true)
            }
            Err(error) => {
                shared.notify(true, error.to_string());
                Ok(false)
            }
        }
    }

    /// The scene is loaded anew, though its name is the same.
    pub fn forget_scene(&mut self) {
        self.asked.clear();
    }

    /// Traces and filters one frame; `view`: the camera, where it does not follow its path.
    ///
    /// # Errors
    /// A lost device.
    pub fn frame(&mut self, settings: &Settings, view: Option<View>, advance: bool, reset: bool) -> Result<()> {
        let (now, before) = self.clock.tick(&self.scene, settings, view, advance);
        if let Some(reference) = self.reference.as_mut().filter(|_| !self.scene.looks_alike(&now, &before)) {
            reference.restart();
        }
        self.tracer.begin_moment(self.seed, &now, &before)?;
        self.seed += 1;
        if reset {
            // Those that are not shown as well: they may be later.
            self.filters.iter_mut().for_each(Filter::forget);
        }
        let presets = presets([settings.left, settings.right]);
        let gpu = self.gpu.clone();
        gpu.submit(|cmd| {
            self.tracer.record_gbuffer(cmd);
            // The filters have their own.
            if presets.is_empty() {
                self.tracer.record_lighting(cmd);
            }
            Ok(())
        })?;
        for preset in presets {
            let index = match self.filters.iter().position(|f| f.preset == preset) {
                Some(index) => index,
                None => {
                    #[cfg_attr(not(feature = "hot-reload"), allow(unused_mut))]
                    let mut filter = Filter::new(&gpu, &self.tracer, preset, (self.taa, self.sizes.output))?;
                    #[cfg(feature = "hot-reload")]
                    self.shaders.put_into(|shader| Ok(filter.replace_shader(shader)?))?;
                    self.filters.push(filter);
                    self.filters.len() - 1
                }
            };
            self.filters[index].frame(&gpu, &mut self.tracer, settings.tuning(preset), &now, &before)?;
        }
        Ok(())
    }

    /// Lets the reference grow, where it is shown.
    ///
    /// # Errors
    /// A lost device.
    pub fn accumulate(&mut self, wanted: bool) -> Result<()> {
        if !wanted {
            // What moves meanwhile is not noticed.
            self.reference = None;
            return Ok(());
        }
        let reference = match &mut self.reference {
            Some(reference) => reference,
            empty => {
                #[cfg_attr(not(feature = "hot-reload"), allow(unused_mut))]
                let mut sums = GrowingReference::new(&self.tracer)?;
                #[cfg(feature = "hot-reload")]
                self.shaders.put_into(|shader| Ok(sums.replace_shader(shader)?))?;
                empty.insert(sums)
            }
        };
        Ok(reference.add(&self.tracer, REFERENCE_TIME, REFERENCE_LIMIT)?)
    }

    /// Puts a shader in place wherever it runs, now and in what is made later. The history is kept; the reference starts anew.
    ///
    /// # Errors
    /// No memory, or a lost device.
    #[cfg(feature = "hot-reload")]
    pub fn replace_shader(&mut self, shader: &Compiled) -> Result<()> {
        self.tracer.replace_shader(shader)?;
        for filter in &mut self.filters {
            filter.replace_shader(shader)?;
        }
        if let Some(reference) = self.reference.as_mut().filter(|_| shader.owner() == Owner::Engine) {
            reference.replace_shader(shader)?;
            reference.restart();
        }
        self.shaders.keep(shader.clone());
        Ok(())
    }

    /// Whether the reference is shown and can still grow.
    pub fn is_accumulating(&self) -> bool {
        self.reference.as_ref().is_some_and(|reference| reference.samples() < REFERENCE_LIMIT)
    }

    /// Paths of each pixel in the reference.
    pub fn reference_samples(&self) -> u32 {
        self.reference.as_ref().map_or(0, GrowingReference::samples)
    }

    /// Whether a filter has seen the last frame.
    pub fn has(&self, preset: Preset) -> bool {
        self.filters.iter().any(|f| f.preset == preset && f.is_current(&self.tracer))
    }

    /// Fills both panes from what the last frame left.
    ///
    /// # Errors
    /// A lost device.
    pub fn fill(&mut self, writer: &mut PaneWriter, panes: &Panes, contents: [Content; 2]) -> Result<()> {
        for (side, content) in contents.into_iter().enumerate() {
            let outputs = self.tracer.outputs();
            let filter = content.preset().and_then(|preset| self.filters.iter_mut().find(|f| f.preset == preset));
            let source = match (content, filter, &self.reference) {
                (Content::Debug(_, view), Some(filter), _) => {
                    filter.show(&self.gpu, view)?;
                    Source::of(&filter.debug)
                }
                (Content::Filtered(_), Some(filter), _) => filter.source(),
                (Content::Error(preset), Some(filter), _) => {
                    self.errors.as_ref().and_then(|errors| errors.source(preset)).unwrap_or_else(|| filter.source())
                }
                (Content::Reference, _, Some(reference)) => reference.source(outputs),
                _ => {
                    let medium = self.tracer.volume().map(|volume| (&volume.noisy_volume, 1.0));
                    Source::sum((&outputs.scattered, 1.0), [(&outputs.emission, 1.0)].into_iter().chain(medium))
                }
            };
            writer.write(&self.gpu, panes, side, &source)?;
        }
        Ok(())
    }

    /// Where the camera is.
    pub fn view(&self) -> Option<View> {
        self.clock.view()
    }

    /// The source of the scene: a name, or a file.
    pub fn loaded(&self) -> &str {
        &self.loaded
    }

    /// The scene's name.
    pub fn scene_name(&self) -> &str {
        &self.scene.name
    }
}

/// The filters that have to run, each once.
fn presets(contents: [Content; 2]) -> Vec<Preset> {
    let mut presets: Vec<Preset> = contents.into_iter().filter_map(Content::preset).collect();
    presets.dedup();
    // Those first that have some samples shaded again, since the noisy picture is that of the last one.
    presets.sort_by_key(|preset| !preset.has_gradients());
    presets
}

mod errors;
mod inspection;
#[cfg(test)]
mod tests;
