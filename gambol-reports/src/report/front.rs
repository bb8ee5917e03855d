//! The front of a search for several objectives: where its points lie, and how each moves.

use super::{data::Replay, replays::Stills, spread};
use gambol_runs::front::{Front, SavedPoint};
use ne_core::Fitness;
use rayon::prelude::*;
use serde::Serialize;

/// How many points can be played.
const POINTS: usize = 40;

#[derive(Serialize)]
pub(super) struct FrontData {
    objectives: Vec<ObjectiveData>,
    /// How many points the front has; the page has them all or as many as it can play, evenly spread.
    total: usize,
    points: Vec<PointData>,
    /// What to type to have the trajectory of a point, its number left out.
    command: String,
}

#[derive(Serialize)]
struct ObjectiveData {
    name: String,
    unit: String,
    less_is_better: bool,
}

#[derive(Serialize)]
struct PointData {
    /// Its place in the file, from 1.
    number: usize,
    generation: u64,
    fitness: f64,
    /// What was measured in training, in the units of the objectives.
    values: Vec<f64>,
    /// The same in the world and the episode champions are judged in, if those are others; `None` also where it fails
    /// there.
    #[serde(skip_serializing_if = "Option::is_none")]
    judged: Option<Vec<f64>>,
    replay: Replay,
}

impl FrontData {
    /// Plays the points; nothing where there is nothing to choose between.
    pub(super) fn new(front: &Front, stills: &Stills<'_>, command: String) -> Option<Self> {
        if front.objectives.len() < 2 || front.points.is_empty() {
            return None;
        }
        let objectives = front.objectives.iter().map(|objective| ObjectiveData {
            name: objective.name.clone(),
            unit: objective.unit.clone(),
            less_is_better: objective.weight < 0.0,
        });
        let measured = |values: &[Fitness]| {
            let values = values.iter().zip(&front.objectives);
            // Never −0.
            values.map(|(value, objective)| value.get() / objective.weight + 0.0).collect()
        };
        let numbered: Vec<(usize, &SavedPoint)> = (1..).zip(&front.points).collect();
        let point = |&&(number, point): &&(usize, &SavedPoint)| PointData {
            number,
            generation: point.generation,
            fitness: point.fitness.get(),
            values: measured(&point.objectives),
            judged: stills.judged(&point.network).and_then(|judged| Some(measured(&judged.objectives()?))),
            replay: stills.found(&point.network, point.generation),
        };
        let shown = spread(&numbered.iter().collect::<Vec<_>>(), POINTS);
        let points = shown.par_iter().map(point).collect();
        Some(Self { objectives: objectives.collect(), total: front.points.len(), points, command })
    }
}
