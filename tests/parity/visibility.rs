//! Shadows that move.

use super::super::support::{assert_valid, scene::Scene, session_with, svgf, svgf_tuning, upload};
use super::run;
use atrous::executor::SessionOptions;
use atrous::reference::InstanceTransform;
use atrous::{Config, Counter, FrameParams, Input};

/// Things and lights that move, transforms that none has, ids that have none, and motions that are NaN.
pub fn moving_shadows() {
    for (visibility, coloured_visibility) in [(1, false), (4, true)] {
        moving_shadows_of(Config { visibility, coloured_visibility, ..svgf([67, 35]) });
    }
}

fn moving_shadows_of(config: Config) {
    let scene = Scene { speed: 0.07, ..Scene::new([67, 35]) };
    let identity: InstanceTransform = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let moved = [[0.9998, -0.02, 0.0, 0.1], [0.02, 0.9998, 0.0, -0.05], [0.0, 0.0, 1.0, 0.02]];
    let bad = [[f32::NAN; 4]; 3];
    let tables: [&[InstanceTransform]; 3] = [&[identity, identity, moved], &[identity, moved, bad], &[bad, moved]];
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    let mut counted = [0; 2];
    for (i, table) in (0..).zip(tables.into_iter().cycle().take(8)) {
        let guides = scene.frame(i, i);
        upload(&mut s, &guides);
        let pixels = guides.depth.len() as u32;
        let ids: Vec<u32> = (0..pixels).map(|k| (k / 5) % 4).collect();
        for of_light in &Input::OCCLUDER_ID[..config.visibility as usize] {
            s.upload_ids(of_light.name, &ids).expect(of_light.name);
        }
        s.upload_buffer("instance_transforms", bytemuck::cast_slice(table)).expect("instance_transforms");
        let of_lights = &Input::OCCLUDER_MOTION[..config.visibility as usize];
        if i % 4 == 3 {
            let motion: Vec<_> = (0..pixels).map(|k| [if k % 11 == 0 { f32::NAN } else { 0.06 }, -0.02, 0.0, 0.0]).collect();
            of_lights.iter().for_each(|of_light| s.upload(of_light.name, &motion).expect(of_light.name));
        } else {
            of_lights.iter().for_each(|of_light| s.unbind(of_light.name).expect(of_light.name));
        }
        // A lamp that moves, then a sun that stands, then neither.
        let light = |k: usize| [[0.2 * i as f32, 6.0, 2.0, 1.0], [0.3, 0.8, 0.5, 0.0], [0.0; 4]][(i as usize / 3 + k) % 3];
        run(&mut s, &FrameParams { lights: [0, 1, 2, 3].map(light), ..scene.params(i) }, &svgf_tuning());
        let statistics = s.statistics().expect("counters");
        counted[0] += statistics[Counter::OccluderId];
        counted[1] += statistics[Counter::OccluderMotion];
    }
    assert!(counted.iter().all(|count| *count > 0), "{counted:?}");
    assert_valid();
}
