//! Numbers for people.

/// `1234567` as `1,234,567`.
pub fn grouped(n: u64) -> String {
    let digits = n.to_string();
    let mut text = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            text.push(',');
        }
        text.push(digit);
    }
    text
}

/// `1 triangle`, `12 triangles`.
pub fn counted(n: u64, what: &str) -> String {
    let plural = if n == 1 { "" } else { "s" };
    format!("{} {what}{plural}", grouped(n))
}

/// `31 ms`, `3.14 s`, `12.3 s`, `2 min 5 s`, `1 h 2 min`.
pub fn duration(seconds: f64) -> String {
    let whole = seconds.round() as u64;
    match whole {
        0 if seconds < 0.1 => format!("{:.0} ms", 1000.0 * seconds),
        0..10 => format!("{seconds:.2} s"),
        10..120 => format!("{seconds:.1} s"),
        120..7200 => format!("{} min {} s", whole / 60, whole % 60),
        _ => format!("{} h {} min", whole / 3600, whole % 3600 / 60),
    }
}

/// Three digits: `0.0314`, `12.6`, `3.14e-5`.
pub fn three_digits(x: f64) -> String {
    match x.abs() {
        0.0 => "0".into(),
        a if (0.01..1000.0).contains(&a) => {
            let decimals = (2.0 - a.log10().floor()).clamp(0.0, 4.0) as usize;
            format!("{x:.decimals$}")
        }
        _ => format!("{x:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(grouped(0), "0");
        assert_eq!(grouped(999), "999");
        assert_eq!(grouped(1_234_567), "1,234,567");
        assert_eq!(counted(1, "quad"), "1 quad");
        assert_eq!(counted(1200, "quad"), "1,200 quads");
        assert_eq!(duration(0.0314), "31 ms");
        assert_eq!(duration(0.314), "0.31 s");
        assert_eq!(duration(125.2), "2 min 5 s");
        assert_eq!(duration(3725.0), "62 min 5 s");
        assert_eq!(duration(7325.0), "2 h 2 min");
        assert_eq!(three_digits(0.0314159), "0.0314");
        assert_eq!(three_digits(12.6), "12.6");
        assert_eq!(three_digits(3.14e-5), "3.14e-5");
        assert_eq!(three_digits(0.0), "0");
        assert_eq!(three_digits(1234.0), "1.23e3");
    }
}
