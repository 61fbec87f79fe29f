//! What the figures say, in plain words, and what to do about it.

use super::found::{BrightSample, Condition, Finding, Health, Paths};
use super::route::Kind;
use super::words::percent;
use crate::oracle::Oracle;
use crate::report::words::number;
use sr_experiment::units::{counted, grouped};

/// The brightest 0.01 % of the samples are fireflies from this part of the light on: each is then a hundred times as far
/// above the others of its pixel as samples are bright on average.
const FIREFLIES: f64 = 0.01;
/// From this part of the noisy pixels on, pixels with the noise of a single sample are told.
const UNEVEN: f64 = 0.01;
/// From this part of the light on, what is missing beyond the last bounce is told: a difference that shows.
const MISSING: f64 = 0.01;
/// Fewer samples have no kurtosis worth the name.
const FEWEST_SAMPLES: u64 = 16;

/// All findings.
pub(super) fn findings(health: &Health) -> Vec<Finding> {
    let mut all = vec![rejected(health)];
    if health.mean > 0.0 {
        all.push(brightest(health));
        all.extend(kurtosis(health));
    } else {
        all.push(black());
    }
    if let Some(paths) = &health.paths {
        all.extend(depth(paths));
        all.extend(roulette(paths));
    }
    all.extend(health.oracle.as_ref().map(oracle));
    all
}

fn finding(
    name: &'static str,
    condition: Condition,
    text: String,
    advice: Option<String>,
) -> Finding {
    Finding {
        name,
        condition,
        text,
        advice,
    }
}

fn rejected(health: &Health) -> Finding {
    let all = health.pixels * health.samples;
    let count = health.rejected.count;
    if count == 0 {
        let text = format!("none of {} was refused", counted(all, "sample"));
        return finding("rejected", Condition::Ok, text, None);
    }
    let worst = &health.rejected.kinds[0];
    let on = worst.material.as_ref();
    let on = on.map_or_else(String::new, |m| format!(" on `{m}`"));
    let others = health.rejected.kinds.len() as u64 - 1;
    let of_these = match others {
        0 => String::new(),
        _ => format!("{} ", grouped(worst.count)),
    };
    let mut text = format!(
        "{} of {} ({}) are refused by the film: {of_these}{} after {}{on}",
        grouped(count),
        counted(all, "sample"),
        percent(count as f64 / all as f64),
        worst.cause,
        counted(worst.bounces.into(), "bounce"),
    );
    if let Some(defect) = &worst.first_defect {
        let what = &defect.what;
        text += &match defect.vertex {
            0 => format!("; {what} goes wrong first, at the camera"),
            n => format!("; {what} goes wrong first, at vertex {n}"),
        };
    }
    if others > 0 {
        text += &format!("; and {} more", counted(others, "kind"));
    }
    let advice = match &worst.replay {
        Some(_) => "replay the example: it tells the vertex and the number that is wrong",
        None => {
            "this is an error of the integrator or of a lobe; the pixel and sample are a case for its tests"
        }
    };
    finding("rejected", Condition::Broken, text, Some(advice.into()))
}

fn black() -> Finding {
    let text = "no sample brings any light: the picture is black".to_owned();
    let advice = "are there lights, and does the camera look at what they shine on?";
    finding("light", Condition::Look, text, Some(advice.into()))
}

fn brightest(health: &Health) -> Finding {
    let b = &health.brightest;
    let mut text = format!(
        "the brightest 0.01 % of the samples ({}) bring {} of the light, {} of it above what others of their pixels bring",
        grouped(b.count),
        percent(b.light),
        percent(b.excess),
    );
    if b.excess < FIREFLIES {
        return finding("brightest", Condition::Ok, text, None);
    }
    text += ": fireflies";
    let common = commonest(&b.worst);
    if let Some((n, kind, material)) = &common {
        let through = match (kind, material) {
            (_, None) => String::new(),
            (Kind::Caustic, Some(m)) => format!(", thrown by `{m}`"),
            (_, Some(m)) => format!(" by way of `{m}`"),
        };
        let all = b.worst.len();
        text += &format!(
            "; {n} of the {all} brightest are {}{through}",
            plural(*kind)
        );
    }
    let advice = match common.map(|(_, kind, _)| kind) {
        Some(Kind::Caustic) => {
            "a path from the camera meets a small light behind a mirror or glass by chance only: a larger light or a rougher \
             surface helps, more samples help slowly, `film.clamp` takes the light away (a bias that is counted)"
        }
        Some(Kind::Direct) => {
            "rare light is chosen too rarely: try `compile.light_selection: Spatial` or `All`, or more samples where it is"
        }
        Some(Kind::Seen) => {
            "a small bright light, seen directly, in mirrors or through clear glass, is in few samples of a pixel: more of them \
             resolve it, `film.clamp` dims it (a bias that is counted)"
        }
        Some(Kind::Indirect) | None => {
            "replay the brightest: it tells which weight is large; more samples help slowly, `film.clamp` takes the light away \
             (a bias that is counted)"
        }
    };
    finding("brightest", Condition::Look, text, Some(advice.into()))
}

