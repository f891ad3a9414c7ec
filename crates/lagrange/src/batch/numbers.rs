//! The numbers of a chain in its vertical plane.

use model::Problem;

use crate::larger::larger;

/// One bar, in units of the total length and weight.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Bar {
    /// $l_i$.
    pub length: f64,
    /// $c_i$: weight between joint 0 and the averaged section of the bar.
    pub carried: f64,
}

/// A chain without dimensions.
#[derive(Debug, Clone)]
pub(crate) struct Numbers {
    pub bars: Vec<Bar>,
    /// From the first to the last anchor: along the heading and up.
    pub span: [f64; 2],
    /// Unit vector (X, Y) of the plane, from the first anchor towards the last; +Y if they are on
    /// one vertical.
    pub heading: [f64; 2],
    /// Total weight times total length, J.
    pub unit_j: f64,
}

impl Numbers {
    pub fn of(problem: &Problem) -> Self {
        let chain = problem.chain();
        let total_m = chain.total_length_m();
        let weight_n = chain.total_mass_kg() * chain.gravity_m_s2();
        let mut before = 0.0;
        let bars = chain
            .bars()
            .iter()
            .map(|bar| {
                let weight = bar.mass_kg() * chain.gravity_m_s2() / weight_n;
                let lever = (bar.length_m() - bar.centre_m()) / bar.length_m();
                let carried = before + lever * weight;
                before += weight;
                Bar { length: bar.length_m() / total_m, carried }
            })
            .collect();
        let [x, y, z] = chain.anchors().difference_m().map(|d| d / total_m);
        let level = x.hypot(y);
        let heading = if level > 0.0 { [x / level, y / level] } else { [0.0, 1.0] };
        Self { bars, span: [level, z], heading, unit_j: weight_n * total_m }
    }

    /// $V = \sum_i (1 - c_i)\\, l_i u_i \cdot e_z$: each bar lifts what hangs after it. J above
    /// joint 0.
    pub fn energy_j(&self, directions: &[[f64; 2]]) -> f64 {
        let bars = self.bars.iter().zip(directions);
        self.unit_j * bars.map(|(bar, u)| (1.0 - bar.carried) * bar.length * u[1]).sum::<f64>()
    }

    /// The largest equation, as [`Settings::tolerance`](crate::Settings::tolerance) means it:
    /// moment rows in units of the largest force times the mean length, closure in units of the
    /// total length.
    pub fn largest(&self, directions: &[[f64; 2]], pull: [f64; 2]) -> f64 {
        let mut gap = [-self.span[0], -self.span[1]];
        let mut largest = 0.0_f64;
        // In these units no square that matters leaves the range, and a root is the same
        // everywhere.
        let size = |up: f64| (pull[0] * pull[0] + up * up).sqrt();
        let mean = 1.0 / self.bars.len() as f64;
        let unit = size(pull[1]).max(size(pull[1] + 1.0)).max(mean) * mean;
        for (bar, u) in self.bars.iter().zip(directions) {
            gap[0] += bar.length * u[0];
            gap[1] += bar.length * u[1];
            let moment = -u[1] * pull[0] + u[0] * (pull[1] + bar.carried);
            largest = larger(largest, bar.length * moment.abs() / unit);
        }
        larger(larger(largest, gap[0].abs()), gap[1].abs())
    }
}
