//! Episodes of a mass that is pushed: trials, ends, failures, measurements.

mod common;

use common::{Constant, PointMass, TIME_STEP};
use ne_core::{
    Evaluation, Failure, Genome, Seed, Task,
    conformance::{Puppet, check_task},
};
use tasks::{
    Combine, Energy, Environment, Episode, Moment, Movement, MovementCatalogue, MovementSpec, Objectives, Running,
    Snapshot, Sum, Trials, Verdict,
};

const SEED: Seed = Seed::of_run(1);
const ONE: Trials = Trials { count: 1, combine: Combine::Mean, lessons: false };

fn episode(
    environment: PointMass,
    movement: impl Movement + 'static,
    steps: u32,
    trials: Trials,
) -> Episode<PointMass> {
    Episode::new(environment, Box::new(movement), steps, trials).expect("settings in range")
}

fn fitness(evaluation: &Evaluation) -> f64 {
    evaluation.fitness().expect("the evaluation succeeds").get()
}

/// Where a mass at rest is after `steps` steps of a push of 1 N: h² (1 + 2 + ... + n).
fn way(steps: u32) -> f64 {
    let step = f64::from(TIME_STEP);
    step * step * f64::from(steps * (steps + 1) / 2)
}

#[test]
fn an_episode_passes_the_check_of_tasks() -> Result<(), Box<dyn std::error::Error>> {
    let varied = PointMass::varied(0.5, 2.0);
    let movement = Sum::of(Running::default()).plus(-0.1, Energy::default());
    for trials in [ONE, Trials { count: 4, combine: Combine::Worst, lessons: false }] {
        check_task(&episode(varied.clone(), movement.clone(), 50, trials), &Puppet::sample(2, 1, 6), SEED)?;
    }
    Ok(())
}

#[test]
fn fitness_is_the_movements_value_after_all_steps() {
    for steps in [1, 10, 40] {
        let evaluation = episode(PointMass::new(), Running::default(), steps, ONE).evaluate(&mut Constant(1.0), SEED);
        assert_eq!(fitness(&evaluation), way(steps));
        assert_eq!(evaluation.steps, u64::from(steps));
    }
}

/// The torso's place at the start, so that trials can be told apart.
#[derive(Clone, Default)]
struct StartPlace(f32);

impl Movement for StartPlace {
    fn name(&self) -> &str {
        "start-place"
    }
    fn unit(&self) -> &str {
        "m"
    }
    fn begin(&mut self, start: &Snapshot) {
        self.0 = start.torso().x;
    }
    fn observe(&mut self, _: &Snapshot) -> Verdict {
        Verdict::GoOn
    }
    fn value(&self) -> f64 {
        f64::from(self.0)
    }
}

#[test]
fn trials_are_different_and_become_their_mean_or_their_worst() {
    let varied = PointMass::varied(1.0, 1e6);
    let starts: Vec<f64> = (0..5)
        .map(|trial| {
            let mut one = varied.clone();
            one.reset(SEED.trial(trial)).expect("it always starts");
            f64::from(one.snapshot().torso().x)
        })
        .collect();
    assert!((1..5).all(|trial| starts[trial] != starts[0]), "{starts:?}");
    let evaluate = |combine| {
        episode(varied.clone(), StartPlace::default(), 3, Trials { count: 5, combine, lessons: false })
            .evaluate(&mut Constant(0.0), SEED)
    };
    let (mean, worst) = (evaluate(Combine::Mean), evaluate(Combine::Worst));
    assert!((fitness(&mean) - starts.iter().sum::<f64>() / 5.0).abs() < 1e-12);
    assert_eq!(fitness(&worst), starts.iter().copied().fold(f64::INFINITY, f64::min));
    assert_eq!((mean.steps, worst.steps), (15, 15));
    // Measurements are means, whatever becomes of the fitness.
    assert!((worst.measurements["start-place"] - fitness(&mean)).abs() < 1e-12);
}

#[test]
fn the_lesson_that_went_worst_counts_for_half() {
    let evaluate = |combine, lessons| {
        let trials = Trials { count: 7, combine, lessons };
        fitness(
            &episode(PointMass::varied(1.0, 1e6), StartPlace::default(), 3, trials).evaluate(&mut Constant(0.0), SEED),
        )
    };
    let start = |trial| {
        let mut one = PointMass::varied(1.0, 1e6);
        one.reset(SEED.trial(trial)).expect("it always starts");
        f64::from(one.snapshot().torso().x)
    };
    let mean = |trials: &[u32]| trials.iter().map(|&trial| start(trial)).sum::<f64>() / trials.len() as f64;
    let worst = [mean(&[0, 2, 4, 6]), mean(&[1, 3, 5])].into_iter().fold(f64::INFINITY, f64::min);
    let all = mean(&[0, 1, 2, 3, 4, 5, 6]);
    assert!((evaluate(Combine::WorstLesson, true) - 0.5 * (worst + all)).abs() < 1e-12);
    assert_eq!(evaluate(Combine::WorstLesson, false), evaluate(Combine::Mean, false));
    assert!(worst < all);
}

