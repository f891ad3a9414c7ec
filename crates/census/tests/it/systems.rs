//! Lists of equilibria against closed forms, and against the census of chains.

use model::system::{Joint, Kind, Member, PointLoad, Support, System};
use model::{Anchors, Bar, Chain, NoCensus, Problem};
use numerics::Interval;

use census::net::{LoadedRow, SystemCensus};
use census::{Census, ProvenEquilibrium, Settings};

use crate::support::{G, light, system, taken};

/// The cases of chains without slack bars, as systems: the same list.
#[test]
fn a_chain_as_a_system_has_the_list_of_the_chain() {
    let mut compared = 0;
    for case in model::cases::all() {
        let problem = case.problem();
        if problem.chain().bars().len() > 6 {
            continue;
        }
        let Ok(alone) = Census::take(&problem, &Settings::default()) else { continue };
        if !alone.complete || !alone.families.is_empty() {
            continue;
        }
        let system = System::from(problem.chain());
        let census = taken(&system);
        assert_eq!(census.row(&system).unwrap().census.equilibria, alone.equilibria);
        assert_eq!((census.equilibria.len(), census.complete), (alone.equilibria.len(), true));
        for one in &census.equilibria {
            let same = |other: &&ProvenEquilibrium| {
                let joints = one.joints_m.iter().flatten().zip(other.joints_m.iter().flatten());
                joints.into_iter().all(|(a, b)| !a.disjoint(*b))
            };
            let other = alone.equilibria.iter().find(same).unwrap();
            assert!(!one.energy_j.disjoint(other.energy_j), "{}", case.name);
            assert_eq!(one.index_in_space, other.index_in_space());
        }
        compared += 1;
    }
    assert!(compared >= 5, "{compared}");
}

/// A row of bars with their centres off the middle, the second told from its far end: where its centre from the near
/// one is a number, it is the chain to the last bit; where that is rounded, its weight is at its joints.
#[test]
fn a_bar_told_against_its_row_is_the_same_bar() {
    let ends = [[0.0; 3], [1.3, 0.4, -0.5]];
    let bar = |length_m, centre_m| Bar::new(length_m, 2.0, centre_m, [0.0; 3]).unwrap();
    let [first, last] = [bar(1.0, 0.3), bar(0.7, 0.1)];
    for (length_m, centre_m, is_row) in [(1.5, 0.375, true), (1.1, 0.3, false)] {
        let bars = vec![first, bar(length_m, length_m - centre_m), last];
        let anchors = Anchors { start_m: ends[0], end_m: ends[1] };
        let chain = Problem::new(Chain::new("row", G, anchors, bars).unwrap()).unwrap();
        let alone = Census::take(&chain, &Settings::default()).unwrap();
        let joints = samples::joints(&[ends[0], ends[1]], &[0.0, 0.0]);
        // From the last anchor on, so that the row is walked against the order of its members too.
        let members = vec![
            Member::bar(3, 1, last),
            Member::bar(3, 2, bar(length_m, centre_m)),
            Member::bar(0, 2, first),
        ];
        let system = system(joints, members);
        let census = taken(&system);
        let row = census.row(&system).map(|row| (&row.joints, &row.census.equilibria));
        let wanted = (&vec![0, 2, 3, 1], &alone.equilibria);
        assert_eq!(row, is_row.then_some(wanted), "{length_m}");
        assert_eq!(LoadedRow::of(&system).map(|row| row.bars()), is_row.then_some(3));
        assert!(alone.complete && census.equilibria.len() == alone.equilibria.len());
        for (one, other) in census.equilibria.iter().zip(&alone.equilibria) {
            let [a, b] = [one.energy_j, other.energy_j].map(Interval::mid);
            assert!((a - b).abs() < 1e-13 * 60.0, "{a} {b}");
            assert_eq!(one.index_in_space, other.index_in_space());
        }
    }
}

