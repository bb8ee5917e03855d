//! The verdict on a champion's gait.

use gambol_runs::{Registry, champion::Champion, gait};
use serde::{Deserialize, Serialize};
use tasks::gait::Judgement;

/// What `gambol gait` says of a champion.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Verdict {
    /// The champion's generation.
    pub generation: u64,
    /// Whether the gait is usable; `null` where gaits are not judged.
    pub usable: Option<bool>,
    /// What speaks against it, in words.
    pub against: Vec<String>,
    /// In how many near worlds it is usable, and of how many.
    pub near_worlds: Option<[u64; 2]>,
}

impl Verdict {
    /// Judges a champion as it moves in rapier.
    pub fn of(champion: &Champion, registry: &Registry) -> Self {
        let generation = champion.generation;
        match gait::judge(champion, registry) {
            Ok(report) => {
                let flagged = report.cheats.iter().map(ToString::to_string);
                let reasons = |judgement: &Judgement| judgement.reasons.iter().map(ToString::to_string).collect();
                let near = report.verdict.as_ref().and_then(|verdict| verdict.near_worlds);
                Self {
                    generation,
                    usable: report.verdict.as_ref().map(|verdict| verdict.usable),
                    against: report.verdict.as_ref().map_or_else(|| flagged.collect(), reasons),
                    near_worlds: near.map(|near| [near.usable as u64, near.worlds as u64]),
                }
            }
            Err(error) => Self { generation, usable: Some(false), against: vec![error.to_string()], near_worlds: None },
        }
    }
}
