//! Equal bars of a fixed length tend to the catenary: energy, the forces at both ends, and the
//! shape, with order two, up to tens of thousands of bars, by both solvers.

use lagrange::condensed;
use model::Equilibrium;

/// Numbers of bars, each four times the one before it.
const SIZES: [usize; 5] = [64, 256, 1024, 4096, 16_384];
/// Deviation of the last measured order from two. The error has a term of order four as well, some
/// 1e-6 of the first at 4096 bars; rounding is some 1e-4 of the error at 16,384. Measured: 1.5e-4.
const ORDER: f64 = 1e-3;

/// The catenary of unit weight per length from (0, 0) to (across, rise): z = c cosh((x - low) /
/// c) + constant.
pub struct Catenary {
    /// The horizontal pull.
    pub c: f64,
    low: f64,
    across: f64,
}

impl Catenary {
    pub fn new(length: f64, across: f64, rise: f64) -> Self {
        // sinh(u) / u = sqrt(L² - rise²) / across with u = across / 2c, increasing: by bisection.
        let ratio = (length * length - rise * rise).sqrt() / across;
        let (mut small, mut large) = (1e-9, 50.0);
        for _ in 0..200 {
            let u: f64 = 0.5 * (small + large);
            if u.sinh() / u < ratio { small = u } else { large = u }
        }
        let c = across / (2.0 * small);
        Self { c, low: 0.5 * across - c * (rise / length).atanh(), across }
    }

    /// Slope angle's sinh at an end, times c: the vertical force that the chain hangs on it with.
    fn lift(&self, x: f64) -> f64 {
        self.c * ((x - self.low) / self.c).sinh()
    }

    fn height(&self, x: f64) -> f64 {
        self.c * (((x - self.low) / self.c).cosh() - (self.low / self.c).cosh())
    }

    /// Integral of z ds: with t = (x - low) / c, of (c cosh t - c cosh t0) c cosh t dt.
    pub fn energy(&self) -> f64 {
        let c = self.c;
        let [t0, t1] = [-self.low / c, (self.across - self.low) / c];
        let square = |t: f64| 0.5 * (t + t.sinh() * t.cosh());
        c * c * (square(t1) - square(t0) - t0.cosh() * (t1.sinh() - t0.sinh()))
    }
}

/// What is compared: energy, horizontal force, vertical forces at the start and at the end, tension
/// at the end, and how far the joints are from the curve.
const QUANTITIES: [&str; 6] =
    ["energy", "horizontal", "start, vertical", "end, vertical", "end, tension", "shape"];

fn errors(found: &Equilibrium, catenary: &Catenary) -> [f64; 6] {
    let [start, end] = [found.reactions_n.start, found.reactions_n.end];
    let lift = catenary.lift(catenary.across);
    let shape = found.joints_m.iter().map(|[x, _, z]| (z - catenary.height(*x)).abs());
    [
        found.energy_j - catenary.energy(),
        end[0] - catenary.c,
        start[2] + catenary.lift(0.0),
        end[2] - lift,
        end[0].hypot(end[2]) - catenary.c.hypot(lift),
        shape.fold(0.0, f64::max),
    ]
}

#[test]
fn energy_forces_and_shape_converge_with_order_two() {
    for (length, across, rise) in [(1.5, 1.0, -0.2), (3.0, 1.0, 0.5), (1.05, 1.0, 0.1)] {
        let catenary = Catenary::new(length, across, rise);
        let runs = SIZES.map(|n| {
            let bars = vec![(length / n as f64, length / n as f64); n];
            let problem = samples::homogeneous(1.0, &bars, [across, 0.0, rise]);
            let lagrange = condensed::solve(&problem, &condensed::Settings::default()).unwrap();
            let energy = energy::minimise(&problem, &energy::Settings::default()).unwrap();
            let errors =
                [lagrange.equilibrium, energy.equilibrium].map(|found| errors(&found, &catenary));
            // The energy comes from above: the minimum of the chain is over fewer shapes.
            assert!(errors.iter().all(|errors| errors[0] > 0.0), "{length}, {n}: {errors:?}");
            errors.map(|errors| errors.map(f64::abs))
        });
        for (solver, name) in ["lagrange", "energy"].into_iter().enumerate() {
            for (k, quantity) in QUANTITIES.into_iter().enumerate() {
                let error = |run: usize| runs[run][solver][k];
                let orders: Vec<f64> =
                    (1..SIZES.len()).map(|run| (error(run - 1) / error(run)).log(4.0)).collect();
                println!(
                    "{length} {name:8} {quantity:16} {:.2e} {orders:.6?}",
                    error(SIZES.len() - 1)
                );
                let last = orders[orders.len() - 1];
                assert!((last - 2.0).abs() < ORDER, "{length}, {name}, {quantity}: {orders:?}");
            }
        }
    }
}
