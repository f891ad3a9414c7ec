//! Where each change goes.

use std::collections::HashMap;

use proc_macro2::Span as Tokens;
use syn::spanned::Spanned;
use syn::visit::{self, Visit};

use crate::edit::{Insertions, Lines};
use crate::{Mutant, Position, Span};

/// The source with its changes behind switches, and the ids of those that found their place.
pub fn switched(source: &str, mutants: &[Mutant]) -> syn::Result<(String, Vec<u32>)> {
    let lines = Lines::new(source);
    let mut at: HashMap<Position, Vec<&Mutant>> = HashMap::new();
    let mut whole: HashMap<Span, Vec<(u32, String)>> = HashMap::new();
    let (mut insertions, mut placed) = (Insertions::default(), Vec::new());
    for mutant in mutants {
        if mutant.genre == "FnValue" {
            let (id, value) = (mutant.id, &mutant.replacement);
            insertions.at(
                lines.byte(mutant.span.start),
                format!("if crate::mx::on({id}) {{ return ({value}); /*{id}*/ }} "),
            );
            placed.push(id);
        } else if mutant.genre == "Plausible" {
            let text = (mutant.id, mutant.replacement.clone());
            whole.entry(mutant.span).or_default().push(text);
            placed.push(mutant.id);
        } else {
            at.entry(mutant.span.start).or_default().push(mutant);
        }
    }
    let file = syn::parse_file(source)?;
    let mut visitor = Visitor { lines, at, insertions, placed };
    visitor.visit_file(&file);
    whole.iter().for_each(|(whole, texts)| visitor.choose(*whole, texts));
    Ok((visitor.insertions.applied(source), visitor.placed))
}

struct Visitor<'a> {
    lines: Lines<'a>,
    at: HashMap<Position, Vec<&'a Mutant>>,
    insertions: Insertions,
    placed: Vec<u32>,
}

pub fn span(tokens: Tokens) -> Span {
    let (start, end) = (tokens.start(), tokens.end());
    let position = |at: proc_macro2::LineColumn| Position { line: at.line, column: at.column + 1 };
    Span { start: position(start), end: position(end) }
}

/// Whether a condition has a `let` among its parts.
pub fn binds(condition: &syn::Expr) -> bool {
    match condition {
        syn::Expr::Let(_) => true,
        syn::Expr::Binary(chain) => binds(&chain.left) || binds(&chain.right),
        _ => false,
    }
}

impl Visitor<'_> {
    fn taken(&mut self, tokens: Tokens, genre: &str) -> Vec<(u32, String)> {
        let Some(list) = self.at.get_mut(&span(tokens).start) else { return Vec::new() };
        let (taken, left) =
            list.iter().partition::<Vec<&Mutant>, _>(|mutant| mutant.genre == genre);
        *list = left;
        self.placed.extend(taken.iter().map(|mutant| mutant.id));
        taken.iter().map(|mutant| (mutant.id, mutant.replacement.clone())).collect()
    }

    /// `whole` if no switch is on, else the text that belongs to it.
    fn choose(&mut self, whole: Span, texts: &[(u32, String)]) {
        if texts.is_empty() {
            return;
        }
        let arms: String = texts
            .iter()
            .map(|(id, text)| format!("if crate::mx::on({id}) {{ {text} /*{id}*/ }} else "))
            .collect();
        let (start, end) = (self.lines.byte(whole.start), self.lines.byte(whole.end));
        // In parentheses: what begins with `if` and goes on would be a statement.
        self.insertions.around(start, end, format!("({arms}{{ ("), ") })");
    }
}

impl<'ast> Visit<'ast> for Visitor<'_> {
    fn visit_expr_binary(&mut self, binary: &'ast syn::ExprBinary) {
        if binds(&binary.left) || binds(&binary.right) {
            // A chain with `let` in it can stand in no other place, and `||` in it does not compile.
            visit::visit_expr_binary(self, binary);
            return;
        }
        let taken = self.taken(binary.op.span(), "BinaryOperator");
        let left = self.lines.text(span(binary.left.span()));
        let right = self.lines.text(span(binary.right.span()));
        let assigns = matches!(
            self.lines.text(span(binary.op.span())),
            "+=" | "-=" | "*=" | "/=" | "%=" | "&=" | "|=" | "^=" | "<<=" | ">>="
        );
        let texts: Vec<_> = taken
            .into_iter()
            .map(|(id, operator)| {
                let text = if assigns {
                    format!("{left} {operator} {right};")
                } else {
                    format!("({left}) {operator} ({right})")
                };
                (id, text)
            })
            .collect();
        self.choose(span(binary.span()), &texts);
        visit::visit_expr_binary(self, binary);
    }

    fn visit_expr_unary(&mut self, unary: &'ast syn::ExprUnary) {
        let taken = self.taken(unary.op.span(), "UnaryOperator");
        let operand = self.lines.text(span(unary.expr.span()));
        let texts: Vec<_> = taken
            .into_iter()
            .map(|(id, operator)| (id, format!("{operator}({operand})")))
            .collect();
        self.choose(span(unary.span()), &texts);
        visit::visit_expr_unary(self, unary);
    }

    fn visit_arm(&mut self, arm: &'ast syn::Arm) {
        let guards = match &arm.guard {
            Some((_, guard)) => self.taken(guard.span(), "MatchArmGuard"),
            None => Vec::new(),
        };
        if let Some((_, guard)) = &arm.guard {
            self.choose(span(guard.span()), &guards);
        }
        for (id, _) in self.taken(arm.span(), "MatchArm") {
            match &arm.guard {
                Some((_, guard)) => {
                    let guard = span(guard.span());
                    let (start, end) = (self.lines.byte(guard.start), self.lines.byte(guard.end));
                    self.insertions.around(
                        start,
                        end,
                        format!("(!crate::mx::on({id})) && /*{id}*/ ("),
                        ")",
                    );
                }
                None => {
                    let place = self.lines.byte(span(arm.pat.span()).end);
                    self.insertions.behind(place, format!(" if !crate::mx::on({id}) /*{id}*/"));
                }
            }
        }
        visit::visit_arm(self, arm);
    }

    fn visit_expr_struct(&mut self, value: &'ast syn::ExprStruct) {
        let whole = self.lines.text(span(value.span()));
        let from = self.lines.byte(span(value.span()).start);
        let mut texts = Vec::new();
        for field in &value.fields {
            let own = span(field.span());
            let (start, end) = (self.lines.byte(own.start) - from, self.lines.byte(own.end) - from);
            for (id, _) in self.taken(field.span(), "StructField") {
                let rest = whole[end..].trim_start().strip_prefix(',').unwrap_or(&whole[end..]);
                texts.push((id, format!("{}{rest}", &whole[..start])));
            }
        }
        self.choose(span(value.span()), &texts);
        visit::visit_expr_struct(self, value);
    }
}
