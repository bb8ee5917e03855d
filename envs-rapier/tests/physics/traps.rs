//! Each test measures with our settings, then undoes one of them and sees the trap close.

use crate::gauge::*;
use envs_rapier::PhysicsSettings;

/// The worst value of a gauge over three restless programs of 10 s.
fn worst(name: &str, settings: PhysicsSettings, gauge: impl Fn(&creatures::Blueprint, &tasks::Snapshot) -> f32) -> f32 {
    use tasks::Environment;
    let blueprint = blueprint(name);
    let mut environment = environment(blueprint.clone(), settings);
    let mut worst = f32::NEG_INFINITY;
    for seed in 0..3 {
        let program = restless(seed, environment.outputs(), 500);
        run(&mut environment, &program, |environment| worst = worst.max(gauge(&blueprint, environment.snapshot())));
    }
    worst
}

#[test]
fn probe_numbers() {
    let d = PhysicsSettings::default();
    for name in ["biped-1", "tetrapod-2", "apod", "decapod-2"] {
        println!("{name}: limit {} undone {}", worst(name, d, limit_overshoot), worst(name, PhysicsSettings { corrective_speed: 3.0, ..d }, limit_overshoot));
        println!("{name}: joint {} ccd1 {} pgs1 {}", worst(name, d, joint_error), worst(name, PhysicsSettings { continuous_collision_substeps: 1, ..d }, joint_error), worst(name, PhysicsSettings { internal_iterations: 1, ..d }, joint_error));
        println!("{name}: sink {} undone {}", worst(name, d, penetration), worst(name, PhysicsSettings { prediction_distance: 0.02, ..d }, penetration));
    }
}
#[test]
fn probe_two() {
    use tasks::Environment;
    let d = PhysicsSettings { settle_time: 0.0, ..PhysicsSettings::default() };
    for (h, p) in [(0.0, 0.1), (3.0, 0.1), (3.0, 0.02), (10.0, 0.1), (10.0, 0.02), (20.0, 0.02)] {
        for ccd in [0, 1] {
            let mut c = creatures::find("tetrapod-2").unwrap();
            for part in &mut c.parts { part.position[1] += h; }
            for j in &mut c.joints { j.anchor[1] += h; }
            let b = creatures::Blueprint::new(c).unwrap();
            let mut e = environment(b.clone(), PhysicsSettings { continuous_collision_substeps: ccd, prediction_distance: p, ..d });
            let mut w = 0f32; let mut s = 0f32; let mut eg = 0f64; let e0 = energy(&b, e.snapshot(), 9.81);
            let prog = vec![vec![0.0; e.outputs()]; 250];
            run(&mut e, &prog, |e| { w = w.max(joint_error(&b, e.snapshot())); s = s.max(penetration(&b, e.snapshot())); eg = eg.max(energy(&b, e.snapshot(), 9.81) - e0); });
            println!("h {h} p {p} ccd {ccd}: joint {w} sink {s} gain {eg}");
        }
    }
    for name in ["biped-1", "tetrapod-2", "apod"] { for f in [60.0, 1e6] {
        let mut c = creatures::find(name).unwrap();
        for part in &mut c.parts { part.position[1] += 1.0; }
        for j in &mut c.joints { j.anchor[1] += 1.0; j.motor = j.motor.map(|m| creatures::Motor { top_torque: 0.01, ..m }); }
        let b = creatures::Blueprint::new(c).unwrap();
        let mut e = environment(b.clone(), PhysicsSettings { joint_frequency: f, ..d });
        let e0 = energy(&b, e.snapshot(), 9.81); let mut eg = 0f64; let mut up = 0f64; let mut last = e0;
        let prog = vec![vec![0.0; e.outputs()]; 500];
        run(&mut e, &prog, |e| { let en = energy(&b, e.snapshot(), 9.81); eg = eg.max(en - e0); up += (en - last).max(0.0); last = en; });
        println!("{name} f {f}: gain over start {eg}, ups {up}, e0 {e0}");
    }}
    for (torque, speed) in [(50.0, 12.0), (50.0, 8.0), (30.0, 12.0), (30.0, 8.0), (20.0, 10.0), (15.0, 8.0)] { for gain in [20.0, 10.0] {
        let mut c = creatures::find("apod").unwrap();
        for j in &mut c.joints { j.motor = Some(creatures::Motor { top_torque: torque, top_speed: speed }); }
        let b = creatures::Blueprint::new(c).unwrap();
        let mut e = environment(b.clone(), PhysicsSettings { motor_gain: gain, ..PhysicsSettings::default() });
        let mut over = 0f32; let mut all = vec![];
        for seed in 0..3 { let prog = restless(seed, 6, 500); run(&mut e, &prog, |e| { let o = limit_overshoot(&b, e.snapshot()); over = over.max(o); all.push(o); }); }
        all.sort_by(f32::total_cmp);
        println!("apod {torque} {speed} gain {gain}: over {over} p99 {} p90 {}", all[all.len()*99/100], all[all.len()*9/10]);
    }}
}
