//! Presets: each a short list of nodes.

mod svgf;

pub(crate) use svgf::svgf;
