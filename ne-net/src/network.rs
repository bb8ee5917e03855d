use crate::DenseNet;
use ne_core::Phenotype;
use serde::{Deserialize, Serialize};

/// A net of any kind: what a champion's file stores and a game loads.
///
/// In JSON the kind stands beside the fields of the net: `{"kind": "dense", "shape": …, "weights": […]}`. Graph nets
/// come as another variant.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Network {
    /// Layers, each fully connected with the next.
    Dense(DenseNet),
}

impl From<DenseNet> for Network {
    fn from(net: DenseNet) -> Self {
        Self::Dense(net)
    }
}

impl Phenotype for Network {
    fn inputs(&self) -> usize {
        match self {
            Self::Dense(net) => net.inputs(),
        }
    }

    fn outputs(&self) -> usize {
        match self {
            Self::Dense(net) => net.outputs(),
        }
    }

    fn reset(&mut self) {
        match self {
            Self::Dense(net) => net.reset(),
        }
    }

    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        match self {
            Self::Dense(net) => net.activate(inputs, outputs),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::DenseShape;

    #[test]
    fn survives_serialisation_and_says_its_kind() {
        let net = DenseNet::new(DenseShape::new(1, vec![], 1), &[0.25, -0.5]).expect("two weights");
        let network = Network::from(net);
        let text = serde_json::to_string(&network).expect("serialises");
        assert!(text.starts_with(r#"{"kind":"dense","shape":{"inputs":1,"#), "{text}");
        assert_eq!(serde_json::from_str::<Network>(&text).expect("deserialises"), network);
    }

    #[test]
    fn another_kind_or_field_is_an_error() {
        for (text, part) in [
            (r#"{"kind": "cloud"}"#, "unknown variant `cloud`, expected `dense`"),
            (r#"{"weights": []}"#, "missing field `kind`"),
            (
                r#"{"kind": "dense", "shape": {"inputs": 1, "hidden": [], "outputs": 1}, "weights": [0, 1], "bias": 1}"#,
                "unknown field `bias`",
            ),
        ] {
            let error = serde_json::from_str::<Network>(text).expect_err("not a network").to_string();
            assert!(error.contains(part), "{error}");
        }
    }
}