#[test]
fn fewer_trials_are_the_first_ones() {
    let evaluate = |count, fewer: u32| {
        let trials = Trials { count, combine: Combine::Worst, lessons: false };
        let whole = episode(PointMass::varied(1.0, 1e6), StartPlace::default(), 3, trials);
        whole.with_fewer_trials(fewer).evaluate(&mut Constant(0.0), SEED)
    };
    for (fewer, count) in [(0, 1), (1, 1), (3, 3), (5, 5), (9, 5)] {
        assert_eq!(evaluate(5, fewer), evaluate(count, count), "{fewer} of 5");
    }
}

/// Ends the episode beyond a place.
#[derive(Clone)]
struct Until(f32, Running);

impl Movement for Until {
    fn name(&self) -> &str {
        "until"
    }
    fn unit(&self) -> &str {
        "m"
    }
    fn begin(&mut self, start: &Snapshot) {
        self.1.begin(start);
    }
    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.1.observe(now);
        if now.torso().x > self.0 { Verdict::End } else { Verdict::GoOn }
    }
    fn value(&self) -> f64 {
        self.1.value()
    }
}

#[test]
fn a_movement_ends_the_episode_early() {
    let evaluation =
        episode(PointMass::new(), Until(0.1, Running::default()), 1000, ONE).evaluate(&mut Constant(1.0), SEED);
    // h² × 28 = 0.109 is the first beyond 0.1, after 7 steps.
    assert_eq!((fitness(&evaluation), evaluation.steps), (way(7), 7));
    assert_eq!(evaluation.measurements["duration"], 7.0 * f64::from(TIME_STEP));
}

#[test]
fn a_failing_environment_fails_the_evaluation_and_says_how_far_it_came() {
    let short = PointMass::varied(0.0, 0.1);
    let evaluation =
        episode(short, Running::default(), 1000, Trials { count: 3, ..ONE }).evaluate(&mut Constant(1.0), SEED);
    assert_eq!(evaluation.outcome, Err(Failure::Unstable { what: "off the rails".into() }));
    assert_eq!(evaluation.steps, 7);
}

/// Does not score what is beyond a place.
#[derive(Clone)]
struct Disqualifies(f32);

impl Movement for Disqualifies {
    fn name(&self) -> &str {
        "disqualifies"
    }
    fn unit(&self) -> &str {
        "m"
    }
    fn begin(&mut self, _: &Snapshot) {}
    fn observe(&mut self, now: &Snapshot) -> Verdict {
        if now.torso().x > self.0 { Verdict::Fail("too far") } else { Verdict::GoOn }
    }
    fn value(&self) -> f64 {
        1.0
    }
}

#[test]
fn a_movement_that_fails_fails_the_evaluation_and_says_why() {
    let three = Trials { count: 3, ..ONE };
    let too_far = Failure::Other { what: "too far".into() };
    let summed = Sum::of(Until(0.1, Running::default())).plus(0.0, Disqualifies(0.1));
    for (movement, what) in
        [(Sum::of(Disqualifies(0.1)), "alone"), (summed, "beside a term that ends the episode in the same step")]
    {
        let episode = episode(PointMass::new(), movement, 1000, three);
        let evaluation = episode.evaluate(&mut Constant(1.0), SEED);
        assert_eq!((evaluation.outcome, evaluation.steps), (Err(too_far.clone()), 7), "{what}");
        let played = episode.play(&mut Constant(1.0), SEED, &mut ());
        assert_eq!((played.outcome.steps, played.outcome.failure), (7, Some(too_far.clone())), "{what}");
    }
    // In the last step it is as bad as in any other.
    let last = episode(PointMass::new(), Disqualifies(0.1), 7, ONE).evaluate(&mut Constant(1.0), SEED);
    assert_eq!((last.outcome, last.steps), (Err(too_far), 7));
    assert!(episode(PointMass::new(), Disqualifies(0.1), 6, ONE).evaluate(&mut Constant(1.0), SEED).outcome.is_ok());
}

#[test]
fn a_controller_without_numbers_fails() {
    let episode = episode(PointMass::new(), Running::default(), 10, ONE);
    for output in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        let evaluation = episode.evaluate(&mut Constant(output), SEED);
        assert_eq!(evaluation.outcome, Err(Failure::NonFinite { what: "output 0".into() }));
        assert_eq!(evaluation.steps, 0);
    }
}

