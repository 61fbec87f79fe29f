//! Film, sampler, budget and development.

use super::super::session::Session;
use super::complaint;
use sr_render::film::{FilmError, FilmSpec, Layer, Rect};
use sr_scene::settings::{
    AdaptiveSettings, Budget, FilmSettings, LayerName, PixelFilter, PostSettings, SamplerSettings,
    SceneFilm,
};

/// The longest side of a picture: what common readers of EXR and PNG take.
const MAX_SIDE: u32 = 65_536;
/// The widest filter, in pixels: beyond it a picture is blurred past recognition.
const MAX_RADIUS: f32 = 64.0;
/// The most replicas that samples are dealt to.
const MAX_REPLICAS: u32 = 16;

/// The film's layer of a name in RON.
fn layer(name: LayerName) -> Layer {
    match name {
        LayerName::Normal => Layer::Normal,
        LayerName::Depth => Layer::Depth,
        LayerName::Albedo => Layer::Albedo,
        LayerName::Ids => Layer::Ids,
        LayerName::Bounces => Layer::Bounces,
        LayerName::Seconds => Layer::Seconds,
    }
}

impl Session<'_> {
    pub(super) fn check_settings(&mut self) {
        self.check_adaptive();
        self.check_film();
        self.check_filter();
        let replicas = self.world.resource::<SamplerSettings>().replicas;
        if !replicas.is_power_of_two() || replicas > MAX_REPLICAS {
            let message = format!("{replicas} must be one of 1, 2, 4, 8 and 16");
            self.invalid_setting("sampler.replicas", complaint(message));
        }
        self.check_budget();
        let exposure = self.world.resource::<PostSettings>().exposure;
        if !exposure.is_finite() {
            self.invalid_setting("post.exposure", complaint("must be finite"));
        }
    }

    fn check_film(&mut self) {
        let film = self.world.resource::<FilmSettings>().clone();
        let [width, height] = film.size(*self.world.resource::<SceneFilm>());
        let mut size_is_valid = true;
        for (field, side) in [("film.width", width), ("film.height", height)] {
            if !(1..=MAX_SIDE).contains(&side) {
                let message = format!("{side} must be between 1 and {MAX_SIDE}");
                self.invalid_setting(field, complaint(message));
                size_is_valid = false;
            }
        }
        // The rest of what keeps a film from being made is told with its own place. Whether the
        // integrator splats, which takes more memory, is known further on only.
        let spec = FilmSpec {
            crop: match film.crop {
                Some([x0, y0, x1, y1]) => Rect { x0, y0, x1, y1 },
                None => Rect::of_size(width, height),
            },
            replicas: self.world.resource::<SamplerSettings>().replicas,
            layers: film.layers.iter().copied().map(layer).collect(),
            adaptive: self.world.resource::<AdaptiveSettings>().spec(),
            clamp: film.clamp.filter(|c| c.is_finite() && *c > 0.0),
            ..FilmSpec::of_size(width, height)
        };
        if size_is_valid && let Err(error @ FilmError::TooLarge { .. }) = spec.bytes() {
            self.invalid_setting("film.width", complaint(error.to_string()));
        }
        if let Some(clamp) = film.clamp
            && !(clamp > 0.0 && clamp.is_finite())
        {
            let message = format!("{clamp} must be finite and above 0");
            let hint = Some("leave it out, or write None, to clamp nothing");
            self.invalid_setting("film.clamp", (message, hint));
        }
        if let Some([x0, y0, x1, y1]) = film.crop {
            if x0 >= x1 || y0 >= y1 {
                let message = "the crop is empty".to_owned();
                let hint = Some("write (x0, y0, x1, y1) with x0 < x1 and y0 < y1");
                self.invalid_setting("film.crop", (message, hint));
            } else if size_is_valid && (x1 > width || y1 > height) {
                let message = format!("the crop leaves the picture of {width}×{height}");
                self.invalid_setting("film.crop", complaint(message));
            }
        }
        for (i, layer) in film.layers.iter().enumerate() {
            if film.layers[..i].contains(layer) {
                let message = format!("the layer {layer:?} is there already");
                self.invalid_setting(&format!("film.layers[{i}]"), complaint(message));
            }
        }
    }

    fn check_filter(&mut self) {
        let (radius, sigma) = match self.world.resource::<FilmSettings>().filter {
            PixelFilter::Box { radius }
            | PixelFilter::Tent { radius }
            | PixelFilter::BlackmanHarris { radius } => (radius, None),
            PixelFilter::Gaussian { radius, sigma } => (radius, Some(sigma)),
        };
        if !(radius > 0.0 && radius <= MAX_RADIUS) {
            let message = format!("{radius} must be above 0 and at most {MAX_RADIUS} pixels");
            self.invalid_setting("film.filter.radius", complaint(message));
        }
        if let Some(sigma) = sigma
            && !(sigma > 0.0 && sigma.is_finite())
        {
            let message = format!("{sigma} must be finite and above 0");
            self.invalid_setting("film.filter.sigma", complaint(message));
        }
    }

    fn check_budget(&mut self) {
        let budget = self.world.resource::<Budget>().clone();
        if budget.samples == Some(0) {
            self.invalid_setting("budget.samples", complaint("a picture needs samples"));
        }
        if budget.pass_samples == Some(0) {
            self.invalid_setting("budget.pass_samples", complaint("a pass needs samples"));
        }
        for (field, value) in [
            ("budget.seconds", budget.seconds),
            ("budget.target_error", budget.target_error),
        ] {
            if let Some(value) = value
                && !(value > 0.0 && value.is_finite())
            {
                let message = format!("{value} must be finite and above 0");
                self.invalid_setting(field, complaint(message));
            }
        }
    }
}
