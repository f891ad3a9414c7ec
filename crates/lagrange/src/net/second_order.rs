//! The second order at an equilibrium: mechanisms, self-stresses, and the Morse index.
//!
//! With $R$ the rows $u_e^T C_e$ of the inextensible taut members, motions that keep all lengths
//! are its kernel (mechanisms), and axial forces that balance without loads the kernel of its
//! transpose (self-stresses). The energy's second derivative among such motions is
//! $\sum C^T \big(\tfrac{N}{d} (1 - u u^T) + \tfrac{1}{c} u u^T\big) C$ on the kernel of $R$.

use matrices::dense::{
    Kernels, MOST_OPEN, eigen, eigenvalues, falls_one_sided, least_one_sided, product, projected,
};
use model::system::Kind;
use nalgebra::{DMatrix, Matrix3, Vector3};

use super::decided::SHARP;
use super::framework::{Framework, Node, across};
use super::law::by_direction;
use super::possible::translations;
use super::solution::{NO_FORCE, limp};
use super::state::State;
use super::stiffness::Stiffness;
use crate::thresholds::{MOST_STEPS, ROUNDED, ZERO};

/// For sparse factors: stiffness along rigid members in units of the largest $|N|/d$. A negative
/// curvature counts as one if it is smaller than this times the squared singular values of the
/// rows.
const RIGID: f64 = 1e6;

#[derive(Default)]
pub(super) struct SecondOrder {
    /// Directions in which the energy falls.
    pub index: usize,
    /// Directions in which it neither falls nor rises.
    pub neutral: usize,
    /// Independent motions that keep all lengths, where they were counted.
    pub mechanisms: Option<usize>,
    /// Basis of the axial forces that balance without loads, one number a member; where it was
    /// found.
    pub self_stresses: Option<Vec<Vec<f64>>>,
    /// Smallest singular value of the rows that counts, and the largest that does not, in units of
    /// the largest; where they were found.
    pub rank_gap: Option<[f64; 2]>,
    /// The same index among the motions in the vertical plane of the system, if there is one.
    pub index_in_plane: Option<usize>,
}

impl SecondOrder {
    /// Of an equilibrium that nothing pushes: with every $N \ge 0$ the second derivative of the
    /// energy is a sum of squares, and only motions without any of them leave it at zero, the
    /// translations of what taut members hold together. Nothing where a member pushes, or where it
    /// is open whether one bears a force.
    pub fn in_tension(framework: &Framework, state: &State) -> Option<Self> {
        let least = NO_FORCE * state.largest_force(framework);
        let open = |k: usize| {
            let held = !framework.moves(&framework.links[k]);
            !held && if state.taut[k] { state.axial[k] <= least } else { state.axial[k] != 0.0 }
        };
        if (0..framework.links.len()).any(open) {
            return None;
        }
        let neutral = translations(framework, |k| state.axial[k] > least);
        let plane = plane(framework, state);
        let planar = plane.is_some_and(|normal| {
            framework.nodes.iter().all(|node| node_in_plane(node, &normal).is_some())
        });
        let index_in_plane = planar.then_some(0);
        Some(Self { index: 0, neutral, index_in_plane, ..Self::default() })
    }

    /// Of an equilibrium; by dense decompositions where the freedoms are at most `dense`.
    pub fn new(
        framework: &Framework,
        stiffness: &mut Stiffness,
        state: &State,
        dense: usize,
    ) -> Self {
        if framework.freedoms() <= dense {
            let state = &with_open(framework, state, true);
            let space = Dense::new(framework, state);
            let (index, neutral) = (space.index(framework, state), space.count.1);
            let index_in_plane = index_in_plane(framework, state, index, |planar| {
                Some(Dense::new(planar, state).index(planar, state))
            });
            let (mechanisms, self_stresses) = (Some(space.mechanisms), Some(space.self_stresses));
            let rank_gap = Some(space.rank_gap);
            return Self { index, neutral, mechanisms, self_stresses, rank_gap, index_in_plane };
        }
        if let Some(known) = Self::in_tension(framework, state) {
            return known;
        }
        let (index, neutral) = sparse(framework, stiffness, state);
        let index_in_plane = index_in_plane(framework, state, index, |planar| {
            let mut stiffness = Stiffness::new(planar, false).ok()?;
            Some(sparse(planar, &mut stiffness, state).0)
        });
        Self { index, neutral, index_in_plane, ..Self::default() }
    }
}

