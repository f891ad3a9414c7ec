use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;

/// Stream `number` of the random numbers of a test, which is told from others by its `seed`.
///
/// ```
/// use rand::RngExt;
/// let draw = |number| samples::stream(1, number).random_range(0.0..1.0_f64);
/// assert_eq!(draw(5).to_bits(), draw(5).to_bits());
/// assert_ne!(draw(5).to_bits(), draw(6).to_bits());
/// ```
pub fn stream(seed: u64, number: u64) -> ChaCha8Rng {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(number);
    random
}
