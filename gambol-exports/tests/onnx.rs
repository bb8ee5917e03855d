//! A net as an ONNX model gives what the net gives, step by step with its own state: the bits, where each operation is computed
//! with its 32 bits, and what differs by less than 1e-6 in onnxruntime.
#![allow(clippy::print_stderr)]

mod common;
mod onnx_model;

use common::{Outcome, all_sensors, champion, dense, recurrent, weights};
use creatures::{Actuation, Sensor};
use gambol_exports::{Format, Options, Picture, export};
use gambol_runs::{Registry, champion::Champion, judge::Judge};
use ne_net::{Activation, DenseNet, DenseShape, GraphNet, GraphNeuron, GraphShape, Network};
use onnx_model::Model;
use std::{error::Error, fs, path::Path, process::Command};

/// How far onnxruntime may be off.
const TOLERANCE: f64 = 1e-6;

/// 20 s of a champion; whatever is remembered wrongly adds up.
const STEPS: usize = 1000;

type Kind = (&'static str, fn(usize, usize) -> Network);

/// Nets that have all that a net may have.
const KINDS: [Kind; 5] =
    [("dense", dense), ("recurrent", recurrent), ("scaled", scaled), ("straight", straight), ("deaf", deaf)];

/// With several layers, whose neurons are scaled.
fn scaled(inputs: usize, outputs: usize) -> Network {
    let shape = DenseShape {
        hidden_activation: Activation::SteepLogistic,
        output_activation: Activation::RationalTanh,
        hidden_scale: 0.7,
        ..DenseShape::new(inputs, vec![6, 3], outputs)
    };
    let weights = weights(shape.weight_count());
    DenseNet::new(shape, &weights).expect("as many weights as there are").into()
}

/// A graph without cycles, whose outputs stand anywhere.
fn straight(inputs: usize, outputs: usize) -> Network {
    let neuron = |index: usize| {
        let mut sources = vec![(index * 5 + 1) % (inputs + index), index % inputs];
        sources.dedup();
        GraphNeuron { activation: Activation::ALL[index / 2 % 9], bias: !index.is_multiple_of(3), sources }
    };
    let neurons = (0..2 * outputs + 18).map(neuron).collect();
    let nodes = (0..outputs).map(|output| inputs + 18 + 2 * output).rev().collect();
    let shape = GraphShape { inputs, recurrent: false, neurons, outputs: nodes };
    let weights = weights(shape.weight_count());
    GraphNet::new(shape, &weights).expect("sound").into()
}

/// Some outputs hear nothing, and some only what they put out themselves.
fn deaf(inputs: usize, outputs: usize) -> Network {
    let neuron = |index: usize| {
        let sources = if index.is_multiple_of(2) { Vec::new() } else { vec![inputs + index] };
        GraphNeuron { activation: Activation::Tanh, bias: true, sources }
    };
    let nodes = (inputs..inputs + outputs).collect();
    let shape = GraphShape { inputs, recurrent: true, neurons: (0..outputs).map(neuron).collect(), outputs: nodes };
    let weights = weights(shape.weight_count());
    GraphNet::new(shape, &weights).expect("sound").into()
}

fn file(champion: &Champion, format: Format) -> Result<Vec<u8>, Box<dyn Error>> {
    let options = Options { name: "net".into(), steps: Some(STEPS as u32), picture: Picture::default() };
    let mut files = export(champion, &Registry::default(), format, &options)?;
    Ok(files.remove(0).bytes)
}

/// Champions to the end of their training, and how they came about: a net of limbs that share weights, with gates of
/// weights up to 1333 (`gambol train tetrapod-1 playing`), and a net of NEAT with recurrent connections (`gambol train tetrapod-2
/// running --strategy neat --set strategy.neat.recurrent=true --generations 600`).
const TRAINED: [&str; 2] = ["tetrapod-1-playing", "tetrapod-2-running-neat"];

/// All nets with their names: made up, and trained.
fn champions() -> Result<Vec<(&'static str, Champion)>, Box<dyn Error>> {
    let made_up = |(name, net): Kind| {
        let champion = champion("biped-2", "gaps", Actuation::Angle { gain: 12.0 }, all_sensors(), net)?;
        Ok((name, champion))
    };
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/champions");
    let trained = |name| Ok((name, Champion::read(&folder.join(name).with_extension("json"))?));
    KINDS.into_iter().map(made_up).chain(TRAINED.into_iter().map(trained)).collect()
}

/// The rows of a trace: inputs and outputs.
fn steps(trace: &str, champion: &Champion) -> Result<Vec<[Vec<f32>; 2]>, Box<dyn Error>> {
    let header: Vec<&str> = trace.lines().next().ok_or("no header")?.split(',').collect();
    let first = |name: &str| header.iter().position(|column| *column == name).ok_or("no such column");
    let (input, output) = (first("input0")?, first("output0")?);
    let row = |line: &str| {
        let numbers = line.split(',').map(str::parse).collect::<Result<Vec<f32>, _>>()?;
        let inputs = numbers[input..input + champion.inputs.len()].to_vec();
        Ok([inputs, numbers[output..output + champion.outputs.len()].to_vec()])
    };
    trace.lines().skip(1).map(row).collect()
}

#[test]
fn a_model_that_is_read_again_gives_the_bits_of_the_net() -> Outcome {
    for (name, champion) in champions()? {
        let model = Model::read(&file(&champion, Format::Onnx)?);
        let (inputs, outputs) = (champion.inputs.len() as u64, champion.outputs.len() as u64);
        assert_eq!(model.inputs[0], ("inputs".into(), vec![1, inputs]));
        assert_eq!(model.outputs[0], ("outputs".into(), vec![1, outputs]));
        let is_recurrent = matches!(name, "recurrent" | "deaf" | "tetrapod-2-running-neat");
        assert_eq!((model.inputs.len(), model.outputs.len()), if is_recurrent { (2, 2) } else { (1, 1) }, "{name}");
        let neurons = champion.network.view().neurons.len();
        if is_recurrent {
            assert_eq!(model.inputs[1], ("state".into(), vec![1, neurons as u64]));
            assert_eq!(model.outputs[1], ("next_state".into(), vec![1, neurons as u64]));
        }
        let mut state = vec![0.0; neurons];
        let trace = String::from_utf8(file(&champion, Format::Trace)?)?;
        let steps = steps(&trace, &champion)?;
        assert_eq!(steps.len(), STEPS);
        for (step, [inputs, outputs]) in steps.into_iter().enumerate() {
            let given = [("inputs", &*inputs), ("state", &*state)];
            let known = model.run(&given[..if is_recurrent { 2 } else { 1 }]);
            state = known.get("next_state").cloned().unwrap_or_default();
            assert_eq!(known["outputs"], outputs, "{name}, step {step}");
        }
    }
    Ok(())
}

/// Were they not, they would test nothing that nets with small weights do not.
#[test]
fn trained_nets_are_as_hard_as_they_get() -> Outcome {
    let trained = champions()?.split_off(KINDS.len());
    let nets: Vec<&Network> = trained.iter().map(|(_, champion)| &champion.network).collect();
    let largest = |net: &Network| net.weights().iter().map(|weight| weight.abs()).fold(0.0, f32::max);
    assert!(largest(nets[0]) > 1000.0 && largest(nets[1]) > 5.0);
    let view = nets[1].view();
    let hears_late =
        |(node, neuron): (usize, &ne_net::NeuronView)| neuron.sources.iter().any(|&(source, _)| source >= node);
    assert!((view.inputs..).zip(&view.neurons).filter(|&pair| hears_late(pair)).count() > 5);
    Ok(())
}

#[test]
fn metadata_say_what_inputs_and_outputs_are() -> Outcome {
    let champion = champion(
        "biped-2",
        "flat",
        Actuation::Angle { gain: 12.5 },
        vec![Sensor::JointAngles, Sensor::FootContacts],
        dense,
    )?;
    let metadata = Model::read(&file(&champion, Format::Onnx)?).metadata;
    for (key, expected) in [
        ("creature", "biped-2"),
        ("movement", "playing"),
        ("actuation", "angle"),
        ("gain", "12.5"),
        ("input_range", "3"),
        ("time_step", &champion.physics.time_step.to_string()),
    ] {
        assert_eq!(metadata.get(key).map(String::as_str), Some(expected), "{key}");
    }
    let inputs: serde_json::Value = serde_json::from_str(&metadata["inputs"])?;
    let outputs: serde_json::Value = serde_json::from_str(&metadata["outputs"])?;
    for (channels, described) in [(&champion.inputs, &inputs), (&champion.outputs, &outputs)] {
        assert_eq!(described.as_array().map(Vec::len), Some(channels.len()));
        for (index, channel) in channels.iter().enumerate() {
            assert_eq!(
                (&described[index]["name"], &described[index]["unit"]),
                (&(*channel.name).into(), &(*channel.unit).into())
            );
            let bound = |end: usize| described[index]["range"][end].as_f64().map(|bound| bound as f32);
            assert_eq!([bound(0), bound(1)], channel.range.map(Some));
        }
    }
    // With the formula of the description, what every motor is asked for.
    let judge = Judge::new(champion.episode_parts(), &Registry::default())?;
    let motors = judge.environment().motors();
    assert_eq!(outputs.as_array().map(Vec::len), Some(motors.len()));
    for (index, drive) in motors.drives().iter().enumerate() {
        let number = |value: &serde_json::Value| value.as_f64().map(|number| number as f32).ok_or("no number");
        let output = &outputs[index];
        let [low, high] = [number(&output["limits"][0])?, number(&output["limits"][1])?];
        for (asked, angle) in [(-2.0_f32, 0.1), (-0.6, -0.2), (0.3, 0.4), (1.0, 0.0)] {
            let target = (asked.clamp(-1.0, 1.0) * low.abs().max(high.abs())).clamp(low, high);
            let top_speed = number(&output["top_speed"])?;
            let speed = (12.5 * (target - angle)).clamp(-top_speed, top_speed);
            assert!((drive.speed(motors.actuation(), asked, || angle) - speed).abs() < 1e-5);
        }
    }
    let height: f32 = metadata["rest_height"].parse()?;
    assert!((0.2..2.0).contains(&height), "{height} m");
    let angle = &inputs[0];
    assert_eq!([&angle["source"], &angle["index"]].map(serde_json::Value::as_u64), [Some(2), Some(0)]);
    let contact = inputs.as_array().and_then(|inputs| inputs.last()).ok_or("no inputs")?;
    assert_eq!(contact["source"].as_u64(), Some(7));
    assert_eq!((contact["middle"].as_f64(), contact["factor"].as_f64()), (Some(0.5), Some(6.0)));
    Ok(())
}

/// With the program that most others compute such models with, where python has it.
#[test]
fn onnxruntime_gives_what_the_net_gives() -> Outcome {
    let has = Command::new("python3").args(["-c", "import numpy, onnx, onnxruntime"]).output();
    if !has.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: python3 has no onnxruntime");
        return Ok(());
    }
    let folder = tempfile::tempdir()?;
    let (model, trace) = (folder.path().join("net.onnx"), folder.path().join("net.trace.csv"));
    for (name, champion) in champions()? {
        fs::write(&model, file(&champion, Format::Onnx)?)?;
        fs::write(&trace, file(&champion, Format::Trace)?)?;
        let program = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/check_onnx.py");
        let output = Command::new("python3").arg(program).args([&model, &trace]).arg(TOLERANCE.to_string()).output()?;
        let said = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
        assert!(output.status.success(), "{name}: {said}");
        eprintln!("{name}: {}", said.trim());
    }
    Ok(())
}
