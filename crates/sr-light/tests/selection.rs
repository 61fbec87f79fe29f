//! The choice of a light by place: probabilities that sum to 1, are honoured, and never leave out a
//! light that may contribute.

use glam::{Vec2, Vec3};
use sr_light::{
    ConstantEnvironment, DirectionalLight, Light, LightSampler, LightSelection, PointLight,
    QuadLight, Receiver, SphereLight, SpotLight, TriangleLight,
};
use sr_math::{hash, warp};
use sr_stats::{chi2_test, sidak};
use std::time::Instant;

/// Hashed numbers in `[0, 1)`, one after the other.
struct Numbers(u32, u32);

impl Numbers {
    fn next(&mut self) -> f32 {
        self.1 += 1;
        hash::unit_f32(hash::mix(self.0, self.1))
    }

    /// A point of the cube of half side `size` about `center`.
    fn point(&mut self, center: Vec3, size: f32) -> Vec3 {
        let [x, y, z] = [0, 1, 2].map(|_| 2.0 * self.next() - 1.0);
        center + size * Vec3::new(x, y, z)
    }

    fn direction(&mut self) -> Vec3 {
        warp::uniform_sphere([self.next(), self.next()]).into()
    }
}

/// One light of any kind with a place, about `size` large, `brightness` bright.
fn any_light(r: &mut Numbers, at: Vec3, size: f32, brightness: f32) -> Light {
    let radiance = Vec3::splat(brightness);
    let two_sided = r.next() < 0.3;
    let mut edge = || size * r.direction() * (0.1 + 0.9 * r.next());
    let (a, b) = (edge(), edge());
    match (5.0 * r.next()) as u32 {
        0 => Light::Triangle(TriangleLight::new(
            [at, at + a, at + b],
            radiance,
            two_sided,
        )),
        1 => Light::Quad(QuadLight::new(at, a, b, radiance, two_sided)),
        2 => Light::Sphere(SphereLight::new(
            at,
            0.5 * size * r.next(),
            radiance,
            two_sided,
        )),
        3 => Light::Point(PointLight {
            p: at,
            intensity: size * size * radiance,
        }),
        _ => {
            let outer = 1.57 * r.next();
            Light::Spot(SpotLight {
                p: at,
                axis: r.direction(),
                intensity: size * size * radiance,
                cos_inner: (outer * r.next()).cos(),
                cos_outer: outer.cos(),
            })
        }
    }
}

fn sun(r: &mut Numbers, irradiance: f32) -> Light {
    Light::Directional(DirectionalLight {
        wi: r.direction(),
        irradiance: Vec3::splat(irradiance),
    })
}

fn sky(radiance: f32) -> Light {
    Light::Environment(ConstantEnvironment {
        radiance: Vec3::splat(radiance),
    })
}

/// `count` lights in a cube of half side 1 about `center`, scaled by `scale`; every third scene has
/// two suns and a sky too. Brightness goes over nine orders of magnitude in every fourth.
fn scene(seed: u32, count: usize, center: Vec3, scale: f32) -> Vec<Light> {
    let mut r = Numbers(seed, 0);
    let mut lights: Vec<Light> = (0..count)
        .map(|_| {
            let brightness = if seed.is_multiple_of(4) {
                10f32.powf(9.0 * r.next())
            } else {
                0.5 + r.next()
            };
            let at = r.point(center, scale);
            any_light(&mut r, at, 0.2 * scale, brightness)
        })
        .collect();
    if seed.is_multiple_of(3) {
        lights.push(sky(0.3));
        let (a, b) = (sun(&mut r, 0.1), sun(&mut r, 1e-3));
        lights.insert(count / 2, a);
        lights.push(b);
    }
    lights
}

fn spatial(lights: &[Light]) -> LightSampler {
    LightSampler::new(lights, LightSelection::Spatial, Vec3::ZERO, 10.0)
}

/// Receivers among the lights, on one of them, near and far; every other one with a normal.
fn receiver(r: &mut Numbers, lights: &[Light], center: Vec3, scale: f32) -> Receiver {
    let p = match (5.0 * r.next()) as u32 {
        0 => r.point(center, 1.2 * scale),
        1 => r.point(center, 30.0 * scale),
        2 => r.point(center, 1e4 * scale),
        _ => {
            let k = (r.next() * lights.len() as f32) as usize;
            let bounds = lights[k].bounds();
            let at = bounds.map_or(center, |b| b.min + (b.max - b.min) * r.next());
            let off = scale * 10f32.powf(-8.0 * r.next());
            at + off * r.direction()
        }
    };
    let n = if r.next() < 0.5 {
        Vec3::ZERO
    } else {
        r.direction()
    };
    Receiver { p, n }
}

