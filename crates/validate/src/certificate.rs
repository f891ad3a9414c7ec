//! The certificate of global minimality, O(n): no configuration of the chain has less energy.
//!
//! # The bound
//!
//! With $c_i = g\\,(l_i \sum_{j>i} m_j + m_i r_i)$ the energy of the chain is linear in the
//! directions of its bars, $V = \sum_i c_i\\, u_{i,z}$, and closure says $\sum_i l_i u_i = D$. So
//! for any vector $P$ and any numbers $\nu_i \ne 0$, with $G_i = l_i P - c_i e_z$ and
//! $\hat u_i = G_i/\nu_i$, every configuration has
//!
//! $$ V = P\cdot D - \sum_i \Big(\frac{|G_i|^2}{2\nu_i} + \frac{\nu_i}{2}\Big)
//!        + \frac12 \sum_i \nu_i\\,|u_i - \hat u_i|^2 . $$
//!
//! If all $\nu_i$ are positive the last sum can be dropped, and what remains is a lower bound; with
//! $\nu_i = |G_i|$ it is the energy of the chain as cables. If just one is negative, $\nu_k$, the
//! last sum is still bounded below, because closure ties $u_k$ to the others: with the force
//! densities $\tau_i = \nu_i / l_i^2$ it is at least $-|\tau_k|\\,(|s||e| + |e|^2/2)$ as soon as
//! $|\tau_k| \sum_{i\ne k} 1/\tau_i \le 1$, where $e = D - \sum_i l_i \hat u_i$ is the closure
//! error of the directions $\hat u_i$ (nothing but rounding at an equilibrium) and
//! $|s| \le |e| + l_k (1 + |\hat u_k|)$.
//!
//! That condition is the positive semidefiniteness of the stress matrix, the tridiagonal
//! $\Omega = \mathrm{tridiag}(-\tau_k,\ \tau_k + \tau_{k+1},\ -\tau_{k+1})$: its LDLᵀ pivots are
//! $\delta_k = \tau_{k+1}\\,\gamma_{k+1}/\gamma_k$ with the compliances
//! $\gamma_k = \sum_{i\le k} 1/\tau_i$, so its inertia is read from the signs of the $\tau_i$ and
//! of the running sums, without a factorisation that could lose them. Connelly's super stability
//! for a chain.
//!
//! Here $P$ is the reaction at the end anchor. Whatever its value, the bound holds; the better the
//! value, the smaller the gap to the energy found. All rounding errors are bounded and included.
//!
//! # The singular turn
//!
//! With both anchors on one vertical the whole chain turns freely about it, the stress matrix is
//! exactly singular, and no floating-point number can show that $\sum 1/\tau_i$ is not positive.
//! The compressed bar's $|\nu_k|$ is then reduced until it does, by about the rounding error of the
//! sum; this costs energy of the same size, which the gap contains.
//!
//! # References
//!
//! R. Connelly, Invent. Math. 66 (1982) 11-33, doi:10.1007/BF01404753 (stress matrices and global
//! minima); S. M. Rump, Acta Numerica 19 (2010) 287-449, doi:10.1017/S096249291000005X (rounding
//! error bounds).

mod highest;

pub use highest::certify_highest;

use crate::free::stored_rounding_m;
use crate::lever::{carried_kg, far_kg};
use model::{Bar, Chain, Equilibrium, NoCertificate, Optimal, Problem, Vector, sum};
use numerics::vector::norm;

/// Unit roundoff of doubles.
const U: f64 = 0.5 * f64::EPSILON;

/// Relative error, in units of `U`, allowed to each term of a sum below.
///
/// The longest chain of operations in a term is that of `l²/|G|`: the suffix mass (compensated, 2),
/// its product with gravity and the sum with the bar's own part (6), the norm (8), square, division
/// and the summation itself (6). 32 leaves room for second-order terms and for the roundings of the
/// error bound itself.
const TERM_ULPS: f64 = 32.0;

/// Roundings of the energy of what rests on the last anchor: its product, and what it is added to.
const STORED_ULPS: f64 = 4.0;

/// Largest gap, in units of the weight between the anchors × total length, that still counts as "no
/// configuration has less energy". Measured: 3e-15 for the paper's chain, below 1e-12 for all cases
/// of the registry (test below).
pub const GAP_TOLERANCE: f64 = 1e-10;

/// A bar pressed by less than this part of the forces carries none: bars that hang loose between
/// others are left with the solvers' tolerance, of either sign. With such a bar taken for one in
/// tension the bound holds all the same, and the gap contains what that costs, twice its force
/// times its length.
const NO_FORCE: f64 = 1e-12;

