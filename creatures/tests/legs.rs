//! What a creature file says to be no leg is moved like a leg, and is none.

use creatures::{Blueprint, Creature, Motors, Senses, Sensor, find};

/// This creature, whose parts with these names say `"leg": false`.
fn without_legs(name: &str, parts: &[&str]) -> Blueprint {
    let mut creature = find(name).expect("shipped");
    for &part in parts {
        creature.parts.iter_mut().find(|found| found.name == part).expect("it has this part").leg = false;
    }
    Blueprint::new(creature).expect("valid")
}

fn names(blueprint: &Blueprint, limbs: &[Vec<usize>]) -> Vec<String> {
    let name = |&part: &usize| blueprint.parts()[part].name.clone();
    limbs.iter().map(|limb| limb.iter().map(name).collect::<Vec<_>>().join(", ")).collect()
}

#[test]
fn one_part_makes_an_arm_of_its_chain() {
    for part in ["left thigh", "left shin"] {
        let blueprint = without_legs("biped-2", &[part]);
        assert_eq!(names(&blueprint, blueprint.legs()), ["right thigh, right shin"], "{part}");
        assert_eq!(names(&blueprint, blueprint.arms()), ["left thigh, left shin"], "{part}");
        assert_eq!(blueprint.feet(), [blueprint.legs()[0][1]]);
        assert!(!blueprint.is_legless());
        assert_eq!(Motors::new(&blueprint).len(), 4, "its motors are outputs all the same");
    }
}

#[test]
fn sensors_of_feet_leave_arms_out() {
    let channels = |blueprint: &Blueprint| {
        let senses = Senses::new(blueprint, &[Sensor::FootContacts, Sensor::FootSlip], 1.0).expect("it has a foot");
        senses.channels().iter().map(|channel| channel.name.clone()).collect::<Vec<_>>()
    };
    let blueprint = without_legs("biped-2", &["left thigh"]);
    let found = channels(&blueprint);
    assert!(found.len() == 2 && found.iter().all(|name| name.contains("right shin")), "{found:?}");
}

#[test]
fn a_body_of_arms_alone_is_legless_and_has_no_feet_to_feel() {
    let blueprint = without_legs("biped-1", &["left leg", "right leg"]);
    assert!(blueprint.is_legless() && blueprint.feet().is_empty() && blueprint.legs().is_empty());
    assert_eq!(blueprint.leg_length(), blueprint.start_height());
    assert_eq!(blueprint.arms().len(), 2);
    let mut creature = blueprint.creature().clone();
    creature.sensors = vec![Sensor::FootContacts];
    let refusal = Blueprint::new(creature).expect_err("no feet").to_string();
    assert!(refusal.contains("sensors[0]: `foot-contacts` needs feet"), "{refusal}");
    let mut creature = without_legs("biped-1", &["left leg"]).creature().clone();
    creature.sensors = vec![Sensor::FootContacts];
    assert!(Blueprint::new(creature).is_ok(), "one foot is left");
}

#[test]
fn files_without_arms_are_written_as_ever() {
    let creature = find("biped-1").expect("shipped");
    assert!(!creature.to_json().contains("\"leg\": "), "{}", creature.to_json());
    let text = without_legs("biped-1", &["left leg"]).creature().to_json();
    assert_eq!(text.matches("\"leg\": false").count(), 1);
    let read = Creature::from_json(&text).expect("its own text");
    assert!(!read.parts[1].leg && read.parts[2].leg);
}

#[test]
fn what_is_neither_true_nor_false_is_refused() {
    let text =
        find("biped-1").expect("shipped").to_json().replacen("\"tag\": \"leg\"", "\"leg\": 0, \"tag\": \"leg\"", 1);
    let refusal = Creature::from_json(&text).expect_err("0 is neither").to_string();
    assert!(refusal.contains("parts[1].leg") && refusal.contains("boolean"), "{refusal}");
}
