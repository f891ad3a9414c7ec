//! A point of a path with its tangent, and how to get to the next one.

use nalgebra::DVector;

use super::Equations;
use super::bordered::{Bordered, Row};

/// Newton's method ends at this size of the residual, or where it falls no further, below the other.
const TIGHT: f64 = 1e-14;
const LOOSE: f64 = 1e-9;
/// A point at which more is left of the equations is not given, thirty times their rounding: next to a singular one the corrector
/// stalls, and the judge of statics, in units up to ten times as fine, allows 1e-11.
pub(super) const GIVEN: f64 = 3e-13;
/// Iterations of the corrector; from a fair prediction it takes three.
pub(super) const ITERATIONS: usize = 12;
/// A residual that has not fallen to this part in an iteration is at rounding, or the corrector
/// diverges.
pub(super) const FALLS: f64 = 0.5;
/// Step of the difference for the derivative by the parameter.
const DIFFERENCE: f64 = 1e-5;

/// An equilibrium, or what is left of the equations where there is none.
pub(super) type Corrected = Result<(DVector<f64>, f64), f64>;

/// A point with its tangent.
#[derive(Debug, Clone)]
pub(super) struct Here {
    pub(super) y: DVector<f64>,
    pub(super) t: f64,
    pub(super) tangent: Row,
    pub(super) index: usize,
}

/// Squared weight of the places in the length of the path.
#[derive(Debug, Clone, Copy)]
pub(super) struct Metric {
    pub(super) places: usize,
    pub(super) square: f64,
}

/// A change of places by so much, in units of length, counts as much as the whole range of the parameter where paths branch
/// off.
const LARGE: f64 = 0.05;

/// The equations, and what measures a way along their paths.
pub(super) struct Space<'a, Q> {
    pub(super) equations: &'a mut Q,
    pub(super) metric: Metric,
}

impl Metric {
    /// In which places count by the size of the structure, however far the first path moves them: small changes do not count
    /// for more than large ones of the parameter, and no wide range makes large ones small.
    pub(super) fn coarse(self) -> Self {
        Self { square: LARGE.powi(-2), ..self }
    }

    pub(super) fn norm(&self, y: &DVector<f64>, t: f64) -> f64 {
        (self.square * y.rows(0, self.places).norm_squared() + t * t).sqrt()
    }

    /// In this direction, of unit length.
    pub(super) fn unit(&self, y: DVector<f64>, t: f64) -> Row {
        let norm = self.norm(&y, t).max(f64::MIN_POSITIVE);
        Row { y: y / norm, t: t / norm }
    }

    /// How far two points are apart.
    pub(super) fn apart(&self, a: &Here, b: &Here) -> f64 {
        let way = a.towards(b);
        self.norm(&way.y, way.t)
    }

    /// The unit vector from one point to another.
    pub(super) fn towards(&self, from: &Here, to: &Here) -> Row {
        let way = from.towards(to);
        self.unit(way.y, way.t)
    }

    /// The row that measures along a direction.
    pub(super) fn along(&self, direction: &Row) -> Row {
        let mut y = DVector::zeros(direction.y.len());
        y.rows_mut(0, self.places).axpy(self.square, &direction.y.rows(0, self.places), 0.0);
        Row { y, t: direction.t }
    }
}

/// $\partial G/\partial t$ by a difference, on one side where the other has no meaning.
///
/// # Errors
///
/// Where the parameter has no meaning.
pub fn difference<Q: Equations + ?Sized>(
    equations: &mut Q,
    y: &DVector<f64>,
    t: f64,
) -> Result<DVector<f64>, Q::Error> {
    let h = DIFFERENCE;
    let mut at = |t: f64| equations.residual(y, t).map(|(rows, _)| rows);
    match (at(t - h), at(t + h)) {
        (Ok(before), Ok(after)) => Ok((after - before) / (2.0 * h)),
        (Ok(before), Err(_)) => Ok((at(t)? * 3.0 - before * 4.0 + at(t - 2.0 * h)?) / (2.0 * h)),
        (Err(_), Ok(after)) => Ok((after * 4.0 - at(t)? * 3.0 - at(t + 2.0 * h)?) / (2.0 * h)),
        (Err(error), Err(_)) => Err(error),
    }
}

