//! Structures to scale, of two members and of a million.

use figures::{Joint, Member, Seen, Structure, StructureError, Support};

/// A tripod: three legs pushed down by a load on top.
fn tripod() -> (Vec<Joint<'static>>, Vec<Member>) {
    let foot = |name, x: f64, y: f64| Joint {
        support: Some(Support::Fixed),
        reaction_n: [-x, -y, 3.0],
        ..Joint::free(name, [x, y, 0.0])
    };
    let root = 0.75_f64.sqrt();
    let joints = vec![
        foot("A <1>", 1.0, 0.0),
        foot("B", -0.5, root),
        foot("C", -0.5, -root),
        Joint { load_n: [0.0, 0.0, -9.0], ..Joint::free("top", [0.0, 0.0, 3.0]) },
    ];
    let leg =
        |foot| Member { joints: [foot, 3], axial_n: Some(-10.0_f64.sqrt()), ..Member::default() };
    (joints, (0..3).map(leg).collect())
}

/// A chain of many short bars between two anchors: a parabola, all in tension, or all in
/// compression.
fn chain(bars: usize, sign: f64) -> (Vec<Joint<'static>>, Vec<Member>) {
    let joints = (0..=bars).map(|k| {
        let x = 2.0 * k as f64 / bars as f64 - 1.0;
        let support = (k == 0 || k == bars).then_some(Support::Fixed);
        Joint { support, ..Joint::free("", [x, 0.0, x * x]) }
    });
    let member = |k| Member {
        joints: [k, k + 1],
        axial_n: Some(sign * (1.0 + k as f64)),
        ..Member::default()
    };
    (joints.collect(), (0..bars).map(member).collect())
}

fn draw(joints: &[Joint<'_>], members: &[Member]) -> String {
    Structure { title: "a & b", note: "note", joints, members, floor_m: None, seen: Seen::Best }
        .svg()
        .unwrap()
}

/// The lines of a path in a drawing, by its class.
fn lines(svg: &str, class: &str) -> Vec<[[f64; 2]; 2]> {
    let paths = svg.lines().filter(|line| line.starts_with(&format!("<path class=\"{class}\"")));
    let mut found = vec![];
    for path in paths {
        let data = path.split(" d=\"").nth(1).unwrap().split('"').next().unwrap();
        for line in data.split('M').skip(1) {
            let ends: Vec<[f64; 2]> = line
                .split('L')
                .map(|point| {
                    let mut parts = point.split(' ').map(|x| x.parse().unwrap());
                    [parts.next().unwrap(), parts.next().unwrap()]
                })
                .collect();
            found.push([ends[0], ends[1]]);
        }
    }
    found
}

#[test]
fn a_planar_structure_is_to_scale_with_all_its_marks() {
    let joints = [
        Joint {
            support: Some(Support::Fixed),
            reaction_n: [0.0, -3.0, 4.0],
            ..Joint::free("A", [5.0, 0.0, 1.0])
        },
        Joint { load_n: [0.0, 0.0, -8.0], ..Joint::free("P", [5.0, 3.0, -3.0]) },
        Joint {
            support: Some(Support::Line([0.0, 1.0, 0.0])),
            reaction_n: [0.0, 0.0, 4.0],
            ..Joint::free("B", [5.0, 6.0, 1.0])
        },
    ];
    let members = [([0, 1], 5.0), ([1, 2], 5.0), ([0, 2], -3.0)].map(|(joints, axial_n)| Member {
        joints,
        axial_n: Some(axial_n),
        ..Member::default()
    });
    let svg = draw(&joints, &members);
    assert!(svg.contains("a &amp; b") && svg.contains("in their plane"));
    assert!(svg.contains("largest tension 5 N, largest compression 3 N"));
    // Two members of 5 m and one of 6 m; each kind once more in the key.
    let size = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]);
    let tension = lines(&svg, "tension");
    let compression = lines(&svg, "compression");
    assert_eq!((tension.len(), compression.len()), (3, 2));
    let scale = size(tension[0]) / 5.0;
    assert!((size(tension[1]) / 5.0 - scale).abs() < 0.01);
    assert!((size(compression[0]) / 6.0 - scale).abs() < 0.01);
    // The upright plane is seen with the vertical up: P is below A and B.
    assert!(tension[0][1][1] > tension[0][0][1]);
    for wanted in [">A</text>", ">P</text>", ">B</text>", ">8 N</text>", ">5 N</text>", ">tension<"]
    {
        assert!(svg.contains(wanted), "{wanted}");
    }
    assert_eq!(svg.matches("class=\"load\"").count(), 2);
    assert_eq!(svg.matches("class=\"reaction\"").count(), 3);
    assert!(!svg.contains("NaN") && !svg.contains("inf"));
}

#[test]
fn a_spatial_structure_is_seen_from_above_with_the_axes_of_the_world() {
    let (joints, members) = tripod();
    let svg = draw(&joints, &members);
    assert!(svg.contains("in space") && svg.contains("A &lt;1&gt;"));
    assert_eq!(svg.matches("class=\"axis\"").count(), 3);
    assert_eq!(lines(&svg, "compression").len(), 4);
}

