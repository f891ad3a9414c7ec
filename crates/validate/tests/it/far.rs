//! Systems far from the origin, as survey coordinates put them: both solvers agree, and what they say is that of closed
//! forms to the rounding of the coordinates.

use model::Bar;
use model::system::{Joint, Member, System};
use validate::Solvers;
use validate::systems::ask;

/// Origins of surveys, m: none, one of UTM, one beyond.
const ORIGINS_M: [[f64; 3]; 3] = [[0.0; 3], [500_000.0, 5_400_000.0, 300.0], [1e7, -3e6, 8848.0]];

/// A place turned about the vertical by 0.3 rad and moved to an origin, which rounds its coordinates.
fn moved([x, y, z]: [f64; 3], origin_m: [f64; 3]) -> [f64; 3] {
    let (sin, cos) = 0.3_f64.sin_cos();
    [origin_m[0] + cos * x - sin * y, origin_m[1] + sin * x + cos * y, origin_m[2] + z]
}

/// Both solvers agree on the height of joint `P` below the reference and on the force of member 0, which gains
/// `stiff_n_m` by a metre.
#[track_caller]
fn agreed(system: &System, wanted_m: f64, wanted_n: f64, stiff_n_m: f64) {
    let answer = ask(system, Solvers::Both, &|_| {});
    assert!(answer.agrees() && answer.equilibria.len() == 2, "{:?}", answer.agreement);
    let joint = system.joints().iter().position(|joint| joint.name == "P").unwrap();
    let far_m = system.reference_m().iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    let rounding_m = 4.0 * f64::EPSILON * far_m;
    for found in &answer.equilibria {
        let down_m = system.reference_m()[2] - found.joints_m[joint][2];
        assert!((down_m - wanted_m).abs() < 1e-12 + rounding_m, "{down_m} m");
        let off_n = (found.axial_n[0] - wanted_n).abs();
        assert!(off_n < 1e-10 * wanted_n + stiff_n_m * rounding_m, "{} N", found.axial_n[0]);
    }
}

/// Where a function that grows crosses zero.
fn zero(of: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, 100.0);
    for _ in 0..200 {
        let middle = f64::midpoint(low, high);
        if of(middle) < 0.0 { low = middle } else { high = middle }
    }
    low
}

/// 20 m apart four anchors hold a joint with 0.06 N by cables of EA 68 MN that bear 5.5 kN at 20 m: at the depth d, s
/// long, each bears (EA + N) (s/20 - 1) + N, and four of that times d/s are the load.
#[test]
fn stiff_cables_with_prestress() {
    let (stiffness_n, prestress_n, load_n) = (68e6, 5500.0, 0.06);
    let long_m = |down_m: f64| down_m.hypot(20.0);
    let pull_n = |down_m: f64| {
        // s - 20 without cancellation.
        let stretch_m = down_m * down_m / (long_m(down_m) + 20.0);
        (stiffness_n + prestress_n) * stretch_m / 20.0 + prestress_n
    };
    let down_m = zero(|down_m| 4.0 * pull_n(down_m) * down_m / long_m(down_m) - load_n);
    for origin_m in ORIGINS_M {
        let at = [[-20.0, 0.0], [20.0, 0.0], [0.0, -20.0], [0.0, 20.0]];
        let mut joints = vec![Joint::free("P").with_mass(load_n / 10.0).near(origin_m)];
        let anchor =
            |[x, y]: [f64; 2]| Joint::anchor(format!("{x} {y}"), moved([x, y, 0.0], origin_m));
        joints.extend(at.map(anchor));
        let cable = |to| {
            let body = Bar::homogeneous(20.0, 0.0).unwrap();
            Member::cable(0, to, body)
                .with_stiffness(stiffness_n)
                .with_prestress(prestress_n)
                .unwrap()
        };
        let system = System::new("cross", 10.0, joints, (1..5).map(cable).collect()).unwrap();
        agreed(&system, down_m, pull_n(down_m), stiffness_n / 20.0);
    }
}

/// A ring with 100 kN on a rope of EA 1.4 MN and 15 m, whose ends are 4 m apart: 2 s long at the depth d with
/// s^2 = 4 + d^2, it bears T with 2 s = 15 (1 + T/EA), and 2 T d/s is the load. A slack cable holds the ring, too.
#[test]
fn a_ring_on_a_rope_that_stretches() {
    let (stiffness_n, load_n) = (1.4e6, 1e5);
    let pull_n = |down_m: f64| stiffness_n * (2.0 * down_m.hypot(2.0) / 15.0 - 1.0);
    let down_m = zero(|d| 2.0 * pull_n(d) * d / d.hypot(2.0) - load_n);
    for origin_m in ORIGINS_M {
        let anchor = |name: &str, at_m| Joint::anchor(name, moved(at_m, origin_m));
        let joints = vec![
            anchor("A", [0.0; 3]),
            anchor("B", [4.0, 0.0, 0.0]),
            anchor("H", [2.0, 2.0, 1.0]),
            Joint::free("P").with_mass(load_n / 10.0),
        ];
        let body = |length_m| Bar::homogeneous(length_m, 0.0).unwrap();
        let rope = Member::cable(0, 1, body(15.0)).over(vec![3]).with_stiffness(stiffness_n);
        let slack = Member::cable(2, 3, body(12.0)).with_stiffness(1e8);
        let system = System::new("ring", 10.0, joints, vec![rope, slack]).unwrap();
        agreed(&system, down_m, pull_n(down_m), stiffness_n / 15.0);
    }
}
