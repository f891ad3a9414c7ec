//! `modes` and `simulate`: two bars between level anchors swing about the line between these as a
//! pendulum of two rods, `φ'' = -(3 g / 2 h) sin φ` with the depth h.

use serde_json::json;

use super::output::Output;
use super::solve::{DEPTH, LEVEL_V};

use crate::run::{good, holding};

/// 3 g / 2 h, 1/s².
const OMEGA2: f64 = 15.0 / DEPTH;

/// Angle and rate of the pendulum after the time, by Runge and Kutta's steps of a tenth of a
/// millisecond: fourth order, 1e-13 of error.
fn pendulum(time_s: f64, mut phi: f64, mut rate: f64) -> [f64; 2] {
    let fall = |phi: f64| -OMEGA2 * phi.sin();
    let h = 1e-4;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some seconds")]
    for _ in 0..(time_s / h).round() as usize {
        let [k1, l1] = [rate, fall(phi)];
        let [k2, l2] = [rate + 0.5 * h * l1, fall(phi + 0.5 * h * k1)];
        let [k3, l3] = [rate + 0.5 * h * l2, fall(phi + 0.5 * h * k2)];
        let [k4, l4] = [rate + h * l3, fall(phi + h * k3)];
        phi += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        rate += h / 6.0 * (l1 + 2.0 * l2 + 2.0 * l3 + l4);
    }
    [phi, rate]
}

/// 3 N s push 2/3 kg, as much as two rods have about their ends, to 4.5 m/s.
#[test]
fn columns_of_a_motion() {
    /// Of the eighth order at steps of 1 ms nothing else is left.
    const CLOSE: f64 = 1e-9;

    let folder = holding([("v.toml", LEVEL_V)]);
    let arguments = ["simulate", "v.toml", "--push", "1=0,3,0", "--time", "1", "--store", "0.5"];
    good(&folder, &[&arguments[..], &["--order", "8", "--out", "m.csv"]].concat());
    let mut output =
        Output::file("columns of a motion", "columns_of_a_motion", folder.path().join("m.csv"));
    let times = [0.0, 0.5, 1.0];
    output.is("time_s", json!(times));
    let at = times.map(|time| pendulum(time, 0.0, 4.5 / DEPTH));
    // Both rods have the moment of inertia h²/3 about the line, their centres are at h/2.
    let kinetic = at.map(|[_, rate]| DEPTH * DEPTH * rate * rate / 3.0);
    let potential = at.map(|[phi, _]| -10.0 * DEPTH * phi.cos());
    output.near("kinetic_j", CLOSE, json!(kinetic));
    output.near("potential_j", CLOSE, json!(potential));
    output.near("energy_j", CLOSE, json!([0, 1, 2].map(|k| kinetic[k] + potential[k])));
    let rows = |of: &dyn Fn(f64, f64) -> [f64; 3]| json!(at.map(|[phi, rate]| of(phi, rate)));
    let anchors = [0.0, 0.5, 1.0];
    let joint = |k: usize, on: f64| if k == 1 { on } else { 0.0 };
    let three = |on: &dyn Fn(usize) -> f64| [0, 1, 2].map(on);
    // By columns of joints 0 to 2, each with its rows.
    let column = |of: &dyn Fn(usize, f64, f64) -> f64| {
        json!(rows(&|phi, rate| three(&|k| of(k, phi, rate))))
    };
    output.near("joint#_x_m", CLOSE, column(&|k, _, _| anchors[k]));
    output.near("joint#_y_m", CLOSE, column(&|k, phi, _| joint(k, DEPTH * phi.sin())));
    output.near("joint#_z_m", CLOSE, column(&|k, phi, _| joint(k, -DEPTH * phi.cos())));
    output.near("joint#_vx_m_s", CLOSE, column(&|_, _, _| 0.0));
    output.near("joint#_vy_m_s", CLOSE, column(&|k, phi, w| joint(k, DEPTH * w * phi.cos())));
    output.near("joint#_vz_m_s", CLOSE, column(&|k, phi, w| joint(k, DEPTH * w * phi.sin())));
    // Each anchor bears its bar: weight and centrifugal force along the depth, a quarter of the
    // weight's part across; the moment about the joint in the middle gives the level force.
    let level = |phi: f64, w: f64| (2.5 * phi.cos() + w * w * DEPTH / 6.0) / DEPTH;
    let along = |phi: f64, w: f64| 10.0 * phi.cos() + w * w * DEPTH / 2.0;
    let y = |phi: f64, w: f64| 2.5 * phi.sin() * phi.cos() - along(phi, w) * phi.sin();
    let z = |phi: f64, w: f64| 2.5 * phi.sin() * phi.sin() + along(phi, w) * phi.cos();
    let both = |of: &dyn Fn(f64, f64) -> [f64; 2]| json!(at.map(|[phi, w]| of(phi, w)));
    output.near("joint#_fx_n", CLOSE, both(&|phi, w| [-level(phi, w), level(phi, w)]));
    output.near("joint#_fy_n", CLOSE, both(&|phi, w| [y(phi, w); 2]));
    output.near("joint#_fz_n", CLOSE, both(&|phi, w| [z(phi, w); 2]));
    // At the joint in the middle, which has no mass of its own, the force is along x: half of the
    // bar's length lies along it.
    output.near("bar#_axial_n", CLOSE, both(&|phi, w| [level(phi, w) / 0.5; 2]));
}

#[test]
fn a_throw_that_a_cable_ends() {
    let weight = "gravity_m_s2 = 10\njoints = { A = { at_m = [0, 0, 0] }, P = { mass_kg = 2 } }\n\
                  bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 0, kind = \"cable\" }]\n";
    let folder = holding([("w.toml", weight)]);
    let arguments = ["simulate", "w.toml", "--push", "P=0,0,4", "--time", "1", "--store", "0.3"];
    good(&folder, &[&arguments[..], &["--out", "m.csv"]].concat());
    let file = folder.path().join("m.csv");
    drop(Output::file("columns of a motion", "a_throw_that_a_cable_ends", file));
}
