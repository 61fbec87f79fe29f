//! Which files a render writes.

use crate::support::Work;
use sr_pipeline::film_kernel::{read_channels, read_image};

/// The files that a render adds to the folder.
fn added(work: &Work, args: &[&str]) -> Vec<String> {
    let before = work.files();
    let mut line = vec!["render"];
    line.extend(args);
    work.done(&line);
    let after = work.files();
    after
        .into_keys()
        .filter(|k| !before.contains_key(k))
        .collect()
}

#[test]
fn the_name_given_says_which_files_are_written() {
    let work = Work::new();
    std::fs::create_dir(work.path("shelf")).unwrap();
    for (args, files) in [
        (
            &["tiny.ron"][..],
            &["out/", "out/tiny.exr", "out/tiny.png"][..],
        ),
        (&["tiny.ron", "-o", "a.exr"], &["a.exr", "a.png"]),
        (&["tiny.ron", "-o", "b.png"], &["b.png"]),
        (&["tiny.ron", "-o", "c"], &["c.exr", "c.png"]),
        (
            &["tiny.ron", "-o", "shelf"],
            &["shelf/tiny.exr", "shelf/tiny.png"],
        ),
        (
            &["tiny.ron", "-o", "d.png", "--stats", "d.json"],
            &["d.json", "d.png"],
        ),
    ] {
        assert_eq!(added(&work, args), files, "{args:?}");
    }
}

#[test]
fn a_bare_scene_is_rendered_with_defaults() {
    let work = Work::new();
    work.done(&["render", "tiny.scene.ron", "--spp", "1", "-o", "a.exr"]);
    let image = read_image(work.path("a.exr")).unwrap();
    assert_eq!((image.width, image.height), (480, 360));
    let config = &work.provenance("a.exr")["config"];
    assert!(config.contains("integrator: Path("), "{config}");
}

#[test]
fn earlier_pictures_are_replaced() {
    let work = Work::new();
    work.write("a.exr", "old");
    work.write("a.png", "old");
    work.done(&["render", "tiny.ron", "-o", "a.exr"]);
    let image = read_image(work.path("a.exr")).unwrap();
    assert_eq!((image.width, image.height), (16, 12));
    let display = read_image(work.path("a.png")).unwrap();
    assert_eq!((display.width, display.height), (16, 12));
    assert!(image.pixels.iter().any(|p| p.min_element() > 0.1));
    let counts = read_channels(work.path("a.exr"), &["SampleCount.Y"]).unwrap();
    assert!(counts.planes[0].iter().all(|n| *n == 4.0));
}

#[test]
fn a_file_that_cannot_be_written_is_found_before_the_work() {
    let work = Work::new();
    // A render that would outlast any patience.
    let run = work.run(&["render", "tiny.ron", "--time", "9h", "-o", "no/a.exr"]);
    assert_eq!(run.status, 2, "{run:?}");
}

#[test]
fn quiet_prints_nothing_and_writes_all_the_same() {
    let work = Work::new();
    let run = work.done(&[
        "render", "tiny.ron", "-q", "-o", "a.exr", "--stats", "s.json",
    ]);
    assert_eq!((run.out.as_str(), run.err.as_str()), ("", ""));
    assert!(work.path("a.exr").exists() && work.path("s.json").exists());
    let run = work.run(&["render", "tiny.ron", "--quiet", "--set", "film.width=x"]);
    assert_eq!(run.status, 2);
    assert!(run.err.contains("film.width"), "errors are not quiet");
}

/// Seconds are no part of the picture.
#[test]
fn the_layer_of_seconds_is_written_and_changes_nothing_else() {
    let work = Work::new();
    work.done(&["render", "tiny.ron", "-o", "plain.exr"]);
    let layers = "film.layers=[Seconds, Depth]";
    work.done(&["render", "tiny.ron", "-o", "a.exr", "--set", layers]);
    let read = |name: &str| read_image(work.path(name)).unwrap();
    assert_eq!(read("a.exr").pixels, read("plain.exr").pixels);
    assert!(
        work.done(&["compare", "a.exr", "plain.exr"])
            .out
            .contains("relMSE")
    );
    let seconds = read_channels(work.path("a.exr"), &["Seconds.Y"]).unwrap();
    // The picture is one tile.
    let first = seconds.planes[0][0];
    assert!(first > 0.0 && first < 1.0, "{first}");
    assert!(seconds.planes[0].iter().all(|s| *s == first));
    let plan = |args: &[&str]| work.done(&[&["plan", "tiny.ron"], args].concat()).out;
    let line = "film: seconds by tile";
    let runs = |text: &str| text.find(line).unwrap() < text.find("left out").unwrap();
    assert!(!runs(&plan(&[])) && runs(&plan(&["--set", layers])));
}

#[test]
fn the_closing_lines_say_what_came_out() {
    let work = Work::new();
    let run = work.done(&["render", "tiny.ron", "-o", "a.exr"]);
    let lines: Vec<&str> = run.out.lines().collect();
    assert_eq!(lines.len(), 2, "{}", run.out);
    for part in [
        "4 samples a pixel, ",
        "rays/s, relMSE ≈ ",
        " ± ",
        " of measuring",
    ] {
        assert!(lines[0].contains(part), "no {part} in {}", lines[0]);
    }
    assert_eq!(lines[1], "wrote a.exr, a.png");
    assert_eq!(run.err, "", "a clean render has nothing to warn of");
}
