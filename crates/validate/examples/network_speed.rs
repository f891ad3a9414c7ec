//! Time of one solve against the size of a system, by either solver or by clarabel's cone programme.
//!
//! `cargo run --profile dist -p validate --example network_speed SOLVER,... KIND n ...`, of the solvers
//! `lagrange`, `energy` and `clarabel` (bars as cables), prints a line for each size *n* and solver: members, time,
//! time of the processor (on Linux, in steps of 10 ms) and that of a member, energy, members in compression,
//! members that bear nothing, and the solver's own account of its work.
//!
//! | kind | system |
//! |---|---|
//! | `net` | n x n joints and rigid bars, hung from the four corners |
//! | `cables` | the same of cables |
//! | `crumpled` | such a net of cables with all its edges held, the cables between as long as their places are apart up to 1.5 times that |
//! | `ring` | such a net of massless cables of 1.05 m with 1 kg at each joint |
//! | `bridle` | three strands of n bars each that meet in a joint |
//! | `branches` | ten branchings in a tree of n bars in all, between twelve anchors |
//! | `tree` | a dangling tree of n bars, two more below each |
//! | `chain` | n bars between two anchors |
//!
//! One run of all three for `ring 33 101` on a server (AMD EPYC):
//!
//! | members | `lagrange` | `energy` | clarabel | ratios |
//! |---|---|---|---|---|
//! | 1,984 | 0.03 s | 0.04 s | 0.15 s | 5.0 and 3.7 |
//! | 19,800 | 0.52 s | 0.43 s | 5.97 s | 11.5 and 13.9 |

use std::error::Error;
use std::time::Instant;

use model::Bar;
use model::system::{Joint, Kind, Member, System};
use samples::process;
use validate::systems::hang_as_cables;

type Failure = Box<dyn Error>;

/// Span of the corners over the length of a side.
const SPAN: f64 = 0.8;

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [solvers, kind, sizes @ ..] = arguments.as_slice() else {
        return Err(
            "say `lagrange`, `energy` or `clarabel`, the kind of a system, and sizes".into()
        );
    };
    println!(
        " members   solver     time s  processor us/member             energy J   pushed     idle"
    );
    for size in sizes {
        let n = size.parse()?;
        let system = match kind.as_str() {
            "net" => net(n, SPAN, Kind::Bar, |x, y| x && y, |_| 1.0)?,
            "cables" => net(n, SPAN, Kind::Cable, |x, y| x && y, |_| 1.0)?,
            // Spread without pattern (golden ratio).
            "crumpled" => net(
                n,
                1.0,
                Kind::Cable,
                |x, y| x || y,
                |k| 1.0 + 0.5 * (k as f64 * 0.618_033_988_749_894_9).fract(),
            )?,
            "ring" => samples::cable_net(n),
            "bridle" => samples::bridle(n),
            "branches" => branches(n)?,
            "tree" => tree(n)?,
            "chain" => {
                let mut draft = Draft::default();
                let ends = [[0.0; 3], [0.6, 0.3, 0.2]].map(|at_m| draft.joint(Some(at_m)));
                draft.run(ends, n, 1.0)?;
                draft.finish()?
            }
            other => return Err(format!("no kind `{other}`").into()),
        };
        let members = system.members().len();
        for solver in solvers.split(',') {
            let (began, used) = (Instant::now(), process::processor_s().unwrap_or(f64::NAN));
            let solved = solve(solver, &system);
            let seconds = began.elapsed().as_secs_f64();
            let used = process::processor_s().unwrap_or(f64::NAN) - used;
            print!("{members:>8} {solver:>8} {seconds:>10.3} {used:>10.2} ");
            match solved {
                Ok((energy_j, axial_n, work)) => println!(
                    "{:>9.3} {energy_j:>20.12e} {:>8} {:>8} {work}",
                    1e6 * used / members as f64,
                    axial_n.iter().filter(|axial| **axial < 0.0).count(),
                    axial_n.iter().filter(|axial| axial.abs() <= 0.0).count(),
                ),
                Err(error) => println!("{error}"),
            }
        }
    }
    Ok(())
}