/// A heavy bar hangs straight down from the last anchor, told from there with its centre where the distance from
/// its other end is rounded, and four bars without mass bridge the gap in any way: `V = m g (z_B - r)`.
#[test]
fn a_family_with_slack_bars_has_the_energy_of_its_system() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P"),
        Joint::free("Q"),
        Joint::free("R"),
        Joint::free("S"),
        Joint::anchor("B", [0.0, 0.0, 0.15]),
    ];
    let light =
        |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap());
    let heavy = Member::bar(5, 4, Bar::new(0.6, 1.0, 0.1575, [0.0; 3]).unwrap());
    let members =
        vec![light(0, 1, 0.3), light(1, 2, 0.8), light(2, 3, 0.4), light(3, 4, 1.0), heavy];
    let census = taken(&system(joints, members));
    let families: Vec<_> = census.chains().flat_map(|chain| &chain.census.families).collect();
    let wanted = [0.15 - 0.1575, 0.15 + 0.1575].map(|z_m| G * z_m);
    assert_eq!(families.len(), 2);
    for (family, wanted) in families.iter().zip(wanted) {
        assert!(
            (family.energy_j.mid() - wanted).abs() < 1e-13,
            "{} {wanted}",
            family.energy_j.mid()
        );
    }
}

/// Loads of 16 N and 9 N and the horizontal pull 12 N: slopes 4/3, 0, 3/4 of bars of 5 m. The members
/// run from both ends to the middle; a float of 3 N lifts at P, and half of the load of 9 N is a force at
/// the very end of a bar.
#[test]
fn the_loaded_string_is_in_the_list() {
    let joints = vec![
        Joint::anchor("A", [1.0, 0.0, 2.0]),
        Joint::free("P").with_mass(1.9).with_force([0.0, 0.0, 3.0]),
        Joint::free("Q").with_mass(0.45),
        Joint::anchor("B", [13.0, 0.0, 1.0]),
    ];
    let mut members: Vec<Member> =
        [(0, 1), (2, 1), (3, 2)].into_iter().map(|(a, b)| Member::bar(a, b, light(5.0))).collect();
    members[2].loads.push(PointLoad { at_m: 5.0, force_n: [0.0, 0.0, -4.5], is_spread: false });
    let string = system(joints.clone(), members.clone());
    let census = taken(&string);
    assert!(census.complete && census.families() == 0);
    let lowest = &census.equilibria[0];
    let at = [[1.0, 2.0], [4.0, -2.0], [9.0, -2.0], [13.0, 1.0]];
    for (joint, [x, z]) in lowest.joints_m.iter().zip(at) {
        assert!(
            joint[0].contains(x) && joint[1].contains(0.0) && joint[2].contains(z),
            "{joint:?}"
        );
    }
    for (axial, n) in lowest.axial_n.iter().zip([20.0, 12.0, 15.0]) {
        assert!(axial.contains(n) && axial.width() < 1e-12, "{axial:?}");
    }
    assert!(lowest.reactions_n[0][2].contains(16.0) && lowest.reactions_n[3][0].contains(12.0));
    assert_eq!((lowest.index_in_space, lowest.index_in_plane), (0, Some(0)));
    // -16 N times -4 m and -9 N times -4 m below A.
    assert!(lowest.energy_j.contains(-100.0));
    // A wind, an elastic member, and a cable are other questions.
    let mut windy = joints.clone();
    windy[1].force_n[1] = 0.5;
    let refused = SystemCensus::take(&system(windy, members.clone()), &Settings::default());
    assert_eq!(refused.unwrap_err(), NoCensus::LoadsNotDown { joint: 2 });
    members[1] = members[1].clone().with_stiffness(1e5);
    let refused = SystemCensus::take(&system(joints, members), &Settings::default());
    assert_eq!(refused.unwrap_err(), NoCensus::Elastic { member: 2 });
}

