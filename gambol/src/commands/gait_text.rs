//! A gait report as text for people.

use crate::Registry;
use crate::obstacles::ObstaclesPassed;
use std::fmt::Write;
use tasks::gait::{GaitReport, Interval, JointUse, LegUse, NearWorlds};

/// How much of the end the footfall diagram shows, s.
const DIAGRAM_SECONDS: f64 = 3.0;
/// How many characters that takes.
const DIAGRAM_WIDTH: usize = 60;

/// The verdict first, then what was measured, legs, joints and footfalls.
pub(super) fn describe(name: &str, report: &GaitReport, obstacles: &[ObstaclesPassed], registry: &Registry) -> String {
    let mut text = verdict(name, report, registry);
    text.push('\n');
    for (label, value) in measurements(report) {
        line(&mut text, &format!("  {label:<18} {value}"));
    }
    for ObstaclesPassed { kind, passed, of } in obstacles {
        line(&mut text, &format!("  {:<18} {passed} of {of}", kind.passed()));
    }
    table(&mut text, &legs(&report.legs));
    table(&mut text, &joints(&report.joints));
    if !report.legs.is_empty() {
        text.push_str(&footfalls(report));
    }
    text
}

/// Writing to a string cannot fail.
fn line(text: &mut String, line: &str) {
    let _ = writeln!(text, "{}", line.trim_end());
}

fn verdict(name: &str, report: &GaitReport, registry: &Registry) -> String {
    let mut text = String::new();
    match &report.verdict {
        None => {
            let judged: Vec<&str> = registry.movements.judged().collect();
            line(&mut text, &format!("{name}: not judged; only {} are", judged.join(", ")));
        }
        Some(verdict) if verdict.usable => {
            line(&mut text, &format!("{name}: usable"));
            line(
                &mut text,
                &match verdict.near_worlds {
                    Some(NearWorlds { usable, worlds }) => format!("  usable in {usable} of {worlds} near worlds"),
                    None => "  judged alone: near worlds need the champion".into(),
                },
            );
        }
        Some(verdict) => {
            line(&mut text, &format!("{name}: not usable:"));
            verdict.reasons.iter().for_each(|reason| line(&mut text, &format!("  {reason}")));
        }
    }
    // If the gait is not judged, no reasons name its cheats.
    if report.verdict.is_none() {
        report.cheats.iter().for_each(|cheat| line(&mut text, &format!("  {cheat}")));
    }
    text
}

fn measurements(report: &GaitReport) -> Vec<(&'static str, String)> {
    let GaitReport { travel, torso, aloft, rhythm, .. } = report;
    let cost = travel.cost_of_transport.map_or_else(|| "–".into(), |cost| format!("{cost:.2}"));
    let highest = aloft.highest.map_or_else(String::new, |rise| format!(", torso up to {rise:.2} m above its start"));
    let stride = match (rhythm.stride_time, rhythm.progress_per_stride) {
        (Some(time), Some(progress)) => {
            format!("a stride takes {time:.2} s and goes {progress:.2} m, regular to {:.0} %", 100.0 * rhythm.strength)
        }
        _ => "none".into(),
    };
    let rollovers = if torso.rollovers == 1.0 { "rollover" } else { "rollovers" };
    let mut rows = vec![
        (
            if report.view.backwards { "way back" } else { "distance" },
            format!("{:.2} m in {:.2} s", travel.distance, report.duration),
        ),
        ("speed", format!("{:.2} m/s, {:.2} body lengths/s", travel.speed, travel.relative_speed)),
        (
            "  second half",
            format!("{:.2} m/s, {:.2} body lengths/s", travel.second_half_speed, travel.second_half_relative_speed),
        ),
        ("cost of transport", cost),
        (
            "torso",
            format!(
                "tilts by up to {:.0}° (at {:.1} s), {} {rollovers}",
                torso.largest_tilt, torso.largest_tilt_at, torso.rollovers
            ),
        ),
        (
            "off the ground",
            format!("{:.0} % of the time, at most {:.2} s{highest}", 100.0 * aloft.share, aloft.longest),
        ),
        ("rhythm", stride),
    ];
    rows.extend(report.best_flight().map(|flight| {
        let (from, seconds) = (flight.interval.from, flight.interval.seconds());
        ("best jump", format!("at {from:.2} s, {seconds:.2} s in the air, {:.2} m high", flight.rise))
    }));
    rows
}

fn legs(legs: &[LegUse]) -> Vec<Vec<String>> {
    let header = ["leg", "footfalls", "stands", "slip", "rests at most", "joints"].map(str::to_owned).to_vec();
    let row = |leg: &LegUse| {
        let longest = leg.longest_without_touchdown.max(leg.longest_without_liftoff);
        let joints: Vec<_> = leg.joints.iter().map(|joint| format!("{:.0}°", joint.range.to_degrees())).collect();
        vec![
            leg.foot.clone(),
            leg.footfalls.to_string(),
            format!("{:.0} %", 100.0 * leg.duty_factor),
            leg.slip_per_distance.map_or_else(|| format!("{:.2} m", leg.slip), |slip| format!("{slip:.2} m/m")),
            format!("{longest:.2} s"),
            if joints.is_empty() { "–".into() } else { joints.join(" ") },
        ]
    };
    if legs.is_empty() { Vec::new() } else { [header].into_iter().chain(legs.iter().map(row)).collect() }
}

