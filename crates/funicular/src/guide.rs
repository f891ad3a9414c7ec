//! The guide: chapters for people. The same files stand as pages in the folder `guide` of the repository, with their pictures.
#![doc = include_str!("../guide/1-first-steps.md")]

#[doc = include_str!("../guide/2-systems.md")]
pub mod systems {}
#[doc = include_str!("../guide/3-evidence.md")]
pub mod evidence {}
#[doc = include_str!("../guide/4-all-equilibria.md")]
pub mod all_equilibria {}
#[doc = include_str!("../guide/5-judging.md")]
pub mod judging {}
#[doc = include_str!("../guide/6-motion.md")]
pub mod motion {}
#[doc = include_str!("../guide/7-large-systems.md")]
pub mod large_systems {}
#[doc = include_str!("../guide/8-limits.md")]
pub mod limits {}
#[doc = include_str!("../guide/9-speeds.md")]
pub mod speeds {}
#[doc = include_str!("../guide/10-methods.md")]
pub mod methods {}
#[doc = include_str!("../guide/11-from-python.md")]
pub mod from_python {}
#[doc = include_str!("../guide/12-from-rust.md")]
pub mod from_rust {}
#[doc = include_str!("../guide/13-commands.md")]
pub mod commands {}
#[doc = include_str!("../guide/14-keys.md")]
pub mod keys {}
#[doc = include_str!("../guide/15-load-paths.md")]
pub mod load_paths {}
