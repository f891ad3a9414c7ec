//! Frequencies in closed form.

use model::Bar;
use model::system::{Joint, Member, Support, System};
use motion::{Direction, MotionError, What, modes};

use crate::common::{G, hanging, links, paper, rods, string};

/// `ω² l/g` of a string of bars that hangs straight, in its plane.
fn frequencies(bars: &[Bar], masses: &[f64]) -> Vec<f64> {
    let lengths: Vec<f64> = bars.iter().map(Bar::length_m).collect();
    let system = hanging(bars, masses);
    let at = string(&lengths, &vec![0.0; bars.len()]);
    let found = modes(&system, &at, None).unwrap();
    assert_eq!(found.modes.len(), 2 * bars.len());
    let of = |direction| {
        let modes = found.modes.iter().filter(move |mode| mode.direction == direction);
        modes.map(|mode| mode.omega2_s2 / G).collect::<Vec<f64>>()
    };
    let (in_plane, across) = (of(Direction::InPlane), of(Direction::Across));
    // As near as rounding leaves them beside the largest.
    let largest = in_plane.iter().fold(1.0_f64, |largest, a| largest.max(a.abs()));
    for (a, b) in in_plane.iter().zip(&across) {
        let rounding = f64::EPSILON * largest;
        assert!((a - b).abs() < 1e-12 * a.abs().max(1.0) + rounding, "{in_plane:?} {across:?}");
    }
    in_plane
}

fn near(found: &[f64], told: &[f64], tolerance: f64) {
    assert_eq!(found.len(), told.len());
    for (a, b) in found.iter().zip(told) {
        assert!((a / b - 1.0).abs() < tolerance, "{found:?} {told:?}");
    }
}

/// Two members of mass m that bear F at the length d of 1 m, in one line with a point mass M between
/// them. Across the line `ω² = 2 (F/d)/μ`, along it `ω² = 2 (EA + F)/d/μ`, since `EA (D/l − 1)` has
/// the slope `EA/l` and `l = d EA/(EA + F)`; with `μ = M + 2 (m r² + J)/d²`, where r, from the anchor,
/// and J are those at the length d.
#[test]
fn moments_of_a_prestressed_member_are_those_at_the_length_given() {
    let (m, mass_kg, prestress_n, stiffness_n) = (12.0, 1.0, 500.0, 1000.0);
    // As good as no gravity: the members stay in line.
    let joints = samples::joints(&[[0.0; 3], [2.0, 0.0, 0.0]], &[mass_kg]);
    for (centre_m, inertia, moment) in [
        (None, None, 1.0),
        (None, Some([0.0, 1.0, 1.0]), 1.0),
        (None, Some([0.5, 1.0, 1.0]), 1.0),
        (Some(0.25), Some([0.5, 2.5, 2.5]), 2.5),
    ] {
        let body = Bar::given(1.0, m, centre_m, inertia).unwrap();
        let r = centre_m.unwrap_or(0.5);
        let member = |from| Member::bar(from, 2, body).with_stiffness(stiffness_n);
        let members = [0, 1].map(|from| member(from).with_prestress(prestress_n).unwrap());
        let system = System::new("string", 1e-9, joints.clone(), members.into()).unwrap();
        let at = [[0.0; 3], [2.0, 0.0, 0.0], [1.0, 0.0, 0.0]];
        let found = modes(&system, &at, None).unwrap();
        let found = found.modes.iter().filter(|mode| !matches!(mode.what, What::Spin { .. }));
        let found: Vec<f64> = found.map(|mode| mode.omega2_s2).collect();
        let moving = mass_kg + 2.0 * (m * r * r + moment);
        let (across, along) = (2.0 * prestress_n, 2.0 * (stiffness_n + prestress_n));
        near(&found, &[across, across, along].map(|k| k / moving), 1e-9);
    }
}

