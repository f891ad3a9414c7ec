//! Prestress stability: whether a stress holds what lengths alone do not.
//!
//! With the members' directions $u_e$ the motions of the joints that keep all lengths to first
//! order are the kernel of the rigidity matrix $R$, the axial forces that balance without loads the
//! kernel of its transpose. A motion $v$ of that kernel changes the energy by
//!
//! $$ \tfrac12 \sum_e w_e\\,|v_b - v_a|^2, \qquad w_e = N_e/d_e , $$
//!
//! to second order, whatever the stiffnesses; of a rope each of its spans adds that of its motion across
//! itself, $|v|^2 - (u \cdot v)^2$. A framework is *prestress stable* where a stress that
//! its members can bear (cables pull, struts push) makes this positive for every such motion. It is
//! *super stable* where the stress matrix $\Omega = C^T \mathrm{diag}(w)\\,C$ over all joints is
//! positive semidefinite with no more than the affine motions in its kernel, and no affine motion
//! keeps all lengths: then no other shape of its members exists in any dimension. Of ropes over rings that does
//! not follow, and is not claimed.
//!
//! R. Connelly and W. Whiteley, SIAM J. Discrete Math. 9 (1996) 453-491,
//! doi:10.1137/S0895480192229236; R. Connelly, Invent. Math. 66 (1982) 11-33,
//! doi:10.1007/BF01404753; S. Pellegrino and C. R. Calladine, Int. J. Solids Struct. 22 (1986)
//! 409-428, doi:10.1016/0020-7683(86)90014-4

use matrices::dense::{Kernels, eigen, eigenvalues};
use model::Vector;
use model::system::{Kind, Support, System};

use super::family::normalised;
use nalgebra::DMatrix;
use numerics::vector::{cross, dot, minus, norm, times};

/// Coordinates up to which it is decided: dense decompositions.
const COUNTED: usize = 300;
/// Singular values below this part of the largest are zero, and eigenvalues below this part of the
/// largest force density.
const ZERO: f64 = 1e-9;
/// Steps of the ascent that looks for a stress among several: enough for the towers of the tests
/// by a factor of ten, and some milliseconds.
const STEPS: u32 = 2000;

/// The entries of a symmetric matrix, of a quadratic form in space.
const FORMS: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// What keeps the whole in its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// Its supports.
    Supported,
    /// Nothing: supports are not looked at, motions of the whole as one body are not counted.
    Free,
}

/// The stress that is to hold a framework.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stress<'a> {
    /// These axial forces, N, tension positive.
    Given(&'a [f64]),
    /// Any self-stress that the kinds of the members allow.
    Free,
}

/// What holds a framework.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Held {
    /// No motion keeps all lengths to first order: no stress is needed.
    ByLengths,
    /// The stress resists every such motion; of those of unit size the softest with this
    /// stiffness, N/m. Of a free stress the largest force is 1 N.
    ByStress {
        /// Second derivative of the energy along the softest motion.
        stiffness_n_m: f64,
    },
    /// The stress does not: its stiffness against the softest motion, zero or negative, N/m.
    NotByThis {
        /// Second derivative of the energy along the softest motion.
        stiffness_n_m: f64,
    },
    /// No stress that holds it was found among those that the members bear; where there is only
    /// one, there is none.
    NotFound,
}

/// How a framework is held at a configuration.
#[derive(Debug, Clone, PartialEq)]
pub struct PrestressStability {
    /// Independent axial forces that balance without loads.
    pub self_stresses: usize,
    /// Independent motions that keep all lengths to first order.
    pub mechanisms: usize,
    /// Whether they are resisted.
    pub held: Held,
    /// The axial forces that hold it, N: those given, or those found, the largest of 1 N.
    pub stress: Option<Vec<f64>>,
    /// Whether it is super stable under this stress.
    pub super_stable: bool,
}

