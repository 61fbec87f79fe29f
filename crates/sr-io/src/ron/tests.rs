use super::*;

/// Documents that RON accepts; each exercises something.
const VALID: &[&str] = &[
    "()",
    "( )",
    "(a: 1, b: (c: [1, 2, 3,], ), )",
    "Name",
    "Name()",
    "Name(1, 2.5, \"x\",)",
    "Name ( a : 1 )",
    "(a, b)",
    "{\"a\": 1, 'c': 2, (1, 2): 3,}",
    "[]",
    "{}",
    "Some(1)",
    "Some( (1,2) , )",
    "None",
    "[true, false]",
    "[1, -1, +1, 0x1F, -0x1f, 0b1010, 0o17, 1_000, 1_]",
    "[1.0, .5, 5., 1e5, 1E-5, 1.5e+3, 1_0.2_5e1_0, -0.0]",
    "[inf, -inf, +inf, NaN, inff32, 1f32, 1.5f64, -inff64]",
    "[1u8, 255u8, -128i8, 0xffu8, 18446744073709551615]",
    "[1e999, 123456789012345678901234567890]",
    r#"["a\"b\\\n\r\t\0\x41\u{3b1}\xce\xb1", 'a', '\'', '\\', '"', '\u{3b1}', ''']"#,
    "\"a\\\n   b\"",
    "\"a\\\r\n   b\"",
    "r\"a\\b\"",
    "r##\"a\"#b\"##",
    "/* a /* b */ c */ (a: 1) // end",
    "(// x\n a/**/:/**/1/*,*/, /*)*/b: 2)",
    "#![enable(implicit_some)]\n(a: 1)",
    "#![enable(implicit_some, unwrap_newtypes,)]\n#![enable(unwrap_variant_newtypes)] ()",
    "# ! [ type = \"a::B\" ] #![schema = r\"b\"] (a: 1)",
    "(r#type: 1, r#a-b.c: 2)",
    "Größe(länge: 1)",
    "(a: r#b)",
    "(r: 1, br: 2, b: 3, inf_: 4, true_: 5)",
    "\"\u{2028}\"",
    "\u{2028}\u{200e}()\u{85}",
    "(a: 1, a: 2)",
    "Some(Some(None))",
    "(((1)))",
];

/// Documents that RON refuses.
const INVALID: &[&str] = &[
    "",
    "   ",
    "// only a comment",
    "(",
    ")",
    "(a: )",
    "(a 1)",
    "(a: 1 b: 2)",
    "(,)",
    "(a: 1,, b: 2)",
    "[1 2]",
    "[1, 2",
    "{1}",
    "{1: }",
    "{1: 2, 3}",
    "() ()",
    "\"abc",
    "r#\"abc\"",
    "\"\\q\"",
    "\"\\u{110000}\"",
    "\"\\u{}\"",
    "\"\\x4\"",
    "\"\\xff\"",
    "'ab'",
    "'a",
    "/* open",
    "/ 1",
    "_1.5.5",
    "1.5.5",
    "1e",
    "0b12",
    "0o8",
    "256u8",
    "-1u8",
    "1__.5_.",
    "._5",
    ".",
    "-",
    "+-1",
    "#![enable(nonsense)] ()",
    "#![enable()] ()",
    "#![enable(implicit_some] ()",
    "#[enable(implicit_some)] ()",
    "Some",
    "Some()",
    "Some(1, 2)",
    "(a: 1; b: 2)",
    "@",
    "(a: 1, 2)",
    "a-b",
    "Name(a: 1, 2)",
];

fn oracle(text: &str) -> Result<ron::Value, String> {
    ron::from_str::<ron::Value>(text).map_err(|e| e.to_string())
}

#[test]
fn the_ron_crate_accepts_the_same_documents() {
    let differing: Vec<_> = (VALID.iter().map(|t| (t, true)))
        .chain(INVALID.iter().map(|t| (t, false)))
        .filter(|(t, valid)| oracle(t).is_ok() != *valid || parse(t).is_ok() != *valid)
        .map(|(t, _)| (t, oracle(t), parse(t)))
        .collect();
    assert!(differing.is_empty(), "{differing:#?}");
}

#[test]
fn what_is_written_reads_back_as_the_same_tree() {
    for text in VALID {
        let Ok(node) = parse(text) else { continue };
        let again = parse(&node.to_string()).unwrap_or_else(|e| panic!("{node}: {e}"));
        assert_eq!(again.to_string(), node.to_string());
        assert!(oracle(&node.to_string()).is_ok(), "{node}");
    }
}

/// A small generator (SplitMix64): the tests below are the same at each run.
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut x = self.0;
        x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        usize::try_from((x ^ (x >> 31)) % n as u64).expect("below a usize")
    }
}

