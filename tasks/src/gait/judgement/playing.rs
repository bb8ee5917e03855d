use super::{CLOCK_ERROR, jumping};
use crate::{
    Body, Command, Snapshot,
    gait::{Findings, GaitReport, Reason, Rules, RunningRules, Trajectory},
};
use std::ops::{Range, RangeInclusive};

/// How long the episode must be, s.
const SECONDS: f64 = 60.0;

/// How far the mean speed over the last half of a hold may be off, body lengths/s, or as a share of the commanded speed.
const SPEED_ERROR: f64 = 0.25;
const SPEED_ERROR_SHARE: f64 = 0.2;
/// The same where it is told to stand.
const DRIFT: f64 = 0.1;
/// How much of a change of speed must be done...
const ANSWERED: f64 = 0.75;
/// ...within this, s. A smaller change than the speed error is none.
const ANSWER_SECONDS: f64 = 1.2;
/// Speeds are means over so long at least, in all, s: within a stride they swing.
const STRIDE: f64 = 0.5;
/// By when it has to leave the ground, s after the press.
const JUMP_ANSWER: f64 = 0.5;
/// How long a jump has, from the press until the body is on its way again, s. Speeds are not judged meanwhile.
const JUMP_SECONDS: f64 = 1.5;
/// Beyond this a torso has begun to fall, degrees.
const LARGEST_TILT: f64 = 45.0;
/// What stands is within this of its start, degrees.
const STANDING_TILT: f64 = 20.0;
/// The largest share of the time in which parts that are no feet may touch the ground.
const OTHER_CONTACT: f64 = 0.01;

/// Playing: 60 s of commands.
///
/// It is playable if it is told to move at all; if, while it is told to move, its mean speed over the last half of each hold is
/// within 0.25 body lengths/s or 20 % of the commanded speed, whichever is more, and three quarters of a change of speed are done within 1.2 s; if, while it
/// is told to stand, it drifts by at most 0.1 body lengths/s over the last half of the hold, its torso within 20° of its start;
/// if within 0.5 s of each press it leaves the ground in a flight that makes a [usable jump](super::JumpingRules), and nothing
/// but feet touches the ground in the 1.5 s after the press; if the torso stays within 45°, and parts that are no feet touch
/// the ground for at most 1 % of the time; and if no cheat is flagged. Speeds are the torso's. Of the last half of a hold the
/// 1.5 s after each press are left out, and what is left counts if it is half a second or more in all; a change is measured by means
/// over half a second. A legless body may turn and touch as it likes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PlayingRules;

/// A stretch of time with one commanded speed, by snapshots.
struct Hold {
    first: usize,
    /// The first snapshot of the next hold, or the last of all.
    end: usize,
    wanted: f64,
}

impl Rules for PlayingRules {
    fn name(&self) -> &str {
        "playing"
    }

    fn seconds(&self) -> f64 {
        SECONDS
    }

    fn needs_commands(&self) -> bool {
        true
    }

    /// As of running.
    fn is_lost(&self, body: &Body, now: &Snapshot) -> bool {
        RunningRules::default().is_lost(body, now)
    }

    fn judge(&self, report: &GaitReport, trajectory: &Trajectory<'_>) -> Findings {
        let mut reasons = Vec::new();
        let presses = presses(trajectory);
        speeds(trajectory, &presses, &mut reasons);
        jumps(report, trajectory, &presses, &mut reasons);
        if !trajectory.body().legless {
            let torso = &report.torso;
            if torso.largest_tilt > LARGEST_TILT {
                let time = torso.largest_tilt_at;
                reasons.push(Reason::Tilted { tilt: torso.largest_tilt, allowed: LARGEST_TILT, time });
            }
            if let Some(contact) = report.other_contact.as_ref().filter(|contact| contact.share > OTHER_CONTACT) {
                let (part, share) = (contact.part.clone(), contact.share);
                reasons.push(Reason::OtherContact { part, share, allowed: OTHER_CONTACT });
            }
        }
        Findings::new(reasons)
    }
}