/// Decide prestress stability of the members of a system at these places, all of them taken as
/// keeping their lengths. Nothing where there is not a place for each joint and a force for each
/// member, a member has no length, or the system is larger than some hundred joints.
///
/// ```
/// use model::cases::tensegrities;
/// use validate::systems::{Held, Standing, Stress, prestress_stability};
/// // A square of cables around two crossed struts: flexible out of its plane, held by its stress.
/// let cross = tensegrities()[0].system();
/// let at = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 0.0, 2.0], [0.0, 0.0, 2.0]];
/// let held = prestress_stability(&cross, &at, Standing::Free, Stress::Free).unwrap();
/// assert_eq!((held.self_stresses, held.mechanisms, held.super_stable), (1, 1, true));
/// assert!(matches!(held.held, Held::ByStress { .. }));
/// ```
pub fn prestress_stability(
    system: &System,
    joints_m: &[Vector],
    standing: Standing,
    stress: Stress<'_>,
) -> Option<PrestressStability> {
    let geometry = Geometry::new(system, joints_m, standing)?;
    let (mechanisms, self_stresses) = geometry.kernels()?;
    let form = Form::new(system, &geometry, &mechanisms);
    let known = match stress {
        Stress::Given(axial) if axial.len() != system.members().len() => return None,
        Stress::Given(axial) => Some(axial.to_vec()),
        Stress::Free => form.search(system, &self_stresses),
    };
    let held = match (&known, stress) {
        _ if form.motions == 0 => Held::ByLengths,
        (Some(axial), stress) => {
            let stiffness_n_m = form.softest(axial)?.0;
            match stress {
                _ if stiffness_n_m > form.zero(axial) => Held::ByStress { stiffness_n_m },
                Stress::Given(_) => Held::NotByThis { stiffness_n_m },
                Stress::Free => Held::NotFound,
            }
        }
        (None, _) => Held::NotFound,
    };
    let super_stable = !system.has_ropes()
        && known.as_deref().is_some_and(|axial| {
            bears(system, axial) && geometry.super_stable(system, axial) == Some(true)
        });
    let (self_stresses, mechanisms) = (self_stresses.len(), form.motions);
    Some(PrestressStability { self_stresses, mechanisms, held, stress: known, super_stable })
}

/// Whether cables pull and struts push, to rounding.
fn bears(system: &System, axial: &[f64]) -> bool {
    let least = ZERO * axial.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
    system.members().iter().zip(axial).all(|(member, n)| sign(member.kind) * n >= -least)
}

/// What the force of a kind is multiplied with to be positive; zero where both signs are right.
fn sign(kind: Kind) -> f64 {
    match kind {
        Kind::Bar => 0.0,
        Kind::Cable => 1.0,
        Kind::Strut => -1.0,
    }
}

/// Members and motions at a configuration.
struct Geometry<'a> {
    joints_m: &'a [Vector],
    /// The spans of each member: their joints, unit vectors and lengths.
    members: Vec<Vec<([usize; 2], Vector, f64)>>,
    /// Directions of the coordinates: number of the joint, and axis.
    coordinates: Vec<(usize, Vector)>,
    standing: Standing,
}

impl<'a> Geometry<'a> {
    fn new(system: &System, joints_m: &'a [Vector], standing: Standing) -> Option<Self> {
        let finite = joints_m.iter().flatten().all(|x| x.is_finite());
        if joints_m.len() != system.joints().len() || !finite {
            return None;
        }
        let free = |support: &Support| match standing {
            Standing::Supported => support.motions(),
            Standing::Free => Support::Free.motions(),
        };
        let joints = system.joints().iter().enumerate();
        let coordinates: Vec<_> = joints
            .flat_map(|(k, joint)| free(&joint.support).into_iter().map(move |axis| (k, axis)))
            .collect();
        if coordinates.is_empty() || coordinates.len() > COUNTED {
            return None;
        }
        let span = |[a, b]: [usize; 2]| {
            let d = minus(joints_m[b], joints_m[a]);
            let length = norm(d);
            (length > 0.0).then(|| ([a, b], times(1.0 / length, d), length))
        };
        let members = system.members().iter().map(|member| member.spans().map(span).collect());
        Some(Self { joints_m, members: members.collect::<Option<_>>()?, coordinates, standing })
    }

