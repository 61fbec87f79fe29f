//! The path tracer in `f64`: what the wave of `Path` and `PathBsdf` does, for one path.
//!
//! Lobes and lights are the renderer's own formulas over `f64`, at parameters and tables as they are. Intersections,
//! surface points and camera rays are written once more.

use super::camera::camera_way;
use super::steps::{Step, brings};
use super::tree::{Tree, Way};
use super::vertex::Vertex;
use sr_integrators::wave::{LightStrategy, WaveSettings, power_heuristic, survival};
use sr_pipeline::accel::PRIM_NONE;
use sr_pipeline::bsdf::{LobeFlags, TransportMode};
use sr_pipeline::glam::{DVec3, Vec2};
use sr_pipeline::light::{LightSampleOf, LightSelection, Receiver};
use sr_pipeline::prelude::{BounceDim, Dim, Sampler, SceneFeatures};
use sr_pipeline::replay::{PathEnd, SampleId};
use sr_pipeline::sampling::FilterSampler;
use sr_pipeline::{LightId, RenderScene, SampleSource, Samples, ShapeId};

/// Traces any sample of a picture in `f64`.
pub(super) struct Tracer<'a> {
    pub scene: &'a RenderScene,
    pub settings: WaveSettings,
    pub filter: FilterSampler,
    pub samples: Samples,
    tree: Tree<'a>,
    /// By light: the primitive that glows, or [`PRIM_NONE`].
    glowing: Vec<u32>,
}

/// A path, once it is over.
pub(super) struct Traced {
    pub radiance: DVec3,
    pub steps: Vec<Step>,
    /// The surfaces that it met.
    pub vertices: Vec<Vertex>,
}

/// A path on its way.
struct Walk<S> {
    way: Way,
    beta: DVec3,
    /// Density of the direction; infinite where no sampling of lights competes.
    pdf: f64,
    /// Where the direction was chosen, for the sampling of lights and for the choice among them.
    from: DVec3,
    receiver: Receiver,
    /// Product of η² over refractions.
    eta_scale: f64,
    sampler: S,
    depth: u32,
    radiance: DVec3,
}

fn wide(u: Vec2) -> [f64; 2] {
    u.to_array().map(f64::from)
}

impl<'a> Tracer<'a> {
    pub fn new(
        scene: &'a RenderScene,
        settings: WaveSettings,
        filter: FilterSampler,
        samples: Samples,
    ) -> Self {
        let mut glowing = vec![PRIM_NONE; scene.lights().len()];
        let geometry = scene.accel().geometry();
        let shapes = (0..scene.shape_count() as u32).map(|s| scene.shape(ShapeId(s)));
        if shapes.clone().any(|s| s.first_light.is_some()) {
            for prim in 0..geometry.prim_count() as u32 {
                if let Some(light) = scene.light_of(prim) {
                    glowing[light.index()] = prim;
                }
            }
        }
        Self {
            scene,
            settings,
            filter,
            samples,
            tree: Tree::new(geometry),
            glowing,
        }
    }

    pub fn trace(&self, id: SampleId) -> Traced {
        match self.samples {
            Samples::Sobol(s) => self.walk(id.pixel, s.at(id.pixel, id.sample)),
            Samples::Independent(s) => self.walk(id.pixel, s.at(id.pixel, id.sample)),
        }
    }

    fn walk<S: Sampler>(&self, pixel: [u32; 2], sampler: S) -> Traced {
        let way = camera_way(self.scene.camera(), &self.filter, pixel, &sampler);
        let mut walk = Walk {
            way,
            beta: DVec3::ONE,
            pdf: f64::INFINITY,
            from: way.line.o,
            receiver: Receiver::anywhere(way.line.o.as_vec3()),
            eta_scale: 1.0,
            sampler,
            depth: 0,
            radiance: DVec3::ZERO,
        };
        let (mut steps, mut vertices) = (Vec::new(), Vec::new());
        loop {
            let mut step = Step::default();
            match self.tree.closest(&walk.way) {
                None => {
                    self.add_background(&mut walk, &mut step);
                    step.end = Some(PathEnd::Left);
                }
                Some(hit) => {
                    let vertex = Vertex::new(self.scene, &walk.way.line, &hit);
                    step.prim = Some(hit.prim);
                    self.add_emission(&mut walk, &vertex, &mut step);
                    step.end = self.advance(&mut walk, &vertex, &mut step);
                    vertices.push(vertex);
                }
            }
            let is_over = step.end.is_some();
            steps.push(step);
            if is_over {
                let radiance = walk.radiance;
                return Traced {
                    radiance,
                    steps,
                    vertices,
                };
            }
            walk.depth += 1;
        }
    }

