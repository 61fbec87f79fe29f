//! Errors and notices for people: where, what, and what to do.

use crate::components::SourceSpan;
use bevy_ecs::prelude::*;
use std::borrow::Cow;
use std::fmt;

/// How bad it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Worth knowing; said once.
    Notice,
    /// Something was left out or replaced.
    Warning,
    /// The run cannot start.
    Error,
}

/// One thing to tell the user.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// How bad it is.
    pub severity: Severity,
    /// Where it is, when it is anywhere.
    pub span: Option<SourceSpan>,
    /// The path of the field, such as `entities.gold.Conductor.alpha`; may be empty.
    pub field: String,
    /// What is wrong.
    pub message: String,
    /// What to do about it, such as the nearest valid name.
    pub hint: Option<String>,
}

impl Diagnostic {
    /// A new one without place, field and hint.
    pub fn new(severity: Severity, message: impl Into<String>) -> Self {
        Self {
            severity,
            span: None,
            field: String::new(),
            message: message.into(),
            hint: None,
        }
    }

    /// An error.
    pub fn error(message: impl Into<String>) -> Self {
        Self::new(Severity::Error, message)
    }

    /// A warning.
    pub fn warning(message: impl Into<String>) -> Self {
        Self::new(Severity::Warning, message)
    }

    /// A notice.
    pub fn notice(message: impl Into<String>) -> Self {
        Self::new(Severity::Notice, message)
    }

    /// With its place.
    #[must_use]
    pub fn at(mut self, span: impl Into<Option<SourceSpan>>) -> Self {
        self.span = span.into();
        self
    }

    /// With the path of its field.
    #[must_use]
    pub fn field(mut self, field: impl Into<String>) -> Self {
        self.field = field.into();
        self
    }

    /// With advice.
    #[must_use]
    pub fn hint(mut self, hint: impl Into<String>) -> Self {
        self.hint = Some(hint.into());
        self
    }
}

/// The longest word or quoted text that is printed whole, in characters.
const LONGEST_PIECE: usize = 256;
/// The longest message, field or hint that is printed whole, in characters.
const LONGEST_PART: usize = 2000;

/// For people at a terminal: what a file holds can be long, and can be meant for the terminal.
///
/// Control characters, and those that turn the direction of writing, are escaped as in Rust. The
/// middle of a word or quoted text above 256 characters, and of a message, field or hint above
/// 2000, is left out.
impl fmt::Display for Diagnostic {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Notice => "notice",
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        if let Some(span) = &self.span {
            // Whole, so that programs can find the file.
            write!(f, "{}: ", escaped(&span.to_string()))?;
        }
        write!(f, "{severity}: ")?;
        if !self.field.is_empty() {
            write!(f, "{}: ", printable(&self.field))?;
        }
        f.write_str(&printable(&self.message))?;
        if let Some(hint) = &self.hint {
            write!(f, "; {}", printable(hint))?;
        }
        Ok(())
    }
}

/// Shortened, then escaped: what an escape adds is bounded by what is left.
fn printable(text: &str) -> String {
    let mut short = String::new();
    let mut rest = text;
    while !rest.is_empty() {
        let (piece, after) = next_piece(rest);
        short.push_str(&shortened(piece, LONGEST_PIECE));
        rest = after;
    }
    escaped(&shortened(&short, LONGEST_PART))
}

/// Splits off a quoted text with its quotes, or else a word with the space before it.
fn next_piece(text: &str) -> (&str, &str) {
    let is_quote = |c: char| matches!(c, '`' | '"');
    let first = text.chars().next().filter(|c| is_quote(*c));
    let mut others = text.char_indices().skip(1);
    let end = match first {
        Some(quote) => others
            .find(|(_, c)| *c == quote)
            .map(|(i, c)| i + c.len_utf8()),
        None => others
            .find(|(_, c)| c.is_whitespace() || is_quote(*c))
            .map(|(i, _)| i),
    };
    text.split_at(end.unwrap_or(text.len()))
}

/// Three quarters of the start and one of the end, when a text is longer than `limit` characters.
fn shortened(text: &str, limit: usize) -> Cow<'_, str> {
    let count = text.chars().count();
    if count <= limit {
        return text.into();
    }
    let tail = limit / 4;
    let head = limit - tail;
    let start: String = text.chars().take(head).collect();
    let end: String = text.chars().skip(count - tail).collect();
    format!("{start}…{end}").into()
}

/// Without characters that a terminal obeys instead of showing.
fn escaped(text: &str) -> String {
    // The explicit directional formatting characters of Unicode's annex 9.
    let turns = |c| matches!(c, '\u{61C}' | '\u{200E}' | '\u{200F}' | '\u{202A}'..='\u{202E}' | '\u{2066}'..='\u{2069}');
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() || turns(c) {
            out.extend(c.escape_default());
        } else {
            out.push(c);
        }
    }
    out
}

