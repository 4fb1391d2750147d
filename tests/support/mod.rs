//! What the tests share: the device, sessions on it, and a synthetic scene.

pub mod display;
pub mod examples;
pub mod host;
pub mod intercepted;
pub mod rig;
pub mod soak;
pub mod spy;

pub use atrous_synthetic::scene::{self, pixels, random, rmse};

use atrous::config::Preset;
use atrous::executor::{HeadlessDevice, HeadlessOptions, Session, SessionOptions, Validation};
use atrous::reference::{unpack_luminance_history, Engine, LuminanceHistory};
use atrous::{Config, Declaration, Error, FrameContext, FrameParams, Material, Tuning, UseFrame};
use scene::Guides;
use std::cell::{OnceCell, RefCell};
use std::sync::{Arc, Mutex, PoisonError};

thread_local! {
    static GPU: OnceCell<Arc<HeadlessDevice>> = const { OnceCell::new() };
    static WARNINGS: RefCell<Vec<String>> = const { RefCell::new(Vec::new()) };
}

struct Listener;

impl log::Log for Listener {
    fn enabled(&self, metadata: &log::Metadata) -> bool {
        metadata.level() <= log::Level::Warn
    }

    fn log(&self, record: &log::Record) {
        if self.enabled(record.metadata()) {
            WARNINGS.with_borrow_mut(|w| w.push(record.args().to_string()));
        }
    }

    fn flush(&self) {}
}

/// What the library said through the log facade on the thread of this test.
pub fn warnings() -> Vec<String> {
    static ONCE: std::sync::Once = std::sync::Once::new();
    ONCE.call_once(|| {
        log::set_logger(&Listener).expect("no other logger");
        log::set_max_level(log::LevelFilter::Warn);
    });
    WARNINGS.with_borrow(Clone::clone)
}

/// Devices that no thread has yet.
static FREE: Mutex<Vec<Arc<HeadlessDevice>>> = Mutex::new(Vec::new());

/// Opens the devices for so many threads of tests, under validation, before there is a second thread: layers of 2023 find the device of a
/// call in a table without a lock, and crash where another thread opens one at that time.
///
/// Not one for all: the queue of a software device compiles shaders, and tests of other threads would wait for it.
pub fn open_devices(threads: usize) -> Result<(), Error> {
    for _ in 0..threads {
        let device = Arc::new(HeadlessDevice::new(&HeadlessOptions { validation: Validation::On, ..Default::default() })?);
        // Threads of tests end while the process does: by then no driver may be called any more.
        std::mem::forget(device.clone());
        FREE.lock().unwrap_or_else(PoisonError::into_inner).push(device);
    }
    Ok(())
}

/// Gives the tests of this thread the device of another.
pub fn share_gpu(device: Arc<HeadlessDevice>) {
    GPU.with(|gpu| assert!(gpu.set(device).is_ok(), "this thread has a device already"));
}

/// The device of the tests that this thread runs.
pub fn gpu() -> Arc<HeadlessDevice> {
    let free = || FREE.lock().unwrap_or_else(PoisonError::into_inner).pop();
    GPU.with(|gpu| gpu.get_or_init(|| free().expect("a thread of tests, on a machine with a device, or `share_gpu`")).clone())
}

/// SVGF, for tests of what it does and of passes that it has.
pub fn svgf(extent: [u32; 2]) -> Config {
    Config { preset: Preset::Svgf, ..Config::new(extent) }
}

/// The numbers of SVGF.
pub fn svgf_tuning() -> Tuning {
    Tuning::for_preset(Preset::Svgf)
}

/// A session with poison: transients and previous copies hold NaN before they are written.
pub fn session(config: &Config) -> Session {
    session_with(config, SessionOptions { poison: true, ..Default::default() })
}

pub fn session_with(config: &Config, options: SessionOptions) -> Session {
    Session::new(gpu(), config.declare().expect("valid"), options).expect("session")
}

/// No error of the validation layer so far.
pub fn assert_valid() {
    let errors = gpu().validation_errors();
    assert!(errors.is_empty(), "{} validation messages, the first:\n{}", errors.len(), errors[0]);
}

/// Uploads what a frame of the synthetic scene has, for the inputs that are declared.
pub fn upload(session: &mut Session, guides: &Guides) {
    upload_traced(session, guides, [0; 2]);
}

/// Of images of light that has fewer pixels, those of an offset in each cell.
pub fn upload_traced(session: &mut Session, guides: &Guides, offset: [u32; 2]) {
    let declaration = session.executor().denoiser().declaration().clone();
    for (name, texels) in guides.declared(&declaration) {
        session.upload(name, &traced(&declaration, name, texels, offset)).expect(name);
    }
    if declaration.find("surface_id").is_some() {
        session.upload_ids("surface_id", &guides.surface_id).expect("surface_id");
    }
    if declaration.find("material_class").is_some() {
        session.upload_ids("material_class", &classes(declaration.allocated_extent())).expect("material_class");
    }
}