/// One member at an equilibrium.
struct Link {
    u: Vector3<f64>,
    across: f64,
    /// `None` for an inextensible one.
    along: Option<f64>,
    taut: bool,
}

fn links(framework: &Framework, state: &State) -> Vec<Link> {
    let directions = state.directions(framework);
    let links = framework.links.iter().zip(directions).enumerate();
    links
        .map(|(k, (link, (u, length)))| Link {
            u,
            across: if length > 0.0 { state.axial[k] / length } else { 0.0 },
            along: (link.compliance > 0.0).then(|| link.compliance.recip()),
            taut: state.taut[k],
        })
        .collect()
}

/// Index and number of neutral directions from the pivots of two shifted factors. Where the energy rises with all that is open
/// it may yet fall where some of that goes slack.
fn sparse(framework: &Framework, stiffness: &mut Stiffness, state: &State) -> (usize, usize) {
    let open = open(framework, state);
    // Too many to look at count as slack, the worst they can be.
    let few = open.len() <= MOST_OPEN;
    let links = links(framework, &with_open(framework, state, few));
    let largest = links.iter().map(|link| link.across.abs()).fold(0.0, f64::max);
    let along = |link: &Link| link.along.unwrap_or(RIGID * largest);
    let negative = |stiffness: &mut Stiffness, shift: f64| {
        stiffness.assemble_members(framework, |k| {
            let link = &links[k];
            (link.u, link.across, if link.taut { along(link) } else { 0.0 })
        });
        stiffness.shift(shift);
        stiffness.factorise_indefinite();
        stiffness.negative_pivots()
    };
    let flat = ZERO * largest;
    let not_rising = negative(stiffness, -flat);
    let index = negative(stiffness, flat);
    let neutral = not_rising.saturating_sub(index);
    if index > 0 || open.is_empty() || !few {
        return (index, neutral);
    }
    let firsts = (0..framework.nodes.len()).map(|joint| stiffness.first_unknown(joint));
    let firsts: Vec<usize> = firsts.map(Option::unwrap_or_default).collect();
    let rows = outwards(framework, &links, &firsts, &open, RIGID * largest);
    let mut moves = rows.transpose();
    for mut column in moves.column_iter_mut() {
        stiffness.solve(column.as_mut_slice());
    }
    (usize::from(falls_one_sided(&(rows * moves))), neutral)
}

/// The gradients of the lengths of members that are open, positive where they would resist, times the roots of their
/// stiffnesses, of rigid ones this.
fn outwards(
    framework: &Framework,
    links: &[Link],
    first_unknown: &[usize],
    open: &[usize],
    rigid: f64,
) -> DMatrix<f64> {
    let mut rows = gradients(framework, links, first_unknown, open);
    for (mut row, k) in rows.row_iter_mut().zip(open) {
        let outwards = if framework.links[*k].kind == Kind::Strut { -1.0 } else { 1.0 };
        row *= outwards * links[*k].along.unwrap_or(rigid).sqrt();
    }
    rows
}

/// Basis of the axial forces of inextensible taut members that balance without loads.
pub(super) fn self_stresses(framework: &Framework, state: &State) -> Vec<Vec<f64>> {
    Dense::new(framework, state).self_stresses
}

/// Cables and struts that bear no force at just their length, of which it is open whether they are taut.
fn open(framework: &Framework, state: &State) -> Vec<usize> {
    let may_go = |k: &usize| {
        let link = &framework.links[*k];
        link.kind != Kind::Bar && framework.moves(link)
    };
    limp(framework, state, &state.directions(framework)).filter(may_go).collect()
}

