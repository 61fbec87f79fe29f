//! A sweep as a plot: error against the parameter, the bound, and where it is promised.

use super::words::number;
use crate::{Point, Sweep};
use plotters::chart::{ChartContext, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::prelude::*;
use sr_experiment::report::{Axis, FONT, GRID, INK, Marks, axis, font, inline};

const SIZE: (u32, u32) = (720, 400);
/// What was measured: blue, and orange for the f64 instance (Okabe and Ito 2008).
const MEASURED: RGBColor = RGBColor(0, 114, 178);
const ORACLE: RGBColor = RGBColor(213, 94, 0);
const PROMISE: RGBColor = RGBColor(0, 158, 115);
const FAILURE: RGBColor = RGBColor(204, 51, 51);

type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Axis, Axis>>;
type Drawn<'b> = Result<(), DrawingAreaErrorKind<<SVGBackend<'b> as DrawingBackend>::ErrorType>>;

/// As a file.
pub(super) fn svg(sweep: &Sweep) -> Result<String, String> {
    font()?;
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(sweep, &area).map_err(|e| format!("plot {}: {e}", sweep.name))?;
    }
    Ok(text)
}

/// As a part of a page.
pub(super) fn plot(sweep: &Sweep) -> Result<String, String> {
    let text = svg(sweep)?;
    let label = format!("{} against {}", sweep.error, sweep.parameter);
    Ok(inline(&text, &sr_experiment::report::escape(&label)))
}

/// Zero and infinity have no place on a logarithmic axis: they are drawn at its ends, half a decade beyond the
/// values that have one.
fn axes(sweep: &Sweep) -> (Axis, Axis) {
    let points = || sweep.points.iter();
    let x = axis(Marks::Decades, points().map(|p| p.at));
    let errors = points().flat_map(|p| [Some(p.error), Some(p.error + p.half_width), p.oracle]);
    let known: Vec<f64> = errors
        .flatten()
        .chain([sweep.bound])
        .filter(|e| *e > 0.0 && e.is_finite())
        .collect();
    let [low, high] = [f64::min, f64::max].map(|f| known.iter().copied().reduce(f).unwrap_or(1.0));
    let half_decade = 10f64.sqrt();
    let ends = [low / half_decade, high * half_decade];
    (x, axis(Marks::Decades, ends.into_iter()))
}

/// Where a value is drawn.
fn place(axis: &Axis, value: f64) -> f64 {
    if value == f64::INFINITY {
        axis.range.end
    } else {
        axis.place(value)
    }
}

fn draw<'b>(sweep: &Sweep, area: &Area<'b>) -> Drawn<'b> {
    area.fill(&WHITE)?;
    let text = |size: u32| (FONT, size).into_font().color(&INK);
    let (x, y) = axes(sweep);
    let mut chart = ChartBuilder::on(area)
        .margin(12)
        .x_label_area_size(44)
        .y_label_area_size(72)
        .build_cartesian_2d(x.clone(), y.clone())?;
    let [from, to] = sweep.holds.map(|h| place(&x, h));
    let promised = [(from, y.range.start), (to, y.range.end)];
    chart.draw_series([Rectangle::new(promised, PROMISE.mix(0.09).filled())])?;
    chart
        .configure_mesh()
        .x_desc(&sweep.parameter)
        .y_desc(&sweep.error)
        .label_style(text(12))
        .axis_desc_style(text(13))
        .axis_style(INK)
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .draw()?;
    level(&mut chart, sweep, (&x, &y))?;
    let limit = sweep.limit();
    for at in [limit.below, limit.above].into_iter().flatten() {
        let at = place(&x, at);
        let line = [(at, y.range.start), (at, y.range.end)];
        chart.draw_series(DashedLineSeries::new(line, 3, 4, FAILURE.stroke_width(1)))?;
    }
    let oracle: Vec<(f64, f64)> = sweep
        .points
        .iter()
        .filter_map(|p| Some((p.at, p.oracle?)))
        .collect();
    curve(&mut chart, "f64", &oracle, ORACLE, (&x, &y))?;
    bars(&mut chart, &sweep.points, (&x, &y))?;
    let measured: Vec<(f64, f64)> = sweep.points.iter().map(|p| (p.at, p.error)).collect();
    let name = if oracle.is_empty() { "measured" } else { "f32" };
    curve(&mut chart, name, &measured, MEASURED, (&x, &y))?;
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .margin(8)
        .legend_area_size(28)
        .background_style(WHITE.mix(0.85))
        .border_style(GRID)
        .label_font(text(12))
        .draw()?;
    area.present()
}

/// The bound, where there is one above 0 to draw.
fn level<'b>(chart: &mut Chart<'_, 'b>, sweep: &Sweep, (x, y): (&Axis, &Axis)) -> Drawn<'b> {
    let at = y.place(sweep.bound);
    let style = PROMISE.stroke_width(2);
    let line = [(x.range.start, at), (x.range.end, at)];
    chart
        .draw_series(DashedLineSeries::new(line, 8, 5, style))?
        .label(format!("bound {}", number(sweep.bound)))
        .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 22, y)], style));
    Ok(())
}

fn curve<'b>(
    chart: &mut Chart<'_, 'b>,
    name: &str,
    points: &[(f64, f64)],
    ink: RGBColor,
    (x, y): (&Axis, &Axis),
) -> Drawn<'b> {
    if points.is_empty() {
        return Ok(());
    }
    let mut at: Vec<(f64, f64)> = points
        .iter()
        .map(|(a, e)| (place(x, *a), place(y, *e)))
        .collect();
    at.sort_by(|a, b| a.0.total_cmp(&b.0));
    let style = ink.stroke_width(2);
    chart
        .draw_series(LineSeries::new(at.iter().copied(), style))?
        .label(name)
        .legend(move |(x, y)| PathElement::new(vec![(x, y), (x + 22, y)], style));
    chart.draw_series(at.iter().map(|p| Circle::new(*p, 3, ink.filled())))?;
    Ok(())
}

/// Four standard errors to either side.
fn bars<'b>(chart: &mut Chart<'_, 'b>, points: &[Point], (x, y): (&Axis, &Axis)) -> Drawn<'b> {
    let random = points.iter().filter(|p| p.half_width > 0.0);
    let bar = |p: &Point| {
        let at = place(x, p.at);
        let ends = [p.error - p.half_width, p.error + p.half_width];
        let ends = ends.map(|e| (at, place(y, e)));
        PathElement::new(ends.to_vec(), MEASURED.mix(0.5).stroke_width(1))
    };
    chart.draw_series(random.map(bar))?;
    Ok(())
}
