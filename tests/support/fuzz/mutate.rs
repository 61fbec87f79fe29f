//! Damage: valid files become files that nobody would write, and that look as if somebody had.
//!
//! Deterministic: the same seed gives the same files. Beside the usual damage to bytes there is what
//! readers of text stumble over: numbers at the ends of their ranges, words taken out, doubled and
//! swapped, values nested deeply, lists of thousands of entries with names of their own.

use super::Target;
use sr_stats::SplitMix;

/// Where numbers end.
const NUMBERS: &[&str] = &[
    "0",
    "-0",
    "1",
    "-1",
    "2",
    "255",
    "256",
    "65535",
    "65536",
    "2147483647",
    "2147483648",
    "-2147483648",
    "4294967295",
    "4294967296",
    "9223372036854775807",
    "-9223372036854775808",
    "18446744073709551615",
    "18446744073709551616",
    "1e-45",
    "1e-38",
    "1.17549e-38",
    "3.4028235e38",
    "3.4028236e38",
    "1e39",
    "1.7976931348623157e308",
    "1e309",
    "-1e309",
    "1e-400",
    "0.1",
    "-0.5",
    "90",
    "180",
    "360",
    "nan",
    "NaN",
    "inf",
    "-inf",
    "0x10",
    "1e",
    "1e+",
    ".",
    "--1",
    "1_0",
    "99999999999999999999999999999999999999999999",
];

/// Words of 32 bits where lengths, counts and floats end.
const WORDS: &[u32] = &[
    0,
    1,
    2,
    0x7f,
    0xff,
    0x100,
    0xffff,
    0x1_0000,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_fffe,
    0xffff_ffff,
    0x7f80_0000,
    0x7fc0_0000,
    0x7f7f_ffff,
    0x0000_8000,
];

/// Inputs stay below this, so that most of a second's cases are not a few large ones.
const LARGEST: usize = 1 << 18;

/// One of several.
fn pick<'t, T>(random: &mut SplitMix, from: &'t [T]) -> &'t T {
    &from[random.below(from.len())]
}

/// A damaged copy of one of the seeds.
pub fn mutate(target: &Target, seeds: &[Vec<u8>], random: &mut SplitMix) -> Vec<u8> {
    let mut bytes = pick(random, seeds).clone();
    for _ in 0..1 + random.below(4) {
        damage(&mut bytes, target, seeds, random);
        bytes.truncate(LARGEST);
    }
    if let Some(repair) = target.repair.filter(|_| random.below(2) == 0) {
        repair(&mut bytes);
    }
    bytes
}

fn damage(bytes: &mut Vec<u8>, target: &Target, seeds: &[Vec<u8>], random: &mut SplitMix) {
    let at = random.below(bytes.len() + 1);
    let end = (at + random.below(40)).min(bytes.len());
    match random.below(32) {
        0 | 1 if at < bytes.len() => bytes[at] ^= 1 << random.below(8),
        2 | 3 if at < bytes.len() => {
            bytes[at] = *pick(
                random,
                &[0, 1, 0x7f, 0x80, 0xff, b'0', b'9', b' ', b'\n', b'"', b'-'],
            );
        }
        4 => drop(bytes.drain(at..end)),
        5 => {
            let piece = bytes[at..end].to_vec();
            let to = random.below(bytes.len() + 1);
            bytes.splice(to..to, piece);
        }
        6 if random.below(4) == 0 => bytes.truncate(at),
        7 => {
            let other = pick(random, seeds);
            let from = random.below(other.len() + 1);
            let to = (from + random.below(200)).min(other.len());
            bytes.splice(at..end, other[from..to].iter().copied());
        }
        8 | 9 if bytes.len() >= 4 => {
            let at = random.below(bytes.len() - 3);
            let word = pick(random, WORDS).to_le_bytes();
            bytes[at..at + 4].copy_from_slice(&word);
        }
        10..=17 => {
            let range = number_from(bytes, at);
            bytes.splice(range, pick(random, NUMBERS).bytes());
        }
        18 | 19 => {
            let range = word_from(bytes, at);
            bytes.splice(range, pick(random, target.words).bytes());
        }
        20 | 21 => bytes
            .splice(at..at, pick(random, target.words).bytes())
            .for_each(drop),
        22 | 23 => drop(bytes.drain(word_from(bytes, at))),
        24 | 25 => {
            let range = word_from(bytes, at);
            let word = bytes[range.clone()].to_vec();
            bytes.splice(range.end..range.end, word);
        }
        26..=28 => swap_words(bytes, at, random),
        29 if !target.nests.is_empty() => nest(bytes, at, target, random),
        30 if random.below(8) == 0 => repeat(bytes, at, random),
        _ => exchange_digit(bytes, at, random),
    }
}

