use super::{
    Aloft, Cheat, GaitError, Goal, Interval, JointUse, Judgement, LegUse, OtherContact, Rhythm, Rules, Trajectory,
    Travel, Uprightness, View, audit, spectrum::Spectrum,
};
use crate::{Body, Snapshot};
use serde::{Deserialize, Serialize};

/// Everything measured about a gait, its audit and its verdict. All numbers are finite.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct GaitReport {
    /// How long the episode lasted, s.
    #[serde(rename = "duration_s")]
    pub duration: f64,
    /// How long a step lasted, s.
    #[serde(rename = "time_step_s")]
    pub time_step: f64,
    /// How it was looked at.
    #[serde(default)]
    pub view: View,
    /// From when to when rhythm and frequencies were measured.
    pub window: Interval,
    /// Distance, speed and cost; backwards, or of the centre of mass in water, if that is the [view](View).
    pub travel: Travel,
    /// The torso's turning.
    pub torso: Uprightness,
    /// Time off the ground.
    pub aloft: Aloft,
    /// Each actuated leg, in the body's order.
    pub legs: Vec<LegUse>,
    /// What touches the ground besides feet; `None` if nothing does, and for a legless body.
    #[serde(default)]
    pub other_contact: Option<OtherContact>,
    /// Each joint, in the body's order.
    pub joints: Vec<JointUse>,
    /// How regular it is.
    pub rhythm: Rhythm,
    /// What the audit flagged; empty for an honest gait.
    pub cheats: Vec<Cheat>,
    /// The [name](Rules::name) of the rules by which it was judged.
    pub judged_as: Option<String>,
    /// Whether it is usable; `None` if it was not to be judged.
    pub verdict: Option<Judgement>,
}

impl GaitReport {
    /// Measures the snapshots of an episode, one a physics step, the first being the settled start. Ground is flat
    /// and the motors' work known; for anything else see [`of`](Self::of).
    ///
    /// # Errors
    /// See [`Trajectory::new`].
    pub fn measure(body: &Body, trajectory: &[Snapshot], rules: Option<&dyn Rules>) -> Result<Self, GaitError> {
        Ok(Self::of(&Trajectory::new(body, trajectory)?, rules))
    }

    /// Measures a trajectory and judges it by rules, as they [look at it](Rules::view). Without rules it is measured and
    /// audited as what gets ahead on the ground, and not judged.
    pub fn of(trajectory: &Trajectory<'_>, rules: Option<&dyn Rules>) -> Self {
        let view = rules.map(Rules::view).unwrap_or_default();
        if !view.backwards && !view.in_water {
            return Self::seen(trajectory, view, rules);
        }
        let mut trajectory = trajectory.clone();
        if view.backwards {
            trajectory = trajectory.backwards();
        }
        if view.in_water {
            trajectory = trajectory.swimming();
        }
        Self::seen(&trajectory, view, rules)
    }

    /// Measures a trajectory that knows which way is ahead.
    fn seen(trajectory: &Trajectory<'_>, view: View, rules: Option<&dyn Rules>) -> Self {
        let body = trajectory.body();
        let first = match view.goal {
            Goal::Height => 0,
            Goal::Distance => trajectory.at(0.5),
        };
        let window = first..=trajectory.steps();
        let spectrum = Spectrum::new(window.end() - window.start() + 1, trajectory.time_step());
        let hinges = body.hinges.iter().enumerate();
        let mut report = Self {
            duration: trajectory.seconds(),
            time_step: trajectory.time_step(),
            view,
            window: Interval { from: trajectory.time(first), to: trajectory.seconds() },
            travel: Travel::measure(trajectory),
            torso: Uprightness::measure(trajectory),
            aloft: Aloft::measure(trajectory),
            legs: body
                .legs
                .iter()
                .filter_map(|leg| leg.last().map(|&foot| LegUse::measure(trajectory, leg, foot)))
                .collect(),
            other_contact: OtherContact::measure(trajectory),
            joints: hinges
                .map(|(index, hinge)| JointUse::measure(trajectory, index, hinge, &window, &spectrum))
                .collect(),
            rhythm: Rhythm::measure(trajectory, &window),
            cheats: Vec::new(),
            judged_as: rules.map(|rules| rules.name().to_owned()),
            verdict: None,
        };
        report.cheats = audit::audit(trajectory, &report.joints, view);
        report.verdict = rules.map(|rules| Judgement::of(rules, &report, trajectory));
        report
    }

    /// The flight that makes the jump usable, the highest if there are several; `None` if none does, or for a gait that
    /// is not judged as a jump.
    pub fn best_flight(&self) -> Option<&super::Flight> {
        self.verdict.as_ref().and_then(|verdict| self.aloft.flights.get(verdict.best_flight?))
    }

    /// What the movement is [about](Goal), m: the distance, or how far the torso rises in the highest flight.
    pub fn progress(&self) -> f64 {
        match self.view.goal {
            Goal::Distance => self.travel.distance,
            Goal::Height => self.aloft.highest.unwrap_or(0.0),
        }
    }
}
