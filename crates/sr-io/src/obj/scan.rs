//! First pass over an OBJ file: checks every statement, and sorts what is drawn.

use super::text::{Line, Word, lines};
use crate::polygon::MAX_CONCAVE_CORNERS;
use crate::report::Report;
use sr_scene::diagnostics::{Diagnostic, Severity};
use std::collections::HashMap;
use std::fmt::Write;

/// Statements with a meaning, but not for a picture of triangles.
const WITHOUT_EFFECT: &[&str] = &[
    "s",
    "mg",
    "usemap",
    "maplib",
    "shadow_obj",
    "trace_obj",
    "lod",
    "bevel",
    "c_interp",
    "d_interp",
];

/// Statements of free-form curves and surfaces.
const FREE_FORM: &[&str] = &[
    "vp", "cstype", "deg", "bmat", "step", "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
    "sp", "end", "con",
];

/// What a file holds, checked.
#[derive(Debug, Default)]
pub(super) struct Scan {
    /// Names of objects, in order.
    pub(super) objects: Vec<String>,
    /// Faces by object and material.
    pub(super) buckets: Vec<Bucket>,
    /// `usemtl` names, each where it is first used.
    pub(super) materials: Vec<Place>,
    /// `mtllib` names.
    pub(super) libraries: Vec<Place>,
    /// Clean `v` and `vn` lines.
    vertices: String,
    /// Line and corners of faces that ear clipping would refuse.
    large_faces: Vec<(u32, usize)>,
}

/// Faces that become one part; either all of them have normals or none.
#[derive(Debug)]
pub(super) struct Bucket {
    /// Index into the objects.
    pub(super) object: usize,
    /// Index into the materials, when one was chosen.
    pub(super) material: Option<usize>,
    /// Clean `f` lines with absolute indices.
    faces: String,
}

/// A name and where it stands.
#[derive(Clone, Debug)]
pub(super) struct Place {
    pub(super) name: String,
    pub(super) line: u32,
    pub(super) column: u32,
}

impl Scan {
    /// The file as `tobj` reads it right: vertices, then one object a bucket, called by its number.
    pub(super) fn clean_text(&self) -> String {
        let faces: usize = self.buckets.iter().map(|b| b.faces.len() + 24).sum();
        let mut text = String::with_capacity(self.vertices.len() + faces);
        text += &self.vertices;
        for (i, bucket) in self.buckets.iter().enumerate() {
            let _ = writeln!(text, "o {i}");
            text += &bucket.faces;
        }
        text
    }

    /// The first line with a face of so many corners.
    pub(super) fn line_of_large_face(&self, corners: usize) -> Option<u32> {
        let face = self.large_faces.iter().find(|f| f.1 == corners);
        face.map(|f| f.0)
    }
}

/// Checks the text of a file; objects without name are called `unnamed`.
pub(super) fn scan(text: &str, unnamed: String, report: &mut Report) -> Scan {
    let mut scanner = Scanner {
        unnamed,
        report,
        scan: Scan::default(),
        counts: [0; 3],
        object: None,
        group: None,
        material: None,
        bucket: [None; 2],
        object_index: HashMap::new(),
        material_index: HashMap::new(),
        bucket_index: HashMap::new(),
        ahead: Vec::new(),
    };
    for line in lines(text) {
        scanner.statement(&line);
    }
    scanner.finish()
}

/// What the three numbers of a corner count.
const KINDS: [&str; 3] = ["vertex", "texture vertex", "normal"];

struct Scanner<'r> {
    unnamed: String,
    report: &'r mut Report,
    scan: Scan,
    /// `v`, `vt`, `vn` so far.
    counts: [usize; 3],
    object: Option<String>,
    group: Option<String>,
    material: Option<usize>,
    /// The current buckets of faces without and with normals, once there are such faces.
    bucket: [Option<usize>; 2],
    object_index: HashMap<String, usize>,
    material_index: HashMap<String, usize>,
    bucket_index: HashMap<(usize, Option<usize>, bool), usize>,
    /// Indices of what was not there yet: kind, index, line.
    ahead: Vec<(usize, usize, u32)>,
}

