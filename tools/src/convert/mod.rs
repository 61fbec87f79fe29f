//! COLLADA 1.4.1 to a binary glTF and a scene file.
//!
//! The format: Khronos Group 2008, "COLLADA – Digital Asset Schema Release 1.4.1". Read are the
//! elements that Blender and its like write for still scenes, and the blocks
//! `<extra><technique profile="CGL">` in which the classic ray-tracing assignment of UC Berkeley's
//! CS 184 keeps its materials, area lights and spheres; those mean here what they should have
//! meant there (exact Fresnel, inverse-square falloff).
//!
//! Everything is read into memory, converted, and only then written. What is dropped or
//! approximated is in the [`Report`]; what is wrong is told with line and column, all of it at
//! once. Colours are taken as linear, photometric units as radiometric ones.

mod camera;
mod diagnostics;
mod frame;
mod geometry;
pub(crate) mod glb;
mod input;
mod light;
mod material;
mod mesh;
mod names;
mod nodes;
pub(crate) mod output;
mod polygon;
mod primitives;
mod scene_file;
mod source;
mod transform;
mod xml;

pub use camera::{Framing, View};
pub use diagnostics::Problem;

use diagnostics::problem;
use frame::Convention;
use geometry::uses_course_blocks;
use names::{Names, plain};
use nodes::{Scene, Walker};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};
use xml::{Reader, children, label, tag};

/// Which way the camera looks at the scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CameraMode {
    /// As the file says.
    File,
    /// As the viewer of the classic assignment frames it.
    Course,
}

/// Which normals meshes get.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NormalsMode {
    /// Those of the file; none where it has none.
    File,
    /// Computed: the area-weighted mean around each position.
    Smooth,
}

/// How to convert.
#[derive(Clone, Debug)]
pub struct Options {
    /// `None`: [`CameraMode::Course`] for files with the assignment's blocks, else
    /// [`CameraMode::File`].
    pub camera: Option<CameraMode>,
    /// Width and height of the picture that [`CameraMode::Course`] frames for; its window of
    /// 800 × 600 is cropped to this size. Above 0.
    pub course_size: (u32, u32),
    /// `None`: smooth with [`CameraMode::Course`], else the file's.
    pub normals: Option<NormalsMode>,
    /// An environment map, as the scene file shall name it.
    pub environment: Option<String>,
    /// Pass over what can be passed over.
    pub lenient: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            camera: None,
            course_size: (480, 360),
            normals: None,
            environment: None,
            lenient: false,
        }
    }
}

/// What a conversion did.
#[derive(Clone, Debug)]
pub struct Report {
    /// What was read, and how.
    pub summary: Vec<String>,
    /// The camera that was used.
    pub camera: CameraMode,
    /// Framing by the file; `None` when there is no camera or its matrix gives no direction.
    pub file_framing: Option<Framing>,
    /// Framing by the course's viewer, or why there is none.
    pub course_framing: Result<Framing, String>,
    /// What was dropped or approximated although the file is right.
    pub notes: Vec<String>,
    /// What was passed over because the reader was lenient.
    pub warnings: Vec<Problem>,
}

/// A converted file, not yet written.
#[derive(Clone, Debug)]
pub struct Converted {
    /// The binary glTF.
    pub glb: Vec<u8>,
    /// The scene file, which includes the model `<stem>.glb`.
    pub ron: String,
    /// What was done.
    pub report: Report,
}

/// Why there is no result.
#[derive(Debug)]
pub enum Error {
    /// The input is bad: at least one problem.
    Invalid {
        /// The input.
        file: PathBuf,
        /// Where and what.
        problems: Vec<Problem>,
    },
    /// Reading or writing failed.
    Io {
        /// The file.
        file: PathBuf,
        /// What the system says.
        source: io::Error,
        /// The input was at fault, not the output.
        reading: bool,
    },
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Invalid { file, problems } => {
                for (i, p) in problems.iter().enumerate() {
                    let newline = if i == 0 { "" } else { "\n" };
                    write!(f, "{newline}{}:{p}\n  hint: {}", file.display(), p.hint)?;
                }
                Ok(())
            }
            Self::Io { file, source, .. } => write!(f, "{}: {source}", file.display()),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::Invalid { .. } => None,
            Self::Io { source, .. } => Some(source),
        }
    }
}

/// Longest input in bytes: byte offsets of the XML reader are 32 bits wide.
const MAX_BYTES: u64 = u32::MAX as u64;