    /// Bases of the motions that keep all lengths, by columns, and of the self-stresses.
    fn kernels(&self) -> Option<(DMatrix<f64>, Vec<Vec<f64>>)> {
        let (rows, columns) = (self.members.len(), self.coordinates.len());
        let entry = |row: usize, column: usize| {
            let (joint, axis) = self.coordinates[column];
            let is = |end: usize| f64::from(u8::from(joint == end));
            let spans = self.members[row].iter();
            spans.map(|([a, b], along, _)| dot(*along, axis) * (is(*b) - is(*a))).sum::<f64>()
        };
        let lengths = DMatrix::from_fn(rows, columns, entry);
        let stresses = Kernels::new(&lengths, ZERO)?.left();
        let stresses = stresses.column_iter().map(|stress| stress.iter().copied().collect());
        let body = self.body_motions();
        let fixed = DMatrix::from_fn(rows + body.len(), columns, |row, column| {
            if row < rows { entry(row, column) } else { body[row - rows][column] }
        });
        Some((Kernels::new(&fixed, ZERO)?.right(), stresses.collect()))
    }

    /// Motions of the whole as one body, about its middle, where nothing supports it.
    fn body_motions(&self) -> Vec<Vec<f64>> {
        if self.standing == Standing::Supported {
            return vec![];
        }
        let count = self.joints_m.len() as f64;
        let middle = [0, 1, 2].map(|c| self.joints_m.iter().map(|x| x[c]).sum::<f64>() / count);
        let size = self.joints_m.iter().map(|x| norm(minus(*x, middle))).fold(0.0, f64::max);
        let axes = Support::Free.motions();
        let field = |at: &dyn Fn(usize) -> Vector| {
            self.coordinates.iter().map(|(joint, axis)| dot(*axis, at(*joint))).collect()
        };
        let shifts = axes.iter().map(|shift| field(&|_| *shift));
        let arm = |joint: usize| times(1.0 / size, minus(self.joints_m[joint], middle));
        let turns = axes.iter().map(|about| field(&|joint| cross(*about, arm(joint))));
        shifts.chain(turns).collect()
    }

    /// Whether the stress matrix of these forces proves that no other shape exists.
    fn super_stable(&self, system: &System, axial: &[f64]) -> Option<bool> {
        let joints = system.joints().len();
        let mut stress = DMatrix::<f64>::zeros(joints, joints);
        let mut largest: f64 = 0.0;
        let spans = || self.members.iter().flatten();
        for (([from, to], _, length), axial) in spans().zip(axial) {
            let density = axial / length;
            largest = largest.max(density.abs());
            stress[(*from, *from)] += density;
            stress[(*to, *to)] += density;
            stress[(*from, *to)] -= density;
            stress[(*to, *from)] -= density;
        }
        let values = eigenvalues(&stress)?;
        let zero = ZERO * largest;
        let null = values.iter().filter(|value| value.abs() <= zero).count();
        // Affine functions of the places: the constant, and as many as the joints span directions.
        let places = DMatrix::from_fn(joints, 3, |k, c| self.joints_m[k][c] - self.joints_m[0][c]);
        let span = Kernels::new(&places, ZERO)?.rank;
        // An affine motion keeps a length if its quadratic form vanishes on the direction.
        let along: Vec<Vector> = spans().map(|(_, along, _)| *along).collect();
        let conic = DMatrix::from_fn(along.len(), FORMS.len(), |row, k| {
            let (i, j) = FORMS[k];
            along[row][i] * along[row][j]
        });
        let no_affine_motion = Kernels::new(&conic, ZERO)?.rank == span * (span + 1) / 2;
        let semidefinite = values.iter().all(|value| *value >= -zero);
        Some(largest > 0.0 && semidefinite && null == span + 1 && no_affine_motion)
    }
}

/// The second derivative of the energy by the motions that keep the lengths.
struct Form {
    motions: usize,
    /// Of each member, the matrix of its |v_b - v_a|² across itself by these motions, over its length.
    by_force: Vec<DMatrix<f64>>,
    lengths: Vec<f64>,
}

impl Form {
    fn new(system: &System, geometry: &Geometry<'_>, motions: &DMatrix<f64>) -> Self {
        let mut moves = vec![vec![[0.0; 3]; motions.ncols()]; system.joints().len()];
        for (row, (joint, axis)) in geometry.coordinates.iter().enumerate() {
            for (k, place) in moves[*joint].iter_mut().enumerate() {
                *place = std::array::from_fn(|c| place[c] + motions[(row, k)] * axis[c]);
            }
        }
        let of_span = |([from, to], along, length): &([usize; 2], Vector, f64)| {
            let across = moves[*to].iter().zip(&moves[*from]).map(|(b, a)| {
                let apart = minus(*b, *a);
                minus(apart, times(dot(apart, *along), *along))
            });
            let across: Vec<Vector> = across.collect();
            DMatrix::from_fn(across.len(), across.len(), |i, k| dot(across[i], across[k]) / length)
        };
        let by_force = geometry.members.iter().map(|spans| {
            let zero = DMatrix::zeros(motions.ncols(), motions.ncols());
            spans.iter().map(of_span).fold(zero, |sum, span| sum + span)
        });
        let shortest = |spans: &Vec<([usize; 2], Vector, f64)>| {
            spans.iter().map(|(.., length)| *length).fold(f64::INFINITY, f64::min)
        };
        let lengths = geometry.members.iter().map(shortest).collect();
        Self { motions: motions.ncols(), by_force: by_force.collect(), lengths }
    }

