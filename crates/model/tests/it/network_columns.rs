//! Systems whose joints and bars stand in files of columns: what is read, and the exact error of
//! what is not.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use model::Bar;
use model::system::{Joint, Kind, Member, PointLoad, Support, System};
use model::system_file::{Cell, Described, Rows, SystemFileError, read, read_with};

use crate::support::{Folder, rows};

const JOINTS: &str = "name,x_m,y_m,z_m,fixed,free,mass_kg,force_x_n,force_y_n,force_z_n\n\
                      A,0,0,0,,,,,,\n\
                      \"lamp, old\",9,9,9,0,,5,0,12,0\n\
                      C,2,0,0.5,,xz,,,,\n\
                      4,,,,,,,,,\n";

const BARS: &str = "to,from,length_m,mass_kg,centre_m,kind,stiffness_n,prestress_n,force_x_n,force_y_n,force_z_n,force_at_m\n\
                    \"lamp, old\",A,1.5,1,0.5,,,,,,,\n\
                    C,\"lamp, old\",1.5,1,,cable,1e5,25000,1,0,0,\n\
                    4,C,0.25,1,,strut,,,0,0,1,0.25\n";

const SYSTEM: &str = "joints_file = \"joints.csv\"\nbars_file = \"bars.csv\"\n";

/// The folder of a test.
fn folder() -> PathBuf {
    let test = std::thread::current().name().unwrap().replace("::", "-");
    PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(test)
}

/// The system of these texts; nothing is written of a text that is empty.
fn described([system, joints, bars]: [&str; 3]) -> Result<System, SystemFileError> {
    let folder = Folder::new(folder());
    for (file, text) in [("system.toml", system), ("joints.csv", joints), ("bars.csv", bars)] {
        if !text.is_empty() {
            folder.file(file, text);
        }
    }
    match read(folder.0.join("system.toml"))? {
        Described::System(system) => Ok(system),
        Described::Chain(_) => panic!("joints by name make no chain"),
    }
}

/// The files must be refused with this message: file, line, column, key, reason.
#[track_caller]
fn check(joints: &str, bars: &str, wanted: &str) {
    let error = described([SYSTEM, joints, bars]).unwrap_err().to_string();
    assert_eq!(error, folder().join(wanted).display().to_string());
}

#[test]
fn every_column_arrives_where_it_belongs() {
    let found = described([SYSTEM, JOINTS, BARS]).unwrap();
    let at_m = [2.0, 0.0, 0.5];
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        // Where it was drawn says nothing of where it hangs.
        Joint::free("lamp, old").with_mass(5.0).with_force([0.0, 12.0, 0.0]),
        Joint::free("C").held_by(Support::Plane { at_m, normal: [0.0, 1.0, 0.0] }),
        Joint::free("4"),
    ];
    let bar = |length: f64| Bar::homogeneous(length, 1.0).unwrap();
    let load = |at_m, force_n| vec![PointLoad { at_m, force_n, is_spread: false }];
    let off = Bar::new(1.5, 1.0, 0.5, Bar::slender_inertia(1.5, 1.0)).unwrap();
    // A quarter of its stiffness makes it a quarter longer.
    let cable = Member::cable(1, 2, bar(1.5)).with_loads(load(0.75, [1.0, 0.0, 0.0]));
    let cable = cable.with_stiffness(1e5).with_prestress(2.5e4).unwrap();
    assert_eq!((cable.body.length_m(), cable.loads[0].at_m), (1.2, 0.6));
    let members = vec![
        Member::bar(0, 1, off),
        cable,
        Member::bar(2, 3, bar(0.25)).of_kind(Kind::Strut).with_loads(load(0.25, [0.0, 0.0, 1.0])),
    ];
    assert_eq!(found, System::new("unnamed", 9.80665, joints, members).unwrap());
}

/// Names between blanks, or between semicolons as one of them has a blank; written as a table they are read as the same.
#[test]
fn ropes_run_over_the_joints_of_a_cell() {
    let bars = "from,via,to,length_m,mass_kg,kind,stiffness_n\n\
                A,C A C,4,9,,cable,\n\
                A,\"lamp, old; C\",4,7.5,0,cable,300\n\
                A,\"lamp, old;\",C,4,,cable,\n\
                C,,4,1,0.5,,\n";
    let found = described([SYSTEM, JOINTS, bars]).unwrap();
    let rope = |to, length_m, via: &[usize]| {
        Member::cable(0, to, Bar::homogeneous(length_m, 0.0).unwrap()).over(via.to_vec())
    };
    let told = [
        rope(3, 9.0, &[2, 0, 2]),
        rope(3, 7.5, &[1, 2]).with_stiffness(300.0),
        rope(2, 4.0, &[1]),
        Member::bar(2, 3, Bar::homogeneous(1.0, 0.5).unwrap()),
    ];
    assert_eq!(found.members(), told);
    let text = model::system_file::write_network(&found);
    assert_eq!(model::system_file::parse(&text, "x.toml").unwrap(), Described::System(found));
    // Drawn, it is as long as its spans: 2, 1.5 and 2.5 m.
    let joints = "name,x_m,y_m,z_m,mass_kg,near_x_m,near_y_m,near_z_m\nA,0,0,0,,,,\nB,2,0,0,,,,\n\
                  P,,,,1,2,1.5,0\nQ,,,,1,2,1.5,-2.5\n";
    let bars = "from,via,to,mass_kg,kind\nA,B P,Q,,cable\nP,,Q,1,cable\n";
    let drawn = described([SYSTEM, joints, bars]).unwrap();
    assert!((drawn.members()[0].body.length_m() - 6.0).abs() < 1e-15);
}

