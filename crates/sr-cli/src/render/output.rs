//! Where a render goes: which files, and whether they can be written, found out before any work.

use crate::args::RenderArgs;
use crate::failure::Failure;
use std::fs::{self, OpenOptions};
use std::path::{Path, PathBuf};

/// Where pictures go when nobody says.
const DEFAULT_FOLDER: &str = "out";

/// The files of a render.
#[derive(Debug, PartialEq, Eq)]
pub struct Outputs {
    /// Radiance with layers.
    pub exr: Option<PathBuf>,
    /// The developed picture.
    pub png: Option<PathBuf>,
    /// Sample counts in false colour, of an adaptive render.
    pub rate: Option<PathBuf>,
    /// Figures as JSON.
    pub stats: Option<PathBuf>,
    /// The error against time as CSV.
    pub convergence: Option<PathBuf>,
    /// A folder that is made when it is missing.
    folder: Option<PathBuf>,
}

impl Outputs {
    /// From the options.
    pub fn choose(args: &RenderArgs) -> Result<Self, Failure> {
        let stem = stem(&args.scene.input);
        let both = |path: PathBuf| {
            // Not `with_extension`, which takes `box.v2` for a name with one.
            let with = |extension| {
                let mut name = path.clone().into_os_string();
                name.push(extension);
                Some(PathBuf::from(name))
            };
            (with(".exr"), with(".png"))
        };
        let mut folder = None;
        let (exr, png) = match &args.output {
            None => {
                folder = Some(PathBuf::from(DEFAULT_FOLDER));
                both(Path::new(DEFAULT_FOLDER).join(stem))
            }
            Some(path) if path.is_dir() => both(path.join(stem)),
            Some(path) => match picture_extension(path)?.as_deref() {
                Some("exr") => (Some(path.clone()), Some(path.with_extension("png"))),
                Some("png") => (None, Some(path.clone())),
                None => both(path.clone()),
                Some(other) => {
                    return Err(Failure::Input(format!(
                        "{}: pictures are written as .exr and .png, not as .{other}",
                        path.display()
                    )));
                }
            },
        };
        Ok(Self {
            exr,
            png,
            rate: None,
            stats: args.stats.clone(),
            convergence: args.convergence.clone(),
            folder,
        })
    }

    /// The pictures, and the figures after them.
    pub fn files(&self) -> impl Iterator<Item = &PathBuf> {
        let pictures = [&self.exr, &self.png, &self.rate];
        let figures = [&self.stats, &self.convergence];
        pictures.into_iter().chain(figures).flatten()
    }

    /// Adds the picture of sample counts, whose name is that of the PNG with `_rate`.
    pub fn add_rate(&mut self) {
        self.rate = self.png.as_ref().map(|png| {
            let mut name = png.file_stem().unwrap_or_default().to_owned();
            name.push("_rate.png");
            png.with_file_name(name)
        });
    }

    /// Whether every file can be written without harm to `input`. Touches none of them.
    pub fn check(&self, input: &Path) -> Result<(), Failure> {
        let files: Vec<&PathBuf> = self.files().collect();
        for (i, file) in files.iter().enumerate() {
            if files[..i].contains(file) {
                let message = format!("{} is to be written twice", file.display());
                return Err(Failure::Input(message));
            }
        }
        for file in files {
            self.check_file(file, input).map_err(|cause| {
                Failure::Input(format!("cannot write {}: {cause}", file.display()))
            })?;
        }
        Ok(())
    }

    fn check_file(&self, file: &Path, input: &Path) -> Result<(), String> {
        if file.file_name().is_none() {
            return Err("it is no name of a file".into());
        }
        if let Ok(meta) = fs::metadata(file) {
            if meta.is_dir() {
                return Err("it is a folder".into());
            }
            if !meta.is_file() {
                return Err("it is no regular file".into());
            }
            if meta.permissions().readonly() {
                return Err("it is read-only".into());
            }
            let same = |a: &Path, b: &Path| Some(a.canonicalize().ok()? == b.canonicalize().ok()?);
            if same(file, input) == Some(true) {
                return Err("it is the input".into());
            }
            // Scenes, models and what these consist of have other extensions, so a slip of the pen
            // costs none of them.
            for (figures, own) in [(&self.stats, "json"), (&self.convergence, "csv")] {
                if Some(file) == figures.as_deref() && extension(file).as_deref() != Some(own) {
                    return Err(format!("it exists and is no .{own} file"));
                }
            }
        }
        let folder = match file.parent() {
            Some(parent) if !parent.as_os_str().is_empty() => parent,
            _ => Path::new("."),
        };
        if self.folder.as_deref() == Some(folder) && !folder.exists() {
            return probe(Path::new("."));
        }
        if !folder.exists() {
            return Err(format!("there is no folder {}", folder.display()));
        }
        if !folder.is_dir() {
            return Err(format!("{} is no folder", folder.display()));
        }
        probe(folder)
    }

    /// Makes the folder that pictures go to when nobody says.
    pub fn make_folder(&self) -> Result<(), Failure> {
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        fs::create_dir_all(folder).map_err(|e| {
            Failure::Input(format!("cannot make the folder {}: {e}", folder.display()))
        })
    }
}