/// The state with these taut or slack.
fn with_open(framework: &Framework, state: &State, taut: bool) -> State {
    let mut state = state.clone();
    for k in open(framework, &state) {
        (state.taut[k], state.axial[k]) = (taut, 0.0);
    }
    let members = framework.members();
    state.taut = framework.by_link(state.taut[..members].to_vec());
    state.axial = framework.by_link(state.axial[..members].to_vec());
    state
}

/// Dense decompositions of a small system.
struct Dense {
    count: (usize, usize),
    mechanisms: usize,
    self_stresses: Vec<Vec<f64>>,
    rank_gap: [f64; 2],
    /// Basis of the motions that keep all lengths, and the second derivative among them.
    motions: DMatrix<f64>,
    form: DMatrix<f64>,
    /// A curvature of this size is none.
    flat: f64,
}

/// The gradients of the lengths of some members by the free directions, a row for each.
fn gradients(
    framework: &Framework,
    links: &[Link],
    first_unknown: &[usize],
    members: &[usize],
) -> DMatrix<f64> {
    let mut rows = DMatrix::<f64>::zeros(members.len(), framework.freedoms());
    for (row, &member) in members.iter().enumerate() {
        let spans = framework.rope(&framework.links[member]).map(|rope| rope.spans.as_slice());
        for &k in spans.unwrap_or(&[member]) {
            for (joint, sign) in [(framework.links[k].from, -1.0), (framework.links[k].to, 1.0)] {
                let node = &framework.nodes[joint];
                let along = node.free.components(&links[k].u);
                for axis in 0..node.freedom() {
                    rows[(row, first_unknown[joint] + axis)] += sign * along[axis];
                }
            }
        }
    }
    rows
}

impl Dense {
    fn new(framework: &Framework, state: &State) -> Self {
        let links = links(framework, state);
        let first_unknown = first_unknowns(framework);
        let size = framework.freedoms();
        // Its answer would count for nothing after that.
        framework.work.spend(size * size);
        let members = 0..framework.members();
        let rigid: Vec<usize> =
            members.filter(|&k| links[k].taut && links[k].along.is_none()).collect();
        let rows = gradients(framework, &links, &first_unknown, &rigid);
        // A decomposition that fails says nothing: every direction counts as one that is free, and neutral.
        let kernels = Kernels::at_scale(&rows, SHARP, 1.0);
        let rank_gap = kernels.as_ref().map_or([1.0, 0.0], |kernels| kernels.gap);
        let (motions, stresses) = kernels.map_or_else(
            || (DMatrix::identity(size, size), DMatrix::zeros(rigid.len(), 0)),
            |kernels| (kernels.right(), kernels.left()),
        );
        let mut hessian = DMatrix::<f64>::zeros(size, size);
        let is_rope = |k: usize| framework.links[k].rope.is_some();
        for (k, link) in links.iter().enumerate() {
            let along = link.along.filter(|_| link.taut && !is_rope(k)).unwrap_or(0.0);
            add(
                framework,
                &first_unknown,
                &mut hessian,
                k,
                &by_direction(&link.u, link.across, along),
            );
        }
        let springs: Vec<usize> = framework.ropes.iter().map(|rope| rope.spans[0]).collect();
        let springs: Vec<usize> =
            springs.into_iter().filter(|k| links[*k].taut && links[*k].along.is_some()).collect();
        let ropes = gradients(framework, &links, &first_unknown, &springs);
        let stiffness = DMatrix::from_fn(springs.len(), size, |row, column| {
            links[springs[row]].along.unwrap_or(0.0) * ropes[(row, column)]
        });
        hessian += product(&ropes.transpose(), &stiffness);
        let largest = links.iter().map(|link| link.across.abs()).fold(0.0, f64::max);
        let stiffest = links.iter().filter_map(|link| link.along).fold(0.0, f64::max);
        let flat = (ZERO * largest).max(ROUNDED * stiffest);
        let form = projected(&hessian, &motions);
        let mut curvatures = eigenvalues(&form).unwrap_or_else(|| vec![0.0; form.nrows()]);
        if stresses.ncols() > 0 && curvatures.iter().any(|c| *c < -flat) {
            let of = (framework, links.as_slice(), first_unknown.as_slice(), rigid.as_slice());
            curvatures = stiffened(of, &motions, &stresses, form.clone()).unwrap_or(curvatures);
        }
        let index = curvatures.iter().filter(|c| **c < -flat).count();
        let neutral = curvatures.iter().filter(|c| c.abs() <= flat).count();
        let self_stresses = (0..stresses.ncols())
            .map(|column| {
                let mut forces = vec![0.0; framework.members()];
                for (row, &k) in rigid.iter().enumerate() {
                    forces[k] = stresses[(row, column)];
                }
                framework.by_link(forces)
            })
            .collect();
        let (count, mechanisms) = ((index, neutral), motions.ncols());
        Self { count, mechanisms, self_stresses, rank_gap, motions, form, flat }
    }

