//! Numbers as text, the same on every machine.
//!
//! What differs from processor to processor is the rounding of sines and cosines, a few units of the last
//! place. Numbers of that size are therefore printed as a bound, and all others with no more digits
//! than are stable.

/// Bounds for what is only rounding, largest first: text and value. A number is printed as the
/// smallest of them that it stays below.
const BOUNDS: [(f64, &str); 3] =
    [(1e-6, "<\u{a0}10⁻⁶"), (1e-9, "<\u{a0}10⁻⁹"), (1e-12, "<\u{a0}10⁻¹²")];

/// `digits` significant digits in plain notation, or a bound where the number is rounding.
///
/// ```
/// use report::numbers::measured;
/// assert_eq!(measured(0.522_916_3, 4), "0.5229");
/// assert_eq!(measured(-13.0, 4), "-13");
/// assert_eq!(measured(-3.816e-6, 3), "-3.82×10⁻⁶");
/// assert_eq!(measured(4.1e-13, 4), "<\u{a0}10⁻¹²");
/// assert_eq!(measured(0.0, 4), "<\u{a0}10⁻¹²");
/// assert_eq!(measured(f64::NAN, 4), "not a number");
/// ```
#[must_use]
pub fn measured(x: f64, digits: usize) -> String {
    if !x.is_finite() {
        return "not a number".to_owned();
    }
    match BOUNDS.iter().rfind(|(bound, _)| x.abs() < *bound) {
        Some((_, text)) => (*text).to_owned(),
        None if x.abs() < SMALL => powered(x, digits),
        None => significant(x, digits),
    }
}

/// [`measured`] within a sentence.
///
/// ```
/// assert_eq!(report::numbers::in_words(1e-15, 2), "less than 10⁻¹²");
/// ```
#[must_use]
pub fn in_words(x: f64, digits: usize) -> String {
    measured(x, digits).replace("<\u{a0}", "less than ")
}

/// Below this zeros would hide the digits.
const SMALL: f64 = 1e-3;

/// Digits and a power of ten.
fn powered(x: f64, digits: usize) -> String {
    let text = format!("{x:.*e}", digits.saturating_sub(1));
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let raised = exponent.chars().filter_map(|c| match c {
        '-' => Some('⁻'),
        digit => RAISED.get(digit.to_digit(10)? as usize).copied(),
    });
    format!("{digits}×10{}", raised.collect::<String>())
}

/// Digits as exponents.
const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];

/// A number that counts something: an integer, and a bound where it is none.
///
/// ```
/// assert_eq!(report::numbers::counted(12.0), "12");
/// assert_eq!(report::numbers::counted(0.0), "0");
/// assert_eq!(report::numbers::counted(0.25), "0.25");
/// ```
#[must_use]
pub fn counted(x: f64) -> String {
    if x.fract().abs() > 0.0 { measured(x, 4) } else { fixed(x, 0) }
}

/// A fixed number of decimals, never a negative zero.
///
/// ```
/// assert_eq!(report::numbers::fixed(-1e-17, 3), "0.000");
/// assert_eq!(report::numbers::fixed(-0.6489, 3), "-0.649");
/// ```
#[must_use]
pub fn fixed(x: f64, decimals: usize) -> String {
    let text = format!("{x:.decimals$}");
    match text.strip_prefix('-') {
        Some(positive) if positive.bytes().all(|b| matches!(b, b'0' | b'.')) => positive.to_owned(),
        _ => text,
    }
}

/// `digits` significant digits without trailing zeros.
fn significant(x: f64, digits: usize) -> String {
    let exponent = x.abs().log10().floor();
    // A double has exponents of three digits at most, and `digits` is small.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "small and not negative"
    )]
    let decimals = (digits as f64 - 1.0 - exponent).max(0.0) as usize;
    let text = fixed(x, decimals);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// ASCII names of Greek letters, `>=` and the like as the signs themselves.
///
/// ```
/// use report::numbers::signs;
/// assert_eq!(signs("cos(phi_1) != 0, lambda_12"), "cos(φ₁) ≠ 0, λ₁₂");
/// assert_eq!(signs("{u_psi}, alphabet"), "{u_ψ}, alphabet");
/// assert_eq!(signs("pi/2 and (xiii)"), "π/2 and (xiii)");
/// ```
#[must_use]
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

/// Text with the numbers in it that are only rounding (`3.1e-16`) replaced by their bounds.
///
/// ```
/// use report::numbers::stable;
/// assert_eq!(stable("agree to 2e-16 rad"), "agree to <\u{a0}10⁻¹² rad");
/// assert_eq!(stable("(residual 3.5e-13)."), "(residual <\u{a0}10⁻¹²).");
/// assert_eq!(stable("to 1e-3 mg"), "to 0.001 mg");
/// ```
#[must_use]
pub fn stable(text: &str) -> String {
    let words = text.split(' ').map(|word| {
        let core = word.trim_matches(|c: char| !c.is_ascii_alphanumeric() && c != '-');
        match core.parse::<f64>() {
            Ok(value) if core.contains('e') => word.replace(core, &measured(value, 4)),
            _ => word.to_owned(),
        }
    });
    words.collect::<Vec<_>>().join(" ")
}
