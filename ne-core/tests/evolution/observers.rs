use crate::{TASK, common::Climber, evolution, state};
use ne_core::{Generation, Observer, ObserverError, Serial};
use std::{cell::RefCell, rc::Rc};

/// Writes down what it is told, and fails in one generation.
struct Scribe {
    notes: Rc<RefCell<Vec<u64>>>,
    fails_in: Option<u64>,
}

impl Observer<Climber> for Scribe {
    fn generation(&mut self, generation: &Generation<'_, Climber>) -> Result<(), ObserverError> {
        let number = generation.report.generation;
        if self.fails_in == Some(number) {
            return Err("the disk is full".into());
        }
        assert_eq!(generation.genomes.len(), generation.evaluations.len());
        assert_eq!(generation.progress.generations, number);
        let best = generation.evaluations.iter().filter_map(|evaluation| evaluation.fitness()).max();
        let champion = generation.champion.map(|champion| champion.fitness);
        assert!(champion >= best && generation.report.best_so_far == champion);
        assert_eq!(generation.improved, generation.champion.is_some_and(|champion| champion.generation == number));
        self.notes.borrow_mut().push(number);
        Ok(())
    }
}

#[test]
fn observers_are_told_of_every_generation_in_order() {
    let notes = Rc::default();
    let mut observers: [Box<dyn Observer<Climber>>; 2] = [
        Box::new(Scribe { notes: Rc::clone(&notes), fails_in: None }),
        Box::new(Scribe { notes: Rc::clone(&notes), fails_in: None }),
    ];
    evolution(4).run(&TASK, &Serial, &mut observers).expect("the run ends in peace");
    assert_eq!(*notes.borrow(), [1, 1, 2, 2, 3, 3, 4, 4]);
}

#[test]
fn observers_change_nothing() {
    let (mut seen, mut unseen) = (evolution(5), evolution(5));
    let scribe = Scribe { notes: Rc::default(), fails_in: None };
    seen.run(&TASK, &Serial, &mut [Box::new(scribe)]).expect("the run ends in peace");
    unseen.run(&TASK, &Serial, &mut []).expect("the run ends in peace");
    assert_eq!(state(&seen), state(&unseen));
}

#[test]
fn an_observers_error_ends_the_run_and_leaves_it_whole() {
    let notes = Rc::default();
    let mut broken = evolution(6);
    let scribe = Scribe { notes: Rc::clone(&notes), fails_in: Some(3) };
    let error = broken.run(&TASK, &Serial, &mut [Box::new(scribe)]).expect_err("the scribe fails");
    assert_eq!(error.to_string(), "the disk is full");
    assert_eq!(*notes.borrow(), [1, 2]);
    assert_eq!(broken.progress().generations, 3);
    // It can go on, and comes to where an undisturbed run does.
    broken.run(&TASK, &Serial, &mut []).expect("the run ends in peace");
    let mut whole = evolution(6);
    whole.run(&TASK, &Serial, &mut []).expect("the run ends in peace");
    assert_eq!(state(&broken), state(&whole));
}
