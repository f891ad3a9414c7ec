//! Changes that a person makes by mistake: ends, arguments, rows and columns exchanged, another index, a sign, a term or
//! factor left out, twice a number, a threshold 1000 times as large, the other side of a bound, a range without its
//! first or last, another function.
//!
//! What says the same by its form (`dot(b, a)` for `dot(a, b)`) is not proposed, nor are constants, patterns, macros,
//! text and the files of errors and settings.

use std::path::Path;

use proc_macro2::Span as Tokens;
use syn::punctuated::Punctuated;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};
use syn::{BinOp, Expr, Token};

use crate::edit::Lines;
use crate::place::{binds, span};
use crate::tree::sources;
use crate::{Failure, Mutant};

/// Names of which one stands for the other by mistake.
const PAIRS: [(&str, &str); 19] = [
    ("from", "to"),
    ("start", "end"),
    ("first", "last"),
    ("lower", "upper"),
    ("low", "high"),
    ("inf", "sup"),
    ("row", "column"),
    ("left", "right"),
    ("x", "y"),
    ("y", "z"),
    ("sin", "cos"),
    ("min", "max"),
    ("any", "all"),
    ("floor", "ceil"),
    ("is_some", "is_none"),
    ("exp", "ln"),
    ("ascending", "descending"),
    ("rows", "columns"),
    ("nrows", "ncols"),
];
/// Methods that are left out by mistake.
const LEFT_OUT: [&str; 7] = ["abs", "sqrt", "transpose", "recip", "powi", "signum", "clamp"];
/// Their arguments commute.
const SYMMETRIC: [&str; 10] =
    ["dot", "min", "max", "hypot", "distance", "zip", "swap", "sum", "plus", "product"];

/// All of a crate, in the order of its files.
///
/// # Errors
///
/// Where a file cannot be read or is no Rust.
pub fn proposed(krate: &str) -> Result<Vec<Mutant>, Failure> {
    let mut files = sources(&Path::new("crates").join(krate).join("src"))?;
    files.sort();
    let mut all = Vec::new();
    for file in files {
        let name = file.to_string_lossy().into_owned();
        let spared =
            ["tests", "/error", "/settings", "/mx.rs", "/text", "/svg", "/figure", "/diagram"];
        if spared.iter().any(|part| name.contains(part)) {
            continue;
        }
        let source = std::fs::read_to_string(&file)?;
        let mut found = Proposals { file: name, lines: Lines::new(&source), all: Vec::new() };
        found.visit_file(&syn::parse_file(&source)?);
        all.append(&mut found.all);
    }
    Ok(all)
}

struct Proposals<'a> {
    file: String,
    lines: Lines<'a>,
    all: Vec<Mutant>,
}

impl Proposals<'_> {
    fn text(&self, part: &impl Spanned) -> String {
        self.lines.text(span(part.span())).to_owned()
    }

    fn propose(&mut self, whole: Tokens, text: String) {
        let span = span(whole);
        let old = self.lines.text(span);
        if old == text || old.contains('"') {
            return;
        }
        let (line, column) = (span.start.line, span.start.column);
        let flat = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let name = format!("{}:{line}:{column}: `{}` to `{}`", self.file, flat(old), flat(&text));
        let (file, genre) = (self.file.clone(), "Plausible".to_owned());
        self.all.push(Mutant { id: 0, file, name, span, replacement: text, genre });
    }

    /// `whole` with one part of it replaced.
    fn within(&mut self, whole: &impl Spanned, part: Tokens, text: &str) {
        let (outer, inner) = (span(whole.span()), span(part));
        let from = self.lines.byte(outer.start);
        let (start, end) = (self.lines.byte(inner.start) - from, self.lines.byte(inner.end) - from);
        let old = self.lines.text(outer);
        let new = format!("{}{text}{}", &old[..start], &old[end..]);
        self.propose(whole.span(), new);
    }

    /// Neighbours among arguments exchanged.
    fn exchanged(&mut self, whole: &impl Spanned, arguments: &Punctuated<Expr, Token![,]>) {
        let texts: Vec<String> = arguments.iter().map(|part| self.text(part)).collect();
        for (k, pair) in texts.windows(2).enumerate() {
            let (first, second) = (arguments[k].span(), arguments[k + 1].span());
            let both = first.join(second).unwrap_or(first);
            if pair[0] != pair[1] {
                self.within(whole, both, &format!("{}, {}", pair[1], pair[0]));
            }
        }
    }

    fn renamed(&mut self, whole: &impl Spanned, name: &syn::Ident) {
        let old = name.to_string();
        for (one, other) in PAIRS {
            if old == one {
                self.within(whole, name.span(), other);
            } else if old == other {
                self.within(whole, name.span(), one);
            }
        }
    }
}

