//! What one step of one creature costs, and how much of it is ours.
//!
//! `whole`: an episode as training runs it: sensing, a 10-neuron controller, motors, rapier, measuring, the movement.
//! `bare`: the same bodies and joints in a bare rapier world with the same settings, the same controller and nothing
//! else: angles in, motor speeds out, step. `physics alone`: the bare world with motors that never change.
//!
//! ```text
//! cargo bench -p envs-rapier
//! ```
//!
//! Reported per episode of 1,000 steps, so milliseconds read as microseconds per step.

#![allow(clippy::print_stdout)]

use creatures::Blueprint;
use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use envs_rapier::{PhysicsSettings, RapierEnvironment, Variation};
use ne_core::{Phenotype, Purpose, Seed};
use ne_net::{DenseNet, DenseShape};
use rand::RngExt;
use rapier2d::prelude::*;
use std::{hint::black_box, time::Duration};
use tasks::{Episode, Moment, Running, Trials};

const STEPS: u32 = 1000;

fn blueprint(name: &str) -> Blueprint {
    Blueprint::new(creatures::find(name).expect("shipped")).expect("valid")
}

fn controller(inputs: usize, outputs: usize) -> DenseNet {
    let shape = DenseShape::new(inputs, vec![10], outputs);
    let mut stream = Seed::of_run(4).stream(Purpose::new("bench weights"));
    let weights: Vec<f32> = (0..shape.weight_count()).map(|_| stream.random_range(-1.0..1.0)).collect();
    DenseNet::new(shape, &weights).expect("as many weights as the shape needs")
}

/// The same creature, built by hand with rapier alone.
struct Bare {
    world: PhysicsWorld,
    bodies: Vec<RigidBodyHandle>,
    joints: Vec<(usize, usize, ImpulseJointHandle, f32, f32)>,
    net: DenseNet,
    inputs: Vec<f32>,
    outputs: Vec<f32>,
}

impl Bare {
    fn new(blueprint: &Blueprint) -> Self {
        let mut world = PhysicsWorld::new();
        world.integration_parameters.dt = 0.02;
        world.integration_parameters.num_solver_iterations = 2;
        world.integration_parameters.num_internal_pgs_iterations = 4;
        world.integration_parameters.max_ccd_substeps = 0;
        world.integration_parameters.normalized_prediction_distance = 0.1;
        world.integration_parameters.normalized_max_corrective_velocity = 20.0;
        let groups = |member, filter| InteractionGroups::new(member, filter, InteractionTestMode::And);
        let (ground, body) = (Group::GROUP_1, Group::GROUP_2);
        let halfspace = ColliderBuilder::new(SharedShape::halfspace(Vector::Y));
        world.insert_collider(halfspace.friction(1.0).collision_groups(groups(ground, body)), None);
        let mut bodies = Vec::new();
        for part in blueprint.parts() {
            let creatures::Shape::Box { width, height } = part.shape else { panic!("boxes only") };
            let rigid = RigidBodyBuilder::dynamic().translation(Vector::new(part.x, part.y)).can_sleep(false);
            let collider = ColliderBuilder::cuboid(width / 2.0, height / 2.0)
                .density(part.density)
                .friction(part.friction)
                .collision_groups(groups(body, ground));
            bodies.push(world.insert(rigid, collider).0);
        }
        let mut joints = Vec::new();
        for hinge in blueprint.hinges() {
            let motor = hinge.motor.expect("all shipped hinges have motors");
            let at = |[x, y]: [f32; 2]| Vector::new(x, y);
            let joint = RevoluteJointBuilder::new()
                .local_anchor1(at(hinge.parent_anchor))
                .local_anchor2(at(hinge.child_anchor))
                .contacts_enabled(false)
                .limits(hinge.limits)
                .motor_model(MotorModel::ForceBased)
                .motor_velocity(0.0, 20.0)
                .motor_max_force(motor.top_torque)
                .softness(SpringCoefficients::new(60.0, 1.0));
            let handle = world.insert_impulse_joint(bodies[hinge.parent], bodies[hinge.child], joint);
            let scale = 2.0 * 3.0 / (2.0 * hinge.limits[1]);
            joints.push((hinge.parent, hinge.child, handle, scale, motor.top_speed));
        }
        let outputs = joints.len();
        let net = controller(outputs + 1, outputs);
        settle(&mut world, &bodies);
        Self { world, bodies, joints, net, inputs: vec![0.0; outputs + 1], outputs: vec![0.0; outputs] }
    }

