use crate::common::PointMass;
use ne_core::{Seed, conformance::Violation};
use tasks::{
    Energy, FallEnds, MovementCatalogue, Running, Sum,
    conformance::{check_environment, check_movement, environment, movement, rules},
};

#[test]
fn every_movement_of_the_catalogue_passes() {
    let catalogue = MovementCatalogue::default();
    for entry in catalogue.entries() {
        let spec = serde_json::from_value(serde_json::json!({ "name": entry.name })).expect("a spec of a name");
        let movement = catalogue.build(&spec).expect("it is in the catalogue");
        check_movement(&*movement).unwrap_or_else(|violation| panic!("{}: {violation}", entry.name));
    }
}

#[test]
fn sums_pass() -> Result<(), Violation> {
    check_movement(&Sum::of(Running::default()))?;
    check_movement(&Sum::of(Running::default()).plus(-0.01, Energy::default()).plus(-3.0, FallEnds::default()))
}

#[test]
fn the_toy_environment_passes() -> Result<(), Violation> {
    check_environment(&PointMass::new(), Seed::of_run(1))?;
    check_environment(&PointMass::varied(1.0, 1e6), Seed::of_run(2))?;
    // One that soon fails is still an environment.
    check_environment(&PointMass::varied(1.0, 1.5), Seed::of_run(3))
}

#[test]
fn no_promise_is_made_twice() {
    let all = [environment::PROMISES, movement::PROMISES, rules::PROMISES].concat();
    for (index, promise) in all.iter().enumerate() {
        assert!(!all[..index].contains(promise), "{promise:?}");
    }
}
