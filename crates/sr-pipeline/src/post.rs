//! From film to files.

use crate::clock::StageSeconds;
use crate::film::FilmResource;
use crate::pass::most_samples;
use crate::report::RenderReport;
use bevy_ecs::prelude::*;
use sr_render::film::{
    DisplayImage, FilmImage, Precision, ToneMap, WriteReport, develop, rate_picture, write_exr,
    write_png,
};
use sr_scene::bevy_ecs;
use sr_scene::settings::{self, AdaptiveSettings, Budget, FilmSettings, PostSettings, ToneMapName};
use std::path::PathBuf;

/// Which files to write.
#[derive(Resource, Clone, Debug, Default)]
pub struct OutputRequest {
    /// Linear radiance with layers and provenance.
    pub exr: Option<PathBuf>,
    /// The developed picture.
    pub png: Option<PathBuf>,
    /// Sample counts in false colour; see [`rate_picture`].
    pub rate: Option<PathBuf>,
}

/// Text attributes of the EXR file: what the picture was made from.
#[derive(Resource, Clone, Debug, Default)]
pub struct Provenance(pub Vec<(String, String)>);

/// The finished picture.
#[derive(Resource)]
pub struct Developed {
    /// Linear, with variance and layers.
    pub image: FilmImage,
    /// For the screen.
    pub display: DisplayImage,
    /// What writing had to change; set once the file is written.
    pub written: Option<WriteReport>,
}

/// Resolves the film, exposes and tone-maps it.
pub(crate) fn develop_film(
    film: Res<'_, FilmResource>,
    post: Res<'_, PostSettings>,
    mut commands: Commands<'_, '_>,
) {
    let tone_map = match post.tone_map {
        ToneMapName::Srgb => ToneMap::Srgb,
        ToneMapName::AgX => ToneMap::AgX,
        ToneMapName::PbrNeutral => ToneMap::PbrNeutral,
    };
    let image = film.film.resolve(film.estimator);
    let display = develop(&image.rgb, post.exposure, tone_map);
    commands.insert_resource(Developed {
        image,
        display,
        written: None,
    });
}

/// Writes the files that are asked for, each atomically.
pub(crate) fn write_files(
    request: Res<'_, OutputRequest>,
    settings: Res<'_, FilmSettings>,
    provenance: Res<'_, Provenance>,
    report: Res<'_, RenderReport>,
    seconds: Res<'_, StageSeconds>,
    mut developed: ResMut<'_, Developed>,
) -> Result {
    if let Some(path) = &request.exr {
        let precision = match settings.precision {
            settings::Precision::Float => Precision::Float,
            settings::Precision::Half => Precision::Half,
        };
        let mut attributes = provenance.0.clone();
        attributes.push(("samples".into(), report.samples_per_pixel.to_string()));
        attributes.push(("seconds".into(), format!("{:.3}", seconds.integrate)));
        attributes.push(("threads".into(), rayon::current_num_threads().to_string()));
        let written = write_exr(path, &developed.image, precision, &attributes)?;
        developed.written = Some(written);
    }
    if let Some(path) = &request.png {
        write_png(path, &developed.display)?;
    }
    Ok(())
}

/// Writes the picture of sample counts, over the most that a pixel could get, or got.
pub(crate) fn write_rate(
    request: Res<'_, OutputRequest>,
    budget: Res<'_, Budget>,
    adaptive: Res<'_, AdaptiveSettings>,
    report: Res<'_, RenderReport>,
    developed: Res<'_, Developed>,
) -> Result {
    if let Some(path) = &request.rate {
        let most = most_samples(&budget, &adaptive).unwrap_or(report.samples_per_pixel);
        write_png(path, &rate_picture(&developed.image, most))?;
    }
    Ok(())
}
