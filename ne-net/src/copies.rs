use crate::{GraphNet, GraphNeuron, GraphShape};
use ne_core::SettingError;
use serde::{Deserialize, Serialize};
use std::{collections::BTreeSet, fmt, sync::Arc};

/// Copies of one small net that make up a whole one: one a limb, say.
///
/// A [`SharedShape`](crate::SharedShape) says for each weight of a whole net which genes it is made of, so that the net must be
/// known. Here the small net may be any, one whose topology evolves too: [`whole`](Self::whole) puts copies of it together.
/// Each copy has senses of its own: each input of the small net is a weighted sum of the whole's inputs, and a constant.
///
/// ```
/// use ne_net::{Activation, CopySense, Copies, GraphNet, GraphNeuron, GraphShape, NetCopy};
///
/// // Two copies of a net of one input: the first senses the first input of the whole, the second is its mirror image.
/// let copy = |input, sign| NetCopy { senses: vec![CopySense { constant: 0.0, sources: vec![(input, sign)] }], sign };
/// let copies = Copies { inputs: 2, outputs: vec![(0, 0), (1, 0)], copies: vec![copy(0, 1.0), copy(1, -1.0)] };
/// let neuron = GraphNeuron { activation: Activation::Linear, bias: true, sources: vec![0] };
/// let small = GraphShape { inputs: 1, recurrent: false, neurons: vec![neuron], outputs: vec![1] };
/// let small = GraphNet::new(small, &[0.25, 0.5])?;
/// assert_eq!(copies.whole(&small).weights(), [0.25, 0.5, -0.25, 0.5]);
/// # Ok::<(), ne_net::NetworkError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "UncheckedCopies")]
#[cfg_attr(feature = "schema", schemars(!try_from, deny_unknown_fields))]
pub struct Copies {
    /// Inputs of the whole net, from 1 to 4096.
    #[cfg_attr(feature = "schema", schemars(range(min = 1, max = 4096)))]
    pub inputs: usize,
    /// For each output of the whole net, which copy it is from, and which of that copy's outputs it is; each once.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 4096)))]
    pub outputs: Vec<(usize, usize)>,
    /// The copies, at least one, all with as many senses.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 4096)))]
    pub copies: Vec<NetCopy>,
}

/// One of the [`Copies`] of a net.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct NetCopy {
    /// What each input of the small net is in this copy.
    #[cfg_attr(feature = "schema", schemars(length(min = 1, max = 4096)))]
    pub senses: Vec<CopySense>,
    /// −1 for a mirror image, whose outputs have the other sign, or 1. The sums of its output neurons change their sign, and
    /// so the outputs do if the activation is odd, as [`Tanh`](crate::Activation::Tanh) is. With another activation neurons that
    /// hear such an output hear something else, too.
    #[cfg_attr(feature = "schema", schemars(extend("enum" = [-1, 1])))]
    pub sign: f32,
}

/// An input of the small net in one copy.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(deny_unknown_fields)]
pub struct CopySense {
    /// What is always added.
    pub constant: f32,
    /// Inputs of the whole, each with a factor; nothing at all is an input that is always 0.
    pub sources: Vec<(usize, f32)>,
}

impl Copies {
    /// The number of inputs of the small net.
    pub fn small_inputs(&self) -> usize {
        self.copies.first().map_or(0, |copy| copy.senses.len())
    }

    /// The number of outputs of the small net.
    pub fn small_outputs(&self) -> usize {
        self.outputs.iter().map(|&(_, output)| output + 1).max().unwrap_or(0)
    }

