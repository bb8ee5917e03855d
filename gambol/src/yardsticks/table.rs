use super::{Measured, PUBLISHED, Published, Yardstick};
use std::fmt::Write;

/// What was measured, task by task, beside what is published, as text.
pub fn render(measured: &[Measured]) -> String {
    let mut text = String::new();
    for task in Yardstick::ALL {
        let mine: Vec<&Measured> = measured.iter().filter(|measured| measured.task == task).collect();
        if !mine.is_empty() {
            // Writing to a string does not fail.
            let _ = render_task(&mut text, task, &mine);
        }
    }
    text
}

fn render_task(text: &mut String, task: Yardstick, measured: &[&Measured]) -> std::fmt::Result {
    writeln!(text, "{}: evaluations to a solution", task.name())?;
    writeln!(
        text,
        "  {:<14}{:>10}{:>10}{:>10}{:>10}{:>10}{:>10}{:>8}  published mean",
        "strategy", "mean", "sd", "median", "worst", "solved", "ms", "of 625"
    )?;
    for measured in measured {
        let evaluations = measured.evaluations();
        let (mean, deviation) = mean_and_deviation(&evaluations);
        let mut milliseconds: Vec<f64> = measured.attempts.iter().map(|attempt| attempt.seconds * 1000.0).collect();
        milliseconds.sort_by(f64::total_cmp);
        let starts: Vec<u64> =
            measured.attempts.iter().filter_map(|attempt| attempt.generalization.map(u64::from)).collect();
        let starts = if starts.is_empty() { "–".into() } else { format!("{:.0}", mean_and_deviation(&starts).0) };
        writeln!(
            text,
            "  {:<14}{mean:>10.0}{deviation:>10.0}{:>10}{:>10}{:>10}{:>10.1}{starts:>8}  {}",
            measured.strategy,
            middle(&evaluations).map_or_else(|| "–".into(), |median| median.to_string()),
            evaluations.last().map_or_else(|| "–".into(), u64::to_string),
            format!("{}/{}", measured.solved(), measured.attempts.len()),
            middle(&milliseconds).unwrap_or_default(),
            published(task, |published| published.strategy == Some(measured.strategy.as_str())),
        )?;
        writeln!(text, "    {}", measured.description)?;
    }
    let others = published(task, |published| {
        measured.iter().all(|measured| published.strategy != Some(measured.strategy.as_str()))
    });
    writeln!(text, "  published, others: {others}\n")
}

/// What papers report on a task, the best first.
fn published(task: Yardstick, wanted: impl Fn(&Published) -> bool) -> String {
    let of_task = PUBLISHED.iter().filter(|published| published.task == task && wanted(published));
    let texts: Vec<String> = of_task.map(|of| format!("{} {} ({})", of.method, of.evaluations, of.source)).collect();
    if texts.is_empty() { "–".into() } else { texts.join(", ") }
}

/// Arithmetic mean and sample standard deviation.
fn mean_and_deviation(values: &[u64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().map(|&value| value as f64).sum::<f64>() / count;
    let squares: f64 = values.iter().map(|&value| (value as f64 - mean).powi(2)).sum();
    (mean, if values.len() > 1 { (squares / (count - 1.0)).sqrt() } else { 0.0 })
}

/// The middle of sorted values; with an even number of them the lower of the two in the middle.
fn middle<T: Copy>(sorted: &[T]) -> Option<T> {
    sorted.get(sorted.len().saturating_sub(1) / 2).copied()
}
