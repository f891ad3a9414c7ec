//! Random and named chains for the tests of all crates, the same in every run.
//!
//! ```
//! use samples::{General, stream};
//! // Chain 7 of a test: its bars reach from anchor to anchor with length to spare.
//! let problem = General::default().problem(&mut stream(20_261_122, 7), 5);
//! let chain = problem.chain();
//! assert_eq!(chain.bars().len(), 5);
//! assert!(chain.anchors().span_m() < 0.95 * chain.total_length_m());
//! ```
//!
//! | chains | from |
//! |---|---|
//! | in general position | [`General`] |
//! | of eleven shapes that are hard to solve, one for each seed | [`random_chain`] |
//! | hard in several ways at once | [`extreme_chain`] |
//! | all but folded on one line | [`folded_chain`] |
//! | of so many equal bars | [`equal_bars`] |
//! | of bars written down as numbers | [`chain`], [`homogeneous`], [`of_bars`] |
//! | of the text of a system file | [`parsed`] |
//!
//! [`rope`] is a rope and [`ropes`] are systems with ropes over rings and pulleys, [`known`] others, known by hand, [`dome`] is the text of a system file, [`bridle`] and [`cable_net`] are of any size, [`joints`] are anchors and free joints by their places and masses, [`legs`] a frame whose lengths do not fit, [`scaled`] a system and [`scaled_chain`] a chain in other units, [`root`] what closed forms need, [`process`] what measurements do.
//!
//! Chains with a name and a file of their own are those of [`model::cases`].
//!
//! Here are lengths, masses and places, and no mechanics: so both solvers may draw their test
//! chains from here and still have nothing in common but data. Numbers out of range make these
//! functions panic, as what is not so does those that assert it.
#![expect(clippy::missing_panics_doc, reason = "said above of all")]

mod batches;
mod dome;
mod extreme;
mod folded;
mod frozen;
mod general;
mod known;
mod large;
mod named;
mod pairs;
pub mod process;
mod root;
mod ropes;
mod scaled;
mod shape;
mod stream;

pub use batches::{assert_batches_scale, assert_seeds_are_alone};
pub use dome::dome;
pub use extreme::extreme_chain;
pub use folded::folded_chain;
pub use frozen::assert_frozen;
pub use general::{General, Line};
pub use known::{Known, known};
pub use large::{bridle, cable_net};
pub use named::{
    assert_misfits_of_legs, assert_shared_by_legs, chain, equal_bars, homogeneous, joints, legs,
    of_bars, parsed,
};
pub use pairs::{Pair, unlike_pairs};
pub use root::root;
pub use ropes::{RopeSample, jammed_ropes, rope, ropes};
pub use scaled::{scaled, scaled_chain};
pub use shape::{Shape, random_chain};
pub use stream::stream;
