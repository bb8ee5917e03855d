use super::{limb::phases_of, *};
use crate::Registry;
use creatures::{Creature, Joint, Motor, Part, Sensor, Shape, Source};
use ne_core::Phenotype;
use ne_net::Topology;

const EXAMPLES: [&str; 6] = [
    include_str!("../../../../examples/creatures/biped-with-feet.json"),
    include_str!("../../../../examples/creatures/hexapod.json"),
    include_str!("../../../../examples/creatures/hopper.json"),
    include_str!("../../../../examples/creatures/long-apod.json"),
    include_str!("../../../../examples/creatures/tetrapod-on-its-back.json"),
    include_str!("../../../../examples/creatures/tripod.json"),
];

pub(super) fn all_creatures() -> Vec<Blueprint> {
    let shipped = creatures::shipped().iter().map(|creature| creatures::find(creature.name).expect("shipped"));
    let shipped = shipped.map(|creature| Blueprint::new(creature).expect("valid"));
    shipped.chain(EXAMPLES.iter().map(|text| Blueprint::from_json(text).expect("valid"))).collect()
}

/// A creature's senses, motors and limbs, and the topology made of them.
struct Made {
    name: String,
    senses: Senses,
    motors: Motors,
    limbs: Vec<Limb>,
    shape: SharedShape,
    names: Vec<String>,
}

impl Made {
    fn new(blueprint: &Blueprint, phases: LimbPhases) -> Self {
        let mut sensors = vec![
            Sensor::TorsoRotation,
            Sensor::JointAngles,
            Sensor::JointSpeeds,
            Sensor::TorsoSpin,
            Sensor::Clock { period: 1.0 },
        ];
        if !blueprint.feet().is_empty() {
            sensors.insert(1, Sensor::FootContacts);
            sensors.push(Sensor::FootSlip);
        }
        let senses = Senses::new(blueprint, &sensors, 1.0).expect("it has what is sensed");
        let motors = Motors::new(blueprint);
        let config = Registry::default().config("default", blueprint.creature().clone(), "running").expect("a preset");
        let controller = ControllerSettings { hidden: vec![2, 1], ..config.controller };
        let Limbs { topology: shape, names, .. } = topology(blueprint, &senses, &motors, &controller, phases);
        let limbs = limbs(blueprint, &senses, phases);
        Self { name: blueprint.name().into(), senses, motors, limbs, shape, names }
    }

    /// The ties of each limb's copy, as they follow each other.
    fn copies(&self) -> Vec<(&Limb, &[SharedWeight])> {
        let kinds = self.limbs.iter().map(|limb| limb.kind).max().unwrap_or(0) + 1;
        let in_order = (0..kinds).flat_map(|kind| self.limbs.iter().filter(move |limb| limb.kind == kind));
        let (mut neurons, mut ties) = (&self.shape.net.neurons[..], &self.shape.weights[..]);
        let mut copies = Vec::new();
        for limb in in_order {
            let (mine, rest) = neurons.split_at(3 + limb.hinges.len());
            let count = mine.iter().map(|neuron| neuron.sources.len() + usize::from(neuron.bias)).sum();
            let (mine, other_ties) = ties.split_at(count);
            copies.push((limb, mine));
            (neurons, ties) = (rest, other_ties);
        }
        assert!(neurons.is_empty() && ties.is_empty(), "{}: more than the copies", self.name);
        copies
    }

    /// Genes of which the copies have each their own: the wave along the body and the phase of each limb.
    fn own(&self) -> usize {
        1 + self.limbs.len()
    }

    /// Genes that look like chance; those of waves, phases and places are 0 if limbs are to be `alike`.
    fn genes(&self, alike: bool) -> Vec<f32> {
        let mut genes: Vec<f32> =
            (0..self.shape.gene_count()).map(|index| libm::sinf(3.7 * index as f32 + 1.0)).collect();
        if alike {
            genes[..self.own()].fill(0.0);
            let of_places = self.names.iter().zip(&mut genes).filter(|(name, _)| name.ends_with("place"));
            of_places.for_each(|(_, gene)| *gene = 0.0);
        }
        genes
    }

