//! Time and memory of the certificate that no configuration of a large system has less energy.
//!
//! `cargo run --profile dist -p validate --example certificate_speed [KIND N ...]`, by default
//! `net 708 chain 1000000`:
//!
//! | kind | system |
//! |---|---|
//! | `net` | N x N joints with bars and cables in turn between neighbours, hung from its whole edge |
//! | `corners` | the same, hung from the four corners alone |
//! | `chain` | N bars in a row between two anchors |
//! | `energy` | as `net`, with the answer of that solver |
//!
//! The systems are in equilibrium by their making: with a force density given to each member the
//! places of the joints follow from linear equations, and the members are as long as their joints
//! are apart. The certificate knows nothing of that; it is given lengths, places and forces, as
//! from any solver. Each line has the time of the certificate alone, by the clock and of the
//! processor (on Linux, in steps of 10 ms), the gap that it leaves in units of the loads times the
//! size, and the most memory that the process has had so far, before the certificate and after it.
//! One run on a server (AMD EPYC):
//!
//! | kind | members | joints | clock | processor | gap | memory after |
//! |---|---|---|---|---|---|---|
//! | `net` | 998,284 | 501,264 | 2.2 s | 1.0 s | 4e-15 | 605 MB |
//! | `corners` | 1,003,944 | 502,681 | 1.9 s | 1.0 s | 7e-15 | 652 MB |
//! | `chain` | 1,000,000 | 1,000,001 | 1.1 s | 0.5 s | 7e-10 | 652 MB |

use std::error::Error;
use std::time::Instant;

use matrices::sparse::{Entries, Ldlt, Pivots, minimum_degree};
use model::system::{Joint, Member, System, SystemEquilibrium, SystemStability};
use model::{Bar, Evidence, InSpace, SolverName, Vector, sum};
use samples::process;
use validate::systems::certify;

const GRAVITY_M_S2: f64 = 9.806_65;
/// Mean force density of the members, in units of the weight of a joint times the number of members
/// from side to side: what hangs from both sides sags by half its width.
const DENSITY: f64 = 0.25;

/// Joints, those that are held, and members by their joints.
struct Plan {
    /// Number of members from side to side.
    across: usize,
    held: Vec<Option<Vector>>,
    members: Vec<(usize, usize)>,
}

fn net(side: usize, held: impl Fn(bool, bool) -> bool) -> Plan {
    let edge = |k: usize| k == 0 || k + 1 == side;
    let mut plan = Plan { across: side - 1, held: Vec::new(), members: Vec::new() };
    for k in 0..side * side {
        let (x, y) = (k % side, k / side);
        plan.held.push(held(edge(x), edge(y)).then_some([x as f64, y as f64, 0.0]));
        if x > 0 {
            plan.members.push((k - 1, k));
        }
        if y > 0 {
            plan.members.push((k - side, k));
        }
    }
    // Two anchors need no member between them.
    plan.members.retain(|&(a, b)| plan.held[a].is_none() || plan.held[b].is_none());
    plan
}

fn chain(bars: usize) -> Plan {
    let held = |k: usize| (k == 0 || k == bars).then_some([0.5 * k as f64, 0.0, 0.0]);
    let members = (0..bars).map(|k| (k, k + 1)).collect();
    Plan { across: bars, held: (0..=bars).map(held).collect(), members }
}

/// A number between one half and three halves for each `k`, without pattern (golden ratio).
fn spread(k: usize) -> f64 {
    0.5 + ((k + 1) as f64 * 0.618_033_988_749_894_9).fract()
}

/// The places at which the force densities balance the loads.
fn places(plan: &Plan, densities: &[f64], loads_n: &[f64]) -> Result<Vec<Vector>, Box<dyn Error>> {
    let mut rows = vec![usize::MAX; plan.held.len()];
    let mut size = 0;
    for (row, held) in rows.iter_mut().zip(&plan.held) {
        if held.is_none() {
            *row = size;
            size += 1;
        }
    }
    let mut right = vec![0.0; 3 * size];
    let mut entries = Vec::new();
    for (joint, load_n) in loads_n.iter().enumerate().filter(|(joint, _)| rows[*joint] < size) {
        right[2 * size + rows[joint]] -= load_n;
    }
    for (&(from, to), density) in plan.members.iter().zip(densities) {
        for (here, there) in [(from, to), (to, from)] {
            if rows[here] < size {
                entries.push((rows[here], rows[here], *density));
                if let Some(at_m) = plan.held[there] {
                    for (axis, x) in at_m.iter().enumerate() {
                        right[axis * size + rows[here]] += density * x;
                    }
                }
            }
        }
        let (a, b) = (rows[from], rows[to]);
        if a < size && b < size {
            entries.push((a.max(b), a.min(b), -density));
        }
    }
    let matrix = Entries::new(size, &entries);
    let order = minimum_degree(&matrix.starts, &matrix.rows).ok_or("no order")?;
    let mut factor = Ldlt::new(&matrix.starts, &matrix.rows, &order).ok_or("no memory")?;
    if !factor.factorise(&matrix.values, Pivots::Positive) {
        return Err("not positive definite".into());
    }
    factor.solve(&mut right);
    let place = |(row, held): (&usize, &Option<Vector>)| {
        held.unwrap_or_else(|| std::array::from_fn(|axis| right[axis * size + *row]))
    };
    Ok(rows.iter().zip(&plan.held).map(place).collect())
}

