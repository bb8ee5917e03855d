use crate::{Cases, assert_caught, common::PointMass};
use ne_core::{Failure, Seed};
use std::{
    cell::Cell,
    sync::{
        Arc,
        atomic::{AtomicU32, Ordering},
    },
};
use tasks::{
    Environment, Snapshot,
    conformance::{check_environment, environment::*},
};

/// The toy environment, with one flaw.
struct Flawed {
    inner: PointMass,
    flaw: Flaw,
    snapshot: Snapshot,
    leftover: f32,
    steps: u32,
    shared: Arc<AtomicU32>,
}

#[derive(Clone, Copy, PartialEq)]
enum Flaw {
    None,
    ShapeGrows,
    NoTime,
    StepsGetLonger,
    CannotBegin,
    BeginsByChance,
    KnowsItsThread,
    ResetKeepsThePush,
    NeverRecoversFromNan,
    ClonesShareAWorld,
    CloneStandsStill,
    ForgetsAnInput,
    SensingCounts,
    SensesNan,
    SilentNan,
    NanAtFullPower,
    LosesParts,
    NoParts,
    Shears,
    SettlingCounts,
    ClockIsSlow,
    WorkIsGivenBack,
    Panics,
}

static BEGUN: AtomicU32 = AtomicU32::new(0);

thread_local! {
    static PLAYED_HERE: Cell<u32> = const { Cell::new(0) };
}

impl Flawed {
    fn new(flaw: Flaw) -> Self {
        let inner = PointMass::varied(1.0, 1e6);
        let snapshot = inner.snapshot().clone();
        Self { inner, flaw, snapshot, leftover: 0.0, steps: 0, shared: Arc::default() }
    }

    fn is(&self, flaw: Flaw) -> bool {
        self.flaw == flaw
    }

    /// Shows the snapshot of the toy, with what is wrong with it.
    fn show(&mut self) {
        self.snapshot = self.inner.snapshot().clone();
        let (steps, leftover) = (self.steps, self.leftover);
        let torso = &mut self.snapshot.parts[0];
        match self.flaw {
            Flaw::SilentNan | Flaw::NanAtFullPower => torso.vy = leftover,
            Flaw::ResetKeepsThePush | Flaw::NeverRecoversFromNan => torso.y = leftover,
            Flaw::Shears => torso.cos = 1.0 + 0.01 * steps as f32,
            Flaw::LosesParts if steps < 50 => self.snapshot.parts.push(Default::default()),
            Flaw::ClonesShareAWorld => torso.y = self.shared.load(Ordering::Relaxed) as f32,
            Flaw::SettlingCounts => self.snapshot.time += 1.0,
            Flaw::ClockIsSlow => self.snapshot.time *= 0.5,
            Flaw::WorkIsGivenBack if steps > 40 => self.snapshot.motor_work = 0.0,
            Flaw::NoParts => self.snapshot.parts.clear(),
            _ => {}
        }
        if self.is(Flaw::LosesParts) {
            self.snapshot.parts.iter_mut().for_each(|part| part.cos = 1.0);
        }
    }
}

impl Clone for Flawed {
    fn clone(&self) -> Self {
        let inner = if self.is(Flaw::CloneStandsStill) { Self::new(self.flaw).inner } else { self.inner.clone() };
        Self { inner, snapshot: self.snapshot.clone(), shared: self.shared.clone(), ..*self }
    }
}

impl Environment for Flawed {
    fn inputs(&self) -> usize {
        2 + usize::from(self.is(Flaw::ShapeGrows) && self.steps > 30)
    }

    fn outputs(&self) -> usize {
        1
    }

    fn time_step(&self) -> f32 {
        match self.flaw {
            Flaw::NoTime => 0.0,
            Flaw::StepsGetLonger if self.steps > 30 => 2.0 * self.inner.time_step(),
            _ => self.inner.time_step(),
        }
    }

    fn reset(&mut self, seed: Seed) -> Result<(), Failure> {
        if self.is(Flaw::CannotBegin) {
            return Err(Failure::Unstable { what: "it never comes to rest".into() });
        }
        let chance = u64::from(BEGUN.fetch_add(1, Ordering::Relaxed));
        self.inner.reset(if self.is(Flaw::BeginsByChance) { Seed::of_run(chance) } else { seed })?;
        let keeps = match self.flaw {
            Flaw::ResetKeepsThePush => self.leftover.is_finite(),
            Flaw::NeverRecoversFromNan => self.leftover.is_nan(),
            _ => false,
        };
        self.leftover = if keeps { self.leftover } else { 0.0 };
        self.steps = 0;
        self.shared.store(0, Ordering::Relaxed);
        self.show();
        Ok(())
    }