    /// Checks the numbers.
    ///
    /// # Errors
    /// Names the field and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        let count = |field: &str, count: usize, most: usize| match (1..=most).contains(&count) {
            true => Ok(()),
            false => Err(SettingError::new(field, format!("{count} {field}"), format!("from 1 to {most} {field}"))),
        };
        count("inputs", self.inputs, GraphShape::MAX_WIDTH)?;
        count("outputs", self.outputs.len(), GraphShape::MAX_WIDTH)?;
        count("copies", self.copies.len(), GraphShape::MAX_WIDTH)?;
        let senses = self.small_inputs();
        for (index, copy) in self.copies.iter().enumerate() {
            let field = |rest: String| format!("copies[{index}].{rest}");
            if copy.senses.len() != senses || senses == 0 || senses > GraphShape::MAX_WIDTH {
                let (found, most) = (format!("{} senses", copy.senses.len()), GraphShape::MAX_WIDTH);
                let allowed = format!("as many as in every copy, from 1 to {most}");
                return Err(SettingError::new(field("senses".into()), found, allowed));
            }
            if copy.sign.abs() != 1.0 {
                return Err(SettingError::new(field("sign".into()), copy.sign, "-1 or 1"));
            }
            for (place, sense) in copy.senses.iter().enumerate() {
                let factors = sense.sources.iter().map(|&(_, factor)| factor);
                if let Some(wrong) = factors.chain([sense.constant]).find(|factor| !factor.is_finite()) {
                    return Err(SettingError::new(field(format!("senses[{place}]")), wrong, "finite"));
                }
                let mut seen = BTreeSet::new();
                let is_wrong = |&&(input, _): &&(usize, f32)| input >= self.inputs || !seen.insert(input);
                if let Some(&(wrong, _)) = sense.sources.iter().find(is_wrong) {
                    let allowed = format!("an input below {}, listed once", self.inputs);
                    return Err(SettingError::new(field(format!("senses[{place}].sources")), wrong, allowed));
                }
            }
        }
        let mut seen = BTreeSet::new();
        for (index, &(copy, output)) in self.outputs.iter().enumerate() {
            let wrong = |allowed: String| {
                Err(SettingError::new(format!("outputs[{index}]"), format!("{output} of copy {copy}"), allowed))
            };
            if copy >= self.copies.len() {
                return wrong(format!("of a copy below {}", self.copies.len()));
            }
            if output >= GraphShape::MAX_WIDTH {
                return wrong(format!("below {}", GraphShape::MAX_WIDTH));
            }
            if !seen.insert((copy, output)) {
                return wrong("listed once".into());
            }
        }
        Ok(())
    }

    /// The most neurons that a small net may have, so that the whole is a net.
    pub fn most_neurons(&self) -> usize {
        GraphShape::MAX_NEURONS / self.copies.len().max(1)
    }

    /// The whole net: a copy after the other, each with the neurons that lead to outputs of the whole, in the small net's order.
    /// The copies are valid.
    ///
    /// # Panics
    /// If the small net has other numbers of inputs or outputs than these copies.
    pub fn whole(&self, small: &GraphNet) -> GraphNet {
        let shape = small.shape();
        let (inputs, outputs) = (self.small_inputs(), self.small_outputs());
        assert_eq!((shape.inputs, shape.outputs.len()), (inputs, outputs), "inputs and outputs of the small net");
        let is_output: Vec<bool> =
            (0..shape.neurons.len()).map(|neuron| shape.outputs.contains(&(shape.inputs + neuron))).collect();
        let mut whole = Whole { inputs: self.inputs, neurons: Vec::new(), weights: Vec::new() };
        let mut nodes = Vec::with_capacity(self.copies.len());
        for (index, copy) in self.copies.iter().enumerate() {
            let is_used = |&(_, &(of, _)): &(usize, &(usize, usize))| of == index;
            let used = self.outputs.iter().enumerate().filter(is_used).map(|(_, &(_, output))| shape.outputs[output]);
            let is_needed = leads_to(used.collect(), shape);
            nodes.push(whole.add(copy, small, &is_needed, &is_output));
        }
        let neuron = |output: usize| shape.outputs[output] - shape.inputs;
        // An output that is used is needed.
        let node = |&(copy, output): &(usize, usize)| nodes[copy][neuron(output)].unwrap_or(self.inputs);
        let outputs = self.outputs.iter().map(node).collect();
        let net = GraphShape { inputs: self.inputs, recurrent: shape.recurrent, neurons: whole.neurons, outputs };
        GraphNet::from_checked(Arc::new(net), &whole.weights)
    }
}

/// A whole net while copies are added.
struct Whole {
    inputs: usize,
    neurons: Vec<GraphNeuron>,
    weights: Vec<f32>,
}

impl Whole {
    /// Adds a copy; returns for each neuron of the small net its node.
    fn add(&mut self, copy: &NetCopy, small: &GraphNet, needed: &[bool], is_output: &[bool]) -> Vec<Option<usize>> {
        let shape = small.shape();
        let mut next = self.inputs + self.neurons.len();
        // Numbered first: in a net with cycles a source may stand behind.
        let number = |&is_needed: &bool| {
            next += usize::from(is_needed);
            is_needed.then(|| next - 1)
        };
        let nodes: Vec<Option<usize>> = needed.iter().map(number).collect();
        let sign_of = |neuron: usize| if is_output[neuron] { copy.sign } else { 1.0 };
        let mut rest = small.weights();
        for (index, neuron) in shape.neurons.iter().enumerate() {
            let (own, later) = rest.split_at(neuron.weight_count());
            rest = later;
            if nodes[index].is_none() {
                continue;
            }
            let sign = sign_of(index);
            let (mut bias, connections) = match neuron.bias {
                true => (Some(sign * own[0]), &own[1..]),
                false => (None, own),
            };
            let mut sources: Vec<(usize, f32)> = Vec::with_capacity(connections.len());
            for (&source, &weight) in neuron.sources.iter().zip(connections) {
                let weight = sign * weight;
                match source.checked_sub(shape.inputs) {
                    // The sources of a needed neuron are needed.
                    Some(hidden) => sources.extend(nodes[hidden].map(|node| (node, sign_of(hidden) * weight))),
                    None => {
                        let sense = &copy.senses[source];
                        if sense.constant != 0.0 {
                            bias = Some(bias.unwrap_or(0.0) + sense.constant * weight);
                        }
                        for &(input, factor) in &sense.sources {
                            match sources.iter_mut().find(|(known, _)| *known == input) {
                                Some((_, sum)) => *sum += factor * weight,
                                None => sources.push((input, factor * weight)),
                            }
                        }
                    }
                }
            }
            self.weights.extend(bias.into_iter().chain(sources.iter().map(|&(_, weight)| weight)).map(finite));
            let (activation, sources) = (neuron.activation, sources.iter().map(|&(node, _)| node).collect());
            self.neurons.push(GraphNeuron { activation, bias: bias.is_some(), sources });
        }
        nodes
    }
}

