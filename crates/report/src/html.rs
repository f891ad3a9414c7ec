//! The report as one page that needs nothing else.

use std::fmt::Write as _;

use figures::Escaped;
use paper::equations::Validity;

use crate::badge::{Badge, Tone};
use crate::block::{self, Block, Table, residual};
use crate::cell::Cell;
use crate::equations::Judged;
use crate::figures::Figure;
use crate::math::mathml;
use crate::symbols::signs;

/// The style of the page.
const STYLE: &str = include_str!("style.css");

/// The page: a head, a table of contents, the blocks, and a foot.
pub fn page(title: &str, blocks: &[Block], run: &[Block]) -> String {
    let mut body = String::new();
    let mut open = false;
    for block in blocks {
        // Each chapter is a region of its own.
        if let Block::Heading(2, id, _) = block {
            if open {
                body.push_str("</section>\n");
            }
            let _ = writeln!(body, "<section aria-labelledby=\"{id}\">");
            open = true;
        }
        body.push_str(&html(block));
    }
    if open {
        body.push_str("</section>\n");
    }
    let run: String = run.iter().map(html).collect();
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{}</title>\n<link rel=\"icon\" href=\"data:,\">\n<style>\n{STYLE}</style>\n</head>\n<body>\n\
         <a class=\"skip\" href=\"#content\">Skip to the content</a>\n\
         {}<main id=\"content\">\n{body}</main>\n\
         <footer class=\"run\" aria-label=\"This run\">\n{run}</footer>\n</body>\n</html>\n",
        Escaped(title),
        contents(blocks),
    )
}

/// The chapters and their parts, to jump to.
fn contents(blocks: &[Block]) -> String {
    let mut items = String::new();
    for block in blocks {
        if let Block::Heading(level @ 2..=3, id, text) = block {
            let class = if *level == 3 { " class=\"part\"" } else { "" };
            let _ = writeln!(items, "<li{class}><a href=\"#{id}\">{}</a></li>", inline(text));
        }
    }
    items.push_str("<li><a href=\"#this-run\">This run</a></li>\n");
    format!("<nav aria-label=\"Contents\">\n<ol>\n{items}</ol>\n</nav>\n")
}

fn html(block: &Block) -> String {
    match block {
        Block::Heading(level, id, text) => {
            format!("<h{level} id=\"{id}\">{}</h{level}>\n", inline(text))
        }
        Block::Text(text) => format!("<p>{}</p>\n", inline(text)),
        Block::List(items) => {
            let items: Vec<_> = items.iter().map(|item| inline(item)).collect();
            format!("<ul>\n<li>{}</li>\n</ul>\n", items.join("</li>\n<li>"))
        }
        Block::Table(table) => rows(table),
        Block::Equation(judged) => equation(judged),
        Block::Statements(audit) => rows(&block::statements(audit)),
        Block::Figure(figure) => drawn(figure, "plate"),
        Block::Sheet(figure) => drawn(figure, "sheet"),
        Block::Slot { html, .. } => html.clone(),
        Block::Code(_, text) => {
            format!("<pre tabindex=\"0\"><code>{}</code></pre>\n", Escaped(text.trim_end()))
        }
    }
}

fn drawn(figure: &Figure, class: &str) -> String {
    format!(
        "<figure class=\"{class}\" id=\"{}\">\n<div class=\"panels\">\n{}</div>\n<figcaption>{}</figcaption>\n</figure>\n",
        figure.id,
        figure.panels.concat(),
        inline(&figure.caption)
    )
}

/// Cells with more characters get room for a few words in a line.
const LONG: usize = 32;

