//! Pictures, strips, plots, tables and pages; and the filters on the miniature engine. In one program: each is linked with all of it.

#[cfg(feature = "measure")]
mod denoising;
#[cfg(feature = "measure")]
mod fog;
#[cfg(feature = "measure")]
mod gradients;
mod pictures;
mod plots_and_tables;
#[cfg(feature = "measure")]
mod reflections;
#[cfg(feature = "measure")]
mod shadows;
mod strips;
mod structure;
mod support;
