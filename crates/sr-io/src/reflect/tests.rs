use super::*;
use crate::ron::parse;
use bevy_ecs::entity::Entity;
use bevy_reflect::std_traits::ReflectDefault;
use bevy_reflect::{Reflect, TypeRegistry};
use sr_scene::components::Rgb;
use sr_scene::diagnostics::Diagnostic;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

#[derive(Reflect, Clone, Debug, PartialEq, Default)]
#[reflect(Default)]
enum Shape {
    #[default]
    Nothing,
    Disk {
        radius: f32,
        hole: Option<f32>,
    },
    Pair(u8, f64),
}

#[derive(Reflect, Clone, Debug, PartialEq)]
struct Link(Entity);

#[derive(Reflect, Clone, Debug, PartialEq)]
struct Thing {
    small: u8,
    large: u64,
    signed: i16,
    float: f32,
    double: f64,
    flag: bool,
    letter: char,
    name: String,
    file: PathBuf,
    color: Rgb,
    crop: Option<[u32; 4]>,
    depth: Option<u32>,
    pair: (u8, String),
    list: Vec<[f32; 2]>,
    shapes: Vec<Shape>,
    map: BTreeMap<String, f64>,
    shape: Shape,
    link: Link,
    inner: Inner,
}

#[derive(Reflect, Clone, Debug, PartialEq, Default)]
#[reflect(Default)]
struct Inner {
    a: f64,
    b: Option<Rgb>,
}

fn thing() -> Thing {
    Thing {
        small: 1,
        large: 2,
        signed: 3,
        float: 4.0,
        double: 5.0,
        flag: false,
        letter: 'a',
        name: "n".into(),
        file: PathBuf::new(),
        color: Rgb([1.0, 2.0, 3.0]),
        crop: None,
        depth: Some(3),
        pair: (1, "p".into()),
        list: vec![[0.0, 1.0]],
        shapes: vec![],
        map: BTreeMap::new(),
        shape: Shape::Nothing,
        link: Link(Entity::PLACEHOLDER),
        inner: Inner::default(),
    }
}

const GOLD: u64 = 7;

fn run(text: &str, steps: &str, is_file: bool) -> (Thing, Vec<Diagnostic>, Places) {
    let mut registry = TypeRegistry::new();
    registry.register::<Thing>();
    let mut origin = Origin::file(Path::new("dir/t.ron"));
    origin.is_file = is_file;
    let mut places = Places::default();
    let mut diagnostics = Vec::new();
    let mut thing = thing();
    let mut context = Context {
        registry: &registry,
        origin: &origin,
        entity: &|name| match name {
            "gold" => Ok(Entity::from_bits(GOLD)),
            "lost" => Err(None),
            other => Err(Some(sr_scene::diagnostics::suggest(other, ["gold"]))),
        },
        places: &mut places,
        diagnostics: &mut diagnostics,
        unresolved: false,
    };
    let node = parse(text).expect("valid RON");
    let steps = parse_steps(steps).expect("valid path");
    context.apply_at(&mut thing, &steps, node.pos, &node, &FieldPath::Root("t"));
    (thing, diagnostics, places)
}

fn applied(text: &str) -> Thing {
    let (thing, diagnostics, _) = run(text, "", true);
    assert!(diagnostics.is_empty(), "{text}: {diagnostics:?}");
    thing
}

fn complaints(text: &str) -> Vec<String> {
    let (_, diagnostics, _) = run(text, "", true);
    diagnostics.iter().map(ToString::to_string).collect()
}

#[test]
fn every_kind_of_field_takes_its_value() {
    let got = applied(
        r#"Thing(
            small: 0xff, large: 18446744073709551615, signed: -5, float: 1, double: 1e-3,
            flag: true, letter: 'ß', name: "x", file: "a/b.png", color: 0.5,
            crop: (0, 1, 2, 3), depth: None, pair: (2, "q"), list: [(1, 2), [3, 4], 5],
            shapes: [Nothing, Disk(radius: 2), Pair(1, 2)], map: {"k": 1, "l.m": 2},
            shape: Disk(radius: 1.5, hole: 0.5), link: "gold", inner: (b: (1, 2, 3)),
        )"#,
    );
    let expected = Thing {
        small: 255,
        large: u64::MAX,
        signed: -5,
        float: 1.0,
        double: 1e-3,
        flag: true,
        letter: 'ß',
        name: "x".into(),
        file: "dir/a/b.png".into(),
        color: Rgb::splat(0.5),
        crop: Some([0, 1, 2, 3]),
        depth: None,
        pair: (2, "q".into()),
        list: vec![[1.0, 2.0], [3.0, 4.0], [5.0, 5.0]],
        shapes: vec![
            Shape::Nothing,
            Shape::Disk {
                radius: 2.0,
                hole: None,
            },
            Shape::Pair(1, 2.0),
        ],
        map: BTreeMap::from([("k".into(), 1.0), ("l.m".into(), 2.0)]),
        shape: Shape::Disk {
            radius: 1.5,
            hole: Some(0.5),
        },
        link: Link(Entity::from_bits(GOLD)),
        inner: Inner {
            a: 0.0,
            b: Some(Rgb([1.0, 2.0, 3.0])),
        },
    };
    assert_eq!(got, expected);
}

