use super::{Movement, Verdict};
use crate::{Body, Snapshot};

/// Several movements, weighted and added: running minus a hundredth of the energy, say.
///
/// Its name and unit are those of the first movement; the weights carry the units that make the sum one (metres per
/// joule). The episode ends when any of them says so.
///
/// ```
/// use tasks::{Energy, Movement, Running, Sum};
/// let thrifty = Sum::of(Running::default()).plus(-0.01, Energy::default());
/// assert_eq!(thrifty.name(), "running");
/// ```
#[derive(Clone)]
pub struct Sum {
    terms: Vec<(f64, Box<dyn Movement>)>,
}

impl Sum {
    /// One movement, with weight 1.
    pub fn of(movement: impl Movement + 'static) -> Self {
        Self::of_boxed(Box::new(movement))
    }

    /// One movement, with weight 1.
    pub fn of_boxed(movement: Box<dyn Movement>) -> Self {
        Self { terms: vec![(1.0, movement)] }
    }

    /// The same sum and another movement.
    #[must_use]
    pub fn plus(self, weight: f64, movement: impl Movement + 'static) -> Self {
        self.plus_boxed(weight, Box::new(movement))
    }

    /// The same sum and another movement.
    #[must_use]
    pub fn plus_boxed(mut self, weight: f64, movement: Box<dyn Movement>) -> Self {
        self.terms.push((weight, movement));
        self
    }
}

impl Movement for Sum {
    fn name(&self) -> &str {
        self.terms[0].1.name()
    }

    fn unit(&self) -> &str {
        self.terms[0].1.unit()
    }

    fn bind(&mut self, body: &Body) {
        for (_, movement) in &mut self.terms {
            movement.bind(body);
        }
    }

    fn begin(&mut self, start: &Snapshot) {
        for (_, movement) in &mut self.terms {
            movement.begin(start);
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let mut verdict = Verdict::GoOn;
        for (_, movement) in &mut self.terms {
            match (movement.observe(now), verdict) {
                (Verdict::GoOn, _) | (_, Verdict::Fail(_)) => {}
                (stricter, _) => verdict = stricter,
            }
        }
        verdict
    }

    fn value(&self) -> f64 {
        self.terms.iter().map(|(weight, movement)| weight * movement.value()).sum()
    }

    fn measurements(&self, tell: &mut dyn FnMut(&str, f64)) {
        for (_, movement) in &self.terms {
            movement.measurements(tell);
        }
    }
}
