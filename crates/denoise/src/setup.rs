//! Decisions that are made on the first frame and hold for the whole sequence, and their report to the user.

use crate::camera::{self, Camera, SequenceFile};
use crate::conventions;
use crate::error::{Result, ToolError};
use crate::frame_files::FrameFiles;
use crate::frame_source;
use crate::layouts::Layout;
use crate::mapping::{Mapping, Named};
use crate::roles::Role;
use crate::sampling::Pattern;
use atrous::config::{DepthEncoding, GradientSource, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, Preset, Signals};
use atrous::{Config, Tuning};
use std::path::{Path, PathBuf};

/// Options of the user that the setup takes.
#[derive(Clone, Debug, Default)]
pub struct Options {
    /// Channels by role.
    pub channels: Vec<(Role, String)>,
    /// View layer to read alone.
    pub view_layer: Option<String>,
    /// Another `sequence.json`.
    pub camera: Option<PathBuf>,
    /// Conventions by key.
    pub conventions: Vec<(String, String)>,
    /// Signals, where not by what the file has.
    pub signals: Option<Signals>,
    /// À-trous levels, where not the default.
    pub levels: Option<u32>,
    /// Filter, where not that of a capture, or [`Preset::Best`].
    pub preset: Option<Preset>,
    /// Side of the strata, where not the default.
    pub stratum_size: Option<u32>,
    /// Pixels whose samples are kept, where not all.
    pub sampling: Option<Pattern>,
    /// Tunables, on top of those of the sequence.
    pub tunables: Vec<(String, f32)>,
}

/// Settings that hold for all frames.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Channels.
    pub mapping: Mapping,
    /// The configuration for the library.
    pub config: Config,
    /// Cameras.
    pub sequence: Option<SequenceFile>,
    /// Pixels whose samples are kept, where not all.
    pub sampling: Option<Pattern>,
    /// Tunables by which every frame differs from its sequence.
    tunables: Vec<(String, f32)>,
    /// Lines to print.
    pub report: Vec<String>,
    /// Bytes that decoding a file of the first frame takes.
    pub reading: u64,
}

impl Setup {
    /// Looks at the first frames.
    pub fn new(frames: &[FrameFiles], options: &Options) -> Result<Self> {
        let Some(first) = frames.first() else { return Err(ToolError::Usage("no frames were given".into())) };
        let header = frame_source::header(first)?;
        let mut mapping = Mapping::choose(&first.colour, &header, &options.channels, options.view_layer.as_deref())?;
        // Channels about the previous frame are absent in the first.
        if let Some(second) = frames.get(1) {
            let later: Vec<_> = options.channels.iter().filter(|n| is_about_previous(n.0)).cloned().collect();
            let later: &Named = &later;
            if let Ok(second) =
                Mapping::choose(&second.colour, &frame_source::header(second)?, later, options.view_layer.as_deref())
            {
                mapping.roles.extend(second.roles.into_iter().filter(|(role, _)| is_about_previous(*role)));
            }
        }
        // References are dear: not every frame need have one.
        if let (false, Some(with)) = (mapping.has(Role::Reference), frames.iter().find(|f| f.guides.iter().any(|g| g.0 == "ref"))) {
            let named =
                Mapping::choose(&with.colour, &frame_source::header(with)?, &options.channels, options.view_layer.as_deref())?;
            mapping.roles.extend(named.roles.into_iter().filter(|(role, _)| *role == Role::Reference));
        }
        let folder = first.colour.parent().unwrap_or(Path::new("."));
        let sequence = camera::find(options.camera.as_deref(), folder)?;
        let mut config = Config::new(header.extent);
        config.frames_in_flight = 1;
        config.surface_id = mapping.has(Role::Id);
        config.object_normal = mapping.has(Role::ObjectNormal);
        config.gradient_source = gradient_source(&mapping);
        if let Some((_, file)) = &sequence {
            file.config.apply(&mut config);
        }
        let captured = sequence.as_ref().and_then(|(_, file)| file.config.preset);
        config.levels = options.levels.or(config.levels);
        config.stratum_size = options.stratum_size.unwrap_or(config.stratum_size);
        config.preset = options.preset.or(captured).unwrap_or(Preset::Best);
        config.sampling = options.sampling.map_or(config.sampling, Pattern::sampling);
        config.forward_motion = mapping.has(Role::ForwardMotion);
        config.volume = mapping.has(Role::Volume) && config.preset != Preset::Volume;
        config.visibility = mapping.has(Role::Visibility) && mapping.has(Role::OccluderDistance);
        config.signals = signals(&mapping, config.preset, options.signals)?;
        config.conventions = conventions::of_layout(&mapping);
        let mut report = describe(&mapping, &config);
        if let Some((path, file)) = &sequence {
            check_cameras(path, file, frames)?;
            apply(&mut config, &file.conventions, |what| ToolError::Json { path: path.clone(), problem: what })?;
            report.push(format!("  {:<16} {}", "camera", path.display()));
        }
        apply(&mut config, &options.conventions, ToolError::Usage)?;
        without(&mut config, &mapping, sequence.is_some(), &mut report);
        config.validate()?;
        if frames.len() == 1 && config.preset != Preset::Stabilize {
            report.push(still_note(config.preset));
        }
        if header.windows_differ {
            report.push("  note: the data window differs from the display window; the result covers the display window, and pixels without data are background".into());
        }
        Ok(Self {
            mapping,
            config,
            sequence: sequence.map(|(_, file)| file),
            sampling: options.sampling,
            tunables: options.tunables.clone(),
            report,
            reading: header.reading,
        })
    }

