//! Enclosures of `ω²` against closed forms, and what they do not claim.

use model::Bar;
use model::system::{Joint, Kind, Member, Support, System};
use motion::{Enclosures, EquilibriumBox, NotEnclosed, enclose_modes};
use numerics::{DoubleDouble, Interval};
use proptest::prelude::*;

use crate::common::{hanging, links, rods};

fn exact(x: f64) -> Interval {
    Interval::point(x)
}

/// Enclose the modes of a string that hangs straight, with `g = 9.81 m/s²`: its places are exact,
/// the forces sums of weights.
fn string(bars: &[Bar], masses_kg: &[f64], up: bool) -> Enclosures {
    let system = hanging(bars, masses_kg);
    let (sign, g) = (if up { 1.0 } else { -1.0 }, exact(system.gravity_m_s2()));
    let mut z = 0.0;
    let mut at = vec![[Interval::ZERO; 3]];
    for bar in bars {
        z += sign * bar.length_m();
        at.push([Interval::ZERO, Interval::ZERO, exact(z)]);
    }
    // What a bar bears at its lower joint: masses and bars below, its own by the lever rule.
    let mut below = Interval::ZERO;
    let mut axial = Vec::new();
    for (k, bar) in bars.iter().enumerate().rev() {
        let far = exact(bar.mass_kg()) * exact(bar.centre_m()) / exact(bar.length_m());
        let mass = exact(masses_kg.get(k).copied().unwrap_or(0.0));
        axial.push((below + mass + far) * g * exact(-sign));
        below = below + mass + exact(bar.mass_kg());
    }
    axial.reverse();
    let at = EquilibriumBox { joints_m: &at, axial_n: &axial, turns: 0 };
    enclose_modes(&system, &at).unwrap()
}

/// Widths of enclosures, relative: some hundred roundings at each of some ten steps. Worst
/// measured: 1.1e-13.
const NARROW: f64 = 1e-12;

/// Two enclosures of one number: they meet, and both are narrow.
fn meets(found: Interval, told: Interval) {
    assert!(!found.disjoint(told), "{found:?} {told:?}");
    let most = NARROW * told.mag();
    assert!(told.width() <= most && found.width() <= most, "{found:?} {told:?}");
}

#[test]
fn compound_and_double_pendulum_lie_in_their_enclosures() {
    let g = exact(9.81);
    // ω² = m g r / (J + m r²); upright it falls at the same rate.
    let body = Bar::new(1.0, 3.0, 0.625, [0.0, 0.7, 0.7]).unwrap();
    let (m, r) = (exact(3.0), exact(0.625));
    let told = m * g * r / (exact(0.7) + m * r * r);
    for (up, inertia) in [(false, [0, 0, 2]), (true, [2, 0, 0])] {
        let found = string(&[body], &[], up);
        assert_eq!(found.inertia, Some(inertia));
        for omega2 in found.omega2_s2 {
            meets(omega2, if up { -told } else { told });
        }
    }
    // Two rods: (3 -+ 6/√7) g/l; two points on links: (2 -+ √2) g/l. Each in two planes.
    let (root7, root2) = (exact(7.0).sqrt(), exact(2.0).sqrt());
    let (three, two) = (exact(3.0), exact(2.0));
    let six = exact(6.0) / root7;
    for (bars, masses, told) in [
        (rods(2), vec![], [three - six, three + six]),
        (links(2), vec![1.0; 2], [two - root2, two + root2]),
    ] {
        let found = string(&bars, &masses, false);
        assert_eq!((found.inertia, found.omega2_s2.len()), (Some([0, 0, 4]), 4));
        for (k, omega2) in found.omega2_s2.iter().enumerate() {
            meets(*omega2, told[k / 2] * g);
        }
    }
}