    /// The number of directions in which the energy falls, of what is taut with all that is open: where it rises it may yet
    /// fall where some of that goes slack.
    fn index(&self, framework: &Framework, state: &State) -> usize {
        let open = open(framework, state);
        if open.is_empty() || self.count.0 > 0 {
            return self.count.0;
        }
        let slack = Self::new(framework, &with_open(framework, state, false));
        let links = links(framework, state);
        let largest = links.iter().map(|link| link.across.abs()).fold(0.0, f64::max);
        let firsts = first_unknowns(framework);
        let rows = outwards(framework, &links, &firsts, &open, RIGID * largest) * &slack.motions;
        usize::from(least_one_sided(&slack.form, &rows) < -slack.flat)
    }
}

/// Curvatures along mechanisms with the self-stresses of rigid bars that stiffen them most: a
/// minimum on the lengths needs some forces that make it one, not those that are shown
/// (Connelly and Whiteley 1996). Steps along the gradient of the least curvature, which is concave
/// in the self-stresses. `None` where a self-stress has a member with a sign, or nothing is gained.
fn stiffened(
    (framework, links, first_unknown, rigid): (&Framework, &[Link], &[usize], &[usize]),
    motions: &DMatrix<f64>,
    stresses: &DMatrix<f64>,
    mut form: DMatrix<f64>,
) -> Option<Vec<f64>> {
    let signed = |k: &usize| framework.links[*k].kind != Kind::Bar;
    if rigid.iter().any(signed) || !framework.lying.is_empty() {
        return None;
    }
    let size = motions.nrows();
    let by_stress = |column: usize| {
        let mut hessian = DMatrix::<f64>::zeros(size, size);
        for (row, &k) in rigid.iter().enumerate() {
            if framework.ends_move(&framework.links[k]) {
                let across = stresses[(row, column)] / framework.links[k].length;
                let block = by_direction(&links[k].u, across, 0.0);
                add(framework, first_unknown, &mut hessian, k, &block);
            }
        }
        projected(&hessian, motions)
    };
    let changes: Vec<DMatrix<f64>> = (0..stresses.ncols()).map(by_stress).collect();
    // Each at least halves what is left of one.
    for _ in 0..MOST_STEPS {
        let (values, vectors) = eigen(&form)?;
        let weakest = vectors.columns(0, 1).into_owned();
        if values[0] >= 0.0 {
            break;
        }
        let slopes: Vec<f64> =
            changes.iter().map(|change| projected(change, &weakest)[0]).collect();
        let square: f64 = slopes.iter().map(|slope| slope * slope).sum();
        if square <= ZERO * ZERO {
            return None;
        }
        // To twice the way at which the weakest one alone were zero.
        for (slope, change) in slopes.iter().zip(&changes) {
            form += change * (-2.0 * values[0] * slope / square);
        }
    }
    eigenvalues(&form)
}

