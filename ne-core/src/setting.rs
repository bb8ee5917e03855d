use std::fmt;

/// A setting outside its allowed range: which field, what it was, what is allowed.
///
/// Settings are checked once, before a run starts; inside the run they are right.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field} = {found}: must be {allowed}")]
pub struct SettingError {
    /// The path of the field, dots between: `strategy.mutation.rate`.
    pub field: String,
    /// The value found.
    pub found: String,
    /// What is allowed, in words: `from 0 to 1`.
    pub allowed: String,
}

impl SettingError {
    /// An error for `field`.
    pub fn new(field: impl Into<String>, found: impl fmt::Display, allowed: impl Into<String>) -> Self {
        Self { field: field.into(), found: found.to_string(), allowed: allowed.into() }
    }

    /// The same error, with the field seen from one level further out: `rate` within `mutation` is `mutation.rate`.
    #[must_use]
    pub fn within(mut self, parent: &str) -> Self {
        self.field = format!("{parent}.{}", self.field);
        self
    }

    /// Checks that a number is finite and from `low` to `high`, both included.
    ///
    /// # Errors
    /// The error names the field and the range.
    pub fn check_range<N: Copy + Into<f64> + fmt::Display>(
        field: &str,
        value: N,
        low: f64,
        high: f64,
    ) -> Result<(), Self> {
        let number: f64 = value.into();
        if number >= low && number <= high && number.is_finite() {
            Ok(())
        } else if high.is_infinite() {
            let kind = if number.is_finite() { "" } else { "finite and " };
            Err(Self::new(field, value, format!("{kind}at least {low}")))
        } else {
            Err(Self::new(field, value, format!("from {low} to {high}")))
        }
    }

    /// Checks that a number is above 0 and at most `high`.
    ///
    /// # Errors
    /// The error names the field and the range.
    pub fn check_above_0<N: Copy + Into<f64> + fmt::Display>(field: &str, value: N, high: f64) -> Result<(), Self> {
        let number: f64 = value.into();
        if number > 0.0 && number <= high {
            Ok(())
        } else {
            Err(Self::new(field, value, format!("above 0 and at most {high}")))
        }
    }

    /// Checks that a count is at least `low`.
    ///
    /// # Errors
    /// The error names the field and the least value.
    pub fn check_at_least(field: &str, value: usize, low: usize) -> Result<(), Self> {
        if value >= low { Ok(()) } else { Err(Self::new(field, value, format!("at least {low}"))) }
    }
}
