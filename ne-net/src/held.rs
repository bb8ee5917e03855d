//! Nets of which a part is held as it is, and only the rest is searched for.

use crate::{GraphNeuron, GraphShape, SharedShape, SharedWeight, Topology};
use ne_core::SettingError;

impl Topology {
    /// The same nets with these genes held: what remains free are the genes for which `is_free` holds, in their order. A net
    /// of it has the weights of the whole one, with the held genes as they are here.
    ///
    /// ```
    /// use ne_net::{DenseShape, Topology};
    ///
    /// // A neuron with two sources and a bias, of which the second weight is searched for.
    /// let whole = Topology::from(DenseShape::new(2, vec![], 1));
    /// let held = whole.held(&[0.5, 0.0, -1.0], |gene| gene == 1)?;
    /// assert_eq!(held.weight_count(), 1);
    /// # Ok::<(), ne_core::SettingError>(())
    /// ```
    ///
    /// # Errors
    /// If nothing is free, if of a clock's two genes one is free and the other held, if these are copies of a net, or if hidden
    /// neurons are scaled, as those of a graph are not.
    ///
    /// # Panics
    /// If there are fewer genes than the topology has.
    pub fn held(&self, genes: &[f32], is_free: impl Fn(usize) -> bool) -> Result<Self, SettingError> {
        let whole = self.shared()?;
        let mut place = vec![None; whole.gene_count()];
        for (free, gene) in (0..place.len()).filter(|&gene| is_free(gene)).enumerate() {
            place[gene] = Some(free);
        }
        let mut first = 0;
        let mut groups = Vec::new();
        for &group in &whole.groups {
            groups.push(place[first..first + group].iter().flatten().count());
            first += group;
        }
        groups.retain(|&group| group > 0);
        let weights: Result<Vec<SharedWeight>, SettingError> = whole
            .weights
            .iter()
            .enumerate()
            .map(|(index, weight)| {
                let mixed = || {
                    SettingError::new(
                        format!("weights[{index}]"),
                        "a clock of which one gene is held",
                        "a clock whose genes are both held or both free",
                    )
                };
                weight.held(genes, &place).ok_or_else(mixed)
            })
            .collect();
        let held = SharedShape { net: whole.net, groups, weights: weights? };
        held.validate()?;
        Ok(held.into())
    }

    /// The same nets as a graph whose weights are computed from genes.
    fn shared(&self) -> Result<SharedShape, SettingError> {
        match self {
            Self::Shared(shape) => return Ok(SharedShape::clone(shape)),
            Self::Copied(_) => {
                let allowed =
                    "one whose weights each stand for themselves, or a net for each limb that is not searched for";
                return Err(SettingError::new("topology", "copies of a net", allowed));
            }
            Self::Dense(_) | Self::Graph(_) => {}
        }
        let view = self.view();
        let mut weights = Vec::new();
        let gene = |gene: usize| SharedWeight::Sum(vec![(gene, 1.0)]);
        let mut neurons = Vec::with_capacity(view.neurons.len());
        for neuron in &view.neurons {
            weights.extend(neuron.bias.map(gene));
            weights.extend(neuron.sources.iter().map(|&(_, weight)| gene(weight)));
            neurons.push(GraphNeuron {
                activation: neuron.activation,
                bias: neuron.bias.is_some(),
                sources: neuron.sources.iter().map(|&(node, _)| node).collect(),
            });
        }
        if let Some(neuron) = view.neurons.iter().find(|neuron| neuron.scale != 1.0) {
            return Err(SettingError::new("hidden_scale", neuron.scale, "1 in a net of which a part is held"));
        }
        let recurrent = matches!(self, Self::Graph(shape) if shape.recurrent);
        let net = GraphShape { inputs: view.inputs, recurrent, neurons, outputs: view.outputs };
        Ok(SharedShape { net: net.into(), groups: self.weights_of_neurons().collect(), weights })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Activation, DenseShape, Turn};
    use ne_core::Phenotype;

    fn genes(count: usize) -> Vec<f32> {
        (0..count).map(|gene| (gene as f32 * 0.7).sin()).collect()
    }

    fn shared() -> Topology {
        let neuron = |sources: Vec<usize>| GraphNeuron { activation: Activation::Tanh, bias: true, sources };
        let net = GraphShape {
            inputs: 2,
            recurrent: false,
            neurons: vec![neuron(vec![0, 1]), neuron(vec![2])],
            outputs: vec![3],
        };
        let turn = |genes| Turn { genes, factor: 1.0, phase: 0.3, phase_genes: vec![(6, 1.0)] };
        let weights = vec![
            SharedWeight::Sum(vec![(0, 1.0)]),
            SharedWeight::Sine(turn([1, 2])),
            SharedWeight::Cosine(turn([1, 2])),
            SharedWeight::Sum(vec![(3, 1.0), (4, 0.5)]),
            SharedWeight::Sum(vec![(5, -1.0)]),
        ];
        SharedShape { net: net.into(), groups: vec![3, 3, 1], weights }.into()
    }

    #[test]
    fn a_held_net_is_the_whole_one() {
        let dense = DenseShape { hidden_scale: 1.0, ..DenseShape::new(2, vec![3], 2) };
        for whole in [Topology::from(dense), shared()] {
            let genes = genes(whole.weight_count());
            for free in [vec![0], vec![3], vec![4], vec![1, 2, 5], vec![0, 1, 2, 3, 4, 5, 6]] {
                let held = whole.held(&genes, |gene| free.contains(&gene)).expect("something is free");
                let of_free: Vec<f32> = free.iter().map(|&gene| genes[gene]).collect();
                assert_eq!(held.weight_count(), free.len());
                let outputs = [held.network(&of_free), whole.network(&genes)].map(|mut net| {
                    let mut outputs = vec![0.0; whole.outputs()];
                    net.activate(&[0.7, -0.4], &mut outputs);
                    outputs
                });
                let close = outputs[0].iter().zip(&outputs[1]).all(|(found, whole)| (found - whole).abs() < 1e-6);
                assert!(close, "{free:?}: {outputs:?}");
                let json = serde_json::to_string(&held).expect("serialises");
                assert_eq!(serde_json::from_str::<Topology>(&json).expect("deserialises"), held);
            }
        }
    }

    #[test]
    fn what_cannot_be_held_is_said() {
        let error = |free: &[usize]| {
            shared().held(&genes(7), |gene| free.contains(&gene)).expect_err("it cannot be held").to_string()
        };
        assert_eq!(error(&[]), "groups = 0 genes: must be from 1 to 16777216 genes");
        assert_eq!(
            error(&[1]),
            "weights[1] = a clock of which one gene is held: must be a clock whose genes are both held or both free"
        );
        let scaled = Topology::from(DenseShape { hidden_scale: 2.0, ..DenseShape::new(1, vec![1], 1) });
        let said = scaled.held(&genes(4), |gene| gene == 0).expect_err("graphs have no scale").to_string();
        assert_eq!(said, "hidden_scale = 2: must be 1 in a net of which a part is held");
    }
}
