//! The program as it is called.

mod cli;
mod evaluate;
