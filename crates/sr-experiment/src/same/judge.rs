//! From what is known of two methods to a verdict.

use super::Settings;
use super::sides::{Known, SameError, Tile};
use super::verdict::{
    Answer, CHANNELS, HISTOGRAM, MeanDifference, Question, TileDifference, Verdict,
};
use sr_stats::{MeanEstimate, Welch, family_p_value, sidak, small_p_values, welch_test};

/// Confidence of the intervals of the mean's difference.
const CONFIDENCE: f64 = 0.95;

/// Part of the tiles that may have heavy tails before a tile that differs proves nothing: where so many
/// have met a rare bright path, others have missed theirs without a sign of it.
const HEAVY_SHARE: f64 = 0.02;

/// Degrees of freedom of the mean of pixels from which on its p-value is believed, which allows for them:
/// four pixels or more make up its noise.
const ENOUGH: f64 = 12.0;

/// Tiles that are named.
const NAMED_TILES: usize = 5;

pub(super) fn judge(a: &Known, b: &Known, settings: &Settings) -> Result<Verdict, SameError> {
    if a.size != b.size {
        return Err(SameError::SizesDiffer {
            a: a.size,
            b: b.size,
        });
    }
    let mut state = Tests::default();
    for at in 0..a.tiles.len() {
        state.tile(a, b, at);
    }
    let means = mean_differences(a, b);
    let smallest = |p: &mut dyn Iterator<Item = f64>| p.fold(1.0, f64::min);
    let tests = 3 * a.tiles.len();
    let tiles = smallest(&mut state.p.iter().flatten().copied());
    let distribution = std::mem::take(&mut state.free).map(|mut p| small_p_values(&mut p).p_value);
    let question = |smallest: f64, tests: usize| {
        let p_value = family_p_value(smallest, tests);
        Question {
            p_value,
            passed: p_value >= sidak(settings.false_alarm, 3),
        }
    };
    let tiles = question(tiles, tests);
    let distribution = question(smallest(&mut distribution.into_iter()), 3);
    let mean = question(smallest(&mut means.iter().map(|m| m.p_value)), 3);
    let answer = answer(&tiles, &distribution, &mean, [a, b], state.heavy);
    let level = sidak(sidak(settings.false_alarm, 3), tests);
    let wrong = state.p.iter().filter(|p| p.iter().any(|p| *p < level));
    Ok(Verdict {
        answer,
        width: a.size.0,
        height: a.size.1,
        tile: settings.tile,
        tile_count: a.tiles.len(),
        different_tiles: wrong.count(),
        heavy_tiles: state.heavy,
        false_alarm: settings.false_alarm,
        tiles,
        distribution,
        mean,
        p_histogram: state.histogram,
        worst: worst(&state, a, settings),
        tile_error: state.errors / state.light,
        mean_difference: means,
        tile_level: level,
        z: state.z,
        columns: a.columns,
    })
}

/// What the questions say together. Where noise has heavy tails their p-values are too small, and a difference
/// proves nothing.
fn answer(
    tiles: &Question,
    distribution: &Question,
    mean: &Question,
    [a, b]: [&Known; 2],
    heavy: usize,
) -> Answer {
    let local = !(tiles.passed && distribution.passed);
    let light_tailed = heavy as f64 <= HEAVY_SHARE * a.tiles.len() as f64;
    let few = |k: &Known| {
        k.guarded
            && k.whole
                .mean
                .iter()
                .any(|m| m.variance > 0.0 && m.dof < ENOUGH)
    };
    let known_mean = !(few(a) || few(b));
    match (local, !mean.passed) {
        (false, false) => Answer::Same,
        (true, _) if light_tailed => Answer::Different,
        (_, true) if known_mean => Answer::Different,
        _ => Answer::Unclear,
    }
}

/// The tests of all tiles.
#[derive(Default)]
struct Tests {
    /// By tile and channel.
    p: Vec<[f64; 3]>,
    /// Of the channel with the smallest p: its sign, and p as if of a normal distribution.
    z: Vec<f32>,
    differences: Vec<[Welch; 3]>,
    /// The p-values that may be taken for uniform, by channel.
    free: [Vec<f64>; 3],
    histogram: [u64; HISTOGRAM],
    heavy: usize,
    /// Sums over tiles and channels of standard errors, and of the second method's means.
    errors: f64,
    light: f64,
}