/// A weight on a link of 1 m swings with `ω² = g/l` across an elastic cable that is slack, and with
/// `ω² = g/l + EA/(m l_0)`, about, where one of the same stiffness is just taut: a slack one is no
/// spring.
#[test]
fn a_slack_elastic_cable_is_no_spring() {
    let (mass_kg, stiffness_n) = (2.0, 30.0);
    let joints = samples::joints(&[[0.0; 3], [1.5, 0.0, -1.0]], &[mass_kg]);
    let link = Member::bar(0, 2, Bar::homogeneous(1.0, 0.0).unwrap());
    let at = [[0.0; 3], [1.5, 0.0, -1.0], [0.0, 0.0, -1.0]];
    let omega2 = |length_m: f64| {
        let body = Bar::homogeneous(length_m, 0.0).unwrap();
        let cable = Member::cable(1, 2, body).with_stiffness(stiffness_n);
        let system = System::new("tied", G, joints.clone(), vec![link.clone(), cable]).unwrap();
        let found = modes(&system, &at, None).unwrap();
        found.modes.iter().map(|mode| mode.omega2_s2).collect::<Vec<f64>>()
    };
    near(&omega2(1.7), &[G, G], 1e-9);
    let taut = omega2(1.5 * (1.0 - 1e-9));
    near(&taut, &[G, G + stiffness_n / 1.5 / mass_kg], 1e-6);
}

#[test]
fn point_masses_on_massless_links_have_the_zeros_of_laguerre() {
    near(&frequencies(&links(2), &[1.0; 2]), &[2.0 - 2.0_f64.sqrt(), 2.0 + 2.0_f64.sqrt()], 1e-13);
    // Any number: L_n at the frequencies, by its recurrence.
    for n in [3, 5, 12] {
        for x in frequencies(&links(n), &vec![0.7; n]) {
            let (mut before, mut now) = (1.0, 1.0 - x);
            let mut largest = 1.0_f64;
            for k in 1..n {
                let k = k as f64;
                let next = ((2.0 * k + 1.0 - x) * now - k * before) / (k + 1.0);
                (before, now) = (now, next);
                largest = largest.max(now.abs());
            }
            // L_n' = n (L_n - L_{n-1})/x: the distance of the zero.
            let distance = now / (n as f64 * (now - before) / x);
            assert!((distance / x).abs() < 1e-12, "{n} {x} {distance:e}");
        }
    }
}

#[test]
fn slender_rods_have_their_closed_forms() {
    near(&frequencies(&rods(1), &[]), &[1.5], 1e-14);
    let r = 6.0 / 7.0_f64.sqrt();
    near(&frequencies(&rods(2), &[]), &[3.0 - r, 3.0 + r], 1e-13);
    near(&frequencies(&rods(3), &[]), &[0.484_927_948_435, 3.0, 10.707_379_743_9], 1e-11);
}

/// `J_0`, by its series (for the arguments here the cancellation costs three digits).
fn j0(x: f64) -> f64 {
    let (mut term, mut sum) = (1.0, 1.0);
    for k in 1..80_u32 {
        term *= -0.25 * x * x / f64::from(k * k);
        sum += term;
    }
    sum
}

#[test]
fn a_hanging_chain_has_the_zeros_of_bessel_as_it_gets_finer() {
    // ω² = (j_0k / 2)² g/L for a rope of length L: errors fall with the square of the length of a
    // rod.
    for (k, start) in [(0, 2.4), (1, 5.5), (2, 8.65)] {
        let mut zero: f64 = start;
        for _ in 0..60 {
            // A secant step with a slope by differences.
            zero -= j0(zero) * 2e-6 / (j0(zero + 1e-6) - j0(zero - 1e-6));
        }
        let rope = 0.25 * zero * zero;
        let off = |n: usize| {
            let bars = vec![Bar::homogeneous(1.0 / n as f64, 1.0 / n as f64).unwrap(); n];
            (frequencies(&bars, &[])[k] / rope - 1.0).abs()
        };
        let (coarse, fine) = (off(32), off(64));
        let order = (coarse / fine).log2();
        println!("mode {k}: {rope}, off {coarse:e} {fine:e}, order {order}");
        assert!((order - 2.0).abs() < 0.05, "mode {k}: {order}");
        assert!(fine < 0.02, "{fine}");
    }
}

/// E1 and E2 of the paper's chain in OYZ, from the angles of FACTS: digits enough for the modes to
/// be found.
fn equilibrium(angles_deg: [f64; 3]) -> Vec<[f64; 3]> {
    let mut at = vec![[0.0; 3]];
    for angle in angles_deg {
        let [_, y, z] = at[at.len() - 1];
        let angle = angle.to_radians();
        at.push([0.0, y + angle.sin(), z - angle.cos()]);
    }
    at
}