#[test]
fn different_moments_across_have_their_own_enclosures() {
    // ω² = m g r/(m r² + J) about either axis; upright the second axis is along OY.
    let body = Bar::new(1.0, 3.0, 0.625, [0.5, 0.7, 0.4]).unwrap();
    let (m, g, r) = (exact(3.0), exact(9.81), exact(0.625));
    let found = string(&[body], &[], false);
    assert_eq!(found.inertia, Some([0, 0, 2]));
    for (omega2, j) in found.omega2_s2.into_iter().zip([0.7, 0.4]) {
        meets(omega2, m * g * r / (exact(j) + m * r * r));
    }
    // Two of them, one turned upside down as it were: det(K − ω² M) = 0 in the angles, where the
    // moments are all the smaller, all the greater ones, or mixed.
    let other = Bar::new(1.0, 3.0, 0.625, [0.5, 0.4, 0.7]).unwrap();
    let quadratic = |upper: f64, lower: f64| {
        let (a, b, c) = (exact(upper) + m * r * r + m, m * r, exact(lower) + m * r * r);
        let (k, l) = (m * g * (r + exact(1.0)), m * g * r);
        let (square, half) = (a * c - b * b, (k * c + l * a).scale(0.5));
        let root = (half.square() - square * k * l).sqrt();
        [k * l / (half + root), (half + root) / square]
    };
    let mut told: Vec<Interval> =
        [quadratic(0.7, 0.4), quadratic(0.4, 0.7)].into_iter().flatten().collect();
    told.sort_by(|a, b| a.mid().total_cmp(&b.mid()));
    let found = string(&[body, other], &[], false);
    for (omega2, told) in found.omega2_s2.into_iter().zip(told) {
        meets(omega2, told);
    }
}

/// 2 kg on an inextensible cable of 1.5 m.
fn thread(axial: Interval, below: f64) -> Result<Enclosures, NotEnclosed> {
    let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(2.0)];
    let members = vec![Member::cable(0, 1, Bar::homogeneous(1.5, 0.0).unwrap())];
    let system = System::new("thread", 9.81, joints, members).unwrap();
    let at = [[Interval::ZERO; 3], [Interval::ZERO, Interval::ZERO, exact(-below)]];
    enclose_modes(&system, &EquilibriumBox { joints_m: &at, axial_n: &[axial], turns: 0 })
}

#[test]
fn a_cable_that_is_proved_to_pull_is_a_bar() {
    let weight = exact(2.0) * exact(9.81);
    for omega2 in thread(weight, 1.5).unwrap().omega2_s2 {
        meets(omega2, exact(9.81) / exact(1.5));
    }
    let refused = thread(weight.hull(Interval::ZERO), 1.5).unwrap_err();
    assert_eq!(refused, NotEnclosed::Undecided { member: 1 });
    let refused = thread(weight, 1.25).unwrap_err();
    assert_eq!(refused, NotEnclosed::Undecided { member: 1 }, "slack with a force");
}

/// A polynomial in a double, with some thirty digits.
fn value(x: f64, coefficients: &[f64]) -> DoubleDouble {
    let mut sum = DoubleDouble::ZERO;
    for c in coefficients {
        sum = sum * DoubleDouble::point(x) + DoubleDouble::point(*c);
    }
    sum
}

#[test]
fn characteristic_polynomials_change_sign_between_the_ends() {
    // Three rods: 216 det(K - x M) with 6 M = [[14, 9, 3], [9, 8, 3], [3, 3, 2]] and 6 K = diag(15,
    // 9, 3); five points: 120 L₅(x). x is ω² l/g.
    let rods3 = [-26.0, 369.0, -1008.0, 405.0];
    let laguerre5 = [-1.0, 25.0, -200.0, 600.0, -600.0, 120.0];
    for (bars, masses, polynomial) in
        [(rods(3), vec![], &rods3[..]), (links(5), vec![1.0; 5], &laguerre5[..])]
    {
        let found = string(&bars, &masses, false);
        let roots = polynomial.len() - 1;
        assert_eq!(found.inertia, Some([0, 0, 2 * roots]));
        for k in 0..roots {
            let x = found.omega2_s2[2 * k] / exact(9.81);
            assert!(x.width() < NARROW * x.mag(), "{x:?}");
            let [low, high] = [x.lo(), x.hi()].map(|x| value(x, polynomial).interval().sign());
            assert!(low.unwrap() * high.unwrap() < 0, "{x:?}: {low:?} {high:?}");
        }
    }
}

proptest! {
    /// Any double pendulum of points: ω² are the roots of m₁ l₁ l₂ x² − M g (l₁ + l₂) x + M g² = 0
    /// with M = m₁ + m₂.
    #[test]
    fn any_double_pendulum_lies_in_its_enclosure(
        l in prop::array::uniform2(0.1_f64..10.0), m in prop::array::uniform2(0.1_f64..10.0),
    ) {
        // z of the second joint is a sum: lengths with few digits make it exact.
        let l = l.map(|l| (l * 1024.0).round() / 1024.0);
        let bars = l.map(|l| Bar::homogeneous(l, 0.0).unwrap());
        let found = string(&bars, &m, false);
        let [l1, l2] = l.map(exact);
        let (g, all) = (exact(9.81), exact(m[0]) + exact(m[1]));
        let a = exact(m[0]) * l1 * l2;
        let half = (all * g * (l1 + l2)).scale(0.5);
        let root = (half.square() - a * all * g.square()).sqrt();
        let high = (half + root) / a;
        let low = all * g.square() / (half + root);
        for (k, told) in [low, low, high, high].into_iter().enumerate() {
            meets(found.omega2_s2[k], told);
        }
    }
}

