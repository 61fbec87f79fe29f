//! Problems with a place in the file, and notes about what a conversion left out.
//!
//! Three kinds: an *error* ends the conversion (after the rest of the file has been looked at, so
//! that all of them are told at once); a *fault* is an error by default and a warning when the
//! reader is lenient, and always says what leniency would do; a *note* is something that was
//! dropped or approximated although the file is right.

use std::fmt;

/// Problems kept of each kind; a hostile file could have millions.
const KEPT: usize = 50;

/// One thing wrong with the input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// What is wrong.
    pub message: String,
    /// What to do about it, or what was done.
    pub hint: String,
}

impl fmt::Display for Problem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}: {}", self.line, self.column, self.message)
    }
}

/// Collects what is found while a file is read.
pub(crate) struct Diagnostics<'a> {
    input: &'a str,
    lenient: bool,
    errors: Kept,
    warnings: Kept,
    notes: Vec<(String, usize)>,
}

/// The first problems of a kind, and how many more there were.
#[derive(Default)]
struct Kept {
    list: Vec<Raw>,
    left_out: usize,
}

/// A problem before lines are counted, which takes a pass over the file.
#[derive(PartialEq, Eq)]
struct Raw {
    at: usize,
    message: String,
    hint: String,
}

impl Kept {
    fn add(&mut self, raw: Raw) {
        // The same element is visited once for each of its uses.
        if self.list.contains(&raw) {
            return;
        }
        if self.list.len() == KEPT {
            self.left_out += 1;
        } else {
            self.list.push(raw);
        }
    }

    fn finish(mut self, input: &str) -> Vec<Problem> {
        self.list.sort_by_key(|r| r.at);
        if let (1.., Some(last)) = (self.left_out, self.list.last_mut()) {
            last.hint = format!("{} (and {} more problems)", last.hint, self.left_out);
        }
        let place = |r: Raw| problem(input, r.at, r.message, r.hint);
        self.list.into_iter().map(place).collect()
    }
}

/// What was collected.
pub(crate) struct Findings {
    pub errors: Vec<Problem>,
    pub warnings: Vec<Problem>,
    pub notes: Vec<String>,
}

impl<'a> Diagnostics<'a> {
    pub fn new(input: &'a str, lenient: bool) -> Self {
        Self {
            input,
            lenient,
            errors: Kept::default(),
            warnings: Kept::default(),
            notes: Vec::new(),
        }
    }

    /// Something that no leniency can pass over. `at` is a byte offset into the input.
    pub fn error(&mut self, at: usize, message: impl Into<String>, hint: impl Into<String>) {
        self.errors.add(Raw {
            at,
            message: message.into(),
            hint: hint.into(),
        });
    }

    /// Something that a lenient reader can pass over; `remedy` is a clause that says how.
    pub fn fault(&mut self, at: usize, message: impl Into<String>, remedy: &str) {
        let hint = if self.lenient {
            remedy.to_owned()
        } else {
            format!("with --lenient {remedy}")
        };
        let list = if self.lenient {
            &mut self.warnings
        } else {
            &mut self.errors
        };
        list.add(Raw {
            at,
            message: message.into(),
            hint,
        });
    }

    /// Something that was dropped or approximated. The same text twice is counted.
    pub fn note(&mut self, text: impl Into<String>) {
        let text = text.into();
        if let Some((_, n)) = self.notes.iter_mut().find(|(t, _)| *t == text) {
            *n += 1;
        } else if self.notes.len() < 4 * KEPT {
            self.notes.push((text, 1));
        }
    }

    /// Everything that was found, in the order of the file.
    pub fn finish(self) -> Findings {
        let counted = |(text, n): (String, usize)| match n {
            1 => text,
            n => format!("{text} ({n} times)"),
        };
        Findings {
            errors: self.errors.finish(self.input),
            warnings: self.warnings.finish(self.input),
            notes: self.notes.into_iter().map(counted).collect(),
        }
    }
}

/// A problem at a byte offset.
pub(crate) fn problem(input: &str, at: usize, message: String, hint: String) -> Problem {
    let before = &input.as_bytes()[..at.min(input.len())];
    let start = before
        .iter()
        .rposition(|&b| b == b'\n')
        .map_or(0, |i| i + 1);
    Problem {
        line: 1 + before.iter().filter(|&&b| b == b'\n').count(),
        // Every character has one byte that is not a continuation byte.
        column: 1 + before[start..]
            .iter()
            .filter(|&&b| b & 0xC0 != 0x80)
            .count(),
        message,
        hint,
    }
}
