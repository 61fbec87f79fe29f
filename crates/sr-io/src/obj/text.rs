//! Lines and words of OBJ and MTL text, with their places.

use std::borrow::Cow;

/// A line, with those joined to it that a `\` at its end continues.
#[derive(Debug)]
pub(super) struct Line<'t> {
    /// Number of the first of them, from 1.
    pub(super) number: u32,
    text: Cow<'t, str>,
}

/// A word and where it starts in its line.
#[derive(Clone, Copy, Debug)]
pub(super) struct Word<'l> {
    pub(super) text: &'l str,
    start: usize,
}

impl Line<'_> {
    /// Words up to a comment.
    pub(super) fn words(&self) -> impl Iterator<Item = Word<'_>> {
        let end = self.text.find('#').unwrap_or(self.text.len());
        self.text[..end]
            .split_ascii_whitespace()
            .map(|w| self.word(w))
    }

    /// All behind the first word, with its spaces: a name. Empty when there is none.
    pub(super) fn name(&self) -> Word<'_> {
        let line = self.text.trim_ascii();
        let first = line
            .find(|c: char| c.is_ascii_whitespace())
            .unwrap_or(line.len());
        self.word(line[first..].trim_ascii())
    }

    fn word<'l>(&'l self, part: &'l str) -> Word<'l> {
        // A part of the line's own text, so its address tells where.
        Word {
            text: part,
            start: part.as_ptr() as usize - self.text.as_ptr() as usize,
        }
    }

    /// The column of a word, from 1. It takes time on long lines, so only errors ask for it.
    pub(super) fn column(&self, word: Word<'_>) -> u32 {
        let column = self.text[..word.start].chars().count() + 1;
        u32::try_from(column).unwrap_or(u32::MAX)
    }
}

/// The lines of a text, continued ones joined.
pub(super) fn lines(text: &str) -> impl Iterator<Item = Line<'_>> {
    let mut physical = text.split('\n').map(|l| l.strip_suffix('\r').unwrap_or(l));
    let mut number = 0u32;
    std::iter::from_fn(move || {
        let mut part = physical.next()?;
        number = number.saturating_add(1);
        let first = number;
        let Some(head) = part.strip_suffix('\\') else {
            return Some(Line {
                number: first,
                text: part.into(),
            });
        };
        let mut joined = head.to_string();
        while part.ends_with('\\') {
            let Some(next) = physical.next() else { break };
            number = number.saturating_add(1);
            part = next;
            joined.push(' ');
            joined += part.strip_suffix('\\').unwrap_or(part);
        }
        Some(Line {
            number: first,
            text: joined.into(),
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn continued_lines_are_joined_and_numbered_by_their_first() {
        let seen: Vec<_> = lines("a b\\\n c \\\r\nd # e\n\nf\\")
            .map(|l| {
                (
                    l.number,
                    l.words()
                        .map(|w| (w.text.to_string(), l.column(w)))
                        .collect::<Vec<_>>(),
                )
            })
            .collect();
        let word = |t: &str, c| (t.to_string(), c);
        assert_eq!(
            seen[0],
            (
                1,
                vec![word("a", 1), word("b", 3), word("c", 6), word("d", 9)]
            )
        );
        assert_eq!(seen[1], (4, vec![]));
        assert_eq!(seen[2], (5, vec![word("f", 1)]));
    }

    #[test]
    fn names_keep_their_spaces() {
        let line = lines("usemtl  red ä #2 \n").next().unwrap();
        let name = line.name();
        assert_eq!((name.text, line.column(name)), ("red ä #2", 9));
        assert_eq!(lines(" g ").next().unwrap().name().text, "");
    }
}
