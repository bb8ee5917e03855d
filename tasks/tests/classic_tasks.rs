//! XOR and pole balancing as tasks: fitness, what controllers see, failures, and when they are solved.

use ne_core::{
    Evaluation, Failure, Phenotype, Seed, Task,
    conformance::{Puppet, check_task},
};
use tasks::{
    Benchmark, CartPole, CartPoleSettings, DoublePole, DoublePoleSettings, Generalization, OutputRange, Xor,
    XorSettings,
    classic::{Dynamics, State},
};

const SEED: Seed = Seed::of_run(1);
const RANGES: [OutputRange; 2] = [OutputRange::ZeroToOne, OutputRange::MinusOneToOne];

/// A controller with one output from a function of the decisions since reset and the inputs.
struct Controller<F> {
    inputs: usize,
    decisions: usize,
    output: F,
}

fn controller<F: FnMut(usize, &[f32]) -> f32 + Send + 'static>(inputs: usize, output: F) -> Controller<F> {
    Controller { inputs, decisions: 0, output }
}

impl<F: FnMut(usize, &[f32]) -> f32 + Send + 'static> Phenotype for Controller<F> {
    fn inputs(&self) -> usize {
        self.inputs
    }
    fn outputs(&self) -> usize {
        1
    }
    fn reset(&mut self) {
        self.decisions = 0;
    }
    fn activate(&mut self, inputs: &[f32], outputs: &mut [f32]) {
        outputs[0] = (self.output)(self.decisions, inputs);
        self.decisions += 1;
    }
}

/// Feedback of the whole state, in the task's scaled inputs, for outputs from −1 to 1: optimal for the linearised motion
/// and a quadratic cost (x² + 0.1 ẋ² + θ² + 0.1 θ̇² + 0.1 F² a decision).
fn one_pole_feedback(inputs: &[f32]) -> f32 {
    feedback(inputs, &[-2.84, -4.04, -37.54, -9.62])
}

/// The same for two poles.
fn two_poles_feedback(inputs: &[f32]) -> f32 {
    feedback(inputs, &[2.14, 3.47, 56.96, 15.05, -41.29, -3.45])
}

fn feedback(inputs: &[f32], gains: &[f32]) -> f32 {
    let scales = [4.8, 2.0].into_iter().chain([0.52, 2.0].into_iter().cycle());
    let force: f32 = inputs.iter().zip(gains).zip(scales).map(|((input, gain), scale)| -gain * input * scale).sum();
    (force / 10.0).clamp(-1.0, 1.0)
}

/// Balances two poles without seeing velocities: it takes differences of what it sees.
fn with_memory() -> impl Phenotype {
    let mut before = [0.0; 3];
    controller(3, move |decision, seen| {
        if decision == 0 {
            before.copy_from_slice(seen);
        }
        // Differences over 0.02 s, in the scales of velocities.
        let velocities: [f32; 3] =
            std::array::from_fn(|index| (seen[index] - before[index]) / 0.02 * [4.8, 0.52, 0.52][index] / 2.0);
        before.copy_from_slice(seen);
        two_poles_feedback(&[seen[0], velocities[0], seen[1], velocities[1], seen[2], velocities[2]])
    })
}

fn cart_pole(output_range: OutputRange) -> CartPole {
    CartPole::new(CartPoleSettings { output_range, ..CartPoleSettings::default() }).expect("settings in range")
}

fn double_pole(settings: DoublePoleSettings) -> DoublePole {
    DoublePole::new(DoublePoleSettings { output_range: OutputRange::MinusOneToOne, ..settings })
        .expect("settings in range")
}

fn fitness(evaluation: &Evaluation) -> f64 {
    evaluation.fitness().expect("the evaluation succeeds").get()
}

