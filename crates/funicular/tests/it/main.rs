//! The program as its users meet it.

mod census;
mod files;
mod program;
mod sweep;
mod trace;