/// Kind and material of most of the brightest, and how many they are; of equal numbers the brighter.
fn commonest(worst: &[BrightSample]) -> Option<(usize, Kind, Option<String>)> {
    let of = |b: &BrightSample| Some((b.kind?, b.material.clone()));
    let all: Vec<_> = worst.iter().filter_map(of).collect();
    let count = |wanted: &(Kind, Option<String>)| all.iter().filter(|k| *k == wanted).count();
    let best = all.iter().rev().max_by_key(|k| count(k))?;
    Some((count(best), best.0, best.1.clone()))
}

fn plural(kind: Kind) -> &'static str {
    match kind {
        Kind::Seen => "lights that the camera sees",
        Kind::Caustic => "caustics",
        other => other.describe(),
    }
}

fn kurtosis(health: &Health) -> Option<Finding> {
    let k = &health.kurtosis;
    let (median, high) = (k.median?, k.percentile_99?);
    if health.samples < FEWEST_SAMPLES {
        return None;
    }
    let mut text = format!(
        "kurtosis of the samples of a pixel: {} in the middle, {} exceeded by one of a hundred (noise of normal shape: 3; at most {})",
        number(median),
        number(high),
        health.samples
    );
    if k.by_one_sample < UNEVEN {
        return Some(finding("kurtosis", Condition::Ok, text, None));
    }
    text += &format!(
        "; in {} of the noisy pixels one sample makes the noise",
        percent(k.by_one_sample)
    );
    let advice = format!(
        "there {} do not tell their error yet: neither the error estimate nor adaptive sampling is to be trusted",
        counted(health.samples, "sample")
    );
    Some(finding("kurtosis", Condition::Look, text, Some(advice)))
}

/// Throughput of some ends.
fn throughput(paths: &Paths, why: &[&str]) -> f64 {
    let of = paths.ends.iter().filter(|e| why.contains(&e.why));
    of.map(|e| e.throughput).sum()
}

fn depth(paths: &Paths) -> Option<Finding> {
    let limit = paths.max_depth?;
    let cut = throughput(paths, &["depth", "last_ray"]);
    let mut text = format!(
        "`max_depth` {limit} cuts off {} of the throughput",
        percent(cut)
    );
    let missing = match paths.missing {
        Some(missing) => {
            text += &format!(
                ", and about {} of the light if it goes on to fall as in the last two bounces",
                percent(missing)
            );
            missing
        }
        None => {
            text += "; what light that would be, the last bounces do not tell";
            cut
        }
    };
    if missing < MISSING {
        return Some(finding("depth", Condition::Ok, text, None));
    }
    let advice =
        "a larger `max_depth` brings it, at the price of longer paths; roulette keeps them short";
    Some(finding("depth", Condition::Look, text, Some(advice.into())))
}

fn roulette(paths: &Paths) -> Option<Finding> {
    let ended = paths.ends.iter().find(|e| e.why == "roulette")?;
    if ended.count == 0 {
        return None;
    }
    let text = format!(
        "roulette ended {} of the paths, after {} bounces on average; they had {} of the throughput, which those that live carry on",
        percent(ended.share),
        number(ended.mean_bounces),
        percent(ended.throughput),
    );
    Some(finding("roulette", Condition::Ok, text, None))
}

fn oracle(oracle: &Oracle) -> Finding {
    let defects = oracle.defects();
    if defects.is_empty() {
        let words = oracle.words();
        let text = format!("{}: rounding does no harm", words[0]);
        return finding("oracle", Condition::Ok, text, None);
    }
    let advice = "this is an error of the renderer: replay the example, and check the suites of what is on its way";
    let text = defects.join("; ");
    finding("oracle", Condition::Broken, text, Some(advice.into()))
}
