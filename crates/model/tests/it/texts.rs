//! Malformed texts, each with its exact error.

use model::system_file::parse;

use crate::support::{anchored, barred, chain, check, system};

#[test]
fn text_that_is_no_system() {
    check("", "f: the file describes no system: it is empty", "");
    check("  \n# nothing\n", "f: the file describes no system: it is empty", "");
    check("hello", "f:1:6: not valid TOML: key with no value, expected `=`", "");
    check("name = \"a\nb\"", "f:2:3: not valid TOML: key with no value, expected `=`", "");
    check("[anchors\n", "f:1:9: not valid TOML: unclosed table, expected `]`", "");
    check("a = 1\na = 2\n", "f:2:1: a: duplicate key `a`, first given in line 1", "a");
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\nmass_kg = 2\n"),
        "f:7:1: bars[1].mass_kg: duplicate key `mass_kg`, first given in line 6",
        "mass_kg",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1,5\nmass_kg = 1\n"),
        "f:5:13: not valid TOML: unexpected key or value, expected newline, `#`",
        "",
    );
}

#[test]
fn keys_that_are_unknown_or_missing() {
    check(&barred("gravity = 9.81"), "f:1:1: gravity: unknown key `gravity`", "gravity");
    check(&anchored("[[bar]]\nlength_m = 1\n"), "f:4:3: bar: unknown key `bar`", "bar");
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass = 1\n"),
        "f:6:1: bars[1].mass: unknown key `mass`",
        "mass",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\n[[bars]]\nLength_m = 1\n"),
        "f:8:1: bars[2].Length_m: unknown key `Length_m`",
        "Length_m",
    );
    check(
        &barred("[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\nmiddle_m = [0, 0, 0]"),
        "f:4:1: anchors.middle_m: unknown key `middle_m`",
        "middle_m",
    );
    check(&barred("name = \"no anchors\""), "f:1:1: anchors: the key `anchors` is missing", "");
    check(&anchored(""), "f:1:1: bars: the key `bars` is missing", "");
    check(
        &barred("[anchors]\nstart_m = [0, 0, 0]"),
        "f:1:1: anchors.end_m: the key `end_m` is missing",
        "[anchors]",
    );
    check(
        &anchored("[[bars]]\nmass_kg = 1\n"),
        "f:4:1: bars[1].length_m: the key `length_m` is missing",
        "[[bars]]",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\n"),
        "f:4:1: bars[1].mass_kg: the key `mass_kg` is missing",
        "[[bars]]",
    );
}

#[test]
fn values_of_the_wrong_type() {
    check(
        &barred("name = 3\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]"),
        "f:1:8: name: expected a string, found an integer",
        "3",
    );
    check(
        &barred("gravity_m_s2 = \"9.81\"\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]"),
        "f:1:16: gravity_m_s2: expected a number, found a string",
        "\"9.81\"",
    );
    check(&barred("anchors = 1"), "f:1:11: anchors: expected a table, found an integer", "1");
    check(
        "bars = 3\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]",
        "f:1:8: bars: expected one or more tables [[bars]] with length_m and mass_kg, found an integer",
        "3",
    );
    check(
        "bars = [1]\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]",
        "f:1:9: bars[1]: expected a table, found an integer",
        "1",
    );
    check(
        &anchored("[[bars]]\nlength_m = [1]\nmass_kg = 1\n"),
        "f:5:12: bars[1].length_m: expected a number, found an array",
        "[1]",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = true\n"),
        "f:6:11: bars[1].mass_kg: expected a number, found a boolean",
        "true",
    );
    check(
        &barred("[anchors]\nstart_m = [0, 0]\nend_m = [0, 0, -2]"),
        "f:2:11: anchors.start_m: expected three numbers, found 2",
        "[0, 0]",
    );
    check(
        &barred("[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2, 1]"),
        "f:3:9: anchors.end_m: expected three numbers, found 4",
        "[0, 0, -2, 1]",
    );
    check(
        &barred("[anchors]\nstart_m = [0, \"0\", 0]\nend_m = [0, 0, -2]"),
        "f:2:15: anchors.start_m[2]: expected a number, found a string",
        "\"0\"",
    );
    check(
        &barred("[anchors]\nstart_m = 0\nend_m = [0, 0, -2]"),
        "f:2:11: anchors.start_m: expected three numbers [x, y, z], found an integer",
        "0",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 1.5\n"),
        "f:7:9: bars[1].count: expected a whole number of bars, 1 or more, found a number with a fraction",
        "1.5",
    );
}

