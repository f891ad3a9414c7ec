//! Structures as they are drawn: the equilibrium next to the drawing by both solvers, against the
//! method of joints, a linear stiffness computation by nalgebra, and published numbers.

use model::cases::exhibit;
use model::system::{Joint, Kind, Member, Support, System, SystemEquilibrium};
use model::system_file::{Described, parse};
use model::{Bar, STANDARD_GRAVITY_M_S2 as G, Vector};
use nalgebra::{DMatrix, DVector, Vector3};
use rand::{RngExt as _, SeedableRng as _};
use rand_chacha::ChaCha8Rng;
use validate::systems::{Near, SystemAnswer, ask, ask_with};
use validate::{Question, Solvers, UseCensus};

pub fn drawn(name: &str) -> System {
    exhibit(name).expect("it is drawn").system()
}

/// Both answers next to the drawing, which agree.
#[track_caller]
pub fn neighbour(system: &System) -> SystemAnswer {
    let answer = ask(system, Solvers::Both, &|_| {});
    assert!(answer.agrees(), "{}: {:?} {:?}", system.name(), answer.agreement, answer.failures);
    assert!(answer.near.as_ref().unwrap().is_neighbour, "{:?}", answer.near);
    answer
}

pub fn axial(system: &System, e: &SystemEquilibrium, from: &str, to: &str) -> f64 {
    let [a, b] = [from, to].map(|name| system.joint(name).expect("a joint"));
    let member = system.members().iter().position(|m| [m.from, m.to] == [a, b]);
    e.axial_n[member.expect("a member")]
}

/// The directions in which joints may move.
struct Freedoms {
    axes: Vec<Vec<Vector3<f64>>>,
    /// The number of the first of each joint.
    first: Vec<usize>,
    size: usize,
}

impl Freedoms {
    fn of(system: &System) -> Self {
        let unit: Vec<Vector3<f64>> = (0..3).map(|k| Vector3::ith(k, 1.0)).collect();
        let axes = |joint: &Joint| match joint.support {
            Support::Free => unit.clone(),
            Support::Fixed { .. } => vec![],
            Support::Line { direction, .. } => vec![direction.into()],
            Support::Plane { normal, .. } => {
                let normal = Vector3::from(normal);
                unit.iter().filter(|axis| axis.dot(&normal).abs() < 0.5).copied().collect()
            }
        };
        let axes: Vec<_> = system.joints().iter().map(axes).collect();
        let mut size = 0;
        let first = axes.iter().map(|axes| {
            size += axes.len();
            size - axes.len()
        });
        Self { first: first.collect(), size, axes }
    }

    /// How fast the ends of a member move apart in a direction.
    fn row(&self, member: &Member, direction: Vector3<f64>) -> DVector<f64> {
        let mut row = DVector::zeros(self.size);
        for (joint, sign) in [(member.from, -1.0), (member.to, 1.0)] {
            for (k, axis) in self.axes[joint].iter().enumerate() {
                row[self.first[joint] + k] += sign * axis.dot(&direction);
            }
        }
        row
    }

    fn load(&self, system: &System) -> DVector<f64> {
        let mut load = DVector::zeros(self.size);
        for (joint, of) in system.joints().iter().enumerate() {
            let weight = Vector3::z() * (of.mass_kg * system.gravity_m_s2());
            for (k, axis) in self.axes[joint].iter().enumerate() {
                load[self.first[joint] + k] = axis.dot(&(Vector3::from(of.force_n) - weight));
            }
        }
        load
    }

    fn moved(&self, places: &mut [Vector], by: &DVector<f64>) {
        for (joint, place) in places.iter_mut().enumerate() {
            for (k, axis) in self.axes[joint].iter().enumerate() {
                *place = (Vector3::from(*place) + axis * by[self.first[joint] + k]).into();
            }
        }
    }
}

fn span(places: &[Vector], member: &Member) -> Vector3<f64> {
    Vector3::from(places[member.to]) - Vector3::from(places[member.from])
}