/// Places and sizes: about the origin, far from it, tiny and huge.
const PLACES: [(Vec3, f32); 4] = [
    (Vec3::ZERO, 1.0),
    (Vec3::new(1e4, -2e4, 5e3), 3.0),
    (Vec3::ZERO, 1e-6),
    (Vec3::new(3e8, 0.0, 1e8), 1e9),
];

/// What is left of 1 is the probability of no light, which a grid of `u` measures: each of at most
/// 2·n + 2 intervals is met to within a step at either end. An error of 1 % in any receiver is found.
#[test]
fn probabilities_sum_to_one_with_that_of_no_light() {
    const STEPS: u32 = 1 << 14;
    for seed in 0..24 {
        let count = [1, 2, 3, 20][seed as usize % 4];
        let (center, scale) = PLACES[seed as usize / 4 % 4];
        let lights = scene(seed, count, center, scale);
        let sampler = spatial(&lights);
        let mut r = Numbers(seed, 1 << 20);
        for _ in 0..12 {
            let receiver = receiver(&mut r, &lights, center, scale);
            let sum: f64 = (0..lights.len() as u32)
                .map(|k| f64::from(sampler.pmf(&receiver, k)))
                .sum();
            let mut none = 0;
            for k in 0..STEPS {
                match sampler.select(&receiver, k as f32 / STEPS as f32) {
                    None => none += 1,
                    Some((index, pmf, rest)) => {
                        let again = sampler.pmf(&receiver, index);
                        // The same factors in another order: 64 roundings at most.
                        assert!((pmf / again - 1.0).abs() < 64.0 * f32::EPSILON);
                        assert!((0.0..1.0).contains(&rest));
                    }
                }
            }
            let total = sum + f64::from(none) / f64::from(STEPS);
            assert!(
                (total - 1.0).abs() < 0.01,
                "{seed} {receiver:?}: {sum} {none}"
            );
        }
    }
}

/// χ² of 40,000 choices at 80 receivers, 10⁻⁴ in all; an error of 5 % in half of the lights is found.
#[test]
fn lights_are_chosen_as_often_as_the_probability_says() {
    const CHOICES: u32 = 40_000;
    for seed in 0..8 {
        let lights = scene(seed + 100, 30, Vec3::ZERO, 1.0);
        let sampler = spatial(&lights);
        let mut r = Numbers(seed, 1 << 21);
        for _ in 0..10 {
            let receiver = receiver(&mut r, &lights, Vec3::ZERO, 1.0);
            let mut counts = vec![0u64; lights.len() + 1];
            for _ in 0..CHOICES {
                let chosen = sampler.select(&receiver, r.next());
                counts[chosen.map_or(lights.len(), |c| c.0 as usize)] += 1;
            }
            let mut expected: Vec<f64> = (0..lights.len() as u32)
                .map(|k| f64::from(sampler.pmf(&receiver, k)))
                .collect();
            expected.push((1.0 - expected.iter().sum::<f64>()).max(0.0));
            expected.iter_mut().for_each(|e| *e *= f64::from(CHOICES));
            let p = chi2_test(&counts, &expected, 5.0).p_value;
            assert!(p > sidak(1e-4, 80), "{seed} {receiver:?}: {p}");
        }
    }
}

