//! Inputs that are nearly right, by chance.

use sweep::Stream;

/// Reproducible random numbers.
pub struct Random {
    stream: Stream,
    next: u64,
}

impl Random {
    pub fn new(seed: u64) -> Self {
        Self { stream: Stream::new(seed), next: 0 }
    }

    /// 0 to `most` - 1; 0 for none.
    pub fn below(&mut self, most: usize) -> usize {
        self.next += 1;
        let bits = self.stream.at(self.next) % (most.max(1) as u64);
        usize::try_from(bits).unwrap()
    }

    pub fn pick<'a, T: ?Sized>(&mut self, among: &[&'a T]) -> &'a T {
        among[self.below(among.len())]
    }
}

/// Pieces that mean something somewhere: numbers at the ends of ranges, brackets, quotes, text that
/// steers terminals, and bytes that are no text.
pub const PIECES: &[&[u8]] = &[
    b"0", b"-1", b"1e308", b"-1e-320", b"1e400", b"nan", b"-inf", b"0.1e", b"0x10", b"20000001",
    b"18446744073709551616", b"[", b"]", b"[[", b"{", b"}", b"\"", b"'''", b"\"\"\"",
    b"\\u001b[2J", b"\x1b]0;X\x07", b"\xe2\x80\xae", b"\xff\xfe", b"\xc3", b"\0", b"\n", b"\r\n",
    b",", b"=", b".", b"#", b"null", b"true", b"count = 3\n", b"[[bars]]\n", b"[joints]\n",
    b"mass_kg = 1\n", b"length_m", b"/dev/null", b"--json", b"..", b"%s%n",
];

/// One to eight changes of an example: of single bytes, of runs of bytes, of lines and numbers.
pub fn mutated(random: &mut Random, example: &[u8], others: &[&[u8]]) -> Vec<u8> {
    let mut bytes = example.to_vec();
    for _ in 0..=random.below(8) {
        let at = random.below(bytes.len() + 1);
        let longest = 1 << random.below(8);
        let length = 1 + random.below(longest);
        let end = bytes.len().min(at + length);
        match random.below(9) {
            0 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
            1 => drop(bytes.drain(at..end)),
            2 => {
                let again = bytes[at..end].to_vec();
                bytes.splice(at..at, again);
            }
            3 => bytes.truncate(at),
            4 => drop(bytes.splice(at..end, random.pick(PIECES).iter().copied())),
            5 => drop(bytes.splice(at..at, random.pick(PIECES).iter().copied())),
            6 => {
                let other = random.pick(others);
                let from = random.below(other.len() + 1);
                let to = other.len().min(from + length);
                drop(bytes.splice(at..at, other[from..to].iter().copied()));
            }
            7 => number(random, &mut bytes),
            _ => lines(random, &mut bytes),
        }
    }
    bytes
}

/// Another number in the place of one.
fn number(random: &mut Random, bytes: &mut Vec<u8>) {
    let digits: Vec<usize> = (0..bytes.len()).filter(|k| bytes[*k].is_ascii_digit()).collect();
    if digits.is_empty() {
        return;
    }
    let at = digits[random.below(digits.len())];
    let end = (at..bytes.len()).find(|k| !bytes[*k].is_ascii_digit()).unwrap_or(bytes.len());
    let numbers: [&[u8]; 8] =
        [b"0", b"-0.0", b"1e-300", b"1e300", b"7", b"4294967296", b"9223372036854775807", b"1e17"];
    drop(bytes.splice(at..end, random.pick(&numbers).iter().copied()));
}

/// A line removed, doubled, or moved to another place.
fn lines(random: &mut Random, bytes: &mut Vec<u8>) {
    let mut lines: Vec<Vec<u8>> =
        bytes.split_inclusive(|b| *b == b'\n').map(<[u8]>::to_vec).collect();
    if lines.is_empty() {
        return;
    }
    let line = lines.remove(random.below(lines.len()));
    for _ in 0..random.below(3) {
        let at = random.below(lines.len() + 1);
        lines.insert(at, line.clone());
    }
    *bytes = lines.concat();
}
