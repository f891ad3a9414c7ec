//! The equations of `lagrange` along a straight line of numbers of the file.

use branches::Variation;
use branches::load::{self, NoPath};
use lagrange::net::{Equations, Side};
use model::Vector;
use model::system::{System, SystemEquilibrium};
use nalgebra::DVector;
use validate::systems::Near;

use super::enclosed::loads_alone;
use super::load::LoadError;
use crate::equilibria::as_solved;

/// Part of the line at which it is seen what stays taut.
const AHEAD: f64 = 1e-3;

/// Step of the difference for how supports move.
const GIVEN: f64 = 1e-3;

/// A factor is good for unknowns that differ by rounding.
const SAME: f64 = 1e-13;

/// Where the numbers run, and the system there.
pub(super) struct Family<'a> {
    variation: &'a Variation,
    from: Vec<f64>,
    to: Vec<f64>,
    at: f64,
    equations: Equations,
    /// Number of joints.
    joints: usize,
    /// The loads at 0 and their change to 1, where these alone vary.
    loads: Option<[DVector<f64>; 2]>,
    /// Where the factor is of, and the index there.
    factored: Option<(DVector<f64>, f64, Option<usize>)>,
}

impl<'a> Family<'a> {
    /// From the values of the numbers at 0 to those at 1, with the unknowns of the equilibrium at 0:
    /// that next to the drawing, or, where nothing is drawn, the hanging one.
    pub(super) fn new(
        variation: &'a Variation,
        [from, to]: [&[f64]; 2],
    ) -> Result<(Self, DVector<f64>), LoadError> {
        let system = variation.unloaded(from).map_err(LoadError::Numbers)?;
        // Forces are measured in the loads, if there are any later.
        let far = variation.unloaded(to).ok();
        let of_units = far.as_ref().filter(|_| system.is_unloaded());
        let mut equations = Equations::new(of_units.unwrap_or(&system))?;
        let loads = far.filter(|far| loads_alone(&system, far)).map(|far| {
            equations.set(&far);
            let to = DVector::from_vec(equations.loads());
            equations.set(&system);
            let from = DVector::from_vec(equations.loads());
            [from.clone(), to - from]
        });
        equations.set(&system);
        let drawing_m = system.drawing();
        let start = match (as_solved(&system).0, &drawing_m) {
            (Ok(found), drawing_m) => {
                let near = drawing_m.as_ref().map(|m| Near::of(&system, m, &found.equilibrium));
                if let Some(Near { joint, moved_m, .. }) = near.filter(|near| !near.is_neighbour) {
                    return Err(LoadError::NotNear { joint, moved_m });
                }
                let answer = &found.equilibrium;
                // No equation describes the corner of a rope that jams.
                if !answer.evidence.jams.is_empty() {
                    return Err(LoadError::Jams);
                }
                if answer.stability.neutral > 0 {
                    return Err(LoadError::Singular);
                }
                equations.at(&system, &found)
            }
            // Without loads the drawing may be what there is.
            (Err(_), Some(drawing_m)) if system.is_unloaded() => equations.drawn(drawing_m),
            (Err(error), _) => return Err(error.into()),
        };
        let joints = system.joints().len();
        let mut family = Self {
            variation,
            from: from.to_vec(),
            to: to.to_vec(),
            at: 0.0,
            equations,
            joints,
            loads,
            factored: None,
        };
        // Of what is just taut at the start some goes slack at once, but for what holds the others.
        let open = family.equations.just_taut(start.as_slice());
        if !open.is_empty()
            && let Ok(found) = as_solved(&family.system(AHEAD)?).0
        {
            let there = DVector::from_vec(family.equations.unknowns(&found.equilibrium));
            let index = found.equilibrium.stability.index_in_space;
            for all in [true, false] {
                family.equations.taut_as_in(&open, &found, all);
                if load::Equations::factorise(&mut family, &there, AHEAD)? == Some(index) {
                    break;
                }
                family.factored = None;
            }
        }
        Ok((family, DVector::from_vec(start)))
    }

    /// The numbers at a point of the line.
    pub(super) fn values(&self, t: f64) -> Vec<f64> {
        let between = |(from, to): (&f64, &f64)| from * (1.0 - t) + to * t;
        self.from.iter().zip(&self.to).map(between).collect()
    }

    /// The numbers at 0 and at 1.
    pub(super) fn ends(&self) -> [&[f64]; 2] {
        [&self.from, &self.to]
    }

    /// The derivatives of the last number in a limit point by lengths and by places of supports, its unit
    /// a metre: along the null vector $\phi$ of $J$,
    /// $\mathrm{d}t/\mathrm{d}p = -(\phi \cdot \partial G/\partial p) / (\phi \cdot \partial G/\partial t)$.
    pub(super) fn imperfections(
        &mut self,
        at: &Kept,
        limit: &load::Event<Side>,
    ) -> Result<(Vec<f64>, Vec<Vector>), LoadError> {
        self.set(limit.t)?;
        let y = self.equations.unknowns(&at.equilibrium);
        let phi = DVector::from_column_slice(&limit.mode);
        let by_load = phi.dot(&load::Equations::by_parameter(
            self,
            &DVector::from_column_slice(&y),
            limit.t,
        )?);
        let range = self.to.last().zip(self.from.last()).map_or(1.0, |(to, from)| to - from);
        let [length_m, _] = self.equations.units();
        let scale = -range / (by_load * length_m);
        let by_length = self.equations.by_length(&self.system(limit.t)?, &y, &limit.mode);
        let by_place = self.equations.by_place(&y, &limit.mode);
        Ok((
            by_length.into_iter().map(|by| scale * by).collect(),
            by_place.into_iter().map(|by| (by * scale).into()).collect(),
        ))
    }

