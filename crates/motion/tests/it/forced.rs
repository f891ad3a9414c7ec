//! Forces and moments of time, and damping, against the adaptive method.

use model::Bar;
use motion::{Order, Simulation};
use nalgebra::DVector;
use ode_solvers::System as Equations;

use crate::common::{G, hanging, run, string};
use crate::second_opinion::adaptive;

/// The angle of a rod of 1 m and 1 kg in a medium, with friction at its anchor, pulled at its end
/// along OX and turned by a moment, both by the time.
struct Forced;

const DRAG_1_S: f64 = 0.3;
const FRICTION_N_M_S: f64 = 0.05;

fn pull_n(t: f64) -> f64 {
    4.0 * (5.0 * t).sin()
}

fn moment_n_m(t: f64) -> f64 {
    1.5 * (2.0 * t).cos()
}

impl Equations<f64, DVector<f64>> for Forced {
    fn system(&self, _: f64, y: &DVector<f64>, dy: &mut DVector<f64>) {
        // Time is a coordinate: with its own argument the crate's method (0.6.2) does not get
        // ahead.
        let (theta, rate, t) = (y[0], y[1], y[2]);
        // θ from the descending vertical towards OX: a turn about −OY.
        let moment = pull_n(t) * theta.cos() - 0.5 * G * theta.sin() + moment_n_m(t);
        dy[2] = 1.0;
        dy[0] = rate;
        dy[1] = 3.0 * (moment - FRICTION_N_M_S * rate) - DRAG_1_S * rate;
    }
}

#[test]
fn a_rod_follows_forces_and_moments_of_time_through_a_medium() {
    let (start, time_s) = (0.4_f64, 5.0);
    let settings = motion::Settings {
        order: Order::Eighth,
        damping_1_s: DRAG_1_S,
        friction_n_m_s: FRICTION_N_M_S,
    };
    let system = hanging(&[Bar::homogeneous(1.0, 1.0).unwrap()], &[]);
    let at = string(&[1.0], &[start]);
    let mut simulation = Simulation::new(&system, &at, settings).unwrap();
    simulation.add_force(1, Box::new(|t| [pull_n(t), 0.0, 0.0])).unwrap();
    simulation.add_moment(0, Box::new(|t| [0.0, -moment_n_m(t), 0.0])).unwrap();
    run(&mut simulation, time_s, 1e-3);
    let end = adaptive(Forced, DVector::from_vec(vec![start, 0.0, 0.0]), time_s);
    let [x, _, z] = simulation.joints_m()[1];
    let off = (x - end[0].sin()).hypot(z + end[0].cos());
    println!("forced and damped: {off:e} m apart");
    assert!(off < 1e-10, "{off:e}");
    assert!(simulation.snapshot().laws.largest() < 1e-12);
    // What of a moment is along the rod does nothing.
    simulation.add_moment(0, Box::new(|_| [0.7, 0.0, -0.4])).unwrap();
    assert!(simulation.snapshot().laws.largest() < 1e-12);
}