/// Kind external: 40-digit root finding.
const E1: [f64; 3] = [19.694_867_976_133_02, 38.599_136_184_451_89, -73.920_588_792_231_34];

#[test]
fn the_papers_equilibria_turn_about_their_anchors_and_have_their_index() {
    let e1 = modes(&paper(), &equilibrium(E1), None).unwrap();
    assert_eq!((e1.modes.len(), e1.index(), e1.neutral()), (3, 0, 1));
    assert_eq!(e1.modes[0].what, What::Turn { axis_m: [0.0, 0.0] });
    assert!(e1.modes[0].omega2_s2.abs() <= 0.0 && e1.modes[0].direction == Direction::Across);
    let [a, b, c] = E1;
    let e2 = modes(&paper(), &equilibrium([-c, -b, -a]), None).unwrap();
    assert_eq!((e2.modes.len(), e2.index(), e2.neutral()), (3, 2, 1));
    assert!(e2.modes.iter().any(|m| m.what == What::Leaving && m.direction == Direction::InPlane));
    // Turned upside down, forces change their signs: E2 is E1 with the opposite stiffness.
    for (one, other) in e1.modes.iter().zip(e2.modes.iter().rev()) {
        assert!((one.omega2_s2 + other.omega2_s2).abs() < 1e-10, "{e1:?} {e2:?}");
    }
    let off = modes(&paper(), &equilibrium([20.0, 38.0, -74.0]), None);
    assert!(off.is_err());
    // In balance, but longer than it is.
    let long = modes(&hanging(&rods(1), &[]), &string(&[1.0 + 1e-6], &[0.0]), None);
    assert!(matches!(long, Err(MotionError::NotClosed { .. })), "{long:?}");
}

#[test]
fn a_frequency_is_that_of_the_motion() {
    // Released from E1 moved along its mode in the plane: half a period later on the other side.
    let found = modes(&paper(), &equilibrium(E1), None).unwrap();
    let in_plane = found.modes.iter().find(|m| m.direction == Direction::InPlane).unwrap();
    let mut chain = motion::Simulation::new(
        &paper(),
        &equilibrium(E1),
        motion::Settings { order: motion::Order::Fourth, ..motion::Settings::default() },
    )
    .unwrap();
    let speeds: Vec<[f64; 3]> = in_plane.shape.iter().map(|v| v.map(|x| 1e-5 * x)).collect();
    chain.set_velocities(&speeds).unwrap();
    let start = chain.joints_m()[1][1];
    let (mut before, mut crossings) = (0.0, Vec::new());
    for _ in 0..20_000 {
        chain.step(1e-3).unwrap();
        let now = chain.joints_m()[1][1] - start;
        if before * now < 0.0 {
            crossings.push(chain.time_s() - 1e-3 * now / (now - before));
        }
        before = now;
    }
    let n = crossings.len() - 1;
    let half_period = (crossings[n] - crossings[0]) / n as f64;
    let omega = std::f64::consts::PI / half_period;
    assert!((omega * omega / in_plane.omega2_s2 - 1.0).abs() < 1e-6, "{omega}");
}

#[test]
fn a_bar_with_inertia_about_its_axis_spins_and_a_slender_one_does_not() {
    let slender = Bar::homogeneous(1.0, 1.0).unwrap();
    let thick = Bar::new(1.0, 1.0, 0.5, [1e-3, 0.1, 0.1]).unwrap();
    let system = hanging(&[slender, thick], &[]);
    let found = modes(&system, &string(&[1.0; 2], &[0.0; 2]), None).unwrap();
    let named: Vec<What> = found.modes.iter().map(|mode| mode.what).collect();
    assert_eq!((named.len(), found.total, found.index(), found.neutral()), (5, 5, 0, 0));
    assert_eq!(named[0], What::Spin { member: 1 });
    assert!(named[1..].iter().all(|what| *what == What::Oscillation), "{named:?}");
}

