//! Bars as columns: what is read, and the exact error of what is not.

use std::fmt::Write as _;

use model::Bar;
use model::system_file::{SystemFileError, read};

use crate::support::{Folder, chain};

/// The bars of a file, between anchors as far apart as fits to them.
fn bars(text: &str, span_m: f64) -> Result<Vec<Bar>, SystemFileError> {
    let folder = Folder::new(std::thread::current().name().unwrap());
    folder.file("b", text);
    let anchors = format!("{{ start_m = [0, 0, 0], end_m = [{span_m}, 0, 0] }}");
    let file = folder.file("chain.toml", format!("bars_file = \"b\"\nanchors = {anchors}"));
    let found = chain(read(file)).map(|problem| problem.chain().bars().to_vec());
    folder.done();
    found
}

#[track_caller]
fn check(text: &str, message: &str, marked: &str) {
    let error = bars(text, 1.0).expect_err(text);
    let found = &error.text()[error.span().unwrap()];
    let said = error.to_string();
    let place = said.find("/b:").map_or(0, |at| at + 1);
    assert_eq!((&said[place..], found), (message, marked));
}

#[test]
fn headers_that_are_wrong() {
    check("", "b:1:1: the key `length_m` is missing", "");
    check("\n\n", "b:1:1: the key `length_m` is missing", "");
    check("length_m\n1\n", "b:1:1: the key `mass_kg` is missing", "length_m");
    check("mass_kg , x\n", "b:1:11: x: unknown key `x`", "x");
    check("length_m,mass_kg,\n1,1,\n", "b:1:18: unknown key ``", "");
    check(
        "length_m;mass_kg\n1;1\n",
        "b:1:1: columns are separated by commas, found ';'",
        "length_m;mass_kg",
    );
    check(
        "length_m\tmass_kg\n",
        "b:1:1: columns are separated by commas, found '\\t'",
        "length_m\tmass_kg",
    );
    check(
        "length_m,mass_kg,length_m\n",
        "b:1:18: length_m: duplicate column `length_m`",
        "length_m",
    );
    let other = bars("1.0,2.0\n", 1.0).unwrap_err().to_string();
    assert!(other.ends_with("/b names no column"), "{other}");
    let help = bars("length,mass_kg\n", 1.0).unwrap_err().help().unwrap();
    assert_eq!(help, "did you mean `length_m`? allowed here: length_m, mass_kg, centre_m");
}

/// A bars file knows no `[[bars]]`.
#[test]
fn help_is_about_columns_and_rows() {
    let help = |text: &str| bars(text, 1.0).unwrap_err().help().unwrap();
    assert_eq!(
        help("length_m,mass_kg\n"),
        "every line after the header is a row: a bar of a file of bars, a joint of one of joints"
    );
    assert_eq!(
        help("length_m,mass_kg,mass_kg\n1,1,1\n"),
        "a column is given once; keep one of them"
    );
}

#[test]
fn rows_that_are_wrong() {
    let rows = |rows: &str| format!("length_m,mass_kg,centre_m\n1,1,\n{rows}\n1,1,0.5\n");
    check(&rows("1,1"), "b:3:1: expected 3 cells, found 2", "1,1");
    check(&rows("1,5,1,5,"), "b:3:1: expected 3 cells, found 5", "1,5,1,5,");
    check(&rows(""), "b:3:1: expected 3 cells, found 0", "");
    check(&rows("# bars"), "b:3:1: expected 3 cells, found 1", "# bars");
    check(&rows("1, one,"), "b:3:4: mass_kg: expected a number, found \"one\"", "one");
    check(&rows(",1,"), "b:3:1: length_m: the cell is empty", "");
    check(&rows("1,1 kg,"), "b:3:3: mass_kg: expected a number, found \"1 kg\"", "1 kg");
    check(&rows("1_0,1,"), "b:3:1: length_m: expected a number, found \"1_0\"", "1_0");
    check(&rows("\"1,0\",1,"), "b:3:1: length_m: expected a number, found \"1,0\"", "\"1,0\"");
    check(
        &rows("\u{a0}nan ,1,"),
        "b:3:2: length_m: the length of a bar must be positive and finite, got NaN m",
        "nan",
    );
    check(
        &rows("1e200,1,"),
        "b:3:1: length_m: a moment of inertia must be zero or positive, and finite, got inf kg m^2",
        "1e200",
    );
    check("length_m,mass_kg\n", "b:1:1: there are columns but no rows", "length_m,mass_kg");
}

#[test]
fn rows_become_bars() {
    let wanted = vec![
        Bar::homogeneous(1.5, 0.0).unwrap(),
        Bar::new(0.25, 2.0, 0.0, Bar::slender_inertia(0.25, 2.0)).unwrap(),
    ];
    let found = bars("length_m,mass_kg\n1.5,0\n1,1\n", 1.5).unwrap();
    assert_eq!(found, [wanted[0], Bar::homogeneous(1.0, 1.0).unwrap()]);
    for text in [
        "length_m,mass_kg,centre_m\n1.5,0,\n.25,2.,0\n",
        "\u{feff}centre_m, length_m ,mass_kg\r\n ,\t1.50,+0\r\n0,2.5e-1,2\r\n\r\n \n",
        "mass_kg,centre_m,length_m\n0,0.75,1.5\n2,-0,0.25",
    ] {
        assert_eq!(bars(text, 1.5).unwrap(), wanted, "{text:?}");
    }
}

#[test]
fn a_million_rows_come_out_bit_for_bit() {
    // Numbers of all magnitudes, with as many digits as they have.
    let number = |k: u32, power: i32| (f64::from(k) + 0.1).sqrt() * 10_f64.powi(power);
    let bar = |k: u32| {
        let (length, mass) = (number(k, -3), number(k, i32::try_from(k % 4).unwrap() - 2));
        Bar::new(length, mass, length / 3.0, Bar::slender_inertia(length, mass)).unwrap()
    };
    let wanted: Vec<Bar> = (0..1_000_000).map(bar).collect();
    let mut text = "length_m,mass_kg,centre_m\n".to_owned();
    for bar in &wanted {
        writeln!(text, "{:?},{:?},{:?}", bar.length_m(), bar.mass_kg(), bar.centre_m()).unwrap();
    }
    assert!(bars(&text, 1e5).unwrap() == wanted);
    // The place of an error in the last row is found as in the first.
    text += "1,x,\n";
    check(&text, "b:1000002:3: mass_kg: expected a number, found \"x\"", "x");
}