#[test]
fn what_is_not_named_stays() {
    assert_eq!(applied("()"), thing());
    assert_eq!(applied("Thing"), thing());
    let got = applied("(depth: Some(9), crop: [1, 2, 3, 4])");
    let expected = Thing {
        depth: Some(9),
        crop: Some([1, 2, 3, 4]),
        ..thing()
    };
    assert_eq!(got, expected);
}

#[test]
fn each_mistake_is_told_with_its_place_and_the_others_still_count() {
    let (got, diagnostics, _) = run(
        "(\n small: 300,\n flot: 1,\n large: 1.5,\n double: \"x\",\n color: (1, 2),\n \
         shape: Dsk(radius: 1),\n link: \"gould\",\n flag: true,\n flag: false,\n)",
        "",
        true,
    );
    let got_texts: Vec<String> = diagnostics.iter().map(ToString::to_string).collect();
    assert_eq!(
        got_texts,
        [
            "dir/t.ron:2:9: error: t.small: 300 is out of range: 0 to 255",
            "dir/t.ron:3:2: error: t.flot: unknown field of Thing; did you mean `float`?",
            "dir/t.ron:4:9: error: t.large: expected a whole number, found 1.5",
            "dir/t.ron:5:10: error: t.double: expected a number, found the text \"x\"",
            "dir/t.ron:6:9: error: t.color: expected 3 values, found 2",
            "dir/t.ron:7:9: error: t.shape: there is no `Dsk` here; did you mean `Disk`?",
            "dir/t.ron:8:8: error: t.link: there is no entity `gould`; did you mean `gold`?",
            "dir/t.ron:10:2: error: t.flag: the field is set twice",
        ]
    );
    assert!(got.flag);
}

#[test]
fn wrong_values_are_refused_with_reasons() {
    for (text, expected) in [
        ("(float: 1e40)", "1:9: error: t.float: 1e40 is too large"),
        ("(float: NaN)", "1:9: error: t.float: NaN is no number"),
        (
            "(signed: -40000)",
            "1:10: error: t.signed: -40000 is out of range: -32768 to 32767",
        ),
        (
            "(flag: 1)",
            "1:8: error: t.flag: expected `true` or `false`, found the number 1",
        ),
        (
            "(shape: \"Disk\")",
            "1:9: error: t.shape: expected one of Nothing, Disk, Pair, found a text; write Disk without quotes",
        ),
        (
            "(shape: Disk)",
            "1:9: error: t.shape: `Disk` needs the field `radius`",
        ),
        (
            "(shape: Disk(1))",
            "1:9: error: t.shape: expected `Disk(radius: …, hole: …)`",
        ),
        (
            "(shape: Nothing(1))",
            "1:9: error: t.shape: expected `Nothing` alone",
        ),
        (
            "(shape: Pair(1))",
            "1:9: error: t.shape: expected 2 values, found 1",
        ),
        (
            "(shape: Disk(radius: 1, hol: 2))",
            "1:25: error: t.shape.hol: unknown field of Disk; did you mean `hole`?",
        ),
        (
            "(list: [(1, \"a\")])",
            "1:13: error: t.list[0][1]: expected a number, found the text \"a\"",
        ),
        (
            "(list: 3)",
            "1:8: error: t.list: expected a list as `[…, …]`, found the number 3",
        ),
        (
            "(map: {\"a\": 1, \"a\": 2})",
            "1:16: error: t.map.a: the key is set twice",
        ),
        (
            "(name: gold)",
            "1:8: error: t.name: expected a text, found the name `gold`; write \"gold\"",
        ),
        (
            "(inner: 3)",
            "1:9: error: t.inner: expected Inner as `(field: value, …)`, found the number 3",
        ),
        (
            "(inner: Outer(a: 1))",
            "1:9: error: t.inner: expected Inner as `(field: value, …)`, found `Outer(…)`",
        ),
        (
            "(letter: \"ab\")",
            "1:10: error: t.letter: expected a character, found the text \"ab\"",
        ),
        (
            "3",
            "1:1: error: t: expected Thing as `(field: value, …)`, found the number 3",
        ),
    ] {
        let got = complaints(text);
        assert_eq!(got, [format!("dir/t.ron:{expected}")], "{text}");
    }
    assert!(complaints("(link: \"lost\")").is_empty(), "said elsewhere");
    assert_eq!(applied("(float: -inf)").float, f32::NEG_INFINITY);
}

