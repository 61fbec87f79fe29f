//! A replay for people.

use super::view::{RayView, Step, Surface, Triple, Value, View};
use crate::units::counted;
use std::fmt::{self, Write};

/// The shortest digits that give the same bits back.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.0)
    }
}

/// The whole story.
pub fn of(view: &View) -> String {
    let [x, y] = view.pixel;
    let [width, height] = view.size;
    let mut text = format!(
        "sample {} of pixel {x},{y} of {width} × {height}: {}, seed {}\n\ncamera\n",
        view.sample, view.integrator, view.seed
    );
    for step in &view.steps {
        add_step(&mut text, step);
    }
    add_sum(&mut text, view);
    text
}

fn add_step(text: &mut String, step: &Step) {
    let _ = match step {
        Step::Surface(surface) => add_surface(text, surface),
        Step::Number {
            name,
            u,
            fork,
            split,
        } => {
            let u: Vec<String> = u.iter().map(ToString::to_string).collect();
            let part = part(*fork, *split);
            line(text, "number", format!("{name}{part}: {}", u.join(", ")))
        }
        Step::Ray(ray) => line(text, "ray", way(ray)),
        Step::Miss => line(text, "", "meets nothing".into()),
        Step::At {
            bounce,
            shape,
            material,
        } => line(
            text,
            "at",
            format!(
                "{}, on `{}` of `{}`",
                counted((*bounce).into(), "bounce"),
                shape.name,
                material.name
            ),
        ),
        Step::Emission {
            light,
            le,
            light_pdf,
            weight,
            contribution,
        } => {
            let pdf = match light_pdf {
                Some(pdf) => format!(", pdf of sampling it {pdf}"),
                None => String::new(),
            };
            let _ = line(
                text,
                "light met",
                format!("{light}: Le {}{pdf}, weight {weight}", triple(le)),
            );
            line(text, "", format!("adds {}", triple(contribution)))
        }
        Step::Connection { .. } => add_connection(text, step),
        Step::Shadow {
            ray,
            occluded,
            contribution,
        } => add_shadow(text, ray, *occluded, contribution.as_ref()),
        Step::Scatter { .. } => add_scatter(text, step),
        Step::Roulette {
            u,
            survival,
            lives,
            beta,
        } => line(
            text,
            "roulette",
            match lives {
                true => format!("{u} < {survival}: lives, beta {}", triple(beta)),
                false => format!("{u} ≥ {survival}: ends"),
            },
        ),
        Step::End {
            text: why,
            bounces,
            beta,
            ..
        } => line(
            text,
            "end",
            format!(
                "{why}; {}, beta {}",
                counted((*bounces).into(), "bounce"),
                triple(beta)
            ),
        ),
    };
}

fn add_surface(text: &mut String, s: &Surface) -> fmt::Result {
    let [x, y, z] = s.world;
    writeln!(text, "\nvertex {}: {} of {}", s.vertex, s.shape, s.material)?;
    line(
        text,
        "place",
        format!(
            "{} in render space, ({x}, {y}, {z}) in the world; t {}, primitive {}",
            triple(&s.p),
            s.t,
            s.prim
        ),
    )?;
    let normals = match s.n == s.ng {
        true => format!("n {}", triple(&s.n)),
        false => format!("n {}, geometric {}", triple(&s.n), triple(&s.ng)),
    };
    line(text, "normal", format!("{normals}; wo {}", triple(&s.wo)))
}

fn add_connection(text: &mut String, step: &Step) -> fmt::Result {
    let Step::Connection {
        light,
        wi,
        dist,
        radiance,
        light_pdf,
        f,
        scatter_pdf,
        weight,
        contribution,
    } = step
    else {
        return Ok(());
    };
    line(
        text,
        "light",
        format!(
            "{light}: wi {}, distance {dist}, radiance {}, pdf {light_pdf}",
            triple(wi),
            triple(radiance)
        ),
    )?;
    line(
        text,
        "",
        format!(
            "f {}, pdf of scattering there {scatter_pdf}, weight {weight}",
            triple(f)
        ),
    )?;
    if contribution.iter().all(|c| c.0 == 0.0) {
        line(text, "", "brings nothing: no shadow ray".into())?;
    }
    Ok(())
}

fn add_shadow(
    text: &mut String,
    ray: &RayView,
    occluded: bool,
    contribution: Option<&Triple>,
) -> fmt::Result {
    let end = match (occluded, contribution) {
        (true, Some(c)) => format!("occluded: {} does not arrive", triple(c)),
        (true, None) => "occluded".into(),
        (false, Some(c)) => format!("free: adds {}", triple(c)),
        (false, None) => "free".into(),
    };
    line(text, "shadow ray", way(ray))?;
    line(text, "", end)
}

fn add_scatter(text: &mut String, step: &Step) -> fmt::Result {
    let Step::Scatter {
        branch: [j, n],
        lobe,
        wi,
        weight,
        pdf,
        eta,
        beta,
    } = step
    else {
        return Ok(());
    };
    if *n > 1 {
        writeln!(text, "\ndirection {} of {n}", j + 1)?;
    }
    let eta = match eta.0 == 1.0 {
        true => String::new(),
        false => format!(", eta {eta}"),
    };
    line(
        text,
        "scatter",
        format!("{}: wi {}", lobe.join(" "), triple(wi)),
    )?;
    line(
        text,
        "",
        format!(
            "weight {}, pdf {pdf}{eta}, beta {}",
            triple(weight),
            triple(beta)
        ),
    )
}

fn add_sum(text: &mut String, view: &View) {
    let _ = write!(text, "\nradiance {}", triple(&view.radiance));
    if view.contributions > 0 {
        let parts = counted(view.contributions as u64, "contribution");
        let _ = write!(text, ", the sum of {parts}");
    }
    let _ = match (&view.refused, &view.clamped) {
        (Some(why), _) => write!(text, "\nthe film refuses it: {why}"),
        (None, Some(clamped)) => write!(text, "\nfilm.clamp makes {} of it", triple(clamped)),
        (None, None) => write!(text, "\nthe film adds it"),
    };
    if let Some(defect) = &view.first_defect {
        let place = match defect.vertex {
            0 => "at the camera".to_owned(),
            n => format!("at vertex {n}"),
        };
        let _ = write!(text, "\nfirst wrong {place}: {}", defect.what);
    }
}

fn line(text: &mut String, what: &str, rest: String) -> fmt::Result {
    writeln!(text, "  {what:10} {rest}")
}

fn way(ray: &RayView) -> String {
    let end = match ray.t_max.0 == f32::INFINITY {
        true => String::new(),
        false => format!(", t up to {}", ray.t_max),
    };
    format!("from {} along {}{end}", triple(&ray.o), triple(&ray.d))
}

/// Which of several decisions that share a dimension.
fn part(fork: u32, [j, n]: [u32; 2]) -> String {
    let mut part = String::new();
    if fork > 0 {
        let _ = write!(part, ", number {fork}");
    }
    if n > 1 {
        let _ = write!(part, ", {} of {n}", j + 1);
    }
    part
}

fn triple([x, y, z]: &Triple) -> String {
    format!("({x}, {y}, {z})")
}
