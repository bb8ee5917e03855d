use super::{
    Aloft, Cheat, GaitError, JointUse, Judgement, Kind, LegUse, OtherContact, Rhythm, Trajectory, Travel, Uprightness,
    audit, spectrum::Spectrum,
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
    /// Distance, speed and cost; backwards, if it was judged as [`Kind::Backwards`]; of the centre of mass, if it was judged as
    /// [`Kind::Swimming`].
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
    /// As what it was judged.
    pub kind: Option<Kind>,
    /// Whether it is usable; `None` if it was not to be judged.
    pub verdict: Option<Judgement>,
}

impl GaitReport {
    /// Measures the snapshots of an episode, one a physics step, the first being the settled start. Ground is flat
    /// and the motors' work known; for anything else see [`of`](Self::of).
    ///
    /// # Errors
    /// See [`Trajectory::new`].
    pub fn measure(body: &Body, trajectory: &[Snapshot], kind: Option<Kind>) -> Result<Self, GaitError> {
        Ok(Self::of(&Trajectory::new(body, trajectory)?, kind))
    }

    /// Measures a trajectory; one to be judged as [`Kind::Backwards`] with backwards as the way ahead, one to be judged as
    /// [`Kind::Swimming`] by its centre of mass.
    pub fn of(trajectory: &Trajectory<'_>, kind: Option<Kind>) -> Self {
        match kind {
            Some(Kind::Backwards) => Self::facing(&trajectory.clone().backwards(), kind),
            Some(Kind::Swimming) => Self::facing(&trajectory.clone().swimming(), kind),
            Some(Kind::Running | Kind::Jumping) | None => Self::facing(trajectory, kind),
        }
    }

    /// Measures a trajectory that knows which way is ahead.
    fn facing(trajectory: &Trajectory<'_>, kind: Option<Kind>) -> Self {
        let body = trajectory.body();
        let window = match kind {
            Some(Kind::Jumping) => 0..=trajectory.steps(),
            Some(Kind::Running | Kind::Backwards | Kind::Swimming) | None => trajectory.at(0.5)..=trajectory.steps(),
        };
        let spectrum = Spectrum::new(window.end() - window.start() + 1, trajectory.time_step());
        let hinges = body.hinges.iter().enumerate();
        let mut report = Self {
            duration: trajectory.seconds(),
            time_step: trajectory.time_step(),
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
            kind,
            verdict: None,
        };
        report.cheats = audit::audit(trajectory, &report.joints, kind);
        report.verdict = kind.map(|kind| Judgement::of(kind, &report, trajectory));
        report
    }

    /// The flight that makes the jump usable, the highest if there are several; `None` if none does, or for a gait that
    /// is not judged as a jump.
    pub fn best_flight(&self) -> Option<&super::Flight> {
        self.verdict.as_ref().and_then(|verdict| self.aloft.flights.get(verdict.best_flight?))
    }
}
