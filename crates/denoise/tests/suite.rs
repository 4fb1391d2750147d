//! Tests of the tool that need no Vulkan device.

mod samples;
mod tool;
