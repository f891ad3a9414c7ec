//! What the paper prints wrong is wrong by a lot; what is corrected holds to rounding.

use std::sync::LazyLock;

use paper::equations::{E1State, EquationAudit, FaultyEquations, Validity, audit};

/// The audit at E1: most tests read it.
static ROWS: LazyLock<Vec<EquationAudit>> = LazyLock::new(|| audit(&e1()));

/// E1 of 40-digit root finding, as established outside of the project.
fn e1() -> E1State {
    E1State {
        theta: 19.694_867_976_133_02_f64.to_radians(),
        alpha: 38.599_136_184_451_89_f64.to_radians(),
        beta: (-73.920_588_792_231_34_f64).to_radians(),
        multipliers_mg: [
            [0.0, -0.648_944_835_933_933_6, 2.312_944_292_241_837_6],
            [0.0, 0.648_944_835_933_933_6, -1.312_944_292_241_837_6],
            [0.0, 0.648_944_835_933_933_6, -0.312_944_292_241_837_6],
            [0.0, 0.648_944_835_933_933_6, 0.687_055_707_758_162_4],
        ],
    }
}

/// The row whose text begins so.
fn row(rows: &[EquationAudit], number: &str, what: &str) -> EquationAudit {
    let found: Vec<_> =
        rows.iter().filter(|row| row.number == number && row.what.starts_with(what)).collect();
    assert_eq!(found.len(), 1, "{number} {what}");
    found[0].clone()
}

/// Residual of the corrected form; infinite if there is none.
fn corrected(row: &EquationAudit) -> f64 {
    row.as_corrected.map_or(f64::INFINITY, f64::abs)
}

#[test]
fn what_is_wrong_is_wrong_by_a_lot_and_right_when_corrected() {
    // number, beginning of the text, least error as printed, largest as corrected.
    let exact = 1e-12;
    let numeric = 1e-9;
    let expected = [
        ("abstract", "", 11.9, exact),
        ("(5)", "entry (3,1)", 1.5, exact),
        ("(5)", "entry (3,3)", 1.5, exact),
        ("(18)", "", 1.0, exact),
        ("(19)", "", 1.0, exact),
        ("(20)", "", 1.0, exact),
        ("(23)", "first line", 0.9, exact),
        ("(24)", "first component", 1.5, numeric),
        ("(31)", "entry (2,1)", 0.3, exact),
        ("(31)", "entry (2,2)", 1.0, exact),
        ("(31)", "entry (3,1)", 1.0, exact),
        ("(32)", "two brackets", 2.9, exact),
        ("(33)", "lower right", 1.0, numeric),
        ("(33)", "no bracket", 17.9, exact),
        ("(33)", "the matrix", 11.9, exact),
        ("(38)", "", 1.9, exact),
        ("(39)", "no bracket", 1.9, exact),
        ("(39)", "[Q']", 1.0, numeric),
        ("before (40)", "", 3.9, exact),
        ("after (41)", "cites", 10.9, exact),
        ("before (i)", "the angles", 0.9, exact),
        ("before (i)", "OD = l", 0.9, exact),
        ("(vii)", "is printed", 0.9, exact),
        ("after (viii)", "two solutions", 1.9, exact),
        // The digits that the correction prints end at 1e-5 deg.
        ("(ix)", "the angles", 0.01, 5.01e-6),
        ("(xxiii)", "row of theta_1", 0.9, exact),
        ("(xxiv)", "row of phi_2", 0.9, exact),
        ("(xxiv)", "row of phi_3 split into two equations: the half with lambda_8", 0.4, exact),
        ("(xxiv)", "row of phi_3 split into two equations: the half with lambda_11", 0.4, exact),
        ("(xxiv)-(xxvi)", "", 0.9, exact),
    ];
    for (number, what, least, most) in expected {
        let row = row(&ROWS, number, what);
        assert!(row.as_printed.abs() > least, "{row:?}");
        assert!(corrected(&row) < most, "{row:?}");
        assert_eq!(row.verdict, Validity::Corrected, "{row:?}");
        assert!(!row.corrected.is_empty());
    }
    assert_eq!(
        ROWS.iter().filter(|row| row.verdict == Validity::Corrected).count(),
        expected.len()
    );
}

#[test]
fn the_halves_of_the_last_row_are_false_and_cancel() {
    let half = |what: &str| row(&ROWS, "(xxiv)", what).as_printed;
    let at_b = half("row of phi_3 split into two equations: the half with lambda_8");
    let at_d = half("row of phi_3 split into two equations: the half with lambda_11");
    // Four digits, from outside of the project.
    assert!((at_b + 0.4804).abs() < 5e-5, "{at_b}");
    assert!((at_d - 0.4804).abs() < 5e-5, "{at_d}");
    assert!((at_b + at_d).abs() < 1e-14);
}

#[test]
fn the_second_position_is_refuted_and_the_overturned_first_is_one() {
    let x = row(&ROWS, "(x)", "no equilibrium");
    assert_eq!(x.verdict, Validity::Refuted);
    // Four digits, from outside of the project.
    assert!((x.as_printed - 0.5229).abs() < 5e-5, "{x:?}");
    assert!(corrected(&x) < 1e-12, "{x:?}");
    let quadrant = row(&ROWS, "after (viii)", "one solution");
    assert_eq!(quadrant.verdict, Validity::Refuted);
    // beta of E1 is the theta of E2; its roots are the other two angles of E1 with the sign
    // changed.
    assert!((quadrant.as_printed - 19.694_867_976_133_02).abs() < 1e-12, "{quadrant:?}");
    assert!(corrected(&quadrant) < 1e-12, "{quadrant:?}");
    assert_eq!(ROWS.iter().filter(|row| row.verdict == Validity::Refuted).count(), 2);
}

