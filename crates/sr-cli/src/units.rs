//! Numbers for people: read from the command line, and written.

pub use sr_experiment::units::{counted, duration, grouped};
use sr_pipeline::TimeToError;
use sr_pipeline::film_kernel::ErrorEstimate;

/// Seconds from `10s`, `500ms`, `2m`, `1.5h`; without unit they are seconds.
pub fn parse_seconds(text: &str) -> Result<f64, String> {
    let digits = text.trim_end_matches(|c: char| c.is_ascii_alphabetic());
    let factor = match text[digits.len()..].trim() {
        "ms" => 1e-3,
        "s" | "" => 1.0,
        "m" | "min" => 60.0,
        "h" => 3600.0,
        unit => return Err(format!("`{unit}` is no unit of time: use ms, s, m or h")),
    };
    let number: f64 = digits
        .trim()
        .parse()
        .map_err(|_| "expected a time such as 10s, 500ms or 2m")?;
    positive(number * factor)
}

/// A number above 0.
pub fn parse_positive(text: &str) -> Result<f64, String> {
    positive(text.trim().parse().map_err(|_| "expected a number")?)
}

fn positive(x: f64) -> Result<f64, String> {
    if x > 0.0 && x.is_finite() {
        Ok(x)
    } else {
        Err("must be above 0".into())
    }
}

/// `x0,y0,x1,y1` with something inside.
pub fn parse_crop(text: &str) -> Result<[u32; 4], String> {
    let numbers: Result<Vec<u32>, _> = text.split(',').map(|n| n.trim().parse()).collect();
    let crop: [u32; 4] = numbers
        .ok()
        .and_then(|n| n.try_into().ok())
        .ok_or("expected four numbers of pixels: left,top,one past right,one past bottom")?;
    let [x0, y0, x1, y1] = crop;
    if x0 >= x1 || y0 >= y1 {
        return Err("nothing is inside".into());
    }
    Ok(crop)
}

/// A share as per cent: `1.85 %`, `2.1e-5 %`.
pub fn percent(share: f64) -> String {
    let x = 100.0 * share;
    if x == 0.0 {
        "0 %".into()
    } else if x >= 0.01 {
        format!("{x:.2} %")
    } else {
        format!("{x:.1e} %")
    }
}

/// Three digits and a prefix: `4.51 M`, before a unit.
pub fn scaled(x: f64) -> String {
    let (x, prefix) = match x {
        x if x >= 1e9 => (x / 1e9, "G"),
        x if x >= 1e6 => (x / 1e6, "M"),
        x if x >= 1e3 => (x / 1e3, "k"),
        x => (x, ""),
    };
    let decimals = usize::from(x < 100.0) + usize::from(x < 10.0);
    format!("{x:.decimals$} {prefix}")
}

/// `27.7 MiB`.
pub fn bytes(n: u64) -> String {
    let x = n as f64;
    match n {
        0..0x400 => format!("{n} B"),
        0x400..0x10_0000 => format!("{:.1} KiB", x / 1024.0),
        0x10_0000..0x4000_0000 => format!("{:.1} MiB", x / f64::from(1 << 20)),
        _ => format!("{:.2} GiB", x / f64::from(1 << 30)),
    }
}

/// As [`duration`] for a guess: whole seconds.
pub fn about(seconds: f64) -> String {
    match seconds.ceil() as u64 {
        s @ 0..120 => format!("{s} s"),
        s => duration(s as f64),
    }
}

/// `relMSE ≈ 0.0031 ± 0.0002`: as many digits as the uncertainty leaves.
pub fn error(estimate: &ErrorEstimate) -> String {
    let value = estimate.relmse;
    if value == 0.0 {
        return "relMSE ≈ 0".into();
    }
    let Some(spread) = estimate.relmse_std_error.filter(|s| *s > 0.0) else {
        return format!("relMSE ≈ {value:.2e}");
    };
    // Outside of these, zeros would hide the digits.
    let exponent = if (1e-3..1e4).contains(&value) {
        0
    } else {
        value.log10().floor() as i32
    };
    let unit = 10f64.powi(exponent);
    let (value, spread) = (value / unit, spread / unit);
    let decimals = (-spread.log10().floor()).clamp(0.0, 9.0) as usize;
    if exponent == 0 {
        return format!("relMSE ≈ {value:.decimals$} ± {spread:.decimals$}");
    }
    // One more than needed at times, but 9.8 does not become 10.
    let decimals = decimals.max(1);
    format!("relMSE ≈ ({value:.decimals$} ± {spread:.decimals$})e{exponent}")
}

