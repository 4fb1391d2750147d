//! A picture that is a part of the host's images, at another place in each frame.

use super::super::support::upload_part;
use super::*;

pub fn sequence(config: &Config) {
    let (extent, allocated, images) = ([37, 21], [40, 24], [61, 40]);
    let config = Config { allocated_extent: allocated, image_extent: Some(images), ..*config };
    let scene = Scene { speed: 0.12, allocated, ..Scene::new(extent) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for i in 0..4 {
        let viewport_origin = [7 * i, 19 - 5 * i];
        upload_part(&mut s, &scene.frame(i, i), viewport_origin);
        run(&mut s, &FrameParams { viewport_origin, ..scene.params(i) }, &Tuning::for_preset(config.preset));
    }
    assert_valid();
}
