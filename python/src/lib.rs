//! The native part of the Python package `gambol`: vector environments on SIMD lanes, strategies by ask and tell, runs,
//! champions.
//!
//! Nothing is computed here that the libraries do not compute: a Python caller never changes a bit of a run, unless it brings a
//! movement of its own. All that takes
//! time is done without Python's global lock, and arrays are written in place.

mod champions;
mod elsewhere;
mod environments;
mod episodes;
mod errors;
mod experiments;
mod group;
mod layout;
mod movements;
mod names;
mod neat;
mod progress;
mod runs;
mod searches;
mod stage;

use pyo3::prelude::*;

/// The native part of the package.
#[pymodule]
mod _gambol {
    #[pymodule_export]
    use crate::champions::{
        Net, champion_robustness, export_champion, judge_gait, read_champion, verify, write_replay,
    };
    #[pymodule_export]
    use crate::elsewhere::{Batch, BatchEvaluator};
    #[pymodule_export]
    use crate::environments::Environments;
    #[pymodule_export]
    use crate::experiments::Experiment;
    #[pymodule_export]
    use crate::movements::{Snapshot, register_movement};
    #[pymodule_export]
    use crate::names::{
        creature_names, default_time_step, episode_facts, movement_names, strategy_names, terrain_names,
        variation_names,
    };
    #[pymodule_export]
    use crate::neat::{Genes, NeatSearch};
    #[pymodule_export]
    use crate::runs::{read_config, read_log, resume, train};
    #[pymodule_export]
    use crate::searches::Search;
}
