//! What is written down at log points: each doubling of the samples, and the end.

use crate::compare;
use crate::reference::Reference;
use crate::seen::Seen;
use serde::{Deserialize, Serialize};
use sr_pipeline::bevy_ecs::{self, prelude::*};
use sr_pipeline::settings::PostSettings;
use sr_pipeline::{Estimate, FilmResource, RenderReport, StageSeconds};
use sr_pipeline::{LogPoints, Measure, MeasureSet, Pipeline, at_log_point};
use std::sync::Arc;

/// Where a row's error comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ErrorSource {
    /// From the reference.
    Reference,
    /// From the variance of the picture's own pixels; it knows of noise only, not of bias.
    Estimate,
    /// Too few samples for an estimate, and no reference.
    None,
}

/// A render at one of its log points.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LogPoint {
    /// Passes so far.
    pub passes: u32,
    /// Samples a pixel so far.
    pub samples: u64,
    /// Samples of all pixels so far.
    pub samples_total: u64,
    /// Seconds of integration so far; nothing else is on this clock.
    pub seconds: f64,
    /// Rays so far.
    pub rays: u64,
    /// Samples that were not added to the picture.
    pub rejected: u64,
    /// Where the errors come from.
    pub error_source: ErrorSource,
    /// Mean squared error.
    pub mse: Option<f64>,
    /// Relative mean squared error.
    pub relmse: Option<f64>,
    /// The same without the worst 0.1 % of the pixels; with a reference only.
    pub relmse_trimmed: Option<f64>,
    /// Mean absolute percentage error as a fraction; with a reference only.
    pub mape: Option<f64>,
    /// Symmetric mean absolute percentage error as a fraction; with a reference only.
    pub smape: Option<f64>,
    /// Mean LDR-FLIP of the pictures as they are shown; with a reference only.
    pub flip: Option<f64>,
    /// `mse` less that of the reference, when that is known.
    pub mse_debiased: Option<f64>,
    /// `relmse` less that of the reference, when that is known.
    pub relmse_debiased: Option<f64>,
    /// The picture's own estimate of its relMSE, with and without a reference.
    pub relmse_estimate: Option<f64>,
    /// Standard error of that estimate.
    pub relmse_estimate_std_error: Option<f64>,
}

/// The log of one render.
#[derive(Resource, Default)]
pub(crate) struct ErrorLog {
    pub reference: Option<Arc<Reference>>,
    pub seen: Option<Seen>,
    pub points: Vec<LogPoint>,
}

/// Lets a pipeline keep a log at these seconds, or without any at doublings of the samples.
pub(crate) fn install(pipeline: &mut Pipeline, reference: Option<Arc<Reference>>, seconds: &[f64]) {
    pipeline.world.insert_resource(LogPoints {
        doublings: seconds.is_empty(),
        seconds: seconds.to_vec(),
    });
    let post = pipeline.world.resource::<PostSettings>();
    let seen = reference.as_ref().map(|r| Seen::new(&r.image, post));
    pipeline.world.insert_resource(ErrorLog {
        reference,
        seen,
        points: Vec::new(),
    });
    pipeline.add_systems(
        Measure,
        write_log_point.in_set(MeasureSet::Log).run_if(at_log_point),
    );
}

fn write_log_point(
    film: Res<'_, FilmResource>,
    report: Res<'_, RenderReport>,
    seconds: Res<'_, StageSeconds>,
    estimate: Res<'_, Estimate>,
    mut log: ResMut<'_, ErrorLog>,
) -> Result {
    // The end is measured even when it is a log point already.
    if log.points.last().is_some_and(|p| p.passes == report.passes) {
        return Ok(());
    }
    let own = estimate.0;
    let mut point = LogPoint {
        passes: report.passes,
        samples: report.samples_per_pixel,
        samples_total: report.samples,
        seconds: seconds.integrate,
        rays: report.tiles.rays.total(),
        rejected: report.tiles.rejects.total(),
        error_source: match own {
            Some(_) => ErrorSource::Estimate,
            None => ErrorSource::None,
        },
        mse: own.map(|e| e.mse),
        relmse: own.map(|e| e.relmse),
        relmse_trimmed: None,
        mape: None,
        smape: None,
        flip: None,
        mse_debiased: None,
        relmse_debiased: None,
        relmse_estimate: own.map(|e| e.relmse),
        relmse_estimate_std_error: own.and_then(|e| e.relmse_std_error),
    };
    if let (Some(reference), Some(seen)) = (&log.reference, &log.seen) {
        let image = film.film.resolve(film.estimator).rgb;
        let found = compare(&image, &reference.image)?;
        let less = |error: f64, own: Option<f64>| own.map(|own| error - own);
        point = LogPoint {
            error_source: ErrorSource::Reference,
            mse: Some(found.mse),
            relmse: Some(found.relmse),
            relmse_trimmed: Some(found.relmse_trimmed),
            mape: Some(found.mape),
            smape: Some(found.smape),
            flip: seen.flip(&image)?.mean(),
            mse_debiased: less(found.mse, reference.facts.mse),
            relmse_debiased: less(found.relmse, reference.facts.relmse),
            ..point
        };
    }
    log.points.push(point);
    Ok(())
}

impl LogPoint {
    /// One of the metrics that a file can name. A reference's own error is taken off where it is
    /// known.
    pub fn metric(&self, metric: crate::Metric) -> Option<f64> {
        match metric {
            crate::Metric::RelMse => self.relmse_debiased.or(self.relmse),
            crate::Metric::Mse => self.mse_debiased.or(self.mse),
            crate::Metric::Mape => self.mape,
            crate::Metric::Smape => self.smape,
            crate::Metric::RelMseTrimmed => self.relmse_trimmed,
            crate::Metric::Flip => self.flip,
        }
    }
}
