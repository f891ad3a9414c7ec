//! Answers as text: what the program prints, by the same code. How tables look is set once for a
//! whole program ([`printed::Style`]).

mod answer;
#[cfg(feature = "sweep")]
mod basins;
pub(crate) mod census;
mod census_chain;
#[cfg(feature = "branches")]
pub mod derivatives;
mod judged;
#[cfg(feature = "branches")]
pub mod load;
mod load_cases;
mod losses;
pub mod markdown;
mod modes;
pub mod motion;
pub mod printable;
pub mod printed;
#[cfg(feature = "paper")]
mod reproduction;
mod settled;
mod shape;
#[cfg(feature = "branches")]
mod study;
#[cfg(feature = "sweep")]
pub mod sweep;
pub mod tables;
mod tolerances;
#[cfg(feature = "branches")]
mod trace;

use model::system::System;

pub(crate) use answer::facts;
pub use answer::{answer, remarks};

/// The member of a system that is nearest to breaking, in a sentence.
pub(crate) fn weakest(system: &System, weakest: &crate::Weakest) -> String {
    let ends = |bar: usize| {
        let member = &system.members()[bar];
        [member.from, member.to].map(|joint| system.joints()[joint].name.to_string())
    };
    shape::weakest_of(weakest, &ends)
}
