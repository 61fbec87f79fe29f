//! A place in a text that moves forward: characters, white space and comments.

use super::{Pos, SyntaxError};

/// Reads a text from front to back.
#[derive(Clone)]
pub(super) struct Cursor<'a> {
    rest: &'a str,
    pos: Pos,
}

impl<'a> Cursor<'a> {
    pub fn new(text: &'a str) -> Self {
        Self {
            rest: text,
            pos: Pos { line: 1, column: 1 },
        }
    }

    pub fn pos(&self) -> Pos {
        self.pos
    }

    pub fn rest(&self) -> &'a str {
        self.rest
    }

    pub fn peek(&self) -> Option<char> {
        self.rest.chars().next()
    }

    pub fn bump(&mut self) -> Option<char> {
        let c = self.peek()?;
        self.rest = &self.rest[c.len_utf8()..];
        if c == '\n' {
            self.pos.line += 1;
            self.pos.column = 1;
        } else {
            self.pos.column += 1;
        }
        Some(c)
    }

    /// Passes over `token` when it stands here.
    pub fn eat(&mut self, token: &str) -> bool {
        let here = self.rest.starts_with(token);
        if here {
            token.chars().for_each(|_| {
                self.bump();
            });
        }
        here
    }

    /// Passes over all characters that `accept` takes.
    pub fn take_while(&mut self, accept: impl Fn(char) -> bool) -> &'a str {
        let start = self.rest;
        while self.peek().is_some_and(&accept) {
            self.bump();
        }
        &start[..start.len() - self.rest.len()]
    }

    /// Passes over white space and comments.
    pub fn skip_space(&mut self) -> Result<(), SyntaxError> {
        loop {
            self.take_while(is_space);
            if self.rest.starts_with("//") {
                self.take_while(|c| c != '\n');
            } else if self.rest.starts_with("/*") {
                self.skip_block_comment()?;
            } else {
                return Ok(());
            }
        }
    }

    fn skip_block_comment(&mut self) -> Result<(), SyntaxError> {
        let start = self.pos;
        let mut depth = 0u32;
        loop {
            if self.eat("/*") {
                depth += 1;
            } else if self.eat("*/") {
                depth -= 1;
                if depth == 0 {
                    return Ok(());
                }
            } else if self.bump().is_none() {
                return Err(SyntaxError {
                    pos: start,
                    message: "this comment is never closed by `*/`".into(),
                });
            }
        }
    }

    /// "expected ..., found what stands here".
    pub fn expected(&self, what: &str) -> SyntaxError {
        SyntaxError {
            pos: self.pos,
            message: format!("expected {what}, found {}", self.found()),
        }
    }

    fn found(&self) -> String {
        match self.peek() {
            None => "the end of the text".into(),
            Some(c) if is_identifier_start(c) => {
                format!("`{}`", self.clone().take_while(is_identifier_continue))
            }
            Some(c) => format!("`{}`", c.escape_debug()),
        }
    }
}

/// RON's white space: Unicode's Pattern_White_Space.
fn is_space(c: char) -> bool {
    matches!(
        c,
        '\t'..='\r' | ' ' | '\u{85}' | '\u{200e}' | '\u{200f}' | '\u{2028}' | '\u{2029}'
    )
}

pub(super) fn is_identifier_start(c: char) -> bool {
    c == '_' || c.is_alphabetic()
}

pub(super) fn is_identifier_continue(c: char) -> bool {
    c == '_' || c.is_alphanumeric()
}