    /// Pixels of a frame.
    pub fn pixels(&self) -> usize {
        let [width, height] = self.config.allocated_extent;
        width as usize * height as usize
    }

    /// Whether values that are not finite reach the filter.
    pub fn is_verbatim(&self) -> bool {
        self.sequence.as_ref().is_some_and(|s| s.verbatim)
    }

    /// Tunables of a frame.
    pub fn tuning(&self, number: u64) -> Result<Tuning> {
        let mut tuning = Tuning::for_preset(self.config.preset);
        let of_sequence = self.sequence.iter().flat_map(|s| &s.tuning);
        let of_frame = self.camera(number).into_iter().flat_map(|c| &c.tuning);
        let wished = self.tunables.iter().map(|(name, value)| (name, value));
        for (name, value) in of_sequence.chain(of_frame).chain(wished) {
            tuning.set(name, *value)?;
        }
        Ok(tuning)
    }

    /// The camera of a frame.
    pub fn camera(&self, number: u64) -> Option<&Camera> {
        self.sequence.as_ref().and_then(|s| s.cameras.get(&number))
    }
}

/// Roles that the first frame of a sequence need not have.
pub fn is_about_previous(role: Role) -> bool {
    matches!(role, Role::ReshadeDirect | Role::ReshadeIndirect | Role::ReshadeEmission | Role::Reshaded | Role::ForwardMotion)
}

/// The source of gradients, by what the frames have; a capture names it itself.
fn gradient_source(mapping: &Mapping) -> GradientSource {
    match () {
        () if mapping.has(Role::SparseGradient) => GradientSource::Sparse,
        () if mapping.has(Role::Confidence) => GradientSource::Confidence,
        () => GradientSource::Reshaded,
    }
}

fn signals(mapping: &Mapping, preset: Preset, asked: Option<Signals>) -> Result<Signals> {
    if preset == Preset::Stabilize {
        if !mapping.has(Role::OtherDenoised) {
            return Err(ToolError::Usage(
                "--preset stabilize needs the picture of another denoiser; name its layer with --channel other_denoised=LAYER"
                    .into(),
            ));
        }
        return Ok(Signals::Together);
    }
    match (asked, mapping.has_signals_apart()) {
        (Some(Signals::Specular), _) if !mapping.has_specular() => Err(ToolError::Usage(
            "--signals specular needs specular light in a layer of its own; name it with --channel specular=LAYER".into(),
        )),
        (None, _) if mapping.has_specular() => Ok(Signals::Specular),
        (Some(Signals::Apart), false) => Err(ToolError::Usage(
            "--signals apart needs direct and indirect light in separate layers; name them with --channel direct=LAYER and --channel indirect=LAYER".into(),
        )),
        (Some(asked), _) => Ok(asked),
        (None, true) => Ok(Signals::Apart),
        (None, false) => Ok(Signals::Together),
    }
}