    /// What a limb's motors get when its clock stands at `phase`, its joints and its feet say `felt`, the first joint the
    /// first, and all other limbs are silent.
    fn answer(&self, limb: &Limb, phase: f32, felt: [f32; 2]) -> Vec<f32> {
        let sense = |source: Source| match source {
            Source::TorsoRotation => 0.3,
            Source::TorsoSpin => -0.2,
            Source::ClockSine { .. } => libm::sinf(phase),
            Source::ClockCosine { .. } => libm::cosf(phase),
            Source::JointAngle(hinge) | Source::JointSpeed(hinge) => {
                let place = limb.hinges.iter().position(|&mine| mine == hinge);
                place.map_or(0.0, |place| limb.sign * felt[0] / (1.0 + place as f32))
            }
            Source::Contact(part) => f32::from(u8::from(limb.parts.contains(&part))) * felt[1],
            Source::Slip(part) => f32::from(u8::from(limb.parts.contains(&part))) * 0.7 * felt[1],
            other => unreachable!("{other:?}"),
        };
        let inputs: Vec<f32> = self.senses.probes().iter().map(|probe| sense(probe.source)).collect();
        let mut outputs = vec![0.0; self.motors.len()];
        Topology::from(self.shape.clone()).network(&self.genes(true)).activate(&inputs, &mut outputs);
        let of = |&hinge: &usize| {
            let output = self.motors.drives().iter().position(|drive| drive.hinge == hinge).expect("a motor");
            limb.sign * outputs[output]
        };
        limb.hinges.iter().map(of).collect()
    }
}

fn has_foot(blueprint: &Blueprint, limb: &Limb) -> bool {
    limb.parts.iter().any(|part| blueprint.feet().contains(part))
}

/// Whether a gene counts in a weight.
fn mentions(tie: &SharedWeight, gene: usize) -> bool {
    let has = |terms: &[(usize, f32)]| terms.iter().any(|&(mine, _)| mine == gene);
    match tie {
        SharedWeight::Sum(terms) | SharedWeight::Affine { terms, .. } => has(terms),
        SharedWeight::Sine(turn) | SharedWeight::Cosine(turn) => turn.genes.contains(&gene) || has(&turn.phase_genes),
    }
}

#[track_caller]
fn assert_close(found: &[f32], expected: &[f32], what: &str) {
    let close = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-5);
    assert!(found.len() == expected.len() && close, "{what}: {found:?}, expected {expected:?}");
}

#[test]
fn every_motor_has_an_output_of_its_own_and_every_gene_a_weight() {
    for blueprint in all_creatures() {
        for phases in [LimbPhases::Alternating, LimbPhases::Together] {
            let made = Made::new(&blueprint, phases);
            let name = &made.name;
            assert_eq!(made.shape.validate(), Ok(()), "{name}");
            let net = &made.shape.net;
            assert_eq!((net.inputs, net.outputs.len()), (made.senses.len(), blueprint.actuated().len()), "{name}");
            let mut outputs = net.outputs.clone();
            outputs.sort_unstable();
            outputs.dedup();
            assert_eq!(outputs.len(), blueprint.actuated().len(), "{name}: two motors have one neuron");
            assert!(outputs[0] >= net.inputs, "{name}: a motor gets an input");
            let counts = |gene: usize| made.shape.weights.iter().any(|tie| mentions(tie, gene));
            assert!((0..made.shape.gene_count()).all(counts), "{name}: a gene counts in no weight");
            // Every input is the source of a neuron.
            let heard = |input: usize| net.neurons.iter().any(|neuron| neuron.sources.contains(&input));
            assert!((0..net.inputs).all(heard), "{name}");
        }
    }
}