    fn sense(&self, inputs: &mut [f32]) {
        if self.is(Flaw::ForgetsAnInput) {
            inputs[0] = self.snapshot.torso().x;
            return;
        }
        self.inner.sense(inputs);
        match self.flaw {
            Flaw::SensingCounts => inputs[1] = self.shared.fetch_add(1, Ordering::Relaxed) as f32,
            Flaw::SensesNan if self.steps > 60 => inputs[1] = f32::NAN,
            Flaw::KnowsItsThread => inputs[1] = PLAYED_HERE.get() as f32,
            _ => {}
        }
    }

    fn act(&mut self, outputs: &[f32]) {
        self.inner.act(outputs);
        match self.flaw {
            Flaw::ResetKeepsThePush if outputs[0].is_finite() => self.leftover = outputs[0],
            Flaw::NeverRecoversFromNan if outputs[0].is_nan() => self.leftover = f32::NAN,
            Flaw::SilentNan => {
                self.leftover = outputs[0];
                self.inner.act(&[outputs[0].max(-1.0)]);
            }
            Flaw::NanAtFullPower if outputs[0] == 1.0 => self.leftover = f32::NAN,
            Flaw::KnowsItsThread => PLAYED_HERE.set(1),
            _ => {}
        }
    }

    fn step(&mut self) -> Result<(), Failure> {
        assert!(!(self.is(Flaw::Panics) && self.steps == 100), "on purpose");
        self.inner.step()?;
        self.steps += 1;
        self.shared.fetch_add(u32::from(self.is(Flaw::ClonesShareAWorld)), Ordering::Relaxed);
        self.show();
        if self.is(Flaw::NeverRecoversFromNan) && self.leftover.is_nan() {
            return Err(Failure::NonFinite { what: "height".into() });
        }
        Ok(())
    }

    fn snapshot(&self) -> &Snapshot {
        &self.snapshot
    }
}

#[test]
fn broken_environments_are_caught() {
    // Plays on this thread first, so that other threads are other places.
    PLAYED_HERE.set(1);
    let check = |flaw: Flaw| check_environment(&Flawed::new(flaw), Seed::of_run(4));
    assert_eq!(check(Flaw::None), Ok(()));
    let cases: Cases<'_> = vec![
        (SHAPE, "shape grows", check(Flaw::ShapeGrows)),
        (SHAPE, "steps take no time", check(Flaw::NoTime)),
        (SHAPE, "steps get longer", check(Flaw::StepsGetLonger)),
        (SHAPE, "panics", check(Flaw::Panics)),
        (BEGINS, "cannot begin", check(Flaw::CannotBegin)),
        (DETERMINISTIC, "begins by chance", check(Flaw::BeginsByChance)),
        (DETERMINISTIC, "knows its thread", check(Flaw::KnowsItsThread)),
        (RESET, "reset keeps the push", check(Flaw::ResetKeepsThePush)),
        (RESET, "never recovers from NaN", check(Flaw::NeverRecoversFromNan)),
        (CLONES, "clones share a world", check(Flaw::ClonesShareAWorld)),
        (CLONES, "a clone stands still", check(Flaw::CloneStandsStill)),
        (SENSES, "forgets an input", check(Flaw::ForgetsAnInput)),
        (SENSES, "sensing counts", check(Flaw::SensingCounts)),
        (FINITE, "senses NaN", check(Flaw::SensesNan)),
        (FINITE, "NaN without a word", check(Flaw::SilentNan)),
        (FINITE, "NaN at full power", check(Flaw::NanAtFullPower)),
        (BODY, "loses parts", check(Flaw::LosesParts)),
        (BODY, "no parts", check(Flaw::NoParts)),
        (BODY, "shears", check(Flaw::Shears)),
        (CLOCK, "settling counts", check(Flaw::SettlingCounts)),
        (CLOCK, "the clock is slow", check(Flaw::ClockIsSlow)),
        (WORK, "work is given back", check(Flaw::WorkIsGivenBack)),
    ];
    assert_caught(&cases, PROMISES);
}
