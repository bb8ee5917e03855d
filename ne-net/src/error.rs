use ne_core::SettingError;

/// Why a shape and weights are not a net.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum NetworkError {
    /// The shape is not one.
    #[error("shape.{0}")]
    Shape(#[from] SettingError),
    /// There are too many or too few weights.
    #[error("weights: found {found}, a net of {net} has {expected}")]
    WeightCount {
        /// The shape in words.
        net: String,
        /// How many there must be.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A weight is NaN or infinite.
    #[error("weights[{index}] = {value}: must be finite")]
    NotFinite {
        /// Which one, from 0.
        index: usize,
        /// The weight.
        value: f32,
    },
}

/// Checks the number of weights of a net, told in words for an error, and that they are finite.
pub(crate) fn check_weights(net: impl ToString, expected: usize, weights: &[f32]) -> Result<(), NetworkError> {
    if weights.len() != expected {
        return Err(NetworkError::WeightCount { net: net.to_string(), expected, found: weights.len() });
    }
    match weights.iter().position(|weight| !weight.is_finite()) {
        Some(index) => Err(NetworkError::NotFinite { index, value: weights[index] }),
        None => Ok(()),
    }
}
