//! `film.clamp` from the command line.

use crate::support::Work;
use sr_pipeline::film_kernel::read_image;

#[test]
fn a_clamped_render_says_what_is_missing_and_that_it_is_biased() {
    let work = Work::new();
    let clamped = ["--set", "film.clamp=0.4"];
    let mut args = vec!["render", "tiny.ron", "-o", "a.exr", "--stats", "s.json"];
    args.extend(clamped);
    let run = work.done(&args);
    assert!(
        run.out.contains("clamp at 0.4: ") && run.out.contains("the picture is biased"),
        "{run:?}"
    );
    let s = work.json("s.json");
    let removed = s["clamp"]["removed"].as_f64().unwrap();
    assert!(s["clamp"]["samples"].as_u64().unwrap() > 0 && removed > 0.0);
    let brightest = |name: &str| {
        let image = read_image(work.path(name)).unwrap();
        let each = image.pixels.iter().map(|p| p.max_element());
        each.fold(0.0, f32::max)
    };
    work.done(&["render", "tiny.ron", "-o", "b.exr", "--stats", "t.json"]);
    assert_eq!(work.json("t.json")["clamp"], serde_json::Value::Null);
    assert!(brightest("a.exr") <= 0.4);

    // What is missing is what the figures say, as far as 32-bit pixels tell.
    let light = |name: &str| -> f64 {
        let image = read_image(work.path(name)).unwrap();
        let weights = sr_pipeline::glam::DVec3::new(0.2126, 0.7152, 0.0722);
        image.pixels.iter().map(|p| weights.dot(p.as_dvec3())).sum()
    };
    let missing = 1.0 - light("a.exr") / light("b.exr");
    assert!((removed - missing).abs() < 1e-6, "{removed} {missing}");

    let plan = |args: &[&str]| work.done(&[&["plan", "tiny.ron"], args].concat()).out;
    let text = plan(&clamped);
    assert!(text.contains("samples clamped at 0.4: biased"), "{text}");
    assert!(
        text.contains("the picture is biased, it lacks what is cut off"),
        "{text}"
    );
    let text = plan(&[]);
    assert!(text.contains("`film.clamp` is not set") && !text.contains("biased"));
}

#[test]
fn a_clamp_above_every_sample_changes_no_bit_and_says_so() {
    let work = Work::new();
    work.done(&["render", "tiny.ron", "-o", "a.exr"]);
    let run = work.done(&[
        "render",
        "tiny.ron",
        "-o",
        "b.exr",
        "--set",
        "film.clamp=1e30",
    ]);
    assert!(run.out.contains("nothing is missing"), "{run:?}");
    let [a, b] = ["a.exr", "b.exr"].map(|name| read_image(work.path(name)).unwrap());
    assert_eq!(a, b);
}
