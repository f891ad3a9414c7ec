use model::Vector;

use super::planes::{Direction, FLAT, Sector};
use crate::mechanism::{Link, Mechanism};
use crate::state::State;
use crate::unequal::{Excess, excesses};
use numerics::vector::{add_times, dot, norm, times};

/// Stiffness, inertia and constraints about an equilibrium.
pub(super) struct Stiffness<'a> {
    pub mechanism: &'a Mechanism,
    vectors: &'a [Vector],
    members: Vec<(&'a Link, Block)>,
    /// What ropes resist in their lengths.
    lengths: Vec<Length>,
    densities: Vec<f64>,
    /// Motions, by slot, that lengths bind to second order.
    pub bound: Vec<Vec<Vector>>,
    /// What bars with different moments across have beyond the inertia of the mechanism.
    pub excesses: Vec<Excess>,
}

/// The stiffness of a span: a force density, N/m, and what it has beyond that along a unit vector.
struct Block {
    density: f64,
    beyond: f64,
    u: Vector,
}

impl Block {
    /// Of a span `d` with a stiffness along it.
    fn new(density: f64, d: Vector, along: f64) -> Self {
        if density.abs() <= 0.0 && along <= 0.0 {
            return Self { density: 0.0, beyond: 0.0, u: [0.0; 3] };
        }
        Self { density, beyond: along - density, u: times(1.0 / norm(d), d) }
    }

    /// `aᵀ K b`.
    fn between(&self, a: Vector, b: Vector) -> f64 {
        self.density * dot(a, b) + self.beyond * dot(self.u, a) * dot(self.u, b)
    }
}

/// A stiffness against changes of the length of a rope.
struct Length {
    /// N/m.
    stiffness: f64,
    /// Derivatives of the length by slots, one for each end of a span.
    gradient: Vec<(usize, Vector)>,
}

/// Row, column, value; equal places are added.
pub(super) type Entry = (usize, usize, f64);

/// The matrices in the coordinates of a sector: those of slot 0, of slot 1, and so on.
pub(super) struct Entries {
    pub size: usize,
    /// `M` and `K`, both triangles.
    pub inertia: Vec<Entry>,
    pub stiffness: Vec<Entry>,
    /// `R`; rows may be empty.
    pub rows: Vec<Entry>,
}

impl Entries {
    /// `M y`.
    pub(super) fn inertia_times(&self, y: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.size];
        for &(row, column, value) in &self.inertia {
            product[row] += value * y[column];
        }
        product
    }
}

impl<'a> Stiffness<'a> {
    pub(super) fn new(
        mechanism: &'a Mechanism,
        state: &State,
        vectors: &'a [Vector],
        densities: Vec<f64>,
    ) -> Self {
        let (mut members, mut lengths) = (Vec::new(), Vec::new());
        for (bar, rho) in mechanism.bars.iter().zip(&densities) {
            let spans = mechanism.of(&bar.spans);
            if let [span] = spans {
                members.push((span, Block { density: *rho, beyond: 0.0, u: [0.0; 3] }));
                continue;
            }
            for span in spans {
                let d = state.between(span.a, span.b);
                members.push((span, Block::new(rho * bar.length_m / norm(d), d, 0.0)));
            }
        }
        for spring in &mechanism.springs {
            let spans = mechanism.of(&spring.spans);
            let length_m = state.length_m(spans);
            // Slack members, whose ends may be in one place, have none.
            let slope = spring.slope(length_m);
            let own = if spans.len() == 1 { slope } else { 0.0 };
            let mut gradient = Vec::new();
            for span in spans {
                let d = state.between(span.a, span.b);
                let density = spring.force_density(length_m, norm(d));
                members.push((span, Block::new(density, d, own)));
                let u = if slope > own { times(1.0 / norm(d), d) } else { [0.0; 3] };
                gradient.extend([(span.a, times(-1.0, u)), (span.b, u)]);
            }
            if slope > own {
                lengths.push(Length { stiffness: slope, gradient });
            }
        }
        let excesses = excesses(mechanism, state);
        Self { mechanism, vectors, members, lengths, densities, bound: vec![], excesses }
    }

    /// Number of rows of the constraints, empty ones included.
    pub(super) fn row_count(&self) -> usize {
        self.mechanism.constraints() + self.bound.len()
    }

    /// Inertia, stiffness and constraints in the coordinates of a sector.
    pub(super) fn entries(&self, sector: &Sector) -> Entries {
        let (moving, axes) = (self.mechanism.moving, &sector.axes);
        let size = moving * axes.len();
        let mut inertia = Vec::new();
        let mut stiffness = Vec::new();
        for slot in 0..moving {
            for k in 0..axes.len() {
                let at = slot * axes.len() + k;
                inertia.push((at, at, self.mechanism.mass[slot]));
            }
        }
        for (link, block) in &self.members {
            for (i, row) in axes.iter().enumerate() {
                for (j, column) in axes.iter().enumerate() {
                    let value = block.between(*row, *column);
                    let ends =
                        [link.a, link.b].map(|slot| (slot < moving).then_some(slot * axes.len()));
                    put_difference(&mut stiffness, ends, [i, j], value);
                }
                if link.a < moving && link.b < moving {
                    let (a, b) = (link.a * axes.len() + i, link.b * axes.len() + i);
                    inertia.push((a, b, link.inertia.between));
                    inertia.push((b, a, link.inertia.between));
                }
            }
        }
        for Length { stiffness: k, gradient } in &self.lengths {
            let parts = gradient.iter().filter(|(slot, _)| *slot < moving).flat_map(|(slot, u)| {
                axes.iter().enumerate().map(move |(i, a)| (slot * axes.len() + i, dot(*u, *a)))
            });
            for (row, u) in parts.clone() {
                stiffness.extend(parts.clone().map(|(column, v)| (row, column, k * u * v)));
            }
        }
        for excess in &self.excesses {
            for (i, row) in axes.iter().enumerate() {
                for (j, column) in axes.iter().enumerate() {
                    let across = dot(excess.axis, *row) * dot(excess.axis, *column);
                    put_difference(
                        &mut inertia,
                        [excess.a, excess.b]
                            .map(|slot| (slot < moving).then_some(slot * axes.len())),
                        [i, j],
                        excess.inertia_kg * across,
                    );
                }
            }
        }
        Entries { size, inertia, stiffness, rows: self.rows(sector) }
    }

