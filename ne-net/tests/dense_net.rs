//! What dense nets promise, for nets of any shape.

use ne_core::Phenotype;
use ne_net::{Activation, DenseNet, DenseShape};
use proptest::{collection::vec, prelude::*};

/// The definition, written down neuron by neuron: bias first, then the sources in order.
fn reference(shape: &DenseShape, weights: &[f32], inputs: &[f32]) -> Vec<Vec<f32>> {
    let mut weights = weights.iter();
    let mut layers = vec![inputs.to_vec()];
    let last = shape.hidden.len();
    for (layer, (sources, targets)) in shape.connections().enumerate() {
        let mut outputs = Vec::new();
        for _ in 0..targets {
            let mine: Vec<f32> = weights.by_ref().take(sources + 1).copied().collect();
            let sum =
                layers[layer].iter().zip(&mine).fold(mine[sources], |sum, (source, weight)| sum + weight * source);
            outputs.push(if layer == last {
                shape.output_activation.apply(sum)
            } else {
                shape.hidden_activation.apply(sum) * shape.hidden_scale
            });
        }
        layers.push(outputs);
    }
    layers
}

fn bits(values: &[f32]) -> Vec<u32> {
    values.iter().map(|value| value.to_bits()).collect()
}

fn activations() -> impl Strategy<Value = Activation> {
    proptest::sample::select(Activation::ALL.to_vec())
}

prop_compose! {
    fn shapes()(
        inputs in 1..20usize, hidden in vec(1..20usize, 0..4), outputs in 1..20usize,
        hidden_activation in activations(), output_activation in activations(), hidden_scale in 0.1..4.0f32,
    ) -> DenseShape {
        DenseShape { inputs, hidden, outputs, hidden_activation, output_activation, hidden_scale }
    }
}

prop_compose! {
    fn nets()(shape in shapes())(
        weights in vec(-2.0..2.0f32, shape.weight_count()), inputs in vec(-3.0..3.0f32, shape.inputs), shape in Just(shape),
    ) -> (DenseNet, Vec<f32>) {
        (DenseNet::new(shape, &weights).expect("valid"), inputs)
    }
}

fn activate(net: &mut DenseNet, inputs: &[f32]) -> Vec<f32> {
    let mut outputs = vec![f32::NAN; net.outputs()];
    net.activate(inputs, &mut outputs);
    outputs
}

proptest! {
    #[test]
    fn equals_the_definition_to_the_bit((mut net, inputs) in nets()) {
        let outputs = activate(&mut net, &inputs);
        let wanted = reference(net.shape(), net.weights(), &inputs);
        prop_assert_eq!(bits(&outputs), bits(wanted.last().expect("at least the outputs")));
        let found: Vec<_> = net.activations().map(bits).collect();
        prop_assert_eq!(found, wanted.iter().map(|layer| bits(layer)).collect::<Vec<_>>());
    }

    #[test]
    fn outputs_are_finite_and_in_range((mut net, inputs) in nets()) {
        let (low, high) = net.shape().output_activation.range();
        for output in activate(&mut net, &inputs) {
            prop_assert!(output.is_finite() && low <= output && output <= high);
        }
    }

    #[test]
    fn survives_serialisation_to_the_bit((mut net, inputs) in nets()) {
        let text = serde_json::to_string(&net).expect("serialises");
        let mut loaded: DenseNet = serde_json::from_str(&text).expect("deserialises");
        prop_assert_eq!(bits(loaded.weights()), bits(net.weights()));
        prop_assert_eq!(&loaded, &net);
        prop_assert_eq!(bits(&activate(&mut loaded, &inputs)), bits(&activate(&mut net, &inputs)));
    }

    #[test]
    fn has_no_memory((mut net, inputs) in nets()) {
        let first = activate(&mut net, &inputs);
        let others: Vec<f32> = inputs.iter().map(|input| 1.0 - input).collect();
        activate(&mut net, &others);
        prop_assert_eq!(bits(&activate(&mut net, &inputs)), bits(&first));
        net.reset();
        prop_assert_eq!(bits(&activate(&mut net, &inputs)), bits(&first));
    }

    #[test]
    fn doubled_weights_double_a_linear_layer(
        weights in vec(-2.0..2.0f32, 4 * 3), inputs in vec(-3.0..3.0f32, 3),
    ) {
        let shape = DenseShape { output_activation: Activation::Linear, ..DenseShape::new(3, vec![], 3) };
        let doubled: Vec<f32> = weights.iter().map(|weight| 2.0 * weight).collect();
        let mut net = DenseNet::new(shape.clone(), &weights).expect("valid");
        let mut double = DenseNet::new(shape, &doubled).expect("valid");
        let wanted: Vec<f32> = activate(&mut net, &inputs).iter().map(|output| 2.0 * output).collect();
        prop_assert_eq!(bits(&activate(&mut double, &inputs)), bits(&wanted));
    }

    #[test]
    fn any_other_number_of_weights_is_an_error(shape in shapes(), count in 0..2000usize) {
        prop_assume!(count != shape.weight_count());
        let error = DenseNet::new(shape, &vec![0.0; count]).expect_err("wrong number").to_string();
        let start = format!("weights: found {count}, a net of shape ");
        prop_assert!(error.starts_with(&start));
    }
}

