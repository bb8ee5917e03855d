use crate::{GraphShape, mathematics::sin};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};
use std::{f32::consts::FRAC_PI_2, fmt, sync::Arc};

/// A graph net whose weights are not free: each is computed from a few genes, and a gene may count in many weights.
///
/// This is how copies of one small net, such as one a leg, share what they learn: what is searched for is one copy's
/// weights, and what is built is the whole net. The nets are ordinary graph nets.
///
/// ```
/// use ne_net::{Activation, GraphNeuron, GraphShape, SharedWeight, SharedShape, Topology};
///
/// // Two neurons, each with an input of its own, and one weight for both, in the second with its sign turned.
/// let neuron = |input| GraphNeuron { activation: Activation::Linear, bias: false, sources: vec![input] };
/// let net = GraphShape { inputs: 2, recurrent: false, neurons: vec![neuron(0), neuron(1)], outputs: vec![2, 3] };
/// let weights = vec![SharedWeight::Sum(vec![(0, 1.0)]), SharedWeight::Sum(vec![(0, -1.0)])];
/// let topology = Topology::from(SharedShape { net: net.into(), groups: vec![1], weights });
/// assert_eq!(topology.weight_count(), 1);
/// assert_eq!(topology.network(&[0.5]).weights(), [0.5, -0.5]);
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "UncheckedSharedShape")]
#[cfg_attr(feature = "schema", schemars(!try_from, deny_unknown_fields))]
pub struct SharedShape {
    /// The net.
    pub net: Arc<GraphShape>,
    /// The genes, in groups that belong together: the number of each.
    pub groups: Vec<usize>,
    /// For each weight of the net, in their order, how it is computed.
    pub weights: Vec<SharedWeight>,
}

/// How a weight is computed from genes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case", deny_unknown_fields)]
pub enum SharedWeight {
    /// The sum of genes, each times a factor; nothing summed up is a weight of 0.
    Sum(Vec<(usize, f32)>),
    /// Of two genes, the weights of the sine and of the cosine of a clock, the one of the sine after the clock was put
    /// forward by `phase`.
    Sine(Turn),
    /// The same, the one of the cosine.
    Cosine(Turn),
    /// A constant, and the sum of genes, each times a factor.
    Affine {
        /// The constant.
        constant: f32,
        /// The genes and their factors.
        terms: Vec<(usize, f32)>,
    },
}

/// Two genes that weigh a clock's sine and cosine, and by how much the clock is put forward.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct Turn {
    /// The genes of the sine and of the cosine.
    pub genes: [usize; 2],
    /// What both are multiplied by.
    pub factor: f32,
    /// rad.
    pub phase: f32,
    /// Genes that are added to the phase, each times a factor, in rad.
    pub phase_genes: Vec<(usize, f32)>,
}

impl Turn {
    /// The weights of sine and cosine.
    fn weights(&self, genes: &[f32]) -> [f32; 2] {
        let phase = self.phase + sum(&self.phase_genes, genes);
        let (sin, cos) = (sin(phase), sin(phase + FRAC_PI_2));
        let [a, b] = self.genes.map(|gene| self.factor * genes[gene]);
        // a sin(t + p) + b cos(t + p), written with sin t and cos t.
        [a * cos - b * sin, a * sin + b * cos]
    }
}

fn sum(terms: &[(usize, f32)], genes: &[f32]) -> f32 {
    terms.iter().map(|&(gene, factor)| factor * genes[gene]).sum()
}

impl SharedWeight {
    fn weight(&self, genes: &[f32]) -> f32 {
        let weight = match self {
            Self::Sum(terms) => sum(terms, genes),
            Self::Sine(turn) => turn.weights(genes)[0],
            Self::Cosine(turn) => turn.weights(genes)[1],
            Self::Affine { constant, terms } => constant + sum(terms, genes),
        };
        // Genes are finite; what is computed from huge ones must be too.
        if weight.is_nan() { 0.0 } else { weight.clamp(f32::MIN, f32::MAX) }
    }

    /// A weight that no gene changes.
    pub fn fixed(weight: f32) -> Self {
        Self::Affine { constant: weight, terms: Vec::new() }
    }

