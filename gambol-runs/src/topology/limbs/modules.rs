//! Modules: the hidden neurons of a limb that have the body together, for a while.

use super::gates::Gates;

/// Hidden neurons of a limb that drive its joints while it is their turn.
#[derive(Clone, Copy, Debug)]
pub(super) struct Module {
    /// What they are called in the names of genes.
    pub(super) name: &'static str,
    /// How many there are.
    pub(super) hidden: usize,
    /// The gate that is open while it is not their turn; `None`: it always is.
    pub(super) silenced_by: Option<usize>,
    /// Whether they are a phase of the jump, in which all legs do the same.
    pub(super) jumps: bool,
}

impl Module {
    /// The modules of a limb with so many hidden neurons: the stride has all of them, and each phase of the jump half as many of
    /// its own. What a phase has to do is simpler.
    pub(super) fn all(hidden: usize, gates: Option<&Gates>) -> Vec<Self> {
        let silenced_by = gates.map(|gates| gates.jumping);
        let stride = Self { name: "hidden", hidden, silenced_by, jumps: false };
        let phases = gates.map_or(&[][..], |gates| &gates.phases);
        let phase = |&(name, gate)| Self { name, hidden: hidden.div_ceil(2), silenced_by: Some(gate), jumps: true };
        std::iter::once(stride).chain(phases.iter().map(phase)).collect()
    }

    /// What its hidden neurons are called.
    pub(super) fn neurons(&self) -> impl Iterator<Item = String> + use<> {
        let Self { name, hidden, .. } = *self;
        (0..hidden).map(move |index| format!("{name} {index}"))
    }

    /// What its own threshold of a joint, and its share that goes with the place of the limb, are called; the stride has the
    /// plain one.
    pub(super) fn thresholds(&self) -> impl Iterator<Item = String> + use<> {
        let name = self.name;
        let own = self.jumps.then_some(["threshold", "place"]);
        own.into_iter().flatten().map(move |what| format!("{name} {what}"))
    }
}
