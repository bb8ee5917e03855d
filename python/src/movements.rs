//! Movements written in Python: each step of each creature calls Python, which is slow.

use crate::{episodes::register, errors::wrong};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;
use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};
use tasks::{Movement, Verdict};

/// What a movement sees.
#[pyclass(module = "gambol._gambol", frozen)]
pub(crate) struct Snapshot(tasks::Snapshot);

#[pymethods]
impl Snapshot {
    /// Seconds since the episode began.
    #[getter]
    fn time(&self) -> f32 {
        self.0.time
    }

    /// Work of all motors so far, J.
    #[getter]
    fn motor_work(&self) -> f64 {
        self.0.motor_work
    }

    /// A row for each part, the torso first: x, y, cosine, sine, vx, vy, spin, and 1 where it touches the ground.
    #[getter]
    fn parts<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f32>>> {
        let row = |part: &tasks::PartState| {
            [part.x, part.y, part.cos, part.sin, part.vx, part.vy, part.spin, f32::from(u8::from(part.touching))]
        };
        let numbers: Vec<f32> = self.0.parts.iter().flat_map(row).collect();
        PyArray1::from_vec(py, numbers).reshape([self.0.parts.len(), 8])
    }
}

/// Adds a movement to those that can be named. `make`: called without arguments for each creature; what it returns has the methods
/// `begin`, `observe` and `value`.
#[pyfunction]
pub(crate) fn register_movement(
    py: Python<'_>,
    name: String,
    unit: String,
    steps: Option<u32>,
    description: &str,
    make: Py<PyAny>,
) -> PyResult<()> {
    let is_name = |name: &str| {
        let fine = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
        !name.is_empty() && name.len() <= 64 && name.chars().all(fine)
    };
    if !is_name(&name) {
        return Err(wrong(format!("name = \"{name}\": must be of lower-case letters, digits and hyphens, at most 64")));
    }
    if matches!(steps, Some(0) | Some(1_000_001..)) {
        return Err(wrong(format!("steps = {}: must be from 1 to 1000000", steps.unwrap_or_default())));
    }
    // Once as a sample, so that an error is told at once: it goes to the first that asks.
    let (made, make) = (make.call0(py)?, Arc::new(make));
    let of = |made| Written { made, is_broken: false, name: name.clone(), unit: unit.clone(), make: Arc::clone(&make) };
    let (first, pattern) = (Mutex::new(Some(of(made))), of(py.None()));
    register(name.clone(), |registry| {
        registry.movements.add_with(steps, description, move || {
            let sample = first.lock().unwrap_or_else(PoisonError::into_inner).take();
            Box::new(sample.unwrap_or_else(|| pattern.clone()))
        });
    })
    .map_err(wrong)
}

/// What one of these movements has raised since this was asked last: whatever it was called for is not to be believed.
pub(crate) fn raised(movements: &[String]) -> PyResult<()> {
    let mut raised = RAISED.lock().unwrap_or_else(PoisonError::into_inner);
    // All are forgotten, the first is told.
    let errors: Vec<PyErr> = movements.iter().filter_map(|movement| raised.remove(movement)).collect();
    errors.into_iter().next().map_or(Ok(()), Err)
}

/// By the movement's name, since other threads may train with others.
static RAISED: Mutex<BTreeMap<String, PyErr>> = Mutex::new(BTreeMap::new());

/// A movement whose methods are Python's.
struct Written {
    name: String,
    unit: String,
    make: Arc<Py<PyAny>>,
    made: Py<PyAny>,
    /// Whether this episode could not begin.
    is_broken: bool,
}

impl Written {
    /// Whether its object could not be made.
    fn is_unmade(&self) -> bool {
        Python::attach(|py| self.made.is_none(py))
    }

    /// What Python answers; the first error is kept to be raised.
    fn ask<T>(&self, ask: impl FnOnce(&Bound<'_, PyAny>) -> PyResult<T>) -> Option<T> {
        if self.is_broken {
            return None;
        }
        Python::attach(|py| ask(self.made.bind(py))).map_err(|error| keep(&self.name, error)).ok()
    }
}

fn keep(movement: &str, error: PyErr) {
    RAISED.lock().unwrap_or_else(PoisonError::into_inner).entry(movement.to_owned()).or_insert(error);
}

impl Clone for Written {
    fn clone(&self) -> Self {
        Python::attach(|py| {
            // A copy begins anew: episodes are independent.
            let made = self.make.call0(py).map_err(|error| keep(&self.name, error)).ok();
            let (name, unit, make) = (self.name.clone(), self.unit.clone(), Arc::clone(&self.make));
            Self { name, unit, make, is_broken: made.is_none(), made: made.unwrap_or_else(|| py.None()) }
        })
    }
}

impl Movement for Written {
    fn name(&self) -> &str {
        &self.name
    }

    fn unit(&self) -> &str {
        &self.unit
    }

    fn begin(&mut self, start: &tasks::Snapshot) {
        // Each episode is asked for anew: what was raised in another may not be raised in this.
        if self.is_unmade() {
            *self = self.clone();
        }
        self.is_broken = self.is_unmade();
        let begun = self.ask(|made| made.call_method1("begin", (Snapshot(start.clone()),)).map(drop));
        self.is_broken = begun.is_none();
    }

    fn observe(&mut self, now: &tasks::Snapshot) -> Verdict {
        if self.is_broken {
            return Verdict::Fail("the movement raised an error");
        }
        match self.ask(|made| made.call_method1("observe", (Snapshot(now.clone()),))?.is_truthy()) {
            Some(false) => Verdict::GoOn,
            Some(true) => Verdict::End,
            None => Verdict::Fail("the movement raised an error"),
        }
    }

    fn value(&self) -> f64 {
        self.ask(|made| made.call_method0("value")?.extract()).unwrap_or(f64::NAN)
    }
}
