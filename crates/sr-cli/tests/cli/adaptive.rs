//! Adaptive sampling from the command line.

use crate::support::Work;
use sr_pipeline::film_kernel::read_channels;

/// The sky is black and done at once; the lit floor takes what it needs.
#[test]
fn an_adaptive_render_tells_where_its_samples_went() {
    let work = Work::new();
    let run = work.done(&[
        "render",
        "tiny.ron",
        "-o",
        "a.exr",
        "--spp",
        "512",
        "--adaptive",
        "0.05",
        "--stats",
        "s.json",
        "--set",
        "adaptive.block=1",
    ]);
    let s = work.json("s.json");
    let adaptive = |key: &str| s["adaptive"][key].as_f64().unwrap();
    assert_eq!(adaptive("samples_min"), 64.0);
    assert!(adaptive("samples_max") > 64.0);
    let samples = s["samples"].as_f64().unwrap();
    assert!((samples - adaptive("samples_mean") * 16.0 * 12.0).abs() < 1e-6);
    assert!(samples < 16.0 * 12.0 * 512.0);
    assert_eq!(s["rays"]["camera"], s["samples"]);
    assert!(run.out.contains("on average") && run.out.contains("reached the tolerance"));
    assert!(work.path("a_rate.png").is_file());

    let counts = read_channels(work.path("a.exr"), &["SampleCount.Y"]).unwrap();
    let counts = counts.planes[0].iter().map(|n| f64::from(*n));
    assert_eq!(counts.sum::<f64>(), samples);
}

#[test]
fn a_render_whose_pixels_are_all_done_says_so() {
    let work = Work::new();
    let run = work.done(&[
        "render",
        "tiny.ron",
        "-o",
        "a.png",
        "--spp",
        "100000",
        "--adaptive",
        "10",
        "--stats",
        "s.json",
    ]);
    let s = work.json("s.json");
    assert_eq!(
        (&s["stop"], &s["samples_per_pixel"]),
        (&"converged".into(), &64.into())
    );
    assert!(run.out.contains("every pixel reached the tolerance"));
}

#[test]
fn a_plan_says_how_samples_are_given() {
    let work = Work::new();
    let plan = |args: &[&str]| work.done(&[&["plan", "tiny.ron"], args].concat()).out;
    assert!(plan(&[]).contains("adaptive    off"));
    let text = plan(&["--adaptive", "0.1", "--spp", "256"]);
    assert!(text.contains("at most 256 samples a pixel"), "{text}");
    assert!(
        text.contains("adaptive    Folds: tolerance 0.1 at 95 %"),
        "{text}"
    );
    assert!(text.contains("8 replicas"), "{text}");
}

#[test]
fn what_cannot_be_adaptive_is_told() {
    let work = Work::new();
    let run = work.run(&[
        "plan",
        "tiny.ron",
        "--adaptive",
        "0.1",
        "--set",
        "sampler.replicas=2",
    ]);
    assert_eq!(run.status, 2);
    assert!(
        run.err.contains("sampler.replicas: 2 is too few"),
        "{}",
        run.err
    );
    let run = work.done(&["plan", "tiny.ron", "--adaptive", "0.1", "--spp", "64"]);
    assert!(run.err.contains("nothing can be adaptive"), "{}", run.err);
}
