//! The proof and its pieces: numbers by hand.

use model::{Anchors, Chain, Evidence, InPlane, InSpace, Reactions, SolverName, Stability};

use super::*;

/// The paper's chain in units of l, m, g.
fn paper() -> Problem {
    samples::homogeneous(1.0, &[(1.0, 1.0); 3], [0.0, 0.0, -2.0])
}

/// An answer with the numbers the certificate reads; reference digits, external.
pub(crate) fn answer(end: Vector, axial_n: [f64; 3], energy_j: f64) -> Equilibrium {
    Equilibrium {
        solver: SolverName::LAGRANGE,
        energy_j,
        // Only the last joint is read.
        joints_m: vec![[0.0, 0.0, -2.0]],
        multipliers_n: Vec::new(),
        reactions_n: Reactions { start: [0.0; 3], end },
        axial_n: axial_n.to_vec(),
        stability: Stability {
            in_plane: InPlane::Minimum,
            index_in_plane: 0,
            in_space: InSpace::Stable,
            index_in_space: 0,
        },
        evidence: Evidence::new("given", 0.0, 0.0, 0),
    }
}

const E1_END: Vector = [0.0, 0.648_944_835_933_933_7, 0.687_055_707_758_162_4];
const E1_ENERGY: f64 = 2.335_468_651_999_305 - 6.0;
const E1_SIGNS: [f64; 3] = [1.0, 1.0, -1.0];

#[test]
fn e1_of_the_paper_is_proved_to_be_the_global_minimum() {
    let certificate = certify(&paper(), &answer(E1_END, E1_SIGNS, E1_ENERGY)).unwrap();
    assert!(certificate.gap < 1e-13, "{certificate:?}");
    assert!(certificate.singular, "both anchors lie on one vertical: the chain turns freely");
    assert_eq!(certificate.compressed_bar, Some(3));
}

/// Two bars of length 1 between anchors 1e-14 apart lie level. Hanging straight down they miss
/// the anchor by a rounding, and have so much less energy that every bound is far above.
#[test]
fn an_answer_that_is_no_configuration_gets_no_certificate() {
    let problem = samples::homogeneous(1.0, &[(1.0, 1.0); 2], [0.0, 0.0, -1e-14]);
    let hanging = Equilibrium {
        joints_m: vec![[0.0; 3]],
        axial_n: vec![0.5, 0.5],
        ..answer([0.0, 0.0, 1.0], E1_SIGNS, -1.0)
    };
    assert!(matches!(certify(&problem, &hanging), Err(NoCertificate::NotClosed { .. })));
}

/// What rests on the last anchor moves nothing: a certificate is as tight with it as without,
/// and as strict.
#[test]
fn weight_on_the_last_anchor_changes_no_certificate() {
    let heavy = 1e6;
    let gaps = [0.0, heavy].map(|resting| {
        let bars = [
            Bar::homogeneous(1.0, 1.0).unwrap(),
            Bar::homogeneous(0.8, 1.0).unwrap(),
            Bar::new(0.9, resting, 0.9, [0.0; 3]).unwrap(),
        ];
        let problem = samples::of_bars(1.0, bars, [1.0, 0.0, 0.3]);
        let settings = lagrange::condensed::Settings::default();
        let found = lagrange::condensed::solve(&problem, &settings).unwrap().equilibrium;
        let off = Equilibrium { energy_j: found.energy_j + 1e-8, ..found.clone() };
        assert!(matches!(certify(&problem, &off), Err(NoCertificate::Gap { .. })));
        certify(&problem, &found).unwrap().gap
    });
    assert!(gaps[0] < 1e-13 && gaps[1] < 4.0 * f64::EPSILON * heavy, "{gaps:?}");
}

