//! Names of channels that nobody thought of. Whole files are those of `fuzz/`.

use crate::samples::frame;
use atrous_denoise::mapping::Mapping;
use atrous_denoise::{exr_header, exr_read};

/// Splitmix64.
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut v = self.0;
        v = (v ^ (v >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        v = (v ^ (v >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        v ^ (v >> 31)
    }

    fn below(&mut self, end: usize) -> usize {
        (self.next() % end.max(1) as u64) as usize
    }
}

#[test]
fn mutated_names_do_not_break_the_mapping() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let path = folder.path().join("a.exr");
    frame(0).write(&path);
    let header = exr_read::read_header(&path).expect("readable");
    let pieces =
        ["R", "G", ".", "..", "noisy", "ViewLayer", "Combined", "é", "", "normal", "X", "\u{1F600}", "depth", "Z", "I", "a.b.c"];
    for round in 0..20_000 {
        let mut random = Random(round);
        let mut changed = header.clone();
        for channel in &mut changed.channels {
            if random.below(2) == 0 {
                channel.name = (0..random.below(5)).map(|_| pieces[random.below(pieces.len())]).collect();
            }
        }
        let keep = random.below(changed.channels.len() + 1);
        changed.channels.truncate(keep);
        let named = [(atrous_denoise::roles::Role::Normal, pieces[random.below(pieces.len())].to_owned())];
        let view = pieces[random.below(pieces.len())];
        let _ = Mapping::choose(&path, &changed, &named[..random.below(2)], (random.below(4) == 0).then_some(view));
    }
}

#[test]
fn limits_are_those_of_the_library() {
    assert_eq!(exr_header::MAX_SIDE, atrous::Config::MAX_SIDE);
}
