//! Strings, characters and their escapes.

use super::SyntaxError;
use super::cursor::Cursor;

/// A string in quotes; the cursor stands on the first quote.
pub(super) fn string(cursor: &mut Cursor<'_>) -> Result<String, SyntaxError> {
    let start = cursor.clone();
    cursor.bump();
    let mut text = String::new();
    loop {
        text.push_str(cursor.take_while(|c| !matches!(c, '"' | '\\')));
        match cursor.bump() {
            Some('"') => return Ok(text),
            Some(_) if cursor.rest().starts_with(['\n']) || cursor.rest().starts_with("\r\n") => {
                // A backslash before the end of a line joins it with the next.
                cursor.take_while(|c| matches!(c, ' ' | '\t' | '\r' | '\n'));
            }
            Some(_) => text.push(escape(cursor)?),
            None => return Err(never_closed(&start)),
        }
    }
}

/// A raw string; the cursor stands on the `r`.
pub(super) fn raw_string(cursor: &mut Cursor<'_>) -> Result<String, SyntaxError> {
    let start = cursor.clone();
    cursor.bump();
    let hashes = cursor.take_while(|c| c == '#');
    if !cursor.eat("\"") {
        return Err(cursor.expected("`\"` of a raw string"));
    }
    let end = format!("\"{hashes}");
    let Some(length) = cursor.rest().find(&end) else {
        return Err(never_closed(&start));
    };
    let text = &cursor.rest()[..length];
    cursor.eat(text);
    cursor.eat(&end);
    Ok(text.to_owned())
}

fn never_closed(start: &Cursor<'_>) -> SyntaxError {
    SyntaxError {
        pos: start.pos(),
        message: "this text is never closed by its quote".into(),
    }
}

/// A character in single quotes; the cursor stands on the first.
pub(super) fn character(cursor: &mut Cursor<'_>) -> Result<char, SyntaxError> {
    cursor.bump();
    let c = match cursor.bump() {
        Some('\\') => escape(cursor)?,
        Some(c) => c,
        None => return Err(cursor.expected("a character")),
    };
    if !cursor.eat("'") {
        return Err(cursor.expected("`'`"));
    }
    Ok(c)
}

/// What follows a backslash.
fn escape(cursor: &mut Cursor<'_>) -> Result<char, SyntaxError> {
    let at = cursor.clone();
    let invalid = || at.expected("an escape: one of \\\\ \\\" \\' \\n \\r \\t \\0 \\x41 \\u{3b1}");
    let c = match cursor.bump() {
        Some(c @ ('\\' | '"' | '\'')) => c,
        Some('n') => '\n',
        Some('r') => '\r',
        Some('t') => '\t',
        Some('0') => '\0',
        Some('x') => return byte_escapes(cursor).ok_or_else(invalid),
        Some('u') => {
            if !cursor.eat("{") {
                return Err(invalid());
            }
            let digits = cursor.take_while(|c| c.is_ascii_hexdigit());
            let code = match digits.len() {
                1..=6 => u32::from_str_radix(digits, 16).ok(),
                _ => None,
            };
            let c = code.and_then(char::from_u32).ok_or_else(invalid)?;
            if !cursor.eat("}") {
                return Err(cursor.expected("`}`"));
            }
            c
        }
        _ => return Err(invalid()),
    };
    Ok(c)
}

/// One character as its UTF-8 bytes, `\xce\xb1`; the cursor stands after the first `\x`.
fn byte_escapes(cursor: &mut Cursor<'_>) -> Option<char> {
    let mut bytes = Vec::with_capacity(4);
    loop {
        let high = cursor.bump()?.to_digit(16)?;
        let low = cursor.bump()?.to_digit(16)?;
        bytes.push(u8::try_from(high << 4 | low).ok()?);
        if let Ok(text) = std::str::from_utf8(&bytes) {
            return text.chars().next();
        }
        if bytes.len() == 4 || !cursor.eat("\\x") {
            return None;
        }
    }
}