/// Anchors 1 m apart on one vertical, from the upper one a bar of `a = 2^-10` m with 1 kg at its
/// end, which a bar of 1 m props up. Both force densities are 1 N/m, so that the matrix is
/// singular, and `1/(1 + e)` of the prop's compression is all that is proved: with the unit
/// roundoff `u`, `e = 32 u · 2/a`, since the short bar's force of `a` N is a difference of forces
/// of 2 N together. By closure that costs `2 e` of the prop's 1 N times 1 m.
#[test]
fn the_gap_of_a_singular_turn_is_what_the_prop_is_reduced_by() {
    let short = 2.0_f64.powi(-10);
    let bars =
        [Bar::new(short, 1.0, short, [0.0; 3]).unwrap(), Bar::homogeneous(1.0, 0.0).unwrap()];
    let problem = samples::of_bars(1.0, bars, [0.0, 0.0, -1.0]);
    // The triangle of 1, 1 and a has the height a²/2 over its foot.
    let down = 0.5 * short * short;
    let end = [short * (1.0 - 0.25 * short * short).sqrt(), 0.0, 1.0 - down];
    let found = Equilibrium {
        joints_m: vec![[0.0, 0.0, -1.0]],
        axial_n: vec![short, -1.0],
        ..answer(end, E1_SIGNS, -down)
    };
    let certificate = certify(&problem, &found).unwrap();
    assert!(certificate.singular && certificate.compressed_bar == Some(2));
    let lost = 2.0 * (32.0 * U * 2.0 / short);
    assert!((certificate.gap / lost - 1.0).abs() < 0.02, "{:e} {lost:e}", certificate.gap);
}

#[test]
fn what_is_no_minimum_gets_no_certificate() {
    // E2 is E1 upside down: two bars pressed (bars 1 and 2 of E2 are 3 and 2 of E1 reversed).
    let end = [0.0, 0.648_944_835_933_933_7, 3.0 - 0.687_055_707_758_162_4];
    let e2 = answer(end, [1.0, -1.0, -1.0], -E1_ENERGY - 6.0);
    assert_eq!(certify(&paper(), &e2), Err(NoCertificate::SeveralCompressed { bars: 2 }));
    // More energy than the minimum, less than the minimum, NaN.
    for energy in [E1_ENERGY + 1e-6, E1_ENERGY - 1e-6, f64::NAN] {
        assert!(certify(&paper(), &answer(E1_END, E1_SIGNS, energy)).is_err());
    }
    // A wrong force: the bound still holds, but says less.
    for k in 1..3 {
        let mut end = E1_END;
        end[k] += 1e-3;
        assert!(certify(&paper(), &answer(end, E1_SIGNS, E1_ENERGY)).is_err(), "{k}");
    }
    // A wrong sign: as if bar 3 were pulled.
    let wrong = answer(E1_END, [1.0; 3], E1_ENERGY);
    assert!(matches!(certify(&paper(), &wrong), Err(NoCertificate::Gap { .. })));
}

/// What is compared with bits that are exact.
fn is(found: f64, wanted: f64) {
    assert_eq!(found.to_bits(), wanted.to_bits(), "{found:e}, not {wanted:e}");
}

fn chain(gravity: f64, end_m: Vector, bars: Vec<Bar>) -> Chain {
    Chain::new("by hand", gravity, Anchors { start_m: [0.0; 3], end_m }, bars).unwrap()
}

/// 8 kg at a quarter of 2 m, 3 kg at a quarter of 4 m, 5 kg at four fifths of 5 m: the far joints
/// bear 2, 3/4 and 4 kg. Without the 40 N of the last the bars feel 100 N less the weight from them
/// on: nothing, the 1 + 3/4 kg at the second joint, and 4 + 2 kg at the first as well.
#[test]
fn a_bar_bears_what_hangs_between_it_and_the_anchor() {
    let bars = [(2.0, 8.0, 0.5), (4.0, 3.0, 1.0), (5.0, 5.0, 4.0)]
        .map(|(length, mass, centre)| Bar::new(length, mass, centre, [0.0; 3]).unwrap());
    let forces = bar_forces(&bars, 10.0, [1.0, 2.0, 100.0]);
    assert_eq!(forces, [[1.0, 2.0, 40.0], [1.0, 2.0, 82.5], [1.0, 2.0, 100.0]]);
    is(last_part(&bars), 4.0);
    is(last_part(&[]), 0.0);
    // 2 + 9/4 kg and 3/4 + 1 kg.
    is(hanging_n(&chain(10.0, [3.0, 0.0, 0.0], bars.to_vec())), 60.0);
    // Nothing hangs between the anchors of one bar.
    is(hanging_n(&chain(10.0, [3.0, 0.0, 0.0], bars[1..2].to_vec())), 30.0);
}

