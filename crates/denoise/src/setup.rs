//! Decisions that are made on the first frame and hold for the whole sequence, and their report to the user.

use crate::camera::{self, Camera, SequenceFile};
use crate::conventions::{self, Scales};
use crate::display_transform::DisplayTransform;
use crate::error::{Result, ToolError};
use crate::exr_header::ExrHeader;
use crate::frame_files::FrameFiles;
use crate::frame_source;
use crate::mapping::{Mapping, Named};
use crate::missing::{describe, without};
use crate::output_size::OutputSize;
use crate::range::Range;
use crate::roles::Role;
use crate::sampling::Pattern;
use atrous::config::{GradientSource, MotionDepth, MotionUnit, NormalEncoding, Preset, Signals};
use atrous::{Config, Tuning};
use std::collections::BTreeSet;
use std::path::Path;

pub use crate::options::{Made, Options};

/// Settings that hold for all frames.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Channels.
    pub mapping: Mapping,
    /// The configuration for the library.
    pub config: Config,
    /// Cameras.
    pub sequence: Option<SequenceFile>,
    /// The file beside the light, where it has fewer pixels than the guides.
    light: Option<SequenceFile>,
    /// Width and height of that light.
    light_extent: Option<[u32; 2]>,
    /// Pixels whose samples are kept, where not all.
    pub keep_samples: Option<Pattern>,
    /// Lines to print.
    pub report: Vec<String>,
    /// Bytes that decoding a file of the first frame takes.
    pub reading: u64,
    /// Header of the first frame, with the channels of all its files.
    pub header: ExrHeader,
    /// Factors of depth and motion.
    pub scales: Scales,
    /// The range of light.
    pub range: Range,
    /// The way to pictures and scores.
    pub shown: DisplayTransform,
    /// Every frame is filtered by itself: the noise of all of them is the same.
    pub stills: bool,
    /// The depth in the previous frame, where motion leads, is looked up: the motion has none.
    pub carries_depth: bool,
    /// Guides are means over samples that are spread over their pixels.
    pub has_means: bool,
    /// The light of surfaces without an albedo is filtered apart.
    pub has_lobes: bool,
    /// The depth of fog without a surface behind it, where depths have gaps that are filled.
    pub beyond: Option<f32>,
    /// Guides with noise in them, by the names of the library, which are smoothed.
    pub smoothed: BTreeSet<&'static str>,
    /// The step of the numbers of frames.
    pub step: u64,
    options: Options,
    /// Lines about the first frames, behind those of the channels.
    notes: Vec<String>,
}

impl Setup {
    /// Looks at the headers of the first frames.
    pub fn new(frames: &[FrameFiles], options: &Options) -> Result<Self> {
        let Some(first) = frames.first() else {
            return Err(ToolError::Usage("no frames were given".into()));
        };
        let header = frame_source::header(first)?;
        let mapping = choose(frames, &header, options)?;
        let folder = first.colour.parent().unwrap_or(Path::new("."));
        let sequence = camera::find(options.camera.as_deref(), folder)?;
        if let Some((path, file)) = &sequence {
            check_cameras(path, file, frames)?;
        }
        let light_extent = frame_source::light_extent(first)?;
        let light = match &first.light {
            Some(light) => camera::find(None, light.parent().unwrap_or(Path::new(".")))?,
            None => None,
        };
        let mut setup = Self {
            light: light.map(|(_, file)| file),
            light_extent,
            config: Config::new(header.extent),
            mapping,
            keep_samples: options.keep_samples,
            report: Vec::new(),
            reading: header.reading,
            shown: DisplayTransform::new(&header, 0),
            header,
            scales: Scales::default(),
            range: Range::default(),
            stills: false,
            carries_depth: false,
            has_means: false,
            has_lobes: false,
            beyond: None,
            smoothed: BTreeSet::new(),
            step: options.step.unwrap_or(1),
            options: options.clone(),
            notes: Vec::new(),
            sequence: sequence.map(|(path, file)| SequenceFile { path, ..file }),
        };
        setup.notes = setup.notes_of_header(frames.len());
        setup.decide()?;
        Ok(setup)
    }

