//! Files of other programs: refused with a line, or systems that are written and read again as the same.

use formats::system::Source;
use model::system_file::{Described, parse, write_network};

use super::fuzz;
use super::mutate::mutated;

/// A lamp on two lines, as each of them has it.
const EXAMPLES: [(Source, &str); 4] = [
    (
        Source::Dxf,
        "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLINE\n8\ncables\n10\n0\n20\n0\n\
         30\n0\n11\n3\n21\n0\n31\n-4\n0\nLWPOLYLINE\n8\nbars\n90\n2\n70\n0\n38\n0\n10\n6\n20\n0\n10\n6\n20\n9\n0\nPOLYLINE\n\
         8\nstruts\n66\n1\n70\n8\n0\nVERTEX\n10\n3\n20\n0\n30\n-4\n0\nVERTEX\n10\n6\n20\n0\n30\n0\n0\nSEQEND\n0\nPOINT\n8\n\
         anchors\n10\n0\n20\n0\n0\nPOINT\n8\nanchors_free_x\n10\n6\n20\n0\n0\nTEXT\n8\nnames\n10\n3\n20\n0\n30\n-4\n1\n\
         lamp\n0\nENDSEC\n0\nEOF\n",
    ),
    (
        Source::Obj,
        "v 0 0 0\nv 6 0 0\nv 3 0 -4\nv 3 1 2\ng cables\nl 1 -2 2\no a\nl 4 3\ng anchors\np 1 2 4\nf 1 2 3\n",
    ),
    (
        Source::Map,
        "--- LINE DICTIONARY ---\nLineType Diam MassDenInAir EA CB\n(-) (m) (kg/m) (N) (-)\na 0.1 50 1e8 1\n\
         --- NODE PROPERTIES ---\nNode Type X Y Z M B FX FY FZ\n(-) (-) (m) (m) (m) (kg) (m^3) (N) (N) (N)\n\
         1 Fix 90 1 -80 0 0 # # #\n2 Connect #4 #0 #-5 1 0.5 3 0 -2\n3 Vessel 2 0 -1 0 0 # # #\n\
         --- LINE PROPERTIES ---\nLine LineType UnstrLen NodeAnch NodeFair Flags\n(-) (-) (m) (-) (-) (-)\n\
         1 a 70 1 2 plot\n2 a 50 2 3\n--- SOLVER OPTIONS ---\nOption\n(-)\nhelp\nrepeat 90 120\n",
    ),
    (
        Source::OpenSees,
        "model basic -ndm 2 -ndf 2\nset E 200e9; set L [expr 3*(1+1)]\nnode 1 0 0\nnode 2 $L 0\nnode 3 3.0 -4 -mass 1 1\n\
         fix 1 1 1\nfix 2 0 1\nuniaxialMaterial Elastic 1 $E\nelement truss 1 1 3 1e-4 1\nelement corotTruss 2 3 2 \\\n 1e-4 1\n\
         timeSeries Linear 1 -factor 2\npattern Plain 1 1 {\nload 3 [expr {-1e3}] -9\n}\nanalyze 1\n",
    ),
];

/// More members than a test has time for.
const MANY: usize = 5000;

fn check(source: Source, text: &str) {
    let read = match source.parse(text, "fuzz").and_then(|read| read.above_floor("fuzz")) {
        Ok(system) => system,
        Err(error) => {
            assert!(error.to_string().starts_with("fuzz:"), "{error}");
            let lines = text.lines().count();
            assert!(error.line.is_none_or(|line| (1..=lines + 1).contains(&line)), "{error}");
            return;
        }
    };
    if read.members().len() <= MANY {
        let written = write_network(&read);
        let again = parse(&written, "again.toml");
        assert_eq!(again.unwrap(), Described::System(read), "{written}");
    }
}

#[test]
fn files_of_other_programs() {
    let all: Vec<&[u8]> = EXAMPLES.iter().map(|(_, text)| text.as_bytes()).collect();
    for (source, text) in EXAMPLES {
        check(source, text);
        assert!(source.parse(text, "fuzz").unwrap().above_floor("fuzz").is_ok(), "{source:?}");
        fuzz(
            &format!("foreign-{source:?}"),
            |random| mutated(random, text.as_bytes(), &all),
            |bytes| check(source, &String::from_utf8_lossy(bytes)),
        );
    }
}
