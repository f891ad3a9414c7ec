//! Families of equilibria with slack bars.

use census::Settings;
use model::{Anchors, Bar};

use super::*;

/// The last bar hangs from its anchor, with 1 kg at its middle, 0.375 m below 3 m; the others, slack
/// and without mass, bridge what is left of the way in many ways, all of one energy.
#[test]
fn an_energy_is_that_of_a_family_to_rounding() {
    let bar = |length, mass| Bar::homogeneous(length, mass).unwrap();
    let bars = vec![bar(0.5, 0.0), bar(1.0, 0.0), bar(2.0, 0.0), bar(0.75, 1.0)];
    let anchors = Anchors { start_m: [0.0; 3], end_m: [0.0, 0.0, 3.0] };
    let problem = Problem::new(Chain::new("slack", 9.81, anchors, bars).unwrap()).unwrap();
    let census = Census::take(&problem, &Settings::default()).unwrap();
    assert_eq!(census.families.len(), 1);
    let energy_j = 9.81 * 2.625;
    // The unit is 9.81 N times 4.25 m: 1e-12 of it are 4e-11 J.
    for (off_j, is_one) in [(0.0, true), (2e-11, true), (-1e-10, false), (1e-10, false)] {
        assert_eq!(in_family(problem.chain(), &census, energy_j + off_j), is_one, "{off_j}");
    }
    assert!(!in_family(problem.chain(), &census, f64::NAN));
}