/// A hint for a frame by itself: docs/denoise.md has the figures behind it.
fn still_note(preset: Preset) -> String {
    let better = if preset == Preset::Best { "" } else { "; --preset best leaves the least error there" };
    format!("  note: a single frame is filtered in space alone, without history{better}")
}

fn apply(config: &mut Config, changes: &[(String, String)], error: impl Fn(String) -> ToolError) -> Result<()> {
    for (key, value) in changes {
        conventions::set(&mut config.conventions, key, value)
            .map_err(|e| error(format!("no convention `{key}={value}`: {e}; there are: {}", conventions::keys())))?;
    }
    Ok(())
}

fn check_cameras(path: &Path, file: &SequenceFile, frames: &[FrameFiles]) -> Result<()> {
    match frames.iter().find(|f| !file.cameras.contains_key(&f.number)) {
        Some(frame) => Err(ToolError::Json {
            path: path.to_owned(),
            problem: format!("has no camera for {} (frame {})", frame.colour.display(), frame.number),
        }),
        None => Ok(()),
    }
}

fn describe(mapping: &Mapping, config: &Config) -> Vec<String> {
    let mut lines = vec![format!("channels ({}):", mapping.layout.name())];
    for (role, names) in &mapping.roles {
        lines.push(format!("  {:<16} {}", role.name(), short(names)));
    }
    let signals = match config.signals {
        Signals::Apart => "direct and indirect apart",
        Signals::Specular => "diffuse and specular apart",
        _ => "together, as one signal",
    };
    lines.push(format!("  {:<16} {signals}, by {}", "filtered", config.preset.title()));
    lines
}

/// `noisy.R, noisy.G, noisy.B` as `noisy.R/G/B`.
fn short(names: &[String]) -> String {
    let split: Vec<_> = names.iter().map(|n| crate::mapping::split(n)).collect();
    match split.iter().all(|s| s.0 == split[0].0) {
        true => format!(
            "{}{}{}",
            split[0].0,
            if split[0].0.is_empty() { "" } else { "." },
            split.iter().map(|s| s.1).collect::<Vec<_>>().join("/")
        ),
        false => names.join(", "),
    }
}

/// Names what is missing and what is lost, and makes the encodings fit what stands in for it.
fn without(config: &mut Config, mapping: &Mapping, camera: bool, report: &mut Vec<String>) {
    let mut lost = |what: &str, loss: &str| report.push(format!("  no {what}: {loss}"));
    let c = &mut config.conventions;
    let depth = mapping.has(Role::Depth) || (mapping.has(Role::Position) && (camera || mapping.layout == Layout::Pbrt));
    for role in [Role::Emission, Role::Albedo, Role::Normal, Role::Id] {
        if !mapping.has(role) {
            lost(role.name(), role.loss());
        }
    }
    if !mapping.has_signals_apart() && !mapping.has_specular() {
        lost("direct and indirect light", Role::Indirect.loss());
    }
    if !mapping.has(Role::Normal) {
        c.normal = NormalEncoding::Xyz;
    }
    if !mapping.has(Role::Depth) {
        c.depth = DepthEncoding::Linear;
    }
    if !depth {
        lost("depth", Role::Depth.loss());
    } else if !camera && c.depth != DepthEncoding::Linear {
        lost("camera", "the depth cannot be decoded without a projection and is taken as linear");
        c.depth = DepthEncoding::Linear;
    }
    match (mapping.has(Role::Motion), camera && depth) {
        (true, true) => {}
        (true, false) if c.motion_depth == MotionDepth::Absolute && mapping.has(Role::PreviousDepth) => {}
        (true, false) => {
            lost("camera and depth", "depths are expected to stay as they were; surfaces that come closer by more than depth_tolerance lose their history");
            c.motion_depth = MotionDepth::Difference;
        }
        (false, true) => {
            lost("motion", "it is computed from depth and camera, so objects that move by themselves lose their history");
            c.motion_depth = MotionDepth::None;
        }
        (false, false) => {
            lost(
                "motion and no camera",
                "pixels are taken to stay where they are; with a moving camera the history smears or is lost",
            );
            (c.motion_unit, c.motion_depth) = (MotionUnit::Pixels, MotionDepth::Difference);
            (c.motion_direction, c.motion_y_up) = (MotionDirection::PreviousMinusCurrent, false);
        }
    }
}
