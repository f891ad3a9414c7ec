//! Files on disk: those that cannot be read, and bars that stand in a file of their own.

use std::fs;
use std::path::Path;

use model::Bar;
use model::system_file::{
    Cell, MAX_FILE_BYTES, Rows, RowsReader, SystemFileErrorKind as Kind, read, read_with,
};

use crate::support::{Folder, anchored, barred, chain};

#[test]
fn files_that_cannot_be_read() {
    let folder = Folder::new("unreadable");
    let path = folder.0.join("missing.toml");
    let missing = read(&path).unwrap_err();
    let shown = path.display().to_string();
    assert!(matches!(missing.kind(), Kind::Unreadable(_)), "{missing}");
    assert!(
        missing.to_string().starts_with(&format!("{shown}: cannot read the file: ")),
        "{missing}"
    );
    assert_eq!((missing.file(), missing.position(), missing.line()), (shown.as_str(), None, None));
    assert!(std::error::Error::source(&missing).is_some());

    let directory = read(&folder.0).unwrap_err();
    assert!(matches!(directory.kind(), Kind::Unreadable(_)), "{directory}");
    folder.done();
}

#[test]
fn files_that_are_no_text() {
    let folder = Folder::new("no-text");
    let path = folder.file("bytes.toml", b"name = \"\xc3\xa4\"\nname = \"\xe4\"\n");
    let error = read(&path).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("{}:2:9: the file is not UTF-8 text (first bad byte at offset 20)", path.display())
    );
    assert_eq!(error.line(), Some("name = \"\u{fffd}\""));
    assert_eq!(&error.text()[error.span().unwrap()], "\u{fffd}");
    assert_eq!(error.help().unwrap(), "save the file as UTF-8");
    // UTF-16, as some editors save.
    let wide = folder.file("wide.toml", [0xff, 0xfe, b'a', 0]);
    assert!(matches!(read(wide).unwrap_err().kind(), Kind::NotText(0)));
    folder.done();
}

#[test]
fn files_that_are_too_long() {
    let folder = Folder::new("too-long");
    let path = folder.file("long.toml", "");
    let length = MAX_FILE_BYTES + 1;
    fs::File::options().write(true).open(&path).unwrap().set_len(length).unwrap();
    let error = read(&path).unwrap_err();
    assert_eq!(
        error.to_string(),
        format!("{}: the file is longer than the limit of 67108864 bytes", path.display())
    );
    folder.done();
    // A device says that it has no length, and never ends.
    if cfg!(target_os = "linux") {
        let endless = read("/dev/zero").unwrap_err();
        assert!(matches!(endless.kind(), Kind::TooLong(MAX_FILE_BYTES)), "{endless}");
    }
}

#[test]
fn files_from_other_editors() {
    let folder = Folder::new("other-editors");
    let text = anchored("[[bars]]\nlength_m = 1\nmass_kg = 1\ncount = 3\n");
    let plain = read(folder.file("plain.toml", &text)).unwrap();
    let marked = folder.file("marked.toml", format!("\u{feff}{}", text.replace('\n', "\r\n")));
    assert_eq!(read(marked).unwrap(), plain);
    folder.done();
}

const WITH_FILE: &str =
    "bars_file = \"bars.csv\"\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n";

#[test]
fn bars_from_a_file_are_those_of_the_tables() {
    let folder = Folder::new("bars-file");
    let system = folder.file("chain.toml", WITH_FILE);
    folder.file("bars.csv", "length_m,mass_kg,centre_m\n1,1,\n1,2,0.25\n1,1,0.5\n");
    let tables = anchored(
        "[[bars]]\nlength_m = 1\nmass_kg = 1\n[[bars]]\nlength_m = 1\nmass_kg = 2\ncentre_m = 0.25\n\
         inertia_kg_m2 = [0, 0.16666666666666666, 0.16666666666666666]\n\
         [[bars]]\nlength_m = 1\nmass_kg = 1\n",
    );
    let tables = read(folder.file("tables.toml", tables)).unwrap();
    assert_eq!(read(system).unwrap(), tables);
    folder.done();
}