/// Brute force: whatever a light sends to a receiver, from the side of its normal, it must have had a
/// chance. Half of the receivers are grazed by the light or by the horizon on purpose.
#[test]
fn no_light_that_contributes_is_left_out() {
    let (mut contributing, mut grazing) = (0, 0);
    for seed in 0..160 {
        let (center, scale) = PLACES[seed as usize % 4];
        let lights = scene(seed + 1000, 12, center, scale);
        let sampler = spatial(&lights);
        let mut r = Numbers(seed, 1 << 22);
        for _ in 0..60 {
            let mut receiver = receiver(&mut r, &lights, center, scale);
            for (k, light) in lights.iter().enumerate() {
                for _ in 0..6 {
                    let u = Vec2::new(r.next(), r.next());
                    let Some(s) = light.sample_li(receiver.p, u) else {
                        continue;
                    };
                    // The horizon goes through the very point, but for rounding.
                    if receiver.n != Vec3::ZERO && r.next() < 0.5 {
                        let side = s.wi.cross(r.direction()).normalize_or_zero();
                        receiver.n = (side + 1e-6 * (r.next() - 0.3) * s.wi).normalize_or_zero();
                    }
                    if receiver.n != Vec3::ZERO && s.wi.dot(receiver.n) <= 0.0 {
                        continue;
                    }
                    contributing += 1;
                    let cos = s.wi.dot(receiver.n);
                    grazing += u32::from(receiver.n != Vec3::ZERO && cos < 1e-5);
                    let pmf = sampler.pmf(&receiver, k as u32);
                    assert!(
                        pmf > 0.0 && pmf <= 1.0,
                        "{seed} {receiver:?} {light:?}: {pmf}"
                    );
                }
            }
        }
    }
    assert!(
        contributing > 100_000 && grazing > 10_000,
        "{contributing} {grazing}"
    );
}

/// A point of the light just in sight of a small lamp's own horizon: the other cosine.
#[test]
fn receivers_near_the_plane_of_a_lamp_see_it_as_sampling_does() {
    let mut seen = 0;
    for seed in 0..40_000 {
        let mut r = Numbers(seed, 0);
        let at = r.point(Vec3::ZERO, 3.0);
        let (a, b) = (0.1 * r.direction(), 0.1 * r.direction());
        let lamp = TriangleLight::new([at, at + a, at + b], Vec3::ONE, false);
        let along = lamp.ng().cross(r.direction()).normalize_or_zero();
        let height = 10f32.powf(-2.0 - 6.0 * r.next());
        let p = at + 4.0 * r.next() * along + height * lamp.ng();
        let far = sky(1e-3);
        let lights = [Light::Triangle(lamp), far];
        if lights[0].sample_li(p, Vec2::splat(0.4)).is_some() {
            seen += 1;
            assert!(spatial(&lights).pmf(&Receiver::anywhere(p), 0) > 0.0, "{p}");
        }
    }
    assert!(seen > 20_000, "{seen}");
}

#[test]
fn lights_behind_the_receiver_or_turned_away_get_nothing() {
    let lamp = |at: Vec3, ng: Vec3| {
        let (u, v) = ng.any_orthonormal_pair();
        Light::Quad(QuadLight::new(at, 0.1 * u, 0.1 * v, Vec3::ONE, false))
    };
    let lights = [
        lamp(Vec3::new(0.0, 2.0, 0.0), Vec3::NEG_Y),
        lamp(Vec3::new(0.5, 2.0, 0.0), Vec3::Y),
        lamp(Vec3::new(0.0, -2.0, 0.0), Vec3::Y),
        sky(0.0),
    ];
    let sampler = spatial(&lights);
    let up = Receiver {
        p: Vec3::ZERO,
        n: Vec3::Y,
    };
    let pmf = |receiver: &Receiver| [0, 1, 2, 3].map(|k| sampler.pmf(receiver, k));
    assert_eq!(pmf(&up), [1.0, 0.0, 0.0, 0.0]);
    let glass = Receiver::anywhere(Vec3::ZERO);
    let [above, away, below, black] = pmf(&glass);
    assert!(above > 0.3 && below > 0.3, "{above} {below}");
    assert_eq!((away, black), (0.0, 0.0));
    for k in 0..100 {
        let chosen = sampler.select(&up, k as f32 / 100.0);
        assert!(chosen.is_none_or(|c| c.0 == 0), "{chosen:?}");
    }
}

#[test]
fn a_lamp_nearby_counts_as_much_as_a_sky_that_is_as_bright_there() {
    // A lamp 2 m above, of 1 W/sr down, gives about as much as a sky of 0.25/π.
    let lamp = QuadLight::new(
        Vec3::new(-0.05, 2.0, -0.05),
        Vec3::new(0.1, 0.0, 0.0),
        Vec3::new(0.0, 0.0, 0.1),
        Vec3::splat(100.0),
        false,
    );
    let lights = [Light::Quad(lamp), sky(0.25 / std::f32::consts::PI)];
    for radius in [1.0, 1e3, 1e6] {
        let sampler = LightSampler::new(&lights, LightSelection::Spatial, Vec3::ZERO, radius);
        let up = Receiver {
            p: Vec3::ZERO,
            n: Vec3::Y,
        };
        let pmf = sampler.pmf(&up, 0);
        assert!((pmf - 0.5).abs() < 0.01, "{radius}: {pmf}");
    }
}