fn command(trajectory: &Trajectory<'_>, step: usize) -> Command {
    trajectory.snapshots()[step].command
}

/// When the button was pressed.
fn presses(trajectory: &Trajectory<'_>) -> Vec<usize> {
    (0..trajectory.steps()).filter(|&step| command(trajectory, step).since_press == 0.0).collect()
}

fn holds(trajectory: &Trajectory<'_>) -> Vec<Hold> {
    let mut holds: Vec<Hold> = Vec::new();
    for step in 0..=trajectory.steps() {
        let wanted = f64::from(command(trajectory, step).speed);
        match holds.last_mut() {
            Some(hold) if hold.wanted == wanted => hold.end = step,
            last => {
                if let Some(last) = last {
                    last.end = step;
                }
                holds.push(Hold { first: step, end: step, wanted });
            }
        }
    }
    holds
}

/// What is left of these steps without the jumps, each of so many steps from its press on, in order.
fn without_jumps(steps: Range<usize>, presses: &[usize], jump: usize) -> Vec<Range<usize>> {
    let mut left = Vec::new();
    let mut from = steps.start;
    for &press in presses.iter().filter(|&&press| press < steps.end) {
        left.push(from..press);
        from = from.max(press + jump);
    }
    left.push(from..steps.end);
    left.retain(|part| !part.is_empty());
    left
}

/// The mean speed, body lengths/s, of a torso that goes so far, m, in so many steps.
fn speed_of(trajectory: &Trajectory<'_>, progress: f64, steps: usize) -> f64 {
    progress / (steps as f64 * trajectory.time_step()) / f64::from(trajectory.body().body_length)
}

/// The mean speed of the torso, body lengths/s, between two snapshots.
fn mean_speed(trajectory: &Trajectory<'_>, from: usize, to: usize) -> f64 {
    speed_of(trajectory, trajectory.progress(from, to), to - from)
}

fn steps_in(trajectory: &Trajectory<'_>, seconds: f64) -> usize {
    libm::round(seconds / trajectory.time_step()) as usize
}

/// How one hold was kept.
struct Kept {
    time: f64,
    wanted: f64,
    speed: f64,
    allowed: f64,
}

/// A change of speed that was not done in time.
struct SlowAnswer {
    time: f64,
    from: f64,
    to: f64,
    /// How much of it was done.
    share: f64,
}

impl Kept {
    fn excess(&self) -> f64 {
        (self.speed - self.wanted).abs() - self.allowed
    }
}

