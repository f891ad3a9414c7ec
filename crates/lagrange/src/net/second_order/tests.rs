//! The plane of a system, by hand.

use super::*;
use crate::net::directions::Directions;
use crate::net::framework::Units;

/// Three joints in a vertical plane at this azimuth, the last one and the second load out of it by
/// so much.
fn shape(azimuth: f64, joint: f64, largest: f64, load: f64) -> (Framework, State) {
    let (sin, cos) = azimuth.sin_cos();
    let (along, normal) = (Vector3::new(cos, sin, 0.0), Vector3::new(-sin, cos, 0.0));
    let node = |load: Vector3<f64>| Node { base: Vector3::zeros(), free: Directions::All, load };
    let framework = Framework {
        units: Units { length_m: 1.0, force_n: 1.0, origin_m: Vector3::zeros() },
        nodes: vec![
            node(Vector3::new(0.0, 0.0, -largest)),
            node(normal * load),
            node(along * (0.5 * largest)),
        ],
        links: Vec::new(),
        ropes: Vec::new(),
        lying: Vec::new(),
        work: crate::net::work::Work::default(),
    };
    let (up, from) = (Vector3::new(0.0, 0.0, 3.0), Vector3::new(7.0, -2.0, 1.0));
    let places = [up, along * 4.0 + up * 2.0, along * 2.0 + normal * joint];
    let places = places.map(|place| place + from).into();
    (framework, State::new(places, Vec::new(), Vec::new()))
}

/// Joints are in the plane to 1e-9 of the extent, here 5, loads to 1e-9 of the largest.
#[test]
fn planes_are_measured_by_the_extent_and_by_the_largest_load() {
    for azimuth in [0.0, 0.7, 2.0, -1.3] {
        let is = |joint: f64, largest: f64, load: f64| {
            let (framework, state) = shape(azimuth, joint, largest, load);
            let normal = plane(&framework, &state);
            if let Some(normal) = normal {
                let [x, y] = [normal.x, normal.y];
                assert!((x * azimuth.cos() + y * azimuth.sin()).abs() < 1e-8);
                assert!((normal.norm() - 1.0).abs() < 1e-15 && normal.z.abs() < 1e-15);
            }
            normal.is_some()
        };
        assert!(is(0.0, 1.0, 0.0));
        for largest in [1e-3, 1.0, 1e3] {
            assert!(is(0.0, largest, 0.9e-9 * largest) && !is(0.0, largest, 1.1e-9 * largest));
            assert!(is(4e-9, largest, 0.0) && !is(6e-9, largest, 0.0));
        }
    }
}

/// Joints on one vertical: the loads say the plane, and where they do not any will do.
#[test]
fn loads_give_a_vertical_line_its_plane() {
    for azimuth in [0.0, 0.7, 2.0] {
        let (mut framework, mut state) = shape(azimuth, 0.0, 1e3, 0.0);
        state.places = vec![Vector3::zeros(), Vector3::z(), Vector3::z() * 2.0];
        let normal = plane(&framework, &state).unwrap();
        assert!((normal.x * azimuth.cos() + normal.y * azimuth.sin()).abs() < 1e-15);
        framework.nodes[2].load = Vector3::zeros();
        assert!((plane(&framework, &state).unwrap().y.abs() - 1.0).abs() < 1e-15);
    }
}

/// A joint 2 m below one anchor and 1 m aside of another, with the curvatures -0.7 and -0.2 along x and y. The
/// self-stress (0.6, 0.8) adds 0.6/2 to both and 0.8/1 to that across x: to twice the way at which the weaker were zero
/// is 1.4 more of that, and 11/3 times as much of the other.
#[test]
fn self_stresses_go_twice_as_far_as_the_weakest_needs() {
    let (mut framework, _) = shape(0.0, 0.0, 1.0, 0.0);
    framework.nodes[0].free = Directions::Held;
    framework.nodes[1].free = Directions::Held;
    let bar = |from, length| {
        let kind = Kind::Bar;
        crate::net::framework::Link {
            from,
            to: 2,
            length,
            within: 0.0,
            compliance: 0.0,
            kind,
            rope: None,
        }
    };
    framework.links = vec![bar(0, 2.0), bar(1, 1.0)];
    let link = |u| Link { u, across: 0.0, along: None, taut: true };
    let links = [link(Vector3::z()), link(Vector3::x())];
    let motions = DMatrix::from_fn(3, 2, |row, column| if row == column { 1.0 } else { 0.0 });
    let stresses = DMatrix::from_fn(2, 1, |row, _| [0.6, 0.8][row]);
    let projected =
        DMatrix::from_fn(2, 2, |row, column| if row == column { [-0.7, -0.2][row] } else { 0.0 });
    let of = (&framework, &links[..], &first_unknowns(&framework)[..], &[0, 1][..]);
    let mut found = stiffened(of, &motions, &stresses, projected).unwrap();
    found.sort_by(f64::total_cmp);
    for (found, wanted) in found.iter().zip([0.7, 1.4 * 11.0 / 3.0 - 0.2]) {
        assert!((found - wanted).abs() < 1e-14, "{found} {wanted}");
    }
}
