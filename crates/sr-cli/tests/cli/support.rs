//! A folder with a tiny scene, and the binary run inside of it.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A lamp over a floor with a ball on it.
pub const SCENE: &str = r#"(
    entities: {
        "grey": {"Lambert": (reflectance: 0.6)},
        "glow": {"Lambert": (reflectance: 0.5), "Emission": (radiance: 5)},
        "floor": {"Quad": (width: 4, height: 4), "LocalTransform": (rotate_deg: (-90, 0, 0)), "MaterialRef": "grey"},
        "lamp": {"Quad": (width: 1, height: 1), "LocalTransform": (translate: (0, 2, 0), rotate_deg: (90, 0, 0)), "MaterialRef": "glow"},
        "ball": {"Sphere": (radius: 0.5), "LocalTransform": (translate: (0, 0.5, 0)), "MaterialRef": "grey"},
        "eye": {"PerspectiveCamera": (hfov_deg: 45), "LookAt": (from: (0, 1.5, 4), to: (0, 0.5, 0)), "ActiveCamera": ()},
    },
)
"#;

/// 16 × 12 pixels, 4 samples: milliseconds.
pub const CONFIG: &str = r#"(
    scene: "tiny.scene.ron",
    integrator: Path(max_depth: 1),
    film: (width: 16, height: 12),
    budget: (samples: 4),
)
"#;

/// A temporary folder to work in.
pub struct Work {
    folder: tempfile::TempDir,
}

/// What a run came to.
#[derive(Debug)]
pub struct Run {
    pub status: i32,
    pub out: String,
    pub err: String,
}

impl Work {
    /// With `tiny.scene.ron` and `tiny.ron`.
    pub fn new() -> Self {
        let work = Self {
            folder: tempfile::tempdir().unwrap(),
        };
        work.write("tiny.scene.ron", SCENE);
        work.write("tiny.ron", CONFIG);
        work
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    pub fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        std::fs::read(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Every file below, with its bytes; folders end with a slash.
    pub fn files(&self) -> BTreeMap<String, Vec<u8>> {
        let mut files = BTreeMap::new();
        collect(self.folder.path(), "", &mut files);
        files
    }

    /// The binary with these arguments, not started yet.
    pub fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_steradian"));
        command.args(args).current_dir(self.folder.path());
        command.env_remove("RUST_BACKTRACE");
        command
    }

    pub fn run(&self, args: &[&str]) -> Run {
        Run::of(self.command(args).output().unwrap())
    }

    /// Runs what must succeed.
    pub fn done(&self, args: &[&str]) -> Run {
        let run = self.run(args);
        assert_eq!(run.status, 0, "{args:?}\n{run:?}");
        run
    }

    /// The text attributes of an EXR without their prefix.
    pub fn provenance(&self, name: &str) -> BTreeMap<String, String> {
        let attributes = sr_pipeline::film_kernel::read_attributes(self.path(name)).unwrap();
        attributes
            .into_iter()
            .filter_map(|(key, value)| Some((key.strip_prefix("steradian.")?.to_owned(), value)))
            .collect()
    }

    pub fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }
}

impl Run {
    pub fn of(output: Output) -> Self {
        Self {
            status: output.status.code().unwrap_or(-1),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}

fn collect(folder: &Path, prefix: &str, files: &mut BTreeMap<String, Vec<u8>>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let entry = entry.unwrap();
        let name = format!("{prefix}{}", entry.file_name().to_string_lossy());
        if entry.path().is_dir() {
            collect(&entry.path(), &format!("{name}/"), files);
            files.insert(format!("{name}/"), Vec::new());
        } else {
            files.insert(name, std::fs::read(entry.path()).unwrap());
        }
    }
}
