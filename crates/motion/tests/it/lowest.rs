//! The lowest modes of large systems, by a sparse factorisation.

use model::Bar;
use model::system::{Joint, Member, System};
use motion::{Modes, lowest_modes, modes};

use crate::common::{G, hanging, links, string};

/// A square net of massless links with a point mass at each of `side²` nodes that move, hung from
/// the joints around it at one level, as its own funicular shape: found by a force density that is
/// the same for all members, so that lengths follow from places.
fn net(side: usize) -> (System, Vec<[f64; 3]>, Vec<f64>) {
    let width = side + 2;
    let number = |i: usize, j: usize| i * width + j;
    let rim = |i: usize, j: usize| i == 0 || j == 0 || i + 1 == width || j + 1 == width;
    // With equal densities q: q (4 z − Σ z') = −m g; by relaxation.
    // Half as deep as it is wide, or the bars would nearly determine the places by themselves.
    let (weight_n, density) = (G, 0.15 * G * side as f64);
    let mut z = vec![0.0; width * width];
    for _ in 0..40 * width * width {
        for i in 1..width - 1 {
            for j in 1..width - 1 {
                let around = z[number(i - 1, j)]
                    + z[number(i + 1, j)]
                    + z[number(i, j - 1)]
                    + z[number(i, j + 1)];
                z[number(i, j)] = 0.25 * (around - weight_n / density);
            }
        }
    }
    let at: Vec<[f64; 3]> =
        (0..width * width).map(|k| [(k / width) as f64, (k % width) as f64, z[k]]).collect();
    let joints = (0..width * width).map(|k| {
        let (i, j) = (k / width, k % width);
        let name = format!("{i},{j}");
        if rim(i, j) { Joint::anchor(name, at[k]) } else { Joint::free(name).with_mass(1.0) }
    });
    let joints: Vec<Joint> = joints.collect();
    let (mut members, mut axial) = (Vec::new(), Vec::new());
    for i in 0..width {
        for j in 0..width {
            for (k, l) in [(i + 1, j), (i, j + 1)] {
                if k < width && l < width && !(rim(i, j) && rim(k, l)) {
                    let (a, b) = (number(i, j), number(k, l));
                    let d: f64 = (0..3).map(|k| (at[b][k] - at[a][k]).powi(2)).sum();
                    let bar = Bar::homogeneous(d.sqrt(), 0.0).unwrap();
                    members.push(Member::bar(a, b, bar));
                    axial.push(density * d.sqrt());
                }
            }
        }
    }
    (System::new("net", G, joints, members).unwrap(), at, axial)
}

/// Both ways agree, mode by mode.
fn same(sparse: &Modes, dense: &Modes, tolerance: f64) {
    assert_eq!(sparse.total, dense.total);
    assert_eq!(sparse.negative, dense.negative);
    for (a, b) in sparse.modes.iter().zip(&dense.modes) {
        let off = (a.omega2_s2 - b.omega2_s2).abs();
        assert!(off <= tolerance * b.omega2_s2.abs().max(1.0), "{a:?} {b:?}");
        assert!(a.residual_s2 <= 1e-8 * b.omega2_s2.abs().max(1.0), "{}", a.residual_s2);
    }
}

#[test]
fn the_lowest_of_a_string_are_those_of_all_modes() {
    let n = 170;
    let system = hanging(&links(n), &vec![0.7; n]);
    let at = string(&vec![1.0; n], &vec![0.0; n]);
    let all = modes(&system, &at, None).unwrap();
    let lowest = lowest_modes(&system, &at, None, 24).unwrap();
    assert_eq!((all.modes.len(), lowest.modes.len()), (2 * n, 24));
    same(&lowest, &all, 1e-10);
}

#[test]
fn the_lowest_of_an_unstable_string_are_those_that_leave_it() {
    let n = 170;
    let system = hanging(&links(n), &vec![0.7; n]);
    let upright: Vec<[f64; 3]> = (0..=n).map(|k| [0.0, 0.0, k as f64]).collect();
    let all = modes(&system, &upright, None).unwrap();
    let lowest = lowest_modes(&system, &upright, None, 6).unwrap();
    assert_eq!(lowest.negative, 2 * n);
    same(&lowest, &all, 1e-10);
}

#[test]
fn the_lowest_of_a_net_are_those_of_all_modes_and_none_of_a_pair_is_missed() {
    // The symmetry of the square makes pairs of equal frequencies.
    let (system, at, axial) = net(9);
    let all = modes(&system, &at, Some(&axial)).unwrap();
    let lowest = lowest_modes(&system, &at, Some(&axial), 12).unwrap();
    same(&lowest, &all, 1e-9);
    let pair =
        lowest.modes.windows(2).any(|two| (two[0].omega2_s2 / two[1].omega2_s2 - 1.0).abs() < 1e-8);
    assert!(pair, "the square has pairs");
}