fn speeds(trajectory: &Trajectory<'_>, presses: &[usize], reasons: &mut Vec<Reason>) {
    let jump = steps_in(trajectory, JUMP_SECONDS);
    let shortest = steps_in(trajectory, STRIDE);
    let holds = holds(trajectory);
    let (mut moved, mut stood) = (Vec::new(), Vec::new());
    let (mut slowest, mut slow, mut changes): (Option<SlowAnswer>, usize, usize) = (None, 0, 0);
    for (index, hold) in holds.iter().enumerate() {
        let judged = without_jumps(hold.first.midpoint(hold.end)..hold.end, presses, jump);
        let steps: usize = judged.iter().map(ExactSizeIterator::len).sum();
        if steps >= shortest {
            let progress: f64 = judged.iter().map(|part| trajectory.progress(part.start, part.end)).sum();
            let speed = speed_of(trajectory, progress, steps);
            let allowed =
                if hold.wanted == 0.0 { DRIFT } else { SPEED_ERROR.max(SPEED_ERROR_SHARE * hold.wanted.abs()) };
            let kept = Kept { time: trajectory.time(hold.first), wanted: hold.wanted, speed, allowed };
            if hold.wanted == 0.0 { &mut stood } else { &mut moved }.push(kept);
            if hold.wanted == 0.0 && !trajectory.body().legless {
                for part in judged {
                    upright(trajectory, part.start..=part.end, reasons);
                }
            }
        }
        let Some(before) = index.checked_sub(1).and_then(|before| holds.get(before)) else { continue };
        let change = hold.wanted - before.wanted;
        let due = hold.first + steps_in(trajectory, ANSWER_SECONDS);
        let jumps = presses.iter().any(|&press| press + jump > hold.first && press < due);
        if change.abs() < SPEED_ERROR || due > hold.end || jumps {
            continue;
        }
        changes += 1;
        let half = steps_in(trajectory, 0.5 * STRIDE);
        let reached = |step: usize| {
            let (from, to) = (step.saturating_sub(half), (step + half).min(trajectory.steps()));
            (mean_speed(trajectory, from, to) - before.wanted) / change
        };
        let share = (hold.first..=due).map(reached).fold(f64::NEG_INFINITY, f64::max);
        if share < ANSWERED {
            slow += 1;
            if slowest.as_ref().is_none_or(|slowest| share < slowest.share) {
                slowest =
                    Some(SlowAnswer { time: trajectory.time(hold.first), from: before.wanted, to: hold.wanted, share });
            }
        }
    }
    // A short trial of training may happen to tell it nothing.
    if moved.is_empty() && trajectory.seconds() > SECONDS - 0.5 * trajectory.time_step() {
        reasons.push(Reason::NeverToldToMove { required: STRIDE });
    }
    if let Some(SlowAnswer { time, from, to, share }) = slowest {
        reasons.push(Reason::SlowAnswer { time, from, to, share, required: ANSWERED, changes: slow, of: changes });
    }
    for (kept, stands) in [(moved, false), (stood, true)] {
        let off = kept.iter().filter(|kept| kept.excess() > 0.0);
        let (count, of) = (off.clone().count(), kept.len());
        if let Some(&Kept { time, wanted, speed, allowed }) = off.max_by(|a, b| a.excess().total_cmp(&b.excess())) {
            reasons.push(match stands {
                false => Reason::OffSpeed { time, wanted, speed, allowed, holds: count, of },
                true => Reason::Drifting { time, speed, allowed, holds: count, of },
            });
        }
    }
}

/// Told to stand, the torso is as upright as one that stands after a jump. The first moment that is not is told, once.
fn upright(trajectory: &Trajectory<'_>, steps: RangeInclusive<usize>, reasons: &mut Vec<Reason>) {
    if reasons.iter().any(|reason| matches!(reason, Reason::Tilted { .. })) {
        return;
    }
    let tilt = |step: usize| trajectory.tilts()[step].abs().to_degrees();
    let worst = steps.max_by(|&one, &other| tilt(one).total_cmp(&tilt(other)));
    if let Some(step) = worst.filter(|&step| tilt(step) > STANDING_TILT) {
        reasons.push(Reason::Tilted { tilt: tilt(step), allowed: STANDING_TILT, time: trajectory.time(step) });
    }
}

