//! What is written reads back, bit for bit.

use model::system_file::{parse, write_system};
use model::{Anchors, Bar, Chain, Problem};
use proptest::prelude::*;

use crate::support::chain;

/// Numbers of a wide range of magnitudes, with all their digits; as masses none is lost in another.
fn positive() -> impl Strategy<Value = f64> {
    (-26.0..26.0_f64).prop_map(f64::exp2)
}

/// Zero with either sign, or positive: `-0.0 == 0.0`, and yet it must read back as it was.
fn not_negative() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(-0.0), positive()]
}

fn bar() -> impl Strategy<Value = Bar> {
    let part = prop_oneof![Just(-0.0), 0.0..=1.0_f64];
    // Any three of them close.
    (0.5..1.0_f64, not_negative(), part, any::<bool>()).prop_map(|(length, mass, part, plain)| {
        if plain {
            Bar::homogeneous(length, mass).unwrap()
        } else {
            Bar::new(length, mass, part * length, [0.1, part, mass]).unwrap()
        }
    })
}

/// Every number of a chain.
fn bits(chain: &Chain) -> Vec<u64> {
    let anchors = chain.anchors();
    let mut numbers = vec![chain.gravity_m_s2()];
    numbers.extend(anchors.start_m.iter().chain(&anchors.end_m));
    for bar in chain.bars() {
        numbers.extend([bar.length_m(), bar.mass_kg(), bar.centre_m()]);
        numbers.extend(bar.inertia_kg_m2());
    }
    numbers.into_iter().map(f64::to_bits).collect()
}

proptest! {
    #[test]
    fn systems_read_back_bit_for_bit(
        name in any::<String>(),
        gravity in positive(),
        start_m in prop::array::uniform3(-0.5..0.5_f64),
        runs in prop::collection::vec((bar(), 1..5_usize), 3..6),
        end_m in prop::array::uniform3(prop_oneof![Just(-0.0), -0.1..0.1_f64]),
    ) {
        let bars = runs.iter().flat_map(|(bar, count)| vec![*bar; *count]).collect();
        let anchors = Anchors { start_m, end_m };
        let written = Chain::new(name, gravity, anchors, bars).unwrap();
        // Of some all weight is on the anchors.
        prop_assume!(Problem::new(written.clone()).is_ok());
        let text = write_system(&written);
        let read = chain(parse(&text, "written")).unwrap();
        prop_assert_eq!(read.chain().name(), written.name());
        prop_assert_eq!(bits(read.chain()), bits(&written));
        // One table for each run of equal bars: two runs may happen to be equal, never to be split.
        prop_assert!(text.matches("[[bars]]").count() <= runs.len());
    }
}

#[test]
fn a_run_of_equal_bars_is_one_table() {
    let chain = model::cases::get("hundred-bars").unwrap().problem().into_chain();
    assert_eq!(
        write_system(&chain),
        "name = \"hundred bars\"\ngravity_m_s2 = 9.80665\n\n[anchors]\nstart_m = [0.0, 0.0, 0.0]\n\
         end_m = [0.0, 9.5, 1.0]\n\n[[bars]]\nlength_m = 0.1\nmass_kg = 0.05\ncount = 100\n"
    );
}

#[test]
fn every_case_reads_back() {
    for case in model::cases::all() {
        let problem = case.problem();
        let written = problem.chain();
        let read = chain(parse(&write_system(written), case.name)).unwrap();
        let read = read.chain();
        assert_eq!((read.name(), bits(read)), (written.name(), bits(written)), "{}", case.name);
    }
}
