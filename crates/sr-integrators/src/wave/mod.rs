//! The wave: the paths of a tile advance together through short stages.
//!
//! ```text
//! generate camera rays → closest hits → emission → connect to lights → scatter, roulette → …
//! ```
//! Each stage is a function over columns. Every path has its own random numbers and its own slot
//! for radiance, so the result depends neither on how many paths a wave has nor on their order.
//!
//! The stages are generic over a [`Witness`], who sees what happens to the paths and changes nothing;
//! a render's is nobody, and nothing is left of it.

mod columns;
mod emission;
mod light;
mod replay;
mod scatter;
mod system;

pub use scatter::survival;
pub use system::add;

use columns::{Paths, Vertices};
use sr_pipeline::accel::Hit;
use sr_pipeline::light::LightSelection;
use sr_pipeline::math::Real;
use sr_pipeline::prelude::*;
use sr_pipeline::replay::{Event, PathEnd, Witness};
use sr_pipeline::{PlanItem, RayCounts};

/// How lights are sampled at a surface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightStrategy {
    /// Lights are sampled, and hit by chance as well; the power heuristic weights the two.
    Mis,
    /// Lights are sampled; those hit by chance count only where sampling could not have found
    /// them: from the camera and after delta lobes.
    Only,
    /// Only lights that no ray can meet are sampled.
    DeltaOnly,
}

/// How the next direction is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ScatterStrategy {
    /// By the lobe.
    Bsdf,
    /// Uniformly; by the lobe where it has a delta part.
    Hemisphere,
}

/// What a wave does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WaveSettings {
    /// Most bounces.
    pub max_depth: u32,
    /// Bounces before roulette starts.
    pub roulette_from: u32,
    /// Light sampling.
    pub light: LightStrategy,
    /// Direction sampling.
    pub scatter: ScatterStrategy,
    /// Light samples at each surface; where every light is sampled, of each that is more than a
    /// point or a direction.
    pub light_samples: u32,
    /// As many directions leave the last surface of a path as there are light samples; otherwise one.
    pub spreads: bool,
}

impl WaveSettings {
    /// Whether any light is worth sampling on a scene with these features.
    pub fn samples_lights(&self, features: SceneFeatures) -> bool {
        let sampled = match self.light {
            LightStrategy::DeltaOnly => SceneFeatures::DELTA_LIGHTS,
            LightStrategy::Mis | LightStrategy::Only => SceneFeatures::AREA_LIGHTS
                .union(SceneFeatures::DELTA_LIGHTS)
                .union(SceneFeatures::ENVIRONMENT),
        };
        self.max_depth > 0
            && features.contains(SceneFeatures::SMOOTH_LOBES)
            && features.intersects(sampled)
    }
}

/// Most light samples at a surface; beyond it more samples a pixel do the same good.
const MAX_LIGHT_SAMPLES: u32 = 65_536;

/// What is wrong with a number of light samples.
pub(crate) fn check_light_samples(n: u32) -> Result<(), String> {
    if (1..=MAX_LIGHT_SAMPLES).contains(&n) {
        Ok(())
    } else {
        Err(format!(
            "`light_samples` is {n} and must be between 1 and {MAX_LIGHT_SAMPLES}"
        ))
    }
}

/// An integrator that is a wave.
pub trait WaveIntegrator: Integrator {
    /// What its settings mean for the wave, or what is wrong with them.
    fn wave(settings: &Self::Settings) -> Result<WaveSettings, String>;
}

/// The stages of a wave for `steradian plan`.
pub(crate) fn wave_stages(
    settings: Result<WaveSettings, String>,
    features: SceneFeatures,
) -> Vec<PlanItem> {
    let Ok(settings) = settings else {
        return Vec::new();
    };
    let bounces = settings.max_depth > 0;
    vec![
        PlanItem::when("stage: camera rays", true, "always", ""),
        PlanItem::when("stage: closest hits", true, "always", ""),
        PlanItem::when(
            "stage: emission of surfaces",
            features.contains(SceneFeatures::AREA_LIGHTS),
            "surfaces glow",
            "no surface glows",
        ),
        PlanItem::when(
            "stage: background",
            features.contains(SceneFeatures::ENVIRONMENT),
            "there is an environment",
            "rays that leave the scene are black",
        ),
        PlanItem::when(
            "stage: connections to lights",
            settings.samples_lights(features),
            &match settings.light_samples {
                1 => "lights are sampled on lobes that are no delta functions".to_owned(),
                n => format!("lights are sampled {n} times on lobes that are no delta functions"),
            },
            "no light that is sampled, or no lobe that could use it",
        ),
        PlanItem::when(
            "stage: scatter",
            bounces,
            if settings.spreads && settings.light_samples > 1 {
                "`max_depth` is above 0; as many directions as light samples"
            } else {
                "`max_depth` is above 0"
            },
            "`max_depth` is 0",
        ),
        PlanItem::when(
            "stage: Russian roulette",
            bounces && settings.roulette_from < settings.max_depth,
            "paths may outlive `roulette_from`",
            "paths end before it would start",
        ),
    ]
}

