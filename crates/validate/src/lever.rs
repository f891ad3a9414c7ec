//! The lever rule for bars, as the judge uses it: that of [`numerics::lever`].
//!
//! A bar's weight is linear in the places of its two ends, so a bar weighs on its joints as two
//! point masses do: with the centre of weight at the distance `r` from its first end, `(1 − r/l) m`
//! there and `(r/l) m` at its second end.

use model::{Bar, Chain};
use numerics::lever;

/// Where the centre of weight is, as a part of the length from the first end: `r/l`.
///
/// ```
/// use validate::lever;
/// let bar = model::Bar::new(2.0, 8.0, 0.5, [0.0; 3])?;
/// assert_eq!(lever::centre_part(&bar), 0.25);
/// assert_eq!([lever::near_kg(&bar), lever::far_kg(&bar)], [6.0, 2.0]);
/// # Ok::<(), model::BarError>(())
/// ```
pub fn centre_part(bar: &Bar) -> f64 {
    shares(bar)[1]
}

/// What of its mass the first end of a bar carries, kg; exactly none where the centre of weight is
/// at the second.
pub fn near_kg(bar: &Bar) -> f64 {
    bar.mass_kg() * shares(bar)[0]
}

/// What of its mass the second end of a bar carries, kg.
pub fn far_kg(bar: &Bar) -> f64 {
    bar.mass_kg() * centre_part(bar)
}

fn shares(bar: &Bar) -> [f64; 2] {
    lever(bar.length_m(), bar.centre_m())
}

/// The mass that each joint between the anchors carries, kg.
///
/// ```
/// use model::{Anchors, Bar, Chain};
/// let anchors = Anchors { start_m: [0.0; 3], end_m: [3.0, 0.0, 0.0] };
/// // 2 kg of the first bar fall on its second joint, 6 kg of the second bar on its first.
/// let chain = Chain::new("two bars", 9.81, anchors, vec![Bar::new(2.0, 8.0, 0.5, [0.0; 3])?; 2])?;
/// assert_eq!(validate::lever::carried_kg(&chain).collect::<Vec<_>>(), [8.0]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn carried_kg(chain: &Chain) -> impl Iterator<Item = f64> + '_ {
    chain.bars().windows(2).map(|pair| far_kg(&pair[0]) + near_kg(&pair[1]))
}