#[test]
fn errors_name_the_field() {
    let shape = DenseShape::new(9, vec![10], 8);
    let mut weights = vec![0.0; 188];
    weights[17] = f32::NAN;
    let error =
        |shape: &DenseShape, weights: &[f32]| DenseNet::new(shape.clone(), weights).expect_err("not a net").to_string();
    assert_eq!(error(&shape, &weights), "weights[17] = NaN: must be finite");
    assert_eq!(error(&shape, &weights[..187]), "weights: found 187, a net of shape 9-10-8 has 188");
    let empty = DenseShape::new(9, vec![0], 8);
    assert_eq!(error(&empty, &weights), "shape.hidden[0] = 0: must be from 1 to 4096");
}

#[test]
fn damaged_files_are_errors() {
    let shape = r#""shape": {"inputs": 1, "hidden": [], "outputs": 1}"#;
    for (text, part) in [
        (format!(r#"{{{shape}, "weights": [0.5]}}"#), "weights: found 1, a net of shape 1-1 has 2"),
        (format!(r#"{{{shape}, "weights": [0.5, 1e39]}}"#), "number out of range"),
        (format!(r#"{{{shape}, "weights": [0.5, null]}}"#), "invalid type: null"),
        (format!(r#"{{{shape}, "weights": [0.5, NaN]}}"#), "expected value"),
        (format!(r#"{{{shape}}}"#), "missing field `weights`"),
        (
            r#"{"shape": {"inputs": 0, "hidden": [], "outputs": 1}, "weights": []}"#.into(),
            "inputs = 0: must be from 1 to 4096",
        ),
    ] {
        let error = serde_json::from_str::<DenseNet>(&text).expect_err("damaged").to_string();
        assert!(error.contains(part), "{error}");
    }
    // Through a value, a number too large for an f32 becomes an infinity.
    let value = serde_json::from_str::<serde_json::Value>(&format!(r#"{{{shape}, "weights": [0.5, 1e39]}}"#));
    let error = serde_json::from_value::<DenseNet>(value.expect("JSON")).expect_err("infinite").to_string();
    assert!(error.contains("weights[1] = inf: must be finite"), "{error}");
}

#[test]
fn nan_goes_through_to_the_outputs() {
    for activation in Activation::ALL {
        let shape = DenseShape {
            hidden_activation: activation,
            output_activation: activation,
            ..DenseShape::new(2, vec![3], 2)
        };
        let mut net = DenseNet::new(shape, &[0.5; 17]).expect("valid");
        assert!(activate(&mut net, &[0.0, f32::NAN]).iter().all(|output| output.is_nan()), "{activation}");
        assert!(activate(&mut net, &[0.0, 1.0]).iter().all(|output| output.is_finite()), "{activation}");
    }
}

/// Golden: other bits are other runs, and champions that no longer repeat theirs.
#[test]
fn bits_are_the_same_for_ever() {
    let weights: Vec<f32> = (0..188).map(|index| ((index * 37 % 101) as f32 - 50.0) * 0.006).collect();
    let mut net = DenseNet::new(DenseShape::new(9, vec![10], 8), &weights).expect("valid");
    let inputs: Vec<f32> = (0..9).map(|index| (index as f32 - 4.0) * 0.7).collect();
    let golden =
        [0xbf68_860c, 0xbf5c_c2cb, 0xbf4b_bc31, 0xbf0a_de43, 0xbebf_2d4a, 0xbe33_7872, 0x3e91_47e1, 0x3eef_6c55];
    assert_eq!(bits(&activate(&mut net, &inputs)), golden);
}
