//! Uploads the frame's constants and clears the counters.

use super::Builder;
use crate::contract::{Lifetime, Phase, ResourceId, Work};
use crate::frame_constants::FrameConstants;

/// How many values `statistics` counts; see `glsl/include/statistics.glsl`.
pub(crate) const STATISTICS_COUNT: u64 = 8;

/// The buffers that every other pass may use.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Frame {
    pub constants: ResourceId,
    pub statistics: ResourceId,
}

/// The first pass of every preset. By `vkCmdUpdateBuffer`, so that no host-visible memory and no copy per slot is needed.
pub(crate) fn start_frame(b: &mut Builder) -> Frame {
    let constants = b.buffer("frame_constants", size_of::<FrameConstants>() as u64, Lifetime::Transient);
    let statistics = b.buffer("statistics", STATISTICS_COUNT * 4, Lifetime::Output);
    b.pass("start_frame", Phase::BeforeLighting, Work::StartFrame, vec![constants.cleared(), statistics.cleared()]);
    Frame { constants, statistics }
}
