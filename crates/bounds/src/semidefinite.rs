//! The semidefinite bound.

use model::{Problem, Vector};

use crate::configuration::Configuration;
use crate::data::{Data, Plane, Sense};
use crate::error::BoundError;
use crate::polish::{CLOSED, Signed};
use crate::program::{Affine, ConeEvidence, Program};
use crate::settings::BoundSettings;
use crate::stress::{Proof, certify};

use dense_lapack::other_library;

/// Gap between the energy of a configuration and a rigorous bound below which the configuration is
/// taken for the optimum, of the largest force (or the total weight) times the total length, within
/// a factor four. Far above the rounding of either (1e-14), far below what another equilibrium
/// leaves.
const PROVED: f64 = 1e-12;

/// What the semidefinite programme says.
#[derive(Debug, Clone, PartialEq)]
pub struct SemidefiniteBound {
    /// Which side of the energy.
    pub sense: Sense,
    /// The solver's value, J: good to about its tolerance when the status is solved, and no proof.
    pub bound_j: f64,
    /// The proved value, J: no configuration in space has less energy (more, for an upper bound),
    /// whatever the rounding. See [`stress_bound`](crate::stress_bound).
    pub rigorous_j: f64,
    /// By what fraction the force densities had to be raised for the proof: 0, or a few roundings
    /// where the stress matrix of the optimum is singular.
    pub raised: f64,
    /// The configuration that attains the bound, without any guess, when the solution is one: its
    /// bars fit between the anchors with the axial forces of the dual. `None` when the solution is
    /// a mixture of configurations, or no nearby one closes.
    pub optimiser: Option<Configuration>,
    /// How the programme was solved.
    pub evidence: ConeEvidence,
}

impl SemidefiniteBound {
    /// By how much an energy, J, is above the rigorous bound (below, for an upper bound). Never
    /// negative for the energy of a configuration, but for the rounding of the energy itself.
    #[must_use]
    pub fn gap_j(&self, energy_j: f64) -> f64 {
        self.sense.sign() * (energy_j - self.rigorous_j)
    }
}

/// Bound the energy of all configurations in space by a semidefinite programme, without a guess,
/// and find the configuration that attains the bound. See the [crate documentation](crate) for the
/// programme and why it is tight.
///
/// The work grows with the number of bars, and so does the solver's loss of digits: up to a
/// thousand bars or so it knows the signs of the forces, which is all that the rest needs.
///
/// The solver's judgement of itself is not what the answer rests on. If it ends without a solution
/// (almost solved is not solved) there is an answer all the same when its last iterate leads to a
/// configuration whose energy is that of the rigorous bound; `evidence.status` tells.
///
/// # Errors
///
/// [`BoundError`]: a setting out of range, a programme that was not solved, a dual solution that
/// cannot be rounded to a proof, or another BLAS or LAPACK in the process.
///
/// ```
/// use bounds::{BoundSettings, Sense, semidefinite};
/// let problem = model::cases::paper();
/// let mgl = problem.chain().gravity_m_s2(); // m = 1 kg, l = 1 m
/// let lower = semidefinite(&problem, Sense::Lower, &BoundSettings::default())?;
/// let upper = semidefinite(&problem, Sense::Upper, &BoundSettings::default())?;
/// // The paper measures from 6 mgl below: 2.33546865 (ix), and the maximum, which it never finds.
/// assert!((lower.rigorous_j / mgl + 6.0 - 2.335_468_651_999_305).abs() < 1e-13);
/// assert!((upper.rigorous_j / mgl + 6.0 - 3.664_531_348_000_695).abs() < 1e-13);
/// # Ok::<(), bounds::BoundError>(())
/// ```
pub fn semidefinite(
    problem: &Problem,
    sense: Sense,
    settings: &BoundSettings,
) -> Result<SemidefiniteBound, BoundError> {
    // Clarabel's calls find their routines by name, so another library would answer some of them.
    if let Some(library) = other_library() {
        return Err(BoundError::OtherLapack { library });
    }
    let data = Data::new(problem, sense);
    let plane = data.plane(problem);
    let (stress, evidence) = solve(&data, &plane, settings)?;

    let sign: Vec<f64> = stress.axial.iter().map(|f| 1.0_f64.copysign(*f)).collect();
    let signed = Signed::new(&data, &plane, &sign);
    let raw = stress.pull(&data);
    let mut proof = certificate(&data, &plane, &signed, raw, Some(&stress.axial));
    let mut optimiser: Option<([f64; 2], f64)> = None;
    // The programme knows the square of the horizontal pull, and not well when it is small. No bar
    // carries less than that, and a chain may hang straight down.
    let least = stress.axial.iter().fold(f64::INFINITY, |least, f| f.abs().min(least));
    for across in [raw[0], -raw[0], least, -least, 0.0] {
        let pull = signed.close([across, raw[1]]);
        let attempt = certificate(&data, &plane, &signed, pull.q, None);
        if better(attempt, proof) {
            proof = attempt;
        }
        let energy = signed.energy(pull.q);
        if pull.open <= CLOSED && optimiser.is_none_or(|(_, least)| energy < least) {
            optimiser = Some((pull.q, energy));
        }
    }
    let proof = proof.ok_or(BoundError::NotCertified)?;
    let force = stress.axial.iter().fold(1.0_f64, |most, f| f.abs().max(most));
    let proved = |(_, energy): &([f64; 2], f64)| (energy - proof.value).abs() <= PROVED * force;
    evidence.accept(optimiser.as_ref().is_some_and(proved))?;
    let optimiser = optimiser.map(|(q, _)| {
        let bars: Vec<_> = (0..data.bars()).map(|i| signed.bar(q, i)).collect();
        let axial: Vec<_> = (0..data.bars()).map(|i| signed.axial(q, i)).collect();
        Configuration::new(problem, sense, &data, &plane, &bars, &axial, q)
    });
    Ok(SemidefiniteBound {
        sense,
        bound_j: sense.energy(data.scale, stress.value),
        rigorous_j: sense.rigorous(data.scale, proof.value),
        raised: proof.raised,
        optimiser,
        evidence,
    })
}