/// A tree in a level wind: every bar along the force that it carries, or against it. A cable only
/// along.
#[test]
fn trees_have_all_their_signs() {
    let joints = vec![
        Joint::anchor("A", [0.0, 0.0, 0.0]),
        Joint::free("P").with_mass(0.1),
        Joint::free("Q").with_force([3.0, 0.0, -4.0]),
        Joint::free("R").with_mass(0.2),
    ];
    let mut members = vec![
        Member::bar(0, 1, light(1.0)),
        Member::bar(2, 1, light(5.0)),
        Member::bar(1, 3, light(2.0)).with_stiffness(4.0),
    ];
    let tree = system(joints.clone(), members.clone());
    let census = taken(&tree);
    assert_eq!((census.equilibria.len(), census.complete), (8, true));
    let by_index =
        |index: usize| census.equilibria.iter().filter(|e| e.index_in_space == index).count();
    // The configuration space is a product of spheres: Poincaré polynomial (1 + t²)³.
    assert_eq!([0, 2, 4, 6].map(by_index), [1, 3, 3, 1]);
    let lowest = &census.equilibria[0];
    // 5 N along (3, 0, -4)/5, and a spring of 2 m and 4 N that 2 N stretch to 3 m.
    let between = |a: usize, b: usize, k: usize| lowest.joints_m[b][k] - lowest.joints_m[a][k];
    assert!(between(1, 2, 0).contains(3.0) && between(1, 2, 2).contains(-4.0));
    assert!(between(1, 3, 2).contains(-3.0) && lowest.axial_n[1].contains(5.0));
    // All of 3 N aside and 7 N down hangs on the first.
    assert!(lowest.axial_n[0].square().contains(58.0));
    assert!(lowest.reactions_n[0][0].contains(-3.0) && lowest.reactions_n[0][2].contains(7.0));
    members[1].kind = Kind::Cable;
    assert_eq!(taken(&system(joints.clone(), members.clone())).equilibria.len(), 4);
    // A bar that bears nothing points anywhere.
    members.push(Member::bar(3, 4, light(1.0)));
    let mut limp = joints;
    limp.push(Joint::free("S"));
    let refused = SystemCensus::take(&system(limp, members), &Settings::default());
    assert_eq!(refused.unwrap_err(), NoCensus::Limp { member: 4 });
}

/// A column of 1 m under 2 N is pressed to a quarter where it bears 8/3 N for all of its length, is
/// nothing where it bears 2 N, and has no place where it bears less.
#[test]
fn columns_are_pressed_together() {
    let column = |stiffness_n: f64| {
        let joints = vec![Joint::anchor("A", [0.0; 3]), Joint::free("P").with_mass(0.2)];
        let members = vec![Member::bar(0, 1, light(1.0)).with_stiffness(stiffness_n)];
        SystemCensus::take(&system(joints, members), &Settings::default())
    };
    let both = column(8.0 / 3.0).unwrap().equilibria;
    let heights: Vec<Interval> = both.iter().map(|one| one.joints_m[1][2]).collect();
    assert!(heights.len() == 2 && heights[0].contains(-1.75) && heights[1].contains(0.25));
    assert_eq!(column(2.0).unwrap_err(), NoCensus::Limp { member: 1 });
    assert_eq!(column(1.5).unwrap().equilibria.len(), 1);
}

/// Two hangers over the same anchors, one of them with a pendulum at its lamp: 2 times 2 times 2.
#[test]
fn parts_are_combined_and_trees_hang_on_chains() {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[0.0, 0.2, 0.2]);
    let members = vec![
        Member::bar(0, 2, light(5.0)),
        Member::bar(1, 2, light(5.0)),
        Member::bar(3, 0, light(5.0)),
        Member::bar(1, 3, light(5.0)),
        Member::bar(2, 4, light(1.0)),
    ];
    let both = system(joints, members);
    let census = taken(&both);
    assert!(census.complete);
    assert_eq!(census.parts.iter().map(|part| part.positions).collect::<Vec<_>>(), [4, 2]);
    assert_eq!(census.equilibria.len(), 8);
    let lowest = &census.equilibria[0];
    assert!(lowest.joints_m[4][2].contains(-5.0) && lowest.joints_m[3][2].contains(-4.0));
    for axial in &lowest.axial_n[..4] {
        assert!(axial.contains(1.25));
    }
    assert_eq!((lowest.index_in_space, lowest.index_in_plane), (0, None));
    // Above and inverted: each hanger falls aside, the pendulum in two directions.
    assert_eq!(census.equilibria[7].index_in_space, 4);
}

