//! Cables that are just taut, with their length and no force, as in a drawing without prestress: they resist on one side alone.

use model::system::{Joint, Kind, Member, Support, System, SystemEquilibrium};
use model::{Bar, ForceChoice, STANDARD_GRAVITY_M_S2 as G};
use numerics::vector::{minus, norm};
use validate::Solvers;
use validate::systems::ask;

use crate::drawn::{close, neighbour, written};

/// A post of 4 m under 20 kg with guys to feet around it.
fn post(azimuths: &[f64], radius_m: f64, stiffness_n: Option<f64>) -> System {
    let mut joints = vec![
        Joint::anchor("foot", [0.0; 3]),
        Joint::free("top").with_mass(20.0).near([0.0, 0.0, 4.0]),
    ];
    let bar = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let mut members = vec![Member::bar(0, 1, bar(4.0))];
    for (k, azimuth) in azimuths.iter().enumerate() {
        let (sin, cos) = azimuth.to_radians().sin_cos();
        joints.push(Joint::anchor(format!("G{k}"), [radius_m * cos, radius_m * sin, 0.0]));
        let guy = Member::bar(2 + k, 1, bar(radius_m.hypot(4.0))).of_kind(Kind::Cable);
        members.push(guy.with_stiffness(stiffness_n));
    }
    System::new("post", G, joints, members).unwrap()
}

/// Posts with guys that are just taut: a lean by x costs EA/l cos² x²/2 of each guy that it stretches, 7200 N/m and more against
/// the 60 N/m by which the post falls, and nothing of the others. Where all guys are on one side nothing holds it.
#[test]
fn posts_stand_where_they_have_guys_on_all_sides() {
    for stiffness_n in [None, Some(1e5), Some(1e6)] {
        for azimuths in
            [&[0.0, 120.0, 240.0][..], &[0.0, 90.0, 180.0, 270.0], &[0.0, 100.0, 130.0, 250.0]]
        {
            let answer = neighbour(&post(azimuths, 3.0, stiffness_n));
            close(&answer.equilibria[0].joints_m[1], &[0.0, 0.0, 4.0], 1e-9);
        }
        for azimuths in [
            &[0.0, 45.0][..],
            &[0.0, 90.0, 170.0],
            &[0.0, 15.0, 45.0, 75.0],
            &[0.0, 1.0, 3.0, 165.0],
        ] {
            let answer = ask(&post(azimuths, 3.0, stiffness_n), Solvers::Both, &|_| {});
            let stands = |e: &SystemEquilibrium| (e.joints_m[1][2] - 4.0).abs() < 1e-6;
            let stable = |e: &&SystemEquilibrium| stands(e) && e.stability.index_in_space == 0;
            assert_eq!(answer.equilibria.iter().find(stable), None, "{azimuths:?} {stiffness_n:?}");
        }
    }
}

/// Under a wind from any side a post with three guys stands, on the two of them that hold it: with rigid guys where it was, by
/// the balance of three forces in the plane, and with elastic ones at most 600 N beside, over half of EA/l cos²: 5.6 mm. Upside
/// down its energy would be less.
#[test]
fn posts_stand_in_a_wind_from_any_side() {
    for (stiffness_n, close_m) in [(None, 1e-9), (Some(3e6), 6e-3)] {
        for degrees in (0..360).step_by(20) {
            let (sin, cos) = f64::from(degrees).to_radians().sin_cos();
            let mut system = post(&[0.0, 120.0, 240.0], 3.0, stiffness_n);
            let mut joints = system.joints().to_vec();
            joints[1] = joints[1].clone().with_force([600.0 * cos, 600.0 * sin, 0.0]);
            let members = system.members().to_vec();
            system = System::new("post in a wind", G, joints, members).unwrap();
            for e in neighbour(&system).equilibria {
                close(&e.joints_m[1], &[0.0, 0.0, 4.0], close_m);
                let pulls = e.axial_n[1..].iter().zip([0.0, 120.0, 240.0_f64]);
                let pulled = pulls.map(|(n, azimuth)| 0.6 * n * azimuth.to_radians().cos());
                assert!((pulled.sum::<f64>() + 600.0 * cos).abs() < 2.0 * close_m * 600.0 + 1e-6);
                assert!(e.axial_n[1..].iter().any(|n| n.abs() < 1e-6), "{:?}", e.axial_n);
            }
        }
    }
}

