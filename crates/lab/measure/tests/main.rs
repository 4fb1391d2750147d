//! The filters on the miniature engine, judged by their scores. In one program: each is linked with all of it.

mod denoising;
mod fog;
mod gradients;
mod reflections;
mod shadows;
