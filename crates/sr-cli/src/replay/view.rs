//! A replay with names instead of ids: what is printed, and what `--json` writes (docs/replay.md is the
//! contract of that).

use super::place::{Place, Places};
use serde::{Serialize, Serializer};
use sr_pipeline::accel::Ray;
use sr_pipeline::bevy_ecs::prelude::World;
use sr_pipeline::bsdf::LobeFlags;
use sr_pipeline::catalog::SelectedIntegrator;
use sr_pipeline::film_kernel::clamped;
use sr_pipeline::glam::{DVec3, Vec3};
use sr_pipeline::replay::{Draw, Event, Number, PathEnd, Replay};
use sr_pipeline::settings::SamplerSettings;
use sr_pipeline::{SealedScene, SurfacePoint, film_spec};

/// Version of the JSON format.
const VERSION: u32 = 1;

/// A float that JSON can hold whatever it is: what is not finite becomes text.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value(pub f32);

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, s: S) -> Result<S::Ok, S::Error> {
        if self.0.is_finite() {
            s.serialize_f32(self.0)
        } else {
            s.collect_str(&self.0)
        }
    }
}

/// A colour, a position or a direction.
pub type Triple = [Value; 3];

fn triple(v: Vec3) -> Triple {
    v.to_array().map(Value)
}

/// All there is to tell.
#[derive(Serialize)]
pub struct View {
    pub version: u32,
    pub replay: String,
    pub pixel: [u32; 2],
    pub sample: u64,
    pub size: [u32; 2],
    pub integrator: String,
    pub seed: u64,
    pub steps: Vec<Step>,
    /// What counts, in the order in which it is added up.
    pub contributions: usize,
    pub radiance: Triple,
    pub bounces: u32,
    /// Why the film refuses it.
    pub refused: Option<String>,
    pub first_defect: Option<Defect>,
    /// What `film.clamp` makes of it.
    pub clamped: Option<Triple>,
}

/// Where a sample went wrong.
#[derive(Serialize)]
pub struct Defect {
    /// Index into the steps.
    pub step: usize,
    /// The last surface before.
    pub vertex: usize,
    pub what: &'static str,
}

/// One event.
#[derive(Serialize)]
#[serde(tag = "event", rename_all = "snake_case")]
pub enum Step {
    Number {
        name: String,
        u: Vec<Value>,
        fork: u32,
        split: [u32; 2],
    },
    Ray(RayView),
    Surface(Box<Surface>),
    Miss,
    At {
        bounce: u32,
        shape: Place,
        material: Place,
    },
    Emission {
        light: Place,
        le: Triple,
        light_pdf: Option<Value>,
        weight: Value,
        contribution: Triple,
    },
    Connection {
        light: Place,
        wi: Triple,
        dist: Value,
        radiance: Triple,
        light_pdf: Value,
        f: Triple,
        scatter_pdf: Value,
        weight: Value,
        contribution: Triple,
    },
    Shadow {
        ray: RayView,
        occluded: bool,
        contribution: Option<Triple>,
    },
    Scatter {
        branch: [u32; 2],
        lobe: Vec<&'static str>,
        wi: Triple,
        weight: Triple,
        pdf: Value,
        eta: Value,
        beta: Triple,
    },
    Roulette {
        u: Value,
        survival: Value,
        lives: bool,
        beta: Triple,
    },
    End {
        why: &'static str,
        text: &'static str,
        bounces: u32,
        beta: Triple,
    },
}

/// A ray in render space.
#[derive(Serialize)]
pub struct RayView {
    pub o: Triple,
    pub d: Triple,
    pub t_max: Value,
}

/// A surface that a path reached.
#[derive(Serialize)]
pub struct Surface {
    /// From 1.
    pub vertex: usize,
    pub shape: Place,
    pub material: Place,
    pub prim: u32,
    pub t: Value,
    pub p: Triple,
    pub world: [f64; 3],
    pub ng: Triple,
    pub n: Triple,
    pub wo: Triple,
}

impl View {
    /// Of a sample in its world.
    pub fn new(world: &World, replay: &Replay) -> Self {
        // Whatever has been replayed has a picture.
        let (size, clamp) = film_spec(world)
            .map(|spec| ([spec.width, spec.height], spec.clamp))
            .unwrap_or_default();
        let mut reader = Reader {
            places: Places::new(world),
            origin: world.resource::<SealedScene>().origin(),
            vertices: 0,
        };
        let steps: Vec<Step> = replay.events.iter().map(|e| reader.step(e)).collect();
        let traced = &replay.traced;
        let refused = replay.refused();
        Self {
            version: VERSION,
            replay: replay.id.to_string(),
            pixel: replay.id.pixel,
            sample: replay.id.sample,
            size,
            integrator: integrator(world),
            seed: world.resource::<SamplerSettings>().seed,
            contributions: steps.iter().filter(|s| s.counts().is_some()).count(),
            radiance: triple(traced.radiance),
            bounces: traced.bounces,
            refused: refused.map(|r| r.to_string()),
            first_defect: replay.first_defect().map(|(step, what)| Defect {
                step,
                vertex: surfaces(&replay.events[..=step]),
                what,
            }),
            clamped: clamp
                .filter(|limit| refused.is_none() && traced.radiance.max_element() > *limit)
                .map(|limit| triple(clamped(traced.radiance, limit))),
            steps,
        }
    }
}

