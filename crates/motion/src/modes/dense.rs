//! The projected eigenproblem by dense linear algebra.

use model::Vector;
use nalgebra::{DMatrix, DVector, Matrix3, SymmetricEigen, Vector3};

use super::planes::{Direction, FLAT, Sector};
use crate::mechanism::{Link, Mechanism};
use crate::state::State;
use crate::vector::{dot, norm, times};

/// Rows of the constraints whose part independent of the others is less than this, relative, are
/// dependent.
const INDEPENDENT: f64 = 1e-10;

/// Stiffness, inertia and constraints about an equilibrium.
pub(super) struct Stiffness<'a> {
    mechanism: &'a Mechanism,
    vectors: &'a [Vector],
    /// Each member with the 3 × 3 matrix of its stiffness, N/m, and whether it is rigid.
    members: Vec<(&'a Link, Matrix3<f64>)>,
    densities: Vec<f64>,
}

/// Solutions of one sector.
pub(super) struct Solved {
    /// `ω²`, ascending, 1/s².
    pub omega2: Vec<f64>,
    /// What rounding may make of a zero.
    pub zero: f64,
    /// Displacements of the coordinates, a column for each, orthonormal in the metric of the
    /// inertia.
    pub shapes: DMatrix<f64>,
}

/// What is less than this, relative to the largest `ω²` that the forces alone make, is rounding: of
/// the places and forces of the equilibrium, and of the eigenvalues.
const ZERO: f64 = 1e-10;

impl<'a> Stiffness<'a> {
    pub(super) fn new(
        mechanism: &'a Mechanism,
        state: &State,
        vectors: &'a [Vector],
        densities: Vec<f64>,
    ) -> Self {
        let rigid = mechanism.bars.iter().zip(&densities);
        let mut members: Vec<_> =
            rigid.map(|(link, rho)| (link, Matrix3::identity() * *rho)).collect();
        for spring in &mechanism.springs {
            let d = state.between(spring.link.a, spring.link.b);
            let length = norm(d);
            let u = Vector3::from(d) / length;
            let density = spring.force_density(length);
            let along = spring.slope(length) - density;
            let block = Matrix3::identity() * density + u * u.transpose() * along;
            members.push((&spring.link, block));
        }
        Self { mechanism, vectors, members, densities }
    }

    /// All modes whose displacements are along the axes of a sector.
    pub(super) fn solve(&self, sector: &Sector) -> Solved {
        let (inertia, stiffness) = self.matrices(sector);
        let size = inertia.nrows();
        // M = L Lᵀ; in z = Lᵀ y the problem is ordinary: L⁻¹ K L⁻ᵀ z = ω² z with R L⁻ᵀ z = 0.
        let Some(factor) = inertia.cholesky() else { return Solved::none(size) };
        let lower = factor.l();
        let solved =
            |m: &DMatrix<f64>| lower.solve_lower_triangular(m).unwrap_or_else(|| m.clone());
        let half = solved(&stiffness);
        let ordinary = solved(&half.transpose());
        let free = null_space(&solved(&self.rows(sector).transpose()));
        if free.ncols() == 0 {
            return Solved::none(size);
        }
        let projected = free.transpose() * &ordinary * &free;
        let symmetric = 0.5 * (&projected + projected.transpose());
        let largest = symmetric.norm();
        let eigen = SymmetricEigen::new(symmetric);
        let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
        order.sort_by(|&i, &j| eigen.eigenvalues[i].total_cmp(&eigen.eigenvalues[j]));
        let ordinary_shapes = &free * &eigen.eigenvectors;
        let shapes =
            lower.transpose().solve_upper_triangular(&ordinary_shapes).unwrap_or(ordinary_shapes);
        let zero =
            ZERO * self.largest_of_forces().min(largest) + size as f64 * f64::EPSILON * largest;
        Solved {
            omega2: order.iter().map(|&k| eigen.eigenvalues[k]).collect(),
            zero,
            shapes: DMatrix::from_columns(
                &order
                    .iter()
                    .map(|&k| shapes.column(k).into_owned())
                    .collect::<Vec<DVector<f64>>>(),
            ),
        }
    }

    /// Inertia and stiffness in the coordinates of a sector: those of slot 0, of slot 1, and so on.
    fn matrices(&self, sector: &Sector) -> (DMatrix<f64>, DMatrix<f64>) {
        let (moving, axes) = (self.mechanism.moving, &sector.axes);
        let size = moving * axes.len();
        let mut inertia = DMatrix::zeros(size, size);
        let mut stiffness = DMatrix::zeros(size, size);
        for slot in 0..moving {
            for k in 0..axes.len() {
                let at = slot * axes.len() + k;
                inertia[(at, at)] += self.mechanism.mass[slot];
            }
        }
        for (link, block) in &self.members {
            for (i, row) in axes.iter().enumerate() {
                for (j, column) in axes.iter().enumerate() {
                    let value = Vector3::from(*row).dot(&(block * Vector3::from(*column)));
                    for (a, b, sign) in [
                        (link.a, link.a, 1.0),
                        (link.b, link.b, 1.0),
                        (link.a, link.b, -1.0),
                        (link.b, link.a, -1.0),
                    ] {
                        if a < moving && b < moving {
                            stiffness[(a * axes.len() + i, b * axes.len() + j)] += sign * value;
                        }
                    }
                }
                if link.a < moving && link.b < moving {
                    let (a, b) = (link.a * axes.len() + i, link.b * axes.len() + i);
                    inertia[(a, b)] += link.inertia.between;
                    inertia[(b, a)] += link.inertia.between;
                }
            }
        }
        (inertia, stiffness)
    }

