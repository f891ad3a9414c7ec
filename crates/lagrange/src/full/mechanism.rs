//! The numbers of a chain that the equations need, in SI units or in the chain's own.

use model::Chain;
use nalgebra::{Matrix3, Vector3};

/// Lengths, centres, weights and anchors of a chain in some system of units.
#[derive(Debug, Clone)]
pub(crate) struct Mechanism {
    /// `l_i`.
    pub lengths: Vec<f64>,
    /// `r_i`.
    pub centres: Vec<f64>,
    /// `m_i g`.
    pub weights: Vec<f64>,
    /// Joint 0.
    pub start: Vector3<f64>,
    /// Joint n.
    pub end: Vector3<f64>,
    /// Whether the anchors are on one vertical.
    pub on_one_vertical: bool,
}

/// The units of a chain: with them every equation is free of dimensions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Units {
    /// m
    pub length: f64,
    /// N
    pub weight: f64,
}

impl Units {
    /// Total length and total weight: the unknowns then stay of order one for any number of bars.
    pub fn total(chain: &Chain) -> Self {
        // A chain without mass is no problem, but its equations can still be written down.
        let weight = chain.total_mass_kg() * chain.gravity_m_s2();
        Self { length: chain.total_length_m(), weight: if weight > 0.0 { weight } else { 1.0 } }
    }

    /// Mean length *l* and mean weight *mg*: the units of the paper's example.
    pub fn mean(chain: &Chain) -> Self {
        let bars = chain.bars().len() as f64;
        let total = Self::total(chain);
        Self { length: total.length / bars, weight: total.weight / bars }
    }
}

impl Mechanism {
    /// In SI units, anchors where they are.
    pub fn si(chain: &Chain) -> Self {
        let anchors = chain.anchors();
        Self {
            lengths: chain.bars().iter().map(model::Bar::length_m).collect(),
            centres: chain.bars().iter().map(model::Bar::centre_m).collect(),
            weights: chain.bars().iter().map(|b| b.mass_kg() * chain.gravity_m_s2()).collect(),
            start: anchors.start_m.into(),
            end: anchors.end_m.into(),
            on_one_vertical: chain.anchors_on_one_vertical(),
        }
    }

    /// In the given units, with joint 0 at the origin.
    pub fn scaled(chain: &Chain, units: Units) -> Self {
        let mut scaled = Self::si(chain);
        for length in scaled.lengths.iter_mut().chain(&mut scaled.centres) {
            *length /= units.length;
        }
        for weight in &mut scaled.weights {
            *weight /= units.weight;
        }
        scaled.start = Vector3::zeros();
        scaled.end = Vector3::from(chain.anchors().difference_m()) / units.length;
        scaled
    }

    /// The metric in which the gap at the last anchor and the pull are measured: along the chord
    /// $1/\sqrt{s}$ times as finely as across, with s the part of the length that the span does not
    /// need.
    ///
    /// A nearly straight chain has slopes of order $\sqrt s$ and a pull of order $1/\sqrt s$, and
    /// only a gap of order s can be closed along the chord, one of order $\sqrt s$ across. In this
    /// metric its equations are as well conditioned as those of a slack one.
    pub fn chord_metric(&self) -> Matrix3<f64> {
        let chord = self.end - self.start;
        let slack = 1.0 - chord.norm() / self.lengths.iter().sum::<f64>();
        let fine = 1.0 / slack.clamp(f64::EPSILON, 1.0).sqrt();
        chord.try_normalize(0.0).map_or(Matrix3::identity(), |chord| {
            Matrix3::identity() + chord * chord.transpose() * (fine - 1.0)
        })
    }

    /// Number of bars n.
    pub fn bars(&self) -> usize {
        self.lengths.len()
    }

    /// Unknowns of the configuration, 6n.
    pub fn coordinates(&self) -> usize {
        6 * self.bars()
    }

    /// Constraint functions and multipliers, 3(n+1).
    pub fn constraints(&self) -> usize {
        3 * (self.bars() + 1)
    }

    /// `c_i`: the weight between joint 0 and the averaged section of bar i, so that the force in
    /// bar i is $F_i = p_0 + c_i e_z$, with the pull $p_0 = -(\lambda_1, \lambda_2, \lambda_3)$.
    pub fn carried_weights(&self) -> Vec<f64> {
        let mut before = 0.0;
        let bars = self.weights.iter().zip(&self.centres).zip(&self.lengths);
        bars.map(|((weight, centre), length)| {
            let carried = before + (length - centre) / length * weight;
            before += weight;
            carried
        })
        .collect()
    }
}
