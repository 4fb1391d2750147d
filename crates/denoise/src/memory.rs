//! Memory that a run takes, told before it is taken: an allocation that fails ends the program, and names no file.
//!
//! `tests/memory.rs` holds the sums against what is really allocated.

use crate::error::{Result, ToolError};
use crate::roles::Role;
use crate::setup::Setup;
use atrous::config::Signals;
use atrous::Config;
use std::path::Path;
use sysinfo::System;

/// Frames in memory at once: read, waiting twice two, filtered, written.
const FRAMES: u64 = 7;
/// Bytes of a texel as the tool has it: four floats.
const TEXEL: u64 = 16;
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
    /// The need of a run.
    ///
    /// # Errors
    /// Errors of [`Config::declare`].
    pub fn new(setup: &Setup, demands: &Demands) -> Result<Self> {
        let pixels = setup.pixels() as u64;
        let has = |role: Role| u64::from(setup.mapping.has(role));
        let frame = TEXEL * images(setup) + COLOUR * (1 + has(Role::Reference)) + 4 * (has(Role::Id) + has(Role::Alpha));
        let planes = 4 * setup.mapping.roles.values().map(|names| names.len() as u64).sum::<u64>();
        // What roles are made of, one after the other.
        let pieces = 4 * (TEXEL + 1);
        let outputs = if demands.filtered { COLOUR } else { 0 };
        Ok(Self {
            frames: (frame + outputs) * pixels * FRAMES.min(demands.frames as u64),
            reading: (planes + pieces) * pixels + 2 * setup.reading,
            filter: if demands.filtered { filter(setup, demands)? } else { 0 },
            writing: if demands.filtered { writing(demands) * pixels } else { 0 },
        })
    }

    /// All of it.
    pub fn total(&self) -> u64 {
        [self.frames, self.reading, self.filter, self.writing].into_iter().fold(PROGRAM, u64::saturating_add)
    }

    /// Refuses a run that does not fit.
    ///
    /// # Errors
    /// [`ToolError::Memory`] names the file whose size it is.
    pub fn check(&self, path: &Path, extent: [u32; 2], free: Option<Free>) -> Result<()> {
        let Some(free) = free.filter(|free| free.bytes < self.total()) else { return Ok(()) };
        let mib = |bytes: u64| bytes >> 20;
        let Self { frames, reading, filter, writing } = self.map(mib);
        let parts = format!("frames {frames}, reading {reading}, filter {filter}, writing {writing}");
        let (needed, available) = (mib(self.total()), mib(free.bytes));
        Err(ToolError::Memory { path: path.to_owned(), extent, needed, parts, available, limit: free.limit })
    }

    fn map(&self, of: impl Fn(u64) -> u64) -> Self {
        Self { frames: of(self.frames), reading: of(self.reading), filter: of(self.filter), writing: of(self.writing) }
    }
}

/// Images that a frame is made of: see [`crate::frame::load`].
fn images(setup: &Setup) -> u64 {
    let any = |roles: &[Role]| u64::from(roles.iter().any(|role| setup.mapping.has(*role)));
    let light = if setup.config.signals == Signals::Together { 1 } else { 2 };
    let alone = [
        Role::Albedo,
        Role::Roughness,
        Role::SpecularAlbedo,
        Role::HitDistance,
        Role::ObjectNormal,
        Role::ForwardMotion,
        Role::Confidence,
        Role::OtherDenoised,
        Role::SparseGradient,
        Role::Volume,
        Role::ScatteringDepth,
        Role::Visibility,
        Role::OccluderDistance,
        Role::UnshadowedDirect,
    ];
    let motion = u64::from(setup.mapping.has(Role::Motion) || setup.sequence.is_none());
    // Normals and depth are made up where there are none.
    light
        + 2
        + motion
        + any(&[Role::Emission, Role::Environment])
        + any(&[Role::ReshadeDirect, Role::ReshadeIndirect, Role::Reshaded])
        + alone.iter().map(|role| any(&[*role])).sum::<u64>()
}

/// Inputs, history and images between passes.
fn filter(setup: &Setup, demands: &Demands) -> Result<u64> {
    let declaration = Config { debug_view: demands.views, ..setup.config }.declare()?;
    let pixels = setup.pixels() as u64;
    let inputs = (TEXEL * images(setup) + 4) * pixels;
    let memory = declaration.memory();
    // Results on their way out: as bytes, as floats, and as colours.
    let passing = (2 * TEXEL + COLOUR) * pixels;
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
    file + of(demands.score, score) + of(demands.pictures, pictures) + of(demands.views, views)
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