/// Each thing that the eye could tell apart is drawn once, however many there are.
#[test]
fn a_million_members_make_a_small_picture() {
    let (joints, members) = chain(1_000_000, 1.0);
    let svg = draw(&joints, &members);
    assert!(svg.len() < 300_000, "{} bytes", svg.len());
    let mut drawn = lines(&svg, "tension");
    // Without the key, one line without gaps from anchor to anchor.
    drawn.pop();
    let mut ends: Vec<_> = drawn.iter().flatten().map(|p| p.map(f64::to_bits)).collect();
    ends.sort_unstable();
    let lonely = ends.chunk_by(|a, b| a == b).filter(|equal| equal.len() == 1).count();
    assert_eq!(lonely, 2);
    // What is too short to be hollow is told apart by its lightness.
    let (joints, members) = chain(10_000, -1.0);
    let light = draw(&joints, &members);
    assert!(light.contains("#e69f00") && !light.contains("#d55e00"));
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let (mut joints, members) = tripod();
    let refused = |joints: &[Joint<'_>], members: &[Member]| {
        Structure { title: "", note: "", joints, members, floor_m: None, seen: Seen::Best }
            .svg()
            .unwrap_err()
    };
    assert_eq!(refused(&joints, &[]), StructureError::Empty);
    let error = StructureError::NoJoint { member: 0, joint: 3, joints: 2 };
    assert_eq!(refused(&joints[..2], &members), error);
    joints[1].at_m[2] = f64::NAN;
    assert_eq!(refused(&joints, &members), StructureError::NotFinite(1));
    // All in one place, and a force that is no number: drawn, without nonsense.
    let joints = [Joint { load_n: [f64::NAN; 3], ..Joint::free("", [1.0; 3]) }; 2];
    let member = Member { joints: [0, 1], axial_n: Some(f64::NAN), ..Member::default() };
    assert!(!draw(&joints, &[member]).contains("NaN"));
}

/// The force at a wide span's end reaches beyond its anchor, and its size stands beyond that.
#[test]
fn the_picture_has_room_for_the_sizes_of_forces() {
    let end = |name, x: f64| Joint {
        support: Some(Support::Fixed),
        reaction_n: [x.signum() * 123.4, 0.0, 0.1],
        ..Joint::free(name, [x, 0.0, 0.0])
    };
    let joints = [end("A", -5.0), Joint::free("P", [0.0, 0.0, -0.1]), end("B", 5.0)];
    let members =
        [[0, 1], [1, 2]].map(|joints| Member { joints, axial_n: Some(123.4), ..Member::default() });
    let svg = draw(&joints, &members);
    let number = |text: &str, key: &str| -> f64 {
        let after = text.split(&format!("{key}=\"")).nth(1).unwrap();
        after.split(['"', ',']).next().unwrap().parse().unwrap()
    };
    let heads = svg.lines().filter(|line| line.contains("class=\"reaction head\""));
    let tips: Vec<f64> = heads.map(|head| number(head, "points")).collect();
    let labels: Vec<&str> = svg.lines().filter(|line| line.ends_with(">123.4 N</text>")).collect();
    // Those of the members stand at these, those of the reactions beyond the arrows.
    let at: Vec<f64> = labels.iter().map(|label| number(label, " x")).collect();
    assert!(at.iter().any(|x| *x < tips[0]) && at.iter().any(|x| *x > tips[1]), "{at:?} {tips:?}");
}

/// Seen from the front nothing is lower or higher than it is; from the top X runs to the right and Y
/// up. An axis that is seen end on is not drawn.
#[test]
fn a_structure_is_seen_from_where_one_asks() {
    let (joints, members) = tripod();
    let draw = |seen| {
        let (joints, members) = (&joints[..], &members[..]);
        Structure { title: "", note: "", joints, members, floor_m: None, seen }.svg().unwrap()
    };
    let legs = |svg: &str| lines(svg, "compression")[..3].to_vec();
    let front = draw(Seen::Front);
    assert_eq!(front.matches("class=\"axis\"").count(), 2);
    // A member without force that is seen end on has no entry of the key.
    let idle = Member { joints: [1, 2], axial_n: Some(0.0), ..Member::default() };
    let members = [&members[..], &[idle]].concat();
    let key = |seen| {
        let (joints, members) = (&joints[..], &members[..]);
        Structure { title: "", note: "", joints, members, floor_m: None, seen }.svg().unwrap()
    };
    assert!(key(Seen::Side).contains(">no force<") && !key(Seen::Front).contains(">no force<"));
    let [a, b, c] = legs(&front)[..] else { panic!("three legs") };
    // The feet B and C stand one behind the other, as high as A.
    assert!((b[0][0] - c[0][0]).abs() < 0.02 && (a[0][1] - b[0][1]).abs() < 0.02);
    let [a, b, c] = legs(&draw(Seen::Side))[..] else { panic!("three legs") };
    // C has the least Y, and A is in the middle.
    assert!(c[0][0] < a[0][0] && a[0][0] < b[0][0] && (a[0][1] - b[0][1]).abs() < 0.02);
    let [a, b, c] = legs(&draw(Seen::Top))[..] else { panic!("three legs") };
    assert!(b[0][1] < a[0][1] && a[0][1] < c[0][1] && a[0][0] > b[0][0]);
}

