//! Motions integrated a second time: Newton's and Euler's equations in the directions of the bars,
//! solved for the joint forces as the paper does, by the adaptive method of Dormand and Prince of
//! the order eight (crate `ode_solvers`). Neither natural coordinates nor a mass matrix, nor
//! constraints to be met, nor RATTLE has a part in it.

use model::Bar;
use motion::{Order, Simulation};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};
use ode_solvers::dop_shared::OutputType;
use ode_solvers::{Dop853, System as Equations};

use crate::common::{G, at_rest, closed, hanging, links, paper, run, string};

/// Tolerance of the adaptive method, relative and absolute.
const TIGHT: f64 = 1e-13;

/// Distance allowed where neighbouring motions of closed chains part by 1e4 to 1e5 in a second, m;
/// measured 1.1e-11 (three bars) and 1.6e-10 (ten).
pub const CHAOTIC_M: f64 = 1e-9;

/// A chain of bars from an anchor at the origin, its last end free or held.
pub struct Chain {
    pub bars: Vec<Bar>,
    pub held: bool,
    pub gravity_m_s2: f64,
}

impl Chain {
    /// Unit vectors and their derivatives, bar by bar.
    fn directions(y: &DVector<f64>, i: usize) -> (Vector3<f64>, Vector3<f64>) {
        (y.fixed_rows::<3>(6 * i).into_owned(), y.fixed_rows::<3>(6 * i + 3).into_owned())
    }

    /// Second derivatives of the unit vectors of bars without spin: with `r` from the beginning to
    /// the centre, `J` about it,
    ///
    /// $$ J \ddot u = -(1 - u u^T) (r f_i + (l - r) f_{i+1}) - J |\dot u|^2 u . $$
    fn accelerations(&self, y: &DVector<f64>) -> Vec<Vector3<f64>> {
        let turns = self.bars.iter().enumerate().map(|(i, bar)| {
            let (u, w) = Self::directions(y, i);
            let across = (Matrix3::identity() - u * u.transpose()) / bar.inertia_kg_m2()[1];
            (across, -u * w.norm_squared())
        });
        let turns: Vec<_> = turns.collect();
        let forces = self.forces(&turns);
        let turned = self.bars.iter().zip(&turns).enumerate();
        let turned = turned.map(|(i, (bar, (across, own)))| own - across * arms(bar, &forces, i));
        turned.collect()
    }

    /// Joint forces `f_0 ... f_n` of bars with `ü_i = −K_i (r f_i + (l − r) f_{i+1}) + c_i`.
    ///
    /// Bar `i` carries `f_i` at its beginning (of the bar before it, or the anchor) and `−f_{i+1}`
    /// at its end: `m a_C = f_i − f_{i+1} − m g e_z` with `a_C` the sum of `l ü` of the bars before
    /// and `r ü` of its own. These equations and the end that is free or held determine the forces.
    pub fn forces(&self, turns: &[(Matrix3<f64>, Vector3<f64>)]) -> Vec<Vector3<f64>> {
        let n = self.bars.len();
        let mut matrix = DMatrix::zeros(3 * n + 3, 3 * n + 3);
        let mut right = DVector::zeros(3 * n + 3);
        let mut add = |row: usize, i: usize, arm_m: f64| {
            let (bar, (across, own)) = (&self.bars[i], &turns[i]);
            let r = bar.centre_m();
            let mut start = matrix.fixed_view_mut::<3, 3>(3 * row, 3 * i);
            start -= across * (arm_m * r);
            let mut end = matrix.fixed_view_mut::<3, 3>(3 * row, 3 * i + 3);
            end -= across * (arm_m * (bar.length_m() - r));
            let mut known = right.fixed_rows_mut::<3>(3 * row);
            known -= own * arm_m;
        };
        for (i, bar) in self.bars.iter().enumerate() {
            for before in 0..i {
                add(i, before, self.bars[before].length_m());
            }
            add(i, i, bar.centre_m());
        }
        if self.held {
            for (i, bar) in self.bars.iter().enumerate() {
                add(n, i, bar.length_m());
            }
        }
        for (i, bar) in self.bars.iter().enumerate() {
            for k in 0..3 {
                matrix[(3 * i + k, 3 * i + k)] -= 1.0 / bar.mass_kg();
                matrix[(3 * i + k, 3 * i + 3 + k)] += 1.0 / bar.mass_kg();
            }
            right[3 * i + 2] -= self.gravity_m_s2;
        }
        if !self.held {
            for k in 0..3 {
                matrix[(3 * n + k, 3 * n + k)] = 1.0;
            }
        }
        let found = matrix.lu().solve(&right).expect("forces are determined");
        (0..=n).map(|i| found.fixed_rows::<3>(3 * i).into_owned()).collect()
    }
}

/// `r f_i + (l − r) f_{i+1}`.
pub fn arms(bar: &Bar, forces: &[Vector3<f64>], i: usize) -> Vector3<f64> {
    forces[i] * bar.centre_m() + forces[i + 1] * (bar.length_m() - bar.centre_m())
}

impl Equations<f64, DVector<f64>> for &Chain {
    fn system(&self, _: f64, y: &DVector<f64>, dy: &mut DVector<f64>) {
        for (i, turned) in self.accelerations(y).iter().enumerate() {
            let rate = y.fixed_rows::<3>(6 * i + 3).into_owned();
            dy.fixed_rows_mut::<3>(6 * i).copy_from(&rate);
            dy.fixed_rows_mut::<3>(6 * i + 3).copy_from(turned);
        }
    }
}

