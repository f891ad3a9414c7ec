//! How long the positions-first solver takes for systems of growing size.
//!
//! `cargo run --profile dist -p energy --example network_minimise_speed [kind [n ...]]` prints a line
//! for each size *n*:
//!
//! | kind | system |
//! |---|---|
//! | `net` | n x n joints and rigid bars, hung from the four corners |
//! | `bridle` | three strands of n bars each |
//! | `branches` | ten branchings in a tree of n bars in all, between twelve anchors |
//! | `tree` | a random tree of n bars |
//! | `chain` | n bars as a system; in brackets the time of the solver of chains |

use std::f64::consts::TAU;
use std::time::Instant;

use energy::net::{Settings, minimise};
use model::system::{Joint, Member, System};
use model::{Anchors, Bar, Chain, Problem};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

type Failure = Box<dyn std::error::Error>;

/// Joints and members while they are put together.
#[derive(Default)]
struct Draft {
    joints: Vec<Joint>,
    members: Vec<Member>,
}

impl Draft {
    fn anchor(&mut self, at_m: [f64; 3]) -> usize {
        self.joints.push(Joint::anchor(format!("{}", self.joints.len()), at_m));
        self.joints.len() - 1
    }

    fn free(&mut self) -> usize {
        self.joints.push(Joint::free(format!("{}", self.joints.len())));
        self.joints.len() - 1
    }

    fn bar(&mut self, from: usize, to: usize, length_m: f64) -> Result<(), Failure> {
        self.members.push(Member::bar(from, to, Bar::homogeneous(length_m, length_m)?));
        Ok(())
    }

    /// Bars in a row.
    fn run(&mut self, from: usize, to: usize, bars: usize, length_m: f64) -> Result<(), Failure> {
        let mut here = from;
        for k in 1..=bars {
            let there = if k == bars { to } else { self.free() };
            self.bar(here, there, length_m / bars as f64)?;
            here = there;
        }
        Ok(())
    }

    fn finish(self, name: &str) -> Result<System, Failure> {
        Ok(System::new(name, model::STANDARD_GRAVITY_M_S2, self.joints, self.members)?)
    }
}

/// A net hung from four corners that are 0.8 of a side apart.
fn net(n: usize) -> Result<System, Failure> {
    let step = 1.0 / (n as f64 - 1.0);
    let mut draft = Draft::default();
    for i in 0..n {
        for j in 0..n {
            let corner = (i == 0 || i == n - 1) && (j == 0 || j == n - 1);
            if corner {
                draft.anchor([0.8 * i as f64 * step, 0.8 * j as f64 * step, 0.0]);
            } else {
                draft.free();
            }
        }
    }
    for i in 0..n {
        for j in 0..n {
            let right = (i + 1 < n).then_some((i + 1) * n + j);
            let up = (j + 1 < n).then_some(i * n + j + 1);
            for to in [right, up].into_iter().flatten() {
                draft.bar(i * n + j, to, step)?;
            }
        }
    }
    draft.finish("net")
}

fn bridle(n: usize) -> Result<System, Failure> {
    let mut draft = Draft::default();
    let knot = draft.free();
    for k in 0..3 {
        let angle = TAU * f64::from(k) / 3.0;
        let anchor = draft.anchor([angle.cos(), angle.sin(), 0.1 * f64::from(k)]);
        draft.run(anchor, knot, n, 1.3)?;
    }
    draft.finish("bridle")
}

/// A trunk of ten branchings between two anchors; from each branching a strand to an anchor of its
/// own.
fn branches(n: usize) -> Result<System, Failure> {
    let mut draft = Draft::default();
    let bars = n / 21;
    let mut here = draft.anchor([0.0; 3]);
    for k in 0..10 {
        let next = draft.free();
        draft.run(here, next, bars, 0.13)?;
        let side = if k % 2 == 0 { 0.4 } else { -0.4 };
        let anchor = draft.anchor([0.1 * f64::from(k + 1), side, 0.0]);
        draft.run(anchor, next, bars, 0.7)?;
        here = next;
    }
    let end = draft.anchor([1.1, 0.0, 0.0]);
    draft.run(here, end, bars, 0.13)?;
    draft.finish("branches")
}

fn tree(n: usize) -> Result<System, Failure> {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut draft = Draft::default();
    draft.anchor([0.0; 3]);
    for k in 0..n {
        let from = random.random_range(k.saturating_sub(100)..=k);
        let to = draft.free();
        draft.bar(from, to, random.random_range(0.5..1.0))?;
    }
    draft.finish("tree")
}

/// A chain as a system, and the time of the solver of chains for it.
fn chain(n: usize) -> Result<(System, f64), Failure> {
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.6, 0.3, 0.2] };
    let bars = vec![Bar::homogeneous(1.0 / n as f64, 1.0 / n as f64)?; n];
    let chain = Chain::new("chain", model::STANDARD_GRAVITY_M_S2, anchors, bars)?;
    let system = System::from(&chain);
    let problem = Problem::new(chain)?;
    let clock = Instant::now();
    energy::minimise(&problem, &energy::Settings::default())?;
    Ok((system, clock.elapsed().as_secs_f64()))
}

fn main() -> Result<(), Failure> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let kind = arguments.first().map_or("net", String::as_str);
    let mut sizes: Vec<usize> = arguments.iter().skip(1).filter_map(|n| n.parse().ok()).collect();
    if sizes.is_empty() {
        sizes = vec![8, 16, 32, 64, 100];
    }
    println!(
        "{:>8} {:>8} {:>9} {:>9} {:>10} {:>10} {:>14} {:>9} {:>9} {:>8}",
        "n",
        "members",
        "time/s",
        "us/member",
        "relaxation",
        "iterations",
        "factorisations",
        "unbalance",
        "misfit",
        "idle"
    );
    for n in sizes {
        let mut beside = String::new();
        let system = match kind {
            "net" => net(n)?,
            "bridle" => bridle(n)?,
            "branches" => branches(n)?,
            "tree" => tree(n)?,
            "chain" => {
                let (system, chain_s) = chain(n)?;
                beside = format!(" [{chain_s:.4} s]");
                system
            }
            other => return Err(format!("no kind `{other}`").into()),
        };
        let members = system.members().len();
        let clock = Instant::now();
        let solution = match minimise(&system, &Settings::default()) {
            Ok(solution) => solution,
            Err(error) => {
                println!("{n:>8} {members:>8} {:>9.4} {error}", clock.elapsed().as_secs_f64());
                continue;
            }
        };
        let (work, time_s) = (solution.work, solution.equilibrium.evidence.solve_s);
        let idle = solution.equilibrium.axial_n.iter().filter(|n| n.abs() <= 0.0).count();
        println!(
            "{n:>8} {members:>8} {time_s:>9.4} {:>9.3} {:>10} {:>10} {:>14} {:>9.1e} {:>9.1e} {:>8}{beside}",
            1e6 * time_s / members as f64,
            work.relaxation,
            work.iterations,
            work.factorisations,
            work.unbalance,
            work.misfit,
            idle,
        );
    }
    Ok(())
}
