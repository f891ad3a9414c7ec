//! The part of Tcl that decks are written in: commands, variables, arithmetic. Nothing is executed.

use std::collections::HashMap;

use super::expr;
use crate::error::{At, Result, shortened};

/// Letters of one word, with the values of its variables: no number has more.
const MOST_LETTERS: usize = 1000;

/// A command with its words, as they are after substitution.
pub(super) struct Command {
    /// The line where it begins.
    pub(super) line: usize,
    pub(super) words: Vec<String>,
    /// The line where the last word begins, if that is in braces.
    pub(super) body: Option<usize>,
    /// A command within it that only Tcl could execute.
    pub(super) executed: Option<String>,
}

/// Values of variables; nothing for one that only Tcl knows.
pub(super) type Variables = HashMap<String, String>;

/// A text whose commands are read.
pub(super) struct Script<'a> {
    file: &'a str,
    rest: &'a str,
    line: usize,
}

impl<'a> Script<'a> {
    /// A text that begins in this line of its file.
    pub(super) fn new(file: &'a str, rest: &'a str, line: usize) -> Self {
        Self { file, rest, line }
    }

    /// The next command that sets no variable.
    pub(super) fn next(&mut self, variables: &mut Variables) -> Result<Option<Command>> {
        loop {
            let Some(command) = self.command(variables)? else { return Ok(None) };
            match &command.words[..] {
                [set, name, value] if set == "set" => {
                    let value = value.clone();
                    if command.executed.is_some() {
                        variables.remove(name);
                    } else {
                        variables.insert(name.clone(), value);
                    }
                }
                _ => return Ok(Some(command)),
            }
        }
    }

    fn command(&mut self, variables: &Variables) -> Result<Option<Command>> {
        loop {
            self.skip(|c| c.is_whitespace() || c == ';');
            match self.rest.chars().next() {
                None => return Ok(None),
                Some('#') => self.comment(),
                Some(_) => break,
            }
        }
        let line = self.line;
        let mut command = Command { line, words: vec![], body: None, executed: None };
        loop {
            self.skip(|c| c.is_whitespace() && c != '\n');
            if let Some(rest) = continued(self.rest) {
                self.take(self.rest.len() - rest.len());
                continue;
            }
            match self.rest.chars().next() {
                None | Some('\n' | ';') => return Ok(Some(command)),
                Some('{') => {
                    let line = self.line;
                    let word = self.enclosed('{', '}')?.to_owned();
                    command.words.push(word);
                    command.body = Some(line);
                }
                Some(_) => {
                    let word = self.word(variables, &mut command.executed)?;
                    command.words.push(word);
                    command.body = None;
                }
            }
        }
    }

    /// A word, or one in quotes, with the values of its variables.
    fn word(&mut self, variables: &Variables, executed: &mut Option<String>) -> Result<String> {
        let (quoted, begun) = (self.rest.starts_with('"'), self.line);
        let mut word = String::new();
        if quoted {
            self.take(1);
        }
        while let Some(c) = self.rest.chars().next() {
            match c {
                '"' if quoted => {
                    self.take(1);
                    return Ok(word);
                }
                c if !quoted && (c.is_whitespace() || c == ';') => break,
                '\\' if continued(self.rest).is_some() => break,
                '$' => word += self.variable(variables)?,
                '[' => word += &self.bracket(variables, executed)?,
                c => {
                    word.push(c);
                    self.take(c.len_utf8());
                }
            }
            if word.len() > MOST_LETTERS {
                let what = format!("a word of more than {MOST_LETTERS} letters");
                return Err(self.at().unknown(what));
            }
        }
        if quoted {
            return Err(At::line(self.file, begun).missing("end of a text in quotes"));
        }
        Ok(word)
    }

    /// The value of a variable, `$name` or `${name}`.
    fn variable<'v>(&mut self, variables: &'v Variables) -> Result<&'v str> {
        self.take(1);
        let name = if self.rest.starts_with('{') {
            self.enclosed('{', '}')?
        } else {
            let end = self.rest.find(|c: char| !c.is_alphanumeric() && c != '_');
            self.take(end.unwrap_or(self.rest.len()))
        };
        let value = variables.get(name).map(String::as_str);
        value.ok_or_else(|| {
            self.at().missing(format!("value of the variable {:?}", shortened(name)))
        })
    }

    /// The value of `[expr ...]`; of any other command nothing, and what it is.
    fn bracket(&mut self, variables: &Variables, executed: &mut Option<String>) -> Result<String> {
        let line = self.line;
        let inner = self.enclosed('[', ']')?;
        let Some(arithmetic) = inner.trim_start().strip_prefix("expr ") else {
            *executed = Some(shortened(inner));
            return Ok(String::new());
        };
        let bare = arithmetic.trim();
        let bare = bare.strip_prefix('{').and_then(|bare| bare.strip_suffix('}')).unwrap_or(bare);
        let mut parts = Script::new(self.file, bare, line);
        let mut text = String::new();
        while let Some(c) = parts.rest.chars().next() {
            match c {
                '$' => text += parts.variable(variables)?,
                c => {
                    text.push(c);
                    parts.take(c.len_utf8());
                }
            }
            if text.len() > MOST_LETTERS {
                break;
            }
        }
        expr::value(&text).ok_or_else(|| {
            At::line(self.file, line).unknown(format!("the arithmetic {:?}", shortened(inner)))
        })
    }

    /// What stands between two signs, in which these may stand in pairs.
    fn enclosed(&mut self, open: char, close: char) -> Result<&'a str> {
        let (mut depth, mut escaped) = (0_usize, false);
        for (k, c) in self.rest.char_indices() {
            if !escaped && c == open {
                depth += 1;
            } else if !escaped && c == close {
                depth -= 1;
                if depth == 0 {
                    return Ok(&self.take(k + 1)[1..k]);
                }
            }
            escaped = !escaped && c == '\\';
        }
        Err(self.at().missing(format!("{close:?} that closes {open:?}")))
    }

    /// A comment, which goes on behind a backslash at the end of its line.
    fn comment(&mut self) {
        let mut escaped = false;
        self.skip(|c| {
            let inside = c != '\n' || escaped;
            escaped = if escaped { c == '\r' } else { c == '\\' };
            inside
        });
    }

    fn skip(&mut self, mut skipped: impl FnMut(char) -> bool) {
        let end = self.rest.find(|c| !skipped(c)).unwrap_or(self.rest.len());
        self.take(end);
    }

    fn take(&mut self, bytes: usize) -> &'a str {
        let (taken, rest) = self.rest.split_at(bytes);
        self.rest = rest;
        self.line += taken.matches('\n').count();
        taken
    }

    fn at(&self) -> At<'a> {
        At::line(self.file, self.line)
    }
}

/// What follows a backslash at the end of a line.
fn continued(text: &str) -> Option<&str> {
    text.strip_prefix("\\\n").or_else(|| text.strip_prefix("\\\r\n"))
}
