use crate::puppet::Puppet;
use creatures::{Blueprint, Sensor};
use envs_core::{
    Conditions, CreatureEnvironment, EnvironmentError, Ground, GroundShape, PhysicsSettings, Push, Variation,
};
use ne_core::Seed;
use tasks::{Commands, Environment, RandomCommands, conformance::check_environment};

fn blueprint(self_collision: bool) -> Blueprint {
    let mut creature = creatures::find("tetrapod-2").expect("shipped");
    creature.self_collision = self_collision;
    Blueprint::new(creature).expect("valid")
}

fn on_ground(blueprint: Blueprint, ground: Ground) -> Result<CreatureEnvironment<Puppet>, EnvironmentError> {
    let sensors = blueprint.creature().sensors.clone();
    let (settings, variation) = (PhysicsSettings::default(), Variation::default());
    CreatureEnvironment::on_ground(blueprint, &sensors, 3.0, settings, variation, ground)
}

fn varied(variation: Variation) -> CreatureEnvironment<Puppet> {
    let blueprint = blueprint(false);
    let sensors = blueprint.creature().sensors.clone();
    CreatureEnvironment::new(blueprint, &sensors, 3.0, PhysicsSettings::default(), variation).expect("builds")
}

#[test]
fn a_toy_engine_makes_an_environment_that_passes_the_conformance_kit() {
    for variation in [Variation::default(), Variation::light()] {
        assert_eq!(check_environment(&varied(variation), Seed::of_run(3)), Ok(()));
    }
}

/// The toy engine knows nothing but flat ground, and says so.
#[test]
fn bumps_are_on_the_ground_of_every_trial_and_not_on_that_of_the_settings() {
    let mut bumpy = varied(Variation { bumps: 0.02, ..Variation::default() });
    assert_eq!(*bumpy.ground(), Ground::flat());
    for trial in 0..3 {
        let refusal = bumpy.reset(Seed::of_run(1).trial(trial)).expect_err("must be refused").to_string();
        assert!(refusal.contains("the ground is not flat"), "{refusal}");
    }
}

/// The sensors of a tetrapod: rotation of the torso, then its joint angles, 0 in the start pose of its file.
#[test]
fn a_varied_start_pose_turns_each_actuated_joint_by_what_was_drawn() {
    let variation = Variation { start_pose: 0.3, time_step: [0.5, 1.5], ..Variation::default() };
    let mut environment = varied(variation);
    let (seed, motors) = (Seed::of_run(5), environment.outputs());
    environment.reset(seed).expect("settles");
    let mut inputs = vec![0.0; environment.inputs()];
    environment.sense(&mut inputs);
    let turns = variation.draw(seed, motors).turns;
    let channels = environment.senses().channels();
    let hinges = environment.blueprint().hinges();
    for ((&hinge, turn), (input, channel)) in
        environment.blueprint().actuated().iter().zip(turns).zip(inputs[1..].iter().zip(&channels[1..]))
    {
        let [low, high] = hinges[hinge].limits;
        let scale = 3.0 / low.abs().max(high.abs());
        assert!((input / scale - turn).abs() < 1e-4, "{}: {} rad, drawn {turn}", channel.name, input / scale);
    }
    assert_eq!(environment.snapshot().time, 0.0, "turning is over when the clock starts");
    assert!(environment.snapshot().parts.iter().all(|part| part.spin == 0.0), "motors hold still again");
}

#[test]
fn motors_are_asked_only_for_what_changes() {
    let friction_alone = Variation { friction: 0.1, ..Variation::default() };
    let mut environment = varied(friction_alone);
    let asked = |environment: &CreatureEnvironment<Puppet>| environment.motor_torques().map(f32::abs).sum::<f32>();
    environment.reset(Seed::of_run(1)).expect("settles");
    assert_eq!(asked(&environment), 0.0, "a start pose that does not vary asks no motor");
    let mut outputs = vec![0.0; environment.outputs()];
    environment.act(&outputs);
    assert_eq!(asked(&environment), 0.0, "motors hold still already");
    outputs[1] = 0.5;
    environment.act(&outputs);
    environment.act(&outputs);
    assert_eq!(asked(&environment), 1.0);
}

#[test]
fn a_varied_time_step_is_that_of_clock_and_work() {
    let variation = Variation { time_step: [0.5, 1.5], ..Variation::default() };
    let (mut environment, seed) = (varied(variation), Seed::of_run(2));
    assert_eq!(environment.time_step(), 0.02);
    environment.reset(seed).expect("settles");
    let time_step = 0.02 * variation.draw(seed, environment.outputs()).time_step;
    assert_ne!(time_step, 0.02);
    assert_eq!(environment.time_step(), time_step);
    assert_eq!(environment.settled(seed).expect("settles").time_step, time_step);
    let mut outputs = vec![0.0; environment.outputs()];
    outputs[0] = 1.0;
    environment.act(&outputs);
    for step in 1..=10_u8 {
        environment.step().expect("stable");
        assert_eq!(environment.snapshot().time, f32::from(step) * time_step);
    }
    // The puppet's one motor was asked once, so its torque is 1 N·m, at its top speed.
    let hinge = environment.actuated()[0].hinge;
    let top_speed = environment.blueprint().hinges()[hinge].motor.expect("it has one").top_speed;
    let expected = 10.0 * f64::from(top_speed) * f64::from(time_step);
    assert!((environment.snapshot().motor_work - expected).abs() < 1e-5 * expected);
}

