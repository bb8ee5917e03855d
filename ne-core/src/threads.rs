/// Threads a task may spread a batch over; see [`Task::evaluate_spread`](crate::Task::evaluate_spread).
pub trait Threads: Sync {
    /// How many there are, at least 1.
    fn count(&self) -> usize;

    /// Calls `work` once on each thread, and returns when all calls have. A thread may be busy until another is done: `work`
    /// takes what there is to do from a queue, and never waits for another call.
    fn each(&self, work: &(dyn Fn() + Sync));
}

/// The calling thread alone.
impl Threads for () {
    fn count(&self) -> usize {
        1
    }

    fn each(&self, work: &(dyn Fn() + Sync)) {
        work();
    }
}
