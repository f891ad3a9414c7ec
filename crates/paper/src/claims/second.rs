//! The position (x), which is no equilibrium, and E2, which is.

use energy::example::{Branch, PAPER_STEP_RAD, slope};
use model::InPlane;

use super::multiplier_system::{Misfit, misfit};
use super::{ANGLE_RAD, ENERGY_MGL, Facts, Finding, largest, printed_degrees, smallest};
use crate::example::Planar;
use crate::printed::{Assessment, Printed};
use crate::sentence::Sentence;
use model::number::Number;

/// A slope or a misfit below this, mgl/rad or mg, would be that of an equilibrium printed with five
/// decimals of a degree: 1e-7 rad times curvatures of some mgl. Well above that, far below what is
/// found.
const FLAT: f64 = 1e-4;

pub(super) fn judge(facts: &Facts, printed: &Printed) -> Option<Finding> {
    match printed.id.as_str() {
        "x-theta" => Some(angle(facts, printed, 0)),
        "x-alpha" => Some(angle(facts, printed, 1)),
        "x-beta" => Some(angle(facts, printed, 2)),
        "x-energy" => Some(energy(facts, printed)),
        "x-slope" => Some(slope_at_x(facts)),
        "x-multipliers" => Some(multipliers(facts)),
        "x-listed" => Some(listed(facts)),
        "x-first-point" => Some(first_point(facts, printed)),
        "second" => Some(second(facts, printed)),
        "symmetric-x" => Some(symmetric(facts)),
        "same-second" => Some(same(facts)),
        "abstract-identical" => Some(identical(facts)),
        _ => None,
    }
}

/// The printed angles of (x) from the file, rad, signed.
fn printed_angles(facts: &Facts) -> [f64; 3] {
    ["x-theta", "x-alpha", "x-beta"].map(|id| {
        let degrees = facts.paper.claim(id).map_or(f64::NAN, Printed::value);
        (if degrees > 180.0 { degrees - 360.0 } else { degrees }).to_radians()
    })
}

fn planar_equilibria(facts: &Facts) -> [Planar; 4] {
    facts.example.lagrange.all().map(|found| facts.example.by_lagrange(found))
}

/// The misfit of (40) at the printed (x), or at its mirror image.
fn misfit_at_x(facts: &Facts, side: f64) -> Misfit {
    let angles = printed_angles(facts).map(|angle| side * angle);
    misfit(&facts.example.problem, facts.example.units, &angles)
}

/// An angle of (x): no equilibrium has it.
fn angle(facts: &Facts, printed: &Printed, bar: usize) -> Finding {
    let truth = planar_equilibria(facts).map(|found| printed_degrees(found.angles_rad[bar]));
    let away = |value: &f64| {
        let turn = (printed.value() - value).rem_euclid(360.0);
        turn.min(360.0 - turn)
    };
    let nearest = smallest(truth.iter().map(away));
    let verdict = if truth.iter().any(|value| printed.rounds_to(*value)) {
        Assessment::Confirmed
    } else if nearest.to_radians() < PAPER_STEP_RAD {
        Assessment::Explained
    } else {
        Assessment::Refuted
    };
    let what = "deg to the nearest of the four equilibria; lagrange's value is that of E2";
    Finding::new(verdict, nearest, what).lagrange(truth[2])
}

/// V of (x): no equilibrium has it.
fn energy(facts: &Facts, printed: &Printed) -> Finding {
    let truth = planar_equilibria(facts).map(|found| found.v_mgl);
    let nearest = smallest(truth.map(|v| v - printed.value()));
    let verdict = Assessment::Refuted.unless(truth.iter().any(|v| printed.rounds_to(*v)));
    let what = "mgl to the nearest of the four equilibria; lagrange's value is that of E2";
    Finding::new(verdict, nearest, what).lagrange(truth[2])
}

/// First refutation: the energy is not stationary at (x).
fn slope_at_x(facts: &Facts) -> Finding {
    let [theta, _, _] = printed_angles(facts);
    let found = slope(theta, Branch::FourthQuadrant);
    let at_zero = slope(0.0, Branch::FourthQuadrant);
    let reference = facts.paper.reference("x-slope");
    // Three decimals of the reference.
    let met = (at_zero - reference).abs() <= 0.5e-3;
    // The same slope vanishes where there is an equilibrium.
    let minimum = &facts.example.energy.minimum;
    let control = slope(minimum.theta_rad, Branch::FirstQuadrant).abs() <= FLAT;
    let verdict = Assessment::Refuted.unless(found.abs() <= FLAT);
    let what = Sentence::filled(
        "mgl/rad ({} at theta = 0): V falls on through theta < 0 (at E1 the slope is zero)",
        [Number::decimals(at_zero, 4).into()],
    );
    Finding::new(verdict.if_shown(met && control), found, what).energy(found)
}

/// Second refutation: no multipliers solve (40) at (x).
fn multipliers(facts: &Facts) -> Finding {
    let found = misfit_at_x(facts, 1.0);
    let met = (found.norm - facts.paper.reference("x-residual")).abs() <= 0.5e-4
        && (found.largest - facts.paper.reference("x-residual-largest")).abs() <= 0.5e-4;
    // The same misfit vanishes at an equilibrium.
    let e1 = planar_equilibria(facts)[0].angles_rad;
    let control = misfit(&facts.example.problem, facts.example.units, &e1).norm <= ANGLE_RAD;
    let verdict = Assessment::Refuted.unless(found.norm <= FLAT);
    let what = Sentence::filled(
        "mg: what the best multipliers leave of (40), norm; the largest component is {} (at E1 nothing is left)",
        [Number::decimals(found.largest, 4).into()],
    );
    Finding::new(verdict.if_shown(met && control), found.norm, what).lagrange(found.norm)
}