    /// The same with some genes held; `place`: where each gene is among those that are not. `None` for a clock of which one gene is
    /// held and the other is not.
    pub(crate) fn held(&self, genes: &[f32], place: &[Option<usize>]) -> Option<Self> {
        if self.genes().all(|(gene, _)| place[gene].is_none()) {
            return Some(Self::fixed(self.weight(genes)));
        }
        // What the held genes add, and the others.
        let split = |terms: &[(usize, f32)]| {
            let (held, free): (Vec<_>, Vec<_>) = terms.iter().copied().partition(|&(gene, _)| place[gene].is_none());
            let free = free.into_iter().filter_map(|(gene, factor)| Some((place[gene]?, factor))).collect::<Vec<_>>();
            (sum(&held, genes), free)
        };
        let turned = |turn: &Turn| {
            let [sine, cosine] = turn.genes.map(|gene| place[gene]);
            let (held, phase_genes) = split(&turn.phase_genes);
            Some(Turn { genes: [sine?, cosine?], phase: turn.phase + held, phase_genes, factor: turn.factor })
        };
        Some(match self {
            Self::Sum(terms) => match split(terms) {
                (_, free) if free.len() == terms.len() => Self::Sum(free),
                (constant, terms) => Self::Affine { constant, terms },
            },
            Self::Affine { constant, terms } => {
                let (held, terms) = split(terms);
                Self::Affine { constant: constant + held, terms }
            }
            Self::Sine(turn) => Self::Sine(turned(turn)?),
            Self::Cosine(turn) => Self::Cosine(turned(turn)?),
        })
    }

    fn genes(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let (terms, turn) = match self {
            Self::Sum(terms) | Self::Affine { terms, .. } => (terms.as_slice(), None),
            Self::Sine(turn) | Self::Cosine(turn) => (turn.phase_genes.as_slice(), Some(turn)),
        };
        terms.iter().copied().chain(turn.into_iter().flat_map(|turn| turn.genes.map(|gene| (gene, turn.factor))))
    }
}

impl SharedShape {
    /// The number of genes.
    pub fn gene_count(&self) -> usize {
        // More than can be counted is refused as too many.
        self.groups.iter().fold(0, |sum, &group| sum.saturating_add(group))
    }

    /// The weights of the net.
    ///
    /// # Panics
    /// If there are fewer genes than the shape has.
    pub fn weights(&self, genes: &[f32]) -> Vec<f32> {
        self.weights.iter().map(|tie| tie.weight(genes)).collect()
    }

    /// Checks the net and the shared weights.
    ///
    /// # Errors
    /// Names the field and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.net.validate().map_err(|error| error.within("net"))?;
        let (found, expected) = (self.weights.len(), self.net.weight_count());
        if found != expected {
            return Err(SettingError::new(
                "weights",
                format!("{found} shared weights"),
                format!("{expected}, one for each weight"),
            ));
        }
        let genes = self.gene_count();
        if !(1..=GraphShape::MAX_WEIGHTS).contains(&genes) {
            let allowed = format!("from 1 to {} genes", GraphShape::MAX_WEIGHTS);
            return Err(SettingError::new("groups", format!("{genes} genes"), allowed));
        }
        for (index, tie) in self.weights.iter().enumerate() {
            for (gene, factor) in tie.genes() {
                let field = || format!("weights[{index}]");
                if gene >= genes {
                    return Err(SettingError::new(field(), format!("gene {gene}"), format!("a gene below {genes}")));
                }
                if !factor.is_finite() {
                    return Err(SettingError::new(field(), factor, "a finite factor"));
                }
            }
            if let SharedWeight::Sine(turn) | SharedWeight::Cosine(turn) = tie
                && !turn.phase.is_finite()
            {
                return Err(SettingError::new(format!("weights[{index}].phase"), turn.phase, "finite"));
            }
            if let SharedWeight::Affine { constant, .. } = tie
                && !constant.is_finite()
            {
                return Err(SettingError::new(format!("weights[{index}].constant"), constant, "finite"));
            }
        }
        Ok(())
    }
}

/// The net and the number of genes: `9 inputs, 3 hidden, 8 outputs, 78 connections from 12 genes`.
impl fmt::Display for SharedShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} from {} genes", self.net, self.gene_count())
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "SharedShape")]
struct UncheckedSharedShape {
    net: GraphShape,
    groups: Vec<usize>,
    weights: Vec<SharedWeight>,
}

impl TryFrom<UncheckedSharedShape> for SharedShape {
    type Error = SettingError;