/// In the plane one inextensible guy leaves a post no motion that keeps all lengths, and it falls to the other side.
#[test]
fn a_post_with_one_guy_falls() {
    let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
    let joints = vec![
        Joint::anchor("foot", [0.0; 3]),
        Joint::anchor("G", [-3.0, 0.0, 0.0]),
        Joint::free("top").held_by(plane).with_mass(20.0).near([0.0, 0.0, 4.0]),
    ];
    let bar = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
    let members =
        vec![Member::bar(0, 2, bar(4.0)), Member::bar(1, 2, bar(5.0)).of_kind(Kind::Cable)];
    let answer = ask(&System::new("post", G, joints, members).unwrap(), Solvers::Both, &|_| {});
    assert!(answer.equilibria.iter().all(|e| e.stability.index_in_space > 0));
}

/// A bay with two diagonal cables sways to neither side, rigid or elastic, with its feet held or on one rail, where it slides:
/// the energy is that of a bay whose posts bear 490 N each, shorter by 490 N · 2 m / EA.
#[test]
fn bays_with_two_diagonals_stand_on_a_rail_too() {
    for (stiffness_n, rails) in
        [(None, 0), (None, 1), (Some(1e6), 0), (Some(1e6), 1), (Some(1e6), 2)]
    {
        let foot = |name: &str, x: f64, rolls: bool| {
            let foot = Joint::anchor(name, [x, 0.0, 0.0]);
            let rail = Support::Line { at_m: [x, 0.0, 0.0], direction: [1.0, 0.0, 0.0] };
            if rolls { foot.held_by(rail) } else { foot }
        };
        let top = |name: &str, x: f64| {
            let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
            Joint::free(name).held_by(plane).with_mass(50.0).near([x, 0.0, 2.0])
        };
        let joints = vec![
            foot("A", 0.0, rails > 1),
            foot("B", 2.0, rails > 0),
            top("C", 2.0),
            top("D", 0.0),
        ];
        let member = |from, to, kind| {
            let length_m = if kind == Kind::Cable { 8.0_f64.sqrt() } else { 2.0 };
            let body = Bar::homogeneous(length_m, 0.0).unwrap();
            Member::bar(from, to, body).of_kind(kind).with_stiffness(stiffness_n)
        };
        let bars = [(0, 1), (1, 2), (2, 3), (3, 0)].map(|(a, b)| member(a, b, Kind::Bar));
        let cables = [(0, 2), (1, 3)].map(|(a, b)| member(a, b, Kind::Cable));
        let members = bars.into_iter().chain(cables).collect();
        let answer = neighbour(&System::new("bay", G, joints, members).unwrap());
        let sags_m = answer.equilibria[0].joints_m[2..].iter().map(|at| 2.0 - at[2]);
        let wanted_m = stiffness_n.map_or(0.0, |ea| 50.0 * G * 2.0 / ea);
        assert!(sags_m.into_iter().all(|sag_m| (sag_m - wanted_m).abs() < 1e-5));
        assert_eq!(answer.agreement.unwrap().sliding_parts, usize::from(rails == 2));
    }
}

/// Five guys without tension, two of them side by side: what balances without them is the post alone.
#[test]
fn guys_that_bear_nothing_are_at_zero() {
    for e in neighbour(&post(&[105.0, 345.0, 255.0, 60.0, 345.0], 2.0, None)).equilibria {
        let [post, guys @ ..] = e.axial_n.as_slice() else { panic!() };
        assert!((post + 20.0 * G).abs() < 1e-9, "{post}");
        assert!(guys.iter().all(|n| (0.0..1e-8).contains(n)), "{guys:?}");
    }
}