    /// The constraints in the coordinates of a sector.
    fn rows(&self, sector: &Sector) -> Vec<Entry> {
        let (moving, axes) = (self.mechanism.moving, &sector.axes);
        let mut rows = Vec::new();
        // In the plane of an equilibrium bars have no part across it, and supports are along it or
        // across: what is left of these parts is rounding, and would be taken for a constraint.
        let part = |axis: Vector, unit: Vector| {
            let part = dot(axis, unit);
            if part.abs() > FLAT { part } else { 0.0 }
        };
        let mut put = |row: usize, slot: usize, sign: f64, unit: Vector| {
            if slot < moving {
                for (k, axis) in axes.iter().enumerate() {
                    rows.push((row, slot * axes.len() + k, sign * part(*axis, unit)));
                }
            }
        };
        if sector.direction != Direction::Across {
            for (row, bar) in self.mechanism.bars.iter().enumerate() {
                for span in bar.spans.clone() {
                    let link = &self.mechanism.spans[span];
                    let unit = times(1.0 / bar.length_m, self.vectors[span]);
                    put(row, link.a, -1.0, unit);
                    put(row, link.b, 1.0, unit);
                }
            }
        }
        for (k, slide) in self.mechanism.slides.iter().enumerate() {
            let row = self.mechanism.bars.len() + k;
            put(row, slide.slot, 1.0, self.vectors[self.mechanism.rigid_spans() + k]);
        }
        for (k, motion) in self.bound.iter().enumerate() {
            for (slot, by) in motion.iter().enumerate() {
                put(self.mechanism.constraints() + k, slot, 1.0, *by);
            }
        }
        rows
    }

    /// `yᵀ K y` of displacements in the coordinates of a sector, of inertia 1, and what it is rounding of: the sum of the
    /// absolute values of the members' parts, at least [`unit`](Self::unit), since where nothing but rounding
    /// resists the parts are rounding too. Member by member, so that the parts of a long system, which nearly cancel in
    /// the matrix, keep their digits.
    pub(super) fn energy(&self, sector: &Sector, y: &[f64]) -> [f64; 2] {
        let (moving, axes) = (self.mechanism.moving, &sector.axes);
        let at = |slot: usize, k: usize| {
            if slot < moving { y[slot * axes.len() + k] } else { 0.0 }
        };
        let (mut sum, mut made_of) = (0.0, 0.0);
        for Length { stiffness, gradient } in &self.lengths {
            let along = |slot: usize, u: &Vector| -> f64 {
                axes.iter().enumerate().map(|(k, axis)| dot(*u, *axis) * at(slot, k)).sum()
            };
            let by: f64 = gradient.iter().map(|(slot, u)| along(*slot, u)).sum();
            let part = stiffness * by * by;
            sum += part;
            made_of += part;
        }
        for (link, block) in &self.members {
            let mut by = [0.0; 3];
            for (k, axis) in axes.iter().enumerate() {
                by = add_times(by, at(link.b, k) - at(link.a, k), *axis);
            }
            let part = block.between(by, by);
            sum += part;
            made_of += part.abs();
        }
        [sum, made_of.max(self.unit())]
    }

    /// What `ω²` are of the order of, 1/s²: the forces over the whole mass and the whole length, as
    /// `g/L` of a hanging chain.
    pub(super) fn unit(&self) -> f64 {
        let mechanism = self.mechanism;
        let loads: f64 = mechanism.load.iter().map(|f| norm(*f)).sum();
        let tension = mechanism.bars.iter().zip(&self.densities);
        let tension = tension.map(|(bar, rho)| rho.abs() * bar.length_m).fold(0.0, f64::max);
        let mass: f64 = mechanism.mass.iter().sum();
        (loads + tension) / (mass * mechanism.system.total_length_m())
    }
}

/// Put `value` times `[[1, −1], [−1, 1]]` at the coordinates of two ends; one that is held has
/// none.
fn put_difference(
    entries: &mut Vec<Entry>,
    [a, b]: [Option<usize>; 2],
    [i, j]: [usize; 2],
    value: f64,
) {
    for (row, column, sign) in [(a, a, 1.0), (b, b, 1.0), (a, b, -1.0), (b, a, -1.0)] {
        if let (Some(row), Some(column)) = (row, column) {
            entries.push((row + i, column + j, sign * value));
        }
    }
}
