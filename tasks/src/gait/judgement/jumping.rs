use super::CLOCK_ERROR;
use crate::gait::{Findings, Flight, GaitReport, Goal, Reason, Rules, Trajectory, View};

/// How long the episode must be, s.
const SECONDS: f64 = 5.0;

/// A shorter flight is a hop of a run, s.
const SHORTEST: f64 = 0.2;
/// The centre of mass rises by at least this share of the start height...
const LOWEST_RISE: f64 = 0.3;
/// ...and by at least this, m: a flat body is soon over a share of its height.
const LOWEST_RISE_METRES: f64 = 0.05;
/// ...and that of a body without legs, which starts next to the ground, by this many body lengths: any wave that runs through a
/// strong caterpillar throws it up by less.
const LOWEST_LEGLESS_RISE: f64 = 0.25;
/// Legs that push off farther apart in time stumble into the air, s.
const WIDEST_SPREAD: f64 = 0.15;
/// Beyond this a torso has begun to fall, degrees...
const LARGEST_TILT: f64 = 45.0;
/// ...and beyond this a body without legs, which bends when it takes off, is on its way to its back.
const LARGEST_LEGLESS_TILT: f64 = 90.0;
/// What stands again is within this of its start, degrees...
const STANDING_TILT: f64 = 20.0;
/// ...within this share of its start height...
const STANDING_HEIGHT: f64 = 0.15;
/// ...or within this, m, where the body is so flat that the share is less than feet sink in...
const STANDING_HEIGHT_METRES: f64 = 0.03;
/// ...and slower than this, body lengths/s...
const STANDING_SPEED: f64 = 0.2;
/// ...for the last second.
const STANDING_SECONDS: f64 = 1.0;
/// What jumps on has taken off for the last time no longer before the end than this, s.
const JUMPS_ON: f64 = 1.5;

/// Jumping: 5 s.
///
/// It is usable if in one and the same flight every part is off the ground for at least 0.2 s, the centre of mass rises
/// at least 0.3 × the start height and 5 cm above its start (without legs 0.25 body lengths), and all legs lose contact
/// within 0.15 s before it; if from the take-off of the first such flight to the end the torso stays within 45° and nothing
/// but feet touches the ground; if the body stands again in the last second, or jumps on; and no cheat is flagged. Legs
/// and contacts are not asked of a legless body, whose torso stays within 90°.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct JumpingRules;

impl Rules for JumpingRules {
    fn name(&self) -> &str {
        "jumping"
    }

    fn seconds(&self) -> f64 {
        SECONDS
    }

    fn view(&self) -> View {
        View { goal: Goal::Height, ..View::default() }
    }

    fn judge(&self, report: &GaitReport, trajectory: &Trajectory<'_>) -> Findings {
        let flights = &report.aloft.flights;
        let judged: Vec<Vec<Reason>> = flights.iter().map(|flight| against(flight, trajectory)).collect();
        let jumps: Vec<usize> = (0..flights.len()).filter(|&index| judged[index].is_empty()).collect();
        let Some(&first) = jumps.first() else {
            // What is against the best of them: the one with the least against it, then the highest.
            let best = judged.into_iter().zip(flights).min_by(|(one, flight), (other, other_flight)| {
                one.len().cmp(&other.len()).then(other_flight.centre_rise.total_cmp(&flight.centre_rise))
            });
            return Findings::new(best.map_or_else(|| vec![Reason::NeverAloft], |(against, _)| against));
        };
        let mut reasons = Vec::new();
        let take_off = step_at(trajectory, flights[first].interval.from);
        if trajectory.body().legless {
            stays_upright(trajectory, take_off, LARGEST_LEGLESS_TILT, &mut reasons);
        } else {
            stays_upright(trajectory, take_off, LARGEST_TILT, &mut reasons);
            lands_on_its_feet(trajectory, take_off, &mut reasons);
        }
        let jumps_on = jumps.len() > 1
            && jumps.last().is_some_and(|&last| trajectory.seconds() - flights[last].interval.from <= JUMPS_ON);
        if !jumps_on {
            stands(trajectory, &mut reasons);
        }
        let higher = |&one: &usize, &other: &usize| flights[other].centre_rise.total_cmp(&flights[one].centre_rise);
        Findings { reasons, best_flight: jumps.into_iter().min_by(higher) }
    }
}

