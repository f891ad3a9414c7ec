//! The method in short.

use model::number::Number;
use paper::Reproduction;

use super::run::word;
use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;
use crate::figures;

pub(crate) fn blocks(r: &Reproduction) -> Vec<Block<'_>> {
    vec![
        heading(2, "method", "The method in short"),
        Block::List(vec![
            "**`lagrange`** solves the paper's equations of rest: (40) with (41), and the constraint functions (7)-(20), \
             30 equations for 30 unknowns, reduced exactly to the moments of the bars and the closure, by Newton's method. The \
             multipliers are unknowns; energy is never looked at. It finds minima, saddles and maxima alike."
                .to_owned(),
            "**`energy`** minimises the potential energy over closed chains: Newton steps with the exact second derivative, each one \
             lowering the energy, on the directions of the bars. Forces come out afterwards, by virtual work. It finds minima \
             only."
                .to_owned(),
            "The two share no mechanics: a test reads the dependency graph and proves that neither can reach the other. Compared \
             are joints, forces and energy, never inner coordinates."
                .to_owned(),
            "A **third judge** knows neither: it takes the joints and the forces of an answer and checks Newton's laws, bar by bar.".to_owned(),
            "The **census** lists all equilibria with proof (interval arithmetic), the **certificate** proves that one is the lowest \
             of all configurations (the stress matrix, factorised)."
                .to_owned(),
        ]),
        Block::Figure(figures::convergence(r)),
        heading(3, "seeds", "From random starts"),
        text(
            "Where a solver ends depends on where it starts, as the paper says of its own. Started at random, `energy` always ends at \
             the minimum, `lagrange` at any of the equilibria. The exact counts are at the end, with the rest that may differ from \
             machine to machine.",
        ),
        Block::Figure(figures::basins(r)),
        Block::Table(Table::new(
            "Random starts: planar ones with three random angles, spatial ones with three random directions.",
            "solver|starts|converged|equilibria reached|lost",
            r
                .seeds
                .iter()
                .map(|s| {
                    let reached: Vec<_> =
                        s.reached.iter().filter(|e| e.seeds > 0).map(|e| e.equilibrium.replace('\'', "′")).collect();
                    vec![
                        s.solver.to_string().into(),
                        format!("{} {}", s.seeds, word(&s.kind)).into(),
                        Cell::Number(Number::decimals(100.0 * s.rate(), 1), "%"),
                        reached.join(", ").into(),
                        Cell::count(s.seeds - s.converged + s.elsewhere),
                    ]
                })
                .collect(),
        )),
    ]
}
