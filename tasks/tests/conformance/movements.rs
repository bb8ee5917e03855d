use crate::{Cases, assert_caught};
use ne_core::conformance::Violation;
use std::sync::{
    Arc,
    atomic::{AtomicU32, Ordering},
};
use tasks::{
    Body, Movement, Running, Snapshot, Sum, Verdict,
    conformance::{check_movement, movement::*},
};

/// The mean height of the torso, with one flaw.
struct Flawed {
    flaw: Flaw,
    sum: f64,
    steps: u32,
    begun: u32,
    asked: Arc<AtomicU32>,
    met: u32,
    /// Of the body it has met, m.
    body_length: f64,
}

#[derive(Clone, Copy, PartialEq)]
enum Flaw {
    None,
    NameWithSpace,
    NameCounts,
    NoUnit,
    DividesByZeroAtFirst,
    CountsAllClones,
    AskingCounts,
    ObserverNeedsAsking,
    BeginKeepsTheSum,
    VerdictRemembers,
    CloneForgets,
    ClonesShare,
    MeasuresTwice,
    MeasuresNan,
    MeasuresAtHeightsOnly,
    Panics,
    BindsBodiesWithLegsOnly,
    BindingIsCounted,
    KeepsTheLongestBody,
    BindingGivesAName,
    InfiniteOnceMet,
    KeepsTheSumOnceMet,
}

static WATCHED: AtomicU32 = AtomicU32::new(0);

impl Flawed {
    fn new(flaw: Flaw) -> Self {
        Self { flaw, sum: 0.0, steps: 0, begun: 0, asked: Arc::default(), met: 0, body_length: 0.0 }
    }

    fn is(&self, flaw: Flaw) -> bool {
        self.flaw == flaw
    }
}

impl Clone for Flawed {
    fn clone(&self) -> Self {
        let sum = if self.is(Flaw::CloneForgets) { 0.0 } else { self.sum };
        // What is asked of one clone is no other's concern, unless the flaw is that they share it.
        let asked = if self.is(Flaw::ClonesShare) { self.asked.clone() } else { Arc::default() };
        asked.store(self.asked.load(Ordering::Relaxed), Ordering::Relaxed);
        Self { sum, asked, ..*self }
    }
}

impl Movement for Flawed {
    fn name(&self) -> &str {
        match self.flaw {
            Flaw::NameWithSpace => "mean height",
            Flaw::NameCounts if self.begun > 0 => "mean-height-1",
            Flaw::BindingGivesAName if self.met > 0 => "mean-height-of-a-friend",
            _ => "mean-height",
        }
    }

    fn unit(&self) -> &str {
        if self.is(Flaw::NoUnit) { "" } else { "m" }
    }

    fn bind(&mut self, body: &Body) {
        assert!(!(self.is(Flaw::BindsBodiesWithLegsOnly) && body.legs.is_empty()), "on purpose");
        self.met += 1;
        let longest = if self.is(Flaw::KeepsTheLongestBody) { self.body_length } else { 0.0 };
        self.body_length = longest.max(f64::from(body.body_length) * body.parts.len() as f64);
    }

    fn begin(&mut self, _: &Snapshot) {
        let keeps = self.is(Flaw::BeginKeepsTheSum) || self.is(Flaw::KeepsTheSumOnceMet) && self.met > 0;
        if !keeps {
            self.sum = 0.0;
        }
        self.steps = 0;
        self.begun += 1;
        self.asked.store(0, Ordering::Relaxed);
        WATCHED.fetch_add(u32::from(self.is(Flaw::CountsAllClones)), Ordering::Relaxed);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        assert!(!(self.is(Flaw::Panics) && self.steps > 20), "on purpose");
        self.sum += f64::from(now.torso().y);
        self.steps += 1;
        if self.is(Flaw::ObserverNeedsAsking) {
            self.sum += f64::from(self.asked.swap(0, Ordering::Relaxed));
        }
        if self.is(Flaw::ClonesShare) {
            self.asked.fetch_add(1, Ordering::Relaxed);
        }
        if self.is(Flaw::VerdictRemembers) && self.begun > 3 { Verdict::End } else { Verdict::GoOn }
    }

