//! Equilibria as files of other programs: of an asymmetric system in balance by hand.

use formats::answer::{Forces, Joints, parse_vtu};
use formats::export::{ExportError, Moving, Shape, Target, collection};
use formats::system::{parse_compas, parse_moordyn};
use model::system::{Joint, Kind, Member, Support, System};
use model::{Bar, Vector};

/// A lamp of 40 N on two cables of 3 and 4 m between anchors 5 m apart, at 10 m/s²: forces of 32 and 24 N. The second weighs 10 N
/// itself, half of it on the lamp of 35 N.
fn lamp() -> (System, [Vector; 3]) {
    let system = System::new(
        "lamp <1>",
        10.0,
        vec![
            Joint::anchor("A", [0.0; 3]),
            Joint::anchor("B \"b\"", [5.0, 0.0, 0.0]),
            Joint::free("lamp").with_mass(2.5).with_force([0.0, 0.0, -10.0]),
        ],
        vec![
            Member::cable(0, 2, Bar::homogeneous(2.5, 0.0).unwrap()).with_stiffness(160.0),
            Member::cable(2, 1, Bar::homogeneous(3.2, 1.0).unwrap()).with_stiffness(96.0),
        ],
    );
    (system.unwrap(), [[0.0; 3], [5.0, 0.0, 0.0], [1.8, 0.0, -2.4]])
}

const AXIAL_N: [f64; 2] = [32.0, 24.0];
/// The ground holds half of the weight of the second cable too.
const REACTIONS_N: [Vector; 3] = [[-19.2, 0.0, 25.6], [19.2, 0.0, 19.4], [0.0; 3]];

fn text(target: Target) -> String {
    moving_text(target, None).unwrap()
}

fn moving_text(target: Target, moving: Option<Moving<'_>>) -> Result<String, ExportError> {
    let (system, joints_m) = lamp();
    let used = [Some(0.5), None];
    let shape = Shape {
        system: &system,
        joints_m: &joints_m,
        axial_n: &AXIAL_N,
        reactions_n: &REACTIONS_N,
        used: &used,
        moving,
    };
    shape.text(target)
}

/// Numbers of an array of a grid.
fn array<'a>(text: &'a str, name: &str) -> Vec<&'a str> {
    let (_, rest) = text.split_once(&format!("Name=\"{name}\"")).unwrap();
    let (_, rest) = rest.split_once('>').unwrap();
    rest.split_once('<').unwrap().0.split_whitespace().collect()
}

#[test]
fn a_grid_has_places_and_forces() {
    let text = text(Target::Vtu);
    let read = parse_vtu(&text, "x").unwrap();
    assert_eq!(read.joints, Joints::InOrder(lamp().1.to_vec()));
    assert_eq!(read.forces, Forces::Numbered(vec![(0, 2, Some(32.0)), (2, 1, Some(24.0))]));
    let array = |name| array(&text, name);
    assert_eq!(array("utilisation"), ["0.5", "nan"]);
    assert_eq!(array("reaction_n")[..6], ["-19.2", "0.0", "25.6", "19.2", "0.0", "19.4"]);
    assert_eq!(array("mass_kg"), ["0.0", "0.0", "2.5"]);
    assert_eq!((array("held"), array("unstretched_m")), (vec!["1", "1", "0"], vec!["2.5", "3.2"]));
    assert!(!text.contains("velocity_m_s") && !text.contains("TimeValue"));
}

#[test]
fn a_grid_of_a_motion_has_its_time() {
    let velocities_m_s = [[0.0; 3], [0.0; 3], [0.25, -3.0, 1.5]];
    let moving =
        Moving { time_s: 0.5, velocities_m_s: &velocities_m_s, numbers: &[("kinetic_j", 14.0)] };
    let text = moving_text(Target::Vtu, Some(moving)).unwrap();
    assert_eq!((array(&text, "TimeValue"), array(&text, "kinetic_j")), (vec!["0.5"], vec!["14.0"]));
    assert_eq!(array(&text, "velocity_m_s")[6..], ["0.25", "-3.0", "1.5"]);
    assert_eq!(array(&text, "axial_n"), ["32.0", "24.0"]);
    let cut = Moving { velocities_m_s: &velocities_m_s[1..], ..moving };
    assert!(moving_text(Target::Vtu, Some(cut)).is_err());
    let files = [(0.0, "a \"b\"/0.vtu".to_owned()), (0.1, "a/1.vtu".to_owned())];
    let text = collection(files);
    assert!(text.contains("timestep=\"0.0\" part=\"0\" file=\"a &quot;b&quot;/0.vtu\""));
    assert!(text.contains("timestep=\"0.1\" part=\"0\" file=\"a/1.vtu\""));
}