/// Displacements and axial forces of the linear analysis at the drawing. Rigid members are equally
/// stiff, which moves nothing in the limit; forces of members that are fewer than needed do not
/// depend on it.
pub fn linear(system: &System) -> (DVector<f64>, Vec<f64>) {
    let (freedoms, places) = (Freedoms::of(system), system.drawing().unwrap());
    let row = |member: &Member| {
        let span = span(&places, member);
        let stiffness = member.stiffness_n.unwrap_or(1.0) / span.norm();
        (freedoms.row(member, span.normalize()), stiffness)
    };
    let mut stiffness = DMatrix::zeros(freedoms.size, freedoms.size);
    for member in system.members() {
        let (row, k) = row(member);
        stiffness += &row * row.transpose() * k;
    }
    let load = freedoms.load(system);
    let moves = stiffness.cholesky().expect("it is braced").solve(&load);
    let forces = system.members().iter().map(|member| {
        let (row, k) = row(member);
        k * row.dot(&moves)
    });
    let forces = forces.collect();
    (moves, forces)
}

/// Newton's method on the places of the joints, elastic members alone, while the load grows in
/// steps from the drawing: places and axial forces. No value where the stiffness is no longer
/// positive on the way, past the limit load.
fn newton(system: &System) -> Option<(Vec<Vector>, Vec<f64>)> {
    const LOAD_STEPS: u32 = 40;
    let freedoms = Freedoms::of(system);
    let mut places = system.drawing().unwrap();
    let axial = |places: &[Vector], member: &Member| {
        let length_m = member.body.length_m();
        let force = member.stiffness_n.unwrap() * (span(places, member).norm() / length_m - 1.0);
        if member.kind == Kind::Cable { force.max(0.0) } else { force }
    };
    for step in 1..=LOAD_STEPS {
        for _ in 0..10 {
            let mut left = freedoms.load(system) * (f64::from(step) / f64::from(LOAD_STEPS));
            let mut stiffness = DMatrix::zeros(freedoms.size, freedoms.size);
            for member in system.members() {
                let (span, force) = (span(&places, member), axial(&places, member));
                let row = freedoms.row(member, span.normalize());
                left -= &row * force;
                let slack = member.kind == Kind::Cable && force <= 0.0;
                let along = member.stiffness_n.filter(|_| !slack).unwrap_or(0.0);
                stiffness += &row * row.transpose() * (along / member.body.length_m());
                let aside = span.cross(&Vector3::ith(span.iamin(), 1.0)).normalize();
                for across in [aside, span.normalize().cross(&aside)] {
                    let row = freedoms.row(member, across);
                    stiffness += &row * row.transpose() * (force / span.norm());
                }
            }
            freedoms.moved(&mut places, &stiffness.cholesky()?.solve(&left));
        }
    }
    let forces = system.members().iter().map(|member| axial(&places, member)).collect();
    Some((places, forces))
}

/// The same system under a part of its loads.
fn loaded(system: &System, part: f64) -> System {
    let joints = system.joints().iter().map(|joint| {
        joint.clone().with_mass(part * joint.mass_kg).with_force(joint.force_n.map(|x| part * x))
    });
    let members = system.members().to_vec();
    System::new(system.name(), system.gravity_m_s2(), joints.collect(), members).unwrap()
}

#[track_caller]
pub fn close(found: &[f64], wanted: &[f64], within: f64) {
    for (k, (a, b)) in found.iter().zip(wanted).enumerate() {
        assert!((a - b).abs() <= within, "member {k}: {a} is not {b} within {within:e}");
    }
}

#[test]
fn the_tower_tends_to_its_linear_analysis_as_its_loads_vanish() {
    let system = drawn("lattice-tower");
    let total_n = 200.0 * G + 4.0 * 400.0_f64.hypot(100.0);
    for part in [1.0, 1e-3, 1e-6] {
        let system = loaded(&system, part);
        let (moves, forces) = linear(&system);
        // Strains of some 1e-5 under the whole load change the forces by as much; and lengths that
        // are rounded to doubles strain a frame with more members than needed.
        let rounded_n = 1e8 * f64::EPSILON;
        let within = 1e-4 * part * part * total_n + rounded_n;
        for e in &neighbour(&system).equilibria {
            close(&e.axial_n, &forces, within);
        }
        assert!(moves.amax() > 0.0);
    }
}

