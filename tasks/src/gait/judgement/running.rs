use super::CLOCK_ERROR;
use crate::{
    Body, Snapshot,
    gait::{Findings, GaitReport, JointUse, LegUse, Reason, Rules, Trajectory, View},
};

/// How long the episode must be, s: bipeds that fall between 18 and 60 s of running look sound for 20 s.
const SECONDS: f64 = 60.0;

/// Slower than this is a stroll that no game calls running, body lengths/s.
const SLOWEST: f64 = 0.5;
/// Beyond this a torso has begun to fall, degrees.
const LARGEST_TILT: f64 = 45.0;
/// Of a degree more: a single moment is looked at with less precision than a trajectory.
const COSINE_OF_LOST: f32 = 0.694_658;
/// A torso that sways by more looks drunk, degrees of standard deviation.
const LARGEST_SWAY: f64 = 12.0;
/// A runner that crouches below this share of its start height crawls.
const LOWEST_HEIGHT: f64 = 0.6;
/// The largest share of the time in which knees, hips, tail or torso may touch the ground: a brush, no more.
const OTHER_CONTACT: f64 = 0.01;
/// The longest a leg may go without a touchdown or a liftoff, s: the stride of a large animal at a walk.
const LONGEST_REST: f64 = 1.0;
/// A foot that rises by less than this share of the body length shuffles.
const LOWEST_CLEARANCE: f64 = 0.02;
/// More than this, in m of slip for each m of way as a mean over the feet, is skating.
const LARGEST_SLIP: f64 = 0.3;
/// The eye reads faster swings as trembling, Hz.
const HIGHEST_FREQUENCY: f64 = 4.0;
/// Strides that repeat themselves less look like stumbling.
const LEAST_REGULARITY: f64 = 0.8;
/// A leg whose joints move by less in all is carried along, and a joint of a legless body that does is not used, degrees.
const SMALLEST_RANGE: f64 = 20.0;

/// Running, forwards or backwards, and everything that is judged like it: 60 s.
///
/// It is usable if over the second half the mean forward speed is at least 0.5 body lengths/s; the torso gets ahead
/// in each quarter of the episode and in each quarter of its second half; every leg comes down (its foot touches the
/// ground, or is less than 1 % of the body length above it) and lifts off at least once every second, from the
/// start to the end, its foot rises by at least 2 % of the body length between, and its joints move by at least 20° in all
/// in the second half; the torso
/// stays within 45° of its start, with a standard deviation of at most 12° over the second half, and above 0.6 of its start
/// height on flat ground; parts that are no feet touch the ground for at most 1 % of the time; feet slip by at most
/// 0.3 m for each metre of way, as a mean over all; no actuated joint's dominant frequency is above 4 Hz; the joints repeat
/// themselves with a regularity of at least 0.8; and no cheat is flagged. A legless body (or one without an actuated leg)
/// may turn, touch and lie as it likes; every actuated joint moves by at least 20° in the second half instead.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunningRules {
    /// Whether every way is measured against the direction the creature faces.
    pub backwards: bool,
}

impl Rules for RunningRules {
    fn name(&self) -> &str {
        if self.backwards { "backwards" } else { "running" }
    }

    fn seconds(&self) -> f64 {
        SECONDS
    }

    fn view(&self) -> View {
        View { backwards: self.backwards, ..View::default() }
    }

    /// A torso that tilts too far.
    fn is_lost(&self, body: &Body, now: &Snapshot) -> bool {
        let (sin, cos) = libm::sincosf(body.start_angle);
        let torso = now.torso();
        let cosine_of_tilt = torso.cos * cos + torso.sin * sin;
        cosine_of_tilt < COSINE_OF_LOST && !body.legless && body.feet().next().is_some()
    }

    fn judge(&self, report: &GaitReport, trajectory: &Trajectory<'_>) -> Findings {
        let mut reasons = Vec::new();
        gets_ahead(report, &mut reasons);
        if trajectory.body().legless || report.legs.is_empty() {
            joints_used(report, &mut reasons);
        } else {
            upright(report, trajectory, &mut reasons);
            on_its_feet(report, &mut reasons);
            for leg in &report.legs {
                steps(leg, trajectory, &mut reasons);
                swings(leg, &report.joints, &mut reasons);
            }
            let slips: f64 = report.legs.iter().filter_map(|leg| leg.slip_per_distance).sum();
            let slip = slips / report.legs.len() as f64;
            if slip > LARGEST_SLIP {
                reasons.push(Reason::Slipping { slip, allowed: LARGEST_SLIP });
            }
        }
        smooth(report, &mut reasons);
        if report.rhythm.strength < LEAST_REGULARITY {
            reasons.push(Reason::Irregular { regularity: report.rhythm.strength, required: LEAST_REGULARITY });
        }
        Findings::new(reasons)
    }
}