/// The energy and the forces that this solver finds, and its work.
fn solve(solver: &str, system: &System) -> Result<(f64, Vec<f64>, String), Failure> {
    let (found, work) = match solver {
        "lagrange" => {
            let found = lagrange::net::solve(system, &lagrange::net::Settings::default())?;
            let (count, residual) = (found.factorisations, found.residual);
            (found.equilibrium, format!("{count} factorisations, residual {residual:.1e}"))
        }
        "energy" => {
            let found = energy::net::minimise(system, &energy::net::Settings::default())?;
            (found.equilibrium, format!("{:?}", found.work))
        }
        "clarabel" => {
            let found = hang_as_cables(system)?;
            return Ok((found.energy_j, found.axial_n, String::new()));
        }
        other => return Err(format!("no solver `{other}`").into()),
    };
    Ok((found.energy_j, found.axial_n, work))
}

/// Joints and members while they are put together.
#[derive(Default)]
struct Draft {
    joints: Vec<Joint>,
    members: Vec<Member>,
}

impl Draft {
    /// A joint held at a place, or free.
    fn joint(&mut self, held_m: Option<[f64; 3]>) -> usize {
        let name = self.joints.len().to_string();
        self.joints.push(
            held_m.map_or_else(
                || Joint::free(name.as_str()),
                |at_m| Joint::anchor(name.as_str(), at_m),
            ),
        );
        self.joints.len() - 1
    }

    /// Bars in a row, of 1 kg a metre.
    fn run(&mut self, [from, to]: [usize; 2], bars: usize, length_m: f64) -> Result<(), Failure> {
        let (mut here, length_m) = (from, length_m / bars as f64);
        for k in 1..=bars {
            let there = if k == bars { to } else { self.joint(None) };
            self.members.push(Member::bar(here, there, Bar::homogeneous(length_m, length_m)?));
            here = there;
        }
        Ok(())
    }

    fn finish(self) -> Result<System, Failure> {
        Ok(System::new("drawn", model::STANDARD_GRAVITY_M_S2, self.joints, self.members)?)
    }
}

/// A net of `n` by `n` joints `step_m` apart, those held that `held` says of lying on an edge across and along, and
/// members of 1 kg between neighbours, as long as `length_m` says of their number.
fn net(
    n: usize,
    step_m: f64,
    kind: Kind,
    held: impl Fn(bool, bool) -> bool,
    length_m: impl Fn(usize) -> f64,
) -> Result<System, Failure> {
    let mut draft = Draft::default();
    let edge = |i: usize| i == 0 || i + 1 == n;
    for k in 0..n * n {
        let (i, j) = (k / n, k % n);
        let at_m = [i as f64 * step_m, j as f64 * step_m, 0.0];
        draft.joint(held(edge(i), edge(j)).then_some(at_m));
        for back in [(i > 0).then_some(n), (j > 0).then_some(1)].into_iter().flatten() {
            let body = Bar::homogeneous(length_m(draft.members.len()), 1.0)?;
            draft.members.push(Member::bar(k - back, k, body).of_kind(kind));
        }
    }
    draft.finish()
}

/// A trunk of ten branchings between two anchors; from each branching a strand to an anchor of its
/// own.
fn branches(n: usize) -> Result<System, Failure> {
    let mut draft = Draft::default();
    let bars = n / 21;
    let mut here = draft.joint(Some([0.0; 3]));
    for k in 0..10 {
        let next = draft.joint(None);
        draft.run([here, next], bars, 0.13)?;
        let side = if k % 2 == 0 { 0.4 } else { -0.4 };
        let anchor = draft.joint(Some([0.1 * f64::from(k + 1), side, 0.0]));
        draft.run([anchor, next], bars, 0.7)?;
        here = next;
    }
    let end = draft.joint(Some([1.1, 0.0, 0.0]));
    draft.run([here, end], bars, 0.13)?;
    draft.finish()
}

/// A tree of bars below one anchor.
fn tree(n: usize) -> Result<System, Failure> {
    let mut draft = Draft::default();
    draft.joint(Some([0.0; 3]));
    for k in 1..=n {
        draft.joint(None);
        // Each joint is pushed aside a little, or all would hang in one line.
        draft.joints[k].force_n = [0.1 * (k % 7) as f64, 0.1 * (k % 5) as f64, 0.0];
        draft.members.push(Member::bar((k - 1) / 2, k, Bar::homogeneous(1.0, 1.0)?));
    }
    draft.finish()
}
