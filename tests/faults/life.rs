//! All that a session does, in steps that can each be tried again.

use crate::support::scene::Scene;
use atrous::config::Preset;
use atrous::executor::{HeadlessDevice, Session, SessionOptions};
use atrous::{Config, Error, Tuning};
use std::sync::Arc;

const EXTENTS: [[u32; 2]; 2] = [[19, 17], [24, 18]];

pub struct Life {
    session: Session,
    extent: [u32; 2],
    frames: u32,
    index: u64,
    #[cfg(feature = "capture")]
    folder: tempfile::TempDir,
}

/// A step. What it does is done by its end, so that a second try does no harm.
type Step = fn(&mut Life) -> Result<(), Error>;

pub const STEPS: &[(&str, Step)] = &[
    ("inputs and a frame", Life::frame),
    ("a buffer and a frame", Life::buffer),
    ("a frame and its output", |life| life.frame().and_then(|()| life.session.download("denoised_radiance").map(drop))),
    ("a frame pass by pass", Life::traced),
    #[cfg(feature = "capture")]
    ("a captured frame", Life::capture),
    ("another extent", Life::resize),
];

impl Life {
    pub fn open(gpu: &Arc<HeadlessDevice>) -> Result<Self, Error> {
        let config = Config { preset: Preset::Fast, ..Config::new(EXTENTS[0]) };
        let options = SessionOptions { timestamps: true, ..SessionOptions::default() };
        Ok(Self {
            session: Session::new(gpu.clone(), config.declare().expect("valid"), options)?,
            extent: EXTENTS[0],
            frames: 0,
            index: 0,
            #[cfg(feature = "capture")]
            folder: tempfile::tempdir().expect("a folder"),
        })
    }

    /// Every step, to the first error.
    pub fn live(&mut self) -> Result<(), Error> {
        STEPS.iter().try_for_each(|(_, step)| step(self))
    }

    /// The bits of a frame without history.
    pub fn first_frame(&mut self) -> Vec<[u32; 4]> {
        if self.extent != EXTENTS[0] {
            self.resize().expect("the first extent");
        }
        self.go_on_from(0);
        self.frame_bits().expect("a frame")
    }

    /// Frames that ran to their end.
    pub fn finished(&self) -> u32 {
        self.frames
    }

    /// The number of the last frame, as the session has it.
    pub fn index(&self) -> u64 {
        self.index
    }

    /// The next frame is of this number, and has no history.
    pub fn go_on_from(&mut self, frame: u32) {
        self.session.restart_at(frame.into());
        self.frames = frame;
    }

    /// The next frame has no history.
    pub fn invalidate(&mut self) {
        self.session.invalidate();
    }

    /// The bits of a frame.
    pub fn frame_bits(&mut self) -> Result<Vec<[u32; 4]>, Error> {
        self.frame()?;
        let texels = self.session.download("denoised_radiance")?;
        Ok(texels.iter().map(|texel| texel.map(f32::to_bits)).collect())
    }

    pub fn frame(&mut self) -> Result<(), Error> {
        let scene = Scene { speed: 0.1, ..Scene::new(self.extent) };
        let guides = scene.frame(self.frames, self.frames);
        let declaration = self.session.executor().denoiser().declaration().clone();
        for (name, texels) in guides.declared(&declaration) {
            self.session.upload(name, texels)?;
        }
        self.session.upload_ids("surface_id", &guides.surface_id)?;
        self.frame_of_what_is_there()
    }

    /// A frame without an upload.
    pub fn frame_of_what_is_there(&mut self) -> Result<(), Error> {
        let scene = Scene { speed: 0.1, ..Scene::new(self.extent) };
        self.index = self.session.run(&scene.params(self.frames), &Tuning::default())?.index;
        self.frames += 1;
        Ok(())
    }

    fn buffer(&mut self) -> Result<(), Error> {
        let still = [[1.0f32, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]];
        self.session.upload_buffer("instance_transforms", bytemuck::cast_slice(&[still; 3]))?;
        self.frame()?;
        self.session.unbind("instance_transforms")
    }

    fn traced(&mut self) -> Result<(), Error> {
        let scene = Scene { speed: 0.1, ..Scene::new(self.extent) };
        self.session.run_traced(&scene.params(self.frames), &Tuning::default(), &mut |_, _, _, _| Ok(())).map(drop)
    }

    #[cfg(feature = "capture")]
    fn capture(&mut self) -> Result<(), Error> {
        if self.session.executor().frames_to_capture() > 0 {
            self.session.finish_capture()?;
        }
        let name = std::fs::read_dir(self.folder.path()).map_or(0, Iterator::count).to_string();
        self.session.capture(self.folder.path().join(name), 1)?;
        self.frame()?;
        assert_eq!(self.session.finish_capture()?, 1, "a captured frame");
        Ok(())
    }

    fn resize(&mut self) -> Result<(), Error> {
        let other = EXTENTS[usize::from(self.extent == EXTENTS[0])];
        self.session.resize(other)?;
        self.extent = other;
        self.frame()
    }
}