    fn try_from(unchecked: UncheckedSharedShape) -> Result<Self, SettingError> {
        let UncheckedSharedShape { net, groups, weights } = unchecked;
        let shape = Self { net: net.into(), groups, weights };
        shape.validate()?;
        Ok(shape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Activation, GraphNeuron, Topology};
    use ne_core::Phenotype;

    /// One neuron that hears a clock, sine first.
    fn clock(weights: Vec<SharedWeight>, groups: Vec<usize>) -> SharedShape {
        let neuron = GraphNeuron { activation: Activation::Linear, bias: false, sources: vec![0, 1] };
        let net = GraphShape { inputs: 2, recurrent: false, neurons: vec![neuron], outputs: vec![2] };
        SharedShape { net: net.into(), groups, weights }
    }

    fn turned(phase: f32) -> SharedShape {
        let turn = Turn { genes: [0, 1], factor: 1.0, phase, phase_genes: vec![(2, 0.5)] };
        clock(vec![SharedWeight::Sine(turn.clone()), SharedWeight::Cosine(turn)], vec![2, 1])
    }

    #[test]
    fn more_genes_than_can_be_counted_are_too_many() {
        let shape =
            clock(vec![SharedWeight::Sum(vec![(0, 1.0)]), SharedWeight::Sum(vec![(1, 1.0)])], vec![usize::MAX, 2]);
        let error = shape.validate().expect_err("too many").to_string();
        assert!(error.starts_with("groups = "), "{error}");
    }

    #[test]
    fn a_turned_clock_is_the_clock_put_forward() {
        let (ahead, genes) = (0.7, [0.3, -1.1, 0.4]);
        let mut net = Topology::from(turned(ahead)).network(&genes);
        let mut plain = Topology::from(turned(0.0)).network(&[genes[0], genes[1], 0.0]);
        let hear = |net: &mut crate::Network, time: f32| {
            let mut output = [0.0];
            net.activate(&[sin(time), sin(time + FRAC_PI_2)], &mut output);
            output[0]
        };
        for step in 0..40 {
            let time = step as f32 * 0.25;
            let (found, expected) = (hear(&mut net, time), hear(&mut plain, time + ahead + 0.5 * genes[2]));
            assert!((found - expected).abs() < 1e-5, "{found}, expected {expected} at {time}");
        }
    }

    #[test]
    fn survives_serialisation_and_counts_its_genes() {
        let topology = Topology::from(turned(1.0));
        assert_eq!((topology.weight_count(), topology.inputs(), topology.outputs()), (3, 2, 1));
        assert_eq!(topology.weights_of_neurons().collect::<Vec<_>>(), [2, 1]);
        assert_eq!(topology.to_string(), "2 inputs, 0 hidden, 1 outputs, 2 connections from 3 genes");
        let json = serde_json::to_string(&topology).expect("serialises");
        assert_eq!(serde_json::from_str::<Topology>(&json).expect("deserialises"), topology);
    }

    #[test]
    fn weights_of_any_finite_genes_are_finite() {
        for gene in [f32::MAX, f32::MIN, 1e30, -1e30] {
            assert!(turned(0.3).weights(&[gene; 3]).iter().all(|weight| weight.is_finite()));
        }
    }

    #[test]
    fn errors_name_the_field() {
        let error = |weights: Vec<SharedWeight>| clock(weights, vec![1]).validate().expect_err("invalid").to_string();
        let sum = |gene, factor| SharedWeight::Sum(vec![(gene, factor)]);
        assert_eq!(error(vec![sum(0, 1.0)]), "weights = 1 shared weights: must be 2, one for each weight");
        assert_eq!(error(vec![sum(0, 1.0), sum(1, 1.0)]), "weights[1] = gene 1: must be a gene below 1");
        assert_eq!(error(vec![sum(0, f32::NAN), sum(0, 1.0)]), "weights[0] = NaN: must be a finite factor");
        let none =
            clock(vec![SharedWeight::Sum(vec![]), SharedWeight::Sum(vec![])], vec![]).validate().expect_err("no genes");
        assert_eq!(none.to_string(), "groups = 0 genes: must be from 1 to 16777216 genes");
        let topology = Topology::from(turned(0.0));
        let genes = |genes: &[f32]| topology.check_weights(genes).expect_err("invalid").to_string();
        assert_eq!(
            genes(&[0.0]),
            "weights: found 1, a net of 2 inputs, 0 hidden, 1 outputs, 2 connections from 3 genes has 3"
        );
        assert_eq!(genes(&[0.0, f32::NAN, 0.0]), "weights[1] = NaN: must be finite");
    }
}
