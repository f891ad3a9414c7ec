//! The program as its users meet it.

mod census;
mod files;
mod library;
mod program;
mod starts;
mod sweep;
mod trace;
