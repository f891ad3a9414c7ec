//! The statics judge passes what is right and catches what is not.

use model::{Bar, Equilibrium, Place, Problem, Reactions, SolverName, Vector};
use validate::Tolerances;
use validate::systems::{SystemStatics, judge_chain};

/// Rounding of reference digits and of the judge's own arithmetic.
const ROUNDING: f64 = 1e-14;

/// Places and forces with what follows from them: axial forces and energy.
fn judge(problem: &Problem, joints: &[Vector], forces: &[Vector]) -> SystemStatics {
    let chain = problem.chain();
    let (bars, g) = (chain.bars().iter(), chain.gravity_m_s2());
    let ends =
        |k: usize| -> Option<(Vector, Vector)> { Some((*joints.get(k)?, *joints.get(k + 1)?)) };
    let energies = bars.clone().enumerate().filter_map(|(k, bar)| {
        let ((a, b), part) = (ends(k)?, bar.centre_m() / bar.length_m());
        Some(bar.mass_kg() * g * (a[2] + part * (b[2] - a[2]) - joints[0][2]))
    });
    let axial = bars.enumerate().filter_map(|(k, bar)| {
        let ((a, b), part) = (ends(k)?, bar.centre_m() / bar.length_m());
        let [x, y, z] = *forces.get(k + 1)?;
        let pull = [x, y, z - part * bar.mass_kg() * g];
        let along: Vector = std::array::from_fn(|c| b[c] - a[c]);
        let length = along.iter().map(|x| x * x).sum::<f64>().sqrt();
        Some(pull.iter().zip(along).map(|(f, d)| f * d).sum::<f64>() / length)
    });
    let [start, end] =
        [forces.first(), forces.last()].map(|force| force.copied().unwrap_or_default());
    let some = lagrange::solve(&model::cases::paper(), &lagrange::Settings::default()).unwrap();
    let found = Equilibrium {
        solver: SolverName::LAGRANGE,
        energy_j: model::sum(energies),
        joints_m: joints.to_vec(),
        multipliers_n: forces.to_vec(),
        reactions_n: Reactions { start, end },
        axial_n: axial.collect(),
        ..some.equilibrium
    };
    judge_chain(problem, &found)
}

/// E1 of the paper from the digits of 40-digit root finding (external): joints in m, forces in N.
fn e1() -> (Problem, Vec<Vector>, Vec<Vector>) {
    let problem = model::cases::paper();
    let mg = problem.chain().gravity_m_s2();
    let angles_deg: [f64; 3] =
        [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34];
    let mut joints = vec![[0.0; 3]];
    for angle in angles_deg.map(f64::to_radians) {
        let [x, y, z] = joints[joints.len() - 1];
        joints.push([x, y + angle.sin(), z - angle.cos()]);
    }
    let pull = 0.648_944_835_933_933_6;
    let vertical = [
        2.312_944_292_241_837_6, -1.312_944_292_241_837_6, -0.312_944_292_241_837_6,
        0.687_055_707_758_162_4,
    ];
    let forces = vertical
        .iter()
        .enumerate()
        .map(|(k, z)| [0.0, if k == 0 { -pull * mg } else { pull * mg }, z * mg])
        .collect();
    (problem, joints, forces)
}

#[test]
fn the_reference_digits_of_e1_are_in_balance() {
    let (problem, joints, forces) = e1();
    let statics = judge(&problem, &joints, &forces);
    assert!(statics.passes(ROUNDING), "{statics:?}");
}

/// Two bars: a triangle in the vertical plane. The joint lies where the circles meet, below; the
/// forces follow from the moments of each bar about its anchor.
#[test]
fn the_closed_form_of_two_bars_is_in_balance() {
    let problem = model::cases::get("two-bars").unwrap().problem();
    let chain = problem.chain();
    let (bars, g) = (chain.bars(), chain.gravity_m_s2());
    let d = chain.anchors().difference_m();
    let (a, b) = (d[0].hypot(d[1]), d[2]);
    let span = a.hypot(b);
    let (l1, l2) = (bars[0].length_m(), bars[1].length_m());
    let along = (l1 * l1 - l2 * l2 + span * span) / (2.0 * span);
    let aside = (l1 * l1 - along * along).sqrt();
    let (x, z) = ((along * a + aside * b) / span, (along * b - aside * a) / span);
    let parts = [0, 1].map(|i| bars[i].centre_m() / bars[i].length_m());
    let weights = [0, 1].map(|i| bars[i].mass_kg() * g);
    // Force of bar 2 on bar 1 at the joint: moments of bar 1 about joint 0 and of bar 2 about joint
    // 2. x fz - z fx = parts[0] x w1; (x - a) fz - (z - b) fx = -(1 - parts[1]) (x - a) w2
    let right = [parts[0] * x * weights[0], -(1.0 - parts[1]) * (x - a) * weights[1]];
    let determinant = -x * (z - b) + z * (x - a);
    let fz = (-right[0] * (z - b) + z * right[1]) / determinant;
    let fx = (x * right[1] - (x - a) * right[0]) / determinant;
    let (cx, cy) = (d[0] / a, d[1] / a);
    let world = |h: f64, v: f64| [h * cx, h * cy, v];
    let joints = vec![[0.0; 3], world(x, z), d];
    let forces = vec![world(-fx, weights[0] - fz), world(fx, fz), world(fx, fz + weights[1])];
    let statics = judge(&problem, &joints, &forces);
    assert!(statics.passes(ROUNDING), "{statics:?}");
    // And both solvers find this joint and these forces.
    for found in [
        lagrange::solve(&problem, &lagrange::Settings::default()).unwrap().equilibrium,
        energy::minimise(&problem, &energy::Settings::default()).unwrap().equilibrium,
    ] {
        for k in 0..3 {
            assert!((found.joints_m[1][k] - joints[1][k]).abs() < 1e-12, "{found:?}");
            for (ours, theirs) in forces.iter().zip(&found.multipliers_n) {
                assert!((ours[k] - theirs[k]).abs() < 1e-11, "{found:?}");
            }
        }
    }
}

