//! Colours.

/// Okabe and Ito's colours without black and yellow (too faint for lines), from dark to light, and two
/// of their shades; for more equilibria they begin again.
pub(crate) const REGIONS: [[u8; 3]; 8] = [
    [0x00, 0x72, 0xb2], // blue
    [0xe6, 0x9f, 0x00], // orange
    [0x00, 0x9e, 0x73], // bluish green
    [0xcc, 0x79, 0xa7], // reddish purple
    [0x56, 0xb4, 0xe9], // sky blue
    [0xd5, 0x5e, 0x00], // vermilion
    [0xf0, 0xe4, 0x42], // yellow
    [0x8a, 0x8a, 0x8a], // grey
];

/// What leads nowhere.
pub(crate) const FAILURE: [u8; 3] = [0, 0, 0];

/// The colour as SVG has it.
pub(crate) fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// From light (0) to dark (1), even in grey: between four colours of the ramp cividis (Nuñez, Anderton and
/// Renslow, 2018, doi:10.1371/journal.pone.0199239), reversed.
pub(crate) fn ramp(part: f64) -> [u8; 3] {
    const STOPS: [[f64; 3]; 5] = [
        [253.0, 231.0, 55.0],
        [187.0, 173.0, 108.0],
        [124.0, 123.0, 120.0],
        [64.0, 77.0, 107.0],
        [0.0, 32.0, 76.0],
    ];
    let last = STOPS.len() - 1;
    let at = part.clamp(0.0, 1.0) * last as f64;
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 4")]
    let k = (at as usize).min(last - 1);
    let part = at - k as f64;
    std::array::from_fn(|c| {
        let mixed = STOPS[k][c] * (1.0 - part) + STOPS[k + 1][c] * part;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        let byte = mixed.round() as u8;
        byte
    })
}
