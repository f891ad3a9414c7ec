//! Two bars between anchors next to each other.

use model::{Bar, Equilibrium, Problem, Vector};

use crate::of_bars;

/// Two bars and what is known of them.
pub struct Pair {
    /// The two bars, in gravity 10 m/s².
    pub problem: Problem,
    joint_m: Vector,
    axial_n: [f64; 2],
}

impl Pair {
    /// The joint to 1e-15 m and the forces to 1e-13 of each; about one vertical any turn of it.
    pub fn assert_holds(&self, found: &Equilibrium) {
        let upright = self.problem.chain().anchors_on_one_vertical();
        let turned = |[x, y, z]: Vector| if upright { [x.hypot(y), 0.0, z] } else { [x, y, z] };
        let (joint, known) = (turned(found.joints_m[1]), turned(self.joint_m));
        assert!((0..3).all(|k| (joint[k] - known[k]).abs() <= 1e-15), "{joint:?}, not {known:?}");
        for (axial, known) in found.axial_n.iter().zip(self.axial_n) {
            assert!((axial / known - 1.0).abs() < 1e-13, "{known}: {axial}");
        }
        assert_eq!(found.stability.index_in_space, 0);
        assert_eq!(found.evidence.nullity, usize::from(upright));
    }
}

/// Homogeneous bars of unlike lengths: folded across the span, nearly along it, plumb, and about one vertical. Joint
/// and forces from the same triangle with 60 digits (mpmath 1.3).
pub fn unlike_pairs() -> Vec<Pair> {
    type Row = ([f64; 2], [f64; 2], Vector, Vector, [f64; 2]);
    let part = |power: i32| 2.0_f64.powi(power);
    let rows: Vec<Row> = vec![
        (
            [1.0, 1.000_000_05],
            [1.0, 2.0],
            [6e-8, 0.0, 8e-8],
            [0.392_820_363_716_983_5, 0.0, -0.919_615_224_889_875_8],
            [-68_038_470.690_166_84, 68_038_484.484_395_47],
        ),
        (
            [1.3, 1.3 - 7e-9],
            [0.5, 2.0],
            [3e-9, -4e-9, -9e-9],
            [-0.242_451_305_777_947_55, 0.323_268_407_703_930_1, -1.235_603_051_512_553_5],
            [669_030_418.592_931_3, -669_030_406.712_132_7],
        ),
        (
            [0.7, 0.7 + part(-32)],
            [2.0, 1.0],
            [2e-10, 1e-10, -3e-10],
            [-0.625_796_042_231_794, -0.312_898_021_115_897, 0.021_774_799_856_217_606],
            [35_831_172_422.493_99, -35_831_172_422.960_594],
        ),
        (
            [1.5, 1.5 - part(-30)],
            [1.0, 1.0],
            [part(-31), 0.0, -part(-30)],
            [2.328_306_436_900_097e-10, 0.0, -1.5],
            [5.000_000_000_776_102, 4.999_999_999_223_898],
        ),
        (
            [2.0, 2.0 + 3.0 * part(-34)],
            [1.0, 3.0],
            [part(-36), 0.0, 3.0 * part(-34)],
            [7.275_957_614_024_607e-12, 0.0, -2.0],
            [9.999_999_999_781_721, 10.000_000_000_218_279],
        ),
        (
            [1.0, 1.0 - 9.999e-9],
            [1.0, 1.0],
            [6e-9, 0.0, 8e-9],
            [0.611_253_641_913_412_7, 0.0, 0.791_434_763_734_566_7],
            [-43_222_404_620.780_92, 43_222_404_612.866_58],
        ),
        (
            [1.0, 1.0],
            [1.0, 2.0],
            [1e-12, 0.0, 1e-12],
            [0.707_106_781_187_047_5, 0.0, -0.707_106_781_186_047_5],
            [-7_499_999_999_994.697, 7_500_000_000_005.303],
        ),
        (
            [3.0, 3.0 + 1e-6],
            [1.0, 1.0],
            [1e-4, 0.0, 2e-4],
            [2.677_305_184_394_758_4, 0.0, -1.353_527_594_699_475_9],
            [-119_729.433_069_186_96, 119_733.945_160_423_5],
        ),
        (
            [1.5, 1.5 + 3.0 * part(-30)],
            [1.0, 1.0],
            [0.0, 0.0, 5.0 * part(-30)],
            [0.0, -1.200_000_001_117_587, -0.899_999_998_509_883_9],
            [-3_221_225_472.0, 3_221_225_478.0],
        ),
    ];
    let pair = |(lengths, masses, end_m, joint_m, axial_n): Row| {
        let bar = |k: usize| Bar::homogeneous(lengths[k], masses[k]).expect("a bar");
        Pair { problem: of_bars(10.0, [bar(0), bar(1)], end_m), joint_m, axial_n }
    };
    rows.into_iter().map(pair).collect()
}