fn is_word(b: u8) -> bool {
    b.is_ascii_alphanumeric() || matches!(b, b'_' | b'.' | b'-' | b'+' | b'#')
}

/// The first run of bytes at or after `at` that begin with `first` and go on with `other`.
fn run_from(
    bytes: &[u8],
    at: usize,
    first: fn(u8) -> bool,
    other: fn(u8) -> bool,
) -> std::ops::Range<usize> {
    let tail = &bytes[at..];
    let start = tail.iter().position(|b| first(*b)).unwrap_or(tail.len());
    let length = tail[start..].iter().position(|b| !other(*b));
    let end = length.map_or(tail.len(), |n| start + n);
    at + start..at + end
}

fn number_from(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let first = |b: u8| b.is_ascii_digit() || b == b'-';
    run_from(bytes, at, first, |b| {
        b.is_ascii_digit() || matches!(b, b'-' | b'.' | b'e')
    })
}

/// A word, or a mark that is none.
fn word_from(bytes: &[u8], at: usize) -> std::ops::Range<usize> {
    let word = run_from(bytes, at, |b| !b.is_ascii_whitespace(), is_word);
    if word.is_empty() && word.start < bytes.len() {
        return word.start..word.start + 1;
    }
    word
}

fn swap_words(bytes: &mut Vec<u8>, at: usize, random: &mut SplitMix) {
    let first = word_from(bytes, at);
    let far = first.end + random.below(bytes.len() + 1 - first.end);
    let second = word_from(bytes, far);
    let (a, b) = (
        bytes[first.clone()].to_vec(),
        bytes[second.clone()].to_vec(),
    );
    bytes.splice(second, a);
    bytes.splice(first, b);
}

fn exchange_digit(bytes: &mut [u8], at: usize, random: &mut SplitMix) {
    if let Some(digit) = bytes[at..].iter_mut().find(|b| b.is_ascii_digit()) {
        *digit = *pick(random, b"0123456789");
    }
}

/// Levels upon levels, around a value or unclosed.
fn nest(bytes: &mut Vec<u8>, at: usize, target: &Target, random: &mut SplitMix) {
    let (open, close) = pick(random, target.nests);
    let depth = *pick(random, &[3, 100, 127, 128, 129, 1000, 20_000]);
    let closed = random.below(4) > 0;
    let word = word_from(bytes, at);
    let mut nested = open.repeat(depth).into_bytes();
    nested.extend(&bytes[word.clone()]);
    if closed {
        nested.extend(close.repeat(depth).bytes());
    }
    bytes.splice(word, nested);
}

/// A line over and over, its digits and quoted texts counted on, so that no two are alike.
fn repeat(bytes: &mut Vec<u8>, at: usize, random: &mut SplitMix) {
    let start = bytes[..at]
        .iter()
        .rposition(|b| *b == b'\n')
        .map_or(0, |i| i + 1);
    let stop = bytes[at..].iter().position(|b| *b == b'\n');
    let end = stop.map_or(bytes.len(), |i| at + i + 1);
    let line = bytes[start..end].to_vec();
    if line.is_empty() {
        return;
    }
    let counts = random.below(3) > 0;
    let mut lines = Vec::new();
    for n in 0..random.below(LARGEST / line.len() + 2) {
        let mark = line
            .iter()
            .position(|b| counts && (b.is_ascii_digit() || *b == b'"'));
        let (before, after) = line.split_at(mark.map_or(line.len(), |m| m + 1));
        lines.extend(before);
        if mark.is_some() {
            lines.extend(n.to_string().bytes());
        }
        lines.extend(after);
    }
    bytes.splice(start..end, lines);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_gives_the_same_damage_and_another_one_another() {
        let target = crate::fuzz::target("scene");
        let seeds = [b"(a: 1, b: \"c\")\n(d: -2.5e3)\n".to_vec(), Vec::new()];
        let many = |seed| -> Vec<Vec<u8>> {
            let mut random = SplitMix::new(seed);
            (0..2000)
                .map(|_| mutate(target, &seeds, &mut random))
                .collect()
        };
        assert_eq!(many(1), many(1));
        assert_ne!(many(1), many(2));
        // Each kind of damage is among them.
        let text: Vec<String> = many(1)
            .iter()
            .map(|b| String::from_utf8_lossy(b).into_owned())
            .collect();
        assert!(text.iter().any(|t| t.contains("18446744073709551616")));
        assert!(text.iter().any(|t| t.contains(&"(".repeat(129))));
        assert!(text.iter().any(|t| t.contains("Environment")));
        assert!(
            text.iter().any(|t| t.contains("1999")),
            "lines are counted on"
        );
        assert!(text.iter().any(|t| t.is_empty()));
    }
}