impl Tests {
    fn tile(&mut self, a: &Known, b: &Known, at: usize) {
        let (ta, tb) = (&a.tiles[at], &b.tiles[at]);
        let mut tests = [welch_test(&MeanEstimate::default(), &MeanEstimate::default()); 3];
        for (c, test) in tests.iter_mut().enumerate() {
            let plain = rounded(&ta.mean[c], &tb.mean[c], a.rounding + b.rounding);
            *test = if a.guarded || b.guarded {
                let (ga, gb) = (guard(a, at, c), guard(b, at, c));
                rounded(&ga, &gb, a.rounding + b.rounding)
            } else {
                plain
            };
            self.errors += plain.std_error;
            self.light += tb.mean[c].mean.abs();
            if plain.std_error > 0.0 && !ta.heavy[c] && !tb.heavy[c] {
                self.free[c].push(test.p_value);
                let bin = (test.p_value * HISTOGRAM as f64) as usize;
                self.histogram[bin.min(HISTOGRAM - 1)] += 1;
            }
        }
        let heavy = |t: &Tile| t.heavy.iter().any(|h| *h);
        self.heavy += usize::from(heavy(ta) || heavy(tb));
        let worst = tests
            .iter()
            .min_by(|x, y| x.p_value.total_cmp(&y.p_value))
            .expect("there are three channels");
        self.z.push(as_normal(worst));
        self.p.push(tests.map(|t| t.p_value));
        self.differences.push(tests);
    }
}

/// Welch's test, of what rounding cannot explain where there is less noise than rounding; more
/// noise dithers it away. A pixel is off by less than `rounding` of itself, and so is a mean of
/// pixels.
fn rounded(a: &MeanEstimate, b: &MeanEstimate, rounding: f64) -> Welch {
    let plain = welch_test(a, b);
    let off = rounding * a.mean.abs().max(b.mean.abs());
    if plain.std_error > off {
        return plain;
    }
    let beyond = (plain.difference.abs() - off).max(0.0);
    let nearer = MeanEstimate {
        mean: b.mean + beyond.copysign(plain.difference),
        ..*a
    };
    welch_test(&nearer, b)
}

/// A tile's mean with the mean variance of the 3 × 3 tiles around it, if that is larger.
fn guard(known: &Known, at: usize, channel: usize) -> MeanEstimate {
    let columns = known.columns as usize;
    let rows = known.tiles.len() / columns;
    let (x, y) = (at % columns, at / columns);
    let (mut sum, mut n) = (0.0, 0.0);
    for ny in y.saturating_sub(1)..(y + 2).min(rows) {
        for nx in x.saturating_sub(1)..(x + 2).min(columns) {
            sum += known.tiles[ny * columns + nx].mean[channel].variance;
            n += 1.0;
        }
    }
    let own = known.tiles[at].mean[channel];
    MeanEstimate {
        variance: own.variance.max(sum / n),
        ..own
    }
}

/// The z of a normal variable with the test's p-value and sign.
fn as_normal(test: &Welch) -> f32 {
    let size = -sr_stats::normal_quantile(0.5 * test.p_value);
    if test.t < 0.0 {
        -size as f32
    } else {
        size as f32
    }
}

fn mean_differences(a: &Known, b: &Known) -> [MeanDifference; 3] {
    [0, 1, 2].map(|c| {
        let (x, y) = (&a.whole.mean[c], &b.whole.mean[c]);
        let test = rounded(x, y, a.rounding + b.rounding);
        MeanDifference {
            channel: CHANNELS[c],
            a: x.mean,
            b: y.mean,
            difference: x.mean - y.mean,
            half_width: x.less(y).half_width(CONFIDENCE),
            p_value: test.p_value,
        }
    })
}

/// The tiles that differ most, and the picture's place of each.
fn worst(tests: &Tests, a: &Known, settings: &Settings) -> Vec<TileDifference> {
    let least = |p: &[f64; 3]| p.iter().copied().fold(1.0, f64::min);
    let mut order: Vec<usize> = (0..tests.p.len()).collect();
    order.sort_by(|&i, &j| least(&tests.p[i]).total_cmp(&least(&tests.p[j])));
    let name = |&at: &usize| {
        let p = tests.p[at];
        let c = (0..3).min_by(|&i, &j| p[i].total_cmp(&p[j])).unwrap_or(0);
        let test = tests.differences[at][c];
        let place = |i: u32| i.saturating_mul(settings.tile.max(1));
        TileDifference {
            x: place(at as u32 % a.columns),
            y: place(at as u32 / a.columns),
            channel: CHANNELS[c],
            difference: test.difference,
            std_error: test.std_error,
            p_value: test.p_value,
        }
    };
    order.iter().take(NAMED_TILES).map(name).collect()
}
