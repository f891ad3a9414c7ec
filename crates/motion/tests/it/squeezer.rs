//! Andrews' squeezing mechanism: seven bodies in a plane, driven by a constant torque (E. Hairer,
//! G. Wanner, *Solving Ordinary Differential Equations II*, section VII.7; W. Schiehlen, *Multibody
//! Systems Handbook*, 1990).
//!
//! Bodies that turn about a fixed point are bars with their moment about it; the triangle with the
//! spring is two bars and one without mass that holds their ends. The mechanism lies level, so
//! gravity does nothing.

use std::f64::consts::TAU;

use model::Bar;
use model::system::{Joint, Member, Support, System};
use motion::Order;

use crate::common::at_rest;

/// Lengths and places, m.
const RR: f64 = 7e-3;
const RA: f64 = 92e-5;
const D: f64 = 28e-3;
const DA: f64 = 115e-4;
const E: f64 = 2e-2;
const EA: f64 = 1421e-5;
const ZF: f64 = 2e-2;
const FA: f64 = 1421e-5;
const ZT: f64 = 4e-2;
const U: f64 = 4e-2;
const SS: f64 = 35e-3;
const SA: f64 = 1874e-5;
const SB: f64 = 1043e-5;
const SC: f64 = 18e-3;
const SD: f64 = 2e-2;
const TA: f64 = 2308e-5;
const TB: f64 = 916e-5;
const UA: f64 = 1228e-5;
const UB: f64 = 449e-5;
const A: [f64; 2] = [-0.069_34, -0.002_27];
const B: [f64; 2] = [-0.036_35, 0.032_73];
const C: [f64; 2] = [0.014, 0.072];
/// Masses, kg, and moments about the centres of mass, kg m², of the bodies 1 to 7.
const M: [f64; 7] = [0.043_25, 0.003_65, 0.023_73, 0.007_06, 0.070_50, 0.007_06, 0.054_98];
const I: [f64; 7] = [2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5];
/// Spring, N/m and m; torque, N m.
const C0: f64 = 4530.0;
const L0: f64 = 0.077_85;
const MOM: f64 = 0.033;

/// The angles `β, Θ, γ, Φ, δ, Ω, ε` at the beginning, and after 0.03 s (test set for initial value
/// problem solvers, computed by PSIDE at a tolerance of 1e-14).
const BEGIN: [f64; 7] = [
    -0.061_713_890_014_276_45, 0.0, 0.455_279_819_163_070_4, 0.222_668_390_165_885_88,
    0.487_364_979_543_842_5, -0.222_668_390_165_885_88, 1.230_547_444_549_821,
];
const END: [f64; 7] = [
    15.810_771_196_299_04, -15.756_371_059_842_98, 0.040_822_240_130_731_01,
    -0.534_730_116_322_694_8, 0.524_409_965_880_530_4, 0.534_730_116_322_694_8,
    1.048_080_741_042_263,
];

/// Places of F, E, D, G and H.
fn places([beta, theta, gamma, phi, delta, _, epsilon]: [f64; 7]) -> [[f64; 3]; 5] {
    let f = [RR * beta.cos(), RR * beta.sin()];
    let e = [f[0] - D * (beta + theta).cos(), f[1] - D * (beta + theta).sin()];
    let d =
        [B[0] + SD * gamma.cos() + SC * gamma.sin(), B[1] + SD * gamma.sin() - SC * gamma.cos()];
    let g = [A[0] + ZT * delta.cos(), A[1] + ZT * delta.sin()];
    let h = [A[0] + U * epsilon.sin(), A[1] - U * epsilon.cos()];
    // The closure at E, for the angle that the others follow from.
    let closed = [g[0] + E * (phi + delta).sin(), g[1] - E * (phi + delta).cos()];
    assert!((closed[0] - e[0]).hypot(closed[1] - e[1]) < 1e-12, "{closed:?} {e:?}");
    [f, e, d, g, h].map(|[x, y]| [x, y, 0.0])
}