/// Levy and Spillers: the crown moves by 0.20641184 in under P by linear analysis.
#[test]
fn the_dome_stands_under_part_of_its_load_and_tends_to_its_linear_analysis() {
    const INCH_M: f64 = 0.0254;
    let system = drawn("star-dome");
    let crown = |e: &SystemEquilibrium| e.joints_m[0][2] - 0.082_158_84;
    let answer = neighbour(&system);
    for e in &answer.equilibria {
        assert!((crown(e) + 1.842_733_020e-3).abs() < 1e-12, "{:e}", crown(e));
        assert_eq!(e.stability.index_in_space, 0);
    }
    // Inverted it has less energy.
    assert!(answer.near.unwrap().lower_j.unwrap() < -20.0);
    for part in [1e-3, 1e-6] {
        let weak = loaded(&system, part / 0.3);
        let (_, forces) = linear(&weak);
        let load_n = 980.654_937_3 * part;
        for e in &neighbour(&weak).equilibria {
            let per_load_in = crown(e) / part / INCH_M;
            // The first term of what is not linear is some 0.6 of the load's part; places are
            // stored to 1.4e-17 m.
            let within = 0.206 * 2.0 * part + 2.8e-17 / part / INCH_M;
            assert!((per_load_in + 0.206_411_84).abs() < within + 5e-9, "{per_load_in}");
            close(&e.axial_n, &forces, 4.0 * part * load_n + 1e-8 * load_n);
        }
    }
}

/// Under large loads against Newton's method here: strains of a hundredth in the tower, 0.3 and 0.66 of
/// the load in the dome, ridge cables that are all but slack in the cable dome.
#[test]
fn elastic_structures_are_those_of_an_independent_newton_under_large_loads() {
    for (name, parts) in
        [("lattice-tower", [30.0, 1000.0]), ("star-dome", [1.0, 2.2]), ("geiger-dome", [1.0, 2.6])]
    {
        for part in parts {
            let system = loaded(&drawn(name), part);
            let (places, forces) = newton(&system).unwrap();
            let largest_n = forces.iter().fold(0.0, |most: f64, force| most.max(force.abs()));
            let answer = ask(&system, Solvers::Both, &|_| {});
            assert!(answer.agrees(), "{name} {part}: {:?} {:?}", answer.agreement, answer.failures);
            for e in &answer.equilibria {
                close(&e.axial_n, &forces, 1e-9 * largest_n);
                close(e.joints_m.as_flattened(), places.as_flattened(), 1e-10);
                assert_eq!(e.stability.index_in_space, 0);
            }
        }
    }
}

/// It stands under 0.66 of their load and not under 0.675, where Newton's method here meets a stiffness
/// that is not positive; Levy and Spillers found its limit at "about sixty percent".
#[test]
fn the_dome_snaps_through_beyond_its_limit_load_and_that_is_said() {
    for (part, stands) in [(0.6, true), (0.66, true), (0.675, false), (1.0, false)] {
        let system = loaded(&drawn("star-dome"), part / 0.3);
        assert_eq!(newton(&system).is_some(), stands, "{part}");
        let answer = ask(&system, Solvers::Both, &|_| {});
        let near = answer.near.as_ref();
        let up = answer.agrees() && near.is_some_and(|near| near.is_neighbour);
        assert_eq!(up, stands, "{part}: {near:?} {:?}", answer.failures);
        let index = answer.equilibria.first().map(|e| e.stability.index_in_space);
        assert!(!stands || index == Some(0), "{part}");
        for e in answer.equilibria.iter().filter(|_| !stands) {
            let drawing_m = system.drawing().unwrap();
            assert!(!Near::of(&system, &drawing_m, e).is_neighbour, "{part}");
        }
    }
}

pub fn written(text: &str) -> System {
    match parse(text, "drawn.toml").unwrap() {
        Described::System(system) => system,
        Described::Chain(_) => panic!("joints by name"),
    }
}

