//! Equilibria of bars that hang from their anchors: found twice by methods that share no mechanics, compared, judged,
//! and proved as far as they can be.
//!
//! The program `funicular` lies beside this library.
