//! Elastic cables and struts that go slack: a weight that bounces on a cord, and on a prop.
//!
//! The force `EA/l · max(0, e)` is continuous, so that the motion needs no law of impact. In closed
//! form the weight falls freely until the cord is taut, moves on `(1 - cos ωτ)` and `sin ωτ` about
//! its equilibrium, and is thrown back with the speed that it came with.

use model::Bar;
use model::system::{Joint, Kind, Member, System};
use motion::{Order, Simulation};

use crate::common::{G, at_rest, run};

const LENGTH_M: f64 = 1.25;
const MASS_KG: f64 = 2.0;
const STIFFNESS_N: f64 = 400.0;

/// A weight with a cord or, turned round, with a prop below it. Both begin slack: at the anchor,
/// and at twice the length of the prop above it.
fn bouncing(prop: bool) -> (System, [[f64; 3]; 2]) {
    let joints = vec![Joint::anchor("O", [0.0; 3]), Joint::free("P").with_mass(MASS_KG)];
    let body = Bar::homogeneous(LENGTH_M, 0.0).unwrap();
    let kind = if prop { Kind::Strut } else { Kind::Cable };
    let member = Member::bar(0, 1, body).of_kind(kind);
    let members = vec![member.with_stiffness(STIFFNESS_N)];
    let z = if prop { 2.0 * LENGTH_M } else { 0.0 };
    (System::new("bouncing", G, joints, members).unwrap(), [[0.0; 3], [0.0, 0.0, z]])
}

/// How deep it is below its beginning after a time, m, and the period of a bounce.
fn fallen(time_s: f64) -> (f64, f64) {
    let omega = (STIFFNESS_N / (LENGTH_M * MASS_KG)).sqrt();
    let (fall, speed) = ((2.0 * LENGTH_M / G).sqrt(), (2.0 * G * LENGTH_M).sqrt());
    let sag = G / omega.powi(2);
    // Taut from zero elongation to zero elongation: sag (1 - cos ωτ) + (v/ω) sin ωτ = 0.
    let contact = 2.0 * (std::f64::consts::PI - (speed / omega / sag).atan()) / omega;
    let period = 2.0 * fall + contact;
    let t = time_s.rem_euclid(period);
    let deep = if t <= fall {
        0.5 * G * t * t
    } else if t <= fall + contact {
        let (sin, cos) = (omega * (t - fall)).sin_cos();
        LENGTH_M + sag * (1.0 - cos) + speed / omega * sin
    } else {
        0.5 * G * (period - t).powi(2)
    };
    (deep, period)
}

/// Largest distance from the closed form over three bounces.
fn off(prop: bool, steps: u32) -> f64 {
    let (system, at) = bouncing(prop);
    let mut simulation = at_rest(&system, &at, Order::Second);
    let period = fallen(0.0).1;
    let step_s = period / f64::from(steps);
    let mut off = 0.0_f64;
    for _ in 0..3 * steps {
        simulation.step(step_s).unwrap();
        let [x, y, z] = simulation.joints_m()[1];
        assert!(x.abs() + y.abs() <= 0.0, "{x} {y}");
        off = off.max((at[1][2] - fallen(simulation.time_s()).0 - z).abs());
    }
    off
}

#[test]
fn a_weight_bounces_on_a_cord_and_on_a_prop_as_the_closed_form_says() {
    for prop in [false, true] {
        let [coarse, fine, finest] = [500, 2_000, 8_000].map(|steps| off(prop, steps));
        println!("prop {prop}: off {coarse:e} {fine:e} {finest:e} m");
        // Of the second order, over the switches too: where in a step they fall changes the
        // constant.
        assert!(finest < 1e-6 && fine < 0.15 * coarse && finest < 0.15 * fine);
    }
}

#[test]
fn energy_stays_over_a_thousand_bounces_and_the_laws_hold_slack_and_taut() {
    let (system, at) = bouncing(false);
    let mut simulation = at_rest(&system, &at, Order::Second);
    let (start_j, period) = (simulation.energy_j(), fallen(0.0).1);
    let largest = |simulation: &mut Simulation, bounces: u32| {
        let (mut off, mut slack, mut taut) = (0.0_f64, 0, 0);
        for _ in 0..bounces * 50 {
            run(simulation, period / 50.0, period / 1000.0);
            off = off.max((simulation.energy_j() - start_j).abs());
            let now = simulation.snapshot();
            assert!(now.laws.largest() < 1e-12, "{:?}", now.laws);
            *(if now.axial_n[0] > 0.0 { &mut taut } else { &mut slack }) += 1;
        }
        assert!(slack > 100 && taut > 100);
        off
    };
    let laws = simulation.snapshot().laws;
    assert!(laws.largest() < 1e-12, "both ends in one place: {laws:?}");
    let first = largest(&mut simulation, 10);
    let all = largest(&mut simulation, 990);
    println!("energy off by {first:e} J in 10 bounces, {all:e} J in 1000");
    // The potential has a jump in its second derivative: where in a step it falls is not repeated,
    // and each switch leaves a little, of either sign. Of a hundred times as many the sum grows
    // tenfold; a trend would be a hundredfold.
    assert!(all < 10.0 * first && all < 1e-3 * MASS_KG * G * LENGTH_M);
}
