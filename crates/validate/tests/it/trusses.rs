//! Trusses of rigid bars as they are drawn, against the method of joints and of moments.

use model::system::{Joint, Member, Support, System};
use model::{Bar, STANDARD_GRAVITY_M_S2 as G, Vector};
use nalgebra::Vector3;

use crate::drawn::{axial, close, drawn, linear, neighbour, written};

/// Half of 500 kg g on each support; then joint by joint: a diagonal has the slope 8 in 5.
#[test]
fn the_warren_truss_stands_as_by_the_method_of_joints() {
    let system = drawn("warren-truss");
    let answer = neighbour(&system);
    // Upright parts of the diagonals, in 100 kg g; level parts are 5/8 of them.
    let (diagonal, level) = (89.0_f64.sqrt() / 8.0, 5.0 / 8.0);
    let unit = 100.0 * G;
    for e in &answer.equilibria {
        for (from, to, upright) in [
            ("A", "E", -2.5),
            ("E", "B", 1.5),
            ("B", "F", -0.5),
            ("F", "C", -0.5),
            ("C", "G", 1.5),
            ("G", "D", -2.5),
        ] {
            let wanted = upright * diagonal * unit;
            assert!((axial(&system, e, from, to) - wanted).abs() < 1e-9 * unit, "{from}{to}");
        }
        // A pulls with AE; E hands AE and EB on to EF; B adds EB and BF.
        for (from, to, force) in
            [("A", "B", 2.5), ("B", "C", 4.5), ("C", "D", 2.5), ("E", "F", -4.0), ("F", "G", -4.0)]
        {
            let wanted = force * level * unit;
            assert!((axial(&system, e, from, to) - wanted).abs() < 1e-9 * unit, "{from}{to}");
        }
        assert!((e.reactions_n[system.joint("D").unwrap()][2] - 2.5 * unit).abs() < 1e-9 * unit);
        assert_eq!(e.stability.index_in_space, 0);
    }
    // The heap below is lower, and said so.
    assert!(answer.near.unwrap().lower_j.unwrap() < -1000.0);
    close(&answer.equilibria[0].axial_n, &linear(&system).1, 1e-9 * unit);
}

#[test]
fn rigid_braced_trusses_share_their_loads_as_equally_stiff_bars() {
    let system = drawn("pratt-truss");
    let wanted = linear(&system).1;
    for e in &neighbour(&system).equilibria {
        // 3000 N in all.
        close(&e.axial_n, &wanted, 1e-8 * 3000.0);
    }
}

/// Towers that leave no freedom, each with a brace that has the length of the drawing: it bears nothing but its weight, and
/// the rigid bars bear what they would without it. Its force is judged by what it bears, far less than what the others do.
#[test]
fn a_brace_of_the_length_that_is_drawn_bears_nothing() {
    for levels in 2..6 {
        let place = |level: usize, corner: usize| {
            let [x, y] = [[0.0, 0.0], [2.0, 0.0], [1.0, 2.0]][corner];
            [x + 0.1 * level as f64, y, 2.0 * level as f64]
        };
        let at = |level: usize, corner: usize| 3 * level + corner % 3;
        let corners = (0..=levels).flat_map(|level| (0..3).map(move |corner| (level, corner)));
        let joints = corners.map(|(level, corner)| {
            let (name, at_m) = (format!("{level}{corner}"), place(level, corner));
            let load_n = [20.0 * (corner % 2) as f64, 0.0, -30.0 - corner as f64];
            let joint = Joint::free(name.as_str()).with_mass(5.0).with_force(load_n).near(at_m);
            if level == 0 { Joint::anchor(name, at_m) } else { joint }
        });
        let bar = |from: usize, to: usize| {
            let [a, b] = [from, to].map(|k| Vector3::from(place(k / 3, k % 3)));
            Member::bar(from, to, Bar::homogeneous((b - a).norm(), 1.0).unwrap())
        };
        let mut members: Vec<Member> = (1..=levels)
            .flat_map(|level| {
                (0..3).flat_map(move |corner| {
                    let here = at(level, corner);
                    let others =
                        [at(level - 1, corner), at(level - 1, corner + 1), at(level, corner + 1)];
                    others.map(|other| (here, other))
                })
            })
            .map(|(here, other)| bar(here, other))
            .collect();
        members.push(bar(1, at(levels, 0)).with_stiffness(1e5));
        let system = System::new("tower", G, joints.collect(), members).unwrap();
        let answer = neighbour(&system);
        for found in &answer.equilibria {
            let force_n = found.axial_n[system.members().len() - 1];
            assert!(force_n.abs() < 1e-8, "{levels}, {}: {force_n} N", found.solver);
        }
    }
}