#[test]
fn numbers_out_of_range() {
    for (length, shown) in
        [("0", "0"), ("-1.0", "-1"), ("nan", "NaN"), ("inf", "inf"), ("1e999", "inf")]
    {
        check(
            &anchored(&format!("[[bars]]\nlength_m = {length}\nmass_kg = 1\n")),
            &format!(
                "f:5:12: bars[1].length_m: the length of a bar must be positive and finite, got {shown} m"
            ),
            length,
        );
    }
    for (mass, shown) in [("-0.5", "-0.5"), ("nan", "NaN"), ("-inf", "-inf")] {
        check(
            &anchored(&format!("[[bars]]\nlength_m = 1\nmass_kg = {mass}\n")),
            &format!(
                "f:6:11: bars[1].mass_kg: the mass of a bar must be zero or positive, and finite, got {shown} kg"
            ),
            mass,
        );
    }
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncentre_m = 1.5\n"),
        "f:7:12: bars[1].centre_m: the centre of weight must lie on the bar, between 0 and its length 1 m, got 1.5 m",
        "1.5",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ninertia_kg_m2 = [0, -1, 0]\n"),
        "f:7:21: bars[1].inertia_kg_m2[2]: a moment of inertia must be zero or positive, and finite, got -1 kg m^2",
        "-1",
    );
    for (count, shown) in
        [("0", "0"), ("-3", "-3"), ("99999999999999999999", "99999999999999999999")]
    {
        check(
            &anchored(&format!("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = {count}\n")),
            &format!("f:7:9: bars[1].count: the value {shown} is out of range"),
            count,
        );
    }
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 2_000_000_000\n"),
        "f:7:9: bars[1].count: the system has more than 20000000 bars",
        "2_000_000_000",
    );
    for gravity in ["0", "-9.81", "nan"] {
        let text =
            format!("gravity_m_s2 = {gravity}\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]");
        let shown = gravity.replace("nan", "NaN");
        check(
            &barred(&text),
            &format!(
                "f:1:16: gravity_m_s2: gravity must be positive and finite (it acts along -Z), got {shown} m/s^2"
            ),
            gravity,
        );
    }
    check(
        &barred("[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, nan, -2]"),
        "f:3:13: anchors.end_m[2]: the coordinates of joint \"3\" must be finite, got NaN m",
        "nan",
    );
    check(
        &barred("[anchors]\nstart_m = [-1.7e308, 0, 0]\nend_m = [1.7e308, 0, 0]"),
        "f:3:9: anchors.end_m: the span of this system is above 1e150: its square is more than a double can hold",
        "[1.7e308, 0, 0]",
    );
}

#[test]
fn text_that_is_toml_in_part() {
    check(
        "name = \"chain\n[anchors]\n",
        "f:1:14: not valid TOML: invalid basic string, expected `\"`",
        "",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1 m\nmass_kg = 1\n"),
        "f:5:12: not valid TOML: string values must be quoted, expected literal string",
        "1 m",
    );
    check(
        &anchored("[[bars]]\nlength_m : 1\n"),
        "f:5:10: not valid TOML: key with no value, expected `=`",
        "",
    );
    check(
        &anchored("[[bars]]\nlength_m = .5\n"),
        "f:5:12: not valid TOML: invalid mantissa, expected digits",
        "",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1.0.0\n"),
        "f:5:15: not valid TOML: invalid float, expected nothing",
        ".0",
    );
    check(
        "name = 'a\u{7}'\n",
        "f:1:10: not valid TOML: invalid literal string, expected non-single-quote visible characters",
        "",
    );
    // Nested a million deep, as tables, arrays and dotted keys: refused, not followed.
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
fn keys_given_twice_name_the_first() {
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\n[anchors]\nend_m = [1, 1, 1]\n"),
        "f:7:2: anchors: duplicate key `anchors`, first given in line 1",
        "anchors",
    );
    check(
        &anchored("end_m = [0, 0, -1]\n"),
        "f:4:1: anchors.end_m: duplicate key `end_m`, first given in line 3",
        "end_m",
    );
    // The same key in an earlier table is not the first one.
    check(
        &anchored(
            "[[bars]]\nlength_m = 1\nmass_kg = 1\n[[bars]]\nlength_m = 1\n\n  \"length_m\" = 2\n",
        ),
        "f:10:3: bars[2].length_m: duplicate key `length_m`, first given in line 8",
        "\"length_m\"",
    );
    // In one line with others of the same name, which is the first is not said.
    check(
        "bars = [{ length_m = 1, mass_kg = 1 }, { length_m = 1, length_m = 2 }]\n",
        "f:1:56: length_m: duplicate key `length_m`",
        "length_m",
    );
    check("a.b = 1\na.b = 2\n", "f:2:3: b: duplicate key `b`", "b");
}

