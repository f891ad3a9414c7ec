//! The field, judged: verdicts follow from numbers, and runs of members tend to the closed form.

use model::SolverName;
use validate::Solvers;
use validate::field::elastic_catenary::ElasticCatenary;
use validate::field::entry::{BothSolvers, Compared, Entry, FieldVerdict};
use validate::field::record::field;
use validate::field::run_of_members::{end_forces, run_of_members};
use validate::systems::ask;

/// A sagging cable that stretches by some percent, a mooring line between level ends that
/// hardly does, a steep one, and index 7 of MoorPy's own test, the hardest of its lines.
const CABLES: [ElasticCatenary; 4] = [
    ElasticCatenary { x_m: 80.0, z_m: 30.0, length_m: 100.0, stiffness_n: 1e4, weight_n_m: 10.0 },
    ElasticCatenary { x_m: 90.0, z_m: 0.0, length_m: 100.0, stiffness_n: 1e8, weight_n_m: 800.0 },
    ElasticCatenary { x_m: 20.0, z_m: 60.0, length_m: 70.0, stiffness_n: 1e5, weight_n_m: 50.0 },
    ElasticCatenary {
        x_m: 246.224_209_400_329_47,
        z_m: 263.557_663_308_431_64,
        length_m: 360.635_662_623_969_27,
        stiffness_n: 700e6,
        weight_n_m: 3.08735,
    },
];

/// Errors of the three end forces by each solver, for a run of so many members.
fn errors(cable: &ElasticCatenary, members: usize) -> [[f64; 3]; 2] {
    let closed = cable.solve().unwrap();
    let wanted = [closed.horizontal_n, closed.upper_n, closed.lower_n];
    let answer = ask(&run_of_members(cable, members).unwrap(), Solvers::Both, &|_| {});
    assert!(answer.agrees(), "{:?} {:?}", answer.failures, answer.agreement);
    [SolverName::LAGRANGE, SolverName::ENERGY].map(|solver| {
        let found = end_forces(answer.by(&solver).unwrap()).unwrap();
        std::array::from_fn(|k| found[k] - wanted[k])
    })
}

#[test]
fn runs_of_elastic_members_tend_to_the_elastic_catenary_with_order_two() {
    for cable in CABLES {
        let [coarse, fine] = [40, 80].map(|members| errors(&cable, members));
        for solver in 0..2 {
            for force in 0..3 {
                let [coarse, fine] = [coarse, fine].map(|run| run[solver][force].abs());
                // Between level ends each bears half the weight whatever the number of members.
                if cable.z_m <= 0.0 && force > 0 {
                    assert!(coarse < 1e-9 * cable.weight_n_m * cable.length_m);
                    continue;
                }
                let order = (coarse / fine).log2();
                // The next term of the expansion is of order four.
                assert!((order - 2.0).abs() < 0.02, "{cable:?}: {coarse:e} {fine:e} {order}");
            }
        }
    }
}

fn entry<'a>(record: &'a [Entry], title: &str) -> &'a Entry {
    record.iter().find(|entry| entry.title.contains(title)).unwrap()
}

#[test]
fn the_record_says_what_its_numbers_say() {
    let record = field();
    let verdict = |title: &str| entry(&record, title).verdict();
    for index in [1, 3, 4, 5, 6, 8, 9] {
        let title = format!("mooring line, index {index}");
        assert_eq!(verdict(&title), FieldVerdict::Confirmed, "{:?}", entry(&record, &title));
    }
    // Two of the three lines on the floor meet friction there; the third is the rigid catenary with
    // (V/w)² = z² + 2 z H/w, to the stretch.
    let lies = entry(&record, "mooring line, index 1");
    let [h, _, _, v, lies_m] = &lies.numbers[..] else { panic!("five numbers") };
    let hangs_m = -v.ours / 800.0;
    assert!((hangs_m * hangs_m - 200.0 * (200.0 + 2.0 * h.ours / 800.0)).abs() < 1e-2);
    assert!((500.0 - hangs_m - lies_m.ours).abs() < 1e-9);
    let Some(BothSolvers::Run { members: 100, off }) = &lies.solvers else { panic!("a run") };
    assert!(off.iter().all(|(_, off)| off.is_some_and(|off| off < 1e-3)), "{off:?}");
    for index in [0, 2] {
        assert_eq!(verdict(&format!("mooring line, index {index}")), FieldVerdict::NotJudged);
    }
    // Equal vertical forces at both ends of a line that weighs 1113.4 N.
    let refuted = entry(&record, "mooring line, index 7");
    assert_eq!(refuted.verdict(), FieldVerdict::Refuted);
    let left_n = refuted.by_hand.as_ref().unwrap().broken_n;
    assert!((left_n - 1_113.408_5).abs() < 1e-3, "{left_n}");
    let [h, a, _, b] = &refuted.numbers[..] else { panic!("four forces") };
    for (found, wanted) in [(h, 58_377.241_42), (a, 61_931.004_44), (b, -63_044.412_96)] {
        assert!((found.ours / wanted - 1.0).abs() < 1e-8, "{found:?}");
    }
    for title in ["325 m", "stays", "Olympia", "Stuttgart 21"] {
        assert_eq!(verdict(title), FieldVerdict::Confirmed, "{:?}", entry(&record, title));
    }
    for title in ["Olympia", "Stuttgart 21"] {
        let judged = &entry(&record, title).solvers;
        assert!(
            matches!(judged, Some(BothSolvers::Judged { finding: "confirmed", .. })),
            "{judged:?}"
        );
    }
    // Their lengths are kept to 1e-7 only, and the energies lie below what lengths allow.
    assert_eq!(verdict("half of a chain of 8 bars"), FieldVerdict::Corrected);
}

#[test]
fn a_verdict_needs_its_numbers() {
    let number = |published, ours| Compared {
        what: "force / N".to_owned(),
        printed: "1".to_owned(),
        published,
        ours,
        allowed: 0.5,
        at_most: false,
        digits: 3,
    };
    let of = |numbers: Vec<Compared>| {
        let open = Entry::not_judged("x", "y", "z");
        Entry { numbers, not_judged: None, ..open }.verdict()
    };
    assert_eq!(of(vec![number(1.0, 1.4)]), FieldVerdict::Confirmed);
    assert_eq!(of(vec![number(1.0, 1.6)]), FieldVerdict::Corrected);
    assert_eq!(of(vec![number(1.0, f64::NAN)]), FieldVerdict::Corrected);
    assert_eq!(of(vec![]), FieldVerdict::NotJudged);
}
