//! Mobiles of Calder's kind: beams that turn freely about their threads, which hang on other beams.
//! Both solvers are started from other azimuths of every beam, and find one equilibrium.

use model::system::{Joint, Member, System, SystemEquilibrium};
use model::system_file::{Described, parse};
use model::{Bar, Excess, Quantity, Status, Vector};
use numerics::vector::{minus, norm};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use validate::Solvers;
use validate::systems::{Near, SystemAgreement, ask, compare};
use validate::tolerances::Tolerances;

/// Mobiles of each test, and on how many at least both solvers agree: `energy` comes to no end of
/// its iterations for some.
const MOBILES: u64 = 40;
const LEAST: u64 = 30;

/// What hangs on a tip of a beam.
enum Tip {
    Weight(f64),
    Beam(Box<Beam>),
}

/// A thread with a beam: a triangle of light bars that hangs by its hook, the tips `height_m` below
/// that. By the lever rule the hook is above the centre of weight, and the tips are level.
struct Beam {
    thread_m: f64,
    span_m: f64,
    height_m: f64,
    tips: [Tip; 2],
}

impl Tip {
    fn mass_kg(&self) -> f64 {
        match self {
            Self::Weight(mass_kg) => *mass_kg,
            Self::Beam(beam) => beam.tips.iter().map(Self::mass_kg).sum(),
        }
    }
}

impl Beam {
    fn random(random: &mut ChaCha8Rng, depth: usize) -> Self {
        let tips = [(); 2].map(|()| {
            if depth > 0 && random.random_range(0..4) > 0 {
                Tip::Beam(Box::new(Self::random(random, depth - 1)))
            } else {
                Tip::Weight(random.random_range(0.1..2.0))
            }
        });
        Self {
            thread_m: random.random_range(0.1..0.6),
            span_m: random.random_range(0.5..2.0),
            height_m: random.random_range(0.1..0.5),
            tips,
        }
    }

    fn count(&self) -> usize {
        let below = self.tips.iter().map(|tip| match tip {
            Tip::Weight(_) => 0,
            Tip::Beam(beam) => beam.count(),
        });
        1 + below.sum::<usize>()
    }
}

/// A mobile with its beams at random azimuths.
#[derive(Default)]
struct Hung {
    joints: Vec<Joint>,
    members: Vec<Member>,
    places_m: Vec<Vector>,
}

impl Hung {
    fn new(beam: &Beam, azimuths: &mut ChaCha8Rng) -> Self {
        let mut hung = Self::default();
        let at_m = [0.3, -0.2, 1.0];
        hung.joints.push(Joint::anchor("A", at_m));
        hung.places_m.push(at_m);
        hung.hang(0, beam, azimuths);
        hung
    }

    fn joint(&mut self, mass_kg: f64, at_m: Vector) -> usize {
        self.joints.push(Joint::free(format!("{}", self.joints.len())).with_mass(mass_kg));
        self.places_m.push(at_m);
        self.joints.len() - 1
    }

    fn tie(&mut self, from: usize, to: usize) {
        let [a, b] = [from, to].map(|joint| self.places_m[joint]);
        let length_m = (b[0] - a[0]).hypot(b[1] - a[1]).hypot(b[2] - a[2]);
        self.members.push(Member::bar(from, to, Bar::homogeneous(length_m, 0.0).unwrap()));
    }

    fn hang(&mut self, from: usize, beam: &Beam, azimuths: &mut ChaCha8Rng) {
        let [x, y, z] = self.places_m[from];
        let hook = self.joint(0.0, [x, y, z - beam.thread_m]);
        self.tie(from, hook);
        let (sin, cos) = azimuths.random_range(0.0..std::f64::consts::TAU).sin_cos();
        let [left, right] = [&beam.tips[0], &beam.tips[1]].map(Tip::mass_kg);
        let arms_m = [-beam.span_m * right / (left + right), beam.span_m * left / (left + right)];
        let tips = [0, 1].map(|k| {
            let at_m =
                [x + arms_m[k] * cos, y + arms_m[k] * sin, z - beam.thread_m - beam.height_m];
            let mass_kg = if let Tip::Weight(mass_kg) = beam.tips[k] { mass_kg } else { 0.0 };
            self.joint(mass_kg, at_m)
        });
        for tip in tips {
            self.tie(hook, tip);
        }
        self.tie(tips[0], tips[1]);
        for (tip, at) in beam.tips.iter().zip(tips) {
            if let Tip::Beam(below) = tip {
                self.hang(at, below, azimuths);
            }
        }
    }

