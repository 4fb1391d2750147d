//! Specular light with what hosts leave out, and at resolutions that change.

use super::super::support::{assert_valid, scene::Scene, session_with, svgf, svgf_tuning, upload};
use super::run;
use atrous::config::{Channel, Conventions, Preset, RoughnessEncoding, Signals};
use atrous::executor::SessionOptions;
use atrous::reference::InstanceTransform;
use atrous::{Config, Counter, Tuning};

/// A reflectance at normal incidence in the place of an albedo, GGX's α in the place of the roughness, and no hit distance at first.
pub fn by_f0() {
    let conventions =
        Conventions { roughness: RoughnessEncoding::Alpha, roughness_channel: Channel::G, demodulated: true, ..Default::default() };
    let config = Config { signals: Signals::Specular, preset: Preset::Best, conventions, ..Config::new([40, 23]) };
    let scene = Scene { speed: 0.12, ..Scene::new([40, 23]) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for i in 0..4 {
        let guides = scene.frame(i, i);
        upload(&mut s, &guides);
        let second: Vec<_> = guides.roughness.iter().map(|r| [f32::NAN, r[0], 0.0, 0.0]).collect();
        s.upload("roughness", &second).expect("roughness");
        s.upload("specular_f0", &guides.albedo).expect("specular_f0");
        s.unbind("specular_albedo").expect("optional");
        if i < 2 {
            s.unbind("specular_hit_distance").expect("optional");
        }
        run(&mut s, &scene.params(i), &Tuning::for_preset(config.preset));
    }
    assert_valid();
}

/// Neither hit distances nor roughness, as Blender has them: images are sought at infinity. In the end the roughness of half of the picture is known.
pub fn unknown_distances() {
    let config = Config { signals: Signals::Specular, preset: Preset::Best, ..Config::new([40, 23]) };
    let scene = Scene { speed: 0.12, ..Scene::new([40, 23]) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for i in 0..7 {
        let mut guides = scene.frame(i, i);
        guides.roughness.iter_mut().enumerate().filter(|(p, _)| p % 40 < 20).for_each(|(_, roughness)| *roughness = [-1.0; 4]);
        guides
            .specular_hit_distance
            .iter_mut()
            .enumerate()
            .filter(|(p, _)| p % 7 < 5)
            .for_each(|(_, distance)| *distance = [-1.0; 4]);
        upload(&mut s, &guides);
        if i < 6 {
            s.unbind("specular_hit_distance").expect("optional");
        }
        if i < 5 {
            s.unbind("roughness").expect("optional");
        }
        run(&mut s, &scene.params(i), &Tuning::for_preset(config.preset));
    }
    assert_valid();
}

/// Diffuse and specular light in one signal, at first without hit distances, and once without the albedo of the coat.
pub fn mixed_signal() {
    let extent = [36, 20];
    let config = Config { signals: Signals::Mixed, preset: Preset::Best, levels: Some(2), ..Config::new(extent) };
    let scene = Scene { speed: 0.12, ..Scene::new(extent) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for i in 0..4 {
        let mut guides = scene.frame(i, i);
        // Metal on the left, whose lobe explains all of the light.
        guides.albedo.iter_mut().enumerate().filter(|(p, _)| p % 32 < 16).for_each(|(_, albedo)| *albedo = [0.0; 4]);
        upload(&mut s, &guides);
        if i < 2 {
            s.unbind("specular_hit_distance").expect("optional");
        }
        if i == 1 {
            s.unbind("specular_albedo").expect("optional");
        }
        run(&mut s, &scene.params(i), &Tuning::for_preset(config.preset));
    }
    assert_valid();
}

pub fn other_resolutions() {
    let config = Config { signals: Signals::Specular, ..svgf([48, 36]) };
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for (i, extent) in (0..).zip([[48, 36], [31, 20], [40, 27], [48, 36]]) {
        let scene = Scene { speed: 0.12, allocated: [48, 36], ..Scene::new(extent) };
        upload(&mut s, &scene.frame(i, i));
        run(&mut s, &scene.params(i), &svgf_tuning());
    }
    assert_valid();
}

/// A thing that moves in mirrors that turn, transforms that none has, and ids that have none.
pub fn moving_reflections() {
    let config = Config { signals: Signals::Specular, preset: Preset::Best, ..Config::new([40, 23]) };
    let scene = Scene { speed: 0.12, ..Scene::new([40, 23]) };
    let identity: InstanceTransform = [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
    let moved = [[0.9998, -0.02, 0.0, 0.1], [0.02, 0.9998, 0.0, -0.05], [0.0, 0.0, 1.0, 0.02]];
    let bad = [[f32::NAN; 4]; 3];
    let tables: [&[InstanceTransform]; 4] =
        [&[identity, identity, moved], &[identity, moved, moved], &[identity, moved, bad], &[bad, identity]];
    let mut s = session_with(&config, SessionOptions { poison: true, keep_transients: true, ..Default::default() });
    for (i, table) in (0..).zip(tables.into_iter().cycle().take(6)) {
        let guides = scene.frame(i, i);
        upload(&mut s, &guides);
        let ids: Vec<u32> = (0..guides.depth.len() as u32).map(|k| (k / 5) % 4).collect();
        s.upload_ids("specular_hit_id", &ids).expect("specular_hit_id");
        s.upload_buffer("instance_transforms", bytemuck::cast_slice(table)).expect("instance_transforms");
        // By ids, then by the host as well.
        if i == 3 {
            assert!(s.statistics().expect("counters")[Counter::HitId] > 0);
        }
        if i > 2 {
            let motion: Vec<_> = (0..ids.len()).map(|k| [if k % 11 == 0 { f32::NAN } else { 0.05 }, 0.02, -0.1, 0.0]).collect();
            s.upload("specular_motion", &motion).expect("specular_motion");
        }
        run(&mut s, &scene.params(i), &Tuning::for_preset(config.preset));
    }
    assert!(s.statistics().expect("counters")[Counter::SpecularMotion] > 0);
    assert_valid();
}