#[test]
fn the_tasks_pass_the_check_of_tasks() -> Result<(), Box<dyn std::error::Error>> {
    let mut tasks: Vec<Box<dyn Task>> = Vec::new();
    for output_range in RANGES {
        for bias_input in [false, true] {
            tasks.push(Box::new(Xor::new(XorSettings { bias_input, output_range })));
            tasks.push(Box::new(CartPole::new(CartPoleSettings { bias_input, output_range, start_angle: 1.0 })?));
            for preset in [DoublePoleSettings::with_velocities(), DoublePoleSettings::without_velocities()] {
                tasks.push(Box::new(DoublePole::new(DoublePoleSettings { bias_input, output_range, ..preset })?));
            }
        }
    }
    for task in tasks {
        check_task(&*task, &Puppet::sample(task.inputs(), 1, 6), SEED)?;
    }
    Ok(())
}

#[test]
fn xor_squares_what_the_errors_leave_of_four() {
    // The answers to 00, 01, 10, 11; fitness; how many are right.
    let table = [
        ([0.0, 1.0, 1.0, 0.0], 16.0, 4.0),
        ([1.0, 0.0, 0.0, 1.0], 0.0, 0.0),
        ([0.5, 0.5, 0.5, 0.5], 4.0, 0.0),
        ([0.25, 0.75, 0.75, 0.25], 9.0, 4.0),
        ([0.0, 1.0, 0.5, 0.0], 12.25, 3.0),
        // Outputs beyond the range are no better and no worse than its end.
        ([-9.0, 9.0, 9.0, -9.0], 16.0, 4.0),
        ([9.0, -9.0, -9.0, 9.0], 0.0, 0.0),
    ];
    for output_range in RANGES {
        let xor = Xor::new(XorSettings { output_range, ..XorSettings::default() });
        for (answers, expected, right) in table {
            let mut net = controller(2, move |_, bits| {
                let answer: f32 = answers[bits[0] as usize * 2 + bits[1] as usize];
                if output_range == OutputRange::ZeroToOne { answer } else { 2.0 * answer - 1.0 }
            });
            let evaluation = xor.evaluate(&mut net, SEED);
            assert_eq!((fitness(&evaluation), evaluation.steps), (expected, 4), "{answers:?}");
            assert_eq!(evaluation.measurements["right"], right, "{answers:?}");
            assert_eq!(evaluation.measurements["error"], 4.0 - expected.sqrt(), "{answers:?}");
            assert_eq!(xor.is_candidate(&evaluation), right == 4.0, "{answers:?}");
            assert_eq!(xor.is_solved(&mut net, &evaluation), right == 4.0, "{answers:?}");
        }
    }
}

#[test]
fn xor_resets_before_each_pattern_and_gives_the_bias_input() {
    let xor = Xor::new(XorSettings { bias_input: true, ..XorSettings::default() });
    let mut net = controller(3, |decision, inputs| {
        assert_eq!((decision, inputs[2]), (0, 1.0));
        inputs[0] + inputs[1] - 2.0 * inputs[0] * inputs[1]
    });
    assert_eq!(fitness(&xor.evaluate(&mut net, SEED)), 16.0);
}

/// The decisions held under a constant output from −1 to 1, as an independent program in another language counts them
/// with the equations of Lagrange.
#[test]
fn constant_forces_let_the_poles_fall() {
    let table = [
        // Start angle, output, one pole, two poles.
        (1.0, 0.0, 40_u32, 28_u32),
        (1.0, 1.0, 8, 4),
        (1.0, -1.0, 7, 4),
        (1.0, 0.5, 12, 6),
        (4.0, 0.0, 22, 22),
        (4.0, 1.0, 9, 4),
        (4.0, -1.0, 6, 4),
        (4.0, 0.5, 14, 6),
    ];
    for output_range in RANGES {
        for (start_angle, force, one, two) in table {
            let output = if output_range == OutputRange::ZeroToOne { 0.5 * force + 0.5 } else { force };
            let single = CartPoleSettings { start_angle, output_range, ..CartPoleSettings::default() };
            let double = DoublePoleSettings { start_angle, output_range, ..DoublePoleSettings::with_velocities() };
            let single = CartPole::new(single).expect("settings in range");
            let double = DoublePole::new(double).expect("settings in range");
            let found = single.evaluate(&mut controller(4, move |_, _| output), SEED);
            assert_eq!((fitness(&found), found.steps), (f64::from(one), u64::from(one) + 1), "{start_angle}°, {force}");
            assert!(!single.is_candidate(&found));
            let found = double.evaluate(&mut controller(6, move |_, _| output), SEED);
            assert_eq!((fitness(&found), found.steps), (f64::from(two), u64::from(two) + 1), "{start_angle}°, {force}");
            assert_eq!(found.measurements["held"], f64::from(two));
            assert!(!double.is_candidate(&found));
        }
    }
}

