//! The report of the paper: complete, self-contained, accessible, and the same as the golden copy.

mod equations;
mod formulas;
mod pictures;
mod view;

use std::path::Path;
use std::sync::LazyLock;

use paper::equations::Validity;
use report::block::{Block, audit_cells};
use report::equations::{judged, statements};
use report::{Environment, Report};

/// One report for all tests.
static REPORT: LazyLock<Report> = LazyLock::new(|| {
    let reproduction = paper::reproduce(|_| {}).expect("the paper is reproduced");
    let command = ["funicular", "reproduce", "--out", "report"].map(String::from);
    Report::new(reproduction, Environment::here(command.into_iter())).expect("a report")
});

/// Set this variable to anything to write the golden copy again: `BLESS=1 cargo test -p report`.
const BLESS: &str = "BLESS";

#[test]
fn the_golden_copy_is_what_comes_out() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../validation/REPORT.md");
    let text = REPORT.golden();
    if std::env::var_os(BLESS).is_some() {
        std::fs::write(&path, &text).unwrap();
    }
    let golden = std::fs::read_to_string(&path).unwrap();
    for (k, (ours, theirs)) in text.lines().zip(golden.lines()).enumerate() {
        assert_eq!(
            ours,
            theirs,
            "line {} of validation/REPORT.md; {BLESS}=1 writes it again",
            k + 1
        );
    }
    assert_eq!(text, golden);
}

#[test]
fn links_of_the_markdown_lead_to_a_heading() {
    let markdown = REPORT.markdown();
    let links: Vec<_> =
        markdown.split("](#").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(!links.is_empty());
    for link in links {
        assert!(markdown.contains(&format!("# <a id=\"{link}\"></a>")), "#{link} leads nowhere");
    }
}

#[test]
fn every_equation_has_a_verdict_and_every_verdict_a_number() {
    let judged = judged(&REPORT.reproduction().equations);
    assert_eq!(judged.len(), 41 + 26);
    for j in &judged {
        assert!(!j.rows.is_empty(), "{} is not judged", j.equation.number);
        for row in &j.rows {
            assert!(row.as_printed.is_finite(), "{row:?}");
            assert_ne!(row.measure, "nothing measured", "{row:?}");
        }
        // A correction in print if and only if the numbers ask for one.
        let failing = matches!(j.verdict, Validity::Corrected | Validity::Refuted);
        assert_eq!(failing, j.equation.corrected.is_some(), "{}", j.equation.number);
    }
    // Numbered or not, every row of the audit is told.
    let told: usize = judged.iter().map(|j| j.rows.len()).sum();
    let rest = statements(&REPORT.reproduction().equations).count();
    assert_eq!(told + rest, REPORT.reproduction().equations.len());
}

#[test]
fn page_and_markdown_tell_the_same_numbers() {
    let (html, markdown) = (REPORT.html(), REPORT.markdown());
    for row in &REPORT.reproduction().equations {
        let [what, measure, printed, corrected, word] = audit_cells(row).map(|cell| cell.text());
        let line = format!("| {what} | {measure} | {printed} | {corrected} | {word} |");
        assert!(markdown.contains(&line.replace('\u{a0}', " ")), "{line}");
        // A bound has a `<`, which is an entity in HTML.
        let printed = printed.replace('<', "&lt;");
        let name = row.number.trim_matches(['(', ')']);
        let heading = format!("<h3 id=\"eq-{name}\">");
        let Some((_, article)) = html.split_once(&heading) else {
            let cell = format!(">{printed}</td>");
            let (_, table) = html.split_once("Statements of the text").unwrap();
            assert!(table.contains(&cell), "{}: {cell}", row.number);
            continue;
        };
        let (article, _) = article.split_once("</article>").unwrap();
        let strong = format!(":</span> <strong>{printed}</strong>");
        assert!(article.contains(&strong), "{}: {strong}", row.number);
    }
    for claim in &REPORT.reproduction().claims {
        let says = report::symbols::signs(&claim.printed.says);
        let page = html.replace("<sub>", "_").replace("</sub>", "");
        assert!(page.contains(&figures::Escaped(&says).to_string()), "{says}");
    }
}

#[test]
fn the_page_needs_nothing_else() {
    let html = REPORT.html();
    for wanted in ["http://", "https://", "src=\"", "@import", "url(", "<link rel=\"stylesheet\""] {
        let allowed = html.matches("http://www.w3.org/").count();
        let found = html.matches(wanted).count();
        let expected = if wanted == "http://" { allowed } else { 0 };
        assert_eq!(found, expected, "the page asks for something by {wanted}");
    }
    assert!(html.starts_with("<!DOCTYPE html>\n<html lang=\"en\">"));
    // For a look at it, and for the checks in a browser.
    std::fs::write(Path::new(env!("CARGO_TARGET_TMPDIR")).join("report.html"), &html).unwrap();
    // A few hundred kilobytes: it goes by mail.
    assert!(html.len() < 1_500_000, "{}", html.len());
}