fn better(new: Option<Proof>, old: Option<Proof>) -> bool {
    match (new, old) {
        (Some(new), Some(old)) => new.value > old.value,
        (Some(_), None) => true,
        (None, _) => false,
    }
}

/// The proof around the bars of this pull, with its own axial forces or those given.
fn certificate(
    data: &Data,
    plane: &Plane,
    signed: &Signed<'_>,
    q: [f64; 2],
    axial: Option<&[f64]>,
) -> Option<Proof> {
    let bars: Vec<Vector> = (0..data.bars()).map(|i| plane.lift(signed.bar(q, i))).collect();
    let tau: Vec<f64> = data
        .length
        .iter()
        .enumerate()
        .map(|(i, l)| axial.map_or_else(|| signed.axial(q, i), |f| f[i]) / l.mid())
        .collect();
    certify(data, &bars, &tau)
}

/// The solution of the programme.
struct Stress {
    /// The least value of the energy, without units.
    value: f64,
    /// τ_i l_i.
    axial: Vec<f64>,
    /// Mean height of the joints 0..=n.
    height: Vec<f64>,
}

impl Stress {
    /// The pull that the heights and the axial forces belong to; its horizontal part is positive.
    fn pull(&self, data: &Data) -> [f64; 2] {
        let (mut up, mut weight) = (0.0, 0.0);
        let vertical =
            |i: usize| self.axial[i] / data.length[i].mid() * (self.height[i + 1] - self.height[i]);
        // Longer bars know their direction better.
        for i in 0..data.bars() {
            let square = data.length[i].mid().powi(2);
            up += square * (vertical(i) + data.tail_weight[i].mid());
            weight += square;
        }
        let mut across = 0.0;
        for i in 0..data.bars() {
            let square = data.length[i].mid().powi(2);
            across += square * (self.axial[i].powi(2) - vertical(i).powi(2));
        }
        [(across / weight).max(0.0).sqrt(), up / weight]
    }
}

/// Where the variables are: the axial forces, then u, g, e of joints 2..n−1, then what the last
/// joint costs along Z and across.
struct Variables {
    bars: usize,
}

impl Variables {
    const PER_JOINT: usize = 3;

    fn cost_up(&self) -> usize {
        self.bars + Self::PER_JOINT * (self.bars - 2)
    }

    fn count(&self, across: bool) -> usize {
        self.cost_up() + 1 + usize::from(across)
    }

    /// u, g or e (`which` = 0, 1, 2) of joint `k` = 2..n−1.
    fn joint(&self, k: usize, which: usize) -> usize {
        self.bars + Self::PER_JOINT * (k - 2) + which
    }
}

