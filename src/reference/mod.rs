//! The CPU twin of every stage: plain `f32`, no `unsafe`, written from the equations and not from the shaders.
