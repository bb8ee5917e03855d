//! The check of senses passes what is right, and names the promise that a deliberately broken one breaks.

use creatures::{Blueprint, BodyView, Channel, Sense};
use envs_core::conformance::{self, *};
use ne_core::conformance::Promise;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How far each joint is bent, with one flaw.
struct Bend {
    flaw: Flaw,
    asked: AtomicUsize,
}

#[derive(Clone, Copy, PartialEq)]
enum Flaw {
    None,
    NoChannels,
    RangeOfOneNumber,
    RangeWithoutEnd,
    OneNameForAll,
    NoName,
    UnitOfTwoLines,
    CountsBodies,
    AsksBeyondTheLast,
    TellsInfinity,
    CountsReadings,
    Panics,
}

impl Sense for Bend {
    fn channels(&self, blueprint: &Blueprint) -> Vec<Channel> {
        let asked = self.asked.fetch_add(1, Ordering::Relaxed);
        let channel = |&hinge: &usize| Channel {
            name: match self.flaw {
                Flaw::OneNameForAll => "bend".into(),
                Flaw::NoName => " ".into(),
                Flaw::CountsBodies => format!("bend {hinge} of body {asked}"),
                _ => format!("bend {hinge}"),
            },
            unit: if self.flaw == Flaw::UnitOfTwoLines { "rad\n" } else { "rad" },
            range: match self.flaw {
                Flaw::RangeOfOneNumber => [1.0, 1.0],
                Flaw::RangeWithoutEnd => [0.0, f32::INFINITY],
                _ => [0.0, 1.0],
            },
        };
        let none = self.flaw == Flaw::NoChannels;
        blueprint.actuated().iter().filter(|_| !none).map(channel).collect()
    }

    fn read(&self, body: &dyn BodyView, channel: usize) -> f32 {
        let angle = |hinge| body.joint_angle(hinge).abs();
        match self.flaw {
            Flaw::AsksBeyondTheLast => angle(channel + 1),
            Flaw::TellsInfinity => angle(channel) + body.time_since_press(),
            Flaw::CountsReadings => angle(channel) + self.asked.fetch_add(1, Ordering::Relaxed) as f32,
            Flaw::Panics => panic!("on purpose"),
            _ => angle(channel),
        }
    }
}

#[test]
fn broken_senses_are_caught() {
    let check = |flaw| conformance::check_sense(&Bend { flaw, asked: AtomicUsize::new(0) });
    assert_eq!(check(Flaw::None), Ok(()));
    let cases: [(Promise, &str, Flaw, &str); 11] = [
        (CHANNELS, "no channels", Flaw::NoChannels, "no channels"),
        (CHANNELS, "a range of one number", Flaw::RangeOfOneNumber, "has the range [1.0, 1.0]"),
        (CHANNELS, "a range without end", Flaw::RangeWithoutEnd, "has the range [0.0, inf]"),
        (NAMES, "one name for all", Flaw::OneNameForAll, "\"bend\" twice"),
        (NAMES, "no name", Flaw::NoName, "the name \" \""),
        (NAMES, "a unit of two lines", Flaw::UnitOfTwoLines, "the unit \"rad\\n\""),
        (SETTLED, "counts bodies", Flaw::CountsBodies, "at first"),
        (READS, "asks beyond the last joint", Flaw::AsksBeyondTheLast, "it asks for hinge"),
        (READS, "panics", Flaw::Panics, "on purpose"),
        (FINITE, "tells infinity", Flaw::TellsInfinity, "\"bend 0\" at moment 0 is inf"),
        (REMEMBERS_NOTHING, "counts readings", Flaw::CountsReadings, "another number later"),
    ];
    for (promise, name, flaw, says) in cases {
        let violation = check(flaw).expect_err(name);
        assert_eq!(violation.promise, promise, "{name}: {violation}");
        assert!(violation.found.contains(says), "{name}: {violation}");
    }
    for promise in PROMISES {
        assert!(cases.iter().any(|(broken, ..)| broken == promise), "no case breaks {promise:?}");
    }
}
