//! Our time for nets of cables beside that of clarabel's cone programme, in one run:
//! `cargo run --release -p validate --features bounds --example third_road [members ...]`.

use std::time::Instant;

use bounds::{BoundSettings, cable_system};
use model::Bar;
use model::system::{Joint, Member, System};

/// A square net of massless cables of 1.05 m with 1 kg at each joint, hung from all joints of its
/// edge, which are 1 m apart.
fn net(members: usize) -> Result<System, Box<dyn std::error::Error>> {
    // Rows and columns of n joints have 2 n (n - 1) cables; those along the edge are left out.
    let side = (2..=members.max(2)).find(|n| 2 * n * (n - 1) >= members).unwrap_or(2);
    let edge = |k: usize| k == 0 || k + 1 == side;
    let (mut joints, mut cables) = (vec![], vec![]);
    for k in 0..side * side {
        let (x, y) = (k % side, k / side);
        joints.push(if edge(x) || edge(y) {
            Joint::anchor(k.to_string(), [x as f64, y as f64, 0.0])
        } else {
            Joint::free(k.to_string()).with_mass(1.0)
        });
        let body = Bar::homogeneous(1.05, 0.0)?;
        if x + 1 < side && !edge(y) {
            cables.push(Member::cable(k, k + 1, body));
        }
        if y + 1 < side && !edge(x) {
            cables.push(Member::cable(k, k + side, body));
        }
    }
    Ok(System::new(format!("{} cables", cables.len()), 9.81, joints, cables)?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let asked: Vec<usize> =
        std::env::args().skip(1).map(|n| n.parse()).collect::<Result<_, _>>()?;
    let sizes = if asked.is_empty() { vec![2_000, 20_000] } else { asked };
    println!("members  lagrange/s  energy/s  clarabel/s  ratio  energies apart");
    for members in sizes {
        let system = net(members)?;
        let clock = Instant::now();
        let forces = lagrange::network::solve(&system, &lagrange::network::Settings::default())?;
        let lagrange_s = clock.elapsed().as_secs_f64();
        let clock = Instant::now();
        let places = energy::network::minimise(&system, &energy::network::Settings::default())?;
        let energy_s = clock.elapsed().as_secs_f64();
        let clock = Instant::now();
        let cones = cable_system(&system, &BoundSettings::default())?;
        let clarabel_s = clock.elapsed().as_secs_f64();
        let ours = forces.equilibrium.energy_j;
        let apart = [places.equilibrium.energy_j, cones.energy_j]
            .map(|other| ((other - ours) / ours).abs())
            .into_iter()
            .fold(0.0, f64::max);
        println!(
            "{:7}  {lagrange_s:10.3}  {energy_s:8.3}  {clarabel_s:10.3}  {:5.1}  {apart:.1e}",
            system.members().len(),
            clarabel_s / lagrange_s,
        );
    }
    Ok(())
}
