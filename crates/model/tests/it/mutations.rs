//! Ten thousand random changes to good files: no panic, and every error can be shown.

use model::system_file::{SystemFileError, parse, read};

use crate::support::Folder;

/// A small generator (splitmix64): the mutations are the same on every machine.
struct Random(u64);

impl Random {
    fn below(&mut self, bound: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((z ^ (z >> 31)) % bound as u64).unwrap()
    }

    /// One to four changes: flips, deletions, insertions, truncations, repetitions.
    fn mutate(&mut self, original: &[u8], near: &[u8]) -> Vec<u8> {
        let mut bytes = original.to_vec();
        for _ in 0..=self.below(4) {
            let place = self.below(bytes.len().max(1));
            let byte = u8::try_from(self.below(256)).unwrap();
            match self.below(6) {
                0 => bytes.truncate(place),
                1 if !bytes.is_empty() => drop(bytes.remove(place)),
                2 => bytes.insert(place, byte),
                // Mutations that stay close to the format find more than noise.
                3 => bytes.insert(place, near[self.below(near.len())]),
                4 => {
                    let end = place + self.below(bytes.len() - place + 1);
                    let part = bytes[place..end].to_vec();
                    bytes.extend(part);
                }
                _ if !bytes.is_empty() => bytes[place] = byte,
                _ => {}
            }
        }
        bytes
    }
}

/// The message, the place and the help must work for every error.
fn show(error: &SystemFileError) {
    let shown = format!("{error} {:?} {:?}", error.line(), error.help());
    assert!(shown.contains("mutated"));
    if let Some(span) = error.span() {
        let marked = error.text().get(span.clone());
        assert!(marked.is_some(), "{span:?} is outside the text or within a character");
        assert!(error.position().is_some());
    }
}

fn mutate_and_read<T>(
    original: &str,
    near: &[u8],
    read: impl Fn(&str) -> Result<T, SystemFileError>,
) {
    let mut random = Random(1);
    let (mut good, mut bad) = (0, 0);
    for _ in 0..10_000 {
        let bytes = random.mutate(original.as_bytes(), near);
        match read(&String::from_utf8_lossy(&bytes)) {
            Ok(_) => good += 1,
            Err(error) => {
                bad += 1;
                show(&error);
            }
        }
    }
    assert!(good > 100 && bad > 1000, "the mutations test nothing: {good} good, {bad} bad");
}

#[test]
fn ten_thousand_mutations_of_a_system_file_never_panic() {
    let original = model::cases::get("three-bars-off-centre").unwrap().text;
    mutate_and_read(original, b"0123456789.-+eE[]{}=_#\"'\n,", |text| parse(text, "mutated"));
}

#[test]
fn ten_thousand_mutations_of_a_bars_file_never_panic() {
    let original = "length_m,mass_kg,centre_m\n1.0,2.5e-1,0.25\n0.5, 3,\n1.5,0,0.75\n";
    let folder = Folder::new("mutated");
    let anchors = "{ start_m = [0, 0, 0], end_m = [2, 0, 0] }";
    let chain = format!("bars_file = \"mutated.csv\"\nanchors = {anchors}");
    let chain = folder.file("chain.toml", chain);
    mutate_and_read(original, b"0123456789.-+eE,\"\r\n \t;", |text| {
        folder.file("mutated.csv", text);
        read(&chain)
    });
    folder.done();
}

const NETWORK: &str = "[joints]\nA = { at_m = [0, 0, 0] }\nB = { at_m = [2, 0, 0], free = \"xy\" }\n\
P = { mass_kg = 5 }\n[[bars]]\nfrom = \"A\"\nto = \"P\"\nlength_m = 0.5\nmass_kg = 1\ncount = 3\n\
[[bars]]\nfrom = \"P\"\nto = \"B\"\nlength_m = 1\nmass_kg = 0.5\nforces = [{ force_n = [0, 1, 0] }]\n";

#[test]
fn ten_thousand_mutations_of_a_network_never_panic() {
    mutate_and_read(NETWORK, b"0123456789.-+eE[]{}=_#\"'\n,ABP", |text| parse(text, "mutated"));
}

#[test]
fn ten_thousand_mutations_of_json_never_panic() {
    let json = "{\"name\": \"\\u00e4\\/\", \"joints\": {\"A\": {\"at_m\": [0, 0, 0]}, \"P\": {\"mass_kg\": \
                5}},\n \"bars\": [{\"from\": \"A\", \"to\": \"P\", \"length_m\": 0.5, \"mass_kg\": 1}]}";
    // Half of the mutants are noise; a few still describe a system.
    mutate_and_read(json, b"0123456789.-+eE[]{}:\\\"u\n, ", |text| parse(text, "mutated"));
}
