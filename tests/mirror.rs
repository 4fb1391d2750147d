//! Primary-surface replacement: a flat mirror on a wall, whose guides are those of what is seen in it, while the camera slides.

use super::support::{assert_valid, pixels, random, rmse, scene::Scene, session};
use atrous::config::{Conventions, DepthEncoding, MotionDepth, Preset};
use atrous::executor::Session;
use atrous::{Config, FrameParams, Tuning};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("a_mirror_keeps_the_history_of_what_is_seen_in_it", a_mirror_keeps_the_history_of_what_is_seen_in_it),
    ("a_mirror_that_moves_needs_motion", a_mirror_that_moves_needs_motion),
];

const EXTENT: [u32; 2] = [160, 90];
const FRAMES: u32 = 20;
const NOISE: f32 = 0.7;
const CAMERA_SPEED: f32 = 0.06;
/// Depth of the wall with the mirror in the first frame.
const WALL: f32 = 3.0;
/// Of the wall behind the camera.
const BEHIND: f32 = 2.0;
const TINT: [f32; 3] = [0.9, 0.8, 0.7];

/// What the host puts into the guides of the mirror.
#[derive(Clone, Copy, PartialEq)]
enum Shown {
    TheMirror,
    WhatIsSeenInIt,
}

struct Room {
    /// The camera slides by this a frame.
    camera_speed: f32,
    /// The mirror comes nearer or goes away by this a frame.
    mirror_speed: f32,
    shown: Shown,
    has_motion: bool,
}

/// What a pixel sees.
struct Seen {
    is_mirror: bool,
    depth: f32,
    albedo: [f32; 3],
    light: f32,
    /// Of what is seen: previous − current, in UV and in depth.
    motion: [f32; 3],
}

fn checker(x: f32, y: f32) -> [f32; 3] {
    let odd = ((2.0 * x).floor() + (2.0 * y).floor()) as i32 & 1;
    if odd == 1 {
        [0.8, 0.4, 0.2]
    } else {
        [0.2, 0.4, 0.8]
    }
}

impl Room {
    /// Depth of a wall, or of the picture of the one behind the camera, in a frame.
    fn depth(&self, is_mirror: bool, index: f32) -> f32 {
        let wall = WALL + self.mirror_speed * index;
        if is_mirror {
            2.0 * wall + BEHIND
        } else {
            wall
        }
    }

    fn seen(&self, params: [&FrameParams; 2], index: u32, [x, y]: [u32; 2]) -> Seen {
        let [now, before] = params;
        let ndc = [(x, EXTENT[0]), (y, EXTENT[1])].map(|(p, side)| (p as f32 + 0.5) / side as f32 * 2.0 - 1.0);
        let direction = [0, 1].map(|i| ndc[i] / now.clip_from_view[i][i]);
        let eye = |params: &FrameParams| -params.view_from_world[3][0];
        let at = |depth: f32| [eye(now) + direction[0] * depth, direction[1] * depth];
        let on_wall = at(self.depth(false, index as f32));
        let is_mirror = on_wall[0].abs() < 1.4 && on_wall[1].abs() < 0.8;
        let (depth, previous_depth) = (self.depth(is_mirror, index as f32), self.depth(is_mirror, index as f32 - 1.0));
        let [px, py] = at(depth);
        let previous = [(px - eye(before)) / previous_depth, py / previous_depth];
        let uv = |i: usize| 0.5 * (previous[i] - direction[i]) * now.clip_from_view[i][i];
        let light = if is_mirror { 0.8 + 0.4 * (px + 0.5 * py).sin() } else { 0.6 };
        Seen { is_mirror, depth, albedo: checker(px, py), light, motion: [uv(0), uv(1), previous_depth - depth] }
    }

    /// Runs the frames, and gives the mean error in the mirror over the last ones, with the share of all histories that were kept.
    fn measure(&self) -> (f64, f64) {
        let conventions =
            Conventions { depth: DepthEncoding::RayLength, motion_depth: MotionDepth::Difference, ..Conventions::default() };
        let motion_depth = if self.has_motion { MotionDepth::Difference } else { MotionDepth::None };
        let config =
            Config { preset: Preset::Best, conventions: Conventions { motion_depth, ..conventions }, ..Config::new(EXTENT) };
        let mut s = session(&config);
        let (mut error, measured) = (0.0, FRAMES / 2);
        for index in 0..FRAMES {
            let (given, clean) = self.frame(&mut s, index);
            if index >= FRAMES - measured {
                error += rmse(&given, &clean) / f64::from(measured);
            }
        }
        let statistics = s.statistics().expect("counters");
        assert_valid();
        (error, 1.0 - statistics.history_lost() as f64 / statistics.history_sought() as f64)
    }