#[test]
fn controllers_see_the_scaled_state() {
    for (velocities, bias_input) in [(true, false), (true, true), (false, false), (false, true)] {
        let settings = DoublePoleSettings { velocities, bias_input, ..DoublePoleSettings::with_velocities() };
        let task = double_pole(settings);
        let mut state = State::leaning(4.0);
        let mut watcher = controller(task.inputs(), move |_, seen| {
            let [first, second] = state.angles;
            let [first_spin, second_spin] = state.angular_velocities;
            let mut expected = if velocities {
                vec![
                    state.position / 4.8,
                    state.velocity / 2.0,
                    first / 0.52,
                    first_spin / 2.0,
                    second / 0.52,
                    second_spin / 2.0,
                ]
            } else {
                vec![state.position / 4.8, first / 0.52, second / 0.52]
            };
            expected.extend(bias_input.then_some(0.5));
            assert_eq!(seen, expected.iter().map(|&value| value as f32).collect::<Vec<_>>());
            state = Dynamics::TWO_POLES.decision(&state, 2.5);
            0.25
        });
        assert!(fitness(&task.evaluate(&mut watcher, SEED)) > 5.0);
    }
}

#[test]
fn state_feedback_holds_one_pole_for_ever() {
    for output_range in RANGES {
        let task = cart_pole(output_range);
        let mut net = controller(4, move |_, inputs| {
            let output = one_pole_feedback(inputs);
            if output_range == OutputRange::ZeroToOne { 0.5 * output + 0.5 } else { output }
        });
        let evaluation = task.evaluate(&mut net, SEED);
        assert_eq!((fitness(&evaluation), evaluation.steps), (100_000.0, 100_000));
        assert!(task.is_candidate(&evaluation) && task.is_solved(&mut net, &evaluation));
    }
}

#[test]
fn state_feedback_holds_two_poles_for_ever_and_from_many_starts() -> Result<(), Failure> {
    let task = double_pole(DoublePoleSettings::with_velocities());
    let mut net = controller(6, |_, inputs| two_poles_feedback(inputs));
    let evaluation = task.evaluate(&mut net, SEED);
    assert_eq!((fitness(&evaluation), evaluation.steps), (100_000.0, 100_000));
    assert!(task.is_solved(&mut net, &evaluation));
    // Golden, and as many as an independent program counts with the equations of Lagrange.
    let general = task.generalization(&mut net)?;
    assert_eq!(general, Generalization { held: 545, steps: 546_488 });
    assert!(general.is_general());
    Ok(())
}

#[test]
fn a_memory_holds_two_poles_without_velocities() -> Result<(), Failure> {
    let task = double_pole(DoublePoleSettings::without_velocities());
    let mut net = with_memory();
    let evaluation = task.evaluate(&mut net, SEED);
    assert_eq!(evaluation.steps, 1_000);
    assert!(task.is_candidate(&evaluation) && task.is_solved(&mut net, &evaluation));
    assert_eq!(task.generalization(&mut net)?, Generalization { held: 545, steps: 546_490 });
    Ok(())
}

#[test]
fn a_candidate_that_tires_is_no_solution() {
    let task = double_pole(DoublePoleSettings { velocities: true, ..DoublePoleSettings::without_velocities() });
    for (limit, candidate, solved) in [(900, false, false), (99_000, true, false), (100_000, true, true)] {
        let mut net =
            controller(6, move |decision, inputs| if decision < limit { two_poles_feedback(inputs) } else { 1.0 });
        let evaluation = task.evaluate(&mut net, SEED);
        let found = (task.is_candidate(&evaluation), task.is_solved(&mut net, &evaluation));
        assert_eq!(found, (candidate, solved), "tires after {limit}");
    }
}

