//! When each part touches the ground: the rows of a footfall diagram after Hildebrand; and when the body is told to jump.

use super::Subject;
use envs_core::body_of;

/// Rows at most: more than this are no longer legible.
const MOST: usize = 24;

/// A row of the diagram.
pub(super) struct Row {
    pub(super) name: String,
    /// When something touches, s: from and to.
    pub(super) spans: Vec<[f64; 2]>,
    /// Whether it should not touch.
    pub(super) alarming: bool,
}

/// The rows of the parts, and one of presses if there are any.
pub(super) fn rows(subject: &Subject<'_>) -> Vec<Row> {
    let presses = spans(subject, |step| subject.snapshots[step].command.jump);
    let told = (!presses.is_empty()).then(|| Row { name: "told to jump".into(), spans: presses, alarming: false });
    told.into_iter().chain(parts(subject)).collect()
}

/// The rows: each leg's foot, and all other parts together if they touch. Of a legless body each part that touches.
fn parts(subject: &Subject<'_>) -> Vec<Row> {
    let parts = subject.blueprint.parts();
    let row = |part: usize| Row {
        name: parts[part].name.clone(),
        spans: spans(subject, |step| subject.snapshots[step].parts[part].touching),
        alarming: false,
    };
    let body = body_of(subject.blueprint);
    let feet: Vec<usize> = body.feet().collect();
    let touches = |part: &usize| subject.snapshots.iter().any(|snapshot| snapshot.parts[*part].touching);
    if body.legless || feet.is_empty() {
        return (0..parts.len()).filter(touches).take(MOST).map(row).collect();
    }
    let others: Vec<usize> = (0..parts.len()).filter(|part| !feet.contains(part) && touches(part)).collect();
    let mut rows: Vec<Row> = feet.iter().copied().take(MOST).map(row).collect();
    if !others.is_empty() {
        let name = match others[..] {
            [other] => parts[other].name.clone(),
            _ => "other parts".into(),
        };
        let touching = |step: usize| others.iter().any(|&part| subject.snapshots[step].parts[part].touching);
        rows.push(Row { name, spans: spans(subject, touching), alarming: true });
    }
    if rows.iter().all(|row| row.spans.is_empty()) { Vec::new() } else { rows }
}

/// When something holds, s. A snapshot speaks of the step that led to it.
fn spans(subject: &Subject<'_>, holds: impl Fn(usize) -> bool) -> Vec<[f64; 2]> {
    let mut spans: Vec<[f64; 2]> = Vec::new();
    let mut held = false;
    for step in 1..=subject.last() {
        let holds = holds(step);
        match spans.last_mut() {
            Some(span) if holds && held => span[1] = subject.time(step),
            _ if holds => spans.push([subject.time(step - 1), subject.time(step)]),
            _ => {}
        }
        held = holds;
    }
    spans
}