#[test]
fn a_world_given_whole_is_that_of_every_trial() {
    let varied = varied(Variation::light());
    let seed = Seed::of_run(2);
    let conditions = Variation::light().draw(seed, varied.outputs());
    let mut fixed = varied.under(&conditions, Ground::flat()).expect("settles");
    assert_eq!(check_environment(&fixed, Seed::of_run(3)), Ok(()));
    let trial = varied.settled(seed).expect("settles");
    for seed in [seed, Seed::of_run(9)] {
        fixed.reset(seed).expect("settles");
        assert_eq!(*fixed.snapshot(), trial.snapshot);
        assert_eq!(fixed.time_step(), trial.time_step);
    }
    assert_eq!(fixed.settings().time_step, trial.time_step);
    let mass = |environment: &CreatureEnvironment<Puppet>| environment.body().expect("a creature").parts[0].mass;
    assert_eq!(mass(&fixed), mass(&varied) * conditions.mass, "a judge of a body's energy must know its mass");
    assert!(fixed.variation().is_none());
}

#[test]
fn conditions_are_in_the_settings_of_their_world() {
    let environment = varied(Variation::default());
    let conditions = Conditions {
        time_step: 0.5,
        gravity: 0.25,
        motor_gain: 4.0,
        joint_frequency: 2.0,
        contact_frequency: 0.5,
        contact_damping: 0.5,
        solver_iterations: Some(7),
        ..Conditions::reference(environment.outputs())
    };
    let world = environment.under(&conditions, Ground::flat()).expect("settles");
    let expected = PhysicsSettings {
        time_step: 0.01,
        gravity: 9.81 * 0.25,
        motor_gain: 80.0,
        joint_frequency: 120.0,
        contact_frequency: 30.0,
        contact_damping_ratio: 5.0,
        solver_iterations: 7,
        ..PhysicsSettings::default()
    };
    assert_eq!(*world.settings(), expected);
    let body = world.body().expect("a creature");
    assert_eq!(body.gravity, 9.81 * 0.25, "a judge of a body's weight must know the gravity");
}

#[test]
fn the_torso_spins_as_the_clock_starts() {
    let environment = varied(Variation::default());
    let conditions = Conditions { torso_spin: -0.25, ..Conditions::reference(environment.outputs()) };
    let world = environment.under(&conditions, Ground::flat()).expect("settles");
    let spins: Vec<f32> = world.snapshot().parts.iter().map(|part| part.spin).collect();
    assert_eq!(spins[0], -0.25);
    assert!(spins[1..].iter().all(|&spin| spin == 0.0), "{spins:?}");
    assert_eq!(world.snapshot().time, 0.0);
}

/// Nothing slows a puppet down, so that pushes add up.
#[test]
fn a_push_changes_the_torsos_velocity_before_the_first_step_that_begins_at_its_time() {
    let environment = varied(Variation::default());
    let push = |time, velocity| Push { time, velocity };
    let pushes = vec![push(0.05, -0.5), push(0.0, 1.0), push(0.05, 0.25), push(0.09, 2.0), push(9.0, 1.0)];
    let conditions = Conditions { pushes, ..Conditions::reference(environment.outputs()) };
    let mut world = environment.under(&conditions, Ground::flat()).expect("settles");
    let body = world.body().expect("a creature");
    let torso = body.parts[0].mass;
    let share = body.mass() / torso;
    assert!(share > 1.0, "a torso that is all of the body would not show");
    for _ in 0..2 {
        world.reset(Seed::of_run(1)).expect("settles");
        let mut moved = Vec::new();
        for _ in 0..8 {
            world.step().expect("stable");
            let parts = &world.snapshot().parts;
            assert!(parts[1..].iter().all(|part| part.vx == 0.0) && parts[0].vy == 0.0);
            moved.push(parts[0].vx / share);
        }
        let energy = 0.5 * f64::from(torso) * f64::from(world.snapshot().torso().vx).powi(2);
        assert!((world.snapshot().push_work / energy - 1.0).abs() < 1e-5, "{energy} J");
        // Steps begin at 0, 0.02, 0.04, 0.06, 0.08 and 0.1 s.
        let expected = [1.0, 1.0, 1.0, 0.75, 0.75, 2.75, 2.75, 2.75];
        let same = moved.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-5);
        assert!(same, "{moved:?}, not {expected:?}");
    }
}

