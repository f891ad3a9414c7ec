//! Equation by equation.

use paper::Reproduction;
use paper::equations::{Fault, Validity};

use crate::badge::Badge;
use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;
use crate::equations::{Judged, judged, statements};

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    let judged = judged(&r.equations);
    let mut blocks = vec![
        heading(2, "equations", "Equation by equation"),
        text(
            "All numbered equations of the paper in its order, (1) to (41) and (i) to (xxvi). Each was typed in once more as it is \
             printed and evaluated when this report was made, against something that does not come from the same line of print: \
             a product of matrices, chains closed by construction, a numeric derivative, Newton's law, or the equilibrium E1. \
             What is printed wrong is underlined with dashes, what belongs there with a line. A number below 10⁻¹² is rounding. A \
             definition has nothing to fail; its number holds it against what the program uses. A remark is a number worth \
             knowing, and no fault.",
        ),
        text(
            "**“As printed”** means as the copy at hand has it. That copy is a conversion of the printed pages and scrambled in layout, \
             the large matrices most of all: brackets, line breaks, dots and rows that are missing or out of place may be the \
             copy's. Such faults are of form and counted apart. A fault of substance is a formula or statement that is wrong \
             however it is laid out.",
        ),
        Block::Table(overview(&judged)),
    ];
    blocks.extend(judged.into_iter().map(Block::Equation));
    blocks.push(heading(3, "statements", "Statements between the equations"));
    blocks.push(Block::Statements(statements(&r.equations).collect()));
    blocks
}

/// The equations by verdict.
fn overview(judged: &[Judged]) -> Table {
    let kinds = [
        (Validity::Holds, None, "as printed"),
        (Validity::Corrected, Some(Fault::Substance), "wrong in substance"),
        (
            Validity::Corrected,
            Some(Fault::Digits),
            "right to the step of its scan, not to its digits",
        ),
        (Validity::Corrected, Some(Fault::Form), "wrong in form alone"),
        (Validity::Refuted, Some(Fault::Substance), "wrong in substance, beyond correction"),
        (Validity::Definition, None, "names something"),
    ];
    let rows = kinds.map(|(validity, fault, what)| {
        let of = judged.iter().filter(|j| (j.verdict, j.fault) == (validity, fault));
        let of: Vec<&str> = of.map(|j| j.equation.number).collect();
        vec![
            Badge::of_equation(validity, fault).into(),
            what.into(),
            Cell::count(of.len()),
            of.join(", ").into(),
        ]
    });
    Table::new(
        "The equations by verdict; one with several parts counts by its worst.",
        "verdict||equations|which",
        rows.to_vec(),
    )
}
