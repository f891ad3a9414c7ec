//! The second-order cone bound: bars as cables.

use model::Problem;

use crate::configuration::Configuration;
use crate::data::{Data, Sense};
use crate::error::BoundError;
use crate::polish::{CLOSED, Signed};
use crate::program::{Affine, ConeEvidence, Program};
use crate::pull::lower_bound;
use crate::settings::BoundSettings;

/// A bar of a chain that is not taut is called slack when it is shorter than its length by more
/// than this fraction, a thousand times the solver's tolerance.
const SLACK: f64 = 1e-6;

/// What the second-order cone programme says.
#[derive(Debug, Clone, PartialEq)]
pub struct CableBound {
    /// The solver's value, J: good to about its tolerance, and no proof.
    pub bound_j: f64,
    /// The proved value, J: no configuration in space has less energy, whatever the rounding. See
    /// [`pull_bound`](crate::pull_bound).
    pub rigorous_j: f64,
    /// The chain of cables that attains the bound, with its axial forces, none negative.
    pub cables: Configuration,
    /// Numbers, from 1, of the bars that are shorter than they ought to be, and carry no force.
    /// When there is none the cables are the chain: its equilibrium of least energy. (Whether they
    /// are is decided to full accuracy, which of them are slack to the solver's.)
    pub slack: Vec<usize>,
    /// How the programme was solved.
    pub evidence: ConeEvidence,
}

impl CableBound {
    /// By how much an energy, J, is above the rigorous bound.
    #[must_use]
    pub fn gap_j(&self, energy_j: f64) -> f64 {
        energy_j - self.rigorous_j
    }

    /// Whether every bar is taut, so that the cables are the chain itself.
    #[must_use]
    pub fn is_equilibrium(&self) -> bool {
        self.slack.is_empty()
    }
}

/// Bound the energy of all configurations from below by that of a chain of cables, a second-order
/// cone programme of one cone per bar; for any number of bars.
///
/// In terms of the pull q (see [`pull_bound`](crate::pull_bound)):
///
/// $$ \max_{q,\,t}\; q \cdot D - \sum_i l_i t_i \quad\text{with}\quad |q - c_i e_Z| \le t_i , $$
///
/// in the vertical plane of the anchors, which is exact: the cables of least energy lie in it. The
/// multipliers of the cones are the bar vectors. Only the two components of q couple the bars, so
/// the work per iteration is proportional to their number.
///
/// # Errors
///
/// [`BoundError`]: a setting out of range, or a programme that clarabel does not solve.
///
/// ```
/// use bounds::{BoundSettings, cable_bound};
/// use model::{Anchors, Bar, Chain, Problem};
/// // Two bars of weight 1 N hang in an equilateral triangle: V = -√3/2.
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [1.0, 0.0, 0.0] };
/// let chain = Chain::new("two bars", 1.0, anchors, vec![Bar::homogeneous(1.0, 1.0)?; 2])?;
/// let bound = cable_bound(&Problem::new(chain)?, &BoundSettings::default())?;
/// assert!(bound.is_equilibrium());
/// assert!((bound.rigorous_j + 0.75_f64.sqrt()).abs() < 1e-14);
/// // The joint carries 1 N: twice the axial force times sin 60°.
/// assert!((bound.cables.axial_n[0] - 1.0 / 3.0_f64.sqrt()).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn cable_bound(problem: &Problem, settings: &BoundSettings) -> Result<CableBound, BoundError> {
    let sense = Sense::Lower;
    let data = Data::new(problem, sense);
    let plane = data.plane(problem);
    let n = data.bars();

    // Variables: q across and up, then t_i.
    let mut cost = vec![-plane.span, -plane.height];
    cost.extend(data.length.iter().map(|l| l.mid()));
    let mut program = Program::minimise(cost);
    for (i, tail) in data.tail_weight.iter().enumerate() {
        program.second_order(&[
            Affine::new(0.0, [(2 + i, 1.0)]),
            Affine::new(0.0, [(0, 1.0)]),
            Affine::new(-tail.mid(), [(1, 1.0)]),
        ]);
    }
    let (solution, evidence) = program.solve(settings)?;
    let raw = [solution.x[0], solution.x[1]];
    let sign = vec![1.0; n];
    let signed = Signed::new(&data, &plane, &sign);
    let value = |q: [f64; 2]| lower_bound(&data, plane.lift(q));

    // Bars that close the chain with the forces of this pull are a stationary point of a concave
    // function: its maximum, the solution. There is none when a cable is slack.
    let closed = signed.close(raw);
    let taut = closed.open <= CLOSED;
    let (mut pull, bars, slack) = if taut {
        let bars: Vec<_> = (0..n).map(|i| signed.bar(closed.q, i)).collect();
        (closed.q, bars, Vec::new())
    } else {
        let bars: Vec<_> = solution.z.chunks_exact(3).map(|z| [-z[1], -z[2]]).collect();
        let slack: Vec<usize> = (0..n)
            .filter(|&i| bars[i][0].hypot(bars[i][1]) < (1.0 - SLACK) * data.length[i].mid())
            .collect();
        // A slack bar carries nothing, and that says what the pull is.
        let pull = slack.first().map_or(raw, |&i| [0.0, data.tail_weight[i].mid()]);
        (pull, bars, slack)
    };
    evidence.accept(taut)?;
    if value(raw) > value(pull) {
        pull = raw;
    }

    let axial: Vec<f64> = (0..n).map(|i| signed.axial(pull, i)).collect();
    Ok(CableBound {
        bound_j: sense.energy(data.scale, -solution.obj_val),
        rigorous_j: sense.rigorous(data.scale, value(pull)),
        cables: Configuration::new(problem, sense, &data, &plane, &bars, &axial, pull),
        slack: slack.into_iter().map(|i| i + 1).collect(),
        evidence,
    })
}
