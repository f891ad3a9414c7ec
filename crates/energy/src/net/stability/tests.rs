//! Signs, ranks and planes by hand.

use model::system::Kind;

use super::*;
use crate::net::frame::Rod;

const ZERO3: Vector = [0.0; 3];

/// A shallow truss: two elastic bars of length 2 from level anchors to a joint above them by a
/// tenth of their length, each pushed by a unit force, and a slack cable upwards.
fn truss(flexibility: f64) -> (Frame, Shape) {
    let (sine, cosine) = (0.1_f64, (1.0 - 0.01_f64).sqrt());
    let bar = |from| Rod { flexibility, ..Rod::straight(from, 3, 2.0, Kind::Bar) };
    let x = vec![
        [-2.0 * cosine, 0.0, 0.0],
        [2.0 * cosine, 0.0, 0.0],
        [0.0, 0.0, 1.5],
        [0.0, 0.0, 2.0 * sine],
    ];
    let rods = vec![bar(0), bar(1), Rod::straight(2, 3, 2.0, Kind::Cable)];
    let frame = Frame::of_rods(3, x.clone(), rods);
    (frame, Shape { x, force: vec![-1.0, -1.0, 0.0] })
}

/// Upwards the truss has the stiffness `2 (k sin² - F cos² / l)`: it snaps through where that is
/// negative. Sideways out of its plane it always falls.
#[test]
fn a_shallow_truss_snaps_through_where_it_is_soft() {
    // F / l = 1/2 and sin² = 0.01: stiff above k = 49.5.
    for (stiffness, falls) in [(40.0, 2), (49.0, 2), (50.0, 1), (60.0, 1), (f64::INFINITY, 1)] {
        let (frame, shape) = truss(1.0 / stiffness);
        let mut factor = Factor::new(&frame.spots, &frame.rods, &frame.meter).unwrap();
        assert_eq!(below(&frame, &shape, &mut factor, ZERO, false), falls, "{stiffness}");
        // That there is no Cholesky factor, and the signs.
        assert_eq!(factor.count, 2);
        let dense = Dense::read(&frame, &shape, None);
        // Sideways in its plane two rigid bars leave it nothing, and upwards neither.
        let index = if stiffness.is_infinite() { 1 } else { falls };
        assert_eq!(dense.count().index, index, "{stiffness}");
        assert_eq!(index_in_plane(&frame, &shape, None, DENSE, 9), Some(falls - 1), "{stiffness}");
    }
}

#[test]
fn supports_leave_their_motions_in_the_plane() {
    let (direction, up) = ([0.6, 0.8, 0.0], [0.0, 0.0, 1.0]);
    let normal = cross(direction, up);
    let mixed = |a: f64, v: Vector, b: f64, w: Vector| -> Vector {
        std::array::from_fn(|k| a * v[k] + b * w[k])
    };
    let slope = mixed(0.6, direction, 0.8, up);
    let oblique = mixed(0.6, normal, 0.8, up);
    let found = |axes: &[Vector]| {
        let mut all = [ZERO3; 3];
        all[..axes.len()].copy_from_slice(axes);
        let spot = Spot { first: 7, freedom: axes.len(), axes: all };
        in_plane(&spot, direction, up, normal).map(|spot| (spot.freedom, spot.axes))
    };
    assert_eq!(found(&[]).unwrap().0, 0);
    assert_eq!(found(&[slope]), Some((1, [slope, ZERO3, ZERO3])));
    assert_eq!(found(&[normal]).unwrap().0, 0);
    assert_eq!(found(&[oblique]), None);
    for whole in
        [vec![direction, up], vec![slope, cross(normal, slope)], vec![direction, normal, up]]
    {
        assert_eq!(found(&whole), Some((2, [direction, up, ZERO3])));
    }
    // The plane of the normal and the slope meets that of the system in the slope.
    let (freedom, [axis, ..]) = found(&[normal, slope]).unwrap();
    assert!(freedom == 1 && norm(cross(axis, slope)) < 1e-15 && (norm(axis) - 1.0).abs() < 1e-15);
    assert_eq!(found(&[direction, oblique]), None);
}

