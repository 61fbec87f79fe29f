//! The pictures of the viewer with their real numbers: radiance, FLIP, samples, seconds.

use super::markup::data_uri;
use super::planes::{Plane, encode};
use crate::analysis::{Analysis, Group};
use crate::folder::Folder;
use crate::plan::Plan;
use crate::reference::Reference;
use crate::run::Outcome;
use crate::seen::Seen;
use crate::units::counted;
use crate::words;
use serde::Serialize;
use sr_film::{Image, read_channels, read_image};
use std::path::Path;
use std::sync::Arc;

/// Bytes of the page that the numbers may take; above, pictures are shown smaller.
const LIMIT: u64 = 64 << 20;

/// Everything that the viewer shows.
#[derive(Debug, Default, Serialize)]
pub(super) struct Views {
    /// Side of the blocks of pixels that are one value; 1 for all the pixels there are.
    pub factor: u32,
    /// Upper left corner of what is shown, in pixels.
    pub origin: [u32; 2],
    /// Stops of exposure to begin with.
    pub exposure: f32,
    /// The colours of maps from low to high, six hexadecimal digits each.
    magma: String,
    /// The offset of relative errors.
    pub offsets: Offsets,
    /// Pictures of the same thing, which are compared.
    pub sets: Vec<Set>,
    /// Encoded planes, which pictures name by number; the page holds them outside of this.
    #[serde(skip)]
    pub planes: Vec<String>,
}

/// What error maps divide by, so that black has an error.
#[derive(Debug, Default, Serialize)]
pub(super) struct Offsets {
    relmse: f64,
    relative: f64,
}

/// Pictures of one group.
#[derive(Debug, Serialize)]
pub(super) struct Set {
    heading: String,
    pictures: Vec<View>,
    /// Which of them is the reference.
    reference: Option<usize>,
}

/// One picture.
#[derive(Debug, Serialize)]
struct View {
    label: String,
    caption: String,
    /// Its place among the contenders; `None` for a reference.
    place: Option<usize>,
    width: u32,
    height: u32,
    /// Number of its three planes of radiance.
    rgb: usize,
    flip: Option<usize>,
    samples: Option<usize>,
    seconds: Option<usize>,
    /// Maps that are pictures: what they show, and a PNG.
    maps: Vec<(String, String)>,
}

/// Channels of an EXR beside its colour that the viewer shows.
const SAMPLES: &str = "SampleCount.Y";
const SECONDS: &str = "Seconds.Y";

/// Reads the pictures that are shown, and their references.
pub(super) fn views(
    plan: &Plan,
    outcome: &Outcome,
    analysis: &Analysis,
    folder: &Folder,
) -> Result<Views, String> {
    let mut views = Views {
        factor: factor(most_bytes(plan, analysis)),
        origin: plan
            .experiment
            .show
            .crop
            .map_or([0, 0], |[x, y, ..]| [x, y]),
        exposure: plan.facts.first().map_or(0.0, |f| f.post.exposure),
        magma: magma(),
        offsets: Offsets {
            relmse: sr_film::RELMSE_OFFSET,
            relative: crate::RELATIVE_OFFSET,
        },
        ..Default::default()
    };
    let mut reader = Reader {
        plan,
        outcome,
        folder,
        views: &mut views,
        references: Vec::new(),
    };
    for group in &analysis.groups {
        let set = reader.set(group)?;
        if !set.pictures.is_empty() {
            reader.views.sets.push(set);
        }
    }
    Ok(views)
}

fn magma() -> String {
    let colours = (0..256).map(|i| colorous::MAGMA.eval_rational(i, 256));
    colours.map(|c| format!("{c:x}")).collect()
}

/// Bytes that the numbers of all pictures take at most: six planes a picture and three a reference, of
/// four bytes, which base64 makes 4/3 as long, if none of it could be compressed.
fn most_bytes(plan: &Plan, analysis: &Analysis) -> u64 {
    let pixels = |point: usize| match plan.experiment.show.crop {
        Some([x0, y0, x1, y1]) => u64::from(x1 - x0) * u64::from(y1 - y0),
        None => plan.facts[point].pixels(),
    };
    let contenders = analysis.groups.iter().flat_map(|g| &g.contenders);
    let of_runs: u64 = contenders.map(|c| 6 * pixels(c.point)).sum();
    let first = analysis.groups.iter().filter_map(|g| g.contenders.first());
    let of_references: u64 = first.map(|c| 3 * pixels(c.point)).sum();
    (of_runs + of_references) * 4 * 4 / 3
}

/// Side of the blocks that become one value, so that no more than [`LIMIT`] is left of `bytes`.
fn factor(bytes: u64) -> u32 {
    let fits = |k: &u64| bytes.div_ceil(k * k) <= LIMIT;
    (1..).find(fits).map_or(1, |k| k as u32)
}

struct Reader<'a> {
    plan: &'a Plan,
    outcome: &'a Outcome,
    folder: &'a Folder,
    views: &'a mut Views,
    /// Those that are encoded, with the number of their planes and their size.
    references: Vec<(Arc<Reference>, usize, [u32; 2])>,
}

