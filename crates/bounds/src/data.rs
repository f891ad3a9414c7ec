//! The problem without units, with the rounding of its own numbers.
//!
//! Lengths are divided by a power of two near the total length, weights by one near the total
//! weight: the numbers of every chain are then of size one, whatever its units, and the division is
//! exact. What the doubles of the chain do not determine exactly (a product m g, a ratio r / l, a
//! difference of coordinates) is carried as an interval, so that a bound speaks of the chain as
//! given and not of a rounded neighbour.

use intervals::{Interval, IntervalSum, lever};
use model::Problem;
#[cfg(feature = "cones")]
use model::Vector;

/// Which side of the energy a bound is on.
///
/// ```
/// use bounds::{Sense, stress_bound};
/// use model::{Anchors, Bar, Chain, Problem};
/// // Two bars of 1 m and 1 N stand as a triangle of equal sides: no shape has more energy.
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
/// let chain = Chain::new("arch", 1.0, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 2])?;
/// let height = 0.75_f64.sqrt();
/// let joints = [[0.0; 3], [0.5, 0.0, height], [1.0, 0.0, 0.0]];
/// // Both are compressed: the joint carries 1 N, and 2 τ height = -1.
/// let density = [-0.5 / height; 2];
/// let bound = stress_bound(&Problem::new(chain)?, Sense::Upper, &joints, &density).unwrap();
/// assert!(bound.rigorous_j >= height && bound.rigorous_j < height + 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sense {
    /// No configuration has less energy: the bound belongs to the global minimum.
    Lower,
    /// No configuration has more energy: the bound belongs to the global maximum. It is the lower
    /// bound of the chain with gravity reversed, with its sign changed.
    Upper,
}

impl Sense {
    /// +1 or −1: the factor of all weights.
    pub(crate) fn sign(self) -> f64 {
        match self {
            Self::Lower => 1.0,
            Self::Upper => -1.0,
        }
    }

    /// The energy of the problem as posed, J, from the least value of the problem solved.
    #[cfg(feature = "cones")]
    pub(crate) fn energy(self, scale: Scale, value: f64) -> f64 {
        self.sign() * scale.length * (scale.weight * value)
    }

    /// [`energy`](Self::energy), rounded away from the configurations.
    pub(crate) fn rigorous(self, scale: Scale, value: f64) -> f64 {
        let energy = Interval::point(scale.length)
            * (Interval::point(scale.weight) * Interval::point(value));
        match self {
            Self::Lower => energy.lo(),
            Self::Upper => -energy.lo(),
        }
    }
}

/// Units, both powers of two.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Scale {
    /// Unit of length, m.
    pub(crate) length: f64,
    /// Unit of force, N.
    pub(crate) weight: f64,
}

impl Scale {
    /// A force density without its unit.
    pub(crate) fn without_force_density(self, value_n_m: f64) -> f64 {
        value_n_m * self.length / self.weight
    }
}

/// The chain without units; gravity reversed for [`Sense::Upper`].
#[derive(Debug, Clone)]
pub(crate) struct Data {
    pub(crate) scale: Scale,
    /// l_i.
    pub(crate) length: Vec<Interval>,
    /// W_k, the weight at joints k = 1..n, each bar's shared between its ends by the lever rule.
    pub(crate) joint_weight: Vec<Interval>,
    /// c_i = Σ of W_k over k = i..n: the energy is Σ c_i d_iZ.
    pub(crate) tail_weight: Vec<Interval>,
    /// D, from the first anchor to the last.
    pub(crate) difference: [Interval; 3],
}

