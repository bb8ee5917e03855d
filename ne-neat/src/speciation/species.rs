use ne_core::Fitness;
use std::cmp::Reverse;

/// Individuals that are near to each other.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Species {
    /// Its number; no other species of the run has it.
    pub(crate) id: u64,
    /// Its best fitness ever.
    pub(crate) best: Option<Fitness>,
    /// Generations since that was beaten.
    pub(crate) stagnation: u64,
    /// The indices of its members in the generation last told, best first, of equals the one with the lower index first.
    pub(crate) members: Vec<usize>,
}

impl Species {
    pub(crate) fn new(id: u64) -> Self {
        Self { id, best: None, stagnation: 0, members: Vec::new() }
    }

    /// Ranks its members and looks for progress.
    pub(crate) fn tell(&mut self, scores: &[Option<Fitness>]) {
        self.rank(scores);
        let best = self.champion_score(scores);
        self.stagnation = if best > self.best { 0 } else { self.stagnation + 1 };
        self.best = self.best.max(best);
    }

    /// Puts its members in order.
    pub(crate) fn rank(&mut self, scores: &[Option<Fitness>]) {
        self.members.sort_unstable_by_key(|&member| (Reverse(scores[member]), member));
    }

    /// The fitness of its best member.
    pub(crate) fn champion_score(&self, scores: &[Option<Fitness>]) -> Option<Fitness> {
        self.members.first().and_then(|&champion| scores[champion])
    }
}
