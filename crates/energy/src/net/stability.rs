//! The second derivative of the energy at an equilibrium, on the motions that keep the lengths.
//!
//! Small systems: an orthonormal basis of those motions from the singular values of the rigidity
//! matrix, whose rank also counts self-stresses and mechanisms, and the eigenvalues of the second
//! derivative in that basis. Large ones: the signs of the pivots of the sparse matrix with stiff
//! springs for the lengths.

use matrices::dense::{Kernels, MOST_OPEN, eigenvalues, falls_one_sided, least_one_sided};
use model::system::Kind;
use model::{Rigidity, Vector};
use nalgebra::DMatrix;

use crate::net::factor::Factor;
use crate::net::frame::{Frame, Rod, Spot};
use crate::net::law::Excess;
use crate::net::limit::{Limit, stressed};
use crate::net::polish::STIFF_STRAIN;
use crate::net::shape::{Shape, largest};
use crate::thresholds::ZERO;
use crate::vector::{along, cross, dot, norm, unit};

/// Coordinates up to which dense matrices serve.
pub(super) const DENSE: usize = 240;

/// The second order at an equilibrium.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct SecondOrder {
    pub(super) index: usize,
    pub(super) neutral: usize,
    pub(super) index_in_plane: Option<usize>,
    pub(super) rigidity: Option<Rigidity>,
    /// Orthonormal self-stresses, one force for each member; none where forces are unique or not
    /// counted.
    pub(super) self_stresses: Vec<Vec<f64>>,
    /// Largest over smallest eigenvalue that is not zero, by magnitude.
    pub(super) condition: f64,
}

/// The second order at an equilibrium, by dense matrices up to so many coordinates.
pub(super) fn second_order(
    frame: &Frame,
    shape: &Shape,
    limit: Option<&Limit>,
    factor: &mut Factor,
    most: usize,
) -> SecondOrder {
    let (index, neutral, condition, rigidity, self_stresses) = if frame.freedom <= most {
        let dense = Dense::read(frame, shape, limit);
        let Count { index, neutral, condition, .. } = dense.count();
        (index, neutral, condition, Some(dense.rigidity), dense.self_stresses(frame))
    } else {
        let (index, neutral) = sparse(frame, shape, factor);
        (index, neutral, 1.0, None, Vec::new())
    };
    let index_in_plane = index_in_plane(frame, shape, limit, most, index);
    SecondOrder { index, neutral, index_in_plane, rigidity, self_stresses, condition }
}

/// Whether a member resists in this equilibrium.
fn resists(frame: &Frame, shape: &Shape, rod: usize) -> bool {
    frame.rods[rod].resists(shape.force[rod])
}

/// Index among the motions in the vertical plane of the system, if there is one; that among all where there are no others.
fn index_in_plane(
    frame: &Frame,
    shape: &Shape,
    limit: Option<&Limit>,
    most: usize,
    index: usize,
) -> Option<usize> {
    let spots = plane_spots(frame, shape)?;
    let mut freedom = 0;
    let spots: Vec<Spot> = spots
        .into_iter()
        .map(|spot| {
            let first = freedom;
            freedom += spot.freedom;
            Spot { first, ..spot }
        })
        .collect();
    if freedom == frame.freedom {
        return Some(index);
    }
    let flat = Frame { spots, freedom, ..frame.clone() };
    if freedom <= most {
        return Some(Dense::read(&flat, shape, limit).count().index);
    }
    let mut factor = Factor::new(&flat.spots, &flat.rods, &flat.meter).ok()?;
    Some(sparse(&flat, shape, &mut factor).0)
}

/// Index and number of neutral directions by the signs of pivots.
fn sparse(frame: &Frame, shape: &Shape, factor: &mut Factor) -> (usize, usize) {
    let open = open(frame, shape);
    // Too many to look at count as slack, the worst they can be.
    let few = open.len() <= MOST_OPEN;
    let shape = &opened(frame, shape, &open, if few { f64::MIN_POSITIVE } else { 0.0 });
    let neutral = below(frame, shape, factor, -ZERO, false);
    let index = below(frame, shape, factor, ZERO, false);
    let neutral = neutral.saturating_sub(index);
    if index > 0 || open.is_empty() || !few {
        return (index, neutral);
    }
    let mut rows = rows(frame, &frame.excesses(&shape.x), &open);
    let force = frame.largest_force(&shape.force);
    for (mut row, e) in rows.row_iter_mut().zip(&open) {
        let outwards = if frame.rods[*e].kind == Kind::Strut { -1.0 } else { 1.0 };
        row *= outwards * soft_stiffness(&frame.rods[*e], force).sqrt();
    }
    let mut moves = rows.transpose();
    for mut column in moves.column_iter_mut() {
        factor.solve(column.as_mut_slice());
    }
    (usize::from(falls_one_sided(&(rows * moves))), neutral)
}