#[test]
fn what_is_no_rope_is_refused_in_its_cell() {
    for (row, wanted) in [
        ("A,C,4,9,,strut", ["only a cable runs over rings", ": kind: "]),
        ("A,C,4,9,2,cable", ["has no mass here", ": mass_kg: "]),
        ("A,C X,4,9,,cable", ["\"X\"", ": via: "]),
        ("A,;,4,9,,cable", ["empty", ": via: "]),
        ("A,C C,4,9,,cable", ["runs from joint \"C\" to itself", ": via: "]),
    ] {
        let bars = format!("from,via,to,length_m,mass_kg,kind\n{row}\n");
        let text = described([SYSTEM, JOINTS, &bars]).unwrap_err().to_string();
        assert!(wanted.iter().all(|wanted| text.contains(wanted)), "{row}: {text}");
    }
}

/// Anchors in the system file, a thousand joints by their numbers in one of their own.
#[test]
fn joints_may_stand_in_both_places_and_have_numbers_for_names() {
    let joints = "mass_kg\n".to_owned() + &"0.5\n".repeat(999);
    let mut bars = "from,to,length_m,mass_kg\nA,0,0.1,0\n".to_owned();
    for k in 1..999 {
        writeln!(bars, "{},{k},0.1,0", k - 1).unwrap();
    }
    bars += "998,B,0.1,0\n";
    let system = "joints_file = \"joints.csv\"\nbars_file = \"bars.csv\"\n\
                  [joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [80, 0, 0] }\n";
    let found = described([system, &joints, &bars]).unwrap();
    assert_eq!((found.joints().len(), found.members().len()), (1001, 1000));
    assert_eq!(found.joint("998"), Some(1000));
    assert!((found.total_mass_kg() - 499.5).abs() < 1e-12);
    let last = found.members().last().unwrap();
    assert_eq!((last.from, last.to), (1000, 1));
}

#[test]
fn errors_name_file_row_and_column() {
    for [file, old, new, message] in rows("columns") {
        let changed = |text: &str| match old.as_str() {
            "" => new.clone(),
            "+" => text.to_owned() + &new,
            _ => text.replacen(&old, &new, 1),
        };
        match file.as_str() {
            "joints" => check(&changed(JOINTS), BARS, &message),
            _ => check(JOINTS, &changed(BARS), &message),
        }
    }
}

#[test]
fn keys_that_do_not_go_together_are_refused() {
    let refused = |system: &str| described([system, JOINTS, BARS]).unwrap_err().kind().to_string();
    let with_bars = format!("{SYSTEM}[[bars]]\nfrom = \"A\"\n");
    assert_eq!(refused(&with_bars), "`bars_file` and `bars` cannot stand together");
    let anchors = format!("{SYSTEM}anchors = {{}}\n");
    assert_eq!(refused(&anchors), "`joints_file` and `anchors` cannot stand together");
    let gone = refused("joints_file = \"gone.csv\"\nbars_file = \"bars.csv\"\n");
    assert!(gone.contains("gone.csv"), "{gone}");
    let text = model::system_file::parse(SYSTEM, "text").unwrap_err().to_string();
    assert!(text.contains("`joints_file` is relative to the system file"), "{text}");
}

/// Rows of another kind of file, as a program reads them.
#[test]
fn readers_of_other_files_name_their_rows() {
    let text = "bars_file = \"bars.x\"\n[joints]\nA = { at_m = [0, 0, 0] }\n7 = {}\n";
    let path = Folder::new(folder()).file("system.toml", text);
    let by = |length_m: f64, to: f64| {
        let rows = |file: &Path, rows: &mut dyn Rows| {
            assert!(file.ends_with("bars.x"));
            let cells =
                [Cell::Text("A"), Cell::Number(to), Cell::Number(length_m), Cell::Number(1.0)];
            let _ = rows.names(&["from", "to", "length_m", "mass_kg"]) && rows.row(&cells);
            Some(Ok(()))
        };
        read_with(&path, &rows)
    };
    let Ok(Described::System(system)) = by(2.0, 7.0) else { panic!("one bar hangs") };
    assert_eq!(system.members()[0].to, 1);
    let said = |length_m, to| by(length_m, to).unwrap_err().to_string();
    let error = said(-2.0, 7.0);
    assert!(
        error.contains(":1:13: bars_file: ")
            && error.contains("bars.x: row 1, column `length_m`: the length"),
        "{error}"
    );
    assert!(
        said(2.0, 7.5)
            .ends_with("row 1, column `to`: a joint is named by text or a whole number, found 7.5")
    );
    assert!(said(2.0, 8.0).ends_with("row 1, column `to`: there is no joint \"8\""));
}

#[test]
fn cells_may_be_quoted_and_blank() {
    let joints = "name , x_m,y_m,z_m\r\n\"the, \"\"old\"\" lamp\" , 0,0 ,0\n P ,,,\n\n";
    let bars = "from , to,length_m,mass_kg\r\n\"the, \"\"old\"\" lamp\" ,P, 1e-3 ,2\n\n";
    let found = described([SYSTEM, joints, bars]).unwrap();
    let names: Vec<_> = found.joints().iter().map(|joint| joint.name.to_string()).collect();
    assert_eq!(names, ["the, \"old\" lamp", "P"]);
    assert_eq!(found.members(), [Member::bar(0, 1, Bar::homogeneous(1e-3, 2.0).unwrap())]);
}

#[test]
fn quotes_are_closed() {
    for line in ["\"A,0,0,0", "\"A\"x,0,0,0"] {
        let joints = format!("name,x_m,y_m,z_m\n{line}\nB,,,\n");
        let error = described([SYSTEM, &joints, BARS]).unwrap_err();
        assert!(error.to_string().contains("a quote is not closed"), "{error}");
        assert_eq!(&error.text()[error.span().unwrap()], line);
    }
}
