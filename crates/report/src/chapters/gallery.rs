//! Systems of bars beyond chains, each with its picture.

use figures::{Seen, StructureError, SystemShape};
use model::Rung;
use model::number::Number;
use validate::gallery::Piece;

use crate::badge::{Badge, Tone};
use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;
use crate::figures::Figure;

/// Digits of forces and places that are told.
const DIGITS: usize = 8;

pub(crate) fn blocks<'a>(pieces: &[Piece]) -> Vec<Block<'a>> {
    let mut blocks = vec![
        heading(2, "gallery", "Gallery"),
        text(
            "Both solvers, the judge and the certificate of the least energy work for any system of bars, cables and \
             struts. These are known in a closed form (`funicular cases NAME` prints the file of each); the first number \
             is that of the formula, the others how far the solvers are from it.",
        ),
        Block::Table(numbers(pieces)),
        Block::Table(ladder(pieces)),
    ];
    blocks.extend(pieces.iter().filter_map(|piece| sheet(piece).ok()));
    blocks
}

fn numbers(pieces: &[Piece]) -> Table {
    let row = |piece: &Piece| {
        let known = &piece.closed_form;
        let off = |k: usize| {
            let e = piece.answer.equilibria.get(k)?;
            let off = ((known.of)(&piece.system, e) - known.value) / known.value;
            Some(Number::significant(off.abs(), 2))
        };
        vec![
            Cell::from(piece.exhibit.name),
            Cell::count(piece.system.members().len()),
            known.what.into(),
            known.formula.into(),
            Cell::Number(Number::significant(known.value, DIGITS), known.unit),
            off(0).into(),
            off(1).into(),
            Badge::of_agreement(piece.answer.agrees()).into(),
        ]
    };
    Table::new(
        "Numbers in a closed form, and the relative differences of both solvers from them.",
        "system|bars|what|closed form|value|lagrange|energy|verdict",
        pieces.iter().map(row).collect(),
    )
}

/// The rungs that both answers have reached.
fn ladder(pieces: &[Piece]) -> Table {
    let row = |piece: &Piece| {
        let reached = |rung: Rung| {
            let answers = &piece.answer.equilibria;
            let both =
                !answers.is_empty() && answers.iter().all(|e| e.evidence.ladder.is_reached(rung));
            Cell::from(if both {
                Badge::new(Tone::Good, "reached")
            } else {
                Badge::new(Tone::Neutral, "open")
            })
        };
        [Cell::from(piece.exhibit.name)].into_iter().chain(Rung::ALL.map(reached)).collect()
    };
    Table::new(
        "How far the answers are proved.",
        "system|converged|agreed|verified|complete|optimal",
        pieces.iter().map(row).collect(),
    )
}

fn sheet<'a>(piece: &Piece) -> Result<Block<'a>, StructureError> {
    let Some(e) = piece.answer.equilibria.first() else { return Err(StructureError::Empty) };
    let axial = e.axial_forces(&piece.system);
    let axial_n: Vec<f64> = axial.iter().map(model::AxialForce::largest_n).collect();
    let shape = SystemShape {
        used: &[],
        system: &piece.system,
        joints_m: &e.joints_m,
        axial_n: &axial_n,
        reactions_n: &e.reactions_n,
        seen: Seen::Best,
    };
    let panel = shape.in_page(&format!("gallery-{}", piece.exhibit.name))?;
    let lowest = e.joints_m.iter().map(|at| at[2]).fold(f64::INFINITY, f64::min);
    let most = axial_n.iter().fold(0.0, |a: f64, b| a.max(*b));
    let caption = format!(
        "`{}`: {}. {} bars between {} joints; the lowest joint is at {:#} m, the largest tension is {:#} N.",
        piece.exhibit.name,
        piece.exhibit.about,
        piece.system.members().len(),
        piece.system.joints().len(),
        Number::significant(lowest, DIGITS),
        Number::significant(most, DIGITS),
    );
    Ok(Block::Sheet(Figure { id: piece.exhibit.name, panels: vec![panel], caption }))
}
