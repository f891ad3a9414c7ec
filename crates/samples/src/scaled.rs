//! The same system or chain in other units.

use model::system::{Joint, PointLoad, System};
use model::{Anchors, Bar, Chain, Problem, Vector};

fn times(vector: Vector, factor: f64) -> Vector {
    vector.map(|x| x * factor)
}

/// A chain with its lengths, masses and gravity times these factors, as [`scaled`]; without moments of inertia.
pub fn scaled_chain(problem: &Problem, [length, mass, gravity]: [f64; 3]) -> Problem {
    let chain = problem.chain();
    let anchors = chain.anchors();
    let anchors =
        Anchors { start_m: times(anchors.start_m, length), end_m: times(anchors.end_m, length) };
    let bars = chain.bars().iter().map(|bar| {
        let (length_m, centre_m) = (bar.length_m() * length, bar.centre_m() * length);
        Bar::new(length_m, bar.mass_kg() * mass, centre_m, [0.0; 3]).expect("a bar in other units")
    });
    let chain = Chain::new("scaled", chain.gravity_m_s2() * gravity, anchors, bars.collect());
    Problem::new(chain.expect("a chain in other units")).expect("a problem in other units")
}

/// A system with its lengths, masses and gravity times these factors: where they are powers of two, not a digit
/// of its answers changes but by them. So a number in some unit that is added to one in another is noticed,
/// whatever its size.
///
/// ```
/// use model::Bar;
/// use model::system::{Joint, Member, System};
/// let joints = vec![Joint::anchor("A", [0.0, 0.0, 3.0]), Joint::free("P").with_force([0.0, 0.0, -5.0])];
/// let members = vec![Member::bar(0, 1, Bar::homogeneous(1.0, 2.0)?).with_stiffness(10.0)];
/// let other = samples::scaled(&System::new("s", 9.81, joints, members)?, [4.0, 0.5, 2.0]);
/// assert_eq!((other.total_length_m(), other.total_mass_kg()), (4.0, 1.0));
/// assert_eq!((other.members()[0].stiffness_n, other.joints()[1].force_n[2]), (Some(10.0), -5.0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn scaled(system: &System, [length, mass, gravity]: [f64; 3]) -> System {
    let force = mass * gravity;
    let given = |within: f64| (within > 0.0).then_some(within);
    let joints = system.joints().iter().map(|joint| {
        let mut support = joint.support;
        support.at_m_mut().into_iter().for_each(|at_m| *at_m = times(*at_m, length));
        let scaled = Joint::free(joint.name.to_string())
            .held_by(support)
            .with_mass(joint.mass_kg * mass)
            .with_force(times(joint.force_n, force))
            .near(joint.near_m.map(|at_m| times(at_m, length)));
        let within = joint.tolerances.as_deref().copied().unwrap_or_default();
        let [by_kg, by_m, by_n] =
            [within.mass_kg() * mass, within.at_m() * length, within.force_n() * force];
        scaled.with_tolerances(given(by_kg), given(by_m), given(by_n)).expect("as before")
    });
    let members = system.members().iter().map(|member| {
        let original = member.clone().as_given();
        let bar = &original.body;
        let inertia = bar.given_inertia_kg_m2().map(|x| times(x, mass * length * length));
        let centre_m = bar.given_centre_m().map(|x| x * length);
        let body = Bar::given(bar.length_m() * length, bar.mass_kg() * mass, centre_m, inertia);
        let load = |load: &PointLoad| PointLoad {
            at_m: load.at_m * length,
            force_n: times(load.force_n, force),
            ..*load
        };
        let within_m = original.length_tolerance_m().map(|within_m| within_m * length);
        let within = original.tolerances.as_deref().copied().unwrap_or_default();
        let stiffness_n = original.stiffness_n.map(|stiffness_n| stiffness_n * force);
        let loads = original.loads.iter().map(load).collect();
        let mut scaled = original.clone().with_stiffness(stiffness_n).with_loads(loads);
        scaled.body = body.expect("a bar in other units");
        scaled.tolerances = None;
        scaled.set_length_tolerance(within_m);
        let scaled =
            scaled.with_tolerances(given(within.stiffness()), given(within.mass_kg() * mass));
        let scaled = scaled.expect("as before");
        match member.prestress_n() {
            Some(prestress_n) => scaled.with_prestress(prestress_n * force).expect("as before"),
            None => scaled,
        }
    });
    let gravity_m_s2 = system.gravity_m_s2() * gravity;
    let scaled = System::new(system.name(), gravity_m_s2, joints.collect(), members.collect())
        .expect("a system in other units");
    match system.floor_m() {
        Some(floor_m) => scaled.with_floor(floor_m * length).expect("a floor"),
        None => scaled,
    }
}
