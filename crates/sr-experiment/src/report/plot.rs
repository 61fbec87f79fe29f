//! A plot as SVG and as PNG: logarithmic axes, means with the bars of their intervals, slopes in
//! the legend. Drawn by plotters, black on white, for papers.

use super::palette::{colour, dashes};
use super::panel::{By, Panel, Series};
use super::ticks::{Axis, Marks, axis};
use plotters::chart::{ChartContext, SeriesLabelPosition};
use plotters::coord::Shift;
use plotters::prelude::*;
use sr_film::DisplayImage;
use std::sync::OnceLock;

/// Of an SVG, and of a PNG per unit of [`SCALE`].
const SIZE: (u32, u32) = (720, 480);
/// A PNG has more pixels than the SVG has units: it is printed.
const SCALE: u32 = 2;
/// The font of plots, once [`font`] was called.
pub const FONT: &str = "DejaVu Sans";
/// Text and axes. The page replaces exactly this by its own ink.
pub const INK: RGBColor = RGBColor(17, 17, 18);
/// Grid lines, likewise.
pub const GRID: RGBColor = RGBColor(222, 222, 223);

type Area<B> = DrawingArea<B, Shift>;
type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<Axis, Axis>>;

/// As the text of an SVG file.
pub(super) fn svg(panel: &Panel) -> Result<String, String> {
    font()?;
    let mut text = String::new();
    {
        let area = SVGBackend::with_string(&mut text, SIZE).into_drawing_area();
        draw(panel, &area, 1)?;
    }
    Ok(text)
}

/// As pixels.
pub(super) fn picture(panel: &Panel) -> Result<DisplayImage, String> {
    font()?;
    let (width, height) = (SCALE * SIZE.0, SCALE * SIZE.1);
    let mut bytes = vec![0u8; 3 * width as usize * height as usize];
    {
        let backend = BitMapBackend::with_buffer(&mut bytes, (width, height));
        draw(panel, &backend.into_drawing_area(), SCALE)?;
    }
    Ok(DisplayImage {
        width,
        height,
        pixels: bytes.as_chunks().0.to_vec(),
    })
}

/// Registers [`FONT`]: plotters knows fonts by names that programs register.
///
/// # Errors
/// An embedded font that cannot be read.
pub fn font() -> Result<(), String> {
    static KNOWN: OnceLock<bool> = OnceLock::new();
    let register = || {
        let of = |style, bytes| plotters::style::register_font(FONT, style, bytes).is_ok();
        of(FontStyle::Normal, dejavu::sans::regular()) && of(FontStyle::Bold, dejavu::sans::bold())
    };
    match KNOWN.get_or_init(register) {
        true => Ok(()),
        false => Err("the embedded font cannot be read".into()),
    }
}

fn draw<B: DrawingBackend>(panel: &Panel, area: &Area<B>, scale: u32) -> Result<(), String> {
    draw_all(panel, area, scale).map_err(|e| format!("plot {}: {e}", panel.id))
}

type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

fn draw_all<B: DrawingBackend>(panel: &Panel, area: &Area<B>, scale: u32) -> Drawn<B> {
    area.fill(&WHITE)?;
    let text = |size: u32| (FONT, size * scale).into_font().color(&INK);
    let points = || panel.series.iter().flat_map(|s| &s.points);
    let marks = match panel.by {
        By::Time => Marks::Decades,
        By::Samples => Marks::Doublings,
    };
    let x = axis(marks, points().map(|p| p.x));
    // An end of an interval below 0 has no place on the axis; its bar leaves the plot.
    let ends = points().flat_map(|p| [Some(p.y), p.low.filter(|l| *l > 0.1 * p.y), p.high]);
    let y = axis(Marks::Decades, ends.flatten());
    let mut chart = ChartBuilder::on(area)
        .margin(12 * scale)
        .x_label_area_size(46 * scale)
        .y_label_area_size(72 * scale)
        .build_cartesian_2d(x, y.clone())?;
    chart
        .configure_mesh()
        .x_desc(panel.x_title)
        .y_desc(panel.metric)
        .label_style(text(13))
        .axis_desc_style(text(14))
        .axis_style(INK)
        .bold_line_style(GRID)
        .light_line_style(TRANSPARENT)
        .draw()?;
    for series in &panel.series {
        curve(&mut chart, series, &y, scale)?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .margin(10 * scale)
        .legend_area_size(34 * scale)
        .background_style(WHITE.mix(0.85))
        .border_style(GRID)
        .label_font(text(13))
        .draw()?;
    area.present()
}

/// Bars first, so that lines and dots lie over them.
fn curve<B: DrawingBackend>(
    chart: &mut Chart<'_, B>,
    series: &Series,
    y: &Axis,
    scale: u32,
) -> Drawn<B> {
    let [r, g, b] = colour(series.place);
    let ink = RGBColor(r, g, b);
    let line = ink.stroke_width(2 * scale);
    let at: Vec<(f64, f64)> = series
        .points
        .iter()
        .map(|p| (p.x.log10(), p.y.log10()))
        .collect();
    for (p, (x, _)) in series.points.iter().zip(&at) {
        if let (Some(low), Some(high)) = (p.low, p.high) {
            bar(
                chart,
                *x,
                (y.range.start, [y.place(low), y.place(high)]),
                ink.mix(0.6).stroke_width(scale),
                scale,
            )?;
        }
    }
    let dash = dashes(series.place);
    match dash {
        None => chart.draw_series(LineSeries::new(at.iter().copied(), line))?,
        Some([long, gap]) => {
            let dashed = DashedLineSeries::new(at.iter().copied(), long * scale, gap * scale, line);
            chart.draw_series(dashed)?
        }
    }
    .label(legend(series))
    .legend(move |(x, y)| {
        // plotters has the middle of a line of text above that of its letters.
        let y = y - 2 * scale as i32;
        let end = (x + 24 * scale as i32, y);
        match dash {
            None => PathElement::new(vec![(x, y), end], line),
            // Room for a dash and a half: a short line tells it from a solid one.
            Some(_) => PathElement::new(vec![(x, y), (x + 11 * scale as i32, y)], line),
        }
    });
    let dots = at.iter().map(|p| Circle::new(*p, 3 * scale, ink.filled()));
    chart.draw_series(dots)?;
    Ok(())
}

fn bar<B: DrawingBackend>(
    chart: &mut Chart<'_, B>,
    x: f64,
    (lowest, ends): (f64, [f64; 2]),
    style: ShapeStyle,
    scale: u32,
) -> Drawn<B> {
    let stem = PathElement::new(ends.map(|y| (x, y)).to_vec(), style);
    chart.draw_series([stem])?;
    let half = 3 * scale as i32;
    let cap =
        |y: f64| EmptyElement::at((x, y)) + PathElement::new(vec![(-half, 0), (half, 0)], style);
    // Where the bar leaves the plot it has no end.
    chart.draw_series(ends.into_iter().filter(|y| *y > lowest).map(cap))?;
    Ok(())
}

fn legend(series: &Series) -> String {
    match &series.slope {
        Some(slope) => format!("{}: {slope}", series.label),
        None => series.label.clone(),
    }
}
