//! Numbers keep their text, so that each target type rounds it once.

use std::fmt;

/// A number as written.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    /// Without underscores and type suffix; `inf` and `NaN` keep their sign.
    text: String,
    /// Sign (true is negative) and magnitude, when it is an integer that fits.
    integer: Option<(bool, u128)>,
}

const SUFFIXES: [&str; 12] = [
    "i128", "u128", "i16", "i32", "i64", "u16", "u32", "u64", "f32", "f64", "i8", "u8",
];

impl Number {
    /// Understands a literal such as `-1_000`, `0x1f`, `2.5e-3`, `1u8`, `-inf`.
    pub fn parse(literal: &str) -> Result<Self, String> {
        let (negative, body) = match literal.as_bytes().first() {
            Some(b'-') => (true, &literal[1..]),
            Some(b'+') => (false, &literal[1..]),
            _ => (false, literal),
        };
        for (prefix, radix) in [("0x", 16), ("0o", 8), ("0b", 2)] {
            if let Some(digits) = body.strip_prefix(prefix) {
                return Self::parse_radix(literal, negative, digits, radix);
            }
        }
        let (body, suffix) = split_suffix(body);
        let sign = if negative { "-" } else { "" };
        if matches!(body, "inf" | "NaN") {
            return Ok(Self {
                text: format!("{sign}{body}"),
                integer: None,
            });
        }
        let invalid = || format!("`{literal}` is not a number");
        // An underscore follows a digit or the mark of an exponent, never a point.
        let mut after_digit = false;
        for c in body.chars() {
            match c {
                '_' if !after_digit => return Err(invalid()),
                '0'..='9' | 'e' | 'E' => after_digit = true,
                '.' => after_digit = false,
                _ => {}
            }
        }
        let digits: String = body.chars().filter(|c| *c != '_').collect();
        let plain = digits.bytes().all(|b| b.is_ascii_digit()) && !digits.is_empty();
        let integral_suffix = suffix.is_some_and(|s| !s.starts_with('f'));
        let starts_well = digits.starts_with(|c: char| c.is_ascii_digit() || c == '.');
        if !starts_well || digits.parse::<f64>().is_err() || integral_suffix && !plain {
            return Err(invalid());
        }
        let integer = if plain {
            digits.parse().ok().map(|m| (negative, m))
        } else {
            None
        };
        Self {
            text: format!("{sign}{digits}"),
            integer,
        }
        .fits_suffix(suffix)
    }

    fn parse_radix(
        literal: &str,
        negative: bool,
        digits: &str,
        radix: u32,
    ) -> Result<Self, String> {
        let (digits, suffix) = match digits.find(['i', 'u']) {
            Some(at) => (&digits[..at], Some(&digits[at..])),
            None => (digits, None),
        };
        let bare: String = digits.chars().filter(|c| *c != '_').collect();
        let known = suffix.is_none_or(|s| SUFFIXES.contains(&s));
        if digits.starts_with('_') || !known || !bare.chars().all(|c| c.is_digit(radix)) {
            return Err(format!("`{literal}` is not a number of base {radix}"));
        }
        let magnitude = u128::from_str_radix(&bare, radix)
            .map_err(|_| format!("`{literal}` is not a number of base {radix}, or too long"))?;
        Self::integer(negative, magnitude).fits_suffix(suffix)
    }

    fn fits_suffix(self, suffix: Option<&str>) -> Result<Self, String> {
        let fits = match suffix {
            Some("i8") => self.to_integer::<i8>().is_some(),
            Some("i16") => self.to_integer::<i16>().is_some(),
            Some("i32") => self.to_integer::<i32>().is_some(),
            Some("i64") => self.to_integer::<i64>().is_some(),
            Some("u8") => self.to_integer::<u8>().is_some(),
            Some("u16") => self.to_integer::<u16>().is_some(),
            Some("u32") => self.to_integer::<u32>().is_some(),
            Some("u64") => self.to_integer::<u64>().is_some(),
            _ => true,
        };
        if fits {
            Ok(self)
        } else {
            Err(format!(
                "{self} does not fit its type {}",
                suffix.unwrap_or("")
            ))
        }
    }

    /// An integer by sign and magnitude.
    pub fn integer(negative: bool, magnitude: u128) -> Self {
        let sign = if negative { "-" } else { "" };
        Self {
            text: format!("{sign}{magnitude}"),
            integer: Some((negative, magnitude)),
        }
    }

    /// Whether it is written as an integer.
    pub fn is_integer(&self) -> bool {
        self.integer.is_some()
    }

    /// As an integer type, when it is one and fits.
    pub fn to_integer<T: TryFrom<i128>>(&self) -> Option<T> {
        let (negative, magnitude) = self.integer?;
        let magnitude = i128::try_from(magnitude).ok()?;
        T::try_from(if negative { -magnitude } else { magnitude }).ok()
    }

    /// The nearest `f32`, rounded once; infinite when it is too large.
    pub fn to_f32(&self) -> f32 {
        self.text
            .parse()
            .expect("the text was checked when it was read")
    }

    /// The nearest `f64`, rounded once; infinite when it is too large.
    pub fn to_f64(&self) -> f64 {
        self.text
            .parse()
            .expect("the text was checked when it was read")
    }

    /// Whether infinity is what was written, rather than a number too large.
    pub fn is_infinite(&self) -> bool {
        self.text.ends_with("inf")
    }
}

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

fn split_suffix(body: &str) -> (&str, Option<&str>) {
    for suffix in SUFFIXES {
        if let Some(digits) = body.strip_suffix(suffix)
            && !digits.is_empty()
        {
            return (digits, Some(suffix));
        }
    }
    (body, None)
}
