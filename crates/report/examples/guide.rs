//! The guide as a site of plain pages that need no network: the Markdown files of the repository, rendered by rustdoc, with their
//! formulas typeset, their links held against what is there, and their pictures beside them.
//! `cargo run -p report --example guide -- target/guide`

use std::error::Error;
use std::fmt::Write as _;
use std::path::{Component, Path, PathBuf};
use std::process::Command;
use std::{env, fs};

use figures::Escaped;

type Outcome<T> = Result<T, Box<dyn Error>>;

/// The page that is opened first, the folders of chapters, and the pages they refer to.
const FIRST: &str = "README.md";
const FOLDERS: [&str; 2] = ["crates/funicular/guide", "crates/python/guide"];
const REFERENCES: [&str; 1] = ["crates/model/FORMAT.md"];

/// A page: its file in the repository, its name in the site, its first heading, and the folder it is a chapter of.
struct Page {
    source: PathBuf,
    name: String,
    title: String,
    part: usize,
}

fn main() -> Outcome<()> {
    let out: PathBuf =
        env::args_os().nth(1).ok_or("which folder? target/guide, for example")?.into();
    let top = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
    let pages = pages(&top)?;
    fs::create_dir_all(out.join("pictures"))?;
    let mut site = Vec::new();
    for (at, page) in pages.iter().enumerate() {
        let content = report::formulas::typeset(&rendered(&top.join(&page.source), &out)?)?;
        whole_formulas(&content).map_err(|e| format!("{}: {e}", page.source.display()))?;
        let content = linked(&content, page, &pages, &top, &out)?;
        site.push((page.name.clone(), whole(&content, at, &pages)));
    }
    anchored(&site)?;
    for (name, text) in &site {
        fs::write(out.join(name), text)?;
    }
    println!("{} pages in {}", site.len(), out.display());
    Ok(())
}

/// All pages: the first, the chapters of each folder by their numbers, the references.
fn pages(top: &Path) -> Outcome<Vec<Page>> {
    let mut sources = vec![(PathBuf::from(FIRST), 0)];
    for (part, folder) in FOLDERS.iter().enumerate() {
        let mut chapters = Vec::new();
        for entry in fs::read_dir(top.join(folder))? {
            let name = entry?.file_name().into_string().map_err(|_| "a name that is not text")?;
            if let Some((number, _)) =
                name.strip_suffix(".md").and_then(|stem| stem.split_once('-'))
            {
                chapters.push((number.parse::<u32>()?, Path::new(folder).join(&name)));
            }
        }
        chapters.sort();
        sources.extend(chapters.into_iter().map(|(_, source)| (source, part)));
    }
    sources.extend(REFERENCES.map(|source| (source.into(), FOLDERS.len())));
    sources.into_iter().map(|(source, part)| page(top, source, part)).collect()
}

fn page(top: &Path, source: PathBuf, part: usize) -> Outcome<Page> {
    let text = fs::read_to_string(top.join(&source))?;
    let title = text.lines().find_map(|line| line.strip_prefix("# "));
    let title = title.ok_or_else(|| format!("{} has no title", source.display()))?.to_owned();
    let stem = source.file_stem().and_then(|stem| stem.to_str()).ok_or("a page without a name")?;
    let name = if source == Path::new(FIRST) {
        "index.html".into()
    } else {
        format!("{}.html", stem.to_lowercase())
    };
    Ok(Page { source, name, title, part })
}

/// What rustdoc makes of a Markdown file, without the page around it.
fn rendered(source: &Path, out: &Path) -> Outcome<String> {
    let rustdoc = env::var_os("RUSTDOC").unwrap_or_else(|| "rustdoc".into());
    let done = Command::new(rustdoc)
        .arg(source)
        .arg("--markdown-no-toc")
        .arg("--output")
        .arg(out)
        .status()?;
    if !done.success() {
        return Err(format!("rustdoc refuses {}", source.display()).into());
    }
    let written =
        out.join(source.with_extension("html").file_name().ok_or("a page without a name")?);
    let page = fs::read_to_string(&written)?;
    fs::remove_file(written)?;
    let content =
        page.split_once("<h1 class=\"title\">").and_then(|(_, rest)| rest.rsplit_once("</body>"));
    Ok(format!("<h1>{}", content.ok_or("rustdoc writes pages in another form")?.0.trim_end()))
}

