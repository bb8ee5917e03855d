//! Vector environments: what Python's `gambol.VectorEnv` steps.

use crate::{
    episodes::Described,
    errors::{check_threads, wrong},
    group::{Autoreset, Finished, Group, Rows},
    layout::{Layout, Wanted},
    movements,
    stage::stage,
};
use gambol_reports::drawing::Painter;
use gambol_runs::request::Request;
use ne_core::Failure;
use numpy::{
    PyArray1, PyArray2, PyArray3, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2, PyReadwriteArray1,
    PyReadwriteArray2,
};
use pyo3::{exceptions::PyRuntimeError, prelude::*};
use rayon::{ThreadPool, ThreadPoolBuilder, prelude::*};
use std::sync::{Arc, OnceLock};

/// The most environments. Each takes some 6 kB, so that these take gigabytes.
const MOST_ENVIRONMENTS: usize = 1 << 20;

/// Environments of one creature and one movement, stepped together.
#[pyclass(module = "gambol._gambol")]
pub(crate) struct Environments {
    groups: Vec<Group>,
    together: usize,
    count: usize,
    autoreset: Autoreset,
    /// One thread: the caller's.
    pool: Pool,
    described: Described,
    layout: Option<Arc<Layout>>,
    /// Made for the first frame.
    painter: OnceLock<Painter>,
}

/// An episode that has ended: the number of the environment, the fitness (NaN if it failed), and why it failed.
type Ended = (usize, f64, Option<String>);

#[pymethods]
impl Environments {
    /// `steps`: the longest an episode lasts, `None` for the movement's own length; `settings`: `key=value`; `threads`: 0 for
    /// one for each core; `layout`: what is shown of the senses, `None` for all as they are.
    #[new]
    #[pyo3(signature = (creature, movement, count, *, preset, terrain, variation, engine, steps, settings, autoreset, threads, layout))]
    #[expect(clippy::too_many_arguments, reason = "Python calls it by keyword")]
    fn new(
        py: Python<'_>,
        creature: String,
        movement: String,
        count: usize,
        preset: Option<String>,
        terrain: Option<String>,
        variation: Option<String>,
        engine: Option<String>,
        steps: Option<u32>,
        settings: Vec<String>,
        autoreset: &str,
        threads: usize,
        layout: Option<Vec<Wanted>>,
    ) -> PyResult<Self> {
        let autoreset = match autoreset {
            "NextStep" => Autoreset::NextStep,
            "SameStep" => Autoreset::SameStep,
            "Disabled" => Autoreset::Disabled,
            other => return Err(wrong(format!("autoreset_mode = {other}: must be NextStep, SameStep or Disabled"))),
        };
        if !(1..=MOST_ENVIRONMENTS).contains(&count) {
            return Err(wrong(format!("num_envs = {count}: must be from 1 to {MOST_ENVIRONMENTS}")));
        }
        check_threads(threads)?;
        // What is said by an argument is what counts, as in training.
        let steps = steps.map(|steps| format!("movement.steps={steps}"));
        let set = settings.into_iter().chain(steps).collect();
        let request = Request {
            creature: Some(creature),
            movement: Some(movement),
            preset,
            terrain,
            variation,
            engine,
            set,
            ..Request::default()
        };
        py.detach(|| {
            let described = Described::build(&request).map_err(wrong)?;
            let channels = described.episodes.senses().channels();
            let layout = layout.map(|wanted| Layout::new(&wanted, channels, described.input_range));
            let layout = layout.transpose().map_err(wrong)?.map(Arc::new);
            let together = described.episodes.together();
            let (inputs, _) = described.episodes.shape();
            let group = |first| {
                let places = together.min(count - first);
                Group::new(stage(&described.episodes), first, places, layout.clone(), inputs)
            };
            let groups: Vec<Group> = (0..count).step_by(together).map(group).collect();
            let threads = match threads {
                0 => std::thread::available_parallelism().map_or(1, usize::from),
                threads => threads,
            };
            let pool = Pool { threads: threads.min(groups.len()), made: None };
            Ok(Self { groups, together, count, autoreset, pool, described, layout, painter: OnceLock::new() })
        })
    }