#[test]
fn a_path_reaches_every_field() {
    let set = |path: &str, value: &str| {
        let (thing, diagnostics, _) = run(value, path, false);
        assert!(diagnostics.is_empty(), "{path}: {diagnostics:?}");
        thing
    };
    assert_eq!(set("small", "2").small, 2);
    assert_eq!(set("color[1]", "9").color, Rgb([1.0, 9.0, 3.0]));
    assert_eq!(set("color.2", "9").color, Rgb([1.0, 2.0, 9.0]));
    assert_eq!(set("crop[2]", "9").crop, Some([0, 0, 9, 0]));
    assert_eq!(set("depth", "9").depth, Some(9));
    assert_eq!(set("inner.b[0]", "9").inner.b, Some(Rgb([9.0, 0.0, 0.0])));
    assert_eq!(set("list[0][1]", "9").list, [[0.0, 9.0]]);
    assert_eq!(set("pair[1]", "word").pair.1, "word");
    assert_eq!(set("link", "gold").link.0, Entity::from_bits(GOLD));
    assert_eq!(set("shape", "Pair(1, 2)").shape, Shape::Pair(1, 2.0));
}

#[test]
fn a_wrong_path_lists_what_is_valid() {
    for (path, expected) in [
        (
            "smal",
            "t.smal: unknown field of Thing; did you mean `small`?",
        ),
        (
            "inner.c",
            "t.inner.c: unknown field of Inner; did you mean `a`?",
        ),
        ("list[4]", "t.list[4]: the last index is 0"),
        ("color[3]", "t.color[3]: the last index is 2"),
        (
            "color.r",
            "t.color: [f32; 3] has no field `r`; write an index such as `[0]`",
        ),
        ("small.x", "t.small: there is nothing inside a u8"),
    ] {
        let (_, diagnostics, _) = run("1", path, false);
        let got: Vec<String> = diagnostics.iter().map(ToString::to_string).collect();
        assert_eq!(got, [format!("dir/t.ron: error: {expected}")], "{path}");
    }
    for path in ["a..b", "a[", "a[x]", "a[1]b", "."] {
        assert!(parse_steps(path).is_err(), "{path}");
    }
}

#[test]
fn places_are_kept_for_later_checks() {
    let (_, _, places) = run("(\n inner: (\n  b: 1),\n)", "", true);
    let line = |path: &str| places.find(path).map(|s| (s.line, s.column));
    assert_eq!(line("t.inner.b"), Some((3, 6)));
    assert_eq!(line("t.inner.b[2]"), Some((3, 6)));
    assert_eq!(line("t.inner.a"), Some((2, 9)));
    assert_eq!(line("t.small"), None);
}

#[test]
fn what_is_written_reads_back_as_the_same_value() {
    let mut value = applied(
        r#"(float: 0.1, double: 1e-300, letter: '\'', name: "a\"\\\n", crop: (0, 1, 2, 3),
            file: "/x", list: [(1, 2)], map: {"k": inf}, shapes: [Disk(radius: 2), Pair(1, 2)])"#,
    );
    value.link = thing().link;
    let text = to_ron(&value);
    let without_link: String = text.replace(&format!("link: {:?}, ", value.link.0), "");
    assert_eq!(applied(&without_link), value, "{text}");
}

/// Trees that fit nothing must not panic either.
#[test]
fn any_tree_may_be_applied_to_any_field() {
    let values = [
        "()",
        "1",
        "-1.5",
        "inf",
        "true",
        "'c'",
        "\"s\"",
        "None",
        "Some(1)",
        "Some(None)",
        "Name",
        "Name()",
        "Disk(radius: 1)",
        "Disk((1))",
        "(a: 1)",
        "(1, 2)",
        "(1)",
        "()",
        "[]",
        "[[1]]",
        "{}",
        "{1: 2}",
        "{\"a\": None}",
        "Thing(small: (1))",
    ];
    let names = [
        "",
        "small",
        "float",
        "flag",
        "letter",
        "name",
        "file",
        "color",
        "crop",
        "depth",
        "pair",
        "list",
        "shapes",
        "map",
        "shape",
        "link",
        "inner",
        "inner.b",
        "crop[1]",
        "list[0]",
        "map.a",
        "shape.radius",
        "link.x",
        "link[0]",
    ];
    let mut refused = 0;
    for value in values {
        for name in names {
            refused += usize::from(!run(value, name, true).1.is_empty());
        }
    }
    assert!(refused > values.len() * names.len() / 2, "{refused}");
}
