//! Formulas of the pages of the documentation, typeset to be read offline.

use report::formulas::{Unreadable, typeset};

#[test]
fn formulas_are_typeset_and_code_is_kept() {
    let page = "<p>$$a &lt; b$$ or $x$</p><pre class=\"rust\">let $x = <span>$y</span>;</pre>";
    let made = typeset(page).unwrap();
    assert_eq!(made.matches("<math").count(), 2);
    assert!(made.contains("display=\"block\"") && made.contains("display=\"inline\""));
    assert!(made.ends_with("<pre class=\"rust\">let $x = <span>$y</span>;</pre>"));
}

#[test]
fn a_price_is_no_formula() {
    assert_eq!(typeset("<p>5 $ or so</p>").unwrap(), "<p>5 $ or so</p>");
}

#[test]
fn what_no_formula_is_is_told() {
    assert_eq!(typeset(r"<p>$\nosuch{x}$</p>"), Err(Unreadable(r"\nosuch{x}".into())));
}

#[test]
fn what_loads_a_typesetter_is_taken_out() {
    let header = "<link rel=\"stylesheet\" href=\"https://cdn.example/katex.css\">\n\
        <script defer src=\"https://cdn.example/katex.js\"></script>\n\
        <script defer src=\"https://cdn.example/auto-render.js\"></script>\n\
        <script>\nrenderMathInElement(document.body);\n</script>";
    let page = format!("<head>{header}</head><body><script>kept()</script></body>");
    assert_eq!(typeset(&page).unwrap(), "<head></head><body><script>kept()</script></body>");
}