fn jumps(report: &GaitReport, trajectory: &Trajectory<'_>, presses: &[usize], reasons: &mut Vec<Reason>) {
    let whole = presses.iter().filter(|&&press| trajectory.time(press) + JUMP_SECONDS <= trajectory.seconds());
    let (mut failed, mut of) = (0, 0);
    let mut first: Vec<Reason> = Vec::new();
    for &press in whole {
        of += 1;
        let pressed = trajectory.time(press);
        let due = pressed..=pressed + JUMP_ANSWER + CLOCK_ERROR;
        let flights = report.aloft.flights.iter().filter(|flight| due.contains(&flight.interval.from));
        let judged = flights.map(|flight| jumping::against(flight, trajectory));
        let mut against =
            judged.min_by_key(Vec::len).unwrap_or_else(|| vec![Reason::NoJump { time: pressed, allowed: JUMP_ANSWER }]);
        if against.is_empty() && !trajectory.body().legless {
            let others = trajectory.body().parts_without_feet();
            let steps = press..=(press + steps_in(trajectory, JUMP_SECONDS)).min(trajectory.steps());
            let touching = |step: usize| {
                let part = others.iter().find(|&&part| trajectory.snapshots()[step].parts[part].touching)?;
                Some(Reason::LandedOn {
                    part: trajectory.body().parts[*part].name.clone(),
                    time: trajectory.time(step),
                })
            };
            against.extend(steps.clone().find_map(touching));
        }
        failed += usize::from(!against.is_empty());
        if first.is_empty() {
            first = against;
        }
    }
    if failed > 0 {
        reasons.push(Reason::Presses { failed, of });
        reasons.extend(first);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gait::synthetic::{self, Pose, TIME_STEP};

    /// When it moves, when the button is pressed, and when it leaves the ground, s.
    const MOVES: [f64; 2] = [5.0, 35.0];
    const PRESSED: f64 = 50.0;
    const LEAPS: f64 = 50.4;

    /// What is against a puppet that does as it is told, but for a change.
    fn reasons(seconds: f64, change: impl Fn(f64, &mut Pose)) -> Vec<Reason> {
        reasons_told(1.0, seconds, change)
    }

    /// The same, of one that is told this speed while it moves.
    fn reasons_told(speed: f32, seconds: f64, change: impl Fn(f64, &mut Pose)) -> Vec<Reason> {
        let pose = |step: usize| {
            let time = step as f64 * TIME_STEP;
            let [begins, ends] = MOVES;
            let mut pose = match time {
                _ if (begins..ends).contains(&time) => {
                    let walked = Pose::walking(step - (begins / TIME_STEP) as usize);
                    Pose { work: 0.0, ..walked }
                }
                _ if time >= LEAPS - 1.0 => Pose::jumping(step - ((LEAPS - 1.0) / TIME_STEP) as usize),
                _ => Pose::standing(),
            };
            pose.x = (time.min(ends) - begins).max(0.0);
            pose.work = 100.0 * (time + ((time - LEAPS + 0.02) / 0.04).clamp(0.0, 1.0));
            change(time, &mut pose);
            pose
        };
        let body = synthetic::body();
        let mut snapshots = synthetic::film(seconds, pose);
        let mut since_press = f32::INFINITY;
        for snapshot in &mut snapshots {
            let time = f64::from(snapshot.time) + 1e-4;
            let jump = (PRESSED..PRESSED + 0.2).contains(&time);
            since_press = if jump && since_press.is_infinite() { 0.0 } else { since_press + TIME_STEP as f32 };
            let speed = if (MOVES[0]..MOVES[1]).contains(&time) { speed } else { 0.0 };
            snapshot.command = Command { speed, jump, since_press, ..Command::default() };
        }
        let report = GaitReport::measure(&body, &snapshots, Some(&PlayingRules)).expect("a trajectory");
        report.verdict.expect("a verdict").reasons
    }

    fn names(seconds: f64, change: impl Fn(f64, &mut Pose)) -> Vec<String> {
        reasons(seconds, change).iter().map(|reason| reason.name().to_owned()).collect()
    }

    #[test]
    fn what_does_as_it_is_told_is_playable() {
        assert_eq!(reasons(60.0, |_, _| ()), []);
        assert_eq!(names(50.0, |_, _| ()), ["too-short"]);
    }

    #[test]
    fn what_is_never_told_to_move_shows_nothing() {
        let stands = |seconds: f64| reasons_told(0.0, seconds, |_, pose| pose.x = 0.0);
        assert_eq!(stands(60.0), [Reason::NeverToldToMove { required: 0.5 }]);
        let short = stands(54.0);
        assert!(matches!(short[..], [Reason::TooShort { .. }]), "{short:?}");
    }

    #[test]
    fn a_speed_may_be_off_by_a_quarter() {
        let at = |share: f64| names(60.0, move |_, pose| pose.x *= share);
        assert_eq!(at(0.78), Vec::<String>::new());
        assert_eq!(at(0.72), ["slow-answer", "off-speed"]);
        assert_eq!(at(1.3), ["off-speed"]);
    }

    #[test]
    fn a_change_is_answered_within_1_2_seconds() {
        let late =
            |seconds: f64| reasons(60.0, move |time, pose| pose.x = (time.min(MOVES[1]) - MOVES[0] - seconds).max(0.0));
        assert_eq!(late(0.8), []);
        let [Reason::SlowAnswer { time, from, to, changes: 1, of: 2, .. }] = late(1.6)[..] else {
            panic!("{:?}", late(1.6));
        };
        assert!((time - 5.0).abs() < 0.03 && (from, to) == (0.0, 1.0));
    }

    #[test]
    fn what_is_told_to_stand_stays_where_it_is_and_upright() {
        assert_eq!(names(60.0, |time, pose| pose.x += 0.08 * time), Vec::<String>::new());
        assert_eq!(names(60.0, |time, pose| pose.x += 0.14 * time), ["drifting"]);
        let tilted = |degrees: f64| {
            move |time: f64, pose: &mut Pose| {
                // Slowly: what is upright at once gains energy.
                pose.tilt = degrees.to_radians() * (0.2 * (time - 50.0)).clamp(0.0, 1.0);
            }
        };
        assert_eq!(names(60.0, tilted(18.0)), Vec::<String>::new());
        assert_eq!(names(60.0, tilted(25.0)), ["tilted"]);
    }

    #[test]
    fn of_the_last_half_of_a_hold_only_jumps_are_left_out() {
        let moves_two_meters = |from: f64| names(60.0, move |time, pose| pose.x += 2.0 * (time - from).clamp(0.0, 1.0));
        assert_eq!(moves_two_meters(PRESSED - 1.2), ["drifting"]);
        assert_eq!(moves_two_meters(PRESSED + 0.2), Vec::<String>::new());
        assert_eq!(moves_two_meters(PRESSED + 1.7), ["drifting"]);
        let tilted_before = |time: f64, pose: &mut Pose| {
            pose.tilt = 25f64.to_radians() * (0.2 * (time - 41.0).min(53.0 - time)).clamp(0.0, 1.0);
        };
        assert_eq!(names(60.0, tilted_before), ["tilted"]);
        let left = |presses: &[usize]| -> Vec<[usize; 2]> {
            without_jumps(100..200, presses, 30).into_iter().map(|part| [part.start, part.end]).collect()
        };
        assert_eq!(left(&[]), [[100, 200]]);
        assert_eq!(left(&[60, 130, 195]), [[100, 130], [160, 195]]);
        assert_eq!(left(&[90, 110, 200]), [[140, 200]]);
    }

    #[test]
    fn every_press_is_answered_by_a_jump() {
        let earthbound = |time: f64, pose: &mut Pose| {
            if time > 49.0 {
                *pose = Pose { x: pose.x, work: pose.work, ..Pose::standing() };
            }
        };
        assert_eq!(names(60.0, earthbound), ["presses", "no-jump"]);
        let lands_on_its_torso = |time: f64, pose: &mut Pose| pose.touching[0] |= (51.2..51.3).contains(&time);
        assert_eq!(names(60.0, lands_on_its_torso), ["presses", "landed-on"]);
    }

    #[test]
    fn reasons_are_sentences_with_figure_and_limit() {
        let drifts = reasons(60.0, |time, pose| pose.x += 0.2 * time);
        let said = drifts.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n");
        for part in
            ["told to stand from 35.0 s on: moves at 0.20 body lengths/s", "at most 0.1 allowed", "in 2 of 2 holds"]
        {
            assert!(said.contains(part), "{said}");
        }
    }
}