/// A load that is a thirtieth of the reactions would be an arrow inside its joint: it has no entry of
/// the key, which says from which size on there are arrows.
#[test]
fn the_key_names_what_is_drawn() {
    let end = |name, x: f64| Joint {
        support: Some(Support::Fixed),
        reaction_n: [30.0 * x.signum(), 0.0, 0.5],
        ..Joint::free(name, [x, 0.0, 0.0])
    };
    let load = Joint { load_n: [0.0, 0.0, -1.0], ..Joint::free("P", [0.0, 0.0, -0.1]) };
    let joints = [end("A", -5.0), load, end("B", 5.0)];
    let members =
        [[0, 1], [1, 2]].map(|joints| Member { joints, axial_n: Some(30.0), ..Member::default() });
    let svg = draw(&joints, &members);
    assert!(!svg.contains(">load<") && svg.contains(">reaction<"));
    assert!(svg.contains("N (arrows; none below 3 N)"), "{svg}");
}

/// A frame under prestress alone asks nothing of its supports: what rounding leaves of their forces is no arrow.
#[test]
fn what_rounding_leaves_of_a_force_is_not_drawn() {
    let (mut joints, members) = tripod();
    for joint in &mut joints {
        (joint.load_n, joint.reaction_n) = ([0.0; 3], joint.reaction_n.map(|x| 1e-14 * x));
    }
    let svg = draw(&joints, &members);
    assert!(!svg.contains(">reaction<") && !svg.contains("N (arrows"), "{svg}");
}

/// No label covers another, the tip of an arrow or a support.
#[test]
fn labels_are_apart_from_each_other_and_from_arrows() {
    let ends = |k: usize| k == 0 || k == 8;
    let joints = (0..=8).map(|k| {
        let x = k as f64;
        Joint {
            support: ends(k).then_some(Support::Fixed),
            reaction_n: if ends(k) { [10.0 * (x - 4.0), 0.0, 20.0] } else { [0.0; 3] },
            load_n: if ends(k) { [0.0; 3] } else { [0.0, 0.0, -6.0] },
            ..Joint::free(
                ["l0", "l1", "l2", "l3", "l4", "l5", "l6", "l7", "l8"][k],
                [x, 0.0, 0.1 * (x - 4.0).powi(2)],
            )
        }
    });
    let members =
        (0..8).map(|k| Member { joints: [k, k + 1], axial_n: Some(40.0), ..Member::default() });
    let svg = draw(&joints.collect::<Vec<_>>(), &members.collect::<Vec<_>>());
    let number = |line: &str, key: &str| -> f64 {
        line.split(&format!(" {key}=\""))
            .nth(1)
            .unwrap()
            .split('"')
            .next()
            .unwrap()
            .parse()
            .unwrap()
    };
    let labels: Vec<[f64; 4]> = svg
        .lines()
        .filter(|line| line.starts_with("<text") && line.contains("paint-order"))
        .map(|line| {
            let text = line.split('>').nth(1).unwrap().split('<').next().unwrap();
            let width = 6.7 * text.chars().count() as f64;
            let left = number(line, "x")
                - width
                    * if line.contains("\"end\"") {
                        1.0
                    } else if line.contains("\"middle\"") {
                        0.5
                    } else {
                        0.0
                    };
            [left, number(line, "y") - 10.2, left + width, number(line, "y") + 1.8]
        })
        .collect();
    let tips: Vec<[f64; 2]> = svg
        .lines()
        .filter(|line| line.contains(" head\"") && !line.contains("\"axis"))
        .map(|line| {
            let first = line.split("points=\"").nth(1).unwrap().split(' ').next().unwrap();
            let (x, y) = first.split_once(',').unwrap();
            [x.parse().unwrap(), y.parse().unwrap()]
        })
        .collect();
    assert!(labels.len() > 15 && tips.len() > 8, "{} {}", labels.len(), tips.len());
    for (k, a) in labels.iter().enumerate() {
        for b in &labels[..k] {
            let apart = a[2] <= b[0] || b[2] <= a[0] || a[3] <= b[1] || b[3] <= a[1];
            assert!(apart, "{a:?} {b:?}");
        }
        for [x, y] in &tips {
            // Half the width of a head.
            let [x, y, w] = [*x, *y, 3.6];
            assert!(
                x + w < a[0] || x - w > a[2] || y + w < a[1] || y - w > a[3],
                "{a:?} [{x}, {y}]"
            );
        }
    }
}
