/// The worst of a row of figures, one a snapshot.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Worst {
    pub(super) figure: f64,
    pub(super) snapshot: usize,
}

/// The largest figure.
pub(super) fn worst(figures: impl Iterator<Item = f64>) -> Option<Worst> {
    figures
        .enumerate()
        .map(|(snapshot, figure)| Worst { figure, snapshot })
        .reduce(|worst, next| if next.figure > worst.figure { next } else { worst })
}

/// The largest figure, if two in a row exceed the threshold, or one exceeds three times the threshold: an engine's
/// error of a single step is mended in the next.
pub(super) fn sustained(figures: impl Iterator<Item = f64> + Clone, threshold: f64) -> Option<Worst> {
    sustained_or_beyond(figures, threshold, 3.0 * threshold)
}

/// The largest figure, if two in a row exceed the threshold, or one exceeds the most that is allowed for a step.
pub(super) fn sustained_or_beyond(
    figures: impl Iterator<Item = f64> + Clone,
    threshold: f64,
    most: f64,
) -> Option<Worst> {
    let worst = worst(figures.clone())?;
    let twice = figures.clone().zip(figures.skip(1)).any(|(one, next)| one.min(next) > threshold);
    (twice || worst.figure > most).then_some(worst)
}
