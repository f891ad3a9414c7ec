//! Points where the derivative is singular: a test for them, their modes, and what is next to them.

use nalgebra::DVector;

use super::Equations;
use super::bordered::{Bordered, Row};
use super::here::{FALLS, Here, Space};

/// How far before and after a singular point, as a part of the step, the inertia is counted.
const BESIDE: f64 = 1e-2;
/// Corrections of a mode, each by the part of a step at which the factor is.
const CORRECTIONS: usize = 6;
/// Steps of inverse iteration to the null space.
pub(super) const ITERATIONS: usize = 3;

/// A fixed vector without symmetry.
pub(super) fn without_symmetry(size: usize) -> DVector<f64> {
    DVector::from_fn(size, |k, _| ((k as f64 + 1.0) * 0.754_877_666_246_692_7).fract() - 0.4)
}

impl<Q: Equations> Space<'_, Q> {
    /// A basis of so many vectors of the null space of a matrix that is nearly singular here, of unit length among the places, by
    /// some steps of inverse iteration. After the first step they have parts of all modes still.
    pub(super) fn null_space(
        &mut self,
        at: &Here,
        modes: usize,
        steps: usize,
    ) -> Vec<DVector<f64>> {
        let (size, metric) = (at.y.len(), self.metric);
        if !matches!(self.equations.factorise(&at.y, at.t), Ok(Some(_))) {
            return vec![];
        }
        let without = without_symmetry(size);
        let turned = |k: usize| DVector::from_fn(size, |i, _| without[(i + 7 * k) % size]);
        let mut basis: Vec<_> = (0..modes).map(turned).collect();
        for _ in 0..steps {
            for k in 0..basis.len() {
                let mut next = self.equations.solve(&basis[k]);
                for earlier in &basis[..k] {
                    let part = next.rows(0, metric.places).dot(&earlier.rows(0, metric.places));
                    next -= earlier * (part * metric.square);
                }
                basis[k] = metric.unit(next, 0.0).y;
            }
        }
        basis.retain(|mode| mode.sum().is_finite());
        basis
    }

    /// The test for a singular matrix, 0 where it is, with this border: one across the null space would leave the bordered
    /// matrix singular.
    pub(super) fn singular(&mut self, here: &Here, border: &DVector<f64>) -> Option<f64> {
        self.equations.factorise(&here.y, here.t).ok()??;
        let row = Row { y: border.clone(), t: 0.0 };
        let bordered = Bordered::new(self.equations, border, &row);
        Some(bordered.solve(self.equations, (&DVector::zeros(here.y.len()), 1.0))?.1)
    }

    /// The mode with its largest entry among the places 1, and how much of the load acts on it.
    ///
    /// In a singular point no factor is worth much. The mode before it is corrected by $J \phi = 0$ there with
    /// the factor before it.
    pub(super) fn mode(&mut self, at: &Here, before: &Here) -> (DVector<f64>, f64) {
        let none = (DVector::zeros(at.y.len()), 1.0);
        let found = self.null_space(before, 1, ITERATIONS).pop();
        let Some(mut mode) = found else { return none };
        for _ in 0..CORRECTIONS {
            let Some(off) = self.off(&mode, at, before) else { break };
            mode -= off;
        }
        let Ok(column) = self.equations.by_parameter(&at.y, at.t) else { return none };
        let on = mode.dot(&column).abs() / (mode.norm() * column.norm()).max(f64::MIN_POSITIVE);
        let places = mode.rows(0, self.metric.places);
        let largest = places[places.iamax()];
        let mode = if largest.abs() > 0.0 { mode / largest } else { mode };
        (mode, on)
    }

    /// Points before and after one between two others, by a part of their distance.
    pub(super) fn beside(&mut self, at: &Here, ends: [&Here; 2]) -> [Here; 2] {
        let wanted = BESIDE * self.metric.apart(ends[0], ends[1]);
        ends.map(|end| {
            let part = wanted / self.metric.apart(at, end);
            let here = (part < 1.0).then(|| self.between(at, end, part)).flatten();
            // Points that lead from the other end to this one.
            let here =
                here.map(|here| if std::ptr::eq(end, ends[0]) { here.turned() } else { here });
            here.unwrap_or_else(|| end.clone())
        })
    }

    /// A point where paths cross, corrected with the factor of one beside it: its own is singular in more
    /// than one direction.
    pub(super) fn settled(&mut self, at: Here, before: &Here) -> Here {
        let mut best = at;
        let mut corrected = |at: &Here| -> Option<(Here, bool)> {
            let (left, size) = self.equations.residual(&at.y, at.t).ok()?;
            self.equations.factorise(&before.y, before.t).ok()??;
            let step = self.equations.solve(&-left);
            let y = self.equations.onto(&(&at.y + step), at.t).ok()?;
            let (_, after) = self.equations.residual(&y, at.t).ok()?;
            Some((Here { y, ..at.clone() }, after < FALLS * size))
        };
        for _ in 0..CORRECTIONS {
            match corrected(&best) {
                Some((better, true)) => best = better,
                _ => break,
            }
        }
        best
    }

    /// What is wrong with a mode in a singular point, by the factor beside it.
    fn off(&mut self, mode: &DVector<f64>, at: &Here, beside: &Here) -> Option<DVector<f64>> {
        self.equations.factorise(&at.y, at.t).ok()??;
        let left = self.equations.apply(mode);
        self.equations.factorise(&beside.y, beside.t).ok()??;
        let row = Row { y: mode.normalize(), t: 0.0 };
        let bordered = Bordered::new(self.equations, &row.y, &row);
        bordered.solve(self.equations, (&left, 0.0)).map(|(off, _)| off)
    }
}