    /// Makes the configuration and the report of what is read.
    fn decide(&mut self) -> Result<()> {
        let (mapping, options) = (&self.mapping, &self.options);
        let mut config = Config::new(self.header.extent);
        config.frames_in_flight = 1;
        config.output_extent = options.output_size;
        config.light_extent = self.light_extent;
        config.surface_id = mapping.has(Role::Id) || self.has_lobes;
        config.object_normal = mapping.has(Role::ObjectNormal);
        config.material_class = mapping.has(Role::MaterialClass);
        config.gradient_source = gradient_source(mapping);
        if let Some(file) = &self.sequence {
            file.config.apply(&mut config);
            config.output_extent = options.output_size.or(config.output_extent);
        }
        let captured = self.sequence.as_ref().and_then(|file| file.config.preset);
        config.preset = options.preset.or(captured).unwrap_or_default();
        config.sampling = options.keep_samples.map_or(config.sampling, Pattern::sampling);
        options.config.apply(&mut config)?;
        let signals_wished = options.config.has("signals").then_some(config.signals);
        config.forward_motion = mapping.has(Role::ForwardMotion);
        config.volume = mapping.has(Role::Volume) && config.preset != Preset::Volume;
        let is_apart = |light: &usize| mapping.has(Role::Visibility(*light)) && mapping.has(Role::OccluderDistance(*light));
        config.visibility = (0..4).take_while(is_apart).count() as u32;
        config.ambient_occlusion = mapping.has(Role::Ambient) && mapping.has(Role::AmbientDistance);
        // A capture says so itself.
        config.coloured_visibility |=
            captured.is_none() && mapping.roles.get(&Role::Visibility(0)).is_some_and(|names| names.len() > 1);
        // Of a capture, roles tell all others; a host need not have the roughness.
        let is_told = captured.is_some() && config.signals == Signals::Mixed;
        config.signals = match () {
            () if is_told => Signals::Mixed,
            () if self.has_lobes => Signals::Specular,
            () => signals(mapping, config.preset, signals_wished)?,
        };
        if self.lacks_albedo(&config) {
            config.signals = Signals::Specular;
        }
        config.conventions = conventions::of_layout(mapping);
        let mut scales = Scales::default();
        let mut report = describe(mapping, &config);
        if let Some(file) = &self.sequence {
            let problem = |what| ToolError::Json { path: file.path.clone(), problem: what };
            apply(&mut config, &mut scales, &file.conventions, problem)?;
            report.push(format!("  {:<16} {}", "camera", file.path.display()));
        }
        apply(&mut config, &mut scales, &options.conventions, ToolError::Usage)?;
        config.conventions.background_depth *= scales.depth;
        without(&mut config, mapping, self.sequence.is_some(), &mut report);
        if self.carries_depth {
            config.conventions.motion_depth = MotionDepth::Absolute;
        }
        config.validate()?;
        if config.preset == Preset::Stabilize {
            self.notes.retain(|note| !note.contains(STILL));
        }
        report.extend(self.notes.iter().cloned());
        (self.config, self.report, self.scales) = (config, report, scales);
        Ok(())
    }

    /// Notes that the header gives rise to.
    fn notes_of_header(&self, frames: usize) -> Vec<String> {
        let (header, mapping) = (&self.header, &self.mapping);
        let mut notes = Vec::new();
        let unused = mapping.unused(header);
        if !unused.is_empty() {
            let more = unused.len().saturating_sub(UNUSED);
            let more = if more > 0 { format!(" and {more} more layers") } else { String::new() };
            notes.push(format!("  not used: {}{more}", unused[..unused.len().min(UNUSED)].join(", ")));
        }
        for (eye, layer) in mapping.other_eyes(header) {
            notes.push(format!(
                "  note: a second eye, `{eye}`, is left out; filter it in a run of its own, with --channel noisy={layer}"
            ));
        }
        for view in mapping.other_view_layers(header).iter().filter(|_| self.options.view_layer.is_none()) {
            notes.push(format!("  note: another view layer, `{view}`, is left out; --view-layer takes it instead"));
        }
        if frames == 1 {
            notes.push(still_note(self.options.preset.unwrap_or_default()));
        }
        if header.has_gaps {
            notes.push("  note: some data window covers less than the picture; pixels without data are background".into());
        }
        notes
    }

    /// Whether the user named the channels of a role.
    pub fn is_named(&self, role: Role) -> bool {
        self.options.channels.iter().any(|named| named.0 == role)
    }

    /// Adds a line to the report.
    pub fn note(&mut self, line: String) {
        self.report.push(line.clone());
        self.notes.push(line);
    }

    /// Leaves channels out that turned out to be of no use.
    ///
    /// # Errors
    /// What cannot be filtered without them.
    pub fn leave_out(&mut self, roles: &[Role]) -> Result<()> {
        self.mapping.roles.retain(|role, _| !roles.contains(role));
        // They are told by their albedo.
        self.has_lobes &= self.mapping.has(Role::Albedo);
        self.decide()
    }

    /// Takes the environment for one that is not in the picture.
    ///
    /// # Errors
    /// None that [`Self::new`] did not have.
    pub fn hide_environment(&mut self) -> Result<()> {
        let names = self.mapping.roles.remove(&Role::Environment);
        self.mapping.roles.extend(names.map(|names| (Role::HiddenEnvironment, names)));
        self.decide()
    }