    /// From a surface on; why the path ends there, if it does.
    fn advance<S: Sampler>(
        &self,
        walk: &mut Walk<S>,
        vertex: &Vertex,
        step: &mut Step,
    ) -> Option<PathEnd> {
        if walk.depth == self.settings.max_depth {
            return Some(PathEnd::Depth);
        }
        let features = self.scene.features();
        if self.settings.samples_lights(features) {
            self.connect_to_lights(walk, vertex, step);
        }
        // With the strategies of `Path` and `PathBsdf` a last ray counts where there is anything to be met.
        let met = SceneFeatures::AREA_LIGHTS.union(SceneFeatures::ENVIRONMENT);
        if walk.depth + 1 == self.settings.max_depth && !features.intersects(met) {
            return Some(PathEnd::LastRay);
        }
        self.scatter(walk, vertex, step)
    }

    fn add_background<S>(&self, walk: &mut Walk<S>, step: &mut Step) {
        if !self.scene.features().contains(SceneFeatures::ENVIRONMENT) {
            return;
        }
        let d = walk.way.line.d;
        for light in self.scene.infinite_lights() {
            let le = self.scene.light(*light).le_environment_real(d.to_array());
            let weight = self.chance_weight(walk, *light, f64::INFINITY, DVec3::ZERO);
            walk.radiance += walk.beta * DVec3::from(le) * weight;
            step.met.push(*light);
        }
    }

    fn add_emission<S>(&self, walk: &mut Walk<S>, vertex: &Vertex, step: &mut Step) {
        let Some(light) = self.scene.light_of(vertex.prim) else {
            return;
        };
        // Which side glows; how much is a constant.
        let (wo, ng) = (vertex.wo.as_vec3(), vertex.ng.as_vec3());
        let le = self.scene.light(light).le(wo, ng).as_dvec3();
        if le != DVec3::ZERO {
            let weight = self.chance_weight(walk, light, vertex.t, vertex.ng);
            walk.radiance += walk.beta * le * weight;
            step.met.push(light);
        }
    }

    /// What a light that was met by chance counts.
    fn chance_weight<S>(&self, walk: &Walk<S>, light: LightId, dist: f64, ng: DVec3) -> f64 {
        if walk.pdf == f64::INFINITY || self.settings.light != LightStrategy::Mis {
            return 1.0;
        }
        let (from, d) = (walk.from.to_array(), walk.way.line.d.to_array());
        let pdf = self.scene.light(light);
        let pdf = pdf.pdf_li_real(from, d, dist, ng.to_array());
        let choice = if self.samples_all() {
            1.0
        } else {
            f64::from(self.scene.light_sampler().pmf(&walk.receiver, light.0))
        };
        let samples = f64::from(self.settings.light_samples);
        power_heuristic(walk.pdf, samples * choice * pdf)
    }

    fn samples_all(&self) -> bool {
        self.scene.light_sampler().selection() == LightSelection::All
    }

    fn connect_to_lights<S: Sampler>(&self, walk: &mut Walk<S>, vertex: &Vertex, step: &mut Step) {
        let bsdf = &self.scene.material(vertex.material).bsdf;
        let wide = LobeFlags::DIFFUSE | LobeFlags::GLOSSY;
        if !bsdf.flags().intersects(wide) {
            return;
        }
        if self.samples_all() {
            self.sample_every_light(walk, vertex, step);
        } else {
            self.sample_some_lights(walk, vertex, step);
        }
    }

    fn sample_some_lights<S: Sampler>(&self, walk: &mut Walk<S>, vertex: &Vertex, step: &mut Step) {
        let n = self.settings.light_samples;
        let receiver = self.receiver(vertex);
        for j in 0..n {
            let sampler = walk.sampler.split(j, n);
            let u_select = sampler.d1(Dim::bounce(walk.depth, BounceDim::LightSelect));
            let u = sampler.d2(Dim::bounce(walk.depth, BounceDim::Light));
            let chosen = self.scene.light_sampler().select(&receiver, u_select);
            let Some((index, pmf, _)) = chosen else {
                continue;
            };
            let light = LightId(index);
            if let Some(sample) = self.sample_light(light, vertex, u, f64::from(pmf)) {
                self.connect(walk, vertex, (light, sample), n, step);
            }
        }
    }

    fn sample_every_light<S: Sampler>(&self, walk: &mut Walk<S>, vertex: &Vertex, step: &mut Step) {
        for k in 0..self.scene.lights().len() as u32 {
            let light = LightId(k);
            let is_delta = self.scene.light(light).is_delta();
            let n = if is_delta {
                1
            } else {
                self.settings.light_samples
            };
            let own = walk.sampler.fork(k);
            for j in 0..n {
                let u = own
                    .split(j, n)
                    .d2(Dim::bounce(walk.depth, BounceDim::Light));
                if let Some(sample) = self.sample_light(light, vertex, u, 1.0) {
                    self.connect(walk, vertex, (light, sample), n, step);
                }
            }
        }
    }