    fn system(&self) -> System {
        System::new("mobile", 9.806_65, self.joints.clone(), self.members.clone()).unwrap()
    }
}

/// The answers of both solvers from two seeds, if both have one.
fn tried(
    system: &System,
    first_m: &[Vector],
    second_m: &[Vector],
) -> Option<[SystemEquilibrium; 2]> {
    let seed = lagrange::net::Seed::at(first_m.to_vec());
    let forces = lagrange::net::solve_from(system, &seed, &lagrange::net::Settings::default());
    let places = energy::net::minimise_from(system, second_m, &energy::net::Settings::default());
    Some([forces.ok()?.equilibrium, places.ok()?.equilibrium])
}

fn from(system: &System, first_m: &[Vector], second_m: &[Vector]) -> [SystemEquilibrium; 2] {
    tried(system, first_m, second_m).unwrap()
}

fn compared(system: &System, answers: &mut [SystemEquilibrium; 2]) -> SystemAgreement {
    compare(system, answers, &Tolerances::project())
}

fn farthest_m(answers: &[SystemEquilibrium; 2]) -> f64 {
    let pairs = answers[0].joints_m.iter().zip(&answers[1].joints_m);
    let far = |(a, b): (&Vector, &Vector)| (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
    pairs.map(far).fold(0.0, f64::max)
}

#[test]
fn beams_of_a_mobile_are_turned_onto_each_other() {
    let mut answered = 0;
    for seed in 0..MOBILES {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let beam = Beam::random(&mut random, 4);
        let first = Hung::new(&beam, &mut random);
        let second = Hung::new(&beam, &mut random);
        let system = first.system();
        let Some(mut answers) = tried(&system, &first.places_m, &second.places_m) else { continue };
        assert!(farthest_m(&answers) > 0.01, "mobile {seed} does not turn");
        let found = compared(&system, &mut answers);
        assert!(found.turned_parts >= beam.count(), "mobile {seed}: {}", found.turned_parts);
        if !found.agrees() {
            only_the_energies_differ(&found, seed);
            continue;
        }
        answered += 1;
        let Status::Reached(agreed) = &answers[0].evidence.ladder.agreed else { panic!() };
        let said = agreed.to_string();
        assert!(said.contains("freely about") && said.contains("turned"), "{said}");
    }
    println!("{answered} of {MOBILES} mobiles agreed on");
    assert!(answered >= LEAST);
}

#[test]
fn mobiles_from_no_guess_agree() {
    let mut answered = 0;
    for seed in 0..MOBILES {
        let mut random = ChaCha8Rng::seed_from_u64(1000 + seed);
        let beam = Beam::random(&mut random, 3);
        let answer = ask(&Hung::new(&beam, &mut random).system(), Solvers::Both, &|_| {});
        let Some(found) = &answer.agreement else {
            println!("{:?}", answer.failures);
            continue;
        };
        if found.agrees() {
            answered += 1;
        } else {
            only_the_energies_differ(found, seed);
        }
    }
    println!("{answered} of {MOBILES} mobiles agreed on");
    assert!(answered >= LEAST);
}

/// The energy of a shape that hardly resists is known to fewer digits than the budget has; places
/// and forces are one.
fn only_the_energies_differ(found: &SystemAgreement, seed: u64) {
    let of_energy = |excess: &Excess| matches!(excess.what, Quantity::Energy { .. });
    let others = found.disagreement.excesses.iter().filter(|excess| !of_energy(excess)).count();
    assert!(others == 0, "mobile {seed}: {}", found.disagreement);
}

/// A joint that is a micrometre off in one of the answers is not explained by any turn.
#[test]
fn a_difference_that_is_no_turn_stays_one() {
    let mut random = ChaCha8Rng::seed_from_u64(7);
    let beam = Beam::random(&mut random, 3);
    let (first, second) = (Hung::new(&beam, &mut random), Hung::new(&beam, &mut random));
    let system = first.system();
    let answers = from(&system, &first.places_m, &second.places_m);
    assert!(compared(&system, &mut answers.clone()).agrees());
    for joint in 1..answers[1].joints_m.len() {
        let mut changed = answers.clone();
        changed[1].joints_m[joint][2] += 1e-6;
        let found = compared(&system, &mut changed);
        assert!(!found.agrees() && found.joints_m > 5e-7, "joint {joint}");
    }
}

/// Three weights that a light tetrahedron keeps apart, and their mirror image: the same lengths,
/// the same energy, another equilibrium, and no turn leads from the one to the other.
#[test]
fn a_mirror_image_is_another_equilibrium() {
    let place = |mirror: f64| {
        let (a, b) = ([0.6, 0.1 * mirror, -0.5], [-0.1, 0.5 * mirror, -0.9]);
        // Masses 1, 2 and 3: the centre of weight is below the hook.
        let c = [-(a[0] + 2.0 * b[0]) / 3.0, -(a[1] + 2.0 * b[1]) / 3.0, -0.4];
        vec![[0.0; 3], [0.0, 0.0, -0.3], a, b, c]
    };
    let mut hung = Hung { places_m: place(1.0), ..Hung::default() };
    hung.joints.push(Joint::anchor("A", [0.0; 3]));
    hung.joints.push(Joint::free("H"));
    for (name, mass_kg) in [("a", 1.0), ("b", 2.0), ("c", 3.0)] {
        hung.joints.push(Joint::free(name).with_mass(mass_kg));
    }
    for (from, to) in [(0, 1), (1, 2), (1, 3), (1, 4), (2, 3), (3, 4), (4, 2)] {
        hung.tie(from, to);
    }
    let system = hung.system();
    let turned: Vec<Vector> = place(1.0).into_iter().map(|[x, y, z]| [-y, x, z]).collect();
    let mut same = from(&system, &place(1.0), &turned);
    assert!(farthest_m(&same) > 0.1 && compared(&system, &mut same).agrees());
    let mut other = from(&system, &place(1.0), &place(-1.0));
    let found = compared(&system, &mut other);
    assert!(found.energy_j < 1e-12 && !found.agrees() && found.joints_m > 0.1);
}

/// Tripods with ties between feet on level rollers: nothing holds them in the level, and the solvers put them elsewhere. Where
/// they have come to rest their legs bear what the weight asks of them (by symmetry: a third of it by height over length).
#[test]
fn tripods_on_level_rollers_may_be_anywhere() {
    let mut rng = ChaCha8Rng::seed_from_u64(29);
    for _ in 0..20 {
        let (radius, height) = (rng.random_range(0.5..2.0), rng.random_range(0.5..2.0));
        let turn: f64 = rng.random_range(0.0..1.0);
        let foot = |k: u32| {
            let angle = turn + std::f64::consts::TAU * f64::from(k) / 3.0;
            [radius * angle.cos(), radius * angle.sin(), 0.0]
        };
        let [a, b, c] = [0, 1, 2].map(foot);
        let text = format!(
            "gravity_m_s2 = 10\njoints = {{ A = {{ at_m = {a:?}, free = 'xy' }}, B = {{ at_m = {b:?}, free = 'xy' }}, \
             C = {{ at_m = {c:?}, free = 'xy' }}, T = {{ near_m = [0, 0, {height}], mass_kg = 3 }} }}\n\
             bars = [{{ from = 'A', to = 'B', mass_kg = 0 }}, {{ from = 'B', to = 'C', mass_kg = 0 }}, \
             {{ from = 'C', to = 'A', mass_kg = 0 }}, {{ from = 'A', to = 'T', mass_kg = 0 }}, \
             {{ from = 'B', to = 'T', mass_kg = 0 }}, {{ from = 'C', to = 'T', mass_kg = 0 }}]"
        );
        let Ok(Described::System(system)) = parse(&text, "tripod.toml") else { panic!("{text}") };
        let answer = ask(&system, Solvers::Both, &|_| {});
        assert!(answer.agrees(), "{text}: {:?}", answer.agreement);
        assert_eq!(answer.agreement.as_ref().map(|found| found.sliding_parts), Some(1));
        let leg = -10.0 * radius.hypot(height) / height;
        for found in &answer.equilibria {
            assert!((found.axial_n[3] - leg).abs() < 1e-9 * leg.abs(), "{:?} {leg}", found.axial_n);
        }
    }
}

/// Stiff elastic bodies on one hook: of such members a rounding of a length is a force.
#[test]
fn both_solvers_agree_on_stiff_bodies_that_hang_from_one_hook() {
    let mut agreed = 0;
    for seed in 0..100 {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let mut places_m: Vec<Vector> = vec![[0.0; 3]];
        let mut joints = vec![Joint::anchor("H", [0.0; 3])];
        for k in 0..random.random_range(3..6) {
            let mut within = |low, high| random.random_range(low..high);
            places_m.push([within(-1.5, 1.5), within(-1.5, 1.5), within(-3.0, -1.0)]);
            joints.push(Joint::free(format!("P{k}")).with_mass(within(0.5, 100.0)));
        }
        let stiffness_n = 10_f64.powf(random.random_range(6.0..9.0));
        let mut members = Vec::new();
        for to in 1..places_m.len() {
            for from in 0..to {
                if from == 0 || random.random_range(0..10) > 0 {
                    let length_m = norm(minus(places_m[from], places_m[to]));
                    let body = Bar::homogeneous(length_m, random.random_range(0.0..5.0)).unwrap();
                    members.push(Member::bar(from, to, body).with_stiffness(Some(stiffness_n)));
                }
            }
        }
        let system = System::new("a load", 9.81, joints, members).unwrap();
        let answer = ask(&system, Solvers::Both, &|_| {});
        if let Some(found) = &answer.agreement {
            assert!(answer.agrees() && found.turned_parts == 1, "{seed}: {found:?}");
            agreed += 1;
        }
    }
    assert!(agreed >= 98, "{agreed}");
}

/// A load of three bars on one hook, drawn 40 degrees turned from where a solver leaves it, is where it is drawn.
#[test]
fn what_turns_freely_is_held_against_a_drawing_as_it_is_turned() {
    let bar = |from, to, length_m| Member::bar(from, to, Bar::homogeneous(length_m, 1.0).unwrap());
    let joints = vec![
        Joint::anchor("H", [0.0; 3]),
        Joint::free("P").with_mass(3.0),
        Joint::free("Q").with_mass(5.0),
    ];
    let members = vec![bar(0, 1, 2.0), bar(0, 2, 1.8), bar(1, 2, 1.5)];
    let system = System::new("a load", 9.81, joints, members).unwrap();
    let found = &ask(&system, Solvers::Both, &|_| {}).equilibria[0];
    let (sin, cos) = 40.0_f64.to_radians().sin_cos();
    let turned = found.joints_m.iter().map(|[x, y, z]| [cos * x - sin * y, sin * x + cos * y, *z]);
    let drawing_m: Vec<Vector> = turned.collect();
    let near = Near::of(&system, &drawing_m, found);
    assert!(near.is_neighbour && near.moved_m < 1e-12, "{near:?}");
    // Upside down it is elsewhere.
    let above: Vec<Vector> = drawing_m.iter().map(|[x, y, z]| [*x, *y, -z]).collect();
    assert!(!Near::of(&system, &above, found).is_neighbour);
}
