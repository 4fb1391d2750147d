//! `import` in every encoding of a host's guides, and with transforms of instances.

use super::run;
use crate::support::{assert_valid, pixels, scene::Guides, scene::Scene, session_with, svgf, svgf_tuning};
use atrous::config::{
    Channel, Conventions, DepthEncoding, MotionDepth, MotionDirection, MotionUnit, NormalEncoding, NormalSpace, ViewForward,
};
use atrous::executor::SessionOptions;
use atrous::{Config, FrameParams};

/// The synthetic scene, re-encoded: every encoding of every guide at least once.
pub fn every_encoding() {
    let base = Conventions::default();
    let cases = [
        Conventions { depth: DepthEncoding::Device, motion_unit: MotionUnit::Pixels, ..base },
        Conventions { depth: DepthEncoding::RayLength, motion_unit: MotionUnit::Ndc, normal: NormalEncoding::XyzUnorm, ..base },
        Conventions { normal: NormalEncoding::Octahedral, motion_direction: MotionDirection::CurrentMinusPrevious, ..base },
        Conventions { normal: NormalEncoding::OctahedralUnorm, motion_y_up: true, motion_jittered: true, ..base },
        Conventions { normal_space: NormalSpace::View, motion_depth: MotionDepth::Difference, ..base },
        Conventions { motion_depth: MotionDepth::Absolute, background_depth: 5.9, ..base },
        Conventions { view_forward: ViewForward::PositiveZ, ..base },
        Conventions { motion_unit: MotionUnit::Pixels, motion_scale: 50.0, roughness_channel: Channel::A, ..base },
    ];
    for conventions in cases {
        for with_motion in [true, false] {
            encoded(conventions, with_motion);
        }
    }
    assert_valid();
}

/// Motion from the matrices and a transform per instance: a turning ball, a wall with an unusable transform, and ids beyond the
/// buffer.
pub fn instance_transforms() {
    let scene = Scene { speed: 0.1, ..Scene::new([41, 23]) };
    let config = svgf(scene.extent);
    let still = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let (sin, cos) = 0.2f32.sin_cos();
    let turned = [[cos, 0.0, sin, 0.6], [0.0, 1.0, 0.0, -0.1], [-sin, 0.0, cos, -0.3]];
    let unusable = [[f32::NAN; 4]; 3];
    for transforms in [vec![still, still, turned], vec![still, unusable, turned], vec![still, [[0.0; 4]; 3], turned], vec![still]] {
        let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
        s.upload_buffer("instance_transforms", bytemuck::cast_slice(&transforms)).expect("transforms");
        for i in 0..3 {
            let g = scene.frame(i, i);
            for (name, texels) in g.images().into_iter().filter(|(n, _)| ["depth", "normal", "noisy_radiance"].contains(n)) {
                s.upload(name, texels).expect(name);
            }
            s.upload_ids("surface_id", &g.surface_id).expect("surface_id");
            run(&mut s, &scene.params(i), &svgf_tuning());
        }
    }
    assert_valid();
}

fn encoded(conventions: Conventions, with_motion: bool) {
    let scene = Scene { speed: 0.15, ..Scene::new([41, 23]) };
    let config = Config { conventions, ..svgf(scene.extent) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    let roughness: Vec<_> = pixels(scene.extent).map(|(x, y)| [0.9, 0.8, 0.7, (x + y) as f32 / 64.0]).collect();
    s.upload("roughness", &roughness).expect("roughness");
    for i in 0..2 {
        let params = FrameParams { jitter: [0.25 - 0.6 * i as f32, 0.4 * i as f32 - 0.4], ..params(&scene, i, &conventions) };
        let mut g = scene.frame(i, i);
        encode(&mut g, &scene, &params, &conventions);
        for (name, texels) in g.images().into_iter().filter(|(n, _)| ["depth", "normal", "noisy_radiance"].contains(n)) {
            s.upload(name, texels).expect(name);
        }
        if with_motion {
            s.upload("motion", &g.motion).expect("motion");
        }
        s.upload_ids("surface_id", &g.surface_id).expect("surface_id");
        run(&mut s, &params, &svgf_tuning());
    }
}

fn params(scene: &Scene, index: u32, conventions: &Conventions) -> FrameParams {
    let mut params = scene.params(index);
    if conventions.view_forward == ViewForward::PositiveZ {
        // The same camera with z turned round, in view and in projection.
        params.view_from_world.iter_mut().for_each(|column| column[2] = -column[2]);
        params.clip_from_view[2].iter_mut().for_each(|v| *v = -*v);
    }
    params
}

fn encode(g: &mut Guides, scene: &Scene, params: &FrameParams, c: &Conventions) {
    let clip = params.clip_from_view;
    for (i, (x, y)) in pixels(scene.extent).enumerate() {
        let z = g.depth[i][0];
        g.depth[i][0] = match c.depth {
            DepthEncoding::Linear => z,
            DepthEncoding::Device if z == 0.0 => 1.0,
            DepthEncoding::Device => (clip[2][2] * -z + clip[3][2]) / z,
            DepthEncoding::RayLength => {
                let ndc = |p: u32, k: usize| (p as f32 + 0.5 + params.jitter[k]) / scene.extent[k] as f32 * 2.0 - 1.0;
                let v = [ndc(x, 0) / clip[0][0], ndc(y, 1) / clip[1][1]];
                z * (v[0] * v[0] + v[1] * v[1] + 1.0).sqrt()
            }
        };
        let [nx, ny, nz, _] = g.normal[i];
        let e = octahedral([nx, ny, nz]);
        g.normal[i] = match c.normal {
            NormalEncoding::Xyz => [nx, ny, nz, 0.0],
            NormalEncoding::XyzUnorm => [0.5 * nx + 0.5, 0.5 * ny + 0.5, 0.5 * nz + 0.5, 0.0],
            NormalEncoding::Octahedral => [e[0], e[1], 0.0, 0.0],
            NormalEncoding::OctahedralUnorm => [0.5 * e[0] + 0.5, 0.5 * e[1] + 0.5, 0.0, 0.0],
        };
        g.motion[i][2] = if c.motion_depth == MotionDepth::Absolute { z } else { 0.01 * (i % 7) as f32 };
        if c.motion_unit == MotionUnit::Pixels {
            g.motion[i][0] *= scene.extent[0] as f32;
        }
        g.motion[i][0] /= c.motion_scale;
    }
}

fn octahedral([x, y, z]: [f32; 3]) -> [f32; 2] {
    let sum = x.abs() + y.abs() + z.abs();
    if sum == 0.0 {
        return [0.0; 2];
    }
    let (x, y) = (x / sum, y / sum);
    let sign = |v: f32| if v >= 0.0 { 1.0 } else { -1.0 };
    if z < 0.0 {
        [(1.0 - y.abs()) * sign(x), (1.0 - x.abs()) * sign(y)]
    } else {
        [x, y]
    }
}
