//! Malformed texts, each with its exact error.

use model::system_file::parse;

use crate::support::{anchored, barred, chain, check, rows, system};

#[test]
fn every_text_of_the_list_has_its_exact_error() {
    for [before, text, message, marked] in rows("texts") {
        let text = match before.as_str() {
            "anchored" => anchored(&text),
            "barred" => barred(&text),
            _ => text,
        };
        check(&text, &message, &marked);
    }
}

/// Nested a million deep, as tables, arrays and dotted keys.
#[test]
fn deep_nests_are_refused_and_not_followed() {
    let deep = 1_000_000;
    check(
        &format!("a = {}", "[".repeat(deep)),
        "f:1:85: not valid TOML: cannot recurse further; max recursion depth met",
        "[",
    );
    check(&format!("{}a = 1", "a.".repeat(deep)), "f: not valid TOML: recursion limit", "");
    check(&format!("[{}a]", "a.".repeat(deep)), "f: not valid TOML: recursion limit", "");
}

#[test]
fn numbers_are_read_as_written() {
    let text = "gravity_m_s2 = 0x10\nanchors = { start_m = [-0, 1_000, 0o17], end_m = [2, 0.1, 1e3] }\n\
                bars = [{ length_m = 18446744073709551617, mass_kg = 9007199254740993, count = 0b11 },\n\
                { length_m = 1, mass_kg = 9e15, count = 2.0 }]\n";
    let problem = chain(parse(text, "f")).unwrap();
    let chain = problem.chain();
    assert_eq!(chain.gravity_m_s2().to_bits(), 16.0_f64.to_bits());
    let bits = |v: [f64; 3]| v.map(f64::to_bits);
    assert_eq!(bits(chain.anchors().start_m), bits([-0.0, 1000.0, 15.0]));
    assert_eq!(bits(chain.anchors().end_m), bits([2.0, 0.1, 1000.0]));
    assert_eq!(chain.bars().len(), 3 + 2);
    // 2^64 + 1 and 2^53 + 1 are no doubles; the nearest are.
    assert_eq!(chain.bars()[0].length_m().to_bits(), 2.0_f64.powi(64).to_bits());
    assert_eq!(chain.bars()[0].mass_kg().to_bits(), 2.0_f64.powi(53).to_bits());
    assert_eq!(chain.name(), "unnamed");
}

#[test]
fn help_says_what_is_allowed() {
    let help = |text: &str| parse(text, "f").unwrap_err().help().unwrap();
    assert_eq!(
        help(&anchored("[[bars]]\nlenth_m = 1\n")),
        "did you mean `length_m`? allowed here: length_m, mass_kg, mass_kg_per_m, diameter_m, density_kg_m3, temperature_k, \
         expansion_per_k, centre_m, inertia_kg_m2, count, strength_n, compression_n, bending_n_m2, safety, \
         length_tolerance_m, mass_tolerance_kg"
    );
    assert_eq!(
        help(&barred("colour = \"red\"")),
        "allowed here: name, gravity_m_s2, floor_m, plane, safety, tolerances, anchors, bars, bars_file, loads, cases, joints, joints_file"
    );
    assert!(help(&barred("[nodes]")).starts_with("did you mean `joints`? "));
    assert!(help("[[cables]]").starts_with("did you mean `bars` (with a `kind`)? "));
    assert_eq!(help(&barred("")), "anchors must be a table with start_m and end_m");
    assert_eq!(
        help(&anchored("[[bars]]\nlength_m = \"1\"\nmass_kg = 1\n")),
        "numbers are written without quotes"
    );
    assert_eq!(
        help(&anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 0\n")),
        "allowed: a whole number of bars, 1 or more"
    );
    assert!(help(&anchored("[[bars]]\nlength_m = 1,5\n")).contains("numbers take a decimal point"));
    let files = "bars_file = \"b\"\n";
    assert_eq!(
        help(&barred(&format!("{files}[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]"))),
        "keep `bars_file` or `bars`, and remove the other"
    );
}

#[test]
fn positions_count_characters_and_lines_of_any_kind() {
    let text = "name = \"Ketten\u{e4}hnlich\" # \u{2713}\r\n[anchors]\r\nstart_m = [0, 0, 0]\r\nend_m = [0, 0, nan]\r\n";
    let error = parse(&barred(text), "f").unwrap_err();
    let position = error.position().unwrap();
    assert_eq!((position.line, position.column), (4, 16));
    assert_eq!(error.line(), Some("end_m = [0, 0, nan]"));
    let same_line = parse("name = \"\u{e4}\u{e4}\" x", "f").unwrap_err();
    assert_eq!(same_line.position().unwrap().column, 13);
    // A byte order mark is no character of the first line.
    let marked = parse("\u{feff}name = 3\n", "f").unwrap_err();
    assert_eq!(
        (marked.to_string().as_str(), marked.text()),
        ("f:1:8: name: expected a string, found an integer", "name = 3\n")
    );
}

#[test]
fn every_value_of_json_stays_in_its_place() {
    let json = "{\n \"name\": \"a\\/b\", \"joints\": {\"A\": {\"at_m\": [0,\n 1, 2]}, \"P\": {}},\n \
                \"bars\": [{\"from\": \"A\", \"to\": \"P\", \"length_m\": 3, \"mass_kg\": 1}]\n}\n";
    let system = system(json);
    assert_eq!((system.name(), system.joints()[0].support.at_m()), ("a/b", Some([0.0, 1.0, 2.0])));
    for (value, wrong) in
        [("\"a\\/b\"", "12345 "), ("2]", "x]"), ("3,", "-3,"), ("\"P\", ", "\"Q\", ")]
    {
        let wrong_json = json.replace(value, wrong);
        let error = parse(&wrong_json, "f").unwrap_err();
        let span = error.span().unwrap();
        assert_eq!((error.text(), span.start), (wrong_json.as_str(), json.find(value).unwrap()));
    }
}

#[test]
fn characters_of_json_in_two_halves_are_one() {
    let json = " \n{\"name\": \"\\ud83d\\udca1 \\u00e4 \\\"\\\\ : , {\", \"joints\": {\"A\": {\"at_m\": [0, 0, 0]}, \
                \"P\": {}}, \"bars\": [{\"from\": \"A\", \"to\": \"P\", \"length_m\": 3, \"mass_kg\": 1}]}";
    assert_eq!(system(json).name(), "\u{1f4a1} \u{e4} \"\\ : , {");
}

#[test]
fn what_is_no_json_is_told_with_its_place() {
    let error = parse("{\"a\": 1,\n \"b\": }", "f").unwrap_err();
    assert_eq!(error.span().unwrap().start, 15);
    assert!(error.to_string().ends_with("expected value"), "{error}");
    assert!(parse("{\"a\": [null]}", "f").unwrap_err().to_string().contains("null"));
    for (text, what) in [("// a\n{}", "expected value"), ("[{}]", "expected an object")] {
        let said = parse(text, "f.json").unwrap_err().to_string();
        assert!(said.starts_with("f.json:1:1: not valid JSON") && said.ends_with(what), "{said}");
    }
}
