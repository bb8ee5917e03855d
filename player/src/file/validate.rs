use crate::{Character, FileError, Hinge, Medium, Part, net::MOST_NODES};
use alloc::{vec, vec::Vec};
use creatures::{Actuation, Probe, Shape, Source};

type Checked = Result<(), FileError>;

/// Checks every number of a character.
pub(super) fn validate(character: &Character) -> Checked {
    text("name", 0, &character.name)?;
    text("movement", 0, &character.movement)?;
    world(character)?;
    count("parts", character.parts.len())?;
    for (index, part_) in character.parts.iter().enumerate() {
        part(index, part_)?;
    }
    // A body of one part has none.
    if character.hinges.len() + 1 != character.parts.len() {
        return wrong("hinges", 0, "one for each part but the torso");
    }
    let mut hangs = vec![false; character.parts.len()];
    for (index, hinge_) in character.hinges.iter().enumerate() {
        hinge(&mut hangs, index, hinge_)?;
    }
    if let Actuation::Angle { .. } = character.actuation
        && !character.actuation.is_valid()
    {
        return wrong("actuation", 0, "with a gain from 0.1 to 50");
    }
    outputs(character)?;
    number("input range", 0, character.input_range, 0.001, 1000.0, "from 0.001 to 1000")?;
    count("inputs", character.inputs.len())?;
    for (index, probe) in character.inputs.iter().enumerate() {
        input(character, index, probe)?;
    }
    net(character)
}

fn wrong(field: &'static str, index: usize, allowed: &'static str) -> Checked {
    Err(FileError::Field { field, index, allowed })
}

fn number(field: &'static str, index: usize, found: f32, low: f32, high: f32, allowed: &'static str) -> Checked {
    if (low..=high).contains(&found) { Ok(()) } else { wrong(field, index, allowed) }
}

fn finite(field: &'static str, index: usize, numbers: &[f32]) -> Checked {
    if numbers.iter().all(|number| number.is_finite()) { Ok(()) } else { wrong(field, index, "of finite numbers") }
}

fn count(field: &'static str, count: usize) -> Checked {
    if (1..MOST_NODES).contains(&count) { Ok(()) } else { wrong(field, 0, "from 1 to 65535 of them") }
}

fn text(field: &'static str, index: usize, text: &str) -> Checked {
    if text.len() <= 255 { Ok(()) } else { wrong(field, index, "named in at most 255 bytes") }
}

fn world(character: &Character) -> Checked {
    let world = &character.world;
    number("time step", 0, world.time_step, 0.001, 0.05, "from 0.001 to 0.05 s")?;
    number("gravity", 0, world.gravity, 0.0, 100.0, "from 0 to 100 m/s²")?;
    number("ground friction", 0, world.ground_friction, 0.0, 10.0, "from 0 to 10")?;
    number("motor gain", 0, world.motor_gain, 0.01, 1e6, "from 0.01 to 1e6")?;
    number("body length", 0, world.body_length, 0.001, 1e4, "from 0.001 to 10000 m")?;
    finite("rest height", 0, &[world.rest_height])?;
    if let Medium::Water { density, drag, slip } = world.medium {
        number("water density", 0, density, 0.01, 1e5, "from 0.01 to 1e5 kg/m²")?;
        number("water drag", 0, drag, 0.0, 10.0, "from 0 to 10")?;
        number("water slip", 0, slip, 0.0, drag, "from 0 to the drag")?;
    }
    Ok(())
}

fn part(index: usize, part: &Part) -> Checked {
    text("parts", index, &part.name)?;
    finite("parts", index, &[part.x, part.y, part.angle])?;
    number("parts", index, part.density, 0.1, 1e4, "as dense as 0.1 to 10000 kg/m²")?;
    number("parts", index, part.friction, 0.0, 10.0, "with a friction from 0 to 10")?;
    let sizes = match part.shape {
        Shape::Box { width, height } => [width, height],
        Shape::Circle { radius } => [radius, radius],
        Shape::Capsule { length, radius } => [length, radius],
    };
    let fits = |size: &f32| (0.005..=50.0).contains(size);
    if sizes.iter().all(fits) { Ok(()) } else { wrong("parts", index, "of sizes from 0.005 to 50 m") }
}