/// First unknown of each joint.
fn first_unknowns(framework: &Framework) -> Vec<usize> {
    let nodes = framework.nodes.iter();
    nodes
        .scan(0, |next, node| {
            let first = *next;
            *next += node.freedom();
            Some(first)
        })
        .collect()
}

/// Add the block of a member to a dense matrix.
fn add(
    framework: &Framework,
    first_unknown: &[usize],
    matrix: &mut DMatrix<f64>,
    member: usize,
    block: &Matrix3<f64>,
) {
    let link = &framework.links[member];
    let ends = [(link.from, -1.0), (link.to, 1.0)];
    for (one, sign_one) in ends {
        for (other, sign_other) in ends {
            let (a, b) = (&framework.nodes[one], &framework.nodes[other]);
            let part = a.free.axes().tr_mul(block) * b.free.axes() * (sign_one * sign_other);
            for row in 0..a.freedom() {
                for column in 0..b.freedom() {
                    matrix[(first_unknown[one] + row, first_unknown[other] + column)] +=
                        part[(row, column)];
                }
            }
        }
    }
}

/// The index among the motions in the vertical plane of all joints, loads and supports, that among all where there are no
/// others.
fn index_in_plane(
    framework: &Framework,
    state: &State,
    index: usize,
    of: impl FnOnce(&Framework) -> Option<usize>,
) -> Option<usize> {
    let normal = plane(framework, state)?;
    let mut planar = framework.clone();
    for node in &mut planar.nodes {
        *node = node_in_plane(node, &normal)?;
    }
    if planar.freedoms() == framework.freedoms() { Some(index) } else { of(&planar) }
}

/// Normal of the vertical plane of all joints and loads.
fn plane(framework: &Framework, state: &State) -> Option<Vector3<f64>> {
    let origin = state.places.first()?;
    let squares = state.places.iter().map(|p| (p - origin).norm_squared());
    let extent = squares.fold(0.0, f64::max).sqrt();
    let flat = |v: Vector3<f64>| Vector3::new(v.x, v.y, 0.0);
    let mut spread = state.places.iter().map(|p| flat(p - origin));
    let mut loads = framework.nodes.iter().map(|node| flat(node.load));
    let squares = framework.nodes.iter().map(|node| node.load.norm_squared());
    let largest = squares.fold(0.0, f64::max).sqrt();
    let mut along = widest(spread.clone());
    if along.norm() <= ZERO * extent {
        along = widest(loads.clone());
        if along.norm() <= ZERO * largest {
            along = Vector3::x();
        }
    }
    let normal = Vector3::z().cross(&along).normalize();
    let lies = spread.all(|p| p.dot(&normal).abs() <= ZERO * extent)
        && loads.all(|f| f.dot(&normal).abs() <= ZERO * largest);
    lies.then_some(normal)
}

/// The longest of some vectors.
fn widest(vectors: impl Iterator<Item = Vector3<f64>>) -> Vector3<f64> {
    let none = (Vector3::zeros(), 0.0);
    let longer = |widest: (Vector3<f64>, f64), v: Vector3<f64>| {
        let square = v.norm_squared();
        if square > widest.1 { (v, square) } else { widest }
    };
    vectors.fold(none, longer).0
}

/// A joint with only its motions in a plane; nothing when its support is oblique to the plane.
fn node_in_plane(node: &Node, normal: &Vector3<f64>) -> Option<Node> {
    let axes = node.free.axes();
    let free = axes * axes.transpose();
    let out = free * normal;
    // The normal is free, or held, or the support is oblique.
    let rate = out.dot(normal);
    let oblique = (out - normal * rate).norm() > ZERO || (rate > ZERO && rate < 1.0 - ZERO);
    if oblique {
        return None;
    }
    Some(Node { free: node.free.within(across(normal)), ..node.clone() })
}

#[cfg(test)]
mod tests;
