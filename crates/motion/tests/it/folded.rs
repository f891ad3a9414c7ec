//! The falling folded chain: its free end falls faster than a free body.
//!
//! Both ends of a chain of the length `L` are held side by side, and one is released. If no energy
//! is lost and the fold has no width, the free arm (of the length `(L − y)/2` when its end has
//! fallen by `y`) has all the kinetic energy, which gives
//!
//! $$ v^2 = g y \frac{2 L - y}{L - y}, \qquad
//!    a = g \left( 1 + \frac{y (2 L - y)}{2 (L - y)^2} \right) > g $$
//!
//! (M. Schagerl, A. Steindl, W. Steiner, H. Troger, Acta Mech. 125 (1997) 155-168; C. W. Wong, K.
//! Yasui, Am. J. Phys. 74 (2006) 490-496; W. Tomaszewski, P. Pieranski, J.-C. Geminard, Am. J.
//! Phys. 74 (2006) 776-783).
//!
//! Experiments confirm it: Schagerl and others that the end falls faster than a free body; M. G.
//! Calkin and R. H. March (Am. J. Phys. 57 (1989) 154-157) that the energy is kept, as C. W. Wong,
//! S. H. Youn and K. Yasui report ("Falling chain equivalence"), with a fall in 85 % of the time of
//! a free body. Their measured tables were not at hand: compared with numbers is the theory.

use model::Bar;
use model::system::{Joint, Member, System};
use motion::{Order, Simulation};

use crate::common::{G, at_rest};

/// A chain of 1 m in `n` bars, hung at the origin, its free end level with it: two arms side by
/// side at the distance of a bar.
fn folded(n: usize) -> Simulation {
    let length = 1.0 / n as f64;
    let arm = (n - 1) / 2;
    let mut at = vec![[0.0; 3]];
    for k in 0..n {
        let [x, y, z] = at[k];
        at.push(match k {
            k if k < arm => [x, y, z - length],
            k if k == arm => [x + length, y, z],
            _ => [x, y, z + length],
        });
    }
    hung("folded", &at)
}

/// Bars of equal lengths, 1 kg in all, from joint to joint, the first held.
fn hung(name: &str, at: &[[f64; 3]]) -> Simulation {
    let n = at.len() - 1;
    let mut joints = vec![Joint::anchor("O", [0.0; 3])];
    joints.extend((1..=n).map(|k| Joint::free(k.to_string())));
    let bar = Bar::homogeneous(1.0 / n as f64, 1.0 / n as f64).unwrap();
    let members = (0..n).map(|k| Member::bar(k, k + 1, bar)).collect();
    at_rest(&System::new(name, G, joints, members).unwrap(), at, Order::Second)
}

/// The theory's time to fall by the part `y` of the length, relative to that of a free body: the
/// integral of `1/v` with `y = sin² s`, by the midpoint rule.
fn time_ratio(y: f64) -> f64 {
    let n = 10_000;
    let width = y.sqrt().asin() / f64::from(n);
    let parts = (0..n).map(|k| {
        let (sin, cos) = ((f64::from(k) + 0.5) * width).sin_cos();
        // √((1 − y)/(y (2 − y))) dy, over √(2 y) at the end.
        2.0 * cos * cos / (2.0 * y * (2.0 - sin * sin)).sqrt() * width
    });
    model::sum(parts)
}

#[test]
fn the_theory_falls_a_seventh_faster() {
    // 0.847: M. G. Calkin, R. H. March, Am. J. Phys. 57 (1989) 154-157.
    assert!((time_ratio(1.0) - 0.847).abs() < 5e-4, "{}", time_ratio(1.0));
}

/// What is seen while the free end falls from a tenth to three quarters of the length.
struct Fall {
    /// Largest relative deviation of the velocity from the theory's.
    velocity_off: f64,
    /// Mean accelerations between marks a twentieth of the length apart, in units of `g`, and the
    /// theory's.
    accelerations: Vec<[f64; 2]>,
    /// Time to the last mark over that of a free body, and the theory's.
    times: [f64; 2],
}

