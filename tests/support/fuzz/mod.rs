//! Readers as fuzz targets: what each does with bytes that anybody may have written.
//!
//! A target takes bytes, reads them as a user's file is read, and looks at what came of it. The same
//! functions are called by the programs of `tests/fuzz` (libFuzzer makes the bytes) and by the test
//! `hostile` ([`mutate`] does). A target panics when a promise is broken; panics that a reader
//! catches by itself are seen by whoever calls, through the panic hook.

mod models;
pub mod mutate;
mod pictures;
mod repair;
mod scratch;
mod texts;

use std::path::PathBuf;

/// What a reader did with its input.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It was taken.
    Read,
    /// It was refused, for this reason among others.
    Refused(String),
}

/// A reader under test.
pub struct Target {
    /// Name of its folders in `tests/fuzz/corpus` and `tests/fuzz/found`, and of its program.
    pub name: &'static str,
    /// Reads; panics when a promise is broken.
    pub run: fn(&[u8]) -> Fate,
    /// What a mutation may put in: words that mean something in the format.
    pub words: &'static [&'static str],
    /// What opens and closes a level of the format; empty where nothing nests.
    pub nests: &'static [(&'static str, &'static str)],
    /// Makes lengths and checksums right again, so that damage gets past them.
    pub repair: Option<fn(&mut [u8])>,
    /// The most that reading may allocate at a time.
    pub allowance: Allowance,
    /// Panics in decoders that are other people's code become errors, as that reader promises.
    pub contained_panics: bool,
}

/// Bytes that a reader may hold at a time: a multiple of the input and a constant.
#[derive(Clone, Copy, Debug)]
pub struct Allowance {
    /// Bytes for each byte of the input.
    pub per_byte: u64,
    /// Bytes for any input.
    pub free: u64,
}

impl Allowance {
    /// For an input of so many bytes.
    pub fn bytes(self, input: usize) -> u64 {
        self.free + self.per_byte * input as u64
    }
}

/// What any RON may open and close.
const RON_NESTS: &[(&str, &str)] = &[
    ("(", ")"),
    ("[", "]"),
    ("{\"a\":", "}"),
    ("Some(", ")"),
    ("(a:", ")"),
    ("A(", ")"),
];

/// Words of scenes, configurations and experiments.
const RON_WORDS: &[&str] = &[
    "None",
    "Some(1)",
    "()",
    "[]",
    "{}",
    "\"\"",
    "\"..\"",
    "\"/dev/zero\"",
    "'x'",
    "true",
    "r#\"",
    "/*",
    "//",
    "\"\\u{0}\"",
    "models",
    "entities",
    "overrides",
    "film",
    "Sphere",
    "radius",
    "TriangleMesh",
    "positions",
    "indices",
    "ChildOf",
    "\"camera\"",
    "LocalTransform",
    "matrix",
    "Environment",
    "map",
    "scene",
    "integrator",
    "Path",
    "Direct",
    "sampler",
    "budget",
    "axes",
    "zip",
    "methods",
    "seeds",
    "reference",
    "show",
    "caption",
    "insets",
    "(0, 0, 0)",
    "(1, 1, 1, 1)",
    "\"a/b.c[0].d\"",
    "\"{labels}{\"",
    "\u{202e}",
    "\u{feff}",
];

/// RON: the tree takes the most, a node of 40 bytes with its text for each value of two bytes, which a
/// `Vec` that doubles may hold three times. The rest is what components, registries and messages take.
const RON_ALLOWANCE: Allowance = Allowance {
    per_byte: 512,
    free: 8 << 20,
};