#[test]
fn limbs_of_one_kind_share_all_genes_but_their_phases() {
    for blueprint in all_creatures() {
        let made = Made::new(&blueprint, LimbPhases::Alternating);
        let copies = made.copies();
        let genes = made.genes(false);
        let weights_of = |genes: &[f32]| -> Vec<Vec<f32>> {
            let shape = |ties: &[SharedWeight]| SharedShape { weights: ties.to_vec(), ..made.shape.clone() };
            copies.iter().map(|(_, ties)| shape(ties).weights(genes)).collect()
        };
        let before = weights_of(&genes);
        for gene in 0..genes.len() {
            let mut changed = genes.clone();
            changed[gene] += 0.5;
            let after = weights_of(&changed);
            let mentioning: Vec<usize> =
                (0..copies.len()).filter(|&copy| copies[copy].1.iter().any(|tie| mentions(tie, gene))).collect();
            for copy in 0..copies.len() {
                // What a place adds is nothing in the middle.
                let may_stay = !mentioning.contains(&copy) || copies[copy].0.place.abs() < 1e-4;
                let name = &made.name;
                assert!(before[copy] != after[copy] || may_stay, "{name}: gene {gene} does not count in copy {copy}");
                assert!(before[copy] == after[copy] || mentioning.contains(&copy), "{name}: gene {gene}, copy {copy}");
            }
            let of_kind =
                |kind: usize| -> Vec<usize> { (0..copies.len()).filter(|&copy| copies[copy].0.kind == kind).collect() };
            // In a caterpillar only the ends are feet: what weighs the ground counts in them alone.
            let with_feet = |kind: usize| -> Vec<usize> {
                of_kind(kind).into_iter().filter(|&copy| has_foot(&blueprint, copies[copy].0)).collect()
            };
            match gene {
                0 => assert_eq!(mentioning.len(), copies.len(), "{}: the wave goes through all", made.name),
                gene if gene < made.own() => assert_eq!(mentioning.len(), 1, "{}: phase gene {gene}", made.name),
                gene => {
                    let kind = copies[mentioning[0]].0.kind;
                    let shared = mentioning == of_kind(kind) || mentioning == with_feet(kind);
                    assert!(shared, "{}: gene {gene} counts only in {mentioning:?}", made.name);
                }
            }
        }
    }
}

#[test]
fn neighbours_do_the_same_half_a_turn_apart_or_together() {
    for blueprint in all_creatures() {
        for phases in [LimbPhases::Alternating, LimbPhases::Together] {
            let made = Made::new(&blueprint, phases);
            for one in &made.limbs {
                for other in made.limbs.iter().filter(|other| other.kind == one.kind) {
                    for clock in [0.0, 0.4, 2.5, 4.0] {
                        let feet = has_foot(&blueprint, one) && has_foot(&blueprint, other);
                        let felt = [0.6 - clock, f32::from(u8::from(feet))];
                        let ahead = one.phase - other.phase;
                        let (found, expected) =
                            (made.answer(other, clock + ahead, felt), made.answer(one, clock, felt));
                        assert_close(&found, &expected, &format!("{}, {clock}: {one:?}, {other:?}", made.name));
                    }
                }
            }
            let alternates = phases == LimbPhases::Alternating && !blueprint.is_legless();
            let phases_seen = made.limbs.iter().map(|limb| limb.phase);
            if alternates && made.limbs.len() > 1 {
                let halves = phases_seen.filter(|&phase| phase == PI).count();
                assert_eq!(halves, made.limbs.len() / 2, "{}", made.name);
            } else {
                assert!(phases_seen.clone().all(|phase| phase == 0.0), "{}", made.name);
            }
        }
    }
}