/// Two weights of 1 N, on cables of 2 m from level anchors 3 m apart, and between them a cable of 4
/// m: taut, or each hangs plumb and what is between is slack. A bar between them never is; as long
/// as the anchors are apart a cable is both.
#[test]
fn cables_are_taut_or_slack() {
    let hung = |kind: Kind, length_m: f64| {
        let joints = vec![
            Joint::anchor("A", [0.0, 0.0, 0.0]),
            Joint::free("P").with_mass(0.1),
            Joint::free("Q").with_mass(0.1),
            Joint::anchor("B", [3.0, 0.0, 0.0]),
        ];
        let members = vec![
            Member::cable(0, 1, light(2.0)),
            Member::bar(1, 2, light(length_m)).of_kind(kind),
            Member::cable(2, 3, light(2.0)),
        ];
        system(joints, members)
    };
    let cables = taken(&hung(Kind::Cable, 4.0));
    assert_eq!((cables.equilibria.len(), cables.complete), (1, true));
    let only = &cables.equilibria[0];
    assert!(only.joints_m[1][2].contains(-2.0) && only.joints_m[2][0].contains(3.0));
    assert!(only.axial_n[0].contains(1.0) && only.axial_n[1] == Interval::ZERO);
    assert_eq!(only.index_in_space, 0);
    // A shorter one is pulled level: 2 m across the middle of 3 m.
    let taut = taken(&hung(Kind::Cable, 2.0));
    assert_eq!(taut.equilibria.len(), 1);
    assert!(taut.equilibria[0].axial_n[1].lo() > 0.0);
    assert!(taut.equilibria[0].joints_m[1][0].contains(0.5));
    // A bar of 4 m spreads them: 1/2 m outward on either side, in compression.
    let spread = taken(&hung(Kind::Bar, 4.0));
    let lowest = &spread.equilibria[0];
    assert!(lowest.joints_m[1][0].contains(-0.5) && lowest.axial_n[1].hi() < 0.0);
    let even = SystemCensus::take(&hung(Kind::Cable, 3.0), &Settings::default());
    assert_eq!(even.unwrap_err(), NoCensus::Limp { member: 2 });
}

/// A tripod with a lamp on a bar below it: 2 times 2 positions, none of the four movable but by its
/// lamp.
#[test]
fn a_tripod_has_its_two_places() {
    let corners = [[3.0, 0.0, 0.0], [-3.0, 0.0, 0.0], [0.0, 3.0, 0.0]];
    let mut joints: Vec<Joint> =
        corners.iter().enumerate().map(|(k, at)| Joint::anchor(k.to_string(), *at)).collect();
    joints.push(Joint::free("P"));
    joints.push(Joint::free("lamp").with_mass(1.6));
    let mut members: Vec<Member> = (0..3).map(|k| Member::bar(k, 3, light(5.0))).collect();
    members.push(Member::bar(4, 3, light(1.0)));
    let census = taken(&system(joints.clone(), members.clone()));
    assert_eq!((census.equilibria.len(), census.complete), (4, true));
    // It stands in no plane, and so does what hangs on it.
    assert_eq!((census.parts.len(), census.parts[0].framed), (1, 1));
    assert!(census.equilibria.iter().all(|one| one.index_in_plane.is_none()));
    let lowest = &census.equilibria[0];
    assert!(lowest.joints_m[3][2].contains(-4.0) && lowest.joints_m[4][2].contains(-5.0));
    // The third bar is not needed: twice 10 N times 4/5.
    for (axial, n) in lowest.axial_n.iter().zip([10.0, 10.0, 0.0, 16.0]) {
        assert!(axial.contains(n) && axial.width() < 1e-11, "{axial:?}");
    }
    assert_eq!(
        census.equilibria.iter().map(|e| e.index_in_space).collect::<Vec<_>>(),
        [0, 2, 0, 2]
    );
    // A hanger between the top and an anchor swings: below it hangs, above it stands, by the closed
    // form for a chain.
    joints.truncate(4);
    members.truncate(3);
    joints.push(Joint::anchor("C", [0.0, 8.0, -4.0]));
    joints.push(Joint::free("Q").with_mass(0.2));
    members.push(Member::bar(3, 5, light(5.0)));
    members.push(Member::bar(4, 5, light(5.0)));
    let swing = taken(&system(joints, members));
    // With the top 4 m above, C is out of reach.
    assert_eq!((swing.equilibria.len(), swing.complete), (2, true));
    let lowest = &swing.equilibria[0];
    // Between the top 4 m below and C, 8 m apart and level: 3, 4, 5 again.
    assert!(lowest.joints_m[5][1].contains(4.0) && lowest.joints_m[5][2].contains(-7.0));
    assert!((lowest.axial_n[3].mid() - 5.0 / 3.0).abs() < 1e-12);
    assert_eq!((lowest.index_in_space, swing.equilibria[1].index_in_space), (0, 1));
}