/// `hangs`: for each part whether it hangs on an earlier hinge.
fn hinge(hangs: &mut [bool], index: usize, hinge: &Hinge) -> Checked {
    let hung_before = hangs.get_mut(usize::from(hinge.child)).is_none_or(|hangs| core::mem::replace(hangs, true));
    if hinge.parent >= hinge.child || hung_before {
        return wrong("hinges", index, "between a part and a later one that hangs on no other");
    }
    finite("hinges", index, &hinge.parent_anchor)?;
    finite("hinges", index, &hinge.child_anchor)?;
    let [low, high] = hinge.limits;
    let (lowest, highest) = (-10.0..=0.0, 0.0..=10.0);
    if !lowest.contains(&low) || !highest.contains(&high) {
        return wrong("hinges", index, "limited from at most 0 to at least 0, within ± 10 rad");
    }
    let Some(motor) = hinge.motor else { return Ok(()) };
    number("hinges", index, motor.top_speed, 0.01, 100.0, "with a top speed from 0.01 to 100 rad/s")?;
    number("hinges", index, motor.top_torque, 0.01, 1e5, "with a top torque from 0.01 to 1e5 N·m")
}

fn outputs(character: &Character) -> Checked {
    count("outputs", character.outputs.len())?;
    if character.net.outputs().len() != character.outputs.len() {
        return wrong("outputs", 0, "as many as the net has");
    }
    let mut free: Vec<bool> = character.hinges.iter().map(|hinge| hinge.motor.is_some()).collect();
    for (index, &hinge) in character.outputs.iter().enumerate() {
        if !free.get_mut(usize::from(hinge)).is_some_and(core::mem::take) {
            return wrong("outputs", index, "a hinge with a motor, listed once");
        }
    }
    Ok(())
}

fn input(character: &Character, index: usize, probe: &Probe) -> Checked {
    finite("inputs", index, &[probe.middle, probe.factor])?;
    let (parts, hinges) = (character.parts.len(), character.hinges.len());
    let period = |period: f32| number("inputs", index, period, 0.02, 100.0, "with a period from 0.02 to 100 s");
    let top = |top: f32| number("inputs", index, top, 0.1, 20.0, "with a top speed from 0.1 to 20 body lengths/s");
    let length = |length: f32| number("inputs", index, length, 0.0, 1000.0, "with a reach of at most 1000 m");
    match probe.source {
        Source::JointAngle(hinge) | Source::JointSpeed(hinge) if hinge >= hinges => {
            wrong("inputs", index, "of a hinge that is there")
        }
        Source::Contact(part) | Source::Slip(part) if part >= parts => {
            wrong("inputs", index, "of a part that is there")
        }
        Source::Ray { angle, length: reach } => finite("inputs", index, &[angle]).and_then(|()| length(reach)),
        Source::GapDistance { length: reach } | Source::GapWidth { length: reach } => length(reach),
        Source::StrideSine { period: turn, top: fastest } | Source::StrideCosine { period: turn, top: fastest } => {
            period(turn).and_then(|()| top(fastest))
        }
        Source::ClockSine { period: turn }
        | Source::ClockCosine { period: turn }
        | Source::LandingSine { period: turn }
        | Source::LandingCosine { period: turn }
        | Source::JumpSine { period: turn }
        | Source::JumpSwell { period: turn } => period(turn),
        Source::Custom { .. } => {
            wrong("inputs", index, "a sensor of Gambol's own: those of other crates have code of theirs")
        }
        _ => Ok(()),
    }
}

fn net(character: &Character) -> Checked {
    if character.net.inputs() != character.inputs.len() {
        return wrong("neurons", 0, "of a net with as many inputs as are listed");
    }
    for (index, neuron) in character.net.neurons().enumerate() {
        if neuron.sources.len() >= MOST_NODES {
            return wrong("neurons", index, "with at most 65535 sources");
        }
        finite("neurons", index, &[neuron.scale, neuron.bias])?;
        for &(_, weight) in &neuron.sources {
            finite("neurons", index, &[weight])?;
        }
    }
    Ok(())
}
