//! Accepted graphs on the CPU.

use atrous::reference::Engine;
use atrous::{Component, Declaration, FrameParams, ImageFormat, Lifetime, Shape, Tuning, UseFrame};

/// Three frames of two declarations of one graph, the first with transients that are gone behind their last use. All outputs are
/// finite, and the same.
pub fn run(declaration: &Declaration, apart: &Declaration) {
    let mut engine = Engine::new(declaration.clone()).expect("an engine");
    let mut keeping = Engine::new(apart.clone()).expect("an engine").keep_transients();
    let views = declaration.debug_views();
    for frame in 0..3 {
        let debug_view = views.get(frame % views.len().max(1)).copied();
        let params = FrameParams { debug_view, reshaded: frame == 1, ..FrameParams::new(declaration.allocated_extent()) };
        for engine in [&mut engine, &mut keeping] {
            give(engine, frame);
            engine.run(&params, &Tuning::default()).expect("a frame");
        }
        for output in declaration.resources().iter().filter(|r| r.lifetime == Lifetime::Output) {
            // Without a view nothing draws one.
            let Ok(texels) = engine.texels(&output.name, UseFrame::Current) else { continue };
            assert!(texels.to_floats().iter().flatten().all(|v| v.is_finite()), "{} is not finite", output.name);
            let kept = keeping.texels(&output.name, UseFrame::Current).expect("the same outputs");
            assert!(texels == kept, "{} in frame {frame} depends on what nothing wrote in it", output.name);
        }
    }
}

/// The inputs of a frame: noise on a wall that stands still.
fn give(engine: &mut Engine, frame: usize) {
    let declaration = engine.declaration().clone();
    for resource in declaration.resources() {
        let (Lifetime::Input { .. }, Shape::Image { format, .. }) = (resource.lifetime, resource.shape) else { continue };
        let extent = resource.extent(declaration.setup()).expect("an image");
        let count = extent[0] as usize * extent[1] as usize;
        let noise = |i: usize| ((i * 7 + frame * 3) % 11) as f32 / 16.0;
        let texels: Vec<_> = match resource.name.as_str() {
            name if name.contains("motion") => vec![[0.0; 4]; count],
            name if name.starts_with("noisy") => (0..count).map(|i| [0.25 + noise(i), 0.5, noise(i), 1.0]).collect(),
            _ => vec![[0.5; 4]; count],
        };
        match format {
            ImageFormat::Any(Component::Uint, _) => engine.upload_ids(&resource.name, &vec![1; count]),
            _ => engine.upload(&resource.name, &texels),
        }
        .unwrap_or_else(|error| panic!("{}: {error}", resource.name));
    }
}
