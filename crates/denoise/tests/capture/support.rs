//! The device that the tests share, and sessions on it.

use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions, Validation};
use atrous::{Config, Error};
use atrous_synthetic::scene::Guides;
use std::sync::{Arc, OnceLock};

static GPU: OnceLock<Result<Arc<HeadlessDevice>, Error>> = OnceLock::new();

/// The device, under validation.
pub fn try_gpu() -> Result<Arc<HeadlessDevice>, Error> {
    let open = || HeadlessDevice::new(&HeadlessOptions { validation: Validation::On, ..Default::default() }).map(Arc::new);
    GPU.get_or_init(open).clone()
}

pub fn gpu() -> Arc<HeadlessDevice> {
    try_gpu().expect("tests that need a device are ignored without one")
}

/// A session with poison: transients and previous copies hold NaN before they are written.
pub fn session(config: &Config) -> Session {
    Session::new(gpu(), config.declare().expect("valid"), SessionOptions { poison: true, ..Default::default() }).expect("session")
}

/// No error of the validation layer so far.
pub fn assert_valid() {
    let errors = gpu().validation_errors();
    assert!(errors.is_empty(), "{} validation messages, the first:\n{}", errors.len(), errors[0]);
}

/// Uploads what a frame of the synthetic scene has, for the inputs that the configuration declares.
pub fn upload(session: &mut Session, guides: &Guides) {
    let declaration = session.executor().denoiser().declaration().clone();
    for (name, texels) in guides.declared(&declaration) {
        session.upload(name, texels).expect(name);
    }
    if declaration.find("surface_id").is_some() {
        session.upload_ids("surface_id", &guides.surface_id).expect("surface_id");
    }
}

/// [`upload`] with light of fewer pixels, traced at an offset.
pub fn upload_traced(session: &mut Session, guides: &Guides, offset: [u32; 2]) {
    let declaration = session.executor().denoiser().declaration().clone();
    let [width, height] = declaration.allocated_extent();
    for (name, texels) in guides.declared(&declaration) {
        let resource = declaration.resource(declaration.find(name).expect(name));
        let [columns, rows] = resource.extent(declaration.setup()).expect("an image");
        let (x, y) = (width / columns, height / rows);
        let at = |p: u32, q: u32| texels[((q * y + offset[1] % y) * width + p * x + offset[0] % x) as usize];
        let traced: Vec<[f32; 4]> = (0..rows).flat_map(|q| (0..columns).map(move |p| at(p, q))).collect();
        session.upload(name, &traced).expect(name);
    }
    if declaration.find("surface_id").is_some() {
        session.upload_ids("surface_id", &guides.surface_id).expect("surface_id");
    }
}