/// A wave over one scene.
pub(crate) struct Wave<'a> {
    scene: &'a RenderScene,
    settings: WaveSettings,
    /// What the scene has.
    features: SceneFeatures,
    /// Every light is sampled at every surface, instead of one that is chosen.
    all_lights: bool,
    /// Directions that leave the last surface of a path.
    last_directions: u32,
}

impl<'a> Wave<'a> {
    /// Of what the scene has, `uses` is looked at.
    pub fn new(scene: &'a RenderScene, settings: WaveSettings, uses: SceneFeatures) -> Self {
        let all_lights = scene.light_sampler().selection() == LightSelection::All;
        let sampled = scene.lights().iter().filter(|l| !l.is_delta()).count();
        let lights = if all_lights { sampled.max(1) as u32 } else { 1 };
        Self {
            scene,
            settings,
            features: scene.features() & uses,
            all_lights,
            last_directions: if settings.spreads {
                settings.light_samples.saturating_mul(lights)
            } else {
                1
            },
        }
    }
}

/// What becomes of the paths of a wave, by slot.
#[derive(Default)]
pub(crate) struct Outcome {
    pub radiance: Vec<Vec3>,
    /// Bounces of each path.
    pub bounces: Vec<u32>,
    /// The material of each path's last surface, or `u32::MAX`.
    pub material: Vec<u32>,
}

impl Outcome {
    pub fn reset(&mut self, slots: usize) {
        self.radiance.clear();
        self.radiance.resize(slots, Vec3::ZERO);
        self.bounces.clear();
        self.bounces.resize(slots, 0);
        self.material.clear();
        self.material.resize(slots, u32::MAX);
    }
}

/// Columns that live as long as a tile, so that waves do not allocate.
pub(crate) struct Scratch<S> {
    pub paths: Paths<S>,
    /// Paths on their last ray, where several leave a surface.
    children: Paths<S>,
    hits: Vec<Hit>,
    vertices: Vertices,
    connections: light::Connections,
    alive: Vec<bool>,
}

impl<S> Default for Scratch<S> {
    fn default() -> Self {
        Self {
            paths: Paths::default(),
            children: Paths::default(),
            hits: Vec::new(),
            vertices: Vertices::default(),
            connections: light::Connections::default(),
            alive: Vec::new(),
        }
    }
}