    /// Takes ids for numbers that hold for a frame.
    ///
    /// # Errors
    /// None that [`Self::new`] did not have.
    pub fn number_shapes(&mut self) -> Result<()> {
        let names = self.mapping.roles.remove(&Role::Id);
        self.mapping.roles.extend(names.map(|names| (Role::Shape, names)));
        self.decide()
    }

    /// Whether all light is in one picture, in which nobody wants it to stay.
    fn is_one_picture(&self, config: &Config) -> bool {
        let mapping = &self.mapping;
        let has_picture = mapping.has(Role::Noisy) && !mapping.has(Role::Lighting) && config.light_extent.is_none();
        let is_wished = self.options.config.has("signals") || self.is_verbatim();
        config.signals == Signals::Together && config.preset != Preset::Stabilize && has_picture && !is_wished
    }

    /// Whether nothing tells paint from mirrors. Specular light is followed by the motion of surfaces and by that of what is seen in them.
    fn lacks_albedo(&self, config: &Config) -> bool {
        let mapping = &self.mapping;
        let has_albedo = mapping.has(Role::Albedo) || mapping.has(Role::DiffuseColour);
        let has_history = config.preset != Preset::Eaw && self.knows_motion();
        self.is_one_picture(config) && has_history && mapping.has(Role::Normal) && !has_albedo
    }

    /// Whether all light is filtered as specular light, since nothing else is known of it.
    pub fn is_all_specular(&self) -> bool {
        self.config.signals == Signals::Specular && !self.has_lobes && !self.mapping.has_specular()
    }

    /// Whether light may be parted by the albedo of surfaces.
    pub fn may_have_lobes(&self) -> bool {
        let mapping = &self.mapping;
        // Blender's albedo for denoisers is that of what is seen in mirrors and through glass: the lengths of paths tell these.
        let has_paths = mapping.has(Role::PathLength) && mapping.has(Role::Id) && self.sequence.is_some();
        let tells = !mapping.is_for_denoisers(Role::Albedo) || has_paths;
        let is_known = mapping.has(Role::Albedo) && tells && mapping.has(Role::Normal);
        self.is_one_picture(&self.config) && is_known && self.config.conventions.normal == NormalEncoding::Xyz
    }

    /// Has the light of surfaces without an albedo filtered apart.
    ///
    /// # Errors
    /// None that [`Self::new`] did not have.
    pub fn part_lobes(&mut self) -> Result<()> {
        self.has_lobes = true;
        self.decide()
    }

    /// Has the depths of the previous frame looked up.
    ///
    /// # Errors
    /// None that [`Self::new`] did not have.
    pub fn carry_depth(&mut self) -> Result<()> {
        self.carries_depth = true;
        self.decide()
    }

    /// The size of the results, where not that of the frames.
    pub fn output_size(&self) -> Option<OutputSize> {
        self.config.output_extent.map(|result| OutputSize::new(self.config.allocated_extent, result))
    }

    /// The pixel of each cell that the light of a frame was traced for.
    pub fn light_offset(&self, number: u64) -> [u32; 2] {
        let beside_light = self.light.as_ref().map(|file| file.cameras.get(&number));
        // A capture has light and guides in one file.
        beside_light.unwrap_or_else(|| self.camera(number)).map_or([0; 2], |camera| camera.offset)
    }

    /// Pixels of a frame.
    pub fn pixels(&self) -> usize {
        let [width, height] = self.config.allocated_extent;
        width as usize * height as usize
    }

    /// Pixels of a result.
    pub fn result_pixels(&self) -> usize {
        self.output_size().map_or(self.pixels(), OutputSize::pixels)
    }

    /// The display window's share of the picture, and its offset in it, in pixels.
    fn display(&self) -> ([f32; 2], [f32; 2]) {
        let (display, window) = (self.header.shared.display_window, self.header.window);
        let [x, y] = [(display.size.0, window.size.0), (display.size.1, window.size.1)].map(|(d, w)| d as f32 / w as f32);
        let offset = [display.position.0 - window.position.0, display.position.1 - window.position.1];
        ([x, y], offset.map(|o| o as f32))
    }

    /// The factor of motion that is told in parts of the display window: the picture may have overscan.
    pub fn motion_share(&self) -> [f32; 2] {
        match self.config.conventions.motion_unit {
            MotionUnit::Pixels => [1.0; 2],
            MotionUnit::Uv | MotionUnit::Ndc => self.display().0,
        }
    }

