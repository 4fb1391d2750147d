//! Memory that a run takes, told before it is taken: an allocation that fails ends the program, and names no file.
//!
//! `tests/memory.rs` holds the sums against what is really allocated.

use crate::error::{Result, ToolError};
use crate::roles::Role;
use crate::setup::Setup;
use atrous::config::{Preset, Signals};
use atrous::Config;
use std::path::Path;
use sysinfo::System;

/// Frames that wait between two threads of the pipeline, where there is memory for them.
pub const QUEUE: usize = 2;
/// Frames in memory at once that do not wait: read, filtered, written.
const AT_WORK: u64 = 3;
/// Bytes of a texel as the tool has it: four floats.
const TEXEL: u64 = 16;
/// Bytes of a pixel that averages and the motion of surfaces take, of a frame and of the one before: in four images at most, and the edges of one.
const AVERAGES: u64 = 2 * (4 * 24 + 21) + 57;
/// Bytes of a colour.
const COLOUR: u64 = 12;
/// Taken by the program itself, by the driver, by threads, which reserve more than they use, and by [`READING_SLACK`].
const PROGRAM: u64 = 256 << 20;
/// Later files may take more for decoding than those of the first frame: twice as much, and this.
const READING_SLACK: u64 = 64 << 20;

/// Bytes that decoding a file of any frame may take.
pub fn reading_limit(setup: &Setup) -> u64 {
    setup.reading.saturating_mul(2).saturating_add(READING_SLACK)
}

/// The demands of a run that memory depends on.
#[derive(Clone, Copy, Debug, Default)]
pub struct Demands {
    /// Frames of the run.
    pub frames: usize,
    /// Filtered on the CPU; on a device otherwise, whose memory may be that of the program.
    pub reference: bool,
    /// Filtered at all.
    pub filtered: bool,
    /// Scored.
    pub score: bool,
    /// Previews or a strip.
    pub pictures: bool,
    /// Debug views.
    pub views: bool,
    /// Channels of the input that are read again for the result.
    pub kept: usize,
}

/// Bytes that a run takes at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Need {
    /// All frames between reading and writing.
    pub frames: u64,
    /// Decoding a frame.
    pub reading: u64,
    /// The filter with its inputs and its history.
    pub filter: u64,
    /// Encoding, scoring and drawing a frame.
    pub writing: u64,
}

impl Need {
    /// The need of a run in which `queue` frames may wait between two threads of [`crate::pipeline`].
    ///
    /// # Errors
    /// Errors of [`Config::declare`].
    pub fn new(setup: &Setup, demands: &Demands, queue: usize) -> Result<Self> {
        let pixels = setup.pixels() as u64;
        let has = |role: Role| u64::from(setup.mapping.has(role));
        let frame = TEXEL * images(setup) + COLOUR * (1 + has(Role::Reference)) + 4 * (ids(setup) + has(Role::Alpha));
        let planes = 4 * setup.mapping.roles.values().map(|names| names.len() as u64).sum::<u64>();
        // What roles are made of, one after the other.
        let pieces = 7 * (TEXEL + 1);
        let averages = if setup.averages() { AVERAGES } else { 0 };
        let outputs = if demands.filtered { COLOUR } else { 0 };
        let at_once = (AT_WORK + 2 * queue as u64).min(demands.frames as u64);
        let of_result = setup.result_pixels() as u64;
        Ok(Self {
            frames: (frame * pixels + outputs * of_result) * at_once,
            reading: (planes + pieces + averages) * pixels + 2 * setup.reading,
            filter: if demands.filtered { filter(setup, demands)? } else { 0 },
            writing: if demands.filtered { writing(demands) * of_result } else { 0 },
        })
    }

    /// All of it.
    pub fn total(&self) -> u64 {
        [self.frames, self.reading, self.filter, self.writing].into_iter().fold(PROGRAM, u64::saturating_add)
    }
}

