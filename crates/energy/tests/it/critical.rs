//! What the energy says of a shape, against closed forms.

use energy::net::{Critical, critical};
use model::system::{Joint, Member, System};
use model::{Bar, Vector};

use crate::net_support::{bar, close};

/// A lamp of 5 kg on two bars of 5 m between anchors 8 m apart, 50 N, and a cable of 7 m beside them.
fn lamp(kind: fn(usize, usize, Bar) -> Member) -> System {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [8.0, 0.0, 0.0]),
        Joint::free("lamp").with_mass(5.0),
        Joint::anchor("C", [4.0, 0.0, 2.0]),
    ];
    let light = |length_m| Bar::homogeneous(length_m, 0.0).expect("a bar");
    let cable = Member::cable(3, 2, light(7.0));
    let members = vec![cable, kind(0, 2, light(5.0)), kind(2, 1, light(5.0))];
    System::new("lamp", 10.0, joints, members).expect("a system")
}

fn at(system: &System, lamp_m: Vector) -> Critical {
    let found = critical(system, &[[0.0; 3], [8.0, 0.0, 0.0], lamp_m, [4.0, 0.0, 2.0]]);
    found.expect("it has an energy").expect("it is small")
}

/// Below the anchors the bars pull with 50 N · 5 / 6 and swing out of their plane with twice that over their
/// length, twice the stiffness across of one; above them they push, and it falls to the side.
#[test]
fn a_lamp_on_two_bars_hangs_or_stands() {
    let system = lamp(Member::bar);
    for (z_m, index, curvature) in [(-3.0, 0, 2.0), (3.0, 1, -2.0)] {
        let found = at(&system, [4.0, 0.0, z_m]);
        assert!(found.is_equilibrium() && found.misfit < 1e-14, "{found:?}");
        assert_eq!(found.index, index);
        let across_n_m = 50.0 * 5.0 / 6.0 / 5.0;
        close(found.stiffest_n_m, across_n_m);
        close(found.curvature_n_m.expect("it is small"), curvature * across_n_m);
    }
    // A shape that keeps the lengths and is not level, and one that does not keep them.
    let (sine, cosine) = 0.3_f64.sin_cos();
    let aside = at(&system, [4.0, -3.0 * sine, -3.0 * cosine]);
    assert!(!aside.is_equilibrium() && aside.misfit < 1e-14, "{aside:?}");
    let longer = at(&system, [4.0, 0.0, -3.3]);
    assert!(longer.misfit > 0.01 && !longer.is_equilibrium(), "{longer:?}");
}

/// Cables do not push: above the anchors nothing bears the 50 N, of which the largest force is made.
#[test]
fn cables_bear_nothing_above_their_anchors() {
    let system = lamp(Member::cable);
    assert!(at(&system, [4.0, 0.0, -3.0]).is_equilibrium());
    let above = at(&system, [4.0, 0.0, 3.0]);
    assert!(!above.is_equilibrium());
    close(above.unbalance, 1.0);
}

/// A spring of 2 m and EA 40 N from above bears 10 N at 2.5 m, and its own 40 N / 2 m up and down; two bars do
/// the rest: balance with other terms at each place.
#[test]
fn springs_bear_what_their_length_says() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [8.0, 0.0, 0.0]),
        Joint::free("lamp").with_mass(5.0),
        Joint::anchor("C", [4.0, 0.0, -0.5]),
    ];
    let spring = Bar::homogeneous(2.0, 0.0).expect("a bar");
    let members = vec![
        Member::bar(3, 2, spring).with_stiffness(40.0),
        bar(0, 2, 5.0, 0.0),
        bar(2, 1, 5.0, 0.0),
    ];
    let system = System::new("held", 10.0, joints, members).expect("a system");
    let at_m = [[0.0; 3], [8.0, 0.0, 0.0], [4.0, 0.0, -3.0], [4.0, 0.0, -0.5]];
    let found = critical(&system, &at_m).expect("it has an energy").expect("it is small");
    assert!(found.is_equilibrium() && found.index == 0, "{found:?}");
    // Across: 10 N over 2.5 m, and twice 40 N · 5 / 6 over 5 m; the stiffest is the spring, 20 N/m.
    close(found.curvature_n_m.expect("it is small"), 4.0 + 2.0 * 200.0 / 30.0);
    close(found.stiffest_n_m, 20.0);
}

/// What rounding of the places leaves open: eight roundings of the furthest place over the shortest length, times
/// the stiffness of the stiffest member over the largest force. Of members of 2 m and 0.25 m, 40 GN and 10 N.
#[test]
fn stiff_members_may_be_out_of_balance_by_rounding() {
    let joints = samples::joints(&[[0.0; 3], [0.0, 0.0, -2.25]], &[0.5]);
    for stiffness_n in [4e10, 3e8] {
        let members = vec![
            bar(0, 2, 2.0, 0.0).with_stiffness(stiffness_n),
            bar(1, 2, 0.25, 0.0).with_stiffness(10.0),
        ];
        let system = System::new("stiff", 10.0, joints.clone(), members).expect("a system");
        let at_m = [[0.0; 3], [0.0, 0.0, -2.25], [0.0, 0.0, -2.0 * (1.0 + 5.0 / stiffness_n)]];
        let found = critical(&system, &at_m).expect("it has an energy").expect("it is small");
        let reference_m = system.reference_m();
        let extent_m = at_m.iter().map(|at| (at[2] - reference_m[2]).abs()).fold(0.0, f64::max);
        let rounding = 8.0 * f64::EPSILON * (1.0 + extent_m / 0.25) * stiffness_n / 5.0;
        assert!((found.allowed / (1e-9 + rounding) - 1.0).abs() < 1e-4, "{found:?} {rounding:e}");
        assert!(found.is_equilibrium(), "{found:?}");
    }
}

/// In UTM coordinates places are stored to 1e-9 m, which is 2 N of a member of 1e9 N over 0.5 m.
#[test]
fn places_far_from_the_origin_are_equilibria_to_their_digits() {
    let [east_m, north_m] = [500_000.1, 5_400_000.3];
    let joints = |apart_m: f64| {
        vec![
            Joint::anchor("A", [east_m - apart_m, north_m, 432.1]),
            Joint::anchor("B", [east_m + apart_m, north_m, 432.1]),
            Joint::free("P").with_force([0.0, 0.0, -1000.0]),
        ]
    };
    // The members are stretched to 0.5 m each, 0.3 m down: each bears 1000 N / 2 over 0.6.
    let (stiffness_n, force_n) = (1e9, 500.0 / 0.6);
    let length_m = 0.5 / (1.0 + force_n / stiffness_n);
    let members = [0, 1].map(|from| bar(from, 2, length_m, 0.0).with_stiffness(stiffness_n));
    let system = System::new("far", 10.0, joints(0.4), members.to_vec()).expect("a system");
    let at = |lower_m: f64| {
        let places: Vec<Vector> = system.joints().iter().filter_map(|j| j.support.at_m()).collect();
        let lamp_m = [east_m, north_m, 432.1 - 0.3 - lower_m];
        critical(&system, &[places[0], places[1], lamp_m])
            .expect("it has an energy")
            .expect("small")
    };
    assert!(at(0.0).is_equilibrium(), "{:?}", at(0.0));
    assert!(!at(1e-6).is_equilibrium(), "{:?}", at(1e-6));
}