    fn control(&mut self) {
        let Self { world, bodies, joints, net, inputs, outputs } = self;
        let bodies = |index: usize| world.bodies[bodies[index]].rotation();
        inputs[0] = bodies(0).angle() * (3.0 / std::f32::consts::PI);
        for (input, &(parent, child, _, scale, _)) in inputs[1..].iter_mut().zip(&*joints) {
            *input = ((bodies(parent).inverse() * *bodies(child)).angle() * scale).clamp(-3.0, 3.0);
        }
        net.activate(inputs, outputs);
        for (output, &(_, _, handle, _, top_speed)) in outputs.iter().zip(&*joints) {
            let joint = world.impulse_joints.get_mut(handle, false).expect("it is there");
            joint.data.set_motor_velocity(JointAxis::AngX, output * top_speed, 20.0);
        }
    }
}

/// As the environment does it, so that both do the same work afterwards.
fn settle(world: &mut PhysicsWorld, bodies: &[RigidBodyHandle]) {
    let mut still = 0;
    for _ in 0..50 {
        if still == 10 {
            break;
        }
        world.step();
        let rests = |&body: &RigidBodyHandle| {
            let (linear, angular) = (world.bodies[body].linvel(), world.bodies[body].angvel());
            linear.x.abs().max(linear.y.abs()).max(angular.abs()) < 0.005
        };
        still = if bodies.iter().all(rests) { still + 1 } else { 0 };
    }
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("1000 steps");
    group.sample_size(20).measurement_time(Duration::from_secs(3)).warm_up_time(Duration::from_millis(500));
    for name in ["biped-1", "tetrapod-2", "decapod-2", "apod"] {
        let blueprint = blueprint(name);
        let sensors = blueprint.creature().sensors.clone();
        let environment =
            RapierEnvironment::new(blueprint.clone(), &sensors, 3.0, PhysicsSettings::default(), Variation::default())
                .expect("builds");
        let mut net = controller(environment.senses().len(), environment.motors().len());
        let episode = Episode::new(environment, Box::new(Running::default()), STEPS, Trials::default()).expect("valid");
        let mut ours = 0.0;
        episode.play(&mut net, Seed::of_run(1), &mut |moment: &Moment<'_>| ours = moment.snapshot.torso().x);
        let mut bare = Bare::new(&blueprint);
        for _ in 0..STEPS {
            bare.control();
            bare.world.step();
        }
        let theirs = bare.world.bodies[bare.bodies[0]].translation().x;
        println!("{name}: after {STEPS} steps the torso is at {ours} m, in the bare world at {theirs} m");
        group.bench_function(BenchmarkId::new("whole", name), |bench| {
            bench.iter(|| black_box(episode.play(&mut net, Seed::of_run(1), &mut ()).outcome.steps));
        });
        group.bench_function(BenchmarkId::new("bare", name), |bench| {
            bench.iter_batched(
                || Bare::new(&blueprint),
                |mut bare| {
                    for _ in 0..STEPS {
                        bare.control();
                        bare.world.step();
                    }
                    bare
                },
                criterion::BatchSize::LargeInput,
            );
        });
        group.bench_function(BenchmarkId::new("physics alone", name), |bench| {
            bench.iter_batched(
                || Bare::new(&blueprint),
                |mut bare| {
                    for _ in 0..STEPS {
                        bare.world.step();
                    }
                    bare
                },
                criterion::BatchSize::LargeInput,
            );
        });
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