#[test]
fn the_force_densities_of_a_graph_balance_its_loads() {
    let net = parse_compas(&text(Target::Compas), "x").unwrap();
    assert_eq!(net.name, "lamp <1>");
    // The lamp with half of the second cable, and the other half at B.
    let weights: Vec<f64> = net.nodes.iter().map(|node| node.force_n[2]).collect();
    assert_eq!(weights, [0.0, -5.0, -40.0]);
    let lamp = &net.nodes[2];
    for axis in 0..3 {
        let pull: f64 = net
            .edges
            .iter()
            .map(|edge| {
                let other = if edge.from == 2 { edge.to } else { edge.from };
                edge.density_n_m * (net.nodes[other].at_m[axis] - lamp.at_m[axis])
            })
            .sum();
        assert!((pull + lamp.force_n[axis]).abs() < 1e-13, "{axis}: {pull}");
    }
}

#[test]
fn lines_of_moordyn_have_lengths_masses_and_stiffness() {
    let read = parse_moordyn(&text(Target::MoorDyn), "x").unwrap().system;
    assert_eq!((read.gravity_m_s2(), read.floor_m()), (10.0, None));
    // The force on the lamp is a mass there.
    assert_eq!((read.joints()[2].force_n, read.joints()[2].mass_kg), ([0.0; 3], 3.5));
    for (one, other) in read.members().iter().zip(lamp().0.members()) {
        assert_eq!((one.from, one.to, one.kind), (other.from, other.to, Kind::Cable));
        assert_eq!(
            (one.stiffness_n, one.body.length_m()),
            (other.stiffness_n, other.body.length_m())
        );
        assert!((one.body.mass_kg() - other.body.mass_kg()).abs() < 1e-15);
    }
}

#[test]
fn a_drawing_has_a_line_for_each_member_in_its_layer() {
    let text = text(Target::Dxf);
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines.len().is_multiple_of(2));
    let pairs: Vec<(&str, &str)> = lines.chunks(2).map(|pair| (pair[0], pair[1])).collect();
    let begin = pairs.iter().position(|pair| *pair == ("0", "LINE")).unwrap();
    let wanted = "0 LINE 8 cables 62 5 10 0.0 20 0.0 30 0.0 11 1.8 21 0.0 31 -2.4";
    assert_eq!(lines[2 * begin..2 * begin + 18].join(" "), wanted);
    assert!(pairs.contains(&("1", "B \"b\"")) && pairs.ends_with(&[("0", "ENDSEC"), ("0", "EOF")]));
}

/// Six times the volume inside of triangles that are seen from outside.
fn volume6(corners: &[[f64; 3]], triangles: &[[usize; 3]]) -> f64 {
    let of = |[a, b, c]: [[f64; 3]; 3]| {
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
    };
    triangles.iter().map(|triangle| of(triangle.map(|k| corners[k]))).sum()
}

#[test]
fn solids_are_prisms_around_the_members() {
    let text = text(Target::Obj);
    let (mut corners, mut triangles) = (vec![], vec![]);
    for line in text.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let place: Vec<f64> = words.map(|x| x.parse().unwrap()).collect();
                corners.push([place[0], place[1], place[2]]);
            }
            Some("f") => {
                let corners: Vec<usize> = words.map(|k| k.parse::<usize>().unwrap() - 1).collect();
                triangles.push([corners[0], corners[1], corners[2]]);
            }
            _ => {}
        }
    }
    assert_eq!((corners.len(), triangles.len()), (48, 88));
    // The radius is that of the first corner about the anchor A; 12 triangles of 30 degrees make an end.
    let radius_m = corners[0].iter().map(|x| x * x).sum::<f64>().sqrt();
    let wanted = 7.0 * 12.0 * 0.5 * (30.0_f64).to_radians().sin() * radius_m * radius_m;
    let found = volume6(&corners, &triangles) / 6.0;
    assert!((found - wanted).abs() < 1e-12 && radius_m > 0.01, "{found} {wanted}");
    assert!(text.contains("g member_2_tension"));
}

