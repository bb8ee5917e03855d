//! Random creatures and worlds: whatever a creature file and the settings can say, within what makes any sense.

use creatures::{Actuation, Blueprint, Creature, Joint, Motor, Part, Shape};
use envs_core::{PhysicsSettings, Variation};
use proptest::{prelude::*, sample::Index};

/// A part, and how it hangs on one of the parts before it.
#[derive(Clone, Debug)]
struct Sketch {
    shape: Shape,
    density: f32,
    friction: f32,
    /// Degrees.
    angle: f32,
    parent: Index,
    /// Where the hinge is in the frames of parent and child, as shares of half their widths and heights.
    on_parent: [f32; 2],
    on_child: [f32; 2],
    limits: [f32; 2],
    motor: Option<Motor>,
    actuated: bool,
}

/// Which part the next one hangs on.
#[derive(Clone, Copy, Debug)]
enum Tree {
    Chain,
    Star,
    Any,
}

/// A valid creature that stands on the ground, or so high above it.
pub(crate) fn any_creature() -> impl Strategy<Value = Creature> {
    let count = prop_oneof![6 => 2..5_usize, 6 => 5..11_usize, 1 => 11..61_usize];
    let sketches = count.prop_flat_map(|count| prop::collection::vec(any_sketch(), count));
    let tree = prop_oneof![1 => Just(Tree::Chain), 1 => Just(Tree::Star), 2 => Just(Tree::Any)];
    let height = prop_oneof![4 => Just(0.0_f32), 1 => 0.0..0.3_f32, 1 => -0.09..0.0_f32];
    let place = prop_oneof![4 => Just(0.0_f32), 1 => -60.0..60.0_f32];
    (sketches, tree, height, place).prop_map(|(sketches, tree, height, place)| assemble(&sketches, tree, height, place))
}

/// Sizes of a few centimetres to a metre and more, very flat boxes among them.
fn any_shape() -> impl Strategy<Value = Shape> {
    let size = || prop_oneof![8 => 0.04..0.6_f32, 1 => 0.005..0.04_f32, 1 => 0.6..3.0_f32];
    prop_oneof![
        2 => (size(), size()).prop_map(|(width, height)| Shape::Box { width, height }),
        1 => size().prop_map(|size| Shape::Circle { radius: (size * 0.5).max(0.005) }),
        1 => (size(), size()).prop_map(|(length, radius)| Shape::Capsule { length, radius: (radius * 0.4).max(0.005) }),
    ]
}

fn any_sketch() -> impl Strategy<Value = Sketch> {
    let angle = prop_oneof![
        4 => Just(0.0_f32),
        1 => prop::sample::select(vec![90.0_f32, -90.0, 180.0, -180.0, 270.0, 360.0]),
        3 => -360.0..360.0_f32,
    ];
    let share = || prop_oneof![2 => prop::sample::select(vec![-1.0_f32, 0.0, 1.0]), 2 => -1.2..1.2_f32];
    let point = || (share(), share()).prop_map(<[f32; 2]>::from);
    let density = prop_oneof![6 => 5.0..300.0_f32, 1 => 0.1..5.0_f32, 1 => 300.0..10_000.0_f32];
    let friction = prop_oneof![1 => Just(0.0_f32), 1 => Just(1.0_f32), 4 => 0.0..3.0_f32];
    let body = (any_shape(), density, friction, angle);
    let hinge = (any::<Index>(), point(), point(), any_limits());
    (body, hinge, prop::option::weighted(0.8, any_motor()), prop::bool::weighted(0.8)).prop_map(
        |((shape, density, friction, angle), (parent, on_parent, on_child, limits), motor, actuated)| {
            // What has a motor must have room for it.
            let room = |[low, high]: [f32; 2]| if high - low < 1.0 { [low, low + 1.0 + high] } else { [low, high] };
            let limits = if motor.is_some() { room(limits) } else { limits };
            Sketch { shape, density, friction, angle, parent, on_parent, on_child, limits, motor, actuated }
        },
    )
}

fn any_motor() -> impl Strategy<Value = Motor> {
    let top_torque = prop_oneof![6 => 0.5..200.0_f32, 1 => 0.01..0.5_f32, 1 => 200.0..20_000.0_f32];
    let top_speed = prop_oneof![6 => 1.0..15.0_f32, 1 => 0.01..1.0_f32, 1 => 15.0..100.0_f32];
    (top_speed, top_torque).prop_map(|(top_speed, top_torque)| Motor { top_speed, top_torque })
}

/// Symmetric, lopsided, with a limit in the start pose, locked, and nearly a whole turn.
fn any_limits() -> impl Strategy<Value = [f32; 2]> {
    prop_oneof![
        2 => (1.0..170.0_f32).prop_map(|half| [-half, half]),
        4 => (-160.0..0.0_f32, 0.0..180.0_f32).prop_map(<[f32; 2]>::from),
        1 => (0.0..180.0_f32).prop_map(|high| [0.0, high]),
        1 => (-180.0..0.0_f32).prop_map(|low| [low, 0.0]),
        1 => Just([0.0, 0.0]),
        1 => (-180.0..=-160.0_f32).prop_map(|low| [low, low + 340.0]),
    ]
}

fn half_sizes(shape: Shape) -> [f32; 2] {
    match shape {
        Shape::Box { width, height } => [width * 0.5, height * 0.5],
        Shape::Circle { radius } => [radius, radius],
        Shape::Capsule { length, radius } => [radius, length * 0.5 + radius],
    }
}

