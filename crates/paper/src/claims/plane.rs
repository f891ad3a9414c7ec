//! Section VIII, Solution 2: the plane OYZ, the multipliers, the reactions.

use std::f64::consts::FRAC_PI_2;

use lagrange::{constraint_functions, constraint_matrix};
use model::SolverName;

use super::{ANGLE_RAD, FORCE_MG, Facts, Finding, largest, smallest};
use crate::example::Planar;
use crate::printed::{Assessment, Printed};
use crate::seeds::Kind;
use crate::sentence::Sentence;
use model::number::Number;

pub(super) fn judge(facts: &Facts, printed: &Printed) -> Option<Finding> {
    let reaction = |joint, axis, number| Some(reaction(facts, joint, axis, number));
    match printed.id.as_str() {
        "symmetric-ix" => Some(symmetric(facts)),
        "four" => Some(four(facts, printed)),
        "psi" => Some(psi(facts)),
        "cosine" => Some(cosine(facts)),
        "lambda-x" => Some(across(facts)),
        "same-first" => Some(same(facts)),
        "reaction-o-y" => reaction(0, 1, 2),
        "reaction-o-z" => reaction(0, 2, 3),
        "reaction-a-y" => reaction(1, 1, 5),
        "reaction-a-z" => reaction(1, 2, 6),
        "reaction-b-y" => reaction(2, 1, 8),
        "reaction-b-z" => reaction(2, 2, 9),
        "reaction-d-y" => reaction(3, 1, 11),
        "reaction-d-z" => reaction(3, 2, 12),
        _ => None,
    }
}

/// Largest difference of the angles of two positions, one of them mirrored or not, rad.
fn apart(a: &Planar, b: &Planar, side: f64) -> f64 {
    largest((0..3).map(|k| a.angles_rad[k] - side * b.angles_rad[k]))
}

fn symmetric(facts: &Facts) -> Finding {
    let example = facts.example;
    let e1 = example.by_lagrange(&example.lagrange.e1);
    let lagrange = apart(&example.by_lagrange(&example.lagrange.e1_mirrored), &e1, -1.0);
    let energy = apart(&example.by_energy_in_plane(&example.energy.e1_mirrored), &e1, -1.0);
    let off = largest([lagrange, energy]);
    let verdict = Assessment::Refuted.unless(off <= ANGLE_RAD);
    Finding::new(verdict, off, "rad: largest difference of an angle to minus that of E1")
        .lagrange(lagrange)
        .energy(energy)
}

/// Four planar equilibria: listed and proved complete by the census, counted by the roots of the
/// sextic, and all that random seeds lead to.
fn four(facts: &Facts, printed: &Printed) -> Finding {
    let roots = crate::sextic::roots().unwrap_or_default();
    let exact = 2.0 * roots.len() as f64;
    let survey =
        facts.surveys.iter().find(|s| s.solver == SolverName::LAGRANGE && s.kind == Kind::Planar);
    let found = survey.map_or(f64::NAN, |s| (s.distinct() + usize::from(s.elsewhere > 0)) as f64);
    let cosines = [&facts.example.lagrange.e2, &facts.example.lagrange.e1]
        .map(|found| facts.example.by_lagrange(found).angles_rad[0].cos());
    let met = roots.len() == 2
        && largest((0..2).map(|k| roots[k] - cosines[k])) <= ANGLE_RAD
        && (found - exact).abs() < 0.5
        && facts.completeness.is_closed();
    let verdict = Assessment::Corrected.unless((exact - printed.value()).abs() < 0.5);
    let proof = &facts.completeness;
    let what = Sentence::filled(
        "equilibria, proved: the census encloses {} and excludes all others (indices {}, Euler characteristic {}), \
         and the sextic in cos(theta) has {} roots, each with its mirror image (they are not those of (x))",
        [
            proof.planar.into(),
            proof.indices().into(),
            Number::count(proof.alternating_sum as f64).into(),
            roots.len().into(),
        ],
    );
    Finding::new(verdict.if_shown(met), proof.planar as f64, what).lagrange(found)
}

