//! Small oscillations of bars whose two moments across differ.

use model::Bar;
use model::system::{Joint, Member, System};
use motion::{Direction, Mode, Modes, MotionError, Order, Simulation, What, lowest_modes, modes};
use proptest::prelude::*;

use crate::common::{G, at_rest, hanging, paper, string};

/// A bar of 1 m whose moments are those of a body with a finite extent across.
fn flat(mass_kg: f64, centre_m: f64) -> Bar {
    Bar::new(1.0, mass_kg, centre_m, [0.03, 0.06, 0.08]).unwrap()
}

fn oscillations(found: &Modes) -> Vec<&Mode> {
    found.modes.iter().filter(|mode| mode.what == What::Oscillation).collect()
}

/// `ω²` of the oscillations in a direction.
fn of(found: &Modes, direction: Direction) -> Vec<f64> {
    let modes = oscillations(found).into_iter().filter(|mode| mode.direction == direction);
    modes.map(|mode| mode.omega2_s2).collect()
}

fn near(found: f64, told: f64, tolerance: f64) {
    assert!((found / told - 1.0).abs() < tolerance, "{found} {told}");
}

proptest! {
    /// A bar that hangs by one end has ω² = m g r/(m r² + J) about either axis: it swings in OXZ
    /// about its second axis, which is along OY, and across about its third.
    #[test]
    fn a_hanging_bar_swings_with_its_own_moment_about_either_axis(
        m in 0.2_f64..5.0, r in 0.1_f64..1.0, second in prop::array::uniform3(0.01_f64..1.0),
    ) {
        // J_x = ∫ y² + z² and so on: a body for any second moments.
        let [x, y, z] = second;
        let (jy, jz) = (x + z, x + y);
        let bar = Bar::new(1.0, m, r, [y + z, jy, jz]).unwrap();
        let found = modes(&hanging(&[bar], &[]), &string(&[1.0], &[0.0]), None).unwrap();
        prop_assert_eq!((found.modes.len(), found.total), (3, 3));
        prop_assert_eq!(found.modes[0].what, What::Spin { member: 0 });
        for (direction, j) in [(Direction::InPlane, jy), (Direction::Across, jz)] {
            near(of(&found, direction)[0], m * G * r / (m * r * r + j), 1e-13);
        }
    }
}

/// `ω²` of two bars that hang from each other, from `det(K − ω² M) = 0` in the angles: lengths and
/// masses 1, centres in the middle, moments `j`.
fn compound_double_pendulum(j: [f64; 2]) -> [f64; 2] {
    // M = [[J₁ + 1/4 + 1, 1/2], [1/2, J₂ + 1/4]], K = g diag(3/2, 1/2).
    let (a, b, c) = (j[0] + 1.25, 0.5, j[1] + 0.25);
    let (quadratic, linear) = (a * c - b * b, -G * (1.5 * c + 0.5 * a));
    let root = (linear * linear - 4.0 * quadratic * 0.75 * G * G).sqrt();
    [(-linear - root) / (2.0 * quadratic), (-linear + root) / (2.0 * quadratic)]
}

#[test]
fn a_double_pendulum_of_unlike_bars_has_the_roots_of_its_two_quadratics() {
    let bars = [
        Bar::new(1.0, 1.0, 0.5, [0.03, 0.06, 0.08]).unwrap(),
        Bar::new(1.0, 1.0, 0.5, [0.05, 0.11, 0.07]).unwrap(),
    ];
    let found = modes(&hanging(&bars, &[]), &string(&[1.0; 2], &[0.0; 2]), None).unwrap();
    for (direction, j) in [(Direction::InPlane, [0.06, 0.11]), (Direction::Across, [0.08, 0.07])] {
        let told = compound_double_pendulum(j);
        for (found, told) in of(&found, direction).into_iter().zip(told) {
            near(found, told, 1e-12);
        }
    }
}