/// Convert a file and write `<stem>.glb` and `<stem>.scene.ron` into a folder.
///
/// # Errors
/// [`Error::Invalid`] when the file cannot be converted, with every problem found;
/// [`Error::Io`] when reading or writing fails. No file is touched in the first case, and in the
/// second only if the last renaming fails.
pub fn convert_file(
    input: &Path,
    dir: &Path,
    options: &Options,
) -> Result<(Report, [PathBuf; 2]), Error> {
    let reading = |source| Error::Io {
        file: input.to_owned(),
        source,
        reading: true,
    };
    let bytes = input::read_at_most(input, MAX_BYTES).map_err(reading)?;
    let name = input.file_name().unwrap_or_default().to_string_lossy();
    let converted = convert(&bytes, &name, options).map_err(|problems| Error::Invalid {
        file: input.to_owned(),
        problems,
    })?;
    let stem = stem(&name);
    let glb = dir.join(format!("{stem}.glb"));
    let ron = dir.join(format!("{stem}.scene.ron"));
    let files = [
        (glb.as_path(), converted.glb.as_slice()),
        (ron.as_path(), converted.ron.as_bytes()),
    ];
    output::write_all(dir, &files).map_err(|(file, source)| Error::Io {
        file,
        source,
        reading: false,
    })?;
    Ok((converted.report, [glb, ron]))
}

/// Convert the bytes of a COLLADA file. `file_name` gives the names of model and files.
///
/// # Errors
/// All problems that were found, sorted by place.
pub fn convert(
    bytes: &[u8],
    file_name: &str,
    options: &Options,
) -> Result<Converted, Vec<Problem>> {
    let text = decode(bytes)?;
    let doc = xml::parse(text).map_err(|e| {
        let hint = "the file must be well-formed XML";
        vec![Problem {
            line: e.pos().row as usize,
            column: e.pos().col as usize,
            message: without_position(&e.to_string()),
            hint: hint.to_owned(),
        }]
    })?;
    let mut reader = Reader::new(&doc, options.lenient);
    if tag(doc.root_element()) != "COLLADA" {
        let message = format!("the root element is <{}>", tag(doc.root_element()));
        let at = xml::start(doc.root_element());
        reader
            .diag
            .error(at, message, "a COLLADA file begins with <COLLADA>");
        return Err(reader.diag.finish().errors);
    }
    let course_blocks = uses_course_blocks(&doc);
    let mode = options.camera.unwrap_or(if course_blocks {
        CameraMode::Course
    } else {
        CameraMode::File
    });
    let convention = match mode {
        CameraMode::File => Convention::Standard,
        CameraMode::Course => Convention::Course,
    };
    let smooth = match options.normals {
        Some(normals) => normals == NormalsMode::Smooth,
        None => mode == CameraMode::Course,
    };
    let frame = reader.frame(convention);
    let scene = Walker::read(&mut reader, frame, smooth);
    say_what_is_left_out(&mut reader, &scene, options);
    let run = Run {
        file_name,
        options,
        mode,
        smooth,
    };
    finish(reader, &scene, &run)
}

/// The options, and what has been settled beside them.
struct Run<'o> {
    file_name: &'o str,
    options: &'o Options,
    mode: CameraMode,
    smooth: bool,
}

/// By the file, and by the course's viewer.
type Framings = (Option<Framing>, Result<Framing, String>);

/// Both framings; an error is told when there is a camera and the chosen one is not to be had.
fn framings(reader: &mut Reader<'_>, scene: &Scene, run: &Run<'_>) -> Framings {
    let Some(camera) = scene.cameras.first() else {
        return (None, Err("the file has no camera".to_owned()));
    };
    let file = camera.file_framing();
    let course = scene
        .bounds()
        .ok_or_else(|| "there is no geometry to frame".to_owned())
        .and_then(|bounds| camera.course_framing(bounds, run.options.course_size));
    match (run.mode, &file, &course) {
        (CameraMode::Course, _, Err(why)) => {
            reader.diag.error(camera.at, why, "try --camera file");
        }
        (CameraMode::File, None, _) => {
            let message = "this camera's matrix gives no direction";
            let hint = "correct it, or try --camera course";
            reader.diag.error(camera.at, message, hint);
        }
        _ => {}
    }
    (file, course)
}