fn integrator(world: &World) -> String {
    let selected = world.get_resource::<SelectedIntegrator>();
    selected.map_or_else(String::new, |s| s.name.clone())
}

fn surfaces(events: &[Event]) -> usize {
    let is_surface = |e: &&Event| matches!(e, Event::Surface { .. });
    events.iter().filter(is_surface).count()
}

impl Step {
    /// What this step adds to the sample.
    pub fn counts(&self) -> Option<Triple> {
        match self {
            Self::Emission { contribution, .. } => Some(*contribution),
            Self::Shadow {
                occluded: false,
                contribution,
                ..
            } => *contribution,
            _ => None,
        }
    }
}

struct Reader<'a> {
    places: Places<'a>,
    origin: DVec3,
    vertices: usize,
}

impl Reader<'_> {
    fn step(&mut self, event: &Event) -> Step {
        match event {
            Event::Number(number) => step_of_number(number),
            Event::Ray(ray) => Step::Ray(ray_view(ray)),
            Event::Surface { t, point } => Step::Surface(Box::new(self.surface(*t, point))),
            Event::Miss => Step::Miss,
            Event::At { bounce, point } => Step::At {
                bounce: *bounce,
                shape: self.places.shape(point.shape),
                material: self.places.material(point.material),
            },
            Event::Emission(e) => Step::Emission {
                light: self.places.light(e.light),
                le: triple(e.le),
                light_pdf: e.light_pdf.map(Value),
                weight: Value(e.weight),
                contribution: triple(e.contribution),
            },
            Event::Connection(c) => Step::Connection {
                light: self.places.light(c.light),
                wi: triple(c.wi),
                dist: Value(c.dist),
                radiance: triple(c.radiance),
                light_pdf: Value(c.light_pdf),
                f: triple(c.f),
                scatter_pdf: Value(c.scatter_pdf),
                weight: Value(c.weight),
                contribution: triple(c.contribution),
            },
            Event::Shadow {
                ray,
                occluded,
                contribution,
            } => Step::Shadow {
                ray: ray_view(ray),
                occluded: *occluded,
                contribution: contribution.map(triple),
            },
            Event::Scatter(s) => Step::Scatter {
                branch: s.branch,
                lobe: words(s.lobe),
                wi: triple(s.wi),
                weight: triple(s.weight),
                pdf: Value(s.pdf),
                eta: Value(s.eta),
                beta: triple(s.beta),
            },
            Event::Roulette {
                u, survival, beta, ..
            } => Step::Roulette {
                u: Value(*u),
                survival: Value(*survival),
                lives: u < survival,
                beta: triple(*beta),
            },
            Event::End { why, depth, beta } => Step::End {
                why: name(*why),
                text: why.describe(),
                bounces: *depth,
                beta: triple(*beta),
            },
        }
    }

    fn surface(&mut self, t: f32, point: &SurfacePoint) -> Surface {
        self.vertices += 1;
        Surface {
            vertex: self.vertices,
            shape: self.places.shape(point.shape),
            material: self.places.material(point.material),
            prim: point.prim,
            t: Value(t),
            p: triple(point.p),
            world: (self.origin + point.p.as_dvec3()).to_array(),
            ng: triple(point.ng),
            n: triple(point.frame.n),
            wo: triple(point.wo),
        }
    }
}

fn step_of_number(number: &Number) -> Step {
    Step::Number {
        name: number.dim.to_string(),
        u: match number.u {
            Draw::D1(u) => vec![Value(u)],
            Draw::D2(u) => u.to_array().map(Value).to_vec(),
        },
        fork: number.fork,
        split: number.split,
    }
}

fn ray_view(ray: &Ray) -> RayView {
    RayView {
        o: triple(ray.o),
        d: triple(ray.d),
        t_max: Value(ray.t_max),
    }
}

/// The kinds of a lobe.
fn words(lobe: LobeFlags) -> Vec<&'static str> {
    [
        (LobeFlags::DIFFUSE, "diffuse"),
        (LobeFlags::GLOSSY, "glossy"),
        (LobeFlags::DELTA, "delta"),
        (LobeFlags::REFLECTION, "reflection"),
        (LobeFlags::TRANSMISSION, "transmission"),
    ]
    .into_iter()
    .filter_map(|(flag, word)| lobe.contains(flag).then_some(word))
    .collect()
}

/// As JSON has it.
fn name(why: PathEnd) -> &'static str {
    match why {
        PathEnd::Left => "left",
        PathEnd::Absorbed => "absorbed",
        PathEnd::Depth => "depth",
        PathEnd::LastRay => "last_ray",
        PathEnd::Roulette => "roulette",
    }
}