#[test]
fn a_sensor_without_numbers_is_named_before_the_output_that_it_spoils() {
    let nowhere = episode(PointMass::varied(f32::NAN, f32::INFINITY), Running::default(), 10, ONE);
    let evaluation = nowhere.evaluate(&mut Constant(f32::NAN), SEED);
    assert_eq!(evaluation.outcome, Err(Failure::NonFinite { what: "input 0".into() }));
}

/// A movement that divides by zero.
#[derive(Clone)]
struct Nonsense;

impl Movement for Nonsense {
    fn name(&self) -> &str {
        "nonsense"
    }
    fn unit(&self) -> &str {
        "1"
    }
    fn begin(&mut self, _: &Snapshot) {}
    fn observe(&mut self, _: &Snapshot) -> Verdict {
        Verdict::GoOn
    }
    fn value(&self) -> f64 {
        f64::NAN
    }
}

#[test]
fn a_movement_without_a_number_fails() {
    let evaluation = episode(PointMass::new(), Nonsense, 10, ONE).evaluate(&mut Constant(0.0), SEED);
    let expected = Failure::NonFinite { what: "the value of \"nonsense\"".into() };
    assert_eq!(evaluation.outcome, Err(expected.clone()));
    assert_eq!(evaluation.steps, 10);
    // Among others it is named.
    let sum = Sum::of(Running::default()).plus(1.0, Nonsense).plus(1.0, Energy::default());
    assert_eq!(episode(PointMass::new(), sum, 10, ONE).evaluate(&mut Constant(0.0), SEED).outcome, Err(expected));
}

#[test]
fn a_controller_of_another_shape_fails() {
    let episode = episode(PointMass::new(), Running::default(), 10, ONE);
    let expected = Failure::ShapeMismatch { found_inputs: 3, found_outputs: 1, inputs: 2, outputs: 1 };
    assert_eq!(episode.evaluate(&mut Puppet::new(3, 1, 0).express(), SEED).outcome, Err(expected.clone()));
    let played = episode.play(&mut Puppet::new(3, 1, 0).express(), SEED, &mut ());
    assert_eq!((played.outcome.steps, played.outcome.failure), (0, Some(expected)));
}

#[test]
fn measurements_have_the_names_of_the_terms() {
    let movement = Sum::of(Running::default()).plus(-0.5, Energy::default());
    let evaluation = episode(PointMass::new(), movement, 16, ONE).evaluate(&mut Constant(1.0), SEED);
    let names: Vec<&str> = evaluation.measurements.iter().map(|(name, _)| name).collect();
    assert_eq!(names, ["duration", "energy", "running"]);
    assert_eq!(evaluation.measurements["running"], way(16));
    assert_eq!(evaluation.measurements["duration"], 1.0);
    assert_eq!(fitness(&evaluation), way(16) - 0.5 * evaluation.measurements["energy"]);
}

#[test]
fn objectives_are_weighed_means_over_the_trials_and_leave_the_rest_alone() -> Result<(), Box<dyn std::error::Error>> {
    let movement = || Sum::of(Running::default()).plus(-0.5, Energy::default());
    let objectives = || {
        let beside = Objectives::beside(Box::new(movement()));
        let beside = beside.and(-2.0, Box::new(Energy::default())).and(1.0, Box::new(StartPlace::default()));
        // They would end the episode, and fail it; but objectives only watch.
        beside.and(3.0, Box::new(Says(Verdict::End))).and(4.0, Box::new(Says(Verdict::Fail("on purpose"))))
    };
    for trials in [ONE, Trials { count: 4, combine: Combine::Worst, lessons: false }] {
        let place = PointMass::varied(0.5, 1e6);
        let task = episode(place.clone(), objectives(), 16, trials);
        check_task(&task, &Puppet::sample(2, 1, 6), SEED)?;
        let found = task.evaluate(&mut Constant(1.0), SEED);
        let plain = episode(place.clone(), movement(), 16, trials).evaluate(&mut Constant(1.0), SEED);
        assert_eq!(Evaluation { objectives: Vec::new(), ..found.clone() }, plain);
        let of_trial = |movement: Box<dyn Movement>, trial| {
            let once = Episode::new(place.clone(), movement, 16, ONE).expect("in range");
            once.play(&mut Constant(1.0), SEED.trial(trial), &mut ()).movement.value()
        };
        let mean = |movement: &dyn Movement| {
            let values = (0..trials.count).map(|trial| of_trial(movement.boxed_clone(), trial));
            values.sum::<f64>() / f64::from(trials.count)
        };
        let (energy, start) = (mean(&Energy::default()), mean(&StartPlace::default()));
        for (objective, expected) in found.objectives.iter().zip([-2.0 * energy, start, 3.0, 4.0]) {
            assert!((objective - expected).abs() < 1e-12, "{:?}", found.objectives);
        }
        assert_eq!(found.objectives.len(), 4);
    }
    Ok(())
}

