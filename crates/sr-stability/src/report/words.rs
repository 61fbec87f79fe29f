//! What sweeps say, in words.

use crate::{Checked, Sweep, Verdict};
use sr_experiment::units::three_digits;

/// Up to three digits: `0.03`, `600`, `1e-44`, `4.77e-7`, `infinite`.
pub fn number(x: f64) -> String {
    if x.is_infinite() {
        return "infinite".into();
    }
    // Powers of ten and the like say nothing by their zeros.
    let text = three_digits(x);
    let (digits, exponent) = text.split_at(text.find('e').unwrap_or(text.len()));
    match digits.contains('.') {
        true => {
            digits
                .trim_end_matches('0')
                .trim_end_matches('.')
                .to_owned()
                + exponent
        }
        false => text,
    }
}

/// `holds`, `unclear`, `BROKEN`.
pub fn verdict(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Holds => "holds",
        Verdict::Unclear => "unclear",
        Verdict::Broken => "BROKEN",
    }
}

/// `1e-8 to 1`.
pub fn range(sweep: &Sweep) -> String {
    let [low, high] = sweep.holds;
    match (low.is_finite(), high.is_finite()) {
        (true, true) => format!("{} to {}", number(low), number(high)),
        (true, false) => format!("from {}", number(low)),
        (false, true) => format!("to {}", number(high)),
        (false, false) => "everywhere".into(),
    }
}

/// Where the error exceeds the bound outside of the range, if it was seen to.
pub fn limit(sweep: &Sweep) -> Option<String> {
    let found = sweep.limit();
    let below = found.below.map(|x| format!("fails at {}", number(x)));
    let above = found.above.map(|x| format!("fails at {}", number(x)));
    let all: Vec<String> = below.into_iter().chain(above).collect();
    (!all.is_empty()).then(|| all.join(", "))
}

/// A line a sweep, for a terminal.
pub fn lines(checked: &Checked) -> Vec<String> {
    let of_sweep = |s: &Sweep| {
        let worst = s.worst();
        let error = worst.map_or("nothing measured".into(), |p| number(p.error));
        let mut line = format!(
            "  {:8}{:28}{:>10} of {:<10} {}",
            verdict(s.verdict()),
            s.name,
            error,
            number(s.bound),
            s.parameter,
        );
        line += &format!(" {}", range(s));
        if let Some(limit) = limit(s) {
            line += &format!("; {limit}");
        }
        if let (true, Some(p)) = (s.verdict() != Verdict::Holds, worst) {
            line += &format!(
                "\n          at {} {}: {}",
                s.parameter,
                number(p.at),
                p.worst
            );
        }
        line
    };
    checked.sweeps.iter().map(of_sweep).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        let cases = [
            (600.0, "600"),
            (0.03, "0.03"),
            (1e-44, "1e-44"),
            (4.768e-7, "4.77e-7"),
            (f64::INFINITY, "infinite"),
            (0.0, "0"),
        ];
        for (x, wanted) in cases {
            assert_eq!(number(x), wanted);
        }
    }
}