    /// Begins episodes: of every environment with a seed its first; of those without the next. `mask`: the environments that
    /// are meant. Writes what all sense.
    fn reset(
        &mut self,
        py: Python<'_>,
        seeds: Vec<Option<u64>>,
        mask: Option<PyReadonlyArray1<'_, bool>>,
        mut observations: PyReadwriteArray2<'_, f32>,
    ) -> PyResult<()> {
        let mask = mask.as_ref().map(|mask| mask.as_slice()).transpose()?;
        self.check("seeds", seeds.len())?;
        mask.map_or(Ok(()), |mask| self.check("reset_mask", mask.len()))?;
        let (inputs, _) = self.shape();
        let observations = self.rows("observations", observations.as_slice_mut()?, inputs)?;
        let Self { groups, together, pool, .. } = self;
        let pool = pool.here()?;
        let reset = |(index, (group, rows)): (usize, (&mut Group, &mut [f32]))| {
            for place in 0..group.len() {
                let environment = index * *together + place;
                if mask.is_none_or(|mask| mask[environment]) {
                    group.reset(place, seeds[environment])?;
                }
            }
            group.observe(rows);
            Ok::<(), Failure>(())
        };
        let size = *together * inputs;
        py.detach(|| match pool {
            None => groups.iter_mut().zip(observations.chunks_mut(size)).enumerate().try_for_each(reset),
            Some(pool) => pool.install(|| {
                groups.par_iter_mut().zip(observations.par_chunks_mut(size)).enumerate().try_for_each(reset)
            }),
        })
        .map_err(failed)?;
        movements::raised(&self.described.movements)
    }

    /// A step of all environments, written into the arrays. Returns the episodes that have ended.
    #[expect(clippy::too_many_arguments, reason = "each is an array that is written in place")]
    fn step(
        &mut self,
        py: Python<'_>,
        actions: PyReadonlyArray2<'_, f32>,
        mut observations: PyReadwriteArray2<'_, f32>,
        mut last_observations: PyReadwriteArray2<'_, f32>,
        mut rewards: PyReadwriteArray1<'_, f64>,
        mut terminated: PyReadwriteArray1<'_, bool>,
        mut truncated: PyReadwriteArray1<'_, bool>,
    ) -> PyResult<Vec<Ended>> {
        let (inputs, outputs) = self.shape();
        if self.autoreset == Autoreset::Disabled
            && let Some(environment) = self.groups.iter().flat_map(Group::over).next()
        {
            let message = "has ended: with autoreset disabled, reset it first, with options={\"reset_mask\": ...}";
            return Err(wrong(format!("the episode of environment {environment} {message}")));
        }
        let actions = actions.as_slice()?;
        if actions.len() != self.count * outputs {
            return Err(wrong(format!("actions: must be of shape ({}, {outputs})", self.count)));
        }
        let observations = self.rows("observations", observations.as_slice_mut()?, inputs)?;
        let last_observations = self.rows("last observations", last_observations.as_slice_mut()?, inputs)?;
        let rewards = self.rows("rewards", rewards.as_slice_mut()?, 1)?;
        let terminated = self.rows("terminated", terminated.as_slice_mut()?, 1)?;
        let truncated = self.rows("truncated", truncated.as_slice_mut()?, 1)?;
        let Self { groups, together, autoreset, pool, .. } = self;
        let pool = pool.here()?;
        let (together, autoreset) = (*together, *autoreset);
        // The same on this thread and on several.
        macro_rules! step_all {
            ($iter_mut:ident, $chunks:ident, $chunks_mut:ident) => {
                groups
                    .$iter_mut()
                    .zip(actions.$chunks(together * outputs))
                    .zip(observations.$chunks_mut(together * inputs))
                    .zip(last_observations.$chunks_mut(together * inputs))
                    .zip(rewards.$chunks_mut(together))
                    .zip(terminated.$chunks_mut(together))
                    .zip(truncated.$chunks_mut(together))
                    .map(
                        |(
                            (((((group, actions), observations), last_observations), rewards), terminated),
                            truncated,
                        )| {
                            let mut rows = Rows { observations, last_observations, rewards, terminated, truncated };
                            group.step(actions, &mut rows, autoreset)
                        },
                    )
                    .filter(|ended| ended.as_ref().map_or(true, |ended| !ended.is_empty()))
                    .collect()
            };
        }
        let finished: Result<Vec<Vec<Finished>>, Failure> = py.detach(|| match pool {
            None => step_all!(iter_mut, chunks, chunks_mut),
            Some(pool) => pool.install(|| step_all!(par_iter_mut, par_chunks, par_chunks_mut)),
        });
        movements::raised(&self.described.movements)?;
        let ended = |it: Finished| match it.outcome {
            Ok(fitness) => (it.environment, fitness, None),
            Err(failure) => (it.environment, f64::NAN, Some(failure.to_string())),
        };
        Ok(finished.map_err(failed)?.into_iter().flatten().map(ended).collect())
    }

    /// What the movement is worth so far in an environment, in its unit; before the first step 0.
    fn value(&self, environment: usize) -> PyResult<f64> {
        let (group, place) = self.place(environment)?;
        Ok(group.value(place))
    }

