//! What a gait must do for each tier.

use crate::{
    robustness_check::Trial,
    tiers::{DEPENDABLE, USABLE},
};

/// What a gait must do for one tier more: be usable in so many worlds of these trials, taken together.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    pub(super) trials: &'static [Trial],
    pub(super) worlds: usize,
}

/// The steps of a gait that is told nothing; one that fails at a step is not tried at those above. First a quarter of the worlds of the
/// short trial, half, three quarters; then of both, up to all but one. Finer steps would have a slow champion that is usable in one
/// world more stand above one twice as fast.
pub(super) const STEPS: [Step; 8] = {
    const fn short(worlds: usize) -> Step {
        Step { trials: &[Trial::Short], worlds }
    }
    const fn both(worlds: usize) -> Step {
        Step { trials: &[Trial::Short, Trial::Long], worlds }
    }
    [short(4), short(8), short(11), both(19), both(22), both(25), both(28), both(30)]
};

/// In how many schedules of commands a gait that is told what to do must be usable for the first tiers above [`USABLE`]: that it does
/// so whatever it is told comes before that it does so in any world. One of some thousand candidates that has passed nine schedules
/// may yet fail in every second.
const SCHEDULES: [usize; (DEPENDABLE - USABLE) as usize] = [8, 16, 20, 24, 26, 28, 30];

const _: () = assert!(SCHEDULES[SCHEDULES.len() - 1] == 30, "the documentation says 30");

/// Above these tiers all worlds count alike. Otherwise a gait of 30 schedules that bears bumps would not replace one of 31 that falls
/// over each.
const TOGETHER: [Trial; 3] = [Trial::MoreCommands, Trial::Short, Trial::Long];

/// In how many of them a gait must be usable for the first of these tiers, and for the last: all but one. Each asks for two more than the
/// one below, since of gaits that are equal in that the one that earns more is better.
const ALL_WORLDS: [usize; 2] = [34, 62];

const _: () = {
    let [short, long, schedules] = [Trial::Short.worlds(), Trial::Long.worlds(), Trial::MoreCommands.worlds()];
    assert!(STEPS[STEPS.len() - 1].worlds == short + long - 1);
    assert!(ALL_WORLDS[1] == short + long + schedules - 1);
};

/// All steps, in their order, of a gait that is told what to do or is not.
pub(super) fn steps(commanded: bool) -> Vec<Step> {
    if !commanded {
        return STEPS.into();
    }
    let schedules = SCHEDULES.map(|worlds| Step { trials: &[Trial::MoreCommands], worlds });
    let [first, last] = ALL_WORLDS;
    let together = (first..=last).step_by(2).map(|worlds| Step { trials: &TOGETHER, worlds });
    schedules.into_iter().chain(together).collect()
}
