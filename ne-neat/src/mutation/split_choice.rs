use super::one_of;
use crate::{ConnectionGene, InnovationNumber};
use ne_core::{RandomStream, SettingError};
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// Which connection a new neuron splits.
///
/// The paper does not say. The program published with it prefers old connections in small genomes, so that neurons
/// spread over the net; without that, they tend to split what is left of the last split, and form chains.
///
/// In JSON: `"any"` or `{"older": {"probability": 0.7, "below": 15}}`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum SplitChoice {
    /// Any, all alike.
    Any,
    /// In small genomes an old one.
    Older {
        /// From the oldest on each is taken with this probability, and any if none is; from 0 to 1.
        #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
        probability: f64,
        /// Small are genomes with fewer connections than this, disabled ones included.
        below: usize,
    },
}

impl SplitChoice {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        match *self {
            Self::Any => Ok(()),
            Self::Older { probability, .. } => SettingError::check_range("older.probability", probability, 0.0, 1.0),
        }
    }

    /// The number of one of the connections that fit; `None` if none does.
    pub(super) fn choose(
        self,
        connections: &[ConnectionGene],
        fits: impl Fn(&ConnectionGene) -> bool,
        stream: &mut RandomStream,
    ) -> Option<InnovationNumber> {
        if let Self::Older { probability, below } = self
            && connections.len() < below
        {
            let old = connections.iter().find(|gene| fits(gene) && stream.random::<f64>() < probability);
            if let Some(gene) = old {
                return Some(gene.innovation);
            }
        }
        one_of(connections, fits, stream).map(|index| connections[index].innovation)
    }
}