/// Front legs stretch where hind legs bend, if the torso tilts, and more than four feet are felt as one.
#[test]
fn legs_that_leap_together_know_their_place_and_many_feet_are_one() {
    for (name, own_foot) in [("tetrapod-2", true), ("decapod-1", false)] {
        let blueprint = Blueprint::new(creatures::find(name).expect("shipped")).expect("valid");
        let [apart, together] =
            [LimbPhases::Alternating, LimbPhases::Together].map(|phases| Made::new(&blueprint, phases).names);
        let has = |names: &[String], what: &str| names.iter().any(|name| name.contains(what));
        assert!(has(&together, ", by place") && !has(&apart, ", by place"), "{name}");
        assert!(has(&apart, "contact of foot") && !has(&apart, "contact of feet"), "{name}");
        assert_eq!(
            (has(&together, "contact of foot"), has(&together, "contact of feet")),
            (own_foot, !own_foot),
            "{name}"
        );
    }
}

#[test]
fn legs_beside_each_other_and_next_to_each_other_along_the_body_are_half_a_turn_apart() {
    let (front, middle, back) = (0.8, 0.0, -0.8);
    let phases = |places: &[f32]| phases_of(places, LimbPhases::Alternating, false);
    assert_eq!(phases(&[middle, middle]), [0.0, PI]);
    assert_eq!(phases(&[back, front]), [0.0, PI]);
    assert_eq!(phases(&[front, back]), [PI, 0.0], "from the back on, whatever the order");
    assert_eq!(phases(&[back, back, front, front]), [0.0, PI, PI, 0.0], "crosswise");
    assert_eq!(phases(&[back, middle, front]), [0.0, PI, 0.0]);
    assert_eq!(phases(&[back, front, back + 0.005]), [0.0, PI, PI], "as good as beside each other");
    assert_eq!(phases_of(&[back, front], LimbPhases::Together, false), [0.0, 0.0]);
    assert_eq!(phases_of(&[back, front], LimbPhases::Alternating, true), [0.0, 0.0]);
}

/// Otherwise both legs of a biped do the same when it is told to stand.
#[test]
fn where_the_clock_stops_legs_that_hang_from_one_place_are_told_apart() {
    let places = |name: &str, clock: Sensor| {
        let blueprint = Blueprint::new(creatures::find(name).expect("shipped")).expect("valid");
        let senses = Senses::new(&blueprint, &[clock], 1.0).expect("every body can hear a clock");
        let limbs = limbs(&blueprint, &senses, LimbPhases::Alternating);
        limbs.iter().map(|limb| limb.place).collect::<Vec<f32>>()
    };
    let (stops, runs_on) = (Sensor::StrideClock { period: 0.5, top: 1.5 }, Sensor::Clock { period: 0.5 });
    for biped in ["biped-1", "biped-2"] {
        assert_eq!(places(biped, stops.clone()), [-1.0, 1.0], "{biped}");
        assert_eq!(places(biped, runs_on.clone()), [0.0, 0.0], "{biped}");
    }
    for other in ["tetrapod-1", "decapod-2", "apod"] {
        assert_eq!(places(other, stops.clone()), places(other, runs_on.clone()), "{other}: places differ");
    }
}

/// What bends a caterpillar up before its middle turns the other way behind it.
#[test]
fn the_joints_of_apods_behind_the_torso_are_mirrored() {
    for blueprint in all_creatures().into_iter().filter(Blueprint::is_legless) {
        let made = Made::new(&blueprint, LimbPhases::Alternating);
        let (parts, hinges) = (blueprint.parts(), blueprint.hinges());
        assert_eq!(made.limbs.len(), blueprint.actuated().len(), "each joint is a limb");
        let mut mirrored = 0;
        for limb in &made.limbs {
            let hinge = &hinges[limb.hinges[0]];
            let behind = parts[hinge.child].x < parts[hinge.parent].x;
            assert_eq!(limb.sign, if behind { -1.0 } else { 1.0 }, "{}: {}", made.name, parts[hinge.child].name);
            mirrored += usize::from(behind);
        }
        assert!(mirrored > 0 && mirrored < made.limbs.len(), "{}: its torso is in the middle", made.name);
    }
}