/// A table in a box that scrolls on its own, so that the page does not.
///
/// Where there is no room for columns, one with verdicts becomes a list of rows with the verdict on
/// top, so that none is out of sight. Its parts say what they are, since browsers take no table for
/// one that is laid out otherwise.
fn rows(table: &Table) -> String {
    let mut text = String::new();
    let label =
        if table.caption.is_empty() { table.head.join(", ") } else { table.caption.clone() };
    let judged = table.rows.iter().flatten().any(|cell| matches!(cell, Cell::Badge(_)));
    // Writing to a String cannot fail.
    let _ = write!(
        text,
        "<div class=\"scroll\" role=\"region\" tabindex=\"0\" aria-label=\"{}\">\n<table{}>\n",
        Escaped(&label),
        if judged { " class=\"judged\" role=\"table\"" } else { "" }
    );
    if !table.caption.is_empty() {
        let _ = writeln!(text, "<caption><span>{}</span></caption>", inline(&table.caption));
    }
    // A column of numbers alone stands right; one with words among them stands left, all of it.
    let numeric: Vec<bool> = (0..table.head.len())
        .map(|k| k > 0 && table.rows.iter().all(|row| row.get(k).is_some_and(Cell::is_number)))
        .collect();
    let role = |name: &str| if judged { format!(" role=\"{name}\"") } else { String::new() };
    let _ = write!(text, "<thead{}><tr{}>", role("rowgroup"), role("row"));
    for (name, &number) in table.head.iter().zip(&numeric) {
        let class = if number { " class=\"number\"" } else { "" };
        let _ =
            write!(text, "<th scope=\"col\"{class}{}>{}</th>", role("columnheader"), inline(name));
    }
    let _ = write!(text, "</tr></thead>\n<tbody{}>\n", role("rowgroup"));
    for row in &table.rows {
        let _ = write!(text, "<tr{}>", role("row"));
        for (k, (cell, name)) in row.iter().zip(&table.head).enumerate() {
            let plain = cell.text();
            let content = if let Cell::Badge(badge) = cell { shown(badge) } else { inline(&plain) };
            let class = match cell {
                Cell::Badge(_) => " class=\"verdicts\"",
                _ if numeric.get(k) == Some(&true) => " class=\"number\"",
                _ if plain.chars().count() > LONG => " class=\"long\"",
                _ => "",
            };
            let column =
                if judged { format!(" data-column=\"{}\"", Escaped(name)) } else { String::new() };
            let _ = if k == 0 {
                write!(text, "<th scope=\"row\"{class}{}>{content}</th>", role("rowheader"))
            } else {
                write!(text, "<td{class}{}{column}>{content}</td>", role("cell"))
            };
        }
        text.push_str("</tr>\n");
    }
    text.push_str("</tbody>\n</table>\n</div>\n");
    text
}

/// A verdict with a sign for those who see no colour.
fn shown(badge: &Badge) -> String {
    let class = match badge.tone {
        Tone::Good => "good",
        Tone::Mended => "mended",
        Tone::Neutral | Tone::Given => "neutral",
        Tone::Bad => "bad",
    };
    format!(
        "<span class=\"verdict {class}\"><span aria-hidden=\"true\">{}</span> {}</span>",
        badge.sign(),
        inline(&badge.word)
    )
}

fn equation(judged: &Judged) -> String {
    let Judged { equation, section, rows: audit, .. } = judged;
    let name = equation.number.trim_matches(['(', ')']);
    let mut text = format!(
        "<article class=\"equation\" aria-labelledby=\"eq-{name}\">\n<h3 id=\"eq-{name}\">{} {}</h3>\n\
         <p>{} <span class=\"where\">Section {section}.</span></p>\n",
        equation.number,
        shown(&judged.badge()),
        inline(equation.says)
    );
    let formula = |label: &str, latex: &str| {
        format!(
            "<div class=\"formula\"><p class=\"which\">{label}</p><div class=\"scroll\" role=\"region\" tabindex=\"0\" \
             aria-label=\"Equation {} {}\">{}</div></div>\n",
            equation.number,
            label.to_lowercase(),
            mathml(latex)
        )
    };
    text.push_str(&formula("As printed", equation.printed));
    if let Some(corrected) = equation.corrected {
        text.push_str(&formula(judged.instead(), corrected));
    }
    text.push_str("<ul class=\"numbers\">\n");
    for row in audit {
        // What the only part of an equation that holds says, the equation says.
        let part = if audit.len() > 1 || row.verdict != Validity::Holds {
            format!("{}. ", signs(row.what))
        } else {
            String::new()
        };
        let number = |value| inline(&Cell::number(residual(row, value)).text());
        let _ = write!(
            text,
            "<li>{}<span class=\"measure\">{}:</span> <strong>{}</strong>",
            inline(&part),
            inline(&capital(&signs(row.measure))),
            number(row.as_printed)
        );
        if let Some(value) = row.as_corrected {
            let _ = write!(
                text,
                " as printed, <strong>{}</strong> {}",
                number(value),
                judged.instead().to_lowercase()
            );
        }
        if audit.len() > 1 {
            let _ = write!(text, " {}", shown(&Badge::of_row(row)));
        }
        text.push_str("</li>\n");
    }
    text.push_str("</ul>\n</article>\n");
    text
}

