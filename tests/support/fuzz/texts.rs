//! RON: scenes and configurations through the whole of `Load`, experiments through their reader.

use super::Fate;
use super::scratch::with_file;
use sr_io::LoadRequest;
use sr_pipeline::diagnostics::{Diagnostic, Diagnostics, Severity};
use sr_scene::schedule::Load;
use sr_scene::stage;
use std::path::Path;

pub(super) fn scene(bytes: &[u8]) -> Fate {
    with_file("damaged.scene.ron", bytes, load)
}

pub(super) fn config(bytes: &[u8]) -> Fate {
    with_file("damaged.ron", bytes, load)
}

pub(super) fn experiment(bytes: &[u8]) -> Fate {
    with_file("damaged.exp.ron", bytes, |path| {
        match sr_experiment::read(path) {
            Ok(_) => Fate::Read,
            Err(errors) => refused(&errors),
        }
    })
}

/// A file becomes entities, on this thread, so that what it allocates can be counted.
fn load(path: &Path) -> Fate {
    let mut pipeline = crate::pipeline(1);
    sr_io::install(&mut pipeline.world);
    pipeline.world.insert_resource(LoadRequest {
        path: path.to_owned(),
        ..Default::default()
    });
    let result = stage::run(&mut pipeline.world, Load);
    let diagnostics = pipeline.world.resource::<Diagnostics>();
    match result {
        Ok(()) => {
            assert_eq!(diagnostics.error_count(), 0, "loaded in spite of errors");
            Fate::Read
        }
        Err(error) => {
            assert!(diagnostics.error_count() > 0, "no reason is given: {error}");
            refused(&diagnostics.0)
        }
    }
}

/// There is a reason, and it can be printed.
pub(super) fn refused(diagnostics: &[Diagnostic]) -> Fate {
    assert!(!diagnostics.is_empty(), "no reason is given");
    for diagnostic in diagnostics {
        let text = diagnostic.to_string();
        assert!(!diagnostic.message.is_empty(), "an empty message");
        assert!(!text.contains("please report"), "{text}");
        assert!(
            !text.contains(|c: char| c.is_control() && c != '\n'),
            "{text:?}"
        );
    }
    let error = diagnostics.iter().find(|d| d.severity == Severity::Error);
    Fate::Refused(error.expect("a reason is an error").to_string())
}
