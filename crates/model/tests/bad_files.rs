//! Malformed and impossible system files, each with its exact error.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use model::system_file::{SystemFileErrorKind, parse_problem, parse_system, read_problem};

/// A file with the anchors of the paper in front of the given rest.
fn anchored(rest: &str) -> String {
    format!("[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n{rest}")
}

/// Three bars of the paper behind the given head.
fn barred(head: &str) -> String {
    format!("{head}\n[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 3\n")
}

/// The error of a text: its message, and what stands in the marked span.
fn error_of(text: &str) -> (String, String) {
    let error = parse_problem(text, "f").expect_err(text);
    let marked = error.span().map_or("", |span| &text[span]).to_owned();
    (error.to_string(), marked)
}

#[track_caller]
fn check(text: &str, message: &str, marked: &str) {
    assert_eq!(error_of(text), (message.to_owned(), marked.to_owned()));
}

#[test]
fn text_that_is_no_system() {
    check("", "f: the file describes no system: it is empty", "");
    check("  \n# nothing\n", "f: the file describes no system: it is empty", "");
    check("hello", "f:1:6: not valid TOML: key with no value, expected `=`", "");
    check("name = \"a\nb\"", "f:2:3: not valid TOML: key with no value, expected `=`", "");
    check("[anchors\n", "f:1:9: not valid TOML: unclosed table, expected `]`", "");
    check("a = 1\na = 2\n", "f:2:1: not valid TOML: duplicate key", "a");
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\nmass_kg = 2\n"),
        "f:7:1: not valid TOML: duplicate key",
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
        "f:1:8: name: expected a string, found a value of type integer",
        "3",
    );
    check(
        &barred("gravity_m_s2 = \"9.81\"\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]"),
        "f:1:16: gravity_m_s2: expected a number, found a value of type string",
        "\"9.81\"",
    );
    check(
        &barred("anchors = 1"),
        "f:1:11: anchors: expected a table, found a value of type integer",
        "1",
    );
    check(
        "bars = 3\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]",
        "f:1:8: bars: expected one or more tables [[bars]] with length_m and mass_kg, found a value of type integer",
        "3",
    );
    check(
        "bars = [1]\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]",
        "f:1:9: bars[1]: expected a table, found a value of type integer",
        "1",
    );
    check(
        &anchored("[[bars]]\nlength_m = [1]\nmass_kg = 1\n"),
        "f:5:12: bars[1].length_m: expected a number, found an array",
        "[1]",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = true\n"),
        "f:6:11: bars[1].mass_kg: expected a number, found a value of type boolean",
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
        "f:2:15: anchors.start_m: expected a number, found a value of type string",
        "\"0\"",
    );
    check(
        &barred("[anchors]\nstart_m = 0\nend_m = [0, 0, -2]"),
        "f:2:11: anchors.start_m: expected three numbers [x, y, z], found a value of type integer",
        "0",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 1.5\n"),
        "f:7:9: bars[1].count: expected a whole number of bars, 1 or more, found a value of type float",
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
        "f:7:17: bars[1].inertia_kg_m2: a moment of inertia must be zero or positive, and finite, got -1 kg m^2",
        "[0, -1, 0]",
    );
    for (count, shown) in
        [("0", "0"), ("-3", "-3"), ("99999999999999999999", "99999999999999999999")]
    {
        check(
            &anchored(&format!("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = {count}\n")),
            &format!("f:7:9: bars[1].count: the number {shown} is out of range"),
            count,
        );
    }
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 2_000_000_000\n"),
        "f:7:9: bars[1].count: the counts add up to more than 20000000 bars",
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
        "f:3:9: anchors.end_m: the coordinates of an anchor must be finite, got NaN m",
        "[0, nan, -2]",
    );
    check(
        &barred("[anchors]\nstart_m = [-1.7e308, 0, 0]\nend_m = [1.7e308, 0, 0]"),
        "f:4:1: bars: the span of this chain is larger than a double can hold",
        "[[bars]]",
    );
}

#[test]
fn chains_that_are_no_equilibrium_problem() {
    let two = |a: &str, b: &str| {
        format!("[[bars]]\nlength_m = {a}\nmass_kg = 1\n[[bars]]\nlength_m = {b}\nmass_kg = 1\n")
    };
    check(
        &anchored(&two("0.5", "1")),
        "f:3:9: anchors.end_m: the anchors are 2 m apart and the bars reach only 1.5 m: 0.5 m are missing",
        "[0, 0, -2]",
    );
    check(
        &anchored(&two("1", "1")),
        "f:3:9: anchors.end_m: the bars reach exactly from anchor to anchor (total length 2 m, span 2 m): \
         the chain is straight and taut, and the force along it is indeterminate",
        "[0, 0, -2]",
    );
    check(
        &anchored(&two("0.5", "3")),
        "f:8:12: bars[2].length_m: bar 2 is 3 m long, longer than the other bars (0.5 m) and the span (2 m) \
         together: the chain cannot close",
        "3",
    );
    check(
        &anchored(&two("2.5", "0.5")),
        "f:5:12: bars[1].length_m: bar 1 is 2.5 m long, exactly as long as the other bars (0.5 m) and the span \
         (2 m) together: the chain closes only folded on one line, and the force along it is indeterminate",
        "2.5",
    );
    check(
        "[anchors]\nstart_m = [1, 1, 1]\nend_m = [1, 1, 1]\n[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 2\n",
        "f:5:12: bars[1].length_m: bar 1 is 1 m long, exactly as long as the other bars (1 m) and the span (0 m) \
         together: the chain closes only folded on one line, and the force along it is indeterminate",
        "1",
    );
    check(
        &anchored("[[bars]]\nlength_m = 1\nmass_kg = 0\ncount = 3\n"),
        "f:5:12: bars: no bar has mass: without weight every position is an equilibrium",
        "1",
    );
    check(
        &anchored("[[bars]]\nlength_m = 2\nmass_kg = 1\n"),
        "f:5:12: bars: a single bar between two fixed points cannot move, and the force along it is \
         indeterminate (length 2 m, span 2 m)",
        "2",
    );
    // The bar that is too long in the third table is the fifth of the chain.
    check(
        &anchored(
            "[[bars]]\nlength_m = 0.1\nmass_kg = 1\ncount = 3\n[[bars]]\nlength_m = 0.2\nmass_kg = 1\n[[bars]]\nlength_m = 9\nmass_kg = 1\n",
        ),
        "f:12:12: bars[3].length_m: bar 5 is 9 m long, longer than the other bars (0.5 m) and the span (2 m) \
         together: the chain cannot close",
        "9",
    );
}

