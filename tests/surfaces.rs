//! Surfaces that ask for something of their own: strands without normals, and things that the camera carries.

use super::support::{assert_valid, frame, pixels, rmse, scene::Scene, session, svgf, svgf_tuning, upload};
use atrous::executor::Session;
use atrous::reference::InstanceTransform;
use atrous::{Config, Counter, FrameParams};
use atrous_harness::DeviceTest;

pub const TESTS: &[DeviceTest] = &[
    ("where_there_is_no_normal_depth_and_id_decide", where_there_is_no_normal_depth_and_id_decide),
    ("what_the_camera_carries_keeps_its_history", what_the_camera_carries_keeps_its_history),
];

const EXTENT: [u32; 2] = [48, 32];

fn counted(s: &mut Session, counter: Counter) -> u32 {
    s.download("statistics").expect("counters")[counter as usize][0] as u32
}

/// Blades of grass: normals of any direction, another one in every frame, or none.
fn where_there_is_no_normal_depth_and_id_decide() {
    let scene = Scene { speed: 0.05, ..Scene::new(EXTENT) };
    let [mut random, mut none] = [0, 1].map(|_| session(&svgf(EXTENT)));
    let mut errors = [0.0; 2];
    for i in 0..6 {
        let guides = scene.frame(i, i);
        for ((s, error), has_normals) in [&mut random, &mut none].into_iter().zip(&mut errors).zip([true, false]) {
            let mut guides = guides.clone();
            for (k, normal) in guides.normal.iter_mut().enumerate() {
                let angle = (k as f32 * 2.4 + i as f32 * 1.7) % 6.3;
                *normal = if has_normals { [angle.sin(), 0.3, angle.cos(), 0.0] } else { [0.0; 4] };
            }
            let (_, denoised) = frame(s, &guides, &scene.params(i), &svgf_tuning());
            *error = rmse(&denoised, &guides.clean);
        }
        assert_eq!(counted(&mut none, Counter::LostNormal), 0, "frame {i}");
        assert_eq!(counted(&mut none, Counter::Normal), 0, "frame {i}: none is no bad one");
    }
    let [random, none] = errors;
    assert!(none < 0.6 * random, "error without normals {none}, with random ones {random}");
    assert_valid();
}

const WEAPON: u32 = 3;

/// Places of a thing that the camera carries: the inverse of the previous view, times the view of this frame, which only moves here.
fn carried(now: &FrameParams, before: &FrameParams) -> InstanceTransform {
    let moved: [f32; 3] = std::array::from_fn(|i| now.view_from_world[3][i] - before.view_from_world[3][i]);
    std::array::from_fn(|i| std::array::from_fn(|j| if j == 3 { moved[i] } else { f32::from(u8::from(i == j)) }))
}

/// A weapon before a scene that slides, by the matrices and a transform of its own.
fn what_the_camera_carries_keeps_its_history() {
    let scene = Scene { speed: 0.25, ..Scene::new(EXTENT) };
    let is_weapon = |x: u32, y: u32| (18..34).contains(&x) && y >= 16;
    let identity: InstanceTransform = std::array::from_fn(|i| std::array::from_fn(|j| f32::from(u8::from(i == j))));
    for has_transform in [true, false] {
        let mut s = session(&Config { reactive_mask: true, ..svgf(EXTENT) });
        for i in 0..5 {
            let mut guides = scene.frame(i, i);
            for (k, _) in pixels(EXTENT).enumerate().filter(|(_, (x, y))| is_weapon(*x, *y)) {
                guides.depth[k] = [0.5; 4];
                guides.normal[k] = [0.0, 0.0, 1.0, 0.0];
                guides.surface_id[k] = WEAPON;
            }
            let (now, before) = (scene.params(i), scene.params(i.saturating_sub(1)));
            let of_weapon = if has_transform { carried(&now, &before) } else { identity };
            let transforms = [identity, identity, identity, of_weapon];
            s.upload_buffer("instance_transforms", bytemuck::cast_slice(&transforms)).expect("instance_transforms");
            upload(&mut s, &guides);
            s.unbind("motion").expect("optional");
            s.run(&now, &svgf_tuning()).expect("a frame");
            // The share that is new: 1 of as many frames as there are.
            let mask = s.download("reactive_mask").expect("output");
            let new = pixels(EXTENT).zip(&mask).filter(|((x, y), _)| is_weapon(*x, *y)).map(|(_, texel)| texel[0]);
            let new: Vec<f32> = new.collect();
            let mean = new.iter().sum::<f32>() / new.len() as f32;
            let expected = 1.0 / (i + 1) as f32;
            let is_kept = new.iter().all(|share| (share - expected).abs() < 1e-3);
            assert!(i == 0 || is_kept == has_transform, "transform: {has_transform}, frame {i}: {mean} instead of {expected}");
            assert!(i == 0 || has_transform || mean > expected + 0.1, "frame {i}: {mean}");
        }
    }
    assert_valid();
}