    fn set(&mut self, t: f64) -> Result<(), LoadError> {
        if t.to_bits() == self.at.to_bits() {
            return Ok(());
        }
        match &self.loads {
            Some([from, change]) => self.equations.set_loads((from + change * t).as_slice()),
            None => self.equations.set(&self.system(t)?),
        }
        self.at = t;
        Ok(())
    }

    fn system(&self, t: f64) -> Result<System, LoadError> {
        self.variation.unloaded(&self.values(t)).map_err(LoadError::Numbers)
    }
}

/// A point of a path as it is kept.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Kept {
    pub(super) values: Vec<f64>,
    pub(super) equilibrium: SystemEquilibrium,
}

impl load::Equations for Family<'_> {
    type Side = Side;
    type Record = Kept;
    type Error = LoadError;

    fn places(&self) -> usize {
        3 * self.joints
    }

    fn onto(&mut self, y: &DVector<f64>, t: f64) -> Result<DVector<f64>, LoadError> {
        self.set(t)?;
        Ok(DVector::from_vec(self.equations.onto(y.as_slice())))
    }

    fn residual(&mut self, y: &DVector<f64>, t: f64) -> Result<(DVector<f64>, f64), LoadError> {
        self.set(t)?;
        let (rows, size) = self.equations.residual(y.as_slice());
        Ok((DVector::from_vec(rows), size))
    }

    fn by_parameter(&mut self, y: &DVector<f64>, t: f64) -> Result<DVector<f64>, LoadError> {
        match &self.loads {
            Some([_, change]) => Ok(DVector::from_vec(self.equations.of_loads(change.as_slice()))),
            None => load::difference(self, y, t),
        }
    }

    fn given(&mut self, y: &DVector<f64>, t: f64) -> Result<Option<DVector<f64>>, LoadError> {
        if self.loads.is_some() {
            return Ok(None);
        }
        // Supports move on straight lines.
        let (Ok(before), Ok(after)) = (self.onto(y, t - GIVEN), self.onto(y, t + GIVEN)) else {
            return Ok(None);
        };
        Ok(Some((after - before) / (2.0 * GIVEN)))
    }

    fn factorise(&mut self, y: &DVector<f64>, t: f64) -> Result<Option<usize>, LoadError> {
        self.set(t)?;
        if let Some((at, at_t, index)) = &self.factored
            && (at_t - t).abs() <= SAME
            && at.iter().zip(y).all(|(a, b)| (a - b).abs() <= SAME)
        {
            return Ok(*index);
        }
        let index = self.equations.factorise(y.as_slice());
        self.factored = Some((y.clone(), t, index));
        Ok(index)
    }

    fn solve(&mut self, right: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(self.equations.solve(right.as_slice()))
    }

    fn apply(&self, y: &DVector<f64>) -> DVector<f64> {
        DVector::from_vec(self.equations.apply(y.as_slice()))
    }

    fn sides(&mut self, y: &DVector<f64>, t: f64) -> Result<Vec<(Side, f64)>, LoadError> {
        self.set(t)?;
        Ok(self.equations.sides(y.as_slice()))
    }

    fn switch(&mut self, side: Side) -> Result<bool, LoadError> {
        self.factored = None;
        Ok(self.equations.switch(side)?)
    }

    fn record(&mut self, y: &DVector<f64>, t: f64, index: usize) -> Result<Kept, LoadError> {
        self.set(t)?;
        let system = self.system(t)?;
        let equilibrium = self.equations.solution(&system, y.as_slice(), index).equilibrium;
        Ok(Kept { values: self.values(t), equilibrium })
    }
}

impl From<NoPath<LoadError>> for LoadError {
    fn from(error: NoPath<LoadError>) -> Self {
        match error {
            NoPath::Start { residual } => Self::Start(residual),
            NoPath::Singular => Self::Singular,
            NoPath::Numbers(error) => error,
        }
    }
}

/// A straight line of values.
pub(super) struct Line<'a> {
    /// The values at 0 and at 1.
    pub(super) ends: [&'a [f64]; 2],
    /// The range of the points given.
    pub(super) range: [f64; 2],
    /// Their largest distance.
    pub(super) longest: f64,
}

/// The line of a path.
pub(super) fn line(points: &[Vec<f64>]) -> Result<Line<'_>, LoadError> {
    let first = points.first().ok_or(LoadError::NoRange)?;
    let last = first.len().checked_sub(1).ok_or(LoadError::NoRange)?;
    let off = |point: &Vec<f64>| point[last] - first[last];
    let begin = points.iter().map(off).find(|off| off.abs() > 0.0).ok_or(LoadError::NoRange)?;
    // The farthest on the side where the path begins.
    let side = |point: &&Vec<f64>| off(point) * begin.signum();
    let far = points.iter().max_by(|a, b| side(a).total_cmp(&side(b))).unwrap_or(first);
    let part = |point: &Vec<f64>| (point[last] - first[last]) / (far[last] - first[last]);
    let mut range = [0.0_f64, 1.0_f64];
    let mut longest = 0.0_f64;
    for two in points.windows(2) {
        longest = longest.max((part(&two[1]) - part(&two[0])).abs());
    }
    for point in points {
        let t = part(point);
        let on = |k: usize| {
            let value = first[k] * (1.0 - t) + far[k] * t;
            (point[k] - value).abs() <= STRAIGHT * (first[k].abs() + far[k].abs())
        };
        if !(0..=last).all(on) {
            return Err(LoadError::NotStraight);
        }
        range = [range[0].min(t), range[1].max(t)];
    }
    Ok(Line { ends: [first, far], range, longest })
}

/// Values in step are on a line to this part of them.
const STRAIGHT: f64 = 1e-9;
