//! Colours: those of Okabe and Ito, regions beyond them, and a ramp.

use crate::look::Colour;

/// Okabe and Ito's blue.
pub const BLUE: Colour = Colour([0x00, 0x72, 0xb2]);
/// Okabe and Ito's orange.
pub const ORANGE: Colour = Colour([0xe6, 0x9f, 0x00]);
/// Okabe and Ito's bluish green.
pub const GREEN: Colour = Colour([0x00, 0x9e, 0x73]);
/// Okabe and Ito's reddish purple.
pub const PURPLE: Colour = Colour([0xcc, 0x79, 0xa7]);
/// Okabe and Ito's sky blue.
pub const SKY_BLUE: Colour = Colour([0x56, 0xb4, 0xe9]);
/// Okabe and Ito's vermilion.
pub const VERMILION: Colour = Colour([0xd5, 0x5e, 0x00]);
/// Okabe and Ito's yellow.
pub const YELLOW: Colour = Colour([0xf0, 0xe4, 0x42]);

/// Okabe and Ito's colours without black, and a grey.
const REGIONS: [Colour; 8] =
    [BLUE, ORANGE, GREEN, PURPLE, SKY_BLUE, VERMILION, YELLOW, Colour::grey(0x8a)];

/// What leads nowhere.
pub const FAILURE: Colour = Colour::BLACK;

/// What leads to an equilibrium without a colour of its own.
pub const OTHER: Colour = Colour::WHITE;

/// Most colours of regions: with the two above, as many as a byte can number.
pub const MOST_REGIONS: usize = 254;

/// Least lightness of a colour in Oklab: darker ones are far from black by their numbers and look
/// like it.
const DARKEST: f64 = 0.3;

/// Levels of red, green and blue that colours are chosen from: about three times [`MOST_REGIONS`]
/// colours.
const LEVELS: [u8; 9] = [0, 32, 64, 96, 128, 160, 192, 224, 255];

/// Different colours, up to [`MOST_REGIONS`]: those of Okabe and Ito as far as they go, then always
/// the one that is farthest from all before it, and from black and white. The first ones do not
/// depend on how many are asked for.
pub fn regions(count: usize) -> Vec<Colour> {
    let mut colours: Vec<Colour> = REGIONS.into_iter().take(count).collect();
    let mut candidates: Vec<(Colour, f64)> = vec![];
    for r in LEVELS {
        for g in LEVELS {
            candidates.extend(LEVELS.map(|b| (Colour([r, g, b]), f64::INFINITY)));
        }
    }
    candidates.retain(|(colour, _)| oklab(*colour)[0] > DARKEST);
    let narrow = |candidates: &mut Vec<(Colour, f64)>, taken: Colour| {
        for (colour, distance) in candidates {
            *distance = distance.min(difference(*colour, taken));
        }
    };
    for taken in REGIONS.into_iter().chain([FAILURE, OTHER]) {
        narrow(&mut candidates, taken);
    }
    while colours.len() < count.min(MOST_REGIONS) {
        let farthest = candidates.iter().max_by(|a, b| a.1.total_cmp(&b.1)).map(|best| best.0);
        let colour = farthest.unwrap_or(OTHER);
        narrow(&mut candidates, colour);
        colours.push(colour);
    }
    colours
}

/// How different two colours look: their squared distance in Oklab.
///
/// # References
///
/// B. Ottosson, "A perceptual color space for image processing" (2020).
fn difference(one: Colour, other: Colour) -> f64 {
    let (one, other) = (oklab(one), oklab(other));
    (0..3).map(|k| (one[k] - other[k]).powi(2)).sum()
}

fn oklab(colour: Colour) -> [f64; 3] {
    const CONES: [[f64; 3]; 3] = [
        [0.412_221_470_8, 0.536_332_536_3, 0.051_445_992_9],
        [0.211_903_498_2, 0.680_699_545_1, 0.107_396_956_6],
        [0.088_302_461_9, 0.281_718_837_6, 0.629_978_700_5],
    ];
    const AXES: [[f64; 3]; 3] = [
        [0.210_454_255_3, 0.793_617_785_0, -0.004_072_046_8],
        [1.977_998_495_1, -2.428_592_205_0, 0.450_593_709_9],
        [0.025_904_037_1, 0.782_771_766_2, -0.808_675_766_0],
    ];
    // The curve of sRGB (IEC 61966-2-1).
    let linear = colour.0.map(|byte| {
        let x = f64::from(byte) / 255.0;
        if x <= 0.040_45 { x / 12.92 } else { ((x + 0.055) / 1.055).powf(2.4) }
    });
    let times = |m: [[f64; 3]; 3], v: [f64; 3]| m.map(|row| (0..3).map(|k| row[k] * v[k]).sum());
    times(AXES, times(CONES, linear).map(f64::cbrt))
}

/// From light (0) to dark (1), even in grey: between four colours of the ramp cividis (Nuñez,
/// Anderton and Renslow, 2018, doi:10.1371/journal.pone.0199239), reversed.
pub fn ramp(part: f64) -> Colour {
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
    Colour(std::array::from_fn(|c| {
        let mixed = STOPS[k][c] * (1.0 - part) + STOPS[k + 1][c] * part;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 255")]
        let byte = mixed.round() as u8;
        byte
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn colours_are_different_and_the_first_stay() {
        let all = regions(1000);
        assert_eq!(all.len(), MOST_REGIONS);
        let mut sorted = all.clone();
        sorted.extend([FAILURE, OTHER]);
        sorted.sort_unstable();
        sorted.dedup();
        assert_eq!(sorted.len(), MOST_REGIONS + 2);
        assert_eq!(regions(30), all[..30]);
        assert_eq!(regions(3), REGIONS[..3]);
        // No two of thirty are nearer than the two blues of Okabe and Ito are, by half.
        let blues = difference(REGIONS[0], REGIONS[4]);
        for (k, one) in all[..30].iter().enumerate() {
            assert!(all[..k].iter().all(|other| difference(*one, *other) > 0.25 * blues), "{k}");
        }
    }

    #[test]
    fn oklab_is_the_published_one() {
        // White and grey have no colour; the lightness of pure red is 0.62796.
        let white = oklab(Colour::WHITE);
        assert!((white[0] - 1.0).abs() < 1e-6 && white[1].abs() < 1e-6 && white[2].abs() < 1e-6);
        assert!((oklab(Colour([255, 0, 0]))[0] - 0.627_96).abs() < 1e-5);
    }
}