/// Nine equations and the position (x) are wrong in substance; the rest of what fails is form, or
/// digits.
#[test]
fn substance_form_and_digits_are_told_apart() {
    let found = FaultyEquations::of(&ROWS);
    assert_eq!(found.numbered, 41 + 26);
    assert_eq!(
        found.substance,
        ["(5)", "(18)", "(19)", "(20)", "(24)", "(31)", "(39)", "(x)", "(xxiii)", "(xxiv)"]
    );
    assert_eq!(found.form, ["(23)", "(32)", "(33)", "(38)", "(vii)"]);
    assert_eq!(found.digits, ["(ix)"]);
    for row in ROWS.iter() {
        let fails = matches!(row.verdict, Validity::Corrected | Validity::Refuted);
        assert_eq!(row.fault.is_some(), fails, "{row:?}");
    }
}

/// What is true as printed and worth a number: no correction.
#[test]
fn remarks_are_no_faults() {
    let load = row(&ROWS, "(41)", "with zeros for the dots");
    assert!((load.as_printed - 1.0).abs() < 1e-12, "{load:?}");
    let lock = row(&ROWS, "before (xi)", "these coordinates");
    assert!((lock.as_printed - 3.0).abs() < 0.5 && corrected(&lock) < 0.5, "{lock:?}");
    assert_eq!((load.verdict, lock.verdict), (Validity::Remark, Validity::Remark));
    assert_eq!(row(&ROWS, "(41)", "the load").verdict, Validity::Holds);
    assert_eq!(row(&ROWS, "before (xi)", "psi_i").verdict, Validity::Holds);
    assert_eq!(ROWS.iter().filter(|row| row.verdict == Validity::Remark).count(), 2);
}

#[test]
fn what_holds_holds_to_rounding() {
    let numeric = ["(22)", "(23)", "(24)", "(25)", "(32)"];
    let printed_digits = ["(ix)", "(x)"];
    let holding: Vec<_> = ROWS.iter().filter(|row| row.verdict == Validity::Holds).collect();
    assert!(holding.len() > 20, "{}", holding.len());
    for row in holding {
        let bound = if numeric.contains(&row.number) {
            1e-9
        } else if printed_digits.contains(&row.number) {
            5.01e-6
        } else {
            1e-12
        };
        assert!(row.as_printed.abs() < bound, "{row:?}");
        assert!(row.as_corrected.is_none(), "{row:?}");
    }
}

#[test]
fn every_numbered_equation_is_there_in_order() {
    const ROMAN: [&str; 26] = [
        "(i)", "(ii)", "(iii)", "(iv)", "(v)", "(vi)", "(vii)", "(viii)", "(ix)", "(x)", "(xi)",
        "(xii)", "(xiii)", "(xiv)", "(xv)", "(xvi)", "(xvii)", "(xviii)", "(xix)", "(xx)", "(xxi)",
        "(xxii)", "(xxiii)", "(xxiv)", "(xxv)", "(xxvi)",
    ];
    let expected: Vec<String> =
        (1..=41).map(|k| format!("({k})")).chain(ROMAN.map(String::from)).collect();
    let mut found: Vec<String> = ROWS
        .iter()
        .map(|row| row.number.to_owned())
        .filter(|number| expected.contains(number))
        .collect();
    found.dedup();
    assert_eq!(found, expected);
}

#[test]
fn an_equation_off_the_equilibrium_is_not_said_to_hold() {
    let off = E1State { theta: e1().theta + 1e-6, ..e1() };
    let rows = audit(&off);
    for number in ["(i)", "(ii)", "(iii)", "(iv)", "(40)", "(xxv)", "(xxvi)"] {
        assert_eq!(row(&rows, number, "").verdict, Validity::Refuted, "{number}");
    }
}

#[test]
fn nothing_at_an_unknown_equilibrium_is_said_to_hold() {
    let nan = f64::NAN;
    let unknown = E1State { theta: nan, alpha: nan, beta: nan, multipliers_mg: [[nan; 3]; 4] };
    let at_e1 = "(i), (ii), (iii), (iv), (40), (41), before (i), after (viii), (ix), after (xxiii), (xxiv), (xxv), (xxvi), after (xxvi)";
    let at_e1: Vec<_> = at_e1.split(", ").collect();
    let mut met = 0;
    // Neither of these asks where the equilibrium is.
    let elsewhere = ["the angles are measured", "two solutions"];
    let rests = |row: &&EquationAudit| {
        at_e1.contains(&row.number) && !elsewhere.iter().any(|what| row.what.starts_with(what))
    };
    for row in audit(&unknown).iter().filter(rests) {
        assert_eq!(row.verdict, Validity::Refuted, "{row:?}");
        met += 1;
    }
    assert!(met >= at_e1.len());
}

#[test]
fn two_audits_are_the_same() {
    assert_eq!(audit(&e1()), *ROWS);
}
