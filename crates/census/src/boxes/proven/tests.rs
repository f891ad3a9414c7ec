//! What is outside of a box, and the forces of springs between anchors.

use model::Bar;

use super::*;

#[test]
fn distances_are_those_from_the_nearer_end() {
    let part = Interval::new(1.0, 2.0);
    for (x, distance) in [(0.75, 0.25), (1.0, 0.0), (1.5, 0.0), (2.0, 0.0), (4.5, 2.5)] {
        assert_eq!(beyond(part, x).to_bits(), f64::to_bits(distance), "{x}");
    }
    assert!(beyond(part, f64::NAN).is_nan());
    let worst = |distances: [f64; 3]| distances.into_iter().fold(0.0, worse);
    assert_eq!(worst([0.5, 2.0, 1.0]).to_bits(), 2.0_f64.to_bits());
    for distances in [[f64::NAN, 1.0, 2.0], [1.0, f64::NAN, 2.0], [1.0, 2.0, f64::NAN]] {
        assert!(worst(distances).is_nan(), "{distances:?}");
    }
}

/// (2, 3, 6) of 2 m are 14 m: of 8 m a stretch of 3/4, of 16 m one of -1/8.
#[test]
fn springs_between_anchors_have_the_force_of_their_elongation() {
    let places: [Vector; 2] = [[0.0; 3], [2.0, 3.0, 6.0]].map(|at| at.map(Interval::point));
    let force = |kind: Kind, length_m: f64, stiffness_n: Option<f64>| {
        let body = Bar::homogeneous(length_m, 0.0).unwrap();
        let member = Member::bar(0, 1, body).of_kind(kind).with_stiffness(stiffness_n);
        idle_n(&member, &places, 2.0)
    };
    let [long, short] = [8.0, 16.0];
    for (kind, drawn_n, pressed_n) in
        [(Kind::Bar, 24.0, -4.0), (Kind::Cable, 24.0, 0.0), (Kind::Strut, 0.0, -4.0)]
    {
        for (length_m, wanted_n) in [(long, drawn_n), (short, pressed_n)] {
            let found = force(kind, length_m, Some(32.0));
            assert!(found.contains(wanted_n) && found.width() < 1e-13, "{kind:?}: {found:?}");
            assert_eq!(force(kind, length_m, None), Interval::ZERO);
        }
    }
}
