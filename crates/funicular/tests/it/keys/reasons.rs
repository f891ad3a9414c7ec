//! Why a rung is open, of cases with published or closed forms; and what only some systems have.

use serde_json::json;

use super::output::Output;

use crate::run::run;

fn case(kind: &'static str, test: &'static str, arguments: &[&str]) -> Output {
    let folder = tempfile::tempdir().unwrap();
    let (code, text, _) = run(&folder, arguments);
    assert!(code == Some(0) || code == Some(3), "{code:?}");
    Output::json(kind, test, &text)
}

/// Four cables of 2 m around two struts: 500 N/m in each cable, -500 N/m in each strut. The third
/// joint slides along X.
#[test]
fn a_cross_of_struts() {
    let arguments = ["solve", "--case", "x-cross", "--json"];
    let mut output = case("solve", "a_cross_of_struts", &arguments);
    let (side, diagonal) = (1000.0, -500.0 * 8.0_f64.sqrt());
    let forces = json!(vec![[side, side, side, side, diagonal, diagonal]; 2]);
    output.near("equilibria[].bars[].axial_n", 1e-9, forces);
    let at = |key: &str| format!("equilibria[].evidence.ladder[].reason.{key}");
    output.each(&at("kind"), json!(["no_census", "no_certificate"]));
    output.each(&at("because"), json!(["slider", "not_definite"]));
    output.each(&at("joint"), 3);
    output.each(&at("compressed"), 2);
}

/// What a chain's census takes by itself, and where it is asked for.
#[test]
fn too_many_bars() {
    let arguments = ["solve", "--case", "bridle", "--json"];
    let mut output = case("solve", "too_many_bars", &arguments);
    let at = |key: &str| format!("equilibria[].evidence.ladder[].reason.{key}");
    output.each(&at("because"), "bridle");
    // Three strands of eight bars.
    output.is("system.bars", 24);
    output.repeat_at(at, json!({ "bars": 24, "limit": 8 }));
    let arguments = ["solve", "--case", "thirty-bars", "--census=always", "--json"];
    let mut output = case("solve", "too_many_bars", &arguments);
    output.each(&at("because"), "too_many_bars");
    output.is("system.bars", 30);
    output.repeat_at(at, json!({ "bars": 30, "limit": 16 }));
}

/// A beam with its hook at the height c is pressed by m g a/c less 0.5 N: 3 kg, 0.4 over 0.3 m.
#[test]
fn a_pressed_beam() {
    let arguments = ["study", "--case", "mobile", "--vary", "gravity_m_s2=10", "--json"];
    let mut output = case("study", "a_pressed_beam", &arguments);
    // The fourth bar; the second one pulls 30 N times 5/3.
    output.near("points[].compression_n[]", 1e-9, json!([4, 39.5]));
    output.near("points[].tension_n[]", 1e-9, json!([2, 50.0]));
}

/// A tripod is rigid.
#[test]
fn no_modes() {
    let mut output = Output::told("no_modes", ".", "modes --case tripod");
    output.is("equilibria[].modes[]", json!([]));
    // Hanging and standing.
    output.is("equilibria[].modes_in_all", json!([0, 0]));
}

/// Six orders of magnitude are too many to prove the number of signs.
#[test]
fn no_signs() {
    let arguments = ["modes", "--case", "six-orders", "--json"];
    let mut output = case("modes", "no_signs", &arguments);
    output.each("equilibria[].enclosed.inertia", json!(null));
}
