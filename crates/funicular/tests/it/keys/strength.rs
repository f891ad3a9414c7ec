//! What bars bear: how much of it they use, what the loss of each does, load cases and their envelope.

use serde_json::json;

use super::output::Output;
use super::solve::{DEPTH, H, LEVEL_V};

use crate::run::{good, holding};

/// Bars that bear 20 and 10 N in tension, twice as much as they are to.
#[test]
fn strength_of_level_v() {
    let strong = "bars = [{ length_m = 1, mass_kg = 1, strength_n = 20 }, \
                  { length_m = 1, mass_kg = 1, strength_n = 10, safety = 2 }]";
    let text = LEVEL_V.replace("bars = [{ length_m = 1, mass_kg = 1, count = 2 }]", strong);
    let folder = holding([("v.toml", text)]);
    // The force at the anchors, over each strength.
    let largest = 0.5 * H + 10.0 * DEPTH;
    let used = json!([largest / 20.0, largest / 10.0]);
    let arguments = ["solve", "v.toml", "--json", "--bars-csv", "v.csv"];
    let mut output = Output::json("solve", "strength_of_level_v", &good(&folder, &arguments));
    output.each("equilibria[].bars[].utilisation", used.clone());
    output.each("equilibria[].weakest.bar", 2);
    output.each("equilibria[].weakest.utilisation", largest / 10.0);
    output.each("equilibria[].weakest.safety", 10.0 / largest);
    output.each("equilibria[].weakest.safety_wanted", 2.0);
    let mut output =
        Output::file("solve --bars-csv", "strength_of_level_v", folder.path().join("v.csv"));
    output.each("utilisation", used);
}

/// 300 N on two ropes of 5 m from anchors 6 m apart, 187.5 N in each, by a hanger of 1 m. Without one of
/// the ropes all hangs on the other; without the hanger the load falls.
#[test]
fn losses_of_two_ropes_and_a_hanger() {
    let text = "name = \"ropes\"\ngravity_m_s2 = 10\njoints = { A = { at_m = [-3, 0, 0] }, \
                B = { at_m = [3, 0, 0] }, P = {}, Q = { mass_kg = 30 } }\nbars = [\
                { from = \"A\", to = \"P\", length_m = 5, mass_kg = 0, strength_n = 600 }, \
                { from = \"B\", to = \"P\", length_m = 5, mass_kg = 0, strength_n = 1200 }, \
                { from = \"P\", to = \"Q\", length_m = 1, mass_kg = 0 }]";
    let mut output =
        Output::alone("losses_of_two_ropes_and_a_hanger", text, "solve system.toml --without each")
            .of("losses");
    output.is("schema_version", 3);
    output.system("ropes", [4, 3], [11.0, 30.0, 10.0]);
    output.are(json!({
        "losses[].bar": [1, 2, 3], "losses[].lowest_m[]": [3.0, 0.0, -6.0, -3.0, 0.0, -6.0],
        "losses[].lowest_joint": ["Q", "Q"],
        // Below the anchor that is left.
        "losses[].sag_m": [6.0, 6.0],
        // From 4 m below the middle to 5 m below an anchor.
        "losses[].moves": ["P", "P"], "losses[].moves_m": [10.0_f64.sqrt(), 10.0_f64.sqrt()],
        "losses[].tension_n[]": [2, 300.0, 1, 300.0], "losses[].compression_n": [null, null],
        "losses[].weakest.bar": [2, 1], "losses[].weakest.utilisation": [0.25, 0.5],
        "losses[].weakest.safety": [4.0, 2.0], "losses[].weakest.safety_wanted": [1.0, 1.0],
        "losses[].rung": ["optimal", "optimal"], "losses[].agrees": [true, true],
    }));
    output.says("losses[].outcome", &["falls"]);
    output.says("losses[].reason", &["no member meets joint \"Q\""]);
}

