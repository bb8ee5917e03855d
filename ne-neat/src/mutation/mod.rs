//! How a child's genes change.

mod activations;
mod connections;
mod nodes;
mod split_choice;
mod structure;
#[cfg(test)]
mod tests;
mod weights;

pub use split_choice::SplitChoice;
pub use weights::WeightMutation;

pub(crate) use structure::{Proposal, apply};

use crate::{
    NeatGenome,
    noise::{NewWeights, happens},
};
use ne_core::{RandomStream, SettingError};
use ne_net::Activation;
use rand::RngExt;
use serde::{Deserialize, Serialize};

/// How likely each kind of mutation is. All are decided independently for each child, in the order of the fields.
///
/// Source: Stanley & Miikkulainen, 2002, section 4.1, for weights and added structure; deletion and the rest are not in
/// the paper.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct MutationSettings {
    /// How weights change.
    pub weights: WeightMutation,
    /// The probability that a disabled connection, any of them, is enabled; from 0 to 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub enable: f64,
    /// The probability that an enabled connection, any of them, is disabled; from 0 to 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub disable: f64,
    /// The probability that a connection, any of them, is deleted, and with it hidden neurons that have no other; from 0
    /// to 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub delete_connection: f64,
    /// The probability that a hidden neuron, any of them, is deleted with its connections; from 0 to 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub delete_node: f64,
    /// The probability that a hidden neuron, any of them, gets another activation, if there is another to choose; from 0
    /// to 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub activation: f64,
    /// The probability that a connection is added between two nodes that have none, any such pair alike; from 0 to 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub add_connection: f64,
    /// The probability that a neuron is added in the middle of an enabled connection that does not come from the bias
    /// node: the old connection is disabled, the one to the neuron gets weight 1, the one from it the old weight; from 0
    /// to 1.
    #[cfg_attr(feature = "schema", schemars(range(min = 0.0, max = 1.0)))]
    pub add_node: f64,
    /// Which connection it splits.
    pub split: SplitChoice,
}

impl MutationSettings {
    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and its range.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.weights.validate().map_err(|error| error.within("weights"))?;
        for (field, probability) in [
            ("enable", self.enable),
            ("disable", self.disable),
            ("delete_connection", self.delete_connection),
            ("delete_node", self.delete_node),
            ("activation", self.activation),
            ("add_connection", self.add_connection),
            ("add_node", self.add_node),
        ] {
            SettingError::check_range(field, probability, 0.0, 1.0)?;
        }
        self.split.validate().map_err(|error| error.within("split"))
    }

    /// Changes a genome, except for new structure: that is proposed, to be added when it has its numbers.
    pub(crate) fn mutate(
        &self,
        genome: &mut NeatGenome,
        new_weights: NewWeights,
        activations: &[Activation],
        stream: &mut RandomStream,
    ) -> Proposal {
        self.weights.mutate(genome, new_weights, stream);
        if happens(self.enable, stream) {
            connections::switch_one(genome, true, stream);
        }
        if happens(self.disable, stream) {
            connections::switch_one(genome, false, stream);
        }
        if happens(self.delete_connection, stream) {
            connections::delete_one(genome, stream);
        }
        if happens(self.delete_node, stream) {
            nodes::delete_one(genome, stream);
        }
        if happens(self.activation, stream) {
            activations::change_one(genome, activations, stream);
        }
        let connection = if happens(self.add_connection, stream) {
            structure::new_connection(genome, new_weights, stream)
        } else {
            None
        };
        let node = if happens(self.add_node, stream) {
            structure::new_node(genome, self.split, activations, stream)
        } else {
            None
        };
        Proposal { connection, node }
    }
}

/// The index of one of the items that fit, all alike; `None` if none does.
fn one_of<T>(items: &[T], fits: impl Fn(&T) -> bool, stream: &mut RandomStream) -> Option<usize> {
    let mut fitting = items.iter().enumerate().filter(|(_, item)| fits(item)).map(|(index, _)| index);
    let count = fitting.clone().count();
    if count == 0 { None } else { fitting.nth(stream.random_range(0..count)) }
}
