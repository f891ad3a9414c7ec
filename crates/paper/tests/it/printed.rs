//! The file of what is printed.

use paper::printed::Paper;
use toml::Value;
use validate::built_in::{key, parsed, tables, text};

#[test]
fn every_number_has_its_source() {
    let (paper, file) = (Paper::project(), parsed(include_str!("../../data/paper.toml")));
    let mut ids = Vec::new();
    for (claim, keys) in paper.claims.iter().zip(key(&file, "claim", tables)) {
        // A key that is not read is a mistake.
        let read = 5 + usize::from(claim.unit.is_some()) + usize::from(claim.digits.is_some());
        assert_eq!(keys.len(), read, "{}", claim.id);
        assert!(!claim.says.is_empty() && !claim.place.is_empty() && !claim.printed.is_empty());
        if let Some(digits) = claim.digits {
            // The printed number has the digits that the file says it has.
            let decimals = claim.printed.split_once('.').map_or(0, |(_, tail)| tail.len());
            assert_eq!((decimals, claim.value().is_finite()), (digits, true), "{}", claim.id);
            assert!(claim.unit.is_some(), "{}", claim.id);
        }
        ids.push(format!("claim {}", claim.id));
    }
    for keys in key(&file, "reference", tables) {
        let [id, unit, source] = ["id", "unit", "source"].map(|told| key(keys, told, text));
        let value = paper.reference(&id);
        assert!(value.is_finite() && !unit.is_empty() && !source.is_empty(), "{id}");
        assert_eq!(keys.len(), 4, "{id}");
        ids.push(format!("reference {id}"));
    }
    assert_eq!([file.len(), key(&file, "equations", Value::as_table).len()], [3, 3]);
    ids.sort();
    assert!(ids.windows(2).all(|pair| pair[0] != pair[1]), "a name is taken twice");
    assert!(paper.reference("no such number").is_nan());
}

#[test]
fn printed_digits_decide() {
    let paper = Paper::project();
    let energy = paper.claim("ix-energy").unwrap();
    assert!(energy.rounds_to(2.335_469) && energy.rounds_to(2.335_465_1));
    assert!(!energy.rounds_to(2.335_464_9) && !energy.rounds_to(f64::NAN));
}
