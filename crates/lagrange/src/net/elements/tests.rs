//! A step along its line, by hand.

use model::Bar;
use model::system::{Joint, Member, System};

use super::*;

/// Two members of length 1 between level anchors 1.1 apart, with a load of 2v in their middle: they
/// span $2h/\sqrt{h^2 + v^2}$ under a pull of h across. From h = 4v Newton's step is some 29v long;
/// after an eighth of it the span lacks 0.59 of what it had too much, more than a half, after a
/// sixteenth it has too much again.
#[test]
fn steps_are_halved_until_the_slope_is_half_of_the_first() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("B").with_mass(1.0),
        Joint::anchor("C", [1.1, 0.0, 0.0]),
    ];
    let bar = Bar::homogeneous(1.0, 0.0).unwrap();
    let members = vec![Member::bar(0, 1, bar), Member::bar(1, 2, bar)];
    let framework = Framework::new(&System::new("V", 9.81, joints, members).unwrap());
    let v = -0.5 * framework.nodes[1].load.z;
    let runs = Runs::new(&framework).unwrap();
    let start = |h: f64| Start {
        places: runs.nodes.iter().map(|node| node.base).collect(),
        pulls: vec![Vector3::new(h * v, 0.0, -v)],
        factorisations: 0,
    };
    let newton = (8.0 / 17.0_f64.sqrt() - 1.1) * 17.0_f64.powf(1.5) / 2.0;
    let part = 1.0 / 16.0;
    let mut shape = Shape::new(&framework, &runs, start(4.0));
    let mut stiffness = Stiffness::new(&shape.skeleton, false).unwrap();
    shape.step(&mut stiffness);
    let pull = shape.pulls[0] / v;
    // What is added along the members is a few 1e-4 of the step.
    assert!((pull.x - (4.0 - part * newton)).abs() < 1e-3 * part * newton, "{pull}");
    assert!(pull.y.abs() < 1e-12 && (pull.z + 1.0).abs() < 1e-12);
}

/// By hand: forces (3, 0, -4) and (3, 0, 4) along members of 5 and 10 with compliances 0.1 and 0.2.
#[test]
fn sums_over_a_run_are_those_of_its_members() {
    let step = |length: f64, compliance: f64, z: f64| Step {
        member: 0,
        joint: 0,
        length,
        compliance,
        offset: Vector3::new(0.0, 0.0, z),
    };
    let steps = [step(5.0, 0.1, 0.0), step(10.0, 0.2, 8.0)];
    let pull = Vector3::new(3.0, 0.0, -4.0);
    let all = Sums::of(&steps, &pull);
    let parts = Sums::of(&steps[..1], &pull).plus(&Sums::of(&steps[1..], &pull));
    for sums in [all, parts] {
        // (5/5 + 0.1) (3, -4) + (10/5 + 0.2) (3, 4)
        assert!((sums.span - Vector3::new(9.9, 0.0, 4.4)).norm() < 1e-14);
        assert!((sums.across - 3.3).abs() < 1e-15);
        // 1 (0.36, -0.48, 0.64) + 2 (0.36, 0.48, 0.64)
        let square = Matrix3::new(1.08, 0.0, 0.48, 0.0, 0.0, 0.0, 0.48, 0.0, 1.92);
        assert!((sums.square - square).norm() < 1e-14);
        assert!((sums.least - 25.0).abs() < 1e-13 && (sums.most - 25.0).abs() < 1e-13);
    }
    let law = Law::new(&steps, &pull);
    let compliance = Matrix3::identity() * 3.3
        - Matrix3::new(1.08, 0.0, 0.48, 0.0, 0.0, 0.0, 0.48, 0.0, 1.92) * (1.0 - ALONG);
    assert!((law.stiffness * compliance - Matrix3::identity()).norm() < 1e-13);
}

/// Two runs between the same anchors, one loaded: forces have a direction where they are more than a millionth of the
/// largest of their run, and more than 1e-9 of the largest of all.
#[test]
fn forces_are_clear_in_their_run_and_in_the_whole() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("C", [1.1, 0.0, 0.0]),
        Joint::free("B").with_mass(1.0),
        Joint::free("E"),
    ];
    let bar = Bar::homogeneous(1.0, 0.0).unwrap();
    let members = [(0, 2), (2, 1), (0, 3), (3, 1)].map(|(a, b)| Member::bar(a, b, bar));
    let framework = Framework::new(&System::new("two", 9.81, joints, members.to_vec()).unwrap());
    let runs = Runs::new(&framework).unwrap();
    let load = -framework.nodes[2].load.z;
    let loaded = runs.steps[runs.elements[0].steps.clone()].iter().any(|step| step.member < 2);
    for (heavy, light, clear) in [
        // The first member of the loaded run pulls with so much of the load, the unloaded run with so much.
        (0.5, 1e-3, true),
        (0.5, 1e-8, true),
        (0.5, 1e-10, false),
        (1e-5, 1e-3, true),
        (1e-7, 1e-3, false),
    ] {
        let [heavy, light] = [heavy, light].map(|part| Vector3::new(0.0, 0.0, -part * load));
        let start = Start {
            places: runs.nodes.iter().map(|node| node.base).collect(),
            pulls: if loaded { vec![heavy, light] } else { vec![light, heavy] },
            factorisations: 0,
        };
        assert_eq!(Shape::new(&framework, &runs, start).clear(), clear, "{heavy} {light}");
    }
}