/// From the anchor on 1, 2^53 + 2 and 3 kg: the sums 2^53 + 3 and 2^53 + 6 round to even ones, and
/// what they lose is kept.
#[test]
fn no_weight_is_lost_beside_a_heavy_bar() {
    let heavy = 2.0_f64.powi(53);
    let bars = [4.0, 3.0, heavy + 2.0, 1.0].map(|mass| Bar::new(1.0, mass, 0.0, [0.0; 3]).unwrap());
    let forces = bar_forces(&bars, 1.0, [0.0; 3]);
    is(forces[3][2], 0.0);
    is(forces[2][2], -1.0);
    is(forces[0][2], -(heavy + 6.0));
}

#[test]
fn one_bar_may_be_pressed_by_more_than_nothing() {
    let pressed = |axial_n: &[f64]| the_compressed_bar(axial_n, 4.0);
    assert_eq!(pressed(&[3.0, 0.0, -3.9e-12]), Ok(None));
    assert_eq!(pressed(&[3.0, 0.0, -4.0 * 1e-12]), Ok(None));
    assert_eq!(pressed(&[3.0, 0.0, -4.1e-12]), Ok(Some(2)));
    assert_eq!(pressed(&[3.0, -5.0, -3.9e-12, 6.0]), Ok(Some(1)));
    for (axial_n, bars) in [(&[-1.0, -1.0, 1.0][..], 2), (&[-1.0, -2.0, 4.0, -3.0][..], 3)] {
        assert_eq!(pressed(axial_n), Err(NoCertificate::SeveralCompressed { bars }));
    }
}

/// Bars of 3, 5 and 7 m over 4 m: the longest leaves `8 - 7 + 4 = 5` m of slack. Over 13 m it is
/// the whole that leaves 2 m. A tenth of that may be open.
#[test]
fn the_last_joint_may_be_a_tenth_of_the_slack_from_its_anchor() {
    let bars = [3.0, 5.0, 7.0].map(|length| Bar::homogeneous(length, 1.0).unwrap());
    let rounding = 8.0 * f64::EPSILON * 15.0;
    for (end_m, slack) in [([0.0, 0.0, -4.0], 5.0), ([3.0, 4.0, 12.0], 2.0)] {
        let chain = chain(1.0, end_m, bars.to_vec());
        let open = |off: Vector| {
            let last = std::array::from_fn(|k| end_m[k] + off[k]);
            closed(&chain, last)
        };
        for k in 0..3 {
            for sign in [1.0, -1.0] {
                let off =
                    |size: f64| std::array::from_fn(|c| if c == k { sign * size } else { 0.0 });
                assert_eq!(open(off(0.099 * slack)), Ok(()));
                let Err(NoCertificate::NotClosed { gap_m, slack_m }) = open(off(0.101 * slack))
                else {
                    panic!("{k}: {sign}")
                };
                assert!((gap_m - (0.101 * slack - rounding)).abs() < 5e-15, "{gap_m:e}");
                is(slack_m, slack);
            }
        }
        assert!(open([0.0, f64::NAN, 0.0]).is_err());
    }
    // Exactly as much is none too much.
    let chain = chain(1.0, [0.0, 0.0, -4.0], bars.to_vec());
    for (more, within) in [(0.0, true), (1e-14, false)] {
        let last = [0.0, 0.0, -3.5 + rounding + more];
        assert_eq!(closed(&chain, last).is_ok(), within, "{more}");
    }
    let nowhere = Equilibrium { joints_m: vec![], ..answer(E1_END, E1_SIGNS, E1_ENERGY) };
    assert_eq!(certify(&paper(), &nowhere), Err(NoCertificate::Unusable));
}