/// A lamp on two bars between anchors, and a bar that hangs on it: three signs.
fn hanging_lamp() -> System {
    let joints = samples::joints(&[[-3.0, 0.0, 0.0], [3.0, 0.0, 0.0]], &[0.2, 0.1]);
    let members = vec![
        Member::bar(0, 2, light(5.0)),
        Member::bar(2, 1, light(5.0)),
        Member::bar(2, 3, light(1.0)),
    ];
    system(joints, members)
}

/// Half a metre of the 11 m of all bars, and 1 N of the largest force of 4 N.
#[test]
fn widths_are_parts_of_the_length_and_of_the_largest_force() {
    let system = hanging_lamp();
    let census = taken(&system);
    let width = |width_m: f64, width_n: f64| {
        let mut position = census.equilibria[0].clone();
        position.joints_m[3] = [0.0, 1.0, 2.0].map(Interval::point);
        position.joints_m[3][1] = Interval::new(1.0, 1.0 + width_m);
        position.axial_n = [-4.0, 1.0, 2.0].map(Interval::point).to_vec();
        position.axial_n[1] = Interval::new(1.0, 1.0 + width_n);
        position.joints_m[..3].copy_from_slice(&[
            [Interval::ZERO; 3],
            [Interval::ONE; 3],
            [Interval::point(2.0); 3],
        ]);
        let mut alone = census.clone();
        alone.equilibria = vec![position];
        let answers = alone.to_model(&system);
        answers[0].evidence.ladder.verified.proof().unwrap().box_width
    };
    assert!((width(0.5, 0.0) - 0.5 / 11.0).abs() < 1e-14);
    assert!((width(0.0, 1.0) - 0.25).abs() < 1e-14);
}

#[test]
fn the_signs_of_all_bars_are_gone_through() {
    let system = hanging_lamp();
    let census = taken(&system);
    let complete = census.completeness(&system);
    let proof = complete.proof().unwrap();
    assert_eq!((proof.patterns, proof.in_plane), (8, census.equilibria.len()));
}

/// Bars of 1 m and 1.5 m hang from anchors 1 m apart or stand on them, and a cable of 3 m is slack
/// between their ends, which are 2.7 m apart at most.
#[test]
fn a_slack_cable_leaves_all_signs_of_the_others() {
    let joints = vec![
        Joint::anchor("A", [0.0; 3]),
        Joint::free("P").with_mass(1.0),
        Joint::free("Q").with_mass(1.0),
        Joint::anchor("B", [1.0, 0.0, 0.0]),
    ];
    let members = vec![
        Member::bar(0, 1, light(1.0)),
        Member::cable(1, 2, light(3.0)),
        Member::bar(2, 3, light(1.5)),
    ];
    let system = system(joints, members);
    let census = SystemCensus::take(&system, &Settings::default()).unwrap();
    let slack = census.equilibria.iter().filter(|one| one.axial_n[1] == Interval::ZERO);
    let mut heights: Vec<[f64; 2]> =
        slack.map(|one| [1, 2].map(|k| one.joints_m[k][2].mid())).collect();
    heights.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    assert_eq!(heights.len(), 4, "{heights:?}");
    let wanted = [[-1.0, -1.5], [-1.0, 1.5], [1.0, -1.5], [1.0, 1.5]];
    for (found, wanted) in heights.iter().flatten().zip(wanted.iter().flatten()) {
        assert!((found - wanted).abs() < 1e-12, "{heights:?}");
    }
}

