//! Signs for the names of symbols.

/// ASCII names of Greek letters, `>=` and the like as the signs themselves.
///
/// ```
/// use report::symbols::signs;
/// assert_eq!(signs("cos(phi_1) != 0, lambda_12"), "cos(φ₁) ≠ 0, λ₁₂");
/// assert_eq!(signs("{u_psi}, alphabet"), "{u_ψ}, alphabet");
/// assert_eq!(signs("pi/2 and (xiii)"), "π/2 and (xiii)");
/// ```
pub fn signs(text: &str) -> String {
    let mut out = String::new();
    let mut word = String::new();
    for c in text.chars().chain(['\0']) {
        if c.is_ascii_alphabetic() {
            word.push(c);
            continue;
        }
        out.push_str(greek(&word).unwrap_or(&word));
        word.clear();
        if c != '\0' {
            out.push(c);
        }
    }
    lowered(&out.replace("!=", "≠"))
}

/// The letter of a name.
fn greek(name: &str) -> Option<&'static str> {
    Some(match name {
        "theta" => "θ",
        "alpha" => "α",
        "beta" => "β",
        "phi" => "φ",
        "psi" => "ψ",
        "omega" => "ω",
        "lambda" => "λ",
        "pi" => "π",
        _ => return None,
    })
}

/// Numbers after `_` as indices, where that is all the index.
fn lowered(text: &str) -> String {
    const DIGITS: [char; 10] = ['₀', '₁', '₂', '₃', '₄', '₅', '₆', '₇', '₈', '₉'];
    let mut pieces = text.split('_');
    let mut out = pieces.next().unwrap_or_default().to_owned();
    for piece in pieces {
        let end = piece.find(|c: char| !c.is_ascii_digit()).unwrap_or(piece.len());
        if end == 0 {
            out.push('_');
        }
        let index = piece[..end].chars().filter_map(|c| c.to_digit(10));
        out.extend(index.filter_map(|digit| DIGITS.get(digit as usize)));
        out.push_str(&piece[end..]);
    }
    out
}
