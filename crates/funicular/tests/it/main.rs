//! The program as its users meet it.

mod batch;
mod census;
mod census_systems;
mod derivatives;
mod edited;
mod escapes;
mod examples;
mod files;
mod fuzz;
mod guide;
mod judge;
mod keys;
mod library;
mod modes;
mod motion;
mod pages;
mod program;
mod promise;
mod reached;
mod replaced;
mod slurm;
mod starts;
mod study;
mod sweep;
mod systems;
mod trace;
