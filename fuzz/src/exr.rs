//! EXR files: windows, tiles, channels and whatever else a header says, under the memory that a run is said to take.

use crate::Outcome;
use atrous_denoise::error::Result;
use atrous_denoise::mapping::Mapping;
use atrous_denoise::memory::{Demands, Need};
use atrous_denoise::setup::{Options, Setup};
use atrous_denoise::{exr_read, frame, frame_files};
use std::path::Path;

/// Runs what it is given, and says how many bytes that had allocated at its peak. A program that does not count says 0.
pub type Meter = fn(&mut dyn FnMut()) -> u64;

/// Most bytes of a run that is tried, and of one that is only looked at.
const TRIED: u64 = 32 << 20;
const LOOKED_AT: u64 = 8 << 20;

/// Name of the file that is written.
const NAME: &str = "frame_0000.exr";

/// Writes the bytes into a folder of the caller's, and reads them back as a frame and as a picture of all channels.
pub fn attack(folder: &Path, bytes: &[u8], meter: Meter) -> Outcome {
    let path = folder.join(NAME);
    crate::sequence::replace(&path, bytes);
    match as_frame(folder, meter).and_then(|outcome| as_picture(&path).map(|()| outcome)) {
        Ok(outcome) => outcome,
        Err(error) => {
            assert!(error.to_string().contains(NAME), "no file name in: {error}");
            Outcome::Refused
        }
    }
}

/// What `work` gives, and the bytes that it took.
fn measured<T>(meter: Meter, work: impl FnOnce() -> T) -> (Option<T>, u64) {
    let (mut work, mut result) = (Some(work), None);
    let taken = meter(&mut || result = work.take().map(|work| work()));
    (result, taken)
}

/// Sees whether what is said of memory holds, and reads the file where it is little.
fn as_frame(folder: &Path, meter: Meter) -> Result<Outcome> {
    let files = frame_files::find(&[folder.to_owned()])?;
    let (setup, taken) = measured(meter, || Setup::new(&files, &Options::default()));
    assert!(taken < LOOKED_AT, "{taken} bytes were taken for a header");
    let setup = setup.expect("it was made")?;
    let need = Need::new(&setup, &Demands { frames: 1, ..Demands::default() }, 0)?;
    let said = need.frames + need.reading;
    if said > TRIED {
        return Ok(Outcome::Large);
    }
    let (frame, taken) = measured(meter, || frame::load(&files[0], &setup).map(drop));
    assert!(taken <= said + (1 << 20), "{taken} bytes were taken, where {said} were said: {need:?}");
    frame.expect("it was loaded").map(|()| Outcome::Used)
}

/// Reads every channel, whatever it may be for.
fn as_picture(path: &Path) -> Result<()> {
    let header = exr_read::read_header(path)?;
    // Larger ones stay legal, and are only slow.
    if u64::from(header.extent[0]) * u64::from(header.extent[1]) <= 1 << 20 {
        _ = Mapping::choose(path, &header, &[], None);
        exr_read::read(path, |_| true)?;
    }
    Ok(())
}
