//! The columns of a wave.

use sr_pipeline::accel::{Hit, Ray};
use sr_pipeline::light::Receiver;
use sr_pipeline::prelude::*;

/// Living paths, a column each for what the stages need.
pub(crate) struct Paths<S> {
    /// The ray to trace next.
    pub ray: Vec<Ray>,
    /// Throughput.
    pub beta: Vec<Vec3>,
    /// Solid-angle density of the ray's direction, times the number of directions that share its
    /// surface; infinite where no light sampling competes: from the camera and after a delta lobe.
    pub pdf: Vec<f32>,
    /// Where the direction was chosen: the reference point of the competing light sampling.
    pub from: Vec<Vec3>,
    /// The normal there, as the choice among lights asks for it; empty when nothing asks.
    pub from_n: Vec<Vec3>,
    /// Product of η² over refractions: undoes the radiance scaling for roulette.
    pub eta_scale: Vec<f32>,
    /// The random numbers of the sample.
    pub sampler: Vec<S>,
    /// Where the path's radiance is summed.
    pub slot: Vec<u32>,
}

impl<S> Default for Paths<S> {
    fn default() -> Self {
        Self {
            ray: Vec::new(),
            beta: Vec::new(),
            pdf: Vec::new(),
            from: Vec::new(),
            from_n: Vec::new(),
            eta_scale: Vec::new(),
            sampler: Vec::new(),
            slot: Vec::new(),
        }
    }
}

impl<S: Copy> Paths<S> {
    pub fn len(&self) -> usize {
        self.ray.len()
    }

    pub fn clear(&mut self) {
        self.truncate(0);
    }

    /// Keeps the first `len` paths.
    pub fn truncate(&mut self, len: usize) {
        self.ray.truncate(len);
        self.beta.truncate(len);
        self.pdf.truncate(len);
        self.from.truncate(len);
        self.from_n.truncate(len);
        self.eta_scale.truncate(len);
        self.sampler.truncate(len);
        self.slot.truncate(len);
    }

    /// Where the direction of path `i` was chosen, as the choice among lights sees it.
    #[inline]
    pub fn receiver(&self, i: usize) -> Receiver {
        Receiver {
            p: self.from[i],
            n: self.from_n.get(i).copied().unwrap_or(Vec3::ZERO),
        }
    }

    /// A new path from the camera.
    pub fn push(&mut self, ray: Ray, sampler: S) {
        self.slot.push(self.ray.len() as u32);
        self.ray.push(ray);
        self.beta.push(Vec3::ONE);
        self.pdf.push(f32::INFINITY);
        self.from.push(ray.o);
        self.eta_scale.push(1.0);
        self.sampler.push(sampler);
    }

    /// A path that goes on from path `i` of others, with other numbers.
    pub fn push_child(&mut self, others: &Self, i: usize, sampler: S) {
        self.slot.push(others.slot[i]);
        self.ray.push(others.ray[i]);
        self.beta.push(others.beta[i]);
        self.pdf.push(others.pdf[i]);
        self.from.push(others.from[i]);
        self.eta_scale.push(others.eta_scale[i]);
        self.sampler.push(sampler);
    }

    /// Drops the paths whose index `keep` refuses; the others keep their order.
    pub fn retain(&mut self, mut keep: impl FnMut(usize) -> bool) {
        let mut kept = 0;
        for i in 0..self.len() {
            if keep(i) {
                if kept != i {
                    self.ray[kept] = self.ray[i];
                    self.beta[kept] = self.beta[i];
                    self.pdf[kept] = self.pdf[i];
                    self.from[kept] = self.from[i];
                    if let Some(n) = self.from_n.get(i).copied() {
                        self.from_n[kept] = n;
                    }
                    self.eta_scale[kept] = self.eta_scale[i];
                    self.sampler[kept] = self.sampler[i];
                    self.slot[kept] = self.slot[i];
                }
                kept += 1;
            }
        }
        self.truncate(kept);
    }
}

/// The surfaces that the paths have reached, in the paths' order.
#[derive(Default)]
pub(crate) struct Vertices {
    pub point: Vec<SurfacePoint>,
}

impl Vertices {
    pub fn fill(&mut self, scene: &RenderScene, rays: &[Ray], hits: &[Hit]) {
        self.point.clear();
        self.point.extend(
            rays.iter()
                .zip(hits)
                .map(|(ray, hit)| scene.surface(ray, hit)),
        );
    }
}