/// The state at the end, by Dormand and Prince.
pub fn adaptive<F>(equations: F, y: DVector<f64>, time_s: f64) -> DVector<f64>
where
    F: Equations<f64, DVector<f64>>,
{
    let mut found = Dop853::from_param(
        equations,
        0.0,
        time_s,
        time_s,
        y,
        TIGHT,
        TIGHT,
        0.9,
        0.0,
        0.333,
        6.0,
        time_s,
        0.0,
        1_000_000,
        u32::MAX,
        OutputType::Sparse,
    );
    found.integrate().expect("integrated");
    found.y_out().last().expect("an end").clone()
}

/// Largest distance of a joint between the two integrations at the time, m.
fn disagreement(simulation: &mut Simulation, chain: &Chain, time_s: f64, step_s: f64) -> f64 {
    let (at, velocity) = (simulation.joints_m(), simulation.velocities_m_s());
    let mut y = DVector::zeros(6 * chain.bars.len());
    for (i, bar) in chain.bars.iter().enumerate() {
        for k in 0..3 {
            y[6 * i + k] = (at[i + 1][k] - at[i][k]) / bar.length_m();
            y[6 * i + 3 + k] = (velocity[i + 1][k] - velocity[i][k]) / bar.length_m();
        }
    }
    let end = adaptive(chain, y, time_s);
    run(simulation, time_s, step_s);
    let mut place = Vector3::zeros();
    let mut worst = 0.0_f64;
    for (i, (bar, found)) in chain.bars.iter().zip(&simulation.joints_m()[1..]).enumerate() {
        place += Chain::directions(&end, i).0 * bar.length_m();
        worst = worst.max((place - Vector3::from(*found)).norm());
    }
    println!("{} bars, held {}: {worst:e} m apart", chain.bars.len(), chain.held);
    worst
}

#[test]
fn an_open_chain_in_space_moves_as_the_adaptive_method_says() {
    // Bars that differ, one with its centre of weight aside.
    let bars = vec![
        Bar::homogeneous(0.8, 1.2).unwrap(),
        Bar::new(1.0, 0.7, 0.3, [0.0, 0.08, 0.08]).unwrap(),
        Bar::homogeneous(0.5, 2.0).unwrap(),
        Bar::homogeneous(0.9, 0.6).unwrap(),
    ];
    let system = hanging(&bars, &[]);
    let at = string(&[0.8, 1.0, 0.5, 0.9], &[1.0, 1.4, 0.3, -0.5]);
    let mut simulation = at_rest(&system, &at, Order::Eighth);
    let push = [[0.0; 3], [0.2, 0.5, 0.0], [0.0, -0.4, 0.1], [0.1, 0.3, 0.0], [0.0, 0.6, -0.2]];
    simulation.push(&push).unwrap();
    let worst =
        disagreement(&mut simulation, &Chain { bars, held: false, gravity_m_s2: G }, 3.0, 2e-3);
    assert!(worst < 1e-10, "{worst:e}");
}

/// Two points of 1 kg on massless links of 1 m: bars with half of the first point at an end of each, the first of them
/// with as much at the anchor, where it does not move.
#[test]
fn points_on_massless_links_move_as_the_adaptive_method_says() {
    let dumbbell = |start_kg: f64, end_kg: f64| {
        let mass = start_kg + end_kg;
        let inertia = start_kg * end_kg / mass;
        Bar::new(1.0, mass, end_kg / mass, [0.0, inertia, inertia]).unwrap()
    };
    let bars = vec![dumbbell(0.5, 0.5), dumbbell(0.5, 1.0)];
    let at = string(&[1.0, 1.0], &[1.0, 1.5]);
    let mut simulation = at_rest(&hanging(&links(2), &[1.0, 1.0]), &at, Order::Eighth);
    simulation.push(&[[0.0; 3], [0.2, 0.5, 0.0], [0.0, -0.4, 0.1]]).unwrap();
    let worst =
        disagreement(&mut simulation, &Chain { bars, held: false, gravity_m_s2: G }, 3.0, 2e-3);
    assert!(worst < 1e-10, "{worst:e}");
}

#[test]
fn the_papers_chain_in_space_moves_as_the_adaptive_method_says() {
    let mut simulation = at_rest(&paper(), &closed(0.8, 1.0), Order::Eighth);
    simulation.push(&[[0.0; 3], [0.5, 0.0, 0.2], [-0.3, 0.4, 0.0], [0.0; 3]]).unwrap();
    let case = model::cases::paper();
    let (bars, gravity_m_s2) = (case.chain().bars().to_vec(), case.chain().gravity_m_s2());
    // What is off by a rounding is off by 1e5 times as much a second later.
    let worst = disagreement(&mut simulation, &Chain { bars, held: true, gravity_m_s2 }, 1.0, 2e-3);
    assert!(worst < CHAOTIC_M, "{worst:e}");
}

#[test]
fn a_closed_chain_of_ten_bars_moves_as_the_adaptive_method_says() {
    let case = model::cases::get("ten-equal-bars").unwrap().problem();
    let (bars, gravity_m_s2) = (case.chain().bars().to_vec(), case.chain().gravity_m_s2());
    let system = model::system::System::from(case.chain());
    let at = motion::random_position(&system, 3).unwrap();
    let mut simulation = at_rest(&system, &at, Order::Eighth);
    let worst = disagreement(&mut simulation, &Chain { bars, held: true, gravity_m_s2 }, 1.0, 2e-3);
    assert!(worst < CHAOTIC_M, "{worst:e}");
}