/// Far below what 24 bits of `u` can tell, all is finite and positive.
#[test]
fn extreme_ratios_leave_every_light_a_chance() {
    let lights: Vec<Light> = (0..200)
        .map(|k| {
            Light::Point(PointLight {
                p: Vec3::new(k as f32, 0.0, 0.0),
                intensity: Vec3::splat(10f32.powi(k % 60 - 30)),
            })
        })
        .collect();
    let sampler = spatial(&lights);
    for p in [
        Vec3::ZERO,
        Vec3::new(7.0, 0.0, 0.0),
        Vec3::splat(1e12),
        Vec3::splat(1e-12),
    ] {
        let receiver = Receiver::anywhere(p);
        let sum: f64 = (0..200)
            .map(|k| {
                let pmf = sampler.pmf(&receiver, k);
                assert!(pmf > 0.0 && pmf <= 1.0, "{p} {k}: {pmf}");
                f64::from(pmf)
            })
            .sum();
        assert!((sum - 1.0).abs() < 1e-4, "{p}: {sum}");
    }
    // Where the bright lights are hidden the dim ones still get their share.
    let pair = [1e9, 1.0].map(|i| {
        Light::Point(PointLight {
            p: Vec3::new(i, 0.0, 0.0).normalize(),
            intensity: Vec3::splat(i),
        })
    });
    let dim = spatial(&pair).pmf(&Receiver::anywhere(Vec3::ZERO), 1);
    assert!(dim > 0.9 / 1024.0, "{dim}");
}

#[test]
fn none_one_and_many_of_a_kind() {
    let here = Receiver::anywhere(Vec3::ZERO);
    assert!(spatial(&[]).select(&here, 0.5).is_none());
    assert!(spatial(&[sky(0.0), sky(0.0)]).select(&here, 0.5).is_none());
    let one = spatial(&[sky(0.0), sky(2.0)]);
    assert!(!one.depends_on_receiver());
    assert_eq!(one.select(&here, 0.25), Some((1, 1.0, 0.25)));
    // All in one place, so that no split tells them apart.
    let lights = vec![
        Light::Point(PointLight {
            p: Vec3::ONE,
            intensity: Vec3::ONE,
        });
        1000
    ];
    let sampler = spatial(&lights);
    assert!(sampler.tree_levels() <= 12, "{}", sampler.tree_levels());
    for k in [0, 500, 999] {
        assert!((sampler.pmf(&here, k) - 1e-3).abs() < 3e-4);
    }
    assert_eq!(sampler.pmf(&here, 1000), 0.0);
    assert_eq!(sampler.pmf(&here, u32::MAX), 0.0);
    // Suns only.
    let mut r = Numbers(3, 0);
    let suns = [sun(&mut r, 1.0), sun(&mut r, 2.0)];
    let sampler = spatial(&suns);
    assert!((sampler.pmf(&here, 1) - 2.0 / 3.0).abs() < 1e-6);
    assert_eq!(sampler.tree_levels(), 0);
}

/// The tree is the same each time, and not deep; it takes a fraction of a second (the bound leaves
/// room for a busy machine).
#[test]
fn a_hundred_thousand_lights_make_a_flat_tree_soon() {
    let lights = scene(1, 100_000, Vec3::ZERO, 10.0);
    let start = Instant::now();
    let sampler = spatial(&lights);
    let seconds = start.elapsed().as_secs_f64();
    println!("{} levels in {seconds:.2} s", sampler.tree_levels());
    assert!(sampler.tree_levels() <= 64 && seconds < 10.0, "{seconds} s");
    let again = spatial(&lights);
    let mut r = Numbers(5, 0);
    for _ in 0..2000 {
        let receiver = receiver(&mut r, &lights, Vec3::ZERO, 10.0);
        let u = r.next();
        let chosen = sampler.select(&receiver, u);
        assert_eq!(chosen, again.select(&receiver, u));
        if let Some((light, pmf, _)) = chosen {
            assert!((sampler.pmf(&receiver, light) / pmf - 1.0).abs() < 1e-4);
        }
    }
}
