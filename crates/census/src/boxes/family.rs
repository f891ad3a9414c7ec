//! The equations along a straight line of loads, for shapes of one symmetry.

use model::system::System;
use model::{NoBox, Vector as Point};
use numerics::Interval;

use super::activity::Activity;
use super::arithmetic::{Vector, dot, minus, product, sum};
use super::equations::{Entry, Equations};
use super::frame::Frame;
use super::prove::{Posed, complementarity};
use super::symmetry::{Block, Symmetry};
use super::tube::last;

/// $F(y) + t\\,b = 0$ with $y$ in the first block; a point $x$ is the unknowns of that and $t$.
pub(super) struct Family<'a> {
    system: &'a System,
    /// Under the loads at $t = 0$.
    pub(super) equations: Equations,
    activities: Vec<Activity>,
    /// $b$.
    by_load: Vec<Interval>,
    /// Those of the symmetry, or one of all unknowns.
    pub(super) blocks: Vec<Block>,
}

impl<'a> Family<'a> {
    /// The loads at $t = 0$ and $1$ are those of the ends, all else and the unit of force of the system.
    pub(super) fn new(
        ends: [&System; 2],
        system: &'a System,
        (joints_m, axial_n): (&[Point], &[f64]),
        symmetric: bool,
        most: usize,
    ) -> Result<Self, NoBox> {
        let symmetry = if symmetric { Symmetry::of(&ends, joints_m) } else { None };
        let mut frame = Frame::new(system, axial_n);
        if let Some(symmetry) = &symmetry {
            let [x, y, _] = symmetry.centre_m;
            frame.origin_m = [x, y, frame.origin_m[2]];
        }
        let Posed { equations, activities, .. } =
            Posed::within(system, frame, joints_m, axial_n, most)?;
        let [first, last] = ends.map(|system| equations.frame.loads(system));
        let by_load = along(&equations, first.iter().zip(&last).map(|(a, b)| minus(*b, *a)));
        let blocks = symmetry.and_then(|symmetry| Block::all(&equations, &symmetry));
        let blocks = blocks.unwrap_or_else(|| vec![Block::whole(equations.size)]);
        let equations = equations.with_loads(first);
        Ok(Self { system, equations, activities, by_load, blocks })
    }

    /// Number of unknowns, with the parameter.
    pub(super) fn size(&self) -> usize {
        self.blocks[0].size() + 1
    }

    /// A shape with its parameter.
    pub(super) fn start(&self, joints_m: &[Point], axial_n: &[f64], t: f64) -> Vec<f64> {
        let mut at = self.blocks[0].gather(&self.equations.start(joints_m, axial_n));
        at.push(t);
        at
    }

    /// All unknowns of a point but the parameter.
    pub(super) fn spread(&self, x: &[Interval]) -> Vec<Interval> {
        self.blocks[0].spread(x)
    }

    /// Left-hand sides over a box of points.
    pub(super) fn value(&self, x: &[Interval]) -> Result<Vec<Interval>, NoBox> {
        let value = self.blocks[0].gather(&self.equations.value(&self.spread(x))?);
        let loads = self.blocks[0].gather(&self.by_load);
        let t = last(x);
        Ok(value.iter().zip(&loads).map(|(row, load)| sum(*row, product(t, *load))).collect())
    }

    /// How much the loads do along each unknown of a point.
    pub(super) fn loads(&self) -> Vec<Interval> {
        self.blocks[0].gather(&self.by_load)
    }

    /// $[J, b; c, d]$ over a box of all unknowns, of whose derivative these are the entries.
    pub(super) fn bordered(&self, jacobian: &[Entry], row: &[f64]) -> Vec<Entry> {
        let last = self.size() - 1;
        let mut entries = self.blocks[0].restrict(jacobian);
        let loads = self.loads().into_iter().enumerate();
        entries.extend(loads.map(|(k, load)| (k, last, load)));
        entries.extend(row.iter().enumerate().map(|(k, c)| (last, k, Interval::point(*c))));
        entries.retain(|(_, _, entry)| *entry != Interval::ZERO);
        entries
    }

    /// $-F''(y)[a, b]$ for the rows of a block, and a 0 below.
    pub(super) fn bent(
        &self,
        block: &Block,
        y: &[Interval],
        a: &[Interval],
        b: &[Interval],
    ) -> Vec<Interval> {
        let mut rows = block.gather(&self.equations.second(y, a, b));
        rows.push(Interval::ZERO);
        rows.into_iter().map(|row| -row).collect()
    }

    /// Prove that in all of a box the same members act.
    pub(super) fn acts(&self, y: &[Interval]) -> Result<(), NoBox> {
        complementarity(self.system, &self.equations, &self.activities, y)
    }
}

/// Forces at the joints as they stand in the balances.
fn along(equations: &Equations, forces: impl Iterator<Item = Vector>) -> Vec<Interval> {
    let mut rows = vec![Interval::ZERO; equations.size];
    for (joint, force) in equations.joints.iter().zip(forces) {
        for (k, axis) in joint.axes.iter().enumerate() {
            rows[joint.first + k] = dot(*axis, force);
        }
    }
    rows
}
