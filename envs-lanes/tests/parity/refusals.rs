//! What lanes cannot do they refuse, with a reason.

use crate::stage::{shipped, try_both};
use creatures::{Blueprint, Creature, Joint, Motor, Part, Shape};
use envs_core::{PhysicsSettings, Variation, Water};

/// What lanes say to a creature that rapier takes.
fn refusal(creature: Creature, settings: PhysicsSettings) -> String {
    let blueprint = Blueprint::new(creature).expect("valid");
    let sensors = blueprint.creature().sensors.clone();
    let (rapier, lanes) = try_both(&blueprint, &sensors, settings, Variation::default());
    rapier.expect("rapier takes it");
    lanes.err().expect("lanes refuse it").to_string()
}

#[test]
fn parts_that_collide_with_each_other_are_refused() {
    let creature = Creature { self_collision: true, ..shipped("biped-1").creature().clone() };
    let said = refusal(creature, PhysicsSettings::default());
    let wanted = "lanes cannot simulate this creature: its parts collide with each other (self_collision)";
    assert!(said.starts_with(wanted), "{said}");
}

#[test]
fn continuous_collision_detection_is_refused() {
    let settings = PhysicsSettings { continuous_collision_substeps: 1, ..PhysicsSettings::default() };
    let said = refusal(shipped("biped-1").creature().clone(), settings);
    let wanted = "lanes cannot simulate this creature: it is to have continuous collision detection \
                  (physics.continuous_collision_substeps)";
    assert!(said.starts_with(wanted), "{said}");
}

#[test]
fn water_is_refused() {
    let settings = PhysicsSettings { water: Some(Water::default()), ..PhysicsSettings::default() };
    let said = refusal(shipped("apod").creature().clone(), settings);
    let wanted = "lanes cannot simulate this creature: it is in water (physics.water)";
    assert!(said.starts_with(wanted), "{said}");
}

/// With so many at one part rapier solves joints in another order.
#[test]
fn more_than_100_parts_at_one_part_are_refused() {
    let hub = |arms: usize| {
        let mut creature = Creature::new("hub");
        for index in 0..=arms {
            let shape = Shape::Box { width: 0.2, height: 0.2 };
            let position = [0.0, 0.1];
            let (name, tag) = (format!("part {index}"), "leg".to_owned());
            let look = Default::default();
            creature.parts.push(Part {
                name,
                tag,
                shape,
                density: 10.0,
                friction: 1.0,
                position,
                angle: 0.0,
                leg: true,
                look,
            });
            if index > 0 {
                let motor = Some(Motor { top_speed: 1.0, top_torque: 1.0 });
                let child = format!("part {index}");
                let (parent, anchor) = ("part 0".to_owned(), [0.0, 0.1]);
                creature.joints.push(Joint { parent, child, anchor, limits: [-10.0, 10.0], motor });
            }
        }
        creature
    };
    let settings = PhysicsSettings { settle_time: 0.0, ..PhysicsSettings::default() };
    let said = refusal(hub(101), settings);
    let wanted = "lanes cannot simulate this creature: more than 100 parts hang together at \"part 0\"";
    assert!(said.starts_with(wanted), "{said}");
    let blueprint = Blueprint::new(hub(100)).expect("valid");
    let sensors = blueprint.creature().sensors.clone();
    assert!(try_both(&blueprint, &sensors, settings, Variation::default()).1.is_ok(), "100 are not too many");
}
