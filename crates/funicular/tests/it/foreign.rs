//! Systems of other programs, against closed forms.

#![expect(clippy::unwrap_used, reason = "helpers of tests")]

use std::path::Path;

use funicular::{Problem, Solve, SolveAnswer};
use model::STANDARD_GRAVITY_M_S2;

/// The equilibrium of a file with this text, both solvers of one mind.
fn solved(folder: &Path, name: &str, text: &str) -> SolveAnswer {
    std::fs::write(folder.join(name), text).unwrap();
    let problem = Problem::read(folder.join(name)).unwrap();
    let answer = Solve::new().run(&problem).unwrap();
    assert!(answer.agrees(), "{answer}");
    answer
}

/// A line of MAP++ between an anchor and a vessel; the mass a metre is such that `w` N/m are left in water.
fn line(
    span_m: f64,
    height_m: f64,
    length_m: f64,
    stiffness_n: f64,
    w: f64,
    flags: &str,
) -> String {
    let (diameter_m, density_kg_m3) = (0.05, 1025.0);
    let displaced_kg_m = 0.25 * std::f64::consts::PI * diameter_m * diameter_m * density_kg_m3;
    let mass_kg_m = w / STANDARD_GRAVITY_M_S2 + displaced_kg_m;
    format!(
        "--- LINE DICTIONARY ---\nLineType Diam MassDenInAir EA CB CIntDamp Ca Cdn Cdt\n\
         (-) (m) (kg/m) (N) (-) (Pa-s) (-) (-) (-)\nwire {diameter_m} {mass_kg_m:?} {stiffness_n:?} 0 1e8 0.6 -1 0.05\n\
         --- NODE PROPERTIES ---\nNode Type X Y Z M V FX FY FZ\n(-) (-) (m) (m) (m) (kg) (m^3) (N) (N) (N)\n\
         1 Fix 0 0 -300 0 0 # # #\n2 Vessel {span_m:?} 0 {:?} 0 0 # # #\n\
         --- LINE PROPERTIES ---\nLine LineType UnstrLen NodeAnch NodeFair Flags\n(-) (-) (m) (-) (-) (-)\n\
         1 wire {length_m:?} 1 2 {flags}\n--- SOLVER OPTIONS ---\nOption\n(-)\nhelp\n",
        height_m - 300.0
    )
}

/// The force of a line on the vessel: level, and down, N; and how many of its joints lie on the bottom.
fn pull(text: &str) -> [f64; 3] {
    let folder = tempfile::tempdir().unwrap();
    let answer = solved(folder.path(), "line.map", text);
    let found = &answer.equilibria()[0];
    let on_bottom = found.joints_m.iter().skip(2).filter(|at_m| at_m[2] < -300.0 + 1e-9).count();
    [found.reactions_n[1][0], found.reactions_n[1][2], on_bottom as f64]
}

/// Span and height of an elastic catenary of which one end bears `h` and `v`, m: with all of it hanging, or a part of it
/// on a bottom without friction at the height of its other end.
fn catenary(h: f64, v: f64, length_m: f64, stiffness_n: f64, w: f64) -> [f64; 2] {
    let (root, stretched) = (h.hypot(v), length_m / stiffness_n);
    if v < w * length_m {
        let span_m = h / w * (v / h).asinh() + stretched * h + length_m - v / w;
        return [span_m, (root - h) / w + v * v / (2.0 * w * stiffness_n)];
    }
    let u = v - w * length_m;
    let span_m = h / w * ((v / h).asinh() - (u / h).asinh()) + stretched * h;
    [span_m, (root - h.hypot(u)) / w + stretched * (v - 0.5 * w * length_m)]
}

/// Published by MoorPy as a test of its own, with a wrong answer; the forces are those of the elastic catenary.
#[test]
fn a_steep_line_of_map_has_the_forces_of_the_catenary() {
    let (length_m, w) = (360.635_662_663_969_27, 3.087_35);
    let ends = [246.224_209_400_329_47, 263.557_663_308_431_64];
    let [h, v] = [58_377.241_422_650, 63_044.412_955_917];
    let [span_m, height_m] = catenary(h, v, length_m, 700e6, w);
    assert!((span_m - ends[0]).hypot(height_m - ends[1]) < 1e-9);
    let [level, down, _] = pull(&line(ends[0], ends[1], length_m, 700e6, w, "OMIT_CONTACT"));
    eprintln!("{:e} {:e}", level / h - 1.0, down / v - 1.0);
    assert!((level / h - 1.0).abs() < 1e-4 && (down / v - 1.0).abs() < 1e-4);
}

/// Lines that hang free and that lie on the ground for a third, from the forces to the ends and back.
#[test]
fn slack_lines_of_map_have_the_forces_of_the_catenary() {
    for (h, v, flags) in [(40e3, 95e3, ""), (40e3, 60e3, ""), (9e3, 30e3, "OMIT_CONTACT")] {
        let (length_m, stiffness_n, w) = (150.0, 2e7, 600.0);
        let [span_m, height_m] = catenary(h, v, length_m, stiffness_n, w);
        let [level, down, on_bottom] =
            pull(&line(span_m, height_m, length_m, stiffness_n, w, flags));
        eprintln!("{v} {:e} {:e} {on_bottom}", level / h - 1.0, down / v - 1.0);
        assert!((level / h - 1.0).abs() < 1e-3 && (down / v - 1.0).abs() < 1e-3);
    }
}
