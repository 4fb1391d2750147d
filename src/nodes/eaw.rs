//! The edge-avoiding à-trous wavelet transform by radiance, normal and position. [EAW].

use super::{by_signals, Builder, Filtered, Frame, Guides, Signal};
use crate::contract::Phase;
use crate::shaders;

const NAMES: [&str; 10] = ["eaw_0", "eaw_1", "eaw_2", "eaw_3", "eaw_4", "eaw_5", "eaw_6", "eaw_7", "eaw_8", "eaw_9"];

/// One pass a level, each from the image of the level before it.
pub(crate) fn eaw(b: &mut Builder, frame: Frame, guides: Guides, signals: &[Signal], levels: u32) -> Filtered {
    let shader = by_signals(signals, &shaders::EAW_SIGNALS_1, &shaders::EAW_SIGNALS_2);
    let mut filtered: Filtered = signals.iter().map(|s| s.ping).collect();
    for (level, name) in (0..levels).zip(NAMES) {
        let mut uses = vec![frame.constants.uniform(), guides.guide.sampled()];
        for (signal, from) in signals.iter().zip(&mut filtered) {
            let to = if level % 2 == 0 { signal.pong } else { signal.ping };
            uses.extend([from.sampled(), to.written()]);
            *from = to;
        }
        b.dispatch(name, Phase::AfterLighting, shader, level, uses);
    }
    filtered
}
