//! A configuration to start from: force densities.
//!
//! With the same force per length in every member the joints lie where a linear system says. The
//! multiplicative iteration `F/l <- F/l · |d|/l` brings the lengths towards the members' own while
//! every member keeps pulling: it ascends the dual of the problem in which all members are cables.
//! It costs a scalar factorisation each, a small part of one of the matrix of all coordinates.
//!
//! H.-J. Schek, Comput. Methods Appl. Mech. Eng. 3 (1974) 115-134, doi:10.1016/0045-7825(74)90045-0

use model::Vector;

use crate::error::Error;
use crate::net::factor::{Block, Factor};
use crate::net::frame::{Frame, Rod, Spot};
use crate::net::shape::Shape;
use crate::thresholds::RIDGE;
use crate::vector::{dot, norm};

/// Multiplicative updates of the force densities: lengths are within some per cent after that many,
/// and more of them converge slowly.
const UPDATES: usize = 5;

/// The most by which one update changes a density.
const CLAMP: f64 = 20.0;

/// A strand has at least this part of the length of its rope: the density of one without length has no
/// bound.
const NO_STRAND: f64 = 1e-3;

/// A joint that moves has this one coordinate in the scalar system, for each of the three axes
/// alike.
const SCALAR: Spot = Spot { first: 0, freedom: 1, axes: [[1.0, 0.0, 0.0]; 3] };

/// The linear system of the force densities: scalar where joints are free or fixed, else with all
/// coordinates.
struct Densities {
    spots: Vec<Spot>,
    factor: Factor,
    scalar: bool,
}

impl Densities {
    fn new(frame: &Frame) -> Result<Self, Error> {
        let scalar = frame.spots.iter().all(|spot| spot.freedom == 0 || spot.freedom == 3);
        let mut spots = frame.spots.clone();
        if scalar {
            let mut first = 0;
            for spot in &mut spots {
                if spot.freedom > 0 {
                    *spot = Spot { first, ..SCALAR };
                    first += 1;
                }
            }
        }
        let factor = Factor::new(&spots, &frame.rods, &frame.meter)?;
        Ok(Self { spots, factor, scalar })
    }

    /// Places of the joints in balance with given densities.
    fn places(&mut self, frame: &Frame, density: &[f64]) -> Result<Vec<Vector>, Error> {
        let sizes = frame.sizes(|e| density[e] * frame.rods[e].length);
        let block = |e: usize| Block { isotropic: density[e], ..Block::default() };
        for shift in [0.0, RIDGE] {
            self.factor.fill(&self.spots, &frame.rods, &block, &|joint| shift * sizes[joint]);
            if self.factor.definite() {
                return Ok(self.solve(frame, density));
            }
        }
        Err(Error::NotFinite { quantity: "force density" })
    }

    fn solve(&mut self, frame: &Frame, density: &[f64]) -> Vec<Vector> {
        // From the supports, where free joints lie at the origin.
        let mut forces = frame.loads.clone();
        for (e, rod) in frame.rods.iter().enumerate() {
            let d = frame.span(&frame.supports, e);
            for k in 0..3 {
                forces[rod.from][k] += density[e] * d[k];
                forces[rod.to][k] -= density[e] * d[k];
            }
        }
        if !self.scalar {
            let mut step = frame.reduced(&forces);
            self.factor.solve(&mut step);
            return frame.moved(&frame.supports, 1.0, &step);
        }
        let n = self.factor.size();
        let mut right = vec![0.0; 3 * n];
        for (spot, force) in self.spots.iter().zip(&forces).filter(|(spot, _)| spot.freedom > 0) {
            for k in 0..3 {
                right[k * n + spot.first] = force[k];
            }
        }
        self.factor.solve(&mut right);
        let place = |(spot, &support): (&Spot, &Vector)| match spot.freedom {
            0 => support,
            _ => std::array::from_fn(|k| right[k * n + spot.first]),
        };
        self.spots.iter().zip(&frame.supports).map(place).collect()
    }
}

/// A hanging configuration in which all members pull, lengths not quite kept.
pub(super) fn hanging(frame: &Frame) -> Result<Shape, Error> {
    let mut densities = Densities::new(frame)?;
    let free = |rod: &Rod| if rod.ground { 0.0 } else { 1.0 / rod.length };
    let mut density: Vec<f64> = frame.rods.iter().map(free).collect();
    let mut x = densities.places(frame, &density)?;
    for update in 0..UPDATES {
        let stretch: Vec<f64> = frame
            .rods
            .iter()
            .enumerate()
            .map(|(e, rod)| {
                let length = || frame.whole(e, |strand| norm(frame.span(&x, strand)));
                if rod.ground { 1.0 } else { length() / rod.length }
            })
            .collect();
        // At first all alike: the sag is that of the mean length.
        let mean = stretch[..frame.members].iter().sum::<f64>() / frame.members as f64;
        for (density, stretch) in density.iter_mut().zip(stretch) {
            let ratio = if update == 0 { mean } else { stretch };
            *density *= ratio.clamp(1.0 / CLAMP, CLAMP);
        }
        share_in_ropes(frame, &x, &mut density);
        x = densities.places(frame, &density)?;
    }
    // The floor pushes each joint with a part of the loads, whose sum is one.
    let push = 1.0 / frame.joints as f64;
    let force = frame.rods.iter().zip(&density);
    let force = force.map(|(rod, w)| if rod.ground { push } else { w * rod.length });
    let mut force: Vec<f64> = force.collect();
    for rope in &frame.ropes {
        force[rope[0]] = mean_force(frame, &x, &density, rope);
    }
    frame.spread(&mut force);
    Ok(Shape { x, force })
}

/// The force of a rope whose strands have these densities: its mean over the length.
fn mean_force(frame: &Frame, x: &[Vector], density: &[f64], rope: &[usize]) -> f64 {
    let square = |e: &usize| dot(frame.span(x, *e), frame.span(x, *e));
    let work: f64 = rope.iter().map(|e| density[*e] * square(e)).sum();
    let length: f64 = rope.iter().map(|e| square(e).sqrt()).sum();
    if length > 0.0 { work / length } else { density[rope[0]] * frame.rods[rope[0]].length }
}

/// Give the strands of each rope the densities of one force.
fn share_in_ropes(frame: &Frame, x: &[Vector], density: &mut [f64]) {
    for rope in &frame.ropes {
        let force = mean_force(frame, x, density, rope);
        for e in rope {
            let least = NO_STRAND * frame.rods[*e].length;
            density[*e] = force / norm(frame.span(x, *e)).max(least);
        }
    }
}
