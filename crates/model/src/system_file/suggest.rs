//! What a misspelt key was meant to be.

/// The allowed key most like this one, if it is like one at all: a slip of a few letters, another
/// case, or the same first word (`mass` for `mass_kg`, `length_cm` for `length_m`).
///
/// ```
/// use model::system_file::nearest;
/// let keys = ["length_m", "mass_kg", "centre_m"];
/// assert_eq!(nearest("lenght_m", &keys), Some("length_m"));
/// assert_eq!(nearest("mass", &keys), Some("mass_kg"));
/// assert_eq!(nearest("colour", &keys), None);
/// ```
#[must_use]
pub fn nearest<'a>(key: &str, allowed: &[&'a str]) -> Option<&'a str> {
    let key = key.to_lowercase();
    let alike = |name: &str, distance: usize| {
        // A third of the letters wrong is still a slip; more is another word.
        3 * distance <= key.chars().count().max(name.len()) || first_word(&key) == first_word(name)
    };
    allowed
        .iter()
        .map(|&name| (strsim::levenshtein(&key, name), name))
        .filter(|&(distance, name)| alike(name, distance))
        .min()
        .map(|(_, name)| name)
}

fn first_word(key: &str) -> &str {
    key.split(['_', '-', ' ', '.']).next().unwrap_or(key)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_are_recognised_and_other_words_are_not() {
        const BAR: &[&str] = &["length_m", "mass_kg", "centre_m", "inertia_kg_m2", "count"];
        for (slip, meant) in [
            ("lenght_m", "length_m"),
            ("Length_M", "length_m"),
            ("LENGTH_MM", "length_m"),
            ("mass", "mass_kg"),
            ("mass-kg", "mass_kg"),
            ("mass_g", "mass_kg"),
            ("center_m", "centre_m"),
            ("inertia", "inertia_kg_m2"),
            ("counts", "count"),
        ] {
            assert_eq!(nearest(slip, BAR), Some(meant), "{slip}");
        }
        for other in ["colour", "weight_n", "", "\u{e4}", "radius_m2"] {
            assert_eq!(nearest(other, BAR), None, "{other}");
        }
    }
}