/// Everything there is to tell, in the order it was found.
#[derive(Resource, Clone, Debug, Default)]
pub struct Diagnostics(pub Vec<Diagnostic>);

impl Diagnostics {
    /// Adds one.
    pub fn push(&mut self, d: Diagnostic) {
        self.0.push(d);
    }

    /// How many errors there are.
    pub fn error_count(&self) -> usize {
        self.0
            .iter()
            .filter(|d| d.severity == Severity::Error)
            .count()
    }

    /// An error when there is any: the last step of a stage that looks at a whole file first.
    pub fn check(&self) -> Result<(), InvalidInput> {
        match self.error_count() {
            0 => Ok(()),
            errors => Err(InvalidInput { errors }),
        }
    }
}

/// The input has errors; [`Diagnostics`] lists them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct InvalidInput {
    /// How many.
    pub errors: usize,
}

impl fmt::Display for InvalidInput {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.errors {
            1 => write!(f, "the input has 1 error"),
            n => write!(f, "the input has {n} errors"),
        }
    }
}

impl std::error::Error for InvalidInput {}

/// The candidate nearest to `name` by edit distance, when it is near enough to be a slip of the
/// pen: at most a third of the letters differ.
pub fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let limit = name.chars().count().max(3) / 3 + 1;
    candidates
        .into_iter()
        .map(|c| (edit_distance(&name.to_lowercase(), &c.to_lowercase()), c))
        .filter(|(d, _)| *d <= limit)
        .min_by_key(|(d, _)| *d)
        .map(|(_, c)| c)
}

/// "did you mean `x`?", or else the list of what is valid.
pub fn suggest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> String {
    let candidates: Vec<&str> = candidates.into_iter().collect();
    if let Some(best) = nearest(name, candidates.iter().copied()) {
        return format!("did you mean `{best}`?");
    }
    match candidates.len() {
        0 => "nothing is valid here".into(),
        // A longer list helps nobody.
        n if n > 24 => format!("there are {n} valid names, `{}` for one", candidates[0]),
        _ => format!("valid here: {}", candidates.join(", ")),
    }
}

/// Insertions, deletions and substitutions that turn `a` into `b` (Levenshtein 1966).
fn edit_distance(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, ca) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, cb) in b.iter().enumerate() {
            let substitute = diagonal + usize::from(ca != *cb);
            diagonal = row[j + 1];
            row[j + 1] = substitute.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_pen_finds_its_name() {
        let names = ["roughness", "reflectance", "ior"];
        assert_eq!(nearest("rougness", names), Some("roughness"));
        assert_eq!(nearest("IOR", names), Some("ior"));
        assert_eq!(nearest("banana", names), None);
        assert_eq!(edit_distance("kitten", "sitting"), 3);
    }

    #[test]
    fn what_a_terminal_would_obey_is_escaped() {
        let d = Diagnostic::error("found `\u{1b}[2J\u{9b}31m\u{202e}`\r\n")
            .at(SourceSpan::file(std::path::Path::new("a\u{7}.ron").into()))
            .field("entities.\u{1b}c")
            .hint("did you mean `ü\t`?");
        assert_eq!(
            d.to_string(),
            "a\\u{7}.ron: error: entities.\\u{1b}c: found `\\u{1b}[2J\\u{9b}31m\\u{202e}`\\r\\n; did \
             you mean `ü\\t`?"
        );
    }

    #[test]
    fn long_pieces_lose_their_middle_and_the_rest_stays() {
        let long = "ä".repeat(100_000);
        let d = Diagnostic::error(format!("found the text \"{long} {long}\", no number"));
        let start = "ä".repeat(191);
        let end = "ä".repeat(63);
        assert_eq!(
            d.to_string(),
            format!("error: found the text \"{start}…{end}\", no number")
        );
        let d = Diagnostic::error(format!("the number {long} is too large"));
        assert_eq!(
            d.to_string(),
            format!("error: the number {start}…{end}ä is too large")
        );
        let unclosed = Diagnostic::error(format!("a lone ` and {long}"));
        assert!(unclosed.to_string().chars().count() < 300);
        let words = Diagnostic::error("word ".repeat(10_000)).field(long);
        assert!(words.to_string().chars().count() < 2400);
    }

    #[test]
    fn a_diagnostic_reads_place_field_message_hint() {
        let d = Diagnostic::error("unknown field")
            .at(SourceSpan {
                file: std::path::Path::new("a.ron").into(),
                line: 3,
                column: 7,
            })
            .field("film.widht")
            .hint("did you mean `width`?");
        assert_eq!(
            d.to_string(),
            "a.ron:3:7: error: film.widht: unknown field; did you mean `width`?"
        );
    }
}