/// A boom of √17 m over a foot, held by a cable of √20 m from 3 m above it, with 30 N at its tip: to either side of the mast,
/// 4 m out and 1 m up, where the triangle of forces is that of lengths, and upright with a slack cable. A chain with a
/// pendulum in a plane has the list that it has in space, and falls only within the plane.
#[test]
fn chains_and_trees_in_a_plane_have_their_lists() {
    let sliding = |axis: usize, joint: Joint| {
        let mut normal = [0.0; 3];
        normal[axis] = 1.0;
        joint.held_by(Support::Plane { at_m: [0.5, 0.5, 0.0], normal })
    };
    let place = |axis: usize, out: f64, up: f64| {
        let mut at = [0.5, 0.5, up];
        at[1 - axis] += out;
        at
    };
    for axis in [0, 1] {
        let tip = sliding(axis, Joint::free("T").with_mass(3.0));
        let joints = vec![
            Joint::anchor("foot", place(axis, 0.0, 0.0)),
            Joint::anchor("mast", place(axis, 0.0, 3.0)),
            tip,
        ];
        let [boom_m, cable_m] = [17.0_f64.sqrt(), 20.0_f64.sqrt()];
        let members = vec![Member::bar(0, 2, light(boom_m)), Member::cable(1, 2, light(cable_m))];
        let found = taken(&system(joints, members));
        assert!(found.complete);
        let forces = [-10.0 * boom_m, 10.0 * cable_m];
        let told = [(4.0, 1.0, forces, 0), (-4.0, 1.0, forces, 0), (0.0, boom_m, [-30.0, 0.0], 1)];
        for (out, up, axial_n, index) in told {
            let place_m = place(axis, out, up);
            let there = found.equilibria.iter().filter(|e| {
                let near = |(x, told): (&Interval, &f64)| (x.mid() - told).abs() < 1e-12;
                e.joints_m[2].iter().zip(&place_m).all(near)
                    && e.axial_n.iter().zip(&axial_n).all(near)
                    && e.index_in_space == index
                    && !e.circle
            });
            assert_eq!(there.count(), 1, "{axis} {out}: {:?}", found.equilibria);
        }
        assert_eq!(found.equilibria.len(), 3);
        let of = |sliding: &dyn Fn(Joint) -> Joint| {
            let mut joints = samples::joints(&[place(axis, 0.0, 0.0), place(axis, 2.0, 0.3)], &[]);
            let free = [("P", 1.0), ("Q", 2.0), ("L", 1.0)];
            joints.extend(free.map(|(name, kg)| sliding(Joint::free(name).with_mass(kg))));
            let members = [(0, 2, 1.0), (2, 3, 1.0), (3, 1, 1.0), (2, 4, 0.5)];
            let members = members.map(|(a, b, length_m)| Member::bar(a, b, light(length_m)));
            system(joints, members.to_vec())
        };
        let [plane, space] =
            [of(&|joint| sliding(axis, joint)), of(&|joint| joint)].map(|s| taken(&s));
        let index = |census: &SystemCensus| -> Vec<usize> {
            census.equilibria.iter().map(|e| e.index_in_space).collect()
        };
        assert_eq!((index(&plane), index(&space)), (vec![0, 1, 1, 2], vec![0, 2, 3, 5]));
        let places = |census: &SystemCensus| -> Vec<_> {
            census.equilibria.iter().map(|e| e.joints_m.clone()).collect()
        };
        assert_eq!(places(&plane), places(&space));
    }
    // What is triangulated in a plane has none.
    let joints = vec![
        Joint::anchor("A", [0.5; 3]),
        Joint::anchor("B", [2.5, 0.5, 0.5]),
        sliding(1, Joint::free("P").with_mass(1.0)),
        sliding(1, Joint::free("Q").with_mass(1.0)),
    ];
    let ends = [(0, 2), (0, 3), (2, 3), (1, 3)];
    let members = ends.map(|(a, b)| Member::bar(a, b, light(1.5))).to_vec();
    let refused = SystemCensus::take(&system(joints, members), &Settings::default());
    assert_eq!(refused.unwrap_err(), NoCensus::Slider { joint: 3 });
}
