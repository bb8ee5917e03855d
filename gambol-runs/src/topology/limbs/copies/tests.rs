use super::*;
use crate::{Registry, topology::limbs::tests::all_creatures};
use creatures::{Sensor, Source};
use ne_core::Phenotype;
use ne_net::Topology;

/// A body's senses, among them a clock, and its motors.
fn body(blueprint: &Blueprint) -> (Senses, Motors, ControllerSettings) {
    let mut sensors = vec![
        Sensor::TorsoRotation,
        Sensor::JointAngles,
        Sensor::JointSpeeds,
        Sensor::TorsoSpin,
        Sensor::Clock { period: 1.0 },
    ];
    if !blueprint.feet().is_empty() {
        sensors.extend([Sensor::FootContacts, Sensor::FootSlip]);
    }
    let senses = Senses::new(blueprint, &sensors, 1.0).expect("it has what is sensed");
    let config = Registry::default().config("default", blueprint.creature().clone(), "running").expect("a preset");
    let controller = ControllerSettings { hidden: Vec::new(), ..config.controller };
    (senses, Motors::new(blueprint), controller)
}

fn inputs_of_step(step: usize, count: usize) -> Vec<f32> {
    (0..count).map(|input| libm::sinf(1.7 * input as f32 + step as f32)).collect()
}

/// The copies of a net without hidden neurons are those of the given topology, gene by gene, as long as clocks do not run ahead by
/// genes.
#[test]
fn copies_sense_and_do_what_those_of_a_given_net_do() {
    for blueprint in all_creatures() {
        let (senses, motors, controller) = body(&blueprint);
        for phases in [LimbPhases::Alternating, LimbPhases::Together] {
            let given = super::super::topology(&blueprint, &senses, &motors, &controller, phases);
            let found = copies(&blueprint, &senses, &motors, &controller, phases);
            let own = 1 + limbs(&blueprint, &senses, phases).len();
            let has_places = found.inputs.iter().any(|name| name == "place");
            let is_left_out = |name: &String| name.ends_with(": place") && !has_places;
            let gene = |(index, name): (usize, &String)| match index < own || is_left_out(name) {
                true => 0.0,
                false => libm::sinf(3.7 * index as f32 + 1.0),
            };
            let genes: Vec<f32> = given.names.iter().enumerate().map(gene).collect();
            let gene_named =
                |name: String| given.names.iter().position(|known| *known == name).map_or(0.0, |index| genes[index]);
            let mut weights = Vec::new();
            for output in &found.outputs {
                weights.push(gene_named(format!("{output}: threshold")));
                weights.extend(found.inputs.iter().map(|input| gene_named(format!("{output}: {input}"))));
            }
            let found = Topology::from(found.topology);
            assert_eq!((found.validate(), found.weight_count()), (Ok(()), weights.len()));
            let (mut given, mut found) = (Topology::from(given.topology).network(&genes), found.network(&weights));
            for step in 0..5 {
                let inputs = inputs_of_step(step, senses.len());
                let (mut expected, mut outputs) = (vec![0.0; motors.len()], vec![0.0; motors.len()]);
                given.activate(&inputs, &mut expected);
                found.activate(&inputs, &mut outputs);
                for (found, expected) in outputs.iter().zip(&expected) {
                    assert!((found - expected).abs() < 1e-4, "{} {phases:?}: {found}, {expected}", blueprint.name());
                }
            }
        }
    }
}

#[test]
fn a_wave_runs_along_bodies_with_many_limbs() {
    for (creature, waves) in [("biped-1", 0), ("tetrapod-2", 0), ("decapod-1", 4), ("apod", 4)] {
        let blueprint = Blueprint::new(creatures::find(creature).expect("shipped")).expect("valid");
        let (senses, motors, controller) = body(&blueprint);
        let made = copies(&blueprint, &senses, &motors, &controller, LimbPhases::Together);
        let is_wave = |name: &&String| name.ends_with("wave");
        assert_eq!(made.inputs.iter().filter(is_wave).count(), waves, "{creature}: {:?}", made.inputs);
    }
    let blueprint = Blueprint::new(creatures::find("apod").expect("shipped")).expect("valid");
    let (senses, motors, controller) = body(&blueprint);
    let made = copies(&blueprint, &senses, &motors, &controller, LimbPhases::Together);
    let name_of = |name: &str| made.inputs.iter().position(|known| known.ends_with(name)).expect("there");
    let limbs = limbs(&blueprint, &senses, LimbPhases::Together);
    let clock =
        senses.probes().iter().position(|probe| matches!(probe.source, Source::ClockSine { .. })).expect("a clock");
    for (limb, copy) in limbs.iter().zip(&made.topology.copies.copies) {
        for step in 0..8 {
            let time = step as f32;
            let mut inputs = vec![0.0; senses.len()];
            (inputs[clock], inputs[clock + 1]) = (libm::sinf(time), libm::cosf(time));
            let sensed = |name| {
                let sources = &copy.senses[name_of(name)].sources;
                sources.iter().map(|&(input, factor)| factor * inputs[input]).sum::<f32>()
            };
            // Both sines come before both cosines.
            let expected = libm::sinf(time + PI * limb.place);
            assert!((sensed(", wave") - expected).abs() < 1e-5, "{} {expected}", sensed(", wave"));
            let expected = libm::sinf(time - PI * limb.place);
            assert!((sensed(", counter wave") - expected).abs() < 1e-5, "{} {expected}", sensed(", counter wave"));
        }
    }
}

#[test]
fn sensors_of_one_name_are_all_heard() {
    let blueprint = Blueprint::new(creatures::find("tetrapod-1").expect("shipped")).expect("valid");
    let (_, motors, controller) = body(&blueprint);
    let gaps = [5.0, 6.0].map(|length| Sensor::NextGap { length });
    let senses = Senses::new(&blueprint, &gaps, 1.0).expect("sensors");
    let made = copies(&blueprint, &senses, &motors, &controller, LimbPhases::Alternating);
    let heard = made.topology.copies.copies[0].senses.iter().flat_map(|sense| &sense.sources).map(|&(input, _)| input);
    let heard: std::collections::BTreeSet<usize> = heard.collect();
    assert_eq!(heard.len(), senses.len(), "{:?}", made.inputs);
}
