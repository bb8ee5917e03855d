use super::{Flight, GaitReport, JUMPING_SECONDS, RUNNING_SECONDS, Reason, Trajectory};
use serde::{Deserialize, Serialize};

/// Clocks are f32: a limit in seconds is kept by what exceeds it by less than this.
const CLOCK_ERROR: f64 = 1e-5;

/// What a gait is judged as.
///
/// | movement | judged as | why |
/// |---|---|---|
/// | `running`, `climbing`, `carrying`, `cruising` | running | they get ahead, upright and step by step |
/// | `backwards` | backwards | the same, the other way |
/// | `swimming` | swimming | it gets ahead, and there is neither ground nor up |
/// | `jumping`, `long-jump` | jumping | what gets far without getting high off all legs is a stride |
///
/// Others are measured and audited, and not judged: how fast a walk has to be is a setting, and hopping, standing and
/// getting up have no rules yet that a game agrees on. Nor are movements of other crates.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// Getting ahead.
    Running,
    /// Getting ahead backwards: running, with every way measured against the direction the creature faces.
    Backwards,
    /// Getting off the ground.
    Jumping,
    /// Getting ahead in water.
    Swimming,
}

impl Kind {
    /// The movements whose gaits are judged.
    pub const JUDGED: [&str; 8] =
        ["running", "jumping", "long-jump", "climbing", "carrying", "cruising", "backwards", "swimming"];

    /// How a movement of this name is judged, if it is.
    pub fn of(movement: &str) -> Option<Self> {
        match movement {
            "running" | "climbing" | "carrying" | "cruising" => Some(Self::Running),
            "backwards" => Some(Self::Backwards),
            "jumping" | "long-jump" => Some(Self::Jumping),
            "swimming" => Some(Self::Swimming),
            _ => None,
        }
    }

    /// How long the episode to judge must last, s. All of a longer one is judged.
    pub fn judged_seconds(self) -> f64 {
        match self {
            Self::Running | Self::Backwards | Self::Swimming => RUNNING_SECONDS,
            Self::Jumping => JUMPING_SECONDS,
        }
    }
}

/// Whether a gait is usable.
///
/// **Running** is, if over the second half the mean forward speed is at least 0.5 body lengths/s; the torso gets ahead
/// in each quarter of the episode and in each quarter of its second half; the torso never tilts more than 90° from its
/// start; every leg touches down and lifts off at least once every 3 s, from the start to the end (legless, or without
/// an actuated leg: every actuated joint moves by at least 20° in the second half); no actuated joint's dominant frequency
/// is above 5 Hz; and no cheat is flagged. **Backwards** is the same, where ahead is backwards.
///
/// **Swimming** is, if over the second half the mean forward speed of the centre of mass is at least 0.5 body lengths/s; it
/// gets ahead in each quarter of the episode and of its second half; no actuated joint's dominant frequency is above 5 Hz;
/// and no cheat is flagged. How it is turned does not matter, nor which of its joints it uses.
///
/// **Jumping** is, if in one and the same flight every part is off the ground for at least 0.15 s; the torso rises at
/// least 0.3 × its start height above its start; and all legs lose contact within 0.3 s before it (not asked of a legless
/// body); and no cheat is flagged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// Whether nothing speaks against it.
    pub usable: bool,
    /// What speaks against it.
    pub reasons: Vec<Reason>,
    /// Index of the highest flight that makes a usable jump.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub best_flight: Option<usize>,
    /// In how many near worlds it is usable; `None` if it was judged alone, as a bare trajectory is.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub near_worlds: Option<NearWorlds>,
}

/// In how many worlds that are almost the one it is judged in a gait is usable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct NearWorlds {
    /// So many.
    pub usable: usize,
    /// Of so many.
    pub worlds: usize,
}

/// In how many near worlds a gait is tried.
pub const NEAR_WORLDS: usize = 8;

/// In how many of them it must be usable: a gait that fails in more is a lucky trajectory.
pub const NEAR_WORLDS_REQUIRED: usize = 7;

impl Judgement {
    pub(super) fn of(kind: Kind, report: &GaitReport, trajectory: &Trajectory<'_>) -> Self {
        let mut reasons = Vec::new();
        // Half a step is forgiven: it may be the clock's.
        if report.duration < kind.judged_seconds() - 0.5 * report.time_step {
            reasons.push(Reason::TooShort { seconds: report.duration, required: kind.judged_seconds() });
        }
        let mut best_flight = None;
        match kind {
            Kind::Running | Kind::Backwards => running(report, trajectory, &mut reasons),
            Kind::Swimming => swimming(report, &mut reasons),
            Kind::Jumping => match judge_flights(report, trajectory) {
                Ok(best) => best_flight = Some(best),
                Err(against) => reasons.extend(against),
            },
        }
        reasons.extend(report.cheats.iter().cloned().map(Reason::Cheat));
        Self { usable: reasons.is_empty(), reasons, best_flight, near_worlds: None }
    }

    /// The same, of a gait that was also tried in near worlds. One that is usable in fewer than 7 of 8 is not usable.
    #[must_use]
    pub fn with_near_worlds(mut self, near: NearWorlds) -> Self {
        let required = (near.worlds * NEAR_WORLDS_REQUIRED).div_ceil(NEAR_WORLDS);
        if near.usable < required {
            self.reasons.push(Reason::Brittle { usable: near.usable, worlds: near.worlds, required });
        }
        Self { usable: self.reasons.is_empty(), near_worlds: Some(near), ..self }
    }
}