/// The equilibrium next to a guess, along a row; `Err` in the option with what is left where there is
/// none.
pub(super) fn correct<Q: Equations>(
    equations: &mut Q,
    guess: (&DVector<f64>, f64),
    row: &Row,
) -> Result<Corrected, Q::Error> {
    let column = equations.by_parameter(guess.0, guess.1)?;
    let (mut y, mut t) = (equations.onto(guess.0, guess.1)?, guess.1);
    let (mut last, mut best, mut least) = (f64::INFINITY, None, f64::INFINITY);
    for _ in 0..ITERATIONS {
        let (left, size) = equations.residual(&y, t)?;
        if size < least {
            (best, least) = (Some((y.clone(), t)), size);
        }
        let done = size <= TIGHT || (least <= LOOSE && size >= FALLS * last);
        if done || size.is_nan() {
            break;
        }
        last = size;
        if equations.factorise(&y, t)?.is_none() {
            break;
        }
        let off = row.dot(&(&y - guess.0), t - guess.1);
        let step = Bordered::new(equations, &column, row).solve(equations, (&-left, -off));
        let Some((dy, dt)) = step else { break };
        t += dt;
        // Astray, where the numbers mean nothing.
        let Ok(there) = equations.onto(&(y + dy), t) else { break };
        y = there;
    }
    Ok(match best {
        Some(best) if least <= LOOSE => Ok(best),
        _ => Err(least),
    })
}

/// The same point with what is left of rounding taken out by the factor that is there, if that helps.
fn polished<Q: Equations>(
    equations: &mut Q,
    (y, t): (DVector<f64>, f64),
    across: &Bordered<'_>,
) -> Result<(DVector<f64>, f64), Q::Error> {
    let (left, size) = equations.residual(&y, t)?;
    let Some((dy, dt)) = across.solve(equations, (&-left, 0.0)) else { return Ok((y, t)) };
    // At an end of the range the parameter stays.
    let later = if across.row.y.amax() > 0.0 { t + dt } else { t };
    let better = equations.onto(&(&y + dy), later)?;
    let (_, after) = equations.residual(&better, later)?;
    Ok(if after < size { (better, later) } else { (y, t) })
}

impl<Q: Equations> Space<'_, Q> {
    /// Whether a point is as much of an equilibrium as points of paths are to be.
    pub(super) fn is_exact(&mut self, at: &Here) -> Result<bool, Q::Error> {
        Ok(self.equations.residual(&at.y, at.t)?.1 <= GIVEN)
    }

    /// A point, corrected across the first row, with its tangent, of which the second says the direction;
    /// `None` when it has none.
    pub(super) fn here(
        &mut self,
        (y, t): (DVector<f64>, f64),
        [across, row]: [&Row; 2],
    ) -> Result<Option<Here>, Q::Error> {
        let column = self.equations.by_parameter(&y, t)?;
        let Some(index) = self.equations.factorise(&y, t)? else { return Ok(None) };
        let mut bordered = Bordered::new(self.equations, &column, across);
        let (y, t) = polished(self.equations, (y, t), &bordered)?;
        // Most often both rows are one, and so is the factor.
        if !std::ptr::eq(across, row) {
            bordered = Bordered::new(self.equations, &column, row);
        }
        let tangent = bordered.solve(self.equations, (&DVector::zeros(y.len()), 1.0));
        let tangent = tangent.map(|(dy, dt)| self.metric.unit(dy, dt));
        let given = self.equations.given(&y, t)?;
        let tangent = tangent.map(|tangent| match given {
            None => tangent,
            Some(given) => self.metric.unit(tangent.y + given * tangent.t, tangent.t),
        });
        let finite = tangent.filter(|tangent| tangent.t.is_finite() && tangent.y.sum().is_finite());
        Ok(finite.map(|tangent| Here { y, t, tangent, index }))
    }

    /// The point with the tangent on the chord between two others, at this part of it.
    pub(super) fn between(&mut self, from: &Here, to: &Here, part: f64) -> Option<Here> {
        self.next_to([from, to], (&from.towards(to), part))
    }

    /// The point with the tangent next to what is at this part of the way between two others, across a chord.
    pub(super) fn next_to(
        &mut self,
        [from, to]: [&Here; 2],
        (chord, part): (&Row, f64),
    ) -> Option<Here> {
        let row = self.metric.along(chord);
        let way = from.towards(to);
        let guess = (&from.y + &way.y * part, from.t + way.t * part);
        let found = correct(self.equations, (&guess.0, guess.1), &row).ok()?.ok()?;
        self.here(found, [&row, &row]).ok()?
    }
}

impl Here {
    /// The same with the tangent the other way.
    pub(super) fn turned(self) -> Self {
        Self { tangent: Row { y: -self.tangent.y, t: -self.tangent.t }, ..self }
    }

    /// The vector to another point.
    pub(super) fn towards(&self, other: &Self) -> Row {
        Row { y: &other.y - &self.y, t: other.t - self.t }
    }
}
