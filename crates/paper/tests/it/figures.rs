//! What there is to draw.

use crate::reproduction::reproduction;

#[test]
fn both_solvers_converge_quadratically() {
    let figures = &reproduction().figures;
    assert_eq!(figures.histories.len(), 2 * 2);
    for history in &figures.histories {
        let r = &history.residuals;
        assert!(*r.last().unwrap() < 1e-12, "{history:?}");
        // While rounding has no part in it the exponent of one step's residual over that of the
        // last one is near two.
        let orders: Vec<f64> = r
            .windows(2)
            .filter(|w| w[0] < 1e-2 && w[1] > 1e-13)
            .map(|w| w[1].ln() / w[0].ln())
            .collect();
        assert!(orders.iter().any(|&order| order > 1.7), "{history:?}: {orders:?}");
    }
}

#[test]
fn the_scan_lies_on_the_curve_and_its_second_result_on_a_slope() {
    let figures = &reproduction().figures;
    // The secant of the first two points of the scan, half a step further on; the slope changes
    // by less than 2 mgl/rad per rad.
    let [first, second] = [figures.scan_points[1][0], figures.scan_points[1][1]];
    let secant = (second[1] - first[1]) / (second[0] - first[0]).to_radians();
    assert!((figures.slope_at_x - secant).abs() < 1e-3, "{}", figures.slope_at_x);
    let [_, [theta, _, _, energy]] = figures.scan_results;
    assert_eq!(
        (format!("{theta:.5}"), format!("{energy:.5}")),
        ("0.05730".into(), "2.50087".into())
    );
    for scan in &figures.scan_points {
        let least = scan.iter().map(|p| p[1]).fold(f64::INFINITY, f64::min);
        // The scan solves (viii) for alpha, the curve is geometry.
        assert!(figures.scan_results.iter().any(|r| (r[3] - least).abs() < 1e-9), "{least}");
    }
}

#[test]
fn energy_ends_at_minima_and_lagrange_anywhere() {
    let [lagrange, energy] = &reproduction().figures.basins;
    let side = 73;
    for basins in [lagrange, energy] {
        assert_eq!(basins.rows.len(), side);
        assert!(basins.rows.iter().all(|row| row.len() == side));
    }
    // The minimiser: E1 or E1', nearly all starts. A start with all bars on one line has no
    // side to fall to.
    let minima = energy.count('1') + energy.count('2');
    assert!(minima + energy.count('-') == side * side && energy.count('-') < 10, "{minima}");
    // The multipliers: all four, each by a good part.
    for letter in ['1', '2', '3', '4'] {
        assert!(lagrange.count(letter) > side * side / 20, "{letter}: {}", lagrange.count(letter));
    }
}