#[test]
fn ranks_and_gaps_of_matrices_that_are_known() {
    let wide = DMatrix::from_fn(2, 3, |row, column| match (row, column) {
        (0, 0) => 3.0,
        (1, 1) => 3e-5,
        _ => 0.0,
    });
    let (motions, stresses, found) = kernels(&wide, ZERO);
    assert_eq!((found.rank, found.self_stresses, found.mechanisms), (2, 0, 1));
    assert!((found.gap[0] - 1e-5).abs() < 1e-18 && found.gap[1].abs() <= 0.0);
    assert!((motions[(2, 0)].abs() - 1.0).abs() < 1e-15 && stresses.ncols() == 0);
    let tall = DMatrix::from_fn(3, 2, |row, column| match (row, column) {
        (0 | 1, 0) => 3.0,
        (2, 1) => 3e-12,
        _ => 0.0,
    });
    let (motions, stresses, found) = kernels(&tall, ZERO);
    assert_eq!((found.rank, found.self_stresses, found.mechanisms), (1, 2, 1));
    let small = 1e-12 * std::f64::consts::FRAC_1_SQRT_2;
    assert!(
        (found.gap[0] - 1.0).abs() < 1e-15 && (found.gap[1] - small).abs() < 1e-15 * small.sqrt()
    );
    assert!((motions[(1, 0)].abs() - 1.0).abs() < 1e-15);
    // What the two equal rows say twice is a self-stress.
    let balance = (0..2).map(|k| stresses[(0, k)] + stresses[(1, k)]);
    assert!(balance.fold(0.0_f64, |most, sum| most.max(sum.abs())) < 1e-14);
}

/// Against loads of 1000 a motion with a stiffness of 1e-8 is neutral, with one of 1e-5 it is not.
#[test]
fn what_nearly_nothing_resists_is_neutral() {
    for (force, neutral) in [(0.0, 1), (2e-8, 1), (2e-5, 0)] {
        let (mut frame, mut shape) = truss(0.0);
        frame.loads[3] = [0.0, 0.0, -1000.0];
        shape.force = vec![0.0, 0.0, force];
        let mut factor = Factor::new(&frame.spots, &frame.rods, &frame.meter).unwrap();
        assert_eq!(below(&frame, &shape, &mut factor, -ZERO, false), neutral, "{force}");
    }
}

/// The joint above the floor by a fifth less one: what is worst is named by a member.
#[test]
fn a_floor_is_no_member() {
    let (mut frame, shape) = truss(0.0);
    frame.rods.push(Rod { ground: true, kind: Kind::Cable, ..frame.rods[0] });
    frame.rods[3].from = 2;
    let x = vec![shape.x[0], shape.x[1], [0.0, 0.0, 1.0], shape.x[3]];
    let slope = frame.slope(&Shape { x, force: vec![-1.0, -1.0, 0.0, 0.0] });
    assert_eq!(slope.worst, 2);
    // 0.8 below it, over the length of two.
    assert!((slope.misfit - 0.4).abs() < 1e-15, "{}", slope.misfit);
}

/// Of the three stiffnesses 2 (k cos² - F sin² / l), -2 F / l and 2 (k sin² - F cos² / l).
#[test]
fn the_condition_is_that_of_the_stiffnesses() {
    for stiffness in [40.0, 60.0] {
        let (frame, shape) = truss(1.0 / stiffness);
        let [along, upwards]: [f64; 2] =
            [2.0 * (0.99 * stiffness - 0.005), 2.0 * (0.01 * stiffness - 0.495)];
        let Count { neutral, condition, .. } = Dense::read(&frame, &shape, None).count();
        assert_eq!(neutral, 0);
        assert!(
            (condition * upwards.abs() / along - 1.0).abs() < 1e-12,
            "{stiffness}: {condition}"
        );
    }
}

