#![allow(clippy::unwrap_used, dead_code, unused_imports)]
#[path = "it/frames.rs"]
mod frames;
