//! What an environment owes.

use super::playing::{Played, Script, numbers, play, same, same_inputs};
use crate::{Environment, Snapshot};
use ne_core::{
    Seed,
    conformance::{Promise, Violation},
};
use std::{panic::resume_unwind, thread};

/// Its shape never changes.
pub const SHAPE: Promise = Promise::new(
    "environment",
    "`inputs()` and `outputs()` never change, `time_step()` only with `reset`, and a step takes time",
);
/// It begins.
pub const BEGINS: Promise = Promise::new("environment", "`reset` succeeds with the seed of the check");
/// The same again.
pub const DETERMINISTIC: Promise =
    Promise::new("environment", "the same seed and actions give the same bits, on any thread");
/// Reset is birth.
pub const RESET: Promise = Promise::new("environment", "`reset` leaves nothing of an earlier episode");
/// A clone is another.
pub const CLONES: Promise =
    Promise::new("environment", "a clone is in the same state, and what happens to it happens to no other environment");
/// Every input is written.
pub const SENSES: Promise =
    Promise::new("environment", "`sense` writes every input, the same when asked twice, and changes nothing");
/// Every number is one.
pub const FINITE: Promise =
    Promise::new("environment", "inputs and snapshots are finite, or `step` fails, whatever the actions (±1, 0, NaN)");
/// There is a body.
pub const BODY: Promise =
    Promise::new("environment", "every snapshot has the same parts, at least one, and angles whose cos² + sin² is 1");
/// Time passes.
pub const CLOCK: Promise = Promise::new("environment", "time is 0 after `reset` and grows by `time_step()` each step");
/// Work adds up.
pub const WORK: Promise = Promise::new("environment", "motor work is 0 after `reset` and never falls");

/// All of them.
pub const PROMISES: &[Promise] = &[SHAPE, BEGINS, DETERMINISTIC, RESET, CLONES, SENSES, FINITE, BODY, CLOCK, WORK];

/// Steps of each episode of a check.
const STEPS: usize = 120;

/// Checks an environment by playing a few episodes of 120 steps with clones of it.
///
/// # Errors
/// The first promise that is not kept.
pub fn check_environment<E: Environment>(environment: &E, seed: Seed) -> Result<(), Violation> {
    let fresh = || {
        let mut one = environment.clone();
        one.reset(seed).map_err(|failure| format!("reset failed: {failure}"))?;
        Ok::<_, String>(one)
    };
    BEGINS.check(|| fresh().map(drop))?;
    SHAPE.check(|| shape_stays(environment, &mut fresh()?))?;
    let plain = DETERMINISTIC.check(|| {
        let plain = play(&mut fresh()?, Script::Wander, 0, STEPS);
        same(&play(&mut fresh()?, Script::Wander, 0, STEPS), &plain, "another clone, reset and played the same")?;
        let elsewhere = || Ok::<_, String>(play(&mut fresh()?, Script::Wander, 0, STEPS));
        let elsewhere =
            thread::scope(|scope| scope.spawn(elsewhere).join().unwrap_or_else(|panic| resume_unwind(panic)));
        same(&elsewhere?, &plain, "on another thread")?;
        Ok(plain)
    })?;
    SENSES.check(|| senses(&mut fresh()?, &plain))?;
    BODY.check(|| body(&plain))?;
    for script in [Script::Wander, Script::Still, Script::Full, Script::Bang, Script::NotANumber, Script::Infinite] {
        FINITE.check(|| finite(&play(&mut fresh()?, script, 0, STEPS), script))?;
    }
    CLOCK.check(|| clock(&plain, fresh()?.time_step()))?;
    WORK.check(|| work(&plain))?;
    RESET.check(|| resets(&mut fresh()?, seed, &plain))?;
    CLONES.check(|| clones(fresh()?, &plain))
}

fn shape_stays<E: Environment>(given: &E, used: &mut E) -> Result<(), String> {
    let shape = |of: &E| (of.inputs(), of.outputs());
    let (born, time_step) = (shape(given), used.time_step());
    let stays = |of: &E, when: &str| match shape(of) {
        found if found == born => Ok(()),
        found => Err(format!("(inputs, outputs) are {found:?} {when}, {born:?} before")),
    };
    for step in [given.time_step(), time_step] {
        if !(step.is_finite() && step > 0.0) {
            return Err(format!("a time step of {step} s"));
        }
    }
    stays(used, "after a reset")?;
    play(used, Script::Wander, 0, STEPS);
    stays(used, "after steps")?;
    if used.time_step() != time_step {
        return Err(format!("time_step is {} s after steps, {time_step} s after the reset", used.time_step()));
    }
    Ok(())
}