/// Rigid posts of 3 m and a beam of 4 m, pushed aside, with cables across that are longer than 5 m: upright it has no
/// equilibrium, and it leans until one of them is taut, where 4² + 3² + 2 * 4 * 3 sin θ is the square of its length.
#[test]
fn a_frame_with_slack_bracing_leans_until_it_is_taut() {
    for slack_m in [1e-3, 5e-3, 0.01, 0.05, 0.1] {
        let length_m = 5.0 + slack_m;
        let system = written(&format!(
            "plane = \"xz\"\n\
             joints = {{ A = {{ at_m = [0, 0, 0] }}, B = {{ at_m = [4, 0, 0] }}, \
             C = {{ near_m = [4, 0, 3], mass_kg = 100, force_n = [500, 0, 0] }}, \
             D = {{ near_m = [0, 0, 3], mass_kg = 100 }} }}\n\
             bars = [{{ from = \"A\", to = \"D\", mass_kg = 60 }}, {{ from = \"B\", to = \"C\", mass_kg = 60 }}, \
             {{ from = \"D\", to = \"C\", mass_kg = 80 }}, \
             {{ from = \"A\", to = \"C\", length_m = {length_m}, mass_kg = 3, kind = \"cable\" }}, \
             {{ from = \"B\", to = \"D\", length_m = {length_m}, mass_kg = 3, kind = \"cable\" }}]\n"
        ));
        let sin = (length_m * length_m - 25.0) / 24.0;
        for e in &neighbour(&system).equilibria {
            let [x, _, z] = e.joints_m[system.joint("D").unwrap()];
            close(&[x, z], &[3.0 * sin, 3.0 * (1.0 - sin * sin).sqrt()], 1e-11);
            assert!(e.stability.index_in_space == 0 && axial(&system, e, "A", "C") > 0.0);
        }
    }
}

/// Short panels of a long span that sinks by more than one of them: the parabola of 2.1 m for one that is drawn with
/// 1 m. No panel turns by more than a tenth.
#[test]
fn a_span_of_short_panels_may_sink_by_more_than_a_panel() {
    const N: usize = 80;
    let at = |k: usize| 40.0 * k as f64 / N as f64;
    let joints = (1..N).map(|k| {
        let (x, part) = (at(k), at(k) / 20.0 - 1.0);
        format!("c{k} = {{ near_m = [{x}, 0, {}], mass_kg = 10 }}\n", part * part - 1.0)
    });
    let length_m = (40.0 + 8.0 / 3.0 * 2.1 * 2.1 / 40.0) / N as f64;
    let name = |k: usize| match k {
        0 => "A".to_owned(),
        N => "B".to_owned(),
        _ => format!("c{k}"),
    };
    let bar = |k: usize| {
        let [from, to] = [name(k), name(k + 1)];
        format!("[[bars]]\nfrom = \"{from}\"\nto = \"{to}\"\nlength_m = {length_m}\nmass_kg = 1\n")
    };
    let system = written(&format!(
        "[joints]\nA = {{ at_m = [0, 0, 0] }}\nB = {{ at_m = [40, 0, 0] }}\n{}{}",
        joints.collect::<String>(),
        (0..N).map(bar).collect::<String>()
    ));
    let answer = neighbour(&system);
    assert!(answer.near.unwrap().moved > 2.0);
    for e in &answer.equilibria {
        // The length of a parabola to the next order of its sag over its span.
        assert!((e.joints_m[system.joint("c40").unwrap()][2] + 2.1).abs() < 0.01);
    }
}

