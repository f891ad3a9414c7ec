//! What a misspelt key was meant to be.

/// What others call a key.
const OTHER_WORDS: [(&str, &str); 15] = [
    ("ea", "stiffness_n"),
    ("ea_n", "stiffness_n"),
    ("e", "young_pa"),
    ("e_pa", "young_pa"),
    ("weight_n", "mass_kg"),
    ("load_n", "force_n"),
    ("rope", "cable"),
    ("start", "from"),
    ("end", "to"),
    ("nodes", "joints"),
    ("cables", "bars"),
    ("struts", "bars"),
    ("ropes", "bars"),
    ("members", "bars"),
    ("elements", "bars"),
];

/// The allowed key most like this one, if it is like one at all: a slip of a few letters, another
/// case, the same first word (`mass` for `mass_kg`, `length_cm` for `length_m`), or what others call it.
///
/// ```
/// use model::system_file::nearest;
/// let keys = ["length_m", "mass_kg", "centre_m"];
/// assert_eq!(nearest("lenght_m", &keys), Some("length_m"));
/// assert_eq!(nearest("mass", &keys), Some("mass_kg"));
/// assert_eq!(nearest("weight_n", &keys), Some("mass_kg"));
/// assert_eq!(nearest("colour", &keys), None);
/// ```
pub fn nearest<'a>(key: &str, allowed: &[&'a str]) -> Option<&'a str> {
    let key = key.to_lowercase();
    let meant = OTHER_WORDS.iter().find(|(word, _)| *word == key).map(|(_, name)| *name);
    if let Some(name) = allowed.iter().find(|name| meant == Some(**name)) {
        return Some(name);
    }
    let alike = |name: &str, distance: usize| {
        // A third of the letters wrong is still a slip; more is another word.
        3 * distance <= key.chars().count().max(name.chars().count())
            || first_word(&key) == first_word(name)
    };
    allowed
        .iter()
        .map(|&name| (strsim::levenshtein(&key, &name.to_lowercase()), name))
        .filter(|&(distance, name)| alike(name, distance))
        .min()
        .map(|(_, name)| name)
}

fn first_word(key: &str) -> &str {
    key.split(['_', '-', ' ', '.']).next().unwrap_or(key)
}
