use super::{RankSelector, Roulette, Selector, StochasticUniversal, Tournament, Truncation};
use crate::{Fitness, RandomStream, SettingError};
use serde::{Deserialize, Serialize};

/// One of the five selectors, chosen at run time: how a configuration file names it.
///
/// In JSON the name with its settings: `{"tournament": {"size": 3}}`, `{"roulette": {}}`.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Selection {
    /// Chances proportional to fitness.
    Roulette(Roulette),
    /// Chances by rank.
    Rank(RankSelector),
    /// Best of a few.
    Tournament(Tournament),
    /// The best share.
    Truncation(Truncation),
    /// Chances proportional to fitness, least spread.
    StochasticUniversal(StochasticUniversal),
}

impl Selection {
    /// Checks the settings of the chosen selector.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        match self {
            Self::Roulette(_) | Self::StochasticUniversal(_) => Ok(()),
            Self::Rank(rank) => rank.validate().map_err(|error| error.within("rank")),
            Self::Tournament(tournament) => tournament.validate().map_err(|error| error.within("tournament")),
            Self::Truncation(truncation) => truncation.validate().map_err(|error| error.within("truncation")),
        }
    }
}

impl Selector for Selection {
    fn select(&self, scores: &[Option<Fitness>], count: usize, stream: &mut RandomStream, chosen: &mut Vec<usize>) {
        match self {
            Self::Roulette(selector) => selector.select(scores, count, stream, chosen),
            Self::Rank(selector) => selector.select(scores, count, stream, chosen),
            Self::Tournament(selector) => selector.select(scores, count, stream, chosen),
            Self::Truncation(selector) => selector.select(scores, count, stream, chosen),
            Self::StochasticUniversal(selector) => selector.select(scores, count, stream, chosen),
        }
    }
}
