//! What rules owe.

use super::{
    stories::{Story, TIME_STEP, bodies, longer_stories_of, told},
    typed,
};
use crate::{
    Body, Snapshot,
    gait::{GaitReport, Judgement, Reason, Rules, Trajectory},
};
use ne_core::conformance::{Promise, Violation};
use std::ops::RangeInclusive;

/// Names that can be typed, and what never changes.
pub const LABELS: Promise = Promise::new(
    "set of rules",
    "a name of lower-case letters, digits and hyphens, which never changes, nor do the seconds, the view and the need of commands",
);
/// An episode that can be played.
pub const SECONDS: Promise = Promise::new("set of rules", "the episode to judge lasts from 0.1 to 600 s");
/// Whatever the gait.
pub const JUDGES: Promise = Promise::new("set of rules", "any gait of any body is judged, told what to do or not");
/// The same again.
pub const DETERMINISTIC: Promise = Promise::new("set of rules", "the same gait gives the same findings");
/// Reasons can be told.
pub const REASONS: Promise = Promise::new(
    "set of rules",
    "a reason has a name of lower-case letters, digits and hyphens, and a sentence of one line",
);
/// There is such a flight.
pub const FLIGHT: Promise = Promise::new("set of rules", "the best flight is one of the gait's");
/// Lost is lost.
pub const LOST: Promise = Promise::new(
    "set of rules",
    "where `is_lost` says so of a moment, `judge` finds a reason in the gait, and `is_lost` says the same when asked again",
);

/// All of them.
pub const PROMISES: &[Promise] = &[LABELS, SECONDS, JUDGES, DETERMINISTIC, REASONS, FLIGHT, LOST];

/// How long an episode to judge may be, s.
const ALLOWED: RangeInclusive<f64> = 0.1..=600.0;

/// Checks rules by having them judge bodies that stand, walk, jump, spin, rock and fall, with legs, without, and without any
/// limbs, told what to do or not, for as many seconds as they ask for.
///
/// # Errors
/// The first promise that is not kept; the text says in which of the episodes.
pub fn check_rules(rules: &dyn Rules) -> Result<(), Violation> {
    let labels = LABELS.check(|| labels(rules))?;
    SECONDS.check(|| match rules.seconds() {
        seconds if ALLOWED.contains(&seconds) => Ok(()),
        seconds => Err(format!("{seconds} s")),
    })?;
    let steps = (rules.seconds() / f64::from(TIME_STEP)).ceil() as usize + 1;
    for (name, body) in bodies() {
        for story in longer_stories_of(&body, name, steps) {
            judged(rules, &body, &story)?;
            judged(rules, &body, &told(story))?;
        }
    }
    LABELS.check(|| match self::labels(rules)? {
        now if now == labels => Ok(()),
        now => Err(format!("{labels:?} at first, {now:?} afterwards")),
    })
}

/// What must not change, in words.
fn labels(rules: &dyn Rules) -> Result<String, String> {
    let name = rules.name();
    typed(name)?;
    Ok(format!("{name}, {} s, {:?}, needs commands: {}", rules.seconds(), rules.view(), rules.needs_commands()))
}

/// Every promise about one gait.
fn judged(rules: &dyn Rules, body: &Body, story: &Story) -> Result<(), Violation> {
    let of_story = |found: String| format!("{}: {found}", story.name);
    let judge = || {
        let trajectory = Trajectory::new(body, &story.snapshots).map_err(|error| of_story(error.to_string()))?;
        let GaitReport { aloft, verdict, .. } = GaitReport::of(&trajectory, Some(rules));
        Ok((verdict.ok_or("not judged")?, aloft.flights.len()))
    };
    let (verdict, flights) = JUDGES.check(judge)?;
    DETERMINISTIC.check(|| match judge()? {
        (again, _) if again == verdict => Ok(()),
        (again, _) => Err(of_story(format!("{verdict:?} at first, {again:?} afterwards"))),
    })?;
    REASONS.check(|| verdict.reasons.iter().try_for_each(tellable).map_err(of_story))?;
    FLIGHT.check(|| match verdict.best_flight {
        Some(index) if index >= flights => Err(of_story(format!("flight {index} of {flights}"))),
        _ => Ok(()),
    })?;
    LOST.check(|| lost(rules, body, &story.snapshots, &verdict).map_err(of_story))
}

fn tellable(reason: &Reason) -> Result<(), String> {
    typed(reason.name())?;
    let sentence = reason.to_string();
    match sentence.trim().is_empty() || sentence.contains('\n') {
        true => Err(format!("{} is told as {sentence:?}", reason.name())),
        false => Ok(()),
    }
}

fn lost(rules: &dyn Rules, body: &Body, snapshots: &[Snapshot], verdict: &Judgement) -> Result<(), String> {
    let asked = || snapshots.iter().map(|now| rules.is_lost(body, now));
    if let Some(step) = asked().zip(asked()).position(|(first, second)| first != second) {
        return Err(format!("lost at step {step} or not, as often as asked"));
    }
    // The audit's finding is not the rules'.
    let found = verdict.reasons.iter().any(|reason| !matches!(reason, Reason::Cheat(_)));
    match asked().position(|lost| lost) {
        Some(step) if !found => Err(format!("lost at step {step}, and no reason is found")),
        _ => Ok(()),
    }
}