impl Reader<'_> {
    fn set(&mut self, group: &Group) -> Result<Set, String> {
        let mut pictures = Vec::new();
        let mut reference = None;
        for place in 0..group.contenders.len() {
            let point = group.contenders[place].point;
            pictures.extend(self.run(group, place)?);
            reference = reference.or(self.outcome.reference(point).cloned());
        }
        let mut set = Set {
            heading: group.heading.clone(),
            reference: None,
            pictures,
        };
        // Without any picture there is nothing to compare it with.
        if let (Some(reference), false) = (reference, set.pictures.is_empty()) {
            set.reference = Some(set.pictures.len());
            set.pictures.push(self.reference(reference)?);
        }
        Ok(set)
    }

    /// The picture of a contender, if it is done.
    fn run(&mut self, group: &Group, place: usize) -> Result<Option<View>, String> {
        let (plan, contender) = (self.plan, &group.contenders[place]);
        let Some(done) = self.outcome.shown(plan, contender.point) else {
            return Ok(None);
        };
        let path = self.folder.run(&plan.runs[done.run].id, ".exr");
        let image = read_image(&path).map_err(|e| e.to_string())?;
        let caption = words::caption(plan, self.outcome, contender.point, &[]);
        let (rgb, [width, height]) = self.keep(&planes_of(&image))?;
        Ok(Some(View {
            label: contender.label.clone(),
            caption: caption.join(" · "),
            place: Some(place),
            width,
            height,
            rgb,
            flip: self.flip(contender.point, &image)?,
            samples: self.channel(&path, SAMPLES)?,
            seconds: self.channel(&path, SECONDS)?,
            maps: self.maps(group, place)?,
        }))
    }

    fn flip(&mut self, point: usize, image: &Image) -> Result<Option<usize>, String> {
        let Some(reference) = self.outcome.reference(point) else {
            return Ok(None);
        };
        let seen = Seen::new(&reference.image, &self.plan.facts[point].post);
        let map = seen.flip(image).map_err(|e| e.to_string())?;
        let plane = Plane {
            width: map.width,
            height: map.height,
            values: map.values,
        };
        Ok(Some(self.keep(&[plane])?.0))
    }

    fn channel(&mut self, path: &Path, name: &str) -> Result<Option<usize>, String> {
        // Not every file has it.
        let Ok(mut found) = read_channels(path, &[name]) else {
            return Ok(None);
        };
        let plane = Plane {
            width: found.width,
            height: found.height,
            values: found.planes.swap_remove(0),
        };
        Ok(Some(self.keep(&[plane])?.0))
    }

    /// References that several groups share are held once.
    fn reference(&mut self, reference: Arc<Reference>) -> Result<View, String> {
        let known = self.references.iter();
        let mut known = known.filter(|(r, ..)| Arc::ptr_eq(r, &reference));
        let (rgb, [width, height]) = match known.next() {
            Some((_, rgb, size)) => (*rgb, *size),
            None => {
                let (rgb, size) = self.keep(&planes_of(&reference.image))?;
                self.references.push((reference.clone(), rgb, size));
                (rgb, size)
            }
        };
        let samples = reference.facts.samples.map(|n| counted(n, "sample"));
        Ok(View {
            label: "reference".into(),
            caption: samples.unwrap_or_default(),
            place: None,
            width,
            height,
            rgb,
            flip: None,
            samples: None,
            seconds: None,
            maps: Vec::new(),
        })
    }

    /// Where it differs from what it is compared with, as far as that was asked.
    fn maps(&self, group: &Group, place: usize) -> Result<Vec<(String, String)>, String> {
        let name = |n: usize| &group.contenders[n].label;
        let pairs = group.pairs.iter().filter_map(|p| {
            let other = match place {
                _ if p.a == place => p.b,
                _ if p.b == place => p.a,
                _ => return None,
            };
            Some((format!("against {}", name(other)), p.map.as_ref()?))
        });
        let bias = group.contenders[place].bias.as_ref();
        let bias = bias.and_then(|b| Some(("against the reference".to_owned(), b.map.as_ref()?)));
        let all = bias.into_iter().chain(pairs);
        all.map(|(what, file)| {
            let path = self.folder.file(file);
            let bytes = std::fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?;
            Ok((what, data_uri("image/png", &bytes)))
        })
        .collect()
    }

    /// Cuts, reduces and encodes planes of one size; their number, and the size that is left.
    fn keep(&mut self, planes: &[Plane]) -> Result<(usize, [u32; 2]), String> {
        let crop = self.plan.experiment.show.crop;
        let fitted: Vec<Plane> = planes
            .iter()
            .map(|p| crop.map_or_else(|| p.clone(), |c| p.cut(c)))
            .map(|p| p.reduced(self.views.factor))
            .collect();
        let all: Vec<&Plane> = fitted.iter().collect();
        self.views.planes.push(encode(&all)?);
        let size = fitted.first().map_or([0, 0], |p| [p.width, p.height]);
        Ok((self.views.planes.len() - 1, size))
    }
}

/// Red, green and blue.
fn planes_of(image: &Image) -> [Plane; 3] {
    [0, 1, 2].map(|i| Plane {
        width: image.width,
        height: image.height,
        values: image.pixels.iter().map(|p| p[i]).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_become_smaller_only_when_they_must() {
        assert_eq!([0, LIMIT].map(factor), [1, 1]);
        assert_eq!([LIMIT + 1, 4 * LIMIT].map(factor), [2, 2]);
        assert_eq!(factor(4 * LIMIT + 1), 3);
    }
}