fn fall(n: usize, step_s: f64) -> Fall {
    let mut chain = folded(n);
    let velocity = |y: f64| (G * y * (2.0 - y) / (1.0 - y)).sqrt();
    let mut found = Fall { velocity_off: 0.0, accelerations: Vec::new(), times: [0.0; 2] };
    let mut last: Option<[f64; 3]> = None;
    let mut mark = 0.1;
    while mark < 0.76 {
        chain.step(step_s).unwrap();
        let (y, v) = (-chain.joints_m()[n][2], -chain.velocities_m_s()[n][2]);
        let t = chain.time_s();
        if y < mark {
            continue;
        }
        found.velocity_off = found.velocity_off.max((v / velocity(y) - 1.0).abs());
        found.times = [t / (2.0 * y / G).sqrt(), time_ratio(y)];
        if let Some([t0, y0, v0]) = last {
            // The theory's mean over the same distance: dv²/dy / 2.
            let theory = (velocity(y).powi(2) - velocity(y0).powi(2)) / (2.0 * (y - y0) * G);
            let found_g = (v - v0) / (t - t0) / G;
            found.accelerations.push([found_g, theory]);
        }
        last = Some([t, y, v]);
        mark += 0.05;
    }
    found
}

#[test]
fn the_free_end_falls_faster_than_a_free_body_as_the_theory_says() {
    let (coarse, fine) = (fall(51, 1e-4), fall(151, 5e-5));
    let [off_coarse, off] = [coarse.velocity_off, fine.velocity_off];
    println!("velocity off by {off_coarse:.4} (51 bars), {off:.4} (151 bars)");
    println!("accelerations in g, and the theory's: {:.3?}", fine.accelerations);
    println!("times over those of a free body, and the theory's: {:.5?}", fine.times);
    // The fold has the width of a bar; what it holds of the energy falls with it.
    assert!(off < 0.005 && off < 0.5 * off_coarse, "{off} {off_coarse}");
    let mut before = 1.0;
    for [found, theory] in fine.accelerations {
        assert!((found / theory - 1.0).abs() < 0.03, "{found} {theory}");
        assert!(found > before, "{found} g after {before} g");
        before = found;
    }
    assert!(before > 5.0, "{before}");
    let [found, theory] = fine.times;
    assert!((found / theory - 1.0).abs() < 0.002 && found < 0.92, "{found} {theory}");
}

/// A chain of 1 m in `n` bars, stretched level from the origin.
fn level(n: usize) -> Simulation {
    let length = 1.0 / n as f64;
    hung("level", &(0..=n).map(|k| [k as f64 * length, 0.0, 0.0]).collect::<Vec<_>>())
}

/// The end of a chain that is held stretched level and let go falls as a free body: the experiment
/// of Tomaszewski, Pieranski and Geminard with the largest distance of the ends, as C. W. Wong, S.
/// H. Youn and K. Yasui ("Falling chain equivalence") report and explain it.
#[test]
fn the_end_of_a_level_chain_falls_as_a_free_body_and_that_of_a_folded_one_faster() {
    for (n, most) in [(25, 1e-3), (100, 1e-5)] {
        let mut chain = level(n);
        let mut off = 0.0_f64;
        // The bend that sets out from the anchor has not arrived.
        while chain.joints_m()[n][2] > -0.75 {
            chain.step(1e-4).unwrap();
            let free = 0.5 * G * chain.time_s().powi(2);
            off = off.max((-chain.joints_m()[n][2] / free - 1.0).abs());
        }
        println!("{n} bars: the fall differs by {off:e} from that of a free body");
        assert!(off < most, "{n}: {off:e}");
        // Let go from the fold the end has fallen as far in nine tenths of the time.
        assert!(time_ratio(0.75) < 0.92);
    }
}