/// The joints with their motions in the vertical plane that holds places, loads and supports.
fn plane_spots(frame: &Frame, shape: &Shape) -> Option<Vec<Spot>> {
    let horizontal = |v: &Vector| [v[0], v[1], 0.0];
    let longest = |vectors: &[Vector]| {
        let flat = vectors.iter().map(horizontal);
        flat.max_by(|a, b| norm(*a).total_cmp(&norm(*b))).unwrap_or_default()
    };
    let origin = shape.x[0];
    let places: Vec<Vector> = shape.x.iter().map(|x| along(*x, -1.0, origin)).collect();
    let (place, load) = (longest(&places), longest(&frame.loads));
    let extent = largest(&places.iter().map(|place| norm(*place)).collect::<Vec<f64>>());
    let small = ZERO * extent.max(1.0);
    let direction = if norm(place) > small {
        unit(place)?
    } else if norm(load) > ZERO {
        unit(load)?
    } else {
        [1.0, 0.0, 0.0]
    };
    let up = [0.0, 0.0, 1.0];
    let normal = cross(direction, up);
    let flat = places.iter().all(|place| dot(*place, normal).abs() <= small)
        && frame.loads.iter().all(|load| dot(*load, normal).abs() <= ZERO);
    if !flat {
        return None;
    }
    frame.spots.iter().map(|spot| in_plane(spot, direction, up, normal)).collect()
}

/// A joint with its motions in a plane; nothing where its support is oblique to the plane.
fn in_plane(spot: &Spot, direction: Vector, up: Vector, normal: Vector) -> Option<Spot> {
    let zero = [0.0; 3];
    let (freedom, axes) = match spot.freedom {
        0 => (0, [zero; 3]),
        1 => match dot(spot.axes[0], normal).abs() {
            out if out < ZERO => (1, spot.axes),
            out if out > 1.0 - ZERO => (0, [zero; 3]),
            _ => return None,
        },
        2 => {
            let held = cross(spot.axes[0], spot.axes[1]);
            match dot(held, normal).abs() {
                out if out < ZERO => (1, [unit(cross(held, normal))?, zero, zero]),
                out if out > 1.0 - ZERO => (2, [direction, up, zero]),
                _ => return None,
            }
        }
        _ => (2, [direction, up, zero]),
    };
    Some(Spot { first: 0, freedom, axes })
}

/// Number of eigenvalues below minus a shift, over the size of the matrix, by the signs of pivots;
/// `exact`ly of elastic members, or of these with a spring in series that keeps stiff ones near the
/// others.
pub(super) fn below(
    frame: &Frame,
    shape: &Shape,
    factor: &mut Factor,
    shift: f64,
    exact: bool,
) -> usize {
    let excess = frame.excesses(&shape.x);
    let force = frame.largest_force(&shape.force);
    let block = |e: usize| {
        let rod = &frame.rods[e];
        let stiffness = match resists(frame, shape, e) {
            true if exact && rod.elastic() => rod.flexibility.recip(),
            true => soft_stiffness(rod, force),
            false => 0.0,
        };
        excess[e].block(shape.force[e], stiffness)
    };
    let sizes = frame.sizes(|_| force);
    frame.fill(factor, block, |joint| shift * sizes[joint]);
    // The rule, and the cheaper factorisation.
    if factor.definite() {
        return 0;
    }
    factor.negative_pivots().unwrap_or(0)
}

/// The stiffness of a member with a spring in series that keeps stiff ones near the others, by the largest force.
fn soft_stiffness(rod: &Rod, largest: f64) -> f64 {
    let spring = largest / STIFF_STRAIN / rod.length;
    spring / (1.0 + spring * rod.flexibility)
}

/// Cables, struts and the floor where they are just taut: the sign of their force is rounding.
fn open(frame: &Frame, shape: &Shape) -> Vec<usize> {
    let none = ZERO * frame.largest_force(&shape.force);
    let open = frame.rods.iter().enumerate().filter(|(e, rod)| {
        let reaches = || frame.excess(&shape.x, *e).value.abs() <= ZERO * rod.length;
        let may_go = rod.kind != Kind::Bar && !frame.is_held(rod) && !frame.again(*e);
        may_go && shape.force[*e].abs() <= none && reaches()
    });
    open.map(|(e, _)| e).collect()
}

