use super::{Movement, Verdict};
use crate::{Body, Snapshot};

/// A movement, and beside it what is measured for a search with several objectives.
///
/// The objectives only watch: value, measurements and the end of the episode are those of the movement, whatever they
/// see. An end or a failure that an objective calls for is left to a term of weight 0.
#[derive(Clone)]
pub struct Objectives {
    movement: Box<dyn Movement>,
    objectives: Vec<(f64, Box<dyn Movement>)>,
}

impl Objectives {
    /// This movement, with no objectives yet.
    pub fn beside(movement: Box<dyn Movement>) -> Self {
        Self { movement, objectives: Vec::new() }
    }

    /// The same with one objective more: the value of `measured` times `weight`, to be maximised.
    #[must_use]
    pub fn and(mut self, weight: f64, measured: Box<dyn Movement>) -> Self {
        self.objectives.push((weight, measured));
        self
    }
}

impl Movement for Objectives {
    fn name(&self) -> &str {
        self.movement.name()
    }

    fn unit(&self) -> &str {
        self.movement.unit()
    }

    fn bind(&mut self, body: &Body) {
        self.movement.bind(body);
        for (_, objective) in &mut self.objectives {
            objective.bind(body);
        }
    }

    fn begin(&mut self, start: &Snapshot) {
        self.movement.begin(start);
        for (_, objective) in &mut self.objectives {
            objective.begin(start);
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        for (_, objective) in &mut self.objectives {
            objective.observe(now);
        }
        self.movement.observe(now)
    }

    fn value(&self) -> f64 {
        self.movement.value()
    }

    fn measurements(&self, tell: &mut dyn FnMut(&str, f64)) {
        self.movement.measurements(tell);
    }

    fn objectives(&self, tell: &mut dyn FnMut(f64)) {
        self.objectives.iter().for_each(|(weight, objective)| tell(weight * objective.value()));
    }
}
