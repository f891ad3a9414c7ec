//! Closed forms: a bar of EA = 1 N has the free length `l0` and the length `l`, half the span is 1 m.

use model::Bar;
use model::system::{Joint, Member, Support, System};
use samples::root;

use super::*;
use crate::boxes::prove_singular;

/// Feet on level ground, and an apex at this height which moves as `support` says, on a bar from each.
fn tent(feet: &[[f64; 2]], height: f64, support: Support, load_n: f64) -> System {
    let mut joints: Vec<Joint> = feet
        .iter()
        .enumerate()
        .map(|(k, [x, y])| Joint::anchor(format!("F{k}"), [*x, *y, 0.0]))
        .collect();
    joints.push(Joint::free("P").with_force([0.0, 0.0, -load_n]).held_by(support));
    let bar = |(k, [x, y]): (usize, &[f64; 2])| {
        let body = Bar::homogeneous(x.hypot(*y).hypot(height), 0.0).unwrap();
        Member::bar(k, feet.len(), body).with_stiffness(1.0)
    };
    let members = feet.iter().enumerate().map(bar).collect();
    System::new("tent", 9.81, joints, members).unwrap()
}

/// The places of the joints with the apex at this height.
fn at(feet: &[[f64; 2]], height: f64) -> Vec<Point> {
    let apex = std::iter::once([0.0, 0.0, height]);
    feet.iter().map(|[x, y]| [*x, *y, 0.0]).chain(apex).collect()
}

fn proved(feet: &[[f64; 2]], height: f64, support: Support, to: f64) -> PathProof {
    let [none, most] = [0.0, to].map(|load_n| tent(feet, height, support, load_n));
    let shape = at(feet, height);
    prove_path([&none, &most], [0.0, to], &shape, &vec![0.0; feet.len()]).unwrap()
}

const UP: Support = Support::Line { at_m: [0.0; 3], direction: [0.0, 0.0, 1.0] };
const UPRIGHT: Support = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
const GABLE: [[f64; 2]; 2] = [[-1.0, 0.0], [1.0, 0.0]];
const PYRAMID: [[f64; 2]; 4] = [[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]];

/// What one bar of a tent bears at this length.
fn borne_n(l0: f64, l: f64) -> f64 {
    (l * l - 1.0).sqrt() / l * (l0 - l) / l0
}

fn first_is(found: &PathProof, kind: SingularKind, wanted: f64) {
    let (is, value) = found.first.unwrap_or_else(|| panic!("{found:?}"));
    let rounded = Interval::around(wanted, 1e-15 * wanted);
    assert!(is == kind && !value.disjoint(rounded) && value.width() < 1e-13, "{found:?} {wanted}");
    assert!(
        found.to <= wanted && found.to > wanted - 1e-12 && found.stopped.is_none(),
        "{found:?}"
    );
}

#[test]
fn a_shallow_gable_reaches_its_limit() {
    let l0 = 1.25_f64.sqrt();
    let mut tubes = vec![];
    for (support, most) in [(UP, 1.0), (UPRIGHT, 0.1), (UPRIGHT, 100.0)] {
        let found = proved(&GABLE, 0.5, support, most);
        first_is(&found, SingularKind::Limit, 2.0 * borne_n(l0, l0.cbrt()));
        tubes.push(found.tubes);
    }
    // Less than the limit.
    let found = proved(&GABLE, 0.5, UP, 0.038);
    tubes.push(found.tubes);
    samples::assert_frozen(&tubes[..], &[4, 9, 3, 14]);
    assert_eq!((found.to, found.first, found.stopped), (0.038, None, None));
}

/// Across its axis the steep gable has no stiffness where `l^3 = l0 w^2`, before the limit.
#[test]
fn a_steep_gable_branches_first() {
    let l0 = 10_f64.sqrt();
    let l = root(|l| l.powi(3) - l0 * (l * l - 1.0), [2.2, l0]);
    let branch_n = 2.0 * borne_n(l0, l);
    let found = proved(&GABLE, 3.0, UPRIGHT, 2.0);
    first_is(&found, SingularKind::Branch, branch_n);
    println!("{} tubes", found.tubes);
    // The same point alone; there is no limit point, and no branch point at the limit.
    let [none, one] = [0.0, 1.0].map(|load_n| tent(&GABLE, 3.0, UPRIGHT, load_n));
    let near = |l: f64, kind: SingularKind| {
        let load_n = 2.0 * borne_n(l0, l);
        let shape = at(&GABLE, (l * l - 1.0).sqrt() + 1e-9);
        let here = tent(&GABLE, 3.0, UPRIGHT, load_n);
        let (values, axial_n) = ([0.0, 1.0, load_n], [(l - l0) / l0; 2]);
        prove_singular(kind, [&none, &one], &here, values, &shape, &axial_n)
    };
    let value = near(l, SingularKind::Branch).unwrap();
    assert!(!value.disjoint(Interval::around(branch_n, 1e-15)) && value.width() < 1e-13);
    assert!(near(l, SingularKind::Limit).is_err());
    let value = near(l0.cbrt(), SingularKind::Limit).unwrap();
    assert!(value.contains(2.0 * borne_n(l0, l0.cbrt())) && value.width() < 1e-13, "{value:?}");
    assert!(near(l0.cbrt(), SingularKind::Branch).is_err());
    // Neither is at the shape below the feet, which is on another path.
    let load_n = 2.0 * borne_n(l0, l0.cbrt());
    let here = tent(&GABLE, 3.0, UPRIGHT, load_n);
    let shape = at(&GABLE, -(l0.cbrt().powi(2) - 1.0).sqrt());
    let axial_n = [(l0.cbrt() - l0) / l0; 2];
    let values = [0.0, 1.0, load_n];
    assert_eq!(
        prove_singular(SingularKind::Limit, [&none, &one], &here, values, &shape, &axial_n),
        Err(NoBox::NotConverged)
    );
    // An imperfection makes a limit point of the branch point, at less.
    let feet = [[-1.0, 0.0], [1.0 + 1e-6, 0.0]];
    let found = proved(&feet, 3.0, UPRIGHT, 2.0);
    let (kind, value) = found.first.unwrap_or_else(|| panic!("{found:?}"));
    assert_eq!(kind, SingularKind::Limit);
    assert!(value.hi() < branch_n && value.lo() > 0.999 * branch_n, "{value:?} {branch_n}");
}

