//! The gallery: each system against its closed form, by both solvers, with the judge and the
//! certificate.

use model::cases::exhibit;
use model::system::{System, SystemEquilibrium};
use model::{Rung, STANDARD_GRAVITY_M_S2 as G};

use crate::common::{agreed, close};
use crate::drawn::axial;

/// The system and both answers, which agree and have the least energy.
fn answers(name: &str) -> (System, Vec<SystemEquilibrium>) {
    let system = exhibit(name).expect("it is in the gallery").system();
    let answers = agreed(&system);
    for e in &answers {
        assert_eq!(e.evidence.rung(), Some(Rung::Optimal), "{name}, {}", e.solver);
    }
    assert_eq!(answers.len(), 2);
    (system, answers)
}

fn place(system: &System, e: &SystemEquilibrium, joint: &str) -> [f64; 3] {
    e.joints_m[system.joint(joint).expect("a joint")]
}

fn reaction(system: &System, e: &SystemEquilibrium, joint: &str) -> [f64; 3] {
    e.reactions_n[system.joint(joint).expect("a joint")]
}

#[test]
fn the_cables_of_the_lamp_pull_with_four_and_three_fifths_of_its_weight() {
    let (system, answers) = answers("lamp");
    for e in &answers {
        close(axial(&system, e, "A", "lamp"), 0.8 * 2.0 * G);
        close(axial(&system, e, "lamp", "B"), 0.6 * 2.0 * G);
        let [x, _, z] = place(&system, e, "lamp");
        close(x, 1.8);
        close(z, -2.4);
    }
}

/// What hangs on three anchors alike: a third of all weight on each.
#[test]
fn the_bridle_and_the_ring_divide_their_weight_by_three() {
    for (name, weight_kg) in [("bridle", 24.0), ("ring", 12.0)] {
        let (system, answers) = answers(name);
        close(system.total_mass_kg(), weight_kg);
        for (e, anchor) in answers.iter().flat_map(|e| ["A", "B", "C"].map(|anchor| (e, anchor))) {
            close(reaction(&system, e, anchor)[2], weight_kg * G / 3.0);
        }
    }
}

#[test]
fn the_beams_of_the_mobile_hang_level_by_the_lever_rule() {
    let (system, answers) = answers("mobile");
    for e in &answers {
        // Mass on the left of each beam, its arm, height of the hook: 0.5 N draw at both tips.
        for (beam, left_kg, arm_m, hook_m) in
            [("1", 3.0, 0.4, 0.3), ("2", 0.5, 0.6, 0.3), ("3", 0.4, 0.3, 0.2)]
        {
            let [hook, left, right] = ["H", "L", "R"].map(|end| format!("{end}{beam}"));
            let height = |joint: &str| place(&system, e, joint)[2];
            close(height(&hook) - height(&left), hook_m);
            close(height(&hook) - height(&right), hook_m);
            let pressed = left_kg * G * arm_m / hook_m - 0.5;
            close(axial(&system, e, &left, &right), -pressed);
        }
        close(axial(&system, e, "A", "H1"), 4.5 * G);
    }
}

#[test]
fn the_cables_of_the_footbridge_are_parabolas() {
    let (system, answers) = answers("footbridge");
    let (load_n, distance_m, parts, sag_m) = (65.0 * G, 2.0, 6_u8, 3.0);
    let n = f64::from(parts);
    let pull_n = load_n * distance_m * n * n / (8.0 * sag_m);
    for e in &answers {
        for side in ["l", "r"] {
            close(reaction(&system, e, &format!("{side}0"))[0], -pull_n);
            close(reaction(&system, e, &format!("{side}{parts}"))[0], pull_n);
            for k in 1..parts {
                let cable = format!("{side}{k}");
                close(axial(&system, e, &cable, &format!("{side}d{k}")), load_n);
                let from_middle = (f64::from(k) - 0.5 * n) / n;
                close(place(&system, e, &cable)[2], 0.8 + 4.0 * sag_m * from_middle * from_middle);
            }
            for k in 0..parts {
                close(
                    axial(&system, e, &format!("{side}d{k}"), &format!("{side}d{}", k + 1)),
                    500.0,
                );
            }
        }
    }
}

#[test]
fn the_corners_of_the_net_carry_a_quarter_each() {
    let (system, answers) = answers("net");
    assert_eq!(system.members().len(), 144);
    let side_m = place(&system, &answers[0], "8-8")[0];
    for e in &answers {
        for corner in ["0-0", "0-8", "8-0", "8-8"] {
            close(reaction(&system, e, corner)[2], 144.0 * 0.2 * G / 4.0);
        }
        let [x, y, _] = place(&system, e, "4-4");
        close(x, 0.5 * side_m);
        close(y, 0.5 * side_m);
    }
}

#[test]
fn the_legs_of_the_tripod_are_drawn_by_a_third_and_a_quarter_more() {
    let (system, answers) = answers("tripod");
    for (e, foot) in answers.iter().flat_map(|e| ["A", "B", "C"].map(|foot| (e, foot))) {
        close(axial(&system, e, foot, "top"), 30.0 * G / 3.0 * 1.25);
        close(place(&system, e, "top")[2], -2.4);
    }
}

#[test]
fn the_bars_of_the_pendulum_point_along_wind_and_weight() {
    let (system, answers) = answers("pendulum-chain");
    for e in &answers {
        for k in 0_u8..5 {
            // Half of the bar itself, the bars below, and the mass at the end.
            let below_n = (0.5 + f64::from(4 - k) + 1.0) * G;
            let pull_n = 20.0_f64.hypot(below_n);
            let member = &system.members()[usize::from(k)];
            close(e.axial_n[usize::from(k)], pull_n);
            let [a, b] = [member.from, member.to].map(|joint| e.joints_m[joint]);
            close(b[0] - a[0], 0.4 * 20.0 / pull_n);
            close(a[2] - b[2], 0.4 * below_n / pull_n);
        }
    }
}

#[test]
fn the_cranks_of_the_linkage_slope_by_three_to_four() {
    let (system, answers) = answers("four-bar-linkage");
    for e in &answers {
        for (from, to) in [("A", "C"), ("D", "B")] {
            close(axial(&system, e, from, to), 0.625 * 8.0 * G);
        }
        close(place(&system, e, "C")[0], 0.6);
        close(place(&system, e, "C")[2], -0.8);
        close(place(&system, e, "K")[2], -1.4);
    }
}
