//! What rapier's solver does only for larger creatures, and what lanes leave to it.

use creatures::{Blueprint, Shape};
use envs_core::{EnvironmentError, Ground, GroundShape, PhysicsSettings};

/// The name of the engine, as configurations and errors have it.
pub const ENGINE: &str = "lanes";

fn refuse(what: impl Into<String>) -> EnvironmentError {
    EnvironmentError::Unsupported { engine: ENGINE, what: what.into() }
}

pub(super) fn refuse_what_lanes_cannot_do(
    blueprint: &Blueprint,
    settings: &PhysicsSettings,
    ground: &Ground,
) -> Result<(), EnvironmentError> {
    // How parry finds where a capsule meets a box depends on how long it has known the two, and rapier has them meet when
    // its broad phase says so.
    let has_edges = |shape: &GroundShape| matches!(shape, GroundShape::Box { .. } | GroundShape::Slab { .. });
    let capsule = blueprint.parts().iter().find(|part| matches!(part.shape, Shape::Capsule { .. }));
    if let Some(part) = capsule.filter(|_| ground.shapes.iter().any(has_edges)) {
        return Err(refuse(format!("\"{}\" is a capsule, and the ground is made of boxes", part.name)));
    }
    if blueprint.self_collision() {
        return Err(refuse("its parts collide with each other (self_collision)"));
    }
    if settings.water.is_some() {
        return Err(refuse("it is in water (physics.water)"));
    }
    if settings.continuous_collision_substeps > 0 {
        return Err(refuse("it is to have continuous collision detection (physics.continuous_collision_substeps)"));
    }
    Ok(())
}

/// The hinges in the order rapier solves their joints in: it colours them greedily so that joints of a colour share no
/// part, and goes from colour to colour; large colours, which it solves several joints at a time, come first.
pub(super) fn solving_order(blueprint: &Blueprint) -> Result<Vec<usize>, EnvironmentError> {
    let mut colours_at = vec![0_u128; blueprint.parts().len()];
    let mut colours = Vec::with_capacity(blueprint.hinges().len());
    for hinge in blueprint.hinges() {
        let taken = colours_at[hinge.parent] | colours_at[hinge.child];
        let colour = (!taken).trailing_zeros();
        if colour >= MOST_COLOURS {
            let part = &blueprint.parts()[hinge.parent].name;
            return Err(refuse(format!("more than {MOST_COLOURS} parts hang together at \"{part}\"")));
        }
        colours_at[hinge.parent] |= 1 << colour;
        colours_at[hinge.child] |= 1 << colour;
        colours.push(colour);
    }
    let size = |colour: u32| colours.iter().filter(|&&other| other == colour).count();
    let mut order: Vec<usize> = (0..colours.len()).collect();
    order.sort_by_key(|&hinge| (size(colours[hinge]) < LARGE_COLOUR, colours[hinge]));
    Ok(order)
}

/// With more, rapier solves in another order.
const MOST_COLOURS: u32 = 100;

/// Joints from which on rapier solves a colour several at a time.
const LARGE_COLOUR: usize = 64;