/// Both modes at once; each breaks a mirror of its own.
#[test]
fn a_steep_pyramid_branches_twice_at_once() {
    let l0 = 17_f64.sqrt();
    let across = |l: f64| 0.5 / l + (l - l0) * (1.0 - 0.5 / (l * l));
    let l = root(across, [2.0, l0]);
    let found = proved(&PYRAMID, 4.0, Support::Free, 2.0);
    first_is(&found, SingularKind::Branch, 4.0 * borne_n(l0, l));
}

/// Without a symmetry in double precision: three bars, and a gable off its centre.
#[test]
fn limits_without_symmetry() {
    let third = std::f64::consts::TAU / 3.0;
    let feet = [0.3, 0.3 + third, 0.3 + 2.0 * third].map(|angle: f64| [angle.cos(), angle.sin()]);
    let l0 = 1.25_f64.sqrt();
    let found = proved(&feet, 0.5, Support::Free, 0.2);
    println!("{} tubes", found.tubes);
    let wanted = 3.0 * borne_n(l0, l0.cbrt());
    let (kind, value) = found.first.unwrap();
    assert_eq!(kind, SingularKind::Limit);
    // The feet are on the circle to rounding.
    assert!((value.mid() - wanted).abs() < 1e-14 && value.width() < 1e-13, "{value:?} {wanted}");
}

/// A cable above, a bar below: the cable is slack from 4 N on.
#[test]
fn the_proof_stops_at_a_kink() {
    let system = |load_n: f64| {
        let line = Support::Line { at_m: [0.0; 3], direction: [0.0, 0.0, 1.0] };
        let joints = vec![
            Joint::anchor("T", [0.0, 0.0, 2.0]),
            Joint::anchor("B", [0.0, 0.0, -1.0]),
            Joint::free("P").with_force([0.0, 0.0, load_n]).held_by(line),
        ];
        let light = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let members = vec![
            Member::cable(0, 2, light(1.8)).with_stiffness(18.0),
            Member::bar(1, 2, light(1.0)).with_stiffness(20.0),
        ];
        System::new("kink", 9.81, joints, members).unwrap()
    };
    let z = 3.0 / 30.0;
    let shape = [[0.0, 0.0, 2.0], [0.0, 0.0, -1.0], [0.0, 0.0, z]];
    let axial_n = [10.0 * (0.2 - z), 20.0 * z];
    let [one, eight] = [1.0, 8.0].map(system);
    let found = prove_path([&one, &eight], [1.0, 8.0], &shape, &axial_n).unwrap();
    assert!(found.first.is_none() && found.to < 4.0 && found.to > 4.0 - 1e-4, "{found:?}");
    assert_eq!(found.stopped, Some(NoBox::WrongSign { member: 1 }));
}

/// Another equilibrium than that of the start is refused, and so is none.
#[test]
fn the_start_is_proved() {
    let [none, one] = [0.0, 1.0].map(|load_n| tent(&GABLE, 0.5, UP, load_n));
    for height in [0.3, 0.51] {
        let found = prove_path([&none, &one], [0.0, 1.0], &at(&GABLE, height), &[0.0; 2]);
        assert_eq!(found, Err(NoBox::NotConverged), "{height}");
    }
}

#[test]
fn a_star_dome_reaches_its_limit() {
    let dome = model::cases::exhibit("star-dome").unwrap().system();
    let under = |factor: f64| {
        let joints = dome
            .joints()
            .iter()
            .map(|joint| joint.clone().with_force(joint.force_n.map(|part| part * factor)));
        let members = dome.members().to_vec();
        System::new("dome", dome.gravity_m_s2(), joints.collect(), members).unwrap()
    };
    let [none, four] = [0.0, 4.0].map(under);
    let shape = dome.drawing().unwrap();
    let begin = std::time::Instant::now();
    let found = prove_path([&none, &four], [0.0, 4.0], &shape, &[0.0; 24]).unwrap();
    println!("{found:?} {:?}", begin.elapsed());
    let (kind, value) = found.first.unwrap();
    assert_eq!(kind, SingularKind::Limit);
    assert!(0.3 * value.lo() > 0.66 && 0.3 * value.hi() < 0.675 && value.width() < 1e-9);
}