/// Zero is a billionth of the largest eigenvalue, or of the largest force.
#[test]
fn eigenvalues_count_beside_the_largest() {
    let (frame, shape) = truss(0.0);
    let mut dense = Dense::read(&frame, &shape, None);
    for (small, size, index, neutral) in
        [(5e-7, 1.0, 0, 2), (2e-6, 1.0, 1, 0), (2e-6, 4e3, 0, 2), (5e-6, 4e3, 1, 0)]
    {
        let diagonal = [small, -small, 1e3];
        dense.hessian = DMatrix::from_fn(3, 3, |i, j| if i == j { diagonal[i] } else { 0.0 });
        dense.size = size;
        let found = dense.count();
        assert_eq!((found.index, found.neutral), (index, neutral), "{small} {size}");
    }
}

/// Where the truss slides along a level line its two bars pull against each other, and the slack
/// cable has no part in that.
#[test]
fn two_bars_on_a_line_pull_against_each_other() {
    let (mut frame, shape) = truss(0.0);
    frame.spots[3].freedom = 1;
    frame.freedom = 1;
    let stresses = Dense::read(&frame, &shape, None).self_stresses(&frame);
    let [stress] = &stresses[..] else { panic!("one, not {}", stresses.len()) };
    assert!(stress.len() == 3 && stress[2].abs() <= 0.0);
    assert!((stress[0].abs() - std::f64::consts::FRAC_1_SQRT_2).abs() < 1e-15);
    assert!((stress[0] - stress[1]).abs() < 1e-15);
}

/// The truss turned about the vertical and moved away is in its own plane.
#[test]
fn planes_may_stand_anywhere() {
    let (frame, shape) = truss(1.0 / 40.0);
    let (sin, cos) = 0.7_f64.sin_cos();
    for away in [ZERO3, [5.0, -3.0, 2.0]] {
        let place = |[x, y, z]: &Vector| -> Vector {
            [away[0] + cos * x - sin * y, away[1] + sin * x + cos * y, away[2] + z]
        };
        let x: Vec<Vector> = shape.x.iter().map(place).collect();
        let frame = Frame { supports: x.clone(), ..frame.clone() };
        let there = Shape { x, force: shape.force.clone() };
        assert_eq!(index_in_plane(&frame, &there, None, DENSE, 9), Some(1), "{away:?}");
        // A joint off by a thousandth takes it out of every plane.
        let mut bent = there.clone();
        bent.x[2][0] += 1e-3 * sin;
        bent.x[2][1] -= 1e-3 * cos;
        assert_eq!(index_in_plane(&frame, &bent, None, DENSE, 9), None, "{away:?}");
    }
}

/// Values count over the largest, or over the length of a unit vector where all are less: what is left of a row along
/// a floor under an upright member is rounding.
#[test]
fn ranks_are_relative() {
    let (motions, stresses, rigidity) = kernels(&DMatrix::from_element(1, 2, 1e-20), 1e-7);
    assert_eq!((rigidity.rank, motions.ncols(), stresses.ncols()), (0, 2, 1));
    for size in [1e3, 1.0] {
        for (lesser, rank) in [(2e-7, 2), (0.5e-7, 1)] {
            let matrix = DMatrix::from_fn(2, 3, |row, column| match (row, column) {
                (0, 0) => size,
                (1, 1) => lesser * size,
                _ => 0.0,
            });
            let (motions, stresses, rigidity) = kernels(&matrix, 1e-7);
            assert_eq!(
                (rigidity.rank, motions.ncols(), stresses.ncols()),
                (rank, 3 - rank, 2 - rank)
            );
            let gap = [if rank == 2 { lesser } else { 1.0 }, if rank == 2 { 0.0 } else { lesser }];
            for (found, wanted) in rigidity.gap.iter().zip(gap) {
                assert!((found - wanted).abs() < 1e-15, "{:?}", rigidity.gap);
            }
        }
    }
}
