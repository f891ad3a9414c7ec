//! Chains in general position are what was asked for.

use samples::{General, Line, stream};

#[test]
fn chains_are_in_their_ranges() {
    for number in 0..200 {
        let mut random = stream(1, number);
        let n = 2 + usize::try_from(number).unwrap() % 9;
        for line in [Line::Any, Line::Vertical, Line::PlaneOyz] {
            let general = General { centre: 0.2..0.8, line, ..General::default() };
            let problem = general.problem(&mut random, n);
            let chain = problem.chain();
            assert_eq!(chain.bars().len(), n);
            for bar in chain.bars() {
                assert!((0.5..2.0).contains(&bar.length_m()));
                assert!((0.2..0.8).contains(&(bar.centre_m() / bar.length_m())));
            }
            assert_eq!(chain.anchors_on_one_vertical(), line == Line::Vertical);
            let [x, ..] = chain.anchors().difference_m();
            assert_eq!(x.abs() > 0.0, line == Line::Any);
            let part = chain.anchors().span_m() / chain.total_length_m();
            assert!((0.05 - 1e-15..0.95 + 1e-15).contains(&part), "{part}");
        }
    }
}

#[test]
fn the_first_anchor_is_where_it_is_asked_for() {
    let general = General { start_m: -1.0..1.0, ..General::default() };
    let starts = [0, 1].map(|k| general.problem(&mut stream(2, k), 3).chain().anchors().start_m);
    assert_ne!(starts[0].map(f64::to_bits), starts[1].map(f64::to_bits));
    assert!(starts.iter().flatten().all(|x| x.abs() < 1.0));
}