/// Third refutation, and a proof: (x) is not on the complete list, and the energy has a slope all
/// over the box of positions whose angles round to the printed ones.
fn listed(facts: &Facts) -> Finding {
    let proof = &facts.completeness;
    let x = &proof.second;
    let shown = proof.is_closed() && proof.first.nearest_deg < PAPER_STEP_RAD.to_degrees();
    let what = Sentence::filled(
        "mgl/rad: the slope of V is at least that wherever the angles round to the printed ones, rounded outward; \
         the nearest of all {} equilibria, proved complete by the census, is {} deg away ((ix): {} deg)",
        [
            proof.planar.into(),
            Number::decimals(x.nearest_deg, 2).into(),
            Number::decimals(proof.first.nearest_deg, 4).into(),
        ],
    );
    let verdict = if x.is_refuted() { Assessment::Refuted } else { Assessment::Confirmed };
    Finding::new(verdict.if_shown(shown), x.least_slope_mgl(), what)
}

/// Where (x) comes from: the first point of the scan.
fn first_point(facts: &Facts, printed: &Printed) -> Finding {
    let second = &facts.example.energy.scan.second;
    let step_deg = PAPER_STEP_RAD.to_degrees();
    let shown = second.is_end_point() && printed.rounds_to(step_deg);
    // Before it, the energy is lower still.
    let falls = slope(second.theta_rad, Branch::FourthQuadrant) > FLAT
        && slope(-PAPER_STEP_RAD, Branch::FourthQuadrant) > FLAT;
    let what = Sentence::filled(
        "number of the scan point that it is: the first, theta = 0.001 rad, of {}; before it V is lower",
        [second.points.into()],
    );
    Finding::new(Assessment::Explained.if_shown(shown && falls), second.point as f64, what)
        .energy(step_deg)
}

/// The second equilibrium that does exist.
fn second(facts: &Facts, printed: &Printed) -> Finding {
    let [_, _, e2, mirrored] = planar_equilibria(facts);
    let ids = ["e2-theta", "e2-alpha", "e2-beta"];
    let reference = ids.map(|id| facts.paper.reference(id).to_radians());
    let off =
        largest((0..3).flat_map(|k| {
            [e2.angles_rad[k] - reference[k], mirrored.angles_rad[k] + reference[k]]
        }));
    let energy_off =
        largest([e2, mirrored].map(|found| found.v_mgl - facts.paper.reference("e2-energy")));
    let found = off <= ANGLE_RAD && energy_off <= ENERGY_MGL;
    let maximum = facts.example.lagrange.e2.equilibrium.stability.in_plane == InPlane::Maximum;
    // A minimiser started exactly there does not stay.
    let left = facts.example.by_energy_in_plane(&facts.example.energy.from_e2).v_mgl;
    let falls = e2.v_mgl - left;
    let lower = (left - facts.paper.reference("e1-energy")).abs() <= ENERGY_MGL;
    let verdict = Assessment::Corrected.unless(printed.rounds_to(e2.v_mgl));
    let what = "mgl: what a minimiser loses that starts exactly at E2 (a maximum in the plane) and ends at E1";
    Finding::new(verdict.if_shown(found && maximum && lower), falls, what)
        .lagrange(e2.v_mgl)
        .energy(left)
}

/// The mirror image of (x) is no equilibrium either.
fn symmetric(facts: &Facts) -> Finding {
    let found = misfit_at_x(facts, -1.0).norm;
    let verdict = Assessment::Refuted.unless(found <= FLAT);
    let what = "mg: what the best multipliers leave of (40) at the mirror image of (x)";
    Finding::new(verdict, found, what).lagrange(found)
}

/// Solution 2 does not lead to (x): its nearest equilibrium is far away.
fn same(facts: &Facts) -> Finding {
    let x = printed_angles(facts);
    let distance =
        |found: &Planar| largest((0..3).map(|k| found.angles_rad[k] - x[k])).to_degrees();
    let nearest = smallest(planar_equilibria(facts).iter().map(distance));
    let verdict = Assessment::Refuted.unless(nearest.to_radians() < PAPER_STEP_RAD);
    let what = "deg: the largest angle between (x) and the nearest equilibrium of Solution 2";
    Finding::new(verdict, nearest, what).lagrange(nearest)
}

/// Of the two positions of Solution 1, how many solve the equations of Solution 2?
fn identical(facts: &Facts) -> Finding {
    let first = ["ix-theta", "ix-alpha", "ix-beta"]
        .map(|id| facts.paper.claim(id).map_or(f64::NAN, Printed::value).to_radians());
    let first = misfit(&facts.example.problem, facts.example.units, &first).norm;
    let second = misfit_at_x(facts, 1.0).norm;
    // (ix) is a scan step away from E1, and so is its misfit from zero.
    let verdict = match (first < PAPER_STEP_RAD, second < PAPER_STEP_RAD) {
        (true, true) => Assessment::Confirmed,
        (true, false) => Assessment::Refuted,
        (false, _) => Assessment::Undecided,
    };
    let what = Sentence::filled(
        "mg: what (x) leaves of the equations of the other method, (40); (ix) leaves {}",
        [Number::decimals(first, 4).into()],
    );
    Finding::new(verdict, second, what).lagrange(second)
}
