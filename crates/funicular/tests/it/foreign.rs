//! Systems of other programs, against closed forms.

use std::path::Path;

use funicular::{Modes, Problem, Solve, SolveAnswer};
use model::STANDARD_GRAVITY_M_S2;

use crate::run::holding;

/// The equilibrium of a file with this text, both solvers of one mind.
fn solved(folder: &Path, name: &str, text: &str) -> SolveAnswer {
    std::fs::write(folder.join(name), text).unwrap();
    let problem = Problem::read(folder.join(name)).unwrap();
    let answer = Solve::new().run(&problem).unwrap();
    assert!(answer.agrees(), "{answer}");
    answer
}

/// How far 50 cables in a row are from the catenary, as a part of its force: the error goes with the square of their
/// length. Of the lines here it is at most 2.7e-4.
const WITHIN: f64 = 1.0 / (50.0 * 50.0);

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
fn pull(text: &str) -> ([f64; 2], usize) {
    let folder = tempfile::tempdir().unwrap();
    let answer = solved(folder.path(), "line.map", text);
    let found = &answer.equilibria()[0];
    let on_bottom =
        found.joints_m.iter().skip(2).filter(|at_m| (at_m[2] + 300.0).abs() < 1e-9).count();
    ([found.reactions_n[1][0], found.reactions_n[1][2]], on_bottom)
}

