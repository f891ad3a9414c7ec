//! From the accuracy of a cone solver to that of the numbers themselves.
//!
//! With the signs of the axial forces known (+1 tension, −1 compression) the bars of an equilibrium
//! are $d_i = s_i\, l_i F_i / |F_i|$ with $F_i = q - c_i e_Z$, and closing the chain,
//! $\sum d_i = D$, is two equations for the pull q in the vertical plane of the anchors. They are
//! the stationarity of the dual function $q \cdot D - \sum s_i l_i |F_i|$, and Newton's method on
//! them adds the digits that an interior point method leaves out. Nothing that is proved rests on
//! it: the bounds hold for every q, and a polished q is used only where it gives the better one.

use intervals::CompensatedSum;

use crate::data::{Data, Plane};

/// Steps at most; quadratic convergence from nine digits takes two.
const MAX_STEPS: usize = 20;
/// Halvings of a step that does not come nearer to closing.
const MAX_HALVINGS: usize = 20;

/// How far bars may end from the last anchor, of the unit of length (within a factor two of the
/// total length), to count as a configuration. Newton's method leaves 1e-16, and 1e-13 where the
/// forces are a thousand times the weight; what does not converge leaves the solver's 1e-9 or more.
pub(crate) const CLOSED: f64 = 1e-12;

/// The pull of a chain, in its plane (across, up), and how well it closes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pull {
    /// q.
    pub(crate) q: [f64; 2],
    /// |Σ d_i − D|, without units.
    pub(crate) open: f64,
}

/// A chain with given signs of its axial forces.
pub(crate) struct Signed<'a> {
    length: Vec<f64>,
    tail: Vec<f64>,
    sign: &'a [f64],
    target: [f64; 2],
}

impl<'a> Signed<'a> {
    pub(crate) fn new(data: &Data, plane: &Plane, sign: &'a [f64]) -> Self {
        Self {
            length: data.length.iter().map(|l| l.mid()).collect(),
            tail: data.tail_weight.iter().map(|c| c.mid()).collect(),
            sign,
            target: [plane.span, plane.height],
        }
    }

    /// F_i for this pull.
    pub(crate) fn force(&self, q: [f64; 2], i: usize) -> [f64; 2] {
        [q[0], q[1] - self.tail[i]]
    }

    /// s_i |F_i|.
    pub(crate) fn axial(&self, q: [f64; 2], i: usize) -> f64 {
        let [across, up] = self.force(q, i);
        self.sign[i] * across.hypot(up)
    }

    /// d_i for this pull.
    pub(crate) fn bar(&self, q: [f64; 2], i: usize) -> [f64; 2] {
        let [across, up] = self.force(q, i);
        let factor = self.sign[i] * self.length[i] / across.hypot(up);
        [factor * across, factor * up]
    }

    /// Number of bars.
    pub(crate) fn bars(&self) -> usize {
        self.length.len()
    }

    /// Σ c_i d_iZ for this pull.
    #[cfg(feature = "sdp")]
    pub(crate) fn energy(&self, q: [f64; 2]) -> f64 {
        model::sum((0..self.bars()).map(|i| self.tail[i] * self.bar(q, i)[1]))
    }

    fn gap(&self, q: [f64; 2]) -> [f64; 2] {
        let mut sums = [CompensatedSum::default(); 2];
        for i in 0..self.bars() {
            for (sum, d) in sums.iter_mut().zip(self.bar(q, i)) {
                sum.add(d);
            }
        }
        for (sum, target) in sums.iter_mut().zip(self.target) {
            sum.add(-target);
        }
        sums.map(|sum| sum.value())
    }

    /// The step of Newton's method against a gap.
    fn step(&self, q: [f64; 2], gap: [f64; 2]) -> [f64; 2] {
        // d(d_i)/dq = s_i l_i / |F_i| (1 - f f^T), f = F_i / |F_i|.
        let (mut across, mut mixed, mut up) = (0.0, 0.0, 0.0);
        for i in 0..self.bars() {
            let [x, z] = self.force(q, i);
            let size = x.hypot(z);
            let compliance = self.sign[i] * self.length[i] / size;
            let (x, z) = (x / size, z / size);
            across += compliance * (z * z);
            mixed -= compliance * (x * z);
            up += compliance * (x * x);
        }
        let determinant = across * up - mixed * mixed;
        [
            -(up * gap[0] - mixed * gap[1]) / determinant,
            -(across * gap[1] - mixed * gap[0]) / determinant,
        ]
    }

    /// Newton's method from `start`; where it ends is never worse than where it began.
    pub(crate) fn close(&self, start: [f64; 2]) -> Pull {
        let mut q = start;
        let mut gap = self.gap(q);
        let mut open = size(gap);
        'steps: for _ in 0..MAX_STEPS {
            let step = self.step(q, gap);
            let mut fraction = 1.0;
            for _ in 0..MAX_HALVINGS {
                let trial = [q[0] + fraction * step[0], q[1] + fraction * step[1]];
                let gap_there = self.gap(trial);
                let open_there = size(gap_there);
                // A gap that is not a number was infinitely far and stays so.
                if open_there < open {
                    (q, gap, open) = (trial, gap_there, open_there);
                    continue 'steps;
                }
                fraction *= 0.5;
            }
            break;
        }
        Pull { q, open }
    }
}

fn size(gap: [f64; 2]) -> f64 {
    let size = gap[0].hypot(gap[1]);
    if size.is_nan() { f64::INFINITY } else { size }
}
