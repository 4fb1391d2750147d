//! The bar that says how far a long run is.

use indicatif::{ProgressBar, ProgressStyle};

/// A bar of some steps.
pub fn bar(steps: u64, what: &str) -> ProgressBar {
    let bar = ProgressBar::new(steps).with_message(what.to_owned());
    if let Ok(style) = ProgressStyle::with_template("{msg:24} [{bar:40}] {pos}/{len} {elapsed} (eta {eta})") {
        bar.set_style(style);
    }
    bar
}
