//! The report as Markdown.

use std::fmt::Write as _;

use crate::block::{Block, Table, audit_cells};
use crate::equations::{Judged, verdict_word};
use crate::math::plain_latex;

/// All blocks, one after the other.
#[must_use]
pub fn markdown(blocks: &[Block]) -> String {
    blocks.iter().map(block).collect::<Vec<_>>().join("\n")
}

fn block(block: &Block) -> String {
    match block {
        Block::Heading(level, _, text) => format!("{} {text}\n", "#".repeat(usize::from(*level))),
        Block::Text(text) => format!("{text}\n"),
        Block::List(items) => format!("- {}\n", items.join("\n- ")),
        Block::Table(table) => rows(table),
        Block::Equation(judged) => equation(judged),
        Block::Statements(audit) => rows(&Table {
            head: vec![
                "where",
                "what it says, or what is wrong",
                "measured",
                "as printed",
                "as corrected",
                "verdict",
            ],
            rows: audit
                .iter()
                .map(|row| [row.number.to_owned()].into_iter().chain(audit_cells(row)).collect())
                .collect(),
            ..Table::default()
        }),
        Block::Figure(figure) => format!("*Figure (drawn in `report.html`).* {}\n", figure.caption),
        Block::Slot { instead, .. } => format!("{instead}\n"),
        Block::Code(language, text) => format!("```{language}\n{}\n```\n", text.trim_end()),
    }
}

fn rows(table: &Table) -> String {
    let line = |cells: Vec<String>| format!("| {} |\n", cells.join(" | "));
    let mut text = String::new();
    if !table.caption.is_empty() {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}\n", table.caption);
    }
    text += &line(table.head.iter().map(|cell| (*cell).to_owned()).collect());
    text.push_str(&line(vec!["---".to_owned(); table.head.len()]).replace(' ', ""));
    for row in &table.rows {
        text += &line(row.iter().map(|cell| escaped(cell)).collect());
    }
    text
}

/// Text inside a cell.
fn escaped(cell: &str) -> String {
    cell.replace('|', "\\|").replace('\n', " ").replace("<\u{a0}", "< ").replace('*', "\\*")
}

fn equation(judged: &Judged) -> String {
    let Judged { equation, section, rows: audit, verdict } = judged;
    let math = |latex: &str| format!("```math\n{}\n```\n", plain_latex(latex));
    let mut text = format!(
        "### {}: {}\n\nSection {section}. {}\n\n{}",
        equation.number,
        verdict_word(*verdict),
        equation.says,
        math(equation.printed)
    );
    if let Some(corrected) = equation.corrected {
        // Writing to a String cannot fail.
        let _ = write!(text, "\n{}:\n\n{}", instead(*verdict), math(corrected));
    }
    text.push('\n');
    text += &rows(&Table {
        head: vec!["part", "measured", "as printed", "as corrected", "verdict"],
        rows: audit.iter().map(|row| audit_cells(row).to_vec()).collect(),
        ..Table::default()
    });
    text
}

/// What the second form of an equation is.
pub(crate) fn instead(verdict: paper::equations::Verdict) -> &'static str {
    if verdict == paper::equations::Verdict::Refuted {
        "What is true instead"
    } else {
        "As corrected"
    }
}
