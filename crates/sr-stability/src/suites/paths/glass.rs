//! Paths of more than a thousand bounces in glass.

use crate::{Bench, Effort, Point, Sweep};
use sr_pipeline::{FilmResource, RenderReport};
use std::fmt::Write;
use std::ops::ControlFlow;

/// Shells of glass around the camera, so that its rays meet each interface close to its normal: 4 % turn back,
/// and a path through n interfaces takes some n² / 25 steps. Nothing is absorbed, so that the constant environment is
/// seen through all of it.
fn scene(interfaces: usize) -> String {
    let mut text = String::from(
        "(film: (width: 8, height: 8), entities: {\
         \"in\": {\"Dielectric\": (ior: 1.5)}, \"out\": {\"Dielectric\": (ior: 0.6666667)},\
         \"sky\": {\"Environment\": ()},\
         \"camera\": {\"PerspectiveCamera\": (vfov_deg: 60), \"LookAt\": (from: (0.01, 0.02, 0.03), to: (0, 0, -1)), \
         \"ActiveCamera\": ()},",
    );
    for i in 0..interfaces {
        // An even number: as many ways into glass as out of it.
        let material = if i % 2 == 0 { "in" } else { "out" };
        let radius = 1.0 + 0.01 * i as f64;
        let _ = write!(
            text,
            "\"{i}\": {{\"Sphere\": (radius: {radius:.2}), \"MaterialRef\": \"{material}\"}},"
        );
    }
    text + "})"
}

pub(super) fn shells(effort: &Effort) -> Sweep {
    let most = effort.choose(3, 4);
    let points = [2, 20, 200, 600][..most].iter().map(|n| shell_point(*n));
    Sweep {
        name: "glass_shells".into(),
        about: "Through n interfaces of clear glass a constant environment of radiance 1 is seen as it is; of 200 \
                interfaces a path takes more than a thousand bounces."
            .into(),
        parameter: "interfaces".into(),
        error: "relative error of the picture's mean".into(),
        // A bounce rounds the throughput by two ulp at most, and the 20 000 bounces of the longest paths as a
        // random walk.
        bound: 1e-4,
        holds: [2.0, 600.0],
        points: points.collect(),
    }
}

fn shell_point(interfaces: usize) -> Point {
    let at = interfaces as f64;
    match mean_of(interfaces) {
        Ok((mean, bounces)) => {
            let worst = format!("mean {mean:.7} after {bounces:.0} bounces a path");
            Point::new(at, (mean - 1.0).abs(), worst)
        }
        Err(why) => Point::new(at, f64::INFINITY, why),
    }
}

/// Mean of the picture, and bounces a path.
fn mean_of(interfaces: usize) -> Result<(f64, f64), String> {
    // Longer paths than 65 536 bounces are one in 10¹⁷.
    let set = [
        ("integrator", "Path(max_depth: 65536, roulette_from: None)"),
        ("budget.samples", "4"),
    ];
    let mut pipeline = Bench::new(0).scene(&scene(interfaces), &set)?;
    let stop = pipeline.render(|_| ControlFlow::Continue(()));
    stop.map_err(|e| e.to_string())?;
    let film = pipeline.world.resource::<FilmResource>();
    let picture = film.film.resolve(film.estimator).rgb;
    let sum: f64 = picture.pixels.iter().map(|p| f64::from(p.y)).sum();
    let report = pipeline.world.resource::<RenderReport>();
    let rays = report.tiles.rays;
    match report.tiles.rejects.total() {
        0 => Ok((
            sum / picture.pixels.len() as f64,
            rays.bounce as f64 / rays.camera as f64,
        )),
        n => Err(format!("{n} samples were refused")),
    }
}
