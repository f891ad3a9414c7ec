//! Structures as they are drawn: places, planes, lengths; and what is no drawing.

use model::Bar;
use model::system::{Joint, Member, Refusal, Support, System, SystemError};
use model::system_file::write_network;

use crate::support::system;

/// A braced square, a bar between its two tops hanging in the middle of two.
const FRAME: &str = "plane = \"xz\"\n[joints]\nA = { at_m = [0, 0, 0] }\n\
B = { near_m = [4, 0, 0], free = \"x\" }\nC = { near_m = [0, 0, 3] }\n\
D = { near_m = [4, 0, 3], force_n = [5, 0, 0] }\n";

fn bar(from: &str, to: &str, more: &str) -> String {
    format!("[[bars]]\nfrom = \"{from}\"\nto = \"{to}\"\nmass_kg = 2\n{more}\n")
}

fn frame(diagonal: &str) -> System {
    let bars = [
        bar("A", "C", ""),
        bar("A", "B", ""),
        bar("B", "D", ""),
        bar("C", "D", "count = 2"),
        bar("A", "D", diagonal),
        bar("B", "C", ""),
    ];
    system(&(FRAME.to_owned() + &bars.concat()))
}

#[test]
fn lengths_are_those_of_the_drawing() {
    let read = frame("");
    let lengths: Vec<f64> = read.members().iter().map(|m| m.body.length_m()).collect();
    // 3, 4, 5, and two halves of 4.
    assert_eq!(lengths, [3.0, 4.0, 3.0, 2.0, 2.0, 5.0, 5.0]);
    // The joint between the halves is drawn in the middle.
    let drawing = [[0.0; 3], [4.0, 0.0, 0.0], [0.0, 0.0, 3.0], [4.0, 0.0, 3.0], [2.0, 0.0, 3.0]];
    assert_eq!(read.drawing(), Some(drawing.to_vec()));
    // Where it slides it is drawn.
    assert_eq!(
        read.joints()[1].support,
        Support::Line { at_m: drawing[1], direction: [1.0, 0.0, 0.0] }
    );
    assert_eq!(read.members()[5].body, Bar::homogeneous(5.0, 2.0).unwrap());
    // Unstretched there, or as long as the force makes it: 5 = l (1 + 250/1000).
    let elastic = frame("stiffness_n = 1e3");
    assert_eq!(elastic.members()[5].body.length_m().to_bits(), 5.0_f64.to_bits());
    let prestressed = frame("stiffness_n = 1e3\nprestress_n = 250");
    assert_eq!(prestressed.members()[5].body.length_m().to_bits(), 4.0_f64.to_bits());
    // What is given is given.
    assert_eq!(frame("length_m = 5.5").members()[5].body.length_m().to_bits(), 5.5_f64.to_bits());
}