/// Bars of some lengths with forces of some sizes in any direction.
fn loaded(bars: [(f64, Vector); 3]) -> ([Bar; 3], [Vector; 3]) {
    (bars.map(|(length, _)| Bar::homogeneous(length, 1.0).unwrap()), bars.map(|(_, force)| force))
}

/// Compliances of 3/12 and 7/56 beside 5/10, 6/48 or one without end.
#[test]
fn a_pressed_bar_must_be_softer_than_the_others_together() {
    let reduced = |own: (f64, Vector), rest: Vector| {
        let (bars, forces) = loaded([(3.0, rest), own, (7.0, [0.0, 56.0, 0.0])]);
        reduced_compression(&bars, &forces, 84.0, 1)
    };
    let twelve = [0.0, 0.0, -12.0];
    let (nu, singular) = reduced((5.0, [6.0, 0.0, 8.0]), twelve).unwrap();
    is(nu, -50.0);
    assert!(!singular);
    // 3/8 less 1/8, of both together.
    let excess = |found: Result<_, NoCertificate>| match found {
        Err(NoCertificate::Indefinite { bar: 2, excess }) => excess,
        other => panic!("{other:?}"),
    };
    is(excess(reduced((6.0, [0.0, 0.0, 48.0]), twelve)), 0.5);
    is(excess(reduced((5.0, [6.0, 0.0, 8.0]), [0.0; 3])), 1.0);
}

/// 6 m with 16 N are as soft as 3 m with 12 N and 7 m with 56 N together: 3/8 m/N. With 84 N besides,
/// the roundings of the two are `32 u (8/4 + (5/2)/8) = 74 u` and of the one `32 u (3/8) (25/4) =
/// 75 u`: what is less than 149 u apart is one. The reduced compression is `36 (8/3)` N m less `74 u
/// (8/3)` and `32 u` of it.
#[test]
fn what_rounding_cannot_tell_apart_is_singular_and_reduced() {
    let reduced = |steps: f64| {
        // A step of 2^-51 m is u/3 m/N.
        let first = 3.0 + steps * 2.0_f64.powi(-51);
        let bars = [(first, [0.0, 12.0, 0.0]), (6.0, [16.0, 0.0, 0.0]), (7.0, [0.0, 0.0, 56.0])];
        let (bars, forces) = loaded(bars);
        reduced_compression(&bars, &forces, 84.0, 1)
    };
    let (nu, singular) = reduced(0.0).unwrap();
    assert!(singular);
    let less = 1.0 + nu / 96.0;
    assert!((less / U - (74.0 * 8.0 / 3.0 + 32.0)).abs() < 4.0, "{}", less / U);
    assert!(reduced(444.0).is_ok_and(|(_, singular)| singular));
    let beyond = reduced(450.0);
    assert!(matches!(beyond, Err(NoCertificate::Indefinite { bar: 2, .. })), "{beyond:?}");
    assert!(reduced(-444.0).is_ok_and(|(_, singular)| singular));
    assert!(reduced(-450.0).is_ok_and(|(_, singular)| !singular));
}

/// Bars of 3, 4 and 7 m with 12, 10 and 56 N along the axes. With the second one's `ν` at -32 N m its
/// direction is `4/-32 · 10 = -5/4` long, so that they reach to (3, 7, -5), and its density is 2.
fn slack_j(force_n: f64, difference: Vector) -> f64 {
    let bars = [(3.0, [12.0, 0.0, 0.0]), (4.0, [0.0, 0.0, 10.0]), (7.0, [0.0, 56.0, 0.0])];
    let (bars, forces) = loaded(bars);
    closure_slack(&bars, &forces, force_n, difference, 1, -32.0)
}