impl Data {
    pub(crate) fn new(problem: &Problem, sense: Sense) -> Self {
        let chain = problem.chain();
        let gravity = Interval::point(sense.sign() * chain.gravity_m_s2());
        let scale = Scale {
            length: power_of_two_below(chain.total_length_m()),
            weight: power_of_two_below(chain.total_mass_kg() * chain.gravity_m_s2()),
        };
        let per_length = Interval::point(scale.length);
        let per_weight = Interval::point(scale.weight);

        let length: Vec<_> =
            chain.bars().iter().map(|bar| Interval::point(bar.length_m()) / per_length).collect();
        // Weight of each bar, and the part that its far joint carries.
        let carried: Vec<_> = chain
            .bars()
            .iter()
            .map(|bar| {
                let weight = Interval::point(bar.mass_kg()) * gravity / per_weight;
                let [_, far] =
                    lever(Interval::point(bar.length_m()), Interval::point(bar.centre_m()));
                (weight, weight * far)
            })
            .collect();
        let joint_weight: Vec<_> = (0..carried.len())
            .map(|k| match carried.get(k + 1) {
                Some((weight, far)) => carried[k].1 + (*weight - *far),
                None => carried[k].1,
            })
            .collect();

        let mut below = IntervalSum::ZERO;
        let mut tail_weight = vec![Interval::ZERO; carried.len()];
        for (tail, (weight, far)) in tail_weight.iter_mut().zip(&carried).rev() {
            *tail = below.value() + *far;
            below.add(*weight);
        }

        let anchors = chain.anchors();
        let difference = std::array::from_fn(|k| {
            let mut sum = IntervalSum::ZERO;
            sum.add(Interval::point(anchors.end_m[k]));
            sum.add(Interval::point(-anchors.start_m[k]));
            sum.value() / per_length
        });
        Self { scale, length, joint_weight, tail_weight, difference }
    }

    /// Number of bars.
    pub(crate) fn bars(&self) -> usize {
        self.length.len()
    }

    /// The vertical plane of the anchors; OYZ, the paper's choice, when they are on one vertical.
    #[cfg(feature = "cones")]
    pub(crate) fn plane(&self, problem: &Problem) -> Plane {
        /// Of the total length; a span this small (or subnormal) has no direction that can be
        /// computed, and no effect on an energy. Nothing is decided by it: what is proved takes the
        /// anchors as they are.
        const NO_DIRECTION: f64 = f64::EPSILON * f64::EPSILON;
        let [x, y, z] = problem.chain().anchors().difference_m().map(|x| x / self.scale.length);
        let span = x.hypot(y);
        if span > NO_DIRECTION {
            Plane { direction: [x / span, y / span], span, height: z }
        } else {
            Plane { direction: [0.0, 1.0], span: 0.0, height: z }
        }
    }
}

/// The vertical plane of the anchors, and D in it.
#[cfg(feature = "cones")]
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plane {
    /// Horizontal unit vector.
    pub(crate) direction: [f64; 2],
    /// D along it, not negative.
    pub(crate) span: f64,
    /// D along Z.
    pub(crate) height: f64,
}

#[cfg(feature = "cones")]
impl Plane {
    /// The vector with these two components.
    pub(crate) fn lift(&self, [across, up]: [f64; 2]) -> Vector {
        [self.direction[0] * across, self.direction[1] * across, up]
    }
}

/// The largest power of two that is not above a positive number.
fn power_of_two_below(x: f64) -> f64 {
    /// Bits of the exponent of a double.
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(x.to_bits() & EXPONENT).max(f64::MIN_POSITIVE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two() {
        for (x, expected) in [(1.0, 1.0), (3.9, 2.0), (1e-3, 1.0 / 1024.0), (4096.0, 4096.0)] {
            assert!((power_of_two_below(x) - expected).abs() <= 0.0, "{x}");
        }
        assert!(power_of_two_below(5e-324) > 0.0);
        assert!(power_of_two_below(f64::MAX).is_finite());
    }

    /// Three equal bars: the joints carry mg, mg and mg/2, in units of 2 mg (a power of two below
    /// 3).
    #[test]
    fn lumped_weights_of_the_paper() {
        let mut data = Data::new(&model::cases::paper(), Sense::Lower);
        let unit = data.tail_weight[0].mid() / 2.5;
        let expected = [2.5, 1.5, 0.5];
        for (tail, expected) in data.tail_weight.iter().zip(expected) {
            assert!((tail.mid() / unit - expected).abs() < 1e-15);
            // A handful of operations, each rounded outward on both sides.
            assert!(tail.hi() - tail.lo() < 16.0 * f64::EPSILON);
        }
        for (weight, expected) in data.joint_weight.drain(..).zip([1.0, 1.0, 0.5]) {
            assert!((weight.mid() / unit - expected).abs() < 1e-15);
        }
    }
}
