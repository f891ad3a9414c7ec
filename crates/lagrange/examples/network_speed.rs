//! Time of one solve of square nets of rigid bars hung from their four corners, against their size.
//!
//! `cargo run --release -p lagrange --example network_speed -- 32 100` prints a line for each number
//! of joints a side: members, time, factorisations, residual, and whether every bar pulls.

use std::error::Error;
use std::time::Instant;

use lagrange::network::{Settings, solve};
use model::Bar;
use model::system::{Joint, Member, System};

/// Span of the corners over the length of a side.
const SPAN: f64 = 0.8;

fn main() -> Result<(), Box<dyn Error>> {
    let sizes: Vec<String> = std::env::args().skip(1).collect();
    let sizes = if sizes.is_empty() { vec!["32".to_owned()] } else { sizes };
    println!(
        "{:>8} {:>10} {:>15} {:>10} {:>9}",
        "members", "time s", "factorisations", "residual", "all pull"
    );
    for size in sizes {
        let system = net(size.parse()?)?;
        let began = Instant::now();
        let solution = solve(&system, &Settings::default())?;
        let seconds = began.elapsed().as_secs_f64();
        let pull = solution.equilibrium.axial_n.iter().all(|axial| *axial > 0.0);
        println!(
            "{:>8} {seconds:>10.3} {:>15} {:>10.1e} {pull:>9}",
            system.members().len(),
            solution.factorisations,
            solution.residual,
        );
    }
    Ok(())
}

/// A net of `n` by `n` joints, bars of 1 m and 1 kg between neighbours.
fn net(n: usize) -> Result<System, Box<dyn Error>> {
    let side = SPAN * (n - 1) as f64;
    let bar = Bar::homogeneous(1.0, 1.0)?;
    let (mut joints, mut members) = (Vec::new(), Vec::new());
    let edge = |i: usize| i == 0 || i + 1 == n;
    let at = |i: usize| if i == 0 { 0.0 } else { side };
    for i in 0..n {
        for j in 0..n {
            let name = format!("{i} {j}");
            let corner = edge(i) && edge(j);
            joints.push(if corner {
                Joint::anchor(name, [at(i), at(j), 0.0])
            } else {
                Joint::free(name)
            });
            if i + 1 < n {
                members.push(Member::bar(i * n + j, (i + 1) * n + j, bar));
            }
            if j + 1 < n {
                members.push(Member::bar(i * n + j, i * n + j + 1, bar));
            }
        }
    }
    Ok(System::new("net", 9.806_65, joints, members)?)
}
