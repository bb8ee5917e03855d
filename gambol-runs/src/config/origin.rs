use serde::{Deserialize, Serialize};
use std::fmt;

/// Where a run goes on from, and what it has kept: for the record.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Origin {
    /// The run folder or the champion file, as it was named.
    pub source: String,
    /// What was transferred.
    pub transferred: Transferred,
    /// The strategy it was learned with.
    pub strategy: String,
    /// The generation the source had reached; of a champion the one it was found in.
    pub generation: u64,
    /// Weights that go on from weights of the source.
    pub weights_kept: usize,
    /// Weights that are new, and begin at 0.
    pub weights_new: usize,
    /// Weights of the source that are given up.
    #[serde(default, skip_serializing_if = "is_zero")]
    pub weights_lost: usize,
    /// Inputs that are new.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub new_inputs: Vec<String>,
    /// Outputs that are new.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub new_outputs: Vec<String>,
    /// Inputs and outputs that are given up.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub lost: Vec<String>,
    /// Inputs and outputs whose range is another than before, so that the same number means something else.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub rescaled: Vec<String>,
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks with a reference")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// What is transferred from a run to the next.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum Transferred {
    /// The whole state of the strategy: its population, or its distribution. The strategy must stay the same.
    Population,
    /// The champion's weights, from which the new search begins; the net keeps its shape, and limbs their common genes.
    Champion,
    /// The champion's net, whose weights are held as they are: what the search is for are the weights of inputs, outputs and
    /// neurons that are new.
    Held,
    /// The champion's net: its topology is kept, every weight of it is free, and the search begins at the champion's.
    Topology,
    /// Nothing.
    Nothing,
}

impl fmt::Display for Transferred {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Population => "population",
            Self::Champion => "champion",
            Self::Held => "held",
            Self::Topology => "topology",
            Self::Nothing => "nothing",
        })
    }
}

/// A sentence: what was kept.
impl fmt::Display for Origin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { source, generation, weights_kept, weights_new, weights_lost, .. } = self;
        match self.transferred {
            Transferred::Nothing => return write!(f, "begins anew after {source}: nothing is kept"),
            Transferred::Population => write!(f, "goes on with the population of {source} (generation {generation})")?,
            Transferred::Champion => write!(f, "goes on from the champion of {source} (generation {generation})")?,
            Transferred::Held => write!(f, "holds the net of the champion of {source} (generation {generation})")?,
            Transferred::Topology => {
                write!(f, "goes on with the net of the champion of {source} (generation {generation})")?;
            }
        }
        match (weights_kept, weights_new) {
            (0, 0) => {}
            (kept, 0) => write!(f, "; all {kept} weights are kept")?,
            (kept, new) => write!(f, "; {kept} weights are kept, {new} are new and begin at 0")?,
        }
        if *weights_lost > 0 {
            write!(f, ", {weights_lost} are given up")?;
        }
        let lists = [
            ("new inputs", &self.new_inputs),
            ("new outputs", &self.new_outputs),
            ("given up", &self.lost),
            ("with another range", &self.rescaled),
        ];
        for (what, names) in lists.into_iter().filter(|(_, names)| !names.is_empty()) {
            write!(f, "; {what}: {}", names.join(", "))?;
        }
        Ok(())
    }
}