#[test]
fn bars_in_other_shapes() {
    check(
        "bars = []\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n",
        "f:1:8: bars: a system needs at least one member",
        "[]",
    );
    check(
        &anchored("[bars]\nlength_m = 1\nmass_kg = 1\n"),
        "f:4:1: bars: expected one or more tables [[bars]] with length_m and mass_kg, found a table",
        "[bars]",
    );
    check(
        "anchors.start_m = [0, 0, 0]\nbars = [{ length_m = 1, mass_kg = 1, count = 3 }]\n",
        "f:1:1: anchors.end_m: the key `end_m` is missing",
        "anchors",
    );
    check(
        "anchors = { start_m = [0, 0, 0], end_m = [1, 0, 0] }\nbars = [{ length_m = 1, mass_kg = 1 }, { mass_kg = 2 }]\n",
        "f:2:40: bars[2].length_m: the key `length_m` is missing",
        "{ mass_kg = 2 }",
    );
    check(
        &barred("bars_file = \"bars.csv\"\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]"),
        "f:1:13: bars_file: `bars_file` and `bars` cannot stand together",
        "\"bars.csv\"",
    );
    check(
        "bars_file = \"bars.csv\"\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n",
        "f:1:13: bars_file: `bars_file` is relative to the system file, and this text was not read from a file",
        "\"bars.csv\"",
    );
    check(
        "bars_file = 3\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n",
        "f:1:13: bars_file: expected a string, found an integer",
        "3",
    );
}

#[test]
fn values_of_stranger_types() {
    check(
        &barred("gravity_m_s2 = 1979-05-27\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]"),
        "f:1:16: gravity_m_s2: expected a number, found a date or time",
        "1979-05-27",
    );
    check(
        &anchored("[[bars]]\nlength_m = { m = 1 }\nmass_kg = 1\n"),
        "f:5:12: bars[1].length_m: expected a number, found a table",
        "{ m = 1 }",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ninertia_kg_m2 = []\n"),
        "f:7:17: bars[1].inertia_kg_m2: expected three numbers, found 0",
        "[]",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1e-400\nmass_kg = 1\n"),
        "f:5:12: bars[1].length_m: the length of a bar must be positive and finite, got 0 m",
        "1e-400",
    );
    // The length and the mass are numbers, their moment of inertia is infinite; there is no key for
    // it.
    check(
        &anchored("[[bars]]\nlength_m = 1e200\nmass_kg = 1\n"),
        "f:4:1: bars[1].inertia_kg_m2: a moment of inertia must be zero or positive, and finite, got inf kg m^2",
        "[[bars]]",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1e-300\nmass_kg = 1\ncount = 3\n"),
        "f:4:1: bars: the total length of this system, 3e-300 in SI units, is too small for double precision \
         (least: 1.0020841800044864e-292)",
        "[[bars]]",
    );
}

#[test]
fn numbers_are_read_as_written() {
    let text = "gravity_m_s2 = 0x10\nanchors = { start_m = [-0, 1_000, 0o17], end_m = [2, 0.1, 1e3] }\n\
                bars = [{ length_m = 18446744073709551617, mass_kg = 9007199254740993, count = 0b11 }]\n";
    let problem = chain(parse(text, "f")).unwrap();
    let chain = problem.chain();
    assert_eq!(chain.gravity_m_s2().to_bits(), 16.0_f64.to_bits());
    let bits = |v: [f64; 3]| v.map(f64::to_bits);
    assert_eq!(bits(chain.anchors().start_m), bits([-0.0, 1000.0, 15.0]));
    assert_eq!(bits(chain.anchors().end_m), bits([2.0, 0.1, 1000.0]));
    assert_eq!(chain.bars().len(), 3);
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
}
