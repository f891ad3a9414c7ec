use std::sync::Arc;

use model::{Problem, Stability};

use crate::error::Error;
use crate::run::closure::Shape;
use crate::run::curvature::Curvature;
use crate::run::scaled_chain::ScaledChain;
use crate::run::seed::Seed;
use crate::run::settings::Motion;
use crate::run::slope::Slope;
use crate::run::vertical_plane::Turn;
use crate::vector::norm;

/// Second-order behaviour, and how well it is decided.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SecondOrder {
    /// Indices and characters.
    pub stability: Stability,
    /// Dimension of the null space of the second derivative together with the closure rows, in
    /// space: motions of zero curvature, the free turn about vertical anchors among them, and
    /// forces that the closure leaves undetermined (all bars on one line).
    pub nullity: usize,
    /// Ratio of the largest to the smallest size of the curvatures that are not zero, in space: the
    /// largest is that of a single bar, the smallest is enclosed to about ten per cent.
    pub condition: f64,
    /// Largest force across a bar, over the largest force or the weight: how far the directions
    /// are from an equilibrium.
    pub residual: f64,
    /// Distance of the last joint from the end anchor, over the total length.
    pub gap: f64,
}

/// The Morse indices of any equilibrium, whoever found it, in O(n).
///
/// The directions are taken as they are; [`SecondOrder::residual`] and [`SecondOrder::gap`] say how
/// far they are from an equilibrium, and the indices mean little if that is far.
///
/// # Errors
///
/// [`Error::SeedSize`] and [`Error::SeedDirection`] as for a seed.
///
/// ```
/// use model::{InPlane, InSpace};
/// let problem = model::cases::paper();
/// // E2, the paper's chain upside down: theta, alpha, beta by 40-digit root finding.
/// let e2 = [73.920_588_792_231_34_f64, -38.599_136_184_451_89, -19.694_867_976_133_02];
/// let seed = energy::Seed::angles(&problem, &e2.map(f64::to_radians))?;
/// let found = energy::second_order(&problem, &seed)?;
/// assert!(found.residual < 1e-14 && found.gap < 1e-14);
/// assert_eq!((found.stability.in_plane, found.stability.index_in_plane), (InPlane::Maximum, 1));
/// assert_eq!((found.stability.in_space, found.stability.index_in_space), (InSpace::Unstable, 2));
/// # Ok::<(), energy::Error>(())
/// ```
pub fn second_order(problem: &Problem, directions: &Seed) -> Result<SecondOrder, Error> {
    let (links, units) = ScaledChain::new(problem, Motion::Space);
    let u = directions.in_frame(&links, &units)?;
    let moments = links.measure(&u);
    let shape = Shape { u, moments };
    let slope = Slope::new(&links, &shape);
    if !slope.mean.is_finite() {
        return Err(Error::NotFinite { quantity: "projected gradient" });
    }
    let links = Arc::new(links);
    let curvature = Curvature { links, shape: Arc::new(shape), slope: Arc::new(slope) };
    Ok(SecondOrder::new(&curvature))
}

impl SecondOrder {
    pub(crate) fn new(place: &Curvature) -> Self {
        let links = &place.links;
        let space = if links.motion == Motion::Space {
            place.clone()
        } else {
            Curvature {
                links: Arc::new(ScaledChain { motion: Motion::Space, ..(**links).clone() }),
                ..place.clone()
            }
        };
        let plane = in_plane(&space);
        let zero = place.slope.zero;

        let index_in_plane = plane.index(zero);
        let is_degenerate = plane.index(-zero) + plane.undecided(-zero) > index_in_plane;
        let index_in_space = space.index(zero);
        let indices = [index_in_plane, index_in_space];
        let flat = space.index(-zero) - index_in_space;
        let rank = space.rank();
        let free = usize::from(space.links.turns());
        // A chain straight up and down does not change when it turns.
        let turn = free.min((rank + 1).saturating_sub(3));
        let undetermined = (3 + turn).saturating_sub(rank);
        Self {
            stability: Stability::of(indices, plane.dimension(), is_degenerate),
            nullity: flat + turn + undetermined,
            condition: space.condition(zero),
            residual: place.slope.residual(),
            gap: norm(place.shape.moments.gap) / links.total(),
        }
    }
}

/// The same equilibrium among the motions in its own vertical plane.
fn in_plane(space: &Curvature) -> Curvature {
    let mut links = (*space.links).clone();
    let turn = Turn::into_plane(&links, &space.shape.u);
    let u = turn.flattened(&space.shape.u);
    links.motion = Motion::Plane;
    let moments = links.measure(&u);
    let shape = Shape { u, moments };
    let slope = Slope::new(&links, &shape);
    Curvature { links: Arc::new(links), shape: Arc::new(shape), slope: Arc::new(slope) }
}
