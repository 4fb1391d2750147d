//! Depth, normals, gradients, background and bad values.

use super::*;
use crate::config::{Conventions, DepthEncoding, NormalEncoding, NormalSpace, ViewForward};
use crate::reference::test_scene::*;
use crate::reference::{unpack_guide, unpack_surface_motion, Image};
use crate::{Config, FrameParams};
use glam::{Mat4, Quat, Vec2, Vec4};

const EXTENT: [u32; 2] = [8, 6];

fn with_conventions(conventions: Conventions, params: FrameParams) -> FrameConstants {
    let config = Config { conventions, ..Config::new(params.render_extent) };
    frame_with(&config, &params, &params)
}

fn up(extent: [u32; 2]) -> Image<[f32; 4]> {
    Image::new(extent, [0.0, 1.0, 0.0, 0.0])
}

/// Every kind of projection, looking along −z, with the depth row as (P22, P23, P32, P33).
fn projections() -> [(&'static str, Mat4); 4] {
    let (near, far) = (0.1, 100.0);
    let with = |p22: f32, p23: f32, p32: f32, p33: f32| {
        let columns = [Vec4::new(0.75, 0.0, 0.0, 0.0), Vec4::new(0.0, -1.0, 0.0, 0.0), Vec4::new(0.1, 0.05, p22, p32)];
        Mat4::from_cols(columns[0], columns[1], columns[2], Vec4::new(0.0, 0.0, p23, p33))
    };
    [
        ("standard", with(far / (near - far), near * far / (near - far), -1.0, 0.0)),
        ("reversed", with(near / (far - near), near * far / (far - near), -1.0, 0.0)),
        ("infinite reversed", with(0.0, near, -1.0, 0.0)),
        ("orthographic", with(1.0 / (near - far), near / (near - far), 0.0, 1.0)),
    ]
}

#[test]
fn every_depth_encoding_gives_the_linear_depth() {
    let z = 7.5;
    for (name, looking_back) in projections() {
        for (view_forward, sign) in [(ViewForward::NegativeZ, -1.0), (ViewForward::PositiveZ, 1.0)] {
            let projection = looking_back * Mat4::from_scale(Vec3::new(1.0, 1.0, -sign));
            for depth in [DepthEncoding::Linear, DepthEncoding::Device, DepthEncoding::RayLength] {
                let params =
                    FrameParams { clip_from_view: projection.to_cols_array_2d(), jitter: [0.3, -0.2], ..FrameParams::new(EXTENT) };
                let frame = with_conventions(Conventions { depth, view_forward, ..Conventions::default() }, params);
                let device = projection.project_point3(Vec3::new(0.0, 0.0, sign * z)).z;
                let depths = paint(EXTENT, |x, y| {
                    let sample = Vec2::new(x as f32 + 0.8, y as f32 + 0.3) / Vec2::new(8.0, 6.0) * 2.0 - 1.0;
                    let on_ray = |device: f32| projection.inverse().project_point3(sample.extend(device));
                    let d = match depth {
                        DepthEncoding::Linear => z,
                        DepthEncoding::Device => device,
                        // An orthographic line of sight starts beside the view axis.
                        DepthEncoding::RayLength if name == "orthographic" => {
                            let (near, here) = (on_ray(0.0), on_ray(device));
                            near.distance(here) * z / (near.z - here.z).abs()
                        }
                        DepthEncoding::RayLength => on_ray(device).length(),
                    };
                    [d, 9.0, 9.0, 9.0]
                });
                let imported = import(&frame, &ImportInputs::new(&depths, &up(EXTENT)));
                for texel in imported.guide.texels() {
                    let given = unpack_guide(*texel).linear_depth;
                    assert!((given - z).abs() < 2e-3, "{name}, {depth:?}, {view_forward:?}: {given}");
                }
                assert_eq!(imported.statistics, Statistics::default());
            }
        }
    }
}

#[test]
fn background_is_recognised_and_packed_as_zeros() {
    let extent = [8, 1];
    let depths = [0.0, -1.0, f32::INFINITY, 50.0, 49.0, f32::NAN, 3.0, f32::NEG_INFINITY];
    let depth = paint(extent, |x, _| [depths[x as usize], 0.0, 0.0, 0.0]);
    let ids = paint(extent, |x, _| u32::from(x != 6));
    let frame = with_conventions(Conventions { background_depth: 50.0, ..Conventions::default() }, FrameParams::new(extent));
    let normal = Image::new(extent, [f32::NAN; 4]);
    let imported = import(&frame, &ImportInputs { surface_id: Some(&ids), ..ImportInputs::new(&depth, &normal) });
    for (x, texel) in imported.guide.texels().iter().enumerate() {
        assert_eq!(*texel == [0; 4], x != 4, "{}", depths[x]);
        assert_eq!(unpack_guide(*texel).is_background(), x != 4);
    }
    assert_eq!(unpack_guide(imported.guide.texels()[4]).id, 1);
    assert_eq!(unpack_guide(imported.guide.texels()[4]).gradient, [0.0; 2]);
    assert_eq!(
        imported.statistics,
        counted(&[(Counter::Depth, 1), (Counter::Normal, 1)]),
        "one depth; the normal of the one surface"
    );
}

#[test]
fn light_is_kept_apart_where_an_albedo_hardly_divides_or_is_unknown() {
    let albedos =
        [[0.0; 3], [0.02; 3], [0.03; 3], [0.0, 0.0, 0.5], [-1.0; 3], [7.0; 3], [f32::NAN, 0.0, 0.0], [0.0, f32::INFINITY, 0.0]];
    let extent = [albedos.len() as u32, 1];
    let albedo = paint(extent, |x, _| {
        let [r, g, b] = albedos[x as usize];
        [r, g, b, 1.0]
    });
    let (depth, normal) = (Image::new(extent, [3.0, 0.0, 0.0, 0.0]), up(extent));
    let inputs = ImportInputs::new(&depth, &normal);
    let imported = import(&frame(extent), &ImportInputs { albedo: Some(&albedo), ..inputs });
    let apart: Vec<bool> = imported.guide.texels().iter().map(|texel| unpack_guide(*texel).is_apart).collect();
    assert_eq!(apart, [true, true, false, false, true, false, true, true]);
    assert!(imported.guide.texels().iter().all(|texel| unpack_guide(*texel).linear_depth == 3.0));
    assert!(import(&frame(extent), &inputs).guide.texels().iter().all(|texel| !unpack_guide(*texel).is_apart));
}

#[test]
fn a_device_depth_of_infinity_is_background() {
    let [_, _, (_, projection), _] = projections();
    let params = FrameParams { clip_from_view: projection.to_cols_array_2d(), ..FrameParams::new([2, 1]) };
    let frame = with_conventions(Conventions { depth: DepthEncoding::Device, ..Conventions::default() }, params);
    let depth = paint([2, 1], |x, _| [if x == 0 { 0.0 } else { f32::INFINITY }, 0.0, 0.0, 0.0]);
    let imported = import(&frame, &ImportInputs::new(&depth, &up([2, 1])));
    assert_eq!(imported.guide.texels(), &[[0; 4]; 2]);
    assert_eq!(imported.statistics, Statistics::default());
}

#[test]
fn every_normal_encoding_gives_the_world_normal() {
    let turn = Quat::from_euler(glam::EulerRot::XYZ, 0.4, -1.1, 0.3);
    let params = FrameParams { view_from_world: Mat4::from_quat(turn).to_cols_array_2d(), ..FrameParams::new([1, 1]) };
    let world = [Vec3::X, Vec3::NEG_Z, Vec3::new(0.6, -0.64, 0.48), Vec3::new(-0.48, 0.6, -0.64)];
    for normal_space in [NormalSpace::World, NormalSpace::View] {
        for normal in [NormalEncoding::Xyz, NormalEncoding::XyzUnorm, NormalEncoding::Octahedral, NormalEncoding::OctahedralUnorm] {
            let frame = with_conventions(Conventions { normal, normal_space, ..Conventions::default() }, params);
            for n in world {
                let given = if normal_space == NormalSpace::View { turn * n } else { n };
                let square = crate::reference::octahedral::to_square(given);
                let [x, y, z] = match normal {
                    NormalEncoding::Xyz => (given * 0.01).to_array(),
                    NormalEncoding::XyzUnorm => (given * 0.5 + 0.5).to_array(),
                    NormalEncoding::Octahedral => [square.x, square.y, 7.0],
                    NormalEncoding::OctahedralUnorm => [square.x * 0.5 + 0.5, square.y * 0.5 + 0.5, 7.0],
                };
                let (depth, image) = (Image::new([1, 1], [2.0; 4]), Image::new([1, 1], [x, y, z, 0.0]));
                let imported = import(&frame, &ImportInputs::new(&depth, &image));
                let read = Vec3::from(unpack_guide(imported.guide.texels()[0]).normal);
                // Half a step of each component.
                assert!((read - n).abs().max_element() < 0.51 / 127.0, "{normal:?} {normal_space:?}: {read} for {n}");
                assert_eq!(imported.statistics, Statistics::default());
            }
        }
    }
}

#[test]
fn a_normal_without_direction_faces_the_camera() {
    let bad = [[0.0; 4], [1e-5, 0.0, 0.0, 0.0], [f32::NAN, 0.0, 0.0, 0.0], [0.0, f32::INFINITY, 0.0, 0.0], [1e30; 4]];
    for (view_forward, expected) in [(ViewForward::NegativeZ, Vec3::X), (ViewForward::PositiveZ, Vec3::NEG_X)] {
        // +z of view space is +x of the world.
        let view_from_world = Mat4::from_rotation_y(-std::f32::consts::FRAC_PI_2).to_cols_array_2d();
        let params = FrameParams { view_from_world, ..FrameParams::new([5, 1]) };
        let frame = with_conventions(Conventions { view_forward, ..Conventions::default() }, params);
        let normal = paint([5, 1], |x, _| bad[x as usize]);
        let imported = import(&frame, &ImportInputs::new(&Image::new([5, 1], [1.0; 4]), &normal));
        for texel in imported.guide.texels() {
            assert!(Vec3::from(unpack_guide(*texel).normal).distance(expected) < 1e-3, "{:?}", unpack_guide(*texel));
        }
        assert_eq!(imported.statistics[Counter::Normal], 3);
    }
}

#[test]
fn the_gradient_of_a_plane_is_its_slope_up_to_the_border() {
    let depth = paint(EXTENT, |x, y| [5.0 + 0.5 * x as f32 - 0.25 * y as f32, 0.0, 0.0, 0.0]);
    let imported = import(&frame(EXTENT), &ImportInputs::new(&depth, &up(EXTENT)));
    for surface in imported.guide.texels().iter().map(|texel| unpack_guide(*texel)) {
        let [x, y] = surface.gradient;
        // Stored in steps of an eighth of the sum, and of a 32nd of it aside.
        assert!((x - y - 0.75).abs() < 0.0951 && (x / (x - y) - 2.0 / 3.0).abs() < 0.0157, "{surface:?}");
    }
}

#[test]
fn the_gradient_does_not_look_across_a_step_or_the_background() {
    let extent = [6, 1];
    // Slopes of 1 and of 1/2, which the guide keeps as they are.
    let depths = [1.0, 2.0, 128.0, 64.0, 0.0, 4.0];
    let depth = paint(extent, |x, _| [depths[x as usize]; 4]);
    let normal = up(extent);
    let plain = import(&frame(extent), &ImportInputs::new(&depth, &normal));
    let along =
        |image: &ImportOutputs| image.guide.texels().iter().map(|texel| unpack_guide(*texel).gradient[0]).collect::<Vec<_>>();
    assert_eq!(along(&plain), [1.0, 1.0, -64.0, -64.0, 0.0, 0.0]);
    // An object that is as deep as its neighbour is no step: the ids of neighbours are not asked for.
    let ids = paint(extent, |x, _| if x == 0 { 300 } else { 301 });
    let apart = import(&frame(extent), &ImportInputs { surface_id: Some(&ids), ..ImportInputs::new(&depth, &normal) });
    assert_eq!(along(&apart), along(&plain));
}

#[test]
fn equal_differences_of_opposite_sign_take_the_forward_one() {
    let depth = paint([3, 1], |x, _| [if x == 1 { 4.0 } else { 3.0 }; 4]);
    let imported = import(&frame([3, 1]), &ImportInputs::new(&depth, &up([3, 1])));
    assert_eq!(unpack_guide(imported.guide.texels()[1]).gradient, [-1.0, 0.0]);
}

#[test]
fn ids_reach_the_guide_and_bad_roughness_is_counted() {
    let (depth, normal) = (Image::new([5, 1], [1.0; 4]), up([5, 1]));
    // -1 is not known, and not bad.
    let given = [0.2, -3.0, 7.0, f32::NAN, -1.0];
    let roughness = paint([5, 1], |x, _| [given[x as usize]; 4]);
    let ids = paint([5, 1], |x, _| 254 + x as u32);
    let full = ImportInputs { roughness: Some(&roughness), surface_id: Some(&ids), ..ImportInputs::new(&depth, &normal) };
    let imported = import(&frame([5, 1]), &full);
    for (i, texel) in imported.guide.texels().iter().enumerate() {
        assert_eq!(unpack_guide(*texel).id, fold_id(254 + i as u32));
    }
    assert_eq!(imported.statistics[Counter::Roughness], 3);
    let bare = import(&frame([5, 1]), &ImportInputs::new(&depth, &normal)).guide.map(|t| unpack_guide(*t));
    assert!(bare.texels().iter().all(|s| s.id == 1));
}

#[test]
fn no_bad_value_reaches_an_output() {
    let values = [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 3e38, -3e38, 1e-40, 0.0, 1.0];
    let extent = [64, 8];
    let pick = |shift: u32| {
        paint(extent, move |x, y| [0, 3, 6, 9].map(|k| values[((x as u32 >> shift) + y as u32 * (k + 1)) as usize % 8]))
    };
    let (depth, normal, motion, roughness) = (pick(0), pick(3), pick(1), pick(2));
    let ids = paint(extent, |x, y| [0, 1, 2, 77, u32::MAX][(x + y) as usize % 5]);
    let transforms = [[[1.0; 4]; 3], [[f32::NAN; 4]; 3], [[3e38, f32::INFINITY, 0.0, 1.0]; 3]];
    let optional = ImportInputs {
        motion: Some(&motion),
        surface_id: Some(&ids),
        roughness: Some(&roughness),
        instance_transforms: Some(&transforms),
        ..ImportInputs::new(&depth, &normal)
    };
    for flags in 0..1 << 14 {
        if flags % 37 != 0 {
            continue;
        }
        let frame = FrameConstants { flags, clip_from_view: camera(extent, Vec3::ZERO).clip_from_view, ..frame(extent) };
        for inputs in [optional, ImportInputs::new(&depth, &normal)] {
            let imported = import(&frame, &inputs);
            for texel in imported.guide.texels() {
                let surface = unpack_guide(*texel);
                let numbers = [surface.normal.as_slice(), &surface.gradient, &[surface.linear_depth]].concat();
                assert!(numbers.iter().all(|x| x.is_finite()), "{surface:?}");
            }
            for texel in imported.surface_motion.texels() {
                let motion = unpack_surface_motion(*texel);
                assert!(motion.motion.iter().chain([&motion.depth_ratio]).all(|m| m.is_finite()), "{motion:?}");
            }
            let has_motion = inputs.motion.is_some();
            assert_eq!(imported.statistics[Counter::Motion] > 0, has_motion);
            assert!(imported.statistics[Counter::Depth] > 0 && imported.statistics[Counter::Normal] > 0);
        }
    }
}

#[test]
fn a_render_rect_gives_the_bits_of_a_tight_image() {
    let large = [19, 11];
    let depth = noise(EXTENT, 1).map(|t| t.map(|v| v + 1.0));
    let (normal, motion) = (noise(EXTENT, 2).map(|t| [t[0] - 0.5, t[1], 0.4, 0.0]), noise(EXTENT, 3));
    let tight = import(&frame(EXTENT), &ImportInputs { motion: Some(&motion), ..ImportInputs::new(&depth, &normal) });
    let [depth, normal, motion] = [depth, normal, motion].map(|image| embed(&image, large, [f32::NAN; 4]));
    let loose = import(&frame(EXTENT), &ImportInputs { motion: Some(&motion), ..ImportInputs::new(&depth, &normal) });
    assert_eq!(embed(&tight.guide, large, [0; 4]), loose.guide);
    assert_eq!(embed(&tight.surface_motion, large, [0; 4]), loose.surface_motion);
    assert_eq!(tight.statistics, loose.statistics);
}
