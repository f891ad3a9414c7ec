//! Equation by equation.

use paper::Reproduction;

use crate::block::{Block, Table, heading, text};
use crate::equations::{judged, statements, verdict_word};

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    let judged = judged(&r.equations);
    let mut blocks = vec![
        heading(2, "equations", "Equation by equation"),
        text(
            "All numbered equations of the paper in its order, (1) to (41) and (i) to (xxvi). Each was typed in once more as it is \
             printed and evaluated when this report was made, against something that does not come from the same line of print: \
             a product of matrices, chains closed by construction, a numeric derivative, Newton's law, or the equilibrium E1. \
             What is printed wrong is underlined with dashes, what belongs there with a line. A number below 10⁻¹² is rounding. A \
             definition has nothing to fail; its number holds it against what the program uses.",
        ),
        Block::Table(overview(&judged)),
    ];
    blocks.extend(judged.into_iter().map(Block::Equation));
    blocks.push(heading(3, "statements", "Statements between the equations"));
    blocks.push(Block::Statements(statements(&r.equations).collect()));
    blocks
}

/// The equations by verdict.
fn overview(judged: &[crate::equations::Judged]) -> Table {
    use paper::equations::Verdict;
    let rows = [Verdict::Holds, Verdict::Corrected, Verdict::Refuted, Verdict::Definition].map(
        |verdict| {
            let of: Vec<&str> =
                judged.iter().filter(|j| j.verdict == verdict).map(|j| j.equation.number).collect();
            vec![verdict_word(verdict).to_owned(), of.len().to_string(), of.join(", ")]
        },
    );
    Table {
        caption: "The equations by verdict; one with several parts counts by its worst.".to_owned(),
        head: vec!["verdict", "equations", "which"],
        rows: rows.to_vec(),
        verdicts: Some(0),
    }
}