#[test]
fn joints_of_a_planar_system_stay_in_its_plane() {
    let read = frame("");
    let normal = [0.0, 1.0, 0.0];
    for joint in [2, 3, 4] {
        let at_m = read.joints()[joint].drawn_m().unwrap();
        assert_eq!(read.joints()[joint].support, Support::Plane { at_m, normal });
    }
    let along_x = Support::Line { at_m: [4.0, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
    assert_eq!(read.joints()[1].support, along_x);
    // A plane of its own meets that of the drawing in a line.
    let slider = "plane = \"xy\"\n[joints]\nA = { at_m = [0, 0, 7] }\n\
        B = { at_m = [3, 4, 7], normal = [0.6, 0.8, 0], force_n = [1, 0, 0] }\n";
    let read = system(&(slider.to_owned() + &bar("A", "B", "length_m = 6")));
    let Support::Line { at_m, direction } = read.joints()[1].support else { panic!() };
    assert_eq!((at_m, direction.map(f64::abs)), ([3.0, 4.0, 7.0], [0.8, 0.6, 0.0]));
    assert!((0.6 * direction[0] + 0.8 * direction[1]).abs() < 1e-15);
    // Nothing is drawn here, and what is free is in the plane of the supports all the same.
    assert_eq!(read.drawing(), None);
    let hung = "plane = \"yz\"\n[joints]\nA = { at_m = [2, 0, 0] }\nP = { mass_kg = 1 }\n";
    let read = system(&(hung.to_owned() + &bar("A", "P", "length_m = 6")));
    let plane = Support::Plane { at_m: [2.0, 0.0, 0.0], normal: [1.0, 0.0, 0.0] };
    assert_eq!(read.joints()[1].support, plane);
}

#[test]
fn drawings_read_back_as_they_were() {
    for read in [frame(""), frame("stiffness_n = 1e3\nprestress_n = 250")] {
        assert_eq!(system(&write_network(&read)), read);
    }
}

#[test]
fn a_drawing_is_put_on_and_taken_off() {
    let read = frame("");
    assert_eq!(read.clone().undrawn().drawing(), None);
    let mut places = read.drawing().unwrap();
    places[2] = [0.1, 0.0, 2.9];
    let moved = read.clone().undrawn().drawn_at(&places).unwrap();
    assert_eq!(moved.drawing(), Some(places.clone()));
    // What its support does not allow is left out.
    places[2] = [0.1, 0.5, 2.9];
    let put = read.clone().drawn_at(&places).unwrap();
    assert_eq!(put.joints()[2].near_m, Some([0.1, 0.0, 2.9]));
    places[2] = [f64::NAN; 3];
    assert!(matches!(read.drawn_at(&places), Err(SystemError::Coordinate { joint: 2, .. })));
}

/// A chord of two panels between two pins, and a post that holds its middle or does not.
fn chord(braced: bool) -> System {
    let joint = |name, at_m| Joint::free(name).near(at_m).with_mass(1.0);
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::anchor("B", [2.0, 0.0, 0.0]),
        joint("middle", [1.0, 0.0, 0.0]),
        joint("top", [1.0, 0.0, 1.0]),
    ];
    let rigid =
        |from, to, length_m: f64| Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
    let mut members = vec![rigid(0, 2, 1.0), rigid(2, 1, 1.0), rigid(2, 3, 1.0)];
    if braced {
        members.extend([rigid(0, 3, 2.0_f64.sqrt()), rigid(1, 3, 2.0_f64.sqrt())]);
    }
    System::new("chord", 10.0, joints, members).unwrap()
}

#[test]
fn straight_chords_are_refused_only_where_nothing_else_holds_them() {
    assert_eq!(chord(true).refusal(), Ok(()));
    // A post that stands on the middle holds nothing.
    assert!(matches!(chord(false).refusal(), Err(Refusal::Taut { .. })));
    // A cable from 1 m above the middle holds it where it is no longer than that; one that is slack there does not.
    let beside = |third: Member| {
        let mut joints = chord(false).joints().to_vec();
        joints[3] = Joint::anchor("top", [1.0, 0.0, 1.0]);
        let mut members = chord(false).members()[..2].to_vec();
        members.push(third);
        System::new("beside", 10.0, joints, members).unwrap().refusal()
    };
    let long = |length_m: f64| Bar::homogeneous(length_m, 0.0).unwrap();
    assert_eq!(beside(Member::cable(2, 3, long(1.0))), Ok(()));
    for cable in [long(1.001), long(3.0)] {
        let stretched = Member::cable(3, 2, cable).with_stiffness(1e4);
        for member in [Member::cable(2, 3, cable), stretched] {
            assert!(matches!(beside(member), Err(Refusal::Taut { .. })));
        }
    }
    assert_eq!(beside(Member::cable(2, 3, long(0.999)).with_stiffness(1e4)), Ok(()));
    // A third bar over two in a line: held by what meets them elsewhere, or folded.
    let with_long = |braced: bool| {
        let long = Member::bar(4, 1, Bar::homogeneous(2.0, 0.0).unwrap());
        let first = Member::bar(4, 2, Bar::homogeneous(1.0, 0.0).unwrap());
        let base = chord(true);
        let mut joints = base.joints().to_vec();
        joints.push(Joint::free("left").near([0.0, 0.0, 1e-9]));
        let mut members = base.members().to_vec();
        members.remove(0);
        members.extend([first, long]);
        if !braced {
            members.retain(|member| (member.from, member.to) != (2, 3));
        }
        System::new("folded", 10.0, joints, members).unwrap()
    };
    assert_eq!(with_long(true).refusal(), Ok(()));
    assert!(matches!(with_long(false).refusal(), Err(Refusal::Folded { .. })));
}
