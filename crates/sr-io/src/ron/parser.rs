//! Text to tree, by recursive descent.

use super::cursor::{Cursor, is_identifier_continue, is_identifier_start};
use super::{Field, MAX_DEPTH, Node, Number, Pos, SyntaxError, Value, literal};

/// Reads one document.
pub fn parse(text: &str) -> Result<Node, SyntaxError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut parser = Parser {
        cursor: Cursor::new(text),
        depth: 0,
    };
    parser.cursor.skip_space()?;
    while parser.cursor.rest().starts_with('#') {
        parser.attribute()?;
        parser.cursor.skip_space()?;
    }
    let node = parser.value()?;
    parser.cursor.skip_space()?;
    match parser.cursor.peek() {
        None => Ok(node),
        Some(_) => Err(parser.cursor.expected("the end of the text")),
    }
}

/// Extensions of RON. All of them only widen what a typed reader takes; the tree has it all.
const EXTENSIONS: [&str; 4] = [
    "implicit_some",
    "unwrap_newtypes",
    "unwrap_variant_newtypes",
    "explicit_struct_names",
];

struct Parser<'a> {
    cursor: Cursor<'a>,
    depth: usize,
}

impl<'a> Parser<'a> {
    fn expect(&mut self, token: &str) -> Result<(), SyntaxError> {
        self.cursor.skip_space()?;
        if self.cursor.eat(token) {
            return Ok(());
        }
        Err(self.cursor.expected(&format!("`{token}`")))
    }

    /// `#![enable(implicit_some)]` or `#![type = "…"]`.
    fn attribute(&mut self) -> Result<(), SyntaxError> {
        for token in ["#", "!", "["] {
            self.expect(token)?;
        }
        self.cursor.skip_space()?;
        match self.identifier() {
            Some("enable") => self.extensions()?,
            Some("type" | "schema") => {
                self.expect("=")?;
                self.cursor.skip_space()?;
                if self.string()?.is_none() {
                    return Err(self.cursor.expected("a text"));
                }
            }
            _ => return Err(self.cursor.expected("`enable`, `type` or `schema`")),
        }
        self.expect("]")
    }

    fn extensions(&mut self) -> Result<(), SyntaxError> {
        self.expect("(")?;
        loop {
            self.cursor.skip_space()?;
            let here = self.cursor.clone();
            match self.identifier() {
                Some(name) if EXTENSIONS.contains(&name) => {}
                _ => return Err(here.expected(&format!("one of {}", EXTENSIONS.join(", ")))),
            }
            self.cursor.skip_space()?;
            let comma = self.cursor.eat(",");
            self.cursor.skip_space()?;
            if !comma || self.cursor.rest().starts_with(')') {
                return self.expect(")");
            }
        }
    }