/// Choose the camera, then make the two files if nothing was wrong.
fn finish(mut reader: Reader<'_>, scene: &Scene, run: &Run<'_>) -> Result<Converted, Vec<Problem>> {
    let (file_framing, course_framing) = framings(&mut reader, scene, run);
    let used = match run.mode {
        CameraMode::File => file_framing.as_ref(),
        CameraMode::Course => course_framing.as_ref().ok(),
    };
    let materials = material_names(scene);
    let glb = glb::write(scene, &materials, used);
    if let Err(why) = &glb {
        reader.diag.error(0, why.as_str(), "split the scene");
    }
    let findings = reader.diag.finish();
    let glb = match glb {
        Ok(glb) if findings.errors.is_empty() => glb,
        _ => return Err(findings.errors),
    };
    let stem = stem(run.file_name);
    let map = |path: &String| scene_file::MapLight {
        path: path.clone(),
        rotation_deg: scene.frame.environment_rotation(),
    };
    let environment = run.options.environment.as_ref().map(map);
    let parts = scene_file::Parts {
        source: run.file_name,
        model: (&plain(stem), &format!("{stem}.glb")),
        materials: &materials,
        camera: used,
        environment: environment.as_ref(),
    };
    let ron = scene_file::write(scene, &parts);
    let report = Report {
        summary: summary(scene, run.smooth),
        camera: run.mode,
        file_framing,
        course_framing,
        notes: findings.notes,
        warnings: findings.warnings,
    };
    Ok(Converted { glb, ron, report })
}

/// UTF-8 without its byte order mark.
fn decode(bytes: &[u8]) -> Result<&str, Vec<Problem>> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    std::str::from_utf8(bytes).map_err(|e| {
        let good = std::str::from_utf8(&bytes[..e.valid_up_to()]).unwrap_or_default();
        let message = "not UTF-8 text".to_owned();
        let hint = "save the file as UTF-8".to_owned();
        vec![problem(good, good.len(), message, hint)]
    })
}

/// The XML reader ends its messages with the place, which we print in front.
fn without_position(message: &str) -> String {
    match message.rsplit_once(" at ") {
        Some((text, place)) if place.bytes().all(|b| b.is_ascii_digit() || b == b':') => {
            text.to_owned()
        }
        _ => message.to_owned(),
    }
}

fn stem(file_name: &str) -> &str {
    match file_name.rsplit_once('.') {
        Some((stem, _)) if !stem.is_empty() => stem,
        _ => file_name,
    }
}

/// A name for every material of the scene.
fn material_names(scene: &Scene) -> Vec<String> {
    let mut names = Names::default();
    let list = scene.materials.list.iter();
    list.map(|m| names.claim(&m.name)).collect()
}

fn counted(n: usize, one: &str, several: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { several })
}

fn summary(scene: &Scene, smooth: bool) -> Vec<String> {
    let triangles: usize = scene
        .meshes
        .iter()
        .flat_map(|m| &m.parts)
        .map(|p| p.triangles.len())
        .sum();
    let normals = if smooth {
        "computed, area-weighted by position"
    } else {
        "the file's"
    };
    vec![
        format!("frame: {}", scene.frame.describe()),
        format!(
            "read: {} ({}), {}, {}, {}, {}",
            counted(scene.meshes.len(), "mesh", "meshes"),
            counted(triangles, "triangle", "triangles"),
            counted(scene.spheres.len(), "sphere", "spheres"),
            counted(scene.lights.len(), "light", "lights"),
            counted(scene.materials.list.len(), "material", "materials"),
            counted(scene.cameras.len(), "camera", "cameras"),
        ),
        format!("normals: {normals}"),
    ]
}

/// Notes about what the file has and the result has not.
fn say_what_is_left_out(reader: &mut Reader<'_>, scene: &Scene, options: &Options) {
    let root = reader.doc.root_element();
    for library in root.children().filter(|c| c.is_element()) {
        let count = library.children().filter(|c| c.is_element()).count();
        let what = match tag(library) {
            "library_animations" | "library_animation_clips" => {
                "animations: the scene stands still"
            }
            "library_images" => "images: textures come later",
            "library_controllers" => "controllers",
            "library_force_fields" | "library_physics_scenes" => "physics",
            _ => continue,
        };
        if count > 0 {
            reader.diag.note(format!("dropped {count} {what}"));
        }
    }
    let materials = children(root, "library_materials").flat_map(|l| children(l, "material"));
    let used: Vec<&str> = scene
        .materials
        .list
        .iter()
        .map(|m| m.name.as_str())
        .collect();
    let unused: Vec<&str> = materials.map(label).filter(|n| !used.contains(n)).collect();
    if !unused.is_empty() {
        let list = unused.join(", ");
        reader
            .diag
            .note(format!("dropped materials that nothing uses: {list}"));
    }
    if scene.cameras.len() > 1 {
        let names: Vec<&str> = scene.cameras[1..].iter().map(|c| c.name.as_str()).collect();
        let list = names.join(", ");
        reader
            .diag
            .note(format!("dropped all cameras but the first: {list}"));
    }
    if options.environment.is_some() && scene.ambient != [0.0; 3] {
        let text = "dropped the ambient light: the environment map takes its place";
        reader.diag.note(text);
    }
}