/// A bar with its centre at `centre_m` from its first end.
fn bar(length_m: f64, body: usize, centre_m: f64) -> Bar {
    let j = I[body - 1];
    Bar::new(length_m, M[body - 1], centre_m, [0.0, j, j]).unwrap()
}

/// A bar that turns about its first end with the moment `j`.
fn about_its_end(length_m: f64, j: f64) -> Bar {
    Bar::new(length_m, 0.0, 0.0, [0.0, j, j]).unwrap()
}

fn squeezer() -> System {
    let fixed = |name: &str, [x, y]: [f64; 2]| Joint::anchor(name, [x, y, 0.0]);
    let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 0.0, 1.0] };
    let mut joints = vec![fixed("O", [0.0; 2]), fixed("A", A), fixed("B", B), fixed("C", C)];
    joints.extend(["F", "E", "D", "G", "H"].map(|name| Joint::free(name).held_by(plane)));
    let [o, a, b, c, f, e, d, g, h] = std::array::from_fn(|k| k);
    let triangle = 0.5 * (I[2] + M[2] * (SA * SA + SB * SB));
    let members = vec![
        Member::bar(o, f, bar(RR, 1, RA)),
        Member::bar(f, e, bar(D, 2, DA)),
        Member::bar(b, e, about_its_end(SS, triangle)),
        Member::bar(b, d, about_its_end(SC.hypot(SD), triangle)),
        Member::bar(e, d, Bar::homogeneous(SD.hypot(SS - SC), 0.0).unwrap()),
        Member::bar(g, e, bar(E, 4, E - EA)),
        Member::bar(a, g, about_its_end(ZT, I[4] + M[4] * (TA * TA + TB * TB))),
        Member::bar(h, e, bar(ZF, 6, ZF - FA)),
        Member::bar(a, h, about_its_end(U, I[6] + M[6] * (UA * UA + UB * UB))),
        Member::bar(c, d, Bar::homogeneous(L0, 0.0).unwrap()).with_stiffness(C0 * L0),
    ];
    System::new("squeezer", 9.81, joints, members).unwrap()
}

#[test]
fn the_squeezer_goes_where_the_test_set_says() {
    let mut at = vec![[0.0; 3], [A[0], A[1], 0.0], [B[0], B[1], 0.0], [C[0], C[1], 0.0]];
    at.extend(places(BEGIN));
    let mut simulation = at_rest(&squeezer(), &at, Order::Eighth);
    simulation.add_moment(0, Box::new(|_| [0.0, 0.0, MOM])).unwrap();
    // The angular accelerations that the book gives for the beginning.
    let begun = simulation.snapshot();
    let crank = begun.accelerations_m_s2[4];
    let (sin, cos) = BEGIN[0].sin_cos();
    let told = 14_222.443_919_954_114 * RR;
    assert!((crank[1] * cos - crank[0] * sin - told).abs() < 1e-8 * told, "{crank:?} {told}");
    let (mut turned, mut last) = (BEGIN[0], BEGIN[0]);
    for _ in 0..600 {
        simulation.step(0.03 / 600.0).unwrap();
        let [x, y, _] = simulation.joints_m()[4];
        let angle = y.atan2(x);
        turned += (angle - last + 1.5 * TAU) % TAU - 0.5 * TAU;
        last = angle;
    }
    let now = simulation.snapshot();
    assert!(now.laws.largest() < 1e-11, "{:?}", now.laws);
    let off = turned - END[0];
    let told = places(END);
    let apart = now.joints_m[4..].iter().zip(&told);
    let apart = apart.map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1])).fold(0.0, f64::max);
    println!("crank off by {off:e} rad of {turned:.6}, joints by {apart:e} m");
    // Measured: 1.145e-9 rad of 15.8 and 8.0e-12 m, the same with a quarter of the step.
    assert!(off.abs() < 2e-9 && apart < 1e-10, "{off:e} {apart:e}");
}
