//! The metrics that an experiment file can name.

/// An error of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, serde::Serialize)]
pub enum Metric {
    /// [`relmse`](crate::relmse).
    RelMse,
    /// [`mse`](crate::mse).
    Mse,
    /// [`mape`](crate::mape).
    Mape,
    /// [`smape`](crate::smape).
    Smape,
    /// [`relmse_trimmed`](crate::relmse_trimmed).
    RelMseTrimmed,
    /// Mean [`ldr_flip`](crate::ldr_flip) of the pictures as the experiment shows them.
    Flip,
}

impl Metric {
    /// Every metric.
    pub const ALL: [Self; 6] = [
        Self::RelMse,
        Self::Mse,
        Self::Mape,
        Self::Smape,
        Self::RelMseTrimmed,
        Self::Flip,
    ];

    /// Name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RelMse => "RelMse",
            Self::Mse => "Mse",
            Self::Mape => "Mape",
            Self::Smape => "Smape",
            Self::RelMseTrimmed => "RelMseTrimmed",
            Self::Flip => "Flip",
        }
    }

    /// Name in captions and tables.
    pub const fn title(self) -> &'static str {
        match self {
            Self::RelMse => "relMSE",
            Self::Mse => "MSE",
            Self::Mape => "MAPE",
            Self::Smape => "SMAPE",
            Self::RelMseTrimmed => "relMSE less the worst 0.1 %",
            Self::Flip => "FLIP",
        }
    }
}
