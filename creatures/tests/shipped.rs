//! The shipped creatures: whole, standing on the ground, of the right size, with the right inputs and outputs.

use creatures::{Blueprint, Creature, DEFAULT_INPUT_RANGE, Motors, Senses, find, shipped};

fn blueprint(name: &str) -> Blueprint {
    Blueprint::new(find(name).expect("shipped")).unwrap_or_else(|error| panic!("{name}: {error}"))
}

fn senses(blueprint: &Blueprint) -> Senses {
    Senses::new(blueprint, &blueprint.creature().sensors, DEFAULT_INPUT_RANGE).expect("valid sensors")
}

#[test]
fn every_file_is_valid_named_after_its_creature_and_survives_a_round_trip() {
    for file in shipped() {
        let creature = Creature::from_json(file.json).unwrap_or_else(|error| panic!("{}: {error}", file.name));
        assert_eq!(creature.name, file.name);
        assert!(!creature.title.is_empty() && !creature.description.is_empty(), "{}", file.name);
        assert_eq!(Creature::from_json(&creature.to_json()).as_ref(), Ok(&creature));
        assert_eq!(blueprint(file.name).creature(), &creature);
    }
}

#[test]
fn parts_inputs_outputs_and_legs() {
    let expected = [
        ("apod", 7, 7, 6, 2),
        ("biped-1", 3, 3, 2, 2),
        ("biped-2", 5, 5, 4, 2),
        ("tetrapod-1", 5, 5, 4, 4),
        ("tetrapod-2", 9, 9, 8, 4),
        ("decapod-1", 11, 11, 10, 10),
        ("decapod-2", 21, 21, 20, 10),
    ];
    assert_eq!(shipped().len(), expected.len());
    for (name, parts, inputs, outputs, legs) in expected {
        let blueprint = blueprint(name);
        assert_eq!(blueprint.parts().len(), parts, "{name}");
        assert_eq!(senses(&blueprint).len(), inputs, "{name}");
        assert_eq!(Motors::new(&blueprint).len(), outputs, "{name}");
        assert_eq!(blueprint.actuated(), (0..outputs).collect::<Vec<_>>(), "{name}");
        assert_eq!(blueprint.feet().len(), legs, "{name}");
        assert_eq!(blueprint.legs().len(), legs, "{name}");
        assert_eq!(blueprint.is_legless(), name == "apod", "{name}");
        assert!(!blueprint.self_collision(), "{name}");
    }
}

#[test]
fn feet_touch_the_ground_and_hinges_lie_inside_both_parts() {
    for file in shipped() {
        let blueprint = blueprint(file.name);
        for &foot in blueprint.feet() {
            let lowest = blueprint.parts()[foot].lowest_point();
            assert!(lowest.abs() < 1e-4, "{}: {lowest}", file.name);
        }
        assert!(blueprint.bounding_box()[1].abs() < 1e-4, "{}", file.name);
        for hinge in blueprint.hinges() {
            let parent = blueprint.parts()[hinge.parent].shape.distance_to(hinge.parent_anchor);
            let child = blueprint.parts()[hinge.child].shape.distance_to(hinge.child_anchor);
            assert!(parent < 1e-4 && child < 1e-4, "{}", file.name);
        }
    }
}

#[test]
fn sizes_of_the_body() {
    let biped = blueprint("biped-1");
    assert!((biped.body_length() - 1.05).abs() < 1e-4);
    assert!((biped.start_height() - 0.8).abs() < 1e-4);
    // 30 kg/m² on a torso of 0.3 × 0.5 and two legs of 0.1 × 0.6.
    assert!((biped.mass() - 8.1).abs() < 1e-3);
    assert!((blueprint("tetrapod-2").body_length() - 1.2).abs() < 1e-4);
    assert!((blueprint("decapod-2").body_length() - 2.2).abs() < 1e-4);
}

#[test]
fn legs_run_from_hip_to_foot() {
    let biped = blueprint("biped-2");
    let names = |leg: &Vec<usize>| leg.iter().map(|&part| biped.parts()[part].name.clone()).collect::<Vec<_>>();
    assert_eq!(names(&biped.legs()[0]), ["left thigh", "left shin"]);
    assert_eq!(names(&biped.legs()[1]), ["right thigh", "right shin"]);

    let apod = blueprint("apod");
    let lengths: Vec<usize> = apod.legs().iter().map(Vec::len).collect();
    assert_eq!(lengths, [3, 3]);
}

#[test]
fn channels_of_tetrapod_2_keep_their_order() {
    // Trained nets rely on this order: it must never change.
    let blueprint = blueprint("tetrapod-2");
    let limbs = [
        "near front thigh",
        "near front shin",
        "near back thigh",
        "near back shin",
        "far front thigh",
        "far front shin",
        "far back thigh",
        "far back shin",
    ];
    let senses = senses(&blueprint);
    let inputs: Vec<&str> = senses.channels().iter().map(|channel| channel.name.as_str()).collect();
    assert_eq!(inputs[0], "rotation of case");
    for (input, limb) in inputs[1..].iter().zip(limbs) {
        assert_eq!(*input, format!("angle of {limb}"));
    }
    let motors = Motors::new(&blueprint);
    for (output, limb) in motors.channels().iter().zip(limbs) {
        assert_eq!(output.name, format!("speed of {limb}"));
        assert_eq!((output.unit, output.range), ("rad/s", [-12.0, 12.0]));
    }
}

#[test]
fn far_legs_are_drawn_first() {
    let creature = find("tetrapod-1").expect("shipped");
    let order: Vec<&str> = creature.drawing_order().iter().map(|&part| creature.parts[part].name.as_str()).collect();
    assert_eq!(order, ["far front leg", "far back leg", "near front leg", "near back leg", "case"]);
}

/// What a file says of its symmetry is proved.
#[test]
fn shipped_creatures_look_the_same_from_both_sides_and_one_that_does_not_is_refused() {
    for shipped in creatures::shipped() {
        let mut creature = creatures::find(shipped.name).expect("shipped");
        creature.symmetric = true;
        let blueprint = Blueprint::new(creature.clone()).expect("it is symmetric");
        assert_eq!(blueprint.symmetry(), None, "{}", shipped.name);
        if let Some(part) = creature.parts.last_mut() {
            part.density *= 2.0;
        }
        let heavier = Blueprint::new(creature.clone());
        // Of two legs in the middle each is its own mirror image.
        if heavier.is_err() {
            let said = heavier.expect_err("one leg is heavier").to_string();
            assert!(said.contains("symmetric: the mirror image of `"), "{said}");
        } else {
            assert!(shipped.name.starts_with("biped"), "{}", shipped.name);
        }
        creature.symmetric = false;
        assert!(Blueprint::new(creature).is_ok(), "{}: it does not say so", shipped.name);
    }
}