/// A torso, and parts of 0.2 m that hang below each other: parent, tag, and whether there is a motor.
fn hanging(chain: &[(&str, &str, &str, bool)]) -> Blueprint {
    let mut creature = Creature::new("hanging");
    let part = |name: &str, tag: &str, position| Part {
        name: name.into(),
        tag: tag.into(),
        shape: Shape::Box { width: 0.1, height: 0.2 },
        density: 50.0,
        friction: 1.0,
        position,
        angle: 0.0,
        leg: true,
        look: Default::default(),
    };
    creature.parts.push(part("torso", "torso", [0.0, 0.9]));
    for &(name, parent, tag, motor) in chain {
        let above = creature.parts.iter().find(|part| part.name == parent).expect("it comes before").position;
        creature.parts.push(part(name, tag, [above[0], above[1] - 0.2]));
        creature.joints.push(Joint {
            parent: parent.into(),
            child: name.into(),
            anchor: [above[0], above[1] - 0.1],
            limits: [-60.0, 60.0],
            motor: motor.then_some(Motor { top_speed: 8.0, top_torque: 30.0 }),
        });
    }
    Blueprint::new(creature).expect("valid")
}

/// The hinges of each limb, and the names of its parts.
fn limbs_of(blueprint: &Blueprint) -> Vec<(Vec<usize>, Vec<&str>, usize)> {
    let names = |parts: &[usize]| parts.iter().map(|&part| blueprint.parts()[part].name.as_str()).collect();
    let made = Made::new(blueprint, LimbPhases::Alternating);
    assert_eq!(made.shape.validate(), Ok(()));
    assert!(made.shape.net.outputs.iter().all(|&output| output >= made.shape.net.inputs));
    made.limbs.iter().map(|limb| (limb.hinges.clone(), names(&limb.parts), limb.kind)).collect()
}

#[test]
fn passive_joints_are_no_ones_and_a_dangling_foot_is_felt_by_its_leg() {
    let leg = [
        ("thigh", "torso", "leg", true),
        ("shin", "thigh", "leg", false),
        ("foot", "shin", "leg", false),
        ("tail", "torso", "tail", true),
        ("horn", "torso", "leg", true),
    ];
    let blueprint = hanging(&leg);
    assert_eq!(limbs_of(&blueprint), [(vec![0], vec!["thigh", "shin", "foot"], 0), (vec![4], vec!["horn"], 0)]);
    let made = Made::new(&blueprint, LimbPhases::Alternating);
    assert!(made.answer(&made.limbs[0], 0.0, [0.0, 1.0]) != made.answer(&made.limbs[0], 0.0, [0.0, 0.0]));
}

#[test]
fn where_legs_branch_each_joint_is_moved_by_one_limb() {
    let branching = [
        ("thigh", "torso", "leg", true),
        ("left shin", "thigh", "leg", true),
        ("right shin", "thigh", "leg", true),
        ("right foot", "right shin", "leg", true),
    ];
    let left = (vec![0, 1], vec!["thigh", "left shin"], 0);
    let right = (vec![2, 3], vec!["thigh", "right shin", "right foot"], 0);
    assert_eq!(limbs_of(&hanging(&branching)), [left.clone(), right]);
    let alone = (vec![2], vec!["thigh", "right shin"], 1);
    assert_eq!(limbs_of(&hanging(&branching[..3])), [left, alone], "legs of two joints and of one are of two kinds");
}

