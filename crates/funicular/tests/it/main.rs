//! The program as its users meet it.

mod census;
mod examples;
mod files;
mod library;
mod program;
mod starts;
mod sweep;
mod trace;
