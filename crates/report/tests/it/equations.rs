//! The numbered equations: all are there, and all are typeset.

use report::equations::all;

#[test]
fn every_numbered_equation_is_there_in_order() {
    const ROMAN: [&str; 26] = [
        "i", "ii", "iii", "iv", "v", "vi", "vii", "viii", "ix", "x", "xi", "xii", "xiii", "xiv",
        "xv", "xvi", "xvii", "xviii", "xix", "xx", "xxi", "xxii", "xxiii", "xxiv", "xxv", "xxvi",
    ];
    let expected: Vec<String> = (1..=41)
        .map(|k| format!("({k})"))
        .chain(ROMAN.iter().map(|roman| format!("({roman})")))
        .collect();
    let found: Vec<&str> = all().map(|equation| equation.number).collect();
    assert_eq!(found, expected);
}

#[test]
fn what_is_marked_wrong_is_corrected_and_nothing_else() {
    for equation in all() {
        let marked = equation.printed.contains(r"\wrong{");
        let mended = equation.corrected.is_some_and(|latex| latex.contains(r"\fixed{"));
        assert_eq!(marked, mended, "{}", equation.number);
        assert_eq!(marked, equation.corrected.is_some(), "{}", equation.number);
        assert!(
            equation.says.len() > 5 && equation.says.ends_with(['.', ')']),
            "{}",
            equation.number
        );
    }
}

#[test]
fn every_equation_is_typeset() {
    for equation in all() {
        for latex in [Some(equation.printed), equation.corrected].into_iter().flatten() {
            let mathml = report::math::mathml(latex);
            assert!(!mathml.contains("merror"), "{}: {mathml}", equation.number);
            assert!(!mathml.contains("rgb("), "{}: {mathml}", equation.number);
            // The converter puts a space into the base of a power of a bare \cos.
            for script in ["msup", "msub", "msubsup"] {
                assert!(!mathml.contains(&format!("<{script}><mspace")), "{}", equation.number);
            }
            assert_eq!(
                mathml.contains("class=\"wrong\"") || mathml.contains("class=\"fixed\""),
                equation.corrected.is_some(),
                "{}",
                equation.number
            );
        }
    }
}