#[test]
fn a_world_that_makes_no_sense_is_refused() {
    let environment = varied(Variation::default());
    let reference = Conditions::reference(environment.outputs());
    let refusal = |conditions: &Conditions, ground: Ground| {
        environment.under(conditions, ground).err().expect("must be refused").to_string()
    };
    let refusals = [
        (Conditions { mass: 0.0, ..reference.clone() }, "conditions.mass = 0: must be finite and above 0"),
        (Conditions { torque: f32::NAN, ..reference.clone() }, "conditions.torque = NaN: must be finite and above 0"),
        (Conditions { friction: -1.0, ..reference.clone() }, "conditions.friction = -1: must be finite and at least 0"),
        (Conditions { time_step: 4.0, ..reference.clone() }, "physics.time_step = 0.08: must be from 0.001 to 0.05"),
        (Conditions { gravity: -1.0, ..reference.clone() }, "conditions.gravity = -1: must be finite and at least 0"),
        (Conditions { motor_gain: 0.0, ..reference.clone() }, "conditions.motor_gain = 0: must be finite and above 0"),
        (
            Conditions { joint_frequency: f32::INFINITY, ..reference.clone() },
            "conditions.joint_frequency = inf: must be finite and above 0",
        ),
        (
            Conditions { contact_frequency: -1.0, ..reference.clone() },
            "conditions.contact_frequency = -1: must be finite and above 0",
        ),
        (
            Conditions { contact_damping: 0.0, ..reference.clone() },
            "conditions.contact_damping = 0: must be finite and above 0",
        ),
        (
            Conditions { contact_damping: 11.0, ..reference.clone() },
            "physics.contact_damping_ratio = 110: must be from 0.01 to 100",
        ),
        (
            Conditions { solver_iterations: Some(33), ..reference.clone() },
            "physics.solver_iterations = 33: must be from 1 to 32",
        ),
        (Conditions { torso_spin: f32::NAN, ..reference.clone() }, "conditions.torso_spin = NaN: must be finite"),
        (
            Conditions { pushes: vec![Push { time: -1.0, velocity: 0.1 }], ..reference.clone() },
            "conditions.pushes[0].time = -1: must be finite and at least 0",
        ),
        (
            Conditions { pushes: vec![Push { time: 1.0, velocity: 101.0 }], ..reference.clone() },
            "conditions.pushes[0].velocity = 101: must be from -100 to 100",
        ),
        (
            Conditions { turns: vec![], ..reference.clone() },
            "conditions.turns = 0 turns: must be 8, one for each actuated joint",
        ),
    ];
    for (conditions, says) in refusals {
        assert_eq!(refusal(&conditions, Ground::flat()), says);
    }
    assert_eq!(refusal(&reference, Ground { shapes: vec![] }), "ground.shapes = []: must be at least one shape");
}

#[test]
fn what_an_engine_cannot_simulate_is_refused_with_the_engines_name() {
    let refusal = |environment: Result<CreatureEnvironment<Puppet>, EnvironmentError>| {
        environment.err().expect("must be refused").to_string()
    };
    assert_eq!(
        refusal(on_ground(blueprint(true), Ground::flat())),
        "puppets cannot simulate this creature: its parts collide with each other"
    );
    let step = GroundShape::Box { x: 9.0, y: 0.0, width: 1.0, height: 0.2 };
    assert_eq!(
        refusal(on_ground(blueprint(false), Ground { shapes: vec![GroundShape::HalfSpace, step] })),
        "puppets cannot simulate this creature: the ground is not flat"
    );
    assert_eq!(
        refusal(on_ground(blueprint(false), Ground { shapes: vec![] })),
        "ground.shapes = []: must be at least one shape"
    );
}

/// A body that is told what to do senses it, shows it to movements, and forgets it with the trial.
#[test]
fn a_trial_is_told_its_own_commands() {
    let random = RandomCommands { still: 0.1, hold: [0.2, 0.4], jumps: 1.0, ..RandomCommands::default() };
    let sensors = [Sensor::TorsoRotation, Sensor::CommandedSpeed { top: 2.0 }, Sensor::JumpCommand];
    let told = |commands: Commands| {
        let (settings, variation) = (PhysicsSettings::default(), Variation::default());
        let puppet = CreatureEnvironment::<Puppet>::new(blueprint(false), &sensors, 3.0, settings, variation);
        puppet.expect("builds").with_commands(Some(commands), false)
    };
    let mut environment = told(Commands::Random(random)).expect("in range");
    let mut play = |seed: u64| {
        environment.reset(Seed::of_run(seed)).expect("settles");
        let mut sensed = Vec::new();
        for _ in 0..200 {
            let mut inputs = [0.0; 3];
            environment.sense(&mut inputs);
            let command = environment.snapshot().command;
            assert_eq!(inputs[1], 3.0 * command.speed / 2.0);
            assert_eq!(inputs[2] > 0.0, command.jump);
            sensed.push(command);
            environment.act(&[0.0; 8]);
            environment.step().expect("steps");
        }
        sensed
    };
    let first = play(1);
    assert!(first.iter().any(|command| command.jump) && first.iter().any(|command| command.speed > 0.0));
    assert_ne!(play(2), first);
    assert_eq!(play(1), first);
    let refused = told(Commands::Given(Vec::new())).err().expect("refused").to_string();
    assert!(refused.contains("commands.given = 0 changes"), "{refused}");
}
