//! The formulas of the pages that rustdoc writes.
//!
//! rustdoc leaves LaTeX between dollar signs as it stands. Where there is a network a script of the
//! page loads `KaTeX`; what this module makes of the page is MathML, which needs neither.

use crate::math::plain_mathml;

/// What a page's header has to load a typesetter from elsewhere: from the first to the second.
const LOADER: (&str, &str) = ("<link rel=\"stylesheet\" href=\"https://cdn.", "</script>");

/// Elements whose text is no prose.
const VERBATIM: [&str; 5] = ["code", "pre", "script", "style", "textarea"];

/// What cannot be read as LaTeX.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("no formula can be made of {0:?}")]
pub struct Unreadable(pub String);

/// A page with every formula typeset and nothing left that is loaded for that.
///
/// Formulas stand between dollar signs, displayed ones between two of them, within one run of text;
/// a dollar sign without a second one in its run is a dollar sign, and so is every one in code.
///
/// # Errors
/// [`Unreadable`] has the first formula that the converter refuses.
///
/// ```
/// let page = "<p>At rest $V &lt; mgl$, in <code>$HOME</code>.</p>";
/// let typeset = report::formulas::typeset(page)?;
/// assert!(typeset.starts_with("<p>At rest <math") && typeset.contains("<mo>&lt;</mo>"));
/// assert!(typeset.ends_with("</math>, in <code>$HOME</code>.</p>"));
/// # Ok::<(), report::formulas::Unreadable>(())
/// ```
pub fn typeset(page: &str) -> Result<String, Unreadable> {
    let mut rest = page;
    let mut out = String::with_capacity(page.len());
    let mut verbatim: Option<&str> = None;
    while let Some(start) = rest.find('<') {
        let (text, tagged) = rest.split_at(start);
        match verbatim {
            None => prose(text, &mut out)?,
            Some(_) => out.push_str(text),
        }
        let end = tagged.find('>').map_or(tagged.len(), |end| end + 1);
        let (tag, after) = tagged.split_at(end);
        verbatim = match verbatim {
            None => VERBATIM.into_iter().find(|element| opens(tag, element)),
            Some(element) if tag.strip_prefix("</").is_some_and(|t| t.starts_with(element)) => None,
            inside => inside,
        };
        out.push_str(tag);
        rest = after;
    }
    prose(rest, &mut out)?;
    Ok(without_loader(&out))
}

fn opens(tag: &str, element: &str) -> bool {
    let name = tag.strip_prefix('<').and_then(|tag| tag.strip_prefix(element));
    name.is_some_and(|after| after.starts_with([' ', '>']))
}

/// One run of text between two tags.
fn prose(text: &str, out: &mut String) -> Result<(), Unreadable> {
    let mut rest = text;
    while let Some(start) = rest.find('$') {
        let (before, from) = rest.split_at(start);
        let fence = if from.starts_with("$$") { "$$" } else { "$" };
        let inside = &from[fence.len()..];
        let Some(end) = inside.find(fence) else { break };
        out.push_str(before);
        out.push_str(&formula(&inside[..end], fence == "$$")?);
        rest = &inside[end + fence.len()..];
    }
    out.push_str(rest);
    Ok(())
}

fn formula(escaped: &str, displayed: bool) -> Result<String, Unreadable> {
    let latex = escaped
        .replace("&lt;", "<")
        .replace("&gt;", ">")
        .replace("&quot;", "\"")
        .replace("&#39;", "'")
        .replace("&amp;", "&");
    let mathml = plain_mathml(&latex, displayed);
    if mathml.contains("merror") { Err(Unreadable(latex)) } else { Ok(mathml) }
}

fn without_loader(page: &str) -> String {
    let mut page = page.to_owned();
    while let Some(start) = page.find(LOADER.0) {
        // The last of the three scripts is the one in the page that calls the loaded two.
        let Some(end) = page[start..].match_indices(LOADER.1).nth(2) else { break };
        page.replace_range(start..start + end.0 + LOADER.1.len(), "");
    }
    page
}
