//! A sample that is traced again has the bits that the film was given.

use crate::{SIZE, scene};
use example_ambient_occlusion::{AmbientOcclusion, AmbientOcclusionSettings};
use sr_integrators::{
    Aov, AovSettings, Direct, DirectSettings, Path, PathBsdf, PathSettings, Quantity, Strategy,
};
use sr_pipeline::film_kernel::Film;
use sr_pipeline::film_spec;
use sr_pipeline::prelude::*;
use sr_pipeline::replay::{Event, SampleId};
use sr_scene::settings::{
    CompileSettings, FilmSettings, LightSelectionName, PixelFilter, SamplerName, SamplerSettings,
};
use sr_tests::Job;

/// Every pixel's sample number `index` alone, by a pass of the render.
fn rendered(pipeline: &mut Pipeline, index: u64) -> Vec<([u32; 2], Vec3)> {
    let spec = film_spec(&pipeline.world).unwrap_or_else(|e| panic!("{e}"));
    let crop = spec.crop;
    let film = Film::new(spec).unwrap_or_else(|e| panic!("{e}"));
    let estimator = sr_pipeline::film_kernel::VarianceEstimator::Samples;
    pipeline
        .world
        .insert_resource(FilmResource { film, estimator });
    pipeline.world.insert_resource(PassSpec {
        first_sample: index,
        samples: 1,
    });
    pipeline.run(Render).unwrap_or_else(|e| panic!("{e}"));
    let film = &pipeline.world.resource::<FilmResource>().film;
    let image = film.resolve(estimator).rgb;
    (crop.y0..crop.y1)
        .flat_map(|y| (crop.x0..crop.x1).map(move |x| [x, y]))
        .zip(image.pixels)
        .collect()
}

/// Compares the samples; how many were not black.
fn check(pipeline: &mut Pipeline, index: u64, what: &str) -> usize {
    let bits = |v: Vec3| v.to_array().map(f32::to_bits);
    let samples = rendered(pipeline, index);
    let mut lit = 0;
    for (pixel, radiance) in samples {
        let id = SampleId {
            pixel,
            sample: index,
        };
        let replay = pipeline.replay(id).unwrap_or_else(|e| panic!("{e}"));
        let again = replay.traced.radiance;
        assert_eq!(
            bits(radiance),
            bits(again),
            "{what} {id}: {radiance} {again}"
        );
        assert_eq!(replay.refused(), None);
        lit += usize::from(again != Vec3::ZERO);
    }
    lit
}

/// A pipeline with integrator `I` and a change of its world.
fn pipeline<I: Integrator>(settings: I::Settings, change: impl FnOnce(&mut World)) -> Pipeline {
    let mut job = Job::with_threads(SIZE, 1, 5, 2)
        .integrator::<I>(settings)
        .scene(scene);
    change(job.world());
    job.compile()
}

/// A crop that begins within a tile, a filter wider than a pixel.
fn crop_and_filter(world: &mut World) {
    let mut film = world.resource_mut::<FilmSettings>();
    film.crop = Some([5, 9, 43, 34]);
    film.filter = PixelFilter::BlackmanHarris { radius: 2.0 };
}

fn deep() -> PathSettings {
    PathSettings {
        max_depth: Some(8),
        roulette_from: Some(1),
        ..Default::default()
    }
}

#[test]
fn samples_of_every_integrator_have_the_bits_of_the_film() {
    let path = &mut pipeline::<Path>(deep(), |_| ());
    for index in [0, 63, 64, 1 << 33] {
        assert!(check(path, index, "Path") > 1000);
    }
    let bsdf = &mut pipeline::<PathBsdf>(deep(), crop_and_filter);
    assert!(check(bsdf, 65, "PathBsdf") > 100);
    let many = DirectSettings {
        light_samples: 5,
        ..Default::default()
    };
    let direct = &mut pipeline::<Direct>(many, |world| {
        crop_and_filter(world);
        world.resource_mut::<CompileSettings>().light_selection = LightSelectionName::All;
        world.resource_mut::<SamplerSettings>().kind = SamplerName::Independent;
    });
    assert!(check(direct, 77, "Direct") > 100);
    let hemisphere = DirectSettings {
        strategy: Strategy::MisHemisphere,
        ..Default::default()
    };
    let direct = &mut pipeline::<Direct>(hemisphere, crop_and_filter);
    assert!(check(direct, 3, "Direct by the hemisphere") > 100);
    let bounces = AovSettings {
        show: Quantity::Bounces,
        ..Default::default()
    };
    assert!(check(&mut pipeline::<Aov>(bounces, crop_and_filter), 64, "Aov") > 100);
    let ao = AmbientOcclusionSettings { distance: 1.0 };
    let ao = &mut pipeline::<AmbientOcclusion>(ao, crop_and_filter);
    assert!(check(ao, 100, "AmbientOcclusion") > 100);
}

/// What the record says adds up to the sample, to the bit, and every path has an end.
#[test]
fn the_record_of_a_path_adds_up() {
    let path = pipeline::<Path>(deep(), |_| ());
    let mut branches = 0;
    for x in 0..SIZE[0] {
        let id = SampleId {
            pixel: [x, 30],
            sample: 70,
        };
        let replay = path.replay(id).unwrap_or_else(|e| panic!("{e}"));
        let mut sum = Vec3::ZERO;
        let (mut surfaces, mut ends) = (0, 0);
        for event in &replay.events {
            match event {
                Event::Emission(e) => sum += e.contribution,
                Event::Shadow {
                    occluded: false,
                    contribution: Some(c),
                    ..
                } => sum += *c,
                Event::Surface { .. } => surfaces += 1,
                Event::End { .. } => ends += 1,
                _ => {}
            }
        }
        assert_eq!(sum, replay.traced.radiance, "{id}");
        assert_eq!(ends, 1, "{id}");
        assert!(surfaces >= replay.traced.bounces, "{id}");
        assert_eq!(replay.first_defect(), None);
        branches += surfaces;
    }
    // At least every second path goes on from where it first arrives.
    assert!(2 * branches > 3 * SIZE[0], "{branches}");
}

#[test]
fn what_cannot_be_replayed_says_why() {
    let path = pipeline::<Path>(deep(), |_| ());
    let outside = SampleId {
        pixel: [SIZE[0], 0],
        sample: 0,
    };
    let error = path.replay(outside).expect_err("it is outside").to_string();
    assert!(error.contains("the picture has 70 × 50 pixels"), "{error}");
    let tracer = pipeline::<example_light_tracer::LightTracer>(Default::default(), |_| ());
    let inside = SampleId {
        pixel: [0, 0],
        sample: 0,
    };
    let error = tracer.replay(inside).expect_err("it has none").to_string();
    assert!(
        error.starts_with("`LightTracer` cannot trace a single sample"),
        "{error}"
    );
}
