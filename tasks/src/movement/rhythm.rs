use super::{Movement, Verdict};
use crate::{Body, BodyHinge, Snapshot};
use ne_core::SettingError;
use serde::Deserialize;

/// The way made out of rhythm, m, forwards or backwards: all of it where joints never are where they were a stride ago, and
/// none where they always are. Weigh it negatively, from −1 to 0: a gait that keeps time looks meant, and leans less on how
/// the ground answers.
///
/// The stride is that of the clock. What differs is the mean square of each joint's change over a stride, as a share of what
/// it would be if the joint's angles came in any order.
#[derive(Clone, Debug, Default)]
pub struct Rhythm {
    settings: RhythmSettings,
    hinges: Vec<BodyHinge>,
    /// Directions of all hinges, look after look, over and over.
    past: Vec<[f32; 2]>,
    /// Steps from one look to the next; 0 before the first step.
    every: usize,
    /// Looks a stride.
    lag: usize,
    steps: usize,
    looks: usize,
    /// Of the directions of each hinge.
    sums: Vec<[f64; 2]>,
    changes: f64,
    start: f32,
    begun: f32,
    x: f32,
}

/// Settings of [`Rhythm`].
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct RhythmSettings {
    /// Of a stride, s; from 0.05 to 5, default 0.5.
    pub period: f32,
}

impl Default for RhythmSettings {
    fn default() -> Self {
        Self { period: 0.5 }
    }
}

/// The most looks a second.
const MOST_LOOKS: f32 = 100.0;

/// Joints that hardly move have no rhythm to lose: the sum of the variances of their directions.
const STILL: f64 = 1e-6;

impl Rhythm {
    /// With these settings.
    ///
    /// # Errors
    /// If the period is out of range.
    pub fn new(settings: RhythmSettings) -> Result<Self, SettingError> {
        SettingError::check_range("period", settings.period, 0.05, 5.0)?;
        Ok(Self { settings, ..Self::default() })
    }
}

impl Movement for Rhythm {
    fn name(&self) -> &str {
        "rhythm"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        self.hinges = body.actuated().cloned().collect();
        // One more than a stride has: their number is rounded.
        let looks = (self.settings.period * MOST_LOOKS) as usize + 1;
        self.past = vec![[0.0; 2]; looks * self.hinges.len()];
        self.sums = vec![[0.0; 2]; self.hinges.len()];
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.every, self.lag, self.steps, self.looks, self.changes) = (0, 0, 0, 0, 0.0);
        self.sums.fill([0.0; 2]);
        (self.start, self.x, self.begun) = (start.torso().x, start.torso().x, start.time);
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.x = now.torso().x;
        if self.every == 0 {
            let seconds = now.time - self.begun;
            let every = libm::ceilf(1.0 / (MOST_LOOKS * seconds)).max(1.0);
            self.every = every as usize;
            self.lag = libm::roundf(self.settings.period / (every * seconds)).max(1.0) as usize;
        }
        self.steps += 1;
        if !self.steps.is_multiple_of(self.every) || self.hinges.is_empty() {
            return Verdict::GoOn;
        }
        let first = self.looks % self.lag * self.hinges.len();
        let slots = self.past[first..].iter_mut().zip(&mut self.sums);
        for (hinge, (past, [x, y])) in self.hinges.iter().zip(slots) {
            let [cos, sin] = hinge.direction(&now.parts);
            if self.looks >= self.lag {
                let [c, s] = *past;
                self.changes += f64::from((cos - c) * (cos - c) + (sin - s) * (sin - s));
                *x += f64::from(cos);
                *y += f64::from(sin);
            }
            *past = [cos, sin];
        }
        self.looks += 1;
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        let compared = self.looks.saturating_sub(self.lag) as f64;
        if compared == 0.0 {
            return 0.0;
        }
        // Twice the variance is the mean square of the difference of two directions of any two moments.
        let variance = |[x, y]: &[f64; 2]| (1.0 - (x * x + y * y) / (compared * compared)).max(0.0);
        let expected = 2.0 * compared * self.sums.iter().map(variance).sum::<f64>();
        if expected < STILL * compared {
            return 0.0;
        }
        f64::from((self.x - self.start).abs()) * (self.changes / expected).min(1.0)
    }
}
