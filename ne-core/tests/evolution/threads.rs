use crate::{
    common::{Climber, Imitate},
    evolution, state,
};
use ne_core::{Evaluator, Genome, Parallel, Seed, Serial, Strategy, Task};

#[test]
fn any_number_of_threads_and_any_batch_give_the_same_bits() {
    let run = |evaluator: &dyn Fn(&Imitate) -> String| [1, 3, 8, 100].map(|batch| evaluator(&Imitate { batch }));
    let serial = run(&|task| {
        let mut evolution = evolution(12);
        evolution.run(task, &Serial, &mut []).expect("the run ends in peace");
        state(&evolution)
    });
    assert!(serial.iter().all(|state| *state == serial[0]));
    for threads in [1, 2, 8] {
        let parallel = Parallel::new(threads).expect("threads start");
        assert_eq!(parallel.threads(), threads);
        let found = run(&|task| {
            let mut evolution = evolution(12);
            evolution.run(task, &parallel, &mut []).expect("the run ends in peace");
            state(&evolution)
        });
        assert_eq!(found, serial, "{threads} threads");
    }
}

#[test]
fn evaluations_come_in_the_order_of_the_genomes() {
    let seed = Seed::of_run(2).generation(1);
    let parallel = Parallel::new(4).expect("threads start");
    for size in [0, 1, 2, 3, 7, 50] {
        let genomes = if size == 0 { Vec::new() } else { Climber::new(size).ask(seed).to_vec() };
        let alone: Vec<_> =
            genomes.iter().map(|genome| Imitate { batch: 1 }.evaluate(&mut genome.express(), seed)).collect();
        for batch in [1, 2, 5, 64] {
            assert_eq!(Serial.evaluate(&Imitate { batch }, &genomes, seed), alone);
            assert_eq!(parallel.evaluate(&Imitate { batch }, &genomes, seed), alone);
        }
    }
}

#[test]
fn no_thread_count_means_one_a_core() {
    assert!(Parallel::new(0).expect("threads start").threads() >= 1);
}