/// Four cables hold a leaning post, a fifth a strut beside it. Equally stiff they bear `u v / l` each, with their directions `u`
/// and one displacement `v` of the top: by least squares with signs (SciPy) 27.1302, 20.1352, 21.3698 and 24.9297 N.
#[test]
fn cables_share_a_pull_as_equally_stiff_ones() {
    let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
    let top = |name: &str, at: [f64; 2], force: [f64; 2]| {
        let free = Joint::free(name).held_by(plane).near([at[0], 0.0, at[1]]);
        free.with_force([force[0], 0.0, force[1]])
    };
    let feet =
        [[0.0, 0.0], [2.8, 0.3], [1.2, 0.0], [1.5, -0.1], [2.4, 0.0], [2.8, 0.0], [6.1, 0.0]];
    let (t, u) = ([0.6, 2.7], [2.8, 2.7]);
    let mut joints: Vec<Joint> =
        feet.iter().map(|[x, z]| Joint::anchor(format!("{x} {z}"), [*x, 0.0, *z])).collect();
    joints.extend([top("T", t, [-72.3, -73.3]), top("U", u, [-5.0, -338.3])]);
    let member = |from: usize, to: usize, kind| {
        let at = |joint: usize| feet.get(joint).copied().unwrap_or(if joint == 7 { t } else { u });
        let ([x, z], [to_x, to_z]) = (at(from), at(to));
        let body = Bar::homogeneous((to_x - x).hypot(to_z - z), 0.0).unwrap();
        Member::bar(from, to, body).of_kind(kind)
    };
    let post = member(0, 7, Kind::Bar).with_stiffness(2000.0).with_prestress(-157.8).unwrap();
    let mut members = vec![post];
    members.extend((1..5).map(|foot| member(foot, 7, Kind::Cable)));
    members.extend([member(5, 8, Kind::Bar), member(7, 8, Kind::Bar), member(6, 8, Kind::Cable)]);
    for e in neighbour(&System::new("tent", G, joints, members).unwrap()).equilibria {
        let wanted_n = [-157.8, 27.1302, 20.1352, 21.3698, 24.9297, -338.3, -5.0, 0.0];
        close(&e.axial_n, &wanted_n, 5e-5);
    }
}

/// A corner of a tower with storeys of 2 m, whose squares become smaller from one of 2 m radius.
fn corner(level: usize, k: usize, levels: usize, top_m: f64) -> [f64; 3] {
    let radius = 2.0 - (2.0 - top_m) * level as f64 / levels as f64;
    let (sin, cos) = (std::f64::consts::FRAC_PI_4 * (2 * k + 1) as f64).sin_cos();
    [radius * cos, radius * sin, 2.0 * level as f64]
}

/// A tower of 20 kg at each corner, with crossed cables on four sides; elastic with two bars across each level, or rigid with one.
fn tower(levels: usize, top_m: f64, wind_n: [f64; 3], is_rigid: bool) -> System {
    let place = |level: usize, k: usize| corner(level, k, levels, top_m);
    let mut joints = Vec::new();
    for (level, k) in (0..=levels).flat_map(|level| (0..4).map(move |k| (level, k))) {
        let (name, at_m) = (format!("{level} {k}"), place(level, k));
        joints.push(match level {
            0 => Joint::anchor(name, at_m),
            _ => Joint::free(name).with_mass(20.0).with_force(wind_n).near(at_m),
        });
    }
    let mut members = Vec::new();
    let mut member = |[a, b]: [(usize, usize); 2], kind, stiffness_n| {
        let [x, y] = [a, b].map(|(level, k)| place(level, k % 4));
        let body = Bar::homogeneous(norm(minus(x, y)), 0.0).unwrap();
        let [a, b] = [a, b].map(|(level, k)| 4 * level + k % 4);
        let member = Member::bar(a, b, body).of_kind(kind);
        members.push(member.with_stiffness((!is_rigid).then_some(stiffness_n)));
    };
    for level in 0..levels {
        for k in 0..4 {
            member([(level, k), (level + 1, k)], Kind::Bar, 2e8);
            member([(level + 1, k), (level + 1, k + 1)], Kind::Bar, 1e8);
            member([(level, k), (level + 1, k + 1)], Kind::Cable, 1e7);
            member([(level, k + 1), (level + 1, k)], Kind::Cable, 1e7);
        }
        for k in 0..if is_rigid { 1 } else { 2 } {
            member([(level + 1, k), (level + 1, k + 2)], Kind::Bar, 1e7);
        }
    }
    System::new("tower", G, joints, members).unwrap()
}