fn capital(text: &str) -> String {
    let mut chars = text.chars();
    chars.next().map_or_else(String::new, |first| first.to_uppercase().chain(chars).collect())
}

/// A text with its few marks: `code`, **strong**, [text](#anchor), `J_x`, `s^2`.
fn inline(text: &str) -> String {
    let pieces = Escaped(text).to_string();
    // Names in code keep their underscores.
    let pieces = pieces.split('`').enumerate();
    let text: Vec<_> = pieces
        .map(|(k, piece)| if k % 2 == 0 { scripts(piece) } else { piece.to_owned() })
        .collect();
    let strong = pairs(&text.join("`"), "**", "strong");
    let code = pairs(&strong, "`", "code");
    links(&code)
}

/// `J_x`, `b_{1,5}` and `[Q]^T` lowered and raised: an index after a letter that stands by itself,
/// a power after anything.
fn scripts(text: &str) -> String {
    /// Longest index or power without braces: `Ci`, `12`.
    const LONGEST: usize = 2;
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(['_', '^']) {
        let (before, mark, after) = (&rest[..at], &rest[at..=at], &rest[at + 1..]);
        let lowered = mark == "_";
        let alone = {
            let mut back = before.chars().rev();
            back.next().is_some_and(char::is_alphabetic)
                && !back.next().is_some_and(char::is_alphanumeric)
        };
        let braced = after.strip_prefix('{').and_then(|inner| inner.split_once('}'));
        let bare = after.find(|c: char| !c.is_alphanumeric()).unwrap_or(after.len());
        let script = braced.or_else(|| {
            let fits = bare > 0 && after[..bare].chars().count() <= LONGEST;
            fits.then(|| after.split_at(bare))
        });
        out.push_str(before);
        match script {
            Some((script, tail)) if !lowered || alone => {
                let element = if lowered { "sub" } else { "sup" };
                let _ = write!(out, "<{element}>{script}</{element}>");
                rest = tail;
            }
            _ => {
                out.push_str(mark);
                rest = after;
            }
        }
    }
    out + rest
}

/// What stands between two marks becomes an element; an odd mark stays.
fn pairs(text: &str, mark: &str, element: &str) -> String {
    let pieces: Vec<&str> = text.split(mark).collect();
    let mut out = String::new();
    for (k, piece) in pieces.iter().enumerate() {
        match (k % 2, k + 1 == pieces.len()) {
            (0, _) => out.push_str(piece),
            (_, true) => {
                out.push_str(mark);
                out.push_str(piece);
            }
            _ => {
                let _ = write!(out, "<{element}>{piece}</{element}>");
            }
        }
    }
    out
}

fn links(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once("](#") {
        let (Some((ahead, label)), Some((anchor, tail))) =
            (before.rsplit_once('['), after.split_once(')'))
        else {
            break;
        };
        let _ = write!(out, "{ahead}<a href=\"#{anchor}\">{label}</a>");
        rest = tail;
    }
    out + rest
}
