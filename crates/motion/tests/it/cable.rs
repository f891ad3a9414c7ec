//! Many equal bars between level anchors against the linear theory of slack cables: H. M. Irvine,
//! T. K. Caughey, Proc. R. Soc. Lond. A 341 (1974) 299-315.
//!
//! With `ω̄ = ω L √(m/H)`: out of the plane `k π`; in the plane antisymmetric modes `2 k π`, and
//! symmetric ones at the roots of `tan(ω̄/2) = ω̄/2 − (4/λ²)(ω̄/2)³`, where `λ² = (m g L/H)² L
//! EA/(H L_e)`; bars that do not stretch have `λ² = ∞`.

use std::f64::consts::PI;

use model::Bar;
use model::system::{Joint, Member, System};
use motion::{Direction, lowest_modes};

use crate::common::G;

/// A cable of `n` bars with the mass 1 kg over a span of 1 m, in its equilibrium.
struct Cable {
    system: System,
    at: Vec<[f64; 3]>,
    axial_n: Vec<f64>,
    /// Level force, N.
    h: f64,
    /// `λ²`; none for bars that do not stretch.
    lambda2: Option<f64>,
}

/// Of the sag, relative to the span, that a parabola has; `stiffness` is `EA/H`.
fn cable(n: usize, sag: f64, stiffness: Option<f64>) -> Cable {
    let h = G / (8.0 * sag);
    // Each joint carries the weight of a bar: the vertical forces are in arithmetic progression.
    let vertical = |k: usize| G / n as f64 * (k as f64 - 0.5 * (n as f64 - 1.0));
    let axial_n: Vec<f64> = (0..n).map(|k| h.hypot(vertical(k))).collect();
    let stretch = |t: f64| 1.0 + stiffness.map_or(0.0, |s| t / (s * h));
    let level: f64 = axial_n.iter().map(|t| stretch(*t) * h / t).sum();
    let length_m = 1.0 / level;
    let (mut at, mut joints, mut members) = (vec![[0.0; 3]], Vec::new(), Vec::new());
    for (k, t) in axial_n.iter().enumerate() {
        let [x, _, z] = at[k];
        let l = length_m * stretch(*t);
        at.push([x + l * h / t, 0.0, z + l * vertical(k) / t]);
        let bar = Bar::homogeneous(length_m, 1.0 / n as f64).unwrap();
        let bar = Member::bar(k, k + 1, bar);
        members.push(bar.with_stiffness(stiffness.map(|s| s * h)));
    }
    for (k, at) in at.iter().enumerate() {
        let name = k.to_string();
        joints.push(if k % n == 0 { Joint::anchor(name, *at) } else { Joint::free(name) });
    }
    let of = |s: f64| (G / h).powi(2) * s / (1.0 + (G / h).powi(2) / 8.0);
    let system = System::new("cable", G, joints, members).unwrap();
    Cable { system, at, axial_n, h, lambda2: stiffness.map(of) }
}

/// `ω̄` out of the plane, of symmetric and of antisymmetric modes in the plane.
fn frequencies(cable: &Cable) -> [Vec<f64>; 3] {
    let found = lowest_modes(&cable.system, &cable.at, Some(&cable.axial_n), 9).unwrap();
    let mut sorted = [Vec::new(), Vec::new(), Vec::new()];
    for mode in &found.modes {
        let omega = (mode.omega2_s2 / cable.h).sqrt();
        let last = mode.shape.len() - 1;
        let even: f64 =
            (0..=last).map(|k| (mode.shape[k][2] + mode.shape[last - k][2]).abs()).sum();
        let odd: f64 = (0..=last).map(|k| (mode.shape[k][2] - mode.shape[last - k][2]).abs()).sum();
        let class = match mode.direction {
            Direction::Across => 0,
            _ if even > odd => 1,
            _ => 2,
        };
        sorted[class].push(omega);
    }
    sorted
}

/// The root of the symmetric modes between two values of `ω̄/2`, by bisection.
fn symmetric(lambda2: Option<f64>, mut low: f64, mut high: f64) -> f64 {
    let of = |x: f64| {
        let elastic = lambda2.map_or(0.0, |l| 4.0 / l * x.powi(3));
        x.sin() - (x - elastic) * x.cos()
    };
    assert!(of(low) * of(high) < 0.0);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if of(low) * of(middle) <= 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    2.0 * low
}

#[test]
fn bars_that_do_not_stretch_have_the_frequencies_of_the_inextensible_cable() {
    let told = [symmetric(None, 4.0, 4.6), symmetric(None, 7.0, 7.8)];
    // Irvine and Caughey: 2.86 π and 4.92 π.
    assert!((told[0] / PI - 2.86).abs() < 5e-3 && (told[1] / PI - 4.92).abs() < 5e-3);
    let [across, even, odd] = frequencies(&cable(56, 0.01, None));
    for (k, omega) in across.iter().enumerate() {
        assert!((omega / (PI * (k + 1) as f64) - 1.0).abs() < 5e-3, "{across:?}");
    }
    for (k, omega) in odd.iter().enumerate() {
        assert!((omega / (2.0 * PI * (k + 1) as f64) - 1.0).abs() < 5e-3, "{odd:?}");
    }
    assert!(across.len() >= 3 && !odd.is_empty() && !even.is_empty());
    assert!((even[0] / told[0] - 1.0).abs() < 5e-3, "{even:?} {told:?}");
}

#[test]
fn more_bars_come_nearer_with_the_square_of_their_length() {
    let first = |n| frequencies(&cable(n, 0.01, None)).map(|of| of[0]);
    let [coarse, middle, fine] = [14, 28, 56].map(first);
    for ((coarse, middle), fine) in coarse.iter().zip(middle).zip(fine) {
        let order = ((coarse - middle) / (middle - fine)).log2();
        println!("order {order}");
        assert!((order - 2.0).abs() < 0.1, "{order}");
    }
}

#[test]
fn the_symmetric_mode_crosses_the_antisymmetric_one_at_four_pi_squared() {
    let mut below = Vec::new();
    // EA/H for λ² about 4, 30, 50 and 200 at a sag of a hundredth.
    for lambda2 in [4.0, 30.0, 50.0, 200.0] {
        let cable = cable(56, 0.01, Some(lambda2 / 0.0064));
        let exact = cable.lambda2.unwrap();
        let [_, even, odd] = frequencies(&cable);
        // ω̄/2 lies between π/2 of the taut string and 1.43 π of the inextensible cable.
        let told = symmetric(Some(exact), 0.5 * PI, 1.45 * PI);
        println!("λ² = {exact}: {} {told}, {}", even[0], odd[0]);
        assert!((even[0] / told - 1.0).abs() < 5e-3, "{exact}: {even:?} {told}");
        assert!((odd[0] / (2.0 * PI) - 1.0).abs() < 5e-3, "{odd:?}");
        below.push(even[0] < odd[0]);
    }
    // λ² = 4 π² = 39.5.
    assert_eq!(below, [true, true, false, false]);
}
