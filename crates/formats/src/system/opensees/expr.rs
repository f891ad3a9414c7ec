//! Arithmetic of Tcl's `expr`: numbers, `+ - * / % **`, brackets and functions. Of whole numbers `/` and `%` round down.

/// Brackets within brackets.
const MOST_NESTED: usize = 100;

/// A number of Tcl.
#[derive(Clone, Copy)]
struct Value {
    x: f64,
    whole: bool,
}

struct Reader<'a> {
    rest: &'a str,
    nested: usize,
}

/// The value as Tcl writes it; `None` where it is not arithmetic.
pub(super) fn value(text: &str) -> Option<String> {
    let mut reader = Reader { rest: text, nested: 0 };
    let value = reader.sum()?;
    let done = reader.rest.trim().is_empty() && value.x.is_finite();
    done.then(|| if value.whole { value.x.to_string() } else { format!("{:?}", value.x) })
}

impl Reader<'_> {
    /// Whether a sign is next, which is then read.
    fn sign(&mut self, sign: &str) -> bool {
        let rest = self.rest.trim_start().strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn sum(&mut self) -> Option<Value> {
        self.nested += 1;
        if self.nested > MOST_NESTED {
            return None;
        }
        let mut sum = self.product()?;
        loop {
            let minus = self.sign("-");
            if !minus && !self.sign("+") {
                self.nested -= 1;
                return Some(sum);
            }
            let next = self.product()?;
            let x = if minus { sum.x - next.x } else { sum.x + next.x };
            sum = Value { x, whole: sum.whole && next.whole };
        }
    }

    fn product(&mut self) -> Option<Value> {
        let mut product = self.signed()?;
        loop {
            let divided = self.sign("/");
            let rest = !divided && self.sign("%");
            if !divided && !rest && !self.sign("*") {
                return Some(product);
            }
            let next = self.signed()?;
            let whole = product.whole && next.whole;
            let x = match () {
                () if rest => product.x - next.x * (product.x / next.x).floor(),
                () if divided && whole => (product.x / next.x).floor(),
                () if divided => product.x / next.x,
                () => product.x * next.x,
            };
            product = Value { x, whole };
        }
    }

    /// A sign binds tighter than a power.
    fn signed(&mut self) -> Option<Value> {
        let mut minus = false;
        loop {
            if self.sign("-") {
                minus = !minus;
            } else if !self.sign("+") {
                break;
            }
        }
        let base = self.atom()?;
        let base = Value { x: if minus { -base.x } else { base.x }, ..base };
        if !self.sign("**") {
            return Some(base);
        }
        let power = self.signed()?;
        let whole = base.whole && power.whole && power.x >= 0.0;
        Some(Value { x: base.x.powf(power.x), whole })
    }

    fn atom(&mut self) -> Option<Value> {
        if self.sign("(") {
            let value = self.sum()?;
            return self.sign(")").then_some(value);
        }
        let text = self.rest.trim_start();
        if text.starts_with(|c: char| c.is_ascii_alphabetic()) {
            return self.function();
        }
        let mut end = 0;
        for (k, c) in text.char_indices() {
            let exponent = text[..k].ends_with(['e', 'E']) && (c == '-' || c == '+');
            if !(c.is_ascii_digit() || ".eE".contains(c) || exponent) {
                break;
            }
            end = k + c.len_utf8();
        }
        let (number, rest) = text.split_at(end);
        self.rest = rest;
        Some(Value { x: number.parse().ok()?, whole: !number.contains(['.', 'e', 'E']) })
    }

    fn function(&mut self) -> Option<Value> {
        let (name, rest) = self.rest.trim_start().split_once('(')?;
        self.rest = rest;
        let first = self.sum()?;
        let second = if self.sign(",") { Some(self.sum()?.x) } else { None };
        let x = first.x;
        let found = match (name.trim_end(), second) {
            ("sqrt", None) => x.sqrt(),
            ("sin", None) => x.sin(),
            ("cos", None) => x.cos(),
            ("tan", None) => x.tan(),
            ("asin", None) => x.asin(),
            ("acos", None) => x.acos(),
            ("atan", None) => x.atan(),
            ("exp", None) => x.exp(),
            ("log", None) => x.ln(),
            ("double", None) => x,
            ("abs", None) => return self.sign(")").then_some(Value { x: x.abs(), ..first }),
            ("pow", Some(y)) => x.powf(y),
            ("hypot", Some(y)) => x.hypot(y),
            ("atan2", Some(y)) => x.atan2(y),
            _ => return None,
        };
        self.sign(")").then_some(Value { x: found, whole: false })
    }
}