impl Wave<'_> {
    /// Whether the weight of a light that is met by chance depends on the normal where the path
    /// came from.
    fn asks_for_normals(&self) -> bool {
        self.settings.light == LightStrategy::Mis
            && !self.all_lights
            && self.scene.light_sampler().depends_on_receiver()
    }

    /// How many directions leave a surface.
    #[inline]
    fn directions(&self, depth: u32) -> u32 {
        if depth + 1 == self.settings.max_depth {
            self.last_directions
        } else {
            1
        }
    }

    /// Runs the paths in `scratch.paths` to their ends.
    pub fn run<S: Sampler, W: Witness>(
        &self,
        scratch: &mut Scratch<S>,
        outcome: &mut Outcome,
        rays: &mut RayCounts,
        witness: &mut W,
    ) {
        let Scratch {
            paths,
            children,
            hits,
            vertices,
            connections,
            alive,
        } = scratch;
        rays.camera += paths.len() as u64;
        let samples_lights = self.settings.samples_lights(self.features);
        for depth in 0.. {
            self.arrive(paths, hits, vertices, depth, outcome, witness);
            if depth == self.settings.max_depth || paths.len() == 0 {
                end(paths, PathEnd::Depth, depth, witness);
                break;
            }
            for (slot, vertex) in paths.slot.iter().zip(&vertices.point) {
                outcome.bounces[*slot as usize] = depth + 1;
                outcome.material[*slot as usize] = vertex.material.0;
            }
            if samples_lights {
                rays.shadow +=
                    self.connect_to_lights(paths, vertices, depth, connections, outcome, witness);
            }
            let is_last = depth + 1 == self.settings.max_depth;
            if is_last && !self.last_ray_counts(self.features.contains(SceneFeatures::DELTA_LOBES))
            {
                end(paths, PathEnd::LastRay, depth, witness);
                break;
            }
            if self.directions(depth) > 1 {
                let from = std::mem::take(vertices);
                for j in 0..self.directions(depth) {
                    self.spread(paths, &from, depth, j, children, witness);
                    rays.bounce += children.len() as u64;
                    self.arrive(children, hits, vertices, depth + 1, outcome, witness);
                    end(children, PathEnd::Depth, depth + 1, witness);
                }
                break;
            }
            self.scatter(paths, vertices, depth, alive, witness);
            rays.bounce += paths.len() as u64;
        }
    }

    /// Follows the rays to the next surfaces, and adds the light that they meet there or beyond.
    fn arrive<S: Sampler, W: Witness>(
        &self,
        paths: &mut Paths<S>,
        hits: &mut Vec<Hit>,
        vertices: &mut Vertices,
        depth: u32,
        outcome: &mut Outcome,
        witness: &mut W,
    ) {
        hits.clear();
        hits.resize(paths.len(), Hit::MISS);
        self.scene.accel().closest(&paths.ray, hits);
        leave(paths, hits, witness);
        self.add_background(paths, hits, depth, outcome, witness);
        end_missed(paths, hits, depth, witness);
        paths.retain(|i| hits[i].is_hit());
        hits.retain(Hit::is_hit);
        vertices.fill(self.scene, &paths.ray, hits);
        for ((slot, hit), point) in paths.slot.iter().zip(&*hits).zip(&vertices.point) {
            let (t, point) = (hit.t, *point);
            witness.see(*slot, Event::Surface { t, point });
        }
        self.add_emission(paths, hits, vertices, depth, outcome, witness);
    }
}

/// Tells of the rays that set out, and of those that find nothing.
fn leave<S, W: Witness>(paths: &Paths<S>, hits: &[Hit], witness: &mut W) {
    for ((slot, ray), hit) in paths.slot.iter().zip(&paths.ray).zip(hits) {
        witness.see(*slot, Event::Ray(*ray));
        if !hit.is_hit() {
            witness.see(*slot, Event::Miss);
        }
    }
}

/// Tells of the paths that have left the scene.
fn end_missed<S, W: Witness>(paths: &Paths<S>, hits: &[Hit], depth: u32, witness: &mut W) {
    let why = PathEnd::Left;
    for ((slot, beta), hit) in paths.slot.iter().zip(&paths.beta).zip(hits) {
        if !hit.is_hit() {
            let beta = *beta;
            witness.see(*slot, Event::End { why, depth, beta });
        }
    }
}

/// Tells that all paths are over.
fn end<S, W: Witness>(paths: &Paths<S>, why: PathEnd, depth: u32, witness: &mut W) {
    for (slot, beta) in paths.slot.iter().zip(&paths.beta) {
        let beta = *beta;
        witness.see(*slot, Event::End { why, depth, beta });
    }
}

/// Weight of a technique with density `a` against one with density `b`: the power heuristic with
/// exponent 2 (Veach 1997, eq. 9.8), as a ratio so that squares do not overflow.
#[inline]
pub fn power_heuristic<R: Real>(a: R, b: R) -> R {
    if a == R::INFINITY {
        return R::ONE;
    }
    let ratio = b / a;
    R::ONE / (R::ONE + ratio * ratio)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn weights_of_two_techniques_sum_to_one_at_any_magnitude() {
        for a in [1e-30f32, 1e-5, 1.0, 3.0, 1e20, 1e38] {
            for b in [1e-30f32, 1e-5, 1.0, 7.0, 1e20, 1e38] {
                let sum = power_heuristic(a, b) + power_heuristic(b, a);
                // Each weight is good to about 3 ulp.
                assert!((sum - 1.0).abs() < 6.0 * f32::EPSILON, "{a} {b}: {sum}");
            }
        }
        assert_eq!(power_heuristic(1.0f32, 0.0), 1.0);
        assert_eq!(power_heuristic(f32::INFINITY, 1.0), 1.0);
    }
}