/// Arms hang on a body that walks: they are moved, but what they learn is not what legs learn.
#[test]
fn arms_are_limbs_with_weights_of_their_own() {
    let mut creature = hanging(&[
        ("left thigh", "torso", "leg", true),
        ("left shin", "left thigh", "leg", true),
        ("left arm", "torso", "leg", true),
        ("left hand", "left arm", "leg", true),
        ("right arm", "torso", "leg", true),
        ("right hand", "right arm", "leg", true),
        ("tail", "torso", "leg", true),
        ("tip", "tail", "leg", true),
    ])
    .creature()
    .clone();
    for part in &mut creature.parts {
        match part.name.as_str() {
            "left arm" | "right hand" => part.leg = false,
            "tail" => (part.leg, part.tag) = (false, "tail".into()),
            _ => {}
        }
    }
    creature.actuated_tags.push("tail".into());
    let blueprint = Blueprint::new(creature).expect("valid");
    let leg = (vec![0, 1], vec!["left thigh", "left shin"], 0);
    let arms = [(vec![2, 3], vec!["left arm", "left hand"], 1), (vec![4, 5], vec!["right arm", "right hand"], 1)];
    let tail = (vec![6, 7], vec!["tail", "tip"], 2);
    assert_eq!(limbs_of(&blueprint), [leg, arms[0].clone(), arms[1].clone(), tail]);
    let names = Made::new(&blueprint, LimbPhases::Alternating).names;
    for name in
        ["2 joints, joint 0: threshold", "leg of 2 joints, joint 0: threshold", "tail of 2 joints, joint 0: threshold"]
    {
        assert!(names.iter().any(|found| found == name), "{name}: {names:?}");
    }
    let mut unique = names.clone();
    unique.sort();
    unique.dedup();
    assert_eq!(unique.len(), names.len(), "a name is one gene's");
}

/// A creature's senses with these jump clocks, its motors, and what its limbs are made of.
fn jumping(creature: &str, clocks: &[f32]) -> (Senses, Motors, Limbs) {
    let blueprint = Blueprint::new(creatures::find(creature).expect("shipped")).expect("valid");
    let mut sensors = vec![Sensor::TorsoRotation, Sensor::JointAngles, Sensor::StrideClock { period: 0.5, top: 1.5 }];
    sensors.extend(clocks.iter().map(|&period| Sensor::JumpClock { period }));
    let senses = Senses::new(&blueprint, &sensors, 3.0).expect("it has what is sensed");
    let motors = Motors::new(&blueprint);
    let config = Registry::default().config("default", blueprint.creature().clone(), "playing").expect("a preset");
    let limbs = topology(&blueprint, &senses, &motors, &config.controller, LimbPhases::Alternating);
    assert_eq!((limbs.topology.validate(), limbs.names.len()), (Ok(()), limbs.topology.gene_count()));
    (senses, motors, limbs)
}

/// What the motors are asked for so long after the press, s, with genes for which `changed` holds drawn anew.
fn jumper(body: &(Senses, Motors, Limbs), time: f32, changed: impl Fn(&str) -> bool) -> Vec<f32> {
    let (senses, motors, Limbs { topology: shape, names, .. }) = body;
    let gene = |(index, name): (usize, &String)| {
        let of = index as f32 * 0.9 + if changed(name) { 2.0 } else { 0.0 };
        libm::sinf(of)
    };
    let genes: Vec<f32> = names.iter().enumerate().map(gene).collect();
    let turn = |period: f32| if (0.0..period).contains(&time) { 2.0 * PI * time / period } else { 0.0 };
    let input = |(index, probe): (usize, &creatures::Probe)| match probe.source {
        Source::JumpSwell { period } => probe.scale(0.5 - 0.5 * libm::cosf(turn(period)), 3.0),
        Source::JumpSine { period } => probe.scale(libm::sinf(turn(period)), 3.0),
        _ => libm::cosf(index as f32),
    };
    let inputs: Vec<f32> = senses.probes().iter().enumerate().map(input).collect();
    let mut outputs = vec![0.0; motors.len()];
    Topology::from(shape.clone()).network(&genes).activate(&inputs, &mut outputs);
    outputs
}