    /// A plain or raw identifier, when one stands here.
    fn identifier(&mut self) -> Option<&'a str> {
        let rest = self.cursor.rest();
        if let Some(raw) = rest.strip_prefix("r#") {
            if !raw.starts_with(is_raw_identifier_char) {
                return None;
            }
            self.cursor.eat("r#");
            return Some(self.cursor.take_while(is_raw_identifier_char));
        }
        if !rest.starts_with(is_identifier_start) || rest.starts_with("r\"") {
            return None;
        }
        Some(self.cursor.take_while(is_identifier_continue))
    }

    /// A string of either kind, when one stands here.
    fn string(&mut self) -> Result<Option<String>, SyntaxError> {
        let rest = self.cursor.rest();
        if rest.starts_with('"') {
            return literal::string(&mut self.cursor).map(Some);
        }
        let raw = rest.starts_with('r') && rest[1..].trim_start_matches('#').starts_with('"');
        if raw {
            return literal::raw_string(&mut self.cursor).map(Some);
        }
        Ok(None)
    }

    fn value(&mut self) -> Result<Node, SyntaxError> {
        self.cursor.skip_space()?;
        let pos = self.cursor.pos();
        if self.depth == MAX_DEPTH {
            return Err(SyntaxError {
                pos,
                message: format!("values nest more than {MAX_DEPTH} deep"),
            });
        }
        self.depth += 1;
        let value = self.value_here(pos)?;
        self.depth -= 1;
        Ok(Node { value, pos })
    }

    fn value_here(&mut self, pos: Pos) -> Result<Value, SyntaxError> {
        if let Some(text) = self.string()? {
            return Ok(Value::String(text));
        }
        let rest = self.cursor.rest();
        if rest.starts_with("b\"") || rest.starts_with("br\"") || rest.starts_with("b'") {
            return Err(self
                .cursor
                .expected("a value (byte strings have no use here)"));
        }
        match self.cursor.peek() {
            Some('(') => self.parenthesis(None, pos),
            Some('[') => self.list(pos),
            Some('{') => self.map(pos),
            Some('\'') => literal::character(&mut self.cursor).map(Value::Char),
            Some('0'..='9' | '+' | '-' | '.') => self.number(pos),
            _ => match self.identifier() {
                Some(name) => self.after_identifier(name, pos),
                None => Err(self.cursor.expected("a value")),
            },
        }
    }

    fn number(&mut self, pos: Pos) -> Result<Value, SyntaxError> {
        let start = self.cursor.rest();
        self.cursor.bump();
        let mut previous = start.chars().next();
        while let Some(c) = self.cursor.peek() {
            // A sign belongs to the number after the mark of an exponent only.
            let digits = &start[..start.len() - self.cursor.rest().len()];
            let exponent = matches!(previous, Some('e' | 'E')) && !is_radix(digits);
            if !(is_identifier_continue(c) || c == '.' || exponent && matches!(c, '+' | '-')) {
                break;
            }
            previous = Some(c);
            self.cursor.bump();
        }
        let literal = &start[..start.len() - self.cursor.rest().len()];
        match Number::parse(literal) {
            Ok(number) => Ok(Value::Number(number)),
            Err(message) => Err(SyntaxError { pos, message }),
        }
    }

    fn after_identifier(&mut self, name: &str, pos: Pos) -> Result<Value, SyntaxError> {
        match name {
            "true" => return Ok(Value::Bool(true)),
            "false" => return Ok(Value::Bool(false)),
            "None" => return Ok(Value::None),
            "inf" | "NaN" | "inff32" | "inff64" | "NaNf32" | "NaNf64" => {
                return Number::parse(name)
                    .map(Value::Number)
                    .map_err(|message| SyntaxError { pos, message });
            }
            "Some" => {
                self.expect("(")?;
                let value = self.value()?;
                self.cursor.skip_space()?;
                self.cursor.eat(",");
                self.expect(")")?;
                return Ok(Value::Some(Box::new(value)));
            }
            _ => {}
        }
        // White space may stand between a name and its parenthesis.
        let mut ahead = self.cursor.clone();
        ahead.skip_space()?;
        if !ahead.rest().starts_with('(') {
            return Ok(Value::Name(name.to_owned()));
        }
        self.cursor = ahead;
        self.parenthesis(Some(name.to_owned()), pos)
    }

    /// A struct, a tuple or `()`; the cursor stands on the parenthesis.
    fn parenthesis(&mut self, name: Option<String>, pos: Pos) -> Result<Value, SyntaxError> {
        self.cursor.bump();
        self.cursor.skip_space()?;
        if name.is_none() && self.cursor.eat(")") {
            return Ok(Value::Unit);
        }
        if self.field_stands_here() {
            let fields = self.items(pos, ")", Self::field)?;
            return Ok(Value::Struct { name, fields });
        }
        let items = self.items(pos, ")", Self::value)?;
        Ok(Value::Tuple { name, items })
    }

    /// Whether an identifier and a colon come next.
    fn field_stands_here(&self) -> bool {
        let mut ahead = Parser {
            cursor: self.cursor.clone(),
            depth: 0,
        };
        ahead.identifier().is_some()
            && ahead.cursor.skip_space().is_ok()
            && ahead.cursor.rest().starts_with(':')
    }

    fn field(&mut self) -> Result<Field, SyntaxError> {
        let key_pos = self.cursor.pos();
        let Some(key) = self.identifier().map(str::to_owned) else {
            return Err(self.cursor.expected("the name of a field"));
        };
        self.expect(":")?;
        let value = self.value()?;
        Ok(Field {
            key,
            key_pos,
            value,
        })
    }

    fn list(&mut self, pos: Pos) -> Result<Value, SyntaxError> {
        self.cursor.bump();
        self.items(pos, "]", Self::value).map(Value::List)
    }

    fn map(&mut self, pos: Pos) -> Result<Value, SyntaxError> {
        self.cursor.bump();
        let entry = |parser: &mut Self| {
            let key = parser.value()?;
            parser.expect(":")?;
            Ok((key, parser.value()?))
        };
        self.items(pos, "}", entry).map(Value::Map)
    }

    /// Items with commas between, up to `close`.
    fn items<T>(
        &mut self,
        open: Pos,
        close: &str,
        item: impl Fn(&mut Self) -> Result<T, SyntaxError>,
    ) -> Result<Vec<T>, SyntaxError> {
        let mut items = Vec::new();
        loop {
            self.cursor.skip_space()?;
            if self.cursor.eat(close) {
                return Ok(items);
            }
            if self.cursor.peek().is_none() {
                return Err(SyntaxError {
                    pos: open,
                    message: format!("what opens here is never closed by `{close}`"),
                });
            }
            items.push(item(self)?);
            self.cursor.skip_space()?;
            let ended = self.cursor.peek().is_none() || self.cursor.rest().starts_with(close);
            if !self.cursor.eat(",") && !ended {
                return Err(self.cursor.expected(&format!("`,` or `{close}`")));
            }
        }
    }
}

fn is_radix(digits: &str) -> bool {
    let digits = digits.trim_start_matches(['+', '-']);
    ["0x", "0o", "0b"].iter().any(|p| digits.starts_with(p))
}

fn is_raw_identifier_char(c: char) -> bool {
    is_identifier_continue(c) || matches!(c, '.' | '+' | '-')
}