    /// A point on a light, unless the strategy leaves that light to chance.
    fn sample_light(
        &self,
        light: LightId,
        vertex: &Vertex,
        u: Vec2,
        choice: f64,
    ) -> Option<LightSampleOf<f64>> {
        let light = self.scene.light(light);
        if self.settings.light == LightStrategy::DeltaOnly && !light.is_delta() {
            return None;
        }
        let sample = light.sample_li_real(vertex.p.to_array(), wide(u))?;
        let pdf = choice * sample.pdf;
        Some(LightSampleOf { pdf, ..sample })
    }

    /// One of `n` samples: what it brings, if nothing is in the way.
    fn connect<S: Sampler>(
        &self,
        walk: &mut Walk<S>,
        vertex: &Vertex,
        (light, sample): (LightId, LightSampleOf<f64>),
        n: u32,
        step: &mut Step,
    ) {
        let n = f64::from(n);
        let (wo, wi) = (vertex.local(vertex.wo), DVec3::from(sample.wi));
        let local = vertex.local(wi);
        if !vertex.scatters_along(self.scene, wi) {
            return;
        }
        let bsdf = &self.scene.material(vertex.material).bsdf;
        let (f, scatter_pdf) = bsdf.eval_pdf_real(wo, local, TransportMode::Radiance);
        let competes = self.settings.light == LightStrategy::Mis && !sample.is_delta;
        let weight = match competes {
            true => power_heuristic(n * sample.pdf, scatter_pdf),
            false => 1.0,
        };
        let arrives = DVec3::from(sample.radiance) / sample.pdf * (local[2].abs() * (weight / n));
        let contribution = walk.beta * DVec3::from(f) * arrives;
        if !brings(contribution) {
            step.connections.push((light, None));
            return;
        }
        let way = if self.scene.light(light).is_infinite() {
            vertex.spawn(wi)
        } else {
            let ng = DVec3::from(sample.ng);
            let err = DVec3::from(sample.p_err).dot(ng.abs());
            let reaches = self.glowing[light.index()];
            vertex.spawn_to(wi, sample.p.into(), err, ng, reaches)
        };
        let occluded = self.tree.occluded(&way);
        if !occluded {
            walk.radiance += contribution;
        }
        step.connections.push((light, Some(occluded)));
    }

    /// What the choice among lights, whose tables are `f32`, knows of a surface point.
    fn receiver(&self, vertex: &Vertex) -> Receiver {
        if self.scene.light_sampler().depends_on_receiver() {
            self.scene.receiver(&vertex.narrow(self.scene))
        } else {
            Receiver::anywhere(vertex.p.as_vec3())
        }
    }

    fn scatter<S: Sampler>(
        &self,
        walk: &mut Walk<S>,
        vertex: &Vertex,
        step: &mut Step,
    ) -> Option<PathEnd> {
        let bsdf = &self.scene.material(vertex.material).bsdf;
        let u = wide(walk.sampler.d2(Dim::bounce(walk.depth, BounceDim::Bsdf)));
        let uc = walk.sampler.d1(Dim::bounce(walk.depth, BounceDim::Lobe));
        let wo = vertex.local(vertex.wo);
        let sample = bsdf.sample_real(wo, f64::from(uc), u, TransportMode::Radiance);
        let Some(sample) = sample else {
            return Some(PathEnd::Absorbed);
        };
        let wi = vertex.world(sample.wi);
        if !vertex.scatters_along(self.scene, wi) {
            return Some(PathEnd::Absorbed);
        }
        let is_delta = sample.lobe.is_delta();
        walk.beta *= DVec3::from(sample.weight);
        walk.eta_scale *= sample.eta * sample.eta;
        walk.pdf = if is_delta { f64::INFINITY } else { sample.pdf };
        walk.from = vertex.p;
        walk.receiver = self.receiver(vertex);
        walk.way = vertex.spawn(wi);
        step.lobe = Some(sample.lobe);
        if walk.beta == DVec3::ZERO {
            return Some(PathEnd::Absorbed);
        }
        self.play_roulette(walk, step)
    }

    fn play_roulette<S: Sampler>(&self, walk: &mut Walk<S>, step: &mut Step) -> Option<PathEnd> {
        if walk.depth < self.settings.roulette_from {
            return None;
        }
        let survival = survival((walk.beta * walk.eta_scale).max_element());
        let u = walk
            .sampler
            .d1(Dim::bounce(walk.depth, BounceDim::Roulette));
        let lives = f64::from(u) < survival;
        step.lives = Some(lives);
        walk.beta /= survival;
        (!lives).then_some(PathEnd::Roulette)
    }
}