    /// The pixels of the mirror, denoised and clean.
    fn frame(&self, s: &mut Session, index: u32) -> (Vec<[f32; 4]>, Vec<[f32; 4]>) {
        let camera = Scene { speed: self.camera_speed, ..Scene::new(EXTENT) };
        let (now, before) = (camera.params(index), camera.params(index.saturating_sub(1)));
        let seen: Vec<Seen> = pixels(EXTENT).map(|(x, y)| self.seen([&now, &before], index, [x, y])).collect();
        let radiance = |seen: &Seen, noise: f32| {
            let tint = if seen.is_mirror { TINT } else { [1.0; 3] };
            let [r, g, b] = [0, 1, 2].map(|i| seen.albedo[i] * seen.light * tint[i] * noise);
            [r, g, b, 1.0]
        };
        let (mut depth, mut albedo, mut motion, mut noisy, mut ids) = (vec![], vec![], vec![], vec![], vec![]);
        for ((x, y), seen) in pixels(EXTENT).zip(&seen) {
            let is_replaced = seen.is_mirror && self.shown == Shown::WhatIsSeenInIt;
            let linear = if is_replaced || !seen.is_mirror { seen.depth } else { self.depth(false, index as f32) };
            let ray = [0, 1].map(|i| {
                let ndc = ([x, y][i] as f32 + 0.5) / EXTENT[i] as f32 * 2.0 - 1.0;
                ndc / now.clip_from_view[i][i]
            });
            depth.push([linear * (ray[0] * ray[0] + ray[1] * ray[1] + 1.0).sqrt(), 0.0, 0.0, 0.0]);
            let [r, g, b] = match (is_replaced, seen.is_mirror) {
                (true, _) => [0, 1, 2].map(|i| seen.albedo[i] * TINT[i]),
                (false, true) => TINT,
                (false, false) => seen.albedo,
            };
            albedo.push([r, g, b, 1.0]);
            motion.push([seen.motion[0], seen.motion[1], seen.motion[2], 0.0]);
            let noise = 1.0 + NOISE * 12f32.sqrt() * (random(x, y, index) - 0.5);
            noisy.push(radiance(seen, noise.max(0.0)));
            ids.push(if seen.is_mirror { 2 } else { 1 });
        }
        // A wall behind the camera looks along −z; its picture in the mirror along +z, as the wall with the mirror does.
        let images = [("depth", depth), ("normal", vec![[0.0, 0.0, 1.0, 0.0]; seen.len()]), ("albedo", albedo)];
        for (name, texels) in
            images.into_iter().chain([("noisy_radiance", noisy)]).chain(self.has_motion.then_some(("motion", motion)))
        {
            s.upload(name, &texels).expect(name);
        }
        s.upload_ids("surface_id", &ids).expect("surface_id");
        s.run(&now, &Tuning::for_preset(Preset::Best)).expect("frame");
        let denoised = s.download("denoised_radiance").expect("output");
        let clean: Vec<_> = seen.iter().map(|seen| radiance(seen, 1.0)).collect();
        let mirrored = |texels: Vec<[f32; 4]>| texels.into_iter().zip(&seen).filter(|(_, s)| s.is_mirror).map(|(t, _)| t).collect();
        (mirrored(denoised), mirrored(clean))
    }
}

fn a_mirror_keeps_the_history_of_what_is_seen_in_it() {
    let of = |camera_speed, shown| Room { camera_speed, mirror_speed: 0.0, shown, has_motion: false }.measure();
    let (error, kept) = of(CAMERA_SPEED, Shown::WhatIsSeenInIt);
    let (error_of_mirror, _) = of(CAMERA_SPEED, Shown::TheMirror);
    let (at_rest, _) = of(0.0, Shown::WhatIsSeenInIt);
    println!(
        "error in the mirror {error:.4}, {kept:.3} of the histories kept, {at_rest:.4} at rest; with guides of the mirror itself \
         {error_of_mirror:.4}"
    );
    assert!(kept > 0.95, "{kept}");
    assert!(error < 0.5 * error_of_mirror, "{error} {error_of_mirror}");
    // What was kept is of the right place: it costs what it is resampled, and no history is better than that of a camera at rest.
    assert!(error < 1.75 * at_rest, "{error} {at_rest}");
}

fn a_mirror_that_moves_needs_motion() {
    let of = |mirror_speed, has_motion| {
        Room { camera_speed: CAMERA_SPEED, mirror_speed, shown: Shown::WhatIsSeenInIt, has_motion }.measure()
    };
    let (still, _) = of(0.0, true);
    let (with, kept) = of(0.05, true);
    let (without, kept_without) = of(0.05, false);
    println!("error with motion {with:.4}, {kept:.3} kept; by the matrices {without:.4}, {kept_without:.3} kept; still {still:.4}");
    assert!(kept > 0.95, "{kept}");
    assert!(with < 1.25 * still && without > 1.25 * with, "{still} {with} {without}");
}