/// Nothing drawn, and without other starts: the dome turned inside out, which is as long in all members.
/// As the load vanishes its crown is as far below the supports as it is drawn above them. Other starts lead to shapes that are
/// lower.
#[test]
fn without_a_drawing_the_dome_hangs_inside_out() {
    for part in [1e-6, 1e-3, 0.3] {
        let system = loaded(&drawn("star-dome"), part / 0.3).undrawn();
        let alone = Question { census: UseCensus::Never, ..Question::default() };
        let answer = ask_with(&system, &alone, &|_| {});
        assert!(answer.agrees() && answer.near.is_none(), "{part}: {:?}", answer.failures);
        let lowest = ask(&system, Solvers::Both, &|_| {});
        assert!(lowest.agrees() && lowest.equilibria[0].energy_j < answer.equilibria[0].energy_j);
        for e in &answer.equilibria {
            let lower_m = -e.joints_m[0][2] - 0.082_158_84;
            // Of P the linear analysis lowers it by 0.206 in; in tension it stiffens by some 0.4 of the
            // load's part.
            let linear_m = 0.206_411_84 * 0.0254 * part;
            let within_m = 0.6 * part * linear_m + 1e-14;
            assert!((lower_m - linear_m).abs() < within_m, "{part}: {lower_m:e}");
        }
    }
}

#[test]
fn the_cable_dome_stands_by_its_prestress() {
    let system = drawn("geiger-dome");
    let answer = neighbour(&system);
    for e in &answer.equilibria {
        assert_eq!(e.stability.index_in_space, 0);
        // Its weight is 9 times 20 kg, borne by eight supports alike.
        let support = e.reactions_n[system.joint("S3").unwrap()];
        assert!((support[2] - 9.0 * 20.0 * G / 8.0).abs() < 1e-7, "{support:?}");
    }
    // Without weight it stands where it is drawn, with the prestress that is written.
    let still = loaded(&system, 0.0);
    let answer = neighbour(&still);
    assert!(answer.near.unwrap().moved_m < 1e-12);
    for e in &answer.equilibria {
        assert!((axial(&still, e, "top", "bottom") + 2000.0).abs() < 1e-6);
    }
}

/// Places off by up to a part of the shortest member.
fn drawn_wrong(system: &System, part: f64, seed: u64) -> System {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let lengths = system.members().iter().map(|member| member.body.length_m());
    let off_m = part * lengths.fold(f64::INFINITY, f64::min);
    let places: Vec<Vector> = system.drawing().unwrap();
    let moved =
        places.iter().map(|place| place.map(|x| x + off_m * random.random_range(-1.0..1.0)));
    system.clone().drawn_at(&moved.collect::<Vec<_>>()).unwrap()
}

/// It is the same equilibrium, or the program says that it is not, or that there is none.
#[test]
fn shapes_drawn_wrong_lead_to_the_neighbour_or_say_so() {
    for name in ["warren-truss", "lattice-tower", "star-dome", "geiger-dome"] {
        let system = drawn(name);
        let right = neighbour(&system).equilibria.remove(0);
        for (part, seeds) in [(0.01, 3), (0.05, 3), (0.2, 3)] {
            let mut found = 0;
            for seed in 0..seeds {
                let wrong = drawn_wrong(&system, part, seed);
                let answer = ask(&wrong, Solvers::Both, &|_| {});
                let near = answer.near.clone();
                for e in &answer.equilibria {
                    let apart = e.joints_m.iter().zip(&right.joints_m);
                    let apart = apart.map(|(a, b)| (Vector3::from(*a) - Vector3::from(*b)).norm());
                    let same = apart.fold(0.0, f64::max) < 1e-9;
                    let there = Near::of(&wrong, &wrong.drawing().unwrap(), e);
                    let says = !there.is_neighbour || e.stability.index_in_space > 0;
                    // Of two neighbours of a rough sketch either is right.
                    assert!(same || says || part > 0.1, "{name} {part} {seed}: {near:?}");
                    found += usize::from(same && answer.agrees());
                }
            }
            // All of them, both solvers, up to 5 %.
            let least = if part < 0.1 { 6 } else { 0 };
            assert!(found >= least, "{name} {part}: {found}");
        }
    }
}