/// Whether a file can be made in a folder: permissions alone do not tell (read-only systems, quotas,
/// access lists), so it is tried.
fn probe(folder: &Path) -> Result<(), String> {
    let name = format!(".steradian.{}.probe", std::process::id());
    let path = folder.join(name);
    OpenOptions::new()
        .write(true)
        .create_new(true)
        .open(&path)
        .map_err(|e| format!("the folder {} refuses files: {e}", folder.display()))?;
    // It is empty and hidden; should it stay, nothing is lost.
    let _ = fs::remove_file(path);
    Ok(())
}

/// The extension of what `-o` names when it is no folder that exists.
fn picture_extension(path: &Path) -> Result<Option<String>, Failure> {
    let refuse = |cause: &str| {
        let path = path.display();
        Err(Failure::Input(format!("cannot write to `{path}`: {cause}")))
    };
    let text = path.to_string_lossy();
    if text.ends_with(std::path::is_separator) {
        return refuse("there is no such folder");
    }
    let Some(name) = path.file_name() else {
        return refuse("it is no name of a file");
    };
    if fs::metadata(path).is_ok_and(|meta| !meta.is_file()) {
        return refuse("it is neither a folder nor a regular file");
    }
    let name = name.to_string_lossy().to_lowercase();
    if matches!(name.as_str(), ".exr" | ".png") {
        return refuse("a name is missing before the extension");
    }
    Ok(extension(path))
}

fn extension(path: &Path) -> Option<String> {
    Some(path.extension()?.to_string_lossy().to_lowercase())
}

/// `a/box.scene.ron`, `a/box.ron` and `a/box.glb` are called `box`.
fn stem(input: &Path) -> PathBuf {
    let stem = Path::new(input.file_stem().unwrap_or("render".as_ref()));
    match extension(stem).as_deref() {
        Some("scene") => stem.with_extension(""),
        _ => stem.to_owned(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::args::{Cli, Command};
    use clap::Parser;

    fn outputs(words: &[&str]) -> Result<[Option<String>; 3], Failure> {
        let line = ["steradian", "render"].iter().chain(words);
        let Command::Render(args) = Cli::try_parse_from(line).unwrap().command else {
            panic!("it was `render`");
        };
        let text = |p: Option<PathBuf>| p.map(|p| p.display().to_string());
        Outputs::choose(&args).map(|o| [text(o.exr), text(o.png), text(o.stats)])
    }

    fn pictures(words: &[&str]) -> [Option<String>; 2] {
        let [exr, png, _] = outputs(words).unwrap();
        [exr, png]
    }

    fn some(exr: &str, png: &str) -> [Option<String>; 2] {
        [Some(exr.into()), Some(png.into())]
    }

    #[test]
    fn without_o_the_input_names_the_pictures() {
        for input in ["a/box.ron", "box.scene.ron", "../box.glb", "box.OBJ"] {
            assert_eq!(pictures(&[input]), some("out/box.exr", "out/box.png"));
        }
        assert_eq!(
            pictures(&["box.v2.ron"]),
            some("out/box.v2.exr", "out/box.v2.png")
        );
    }

    #[test]
    fn the_extension_of_o_says_what_is_written() {
        assert_eq!(
            pictures(&["b.ron", "-o", "x/a.exr"]),
            some("x/a.exr", "x/a.png")
        );
        assert_eq!(
            pictures(&["b.ron", "-o", "x/a.EXR"]),
            some("x/a.EXR", "x/a.png")
        );
        assert_eq!(
            pictures(&["b.ron", "-o", "a.png"]),
            [None, Some("a.png".into())]
        );
        assert_eq!(
            pictures(&["b.ron", "-o", "x/a"]),
            some("x/a.exr", "x/a.png")
        );
        let error = outputs(&["b.ron", "-o", "a.jpg"]).unwrap_err();
        assert!(error.to_string().contains(".jpg"), "{error}");
    }

    #[test]
    fn what_cannot_be_a_picture_is_refused_by_its_own_name() {
        let dir = tempfile::tempdir().unwrap();
        let missing = format!("{}/none/", dir.path().display());
        let hidden = format!("{}/.EXR", dir.path().display());
        for (path, cause) in [
            (missing.as_str(), "there is no such folder"),
            (".png", "a name is missing"),
            (hidden.as_str(), "a name is missing"),
            ("none/..", "no name of a file"),
            #[cfg(unix)]
            ("/dev/full", "neither a folder nor a regular file"),
        ] {
            let error = outputs(&["b.ron", "-o", path]).unwrap_err().to_string();
            let expected = format!("cannot write to `{path}`: ");
            assert!(error.starts_with(&expected), "{error}");
            assert!(error.contains(cause), "{error}");
        }
    }

    #[test]
    fn a_folder_gets_files_of_the_inputs_name() {
        let dir = tempfile::tempdir().unwrap();
        let path = dir.path().display().to_string();
        assert_eq!(
            pictures(&["b.ron", "-o", &path]),
            some(&format!("{path}/b.exr"), &format!("{path}/b.png"))
        );
    }
}