    /// Rounding of an eigenvalue under these forces.
    fn zero(&self, axial: &[f64]) -> f64 {
        let densities = axial.iter().zip(&self.lengths).map(|(n, length)| n.abs() / length);
        ZERO * densities.fold(0.0, f64::max)
    }

    /// The least eigenvalue under these forces and its gradient by them.
    fn softest(&self, axial: &[f64]) -> Option<(f64, Vec<f64>)> {
        let mut form = DMatrix::<f64>::zeros(self.motions, self.motions);
        for (by_force, axial) in self.by_force.iter().zip(axial) {
            form += by_force * *axial;
        }
        let (values, vectors) = eigen(&form)?;
        let softest = vectors.column(0);
        let along = |matrix: &DMatrix<f64>| softest.dot(&(matrix * softest));
        Some((*values.first()?, self.by_force.iter().map(along).collect()))
    }

    /// A self-stress that the members bear and that resists every motion, the largest force 1: by
    /// ascent of the concave least eigenvalue, over the cone of the signs.
    fn search(&self, system: &System, basis: &[Vec<f64>]) -> Option<Vec<f64>> {
        let combined = |z: &[f64]| -> Vec<f64> {
            let force = |e: usize| z.iter().zip(basis).map(|(z, stress)| z * stress[e]).sum();
            (0..self.by_force.len()).map(force).collect()
        };
        let onto = |gradient: &[f64]| -> Vec<f64> {
            let part = |stress: &Vec<f64>| stress.iter().zip(gradient).map(|(s, g)| s * g).sum();
            basis.iter().map(part).collect()
        };
        let mut best: Option<(f64, Vec<f64>)> = None;
        // What all members together would like: cables pull, struts push.
        let wish: Vec<f64> = system.members().iter().map(|member| sign(member.kind)).collect();
        let mut z = normalised(&onto(&wish)).or_else(|| normalised(&vec![1.0; basis.len()]))?;
        // Of one stress there are two directions, and nothing between them.
        let steps = if basis.len() == 1 { 2 } else { STEPS };
        for step in 1..=steps {
            let axial = scaled(combined(&z))?;
            let signs = system.members().iter().zip(&axial).map(|(m, n)| sign(m.kind) * n);
            let (worst, margin) = signs.enumerate().min_by(|a, b| a.1.total_cmp(&b.1))?;
            let uphill = if margin < -ZERO {
                let mut only = vec![0.0; axial.len()];
                only[worst] = sign(system.members()[worst].kind);
                onto(&only)
            } else {
                let (stiffness, gradient) =
                    if self.motions == 0 { (0.0, vec![]) } else { self.softest(&axial)? };
                if best.as_ref().is_none_or(|(most, _)| stiffness > *most) {
                    best = Some((stiffness, axial));
                }
                if self.motions == 0 {
                    break;
                }
                onto(&gradient)
            };
            if basis.len() == 1 {
                z = vec![-z[0]];
                continue;
            }
            let Some(uphill) = normalised(&uphill) else { break };
            let part = 1.0 / f64::from(step).sqrt();
            let next: Vec<f64> = z.iter().zip(&uphill).map(|(z, up)| z + part * up).collect();
            z = normalised(&next)?;
        }
        best.map(|(_, axial)| axial)
    }
}

/// Forces with the largest made one; nothing where all vanish.
fn scaled(axial: Vec<f64>) -> Option<Vec<f64>> {
    let largest = axial.iter().fold(0.0, |most: f64, n| most.max(n.abs()));
    (largest > 0.0).then(|| axial.into_iter().map(|n| n / largest).collect())
}

#[cfg(test)]
mod tests;