#[test]
fn what_is_refused_as_a_problem_is_still_a_system() {
    let text = anchored("[[bars]]\nlength_m = 2\nmass_kg = 1\n");
    assert_eq!(parse_system(&text, "f").unwrap().bars().len(), 1);
}

#[test]
fn help_says_what_is_allowed() {
    let help = |text: &str| parse_problem(text, "f").unwrap_err().help().unwrap();
    assert_eq!(
        help(&anchored("[[bars]]\nlenth_m = 1\n")),
        "did you mean `length_m`? allowed here: length_m, mass_kg, centre_m, inertia_kg_m2, count"
    );
    assert_eq!(
        help(&barred("colour = \"red\"")),
        "allowed here: name, gravity_m_s2, anchors, bars"
    );
    assert_eq!(help(&barred("")), "anchors must be a table with start_m and end_m");
}

#[test]
fn positions_count_characters_and_lines_of_any_kind() {
    let text = "name = \"Ketten\u{e4}hnlich\" # \u{2713}\r\n[anchors]\r\nstart_m = [0, 0, 0]\r\nend_m = [0, 0, nan]\r\n";
    let error = parse_problem(&barred(text), "f").unwrap_err();
    let position = error.position().unwrap();
    assert_eq!((position.line, position.column), (4, 9));
    assert_eq!(error.line(), Some("end_m = [0, 0, nan]"));
    let same_line = parse_problem("name = \"\u{e4}\u{e4}\" x", "f").unwrap_err();
    assert_eq!(same_line.position().unwrap().column, 13);
}

#[test]
fn files_that_cannot_be_read() {
    let folder = std::env::temp_dir().join(format!("funicular-bad-files-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let missing = read_problem(folder.join("missing.toml")).unwrap_err();
    assert!(matches!(missing.kind(), SystemFileErrorKind::Unreadable(_)), "{missing}");
    assert!(missing.to_string().contains("cannot read the file"), "{missing}");
    let directory = read_problem(&folder).unwrap_err();
    assert!(matches!(directory.kind(), SystemFileErrorKind::Unreadable(_)), "{directory}");
    let bytes = folder.join("bytes.toml");
    std::fs::write(&bytes, [b'a', b'=', 0xff, 0xfe]).unwrap();
    let not_text = read_problem(&bytes).unwrap_err();
    assert!(matches!(not_text.kind(), SystemFileErrorKind::NotText { offset: 2 }), "{not_text}");
    let marked = folder.join("marked.toml");
    std::fs::write(
        &marked,
        format!("\u{feff}{}", anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 3\n")),
    )
    .unwrap();
    assert!(read_problem(&marked).is_ok(), "a byte order mark is no error");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// A small generator (splitmix64): the mutations are the same on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((z ^ (z >> 31)) % bound as u64).unwrap()
    }
}

#[test]
fn ten_thousand_mutations_never_panic() {
    let original = model::cases::get("three-bars-off-centre").unwrap().text.as_bytes();
    let mut random = Random(1);
    let (mut good, mut bad) = (0, 0);
    for _ in 0..10_000 {
        let mut bytes = original.to_vec();
        for _ in 0..=random.below(4) {
            let place = random.below(bytes.len().max(1));
            let byte = u8::try_from(random.below(256)).unwrap();
            match random.below(5) {
                0 => bytes.truncate(place),
                1 if !bytes.is_empty() => drop(bytes.remove(place)),
                2 => bytes.insert(place, byte),
                // Mutations that stay close to the format find more than noise.
                3 => bytes.insert(place, b"0123456789.-+eE[]=_#\"\n"[random.below(22)]),
                _ if !bytes.is_empty() => bytes[place] = byte,
                _ => {}
            }
        }
        let text = String::from_utf8_lossy(&bytes);
        match parse_problem(&text, "mutated") {
            Ok(_) => good += 1,
            Err(error) => {
                bad += 1;
                // The message, the place and the help must work for every error.
                let shown = format!("{error} {:?} {:?}", error.line(), error.help());
                assert!(shown.len() > "mutated:".len());
                if let Some(span) = error.span() {
                    assert!(
                        text.get(span).is_some(),
                        "a span outside the text or within a character"
                    );
                }
            }
        }
    }
    assert!(good > 100 && bad > 1000, "the mutations test nothing: {good} good, {bad} bad");
}
