//! Where the search may end.

use super::*;
use crate::run::settings::Motion;

/// A hanging chain that is closed and all in tension, on the arc that it starts from.
fn hanging() -> Curvature {
    let links = ScaledChain {
        length: vec![0.25; 5],
        carried: vec![0.4, 0.2, 0.0, -0.2, -0.4],
        span: [[1.0, 0.0, 0.0], [0.0; 3]],
        up: [0.0, 0.0, 1.0],
        vertical: false,
        motion: Motion::Plane,
    };
    let u = links.arc();
    let shape = links.close(Shape { moments: links.measure(&u), u }, 60).unwrap();
    let slope = Slope::new(&links, &shape);
    Curvature { links: Arc::new(links), shape: Arc::new(shape), slope: Arc::new(slope) }
}

/// Two bars of 0.5 and 1.5, straight down and straight up, that lift 0.4 and -0.4: the energy is -0.8.
#[test]
fn what_is_no_number_is_no_place() {
    let (length, carried) = (vec![0.5, 1.5], vec![0.4, -0.4]);
    let links = Arc::new(ScaledChain { length, carried, ..(*hanging().links).clone() });
    let u = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    let shape = Shape { moments: links.measure(&u), u };
    assert!((shape.moments.value + 0.8).abs() < 1e-15);
    let Curvature { links, shape, .. } = hanging();
    let run = |shape| FeasibleNewton::new(Arc::clone(&links), Settings::default()).run(shape, 0);
    assert!(run((*shape).clone()).is_ok());
    for value in [f64::NAN, f64::INFINITY] {
        let [mut energy, mut place] = [(*shape).clone(), (*shape).clone()];
        (energy.moments.value, place.u[0][0]) = (value, value);
        assert!(run(energy).is_err() && run(place).is_err());
    }
}

/// A chain that is closed need not be at rest, nor one whose gradient is rounding closed.
#[test]
fn a_place_that_is_no_rest_is_not_taken_for_one() {
    let sloping = hanging();
    let solver = FeasibleNewton::new(Arc::clone(&sloping.links), Settings::default());
    assert!(sloping.slope.residual() > 1e-3 && sloping.index(sloping.slope.zero) == 0);
    assert!(!solver.at_rounding(&sloping));
    let mut open = sloping.clone();
    let mut slope = (*open.slope).clone();
    slope.across = 0.0;
    open.slope = Arc::new(slope);
    assert!(solver.at_rounding(&open));
    let mut shape = (*open.shape).clone();
    shape.moments.gap = [1e-9, 0.0, 0.0];
    open.shape = Arc::new(shape);
    assert!(!solver.at_rounding(&open));
}

/// Bars of 1/4 and 3/4 at an angle a: two eigenvalues with the sum 1 and the product 3/16 sin² a.
#[test]
fn bars_spread_as_they_lie_apart() {
    for a in [0.3_f64, 1e-3] {
        let links = ScaledChain { length: vec![0.25, 0.75], ..(*hanging().links).clone() };
        let u = [0.4, 0.4 + a].map(|angle: f64| [angle.cos(), 0.0, angle.sin()]).to_vec();
        let shape = Shape { moments: links.measure(&u), u };
        let found = smallest_spread(&shape);
        let product = 0.1875 * a.sin().powi(2);
        let wanted = product / (0.5 + (0.25 - product).sqrt());
        assert!((found / wanted - 1.0).abs() < 1e-8, "{a}: {found} {wanted}");
        let floor = 16.0 * f64::EPSILON / wanted.sqrt();
        assert!((rounding_floor(&shape) / floor - 1.0).abs() < 1e-8, "{a}");
    }
}
