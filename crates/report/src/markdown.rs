//! The report as Markdown.

use std::fmt::Write as _;

use crate::block::{self, Block, Table, audit_cells};
use crate::equations::Judged;
use crate::math::plain_latex;

/// All blocks, one after the other.
pub fn markdown(blocks: &[Block]) -> String {
    blocks.iter().map(one).collect::<Vec<_>>().join("\n")
}

fn one(block: &Block) -> String {
    match block {
        // Links lead to these names, whatever a viewer makes of the words.
        Block::Heading(level, id, text) => {
            format!("{} <a id=\"{id}\"></a>{text}\n", "#".repeat(usize::from(*level)))
        }
        Block::Text(text) => format!("{text}\n"),
        Block::List(items) => format!("- {}\n", items.join("\n- ")),
        Block::Table(table) => rows(table),
        Block::Equation(judged) => equation(judged),
        Block::Statements(audit) => {
            rows(&Table { caption: String::new(), ..block::statements(audit) })
        }
        Block::Figure(figure) | Block::Sheet(figure) => {
            format!("*Figure (drawn in `report.html`).* {}\n", figure.caption)
        }
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
        text += &line(row.iter().map(|cell| escaped(&cell.text())).collect());
    }
    text
}

/// Text inside a cell. Markdown has plain spaces only.
fn escaped(cell: &str) -> String {
    cell.replace('|', "\\|").replace(['\n', '\u{a0}'], " ").replace('*', "\\*")
}

fn equation(judged: &Judged) -> String {
    let Judged { equation, section, rows: audit, .. } = judged;
    let math = |latex: &str| format!("```math\n{}\n```\n", plain_latex(latex));
    let mut text = format!(
        "### {}: {}\n\nSection {section}. {}\n\n{}",
        equation.number,
        judged.badge().word,
        equation.says,
        math(equation.printed)
    );
    if let Some(corrected) = equation.corrected {
        // Writing to a String cannot fail.
        let _ = write!(text, "\n{}:\n\n{}", judged.instead(), math(corrected));
    }
    text.push('\n');
    text += &rows(&Table {
        head: vec!["part", "measured", "as printed", "as corrected", "verdict"],
        rows: audit.iter().map(|row| audit_cells(row).to_vec()).collect(),
        ..Table::default()
    });
    text
}