/// 2 kg on a cord of 1.5 m with EA = 300 N.
fn cord(axial: Interval, below: Interval) -> Result<Enclosures, NotEnclosed> {
    let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(2.0)];
    let cord = Bar::homogeneous(1.5, 0.0).unwrap();
    let members = vec![Member::cable(0, 1, cord).with_stiffness(300.0)];
    let system = System::new("cord", 9.81, joints, members).unwrap();
    let at = [[Interval::ZERO; 3], [Interval::ZERO, Interval::ZERO, below]];
    enclose_modes(&system, &EquilibriumBox { joints_m: &at, axial_n: &[axial], turns: 0 })
}

#[test]
fn an_elastic_cord_bounces_with_ea_over_lm_and_swings_with_g_over_its_stretched_length() {
    let weight = exact(2.0) * exact(9.81);
    let length = exact(1.5) + weight * exact(1.5) / exact(300.0);
    let found = cord(weight, -length).unwrap();
    assert_eq!(found.inertia, Some([0, 0, 3]));
    let swing = exact(9.81) / length;
    let bounce = exact(300.0) / (exact(1.5) * exact(2.0));
    for (omega2, told) in found.omega2_s2.iter().zip([swing, swing, bounce]) {
        meets(*omega2, told);
    }
    // A force that may be zero leaves it open whether the cord is taut.
    let refused = cord(Interval::new(0.0, 1.0), -length).unwrap_err();
    assert_eq!(refused, NotEnclosed::Undecided { member: 1 });
}

#[test]
fn a_wider_box_gives_wider_enclosures_around_those_of_a_narrow_one() {
    let weight = exact(2.0) * exact(9.81);
    let length = exact(1.5) + weight * exact(1.5) / exact(300.0);
    let narrow = cord(weight, -length).unwrap();
    let by = Interval::new(-1e-6, 1e-6);
    let wide = cord(weight + by, -(length + by)).unwrap();
    for (narrow, wide) in narrow.omega2_s2.iter().zip(&wide.omega2_s2) {
        assert!(wide.encloses(*narrow), "{wide:?} {narrow:?}");
    }
    // The swing is g/l at every length of the box.
    assert!(wide.omega2_s2[0].width() > 2e-6 * 9.81 / 1.6_f64.powi(2), "{wide:?}");
    // With a length anywhere the rod's direction is lost, and nothing is claimed.
    let system = hanging(&rods(1), &[]);
    let anywhere = [Interval::new(-1.0, 1.0); 3];
    let at = [[Interval::ZERO; 3], anywhere];
    let lost = EquilibriumBox { joints_m: &at, axial_n: &[exact(4.9)], turns: 0 };
    assert!(enclose_modes(&system, &lost).is_err());
}

#[test]
fn an_equilibrium_at_the_edge_of_its_box_has_its_frequencies_enclosed() {
    // Two hanging rods, (3 -+ 6/√7) g/l. The middle of the box is bent by a fiftieth of a radian,
    // which changes the frequencies there by some 1e-4.
    let system = hanging(&rods(2), &[]);
    let g = exact(9.81);
    let beside = Interval::new(0.0, 0.02);
    let at =
        [[exact(0.0); 3], [beside, exact(0.0), exact(-1.0)], [exact(0.0), exact(0.0), exact(-2.0)]];
    let axial = [exact(1.5) * g, exact(0.5) * g];
    let at = EquilibriumBox { joints_m: &at, axial_n: &axial, turns: 0 };
    let found = enclose_modes(&system, &at).unwrap();
    let swing = exact(6.0) / exact(7.0).sqrt();
    let told = [exact(3.0) - swing, exact(3.0) + swing].map(|factor| factor * g);
    assert_eq!((found.inertia, found.omega2_s2.len()), (Some([0, 0, 4]), 4));
    for (k, omega2) in found.omega2_s2.iter().enumerate() {
        assert!(omega2.encloses(told[k / 2]) && omega2.width() < 0.3 * omega2.mag(), "{omega2:?}");
    }
}