pub(super) fn against(flight: &Flight, trajectory: &Trajectory<'_>) -> Vec<Reason> {
    let mut reasons = Vec::new();
    let time = flight.interval.from;
    let seconds = flight.interval.seconds();
    if seconds < SHORTEST - CLOCK_ERROR {
        reasons.push(Reason::ShortFlight { time, seconds, required: SHORTEST });
    }
    let body = trajectory.body();
    let of_length = if body.legless { LOWEST_LEGLESS_RISE * f64::from(body.body_length) } else { 0.0 };
    let required = (LOWEST_RISE * trajectory.start_height()).max(LOWEST_RISE_METRES).max(of_length);
    if flight.centre_rise < required {
        reasons.push(Reason::LowFlight { time, rise: flight.centre_rise, required });
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

/// From take-off to the end the torso tilts by no more than so many degrees, whole turns counted.
fn stays_upright(trajectory: &Trajectory<'_>, take_off: usize, allowed: f64, reasons: &mut Vec<Reason>) {
    let tilts = trajectory.tilts().iter().enumerate().skip(take_off).map(|(step, tilt)| (step, tilt.abs()));
    if let Some((step, tilt)) = tilts.max_by(|(_, one), (_, other)| one.total_cmp(other))
        && tilt.to_degrees() > allowed
    {
        let time = trajectory.time(step);
        reasons.push(Reason::Tilted { tilt: tilt.to_degrees(), allowed, time });
    }
}

/// From take-off to the end nothing but feet touches the ground.
fn lands_on_its_feet(trajectory: &Trajectory<'_>, take_off: usize, reasons: &mut Vec<Reason>) {
    let others = trajectory.body().parts_without_feet();
    let touches = |step: &usize| others.iter().find(|&&part| trajectory.snapshots()[*step].parts[part].touching);
    let first = (take_off..=trajectory.steps()).find_map(|step| Some((step, *touches(&step)?)));
    if let Some((step, part)) = first {
        let part = trajectory.body().parts[part].name.clone();
        reasons.push(Reason::LandedOn { part, time: trajectory.time(step) });
    }
}

/// In the last second the body is where it was at the start, and keeps still.
fn stands(trajectory: &Trajectory<'_>, reasons: &mut Vec<Reason>) {
    let from = step_at(trajectory, trajectory.seconds() - STANDING_SECONDS);
    let last = from..=trajectory.steps();
    let most = |measure: &dyn Fn(usize) -> f64| last.clone().map(measure).fold(0.0, f64::max);
    let tilt = most(&|step| trajectory.tilts()[step].abs().to_degrees());
    let height = most(&|step| trajectory.rise(step).abs());
    let speed = |step: usize| {
        let torso = trajectory.snapshots()[step].torso();
        libm::hypot(torso.vx.into(), torso.vy.into())
    };
    let mean_speed = last.clone().map(speed).sum::<f64>() / last.clone().count() as f64;
    let relative_speed = mean_speed / f64::from(trajectory.body().body_length);
    let tolerance = (STANDING_HEIGHT * trajectory.start_height()).max(STANDING_HEIGHT_METRES);
    if tilt > STANDING_TILT || height > tolerance || relative_speed > STANDING_SPEED {
        let allowed = [STANDING_TILT, tolerance, STANDING_SPEED];
        reasons.push(Reason::NotStanding { tilt, height, speed: relative_speed, allowed });
    }
}

/// The snapshot nearest to a time.
fn step_at(trajectory: &Trajectory<'_>, time: f64) -> usize {
    (libm::round(time / trajectory.time_step()).max(0.0) as usize).min(trajectory.steps())
}
