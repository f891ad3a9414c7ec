//! Time of one solve against the size of a system of rigid bars.
//!
//! `cargo run --release -p lagrange --example network_speed -- net 32 100` takes square nets hung
//! from their four corners, by their joints a side; `cables` the same of cables; `bridle 1000`
//! takes three chains of so many bars that meet in a joint. Each prints a line: members, time,
//! factorisations, residual, members in compression, slack ones.

use std::error::Error;
use std::time::Instant;

use lagrange::network::{Settings, solve};
use model::Bar;
use model::system::{Joint, Kind, Member, System};

/// Span of the corners over the length of a side.
const SPAN: f64 = 0.8;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let Some((shape, sizes)) = arguments.split_first() else {
        return Err("say `net`, `cables` or `bridle`, and sizes".into());
    };
    println!(
        "{:>8} {:>10} {:>15} {:>10} {:>9} {:>9}",
        "members", "time s", "factorisations", "residual", "pushed", "slack"
    );
    for size in sizes {
        let size = size.parse()?;
        let system = match shape.as_str() {
            "net" => net(size, Kind::Bar)?,
            "cables" => net(size, Kind::Cable)?,
            "bridle" => bridle(size)?,
            other => return Err(format!("`{other}` is none of net, cables, bridle").into()),
        };
        let began = Instant::now();
        let solution = solve(&system, &Settings::default())?;
        let seconds = began.elapsed().as_secs_f64();
        let pushed = solution.equilibrium.axial_n.iter().filter(|axial| **axial < 0.0).count();
        println!(
            "{:>8} {seconds:>10.3} {:>15} {:>10.1e} {pushed:>9} {:>9}",
            system.members().len(),
            solution.factorisations,
            solution.residual,
            solution.slack.len(),
        );
    }
    Ok(())
}

/// Three chains of `n` bars of 1 m and 1 kg from anchors on a circle to one joint.
fn bridle(n: usize) -> Result<System, Box<dyn Error>> {
    let bar = Bar::homogeneous(1.0, 1.0)?;
    let mut joints = vec![Joint::free("middle").with_mass(n as f64)];
    let mut members = Vec::new();
    for strand in 0..3 {
        let angle = std::f64::consts::TAU * f64::from(strand) / 3.0;
        let radius = SPAN * n as f64;
        joints.push(Joint::anchor(
            format!("{strand}"),
            [radius * angle.cos(), radius * angle.sin(), 0.0],
        ));
        for k in 1..=n {
            let to = if k == n { 0 } else { joints.len() };
            members.push(Member::bar(joints.len() - 1, to, bar));
            if k < n {
                joints.push(Joint::free(format!("{strand} {k}")));
            }
        }
    }
    Ok(System::new("bridle", 9.806_65, joints, members)?)
}

/// A net of `n` by `n` joints, members of 1 m and 1 kg between neighbours.
fn net(n: usize, kind: Kind) -> Result<System, Box<dyn Error>> {
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
                members.push(Member { kind, ..Member::bar(i * n + j, (i + 1) * n + j, bar) });
            }
            if j + 1 < n {
                members.push(Member { kind, ..Member::bar(i * n + j, i * n + j + 1, bar) });
            }
        }
    }
    Ok(System::new("net", 9.806_65, joints, members)?)
}