    fn value(&self) -> f64 {
        let asked = match self.flaw {
            Flaw::AskingCounts | Flaw::ObserverNeedsAsking => self.asked.fetch_add(1, Ordering::Relaxed),
            Flaw::ClonesShare => self.asked.load(Ordering::Relaxed),
            _ => 0,
        };
        let asked = if self.is(Flaw::ObserverNeedsAsking) { 0 } else { asked };
        let watched = if self.is(Flaw::CountsAllClones) { WATCHED.load(Ordering::Relaxed) } else { 0 };
        let steps = if self.is(Flaw::DividesByZeroAtFirst) { self.steps } else { self.steps.max(1) };
        let met = match self.flaw {
            Flaw::BindingIsCounted => f64::from(self.met),
            Flaw::InfiniteOnceMet if self.met > 0 => f64::INFINITY,
            _ => self.body_length,
        };
        self.sum / f64::from(steps) + f64::from(asked) + f64::from(watched) + met
    }

    fn measurements(&self, tell: &mut dyn FnMut(&str, f64)) {
        if !self.is(Flaw::MeasuresAtHeightsOnly) || self.sum > 160.0 {
            tell(self.name(), self.value());
        }
        match self.flaw {
            Flaw::MeasuresTwice => tell(self.name(), self.value()),
            Flaw::MeasuresNan => tell("ratio", self.sum * 0.0 / 0.0),
            _ => {}
        }
    }
}

#[test]
fn broken_movements_are_caught() {
    let check = |flaw: Flaw| check_movement(&Flawed::new(flaw));
    assert_eq!(check(Flaw::None), Ok(()));
    let twice: Result<(), Violation> = check_movement(&Sum::of(Running::default()).plus(1.0, Running::default()));
    let cases: Cases<'_> = vec![
        (LABELS, "name with a space", check(Flaw::NameWithSpace)),
        (LABELS, "name counts", check(Flaw::NameCounts)),
        (LABELS, "no unit", check(Flaw::NoUnit)),
        (WATCHES, "panics", check(Flaw::Panics)),
        (FINITE, "divides by zero at first", check(Flaw::DividesByZeroAtFirst)),
        (DETERMINISTIC, "counts all clones", check(Flaw::CountsAllClones)),
        (PURE, "asking counts", check(Flaw::AskingCounts)),
        (PURE, "needs to be asked each step", check(Flaw::ObserverNeedsAsking)),
        (FORGETS, "begin keeps the sum", check(Flaw::BeginKeepsTheSum)),
        (FORGETS, "the verdict remembers", check(Flaw::VerdictRemembers)),
        (CLONES, "clone forgets", check(Flaw::CloneForgets)),
        (CLONES, "clones share", check(Flaw::ClonesShare)),
        (MEASURES, "a name twice", check(Flaw::MeasuresTwice)),
        (MEASURES, "a sum of two of the same name", twice),
        (MEASURES, "measures NaN", check(Flaw::MeasuresNan)),
        (MEASURES, "measures at heights only", check(Flaw::MeasuresAtHeightsOnly)),
        (BINDS, "binds bodies with legs only", check(Flaw::BindsBodiesWithLegsOnly)),
        (BINDS, "binding is counted", check(Flaw::BindingIsCounted)),
        (BINDS, "keeps the longest body it has met", check(Flaw::KeepsTheLongestBody)),
        (BINDS, "binding gives it a name", check(Flaw::BindingGivesAName)),
        (FINITE, "infinite once it has met a body", check(Flaw::InfiniteOnceMet)),
        (FORGETS, "begin keeps the sum once it has met a body", check(Flaw::KeepsTheSumOnceMet)),
    ];
    assert_caught(&cases, PROMISES);
}