/// A point of a part, given as shares of its half sizes, seen from its centre, m.
fn lever(sketch: &Sketch, [x, y]: [f32; 2]) -> [f32; 2] {
    let [half_width, half_height] = half_sizes(sketch.shape);
    let (sin, cos) = libm::sincosf(sketch.angle.to_radians());
    let (x, y) = (x * half_width, y * half_height);
    [cos * x - sin * y, sin * x + cos * y]
}

fn assemble(sketches: &[Sketch], tree: Tree, height: f32, place: f32) -> Creature {
    let mut creature = Creature::new("random");
    for (index, sketch) in sketches.iter().enumerate() {
        let mut position = [place, 0.0];
        if index > 0 {
            let parent = match tree {
                Tree::Chain => index - 1,
                Tree::Star => 0,
                Tree::Any => sketch.parent.index(index),
            };
            let to_hinge = lever(&sketches[parent], sketch.on_parent);
            let from_hinge = lever(sketch, sketch.on_child);
            let anchor = [0, 1].map(|axis| creature.parts[parent].position[axis] + to_hinge[axis]);
            position = [0, 1].map(|axis| anchor[axis] - from_hinge[axis]);
            // Every creature must have an output.
            let some_motor = Some(Motor { top_speed: 8.0, top_torque: 30.0 });
            let first = index == 1;
            creature.joints.push(Joint {
                parent: creature.parts[parent].name.clone(),
                child: format!("part {index}"),
                anchor,
                limits: if first { [-60.0, 80.0] } else { sketch.limits },
                motor: if first { some_motor } else { sketch.motor },
            });
        }
        creature.parts.push(Part {
            name: format!("part {index}"),
            tag: if index == 1 || sketch.actuated { "leg" } else { "arm" }.to_owned(),
            shape: sketch.shape,
            density: sketch.density,
            friction: sketch.friction,
            position,
            angle: sketch.angle,
            leg: true,
            look: Default::default(),
        });
    }
    let bottom = Blueprint::new(creature.clone()).map_or(0.0, |blueprint| blueprint.bounding_box()[1]);
    raise(&mut creature, height - bottom);
    creature
}

/// Puts a creature so much higher, m.
pub(crate) fn raise(creature: &mut Creature, height: f32) {
    for part in &mut creature.parts {
        part.position[1] += height;
    }
    for joint in &mut creature.joints {
        joint.anchor[1] += height;
    }
}

/// Settings that lanes take. The defaults half of the time, else each anywhere in its range or most of it.
pub(crate) fn any_settings() -> impl Strategy<Value = PhysicsSettings> {
    let drawn = (
        (0.002..0.05_f32, 0.0..30.0_f32, 0.0..3.0_f32),
        (1..7_u32, 1..7_u32, 0.001..0.6_f32),
        (0.0..7.0_f32, 0.01..10.0_f32, 0.1..100.0_f32, 0.5..4.0_f32, 0.1..50.0_f32),
        (-2.0..5.0_f32, prop::sample::select(vec![0.0_f32, 1.0]), prop::sample::select(vec![5.0_f32, 100.0, 400.0])),
    );
    let drawn = drawn.prop_map(|(world, iterations, joints, others)| PhysicsSettings {
        time_step: world.0,
        gravity: world.1,
        ground_friction: world.2,
        solver_iterations: iterations.0,
        internal_iterations: iterations.1,
        continuous_collision_substeps: 0,
        prediction_distance: iterations.2,
        joint_frequency: libm::powf(10.0, joints.0),
        joint_damping_ratio: joints.1,
        corrective_speed: joints.2,
        contact_frequency: libm::powf(10.0, joints.3),
        contact_damping_ratio: joints.4,
        motor_gain: libm::powf(10.0, others.0),
        settle_time: others.1,
        unstable_speed: others.2,
        water: None,
    });
    let afloat = PhysicsSettings { settle_time: 0.0, ..PhysicsSettings::default() };
    prop_oneof![1 => Just(PhysicsSettings::default()), 1 => Just(afloat), 2 => drawn]
}

/// What outputs mean to motors.
pub(crate) fn any_actuation() -> impl Strategy<Value = Actuation> {
    let [low, high] = Actuation::GAINS;
    prop_oneof![2 => Just(Actuation::Speed), 1 => Just(Actuation::angle()), 2 => (low..=high).prop_map(|gain| Actuation::Angle { gain })]
}

pub(crate) fn any_variation() -> impl Strategy<Value = Variation> {
    let drawn = (0.0..0.9_f32, 0.0..0.9_f32, 0.0..0.9_f32, 0.0..0.5_f32, 0.0..1.0_f32);
    let drawn = drawn.prop_map(|(friction, mass, torque, time_step, start_pose)| Variation {
        friction,
        mass,
        torque,
        time_step: [1.0 - time_step, 1.0 + time_step],
        start_pose,
        ..Variation::default()
    });
    let extreme = Variation {
        time_step: [0.2083, 2.0],
        start_pose: 0.1,
        gravity: 0.9,
        motor_gain: [0.1, 100.0],
        solver_iterations: Some([1, 32]),
        joint_frequency: [0.1, 100.0],
        contact_frequency: [0.1, 100.0],
        contact_damping: [0.1, 100.0],
        torso_spin: 5.0,
        pushes: 5.0,
        ..Variation::default()
    };
    let known = [Variation::light(), Variation::strong(), Variation::physics(), extreme].map(Just);
    let [light, strong, physics, extreme] = known;
    prop_oneof![2 => Just(Variation::default()), 1 => light, 1 => strong, 1 => physics, 1 => extreme, 1 => drawn]
}
