//! Every derivative against its difference quotient, for numbers of all kinds.

use model::system::{Joint, Member, Support};
use model::{Bar, Vector};

use super::*;

/// A mast on a slope, held by a rigid bar and springs, with a slack cable and loads of all kinds.
fn system() -> (System, Vec<Vector>, Vec<f64>) {
    let slope = Support::Plane { at_m: [1.0, 0.5, -1.0], normal: [0.6, 0.0, 0.8] };
    let places = vec![
        [-2.0, 0.0, 0.0],
        [2.0, 0.0, 0.5],
        [0.0, 2.0, 0.2],
        [0.1, 0.3, -1.5],
        [1.0, 0.5, -1.0],
        [0.0, -3.0, 0.0],
    ];
    let within = |joint: Joint, at_m: Option<f64>, force_n: Option<f64>| {
        let mass_kg = Some(0.01).filter(|_| joint.mass_kg > 0.0);
        joint.with_tolerances(mass_kg, at_m, force_n).unwrap()
    };
    let joints = vec![
        within(Joint::anchor("A", places[0]), Some(1e-3), None),
        Joint::anchor("B", places[1]),
        Joint::anchor("C", places[2]),
        within(Joint::free("P").with_mass(3.0).with_force([1.0, -2.0, 0.5]), None, Some(0.1)),
        within(Joint::free("Q").with_mass(2.0).held_by(slope), Some(1e-3), Some(0.2)),
        Joint::anchor("D", places[5]),
    ];
    let member = |from: usize, to: usize, stretch: f64, mass_kg: f64| {
        let [x, y, z] = [0, 1, 2].map(|k| places[to][k] - places[from][k]);
        let length_m = x.hypot(y).hypot(z) * stretch;
        let bar = Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).unwrap());
        bar.with_length_tolerance(1e-3)
    };
    let elastic = |member: Member, mass_kg: Option<f64>| {
        member.with_stiffness(500.0).with_tolerances(Some(0.01), mass_kg).unwrap()
    };
    let members = vec![
        member(0, 3, 1.0, 0.0),
        elastic(member(1, 3, 0.95, 0.4), Some(0.02)),
        elastic(member(2, 3, 0.93, 0.0), None),
        elastic(member(3, 4, 0.97, 0.3), Some(0.01)),
        elastic(member(1, 4, 0.98, 0.0), None),
        member(5, 3, 1.2, 0.0).of_kind(Kind::Cable),
    ];
    let system = System::new("mast", 10.0, joints, members).unwrap();
    let axial = vec![20.0, 25.0, 30.0, 15.0, 10.0, 0.0];
    (system, places, axial)
}

#[test]
fn slopes_are_difference_quotients() {
    let (system, places, axial) = system();
    let numbers = system.uncertain();
    let kinds = [
        UncertainNumber::Length(5),
        UncertainNumber::Stiffness(3),
        UncertainNumber::Mass(1),
        UncertainNumber::JointMass(4),
        UncertainNumber::At(4, 2),
        UncertainNumber::Force(3, 0),
    ];
    assert!(kinds.iter().all(|kind| numbers.iter().any(|number| number.number == *kind)));
    let posed = Posed::new(&system, &places, &axial).unwrap();
    let depths = [[0, 2], [1, 4], [0, 0]].map(|ends| Depth { joint: 3, ends });
    let outputs = outputs(&system, &posed.equations, &posed.activities, &depths);
    assert!(outputs.contains(&Output::Spare(5)));
    let tried = AtomicUsize::new(0);
    let (outputs, numbers) = (&outputs[..], &numbers[..]);
    let cover = Cover { system: &system, posed: &posed, numbers, outputs, tried };
    // From the guess to the equilibrium: a few plain steps.
    let start = relaxed(&posed, posed.equations.start(&places, &axial));
    let small = 1e-2;
    let parts = vec![Interval::new(-small, small); numbers.len()];
    let leaf = Leaf::new(&cover, parts, &start).map_err(|failure| failure.reason).unwrap();
    for k in 0..numbers.len() {
        let at = |part: f64| {
            let mut parts = vec![0.0; numbers.len()];
            parts[k] = part;
            leaf.outputs(&cover, &parts).unwrap()
        };
        let (more, less) = (at(small), at(-small));
        for (output, (more, less)) in more.into_iter().zip(less).enumerate() {
            let quotient = (more - less) / Interval::point(2.0 * small);
            let slope = leaf.slope(output, k);
            assert!(!quotient.disjoint(slope), "{output} {k}: {quotient:?} {slope:?}");
            let near = (quotient.mid() - slope.mid()).abs() < 1e-3 * slope.mag() + 1e-7;
            assert!(near, "{output} {k}: {quotient:?} {slope:?}");
        }
    }
}

/// Newton's method with short steps.
fn relaxed(posed: &Posed, mut at: Vec<f64>) -> Vec<f64> {
    let equations = &posed.equations;
    for step in 0..60 {
        let point: Vec<Interval> = at.iter().copied().map(Interval::point).collect();
        let inverse = super::super::inverse::Inverse::of(equations.size, &equations.slope(&point));
        let off = inverse.unwrap().apply(&equations.value(&point).unwrap());
        let part = if step < 40 { 0.3 } else { 1.0 };
        at.iter_mut().zip(off).for_each(|(x, off)| *x -= part * off.mid());
    }
    at
}