/// In a wind along a diagonal two faces bear no shear, and their cables are slack until one has turned the face a little. By symmetry
/// nothing leaves the plane of the wind by more.
#[test]
fn a_tower_stands_in_a_wind_along_its_diagonal() {
    for e in neighbour(&tower(5, 0.6, [200.0, 0.0, 0.0], false)).equilibria {
        assert_eq!(e.stability.index_in_space, 0);
        // The moment about the feet: 200 N of four joints at each level; two legs bear half of it, and each a quarter of the weight.
        let moment_n_m = 800.0 * 2.0 * 15.0;
        let wanted_n = (moment_n_m / corner(0, 0, 5, 0.6)[0] + 5.0 * 80.0 * G) / 4.0;
        let borne_n = e.reactions_n[0][2];
        assert!((borne_n / wanted_n - 1.0).abs() < 2e-3, "{borne_n} {wanted_n}");
    }
}

/// A rigid tower stays as it is drawn in a wind from anywhere. Its columns become shorter, if by nothing, and all cables would be
/// slack but for the wind: which of them bear it is the least `sum N² l` with no cable that pushes, alike by both.
#[test]
fn rigid_towers_stand_in_a_wind_from_any_side() {
    for (levels, top_m) in [(5, 2.0), (8, 0.6), (20, 2.0), (30, 1.0)] {
        for wind_n in [[5.0, 3.25, 0.0], [-20.0, 13.0, 0.0], [10.0, 0.0, 0.0]] {
            for e in neighbour(&tower(levels, top_m, wind_n, true)).equilibria {
                for (joint, at_m) in e.joints_m.iter().enumerate() {
                    close(at_m, &corner(joint / 4, joint % 4, levels, top_m), 1e-9);
                }
                // Counted or not, there are more lengths than joints have motions.
                assert!(e.evidence.ladder.agreed.proof().unwrap().shape_only, "{levels}");
            }
        }
    }
}

/// The same where the signs of the forces do not follow from those of their neighbours; both name the forces of equally stiff
/// members, which the judge recognises.
#[test]
fn an_irregular_rigid_tower_stands() {
    let system = written(include_str!("drawn/tower.toml"));
    for e in neighbour(&system).equilibria {
        for (at_m, wanted_m) in e.joints_m.iter().zip(system.drawing().unwrap()) {
            close(at_m, &wanted_m, 1e-9);
        }
        assert_eq!(e.evidence.self_stresses.unwrap().choice, ForceChoice::EquallyStiff);
    }
}

/// A long truss of rigid members crossed in each bay, by the moment about the middle of a bay, through which both diagonals go:
/// the forces of its chords differ by twice that over its depth.
#[test]
fn long_trusses_of_rigid_crossed_members_bear_their_moment() {
    let (bays, [w, h]) = (100, [1.7, 2.5]);
    let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
    let rail = Support::Line { at_m: [0.0; 3], direction: [1.0, 0.0, 0.0] };
    let mass_kg =
        |joint: usize| if joint.is_multiple_of(2) { 60.0 + (joint % 7) as f64 } else { 20.0 };
    for kind in [Kind::Bar, Kind::Cable] {
        let place = |joint: usize| [w * (joint / 2) as f64, 0.0, h * (joint % 2) as f64];
        let joints = (0..=2 * bays + 1).map(|joint| {
            if joint == 0 {
                return Joint::anchor("A", place(joint));
            }
            let held = if joint == 2 * bays { rail } else { plane };
            let free = Joint::free(format!("{joint}")).held_by(held);
            free.with_mass(mass_kg(joint)).near(place(joint))
        });
        let member = |a: usize, b: usize, kind| {
            let body = Bar::homogeneous(norm(minus(place(a), place(b))), 0.0).unwrap();
            Member::bar(a, b, body).of_kind(kind)
        };
        let bay = |n: usize| {
            let [l, u, next_l, next_u] = [2 * n, 2 * n + 1, 2 * n + 2, 2 * n + 3];
            let bars = [(l, next_l), (u, next_u), (next_l, next_u)];
            let bars = bars.map(|(a, b)| member(a, b, Kind::Bar));
            bars.into_iter().chain([member(l, next_u, kind), member(u, next_l, kind)])
        };
        let members = std::iter::once(member(0, 1, Kind::Bar)).chain((0..bays).flat_map(bay));
        let system = System::new("truss", G, joints.collect(), members.collect()).unwrap();
        let weights: Vec<[f64; 2]> =
            (1..=2 * bays + 1).map(|joint| [place(joint)[0], G * mass_kg(joint)]).collect();
        let span = w * bays as f64;
        let left_n: f64 = weights.iter().map(|[x, n]| n * (1.0 - x / span)).sum();
        for e in neighbour(&system).equilibria {
            for n in 0..bays {
                let x = w * (n as f64 + 0.5);
                let before = weights.iter().filter(|[at, _]| *at < x);
                let moment_n_m = left_n * x - before.map(|[at, n]| n * (x - at)).sum::<f64>();
                let apart_n = e.axial_n[5 * n + 1] - e.axial_n[5 * n + 2];
                let wanted_n = 2.0 * moment_n_m / h;
                assert!((apart_n / wanted_n - 1.0).abs() < 1e-9, "{n}: {apart_n} {wanted_n}");
            }
        }
    }
}

