//! MAP++ input files.

use formats::system::{Source, parse_map};
use model::STANDARD_GRAVITY_M_S2;

use crate::refused;

/// A buoy between a chain to the ground and a rope to a vessel, and the same turned by a right angle.
const DECK: &str = "\
--------------- LINE DICTIONARY ---------------
LineType  Diam  MassDenInAir  EA     CB   CIntDamp  Ca   Cdn   Cdt
(-)       (m)   (kg/m)        (N)    (-)  (Pa-s)    (-)  (-)   (-)
chain     0.2   100           1e9    1.0  1e8       0.6  -1.0  0.05
rope      0.2   20            1e7    1.0  1e8       0.6  -1.0  0.05
--------------- NODE PROPERTIES ---------------
Node  Type     X    Y   Z     M    B    FX   FY   FZ
(-)   (-)     (m)  (m)  (m)  (kg) (m^3) (N)  (N)  (N)
1     Fix      90   10  -80   0    0    #    #    #
2     Connect  #40  #0  #-50  100  0.5  300  0    -20
3     VESSEL   20   0   -10   0    0    #    #    #
--------------- LINE PROPERTIES ---------------
Line  LineType  UnstrLen  NodeAnch  NodeFair  Flags
(-)   (-)       (m)       (-)       (-)       (-)
1     chain     70        1         2         gx_pos plot
2     rope      50        2         3
--------------- SOLVER OPTIONS ----------------
Option
(-)
help
outer_tol 1e-5
repeat 90   ! degrees
ref_position 0 0 0
";

#[test]
fn nodes_are_joints_and_lines_are_cables_in_a_row() {
    let found = parse_map(DECK, "x.map").unwrap();
    let system = &found.system;
    let names: Vec<_> = system.joints()[..6].iter().map(|joint| joint.name.text()).collect();
    assert_eq!(names, ["1", "2", "3", "4", "5", "6"]);
    assert_eq!((system.members().len(), system.joints().len()), (200, 6 + 4 * 49));
    let g = STANDARD_GRAVITY_M_S2;
    // The water lifts 500 litres of a buoy of 100 kg; a metre of line displaces 1025 pi/100 kg.
    let (lift_n, water_kg_m) = (0.5 * 1025.0 * g, 10.25 * std::f64::consts::PI);
    let (force_n, mass_kg) = (system.joints()[1].force_n, system.joints()[1].mass_kg);
    assert_eq!((&force_n[..2], mass_kg), (&[300.0, 0.0][..], 100.0));
    assert!((force_n[2] - (lift_n - 20.0)).abs() < 1e-9);
    let (chain, rope) = (&system.members()[0], &system.members()[50]);
    assert_eq!((chain.stiffness_n, chain.body.length_m()), (Some(1e9), 1.4));
    assert!((chain.body.mass_kg() - 1.4 * (100.0 - water_kg_m)).abs() < 1e-12);
    assert!((rope.loads[0].force_n[2] - (water_kg_m - 20.0) * g).abs() < 1e-9);
    assert_eq!((rope.from, system.members()[99].to), (1, 2));
    // A quarter clockwise, as seen from above: x is -y.
    let turned = &system.joints()[3..6];
    let at_m = turned[0].support.at_m().unwrap();
    assert!((at_m[0] - 10.0).hypot(at_m[1] + 90.0).hypot(at_m[2] + 80.0) < 1e-12, "{at_m:?}");
    assert!(turned[1].force_n[0].hypot(turned[1].force_n[1] + 300.0) < 1e-12);
    assert_eq!((system.members()[100].from, system.members()[199].to), (3, 5));
    // The ground is at the lowest anchor.
    assert_eq!(found.floor_m, Some(-80.0));
    assert!(found.notes[0].contains("1025 kg/m^3") && found.notes[0].contains("friction"));
    assert!(found.notes[1].starts_with("line 1: 50 elastic cables of 1.4 m"));
    assert!(
        found.notes.last().unwrap().contains("lack the mass of the line that the water carries")
    );
    let free =
        DECK.replace("gx_pos plot", "plot omit_CONTACT").replace("3\n---", "3 OMIT_CONTACT\n---");
    assert_eq!(parse_map(&free, "x").unwrap().floor_m, None);
    assert_eq!(Source::guess("txt", DECK), Some(Source::Map));
    assert_eq!(
        Source::guess("txt", &DECK.replace("UnstrLen", "UnstrLen NumSegs")),
        Some(Source::MoorDyn)
    );
}

/// Mass, volume and force of nodes that do not move, those of the copy turned.
#[test]
fn loads_on_held_nodes_are_told_with_their_sum() {
    let held =
        |text: &str| parse_map(text, "x").unwrap().notes.into_iter().find(|n| n.contains("held"));
    assert_eq!(held(DECK), None);
    let text = DECK.replace("-10   0    0    #    #    #", "-10   2000 1    700  -20  #9");
    assert_ne!(text, DECK);
    let note = held(&text).unwrap();
    let (_, rest) = note.split_once("loads on held nodes (2), in sum (").unwrap();
    let sum: Vec<f64> =
        rest.split_once(')').unwrap().0.split(", ").map(|x| x.parse().unwrap()).collect();
    // The copy has (y, -x).
    let wanted = [700.0 - 20.0, -20.0 - 700.0, -2.0 * (2000.0 - 1025.0) * STANDARD_GRAVITY_M_S2];
    for (sum, wanted) in sum.iter().zip(wanted) {
        assert!((sum - wanted).abs() < 1e-9, "{note}");
    }
}

#[test]
fn options_that_begin_with_a_space_or_a_hash_are_comments() {
    let angles = |to: &str| {
        let found = parse_map(&DECK.replace("repeat 90 ", to), "x").unwrap();
        let says = found.notes.iter().any(|note| note.starts_with("line 22 begins with a space"));
        (found.system.members().len() / 100 - 1, says)
    };
    assert_eq!(angles("repeat 90 180 "), (2, false));
    assert_eq!(angles(" repeat 90 "), (0, true));
    assert_eq!(angles("# repeat 90 "), (0, false));
    assert_eq!(angles(" my own remark "), (0, true));
}

#[test]
fn what_is_wrong_in_a_deck_has_its_line() {
    refused("map", DECK, |text| parse_map(text, "x"));
}

/// What flags there are, and what to do about a spring.
#[test]
fn flags_of_output_pass_and_others_have_help() {
    let outputs =
        "gx_a_pos GY_FORCE h_fair v_anch tension_fair x_excursion azimuth altitude_a line_tension";
    let same = parse_map(&DECK.replace("gx_pos plot", outputs), "x").unwrap();
    assert_eq!(same.system, parse_map(DECK, "x").unwrap().system);
    for (flag, says) in
        [("frobnicate", "known are: OMIT_CONTACT, plot,"), ("LINEAR_SPRING", "an elastic member")]
    {
        let error = parse_map(&DECK.replace("plot", flag), "x").unwrap_err();
        assert!(error.help.unwrap().contains(says), "{flag}");
    }
}

/// Copies are counted before they are made.
#[test]
fn copies_have_a_budget() {
    let error = parse_map(&DECK.replace("90   !", &("90 ".repeat(50_000) + "!")), "x").unwrap_err();
    assert!(error.to_string().contains("bytes of memory are needed"), "{error}");
}
