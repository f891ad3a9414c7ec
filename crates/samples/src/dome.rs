//! Shallow domes on a triangular grid.

use std::fmt::Write as _;

/// A dome of 20 m of radius on a sphere of 50 m as the text of a system file: so many rings of free joints
/// around the top, the ring beyond them held, elastic bars of EA = 1 MN without mass along the grid. 1 kN pulls
/// down at the top, or at all free joints.
///
/// ```
/// let file = samples::dome(1, false);
/// // Seven free joints, twelve held ones; each free one meets six bars.
/// assert_eq!(file.matches("near_m").count(), 7);
/// assert_eq!(file.matches("[[bars]]").count(), 12 + 18);
/// assert_eq!(file.matches("force_n").count(), 1);
/// ```
pub fn dome(rings: i32, all_loaded: bool) -> String {
    let edge = rings + 1;
    let ring = |q: i32, r: i32| q.abs().max(r.abs()).max((q + r).abs());
    let (mut file, mut bars) = ("[joints]\n".to_owned(), String::new());
    for q in -edge..=edge {
        for r in (-edge..=edge).filter(|r| ring(q, *r) <= edge) {
            let step = 20.0 / f64::from(edge);
            let x = (f64::from(q) + 0.5 * f64::from(r)) * step;
            let y = f64::from(r) * 0.75_f64.sqrt() * step;
            let z = (2500.0 - x * x - y * y).sqrt() - 2100_f64.sqrt();
            let loaded = all_loaded || ring(q, r) == 0;
            let (key, more) = match ring(q, r) {
                far if far == edge => ("at_m", ""),
                _ if loaded => ("near_m", ", force_n = [0, 0, -1000]"),
                _ => ("near_m", ""),
            };
            let _ = writeln!(file, "\"{q} {r}\" = {{ {key} = [{x}, {y}, {z}]{more} }}");
            for (a, b) in [(q + 1, r), (q, r + 1), (q + 1, r - 1)] {
                if ring(a, b) <= edge && ring(a, b).min(ring(q, r)) < edge {
                    let ends = format!("from = \"{q} {r}\"\nto = \"{a} {b}\"");
                    let _ = writeln!(bars, "[[bars]]\n{ends}\nmass_kg = 0\nstiffness_n = 1e6");
                }
            }
        }
    }
    file + &bars
}