    /// Where the parts of a creature are: a row for each, x and y of its centre, m, and its angle, rad.
    fn parts<'py>(&self, py: Python<'py>, environment: usize) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let (group, place) = self.place(environment)?;
        let rows: Vec<Vec<f32>> = group.parts(place).map(Vec::from).collect();
        Ok(PyArray2::from_vec2(py, &rows)?)
    }

    /// A picture of a creature where it is, of this many pixels: `uint8[height, width, 3]`.
    fn frame<'py>(
        &self,
        py: Python<'py>,
        environment: usize,
        width: u32,
        height: u32,
    ) -> PyResult<Bound<'py, PyArray3<u8>>> {
        let (group, place) = self.place(environment)?;
        let (pose, episodes) = (group.snapshot(place), &self.described.episodes);
        if pose.parts.is_empty() {
            return Err(wrong(format!("environment {environment}: there is nothing to draw before its first reset")));
        }
        let pixels = py.detach(|| {
            let painter = self.painter.get_or_init(|| Painter::new(episodes.blueprint()));
            let framing = painter.follow(pose, [width, height]);
            painter.paint_in_world(pose, &framing, &episodes.landscape(group.seed(place)).ground)
        });
        let pixels = PyArray1::from_vec(py, pixels.map_err(wrong)?);
        pixels.reshape([height as usize, width as usize, 3])
    }

    /// How many numbers an environment shows of what its creature senses, and how many motors it has.
    #[getter]
    fn shape(&self) -> (usize, usize) {
        let (inputs, outputs) = self.described.episodes.shape();
        (self.layout.as_ref().map_or(inputs, |layout| layout.len()), outputs)
    }

    /// Sensors are scaled to ± this.
    #[getter]
    fn input_range(&self) -> f32 {
        self.described.input_range
    }

    /// The longest an episode lasts, in steps.
    #[getter]
    fn episode_steps(&self) -> u32 {
        self.described.episodes.steps()
    }

    /// Seconds a step lasts, before variation.
    #[getter]
    fn time_step(&self) -> f32 {
        self.described.episodes.time_step()
    }

    /// The unit of the fitness and of rewards.
    #[getter]
    fn unit(&self) -> &str {
        &self.described.unit
    }

    /// What steps the environments: `baseline`, `avx2`, `avx-512` or `rapier`.
    #[getter]
    fn stepped_by(&self) -> &'static str {
        self.described.episodes.stepped_by()
    }

    /// How many threads step them.
    #[getter]
    fn threads(&self) -> usize {
        self.pool.threads.max(1)
    }

    /// The whole configuration, as JSON.
    #[getter]
    fn config(&self) -> &str {
        &self.described.config
    }

    /// The names and the units of the senses that are shown, and those of the motors.
    #[getter]
    fn channels(&self) -> [Vec<(String, String)>; 2] {
        let [senses, motors] = self.described.episodes.channels();
        match &self.layout {
            None => [senses, motors],
            Some(layout) => [layout.pick(&senses), motors],
        }
    }
}

impl Environments {
    fn check(&self, what: &str, found: usize) -> PyResult<()> {
        let count = self.count;
        if found == count { Ok(()) } else { Err(wrong(format!("{what}: must be {count}, found {found}"))) }
    }

    /// An array that has a row of so many numbers for each environment.
    fn rows<'a, T>(&self, what: &str, rows: &'a mut [T], width: usize) -> PyResult<&'a mut [T]> {
        self.check(what, rows.len() / width.max(1)).map(|()| rows)
    }

    fn place(&self, environment: usize) -> PyResult<(&Group, usize)> {
        if environment >= self.count {
            return Err(wrong(format!("environment {environment}: there are {}, counted from 0", self.count)));
        }
        Ok((&self.groups[environment / self.together], environment % self.together))
    }
}

/// Something that no caller did wrong.
fn failed(error: impl ToString) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// Threads of a process: in one that was forked from it they are gone, and others are made.
struct Pool {
    threads: usize,
    made: Option<(u32, ThreadPool)>,
}

impl Pool {
    /// Those of this process; `None` if one is enough.
    fn here(&mut self) -> PyResult<Option<&ThreadPool>> {
        let process = std::process::id();
        if self.threads > 1 && self.made.as_ref().is_none_or(|(of, _)| *of != process) {
            let pool = ThreadPoolBuilder::new().num_threads(self.threads).build().map_err(failed)?;
            std::mem::forget(self.made.take());
            self.made = Some((process, pool));
        }
        Ok(self.made.as_ref().map(|(_, pool)| pool))
    }
}
