//! What a misspelt key was meant to be.

use model::system_file::nearest;

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
        // What others call it.
        ("weight_n", "mass_kg"),
    ] {
        assert_eq!(nearest(slip, BAR), Some(meant), "{slip}");
    }
    assert_eq!(nearest("EA", &["length_m", "stiffness_n"]), Some("stiffness_n"));
    assert_eq!(nearest("p", &["A", "P"]), Some("P"));
    assert_eq!(nearest("A", &["\u{65e5}\u{672c}"]), None);
    for other in ["colour", "width_n", "", "\u{e4}", "radius_m2"] {
        assert_eq!(nearest(other, BAR), None, "{other}");
    }
}