#[test]
fn a_passive_controller_holds_only_the_starts_at_rest_upright() -> Result<(), Failure> {
    for preset in [DoublePoleSettings::with_velocities(), DoublePoleSettings::without_velocities()] {
        let task = double_pole(preset);
        let general = task.generalization(&mut controller(task.inputs(), |_, _| 0.0))?;
        // One for each place of the cart.
        assert_eq!(general.held, 5);
        assert!(!general.is_general());
    }
    Ok(())
}

/// An evaluation of two poles without velocities, and for each decision held, by hand, the terms of Σ.
fn evaluated_by_hand(task: &DoublePole, mut net: impl Phenotype) -> (Evaluation, Vec<f64>) {
    let evaluation = task.evaluate(&mut net, SEED);
    let (mut state, mut output, mut restlessness) = (State::<2>::leaning(4.0), [0.0], Vec::new());
    net.reset();
    while restlessness.len() < 1000 {
        let seen = [state.position / 4.8, state.angles[0] / 0.52, state.angles[1] / 0.52].map(|value| value as f32);
        net.activate(&seen, &mut output);
        state = Dynamics::TWO_POLES.decision(&state, 10.0 * f64::from(output[0]));
        if state.position.abs() > 2.4 || state.angles.iter().any(|angle| angle.to_degrees().abs() > 36.0) {
            break;
        }
        let displacement = state.position.abs() + state.angles[0].abs();
        restlessness.push(displacement + state.velocity.abs() + state.angular_velocities[0].abs());
    }
    (evaluation, restlessness)
}

#[test]
fn damping_rewards_calm() {
    let task = double_pole(DoublePoleSettings::without_velocities());
    for limit in [0, 80, 95, 150, 700, 5_000] {
        let mut net = with_memory();
        let tiring = controller(3, move |decision, seen| {
            if decision == 0 {
                net.reset();
            }
            let mut output = [0.0];
            net.activate(seen, &mut output);
            if decision < limit { output[0] } else { 0.5 }
        });
        let (found, restlessness) = evaluated_by_hand(&task, tiring);
        let held = restlessness.len();
        assert_eq!(found.measurements["held"], held as f64);
        let calm = match held.checked_sub(100) {
            None => 0.0,
            Some(first) => 0.75 / restlessness[first..].iter().sum::<f64>(),
        };
        let expected = 0.1 * held as f64 / 1000.0 + 0.9 * calm;
        assert!((fitness(&found) - expected).abs() < 1e-9 * expected, "{} against {expected}", fitness(&found));
        assert_eq!(calm > 0.0, held >= 100);
    }
}

#[test]
fn the_cart_must_stay_on_its_track() {
    // Feedback that is told of a place 0.96 m to the left runs to the right with its pole upright, until the track ends.
    let task = cart_pole(OutputRange::MinusOneToOne);
    let mut net = controller(4, |_, seen| {
        assert!(seen[0].abs() <= 0.5, "{} m", 4.8 * seen[0]);
        one_pole_feedback(&[-0.2, seen[1], seen[2], seen[3]])
    });
    let evaluation = task.evaluate(&mut net, SEED);
    assert!(fitness(&evaluation) > 100.0 && fitness(&evaluation) < 1000.0, "{evaluation:?}");
}

#[test]
fn outputs_that_are_no_numbers_fail() {
    let wrong = Failure::NonFinite { what: "output 0".into() };
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let xor = Xor::new(XorSettings::default());
        let mut net = controller(2, move |_, bits| if bits == [1.0, 0.0] { bad } else { 0.0 });
        let evaluation = xor.evaluate(&mut net, SEED);
        assert_eq!(evaluation, Evaluation::failed(wrong.clone()).with_steps(2));
        assert!(!xor.is_candidate(&evaluation) && !xor.is_solved(&mut net, &evaluation));

        let single = cart_pole(OutputRange::MinusOneToOne);
        let mut net = controller(4, move |decision, _| if decision == 5 { bad } else { 0.0 });
        let evaluation = single.evaluate(&mut net, SEED);
        assert_eq!(evaluation, Evaluation::failed(wrong.clone()).with_steps(5));
        assert!(!single.is_candidate(&evaluation) && !single.is_solved(&mut net, &evaluation));

        let double = double_pole(DoublePoleSettings::without_velocities());
        let mut net = controller(3, move |decision, _| if decision == 5 { bad } else { 0.0 });
        let evaluation = double.evaluate(&mut net, SEED);
        assert_eq!(evaluation, Evaluation::failed(wrong.clone()).with_steps(5));
        assert!(!double.is_candidate(&evaluation) && !double.is_solved(&mut net, &evaluation));
        let mut net = controller(3, move |_, _| bad);
        assert_eq!(double.generalization(&mut net), Err(wrong.clone()));
    }
}