/// That no formula was torn: Markdown takes `\,` and `*` for its own, and leaves a dollar sign or an entity behind.
fn whole_formulas(content: &str) -> Outcome<()> {
    let mut code = false;
    for part in content.split('<') {
        let (tag, text) = part.split_once('>').unwrap_or(("", part));
        code = (code || tag.starts_with("pre") || tag.starts_with("code"))
            && tag != "/pre"
            && tag != "/code";
        if !code && (text.contains('$') || text.contains("&amp;nbsp;")) {
            return Err(format!("a formula is torn: {text}").into());
        }
    }
    Ok(())
}

/// The page with links to pages of the site, and with its pictures copied; what the repository alone has keeps its words.
fn linked(content: &str, page: &Page, pages: &[Page], top: &Path, out: &Path) -> Outcome<String> {
    let mut made = String::with_capacity(content.len());
    let mut rest = content;
    while let Some(start) =
        ["<a href=\"", "<img src=\""].iter().filter_map(|tag| rest.find(tag)).min()
    {
        let (before, tag) = rest.split_at(start);
        made.push_str(before);
        let (opening, from) = tag.split_at(tag.find('"').unwrap_or_default() + 1);
        let (target, after) = from.split_once('"').ok_or("a link without an end")?;
        rest = after;
        if target.starts_with('#') || target.contains("://") {
            made.extend([opening, target, "\""]);
            continue;
        }
        let (path, anchor) = target.split_at(target.find('#').unwrap_or(target.len()));
        let path = inside(&page.source, path);
        if !top.join(&path).exists() {
            return Err(format!("{}: {target} does not exist", page.source.display()).into());
        }
        // A folder of chapters is its first one.
        let there = |other: &&Page| {
            other.source == path
                || FOLDERS.iter().any(|f| path == Path::new(f)) && other.source.starts_with(&path)
        };
        if let Some(there) = pages.iter().find(there) {
            made.extend([opening, &there.name, anchor, "\""]);
        } else if opening.starts_with("<img") {
            let name = path
                .file_name()
                .and_then(|name| name.to_str())
                .ok_or("a picture without a name")?;
            fs::copy(top.join(&path), out.join("pictures").join(name))?;
            made.extend([opening, "pictures/", name, "\""]);
        } else {
            let (words, after) = rest.split_once("</a>").ok_or("a link without an end")?;
            write!(made, "<span title=\"{} in the repository\"{words}</span>", path.display())?;
            rest = after;
        }
    }
    Ok(made + rest)
}

/// A path as a page writes it, from the top of the repository.
fn inside(source: &Path, target: &str) -> PathBuf {
    let mut path = source.parent().map_or_else(PathBuf::new, Path::to_owned);
    for part in Path::new(target).components() {
        if part == Component::ParentDir {
            path.pop();
        } else {
            path.push(part);
        }
    }
    path
}

/// The whole page: chapters to go to before the content, the next one behind it.
fn whole(content: &str, at: usize, pages: &[Page]) -> String {
    let item = |page: &Page| {
        let here = if page.name == pages[at].name { " aria-current=\"page\"" } else { "" };
        format!("<li><a href=\"{}\"{here}>{}</a></li>", page.name, Escaped(&page.title))
    };
    let list = |part| pages.iter().filter(|page| page.part == part).map(item).collect::<String>();
    let contents = format!("<ol>{}</ol><ol>Python: {}</ol><ol>{}</ol>", list(0), list(1), list(2));
    let next = pages.get(at + 1).map_or_else(String::new, |page| {
        format!("<nav aria-label=\"Next\"><ol>Next: {}</ol></nav>", item(page))
    });
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{}</title>\n\
         <link rel=\"icon\" href=\"data:,\">\n<style>\n{}{}</style>\n</head>\n<body>\n\
         <nav aria-label=\"Chapters\">{contents}</nav>\n<main>\n{content}\n</main>\n{next}\n</body>\n</html>\n",
        Escaped(&pages[at].title),
        include_str!("../src/style.css"),
        include_str!("guide.css"),
    )
}

/// That each link into a page names a heading that is there.
fn anchored(site: &[(String, String)]) -> Outcome<()> {
    for (name, text) in site {
        for link in text.split("<a href=\"").skip(1).filter_map(|rest| rest.split('"').next()) {
            let Some((page, id)) = link.split_once('#').filter(|_| !link.contains("://")) else {
                continue;
            };
            let page = if page.is_empty() { name } else { page };
            let there = site.iter().find(|(other, _)| other == page);
            if !there.is_some_and(|(_, text)| text.contains(&format!("id=\"{id}\""))) {
                return Err(format!("{name}: {link} does not exist").into());
            }
        }
    }
    Ok(())
}