/// A bar level on two equal threads (massless bars, or cables) of `length_m`, along OX.
fn bifilar(length_m: f64, bar: Bar, cables: bool) -> (System, Vec<[f64; 3]>) {
    let at = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 0.0, -length_m], [1.0, 0.0, -length_m]];
    let joints = samples::joints(&[at[0], at[1]], &[0.0, 0.0]);
    let thread = Bar::homogeneous(length_m, 0.0).unwrap();
    let thread =
        |a, b| if cables { Member::cable(a, b, thread) } else { Member::bar(a, b, thread) };
    let members = vec![thread(0, 2), thread(1, 3), Member::bar(2, 3, bar)];
    (System::new("bifilar", G, joints, members).unwrap(), at.to_vec())
}

#[test]
fn a_bifilar_pendulum_turns_about_the_vertical_with_its_third_moment() {
    let (length_m, mass_kg) = (0.7, 1.3);
    for cables in [false, true] {
        let (system, at) = bifilar(length_m, flat(mass_kg, 0.5), cables);
        let found = modes(&system, &at, None).unwrap();
        // It swings along and across with g/h, and turns with ω² = m g (b/2)²/(J h).
        let swing = G / length_m;
        near(of(&found, Direction::InPlane)[0], swing, 1e-13);
        let [low, high] = of(&found, Direction::Across)[..] else { panic!("{found:?}") };
        near(low, swing, 1e-13);
        near(high, mass_kg * G * 0.25 / (0.08 * length_m), 1e-13);
        assert_eq!(found.total, 4, "with the spin");
    }
}

/// The mode's motion `sin(ωt)/ω` of the pushed places against a simulation of bars with four points
/// each; the largest difference in units of the amplitude.
fn off_the_motion(system: &System, at: &[[f64; 3]], mode: &Mode) -> f64 {
    let mut simulation: Simulation = at_rest(system, at, Order::Fourth);
    let omega = mode.omega2_s2.sqrt();
    let speed = 1e-6 * omega;
    let push: Vec<[f64; 3]> = mode.shape.iter().map(|v| v.map(|x| speed * x)).collect();
    simulation.set_velocities(&push).unwrap();
    let step_s = 0.01 / omega;
    let mut off = 0.0_f64;
    for _ in 0..900 {
        simulation.step(step_s).unwrap();
        let told = 1e-6 * (omega * simulation.time_s()).sin();
        for ((now, start), shape) in simulation.joints_m().iter().zip(at).zip(&mode.shape) {
            for k in 0..3 {
                off = off.max((now[k] - start[k] - told * shape[k]).abs());
            }
        }
    }
    off / 1e-6
}

/// How far a motion of the amplitude 1e-6 m may be from its linear part, relative: some amplitudes,
/// and the rounding of places, 1e-16 m, over some periods. Worst measured: 2.1e-6.
const SMALL: f64 = 1e-5;

/// Two bars as a V in a vertical plane of this azimuth and a third that hangs from where they meet.
fn hanging_from_a_v(azimuth: f64) -> (System, Vec<[f64; 3]>) {
    let (sin, cos) = azimuth.sin_cos();
    let at = |x: f64, z: f64| [x * cos, x * sin, z];
    let at = vec![at(0.0, 0.0), at(1.2, 0.0), at(0.6, -0.8), at(0.6, -1.8)];
    let joints = samples::joints(&[at[0], at[1]], &[0.0, 0.0]);
    let members = [(0, 2), (1, 2), (2, 3)].map(|(a, b)| Member::bar(a, b, flat(1.0, 0.5)));
    (System::new("V", G, joints, members.to_vec()).unwrap(), at)
}

#[test]
fn frequencies_are_those_of_small_motions_in_and_out_of_a_plane() {
    // The second axis of the bar that hangs is along OY whichever way the V faces: across its plane
    // at azimuth 0, oblique to it at the others.
    let mut all = Vec::new();
    for azimuth in [0.0, 0.4, 1.1] {
        let (system, at) = hanging_from_a_v(azimuth);
        let found = modes(&system, &at, None).unwrap();
        let oscillating = oscillations(&found);
        assert_eq!((oscillating.len(), found.total), (3, 6));
        let is_planar = oscillating.iter().all(|mode| mode.direction != Direction::Space);
        assert_eq!(is_planar, azimuth <= 0.0);
        for mode in &oscillating {
            let off = off_the_motion(&system, &at, mode);
            println!("azimuth {azimuth}, ω² {}: off {off:e}", mode.omega2_s2);
            assert!(off < SMALL, "{azimuth} {mode:?}: {off:e}");
        }
        all.push(oscillating.iter().map(|mode| mode.omega2_s2).collect::<Vec<f64>>());
    }
    // The axis makes a difference that the motion sees.
    assert!((all[0][0] / all[2][0] - 1.0).abs() > 1e-3, "{all:?}");
}