fn distance(a: Vector, b: Vector) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]).powi(2)).sum::<f64>().sqrt()
}

/// The system in equilibrium, and its answer.
fn system(plan: &Plan) -> Result<(System, SystemEquilibrium), Box<dyn Error>> {
    let masses: Vec<f64> = (0..plan.held.len()).map(spread).collect();
    let loads_n: Vec<f64> = masses.iter().map(|mass_kg| mass_kg * GRAVITY_M_S2).collect();
    let mean = DENSITY * GRAVITY_M_S2 * plan.across as f64;
    let densities: Vec<f64> = (0..plan.members.len()).map(|k| mean * spread(k)).collect();
    let joints_m = places(plan, &densities, &loads_n)?;
    let mut joints = Vec::with_capacity(masses.len());
    for (k, (held, mass_kg)) in plan.held.iter().zip(&masses).enumerate() {
        joints.push(match held {
            Some(at_m) => Joint::anchor(k.to_string(), *at_m),
            None => Joint::free(k.to_string()).with_mass(*mass_kg),
        });
    }
    let (mut members, mut axial_n) = (Vec::new(), Vec::new());
    for (k, (&(from, to), density)) in plan.members.iter().zip(&densities).enumerate() {
        let length_m = distance(joints_m[from], joints_m[to]);
        let body = Bar::homogeneous(length_m, 0.0)?;
        let bar = k % 2 == 0;
        members.push(if bar { Member::bar(from, to, body) } else { Member::cable(from, to, body) });
        axial_n.push(density * length_m);
    }
    let system = System::new("in equilibrium", GRAVITY_M_S2, joints, members)?;
    let reference_m = system.reference_m()[2];
    let heights = joints_m.iter().zip(&plan.held).zip(&loads_n);
    let energies = heights.map(
        |((x, held), load_n)| if held.is_some() { 0.0 } else { load_n * (x[2] - reference_m) },
    );
    let count = plan.held.len();
    let answer = SystemEquilibrium {
        solver: SolverName::new("force densities"),
        energy_j: sum(energies),
        // The certificate reads no forces of ends, and reactions only of the floor.
        start_forces_n: Vec::new(),
        end_forces_n: Vec::new(),
        reactions_n: vec![[0.0; 3]; count],
        joints_m,
        axial_n,
        stability: SystemStability {
            in_space: InSpace::Stable,
            index_in_space: 0,
            index_in_plane: None,
            neutral: 0,
        },
        evidence: Evidence::new("balance by its making", 0.0, 0.0, 0),
    };
    Ok((system, answer))
}

/// The most memory, MB; NaN where the system does not say.
fn peak_mb() -> f64 {
    process::peak_kb().map_or(f64::NAN, |kilobytes| kilobytes as f64 / 1024.0)
}

/// Time that the processors have given to this process; NaN where the system does not say.
fn processor_s() -> f64 {
    process::processor_s().unwrap_or(f64::NAN)
}

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    if arguments.is_empty() {
        arguments = ["net", "708", "chain", "1000000"].map(String::from).to_vec();
    }
    println!("kind     members   joints  clock/s  processor/s      gap  MB before  MB after");
    let mut kind = String::new();
    for argument in arguments {
        let Ok(size) = argument.parse() else {
            kind = argument;
            continue;
        };
        let plan = match kind.as_str() {
            "net" | "energy" => net(size, |x, y| x || y),
            "corners" => net(size, |x, y| x && y),
            "chain" => chain(size),
            other => return Err(format!("`{other}` is none of net, corners, chain, energy").into()),
        };
        let (system, mut answer) = system(&plan)?;
        if kind == "energy" {
            let found = energy::net::minimise(&system, &energy::net::Settings::default())?;
            answer = found.equilibrium;
        }
        let before_mb = peak_mb();
        let (clock, used) = (Instant::now(), processor_s());
        let proof = certify(&system, &answer)?;
        let (seconds, used) = (clock.elapsed().as_secs_f64(), processor_s() - used);
        println!(
            "{kind:7} {:8} {:8}  {seconds:7.2}  {used:11.2}  {:7.1e}  {before_mb:9.0}  {:8.0}",
            system.members().len(),
            system.joints().len(),
            proof.gap.unwrap_or(0.0),
            peak_mb(),
        );
    }
    Ok(())
}
