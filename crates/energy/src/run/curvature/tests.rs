//! Bounds of the lowest curvature, by hand.

use super::*;

/// Bars with these axial forces.
fn curvature(axial: &[f64], motion: Motion) -> Curvature {
    let links = ScaledChain {
        length: vec![0.25; axial.len()],
        carried: vec![0.0; axial.len()],
        span: [[1.0, 0.0, 0.0], [0.0; 3]],
        up: [0.0, 0.0, 1.0],
        vertical: false,
        motion,
    };
    let u = vec![[1.0, 0.0, 0.0]; axial.len()];
    let moments = links.measure(&u);
    let size = |f: fn(f64, f64) -> f64, from: f64| axial.iter().fold(from, |m, n| f(m, n.abs()));
    let slope = Slope {
        multiplier: [0.0; 3],
        axial: axial.to_vec(),
        across: 0.0,
        mean: 0.0,
        lowest: axial.iter().copied().fold(f64::INFINITY, f64::min),
        softest: size(f64::min, f64::INFINITY),
        highest: size(f64::max, 0.0),
        pull: 1.0,
        zero: 1e-10,
        line: None,
        opened: false,
    };
    let shape = Shape { u, moments };
    Curvature { links: Arc::new(links), shape: Arc::new(shape), slope: Arc::new(slope) }
}

/// The condition is a ratio: it is the same in any unit of force, also where products of two forces
/// are less than any double.
#[test]
fn the_condition_of_small_forces_is_that_of_large_ones() {
    let axial = [-1.0, 2.0, 3.0, 4.0];
    let condition =
        |unit: f64| curvature(&axial.map(|n| n * unit), Motion::Plane).condition(1e-9 * unit);
    let usual = condition(1.0);
    assert!(usual >= 1.0);
    for unit in [1e-200, 1e-100, 1e100, 1e200] {
        let found = condition(unit);
        assert!((found / usual - 1.0).abs() < 1e-9, "{unit:e}: {found}, not {usual}");
    }
}

/// By interlacing: two rows in the plane pass two forces, three rows in space, where every force
/// counts twice, pass one.
#[test]
fn the_lowest_curvature_lies_among_the_smallest_forces() {
    for axial in [[5.0, 1.0, 4.0, 2.0, 3.0], [1.0, 2.0, 3.0, 4.0, 5.0], [5.0, 4.0, 3.0, 2.0, 1.0]] {
        for (motion, high) in [(Motion::Plane, 3.0), (Motion::Space, 2.0)] {
            let (least, most) = curvature(&axial, motion).enclosure_of_smallest(1e-10);
            assert!((least - 1.0).abs() <= 0.0 && (most - high).abs() <= 0.0, "{least} {most}");
        }
    }
    // The same force more than once is passed as often.
    let (least, most) = curvature(&[2.0, 1.0, 1.0, 1.0], Motion::Plane).enclosure_of_smallest(0.0);
    assert!((least - 1.0).abs() <= 0.0 && (most - 1.0).abs() <= 0.0);
    // Pushed, or with no more forces than rows: anything up to the largest.
    for axial in [[-1.0, 2.0, 3.0, 4.0], [0.5, 2.0, 3.0, 4.0]] {
        let (least, most) = curvature(&axial, Motion::Plane).enclosure_of_smallest(0.5);
        assert!((least - 0.5).abs() <= 0.0 && (most - 4.0).abs() <= 0.0);
    }
    let (least, most) = curvature(&[2.0, 3.0], Motion::Plane).enclosure_of_smallest(0.0);
    assert!((least - 2.0).abs() <= 0.0 && (most - 3.0).abs() <= 0.0);
}