/// Proof that no configuration of the chain has less energy than `bound_j`.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Certificate {
    /// No configuration has less energy than this, J (from the height of joint 0).
    pub bound_j: f64,
    /// Energy found minus the lower bound, J.
    pub gap_j: f64,
    /// The same in units of the weight between the anchors (what the lever rule leaves on them does
    /// not count) × total length.
    pub gap: f64,
    /// Number of the bar in compression, from 1, if there is one.
    pub compressed_bar: Option<usize>,
    /// Whether the stress matrix is singular as far as doubles can tell: the turn about the
    /// vertical through both anchors.
    pub singular: bool,
}

impl Certificate {
    /// The proof of the rung `optimal`.
    pub fn proof(&self) -> Optimal {
        Optimal { gap: Some(self.gap), singular: self.singular }
    }
}

/// Certify that no configuration has less energy than the equilibrium found.
///
/// Only its end reaction, the signs of its axial forces, its last joint and its energy are used.
///
/// # Errors
/// [`NoCertificate`] when the bound proves nothing, with the reason.
///
/// ```
/// use validate::certificate::certify;
/// let problem = model::cases::paper();
/// let found = lagrange::solve(&problem, &lagrange::Settings::default())?.equilibrium;
/// let certificate = certify(&problem, &found)?;
/// // Bar 3 props the chain up, and the chain turns freely about the vertical of the anchors.
/// assert_eq!((certificate.compressed_bar, certificate.singular), (Some(3), true));
/// let bound = certificate.bound_j / 9.80665 + 6.0;
/// assert!(bound <= 2.335_468_651_999_31 && bound > 2.335_468_65);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certify(problem: &Problem, found: &Equilibrium) -> Result<Certificate, NoCertificate> {
    let end_m = *found.joints_m.last().ok_or(NoCertificate::Unusable)?;
    certify_pulled(problem, found.reactions_n.end, end_m, &found.axial_n, found.energy_j)
}

/// The same from nothing but what is used: of a long row the rest is large.
pub(crate) fn certify_pulled(
    problem: &Problem,
    pull: Vector,
    end_m: Vector,
    axial_n: &[f64],
    energy_j: f64,
) -> Result<Certificate, NoCertificate> {
    let chain = problem.chain();
    let bars = chain.bars();
    if axial_n.len() != bars.len()
        || !pull.iter().chain(axial_n).chain([&energy_j]).all(|x| x.is_finite())
    {
        return Err(NoCertificate::Unusable);
    }
    let length_m = chain.total_length_m();
    closed(chain, end_m)?;
    // What the last bar leaves on its anchor moves nothing: without it the numbers are no larger
    // than what hangs.
    let resting_n = last_part(bars) * chain.gravity_m_s2();
    let pull = [pull[0], pull[1], pull[2] - resting_n];
    let force_n = norm(pull) + hanging_n(chain);
    let compressed = the_compressed_bar(axial_n, force_n)?;

    let forces = bar_forces(bars, chain.gravity_m_s2(), pull);
    let (mut nu_k, mut singular) = (0.0, false);
    if let Some(k) = compressed {
        (nu_k, singular) = reduced_compression(bars, &forces, force_n, k)?;
    }

    // P.D - sum (|G|^2 / 2 nu + nu / 2), where nu = |G| makes the bracket |G|.
    let difference = chain.anchors().difference_m();
    let cables = sum(forces.iter().enumerate().map(|(i, force)| {
        let g = bars[i].length_m() * norm(*force);
        if Some(i) == compressed { 0.5 * (g * (g / nu_k) + nu_k) } else { g }
    }));
    let work = sum((0..3).map(|c| pull[c] * difference[c]));
    let slack_j =
        compressed.map_or(0.0, |k| closure_slack(bars, &forces, force_n, difference, k, nu_k));
    let rounding_j = TERM_ULPS * U * (force_n * (length_m + norm(difference)))
        + STORED_ULPS * U * resting_n * difference[2].abs();
    let bound_j = resting_n * difference[2] + (work - cables - slack_j - 2.0 * rounding_j);
    let gap_j = energy_j - bound_j;
    let gap = gap_j / (hanging_n(chain) * length_m);
    // An energy below a proven bound is as wrong as one far above it; NaN fails both.
    if !(0.0..=GAP_TOLERANCE).contains(&gap) {
        return Err(NoCertificate::Gap { gap });
    }
    let compressed_bar = compressed.map(|k| k + 1);
    Ok(Certificate { bound_j, gap_j, gap, compressed_bar, singular })
}

/// Largest distance of the last joint from its anchor, as a part of the slack of the chain.
const OPEN_PART: f64 = 0.1;

/// Whether the answer is a configuration of the chain, as far as that matters.
fn closed(chain: &Chain, last_m: Vector) -> Result<(), NoCertificate> {
    let end = chain.anchors().end_m;
    let off = norm(std::array::from_fn(|k| last_m[k] - end[k]));
    let gap_m = off - stored_rounding_m(chain);
    let total = chain.total_length_m();
    let longest = chain.bars().iter().fold(0.0_f64, |most, bar| most.max(bar.length_m()));
    let span = chain.anchors().span_m();
    let slack_m = (total - span).min((total - longest) - longest + span);
    if off.is_nan() || gap_m > OPEN_PART * slack_m {
        return Err(NoCertificate::NotClosed { gap_m, slack_m });
    }
    Ok(())
}

