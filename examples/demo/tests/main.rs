//! The tests of the demo but for those of its window, in one program: every program of tests is linked with all that the demo is made of.

mod cli;
mod conventions;
mod denoising;
mod energy;
mod evaluate;
mod fog;
mod frames;
mod gltf;
mod gltf_hostile;
mod gradients;
#[cfg(feature = "hot-reload")]
mod hot_reload;
mod motion;
mod reflections;
mod shadows;
mod support;
