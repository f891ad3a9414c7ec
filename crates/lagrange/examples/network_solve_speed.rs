//! Time of one solve against the size of a system of rigid bars.
//!
//! `cargo run --profile dist -p lagrange --example network_solve_speed -- net 32 100` takes square nets
//! hung from their four corners, by their joints a side; `cables` the same of cables; `bridle 1000`
//! takes three chains of so many bars that meet in a joint; `tree 1000` a dangling tree of so many
//! bars; `crumpled` nets of cables with all their edges held, the cables between as long as their
//! places are apart up to 1.5 times that; `ring` such nets of massless cables of 1.05 m with 1 kg
//! at each joint. Each prints a line: members, time, time of the processor (on Linux, in steps of
//! 10 ms), factorisations, residual, members in compression, slack ones.

use std::error::Error;
use std::time::Instant;

use lagrange::net::{Settings, solve};
use model::Bar;
use model::system::{Joint, Kind, Member, System};
use samples::process::processor_s;

/// Span of the corners over the length of a side.
const SPAN: f64 = 0.8;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((shape, sizes)) = arguments.split_first() else {
        return Err("say `net`, `cables`, `crumpled`, `ring`, `bridle` or `tree`, and sizes".into());
    };
    println!(
        "{:>8} {:>10} {:>10} {:>15} {:>10} {:>9} {:>9}",
        "members", "time s", "processor", "factorisations", "residual", "pushed", "slack"
    );
    for size in sizes {
        let size = size.parse()?;
        let system = match shape.as_str() {
            "net" => net(size, Kind::Bar, SPAN)?,
            "cables" => net(size, Kind::Cable, SPAN)?,
            "crumpled" => crumpled(size)?,
            "ring" => samples::cable_net(size),
            "bridle" => samples::bridle(size),
            "tree" => tree(size)?,
            other => {
                return Err(format!(
                    "`{other}` is none of net, cables, crumpled, ring, bridle, tree"
                )
                .into());
            }
        };
        let (began, used) = (Instant::now(), processor_s().unwrap_or(f64::NAN));
        let solution = solve(&system, &Settings::default());
        let seconds = began.elapsed().as_secs_f64();
        let used = processor_s().unwrap_or(f64::NAN) - used;
        let solution = match solution {
            Ok(solution) => solution,
            Err(error) => {
                println!("{:>8} {seconds:>10.3} {error}", system.members().len());
                continue;
            }
        };
        let pushed = solution.equilibrium.axial_n.iter().filter(|axial| **axial < 0.0).count();
        println!(
            "{:>8} {seconds:>10.3} {used:>10.2} {:>15} {:>10.1e} {pushed:>9} {:>9}",
            system.members().len(),
            solution.factorisations,
            solution.residual,
            solution.slack.len(),
        );
    }
    Ok(())
}

/// A tree of `n` bars below one anchor: each joint carries two more.
fn tree(n: usize) -> Result<System, Box<dyn Error>> {
    let bar = Bar::homogeneous(1.0, 1.0)?;
    let mut joints = vec![Joint::anchor("0", [0.0; 3])];
    let mut members = Vec::new();
    for k in 1..=n {
        // Each joint is pushed aside a little, or all would hang in one line.
        let aside = [0.1 * (k % 7) as f64, 0.1 * (k % 5) as f64, 0.0];
        joints.push(Joint::free(format!("{k}")).with_force(aside));
        members.push(Member::bar((k - 1) / 2, k, bar));
    }
    Ok(System::new("tree", 9.806_65, joints, members)?)
}

/// A net of `n` by `n` joints with all joints of the edges held 1 m apart, and cables of 1 m to
/// 1.5 m between them, spread without pattern (golden ratio).
fn crumpled(n: usize) -> Result<System, Box<dyn Error>> {
    let (mut joints, mut members) = (Vec::new(), Vec::new());
    let mut cable = |from, to| -> Result<(), Box<dyn Error>> {
        let spread = (members.len() as f64 * 0.618_033_988_749_894_9).fract();
        let body = Bar::homogeneous(1.0 + 0.5 * spread, 1.0)?;
        members.push(Member::bar(from, to, body).of_kind(Kind::Cable));
        Ok(())
    };
    for i in 0..n {
        for j in 0..n {
            let edge = [i, j].into_iter().any(|k| k == 0 || k + 1 == n);
            let name = format!("{i} {j}");
            let at_m = [i as f64, j as f64, 0.0];
            joints.push(if edge { Joint::anchor(name, at_m) } else { Joint::free(name) });
            if i > 0 {
                cable((i - 1) * n + j, i * n + j)?;
            }
            if j > 0 {
                cable(i * n + j - 1, i * n + j)?;
            }
        }
    }
    Ok(System::new("crumpled", 9.806_65, joints, members)?)
}

/// A net of `n` by `n` joints, members of 1 m and 1 kg between neighbours.
fn net(n: usize, kind: Kind, span: f64) -> Result<System, Box<dyn Error>> {
    let side = span * (n - 1) as f64;
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
                members.push(Member::bar(i * n + j, (i + 1) * n + j, bar).of_kind(kind));
            }
            if j + 1 < n {
                members.push(Member::bar(i * n + j, i * n + j + 1, bar).of_kind(kind));
            }
        }
    }
    Ok(System::new("net", 9.806_65, joints, members)?)
}