/// Set up and solve the programme in the form of springs in a row; see the
/// [crate documentation](crate).
///
/// With joints 1..k−1 eliminated, what is left of the Lagrangian is a function of joint k,
/// $\tfrac12 u_k |x|^2 + g_k z + e_k$: a spring u_k to the first anchor, a weight g_k. Eliminating
/// joint k as well keeps a lower bound, for all x and y,
///
/// $$ \tfrac12 u_k |x|^2 + (g_k + W_k) x_Z + e_k + \tfrac12 \tau_{k+1} |y - x|^2
///    \;\ge\; \tfrac12 u_{k+1} |y|^2 + g_{k+1} y_Z + e_{k+1} , $$
///
/// which for the coordinate Z is a semidefinite 3 × 3 matrix in (x, y, 1), and for the others
/// follows from it. With y = D the last joint is eliminated for each coordinate by itself.
fn solve(
    data: &Data,
    plane: &Plane,
    settings: &BoundSettings,
) -> Result<(Stress, ConeEvidence), BoundError> {
    let n = data.bars();
    let length: Vec<f64> = data.length.iter().map(|l| l.mid()).collect();
    let weight: Vec<f64> = data.joint_weight.iter().map(|w| w.mid()).collect();
    let at = Variables { bars: n };
    let across = plane.span > 0.0;

    // minimise ½ Σ τ_i l_i² − ½ τ_n |D|² − e_{n−1} + ½ γ_Z + ½ γ_h, in terms of τ_i l_i.
    let mut cost = vec![0.0; at.count(across)];
    for i in 0..n {
        cost[i] = 0.5 * length[i];
    }
    cost[n - 1] -= 0.5 * (plane.span.powi(2) + plane.height.powi(2)) / length[n - 1];
    if n > 2 {
        cost[at.joint(n - 1, 2)] = -1.0;
    }
    for gamma in &mut cost[at.cost_up()..] {
        *gamma = 0.5;
    }
    let mut program = Program::minimise(cost);

    let tau = |i: usize, factor: f64| (i, factor / length[i]);
    // u_k + τ_{k+1}, and g_k + W_k, for joint k.
    let pivot = |k: usize| {
        let u = if k == 1 { tau(0, 1.0) } else { (at.joint(k, 0), 1.0) };
        Affine::new(0.0, [u, tau(k, 1.0)])
    };
    let load = |k: usize| {
        let load = Affine::new(weight[k - 1], []);
        if k == 1 { load } else { load.with(at.joint(k, 1), 1.0) }
    };
    // Where the height of joint k stands among the dual variables, and what it is divided by.
    let mut moments = Vec::with_capacity(n - 1);
    for k in 1..n - 1 {
        let left =
            if k == 1 { Affine::default() } else { Affine::new(0.0, [(at.joint(k, 2), 2.0)]) };
        let first = program.semidefinite(&[
            &[pivot(k)],
            &[
                Affine::new(0.0, [tau(k, -1.0)]),
                Affine::new(0.0, [tau(k, 1.0), (at.joint(k + 1, 0), -1.0)]),
            ],
            &[
                load(k),
                Affine::new(0.0, [(at.joint(k + 1, 1), -1.0)]),
                left.with(at.joint(k + 1, 2), -2.0),
            ],
        ]);
        moments.push((first + 3, first + 5));
    }
    let k = n - 1;
    let towards = |distance: f64| tau(k, -distance);
    let (variable, coefficient) = towards(plane.height);
    let first = program.semidefinite(&[
        &[pivot(k)],
        &[load(k).with(variable, coefficient), Affine::new(0.0, [(at.cost_up(), 1.0)])],
    ]);
    moments.push((first + 1, first + 2));
    if across {
        program.semidefinite(&[
            &[pivot(k)],
            &[Affine::new(0.0, [towards(plane.span)]), Affine::new(0.0, [(at.cost_up() + 1, 1.0)])],
        ]);
    }

    let (solution, evidence) = program.solve(settings)?;
    let mut height = vec![0.0];
    height.extend(
        moments
            .iter()
            .map(|(x, one)| solution.z[*x] * std::f64::consts::FRAC_1_SQRT_2 / solution.z[*one]),
    );
    height.push(plane.height);
    let stress = Stress {
        value: weight[n - 1] * plane.height - solution.obj_val,
        axial: solution.x[..n].to_vec(),
        height,
    };
    Ok((stress, evidence))
}
