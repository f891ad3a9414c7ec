//! The named cases and systems.

use model::cases::{all, exhibits, get, paper};

#[test]
fn every_case_is_a_problem_with_a_name_of_its_own() {
    for (k, case) in all().iter().enumerate() {
        let _ = case.problem();
        assert!(case.name.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{}", case.name);
        assert!(all()[..k].iter().all(|other| other.name != case.name), "{}", case.name);
        assert!(case.text.starts_with("# "), "{} does not say what it exercises", case.name);
    }
    assert_eq!(paper().chain().name(), "three equal bars");
}

#[test]
fn every_system_can_be_asked_about_and_has_a_name_of_its_own() {
    for (k, exhibit) in exhibits().enumerate() {
        assert!(exhibit.system().refusal().is_ok());
        let name = exhibit.name;
        assert!(name.chars().all(|c| c.is_ascii_lowercase() || c == '-'), "{name}");
        assert!(exhibits().take(k).all(|other| other.name != name), "{name}");
        assert!(get(name).is_none(), "{name}");
        assert!(exhibit.text.starts_with("# ") && exhibit.text.contains("# Reference:"), "{name}");
    }
}
