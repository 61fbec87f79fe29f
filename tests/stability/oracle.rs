//! The same paths in `f64`: most are the same, and a renderer that is wrong in `f32` is found.

use sr_experiment::Host;
use sr_io::{LoadRequest, Override};
use sr_pipeline::Pipeline;
use sr_pipeline::replay::{Event, Record, SampleId, SampleTracer, Traced};
use sr_stability::Bench;
use sr_stability::oracle::{Oracle, rerun, rerun_against, spread};

/// A configuration at the size of a stamp, but for `set`.
fn pipeline(name: &str, set: &[(&str, &str)]) -> Pipeline {
    let mut pipeline = Bench::new(0).pipeline().expect("a pipeline");
    let small = [("film.width", "32"), ("film.height", "24")];
    let change = |(path, value): &(&str, &str)| Override {
        path: (*path).into(),
        value: (*value).into(),
        origin: "the test".into(),
    };
    pipeline.world.insert_resource(LoadRequest {
        path: sr_tests::repository().join(format!("configs/quick/{name}.ron")),
        overrides: small.iter().chain(set).map(change).collect(),
        ..Default::default()
    });
    let ready = pipeline.load().and_then(|()| pipeline.compile());
    ready.unwrap_or_else(|e| panic!("{name}: {e}"));
    pipeline
}

fn rerun_some(name: &str, set: &[(&str, &str)]) -> Oracle {
    let pipeline = pipeline(name, set);
    let samples = spread(&pipeline, 2000, 16).expect("samples");
    rerun(&pipeline, &samples).unwrap_or_else(|e| panic!("{name}: {e}"))
}

/// Every lobe and light, lenses, maps, meshes with normals of their own, long paths through glass. On these scenes 1 % of
/// the paths part at most, and half of the others are good to 5·10⁻⁶; the tails are paths that go on between curved
/// surfaces.
#[test]
fn most_paths_are_the_same_in_f64() {
    let bsdf = ("integrator", "PathBsdf(max_depth: 5)");
    let all = ("compile.light_selection", "All");
    let samples = ("integrator", "Path(light_samples: 3)");
    for (name, set) in [
        ("cornell_spheres", &[][..]),
        ("cornell_spheres", &[bsdf]),
        ("cornell_gold", &[]),
        ("caustics", &[]),
        ("gems", &[]),
        ("focus_row", &[]),
        ("lights", &[]),
        ("lights", &[all, samples]),
        ("materials", &[]),
        ("unlit", &[]),
        ("room", &[]),
    ] {
        let found = rerun_some(name, set);
        let words = found.words().join("\n");
        assert!(found.parted_share() < 0.03, "{name} {set:?}: {words}");
        assert!(found.radiance.median < 2e-5, "{name} {set:?}: {words}");
        assert!(found.radiance.p99 < 1e-2, "{name} {set:?}: {words}");
        assert!(found.radiance.paths > 20, "{name} {set:?}: {words}");
        assert_eq!(found.defects(), [""; 0], "{name} {set:?}: {words}");
    }
}

#[test]
fn the_answer_is_always_the_same() {
    let once = rerun_some("cornell_gold", &[]);
    assert_eq!(once, rerun_some("cornell_gold", &[]));
    let json = serde_json::to_value(&once).expect("JSON");
    assert_eq!(json["paths"], 2000);
    assert!(json["partings"][0]["cause"].is_string() && json["off_surface"]["replay"].is_string());
}

/// The renderer's tracer, spoilt.
struct Spoilt<'a> {
    tracer: Box<dyn SampleTracer + 'a>,
    id: fn(SampleId) -> SampleId,
    event: fn(&mut Event),
    traced: fn(&mut Traced),
}

impl SampleTracer for Spoilt<'_> {
    fn trace(&self, id: SampleId, record: &Record) -> Traced {
        let own = Record::new();
        let mut traced = self.tracer.trace((self.id)(id), &own);
        (self.traced)(&mut traced);
        for mut event in own.take() {
            (self.event)(&mut event);
            record.push(event);
        }
        traced
    }
}

impl Spoilt<'_> {
    fn new(pipeline: &Pipeline) -> Spoilt<'_> {
        Spoilt {
            tracer: pipeline.tracer().expect("a tracer"),
            id: |id| id,
            event: |_| {},
            traced: |_| {},
        }
    }

    fn rerun(&self, pipeline: &Pipeline) -> Oracle {
        let samples = spread(pipeline, 1000, 16).expect("samples");
        rerun_against(pipeline, self, &samples).expect("paths")
    }
}

#[test]
fn what_is_wrong_in_f32_is_found() {
    let pipeline = pipeline("cornell_spheres", &[]);
    let spoilt = || Spoilt::new(&pipeline);
    assert_eq!(spoilt().rerun(&pipeline).defects(), [""; 0]);

    // Numbers of another sample: the paths have nothing in common but the first surface, at times.
    let id = |id: SampleId| SampleId {
        sample: id.sample + 1,
        ..id
    };
    let other = Spoilt { id, ..spoilt() }.rerun(&pipeline);
    assert!(other.parted_share() > 0.5, "{:?}", other.words());
    let found = other.defects();
    assert!(found.iter().any(|d| d.starts_with("half of")), "{found:?}");

    // Light that gets lost, a tenth of a percent.
    let traced = |t: &mut Traced| t.radiance *= 0.999;
    let dim = Spoilt { traced, ..spoilt() }.rerun(&pipeline);
    let found = dim.defects();
    assert!(
        found.len() == 1 && found[0].starts_with("the mean is"),
        "{found:?}"
    );

    // Hits off their surface by three times of what they say.
    let event = |event: &mut Event| {
        if let Event::Surface { point, .. } = event {
            let claimed = point.ng.abs().dot(point.p_err);
            point.p += 3.0 * claimed * point.ng;
        }
    };
    let off = Spoilt { event, ..spoilt() }.rerun(&pipeline);
    let found = off.defects();
    assert!(
        found.len() == 1 && found[0].contains("off its surface"),
        "{found:?}"
    );

    // Shadow rays that are stopped by nothing.
    let event = |event: &mut Event| {
        if let Event::Shadow { occluded, .. } = event {
            *occluded = true;
        }
    };
    let dark = Spoilt { event, ..spoilt() }.rerun(&pipeline);
    let causes = dark.causes();
    let first = causes.first().map(|(cause, ..)| cause.to_string());
    assert_eq!(first.as_deref(), Some("another answer of a shadow ray"));

    let traced = |t: &mut Traced| t.radiance.x = f32::NAN;
    let lost = Spoilt { traced, ..spoilt() }.rerun(&pipeline);
    assert!(lost.refused == 1000 && lost.defects().len() == 1);
}

#[test]
fn what_cannot_be_traced_in_f64_is_refused_by_name() {
    for (integrator, name) in [("Direct()", "`Direct`"), ("Aov()", "`Aov`")] {
        let pipeline = pipeline("cornell_spheres", &[("integrator", integrator)]);
        let why = rerun(&pipeline, &[]).expect_err("refused");
        assert!(why.contains(name) && why.contains("`Path(…)`"), "{why}");
    }
    let pipeline = pipeline("cornell_spheres", &[]);
    let id = SampleId {
        pixel: [3, 24],
        sample: 0,
    };
    let why = rerun(&pipeline, &[id]).expect_err("refused");
    assert_eq!(
        why,
        "there is no sample 3,24,0: the picture has 32 × 24 pixels"
    );
}