pub(super) fn gets_ahead(report: &GaitReport, reasons: &mut Vec<Reason>) {
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

fn upright(report: &GaitReport, trajectory: &Trajectory<'_>, reasons: &mut Vec<Reason>) {
    let torso = &report.torso;
    if torso.largest_tilt > LARGEST_TILT {
        reasons.push(Reason::Tilted { tilt: torso.largest_tilt, allowed: LARGEST_TILT, time: torso.largest_tilt_at });
    }
    if torso.deviation > LARGEST_SWAY {
        reasons.push(Reason::Swaying { deviation: torso.deviation, allowed: LARGEST_SWAY });
    }
    // Where the ground falls away the torso follows it.
    if trajectory.is_flat() && torso.lowest < LOWEST_HEIGHT {
        reasons.push(Reason::Crouching { height: torso.lowest, required: LOWEST_HEIGHT, time: torso.lowest_at });
    }
}

fn on_its_feet(report: &GaitReport, reasons: &mut Vec<Reason>) {
    if let Some(contact) = &report.other_contact
        && contact.share > OTHER_CONTACT
    {
        let (part, share) = (contact.part.clone(), contact.share);
        reasons.push(Reason::OtherContact { part, share, allowed: OTHER_CONTACT });
    }
}

fn steps(leg: &LegUse, trajectory: &Trajectory<'_>, reasons: &mut Vec<Reason>) {
    let foot = || leg.foot.clone();
    let (without_touchdown, without_liftoff) = (leg.longest_without_touchdown, leg.longest_without_liftoff);
    if without_touchdown > LONGEST_REST + CLOCK_ERROR {
        reasons.push(Reason::NoTouchdown { foot: foot(), seconds: without_touchdown, allowed: LONGEST_REST });
    }
    if without_liftoff > LONGEST_REST + CLOCK_ERROR {
        reasons.push(Reason::NoLiftoff { foot: foot(), seconds: without_liftoff, allowed: LONGEST_REST });
    }
    let required = LOWEST_CLEARANCE * f64::from(trajectory.body().body_length);
    // A foot that never swings is named above.
    if let Some(clearance) = leg.clearance.filter(|&clearance| clearance < required) {
        reasons.push(Reason::LowStep { foot: foot(), clearance, required });
    }
}

/// A body that rocks itself along on stiff legs does not run.
fn swings(leg: &LegUse, joints: &[JointUse], reasons: &mut Vec<Reason>) {
    let is_of_leg = |joint: &&JointUse| joint.actuated && leg.joints.iter().any(|own| own.name == joint.name);
    let range: f64 = joints.iter().filter(is_of_leg).map(|joint| joint.window_range).sum();
    if range < SMALLEST_RANGE {
        reasons.push(Reason::LegUnused { foot: leg.foot.clone(), range, required: SMALLEST_RANGE });
    }
}

pub(super) fn smooth(report: &GaitReport, reasons: &mut Vec<Reason>) {
    for joint in report.joints.iter().filter(|joint| joint.actuated && joint.dominant_frequency > HIGHEST_FREQUENCY) {
        let (joint, frequency) = (joint.name.clone(), joint.dominant_frequency);
        reasons.push(Reason::TooFast { joint, frequency, allowed: HIGHEST_FREQUENCY });
    }
}

fn joints_used(report: &GaitReport, reasons: &mut Vec<Reason>) {
    let mut actuated = report.joints.iter().filter(|joint| joint.actuated).peekable();
    if actuated.peek().is_none() {
        reasons.push(Reason::NothingActuated);
    }
    for joint in actuated.filter(|joint| joint.window_range < SMALLEST_RANGE) {
        let (joint, range) = (joint.name.clone(), joint.window_range);
        reasons.push(Reason::JointUnused { joint, range, required: SMALLEST_RANGE });
    }
}