#[test]
fn headings_go_down_one_level_at_a_time_and_every_anchor_is_there_once() {
    let html = REPORT.html();
    let levels: Vec<u32> = html
        .match_indices("<h")
        .filter_map(|(at, _)| html[at + 2..].chars().next()?.to_digit(10))
        .collect();
    assert_eq!(levels.first(), Some(&1));
    assert_eq!(levels.iter().filter(|level| **level == 1).count(), 1);
    assert!(levels.windows(2).all(|pair| pair[1] <= pair[0] + 1), "{levels:?}");
    for (at, _) in html.match_indices("href=\"#") {
        let anchor = html[at + 7..].split('"').next().unwrap();
        assert_eq!(html.matches(&format!(" id=\"{anchor}\"")).count(), 1, "{anchor}");
    }
    let ids: Vec<&str> = html
        .match_indices(" id=\"")
        .map(|(at, _)| html[at + 5..].split('"').next().unwrap())
        .collect();
    let mut once = ids.clone();
    once.sort_unstable();
    once.dedup();
    assert_eq!(once.len(), ids.len(), "an id stands twice");
}

/// The menu leads to every chapter and to every part of one that has a heading of its own.
#[test]
fn the_menu_leads_to_the_parts_as_well() {
    let html = REPORT.html();
    let (_, menu) = html.split_once("<nav").unwrap();
    let (menu, _) = menu.split_once("</nav>").unwrap();
    for anchor in ["outcome", "scan", "view", "claims", "equations", "statements", "this-run"] {
        assert!(menu.contains(&format!("href=\"#{anchor}\"")), "{anchor} is not in the menu");
    }
    assert!(menu.contains(">To try it</a>"));
}

/// A table with verdicts names the column at each cell, for screens without room for columns.
#[test]
fn cells_beside_a_verdict_name_their_column() {
    let html = REPORT.html();
    let mut tables = 0;
    for table in html.split("<table class=\"judged\"").skip(1) {
        let (table, _) = table.split_once("</table>").unwrap();
        assert_eq!(table.matches("<td").count(), table.matches(" data-column=\"").count());
        assert!(
            table.contains("<td class=\"verdicts\"")
                || table.contains("<th scope=\"row\" class=\"verdicts\"")
        );
        tables += 1;
    }
    // Rungs, claims, the equations by verdict, statements, cases, two of the gallery, the field.
    assert_eq!(tables, 8);
}

#[test]
fn every_picture_says_what_it_shows() {
    let html = REPORT.html();
    for (at, _) in html.match_indices("<svg ") {
        let tag = html[at..].split('>').next().unwrap();
        assert!(tag.contains("role=\"") && tag.contains("aria-label"), "{tag}");
    }
    assert!(html.matches("<figcaption").count() >= 5);
    assert_eq!(html.matches("<figcaption").count(), html.matches("<figure").count());
    assert_eq!(html.matches("<math").count(), html.matches("</math>").count());
    assert!(!html.contains("merror") && !html.contains("NaN"));
}

#[test]
fn every_table_has_as_many_cells_in_each_row_as_in_its_head() {
    for text in [REPORT.markdown(), REPORT.golden()] {
        let tables: Vec<&str> = text.split("\n\n").filter(|block| block.starts_with('|')).collect();
        assert!(tables.len() > 10, "{}", tables.len());
        for block in tables {
            let cells = |line: &str| line.replace("\\|", "").matches('|').count();
            let mut lines = block.lines();
            let head = cells(lines.next().unwrap());
            assert!(lines.all(|line| !line.starts_with('|') || cells(line) == head), "{block}");
        }
    }
}

#[test]
fn only_the_last_part_knows_where_it_was_made() {
    let golden = REPORT.golden();
    let markdown = REPORT.markdown();
    let run = markdown.strip_prefix(&golden).unwrap();
    assert!(run.contains("</a>This run") && run.contains("`funicular reproduce --out report`"));
    assert!(run.contains("rustc ") && run.contains("nalgebra "));
    assert!(
        !golden.contains("rustc ") && !golden.contains("e-1"),
        "a rounding is told as a number"
    );
    let json: serde_json::Value = serde_json::from_str(&REPORT.json().unwrap()).unwrap();
    assert_eq!(json["schema_version"], 3);
    assert_eq!(json["environment"]["command"], "funicular reproduce --out report");
    assert!(json["figures"]["closure_curve"].as_array().unwrap().len() > 100);
}

#[test]
fn every_package_has_a_version_and_the_command_no_folder() {
    let here =
        Environment::here(["/some/where/funicular", "reproduce"].map(String::from).into_iter());
    assert_eq!(here.command, "funicular reproduce");
    let packages =
        "argmin |argmin-math |clarabel |nalgebra |pulldown-latex |rand |rand_chacha |rayon ";
    for name in packages.split('|') {
        assert!(here.packages.iter().any(|p| p.starts_with(name)), "{name}");
    }
    assert!(here.compiler.starts_with("rustc "), "{}", here.compiler);
}

#[test]
fn marks_become_elements_and_markup_does_not() {
    for (text, element) in [
        ("a < `b` and **c**", "a &lt; <code>b</code> and <strong>c</strong>"),
        ("see [there](#x) and ` alone", "see <a href=\"#x\">there</a> and ` alone"),
        ("b_{1,5} [B]^T", "b<sub>1,5</sub> [B]<sup>T</sup>"),
        ("J_x in 1/s^3, [J_Ci]", "J<sub>x</sub> in 1/s<sup>3</sup>, [J<sub>Ci</sub>]"),
        ("mass_kg and `e_x`, 2^", "mass_kg and <code>e_x</code>, 2^"),
    ] {
        let page = report::html::page("", &[Block::Text(text.to_owned())], &[]);
        assert!(page.contains(&format!("\n<p>{element}</p>\n")), "{text}");
    }
}