fn joints(joints: &[JointUse]) -> Vec<Vec<String>> {
    let header = ["joint", "range", "swings at", "by", "turns back", "acceleration"].map(str::to_owned).to_vec();
    let row = |joint: &JointUse| {
        let passive = if joint.actuated { "" } else { " (passive)" };
        vec![
            format!("{}{passive}", joint.name),
            format!("{:.0}°", joint.range),
            format!("{:.2} Hz", joint.dominant_frequency),
            format!("± {:.0}°", joint.dominant_amplitude),
            format!("{:.1} /s", joint.reversals),
            format!("{:.0} rad/s²", joint.rms_acceleration),
        ]
    };
    if joints.is_empty() { Vec::new() } else { [header].into_iter().chain(joints.iter().map(row)).collect() }
}

/// Columns as wide as they need to be: the first to the left, numbers to the right.
fn table(text: &mut String, rows: &[Vec<String>]) {
    let Some(header) = rows.first() else { return };
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..header.len()).map(width).collect();
    text.push('\n');
    for row in rows {
        let cell = |(column, cell): (usize, &String)| {
            let width = widths[column];
            if column == 0 { format!("  {cell:<width$}") } else { format!("  {cell:>width$}") }
        };
        line(text, &row.iter().enumerate().map(cell).collect::<String>());
    }
}

/// A footfall diagram after Hildebrand: a row a leg, filled while its foot stands.
fn footfalls(report: &GaitReport) -> String {
    let seconds = DIAGRAM_SECONDS.min(report.duration);
    let from = report.duration - seconds;
    let name_width = report.legs.iter().map(|leg| leg.foot.chars().count()).max().unwrap_or(0);
    let mut text = format!("\n  footfalls, the last {seconds:.1} s\n");
    for leg in &report.legs {
        let stands = |cell: usize| {
            let [begin, middle, end] =
                [0.0, 0.5, 1.0].map(|share| from + (cell as f64 + share) / DIAGRAM_WIDTH as f64 * seconds);
            // A stance that is shorter than a character has one all the same.
            let is_seen = |stance: &Interval| {
                (stance.from..stance.to).contains(&middle) || (begin..end).contains(&(0.5 * (stance.from + stance.to)))
            };
            leg.stances.iter().any(is_seen)
        };
        let row: String = (0..DIAGRAM_WIDTH).map(|cell| if stands(cell) { '█' } else { '·' }).collect();
        line(&mut text, &format!("  {:<name_width$}  {row}", leg.foot));
    }
    let (first, last) = (format!("{from:.1} s"), format!("{:.1} s", report.duration));
    let room = DIAGRAM_WIDTH - last.chars().count();
    line(&mut text, &format!("  {:<name_width$}  {first:<room$}{last}", ""));
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use tasks::{Body, BodyPart, PartState, Snapshot, gait::Trajectory};

    /// A lone foot that stands in every other 0.2 s.
    fn report() -> GaitReport {
        standing(20, 10)
    }

    /// A lone foot that stands in so many steps of each stride.
    fn standing(stride: u16, stance: u16) -> GaitReport {
        let part = BodyPart { name: "foot".into(), mass: 1.0, corners: vec![[0.0, 0.0]], ..BodyPart::default() };
        let body =
            Body { body_length: 1.0, start_height: 1.0, parts: vec![part], legs: vec![vec![0]], ..Body::default() };
        let snapshot = |step: u16| {
            let state = PartState { y: 1.0, cos: 1.0, touching: step % stride < stance, ..PartState::default() };
            Snapshot { time: f32::from(step) * 0.02, parts: vec![state], motor_work: 0.0, ..Snapshot::default() }
        };
        let film: Vec<Snapshot> = (0..=200).map(snapshot).collect();
        GaitReport::of(&Trajectory::new(&body, &film).expect("a script"), Some(&tasks::gait::RunningRules::default()))
    }

    #[test]
    fn short_stances_are_drawn_too() {
        let text = footfalls(&standing(25, 2));
        assert_eq!(text.matches('█').count(), 7, "{text}");
    }

    #[test]
    fn the_verdict_comes_first_and_the_footfalls_last() {
        let text = describe("hopper running", &report(), &[], &Registry::default());
        assert!(text.starts_with("hopper running: not usable:\n  the episode lasted 4.0 s"), "{text}");
        let diagram: Vec<&str> = text.lines().rev().take(3).collect();
        assert_eq!(diagram[2], "  footfalls, the last 3.0 s");
        let row = diagram[1].strip_prefix("  foot  ").expect("a row of its name");
        assert_eq!(row.chars().count(), DIAGRAM_WIDTH);
        // 0.2 s are four characters.
        assert!(row.contains("·████····████·"), "{row}");
        assert!(diagram[0].ends_with("4.0 s") && diagram[0].contains("1.0 s"), "{text}");
    }
}
