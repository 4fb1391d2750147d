//! Motion vectors and camera matrices agree.

use atrous_engine::scene::mirror_moving::{MIRROR, MOVERS};
use atrous_engine::testing::{built_in, render, tracer, Validated, SMALL};
use atrous_engine::{Camera, SceneOptions, TracerOptions};
use glam::{Mat4, Vec3, Vec4};

fn matrices(camera: &Camera) -> (Mat4, Mat4) {
    (Mat4::from_cols_array_2d(&camera.view_from_world), Mat4::from_cols_array_2d(&camera.clip_from_view))
}

/// Pixel position and linear depth of a world-space point.
fn project(camera: &Camera, world: Vec3) -> Vec3 {
    let (view_from_world, clip_from_view) = matrices(camera);
    let view = view_from_world * world.extend(1.0);
    let clip = clip_from_view * view;
    let ndc = clip.truncate() / clip.w;
    Vec3::new((0.5 + 0.5 * ndc.x) * SMALL.width as f32, (0.5 + 0.5 * ndc.y) * SMALL.height as f32, -view.z)
}

/// The point that a pixel's centre sees at a linear depth.
fn unproject(camera: &Camera, pixel: usize, depth: f32) -> Vec3 {
    let (view_from_world, clip_from_view) = matrices(camera);
    let (x, y) = (pixel as u32 % SMALL.width, pixel as u32 / SMALL.width);
    let position = [x as f32 + 0.5 + camera.jitter[0], y as f32 + 0.5 + camera.jitter[1]];
    let ndc = Vec4::new(position[0] / SMALL.width as f32 * 2.0 - 1.0, position[1] / SMALL.height as f32 * 2.0 - 1.0, 1.0, 1.0);
    let ray = clip_from_view.inverse() * ndc;
    let view = ray.truncate() / -ray.z * depth;
    view_from_world.inverse().transform_point3(view)
}

/// Checks motion against the matrices, with `moved` giving where a point of a surface was before.
fn check_motion(name: &str, options: TracerOptions, frame: u32, moved: impl Fn(u32, Vec3) -> Vec3) {
    let Some(gpu) = Validated::new() else { return };
    let mut tracer = tracer(&gpu, &built_in(name, SceneOptions::default()), options);
    render(&gpu, &mut tracer, frame);
    let (now, before) = (tracer.camera(frame), tracer.camera(frame - 1));
    let depth = gpu.0.read_image(&tracer.outputs().depth).expect("depth");
    let motion = gpu.0.read_image(&tracer.outputs().motion).expect("motion");
    let ids = gpu.0.read_image_u32(&tracer.outputs().surface_id).expect("ids");
    let mut largest: f32 = 0.0;
    for (pixel, id) in ids.iter().enumerate().filter(|(_, id)| **id != 0) {
        let world = unproject(&now, pixel, depth[pixel][0]);
        let expected = project(&before, moved(*id, world));
        let start = project(&now, world);
        let given = Vec3::from_slice(&motion[pixel]);
        let expected = Vec3::new(expected.x - start.x, expected.y - start.y, expected.z);
        let bound = 2e-3 * (1.0 + expected.z);
        assert!((given - expected).abs().max_element() < bound, "{name}, pixel {pixel}: {given}, expected {expected}");
        largest = largest.max(expected.truncate().length());
    }
    assert!(largest > 0.01, "{name}: nothing moves, so nothing was tested");
}

#[test]
fn motion_of_still_things_follows_the_camera() {
    check_motion("cornell", TracerOptions::default(), 9, |_, world| world);
    check_motion("hall", TracerOptions { jitter: true, ..Default::default() }, 4, |_, world| world);
}

#[test]
fn motion_of_moving_things_follows_them() {
    // Floor, wall and panel are 1 to 3; the pillars go right by 1.2 units a second.
    check_motion("pillars", TracerOptions::default(), 6, |id, world| if id <= 3 { world } else { world - Vec3::X * 1.2 / 30.0 });
}

#[test]
fn still_pictures_have_no_motion_at_all() {
    let Some(gpu) = Validated::new() else { return };
    let options = SceneOptions { static_light: false, static_camera: true, static_objects: true };
    let mut tracer = tracer(&gpu, &built_in("glossy", options), TracerOptions::default());
    render(&gpu, &mut tracer, 5);
    let motion = gpu.0.read_image(&tracer.outputs().motion).expect("motion");
    assert!(motion.iter().all(|m| m[0] == 0.0 && m[1] == 0.0));
}

/// The hit distance along the mirrored line of sight leads to the ball whose id the pixel has, as far as the lobe is narrow.
#[test]
fn hit_ids_and_distances_lead_to_the_thing_in_a_mirror() {
    let Some(gpu) = Validated::new() else { return };
    let scene = built_in("mirror_moving", SceneOptions::default());
    let mut tracer = tracer(&gpu, &scene, TracerOptions::default());
    let (mut met, mut mirrored) = (0, 0);
    for frame in 1..12 {
        render(&gpu, &mut tracer, frame);
        let (camera, outputs) = (tracer.camera(frame), tracer.outputs());
        let [depth, normal, distance] =
            [&outputs.depth, &outputs.normal, &outputs.hit_distance].map(|image| gpu.0.read_image(image).expect("texels"));
        let [ids, hits] = [&outputs.surface_id, &outputs.hit_id].map(|image| gpu.0.read_image_u32(image).expect("ids"));
        let eye = matrices(&camera).0.inverse().transform_point3(Vec3::ZERO);
        let ball = Vec3::from(scene.transforms(scene.moment(frame).object_time)[MOVERS[0] as usize - 1].translation);
        for pixel in (0..ids.len()).filter(|pixel| ids[*pixel] == MIRROR && hits[*pixel] == MOVERS[0]) {
            let world = unproject(&camera, pixel, depth[pixel][0]);
            let direction = (world - eye).normalize().reflect(Vec3::from_slice(&normal[pixel]));
            let thing = world + direction * distance[pixel][0];
            mirrored += 1;
            met += u32::from((thing.distance(ball) - 0.35).abs() < 0.1);
        }
    }
    assert!(mirrored > 24, "{mirrored} pixels show the ball, so little was tested");
    assert!(10 * met >= 9 * mirrored, "{met} of {mirrored} lead to the ball");
}
