//! What a movement owes.

use super::{
    stories::{Story, bodies, stories, stories_of},
    typed,
};
use crate::{Body, Movement, Verdict};
use ne_core::conformance::{Promise, Violation};
use std::collections::BTreeSet;

/// It can be shown anything.
pub const WATCHES: Promise = Promise::new("movement", "it observes any episode, of a body it has met or not");
/// A name that can be typed, and a unit.
pub const LABELS: Promise = Promise::new(
    "movement",
    "a name of lower-case letters, digits and hyphens and a unit without spaces, neither of which ever changes",
);
/// Its value is one.
pub const FINITE: Promise = Promise::new("movement", "the value is finite at any time after `begin`");
/// The same again.
pub const DETERMINISTIC: Promise =
    Promise::new("movement", "the same snapshots give the same values and verdicts to the bit");
/// Asking changes nothing.
pub const PURE: Promise = Promise::new("movement", "asking for the value or the measurements changes nothing");
/// A new life.
pub const FORGETS: Promise = Promise::new("movement", "`begin` forgets every earlier episode");
/// A clone is another.
pub const CLONES: Promise =
    Promise::new("movement", "a clone is in the same state, and what it observes changes no other movement");
/// Every measurement has a name of its own.
pub const MEASURES: Promise =
    Promise::new("movement", "measurements are finite and have the same names, once each, in every episode");

/// Any body will do.
pub const BINDS: Promise = Promise::new(
    "movement",
    "`bind` takes any body, changes neither name nor unit, and forgets every body it was bound to before",
);

/// All of them.
pub const PROMISES: &[Promise] = &[WATCHES, LABELS, FINITE, DETERMINISTIC, PURE, FORGETS, CLONES, MEASURES, BINDS];

/// Checks a movement by showing it bodies that stand, walk, jump, spin, rock and fall: first without telling it whose
/// movement it watches, then having had it meet bodies with legs, without, and without any limbs.
///
/// # Errors
/// The first promise that is not kept; the text says in which of the episodes.
pub fn check_movement(movement: &dyn Movement) -> Result<(), Violation> {
    check_watching(movement, &stories())?;
    for (name, body) in bodies() {
        let stories = stories_of(&body, name);
        let met = BINDS.check(|| binds(movement, &body, &stories))?;
        check_watching(&*met, &stories)?;
    }
    Ok(())
}

/// Every promise but [`BINDS`].
fn check_watching(movement: &dyn Movement, stories: &[Story]) -> Result<(), Violation> {
    WATCHES.check(|| {
        for story in stories {
            watch(&mut *movement.boxed_clone(), story, Asked::EachStep);
        }
        Ok(())
    })?;
    LABELS.check(|| labels(movement, stories))?;
    let alone = DETERMINISTIC.check(|| {
        let watch =
            || stories.iter().map(|story| watch(&mut *movement.boxed_clone(), story, Asked::EachStep)).collect();
        let (first, second): (Vec<Seen>, Vec<Seen>) = (watch(), watch());
        each(&second, &first, stories, "watched by another clone")?;
        Ok(first)
    })?;
    FINITE.check(|| {
        for (seen, story) in alone.iter().zip(stories) {
            if let Some(step) = seen.values.iter().position(|value| !value.is_finite()) {
                return Err(format!("{} after step {step} of {}", seen.values[step], story.name));
            }
        }
        Ok(())
    })?;
    PURE.check(|| pure(movement, stories, &alone))?;
    FORGETS.check(|| {
        let mut used = movement.boxed_clone();
        for old in stories {
            for (story, expected) in stories.iter().zip(&alone) {
                watch(&mut *used, old, Asked::EachStep);
                let what = format!("{} after {}, against alone", story.name, old.name);
                watch(&mut *used, story, Asked::EachStep).same(expected, &what)?;
            }
        }
        Ok(())
    })?;
    CLONES.check(|| clones(movement, stories, &alone))?;
    MEASURES.check(|| measures(movement, stories))
}

/// A clone that has met the body.
fn binds(movement: &dyn Movement, body: &Body, stories: &[Story]) -> Result<Box<dyn Movement>, String> {
    let labels = |of: &dyn Movement| (of.name().to_owned(), of.unit().to_owned());
    let mut met = movement.boxed_clone();
    met.bind(body);
    if labels(&*met) != labels(movement) {
        return Err(format!("{:?} at first, {:?} afterwards", labels(movement), labels(&*met)));
    }
    for (earlier, other) in bodies().iter().map(|(name, other)| (*name, other)).chain([("the same", body)]) {
        let mut again = movement.boxed_clone();
        again.bind(other);
        again.bind(body);
        for story in stories {
            let once = watch(&mut *met.boxed_clone(), story, Asked::EachStep);
            let what = format!("{}, and before it {earlier}", story.name);
            watch(&mut *again.boxed_clone(), story, Asked::EachStep).same(&once, &what)?;
        }
    }
    Ok(met)
}

/// When the value is asked for.
#[derive(Clone, Copy, PartialEq)]
enum Asked {
    EachStep,
    AtTheEnd,
}

/// What a movement said of a story.
struct Seen {
    /// After each step, or only the last.
    values: Vec<f64>,
    /// Steps until it ended the episode.
    steps: usize,
}

