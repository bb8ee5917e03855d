//! Modules: the hidden neurons of a limb that have the body together, for a while.

use super::{gates::Gates, sight::MOST_OF_FEW_FEET};

/// Hidden neurons of a limb that drive its joints while it is their turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Module {
    /// How many there are.
    pub(super) hidden: usize,
    /// The gate that is open while it is not their turn; `None`: it always is.
    pub(super) silenced_by: Option<usize>,
    /// Which phase of the jump they are, in which all legs do the same; `None`: they are the stride.
    pub(super) phase: Option<Phase>,
}

/// A phase of a jump.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Phase {
    Crouch,
    PushOff,
    Landing,
}

impl Module {
    /// The modules of a limb with so many hidden neurons: the stride has all of them, and each phase of the jump half as many of
    /// its own. What a phase has to do is simpler.
    pub(super) fn all(hidden: usize, gates: Option<&Gates>) -> Vec<Self> {
        let silenced_by = gates.map(|gates| gates.jumping);
        let stride = Self { hidden, silenced_by, phase: None };
        let phases = gates.map_or(&[][..], |gates| &gates.phases);
        let phase = |&(phase, gate)| Self { hidden: hidden.div_ceil(2), silenced_by: Some(gate), phase: Some(phase) };
        std::iter::once(stride).chain(phases.iter().map(phase)).collect()
    }

    /// What it is called in the names of genes.
    fn name(&self) -> &'static str {
        self.phase.map_or("hidden", Phase::name)
    }

    /// What its hidden neurons are called.
    pub(super) fn neurons(&self) -> impl Iterator<Item = String> + use<> {
        let (name, hidden) = (self.name(), self.hidden);
        (0..hidden).map(move |index| format!("{name} {index}"))
    }

    /// What its own threshold of a joint, and its share that goes with the place of the limb, are called; the stride has the
    /// plain one.
    pub(super) fn thresholds(&self) -> impl Iterator<Item = String> + use<> {
        let name = self.name();
        let own = self.phase.map(|_| ["threshold", "place"]);
        own.into_iter().flatten().map(move |what| format!("{name} {what}"))
    }
}

impl Phase {
    fn name(self) -> &'static str {
        match self {
            Self::Crouch => "crouch",
            Self::PushOff => "push-off",
            Self::Landing => "landing",
        }
    }

    /// The threshold of the first joint of a leg, and its share that goes with the place of the leg, before evolution changes
    /// them: a search that begins without any jump seldom finds one (docs/playing-experiments.md). So it begins with a
    /// hand-made one. In the crouch legs leave the vertical, which lowers the body; in the push-off they swing back through it; for the
    /// landing they leave it again. Two legs side by side go apart. Those before and behind a long body go to the front together, since
    /// the latter are mirror images. Of many legs those in the middle would stay straight, and carry the body: they all have one
    /// threshold, with which the mirror images go to the back. A held search begins about the mirror image of all of it where that is worth
    /// more.
    pub(super) fn by_hand(self, feet: usize) -> [f32; 2] {
        match (self, feet > MOST_OF_FEW_FEET) {
            (Self::Crouch | Self::Landing, false) => [0.0, 1.0],
            (Self::PushOff, false) => [0.0, -1.0],
            (Self::Crouch, true) => [0.7, 0.0],
            (Self::PushOff, true) => [-0.7, 0.0],
            (Self::Landing, true) => [0.0, 0.0],
        }
    }
}
