//! Playing an environment by a script of actions, and comparing what came of it.

use crate::{Environment, Snapshot};
use ne_core::Failure;

/// What the body is told to do.
#[derive(Clone, Copy, Debug)]
pub(super) enum Script {
    /// Every output a sine of its own.
    Wander,
    /// Other sines.
    WanderElsewhere,
    /// Nothing.
    Still,
    /// Everything at once.
    Full,
    /// From one end to the other in each step.
    Bang,
    /// NaN from the fourth step on.
    NotANumber,
    /// Infinities from the fourth step on.
    Infinite,
}

impl Script {
    fn action(self, step: usize, index: usize) -> f32 {
        let sign = if (step + index).is_multiple_of(2) { 1.0 } else { -1.0 };
        let (time, place) = (step as f32, index as f32);
        match self {
            Self::Wander => libm::sinf(0.2 * time + 1.3 * place),
            Self::WanderElsewhere => libm::sinf(0.31 * time + 2.1 * place + 0.7),
            Self::Still => 0.0,
            Self::Full => 1.0,
            Self::Bang => sign,
            Self::NotANumber if step >= 3 => f32::NAN,
            Self::Infinite if step >= 3 => f32::INFINITY * sign,
            Self::NotANumber | Self::Infinite => sign,
        }
    }
}

/// A step: what was sensed before it, and how things were after it.
pub(super) struct Frame {
    pub(super) inputs: Vec<f32>,
    pub(super) snapshot: Snapshot,
}

/// What came of an episode.
pub(super) struct Played {
    /// How things were before the first step.
    pub(super) start: Snapshot,
    /// The steps that succeeded.
    pub(super) frames: Vec<Frame>,
    /// The failure that ended it.
    pub(super) failure: Option<Failure>,
}

/// Plays on, as an [`Episode`](crate::Episode) does. Steps of the script are counted from `first`.
pub(super) fn play<E: Environment>(environment: &mut E, script: Script, first: usize, steps: usize) -> Played {
    let mut outputs = vec![0.0; environment.outputs()];
    let mut played = Played { start: environment.snapshot().clone(), frames: Vec::new(), failure: None };
    for step in first..first + steps {
        let mut inputs = vec![0.0; environment.inputs()];
        environment.sense(&mut inputs);
        outputs.iter_mut().enumerate().for_each(|(index, output)| *output = script.action(step, index));
        environment.act(&outputs);
        if let Err(failure) = environment.step() {
            played.failure = Some(failure);
            break;
        }
        played.frames.push(Frame { inputs, snapshot: environment.snapshot().clone() });
    }
    played
}

/// All numbers of a snapshot, with names; the time since a press that never came is -1.
pub(super) fn numbers(snapshot: &Snapshot) -> Vec<(String, f64)> {
    let command = &snapshot.command;
    let never_pressed = command.since_press == f32::INFINITY;
    let mut numbers = vec![
        ("time".to_owned(), f64::from(snapshot.time)),
        ("motor_work".into(), snapshot.motor_work),
        ("push_work".into(), snapshot.push_work),
        ("command.speed".into(), f64::from(command.speed)),
        ("command.jump".into(), f64::from(u8::from(command.jump))),
        ("command.stride_began".into(), f64::from(command.stride_began)),
        ("command.since_press".into(), if never_pressed { -1.0 } else { f64::from(command.since_press) }),
    ];
    for (index, part) in snapshot.parts.iter().enumerate() {
        let fields = [
            ("x", part.x),
            ("y", part.y),
            ("cos", part.cos),
            ("sin", part.sin),
            ("vx", part.vx),
            ("vy", part.vy),
            ("spin", part.spin),
            ("touching", f32::from(u8::from(part.touching))),
        ];
        numbers.extend(fields.map(|(field, value)| (format!("parts[{index}].{field}"), f64::from(value))));
    }
    numbers
}

/// An error that says where two episodes first differ in a bit, if they do.
pub(super) fn same(found: &Played, expected: &Played, what: &str) -> Result<(), String> {
    same_snapshot(&found.start, &expected.start, &format!("{what}, at the start"))?;
    for (step, (found, expected)) in (1..).zip(found.frames.iter().zip(&expected.frames)) {
        let place = format!("{what}, step {step}");
        same_inputs(&found.inputs, &expected.inputs, &place)?;
        same_snapshot(&found.snapshot, &expected.snapshot, &place)?;
    }
    let end = |played: &Played| match &played.failure {
        Some(failure) => format!("failure \"{failure}\" after {} steps", played.frames.len()),
        None => format!("{} steps", played.frames.len()),
    };
    if end(found) == end(expected) { Ok(()) } else { Err(format!("{what}: {} against {}", end(found), end(expected))) }
}

/// An error that says which of two lists of inputs differ, if they do.
pub(super) fn same_inputs(found: &[f32], expected: &[f32], what: &str) -> Result<(), String> {
    let differs = |(a, b): (&f32, &f32)| a.to_bits() != b.to_bits();
    match found.iter().zip(expected).position(differs) {
        Some(index) => Err(format!("{what}, input {index}: {:?} against {:?}", found[index], expected[index])),
        None => Ok(()),
    }
}

fn same_snapshot(found: &Snapshot, expected: &Snapshot, what: &str) -> Result<(), String> {
    if found.parts.len() != expected.parts.len() {
        return Err(format!("{what}: {} parts against {}", found.parts.len(), expected.parts.len()));
    }
    for ((name, found), (_, expected)) in numbers(found).into_iter().zip(numbers(expected)) {
        if found.to_bits() != expected.to_bits() {
            return Err(format!("{what}, {name}: {found:?} against {expected:?}"));
        }
    }
    Ok(())
}