/// Numbers of each class of materials; those of class 0 are the usual ones.
pub fn materials() -> [Material; Material::CLASSES] {
    std::array::from_fn(|class| {
        let factor = |salt: usize| [1.0, 0.05, 0.3, 3.0, 20.0][class * salt % 5];
        let longest_history = if class % 3 == 1 { 2.0 } else { 1024.0 };
        Material { depth: factor(1), normal: factor(2), light: factor(3), longest_history }
    })
}

/// Classes of materials, in squares; some are beyond the table.
fn classes(extent: [u32; 2]) -> Vec<u32> {
    pixels(extent).map(|(x, y)| (x / 3 + 8 * (y / 4)) % 19).collect()
}

/// The texels of an image of light that were traced.
pub fn traced(declaration: &Declaration, name: &str, texels: &[[f32; 4]], offset: [u32; 2]) -> Vec<[f32; 4]> {
    let [width, height] = declaration.allocated_extent();
    let resource = declaration.resource(declaration.find(name).expect(name));
    let [columns, rows] = resource.extent(declaration.setup()).expect("an image");
    let (x, y) = (width / columns, height / rows);
    let at = |p: u32, q: u32| texels[((q * y + offset[1] % y) * width + p * x + offset[0] % x) as usize];
    (0..rows).flat_map(|q| (0..columns).map(move |p| at(p, q))).collect()
}

/// Uploads a frame of the synthetic scene as a part of larger images, which are not finite around it, and whose ids are of nothing.
pub fn upload_part(session: &mut Session, guides: &Guides, origin: [u32; 2]) {
    let declaration = session.executor().denoiser().declaration().clone();
    for (name, texels) in guides.declared(&declaration) {
        session.upload(name, &placed(&declaration, name, texels, [f32::NAN; 4], origin)).expect(name);
    }
    if declaration.find("surface_id").is_some() {
        session.upload_ids("surface_id", &placed(&declaration, "surface_id", &guides.surface_id, u32::MAX, origin)).expect("ids");
    }
    if declaration.find("material_class").is_some() {
        let classes = classes(declaration.allocated_extent());
        session.upload_ids("material_class", &placed(&declaration, "material_class", &classes, u32::MAX, origin)).expect("classes");
    }
}

/// The texels of a picture at an origin of the images that it is a part of.
fn placed<T: Copy>(declaration: &Declaration, name: &str, texels: &[T], around: T, origin: [u32; 2]) -> Vec<T> {
    let [width, height] = declaration.allocated_extent();
    let resource = declaration.resource(declaration.find(name).expect(name));
    let [columns, rows] = resource.extent(declaration.setup()).expect("an image");
    let inside = |p: u32, q: u32| {
        let (x, y) = (p.checked_sub(origin[0])?, q.checked_sub(origin[1])?);
        (x < width && y < height).then(|| texels[(y * width + x) as usize])
    };
    (0..rows).flat_map(|q| (0..columns).map(move |p| (p, q))).map(|(p, q)| inside(p, q).unwrap_or(around)).collect()
}

/// Gives the CPU engine what [`upload`] gives a session.
pub fn upload_to_engine(engine: &mut Engine, guides: &Guides) {
    let declaration = engine.declaration().clone();
    for (name, texels) in guides.declared(&declaration) {
        engine.upload(name, texels).expect(name);
    }
    if declaration.find("surface_id").is_some() {
        engine.upload_ids("surface_id", &guides.surface_id).expect("surface_id");
    }
    if declaration.find("material_class").is_some() {
        engine.upload_ids("material_class", &classes(declaration.allocated_extent())).expect("material_class");
    }
}

/// Uploads and runs one frame; checks the output for values that are not finite, and the layer for messages.
pub fn frame(session: &mut Session, guides: &Guides, params: &FrameParams, tuning: &Tuning) -> (FrameContext, Vec<[f32; 4]>) {
    upload(session, guides);
    let context = session.run(params, tuning).expect("frame");
    let image = session.download("denoised_radiance").expect("denoised_radiance");
    assert_finite(&image, context.render_extent, session.executor().denoiser().declaration().allocated_extent());
    assert_valid();
    (context, image)
}

/// The history of luminance that a frame left.
pub fn luminance_history(session: &mut Session, name: &str) -> Vec<LuminanceHistory> {
    let texels: Vec<u32> = bytemuck::allocation::pod_collect_to_vec(&session.download_bytes(name, UseFrame::Current).expect(name));
    texels.into_iter().map(unpack_luminance_history).collect()
}

/// Every texel of the render rect is finite.
pub fn assert_finite(image: &[[f32; 4]], render: [u32; 2], allocated: [u32; 2]) {
    for (x, y) in pixels(render) {
        let texel = image[(y * allocated[0] + x) as usize];
        assert!(texel.iter().all(|v| v.is_finite()), "pixel {x},{y} is {texel:?}");
    }
}