/// 3 m off, and `3 + 4 (1 + 5/4) = 12`: 2 (12 · 3 + 9/2) J. Rounding adds `32 u` of all lengths to the
/// 3 m, each of which costs `2 (12 + 3 + 3)` J, and `32 u` of the whole.
#[test]
fn what_is_open_costs_its_square_and_its_product_with_the_pressed_bar() {
    let rounding = 36.0 * 32.0 * 14.0 / 81.0 + 32.0;
    for off in [[0.0, 0.0, 3.0], [0.0, -3.0, 0.0], [3.0, 0.0, 0.0]] {
        let found = slack_j(0.0, [3.0 + off[0], 7.0 + off[1], -5.0 + off[2]]);
        let more = (found / 81.0 - 1.0) / U;
        assert!((more - rounding).abs() < 6.0, "{off:?}: {more}, not {rounding}");
    }
    // (1, -2, 2) is 3 m long, too.
    assert!((slack_j(0.0, [4.0, 5.0, -3.0]) - 81.0).abs() < 1e-11);
}

/// Of what closes rounding is left: `32 u (3 · 8 + 4 (47/5) + 7 (5/2))` m with 84 N besides, twice
/// `4 (1 + 5/4)` of it.
#[test]
fn what_closes_costs_its_rounding() {
    let open = 32.0 * U * (24.0 + 37.6 + 17.5);
    let found = slack_j(84.0, [3.0, 7.0, -5.0]);
    assert!((found / (18.0 * open) - 1.0).abs() < 1e-12, "{found:e}");
}

/// 21 N on the joint of two bars of 5 and 13 m over (15, 0, 1): by the closed form 20 and 13 N, and
/// -84 J. The weight of the second one rests on its anchor, 1 m up.
fn two(resting: f64) -> (Problem, Equilibrium) {
    let bars = vec![
        Bar::new(5.0, 21.0, 5.0, [0.0; 3]).unwrap(),
        Bar::new(13.0, resting, 13.0, [0.0; 3]).unwrap(),
    ];
    let end_m = [15.0, 0.0, 1.0];
    let problem = Problem::new(chain(1.0, end_m, bars)).unwrap();
    let found = Equilibrium {
        joints_m: vec![end_m],
        axial_n: vec![20.0, 13.0],
        ..answer([12.0, 0.0, 5.0 + resting], E1_SIGNS, -84.0 + resting)
    };
    (problem, found)
}

/// `12 · 15 + 5 · 1` less `5 · 20 + 13 · 13` J, and twice the `32 u` of 13 + 21 N times 18 m and the
/// distance of the anchors.
#[test]
fn the_bound_of_two_bars_is_their_energy_less_rounding() {
    let (problem, found) = two(3.0);
    let certificate = certify(&problem, &found).unwrap();
    let rounding = 2.0 * 32.0 * 34.0 * (18.0 + 226.0_f64.sqrt()) * U;
    assert!((certificate.gap_j / rounding - 1.0).abs() < 0.01, "{certificate:?}");
    is(certificate.gap_j, -81.0 - certificate.bound_j);
    is(certificate.gap, certificate.gap_j / (21.0 * 18.0));
    assert!(certificate.compressed_bar.is_none() && !certificate.singular);
}

/// 2^24 N on the last anchor, 1 m up: `4 u` of that twice, 2^-26 J, besides the rounding of what
/// hangs.
#[test]
fn what_rests_on_the_anchor_costs_its_own_rounding() {
    let (problem, found) = two(2.0_f64.powi(24));
    let certificate = certify(&problem, &found).unwrap();
    assert!((certificate.gap_j - 2.0_f64.powi(-26)).abs() < 2.0_f64.powi(-28), "{certificate:?}");
}

#[test]
fn numbers_that_are_missing_or_none_are_unusable() {
    let (problem, right) = two(3.0);
    assert!(certify(&problem, &right).is_ok());
    let changes: [fn(&mut Equilibrium); 5] = [
        |a| a.axial_n.truncate(1),
        |a| a.axial_n[1] = f64::NAN,
        |a| a.reactions_n.end[1] = f64::INFINITY,
        |a| a.energy_j = f64::NAN,
        |a| a.joints_m.clear(),
    ];
    for (k, change) in changes.into_iter().enumerate() {
        let mut found = right.clone();
        change(&mut found);
        assert_eq!(certify(&problem, &found), Err(NoCertificate::Unusable), "{k}");
    }
}
