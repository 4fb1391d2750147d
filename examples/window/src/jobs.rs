//! What the engine does beside the picture: files of pictures, and ways of the camera.

use std::path::PathBuf;

use super::camera_path::CameraPath;
use super::record::{make, Seen, Shot};
use super::shared::{Request, Shared};
use crate::error::Result;
use atrous_engine::gpu::Gpu;
use atrous_engine::scene::View;

/// What is going on.
#[derive(Default)]
pub struct Jobs {
    /// Folder, and the number of the next frame.
    sequence: Option<(PathBuf, u32)>,
    way: Way,
    /// Folders that the next picture is written to.
    shots: Vec<PathBuf>,
}

#[derive(Default)]
enum Way {
    #[default]
    None,
    Recorded(CameraPath, PathBuf),
    /// With the number of the next frame.
    Flown(CameraPath, usize),
}

impl Jobs {
    /// Starts and ends what was asked for. What fails is said, and not done.
    pub fn take(&mut self, shared: &Shared, requests: &[Request]) {
        for request in requests {
            match request.clone() {
                Request::Screenshot(folder) => self.shots.push(folder),
                Request::Record(folder) => self.record(shared, folder),
                // The world's.
                Request::Reload => {}
                Request::RecordPath(path) => self.record_path(shared, path),
                Request::ReplayPath(path) if !path.exists() => {
                    shared.notify(
                        true,
                        format!("there is no {}: F4 records the camera's way, and F4 again writes it", path.display()),
                    );
                }
                Request::ReplayPath(path) => match CameraPath::load(&path) {
                    Ok(way) => self.way = Way::Flown(way, 0),
                    Err(error) => shared.notify(true, error.to_string()),
                },
            }
        }
    }

    fn record(&mut self, shared: &Shared, folder: PathBuf) {
        if let Some((folder, frames)) = self.sequence.take() {
            shared.notify(false, format!("{frames} frames are in {}", folder.display()));
            return;
        }
        match make(&folder) {
            Ok(()) => self.sequence = Some((folder, 0)),
            Err(error) => shared.notify(true, error.to_string()),
        }
    }

    fn record_path(&mut self, shared: &Shared, path: PathBuf) {
        let Way::Recorded(way, path) = std::mem::replace(&mut self.way, Way::Recorded(CameraPath::default(), path)) else { return };
        self.way = Way::None;
        let saved = path.parent().map_or(Ok(()), make).and_then(|()| way.save(&path));
        match saved {
            Ok(()) => shared.notify(false, format!("a camera path of {} frames is in {}", way.len(), path.display())),
            Err(error) => shared.notify(true, error.to_string()),
        }
    }

    /// The camera of the next frame, while a recorded way is flown.
    pub fn next_view(&mut self) -> Option<View> {
        let Way::Flown(way, frame) = &mut self.way else { return None };
        let view = way.view(*frame);
        *frame += 1;
        if view.is_none() {
            self.way = Way::None;
        }
        view
    }

    /// Whether a recorded way is flown.
    pub fn is_flying(&self) -> bool {
        matches!(self.way, Way::Flown(..))
    }

    /// Whether the next frame is the first of a flown way: the camera jumps.
    pub fn is_cut(&self) -> bool {
        matches!(self.way, Way::Flown(_, 1))
    }

    /// Keeps what the frame has for a sequence and for a way.
    ///
    /// # Errors
    /// A lost device.
    pub fn after_frame(&mut self, shared: &Shared, gpu: &Gpu, seen: &Seen, view: Option<View>) -> Result<()> {
        if let (Way::Recorded(way, _), Some(view)) = (&mut self.way, view) {
            way.push(&view);
        }
        let Some((folder, number)) = &mut self.sequence else { return Ok(()) };
        let shot = Shot::take(gpu, seen)?;
        match shot.write(&folder.join(format!("{number:05}.png"))) {
            Ok(()) => *number += 1,
            Err(error) => {
                shared.notify(true, error.to_string());
                self.sequence = None;
            }
        }
        Ok(())
    }

    /// Writes the pictures that were asked for.
    ///
    /// # Errors
    /// A lost device.
    pub fn shoot(&mut self, shared: &Shared, gpu: &Gpu, seen: &Seen) -> Result<()> {
        for folder in self.shots.drain(..) {
            match Shot::take(gpu, seen)?.write_all(&folder) {
                Ok(path) => shared.notify(false, format!("picture {}", path.display())),
                Err(error) => shared.notify(true, error.to_string()),
            }
        }
        Ok(())
    }

    /// Whether frames are being written, and what happens with the camera.
    pub fn state(&self) -> (bool, Option<&'static str>) {
        let way = match self.way {
            Way::None => None,
            Way::Recorded(..) => Some("recording the camera's way (F4 ends it)"),
            Way::Flown(..) => Some("flying the recorded way"),
        };
        (self.sequence.is_some(), way)
    }
}