impl Seen {
    fn same(&self, expected: &Self, what: &str) -> Result<(), String> {
        if self.steps != expected.steps {
            return Err(format!("{what}: ends after {} steps against {}", self.steps, expected.steps));
        }
        match (0..self.values.len()).find(|&step| self.values[step].to_bits() != expected.values[step].to_bits()) {
            Some(step) => {
                Err(format!("{what}: {:?} against {:?} after step {step}", self.values[step], expected.values[step]))
            }
            None => Ok(()),
        }
    }
}

/// Shows a movement a story until it has seen enough, as an episode does.
fn watch(movement: &mut dyn Movement, story: &Story, asked: Asked) -> Seen {
    movement.begin(&story.snapshots[0]);
    let mut values = Vec::new();
    let mut steps = 0;
    if asked == Asked::EachStep {
        values.push(movement.value());
    }
    for snapshot in &story.snapshots[1..] {
        steps += 1;
        let verdict = movement.observe(snapshot);
        if asked == Asked::EachStep {
            values.push(movement.value());
        }
        if verdict != Verdict::GoOn {
            break;
        }
    }
    if asked == Asked::AtTheEnd {
        values.push(movement.value());
    }
    Seen { values, steps }
}

fn each(found: &[Seen], expected: &[Seen], stories: &[Story], what: &str) -> Result<(), String> {
    let mut all = found.iter().zip(expected).zip(stories);
    all.try_for_each(|((found, expected), story)| found.same(expected, &format!("{}, {what}", story.name)))
}

fn labels(movement: &dyn Movement, stories: &[Story]) -> Result<(), String> {
    let labels = |of: &dyn Movement| (of.name().to_owned(), of.unit().to_owned());
    let born = labels(movement);
    typed(&born.0)?;
    if born.1.is_empty() || born.1.chars().any(char::is_whitespace) {
        return Err(format!("the unit {:?}", born.1));
    }
    let mut used = movement.boxed_clone();
    for story in stories {
        watch(&mut *used, story, Asked::EachStep);
        if labels(&*used) != born {
            return Err(format!("{born:?} at first, {:?} after {}", labels(&*used), story.name));
        }
    }
    Ok(())
}

fn pure(movement: &dyn Movement, stories: &[Story], alone: &[Seen]) -> Result<(), String> {
    for (story, expected) in stories.iter().zip(alone) {
        let mut watching = movement.boxed_clone();
        let last = *expected.values.last().unwrap_or(&0.0);
        let expected_end = Seen { values: vec![last], steps: expected.steps };
        let unasked = watch(&mut *watching, story, Asked::AtTheEnd);
        let what = format!("{}, asked only at the end against after each step", story.name);
        unasked.same(&expected_end, &what)?;
        for times in 2..5 {
            watching.measurements(&mut |_, _| {});
            let value = watching.value();
            if value.to_bits() != last.to_bits() {
                return Err(format!("{}: {value:?} when asked {times} times, {last:?} at first", story.name));
            }
        }
    }
    Ok(())
}

fn clones(movement: &dyn Movement, stories: &[Story], alone: &[Seen]) -> Result<(), String> {
    let last = |seen: &Seen| seen.values[seen.values.len() - 1];
    for (index, (story, expected)) in stories.iter().zip(alone).enumerate() {
        let mut original = movement.boxed_clone();
        let half = expected.steps / 2;
        original.begin(&story.snapshots[0]);
        for snapshot in &story.snapshots[1..=half] {
            original.observe(snapshot);
        }
        let (mut twin, mut stranger) = (original.boxed_clone(), original.boxed_clone());
        watch(&mut *stranger, &stories[(index + 1) % stories.len()], Asked::EachStep);
        for snapshot in &story.snapshots[half + 1..=expected.steps] {
            original.observe(snapshot);
            twin.observe(snapshot);
        }
        for (one, name) in [(&original, "the original, beside its clones"), (&twin, "a clone made half-way")] {
            let (found, expected) = (one.value(), last(expected));
            if found.to_bits() != expected.to_bits() {
                return Err(format!("{}: {name}: {found:?} against {expected:?}", story.name));
            }
        }
    }
    Ok(())
}

fn measures(movement: &dyn Movement, stories: &[Story]) -> Result<(), String> {
    let mut first: Option<Vec<String>> = None;
    for story in stories {
        let mut watching = movement.boxed_clone();
        watch(&mut *watching, story, Asked::AtTheEnd);
        let mut measured = Vec::new();
        watching.measurements(&mut |name, value| measured.push((name.to_owned(), value)));
        if let Some((name, value)) = measured.iter().find(|(name, value)| name.is_empty() || !value.is_finite()) {
            return Err(format!("{}: {name:?} is {value}", story.name));
        }
        let names: Vec<String> = measured.into_iter().map(|(name, _)| name).collect();
        if names.iter().collect::<BTreeSet<_>>().len() < names.len() {
            return Err(format!("{}: a name twice: {names:?}", story.name));
        }
        match &first {
            Some(first) if *first != names => return Err(format!("{}: {names:?}, elsewhere {first:?}", story.name)),
            _ => first = Some(names),
        }
    }
    Ok(())
}
