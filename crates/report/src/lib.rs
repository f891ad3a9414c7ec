//! What people read: the reproduction report and its figures.
//!
//! ```
//! use model::number::Number;
//! use paper::printed::Paper;
//! use report::cell::Cell;
//! // Theta of the paper's first position, degrees: a point of its grid, 344 steps of 0.001 rad.
//! let printed = Paper::project().claim("ix-theta").unwrap().value();
//! assert!((printed.to_radians() - 0.344).abs() < 1e-7);
//! // It is told with all its digits, since it is printed so.
//! assert_eq!(Cell::number(Number::decimals(printed, 5)).text(), "19.70975");
//! ```
//!
//! A [`Report`] is made from one [`Reproduction`](paper::Reproduction) and written as a page
//! ([`Report::html`]: one file that needs nothing else), as Markdown ([`Report::markdown`]) and as
//! JSON ([`Report::json`]). The first two are made of the same [`block`]s, so they say the same.
//!
//! | module | what it does |
//! |---|---|
//! | [`document`], `chapters` | what the report says, chapter by chapter |
//! | [`equations`] | the equations in LaTeX, as printed and as corrected |
//! | [`block`], [`cell`], [`badge`] | what it is made of: headings, texts, tables of numbers and verdicts, figures |
//! | [`figures`] | the pictures |
//! | [`math`], [`symbols`] | LaTeX to MathML, names of symbols to signs |
//! | [`html`], [`markdown`] | the blocks as text |
//! | [`formulas`] | the formulas of the documentation's pages, typeset to be read offline |
//! | [`environment`] | where and with what |

pub mod badge;
pub mod bibliography;
pub mod block;
pub mod cell;
mod chapters;
pub mod document;
pub mod environment;
pub mod equations;
pub mod figures;
pub mod formulas;
pub mod html;
pub mod markdown;
pub mod math;
mod numbers;
pub mod symbols;
pub mod view;

pub use document::Report;
pub use environment::Environment;
