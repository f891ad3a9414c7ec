//! Load paths: one curve of equilibria of any system over a parameter, through limit points and
//! branch points, stable and unstable parts, and kinks where one-sided conditions change.
//!
//! With the equations $G(y, t) = 0$ of any model ([`Equations`]) and the tangent $\tau$ of unit
//! length in $\omega^2 |x|^2 + t^2$, where $x$ are the places among the unknowns and $\omega$ is such
//! that both change alike at the start, a step of length $h$ predicts $(y, t) + h \tau$ and corrects it
//! across the tangent (pseudo-arclength):
//!
//! $$ G(y, t) = 0, \qquad \tau \cdot \big((y, t) - \text{predicted}\big) = 0 . $$
//!
//! The bordered matrix is regular where $J = \partial G/\partial y$ is singular in a limit point.
//!
//! | event | test |
//! |---|---|
//! | limit point | $\tau_t$ changes its sign |
//! | branch point | the number of negative directions changes, $\tau_t$ does not vanish; the null vector $\phi$ of $J$ has $\phi \cdot \partial G/\partial t = 0$ |
//! | kink | the value of a one-sided condition changes its sign: the member or the joint changes sides there |
//!
//! Changes of the inertia that two branch points within one step undo are not seen. Other paths
//! through a branch point are followed on demand ([`Settings::branches`]).
//!
//! # References
//!
//! E. L. Allgower, K. Georg, Numerical Continuation Methods, Springer 1990,
//! doi:10.1007/978-3-642-61257-2. W. Govaerts, J. D. Pryce, Mixed block elimination for linear
//! systems with wider borders, IMA J. Numer. Anal. 13 (1993) 161-180, doi:10.1093/imanum/13.2.161.

mod bordered;
mod circle;
mod crossings;
mod events;
mod here;
mod kinks;
mod linear;
mod singular;
mod walk;

pub use crossings::{MOST_PATHS, follow};
pub use here::difference;
pub use linear::linear_buckling;

use nalgebra::DVector;
use serde::Serialize;

/// A system of equations with a parameter, symmetric in its unknowns, as its model computes them.
#[expect(clippy::missing_errors_doc, reason = "said of the type of the errors")]
pub trait Equations {
    /// Names a one-sided condition.
    type Side: Copy + PartialEq;
    /// What is kept of a point of the path.
    type Record;
    /// Why there are no equations at some value of the parameter, or no memory to change sides.
    type Error;

    /// How many of the unknowns, the first ones, are places: these measure the path.
    fn places(&self) -> usize;

    /// The unknowns moved to where the model allows them; where all are free they stay.
    fn onto(&mut self, y: &DVector<f64>, _t: f64) -> Result<DVector<f64>, Self::Error> {
        Ok(y.clone())
    }

    /// $G(y, t)$, and its size, of which rounding leaves some 1e-14.
    fn residual(&mut self, y: &DVector<f64>, t: f64) -> Result<(DVector<f64>, f64), Self::Error>;

    /// $\partial G/\partial t$: by a difference, if the model knows no better.
    fn by_parameter(&mut self, y: &DVector<f64>, t: f64) -> Result<DVector<f64>, Self::Error> {
        difference(self, y, t)
    }

    /// How the unknowns that are given move with the parameter, as places of supports do; `None` when they
    /// do not.
    fn given(&mut self, _y: &DVector<f64>, _t: f64) -> Result<Option<DVector<f64>>, Self::Error> {
        Ok(None)
    }

    /// Factorise $J$: the number of directions in which the energy falls, nothing where it cannot be
    /// factorised.
    fn factorise(&mut self, y: &DVector<f64>, t: f64) -> Result<Option<usize>, Self::Error>;

    /// $J^{-1} r$ by the last factor, exactly or nearly.
    fn solve(&mut self, right: &DVector<f64>) -> DVector<f64>;