#[test]
fn errors_about_bars_in_a_file_stand_where_they_belong() {
    let folder = Folder::new("bars-file-errors");
    let system = folder.file("chain.toml", WITH_FILE);
    let bars = folder.0.join("bars.csv");
    let (toml, csv) = (system.display().to_string(), bars.display().to_string());
    let error = || read(&system).unwrap_err();

    let missing = error();
    assert!(
        missing
            .to_string()
            .starts_with(&format!("{toml}:1:13: bars_file: cannot read the bars from {csv}: ")),
        "{missing}"
    );
    assert_eq!(missing.line(), Some("bars_file = \"bars.csv\""));

    for (content, message) in [
        (
            "mass_kg,length_m\n1,0.5\n1,3.5\n1,0.5\n",
            format!(
                "{csv}:3:1: member 2 from \"1\" to \"2\" is 3.5 m long, and the rest of a loop through it \
                 (1, 0, 3, 2) only 3 m: the loop cannot close, 0.5 m are missing"
            ),
        ),
        (
            "length_m,mass_kg\n1,0\n2,0\n",
            format!(
                "{toml}:1:13: bars_file: no mass and no force act on the system: without load every \
                 position is an equilibrium"
            ),
        ),
        (
            "length_m,mass_kg\n0.5,1\n0.5,1\n",
            format!(
                "{toml}:4:9: anchors.end_m: the anchors \"0\" and \"2\" are 2 m apart and the members between \
                 them reach only 1 m: 1 m are missing"
            ),
        ),
        (
            "length_m,mass_kg\n1e-300,1\n",
            format!(
                "{toml}:1:13: bars_file: the total length of this system, 1e-300 in SI units, is too small for \
                 double precision (least: 1.0020841800044864e-292)"
            ),
        ),
    ] {
        folder.file("bars.csv", content);
        assert_eq!(error().to_string(), message);
    }
    folder.file("bars.csv", b"length_m,mass_kg\n1,\xff\n");
    assert_eq!(
        error().to_string(),
        format!("{csv}:2:3: the file is not UTF-8 text (first bad byte at offset 19)")
    );
    let conflict = folder.file("both.toml", barred(WITH_FILE));
    assert!(matches!(read(conflict).unwrap_err().kind(), Kind::Conflict { .. }));
    folder.done();
}

#[test]
fn a_reader_of_another_kind_is_asked_first() {
    let folder = Folder::new("foreign");
    let text = "bars_file = \"bars.table\"\n[anchors]\nstart_m = [0, 0, 0]\nend_m = [0, 0, -2]\n";
    let system = folder.file("system.toml", text);
    let shown = system.display().to_string();
    let bar = |length| Bar::homogeneous(length, 1.0).unwrap();
    let by = |reader: RowsReader<'_>| chain(read_with(&system, reader));
    let of = |lengths: [f64; 2]| {
        move |path: &Path, rows: &mut dyn Rows| {
            assert!(path.ends_with("bars.table"));
            let cells = lengths.map(|length| [Cell::Number(length), Cell::Number(1.0)]);
            let _ = rows.names(&["length_m", "mass_kg"]) && cells.iter().all(|row| rows.row(row));
            Some(Ok(()))
        }
    };
    assert_eq!(by(&of([1.0, 2.0])).unwrap().chain().bars(), [bar(1.0), bar(2.0)]);

    let error = by(&|_, _| Some(Err("row 7 is bad".into()))).unwrap_err();
    assert_eq!(error.to_string(), format!("{shown}:1:13: bars_file: row 7 is bad"));

    let error = by(&of([9.0, 1.0])).unwrap_err();
    assert!(
        error.to_string().contains("bars.table: row 1: member 1 from \"0\" to \"1\" is 9 m long"),
        "{error}"
    );
    assert_eq!(error.line(), Some("bars_file = \"bars.table\""));

    // A file that it does not know is read as columns.
    folder.file("bars.table", "length_m,mass_kg\n1,1\n2,1\n");
    assert_eq!(by(&|_, _| None).unwrap().chain().bars(), [bar(1.0), bar(2.0)]);
    folder.done();
}
