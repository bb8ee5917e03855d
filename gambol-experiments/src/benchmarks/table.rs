use super::{Attempt, BenchmarkTask, Counting, Measured, PUBLISHED, Published};
use std::fmt::Write;

/// What was measured, task by task, beside what is published, as text.
pub fn render(measured: &[Measured]) -> String {
    let mut text = String::new();
    for task in BenchmarkTask::ALL {
        let mine: Vec<&Measured> = measured.iter().filter(|measured| measured.task == task).collect();
        if !mine.is_empty() {
            // Writing to a string does not fail.
            let _ = render_task(&mut text, task, &mine);
        }
    }
    text
}

fn render_task(text: &mut String, task: BenchmarkTask, measured: &[&Measured]) -> std::fmt::Result {
    let tested = if task.has_uncounted_test() {
        "; tested, not counted: all candidates, or the best of a generation"
    } else {
        ""
    };
    writeln!(text, "{}: evaluations to a solution{tested}", task.name())?;
    writeln!(
        text,
        "  {:<20}{:<7}{:>9}{:>9}{:>9}{:>9}{:>9}{:>8}{:>8}{:>8}{:>8}  published mean",
        "strategy", "tested", "mean", "sd", "median", "worst", "solved", "ms", "hidden", "weights", "of 625"
    )?;
    for (place, measured) in measured.iter().enumerate() {
        let tested = match measured.counting {
            _ if !task.has_uncounted_test() => "–",
            Counting::EveryCandidate => "all",
            Counting::BestOfGeneration => "best",
        };
        let sorted = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            values
        };
        let evaluations: Vec<f64> = measured.evaluations().into_iter().map(|count| count as f64).collect();
        let seconds = sorted(measured.attempts.iter().map(|attempt| attempt.seconds).collect());
        let (mean, deviation) = mean_and_deviation(&evaluations);
        writeln!(
            text,
            "  {:<20}{tested:<7}{mean:>9.0}{deviation:>9.0}{:>9.0}{:>9.0}{:>9}{:>8.1}{:>8}{:>8}{:>8}  {}",
            format!("{} [{}]", measured.strategy, place + 1),
            median(&evaluations),
            evaluations.last().copied().unwrap_or_default(),
            format!("{}/{}", measured.solved(), measured.attempts.len()),
            median(&seconds) * 1000.0,
            mean_of(measured, |attempt| attempt.hidden.map(|count| count as f64)),
            mean_of(measured, |attempt| attempt.connections.map(|count| count as f64)),
            mean_of(measured, |attempt| attempt.generalization.map(f64::from)),
            published(task, |published| published.strategy == Some(measured.strategy.as_str())),
        )?;
    }
    let others = published(task, |published| {
        measured.iter().all(|measured| published.strategy != Some(measured.strategy.as_str()))
    });
    writeln!(text, "  published, others: {others}")?;
    for (place, measured) in measured.iter().enumerate() {
        let settings: Vec<String> = measured.settings.iter().map(|(key, value)| format!("{key} {value}")).collect();
        let settings = match settings.is_empty() {
            true => "its defaults".into(),
            false => settings.join(", "),
        };
        writeln!(text, "  [{}] {}: {settings}", place + 1, measured.description)?;
    }
    writeln!(text)
}

/// What papers report on a task, the best first.
fn published(task: BenchmarkTask, wanted: impl Fn(&Published) -> bool) -> String {
    let of_task = PUBLISHED.iter().filter(|published| published.task == task && wanted(published));
    let texts: Vec<String> = of_task.map(|of| format!("{} {} ({})", of.method, of.evaluations, of.source)).collect();
    if texts.is_empty() { "–".into() } else { texts.join(", ") }
}

/// The mean of what the attempts that have it say, or a dash.
fn mean_of(measured: &Measured, of: impl Fn(&Attempt) -> Option<f64>) -> String {
    let values: Vec<f64> = measured.attempts.iter().filter_map(of).collect();
    if values.is_empty() { "–".into() } else { format!("{:.1}", mean_and_deviation(&values).0) }
}

/// Arithmetic mean and sample standard deviation.
fn mean_and_deviation(values: &[f64]) -> (f64, f64) {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let squares: f64 = values.iter().map(|value| (value - mean).powi(2)).sum();
    (mean, if values.len() > 1 { (squares / (count - 1.0)).sqrt() } else { 0.0 })
}

/// The middle of sorted values; with an even number of them the mean of the two in the middle.
fn median(sorted: &[f64]) -> f64 {
    let count = sorted.len();
    if count == 0 { 0.0 } else { (sorted[(count - 1) / 2] + sorted[count / 2]) / 2.0 }
}