fn running(report: &GaitReport, trajectory: &Trajectory<'_>, reasons: &mut Vec<Reason>) {
    const LARGEST_TILT: f64 = 90.0;
    gets_ahead(report, reasons);
    let tilt = report.torso.largest_tilt;
    if tilt > LARGEST_TILT {
        reasons.push(Reason::Tilted { tilt, allowed: LARGEST_TILT, time: report.torso.largest_tilt_at });
    }
    if trajectory.body().legless || report.legs.is_empty() {
        joints_used(report, reasons);
    } else {
        legs_used(report, reasons);
    }
    smooth(report, reasons);
}

fn swimming(report: &GaitReport, reasons: &mut Vec<Reason>) {
    gets_ahead(report, reasons);
    smooth(report, reasons);
}

fn gets_ahead(report: &GaitReport, reasons: &mut Vec<Reason>) {
    const SLOWEST: f64 = 0.5;
    let speed = report.travel.second_half_relative_speed;
    if speed < SLOWEST {
        reasons.push(Reason::Slow { speed, required: SLOWEST });
    }
    let parts = [(false, &report.travel.quarters), (true, &report.travel.second_half_quarters)];
    for (second_half, quarters) in parts {
        for (index, &progress) in quarters.iter().enumerate().filter(|&(_, &progress)| progress <= 0.0) {
            reasons.push(Reason::NoProgress { quarter: index + 1, second_half, progress });
        }
    }
}

fn smooth(report: &GaitReport, reasons: &mut Vec<Reason>) {
    const HIGHEST_FREQUENCY: f64 = 5.0;
    for joint in report.joints.iter().filter(|joint| joint.actuated && joint.dominant_frequency > HIGHEST_FREQUENCY) {
        let (joint, frequency) = (joint.name.clone(), joint.dominant_frequency);
        reasons.push(Reason::TooFast { joint, frequency, allowed: HIGHEST_FREQUENCY });
    }
}

fn legs_used(report: &GaitReport, reasons: &mut Vec<Reason>) {
    const LONGEST: f64 = 3.0;
    for leg in &report.legs {
        let (without_touchdown, without_liftoff) = (leg.longest_without_touchdown, leg.longest_without_liftoff);
        if without_touchdown > LONGEST + CLOCK_ERROR {
            let foot = leg.foot.clone();
            reasons.push(Reason::NoTouchdown { foot, seconds: without_touchdown, allowed: LONGEST });
        }
        if without_liftoff > LONGEST + CLOCK_ERROR {
            let foot = leg.foot.clone();
            reasons.push(Reason::NoLiftoff { foot, seconds: without_liftoff, allowed: LONGEST });
        }
    }
}

fn joints_used(report: &GaitReport, reasons: &mut Vec<Reason>) {
    const SMALLEST_RANGE: f64 = 20.0;
    let mut actuated = report.joints.iter().filter(|joint| joint.actuated).peekable();
    if actuated.peek().is_none() {
        reasons.push(Reason::NothingActuated);
    }
    for joint in actuated.filter(|joint| joint.window_range < SMALLEST_RANGE) {
        let (joint, range) = (joint.name.clone(), joint.window_range);
        reasons.push(Reason::JointUnused { joint, range, required: SMALLEST_RANGE });
    }
}

/// The highest flight with nothing against it, or what is against the best of them: the one with the least against it,
/// then the highest.
fn judge_flights(report: &GaitReport, trajectory: &Trajectory<'_>) -> Result<usize, Vec<Reason>> {
    let judged = report.aloft.flights.iter().map(|flight| (flight, against(flight, trajectory))).enumerate();
    let best = judged.min_by(|(_, (one, against_one)), (_, (other, against_other))| {
        against_one.len().cmp(&against_other.len()).then(other.rise.total_cmp(&one.rise))
    });
    match best {
        None => Err(vec![Reason::NeverAloft]),
        Some((index, (_, against))) if against.is_empty() => Ok(index),
        Some((_, (_, against))) => Err(against),
    }
}

fn against(flight: &Flight, trajectory: &Trajectory<'_>) -> Vec<Reason> {
    const SHORTEST: f64 = 0.15;
    const LOWEST_RISE: f64 = 0.3;
    const WIDEST_SPREAD: f64 = 0.3;
    let mut reasons = Vec::new();
    let time = flight.interval.from;
    let seconds = flight.interval.seconds();
    if seconds < SHORTEST - CLOCK_ERROR {
        reasons.push(Reason::ShortFlight { time, seconds, required: SHORTEST });
    }
    let required = LOWEST_RISE * trajectory.start_height();
    if flight.rise < required {
        reasons.push(Reason::LowFlight { time, rise: flight.rise, required });
    }
    if !trajectory.body().legless {
        for (foot, _) in trajectory.body().feet().zip(&flight.push_offs).filter(|(_, push_off)| push_off.is_none()) {
            let foot = trajectory.body().parts[foot].name.clone();
            reasons.push(Reason::NoPushOff { time, foot });
        }
        let spread = flight.push_off_spread().filter(|&spread| spread > WIDEST_SPREAD + CLOCK_ERROR);
        if let Some(spread) = spread {
            reasons.push(Reason::UnevenPushOff { time, spread, allowed: WIDEST_SPREAD });
        }
    }
    reasons
}