/// The shape with these pulled or pushed by so much, zero where they are slack.
fn opened(frame: &Frame, shape: &Shape, open: &[usize], force: f64) -> Shape {
    let mut shape = shape.clone();
    for e in open {
        shape.force[*e] = if frame.rods[*e].kind == Kind::Cable { force } else { -force };
    }
    frame.spread(&mut shape.force);
    shape
}

/// The derivatives of the lengths of some members by the coordinates, a row each.
pub(super) fn rows(frame: &Frame, excess: &[Excess], taut: &[usize]) -> DMatrix<f64> {
    let mut rows = DMatrix::<f64>::zeros(taut.len(), frame.freedom);
    for (row, e) in taut.iter().enumerate() {
        let strands = match frame.rods[*e].rope {
            0 => std::slice::from_ref(e),
            rope => &frame.ropes[rope as usize - 1],
        };
        for &e in strands {
            let rod = &frame.rods[e];
            // Of unit length also where the member is not quite as long as it should be.
            let direction = unit(excess[e].gradient).unwrap_or(excess[e].gradient);
            for (joint, sign) in [(rod.from, -1.0), (rod.to, 1.0)] {
                let spot = &frame.spots[joint];
                for k in 0..spot.freedom {
                    rows[(row, spot.first + k)] += sign * dot(direction, spot.axes[k]);
                }
            }
        }
    }
    rows
}

/// What the eigenvalues of the second derivative say.
pub(super) struct Count {
    /// Negative ones.
    pub(super) index: usize,
    /// Those that vanish.
    pub(super) neutral: usize,
    /// Ratio of the largest to the smallest that does not vanish, by magnitude.
    pub(super) condition: f64,
    pub(super) nearest_to_zero: Option<f64>,
}

/// Dense matrices at an equilibrium.
pub(super) struct Dense {
    /// The second derivative on the motions that keep the lengths.
    hessian: DMatrix<f64>,
    /// Size of the second derivative.
    size: f64,
    /// Basis of the self-stresses by rows, one column for each inextensible member that resists.
    stresses: DMatrix<f64>,
    /// Those members.
    taut: Vec<usize>,
    rigidity: Rigidity,
    /// Basis of the motions that keep the lengths.
    motions: DMatrix<f64>,
    /// The index where some members have just their length, and resist on one side alone.
    one_sided: Option<usize>,
}

impl Dense {
    /// As a shape that is overdetermined is read, if it is one.
    pub(super) fn read(frame: &Frame, shape: &Shape, limit: Option<&Limit>) -> Self {
        let (shape, taut, zero) = if let Some(limit) = limit {
            (stressed(shape, &limit.stiffening), limit.taut.clone(), limit.rank)
        } else {
            let taut = (0..frame.rods.len()).map(|e| resists(frame, shape, e));
            (shape.clone(), taut.collect(), ZERO)
        };
        let one_sided = Self::one_sided(frame, &shape, &taut, zero);
        Self { one_sided, ..Self::with(frame, &shape, |e| taut[e], zero) }
    }

    /// The index where cables, struts or the floor are just taut, if some are: the sign of their force is rounding. Where
    /// the energy falls with all of them it falls; else it may where some go slack.
    fn one_sided(frame: &Frame, shape: &Shape, taut: &[bool], zero: f64) -> Option<usize> {
        let open = open(frame, shape);
        if open.is_empty() {
            return None;
        }
        let with = |force: f64| {
            let mut taut = taut.to_vec();
            for e in &open {
                taut[*e] = force > 0.0;
            }
            Self::with(frame, &opened(frame, shape, &open, force), |e| taut[e], zero)
        };
        let index = with(f64::MIN_POSITIVE).count().index;
        if index > 0 {
            return Some(index);
        }
        let slack = with(0.0);
        let mut rows = rows(frame, &frame.excesses(&shape.x), &open) * &slack.motions;
        for (mut row, e) in rows.row_iter_mut().zip(&open) {
            let rod = &frame.rods[*e];
            let own = slack.size / STIFF_STRAIN / rod.length;
            let stiffness = if rod.elastic() { rod.flexibility.recip() } else { own };
            row *= if rod.kind == Kind::Strut { -1.0 } else { 1.0 } * stiffness.sqrt();
        }
        let zero = ZERO * slack.hessian.amax().max(slack.size);
        Some(usize::from(least_one_sided(&slack.hessian, &rows) < -zero))
    }

