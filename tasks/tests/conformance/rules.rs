use crate::{Cases, assert_caught};
use std::sync::atomic::{AtomicU32, Ordering};
use tasks::{
    Body, MovementCatalogue, Snapshot,
    conformance::{check_rules, rules::*},
    gait::{Findings, GaitReport, Goal, Reason, Rules, Trajectory, View},
};

/// Staying where it is, with one flaw.
#[derive(Debug)]
struct Flawed {
    flaw: Flaw,
    asked: AtomicU32,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Flaw {
    None,
    NameWithSpace,
    ViewChanges,
    NoSeconds,
    SecondsWithoutEnd,
    NeedsLegs,
    NeedsCommands,
    CountsJudgements,
    ReasonWithSpace,
    ReasonWithoutSentence,
    FlightBeyondTheLast,
    LostForNoReason,
    LostEverySecondTime,
}

impl Flawed {
    fn new(flaw: Flaw) -> Self {
        Self { flaw, asked: AtomicU32::new(0) }
    }

    fn asked(&self) -> u32 {
        self.asked.fetch_add(1, Ordering::Relaxed)
    }
}

impl Rules for Flawed {
    fn name(&self) -> &str {
        if self.flaw == Flaw::NameWithSpace { "stay there" } else { "staying" }
    }

    fn seconds(&self) -> f64 {
        match self.flaw {
            Flaw::NoSeconds => 0.0,
            Flaw::SecondsWithoutEnd => f64::INFINITY,
            _ => 2.0,
        }
    }

    fn view(&self) -> View {
        let changes = self.flaw == Flaw::ViewChanges && self.asked() > 100;
        View { goal: if changes { Goal::Height } else { Goal::Distance }, ..View::default() }
    }

    fn is_lost(&self, _: &Body, now: &Snapshot) -> bool {
        match self.flaw {
            Flaw::LostForNoReason => now.torso().y > 1.2,
            Flaw::LostEverySecondTime => self.asked().is_multiple_of(2),
            _ => now.torso().x.abs() > 0.5,
        }
    }

    fn judge(&self, gait: &GaitReport, trajectory: &Trajectory<'_>) -> Findings {
        assert!(!(self.flaw == Flaw::NeedsLegs && gait.legs.is_empty()), "on purpose");
        let told = trajectory.snapshots().iter().any(|snapshot| snapshot.command.speed != 0.0);
        assert!(told || self.flaw != Flaw::NeedsCommands, "on purpose");
        // As `is_lost` does, whose numbers are those of the snapshots.
        let farthest = trajectory.snapshots().iter().map(|now| now.torso().x.abs()).fold(0.0, f32::max);
        let astray = match self.flaw {
            Flaw::CountsJudgements => Reason::other("astray", format!("asked {} times", self.asked())),
            Flaw::ReasonWithSpace => Reason::other("far off", "far off"),
            Flaw::ReasonWithoutSentence => Reason::other("astray", ""),
            _ => Reason::other("astray", format!("{farthest:.1} m away, at most 0.5 m allowed")),
        };
        let best_flight = (self.flaw == Flaw::FlightBeyondTheLast).then_some(gait.aloft.flights.len());
        Findings { best_flight, ..Findings::new((farthest > 0.5).then_some(astray)) }
    }
}

#[test]
fn broken_rules_are_caught() {
    let check = |flaw: Flaw| check_rules(&Flawed::new(flaw));
    assert_eq!(check(Flaw::None), Ok(()));
    let cases: Cases<'_> = vec![
        (LABELS, "name with a space", check(Flaw::NameWithSpace)),
        (LABELS, "the view changes", check(Flaw::ViewChanges)),
        (SECONDS, "no seconds", check(Flaw::NoSeconds)),
        (SECONDS, "seconds without end", check(Flaw::SecondsWithoutEnd)),
        (JUDGES, "needs legs", check(Flaw::NeedsLegs)),
        (JUDGES, "needs commands", check(Flaw::NeedsCommands)),
        (DETERMINISTIC, "counts judgements", check(Flaw::CountsJudgements)),
        (REASONS, "a reason with a space", check(Flaw::ReasonWithSpace)),
        (REASONS, "a reason without a sentence", check(Flaw::ReasonWithoutSentence)),
        (FLIGHT, "a flight beyond the last", check(Flaw::FlightBeyondTheLast)),
        (LOST, "lost for no reason", check(Flaw::LostForNoReason)),
        (LOST, "lost every second time", check(Flaw::LostEverySecondTime)),
    ];
    assert_caught(&cases, PROMISES);
}

#[test]
fn the_rules_of_the_catalogue_pass() {
    let catalogue = MovementCatalogue::default();
    for entry in catalogue.entries() {
        let Some(rules) = &entry.rules else { continue };
        check_rules(&**rules).unwrap_or_else(|violation| panic!("{}: {violation}", entry.name));
    }
}
