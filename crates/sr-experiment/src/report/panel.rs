//! What is plotted: an error against samples and against time, a curve a contender.

use crate::analysis::{Analysis, Contender, Curve, Group};
use crate::metric::Metric;
use crate::plan::Plan;
use crate::stats::{Mean, Slope};
use serde::Serialize;

/// What runs from left to right.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum By {
    /// Seconds of integration.
    Time,
    /// Samples a pixel.
    Samples,
}

impl By {
    pub const ALL: [Self; 2] = [Self::Time, Self::Samples];

    /// The end of file names.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Time => "time",
            Self::Samples => "samples",
        }
    }

    /// What stands below the axis.
    pub const fn title(self) -> &'static str {
        match self {
            Self::Time => "seconds",
            Self::Samples => "samples a pixel",
        }
    }
}

/// One plot.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Panel {
    /// Name of its files, without extension; unique.
    pub id: String,
    /// The group whose contenders it shows, by number.
    pub group: usize,
    pub heading: String,
    pub metric: &'static str,
    pub by: By,
    pub x_title: &'static str,
    pub series: Vec<Series>,
}

/// One curve.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Series {
    pub label: String,
    /// Its place among the contenders, which chooses its colour.
    pub place: usize,
    /// `slope −1.02 ± 0.03`, when there is one.
    pub slope: Option<String>,
    pub points: Vec<Dot>,
}

/// One log point: means over the seeds, with intervals where there are several.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub(super) struct Dot {
    pub x: f64,
    pub y: f64,
    pub low: Option<f64>,
    pub high: Option<f64>,
    pub samples: f64,
    pub seconds: f64,
    pub seconds_half_width: Option<f64>,
    pub seeds: usize,
}

/// Every plot of an experiment: groups, then metrics, then time before samples.
pub(super) fn panels(plan: &Plan, analysis: &Analysis) -> Vec<Panel> {
    let several = analysis.groups.len() > 1;
    let groups = analysis.groups.iter().enumerate();
    let of_group = |(number, group): (usize, &Group)| {
        let metrics = plan.experiment.metrics.iter();
        let both = metrics.flat_map(|m| By::ALL.map(|by| (*m, by)));
        both.map(|(metric, by)| panel(number, group, metric, by, several))
            .collect::<Vec<_>>()
    };
    let all = groups.flat_map(of_group);
    all.filter(|p| !p.series.is_empty()).collect()
}

fn panel(number: usize, group: &Group, metric: Metric, by: By, several: bool) -> Panel {
    let metric_name = metric.name().to_lowercase();
    let contenders = group.contenders.iter().enumerate();
    Panel {
        id: match several {
            true => format!("{}-{}_{}", number + 1, metric_name, by.name()),
            false => format!("{metric_name}_{}", by.name()),
        },
        group: number,
        heading: group.heading.clone(),
        metric: metric.title(),
        by,
        x_title: by.title(),
        series: contenders
            .filter_map(|(place, c)| series(place, c, metric, by))
            .collect(),
    }
}

fn series(place: usize, contender: &Contender, metric: Metric, by: By) -> Option<Series> {
    let curve: &Curve = contender.curves.get(&metric)?;
    let slope = match by {
        By::Time => &curve.slope_seconds,
        By::Samples => &curve.slope_samples,
    };
    let points: Vec<Dot> = curve
        .points
        .iter()
        .filter_map(|p| dot(p.samples.mean, &p.seconds, &p.error, by))
        .collect();
    (!points.is_empty()).then(|| Series {
        label: contender.label.clone(),
        place,
        slope: slope.as_ref().map(slope_text),
        points,
    })
}

/// `None` for what has no logarithm: an error less that of its reference can be below 0 by chance.
fn dot(samples: f64, seconds: &Mean, error: &Mean, by: By) -> Option<Dot> {
    let x = match by {
        By::Time => seconds.mean,
        By::Samples => samples,
    };
    let y = error.mean;
    let has_log = |v: f64| v > 0.0 && v.is_finite();
    let half = error.half_width.filter(|h| h.is_finite());
    (has_log(x) && has_log(y)).then(|| Dot {
        x,
        y,
        low: half.map(|h| y - h),
        high: half.map(|h| y + h),
        samples,
        seconds: seconds.mean,
        seconds_half_width: seconds.half_width,
        seeds: error.count,
    })
}

/// `slope −1.02 ± 0.03`; a curve that flattens is marked.
pub(super) fn slope_text(slope: &Slope) -> String {
    let minus = |x: f64| format!("{x:.2}").replace('-', "−");
    let mut text = format!("slope {}", minus(slope.slope));
    if let Some((low, high)) = slope.interval {
        text += &format!(" ± {:.2}", 0.5 * (high - low));
    }
    if slope.flattening.is_some_and(|f| f.found) {
        text += ", flattens";
    }
    text
}

impl Panel {
    /// The plotted numbers, a line a point, after RFC 4180.
    pub fn csv(&self) -> String {
        let mut text = String::from(
            "label,samples,seconds,seconds_half_width,error,error_low,error_high,seeds\r\n",
        );
        for series in &self.series {
            for p in &series.points {
                let optional = |x: Option<f64>| x.map_or_else(String::new, |x| x.to_string());
                text += &crate::results::line(
                    [
                        series.label.clone(),
                        p.samples.to_string(),
                        p.seconds.to_string(),
                        optional(p.seconds_half_width),
                        p.y.to_string(),
                        optional(p.low),
                        optional(p.high),
                        p.seeds.to_string(),
                    ]
                    .into_iter(),
                );
            }
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stats::Flattening;

    fn mean(mean: f64, half_width: Option<f64>) -> Mean {
        Mean {
            mean,
            half_width,
            count: 3,
        }
    }

    #[test]
    fn what_has_no_logarithm_is_not_plotted() {
        let seconds = mean(0.5, Some(0.1));
        let found = dot(4.0, &seconds, &mean(0.2, Some(0.3)), By::Time).unwrap();
        assert_eq!((found.x, found.y, found.samples), (0.5, 0.2, 4.0));
        assert!((found.low.unwrap() + 0.1).abs() < 1e-12);
        assert_eq!(
            dot(4.0, &seconds, &mean(0.2, None), By::Samples).unwrap().x,
            4.0
        );
        for (x, y) in [(0.0, 1.0), (1.0, 0.0), (1.0, -1e-9), (1.0, f64::NAN)] {
            assert_eq!(dot(4.0, &mean(x, None), &mean(y, None), By::Time), None);
        }
    }

    #[test]
    fn a_legend_tells_the_slope_and_whether_it_flattens() {
        let mut slope = Slope {
            slope: -1.0234,
            interval: None,
            flattening: None,
        };
        assert_eq!(slope_text(&slope), "slope −1.02");
        slope.interval = Some((-1.05, -0.99));
        slope.flattening = Some(Flattening {
            early: -1.0,
            late: -0.1,
            p_value: 1e-4,
            found: true,
        });
        assert_eq!(slope_text(&slope), "slope −1.02 ± 0.03, flattens");
    }
}
