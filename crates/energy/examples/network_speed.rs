//! How long the positions-first solver takes for nets of rigid bars hung from their four corners.
//!
//! `cargo run --release -p energy --example network_speed [n ...]` prints a line for each net of n x n joints.

use energy::network::{Settings, minimise};
use model::Bar;
use model::system::{Joint, Member, System};

/// Distance of the corners over the length of a side.
const SPAN: f64 = 0.8;

fn net(n: usize) -> Result<System, Box<dyn std::error::Error>> {
    let step = 1.0 / (n as f64 - 1.0);
    let bar = Bar::homogeneous(step, step)?;
    let (mut joints, mut members) = (Vec::new(), Vec::new());
    for i in 0..n {
        for j in 0..n {
            let corner = (i == 0 || i == n - 1) && (j == 0 || j == n - 1);
            let at = [SPAN * i as f64 * step, SPAN * j as f64 * step, 0.0];
            let name = format!("{i},{j}");
            joints.push(if corner { Joint::anchor(name, at) } else { Joint::free(name) });
            if i + 1 < n {
                members.push(Member::bar(i * n + j, (i + 1) * n + j, bar));
            }
            if j + 1 < n {
                members.push(Member::bar(i * n + j, i * n + j + 1, bar));
            }
        }
    }
    Ok(System::new("net", model::STANDARD_GRAVITY_M_S2, joints, members)?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut sizes: Vec<usize> =
        std::env::args().skip(1).filter_map(|arg| arg.parse().ok()).collect();
    if sizes.is_empty() {
        sizes = vec![8, 16, 32, 64, 100];
    }
    println!(
        "{:>5} {:>7} {:>9} {:>11} {:>14} {:>9} {:>9}",
        "n", "bars", "time/s", "iterations", "factorisations", "unbalance", "misfit"
    );
    for n in sizes {
        let system = net(n)?;
        let solution = minimise(&system, &Settings::default())?;
        let work = solution.work;
        println!(
            "{n:>5} {:>7} {:>9.4} {:>11} {:>14} {:>9.1e} {:>9.1e}",
            system.members().len(),
            solution.equilibrium.evidence.solve_s,
            work.relaxation + work.iterations,
            work.factorisations,
            work.unbalance,
            work.misfit,
        );
    }
    Ok(())
}