/// Weights are finite; what is computed from huge ones must be too.
fn finite(weight: f32) -> f32 {
    if weight.is_nan() { 0.0 } else { weight.clamp(f32::MIN, f32::MAX) }
}

/// For each neuron whether a way leads from it to one of these nodes, which count themselves.
fn leads_to(mut nodes: Vec<usize>, shape: &GraphShape) -> Vec<bool> {
    let mut leads = vec![false; shape.neurons.len()];
    while let Some(node) = nodes.pop() {
        let Some(neuron) = node.checked_sub(shape.inputs) else { continue };
        if !std::mem::replace(&mut leads[neuron], true) {
            nodes.extend(&shape.neurons[neuron].sources);
        }
    }
    leads
}

/// A small net without its weights, and the [`Copies`] of it that make up the whole.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(try_from = "UncheckedCopiedShape")]
#[cfg_attr(feature = "schema", schemars(!try_from, deny_unknown_fields))]
pub struct CopiedShape {
    /// The small net.
    pub small: Arc<GraphShape>,
    /// The copies.
    pub copies: Arc<Copies>,
}

impl CopiedShape {
    /// Checks the small net and the copies.
    ///
    /// # Errors
    /// Names the field and what is allowed.
    pub fn validate(&self) -> Result<(), SettingError> {
        self.small.validate().map_err(|error| error.within("small"))?;
        self.copies.validate().map_err(|error| error.within("copies"))?;
        for (field, found, expected) in [
            ("small.inputs", self.small.inputs, self.copies.small_inputs()),
            ("small.outputs", self.small.outputs.len(), self.copies.small_outputs()),
        ] {
            if found != expected {
                return Err(SettingError::new(field, found, format!("{expected}, as the copies have it")));
            }
        }
        let (found, most) = (self.small.neurons.len(), self.copies.most_neurons());
        if found > most {
            let allowed = format!("at most {most} with {} copies", self.copies.copies.len());
            return Err(SettingError::new("small.neurons", format!("{found} neurons"), allowed));
        }
        // An input of the small net may be several of the whole.
        let longest = |input: usize| {
            let lengths = self.copies.copies.iter().map(|copy| copy.senses[input].sources.len());
            lengths.max().unwrap_or(0).max(1)
        };
        let lengths: Vec<usize> = (0..self.small.inputs).map(longest).collect();
        let weights_of = |neuron: &GraphNeuron| {
            1 + neuron.sources.iter().map(|&source| lengths.get(source).copied().unwrap_or(1)).sum::<usize>()
        };
        let weights = self.small.neurons.iter().map(weights_of).sum::<usize>().saturating_mul(self.copies.copies.len());
        if weights > GraphShape::MAX_WEIGHTS {
            let (found, most) = (format!("{weights} weights in all copies"), GraphShape::MAX_WEIGHTS);
            return Err(SettingError::new("small", found, format!("at most {most}")));
        }
        Ok(())
    }
}

/// The small net and the number of copies: `4 copies of 9 inputs, 3 hidden, 2 outputs, 33 connections`.
impl fmt::Display for CopiedShape {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} copies of {}", self.copies.copies.len(), self.small)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "CopiedShape")]
struct UncheckedCopiedShape {
    small: Arc<GraphShape>,
    copies: Arc<Copies>,
}

impl TryFrom<UncheckedCopiedShape> for CopiedShape {
    type Error = SettingError;

    fn try_from(UncheckedCopiedShape { small, copies }: UncheckedCopiedShape) -> Result<Self, SettingError> {
        let shape = Self { small, copies };
        shape.validate()?;
        Ok(shape)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename = "Copies")]
struct UncheckedCopies {
    inputs: usize,
    outputs: Vec<(usize, usize)>,
    copies: Vec<NetCopy>,
}

impl TryFrom<UncheckedCopies> for Copies {
    type Error = SettingError;

    fn try_from(UncheckedCopies { inputs, outputs, copies }: UncheckedCopies) -> Result<Self, SettingError> {
        let copies = Self { inputs, outputs, copies };
        copies.validate()?;
        Ok(copies)
    }
}

#[cfg(test)]
mod tests;
