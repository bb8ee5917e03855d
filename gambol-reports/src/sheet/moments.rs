//! Which moments of an episode the frames show.

use super::{FRAMES, Subject};
use tasks::gait::{Flight, Goal};

/// Without a rhythm so much is shown, s.
const SECONDS: f64 = 1.0;
/// A stride is taken from the end of the episode, this long, s: the part that charts show large.
pub(super) const CLOSE_UP: f64 = 5.0;
/// How long before take-off a jump begins, and how long after landing it ends, s.
const BEFORE: f64 = 0.3;
const AFTER: f64 = 0.5;
/// A torso tilted so far lies, rad.
const LYING: f32 = std::f32::consts::FRAC_PI_3;

/// The moments of the frames.
pub(super) struct Moments {
    /// The snapshots to show, in order of time.
    pub(super) steps: Vec<usize>,
    /// From when to when they are, s; without the end, if that is shown as well.
    pub(super) span: [f64; 2],
    /// Whether the last one is the end of the episode, because the body lies there.
    pub(super) lies_at_end: bool,
    /// What they show.
    pub(super) caption: String,
}

impl Moments {
    pub(super) fn choose(subject: &Subject<'_>) -> Self {
        let jump = (subject.report.view.goal == Goal::Height).then(|| flight(subject)).flatten();
        let (caption, [from, to], closed) = match jump {
            Some(flight) => jump_of(subject, flight),
            None => stride(subject),
        };
        let lies_at_end = lies_at_end(subject);
        let count = if lies_at_end { FRAMES - 1 } else { FRAMES };
        // The end of a stride is the beginning of the next.
        let gaps = if closed { count - 1 } else { count };
        let time = |frame: usize| from + (to - from) * frame as f64 / gaps as f64;
        let mut steps: Vec<usize> = (0..count).map(|frame| subject.step_at(time(frame))).collect();
        steps.extend(lies_at_end.then(|| subject.last()));
        Self { steps, span: [from, to], lies_at_end, caption }
    }
}

/// The flight to show: the best, or the highest if none is usable.
fn flight<'a>(subject: &Subject<'a>) -> Option<&'a Flight> {
    let flights = &subject.report.aloft.flights;
    subject.report.best_flight().or_else(|| flights.iter().max_by(|one, other| one.rise.total_cmp(&other.rise)))
}

fn jump_of(subject: &Subject<'_>, flight: &Flight) -> (String, [f64; 2], bool) {
    let best = subject.report.best_flight().is_some();
    let caption = format!(
        "the {} jump, {:.2} s in the air from {:.2} s on",
        if best { "best" } else { "highest" },
        flight.interval.seconds(),
        flight.interval.from
    );
    let span = [(flight.interval.from - BEFORE).max(0.0), (flight.interval.to + AFTER).min(subject.duration())];
    (caption, span, true)
}

fn stride(subject: &Subject<'_>) -> (String, [f64; 2], bool) {
    let duration = subject.duration();
    let rhythm = subject.report.rhythm.stride_time;
    let seconds = rhythm.unwrap_or(SECONDS).min(duration);
    let (earliest, latest) = ((0.5 * duration).max(duration - CLOSE_UP), duration - seconds);
    let leg = subject.report.legs.first();
    let touchdowns = leg.iter().flat_map(|leg| &leg.stances).map(|stance| stance.from);
    let touchdown = touchdowns.filter(|time| (earliest..=latest).contains(time)).reduce(f64::min);
    let mut caption = match rhythm {
        Some(_) => format!("one stride of {seconds:.2} s"),
        None => format!("{seconds:.2} s, for there is no rhythm"),
    };
    if let (Some(_), Some(leg)) = (touchdown, leg) {
        caption.push_str(&format!(", from a touchdown of {} on", leg.foot));
    }
    // A part that touches in a snapshot came down in the step before it.
    let from = touchdown.map_or(earliest.min(latest), |time| (time + subject.report.time_step).min(latest));
    (caption, [from, from + seconds], false)
}

/// Whether the torso lies at the end: tilted far, or on the ground if it was not at the start.
fn lies_at_end(subject: &Subject<'_>) -> bool {
    let (start, end) = (subject.snapshots[0].torso(), subject.snapshots[subject.last()].torso());
    let turn = libm::atan2f(start.cos * end.sin - start.sin * end.cos, start.cos * end.cos + start.sin * end.sin);
    !subject.in_water() && (turn.abs() >= LYING || (end.touching && !start.touching))
}
