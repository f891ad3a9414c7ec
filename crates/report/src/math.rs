//! LaTeX to MathML, which browsers typeset and screen readers read.

use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};

/// Colours that stand for the marks on their way through the converter: LaTeX knows colours, MathML
/// has classes, and nothing else in the equations has a colour.
const MARKS: [Mark; 3] = [
    Mark {
        command: r"\wrong{",
        through: r"\textcolor{#010101}{",
        style: "color: rgb(1 1 1)",
        class: "wrong",
        plain: r"\underline{",
    },
    Mark {
        command: r"\fixed{",
        through: r"\textcolor{#020202}{",
        style: "color: rgb(2 2 2)",
        class: "fixed",
        plain: r"\underline{",
    },
    Mark {
        command: r"\range{",
        through: r"\textcolor{#030303}{",
        style: "color: rgb(3 3 3)",
        class: "range",
        plain: r"\overline{",
    },
];

/// A mark in LaTeX, in the converter and in the page.
struct Mark {
    command: &'static str,
    through: &'static str,
    style: &'static str,
    class: &'static str,
    /// What stands for it in plain LaTeX.
    plain: &'static str,
}

/// MathML of a displayed formula. What is marked `\wrong` or `\fixed` has that class.
///
/// The text of an unreadable formula stands in an `merror` element.
///
/// ```
/// let mathml = report::math::mathml(r"l \cos\theta = \wrong{l}");
/// assert!(mathml.starts_with("<math") && mathml.contains("class=\"wrong\""));
/// assert!(!mathml.contains("merror"));
/// ```
pub fn mathml(latex: &str) -> String {
    let source = MARKS.iter().fold(latex.to_owned(), |s, m| s.replace(m.command, m.through));
    let text = converted(&source, DisplayMode::Block);
    let marked = MARKS.iter().fold(text, |text, mark| {
        text.replace(&format!("style=\"{}\"", mark.style), &format!("class=\"{}\"", mark.class))
    });
    BRACKETED.iter().fold(marked, |text, (from, to)| text.replace(from, to))
}

/// MathML of plain LaTeX, without marks: a formula of its own, or within a sentence.
///
/// ```
/// let mathml = report::math::plain_mathml(r"\sqrt{l}", false);
/// assert!(mathml.contains("<msqrt>") && mathml.contains("display=\"inline\""));
/// ```
pub fn plain_mathml(latex: &str, displayed: bool) -> String {
    converted(latex, if displayed { DisplayMode::Block } else { DisplayMode::Inline })
}

fn converted(latex: &str, display_mode: DisplayMode) -> String {
    let storage = Storage::new();
    let config = RenderConfig { display_mode, ..RenderConfig::default() };
    let mut text = String::new();
    if push_mathml(&mut text, Parser::new(latex, &storage), config).is_err() {
        // Writing to a String cannot fail; were it to, the page shows so.
        "<merror></merror>".clone_into(&mut text);
    }
    // The converter leaves the sign as it is; browsers read it so, parsers of XML do not.
    text.replace("<mo><</mo>", "<mo>&lt;</mo>")
}

/// Brackets about a matrix stretch only in a font made for mathematics. The style of the page draws
/// them as borders of the matrix instead; the signs stay for those who listen.
const BRACKETED: [(&str, &str); 2] = [
    (
        "<mo stretchy=\"true\">[</mo><mtable class=\"menv-arraylike\">",
        "<mo class=\"fence\" stretchy=\"false\">[</mo><mtable class=\"bracketed\">",
    ),
    (
        "</mtable><mo stretchy=\"true\">]</mo>",
        "</mtable><mo class=\"fence\" stretchy=\"false\">]</mo>",
    ),
];

/// LaTeX that needs no macro of ours: marks become a line under or over.
///
/// ```
/// assert_eq!(report::math::plain_latex(r"a = \wrong{b}"), r"a = \underline{b}");
/// ```
pub fn plain_latex(latex: &str) -> String {
    MARKS.iter().fold(latex.to_owned(), |text, mark| text.replace(mark.command, mark.plain))
}