/// The weight of the joints between the anchors, N; all of it where nothing hangs there.
fn hanging_n(chain: &Chain) -> f64 {
    // No difference: what rests on an anchor may be the largest weight by far.
    let mass_kg = sum(carried_kg(chain));
    let mass_kg = if mass_kg > 0.0 { mass_kg } else { chain.total_mass_kg() };
    mass_kg * chain.gravity_m_s2()
}

/// Index of the only bar in compression, if any.
fn the_compressed_bar(axial_n: &[f64], force_n: f64) -> Result<Option<usize>, NoCertificate> {
    let pressed = |axial_n: f64| axial_n < -NO_FORCE * force_n;
    let mut compressed = axial_n.iter().enumerate().filter(|(_, a)| pressed(**a)).map(|(i, _)| i);
    let first = compressed.next();
    match compressed.count() {
        0 => Ok(first),
        more => Err(NoCertificate::SeveralCompressed { bars: more + 1 }),
    }
}

/// The mass that the lever rule leaves at the far end of the last bar, on the anchor, kg.
fn last_part(bars: &[Bar]) -> f64 {
    bars.last().map_or(0.0, far_kg)
}

/// The force `G_i / l_i` along each bar, N: the end reaction without what the last bar leaves on
/// the anchor, less the weight between the bar and the anchor.
fn bar_forces(bars: &[Bar], gravity: f64, pull: Vector) -> Vec<Vector> {
    let mut forces = vec![pull; bars.len()];
    let (mut beyond, mut lost) = (0.0 - last_part(bars), 0.0_f64);
    for (bar, force) in bars.iter().zip(&mut forces).rev() {
        let lever = far_kg(bar);
        force[2] -= gravity * (beyond + lost + lever);
        // Two-sum: the suffix mass stays good to the last place for any number of bars.
        let next = beyond + bar.mass_kg();
        let part = next - beyond;
        lost += (beyond - (next - part)) + (bar.mass_kg() - part);
        beyond = next;
    }
    forces
}

/// `ν_k < 0` of the compressed bar, at most `|G_k|` in size and small enough that
/// `|τ_k| Σ 1/τ_i ≤ 1` is proven; and whether it had to be reduced only because of rounding.
fn reduced_compression(
    bars: &[Bar],
    forces: &[Vector],
    force_n: f64,
    k: usize,
) -> Result<(f64, bool), NoCertificate> {
    let compliance = |i: usize| bars[i].length_m() / norm(forces[i]);
    let others = || (0..bars.len()).filter(|i| *i != k);
    let rest = sum(others().map(compliance));
    // A force that is a small difference of large ones carries their rounding error.
    let error =
        TERM_ULPS * U * sum(others().map(|i| compliance(i) * (1.0 + force_n / norm(forces[i]))));
    let own = compliance(k);
    let own_error = TERM_ULPS * U * own * (1.0 + force_n / norm(forces[k]));
    let excess = rest - own;
    if !(rest + error).is_finite() || excess > error + own_error {
        // A bar without force beside a compressed one makes the sum infinite.
        let excess = if rest.is_finite() { excess / (rest + own) } else { 1.0 };
        return Err(NoCertificate::Indefinite { bar: k + 1, excess });
    }
    let singular = excess.abs() <= error + own_error;
    let needed = own.max((rest + error) * (1.0 + TERM_ULPS * U));
    let length_m = bars[k].length_m();
    Ok((-length_m * length_m / needed, singular))
}

/// Bound on `−½ Σ ν_i |u_i − û_i|²` with one negative `ν_k`, J.
fn closure_slack(
    bars: &[Bar],
    forces: &[Vector],
    force_n: f64,
    difference: Vector,
    k: usize,
    nu_k: f64,
) -> f64 {
    let length_k = bars[k].length_m();
    // û_k = G_k / ν_k; the others are unit vectors.
    let stretch_k = length_k / nu_k * norm(forces[k]);
    let closure: Vector = std::array::from_fn(|c| {
        difference[c]
            - sum(forces.iter().enumerate().map(|(i, force)| {
                let scale = if i == k { stretch_k } else { 1.0 };
                bars[i].length_m() * scale * (force[c] / norm(*force))
            }))
    });
    let rounding = TERM_ULPS
        * U
        * sum(forces.iter().zip(bars).map(|(f, bar)| bar.length_m() * (1.0 + force_n / norm(*f))));
    let e = norm(closure) + rounding;
    let s = e + length_k * (1.0 + stretch_k.abs());
    let tau_k = nu_k.abs() / (length_k * length_k);
    tau_k * (s * e + 0.5 * e * e) * (1.0 + TERM_ULPS * U)
}

#[cfg(test)]
pub(crate) mod tests;
