//! The metrics that an experiment file can name.

/// An error of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Serialize)]
pub enum Metric {
    /// [`relmse`](crate::relmse).
    RelMse,
    /// [`mse`](crate::mse).
    Mse,
    /// [`mape`](crate::mape).
    Mape,
    /// [`smape`](crate::smape).
    Smape,
}

impl Metric {
    /// Every metric.
    pub const ALL: [Self; 4] = [Self::RelMse, Self::Mse, Self::Mape, Self::Smape];

    /// Name in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::RelMse => "RelMse",
            Self::Mse => "Mse",
            Self::Mape => "Mape",
            Self::Smape => "Smape",
        }
    }

    /// Name in captions and tables.
    pub const fn title(self) -> &'static str {
        match self {
            Self::RelMse => "relMSE",
            Self::Mse => "MSE",
            Self::Mape => "MAPE",
            Self::Smape => "SMAPE",
        }
    }
}
