//! `.mtl` text, checked: `tobj` refuses a whole library for one number that it cannot read, and
//! panics on a colour of two.

use super::text::{Line, lines};
use crate::report::Report;
use sr_scene::components::SourceSpan;
use sr_scene::diagnostics::{Diagnostic, Severity};
use std::fmt::Write;
use std::path::Path;
use std::sync::Arc;

/// Passes on those lines of a library that `tobj` can read, and says what it leaves out.
pub(super) struct Cleaner<'r> {
    file: Arc<Path>,
    report: &'r mut Report,
    clean: String,
    /// Statements before the first `newmtl` belong to nothing.
    in_material: bool,
}

impl<'r> Cleaner<'r> {
    pub(super) fn new(path: &Path, report: &'r mut Report) -> Self {
        Self {
            file: path.into(),
            report,
            clean: String::new(),
            in_material: false,
        }
    }

    pub(super) fn clean(mut self, text: &str) -> String {
        for line in lines(text) {
            self.statement(&line);
        }
        self.clean
    }

    fn span(&self, line: &Line<'_>) -> SourceSpan {
        SourceSpan {
            file: self.file.clone(),
            line: line.number,
            column: 1,
        }
    }

    fn warn(&mut self, line: &Line<'_>, text: &str) {
        let words: Vec<&str> = line.words().map(|w| w.text).take(5).collect();
        let span = self.span(line);
        let what = format!("`{}`", words.join(" "));
        self.report
            .note_at(Severity::Warning, text, what, Some(span));
    }

    fn statement(&mut self, line: &Line<'_>) {
        let Some(keyword) = line.words().next() else {
            return;
        };
        match keyword.text {
            "newmtl" => {
                self.in_material = true;
                let name = line.name().text;
                if name.is_empty() {
                    let d = Diagnostic::error("`newmtl` without a name").at(self.span(line));
                    return self.report.error(d);
                }
                let _ = writeln!(self.clean, "newmtl {name}");
            }
            _ if !self.in_material => {
                self.warn(line, "a statement before the first `newmtl` is ignored");
            }
            "Kd" | "Ks" | "Ke" | "Tf" => self.colour(line, keyword.text),
            "Ns" | "Ni" | "d" | "Tr" | "Pr" | "Pm" => self.number(line, keyword.text),
            "illum" => {
                let model = line.words().nth(1).and_then(|w| w.text.parse::<u8>().ok());
                match model {
                    Some(model) => drop(writeln!(self.clean, "illum {model}")),
                    None => self.unreadable(line),
                }
            }
            "Ps" | "Pc" | "Pcr" | "aniso" | "anisor" => {
                let value = line.words().nth(1).and_then(|w| w.text.parse::<f32>().ok());
                if value != Some(0.0) {
                    let text = "sheen, clear coat and anisotropy of materials are not read";
                    self.warn(line, text);
                }
            }
            k if k.starts_with("map_")
                || matches!(k, "bump" | "disp" | "decal" | "refl" | "norm") =>
            {
                self.warn(line, "textures are not read yet, factors are used");
            }
            // `Ka` is light that does not exist, and the rest is about anti-aliasing.
            _ => {}
        }
    }

    fn unreadable(&mut self, line: &Line<'_>) {
        self.warn(line, "a value that cannot be read is left at its default");
    }

    /// Three channels, or one for all of them.
    fn colour(&mut self, line: &Line<'_>, keyword: &str) {
        let words: Vec<&str> = line.words().skip(1).map(|w| w.text).collect();
        if matches!(words.first(), Some(&("spectral" | "xyz"))) {
            return self.warn(line, "colours by spectrum or CIE XYZ are not read");
        }
        let numbers: Option<Vec<f32>> = words.iter().take(3).map(|w| finite(w)).collect();
        match numbers.as_deref() {
            Some([r, g, b]) => drop(writeln!(self.clean, "{keyword} {r} {g} {b}")),
            Some([x]) => drop(writeln!(self.clean, "{keyword} {x} {x} {x}")),
            _ => self.unreadable(line),
        }
    }

    fn number(&mut self, line: &Line<'_>, keyword: &str) {
        // `d -halo 0.5` depends on the angle; the number is what counts.
        let mut words = line
            .words()
            .skip(1)
            .map(|w| w.text)
            .filter(|w| *w != "-halo");
        match words.next().and_then(finite) {
            Some(x) => drop(writeln!(self.clean, "{keyword} {x}")),
            None => self.unreadable(line),
        }
    }
}

/// A number that is one.
pub(super) fn finite(word: &str) -> Option<f32> {
    word.parse().ok().filter(|x: &f32| x.is_finite())
}