#[test]
fn the_papers_chain_with_three_moments_swings_as_its_modes_say() {
    let paper = paper();
    let members =
        paper.members().iter().map(|member| Member::bar(member.from, member.to, flat(1.0, 0.5)));
    let system =
        System::new("flat", paper.gravity_m_s2(), paper.joints().to_vec(), members.collect())
            .unwrap();
    // E1, kind external: 40-digit root finding.
    let mut at = vec![[0.0; 3]];
    for angle in [19.694_867_976_133_02_f64, 38.599_136_184_451_89, -73.920_588_792_231_34] {
        let [_, y, z] = at[at.len() - 1];
        at.push([0.0, y + angle.to_radians().sin(), z - angle.to_radians().cos()]);
    }
    let found = modes(&system, &at, None).unwrap();
    // The turn about the anchors is no oscillation, whatever the moments.
    let whats: Vec<What> = found.modes.iter().map(|mode| mode.what).collect();
    assert!(whats.contains(&What::Turn { axis_m: [0.0, 0.0] }), "{whats:?}");
    assert_eq!((found.total, found.index(), oscillations(&found).len()), (6, 0, 2));
    for mode in oscillations(&found) {
        let off = off_the_motion(&system, &at, mode);
        assert!(off < SMALL, "{mode:?}: {off:e}");
    }
}

#[test]
fn the_lowest_modes_of_a_long_string_of_such_bars_are_those_of_all() {
    let n = 170;
    let bars: Vec<Bar> = (0..n)
        .map(|k| {
            let by = 1e-3 * k as f64;
            Bar::new(1.0, 1.0 + by, 0.4, [0.15, 0.06 + by, 0.1 - 0.1 * by]).unwrap()
        })
        .collect();
    let system = hanging(&bars, &[]);
    let at = string(&vec![1.0; n], &vec![0.0; n]);
    let lowest = lowest_modes(&system, &at, None, 24).unwrap();
    let all = modes(&system, &at, None).unwrap();
    let all = oscillations(&all);
    assert_eq!((lowest.modes.len(), all.len()), (24, 2 * n));
    for (one, other) in lowest.modes.iter().zip(all) {
        near(one.omega2_s2, other.omega2_s2, 1e-9);
    }
}

/// No moment is more than the other two, whichever it is; one as large is a plate's. A bar that stretches has none.
#[test]
fn moments_that_no_body_has_are_refused() {
    for [jx, jy, jz] in [[5.0, 2.0, 1.0], [1.0, 5.0, 2.0], [2.0, 1.0, 5.0]] {
        let body = |j| hanging(&[Bar::new(1.0, 1.0, 0.5, j).unwrap()], &[]);
        let refused = modes(&body([jx, jy, jz]), &string(&[1.0], &[0.0]), None).unwrap_err();
        let MotionError::UnequalMoments { member: 1, reason, .. } = refused else {
            panic!("{refused}")
        };
        assert_eq!(reason, "no body has one that is more than the other two");
        let largest = jx.max(jy).max(jz);
        let others = jx + jy + jz - largest;
        let plate = [jx, jy, jz].map(|j| if j < largest { j } else { others });
        assert!(modes(&body(plate), &string(&[1.0], &[0.0]), None).is_ok(), "{plate:?}");
    }
    let bar = Bar::new(1.0, 1.0, 0.5, [0.1, 0.2, 0.25]).unwrap();
    let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P")];
    let soft = System::new("soft", G, joints, vec![Member::bar(0, 1, bar).with_stiffness(1e3)]);
    let refused = modes(&soft.unwrap(), &string(&[1.0], &[0.0]), None).unwrap_err();
    assert!(matches!(refused, MotionError::UnequalMoments { member: 1, .. }), "{refused}");
}