impl Scanner<'_> {
    fn error(&mut self, line: &Line<'_>, column: u32, text: impl Into<String>) {
        let span = self.report.span(line.number, column);
        self.report.error(Diagnostic::error(text).at(span));
    }

    fn warn(&mut self, line: &Line<'_>, text: &str) {
        let word = line
            .words()
            .next()
            .map_or(String::new(), |w| format!("`{}`", w.text));
        let span = self.report.span(line.number, 1);
        self.report
            .note_at(Severity::Warning, text, word, Some(span));
    }

    fn statement(&mut self, line: &Line<'_>) {
        let Some(keyword) = line.words().next() else {
            return;
        };
        let start = line.column(keyword);
        match keyword.text {
            "v" => self.vertex(line),
            "vt" => {
                self.numbers(line, 1..=3);
                self.counts[1] += 1;
            }
            "vn" => self.normal(line),
            "f" | "fo" => self.face(line),
            "l" | "p" => self.warn(line, "lines and points are not drawn"),
            "o" => {
                self.object = Some(line.name().text.to_string());
                self.bucket = [None; 2];
            }
            "g" => {
                self.group = Some(line.name().text.to_string());
                // Groups only divide files that have no objects.
                if self.object.is_none() {
                    self.bucket = [None; 2];
                }
            }
            "usemtl" => self.use_material(line),
            "mtllib" => match place(line) {
                Some(p) => self.scan.libraries.push(p),
                None => self.error(line, start, "`mtllib` without a name"),
            },
            k if FREE_FORM.contains(&k) => {
                self.warn(line, "free-form curves and surfaces are not drawn");
            }
            k if WITHOUT_EFFECT.contains(&k) => {}
            _ => self.warn(line, "unknown statements are ignored"),
        }
    }

    /// The numbers of a statement, or `None` after an error.
    fn numbers(
        &mut self,
        line: &Line<'_>,
        how_many: std::ops::RangeInclusive<usize>,
    ) -> Option<Vec<f32>> {
        let mut numbers = Vec::with_capacity(*how_many.end());
        for word in line.words().skip(1).take(*how_many.end()) {
            match word.text.parse::<f32>() {
                Ok(x) if x.is_finite() => numbers.push(x),
                Ok(_) => {
                    let text = format!("`{}` is not finite", word.text);
                    self.error(line, line.column(word), text);
                    return None;
                }
                Err(_) => {
                    let text = format!("`{}` is not a number", word.text);
                    self.error(line, line.column(word), text);
                    return None;
                }
            }
        }
        if !how_many.contains(&numbers.len()) {
            let (have, want) = (numbers.len(), how_many.start());
            self.error(line, 1, format!("{have} numbers where {want} are needed"));
            return None;
        }
        Some(numbers)
    }

    fn vertex(&mut self, line: &Line<'_>) {
        self.counts[0] += 1;
        let Some(numbers) = self.numbers(line, 3..=4) else {
            return;
        };
        let values = line.words().count() - 1;
        let words: Vec<&str> = line.words().skip(1).take(3).map(|w| w.text).collect();
        let _ = write!(self.scan.vertices, "v {}", words.join(" "));
        match (values, numbers.as_slice()) {
            (4, &[x, y, z, w]) => {
                if ![x / w, y / w, z / w].iter().all(|q| q.is_finite()) {
                    self.error(
                        line,
                        1,
                        format!("divided by its weight {w} this is not finite"),
                    );
                }
                let _ = write!(self.scan.vertices, " {w}");
            }
            (5, _) => self.error(line, 1, "5 numbers are neither a weight nor a colour"),
            (6.., _) => self.warn(line, "vertex colours are not read"),
            _ => {}
        }
        self.scan.vertices.push('\n');
    }

    fn normal(&mut self, line: &Line<'_>) {
        self.counts[2] += 1;
        if self.numbers(line, 3..=3).is_some() {
            let words: Vec<&str> = line.words().skip(1).take(3).map(|w| w.text).collect();
            let _ = writeln!(self.scan.vertices, "vn {}", words.join(" "));
        }
    }

    fn use_material(&mut self, line: &Line<'_>) {
        let Some(place) = place(line) else {
            return self.error(line, 1, "`usemtl` without a name");
        };
        let next = self.scan.materials.len();
        let i = *self
            .material_index
            .entry(place.name.clone())
            .or_insert(next);
        if i == next {
            self.scan.materials.push(place);
        }
        self.material = Some(i);
        self.bucket = [None; 2];
    }

    fn face(&mut self, line: &Line<'_>) {
        let mut corners = Vec::new();
        for word in line.words().skip(1) {
            match self.corner(line, word) {
                Ok(corner) => corners.push(corner),
                Err(why) => return self.error(line, line.column(word), why),
            }
        }
        if corners.len() < 3 {
            return self.error(line, 1, format!("a face with {} corners", corners.len()));
        }
        if corners.len() > MAX_CONCAVE_CORNERS {
            self.scan.large_faces.push((line.number, corners.len()));
        }
        let with = corners.iter().filter(|c| c[2].is_some()).count();
        let has_normals = with == corners.len();
        if with > 0 && !has_normals {
            self.warn(line, "faces with normals at some corners only are faceted");
        }
        let bucket = self.bucket(has_normals);
        let faces = &mut self.scan.buckets[bucket].faces;
        faces.push('f');
        for [v, _, vn] in corners {
            let v = v.unwrap_or_default();
            let _ = match vn.filter(|_| has_normals) {
                Some(vn) => write!(faces, " {v}//{vn}"),
                None => write!(faces, " {v}"),
            };
        }
        faces.push('\n');
    }

    /// `v`, `v/vt`, `v//vn` or `v/vt/vn`, counted from 1, or from −1 backwards.
    fn corner(&mut self, line: &Line<'_>, word: Word<'_>) -> Result<[Option<usize>; 3], String> {
        let mut corner = [None; 3];
        for (kind, text) in word.text.split('/').enumerate() {
            if kind > 2 {
                return Err(format!("`{}` has more than three indices", word.text));
            }
            if text.is_empty() && kind > 0 {
                continue;
            }
            let index: i64 = text
                .parse()
                .map_err(|_| format!("`{}` is not a corner of a face", word.text))?;
            let count = self.counts[kind];
            let missing = || format!("{} {index} does not exist, there are {count}", KINDS[kind]);
            let absolute = match index {
                0 => return Err("indices count from 1, or from -1 backwards".into()),
                1.. => usize::try_from(index).map_err(|_| missing())?,
                _ => usize::try_from(index.unsigned_abs())
                    .ok()
                    .and_then(|back| (count + 1).checked_sub(back))
                    .filter(|i| *i > 0)
                    .ok_or_else(missing)?,
            };
            if absolute > count {
                self.ahead.push((kind, absolute, line.number));
            }
            corner[kind] = Some(absolute);
        }
        Ok(corner)
    }

    /// The bucket for faces at this place of the file.
    fn bucket(&mut self, has_normals: bool) -> usize {
        if let Some(bucket) = self.bucket[usize::from(has_normals)] {
            return bucket;
        }
        let named = self
            .object
            .as_ref()
            .or(self.group.as_ref())
            .filter(|n| !n.is_empty());
        let name = named.unwrap_or(&self.unnamed);
        let object = match self.object_index.get(name) {
            Some(&i) => i,
            None => {
                let i = self.scan.objects.len();
                self.scan.objects.push(name.clone());
                self.object_index.insert(name.clone(), i);
                i
            }
        };
        let material = self.material;
        let next = self.scan.buckets.len();
        let key = (object, material, has_normals);
        let bucket = *self.bucket_index.entry(key).or_insert(next);
        if bucket == next {
            let faces = String::new();
            self.scan.buckets.push(Bucket {
                object,
                material,
                faces,
            });
        }
        self.bucket[usize::from(has_normals)] = Some(bucket);
        bucket
    }

    fn finish(mut self) -> Scan {
        for (kind, index, line) in std::mem::take(&mut self.ahead) {
            let count = self.counts[kind];
            if index > count {
                let text = format!("{} {index} does not exist, there are {count}", KINDS[kind]);
                let span = self.report.span(line, 1);
                self.report.error(Diagnostic::error(text).at(span));
            }
        }
        if self.scan.buckets.is_empty() && !self.report.has_errors() {
            self.report
                .error(Diagnostic::error("there are no faces in this file"));
        }
        self.scan
    }
}

/// The name that a statement gives, without quotation marks around it.
fn place(line: &Line<'_>) -> Option<Place> {
    let word = line.name();
    let bare = word
        .text
        .strip_prefix('"')
        .and_then(|n| n.strip_suffix('"'));
    let name = bare.unwrap_or(word.text).to_string();
    (!name.is_empty()).then_some(Place {
        name,
        line: line.number,
        column: line.column(word),
    })
}