/// A bar of 3 kg and 2 m whose centre is 0.5 m from its lower end, with 1 kg there, and a massless one of 1 m with 2 kg below it.
#[test]
fn links_have_the_mass_and_moments_of_bars_and_joints() {
    let joints = vec![
        Joint::free("P").with_mass(1.0),
        Joint::anchor("A", [0.0, 0.0, 5.0]),
        Joint::free("Q").with_mass(2.0),
    ];
    let members = vec![
        Member::bar(0, 2, Bar::homogeneous(1.0, 0.0).unwrap()),
        Member::bar(0, 1, Bar::new(2.0, 3.0, 0.5, [0.0, 0.75, 0.75]).unwrap()),
    ];
    let write = |joints: Vec<Joint>, members: Vec<Member>| {
        let system = System::new("two", 10.0, joints, members).unwrap();
        let joints_m = [[0.0, 0.0, 3.0], [0.0, 0.0, 5.0], [0.0, 0.0, 2.0]];
        let (axial_n, reactions_n) = (vec![0.0; system.members().len()], [[0.0; 3]; 3]);
        let shape = Shape {
            system: &system,
            joints_m: &joints_m,
            axial_n: &axial_n,
            reactions_n: &reactions_n,
            used: &[],
            moving: None,
        };
        shape.text(Target::Urdf).map_err(|error| error.to_string())
    };
    let text = write(joints.clone(), members.clone()).unwrap();
    let tree = roxmltree::Document::parse(&text).unwrap();
    let link = |name: &str| {
        let is = |n: &roxmltree::Node<'_, '_>| n.attribute("name") == Some(name);
        let within = tree.descendants().find(is).unwrap();
        move |element: &str, attribute: &str| -> Vec<f64> {
            let node = within.descendants().find(|n| n.has_tag_name(element)).unwrap();
            let numbers = node.attribute(attribute).unwrap().split_whitespace();
            numbers.map(|x| x.parse().unwrap()).collect()
        }
    };
    let near = |found: Vec<f64>, told: &[f64]| {
        assert_eq!(found.len(), told.len());
        assert!(found.iter().zip(told).all(|(a, b)| (a - b).abs() < 1e-8), "{found:?} {told:?}");
    };
    // The centre is (3 × 1.5 + 1 × 2)/4 below the anchor; about it 0.75 + 3 × 0.125² + 0.375².
    near(link("m2")("mass", "value"), &[4.0]);
    near(link("m2")("origin", "xyz"), &[0.0, 0.0, -1.625]);
    near(link("m2")("inertia", "ixx"), &[0.9375]);
    near(link("m2")("inertia", "izz"), &[0.0]);
    assert!(link("m2")("inertia", "izz")[0] > 0.0);
    near(link("j2")("origin", "xyz"), &[0.0, 0.0, 5.0]);
    near(link("m1")("mass", "value"), &[2.0]);
    near(link("m1")("origin", "xyz"), &[0.0, 0.0, -1.0]);
    near(link("j1")("origin", "xyz"), &[0.0, 0.0, -2.0]);
    assert!(text.contains("<option gravity=\"0 0 -10.0\"/>"));
    assert!(text.contains("<parent link=\"m2\"/>\n<child link=\"m1\"/>"));
    let says = |joints: &[Joint], members: &[Member]| {
        write(joints.to_vec(), members.to_vec()).unwrap_err()
    };
    let loops = [&members[..], &[Member::bar(1, 2, Bar::homogeneous(3.0, 1.0).unwrap())]].concat();
    assert_eq!(says(&joints, &loops), "URDF has no loop (member 1)");
    let changed = |k: usize, joint: Joint| {
        let mut joints = joints.clone();
        joints[k] = joint;
        says(&joints, &members)
    };
    let pulled = Joint::free("Q").with_mass(2.0).with_force([1.0, 0.0, 0.0]);
    assert_eq!(changed(2, pulled), "URDF has no force at rest (joint \"Q\")");
    assert_eq!(changed(2, Joint::free("Q")), "URDF has no link without mass (member 1)");
    let uneven = Bar::new(2.0, 3.0, 0.5, [0.0, 0.75, 0.5]).unwrap();
    let uneven = [members[0].clone(), Member::bar(0, 1, uneven)];
    assert!(says(&joints, &uneven).contains("no bar whose moments across differ (member 2)"));
}