#[test]
fn a_cable_that_is_just_taut_is_undecided() {
    // A rod hangs at the end of a level elastic cable of just its distance: stiff to one side
    // alone.
    let cable = |length_m| {
        let joints = samples::joints(&[[0.0; 3], [-1.0, 0.0, -1.0]], &[0.0]);
        let rod = Member::bar(0, 2, Bar::homogeneous(1.0, 2.0).unwrap());
        let mut cord = Member::bar(1, 2, Bar::homogeneous(length_m, 0.0).unwrap());
        (cord.kind, cord.stiffness_n) = (Kind::Cable, Some(100.0));
        let system = System::new("held", 9.81, joints, vec![rod, cord]).unwrap();
        let at = [[0.0; 3], [-1.0, 0.0, -1.0], [0.0, 0.0, -1.0]].map(|x| x.map(exact));
        let at =
            EquilibriumBox { joints_m: &at, axial_n: &[exact(9.81), Interval::ZERO], turns: 0 };
        enclose_modes(&system, &at)
    };
    assert_eq!(cable(1.0).unwrap_err(), NotEnclosed::Undecided { member: 2 });
    // Longer, it is slack, and the rod swings freely.
    let free = cable(1.25).unwrap();
    for omega2 in free.omega2_s2 {
        meets(omega2, exact(1.5) * exact(9.81));
    }
}

#[test]
fn a_zero_without_a_turn_is_enclosed_and_not_proved() {
    // A cart of 3 kg on a level line with a pendulum of 1 kg: x translates freely; ω² = (M + m)
    // g/(M l) along the line, g/l across it.
    for direction in [[1.0, 0.0, 0.0], [0.6, 0.8, 0.0]] {
        let mut cart = Joint::free("S").with_mass(3.0);
        cart.support = Support::Line { at_m: [0.0; 3], direction };
        let joints = vec![cart, Joint::free("P").with_mass(1.0)];
        let members = vec![Member::bar(0, 1, Bar::homogeneous(0.5, 0.0).unwrap())];
        let system = System::new("cart", 9.81, joints, members).unwrap();
        let at = [[0.0; 3], [0.0, 0.0, -0.5]].map(|x| x.map(exact));
        let axial = [exact(9.81)];
        let at = EquilibriumBox { joints_m: &at, axial_n: &axial, turns: 0 };
        let found = enclose_modes(&system, &at).unwrap();
        let [zero, across, along] = found.omega2_s2[..] else { panic!("{found:?}") };
        assert!(zero.contains(0.0) && zero.width() < 1e-12, "{zero:?}");
        assert_eq!(found.inertia, None);
        let swing = exact(9.81) / exact(0.5);
        meets(across, swing);
        meets(along, swing * exact(4.0) / exact(3.0));
    }
}

#[test]
fn what_is_not_enclosed_says_why() {
    let chain = hanging(&links(61), &[1.0; 61]);
    let at = vec![[Interval::ZERO; 3]; 62];
    let axial = vec![Interval::ONE; 61];
    let large = EquilibriumBox { joints_m: &at, axial_n: &axial, turns: 0 };
    let refused = enclose_modes(&chain, &large).unwrap_err();
    assert_eq!(refused, NotEnclosed::TooLarge { joints: 61, most: 60 });
    let other = EquilibriumBox { joints_m: &at[..3], axial_n: &axial, turns: 0 };
    let refused = enclose_modes(&hanging(&links(2), &[1.0; 2]), &other).unwrap_err();
    assert_eq!(refused, NotEnclosed::OtherSystem { places: 3, forces: 61 });
}

/// In a box of 0.6 m to each side a rod of 1 m may stretch as it turns: modes about its middle are no basis.
#[test]
fn wide_boxes_have_no_basis() {
    let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P")];
    let rod = Bar::homogeneous(1.0, 3.0).unwrap();
    let system = System::new("rod", 9.81, joints, vec![Member::bar(0, 1, rod)]).unwrap();
    let wide = |x: f64| Interval::new(x - 0.6, x + 0.6);
    let at = [[0.0; 3].map(Interval::point), [0.0, 0.0, -1.0].map(wide)];
    let axial = [Interval::point(1.5 * 9.81)];
    let hanging = EquilibriumBox { joints_m: &at, axial_n: &axial, turns: 0 };
    let refused = enclose_modes(&system, &hanging).unwrap_err();
    let NotEnclosed::NoBasis { found: 2, wanted: 2, norm } = refused else { panic!("{refused}") };
    assert!(norm >= 1.0, "{norm}");
}