/// Straight trusses of up to 350 panels, of rigid bars: a length that is off by its rounding moves the middle by as many
/// squares of panels, and the chords bear as many squares of loads. Both solvers stay where it is drawn; the force in the
/// middle of the lower chord is the moment there over the height.
#[test]
fn long_trusses_stay_where_they_are_drawn() {
    for panels in [42_u32, 50, 60, 70, 77, 80, 350] {
        let (x, height) = (f64::from, 3.0_f64.sqrt() / 2.0);
        let lower: Vec<Vector> = (0..=panels).map(|k| [x(k), 0.0, 0.0]).collect();
        let upper: Vec<Vector> = (0..panels).map(|k| [x(k) + 0.5, 0.0, height]).collect();
        let (first, last) = (0, panels as usize);
        let mut joints: Vec<Joint> = (0..=last)
            .map(|k| match k {
                0 => Joint::anchor("b0", lower[0]),
                _ if k == last => Joint::free(format!("b{k}"))
                    .held_by(Support::Line { at_m: lower[k], direction: [1.0, 0.0, 0.0] }),
                _ => Joint::free(format!("b{k}")).with_mass(1.0),
            })
            .collect();
        joints.extend((0..last).map(|k| Joint::free(format!("t{k}"))));
        // In the plane of the drawing.
        for joint in joints.iter_mut().skip(1).filter(|joint| joint.support == Support::Free) {
            let at_m = [0.0; 3];
            *joint = joint.clone().held_by(Support::Plane { at_m, normal: [0.0, 1.0, 0.0] });
        }
        let places: Vec<Vector> = lower.iter().chain(&upper).copied().collect();
        let bar = |a: usize, b: usize| Member::bar(a, b, Bar::homogeneous(1.0, 0.0).unwrap());
        let top = |k: usize| last + 1 + k;
        let mut members = vec![];
        for k in first..last {
            members.extend([bar(k, k + 1), bar(k, top(k)), bar(top(k), k + 1)]);
        }
        members.extend((1..last).map(|k| bar(top(k - 1), top(k))));
        let system = System::new("truss", G, joints, members).unwrap();
        let system = system.drawn_at(&places).unwrap();
        let answer = neighbour(&system);
        for found in &answer.equilibria {
            let off = found.joints_m.as_flattened().iter().zip(places.as_flattened());
            let off = off.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
            assert!(off < 1e-9, "{panels} panels, {}: {off} m", found.solver);
        }
        // Between the supports n - 1 loads of 1 kg; the upper joint over the middle of a panel of an odd number.
        let middle = last / 2;
        let (at, loads) = (x(panels / 2) + 0.5, x(panels) - 1.0);
        let moment = G * (0.5 * loads * at - (1..=middle).map(|k| at - k as f64).sum::<f64>());
        let force = axial(
            &system,
            &answer.equilibria[0],
            &format!("b{middle}"),
            &format!("b{}", middle + 1),
        );
        assert!((force / (moment / height) - 1.0).abs() < 1e-9, "{panels} panels: {force} N");
    }
}

/// A triangle on two pins, with a bar between them: it bears nothing that is known, and the others 100 kg g over the root of two.
#[test]
fn a_bar_between_two_pins_is_of_no_account() {
    let text = "plane = \"xz\"\n[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [2, 0, 0] }\n\
        C = { near_m = [1, 0, 1], mass_kg = 100 }\n[[bars]]\nfrom = \"A\"\nto = \"B\"\nmass_kg = 3\n\
        [[bars]]\nfrom = \"A\"\nto = \"C\"\nmass_kg = 0\n[[bars]]\nfrom = \"B\"\nto = \"C\"\nmass_kg = 0\n";
    for e in neighbour(&written(text)).equilibria {
        let borne = -100.0 * G / 2.0_f64.sqrt();
        close(&e.axial_n, &[0.0, borne, borne], 1e-9);
        assert_eq!(e.evidence.self_stresses.unwrap().dimension, 1);
    }
}
