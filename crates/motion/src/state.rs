use model::Vector;
use numerics::two_sum;

use crate::mechanism::{Link, Mechanism};
use numerics::vector::{dot, minus, norm, plus, times, worse};

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

    pub(crate) fn length_m(&self, spans: &[Link]) -> f64 {
        spans.iter().map(|span| norm(self.between(span.a, span.b))).sum()
    }

    /// The vectors of the rows of the constraints; the largest violation, relative to the lengths.
    pub(crate) fn rows(&self, mechanism: &Mechanism, vectors: &mut [Vector]) -> f64 {
        let mut off = 0.0;
        for bar in &mechanism.bars {
            let (spans, vectors) = (mechanism.of(&bar.spans), &mut vectors[bar.spans.clone()]);
            for (span, vector) in spans.iter().zip(vectors.iter_mut()) {
                *vector = self.between(span.a, span.b);
            }
            let squared = match vectors {
                [d] => dot(*d, *d),
                _ => squared(vectors.iter().copied()),
            };
            off = worse(off, half_excess(squared, bar.length_m).abs());
            gradient(vectors, squared);
        }
        let length_m = mechanism.system.total_length_m();
        let slides = mechanism.slides.iter().zip(&mut vectors[mechanism.rigid_spans()..]);
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

/// `s²` of the sum `s` of the lengths of spans.
#[inline]
pub(crate) fn squared(mut spans: impl Iterator<Item = Vector>) -> f64 {
    let Some(first) = spans.next() else { return 0.0 };
    let Some(second) = spans.next() else { return dot(first, first) };
    let length = norm(first) + norm(second) + spans.map(norm).sum::<f64>();
    length * length
}

/// The gradient of `s²/2` by each span: `s u`, which is the span itself where it is the only one.
/// Zero of a span of no length.
#[inline]
pub(crate) fn gradient(spans: &mut [Vector], squared: f64) {
    if spans.len() > 1 {
        for d in spans {
            let length = norm(*d);
            let scale = if length > 0.0 { squared.sqrt() / length } else { 0.0 };
            *d = times(scale, *d);
        }
    }
}

/// Rate of `s²/2` where the spans `d` change with the rates `w`: `s Σ u · w`.
pub(crate) fn rate(spans: impl Iterator<Item = [Vector; 2]> + Clone) -> f64 {
    let length: f64 = spans.clone().map(|[d, _]| norm(d)).sum();
    let parts = spans.map(|[d, w]| [dot(d, w), norm(d)]);
    parts.filter(|[_, size]| *size > 0.0).map(|[along, size]| along * (length / size)).sum()
}

/// Second derivative of `s²/2` where the spans `d` change with the rates `w`:
///
/// $$ (\sum_i u_i \cdot w_i)^2 + s \sum_i \frac{|w_i|^2 - (u_i \cdot w_i)^2}{|d_i|}, $$
///
/// `|w|²` where there is one span alone.
#[inline]
pub(crate) fn curvature(spans: impl Iterator<Item = [Vector; 2]> + Clone) -> f64 {
    let mut rest = spans.clone();
    if let (Some([_, w]), None) = (rest.next(), rest.next()) {
        return dot(w, w);
    }
    let (mut length, mut rate, mut turning) = (0.0, 0.0, 0.0);
    for [d, w] in spans {
        let distance = norm(d);
        let along = if distance > 0.0 { dot(d, w) / distance } else { 0.0 };
        length += distance;
        rate += along;
        turning += if distance > 0.0 { (dot(w, w) - along * along) / distance } else { 0.0 };
    }
    rate * rate + length * turning
}

/// `(d² − l²) / (2 l²)`: the relative excess of a length, to first order.
#[inline]
pub(crate) fn half_excess(squared: f64, length: f64) -> f64 {
    0.5 * (squared - length * length) / (length * length)
}

#[cfg(test)]
mod tests {
    use super::*;
    use numerics::vector::add_times;

    /// Spans that change evenly, alone and together: the differences of half the square of their length.
    #[test]
    fn rates_and_curvatures_are_differences_of_half_the_square() {
        let spans = [
            [[1.0, 2.0, -0.5], [0.3, -0.7, 1.1]],
            [[-0.2, 0.6, 0.9], [1.9, 0.4, -0.15]],
            [[0.35, -0.1, 0.05], [-0.6, 0.25, 0.8]],
        ];
        for count in 1..=spans.len() {
            let spans = &spans[..count];
            let half_square = |t: f64| {
                let length: f64 = spans.iter().map(|[d, w]| norm(add_times(*d, t, *w))).sum();
                0.5 * length * length
            };
            let [less, here, more] = [-1e-4, 0.0, 1e-4].map(half_square);
            let rate = rate(spans.iter().copied());
            assert!((rate - (more - less) / 2e-4).abs() < 1e-6, "{count}: {rate}");
            let curvature = curvature(spans.iter().copied());
            let wanted = (more - 2.0 * here + less) / 1e-8;
            assert!((curvature - wanted).abs() < 1e-5, "{count}: {curvature} {wanted}");
        }
    }
}
