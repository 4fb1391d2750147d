//! Pictures, strips, plots, tables and pages. In one program: each is linked with all of it.

mod pictures;
mod plots_and_tables;
mod strips;
mod structure;
mod support;