#[test]
fn equal_pendulums_side_by_side_have_one_frequency_and_the_search_ends() {
    let bar = Bar::homogeneous(1.0, 1.0).unwrap();
    let (mut joints, mut members, mut at) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..90 {
        at.push([k as f64, 0.0, 0.0]);
        at.push([k as f64, 0.0, -1.0]);
        joints.push(Joint::anchor(format!("O{k}"), at[2 * k]));
        joints.push(Joint::free(format!("P{k}")));
        members.push(Member::bar(2 * k, 2 * k + 1, bar));
    }
    let system = System::new("pendulums", G, joints, members).unwrap();
    let found = lowest_modes(&system, &at, None, 5).unwrap();
    assert_eq!((found.modes.len(), found.total, found.negative), (5, 180, 0));
    for mode in &found.modes {
        assert!((mode.omega2_s2 / (1.5 * G) - 1.0).abs() < 1e-12, "{mode:?}");
    }
}

#[test]
fn a_long_rope_has_the_zeros_of_bessel() {
    // 20,000 rods; errors fall with the square of the length of a rod.
    let n = 20_000;
    let bar = Bar::homogeneous(1.0 / n as f64, 1.0 / n as f64).unwrap();
    let system = hanging(&vec![bar; n], &[]);
    let at = string(&vec![1.0 / n as f64; n], &vec![0.0; n]);
    let found = lowest_modes(&system, &at, None, 4).unwrap();
    assert_eq!(found.total, 2 * n);
    // Kind external: zeros of J0, Abramowitz and Stegun, table 9.5.
    let zeros = [2.404_825_557_695_773, 2.404_825_557_695_773, 5.520_078_110_286_311];
    for (mode, zero) in found.modes.iter().zip(zeros) {
        let told = 0.25 * zero * zero;
        assert!((mode.omega2_s2 / G / told - 1.0).abs() < 1e-8, "{} {told}", mode.omega2_s2 / G);
    }
}

/// Lengths 2^40 times as large swing 2^20 times as slowly, to the last digits.
#[test]
fn the_lowest_of_a_long_string_are_those_of_a_short_one() {
    let lowest = |length: f64| {
        let bars = vec![Bar::homogeneous(length, 0.0).unwrap(); 170];
        let system = hanging(&bars, &[0.7; 170]);
        let at = string(&[length; 170], &[0.0; 170]);
        lowest_modes(&system, &at, None, 5).unwrap().modes
    };
    let scale = 40.0_f64.exp2();
    for (long, short) in lowest(scale).iter().zip(lowest(1.0)) {
        let off = (long.omega2_s2 * scale / short.omega2_s2 - 1.0).abs();
        assert!(off < 1e-12, "{} {}", long.omega2_s2, short.omega2_s2);
    }
}

/// A level net of springs of 1 m without weight, all with the tension T, and a mass m at each joint, has
/// across its plane the frequencies of two strings, $\omega^2 = 4 T/m (\sin^2 + \sin^2)$ of the angles
/// p pi / 2 (n + 1), the lowest of all where the springs are stiff.
#[test]
fn the_lowest_of_a_level_net_are_those_of_its_strings() {
    const SIDE: usize = 34;
    let (tension, mass, width) = (3.0, 0.5, SIDE + 2);
    let (mut joints, mut members, mut at) = (vec![], vec![], vec![]);
    for i in 0..width {
        for j in 0..width {
            let place = [i as f64, j as f64, 0.0];
            let rim = [i, j].iter().any(|k| *k == 0 || *k + 1 == width);
            at.push(place);
            let name = format!("{i},{j}");
            joints.push(if rim {
                Joint::anchor(name, place)
            } else {
                Joint::free(name).with_mass(mass).with_force([0.0, 0.0, mass * G])
            });
            for (k, l) in [(i + 1, j), (i, j + 1)] {
                let both_on_rim = rim && [k, l].iter().any(|k| *k == 0 || *k + 1 >= width);
                if k < width && l < width && !both_on_rim {
                    let bar = Bar::homogeneous(1.0 - tension / 4000.0, 0.0).unwrap();
                    let spring = Member::bar(i * width + j, k * width + l, bar);
                    members.push(spring.with_stiffness(4000.0 - tension));
                }
            }
        }
    }
    let system = System::new("level", G, joints, members).unwrap();
    let found = lowest_modes(&system, &at, None, 6).unwrap().modes;
    let angle =
        |p: usize| (p as f64 * std::f64::consts::FRAC_PI_2 / (SIDE + 1) as f64).sin().powi(2);
    let mut wanted: Vec<f64> = (1..=SIDE)
        .flat_map(|p| (1..=SIDE).map(move |q| 4.0 * tension / mass * (angle(p) + angle(q))))
        .collect();
    wanted.sort_by(f64::total_cmp);
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((found.omega2_s2 / wanted - 1.0).abs() < 1e-9, "{} {wanted}", found.omega2_s2);
    }
}
