//! Chains, systems, and censuses that are checked whatever they find.

use census::boxes::prove;
use census::net::SystemCensus;
use census::{Census, Settings};
use model::system::{Joint, Member, System};
use model::{Bar, Problem, Vector};
use nalgebra::{DMatrix, DVector};
use numerics::vector::{minus, norm};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
pub use samples::chain as problem;

/// Gravity of systems, m/s².
pub const G: f64 = 10.0;

pub fn system(joints: Vec<Joint>, members: Vec<Member>) -> System {
    System::new("test", G, joints, members).unwrap()
}

/// A member without mass.
pub fn light(length_m: f64) -> Bar {
    Bar::homogeneous(length_m, 0.0).unwrap()
}

pub fn equal(bars: usize, end_m: [f64; 3]) -> Problem {
    problem(&vec![(1.0, 1.0, 0.5); bars], end_m)
}

pub fn census(problem: &Problem) -> Census {
    match Census::take(problem, &Settings::default()) {
        Ok(census) => {
            // Whatever was found is right, complete or not.
            assert_eq!(census.check(problem), Ok(()));
            census
        }
        Err(error) => panic!("{error}"),
    }
}

/// A census whose every equilibrium is proved by the test that knows nothing of the search.
#[track_caller]
pub fn taken(system: &System) -> SystemCensus {
    let census = SystemCensus::take(system, &Settings::default()).unwrap();
    for chain in census.chains() {
        assert_eq!(chain.check, Ok(()));
    }
    for found in census.to_model(system) {
        let proof = prove(system, &found.joints_m, &found.axial_n).unwrap();
        assert!(proof.beyond_m(&found.joints_m) < 1e-13 * system.total_length_m());
        assert!(proof.turns >= found.stability.neutral);
    }
    census
}

/// A complete one.
#[track_caller]
pub fn whole(system: &System) -> SystemCensus {
    let census = taken(system);
    let open: Vec<_> = census.nets().flat_map(|net| &net.undecided).collect();
    assert!(census.complete, "{open:?}");
    census
}

/// The equations of a system in which some members act, and the others have no force, written for these tests alone.
pub struct Acting<'a> {
    pub system: &'a System,
    pub free: Vec<usize>,
    pub members: Vec<usize>,
}

impl<'a> Acting<'a> {
    pub fn new(system: &'a System, members: Vec<usize>) -> Self {
        let joints = system.joints().iter().enumerate();
        let free = joints.filter(|(_, joint)| joint.support.at_m().is_none());
        Self { system, free: free.map(|(k, _)| k).collect(), members }
    }

    /// The first of the unknowns of a joint.
    fn row(&self, joint: usize) -> Option<usize> {
        self.free.iter().position(|free| *free == joint).map(|k| 3 * k)
    }

    /// Where a joint is for these unknowns: places of joints, then forces of members.
    fn at(&self, unknowns: &[f64], joint: usize) -> Vector {
        match self.row(joint) {
            Some(row) => [0, 1, 2].map(|axis| unknowns[row + axis]),
            None => self.system.joints()[joint].support.at_m().unwrap(),
        }
    }

    /// How much longer the spans of a member are than it is.
    pub fn beyond(&self, unknowns: &[f64], member: usize) -> f64 {
        let member = &self.system.members()[member];
        let spans =
            member.spans().map(|[a, b]| norm(minus(self.at(unknowns, b), self.at(unknowns, a))));
        spans.sum::<f64>() - member.body.length_m()
    }

    /// Balances of the joints that move and lengths of the members that act, and how they change with the unknowns.
    fn equations(&self, unknowns: &[f64]) -> (DMatrix<f64>, DVector<f64>) {
        let first = 3 * self.free.len();
        let size = first + self.members.len();
        let (mut slope, mut value) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (i, joint) in self.free.iter().enumerate() {
            let joint = &self.system.joints()[*joint];
            (0..3).for_each(|k| value[3 * i + k] = joint.force_n[k]);
            value[3 * i + 2] -= joint.mass_kg * G;
        }
        for (i, member) in self.members.iter().enumerate() {
            let (own, force, column) =
                (&self.system.members()[*member], unknowns[first + i], first + i);
            let softness = own.stiffness_n.map_or(0.0, |stiff| own.body.length_m() / stiff);
            value[column] = self.beyond(unknowns, *member) - softness * force;
            slope[(column, column)] = -softness;
            for [a, b] in own.spans() {
                let span = minus(self.at(unknowns, b), self.at(unknowns, a));
                let (length, u) = (norm(span), span.map(|x| x / norm(span)));
                let ends = [(a, 1.0), (b, -1.0)].map(|(joint, sign)| (self.row(joint), sign));
                for (row, sign) in ends.iter().filter_map(|(row, sign)| Some(((*row)?, sign))) {
                    for k in 0..3 {
                        value[row + k] += sign * force * u[k];
                        slope[(row + k, column)] += sign * u[k];
                        slope[(column, row + k)] -= sign * u[k];
                        for (other, turn) in ends.iter().filter_map(|(r, s)| Some(((*r)?, s))) {
                            for m in 0..3 {
                                let across = f64::from(u8::from(k == m)) - u[k] * u[m];
                                slope[(row + k, other + m)] -=
                                    sign * turn * force * across / length;
                            }
                        }
                    }
                }
            }
        }
        (slope, value)
    }

    /// Newton's method from a random point.
    pub fn newton(&self, random: &mut ChaCha8Rng) -> Option<Vec<f64>> {
        /// No step is longer, m and N.
        const STEP: f64 = 10.0;
        let places = 3 * self.free.len();
        let mut at: Vec<f64> = (0..places).map(|_| random.random_range(-3.0..3.0)).collect();
        at.extend(self.members.iter().map(|_| random.random_range(-20.0..20.0)));
        let n = at.len();
        for _ in 0..60 {
            let (slope, here) = self.equations(&at);
            if here.iter().all(|x| x.abs() < 1e-11) {
                return Some(at);
            }
            let step = slope.lu().solve(&here)?;
            let far = (0..n).map(|k| step[k].abs()).fold(0.0, f64::max);
            if !far.is_finite() {
                return None;
            }
            let part = (STEP / far).min(1.0);
            (0..n).for_each(|k| at[k] -= part * step[k]);
        }
        None
    }
}