/// Two homogeneous bars between level anchors, in a vertical plane that looks neither way and stands anywhere, hang
/// h below them and swing across their plane with `ω² = 3/2 g/h`; a rod on their joint swings in it and across. Two
/// that stand leave that place as fast.
#[test]
fn planes_of_modes_stand_anywhere() {
    let (lengths, span) = ([0.9, 0.7], 1.2);
    // 0.81 = h² + d², 0.49 = h² + (1.2 - d)².
    let d: f64 = (0.81 - 0.49 + span * span) / (2.0 * span);
    let h = (0.81 - d * d).sqrt();
    for (azimuth, away) in [(0.0, [0.0; 3]), (0.7, [3.0, -2.0, 5.0]), (2.5, [-1.0, 4.0, -3.0])] {
        let (sin, cos) = f64::sin_cos(azimuth);
        let at = |along: f64, up: f64| [away[0] + along * cos, away[1] + along * sin, away[2] + up];
        for (up, rod) in [(-h, true), (-h, false), (h, false)] {
            let mut joints = vec![
                Joint::anchor("A", at(0.0, 0.0)),
                Joint::free("P"),
                Joint::anchor("B", at(span, 0.0)),
            ];
            let bar = |from, to, length_m, mass_kg| {
                Member::bar(from, to, Bar::homogeneous(length_m, mass_kg).unwrap())
            };
            let mut members = vec![bar(0, 1, lengths[0], 0.8), bar(1, 2, lengths[1], 0.3)];
            let mut places = vec![at(0.0, 0.0), at(d, up), at(span, 0.0)];
            if rod {
                joints.push(Joint::free("Q"));
                members.push(bar(1, 3, 0.5, 1e-9));
                places.push(at(d, up - 0.5));
            }
            let system = System::new("turned", G, joints, members).unwrap();
            let found = modes(&system, &places, None).unwrap();
            let of = |direction| {
                let modes = found.modes.iter().filter(move |mode| mode.direction == direction);
                modes.map(|mode| mode.omega2_s2).collect::<Vec<f64>>()
            };
            let swing = 1.5 * G / -up;
            let (in_plane, across) = (of(Direction::InPlane), of(Direction::Across));
            if rod {
                // It has next to no weight: the one swings as if it were alone, the other as if it hung from a
                // wall.
                near(&in_plane, &[1.5 * G / 0.5], 1e-6);
                near(&across, &[swing, 1.5 * G / 0.5], 1e-6);
                continue;
            }
            assert!(in_plane.is_empty(), "{in_plane:?}");
            near(&across, &[swing], 1e-12);
            let mode = &found.modes[0];
            let hertz = swing.abs().sqrt() / std::f64::consts::TAU;
            let [oscillates, leaves] = [mode.frequency_hz(), mode.rate_1_s()];
            if up < 0.0 {
                assert!((oscillates.unwrap() / hertz - 1.0).abs() < 1e-12 && leaves.is_none());
            } else {
                let rate = leaves.unwrap() / (hertz * std::f64::consts::TAU);
                assert!((rate - 1.0).abs() < 1e-12 && oscillates.is_none());
            }
        }
    }
}

/// A rod of 1 km whose end is lifted by half of its weight rests anywhere: it turns about the vertical of its anchor, if
/// it stands off it by more than a millionth of its length.
#[test]
fn what_is_on_its_axis_does_not_turn() {
    let length_m = 1000.0;
    let rod = Bar::homogeneous(length_m, 2.0).unwrap();
    let joints =
        vec![Joint::anchor("O", [0.3, 0.1, 5.0]), Joint::free("P").with_force([0.0, 0.0, G])];
    let system = System::new("lifted", G, joints, vec![Member::bar(0, 1, rod)]).unwrap();
    for (part, turns) in [(3e-7, false), (3e-6, true)] {
        let (aside, down) = (part * length_m, length_m * (1.0 - part * part).sqrt());
        let at = [[0.3, 0.1, 5.0], [0.3 + 0.6 * aside, 0.1 + 0.8 * aside, 5.0 - down]];
        let found = modes(&system, &at, None).unwrap();
        let turn = What::Turn { axis_m: [0.3, 0.1] };
        assert!(found.modes.len() == 2 && found.neutral() == 2, "{found:?}");
        assert_eq!(found.modes.iter().any(|mode| mode.what == turn), turns, "{found:?}");
    }
}