/// Frames that may wait between two threads: as many as fit, 2 to 0.
///
/// # Errors
/// [`ToolError::Memory`] where none fits: it names the file whose size it is, and what would fit. Errors of [`Need::new`].
pub fn fitting_queue(path: &Path, setup: &Setup, demands: &Demands, free: Option<Free>) -> Result<usize> {
    let Some(free) = free else { return Ok(QUEUE) };
    for queue in (0..=QUEUE).rev() {
        if Need::new(setup, demands, queue)?.total() <= free.bytes {
            return Ok(queue);
        }
    }
    let need = Need::new(setup, demands, 0)?;
    let Need { frames, reading, filter, writing } = need;
    let parts = format!("frames {}, reading {}, filter {}, writing {}", mib(frames), mib(reading), mib(filter), mib(writing));
    Err(ToolError::Memory {
        path: path.to_owned(),
        extent: setup.config.allocated_extent,
        needed: mib(need.total()),
        parts,
        available: mib(free.bytes),
        limit: free.limit,
        remedies: remedies(setup, demands, &need, free.bytes),
    })
}

fn mib(bytes: u64) -> u64 {
    bytes >> 20
}

/// What would need less, with its figures.
fn remedies(setup: &Setup, demands: &Demands, need: &Need, free: u64) -> String {
    let mut remedies = Vec::new();
    let plain = Demands { score: false, pictures: false, views: false, ..*demands };
    let mut offer = |what: &str, other: Result<Need>| {
        if let Some(total) = other.ok().map(|other| other.total()).filter(|total| *total < need.total()) {
            remedies.push(format!("{what} it is {} MiB{}", mib(total), if total <= free { ", which fit" } else { "" }));
        }
    };
    offer("Without --score, --report, --strip, --png and --views", Need::new(setup, &plain, 0));
    for preset in [Preset::Fast, Preset::Eaw] {
        let mut lean = setup.clone();
        lean.config.preset = preset;
        offer(&format!("With --preset {preset}"), Need::new(&lean, demands, 0));
    }
    // All but what the program itself takes grows with the pixels.
    let share = free.saturating_sub(PROGRAM) as f64 / (need.total() - PROGRAM).max(1) as f64;
    let [width, height] = setup.config.allocated_extent.map(|side| (f64::from(side) * share.sqrt()) as u32);
    if width > 0 && height > 0 {
        let reach = filter_reach(&setup.config);
        remedies.push(format!(
            "Frames of {width}x{height} pixels fit: make them smaller, or crop them into parts that overlap by {reach} pixels, as far as the filter looks"
        ));
    }
    remedies.push(
        "Or leave channels out with --channel ROLE=none, or free memory; where the picture is not as large as that, its header is corrupt".into(),
    );
    remedies.join(". ")
}

/// Pixels that an à-trous filter of 5×5 taps sees to each side.
fn filter_reach(config: &Config) -> u32 {
    2 * ((1 << config.levels()) - 1)
}

/// Images that a frame is made of: see [`crate::frame::load`].
fn images(setup: &Setup) -> u64 {
    let any = |roles: &[Role]| u64::from(roles.iter().any(|role| setup.mapping.has(*role)));
    let light = if matches!(setup.config.signals, Signals::Together | Signals::Mixed) { 1 } else { 2 };
    let alone = [
        Role::Albedo,
        Role::Roughness,
        Role::SpecularAlbedo,
        Role::HitDistance,
        Role::PathLength,
        Role::HitMotion,
        Role::Ambient,
        Role::AmbientDistance,
        Role::ObjectNormal,
        Role::ForwardMotion,
        Role::Confidence,
        Role::OtherDenoised,
        Role::SparseGradient,
        Role::Volume,
        Role::ScatteringDepth,
    ];
    let of_light = |light| {
        [Role::Visibility(light), Role::OccluderDistance(light), Role::OccluderMotion(light), Role::UnshadowedDirect(light)]
    };
    let motion = u64::from(setup.mapping.has(Role::Motion) || setup.sequence.is_none());
    // Normals and depth are made up where there are none.
    light
        + 2
        + motion
        + any(&[Role::Emission, Role::Environment])
        + any(&[Role::ReshadeDirect, Role::ReshadeIndirect, Role::Reshaded])
        + alone.into_iter().chain((0..4).flat_map(of_light)).map(|role| any(&[role])).sum::<u64>()
}

