//! Places and velocities, with the rounding of the places kept.

use model::Vector;
use numerics::two_sum;

use crate::mechanism::Mechanism;
use numerics::vector::{dot, minus, plus, worse};

/// Places and velocities by slot.
///
/// A place is the sum of two doubles. The vector of a bar far out in a long chain then keeps its
/// digits, and the rounding of millions of steps does not add up.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub at: Vec<Vector>,
    rest: Vec<Vector>,
    pub velocity: Vec<Vector>,
}

impl State {
    pub(crate) fn at_rest(at: Vec<Vector>) -> Self {
        let none = vec![[0.0; 3]; at.len()];
        Self { at, rest: none.clone(), velocity: none }
    }

    /// Move the slots that move.
    pub(crate) fn displace(&mut self, by: &[Vector]) {
        for ((at, rest), by) in self.at.iter_mut().zip(&mut self.rest).zip(by) {
            for k in 0..3 {
                let (sum, lost) = two_sum(at[k], by[k]);
                let rest_k = rest[k] + lost;
                at[k] = sum + rest_k;
                rest[k] = rest_k - (at[k] - sum);
            }
        }
    }

    /// Vector from one slot to another.
    #[inline]
    pub(crate) fn between(&self, a: usize, b: usize) -> Vector {
        plus(minus(self.at[b], self.at[a]), minus(self.rest[b], self.rest[a]))
    }

    /// The vectors of the rows of the constraints; the largest violation, relative to the lengths.
    pub(crate) fn rows(&self, mechanism: &Mechanism, vectors: &mut [Vector]) -> f64 {
        let mut off = 0.0;
        for (link, vector) in mechanism.bars.iter().zip(vectors.iter_mut()) {
            let d = self.between(link.a, link.b);
            *vector = d;
            off = worse(off, half_excess(dot(d, d), link.length_m).abs());
        }
        let length_m = mechanism.system.total_length_m();
        let slides = mechanism.slides.iter().zip(&mut vectors[mechanism.bars.len()..]);
        for (slide, vector) in slides {
            *vector = slide.normal;
            let from = minus(self.at[slide.slot], slide.at);
            let exact = plus(from, self.rest[slide.slot]);
            off = worse(off, (dot(slide.normal, exact) / length_m).abs());
        }
        off
    }

    /// Largest speed of a slot, m/s.
    pub(crate) fn largest_speed(&self) -> f64 {
        self.velocity.iter().map(|v| dot(*v, *v)).fold(0.0, worse).sqrt()
    }
}

/// `(d² − l²) / (2 l²)`: the relative excess of a length, to first order.
#[inline]
pub(crate) fn half_excess(squared: f64, length: f64) -> f64 {
    0.5 * (squared - length * length) / (length * length)
}
