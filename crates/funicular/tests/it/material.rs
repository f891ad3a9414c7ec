//! What people know of a bar, against the same file written out by hand.

use std::f64::consts::PI;

use funicular::prelude::*;

/// A rope of eight bars with these keys, between two anchors; 5 kg hang in its middle.
fn rope(keys: &str) -> String {
    format!(
        "name = \"rope\"\njoints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [6, 0, 1] }}, \
         P = {{ mass_kg = 5 }} }}\n\
         [[bars]]\nfrom = \"A\"\nto = \"P\"\ncount = 4\n{keys}\n\
         [[bars]]\nfrom = \"P\"\nto = \"B\"\ncount = 4\n{keys}\n"
    )
}

/// The same as a chain without a load.
fn chain(keys: &str) -> String {
    format!(
        "name = \"rope\"\nanchors = {{ start_m = [0, 0, 0], end_m = [6, 0, 1] }}\n\
         [[bars]]\ncount = 8\n{keys}\n"
    )
}

fn solved(text: &str) -> serde_json::Value {
    let problem =
        Problem::parse(text, "rope.toml").unwrap_or_else(|error| panic!("{error}\n{text}"));
    let mut json = serde_json::to_value(Solve::new().run(&problem).unwrap()).unwrap();
    for equilibrium in json["equilibria"].as_array_mut().unwrap() {
        equilibrium["evidence"]["solve_s"] = 0.into();
    }
    assert_eq!(json["agreement"]["verdict"], "agreed");
    json
}

/// Every key stands for exactly the number that one would have worked out: same answer to the last bit.
#[test]
fn every_key_is_the_one_that_it_stands_for() {
    let area_m2 = 0.25 * PI * 0.012 * 0.012;
    let (mass_kg, stiffness_n) = (7850.0 * area_m2 * 0.9, 1.1e11 * area_m2);
    let expansion = 1.0 + 1.2e-5 * -40.0;
    let long_m = 0.9 * expansion;
    let square = |j: f64| expansion * (expansion * j);
    // Places along a bar stay at the same part of its length, at its end too.
    let cold = "length_m = 0.9\nmass_kg = 1\ntemperature_k = -40\nexpansion_per_k = 1.2e-5\n";
    let pair = [
        (
            "length_m = 0.9\nmass_kg_per_m = 0.75",
            format!("length_m = 0.9\nmass_kg = {}", 0.75 * 0.9),
        ),
        (
            "length_m = 0.9\ndiameter_m = 0.012\ndensity_kg_m3 = 7850",
            format!("length_m = 0.9\nmass_kg = {mass_kg}"),
        ),
        (
            "length_m = 0.9\nmass_kg_per_m = 1\ntemperature_k = -40\nexpansion_per_k = 1.2e-5",
            format!("length_m = {long_m}\nmass_kg = 0.9"),
        ),
        (
            &format!("{cold}centre_m = 0.9\ninertia_kg_m2 = [0.01, 0.02, 0.03]"),
            format!(
                "length_m = {long_m}\nmass_kg = 1\ncentre_m = {long_m}\n\
                 inertia_kg_m2 = [0.01, {}, {}]",
                square(0.02),
                square(0.03)
            ),
        ),
    ];
    for (keys, by_hand) in &pair {
        for file in [rope as fn(&str) -> String, chain] {
            assert_eq!(solved(&file(keys)), solved(&file(by_hand)), "{keys}");
        }
    }
    let of_systems = [
        (
            "length_m = 0.9\ndiameter_m = 0.012\ndensity_kg_m3 = 7850\nyoung_pa = 1.1e11",
            format!("length_m = 0.9\nmass_kg = {mass_kg}\nstiffness_n = {stiffness_n}"),
        ),
        (
            "length_m = 0.9\nmass_kg = 0.5\nforce_n_per_m = [0, 3, -2]",
            format!(
                "length_m = 0.9\nmass_kg = 0.5\nforces = [{{ force_n = [0, {}, {}] }}]",
                3.0 * 0.9,
                -2.0 * 0.9
            ),
        ),
        (
            &format!("{cold}forces = [{{ force_n = [0, 3, -2], at_m = 0.9 }}]"),
            format!(
                "length_m = {long_m}\nmass_kg = 1\n\
                 forces = [{{ force_n = [0, 3, -2], at_m = {long_m} }}]"
            ),
        ),
    ];
    for (keys, by_hand) in &of_systems {
        assert_eq!(solved(&rope(keys)), solved(&rope(by_hand)), "{keys}");
    }
}

/// Twice the bars of half the length need no other mass.
#[test]
fn a_count_asks_for_no_new_masses() {
    let mass_kg = |count: usize| {
        let text = chain("length_m = LENGTH\nmass_kg_per_m = 0.75");
        let text = text.replace("count = 8", &format!("count = {count}"));
        let text = text.replace("LENGTH", &(8.0 / count as f64).to_string());
        let problem = Problem::parse(&text, "rope.toml").unwrap();
        problem.system().total_mass_kg()
    };
    for count in [8, 16, 32] {
        assert!((mass_kg(count) - 6.0).abs() < 1e-12);
    }
}

#[test]
fn contradictions_are_refused_where_they_stand() {
    for (keys, wanted) in [
        ("mass_kg = 1\nmass_kg_per_m = 1", "`mass_kg_per_m` and `mass_kg` cannot stand together"),
        (
            "mass_kg_per_m = 1\ndiameter_m = 1e-2\ndensity_kg_m3 = 1",
            "`density_kg_m3` and `mass_kg_per_m`",
        ),
        ("density_kg_m3 = 1", "the key `diameter_m` is missing"),
        ("mass_kg = 1\ndiameter_m = 1e-2", "the key `density_kg_m3` is missing"),
        ("mass_kg = 1\nyoung_pa = 1e9", "the key `diameter_m` is missing"),
        (
            "mass_kg = 1\nyoung_pa = 1e9\nstiffness_n = 1\ndiameter_m = 1e-2",
            "`young_pa` and `stiffness_n`",
        ),
        ("mass_kg = 1\ndiameter_m = 0\nyoung_pa = 1e9", "the value 0 is out of range"),
        ("mass_kg = 1\ntemperature_k = 20", "the key `expansion_per_k` is missing"),
        ("mass_kg = 1\nexpansion_per_k = 1e-5", "the key `temperature_k` is missing"),
        ("mass_kg_per_m = -1", "must be zero or positive"),
        ("mass_kg = 1\nforce_n_per_m = [0, 1]", "expected three numbers"),
        ("centre_m = 0.1", "the key `mass_kg` is missing"),
    ] {
        let error = Problem::parse(&rope(&format!("length_m = 0.9\n{keys}")), "rope.toml");
        let error = error.unwrap_err().to_string();
        assert!(error.contains(wanted), "{keys}: {error}");
    }
}