/// Slips of the pen: characters go, come, repeat or change.
fn mutate(text: &str, random: &mut Random) -> String {
    const ALPHABET: &[char] = &[
        '(', ')', '[', ']', '{', '}', ',', ':', '"', '\'', '\\', '/', '*', '#', '!', 'r', 'a', 'e',
        '0', '1', '.', '_', '-', '+', 'x', 'ß', '\u{2028}', ' ', '\n', 'S', 'N', '\0', 'u', '😀',
    ];
    let mut chars: Vec<char> = text.chars().collect();
    for _ in 0..=random.below(3) {
        let at = random.below(chars.len() + 1);
        let new = ALPHABET[random.below(ALPHABET.len())];
        match random.below(4) {
            0 => chars.insert(at, new),
            1 if at < chars.len() => {
                chars.remove(at);
            }
            2 if at < chars.len() => chars[at] = new,
            3 => chars.truncate(at),
            _ => {}
        }
    }
    chars.into_iter().collect()
}

/// Byte strings and ranges are RON that this reader refuses.
fn has_use_here(text: &str) -> bool {
    !["b\"", "b'", "br", ".."].iter().any(|t| text.contains(t))
}

#[test]
fn mutated_documents_never_panic_and_agree_with_the_ron_crate() {
    let mut random = Random(1);
    let mut differing = Vec::new();
    for i in 0..60_000 {
        let text = mutate(VALID[i % VALID.len()], &mut random);
        let ours = parse(&text);
        if has_use_here(&text) && ours.is_ok() != oracle(&text).is_ok() {
            differing.push((text.clone(), oracle(&text), ours.map(|n| n.to_string())));
        }
    }
    assert!(differing.is_empty(), "{} {differing:#?}", differing.len());
}

#[test]
fn syntax_errors_name_place_and_what_was_expected() {
    for (text, expected) in [
        (
            "(\n  a: 1\n  b: 2,\n)",
            "3:3: expected `,` or `)`, found `b`",
        ),
        (
            "(\n  a: [1, 2,\n",
            "2:6: what opens here is never closed by `]`",
        ),
        ("(a: 1e)", "1:5: `1e` is not a number"),
        ("(ä: @)", "1:5: expected a value, found `@`"),
        ("() 1", "1:4: expected the end of the text, found `1`"),
        ("{\"a\" 1}", "1:6: expected `:`, found `1`"),
        ("\n \"abc", "2:2: this text is never closed by its quote"),
        ("/* /* */", "1:1: this comment is never closed by `*/`"),
        ("", "1:1: expected a value, found the end of the text"),
        ("300u8", "1:1: 300 does not fit its type u8"),
        (
            "b\"x\"",
            "1:1: expected a value (byte strings have no use here), found `b`",
        ),
    ] {
        let error = parse(text).expect_err(text).to_string();
        assert_eq!(error, expected, "{text}");
    }
}

#[test]
fn deep_nesting_is_an_error_and_not_an_overflow() {
    let nested = |n: usize| format!("{}1{}", "[".repeat(n), "]".repeat(n));
    assert!(parse(&nested(MAX_DEPTH - 1)).is_ok());
    let error = parse(&nested(MAX_DEPTH)).expect_err("too deep");
    assert_eq!(error.message, "values nest more than 128 deep");
    assert!(parse(&"(".repeat(1_000_000)).is_err());
    assert!(parse(&"/*".repeat(1_000_000)).is_err());
}

#[test]
fn numbers_round_once_and_integers_are_exact() {
    let number = |text: &str| match parse(text).expect(text).value {
        Value::Number(n) => n,
        other => panic!("{other:?}"),
    };
    assert_eq!(number("18446744073709551615").to_integer(), Some(u64::MAX));
    assert_eq!(
        number("-9_223_372_036_854_775_808").to_integer(),
        Some(i64::MIN)
    );
    assert_eq!(number("-0x10").to_integer(), Some(-16));
    assert_eq!(number("300").to_integer::<u8>(), None);
    assert_eq!(number("1.0").to_integer::<u8>(), None);
    // Just above halfway between 1 and the next f32: by way of f64 it would round down.
    let text = "1.000000059604644775390626";
    assert_eq!(number(text).to_f32(), 1.0 + f32::EPSILON);
    assert_eq!(number(text).to_f64() as f32, 1.0);
    assert_eq!(number("1e999").to_f64(), f64::INFINITY);
    assert!(!number("1e999").is_infinite() && number("-inf").is_infinite());
}

#[test]
fn values_know_their_places() {
    let node = parse("// x\n(a: 1,\n ß: Some([2, \"y\"]))").expect("valid");
    assert_eq!(node.pos, Pos { line: 2, column: 1 });
    let Value::Struct { fields, .. } = node.value else {
        panic!("a struct")
    };
    assert_eq!(fields[1].key_pos, Pos { line: 3, column: 2 });
    let Value::Some(inner) = &fields[1].value.value else {
        panic!("an option")
    };
    let Value::List(items) = &inner.value else {
        panic!("a list")
    };
    assert_eq!(
        items[1].pos,
        Pos {
            line: 3,
            column: 14
        }
    );
}