/// 100 N between two ropes of 5 m from anchors 6 m apart, 3-4-5, and 30 N of wind along them: each rope takes
/// 62.5 N of the weight and 25 N of the wind, or is relieved of it. A gust from the side as well, 75 N, tilts them as 3-4-5 and
/// makes 125 N of the weight.
#[test]
fn load_cases_of_two_ropes() {
    let text = "name = \"ropes\"\ngravity_m_s2 = 10\njoints = { A = { at_m = [-3, 0, 0] }, \
                B = { at_m = [3, 0, 0] }, P = { mass_kg = 10 } }\nbars = [\
                { from = \"A\", to = \"P\", length_m = 5, mass_kg = 0, strength_n = 175 }, \
                { from = \"B\", to = \"P\", length_m = 5, mass_kg = 0, strength_n = 350 }]\n\
                [[loads]]\nname = \"wind\"\njoint = \"P\"\nforce_n = [30, 0, 0]\n\
                [[loads]]\nname = \"gust\"\njoint = \"P\"\nforce_n = [0, 75, 0]\n\
                [[cases]]\nname = \"east\"\nfactors = { wind = 1 }\n\
                [[cases]]\nname = \"west\"\nfactors = { wind = -1, gust = 1 }\n";
    let nothing = "[[cases]]\nname = \"nothing\"\nfactors = { permanent = 0 }\n";
    let folder = holding([("ropes.toml", format!("{text}{nothing}"))]);
    let mut output =
        Output::ended(3, "load_cases_of_two_ropes", &folder, "solve ropes.toml --load-case each")
            .of("load cases");
    output.is("schema_version", 3);
    output.system("ropes", [3, 2], [10.0, 10.0, 10.0]);
    output.are(json!({
        "cases[].name": ["east", "west", "nothing"],
        "cases[].lowest_m[]": [0.0, 0.0, -4.0, 0.0, 2.4, -3.2], "cases[].lowest_joint": ["P", "P"],
        "cases[].sag_m": [4.0, 3.2], "cases[].moves_m": [0.0, 2.4_f64.hypot(0.8)],
        "cases[].moves": ["A", "P"], "cases[].tension_n[]": [1, 87.5, 2, 103.125],
        "cases[].compression_n": [null, null], "cases[].weakest.bar": [1, 1],
        "cases[].weakest.utilisation": [0.5, 53.125 / 175.0],
        "cases[].weakest.safety": [2.0, 175.0 / 53.125],
        "cases[].weakest.safety_wanted": [1.0, 1.0], "cases[].rung": ["optimal", "optimal"],
        "cases[].agrees": [true, true],
    }));
    output.says("cases[].outcome", &["no-load"]);
    output.says("cases[].reason", &["no mass and no force"]);
    output.are(json!({
        "bars[].bar": [1, 2], "bars[].ends[]": ["A", "P", "B", "P"],
        "bars[].least_n.value": [53.125, 37.5], "bars[].least_n.case": ["west", "east"],
        "bars[].most_n.value": [87.5, 103.125], "bars[].most_n.case": ["east", "west"],
        "bars[].utilisation.value": [0.5, 103.125 / 350.0],
        "bars[].utilisation.case": ["east", "west"], "supports[].joint": ["A", "B"],
        "supports[].most_n.value": [87.5, 103.125], "supports[].most_n.case": ["east", "west"],
    }));
}

/// A triangle on a roller folds without any of its bars; a bar that weighs leaves nothing behind.
#[test]
fn losses_after_which_nothing_hangs() {
    let folder = tempfile::tempdir().unwrap();
    let triangle = "plane = \"xz\"\njoints = { A = { at_m = [0, 0, 0] }, \
                    B = { at_m = [2, 0, 0], free = \"x\" }, C = { near_m = [1, 0, 1], mass_kg = 100 } }\n\
                    bars = [{ from = \"A\", to = \"B\", mass_kg = 0 }, { from = \"A\", to = \"C\", mass_kg = 0 }, \
                    { from = \"B\", to = \"C\", mass_kg = 0 }]";
    let alone = "joints = { A = { at_m = [0, 0, 0] }, P = {} }\n\
                 bars = [{ from = \"A\", to = \"P\", length_m = 1, mass_kg = 1 }]";
    for (text, outcome) in [(triangle, "leaves"), (alone, "no-load")] {
        std::fs::write(folder.path().join("system.toml"), text).unwrap();
        let command = "solve system.toml --without each";
        let mut output =
            Output::told("losses_after_which_nothing_hangs", &folder, command).of("losses");
        output.says("losses[].outcome", &[outcome]);
    }
}