/// What is learned of the jump does not change the stride, nor of one phase another, and of the stride not the jump. At times at
/// which games tick, 50, 60 and 120 times a second, one of them has the body.
#[test]
fn stride_and_phases_of_the_jump_each_have_the_body_alone() {
    let modules = ["hidden", "crouch", "push-off", "landing"];
    let [two_clocks, one_clock] = [&[0.6, 1.2][..], &[0.6]].map(|clocks| jumping("tetrapod-2", clocks));
    let counts = |body: &(Senses, Motors, Limbs), time: f32| -> Vec<&str> {
        let differs = |module: &&str| {
            let (one, other) = (jumper(body, time, |_| false), jumper(body, time, |name| name.contains(*module)));
            one.iter().zip(&other).any(|(one, other)| (one - other).abs() > 1e-4)
        };
        modules.into_iter().filter(differs).collect()
    };
    for (time, module) in [
        (-1.0, "hidden"),
        (0.04, "crouch"),
        (0.28, "crouch"),
        (0.34, "push-off"),
        (0.56, "push-off"),
        (0.6, "landing"),
        (0.9, "landing"),
        (1.16, "landing"),
        (1.2, "hidden"),
        (3.0, "hidden"),
    ] {
        assert_eq!(counts(&two_clocks, time), [module], "{time} s after the press");
        let alone = if module == "landing" { "hidden" } else { module };
        assert_eq!(counts(&one_clock, time), [alone], "{time} s after the press, with one clock");
    }
    let mut several = 0;
    for rate in [50.0, 60.0, 120.0] {
        for tick in 0..(1.3 * rate) as u32 {
            let found = counts(&two_clocks, tick as f32 / rate);
            assert!(!found.is_empty(), "nothing has the body after {tick} ticks of 1/{rate} s");
            several += usize::from(found.len() > 1);
        }
    }
    // Where one follows the other, both may have it for a tick.
    assert!(several <= 6, "two of them have the body at {several} ticks");
}

/// What a jump answers of a tilt, and whether it hears the stride.
#[test]
fn a_jump_of_many_legs_does_not_hear_the_stride() {
    for (creature, heard) in [("biped-1", true), ("tetrapod-2", true), ("decapod-1", false)] {
        let (_, _, Limbs { names, .. }) = jumping(creature, &[0.6, 1.2]);
        let has = |phase: &str, what: &str| names.iter().any(|name| name.contains(phase) && name.contains(what));
        for phase in ["crouch 0", "push-off 1", "landing 0"] {
            assert_eq!(has(phase, "stride clock"), heard, "{creature}, {phase}");
            assert!(has(phase, "rotation") && has(phase, ", by place"), "{creature}, {phase}");
            assert!(!has(phase, "jump clock"), "{creature}, {phase}: gates hear it");
        }
        assert!(has("hidden 0", "stride clock") && !has("hidden 0", ", by place"), "{creature}");
    }
}

/// Hips alone; of many legs those in the middle would stay straight by place.
#[test]
fn a_jump_begins_as_one_that_is_made_by_hand() {
    let by_place: &[(&str, f32)] = &[("crouch place", 1.0), ("push-off place", -1.0), ("landing place", 1.0)];
    let alike: &[(&str, f32)] = &[("crouch threshold", 0.7), ("push-off threshold", -0.7)];
    for (creature, kind, wanted) in [
        ("biped-1", "1 joints", by_place),
        ("biped-2", "2 joints", by_place),
        ("tetrapod-2", "2 joints", by_place),
        ("decapod-1", "1 joints", alike),
        ("decapod-2", "2 joints", alike),
        ("apod", "", &[]),
    ] {
        let (_, _, Limbs { names, by_hand, .. }) = jumping(creature, &[0.4, 0.8]);
        let found = names.iter().zip(&by_hand).filter(|&(_, &value)| value != 0.0);
        let found: Vec<(String, f32)> = found.map(|(name, &value)| (name.clone(), value)).collect();
        let named = |&(what, value): &(&str, f32)| (format!("{kind}, joint 0: {what}"), value);
        assert_eq!(found, wanted.iter().map(named).collect::<Vec<_>>(), "{creature}");
    }
}