    /// A projection to the display window, for the whole picture.
    pub fn projection(&self, clip_from_view: [[f32; 4]; 4]) -> [[f32; 4]; 4] {
        let (share, offset) = self.display();
        if share == [1.0; 2] && offset == [0.0; 2] {
            return clip_from_view;
        }
        let extent = self.config.allocated_extent.map(|side| side as f32);
        let shift: [f32; 2] = std::array::from_fn(|i| 2.0 * offset[i] / extent[i] + share[i] - 1.0);
        clip_from_view.map(|[x, y, z, w]| [x * share[0] + w * shift[0], y * share[1] + w * shift[1], z, w])
    }

    /// Whether values that are not finite reach the filter.
    pub fn is_verbatim(&self) -> bool {
        self.sequence.as_ref().is_some_and(|s| s.verbatim)
    }

    /// Whether it is known where surfaces were in the frame before: by their motion, or by depth and the cameras if they stand still.
    pub fn knows_motion(&self) -> bool {
        let has_depth = self.mapping.has(Role::Depth) || self.mapping.has(Role::Position);
        self.mapping.has(Role::Motion) || (self.sequence.is_some() && has_depth)
    }

    /// Whether images that no filter smooths may be averaged over frames: where the result is of that size, and nobody else does it.
    pub fn averages(&self) -> bool {
        let of_frames = self.config.light_extent.is_none() && self.config.output_extent.is_none();
        of_frames && self.knows_motion() && !self.stills && !self.is_verbatim()
    }

    /// Tunables of a frame.
    pub fn tuning(&self, number: u64) -> Result<Tuning> {
        let mut tuning = Tuning::for_preset(self.config.preset);
        let of_sequence = self.sequence.iter().flat_map(|s| &s.tuning);
        let of_frame = self.camera(number).into_iter().flat_map(|c| &c.tuning);
        let wished = self.options.tunables.iter().map(|(name, value)| (name, value));
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

/// The channels of all roles, by the first frames.
fn choose(frames: &[FrameFiles], header: &ExrHeader, options: &Options) -> Result<Mapping> {
    let view = options.view_layer.as_deref();
    let of = |files: &FrameFiles, named: &Named| -> Result<Mapping> {
        Mapping::choose(&files.colour, &frame_source::header(files)?, named, view)
    };
    let mut mapping = Mapping::choose(&frames[0].colour, header, &options.channels, view)?;
    // Channels about the previous frame are absent in the first.
    if let Some(second) = frames.get(1) {
        let later: Vec<_> = options.channels.iter().filter(|n| is_about_previous(n.0)).cloned().collect();
        if let Ok(second) = of(second, &later) {
            mapping.roles.extend(second.roles.into_iter().filter(|(role, _)| is_about_previous(*role)));
        }
    }
    // References are dear: not every frame need have one.
    let has_reference = |files: &&FrameFiles| files.guides.iter().any(|g| g.0 == "ref");
    if let (false, Some(with)) = (mapping.has(Role::Reference), frames.iter().find(has_reference)) {
        let named = of(with, &options.channels)?;
        mapping.roles.extend(named.roles.into_iter().filter(|(role, _)| *role == Role::Reference));
    }
    Ok(mapping)
}

/// Roles that the first frame of a sequence need not have.
pub fn is_about_previous(role: Role) -> bool {
    matches!(role, Role::ReshadeDirect | Role::ReshadeIndirect | Role::ReshadeEmission | Role::Reshaded | Role::ForwardMotion)
}

/// The source of gradients, by what the frames have; a capture names it itself.
fn gradient_source(mapping: &Mapping) -> GradientSource {
    let is_shaded_again = [Role::Reshaded, Role::ReshadeDirect, Role::ReshadeIndirect].into_iter().any(|role| mapping.has(role));
    match () {
        () if mapping.has(Role::SparseGradient) => GradientSource::Sparse,
        () if mapping.has(Role::Confidence) => GradientSource::Confidence,
        () if is_shaded_again => GradientSource::Reshaded,
        () => GradientSource::ChangeTest,
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
        (Some(Signals::Mixed), _) if !mapping.has(Role::Roughness) => Err(ToolError::Usage(
            "--signals mixed needs the roughness of surfaces; name its layer with --channel roughness=LAYER".into(),
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

/// What a frame by itself gets.
const STILL: &str = "a single frame is filtered in space alone";
/// Layers that are not used and are told one by one.
const UNUSED: usize = 24;

/// A hint for a frame by itself: docs/denoise.md has the figures behind it.
fn still_note(preset: Preset) -> String {
    let better = if preset == Preset::Best { "" } else { "; --preset best leaves the least error there" };
    format!("  note: {STILL}, without history{better}")
}

fn apply(
    config: &mut Config,
    scales: &mut Scales,
    changes: &[(String, String)],
    error: impl Fn(String) -> ToolError,
) -> Result<()> {
    for (key, value) in changes {
        if let Some(scale) = scales.set(key, value) {
            scale.map_err(|e| error(format!("no convention `{key}={value}`: {e}")))?;
            continue;
        }
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