#[test]
fn where_no_minimum_is_near_energy_says_so() {
    let joints = vec![
        Joint::anchor("foot", [0.0; 3]),
        Joint::free("P").near([0.0, 0.0, 1.0]).with_mass(2.0),
    ];
    let rod = vec![Member::bar(0, 1, Bar::homogeneous(1.0, 0.0).unwrap())];
    let system = System::new("a rod on its head", 10.0, joints, rod).unwrap();
    let answer = ask(&system, Solvers::Both, &|_| {});
    let near = answer.near.unwrap();
    assert!(near.is_neighbour && near.moved_m < 1e-12);
    // 2 kg hang 1 m below the foot.
    assert!((near.lower_j.unwrap() + 20.0).abs() < 1e-9);
    assert_eq!(answer.equilibria[0].stability.index_in_space, 2);
    assert!(answer.failures[0].to_string().contains("no minimum near the drawing"));
}

/// A mast of 12 m on one joint with three prestressed guys from below: without one of these it comes down and hangs
/// plumb, the others slack, by (half of 300 kg + 50 kg) g over 4e8 N too long. Energy finds nothing that is near, and
/// `lagrange` nothing at all.
#[test]
fn a_mast_that_has_lost_a_guy_hangs() {
    let guy = |from: &str| {
        format!(
            "{{ from = \"{from}\", to = \"top\", kind = \"cable\", mass_kg = 0, stiffness_n = 1e7, prestress_n = 5000 }}"
        )
    };
    let guys = ["G1", "G2", "G3"].map(guy).join(", ");
    let system = written(&format!(
        "joints = {{ base = {{ at_m = [0, 0, 0] }}, G1 = {{ at_m = [10, 0, -2] }}, G2 = {{ at_m = [-5, 8.66, -2] }}, \
         G3 = {{ at_m = [-5, -8.66, -2] }}, top = {{ near_m = [0, 0, 12], mass_kg = 50 }} }}\n\
         bars = [{{ from = \"base\", to = \"top\", mass_kg = 300, stiffness_n = 4e8 }}, {guys}]\n"
    ));
    neighbour(&system);
    let mast_m = system.members()[0].body.length_m();
    for guy in 1..=3 {
        let (left, _) = system.without(guy);
        let answer = ask(&left, Solvers::Both, &|_| {});
        assert!(answer.agrees(), "{guy}: {:?} {:?}", answer.agreement, answer.failures);
        assert!(!answer.near.as_ref().unwrap().is_neighbour);
        let down_m = mast_m * (1.0 + (150.0 + 50.0) * G / 4e8);
        for e in &answer.equilibria {
            close(&e.joints_m[left.joint("top").unwrap()], &[0.0, 0.0, -down_m], 1e-9);
            close(&e.axial_n, &[(150.0 + 50.0) * G, 0.0, 0.0], 1e-6);
        }
    }
}

/// A triangle on a base of 2 m leans to a tip at (1000, 1000) m: what rounds its lengths moves the tip a thousand times as much, and
/// the loads make of that all by which the energies differ. Its two long bars bear 0.001 of their difference in direction.
#[test]
fn a_slender_triangle_leans() {
    let text = "plane = \"xz\"\n[joints]\nA = { at_m = [0, 0, 0] }\nB = { near_m = [2, 0, 0], free = \"x\" }\n\
        C = { near_m = [1000, 0, 1000], mass_kg = 100 }\n";
    let bars = [["A", "B"], ["A", "C"], ["B", "C"]]
        .map(|[from, to]| format!("[[bars]]\nfrom = \"{from}\"\nto = \"{to}\"\nmass_kg = 0\n"));
    let system = written(&(text.to_owned() + &bars.concat()));
    let answer = neighbour(&system);
    let load_n = 100.0 * G;
    // Moments of the load about A and about B, over the distances of the bars from there.
    let (from_a, from_b) = (1000.0 * load_n, 998.0 * load_n);
    let wanted = [from_b / 2_f64.sqrt(), -from_a / (2e3 / 998_f64.hypot(1e3))];
    for e in &answer.equilibria {
        for (other, wanted) in ["A", "B"].into_iter().zip(wanted) {
            let found = axial(&system, e, other, "C");
            assert!((found / wanted - 1.0).abs() < 1e-6, "{other}: {found} {wanted}");
        }
    }
}
