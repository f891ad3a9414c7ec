//! The equilibria: angles, energies, forces, and how far each is proved.

use census::Census;
use model::Rung;
use model::number::Number;
use paper::Reproduction;

use super::run::word;
use crate::badge::Badge;
use crate::block::{Block, Table, heading, text};
use crate::cell::Cell;
use crate::figures;
use crate::numbers::{fixed, in_words};

pub(crate) fn blocks<'a>(r: &'a Reproduction, census: &Census) -> Vec<Block<'a>> {
    let b = &r.bounds;
    vec![
        heading(2, "positions", "The equilibria of the example"),
        Block::Figure(figures::equilibria(r)),
        Block::Table(angles(r)),
        Block::Table(forces(r)),
        text(format!(
            "No configuration has less energy than {} mgl nor more than {} mgl: the stress matrix is positive \
             semidefinite at E1, negative at E2, and singular at both by the turn about the vertical. E1 lies {} mgl \
             above the first bound, E2 {} mgl below the second. With bars as cables the least energy is only {} mgl, \
             since bar BD is in compression.",
            fixed(b.lower_mgl, 11),
            fixed(b.upper_mgl, 11),
            in_words(b.gap_to_e1_mgl, 2),
            in_words(b.gap_to_e2_mgl, 2),
            fixed(b.cables_mgl, 6),
        )),
        heading(3, "census", "All of them"),
        Block::Figure(figures::census(&model::cases::paper(), census)),
        text(complete(r)),
        heading(3, "evidence", "How far each is proved"),
        text(
            "Five rungs: a solver has converged; both solvers agree and Newton's laws hold for every bar; interval \
             arithmetic proves that exactly one equilibrium is there; a census proves that there is no other; a \
             certificate proves that no configuration has less energy. A rung that was not reached is marked as such.",
        ),
        Block::Table(ladder(r)),
    ]
}

/// Why there are no others.
fn complete(r: &Reproduction) -> String {
    let c = &r.completeness;
    let sextic = c.sextic_roots.map_or_else(|| "no known number of".to_owned(), |n| n.to_string());
    let euler = c.euler.map_or_else(|| "not known".to_owned(), |euler| euler.to_string());
    format!(
        "{} In the plane there are {} equilibria ({}), in space {} circles. Others confirm it without the census: the sextic in cos \
         θ that follows from the equations has {sextic} roots between −1 and 1, counted exactly, each for an equilibrium and \
         its mirror image; the alternating sum of the indices is {}, and the Euler characteristic of the closure curve, known \
         from the lengths alone, is {euler}; `lagrange`, started at each, stays within its box to {} of the chain's length. \
         (x) is none of them: whichever position rounds to its printed digits, V has a slope of at least {} mgl/rad there, \
         and some bar is at least {} degrees away from every equilibrium.",
        if c.complete {
            "The list is proved to be complete."
        } else {
            "**The list is not complete.**"
        },
        c.planar,
        c.indices(),
        c.circles,
        c.alternating_sum,
        in_words(c.lagrange, 2),
        fixed(c.second.least_slope_mgl(), 4),
        fixed(c.second.nearest_deg, 2),
    )
}

fn angles(r: &Reproduction) -> Table {
    let rows = r.equilibria.iter().map(|p| {
        let difference = p.energy_deg.map(|energy| {
            let of = energy.iter().zip(p.lagrange_deg).map(|(e, l)| (e - l).abs());
            of.fold(0.0, |most: f64, d| if most.is_nan() || d <= most { most } else { d })
        });
        let [theta, alpha, beta] = p.lagrange_deg.map(|angle| Number::decimals(angle, 9).into());
        let or_none = |difference: Option<f64>| match difference {
            Some(difference) => Number::significant(difference, 2).into(),
            None => "finds minima only".into(),
        };
        vec![
            p.name.replace('\'', "′").into(),
            theta,
            alpha,
            beta,
            or_none(difference),
            Number::decimals(p.lagrange_mgl, 11).into(),
            or_none(p.energy_mgl.map(|v| (v - p.lagrange_mgl).abs())),
            format!("{} ({})", word(&p.stability.in_plane), p.stability.index_in_plane).into(),
            format!("{} ({})", word(&p.stability.in_space), p.stability.index_in_space).into(),
            Cell::count(p.nullity),
        ]
    });
    Table::new(
        "Angles in degrees from the descending vertical and energies in mgl with the paper's zero, by `lagrange`, and how \
                  far `energy` is from them. In brackets: the number of directions in which the energy falls. Nullity: of \
                  the Jacobian of all 30 equations (three spins of the bars and the turn about OD).",
        "|θ|α|β|energy differs by, deg|V|energy differs by, mgl|in the plane|in space|nullity",
        rows.collect(),
    )
}

fn forces(r: &Reproduction) -> Table {
    let rows = r.equilibria.iter().map(|p| {
        let numbers = |values: &[f64], decimals| {
            Cell::Numbers(values.iter().map(|value| Number::decimals(*value, decimals)).collect())
        };
        [p.name.replace('\'', "′").into()]
            .into_iter()
            .chain(p.forces_mg.iter().map(|force| numbers(force, 8)))
            .chain([numbers(&p.axial_mg, 6)])
            .collect()
    });
    Table::new(
        "The multipliers as forces in mg, across and up: of the ground on the chain at O and D, of the next bar on the \
                  one before at A and B. Axial forces of OA, AB, BD: compression is negative.",
        "|at O (λ₂, λ₃)|at A (λ₅, λ₆)|at B (λ₈, λ₉)|at D (λ₁₁, λ₁₂)|axial",
        rows.collect(),
    )
}

/// One row for each rung of each equilibrium; the mirror images stand on the same rungs.
fn ladder(r: &Reproduction) -> Table {
    let rows = r.equilibria.iter().filter(|p| !p.name.ends_with('\'')).flat_map(|p| {
        Rung::ALL.into_iter().map(|rung| {
            vec![
                p.name.into(),
                rung.to_string().into(),
                Badge::of_rung(p.ladder.is_reached(rung)).into(),
                format!("{:#}", p.ladder.status(rung)).into(),
            ]
        })
    });
    Table::new(
        "The rungs of each equilibrium, lowest first.",
        "|rung||how, or why not",
        rows.collect(),
    )
}