/// `~40 s to 0.001`: how long until that error; `> 1000 h 0 min to 1e-9`.
pub fn to_target(target: &TimeToError) -> String {
    let error = target.relmse;
    let error = if (1e-4..1e4).contains(&error) {
        error.to_string()
    } else {
        format!("{error:e}")
    };
    // Beyond that the guess is of no use to anyone.
    const LONGEST: f64 = 3.6e6;
    match target.seconds {
        s if s > LONGEST => format!("> {} to {error}", about(LONGEST)),
        s => format!("~{} to {error}", about(s)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_units() {
        assert_eq!(parse_seconds("10s"), Ok(10.0));
        assert_eq!(parse_seconds("500ms"), Ok(0.5));
        assert_eq!(parse_seconds("2m"), Ok(120.0));
        assert_eq!(parse_seconds("1.5 h"), Ok(5400.0));
        assert_eq!(parse_seconds("7"), Ok(7.0));
        for bad in ["", "s", "10d", "-1s", "0s", "inf", "NaN", "ten"] {
            assert!(parse_seconds(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn a_crop_has_an_inside() {
        assert_eq!(parse_crop("1, 2,3,4"), Ok([1, 2, 3, 4]));
        for bad in [
            "1,2,3",
            "1,2,3,4,5",
            "1,2,1,4",
            "4,2,3,4",
            "a,b,c,d",
            "-1,0,3,3",
        ] {
            assert!(parse_crop(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn numbers_read_well() {
        assert_eq!(percent(0.0), "0 %");
        assert_eq!(percent(0.018_49), "1.85 %");
        assert_eq!(percent(2.1e-7), "2.1e-5 %");
        assert_eq!(scaled(4_512_345.0), "4.51 M");
        assert_eq!(scaled(12.0), "12.0 ");
        assert_eq!(bytes(1023), "1023 B");
        assert_eq!(bytes(3 << 20), "3.0 MiB");
    }

    #[test]
    fn the_way_to_an_error_reads_well() {
        let text = |relmse, seconds| to_target(&TimeToError { relmse, seconds });
        assert_eq!(text(0.001, 39.2), "~40 s to 0.001");
        assert_eq!(text(0.000_25, 0.0), "~0 s to 0.00025");
        assert_eq!(text(1e-5, 5000.0), "~83 min 20 s to 1e-5");
        assert_eq!(text(10.0, 8e4), "~22 h 13 min to 10");
        assert_eq!(text(1e-30, 1e30), "> 1000 h 0 min to 1e-30");
    }

    #[test]
    fn an_error_shows_the_digits_it_has() {
        let estimate = |relmse, relmse_std_error| ErrorEstimate {
            mse: 0.0,
            relmse,
            relmse_std_error,
            pixels: 1,
            unknown_pixels: 0,
        };
        let text = |e, s| error(&estimate(e, s));
        assert_eq!(text(0.003_14, Some(0.000_2)), "relMSE ≈ 0.0031 ± 0.0002");
        assert_eq!(text(3.14e-5, Some(2e-6)), "relMSE ≈ (3.1 ± 0.2)e-5");
        assert_eq!(text(1.26, Some(0.4)), "relMSE ≈ 1.3 ± 0.4");
        assert_eq!(text(0.003_14, None), "relMSE ≈ 3.14e-3");
        assert_eq!(text(9.8e-5, Some(2.6e-5)), "relMSE ≈ (9.8 ± 2.6)e-5");
        assert_eq!(text(0.0, Some(0.0)), "relMSE ≈ 0");
    }
}
