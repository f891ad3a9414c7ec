//! How long the census of a bridle of three strands takes, by the number of its bars.
//!
//! `cargo run --profile dist -p census --example bridle_census [most bars]`

use std::time::Instant;

use census::Settings;
use census::net::SystemCensus;
use model::Bar;
use model::system::{Joint, Member, System};

/// Three strands of so many bars between anchors at different heights, weights growing along them.
fn bridle(bars: [usize; 3]) -> Result<System, Box<dyn std::error::Error>> {
    let corners = [[2.0, 0.0, 0.0], [-1.0, 1.5, 0.2], [-1.1, -1.6, -0.1]];
    let mut joints = vec![Joint::free("knot").with_mass(1.0)];
    let mut members = vec![];
    for ((k, at), bars) in corners.into_iter().enumerate().zip(bars) {
        let mut here = joints.len();
        joints.push(Joint::anchor(format!("A{here}"), at));
        for i in 0..bars {
            let there = if i + 1 == bars { 0 } else { joints.len() };
            if there > 0 {
                let kg = 0.5 + 0.1 * k as f64 + 0.07 * i as f64;
                joints.push(Joint::free(format!("P{there}")).with_mass(kg));
            }
            let length_m = (2.6 + 0.2 * k as f64) / bars as f64 * (1.0 + 0.1 * i as f64);
            members.push(Member::bar(here, there, Bar::homogeneous(length_m, 0.0)?));
            here = there;
        }
    }
    Ok(System::new("bridle", 10.0, joints, members)?)
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let most: usize = std::env::args().nth(1).map_or(Ok(9), |bars| bars.parse())?;
    let settings = Settings { max_bridle_bars: most, ..Settings::default() };
    let shapes = [
        [3, 1, 1],
        [3, 2, 2],
        [3, 3, 2],
        [3, 3, 3],
        [5, 2, 2],
        [4, 3, 3],
        [4, 4, 3],
        [4, 4, 4],
        [6, 3, 3],
        [5, 5, 5],
    ];
    for bars in shapes.into_iter().filter(|bars| bars.iter().sum::<usize>() <= most) {
        let start = Instant::now();
        let census = SystemCensus::take(&bridle(bars)?, &settings)?;
        let tests: u64 = census.nets().map(|net| net.tests).sum();
        println!(
            "{bars:?}: {} equilibria, complete {}, {} boxes, {tests} tests, {:.2} s",
            census.equilibria.len(),
            census.complete,
            census.cells(),
            start.elapsed().as_secs_f64(),
        );
    }
    Ok(())
}
