//! The paper's example against reference values that were established without this project:
//! 40-digit root finding and a Groebner basis (kind = external).

use census::{Census, Interval};

/// m g l of the example, J; also m g in N.
const MGL: f64 = 9.80665;

/// Angles of E1, degrees.
const E1_DEG: [&str; 3] =
    ["19.69486797613301988864753", "38.5991361844518901070006", "-73.92058879223134081441855"];

/// Angles of E2, degrees.
const E2_DEG: [&str; 3] =
    ["73.92058879223134081441855", "-38.5991361844518901070006", "-19.69486797613301988864753"];

/// V / mgl with the paper's zero, 6 mgl below joint 0.
const E1_ENERGY: &str = "2.33546865199930500930868666574";
const E2_ENERGY: &str = "3.66453134800069499069131333426";

/// λ₂, λ₃, λ₅, λ₆, λ₈, λ₉, λ₁₁, λ₁₂ of E1, mg.
const E1_MULTIPLIERS: [[&str; 2]; 4] = [
    ["-0.6489448359339336338053611", "2.312944292241837598486463"],
    ["0.6489448359339336338053611", "-1.312944292241837598486463"],
    ["0.6489448359339336338053611", "-0.312944292241837598486463"],
    ["0.6489448359339336338053611", "0.687055707758162401513537"],
];

/// The references are rounded to doubles and then scaled: a few units in the last place.
const DIGITS: f64 = 8.0 * f64::EPSILON;

fn census() -> Census {
    crate::support::census(&model::cases::paper())
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or(f64::NAN)
}

fn holds(interval: Interval, reference: f64) -> bool {
    let room = DIGITS * reference.abs();
    interval.lo() - room <= reference && reference <= interval.hi() + room
}

#[test]
fn there_are_exactly_two_circles_and_four_planar_equilibria() {
    let census = census();
    assert!(census.complete && census.circles);
    assert!(census.undecided.is_empty() && census.families.is_empty());
    assert_eq!((census.equilibria.len(), census.count_in_plane()), (2, 4));
    assert_eq!(census.count_by_index(), [2, 2]);
    assert_eq!(census.alternating_sum(), 0);
    let topology = census.topology.as_ref().unwrap();
    assert_eq!((topology.euler, topology.betti.as_slice()), (0, [1, 1].as_slice()));
    assert_eq!(census.morse(), Ok(()));
    assert_eq!(census.check(&model::cases::paper()), Ok(()));
}

#[test]
fn they_are_the_known_ones() {
    let census = census();
    let [low, high] = census.equilibria.as_slice() else { panic!("two circles") };
    for (equilibrium, degrees, energy) in [(low, E1_DEG, E1_ENERGY), (high, E2_DEG, E2_ENERGY)] {
        for (angle, degrees) in equilibrium.angles_rad.iter().zip(degrees) {
            let radians = number(degrees).to_radians();
            assert!(holds(*angle, radians), "{angle:?} {radians}");
            assert!(angle.width() < 1e-13);
        }
        assert!(
            holds(equilibrium.energy_j, (number(energy) - 6.0) * MGL),
            "{:?}",
            equilibrium.energy_j
        );
        assert!(equilibrium.circle);
    }
    // Minimum and maximum in the plane; global minimum, and index 2, in space.
    assert_eq!((low.index_in_plane, low.index_in_space(), low.optimal), (0, 0, true));
    assert_eq!((high.index_in_plane, high.index_in_space(), high.optimal), (1, 2, false));
    // Bars 1 and 2 hang, bar 3 props the chain up.
    assert_eq!(low.signs, [1, 1, -1]);
    // E2 is E1 upside down: V(E1) + V(E2) = 6 mgl.
    assert!((low.energy_j + high.energy_j).contains(-6.0 * MGL));
}

#[test]
fn multipliers_and_joints_of_the_minimum() {
    let census = census();
    let minimum = &census.equilibria[0];
    assert_eq!(minimum.multipliers_n.len(), 4);
    for (force, [y, z]) in minimum.multipliers_n.iter().zip(E1_MULTIPLIERS) {
        assert_eq!(force[0], Interval::ZERO);
        assert!(holds(force[1], number(y) * MGL) && holds(force[2], number(z) * MGL), "{force:?}");
    }
    // Joint A is at (0, sin θ, −cos θ).
    let theta = number(E1_DEG[0]).to_radians();
    let joint = minimum.joints_m[1];
    assert!(holds(joint[1], theta.sin()) && holds(joint[2], -theta.cos()), "{joint:?}");
    assert_eq!(minimum.joints_m[3], [0.0, 0.0, -2.0].map(Interval::point));
    assert!(minimum.axial_n[0].lo() > 0.0 && minimum.axial_n[2].hi() < 0.0);
}

#[test]
fn the_second_result_of_the_paper_is_no_equilibrium() {
    // (x): theta = 0.05730°, alpha = 299.94274°, V = 2.50087 mgl. The angles of every equilibrium,
    // its mirror image included, are further away than a degree.
    let printed = [0.05730_f64, 299.94274 - 360.0, 59.94267].map(f64::to_radians);
    for equilibrium in &census().equilibria {
        for mirror in [1.0, -1.0] {
            let nearest = equilibrium
                .angles_rad
                .iter()
                .zip(printed)
                .map(|(angle, printed)| (*angle - Interval::point(mirror * printed)).mig())
                .fold(0.0, f64::max);
            assert!(nearest > 1_f64.to_radians());
        }
    }
}

/// The widest of angles and pull: far below a hundred roundings, and not zero.
#[test]
fn width_is_that_of_the_widest_enclosure() {
    for equilibrium in &census().equilibria {
        let [h, v] = equilibrium.pull_n;
        let size = h.lo().abs().max(v.lo().abs());
        let pull = h.width().max(v.width()) / size;
        let angles = equilibrium.angles_rad.iter().map(|angle| angle.width()).fold(0.0, f64::max);
        let width = equilibrium.width();
        assert!(width > 0.0 && width < 1e-14);
        assert!((width / pull.max(angles) - 1.0).abs() < 1e-9, "{width:e} {pull:e} {angles:e}");
    }
}