    /// With the members that are taut, and the part of the largest singular value below which all
    /// are zero.
    fn with(frame: &Frame, shape: &Shape, taut: impl Fn(usize) -> bool, zero: f64) -> Self {
        let n = frame.freedom;
        let excess = frame.excesses(&shape.x);
        let once = |e: &usize| taut(*e) && !frame.again(*e);
        let (springs, taut): (Vec<usize>, Vec<usize>) =
            (0..frame.rods.len()).filter(once).partition(|&e| frame.rods[e].elastic());
        let rigidity = rows(frame, &excess, &taut);
        let mut hessian = DMatrix::<f64>::zeros(n, n);
        for (e, rod) in frame.rods.iter().enumerate() {
            let elastic = rod.elastic() && rod.rope == 0 && resists(frame, shape, e);
            let block =
                excess[e].block(shape.force[e], if elastic { 1.0 / rod.flexibility } else { 0.0 });
            for (a, sign_a) in [(rod.from, -1.0), (rod.to, 1.0)] {
                for (b, sign_b) in [(rod.from, -1.0), (rod.to, 1.0)] {
                    let (row, column) = (&frame.spots[a], &frame.spots[b]);
                    for i in 0..row.freedom {
                        for k in 0..column.freedom {
                            hessian[(row.first + i, column.first + k)] +=
                                sign_a * sign_b * block.between(row.axes[i], column.axes[k]);
                        }
                    }
                }
            }
        }
        let springs: Vec<usize> = springs.into_iter().filter(|e| frame.rods[*e].rope > 0).collect();
        let stretch = rows(frame, &excess, &springs);
        let stiff = DMatrix::from_fn(springs.len(), n, |row, column| {
            stretch[(row, column)] / frame.rods[springs[row]].flexibility
        });
        hessian += stretch.transpose() * stiff;
        let size = frame.largest_force(&shape.force);
        // What keeps joints above the floor stands behind the members, and is no length.
        let floors = taut.partition_point(|e| *e < frame.members)..taut.len();
        let floors = floors.filter(|row| (0..n).any(|k| rigidity[(*row, k)].abs() > zero)).count();
        let (motions, stresses, counted) = kernels(&rigidity, zero);
        let rigidity = Rigidity { rank: counted.rank.saturating_sub(floors), ..counted };
        let hessian = motions.transpose() * &hessian * &motions;
        Self { hessian, size, stresses, taut, rigidity, motions, one_sided: None }
    }

    /// What the eigenvalues say.
    pub(super) fn count(&self) -> Count {
        let index = self.one_sided.unwrap_or(0);
        let none = Count { index, neutral: 0, condition: 1.0, nearest_to_zero: None };
        if self.hessian.nrows() == 0 {
            return none;
        }
        let Some(values) = eigenvalues(&self.hessian) else { return none };
        let zero = ZERO * largest(&values).max(self.size);
        let others = values.iter().map(|value| value.abs()).filter(|value| *value > zero);
        let smallest = others.fold(f64::INFINITY, f64::min);
        Count {
            index: self
                .one_sided
                .unwrap_or_else(|| values.iter().filter(|value| **value < -zero).count()),
            neutral: values.iter().filter(|value| value.abs() <= zero).count(),
            condition: if smallest.is_finite() { largest(&values) / smallest } else { 1.0 },
            nearest_to_zero: values.iter().copied().min_by(|a, b| a.abs().total_cmp(&b.abs())),
        }
    }

    /// An orthonormal basis of the self-stresses by members; what the floor bears follows from it.
    fn self_stresses(&self, frame: &Frame) -> Vec<Vec<f64>> {
        let stresses = self.stresses.ncols();
        // What keeps joints above the floor stands behind the members.
        let members = self.taut.partition_point(|e| *e < frame.members);
        let mut basis = self.stresses.rows(0, members).into_owned();
        if members < self.taut.len() && stresses > 0 {
            basis = basis.qr().q();
        }
        let stress = |k| {
            let mut stress = vec![0.0; frame.members];
            for (row, &e) in self.taut[..members].iter().enumerate() {
                stress[e] = basis[(row, k)];
            }
            stress
        };
        (0..stresses).map(stress).collect()
    }
}

/// Orthonormal bases of the motions that keep the lengths and of the self-stresses.
fn kernels(rigidity: &DMatrix<f64>, zero: f64) -> (DMatrix<f64>, DMatrix<f64>, Rigidity) {
    let (m, n) = (rigidity.nrows(), rigidity.ncols());
    let unsolved =
        |rank| Rigidity { rank, self_stresses: m - rank, mechanisms: n - rank, gap: [1.0, 0.0] };
    let Some(found) = Kernels::at_scale(rigidity, zero, 1.0) else {
        return (DMatrix::identity(n, n), DMatrix::zeros(m, 0), unsolved(0));
    };
    let counted = Rigidity { gap: found.gap, ..unsolved(found.rank) };
    (found.right(), found.left(), counted)
}

#[cfg(test)]
mod tests;