    /// The constraints in the coordinates of a sector.
    fn rows(&self, sector: &Sector) -> DMatrix<f64> {
        let (moving, axes) = (self.mechanism.moving, &sector.axes);
        let mut rows = DMatrix::zeros(self.vectors.len(), moving * axes.len());
        // In the plane of an equilibrium bars have no part across it, and supports are along it or
        // across: what is left of these parts is rounding, and would be taken for a constraint.
        let part = |axis: Vector, unit: Vector| {
            let part = dot(axis, unit);
            if part.abs() > FLAT { part } else { 0.0 }
        };
        let mut put = |row: usize, slot: usize, sign: f64, unit: Vector| {
            if slot < moving {
                for (k, axis) in axes.iter().enumerate() {
                    rows[(row, slot * axes.len() + k)] = sign * part(*axis, unit);
                }
            }
        };
        if sector.direction != Direction::Across {
            for (row, link) in self.mechanism.bars.iter().enumerate() {
                let unit = times(1.0 / link.length_m, self.vectors[row]);
                put(row, link.a, -1.0, unit);
                put(row, link.b, 1.0, unit);
            }
        }
        for (k, slide) in self.mechanism.slides.iter().enumerate() {
            let row = self.mechanism.bars.len() + k;
            put(row, slide.slot, 1.0, self.vectors[row]);
        }
        rows
    }

    /// A bound on the `ω²` that the forces of the rigid bars make, 1/s²: stiffness over inertia,
    /// joint by joint.
    fn largest_of_forces(&self) -> f64 {
        let mut around = vec![0.0; self.mechanism.joint_at.len()];
        for (link, rho) in self.mechanism.bars.iter().zip(&self.densities) {
            around[link.a] += 2.0 * rho.abs();
            around[link.b] += 2.0 * rho.abs();
        }
        for spring in &self.mechanism.springs {
            let weight = self.mechanism.load[spring.link.a];
            around[spring.link.a] += norm(weight) / spring.link.length_m;
        }
        let moving = around.iter().zip(&self.mechanism.mass).take(self.mechanism.moving);
        moving.map(|(k, m)| k / m).fold(0.0, f64::max)
    }
}

impl Solved {
    fn none(size: usize) -> Self {
        Self { omega2: Vec::new(), zero: 0.0, shapes: DMatrix::zeros(size, 0) }
    }
}

/// An orthonormal basis of what is orthogonal to the columns.
fn null_space(columns: &DMatrix<f64>) -> DMatrix<f64> {
    let (size, given) = columns.shape();
    let mut basis: Vec<DVector<f64>> = Vec::with_capacity(size);
    // Twice is enough (Kahan, Parlett): Gram-Schmidt with the columns of largest rest first.
    let mut rest: Vec<DVector<f64>> = (0..given).map(|k| columns.column(k).into_owned()).collect();
    let largest = rest.iter().map(DVector::norm).fold(0.0, f64::max);
    while let Some(next) = take_longest(&mut rest, INDEPENDENT * largest) {
        let unit = next.normalize();
        for other in &mut rest {
            subtract(other, &unit);
        }
        basis.push(unit);
    }
    let taken = basis.len();
    let mut units: Vec<DVector<f64>> = (0..size)
        .map(|k| {
            let mut unit = DVector::zeros(size);
            unit[k] = 1.0;
            for b in basis.iter().chain(&basis) {
                subtract(&mut unit, b);
            }
            unit
        })
        .collect();
    while basis.len() < size {
        let Some(next) = take_longest(&mut units, 0.0) else { break };
        let mut unit = next.normalize();
        for b in &basis {
            subtract(&mut unit, b);
        }
        unit.normalize_mut();
        for other in &mut units {
            subtract(other, &unit);
        }
        basis.push(unit);
    }
    if basis.len() == taken {
        return DMatrix::zeros(size, 0);
    }
    DMatrix::from_columns(&basis[taken..])
}

fn subtract(from: &mut DVector<f64>, unit: &DVector<f64>) {
    let part = from.dot(unit);
    from.axpy(-part, unit, 1.0);
}

/// The longest vector, if it is longer than this.
fn take_longest(vectors: &mut Vec<DVector<f64>>, longer_than: f64) -> Option<DVector<f64>> {
    let lengths = vectors.iter().map(DVector::norm);
    let (k, length) = lengths.enumerate().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (length > longer_than).then(|| vectors.swap_remove(k))
}