fn tested(attributes: &[syn::Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        attribute.path().is_ident("test")
            || attribute.path().is_ident("cfg")
                && matches!(&attribute.meta, syn::Meta::List(list) if list.tokens.to_string().contains("test"))
    })
}

impl<'ast> Visit<'ast> for Proposals<'_> {
    fn visit_pat(&mut self, _: &'ast syn::Pat) {}
    fn visit_type(&mut self, _: &'ast syn::Type) {}
    fn visit_generic_argument(&mut self, _: &'ast syn::GenericArgument) {}
    fn visit_attribute(&mut self, _: &'ast syn::Attribute) {}
    fn visit_item_const(&mut self, _: &'ast syn::ItemConst) {}
    fn visit_impl_item_const(&mut self, _: &'ast syn::ImplItemConst) {}
    fn visit_item_static(&mut self, _: &'ast syn::ItemStatic) {}
    fn visit_expr_const(&mut self, _: &'ast syn::ExprConst) {}

    fn visit_item_mod(&mut self, item: &'ast syn::ItemMod) {
        if !tested(&item.attrs) {
            visit::visit_item_mod(self, item);
        }
    }

    fn visit_item_impl(&mut self, item: &'ast syn::ItemImpl) {
        let words = |path: &syn::Path| {
            path.segments
                .last()
                .is_some_and(|name| name.ident == "Display" || name.ident == "Debug")
        };
        if !item.trait_.as_ref().is_some_and(|(_, path, _)| words(path)) {
            visit::visit_item_impl(self, item);
        }
    }

    fn visit_item_fn(&mut self, item: &'ast syn::ItemFn) {
        if item.sig.constness.is_none() && !tested(&item.attrs) {
            visit::visit_item_fn(self, item);
        }
    }

    fn visit_impl_item_fn(&mut self, item: &'ast syn::ImplItemFn) {
        if item.sig.constness.is_none() {
            visit::visit_impl_item_fn(self, item);
        }
    }

    fn visit_expr_assign(&mut self, assign: &'ast syn::ExprAssign) {
        self.visit_place(&assign.left);
        self.visit_expr(&assign.right);
    }

    fn visit_expr_reference(&mut self, reference: &'ast syn::ExprReference) {
        if reference.mutability.is_some() {
            self.visit_place(&reference.expr);
        } else {
            visit::visit_expr_reference(self, reference);
        }
    }

    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        if binds(&binary.left) || binds(&binary.right) {
            visit::visit_expr_binary(self, binary);
            return;
        }
        let (left, right) = (self.text(&binary.left), self.text(&binary.right));
        let whole = binary.span();
        let mut texts = Vec::new();
        match binary.op {
            BinOp::Add(_) => texts.extend([format!("{left} - ({right})"), left, right]),
            BinOp::Sub(_) => {
                texts.extend([format!("{left} + {right}"), format!("{right} - ({left})"), left]);
            }
            BinOp::Mul(_) => texts.extend([format!("{left} / ({right})"), left, right]),
            BinOp::Div(_) => texts.extend([format!("{left} * {right}"), left]),
            BinOp::And(_) | BinOp::Or(_) => texts.extend([left, right]),
            BinOp::Lt(_) | BinOp::Le(_) => texts.push(format!("({left}) > {right}")),
            BinOp::Gt(_) | BinOp::Ge(_) => texts.push(format!("({left}) < {right}")),
            BinOp::Eq(_) => texts.push(format!("({left}) != {right}")),
            BinOp::Ne(_) => texts.push(format!("({left}) == {right}")),
            BinOp::AddAssign(_) => texts.push(format!("{left} -= {right}")),
            BinOp::SubAssign(_) => texts.push(format!("{left} += {right}")),
            BinOp::MulAssign(_) => texts.push(format!("{left} /= {right}")),
            BinOp::DivAssign(_) => texts.push(format!("{left} *= {right}")),
            _ => {}
        }
        let assigns = texts.len() == 1 && texts[0].contains("= ") && !texts[0].contains("== ");
        let assigns = assigns && !matches!(binary.op, BinOp::Eq(_));
        for text in texts {
            self.propose(whole, text);
        }
        if assigns {
            self.visit_place(&binary.left);
        } else {
            self.visit_expr(&binary.left);
        }
        self.visit_expr(&binary.right);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        if !matches!(unary.op, syn::UnOp::Deref(_)) {
            self.propose(unary.span(), format!("({})", self.text(&unary.expr)));
        }
        visit::visit_expr_unary(self, unary);
    }

    fn visit_expr_lit(&mut self, literal: &'ast syn::ExprLit) {
        if let syn::Lit::Float(number) = &literal.lit
            && number.base10_parse::<f64>().is_ok_and(|value| value != 0.0)
        {
            self.propose(literal.span(), format!("2.0 * {}", self.text(literal)));
        }
    }

    fn visit_expr_path(&mut self, path: &'ast syn::ExprPath) {
        let name = path.path.segments.last().map(|part| part.ident.to_string()).unwrap_or_default();
        let constant = name.len() > 2 && name.chars().all(|c| c.is_ascii_uppercase() || c == '_');
        if constant && !["EPSILON", "INFINITY", "NAN"].contains(&name.as_str()) {
            self.propose(path.span(), format!("1000.0 * {}", self.text(path)));
        }
    }

    fn visit_expr_range(&mut self, range: &'ast syn::ExprRange) {
        if let Some(end) = &range.end {
            self.propose(end.span(), format!("({}) - 1", self.text(end)));
            if let Some(start) = &range.start {
                self.propose(start.span(), format!("({}) + 1", self.text(start)));
            }
        }
        visit::visit_expr_range(self, range);
    }

    fn visit_expr_index(&mut self, index: &'ast syn::ExprIndex) {
        self.visit_expr(&index.expr);
        self.visit_index(&index.index);
    }

    fn visit_expr_field(&mut self, field: &'ast syn::ExprField) {
        match &field.member {
            syn::Member::Named(name) => self.renamed(field, name),
            syn::Member::Unnamed(number) => {
                let other = if number.index == 0 { "1" } else { "0" };
                self.within(field, number.span(), other);
            }
        }
        visit::visit_expr_field(self, field);
    }

    fn visit_expr_call(&mut self, call: &'ast syn::ExprCall) {
        let name = match &*call.func {
            Expr::Path(path) => path.path.segments.last().map(|part| part.ident.to_string()),
            _ => None,
        };
        // How much room is made beforehand changes nothing.
        if name.as_deref() == Some("with_capacity") {
            return;
        }
        if !name.is_some_and(|name| SYMMETRIC.contains(&name.as_str())) {
            self.exchanged(call, &call.args);
        }
        call.args.iter().for_each(|argument| self.visit_expr(argument));
    }

    fn visit_expr_method_call(&mut self, call: &'ast syn::ExprMethodCall) {
        let name = call.method.to_string();
        if name == "reserve" {
            return;
        }
        if !SYMMETRIC.contains(&name.as_str()) {
            self.exchanged(call, &call.args);
        }
        self.renamed(call, &call.method);
        if LEFT_OUT.contains(&name.as_str()) {
            self.propose(call.span(), self.text(&call.receiver));
        }
        visit::visit_expr_method_call(self, call);
    }
}

impl Proposals<'_> {
    /// What is written to stays a place: its indices alone change.
    fn visit_place(&mut self, place: &Expr) {
        match place {
            Expr::Index(index) => {
                self.visit_place(&index.expr);
                self.visit_index(&index.index);
            }
            Expr::Field(field) => self.visit_place(&field.base),
            Expr::Paren(inner) => self.visit_place(&inner.expr),
            Expr::Unary(inner) => self.visit_place(&inner.expr),
            _ => {}
        }
    }

    fn visit_index(&mut self, index: &Expr) {
        match index {
            Expr::Lit(literal) => {
                let other = if self.text(literal) == "0" { "1" } else { "0" };
                self.propose(literal.span(), other.to_owned());
            }
            Expr::Path(path) => self.propose(path.span(), "0".to_owned()),
            Expr::Tuple(pair) if pair.elems.len() == 2 => {
                let (row, column) = (self.text(&pair.elems[0]), self.text(&pair.elems[1]));
                if row != column {
                    self.propose(pair.span(), format!("({column}, {row})"));
                }
                pair.elems.iter().for_each(|part| self.visit_expr(part));
            }
            _ => self.visit_expr(index),
        }
    }
}