#[test]
fn what_a_format_does_not_have_is_refused() {
    let refused = |system: &System, joints_m: &[Vector], target| {
        let (axial_n, ground) = (vec![0.0; system.members().len()], vec![[0.0; 3]; joints_m.len()]);
        let (axial_n, reactions_n) = (&*axial_n, &*ground);
        let shape = Shape { system, joints_m, axial_n, reactions_n, used: &[], moving: None };
        shape.text(target).unwrap_err()
    };
    let (system, joints_m) = lamp();
    let error = refused(&system, &joints_m[..2], Target::Vtu);
    assert_eq!(error, ExportError::Sizes { joints: 2, members: 2 });
    let build = |member: Member| {
        let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(1.0)];
        System::new("p", 10.0, joints, vec![member]).unwrap()
    };
    let rigid = build(Member::cable(0, 1, Bar::homogeneous(1.0, 0.0).unwrap()));
    let bar = build(Member::bar(0, 1, Bar::homogeneous(1.0, 0.0).unwrap()).with_stiffness(9.0));
    let hung = [[0.0; 3], [0.0, 0.0, -1.0]];
    let says = |system, target| refused(system, &hung, target).to_string();
    assert_eq!(
        says(&rigid, Target::MoorDyn),
        "MoorDyn has no line that does not stretch (member 1)"
    );
    assert_eq!(says(&bar, Target::MoorDyn), "MoorDyn has no line that can push (member 1)");
    let rope = Member::cable(0, 1, Bar::homogeneous(1.0, 0.0).unwrap()).with_stiffness(9.0);
    let buoy = Joint::free("P").with_mass(1.0).with_force([0.0, 0.0, 11.0]);
    let lifted = System::new("p", 10.0, vec![Joint::anchor("A", [0.0; 3]), buoy], vec![rope]);
    assert_eq!(
        refused(&lifted.unwrap(), &[[0.0; 3], [0.0, 0.0, 1.1]], Target::MoorDyn).to_string(),
        "MoorDyn has no point that is lifted in air (joint \"P\")"
    );
    // 4 kg, 3 of them a force, on 4e8 N/m swing at 1e4 rad/s.
    let stiff = Member::cable(0, 1, Bar::homogeneous(1.0, 0.0).unwrap()).with_stiffness(4e8);
    let pulled = Joint::free("P").with_mass(1.0).with_force([0.0, 0.0, -30.0]);
    let fast =
        System::new("p", 10.0, vec![Joint::anchor("A", [0.0; 3]), pulled], vec![stiff]).unwrap();
    let shape = Shape {
        system: &fast,
        joints_m: &hung,
        axial_n: &[40.0],
        reactions_n: &[[0.0, 0.0, 40.0], [0.0; 3]],
        used: &[None],
        moving: None,
    };
    let fast = shape.text(Target::MoorDyn).unwrap();
    let step = fast.lines().find_map(|line| line.strip_suffix("  dtM")?.parse::<f64>().ok());
    assert!((step.unwrap() - 1e-5).abs() < 1e-19, "{fast}");
    assert!(text(Target::MoorDyn).contains("\n0.001  dtM\n"));
    assert_eq!(says(&rigid, Target::Urdf), "URDF has no link that goes slack (member 1)");
    assert_eq!(says(&bar, Target::Urdf), "URDF has no link that stretches (member 1)");
    let held = |support: Support| {
        let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").held_by(support)];
        let body = Bar::homogeneous(1.0, 2.0).unwrap();
        let system = System::new("p", 10.0, joints, vec![Member::bar(0, 1, body)]).unwrap();
        refused(&system, &hung, Target::Compas).to_string()
    };
    let (at_m, along) = (hung[1], [1.0, 0.0, 0.0]);
    for support in
        [Support::Line { at_m, direction: along }, Support::Plane { at_m, normal: [0.0, 1.0, 0.0] }]
    {
        assert_eq!(held(support), "a COMPAS graph has no support that slides (joint \"P\")");
    }
    let error = refused(&rigid, &[[0.0; 3]; 2], Target::Compas).to_string();
    assert_eq!(error, "a COMPAS graph has no edge without length (member 1)");
}