/// A rigid square of 2 m with both diagonals on two hangers of 1 m; 1 kg at each joint and in each bar. Its braces keep it
/// flat, whatever they bear, so that it has four motions: along its plane `ω² = 11/(32/3) g`, a turn about the vertical with
/// `11/8 g`, and two swings across with `det [11 g - 32/3 ω², -10 ω²; -10 ω², 10 g - 52/3 ω²] = 0`. Bars folded onto one
/// line below a ring have two ways to unfold, and no modes; on a line that is taut between supports nothing moves.
#[test]
fn braces_keep_a_panel_flat_to_second_order() {
    let rod = |length_m| Bar::homogeneous(length_m, 1.0).unwrap();
    let joint = |name: &str| Joint::free(name).with_mass(1.0);
    let mut joints = vec![Joint::anchor("A", [0.0, 0.0, 3.0]), Joint::anchor("B", [2.0, 0.0, 3.0])];
    joints.extend(["P", "Q", "R", "S"].map(joint));
    let ends = [(0, 2, 1.0), (1, 3, 1.0), (2, 3, 2.0), (2, 4, 2.0), (4, 5, 2.0), (3, 5, 2.0)];
    let across = 8.0_f64.sqrt();
    let ends = ends.into_iter().chain([(2, 5, across), (3, 4, across)]);
    let members: Vec<Member> = ends.map(|(a, b, l)| Member::bar(a, b, rod(l))).collect();
    let at = [[0.0, 0.0, 3.0], [2.0, 0.0, 3.0], [0.0, 0.0, 2.0], [2.0, 0.0, 2.0]];
    let at = [&at[..], &[[0.0; 3], [2.0, 0.0, 0.0]]].concat();
    let panel = System::new("panel", G, joints, members).unwrap();
    let [a, b, c]: [f64; 3] =
        [32.0 / 3.0 * 52.0 / 3.0 - 100.0, -(11.0 * 52.0 + 320.0) / 3.0, 110.0];
    let root = (b * b - 4.0 * a * c).sqrt();
    let mut told = [33.0 / 32.0, 11.0 / 8.0, (-b - root) / (2.0 * a), (-b + root) / (2.0 * a)];
    told.sort_by(f64::total_cmp);
    for stress in [0.0, 3.0, -0.5] {
        let axial = [5.5, 5.5, 0.0, 2.5, 0.0, 2.5, 0.0, 0.0];
        let own = [0.0, 0.0, 1.0, 1.0, 1.0, 1.0, -2.0_f64.sqrt(), -2.0_f64.sqrt()];
        let axial_n: Vec<f64> = axial.iter().zip(own).map(|(n, s)| G * (n + stress * s)).collect();
        let found = modes(&panel, &at, Some(&axial_n)).unwrap();
        let omega2: Vec<f64> = found.modes.iter().map(|mode| mode.omega2_s2 / G).collect();
        near(&omega2, &told, 1e-11);
    }
    let folded = |support: [f64; 3], at: [f64; 3], lengths: [f64; 2]| {
        let slides = Support::Line { at_m: support, direction: [1.0, 0.0, 0.0] };
        let ends = [Joint::anchor("A", [0.0; 3]), joint("P"), joint("S").held_by(slides)];
        let members = vec![Member::bar(0, 1, rod(lengths[0])), Member::bar(1, 2, rod(lengths[1]))];
        let system = System::new("row", G, ends.to_vec(), members).unwrap();
        modes(&system, &[[0.0; 3], at, support], Some(&[2.0 * G, 0.0]))
    };
    let upright = folded([0.0, 0.0, 0.5], [0.0, 0.0, -1.0], [1.0, 1.5]);
    assert!(matches!(upright, Err(MotionError::Singular)), "{upright:?}");
    assert!(folded([0.0, 0.0, -2.0], [0.0, 0.0, -1.0], [1.0, 1.0]).unwrap().modes.is_empty());
}

/// A weight on a level support, held by a rope whose force is the rounding of zero: nothing resists, and no frequency of
/// 1e-8 Hz is told.
#[test]
fn what_rounding_alone_resists_is_neutral() {
    let level = Support::Plane { at_m: [0.0, 0.0, -3.0], normal: [0.0, 0.0, 1.0] };
    let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").held_by(level).with_mass(4.0)];
    let body = Bar::homogeneous(3.0, 0.0).unwrap();
    let rope = Member::cable(0, 1, body).with_stiffness(1e4);
    let system = System::new("a weight at rest", 10.0, joints, vec![rope]).unwrap();
    let at = [[0.0; 3], [0.0, 0.0, -3.0 - 1e-15]];
    let found = modes(&system, &at, None).unwrap();
    let all: Vec<_> = found.modes.iter().map(|mode| mode.what).collect();
    assert_eq!(all, [What::Neutral; 2], "{:?}", found.modes);
}
