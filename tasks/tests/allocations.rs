//! Steps allocate nothing: an episode of a thousand allocates what one of ten does.
//!
//! In a program of its own, because the allocator that counts is the program's.

mod common;

use common::{Constant, PointMass};
use ne_core::{Evaluation, Seed, Task};
use tasks::{
    Combine, Energy, Episode, FallEnds, Jumping, Movement, Objectives, Rollovers, Running, Sum, TimeAloft, Trials,
};

fn allocations(steps: u32, trials: u32) -> (u64, Evaluation) {
    let movement = Sum::of(Running::default())
        .plus(1.0, Jumping::default())
        .plus(-0.1, Energy::default())
        .plus(-1.0, Rollovers::default())
        .plus(0.5, TimeAloft::default())
        .plus(-1.0, FallEnds::default());
    let objectives = Objectives::beside(Box::new(movement)).and(-1.0, Box::new(Energy::default()));
    let movement: Box<dyn Movement> = Box::new(objectives.and(1.0, Box::new(Running::default())));
    let trials = Trials { count: trials, combine: Combine::Mean, lessons: false };
    let episode = Episode::new(PointMass::new(), movement, steps, trials).expect("settings in range");
    let mut evaluation = None;
    let counted =
        allocation_counter::measure(|| evaluation = Some(episode.evaluate(&mut Constant(0.5), Seed::of_run(1))));
    (counted.count_total, evaluation.expect("evaluated"))
}

#[test]
fn steps_allocate_nothing() {
    let ((few, short), (many, long)) = (allocations(10, 1), allocations(1000, 1));
    assert_eq!((short.steps, long.steps), (10, 1000));
    assert_eq!(few, many, "allocations of 10 and of 1000 steps");
    assert!(few > 0, "the counter counts");
}

#[test]
fn trials_share_what_is_allocated() {
    let ((one, _), (many, _)) = (allocations(10, 1), allocations(10, 50));
    assert_eq!(one, many, "allocations of 1 and of 50 trials");
}
