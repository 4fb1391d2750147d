//! What is seen through glass and in it, and lights that it colours.

use ash::vk::Extent2D;
use atrous_engine::scene::vitrine::{BALL, PANE};
use atrous_engine::testing::{built_in, mean, render, rgb, Validated};
use atrous_engine::{GlassShown, PathTracer, SceneOptions, TracerOptions};

const EXTENT: Extent2D = Extent2D { width: 60, height: 34 };

fn tracer(gpu: &Validated, glass: GlassShown, options: SceneOptions) -> PathTracer {
    let scene = built_in("vitrine", options);
    PathTracer::new(&gpu.0, &scene, EXTENT, TracerOptions { glass, ..TracerOptions::default() }).expect("a path tracer")
}

/// The picture of one frame is the same, however it is split; what is seen through glass and its reflection add up to it.
#[test]
fn all_ways_to_show_glass_are_one_picture() {
    let Some(gpu) = Validated::new() else { return };
    let picture = |glass| {
        let mut tracer = tracer(&gpu, glass, SceneOptions::default());
        render(&gpu, &mut tracer, 3);
        let outputs = tracer.outputs();
        let [scattered, emission] =
            [&outputs.scattered, &outputs.emission].map(|image| rgb(gpu.0.read_image(image).expect("light")));
        let reference = mean(&tracer.render_reference(64, |_, _| ()).expect("a reference").radiance());
        (mean(&scattered) + mean(&emission), reference)
    };
    let [itself, layers, through, reflection] =
        [GlassShown::Itself, GlassShown::Layers, GlassShown::Through, GlassShown::Reflection].map(picture);
    assert!(reflection.1 > 0.01 * itself.1, "glass mirrors next to nothing: {reflection:?}");
    assert!((itself.0 / layers.0 - 1.0).abs() < 1e-4, "{itself:?} {layers:?}");
    assert!((itself.1 / layers.1 - 1.0).abs() < 1e-4, "{itself:?} {layers:?}");
    assert!(((through.1 + reflection.1) / itself.1 - 1.0).abs() < 0.01, "{through:?} {reflection:?} {itself:?}");
}

/// The place that motion leads to showed the same thing at the depth that motion says, through the pane, through the ball and in both.
#[test]
fn motion_leads_to_where_glass_showed_the_same_point() {
    let Some(gpu) = Validated::new() else { return };
    for (shown, id) in [(GlassShown::Through, PANE), (GlassShown::Through, BALL), (GlassShown::Reflection, PANE)] {
        let mut itself = tracer(&gpu, GlassShown::Itself, SceneOptions::default());
        let mut tracer = tracer(&gpu, shown, SceneOptions::default());
        let read = |tracer: &PathTracer| {
            let outputs = tracer.outputs();
            let texels = |image| gpu.0.read_image(image).expect("texels");
            (texels(&outputs.depth), gpu.0.read_image_u32(&outputs.surface_id).expect("ids"), texels(&outputs.motion))
        };
        render(&gpu, &mut tracer, 4);
        let (depth, ids, _) = read(&tracer);
        render(&gpu, &mut tracer, 5);
        let (_, now, motion) = read(&tracer);
        render(&gpu, &mut itself, 5);
        let glass = gpu.0.read_image_u32(&itself.outputs().surface_id).expect("ids");
        let (width, height) = (EXTENT.width as i32, EXTENT.height as i32);
        let (mut found, mut looked, mut moved) = (0, 0, 0.0_f32);
        for p in (0..glass.len()).filter(|p| glass[*p] == id && now[*p] != 0) {
            let (x, y) = (p as i32 % width, p as i32 / width);
            let to = [x as f32 + motion[p][0], y as f32 + motion[p][1]].map(|v| v.round() as i32);
            if (0..width).contains(&to[0]) && (0..height).contains(&to[1]) {
                let before = (to[1] * width + to[0]) as usize;
                looked += 1;
                moved = moved.max(motion[p][0].abs());
                found += u32::from(ids[before] == now[p] && (depth[before][0] / motion[p][2] - 1.0).abs() < 0.03);
            }
        }
        assert!(looked > 40 && moved > 0.1, "{looked} pixels that move by {moved} at most are too little to look at");
        assert!(10 * found >= 8 * looked, "{shown:?} {id}: {found} of {looked} are where motion leads to");
    }
}

#[test]
fn nothing_moves_in_glass_where_nothing_moves() {
    let Some(gpu) = Validated::new() else { return };
    for shown in [GlassShown::Through, GlassShown::Reflection] {
        let mut tracer = tracer(&gpu, shown, SceneOptions { static_camera: true, static_objects: true, static_light: false });
        render(&gpu, &mut tracer, 5);
        let motion = gpu.0.read_image(&tracer.outputs().motion).expect("motion");
        assert!(motion.iter().all(|m| m[0] == 0.0 && m[1] == 0.0), "{shown:?}");
    }
}
