//! How to repeat it and how to cite it.

use crate::bibliography::{PAPER, SOFTWARE};
use crate::block::{Block, heading, text};

pub(crate) fn blocks<'a>() -> Vec<Block<'a>> {
    vec![
        heading(2, "repeat", "To repeat and to cite"),
        text(
            "`funicular reproduce --out report` writes this page, the same as Markdown, and `results.json` with all numbers in full \
             precision. Random states come from ChaCha8 with fixed seeds (41 for the equations, 2026 for the starts), so that \
             every run takes the same ones.",
        ),
        Block::Code("bibtex", PAPER.to_owned()),
        Block::Code("bibtex", SOFTWARE.to_owned()),
    ]
}