/// Images of ids: see [`crate::frame::FrameInputs`].
fn ids(setup: &Setup) -> u64 {
    let roles = [Role::Id, Role::MaterialClass, Role::HitId].into_iter().chain((0..4).map(Role::OccluderId));
    roles.map(|role| u64::from(setup.mapping.has(role))).sum()
}

/// Inputs, history and images between passes.
fn filter(setup: &Setup, demands: &Demands) -> Result<u64> {
    let declaration = Config { debug_view: demands.views, ..setup.config }.declare()?;
    let pixels = setup.pixels() as u64;
    let inputs = (TEXEL * images(setup) + 4 * ids(setup)) * pixels;
    let memory = declaration.memory();
    // Results on their way out: as bytes, as floats, and as colours. Those beside the radiance as samples, in a file, and compressed.
    let config = &setup.config;
    let beside =
        u64::from(config.visibility) * if config.coloured_visibility { 3 } else { 1 } + u64::from(config.ambient_occlusion);
    let passing = (2 * TEXEL + COLOUR) * setup.result_pixels() as u64 + 3 * 4 * beside * pixels;
    Ok(match demands.reference {
        // The CPU has four floats where a device has four halves, and writes beside what it reads.
        true => inputs + 2 * (memory.history + memory.output + memory.transient) + 2 * TEXEL * pixels + passing,
        false => inputs + memory.history + memory.output + memory.transient + TEXEL * pixels + passing,
    })
}

/// Bytes a pixel behind the filter.
fn writing(demands: &Demands) -> u64 {
    // Two sets of three channels and alpha, as samples, as a file, and compressed.
    let file = 3 * 7 * 4;
    // Three pictures and their motion of the frame before, the same of this one, and what a metric computes with.
    let score = 8 * COLOUR + 2 * (8 + 3 * 4) + 5 * 8;
    // Three bytes in each panel of a strip, twice, and as a file.
    let pictures = 3 * 3 * 3;
    let views = 3 * 4 * atrous::DebugView::ALL.len() as u64;
    let of = |wanted: bool, bytes: u64| if wanted { bytes } else { 0 };
    // As they are read, and as they are written.
    let kept = 3 * 4 * demands.kept as u64;
    file + kept + of(demands.score, score) + of(demands.pictures, pictures) + of(demands.views, views)
}

/// Memory that can be had.
#[derive(Clone, Copy, Debug)]
pub struct Free {
    /// Bytes.
    pub bytes: u64,
    /// What sets the limit.
    pub limit: &'static str,
}

/// The least of what the machine, a container and the shell allow; none where the system does not tell.
pub fn free() -> Option<Free> {
    let mut system = System::new();
    system.refresh_memory();
    let machine = system.available_memory().saturating_add(system.free_swap());
    let mut limits = vec![Free { bytes: machine, limit: "free memory of the machine" }];
    // Not its `free_memory`: pages of files that were read count there, and are given back when they are asked for.
    limits.extend(system.cgroup_limits().map(|group| Free {
        bytes: group.total_memory.saturating_sub(group.rss).saturating_add(group.free_swap),
        limit: "limit of the container",
    }));
    limits.extend(address_space().map(|bytes| Free { bytes, limit: "limit of the shell, ulimit -v" }));
    limits.into_iter().filter(|free| free.bytes > 0).min_by_key(|free| free.bytes)
}

/// What is left of the limit for addresses.
fn address_space() -> Option<u64> {
    #[cfg(unix)]
    {
        let limit = rustix::process::getrlimit(rustix::process::Resource::As).current?;
        let pages: u64 = std::fs::read_to_string("/proc/self/statm").ok()?.split_whitespace().next()?.parse().ok()?;
        // The least size of a page: what is used is not overrated.
        Some(limit.saturating_sub(pages * 4096).max(1))
    }
    #[cfg(not(unix))]
    None
}