/// All of them.
pub const TARGETS: &[Target] = &[
    Target {
        name: "scene",
        run: texts::scene,
        words: RON_WORDS,
        nests: RON_NESTS,
        repair: None,
        allowance: RON_ALLOWANCE,
        contained_panics: false,
    },
    Target {
        name: "config",
        run: texts::config,
        words: RON_WORDS,
        nests: RON_NESTS,
        repair: None,
        allowance: RON_ALLOWANCE,
        contained_panics: false,
    },
    Target {
        name: "experiment",
        run: texts::experiment,
        words: RON_WORDS,
        nests: RON_NESTS,
        repair: None,
        allowance: RON_ALLOWANCE,
        contained_panics: false,
    },
    Target {
        name: "gltf",
        run: models::gltf,
        words: &[
            "null",
            "[]",
            "{}",
            "\"\"",
            "5120",
            "5126",
            "\"VEC3\"",
            "\"SCALAR\"",
            "POSITION",
            "NORMAL",
            "[0,0,0]",
            "\"children\":[0]",
            "\"sparse\"",
            "\"byteStride\":",
            "\"uri\":\"/dev/zero\"",
            "\"mode\":6",
            "data:;base64,AAAA",
            "%00",
            "KHR_lights_punctual",
        ],
        nests: &[("[", "]"), ("{\"extras\":", "}")],
        repair: Some(repair::glb),
        // The reader's own budget, and the tree of the JSON.
        allowance: Allowance {
            per_byte: 1024,
            free: 72 << 20,
        },
        contained_panics: false,
    },
    Target {
        name: "obj",
        run: models::obj,
        words: &[
            "v", "vt", "vn", "f", "o", "g", "usemtl", "mtllib", "/", "//", "1/1/1", "1//1", "-1",
            "\\\n", "\n", "call", "l", "p", "s", "cstype",
        ],
        nests: &[],
        repair: None,
        allowance: Allowance {
            per_byte: 256,
            free: 1 << 20,
        },
        contained_panics: false,
    },
    Target {
        name: "mtl",
        run: models::mtl,
        words: &[
            "newmtl", "Kd", "Ks", "Ke", "Ns", "Ni", "d", "Tr", "Tf", "illum", "Pr", "Pm", "map_Kd",
            "spectral", "xyz", "-s", "\\\n", "\n", "\u{feff}",
        ],
        nests: &[],
        repair: None,
        allowance: Allowance {
            per_byte: 256,
            free: 1 << 20,
        },
        contained_panics: false,
    },
    Target {
        name: "collada",
        run: models::collada,
        words: &[
            "<node>",
            "</node>",
            "<extra>",
            "<technique profile=\"CGL\">",
            "count",
            "stride",
            "offset",
            "source",
            "#a",
            "url=\"#s\"",
            "<p>",
            "<vcount>",
            "<float_array>",
            "<matrix>",
            "<rotate>",
            "NaN",
            "INF",
            "&amp;",
            "&lt;",
            "<!--",
            "-->",
            "<![CDATA[",
            "<!DOCTYPE a [<!ENTITY b \"b\">]>",
            "&b;",
        ],
        nests: &[
            ("<node>", "</node>"),
            ("<extra>", "</extra>"),
            ("<a>", "</a>"),
        ],
        repair: None,
        allowance: Allowance {
            per_byte: 1024,
            free: 8 << 20,
        },
        contained_panics: false,
    },
    Target {
        name: "picture",
        run: pictures::picture,
        words: &[
            "channels",
            "chlist",
            "compression",
            "dataWindow",
            "displayWindow",
            "tiles",
            "tiledesc",
            "lineOrder",
            "name",
            "type",
            "chunkCount",
            "deepscanline",
            "-Y",
            "+X",
            "FORMAT=",
            "IHDR",
            "IDAT",
            "PLTE",
            "tRNS",
            "IEND",
            "R",
            "G",
            "B",
            "Y",
        ],
        nests: &[],
        repair: Some(repair::png),
        allowance: pictures::ALLOWANCE,
        contained_panics: true,
    },
];

/// A target by its name.
///
/// # Panics
/// When there is none.
pub fn target(name: &str) -> &'static Target {
    let found = TARGETS.iter().find(|t| t.name == name);
    found.unwrap_or_else(|| panic!("no target `{name}`"))
}

/// Files of a target in a folder of `tests/fuzz`, sorted: their names and what they hold.
pub fn files(folder: &str, target: &str) -> Vec<(String, Vec<u8>)> {
    let folder: PathBuf = crate::repository()
        .join("tests/fuzz")
        .join(folder)
        .join(target);
    let mut files: Vec<(String, Vec<u8>)> = std::fs::read_dir(&folder)
        .into_iter()
        .flatten()
        .map(|entry| entry.expect("an entry").path())
        .map(|path| {
            let name = path.file_name().expect("a name").to_string_lossy();
            (name.into_owned(), std::fs::read(&path).expect("a file"))
        })
        .collect();
    files.sort();
    files
}