/// Senses more often than needed, with slices that held other things before.
fn senses<E: Environment>(environment: &mut E, plain: &Played) -> Result<(), String> {
    for (step, frame) in plain.frames.iter().enumerate() {
        for poison in [f32::NAN, -12345.0, 0.0] {
            let mut inputs = vec![poison; environment.inputs()];
            environment.sense(&mut inputs);
            same_inputs(&inputs, &frame.inputs, &format!("before step {}, slice filled with {poison}", step + 1))?;
        }
        play(environment, Script::Wander, step, 1);
    }
    Ok(())
}

fn snapshots(played: &Played) -> impl Iterator<Item = &Snapshot> {
    std::iter::once(&played.start).chain(played.frames.iter().map(|frame| &frame.snapshot))
}

fn body(played: &Played) -> Result<(), String> {
    let parts = played.start.parts.len();
    for (step, snapshot) in snapshots(played).enumerate() {
        if snapshot.parts.is_empty() || snapshot.parts.len() != parts {
            return Err(format!("{} parts after step {step}, {parts} at the start", snapshot.parts.len()));
        }
        for (index, part) in snapshot.parts.iter().enumerate() {
            let length = part.cos * part.cos + part.sin * part.sin;
            // f32 engines let the length of a rotation drift a little between renormalisations.
            if (length - 1.0).abs() > 1e-3 {
                return Err(format!("part {index} has cos² + sin² = {length} after step {step}"));
            }
        }
    }
    Ok(())
}

fn finite(played: &Played, script: Script) -> Result<(), String> {
    for (step, frame) in played.frames.iter().enumerate() {
        if let Some(index) = frame.inputs.iter().position(|input| !input.is_finite()) {
            return Err(format!("{script:?}: input {index} is {} before step {}", frame.inputs[index], step + 1));
        }
    }
    for (step, snapshot) in snapshots(played).enumerate() {
        if let Some((name, value)) = numbers(snapshot).into_iter().find(|(_, value)| !value.is_finite()) {
            return Err(format!("{script:?}: {name} is {value} after step {step}"));
        }
    }
    Ok(())
}

fn clock(played: &Played, time_step: f32) -> Result<(), String> {
    if played.start.time != 0.0 {
        return Err(format!("{} s after a reset", played.start.time));
    }
    for (step, snapshot) in snapshots(played).enumerate() {
        let expected = step as f32 * time_step;
        // A sum of f32 may be off by half a unit in the last place for each step.
        if (snapshot.time - expected).abs() > 0.01 * time_step + step as f32 * expected * f32::EPSILON {
            return Err(format!("{} s after {step} steps of {time_step} s", snapshot.time));
        }
    }
    Ok(())
}

fn work(played: &Played) -> Result<(), String> {
    let mut last = 0.0;
    for (step, snapshot) in snapshots(played).enumerate() {
        let work = snapshot.motor_work;
        if work < last || (step == 0 && work != 0.0) {
            return Err(format!("{work} J after step {step}, {last} J before"));
        }
        last = work;
    }
    Ok(())
}

fn resets<E: Environment>(environment: &mut E, seed: Seed, plain: &Played) -> Result<(), String> {
    let other = Seed::of_run(seed.run_seed().wrapping_add(1));
    for (script, what) in [
        (Script::WanderElsewhere, "reset after another episode, against fresh"),
        (Script::Bang, "reset after violent actions, against fresh"),
        (Script::NotANumber, "reset after actions that were NaN, against fresh"),
    ] {
        // Another seed may have a start pose that fails; then its episode is the old one played on.
        let _ = environment.reset(other);
        play(environment, script, 0, STEPS / 2);
        environment.reset(seed).map_err(|failure| format!("{what}: reset failed: {failure}"))?;
        same(&play(environment, Script::Wander, 0, STEPS), plain, what)?;
    }
    environment.reset(seed).map_err(|failure| format!("reset failed: {failure}"))?;
    environment.reset(seed).map_err(|failure| format!("reset after a reset failed: {failure}"))?;
    same(&play(environment, Script::Wander, 0, STEPS), plain, "reset twice, against fresh")
}

fn clones<E: Environment>(mut original: E, plain: &Played) -> Result<(), String> {
    let half = plain.frames.len() / 2;
    let first = play(&mut original, Script::Wander, 0, half);
    let (mut twin, mut stranger) = (original.clone(), original.clone());
    let rest = |mut first: Played, second: Played| {
        first.frames.extend(second.frames);
        Played { failure: second.failure, ..first }
    };
    play(&mut stranger, Script::WanderElsewhere, half, STEPS - half);
    let whole = rest(first, play(&mut original, Script::Wander, half, STEPS - half));
    same(&whole, plain, "the original, after a clone went its own way, against undisturbed")?;
    let twins = play(&mut twin, Script::Wander, half, STEPS - half);
    let start = whole.frames.get(half.wrapping_sub(1)).map_or(&plain.start, |frame| &frame.snapshot).clone();
    let expected = Played { start, frames: whole.frames.into_iter().skip(half).collect(), failure: whole.failure };
    same(&twins, &expected, &format!("a clone made after step {half}, against its original"))
}
