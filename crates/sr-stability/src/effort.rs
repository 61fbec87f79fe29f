//! How much work a check may be.

/// How deep to dig.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Effort {
    /// Minutes instead of seconds: more points, more samples, and the cases that need them.
    pub long: bool,
}

impl Effort {
    /// `short`, or `long` where there is time.
    pub fn choose<T>(self, short: T, long: T) -> T {
        if self.long { long } else { short }
    }
}