/// The columns of a tower bear what is above them, and crossed cables, rigid or elastic, of which none bears anything, hold it to both sides; of
/// one cable a storey it falls to the other side, however large it is.
#[test]
fn towers_stand_by_two_cables_a_storey_and_fall_with_one() {
    let plane = Support::Plane { at_m: [0.0; 3], normal: [0.0, 1.0, 0.0] };
    let place = |joint: usize| [4.0 * (joint % 2) as f64, 0.0, 3.0 * (joint / 2) as f64];
    for (storeys, cables, stiffness_n) in [
        (30, 2, None),
        (100, 2, None),
        (20, 2, Some(5e6)),
        (45, 2, Some(5e6)),
        (30, 1, None),
        (100, 1, None),
    ] {
        let joints = (0..2 * storeys + 2).map(|joint| match joint {
            0 | 1 => Joint::anchor(format!("{joint}"), place(joint)),
            _ => {
                let free = Joint::free(format!("{joint}")).held_by(plane).near(place(joint));
                free.with_force([0.0, 0.0, -1000.0])
            }
        });
        let member = |a: usize, b: usize, kind| {
            let body = Bar::homogeneous(norm(minus(place(a), place(b))), 0.0).unwrap();
            Member::bar(a, b, body).of_kind(kind)
        };
        let members = (0..storeys).flat_map(|storey| {
            let [l, r, above_l, above_r] = [0, 1, 2, 3].map(|k| 2 * storey + k);
            let bars = [(l, above_l), (r, above_r), (above_l, above_r)];
            let bars = bars.map(|(a, b)| member(a, b, Kind::Bar));
            let cables = [(l, above_r), (r, above_l)].into_iter().take(cables);
            let cable = |(a, b)| member(a, b, Kind::Cable).with_stiffness(stiffness_n);
            bars.into_iter().chain(cables.map(cable))
        });
        let system = System::new("tower", G, joints.collect(), members.collect()).unwrap();
        if cables == 1 {
            let answer = ask(&system, Solvers::Both, &|_| {});
            let stands = |e: &&SystemEquilibrium| {
                e.joints_m[2 * storeys][0].abs() < 1e-6 && e.stability.index_in_space == 0
            };
            assert_eq!(answer.equilibria.iter().find(stands), None, "{storeys}");
            continue;
        }
        for e in neighbour(&system).equilibria {
            for (joint, at_m) in e.joints_m.iter().enumerate() {
                close(at_m, &place(joint), 1e-9);
            }
            for (storey, borne_n) in e.axial_n.chunks(5).enumerate() {
                let column_n = -1000.0 * (storeys - storey) as f64;
                close(borne_n, &[column_n, column_n, 0.0, 0.0, 0.0], 1e-6);
            }
        }
    }
}