    /// $J y$ where it was last factorised, exactly.
    fn apply(&self, y: &DVector<f64>) -> DVector<f64>;

    /// The one-sided conditions with their values, which are positive where they hold.
    fn sides(&mut self, y: &DVector<f64>, t: f64) -> Result<Vec<(Self::Side, f64)>, Self::Error>;

    /// Change sides: whether the condition is active now (taut, on the floor).
    fn switch(&mut self, side: Self::Side) -> Result<bool, Self::Error>;

    /// What is kept of a point.
    fn record(
        &mut self,
        y: &DVector<f64>,
        t: f64,
        index: usize,
    ) -> Result<Self::Record, Self::Error>;
}

/// How a path is followed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Settings {
    /// The range of the parameter, which holds the start 0; the path begins towards 1.
    pub range: [f64; 2],
    /// Largest change of the parameter in a step.
    pub longest: f64,
    /// Most points of a path.
    pub max_points: usize,
    /// From how many branch points one after another other paths are followed: 0 for the path from
    /// the start alone.
    pub branches: usize,
}

/// A path with what happens on it.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadPath<Q: Equations> {
    /// Its points, from the start on; events are points too.
    pub points: Vec<Point<Q::Record>>,
    /// What happens, in the order of the path.
    pub events: Vec<Event<Q::Side>>,
    /// Why it ends.
    pub end: End<Q::Error>,
    /// The branch point in which it begins; of the first path none.
    pub parent: Option<Parent>,
}

/// A branch point: an event of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Parent {
    /// The number of the path.
    pub path: usize,
    /// The number of its event.
    pub event: usize,
}

/// A point of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Point<R> {
    /// The parameter.
    pub t: f64,
    /// Number of directions in which the energy falls; in an event that of the part before it.
    pub index: usize,
    /// The event that happens here, by its number.
    pub event: Option<usize>,
    /// What the model keeps.
    pub record: R,
}

/// What happens on a path.
#[derive(Debug, Clone, PartialEq)]
pub struct Event<S> {
    /// What it is.
    pub kind: Kind,
    /// The parameter.
    pub t: f64,
    /// The number of its point.
    pub point: usize,
    /// Number of directions in which the energy falls before and after it.
    pub index: [usize; 2],
    /// Whether the parameter turns back here.
    pub turns: bool,
    /// The conditions that change sides, and whether they are active from here on.
    pub sides: Vec<(S, bool)>,
    /// Where $J$ is singular its null vector: largest entry 1 among the places.
    pub mode: Vec<f64>,
    /// $|\phi \cdot \partial G/\partial t|$ over both norms: 0 in a branch point.
    pub load_on_mode: f64,
}

/// Kinds of events.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// The parameter turns back where the stiffness vanishes.
    #[serde(rename = "limit-point")]
    Limit,
    /// Other paths cross.
    #[serde(rename = "branch-point")]
    Branch,
    /// A one-sided condition changes sides: a cable or strut becomes slack or taut, a joint meets the floor or
    /// leaves it.
    Kink,
}

/// Why a path ends.
#[derive(Debug, Clone, PartialEq)]
pub enum End<E> {
    /// At an end of the range.
    Range,
    /// At the largest number of points.
    MaxPoints,
    /// No step, however short, leads on.
    Lost,
    /// Where places are open: many are in equilibrium at one value of the parameter.
    Open,
    /// Where forces grow without bound, as in a line that is pulled straight.
    Unbounded,
    /// In a branch point of a path that is followed already.
    Joins(Parent),
    /// The numbers of the model have no meaning beyond.
    Numbers(E),
}

/// Why there is no path.
#[derive(Debug, Clone, PartialEq)]
pub enum NoPath<E> {
    /// No equilibrium at the start: what is left of the equations next to the shape given.
    Start {
        /// Their size.
        residual: f64,
    },
    /// The start is singular: no one path leads on from it.
    Singular,
    /// The numbers of the model have no meaning at the start.
    Numbers(E),
}
