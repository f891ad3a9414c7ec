//! What argmin is told.

use super::*;
use crate::run::settings::Motion;

/// Two bars of 0.5 and 1.5, straight down and straight up, that lift 0.4 and -0.4.
#[test]
fn the_cost_is_the_energy_and_nothing_else_passes_for_it() {
    let links = Arc::new(ScaledChain {
        length: vec![0.5, 1.5],
        carried: vec![0.4, -0.4],
        span: [[0.0, 0.0, 1.0], [0.0; 3]],
        up: [0.0, 0.0, 1.0],
        vertical: true,
        motion: Motion::Space,
    });
    let u = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
    let shape = Shape { moments: links.measure(&u), u };
    let objective = Objective { links };
    let cost = objective.cost(&Arc::new(shape.clone())).unwrap();
    assert!((cost + 0.8).abs() < 1e-15);
    for value in [f64::NAN, f64::INFINITY] {
        let mut broken = shape.clone();
        broken.moments.value = value;
        assert!(objective.cost(&Arc::new(broken)).is_err());
        let mut broken = shape.clone();
        broken.u[0][0] = value;
        assert!(objective.gradient(&Arc::new(broken)).is_err());
    }
}
