//! The shape of the planar configuration space, from the lengths alone.
//!
//! The positions of the chain in a vertical plane, together with the line between the anchors, are
//! the closed planar polygons with sides `l_1, ..., l_n, |D|` and one side held: the moduli space
//! of polygons modulo turns and shifts. If no such polygon is straight it is a closed manifold of
//! dimension n − 2, and Farber and Schütz give its homology by counting subsets of the sides. A
//! subset is short if it is shorter than the rest. With one longest side fixed,
//!
//! $$ b_k = a_k + a_{n-2-k}, \qquad k = 0, ..., n - 2, $$
//!
//! where `a_k` is the number of short subsets of k + 1 sides that contain the longest one (their
//! formula has m = n + 1 sides; its third term counts subsets exactly as long as the rest, which a
//! manifold has none of). Their Theorem 1 holds for any longest side, and both sides of it depend
//! only on which subsets are short; so sides that rounding cannot tell apart do no harm.
//!
//! If both anchors are one point there is no side |D|, and nothing is held: the space is the one of
//! the n bars times a circle, the direction of the first bar.
//!
//! M. Farber, D. Schütz, "Homology of planar polygon spaces", Geometriae Dedicata 125 (2007) 75-92,
//! doi:10.1007/s10711-007-9139-7, Theorem 1

use numerics::Interval;

use super::morse::alternating_sum;
use crate::run::closure::bar::size;
use crate::run::plane::system::System;

/// Betti numbers and Euler characteristic of a closed manifold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Topology {
    /// Betti numbers `b_0, b_1, ...` up to the dimension.
    pub betti: Vec<u64>,
    /// Euler characteristic `Σ (−1)^k b_k`.
    pub euler: i64,
}

/// Why the topology is not known.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[expect(missing_docs, reason = "a field is what the message says of it")]
pub enum TopologyError {
    /// Occurs when some bars and perhaps the span are together exactly as long as the others, or so
    /// nearly that rounding hides the difference: a straight position exists, and the configuration
    /// space is no manifold there.
    #[error("{}", model::Reason::StraightPosition { sides: sides.clone() })]
    Straight {
        /// Numbers of the sides, from 1; n + 1 is the line between the anchors.
        sides: Vec<usize>,
    },
    /// Occurs when there are fewer than three sides.
    #[error("{sides} sides make no polygon")]
    TooFewSides { sides: usize },
    /// Occurs when there are too many subsets of sides to count.
    #[error("{sides} sides have too many subsets to count")]
    TooManySides { sides: usize },
}

/// More subsets than those of so many sides are not counted: 2²⁵ take a second.
const MAX_SIDES: usize = 26;

impl Topology {
    /// The planar configuration space of a chain.
    /// [`TopologyError`] when a straight position exists (or may exist), or the chain is too long.
    pub(crate) fn of_system(system: &System) -> Result<Self, TopologyError> {
        let [x, z] = system.span;
        if x == Interval::ZERO && z == Interval::ZERO {
            return Ok(Self::polygons(&system.length)?.times_circle());
        }
        let span = match (x == Interval::ZERO, z == Interval::ZERO) {
            (true, _) => z.abs(),
            (_, true) => x.abs(),
            _ => size([x, z]),
        };
        let mut sides = system.length.clone();
        sides.push(span);
        Self::polygons(&sides)
    }

    /// Planar polygons with these sides, modulo turns and shifts.
    pub(crate) fn polygons(sides: &[Interval]) -> Result<Self, TopologyError> {
        if sides.len() < 3 {
            return Err(TopologyError::TooFewSides { sides: sides.len() });
        }
        if sides.len() > MAX_SIDES {
            return Err(TopologyError::TooManySides { sides: sides.len() });
        }
        let longest = (0..sides.len())
            .fold(0, |best, k| if sides[k].mid() > sides[best].mid() { k } else { best });
        let mut count =
            Count { sides, longest, short: vec![0; sides.len()], chosen: vec![longest] };
        count.walk(0, sides[longest])?;
        let dimension = sides.len() - 3;
        let betti: Vec<u64> =
            (0..=dimension).map(|k| count.short[k] + count.short[dimension - k]).collect();
        Ok(Self::from_betti(betti))
    }

    fn from_betti(betti: Vec<u64>) -> Self {
        let count: Vec<_> = betti.iter().map(|b| i64::try_from(*b).unwrap_or(i64::MAX)).collect();
        Self { euler: alternating_sum(&count), betti }
    }

