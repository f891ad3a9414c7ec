//! How to cite.

/// BibTeX of the paper. Its authors and its venue are not in the copy of the text that this work
/// rests on, so they are not here.
pub const PAPER: &str = r"@unpublished{bars-multibody,
  title = {Equilibrium of a System of Bars Using a Multibody Type Method},
  note  = {Authors and venue are not named in the copy of the text used here}
}";

/// BibTeX of this program.
pub const SOFTWARE: &str = concat!(
    r"@software{funicular,
  title   = {funicular: equilibria and motions of systems of bars, cables and springs, found twice},
  author  = {{The funicular developers}},
  version = {",
    env!("CARGO_PKG_VERSION"),
    r"},
  year    = {2026},
  license = {MIT OR Apache-2.0}
}"
);