/// What every change below must exceed: far above rounding, far below the change.
const CAUGHT: f64 = 1e-8;

#[test]
fn every_single_wrong_number_is_caught() {
    let (problem, joints, forces) = e1();
    for k in 0..joints.len() {
        for c in 0..3 {
            let mut moved = joints.clone();
            moved[k][c] += 1e-3;
            let statics = judge(&problem, &moved, &forces);
            assert!(!statics.passes(CAUGHT), "joint {k}, component {c}: {statics:?}");
            let mut pulled = forces.clone();
            pulled[k][c] += 1e-3;
            let statics = judge(&problem, &joints, &pulled);
            assert!(!statics.passes(CAUGHT), "force {k}, component {c}: {statics:?}");
            let mut nan = forces.clone();
            nan[k][c] = f64::NAN;
            assert!(!judge(&problem, &joints, &nan).passes(f64::INFINITY));
            let mut nan = joints.clone();
            nan[k][c] = f64::NAN;
            assert!(!judge(&problem, &nan, &forces).passes(f64::INFINITY));
        }
        let mut flipped = forces.clone();
        flipped[k] = flipped[k].map(|x| -x);
        assert!(!judge(&problem, &joints, &flipped).passes(CAUGHT), "force {k} flipped");
    }
    let mut swapped = forces.clone();
    swapped.swap(1, 2);
    assert!(!judge(&problem, &joints, &swapped).passes(CAUGHT));
    // The mirror image of the forces belongs to the mirror image of the shape.
    let mirrored: Vec<Vector> = forces.iter().map(|[x, y, z]| [*x, -y, *z]).collect();
    assert!(!judge(&problem, &joints, &mirrored).passes(CAUGHT));
}

#[test]
fn arrays_of_the_wrong_length_pass_nothing() {
    let (problem, joints, forces) = e1();
    for (joints, forces) in
        [(&joints[1..], &forces[..]), (&joints[..], &forces[1..]), (&[][..], &[][..])]
    {
        assert!(!judge(&problem, joints, forces).passes(f64::INFINITY));
    }
}

/// A million bars, exact by construction: with the pull of the first anchor given, every bar lies
/// along the force in it, turned by `lean` rad.
fn long(lean: f64) -> (Problem, Vec<Vector>, Vec<Vector>) {
    const BARS: usize = 1_000_000;
    let bars = vec![Bar::homogeneous(1e-6, 1e-6).unwrap(); BARS];
    let weight = 1e-6;
    let (mut joints, mut forces) = (vec![[0.0; 3]], vec![[-0.4, 0.0, 0.55]]);
    // Sums of integers times the weight, and compensated sums of directions: no drift.
    let (mut place, mut lost) = ([0.0_f64; 3], [0.0_f64; 3]);
    for i in 0..BARS {
        let lump = 0.55 - weight * (i as f64 + 0.5);
        let along = f64::atan2(-lump, 0.4) + lean;
        for (k, part) in [(0, along.cos()), (2, along.sin())] {
            let step = 1e-6 * part - lost[k];
            let next = place[k] + step;
            lost[k] = (next - place[k]) - step;
            place[k] = next;
        }
        joints.push(place);
        forces.push([0.4, 0.0, weight * (i as f64 + 1.0) - 0.55]);
    }
    (samples::of_bars(1.0, bars, place), joints, forces)
}

/// The budget of the project.
fn budget() -> f64 {
    Tolerances::project().statics
}

#[test]
fn a_million_bars_in_balance_pass_and_one_wrong_bar_does_not() {
    let (problem, joints, forces) = long(0.0);
    let statics = judge(&problem, &joints, &forces);
    println!("{statics:?}");
    assert!(statics.passes(budget()), "{statics:?}");
    let mut moved = joints.clone();
    moved[500_000][2] += 1e-11;
    let found = judge(&problem, &moved, &forces);
    assert!(!found.passes(budget()), "{found:?}");
    let places = [Place::Member(500_000), Place::Member(500_001)];
    assert!(places.contains(&found.worst), "{found:?}");
}

/// Every bar of a million leans by less than the rounding of its ends explains; together they do
/// not escape.
#[test]
fn errors_too_small_to_see_on_a_bar_are_seen_on_the_chain() {
    let (problem, joints, forces) = long(1e-9);
    let statics = judge(&problem, &joints, &forces);
    println!("{statics:?}");
    assert!(statics.moment <= budget() && statics.length <= budget(), "{statics:?}");
    assert!(statics.balance > budget() && !statics.passes(budget()), "{statics:?}");
}