    /// The product with a circle.
    pub(crate) fn times_circle(&self) -> Self {
        let mut betti = self.betti.clone();
        betti.push(0);
        for (k, b) in self.betti.iter().enumerate() {
            betti[k + 1] += b;
        }
        Self::from_betti(betti)
    }
}

/// The walk over all subsets that contain the longest side.
struct Count<'a> {
    sides: &'a [Interval],
    longest: usize,
    /// Number of short subsets by size less one.
    short: Vec<u64>,
    chosen: Vec<usize>,
}

impl Count<'_> {
    /// `difference` is the chosen sides less those refused, among all before `side`.
    fn walk(&mut self, side: usize, difference: Interval) -> Result<(), TopologyError> {
        if side == self.longest {
            return self.walk(side + 1, difference);
        }
        if side == self.sides.len() {
            if difference.contains(0.0) {
                let mut sides: Vec<usize> = self.chosen.iter().map(|k| k + 1).collect();
                sides.sort_unstable();
                return Err(TopologyError::Straight { sides });
            }
            if difference.hi() < 0.0 {
                self.short[self.chosen.len() - 1] += 1;
            }
            return Ok(());
        }
        self.walk(side + 1, difference - self.sides[side])?;
        self.chosen.push(side);
        self.walk(side + 1, difference + self.sides[side])?;
        self.chosen.pop();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn betti(sides: &[f64]) -> Vec<u64> {
        let sides: Vec<Interval> = sides.iter().map(|x| Interval::point(*x)).collect();
        Topology::polygons(&sides).unwrap().betti
    }

    /// Spaces known from the literature: Farber, "Invitation to Topological Robotics" (2008),
    /// chapter 1, doi:10.4171/054, and Kapovich and Millson, J. Differential Geom. 42 (1995)
    /// 133-164.
    #[test]
    fn known_polygon_spaces() {
        assert_eq!(betti(&[1.0, 1.0, 1.0]), [2], "a triangle and its mirror image");
        assert_eq!(betti(&[1.0, 1.0, 1.0, 2.0]), [1, 1], "one circle");
        assert_eq!(betti(&[1.0, 2.0, 2.0, 0.5]), [2, 2], "two circles");
        assert_eq!(betti(&[1.0; 5]), [1, 8, 1], "the surface of genus 4");
        assert_eq!(betti(&[1.0, 1.0, 1.0, 1.0, 3.0]), [1, 0, 1], "a sphere");
        assert_eq!(betti(&[1.0, 1.0, 1.0, 0.1, 0.1]), [2, 4, 2], "two tori");
        assert_eq!(betti(&[1.0; 7]), [1, 6, 30, 6, 1].map(|b: u64| b), "equal sides, seven");
    }

    #[test]
    fn straight_positions_are_named() {
        let sides: Vec<Interval> =
            [1.0, 1.0, 1.0, 1.0].iter().map(|x| Interval::point(*x)).collect();
        assert_eq!(Topology::polygons(&sides), Err(TopologyError::Straight { sides: vec![1, 4] }));
        let few = [Interval::ONE; 2];
        assert_eq!(Topology::polygons(&few), Err(TopologyError::TooFewSides { sides: 2 }));
        let many = [Interval::ONE; 40];
        assert_eq!(Topology::polygons(&many), Err(TopologyError::TooManySides { sides: 40 }));
    }

    /// Poincaré duality and the bound of Farber and Schütz's Theorem 2 on random sides.
    #[test]
    fn random_spaces_obey_duality() {
        use rand::{RngExt, SeedableRng};
        let mut rng = rand_chacha::ChaCha8Rng::seed_from_u64(1);
        for round in 0_u64..200 {
            let n = 3 + round % 7;
            let sides: Vec<f64> = (0..n).map(|_| rng.random_range(0.1..1.0)).collect();
            let betti = betti(&sides);
            assert!(betti.iter().eq(betti.iter().rev()), "{betti:?}");
            let total: u64 = betti.iter().sum();
            let choose = |n: u64, k: u64| (0..k).fold(1_u64, |c, j| c * (n - j) / (j + 1));
            assert!(
                total <= (1_u64 << (n - 1)) - choose(n - 1, (n - 1) / 2),
                "{sides:?} {betti:?}"
            );
        }
    }
}