/// Span and height of an elastic catenary of which one end bears `h` and `v`, m: with all of it hanging, or a part of it
/// on a bottom without friction at the height of its other end.
fn catenary([h, v]: [f64; 2], [length_m, stiffness_n, w]: [f64; 3], bottom: bool) -> [f64; 2] {
    let (root, stretched) = (h.hypot(v), length_m / stiffness_n);
    if bottom && v < w * length_m {
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
    let (length_m, w) = (360.635_662_623_969_27, 3.087_35);
    let ends = [246.224_209_400_329_47, 263.557_663_308_431_64];
    let [h, v] = [58_377.241_422_650, 63_044.412_955_917];
    let [span_m, height_m] = catenary([h, v], [length_m, 700e6, w], true);
    assert!((span_m - ends[0]).hypot(height_m - ends[1]) < 1e-9);
    let ([level, down], _) = pull(&line(ends[0], ends[1], length_m, 700e6, w, "OMIT_CONTACT"));
    assert!((level / h - 1.0).abs() < WITHIN && (down / v - 1.0).abs() < WITHIN);
}

/// Lines that hang free and that lie on the ground for a third, from the forces to the ends and back.
#[test]
fn slack_lines_of_map_have_the_forces_of_the_catenary() {
    for (h, v, flags, lying) in
        [(40e3, 95e3, "", false), (40e3, 60e3, "plot", true), (9e3, 30e3, "OMIT_CONTACT", false)]
    {
        let (length_m, stiffness_n, w) = (150.0, 2e7, 600.0);
        let [span_m, height_m] =
            catenary([h, v], [length_m, stiffness_n, w], flags != "OMIT_CONTACT");
        let text = line(span_m, height_m, length_m, stiffness_n, w, flags);
        let ([level, down], on_bottom) = pull(&text);
        assert!(
            (level / h - 1.0).abs() < WITHIN && (down / v - 1.0).abs() < WITHIN,
            "{v} {:e} {:e}",
            level / h - 1.0,
            down / v - 1.0
        );
        // A third of the 50 cables: all but 100 m of them hang.
        assert_eq!(on_bottom, if lying { 17 } else { 0 });
    }
}

/// Two trusses of other stiffness, area and slope, whose loaded node has gone to a place that is chosen: the loads are
/// what their elongation makes there.
#[test]
fn a_truss_of_opensees_is_where_its_elongations_balance_the_loads() {
    let (feet, top, found) = ([[-3.0, 0.5], [4.0, -0.25]], [0.0, 2.0], [0.125, 1.75]);
    let (young_pa, areas_m2) = ([70e6, 210e6], [2e-3, 5e-4]);
    let mut load_n = [0.0; 2];
    for k in 0..2 {
        let [x, y]: [f64; 2] = feet[k];
        let (l0, l) = ((top[0] - x).hypot(top[1] - y), (found[0] - x).hypot(found[1] - y));
        let axial_n = young_pa[k] * areas_m2[k] * (l - l0) / l0;
        load_n[0] += axial_n * (found[0] - x) / l;
        load_n[1] += axial_n * (found[1] - y) / l;
    }
    let deck = format!(
        "# two bars\nmodel basic -ndm 2 -ndf 2\nset E {:?}; set twice [expr 3*$E]\nset P {{{:?}}}\n\
         node 1 {:?} {:?}\nnode 2 {:?} {:?}\nnode 3 [expr 10/4 - 2.0] [expr sqrt(4)]\nfix 1 1 1\nfix 2 1 1\n\
         uniaxialMaterial Elastic 1 $E\nuniaxialMaterial Elastic 2 ${{twice}}\n\
         element corotTruss 1 1 3 {:?} 1\nelement Truss 2 3 2 {:?} 2 -rho 80.0\nmass 3 100 100\n\
         timeSeries Linear 7 -factor 2\npattern Plain 1 7 {{\n  load 3 [expr {{0.5*$P}}] \\\n {:?}\n}}\n\
         recorder Node -file out.txt -node 3 -dof 1 2 disp\nset ok [analyze 10]\n",
        young_pa[0],
        load_n[0],
        feet[0][0],
        feet[0][1],
        feet[1][0],
        feet[1][1],
        areas_m2[0],
        areas_m2[1],
        0.5 * load_n[1],
    );
    let folder = tempfile::tempdir().unwrap();
    let answer = solved(folder.path(), "two.tcl", &deck);
    let at_m = answer.equilibria()[0].joints_m[2];
    assert!((at_m[0] - found[0]).hypot(at_m[2] - found[1]) < 1e-12, "{at_m:?}");
    assert!(at_m[1].abs() <= 0.0);
}

/// Eight trusses on two anchors and two sliders, and what OpenSees 3.7.1 finds (openseespy 3.7.1.2, corotTruss, twenty steps,
/// unbalance of 1e-9 N).
const TRIPOD: &str = "model basic -ndm 3 -ndf 3\nnode 1 -3 0.5 0\nnode 2 4 -0.25 0\nnode 3 0.25 -3.5 0.1\nnode 4 0 0.2 2\n\
    node 5 0.5 3 0\nfix 1 1 1 1\nfix 2 0 1 1\nfix 3 0 0 1\nfix 5 1 1 1\n\
    uniaxialMaterial Elastic 1 70e6\nuniaxialMaterial Elastic 2 210e6\n\
    element corotTruss 1 1 4 2e-3 1\nelement corotTruss 2 2 4 5e-4 2\nelement corotTruss 3 3 4 1e-3 2\n\
    element corotTruss 4 5 4 1.5e-3 1\nelement corotTruss 5 1 2 3e-3 1\nelement corotTruss 6 2 3 4e-4 2\n\
    element corotTruss 7 1 3 6e-4 1\nelement corotTruss 8 3 5 7e-4 2\n\
    timeSeries Linear 1\npattern Plain 1 1 {\nload 4 3e3 -1.5e3 -8e3\nload 2 2e3 0 0\n}\n";
const TRIPOD_M: [[f64; 3]; 5] = [
    [-3.0, 0.5, 0.0],
    [4.189_147_201_003_194, -0.25, 0.0],
    [0.491_578_961_389_531_06, -3.676_062_618_349_213, 0.1],
    [0.185_952_435_890_176_04, 0.090_275_216_936_425_79, 1.492_775_028_909_919_8],
    [0.5, 3.0, 0.0],
];
const TRIPOD_N: [f64; 8] = [
    -2_936.985_287_408_633, -4_876.006_945_677_639, -7_036.045_080_297_409, -5_789.571_317_887_865,
    5_610.853_171_567_846, 1_327.703_628_018_789, 2_358.488_946_617_874_7, 3_869.391_975_407_425,
];

#[test]
fn a_deck_has_the_places_and_forces_of_opensees() {
    let folder = tempfile::tempdir().unwrap();
    let answer = solved(folder.path(), "tripod.tcl", TRIPOD);
    let found = &answer.equilibria()[0];
    for (at_m, theirs_m) in found.joints_m.iter().zip(TRIPOD_M) {
        let away = at_m.iter().zip(theirs_m).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(away < 1e-11, "{at_m:?} {theirs_m:?}");
    }
    for (axial_n, theirs_n) in found.axial_n.iter().zip(TRIPOD_N) {
        assert!((axial_n - theirs_n).abs() < 1e-7, "{axial_n} {theirs_n}");
    }
}

/// Two trusses in a plane without loads: stiffness EA/L along each, a mass that does not weigh.
#[test]
fn a_mass_of_opensees_swings_and_does_not_weigh() {
    // 3 and 4 m to a right angle: stiffness of 900 and 500 N/m, each of a mode of its own; 4 and 1 kg at the node.
    let deck = "model basic -ndm 2\nnode 1 0 0\nnode 2 5 0\nnode 3 1.8 -2.4 -mass 4 4\nfix 1 1 1\nfix 2 1 1\n\
        uniaxialMaterial Elastic 1 1e3\nelement truss 1 1 3 2.7 1\nelement truss 2 2 3 2 1 -rho 0.5\n";
    let folder = holding([("two.tcl", deck)]);
    let problem = Problem::read(folder.path().join("two.tcl")).unwrap();
    let found = Modes::new().run(&problem).unwrap();
    let one = &found.equilibria[0];
    let mut squares: Vec<f64> = one.modes.iter().map(|mode| mode.omega2_s2).collect();
    squares.sort_by(f64::total_cmp);
    for (found, wanted) in squares.iter().zip([500.0 / 5.0, 900.0 / 5.0]) {
        assert!((found / wanted - 1.0).abs() < 1e-9, "{squares:?}");
    }
    assert_eq!(squares.len(), 2);
}

/// A weight on a light rope swings as a rigid pendulum: `omega^2 = (W + w L/2)/((M + m/3) L)` with the weights W and w L
/// in water, and of inertia the whole mass M of the weight.
#[test]
fn a_weight_in_water_swings_with_its_whole_mass() {
    let (length_m, mass_kg, w, stiffness_n) = (50.0, 1000.0, 0.1, 1e6);
    let deck = line(0.0, 0.0, length_m, stiffness_n, w, "OMIT_CONTACT");
    let deck =
        deck.replace("2 Vessel 0.0 0 -300.0 0 0 # # #", "2 connect #0 #0 #-350 1000 0.9 0 0 0");
    assert!(deck.contains("connect"), "{deck}");
    let folder = holding([("pendulum.map", deck)]);
    let problem = Problem::read(folder.path().join("pendulum.map")).unwrap();
    let found = Modes::new().run(&problem).unwrap();
    let weight_n = (mass_kg - 0.9 * 1025.0) * STANDARD_GRAVITY_M_S2;
    let stretched_m = length_m * (1.0 + weight_n / stiffness_n);
    let rope_n = w * length_m;
    let moment = (weight_n + 0.5 * rope_n) * stretched_m;
    let inertia = (mass_kg + rope_n / STANDARD_GRAVITY_M_S2 / 3.0) * stretched_m.powi(2);
    let mut squares: Vec<f64> = found.equilibria[0].modes.iter().map(|m| m.omega2_s2).collect();
    squares.sort_by(f64::total_cmp);
    // In x and in y. The rope bends under its weight across the chord, which takes away a part of some (w L/W)^2/12.
    let within = (rope_n / weight_n).powi(2);
    for square in &squares[..2] {
        assert!((square * inertia / moment - 1.0).abs() < within, "{squares:?}");
    }
    assert!(squares[2] > 10.0 * squares[1], "{squares:?}");
}