#[test]
fn controllers_of_another_shape_are_refused() {
    let task = double_pole(DoublePoleSettings::without_velocities());
    let held = task.evaluate(&mut with_memory(), SEED);
    let mut misfit = controller(4, |_, _| 0.0);
    let error = task.generalization(&mut misfit).expect_err("four inputs");
    let text = "the phenotype has 4 inputs and 1 outputs, the task needs 3 and 1";
    assert_eq!(error.to_string(), text);
    assert_eq!(task.evaluate(&mut misfit, SEED), Evaluation::failed(error));
    assert!(!task.is_solved(&mut misfit, &held));
}

#[test]
fn tasks_have_their_names() {
    let names = [
        Xor::new(XorSettings::default()).name().to_owned(),
        cart_pole(OutputRange::default()).name().to_owned(),
        double_pole(DoublePoleSettings::with_velocities()).name().to_owned(),
        double_pole(DoublePoleSettings::without_velocities()).name().to_owned(),
    ];
    assert_eq!(names, ["xor", "cart-pole", "double-pole", "double-pole-without-velocities"]);
}

#[test]
fn settings_out_of_range_are_named() {
    for (start_angle, found) in [(0.0, "0"), (-1.0, "-1"), (36.5, "36.5"), (f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let settings = DoublePoleSettings { start_angle, ..DoublePoleSettings::with_velocities() };
        let error = DoublePole::new(settings).expect_err("out of range");
        assert_eq!(error.to_string(), format!("start_angle = {found}: must be from 0.1 to 36"));
        assert_eq!(settings.validate(), Err(error));
    }
    let settings = CartPoleSettings { start_angle: 13.0, ..CartPoleSettings::default() };
    let error = CartPole::new(settings).expect_err("out of range");
    assert_eq!(error.to_string(), "start_angle = 13: must be from 0.1 to 12");
    assert_eq!(settings.validate(), Err(error));
}

#[test]
fn settings_are_files() -> Result<(), serde_json::Error> {
    let settings = DoublePoleSettings {
        start_angle: DoublePoleSettings::START_ANGLE_2002,
        ..DoublePoleSettings::without_velocities()
    };
    let text =
        r#"{"velocities":false,"fitness":"damping","start_angle":1.0,"bias_input":false,"output_range":"zero-to-one"}"#;
    assert_eq!(serde_json::to_string(&settings)?, text);
    assert_eq!(serde_json::from_str::<DoublePoleSettings>(text)?, settings);
    let missing = serde_json::from_str::<DoublePoleSettings>(r#"{"velocities":true}"#).expect_err("four are missing");
    assert!(missing.to_string().starts_with("missing field `fitness`"), "{missing}");

    let text = r#"{"start_angle":4.0,"bias_input":false,"output_range":"zero-to-one"}"#;
    assert_eq!(serde_json::to_string(&CartPoleSettings::default())?, text);
    assert_eq!(serde_json::from_str::<CartPoleSettings>("{}")?, CartPoleSettings::default());

    let xor = XorSettings { bias_input: true, output_range: OutputRange::MinusOneToOne };
    assert_eq!(serde_json::from_str::<XorSettings>(&serde_json::to_string(&xor)?)?, xor);
    let unknown = serde_json::from_str::<XorSettings>(r#"{"bias":true}"#).expect_err("no such field");
    assert!(unknown.to_string().starts_with("unknown field `bias`"), "{unknown}");
    Ok(())
}