/// Says the same after each step, and is worth 1.
#[derive(Clone)]
struct Says(Verdict);

impl Movement for Says {
    fn name(&self) -> &str {
        "says"
    }
    fn unit(&self) -> &str {
        "1"
    }
    fn begin(&mut self, _: &Snapshot) {}
    fn observe(&mut self, _: &Snapshot) -> Verdict {
        self.0
    }
    fn value(&self) -> f64 {
        1.0
    }
}

#[test]
fn an_objective_without_a_number_fails() {
    let beside = Objectives::beside(Box::new(Running::default())).and(1.0, Box::new(Energy::default()));
    let movement = beside.and(1.0, Box::new(Nonsense));
    let evaluation = episode(PointMass::new(), movement, 10, ONE).evaluate(&mut Constant(0.0), SEED);
    assert_eq!(evaluation.outcome, Err(Failure::NonFinite { what: "objective 1".into() }));
    assert_eq!((evaluation.steps, evaluation.objectives), (10, vec![]));
}

#[test]
fn objectives_are_named_in_files_and_their_errors_name_the_field() -> Result<(), Box<dyn std::error::Error>> {
    let built = |objectives: &str| {
        let text = format!(r#"{{"name":"running","objectives":{objectives}}}"#);
        let spec: MovementSpec = serde_json::from_str(&text)?;
        assert_eq!(serde_json::to_string(&spec)?, text, "written as it was read");
        Ok::<_, serde_json::Error>(MovementCatalogue::default().build(&spec).map_err(|error| error.to_string()))
    };
    let two = r#"[{"term":"running","weight":1.0},{"term":"energy","weight":-1.0}]"#;
    let movement = built(two)?.map_err(|error| error.to_string())?;
    assert_eq!((movement.name(), movement.unit()), ("running", "m"));
    let mut count = 0;
    movement.objectives(&mut |_| count += 1);
    assert_eq!(count, 2);
    for (objectives, message) in [
        (r#"[{"term":"running","weight":1.0}]"#, "objectives = 1 objectives: must be from 2 to 4 objectives, or none"),
        (
            r#"[{"term":"running","weight":1.0},{"term":"energy","weight":0.0}]"#,
            "objectives[1].weight = 0: must be a finite number other than 0",
        ),
        (
            r#"[{"term":"running","weight":1.0},{"term":"running","weight":-1.0}]"#,
            "objectives[1].term = running: must be named once",
        ),
        (
            r#"[{"term":"running","weight":1.0},{"term":"enrgy","weight":-1.0}]"#,
            "objectives[1].term: there is no movement or term \"enrgy\"",
        ),
    ] {
        let error = built(objectives)?.err().ok_or("it was built")?;
        assert!(error.starts_with(message), "{error}");
    }
    let five = [r#"{"term":"running","weight":1.0}"#; 5].join(",");
    let error = built(&format!("[{five}]"))?.err().ok_or("it was built")?;
    assert!(error.starts_with("objectives = 5 objectives: must be"), "{error}");
    Ok(())
}

#[test]
fn play_shows_a_watcher_what_an_evaluation_does() {
    let episode = episode(PointMass::varied(1.0, 1e6), Running::default(), 20, ONE);
    let mut seen: Vec<(u32, f32, Vec<f32>, Vec<f32>)> = Vec::new();
    let mut watcher = |moment: &Moment<'_>| {
        seen.push((moment.step, moment.snapshot.torso().x, moment.inputs.to_vec(), moment.outputs.to_vec()));
    };
    let mut puppet = Puppet::new(2, 1, 4).express();
    let played = episode.play(&mut puppet, SEED.trial(0), &mut watcher);
    assert_eq!(played.movement.value(), fitness(&episode.evaluate(&mut puppet, SEED)));
    assert_eq!((played.outcome.steps, played.outcome.failure), (20, None));
    assert_eq!(seen.iter().map(|(step, ..)| *step).collect::<Vec<_>>(), (0..=20).collect::<Vec<_>>());
    assert_eq!((&seen[0].2[..], &seen[0].3[..]), (&[0.0, 0.0][..], &[0.0][..]));
    // What the controller saw before a step is where the mass was after the step before.
    assert!(seen.windows(2).all(|pair| pair[1].2[0] == pair[0].1));
}

#[test]
fn settings_out_of_range_are_named() {
    let new = |steps, trials| {
        let result = Episode::new(PointMass::new(), Box::new(Running::default()), steps, trials);
        result.err().map(|error| error.to_string())
    };
    assert_eq!(new(0, ONE).as_deref(), Some("steps = 0: must be at least 1"));
    let none = Trials { count: 0, ..ONE };
    assert_eq!(new(1, none).as_deref(), Some("trials.count = 0: must be from 1 to 1000"));
    assert_eq!(new(1, ONE), None);
}