/// At theta = pi/2 psi and phi turn about the same axis: psi is arbitrary only if phi gives way.
fn psi(facts: &Facts) -> Finding {
    const TURN: f64 = 0.3;
    let found = &facts.example.lagrange.e1;
    let chain = facts.example.problem.chain();
    let angles = facts.example.by_lagrange(found).angles_rad;
    let state = |psi: f64, phi: f64| {
        let mut q = found.q.clone();
        for (bar, angle) in angles.iter().enumerate() {
            q[6 * bar + 3] = psi;
            q[6 * bar + 4] = FRAC_PI_2;
            q[6 * bar + 5] = angle + phi;
        }
        q
    };
    let b = constraint_matrix(chain, &state(0.0, 0.0));
    let columns = largest((0..3).map(|bar| (b.column(6 * bar + 3) - b.column(6 * bar + 5)).amax()));
    let open =
        |psi, phi| constraint_functions(chain, &state(psi, phi)).amax() / facts.example.units.l_m;
    let (alone, together) = (open(TURN, 0.0), open(TURN, -TURN));
    let shown = largest([columns, together]) <= ANGLE_RAD && alone > ANGLE_RAD;
    let what = Sentence::filled(
        "largest difference of columns 4 and 6 of B: gimbal lock. All psi_i turned by {} rad alone break the \
         constraints by {} l, with phi_i turned back by {} l",
        [
            Number::decimals(TURN, 1).into(),
            Number::decimals(alone, 2).into(),
            Number::size(together, 0).into(),
        ],
    );
    Finding::new(Assessment::Explained.if_shown(shown), columns, what).lagrange(columns)
}

/// The paper says that Solution 1 proves it, which it does not. The closure does: AB and BD span at
/// most 2l, so $|D - A|^2 = (5 - 4\cos\theta) l^2 \le 4 l^2$ and $\cos\theta \ge 1/4$ wherever the
/// chain is.
fn cosine(facts: &Facts) -> Finding {
    let all = facts.example.lagrange.all();
    let smallest =
        smallest(all.iter().map(|found| facts.example.by_lagrange(found).angles_rad[0].cos()));
    // Zero is no root of the sextic, and the smallest root is the reference's.
    let root = (smallest - facts.paper.reference("e2-cosine")).abs() <= ANGLE_RAD;
    let verdict = Assessment::Refuted.unless(smallest > ANGLE_RAD);
    Finding::new(
        verdict.if_shown(root),
        smallest,
        "the smallest cos phi_1 of the four equilibria. Solution 1 has no proof of it; a short one is that AB and BD \
         span at most 2l, so that cos theta is at least 1/4 on the whole closure curve",
    )
    .lagrange(smallest)
}

/// No force across the plane.
fn across(facts: &Facts) -> Finding {
    let size = |found: &Planar| largest(found.forces_mg.map(|force| force[0]));
    let lagrange = size(&facts.example.by_lagrange(&facts.example.lagrange.e1));
    let energy = size(&facts.example.by_energy_e1());
    let most = largest([lagrange, energy]);
    let verdict = Assessment::Refuted.unless(most <= FORCE_MG);
    Finding::new(verdict, most, "mg: the largest of the four, by either solver")
        .lagrange(lagrange)
        .energy(energy)
}

fn same(facts: &Facts) -> Finding {
    let e1 = facts.example.by_lagrange(&facts.example.lagrange.e1);
    let other = facts.example.by_energy_e1();
    let off = apart(&e1, &other, 1.0);
    let verdict = Assessment::Refuted.unless(off <= ANGLE_RAD);
    Finding::new(
        verdict,
        off,
        "rad: largest difference of an angle of E1 between the solvers; values: theta, deg",
    )
    .lagrange(e1.angles_rad[0].to_degrees())
    .energy(other.angles_rad[0].to_degrees())
}

/// A multiplier is a reaction: by the multipliers, by virtual work on the energy, and at D by the
/// derivative of the least energy by the anchor.
fn reaction(facts: &Facts, joint: usize, axis: usize, number: usize) -> Finding {
    let example = facts.example;
    let lagrange = example.by_lagrange(&example.lagrange.e1).forces_mg[joint][axis];
    let work = example.by_energy_e1().forces_mg[joint][axis];
    let last = joint == example.problem.chain().bars().len();
    let energy = if last { example.energy.reaction_at_d_mg[axis] } else { work };
    let reference = facts.paper.reference(&format!("lambda-{number}"));
    let off =
        largest([lagrange - energy, lagrange - work, lagrange - reference, energy - reference]);
    let verdict = Assessment::Refuted.unless(off <= FORCE_MG);
    let what = if last {
        "mg: largest difference of multiplier, virtual work, difference quotient of V* and reference"
    } else {
        "mg: largest difference of multiplier, virtual work and reference"
    };
    Finding::new(verdict, off, what).lagrange(lagrange).energy(energy)
}
