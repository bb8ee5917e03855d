use super::*;
use tasks::{BodyHinge, BodyMotor, BodyPart};

/// A body with parts of these names, all of which hang on the first, and are moved if their names say so.
fn body(names: &[&str]) -> Body {
    let part = |name: &&str| BodyPart {
        name: (*name).into(),
        mass: 1.0,
        inertia: 1.0,
        buoyancy: 0.0,
        corners: vec![[0.0, 0.0]],
        radius: 0.1,
    };
    let hinge = |(child, name): (usize, &&str)| {
        let motor = name.contains("leg").then_some(BodyMotor { top_speed: 1.0, top_torque: 3.0 });
        BodyHinge { child, motor, limits: [-1.0, 1.0], ..BodyHinge::default() }
    };
    Body {
        body_length: 1.0,
        start_height: 1.0,
        gravity: 9.81,
        parts: names.iter().map(part).collect(),
        hinges: names.iter().enumerate().skip(1).map(hinge).collect(),
        ..Body::default()
    }
}

fn odd() -> Body {
    body(&["torso", "a \"long\", bent\nleg", "head"])
}

fn recording() -> Recording {
    let part = |x: f32, angle: f32| PartState {
        x,
        y: 0.1,
        cos: angle.cos(),
        sin: angle.sin(),
        vx: 1.0 / 7.0 + x,
        vy: -x / 3.0,
        spin: 0.1 * angle,
        touching: x > 0.5,
    };
    let snapshot = |step: u8| {
        let time = f32::from(step) * 0.02;
        let parts = vec![part(time, 0.3), part(1.0 / 3.0 + time, -3.0), part(time, 0.0)];
        Snapshot { time, parts, motor_work: 0.0, ..Snapshot::default() }
    };
    let torques = (0..20_u8).map(|step| vec![f32::from(step) / 3.0 - 2.0]).collect();
    Recording { snapshots: (0..20).map(snapshot).collect(), activations: Vec::new(), torques }
}

fn written(recording: &Recording) -> String {
    let mut csv = Vec::new();
    recording.write_csv(&odd(), &mut csv).expect("memory");
    String::from_utf8(csv).expect("text")
}

#[test]
fn what_is_written_is_read_again() {
    let text = written(&recording());
    let header =
        "step,time_s,part,x_m,y_m,angle_rad,ground_contact,vx_m_per_s,vy_m_per_s,spin_rad_per_s,motor_torque_n_m\n";
    assert!(text.starts_with(header), "{text}");
    let read = read_csv(&text, &odd()).expect("what was written");
    assert_eq!((read.snapshots.len(), read.speeds_known, read.work_known), (20, true, true));
    // The second name takes two lines.
    assert_eq!(read.lines[..3], [2, 6, 10]);
    let mut work = 0.0;
    for (step, (read, was)) in read.snapshots.iter().zip(&recording().snapshots).enumerate() {
        assert_eq!(read.time, was.time);
        for (read, was) in read.parts.iter().zip(&was.parts) {
            assert_eq!((read.x, read.y, read.touching), (was.x, was.y, was.touching));
            assert_eq!((read.vx, read.vy, read.spin), (was.vx, was.vy, was.spin), "to the bit");
            assert!((read.cos - was.cos).abs() < 1e-6 && (read.sin - was.sin).abs() < 1e-6);
        }
        if step > 0 {
            work += f64::from((step as f32 / 3.0 - 2.0) * (was.parts[1].spin - was.parts[0].spin)).abs() * 0.02;
        }
        assert!((read.motor_work - work).abs() < 1e-6, "{step}: {} {work}", read.motor_work);
    }
    assert!(work > 0.1);
    assert!(read.trajectory(&odd()).is_ok());
}

/// What was watched has no torques; what other programs write may have no speeds either.
#[test]
fn what_the_file_does_not_hold_is_not_known() {
    let watched = written(&Recording { torques: Vec::new(), ..recording() });
    assert!(!watched.contains("torque"), "{watched}");
    let read = read_csv(&watched, &odd()).expect("without torques");
    assert_eq!((read.speeds_known, read.work_known), (true, false));
    assert_eq!(read.snapshots[3].parts[1].vx, recording().snapshots[3].parts[1].vx);
    let old = watched.replace(",vx_m_per_s,vy_m_per_s,spin_rad_per_s", ",a,b,c");
    let read = read_csv(&old, &odd()).expect("without speeds");
    assert_eq!((read.speeds_known, read.work_known, read.snapshots[3].parts[1].vx), (false, false, 0.0));
    assert!(read.trajectory(&odd()).is_ok());
}

#[test]
fn columns_and_parts_may_be_in_another_order() {
    let text = "part,step,time_s,x_m,y_m,note,ground_contact,angle_rad\r\nb,0,0,1,2,hm,1,0\r\na,0,0,3,4,,0,0\r\n\r\n";
    let read = read_csv(text, &body(&["a", "b"])).expect("valid");
    let [a, b] = &read.snapshots[0].parts[..] else { panic!("two parts") };
    assert_eq!((a.x, a.y, a.touching, b.x, b.y, b.touching), (3.0, 4.0, false, 1.0, 2.0, true));
}

const HEADER: &str = "step,time_s,part,x_m,y_m,angle_rad,ground_contact\n";
const GOOD: &str = "0,0,torso,0,1,0,0\n0,0,leg,0,0,0,1\n1,0.02,torso,0,1,0,0\n1,0.02,leg,0,0,0,1\n";

fn refusal(text: &str) -> String {
    read_csv(text, &body(&["torso", "leg"])).expect_err(text).to_string()
}

#[test]
fn what_is_wrong_is_named_with_its_line() {
    let changed = |from: &str, to: &str| {
        assert!(GOOD.contains(from), "{from}");
        refusal(&format!("{HEADER}{}", GOOD.replacen(from, to, 1)))
    };
    assert!(read_csv(&format!("{HEADER}{GOOD}"), &body(&["torso", "leg"])).is_ok());
    assert_eq!(refusal(""), "line 1: expected the columns step,time_s,part,x_m,y_m,angle_rad,ground_contact");
    assert!(refusal(GOOD).starts_with("line 1: the column \"step\" is missing; expected step,time_s,"));
    assert!(refusal(&HEADER.replace(",y_m", "")).starts_with("line 1: the column \"y_m\" is missing"));
    assert_eq!(changed("1,0.02,torso,0,1", "1,0.02,torso,0,high"), "line 4: y_m is \"high\", expected a finite number");
    assert_eq!(changed("0,0,leg,0", "0,0,leg,inf"), "line 3: x_m is \"inf\", expected a finite number");
    assert_eq!(
        changed("1,0.02,leg,0,0,0,1", "1,0.02,leg,0,0,0,yes"),
        "line 5: ground_contact is \"yes\", expected 0 or 1"
    );
    assert_eq!(
        changed("0,0,leg", "0,0,legs"),
        "line 3: there is no part \"legs\"; did you mean \"leg\"? (there are: torso, leg)"
    );
    assert_eq!(changed("0,0,leg", "0,0,torso"), "line 3: step 0 has the part \"torso\" twice");
    assert_eq!(changed("0,0,leg,0,0,0,1\n", ""), "line 3: step 0 ends without the part \"leg\"");
    assert_eq!(changed("1,0.02,leg,0,0,0,1\n", ""), "line 4: step 1 ends without the part \"leg\"");
    assert_eq!(changed("1,0.02,torso", "3,0.02,torso"), "line 4: step 3 is out of order, expected 0 or 1");
    assert_eq!(changed("0,0,torso", "1,0,torso"), "line 2: step 1 is out of order, expected 0");
    assert_eq!(changed("1,0.02,torso", "1.5,0.02,torso"), "line 4: step is \"1.5\", expected a whole number");
    assert_eq!(changed("1,0.02,leg", "1,0.03,leg"), "line 5: time_s is 0.03, but 0.02 in the rows before of step 1");
    assert_eq!(changed("0,0,leg,0,0,0,1", "0,0,leg,0,0,0"), "line 3: 6 fields, the header has 7");
    assert_eq!(changed("0,0,leg", "0,0,\"leg"), "line 3: a quotation mark is never closed");
}

#[test]
fn what_is_wrong_with_speeds_and_torques_is_named_too() {
    let header = format!("{},vx_m_per_s,vy_m_per_s,spin_rad_per_s,motor_torque_n_m\n", HEADER.trim_end());
    let rows = |torso: &str, leg: &str| {
        let ends = [torso, leg, torso, leg];
        GOOD.lines().zip(ends).map(|(row, end)| format!("{row},{end}\n")).collect::<String>()
    };
    let with = |torso: &str, leg: &str| format!("{header}{}", rows(torso, leg));
    for torso in ["0,0,0,", "0,0,0,0", "0,0,0, "] {
        assert!(read_csv(&with(torso, "1,2,3,4"), &body(&["torso", "leg"])).is_ok(), "{torso}");
    }
    let finite = "expected a finite number";
    assert_eq!(refusal(&with("0,0,0,", "1,fast,3,4")), format!("line 3: vy_m_per_s is \"fast\", {finite}"));
    assert_eq!(refusal(&with("0,0,,", "1,2,3,4")), format!("line 2: spin_rad_per_s is \"\", {finite}"));
    assert_eq!(refusal(&with("0,0,0,", "1,2,3,NaN")), format!("line 3: motor_torque_n_m is \"NaN\", {finite}"));
    assert_eq!(refusal(&with("0,0,0,", "1,2,3,")), format!("line 3: motor_torque_n_m is \"\", {finite}"));
    assert_eq!(
        refusal(&with("0,0,0,7", "1,2,3,4")),
        "line 2: motor_torque_n_m is 7, expected 0 or nothing: \"torso\" hangs on no motor of a controller"
    );
    let whole = with("0,0,0,", "1,2,3,4");
    for (column, name) in [("vx_m_per_s", "vx"), ("vy_m_per_s", "vy"), ("spin_rad_per_s", "spin")] {
        assert_eq!(
            refusal(&whole.replace(column, name)),
            format!("line 1: the column \"{column}\" is missing; expected vx_m_per_s,vy_m_per_s,spin_rad_per_s")
        );
    }
}

/// A body whose parts move by 1 m/s to the right and turn by 1 rad/s, and what its file says of that.
fn moving(speeds: [&str; 3], torque: &str) -> String {
    let row = |step: usize, part: &str, torque: &str| {
        let (time, [vx, vy, spin]) = (step as f32 * 0.02, speeds);
        format!("{step},{time},{part},{time},1,{time},0,{vx},{vy},{spin},{torque}\n")
    };
    let rows: String = (0..20).flat_map(|step| [row(step, "torso", "0"), row(step, "leg", torque)]).collect();
    format!("{},vx_m_per_s,vy_m_per_s,spin_rad_per_s,motor_torque_n_m\n{rows}", HEADER.trim_end())
}

#[test]
fn speeds_of_another_film_and_torques_beyond_the_motors_are_refused() {
    assert!(read_csv(&moving(["1", "0", "1"], "6"), &body(&["torso", "leg"])).is_ok());
    assert!(read_csv(&moving(["1.4", "0.4", "0.5"], "-6"), &body(&["torso", "leg"])).is_ok());
    assert_eq!(
        refusal(&moving(["100", "0", "1"], "1")),
        "line 1: by the positions the parts move at 1.00 m/s on average, and vx_m_per_s and vy_m_per_s are 99.00 m/s off that: correct \
         them, or leave out the columns of speeds and torques"
    );
    assert_eq!(
        refusal(&moving(["1", "0", "1"], "-6.5")),
        "line 3: motor_torque_n_m is -6.5, but the motor of \"leg\" gives at most 3 N·m"
    );
}

#[test]
fn a_column_that_is_read_is_there_once() {
    let twice = |name: &str| refusal(&format!("{},{name}\n{}", HEADER.trim_end(), GOOD.replace('\n', ",0\n")));
    for name in ["step", "x_m", "ground_contact"] {
        assert_eq!(twice(name), format!("line 1: the column \"{name}\" is there twice"));
    }
    let note = format!("{},note,note\n{}", HEADER.trim_end(), GOOD.replace('\n', ",,\n"));
    assert!(read_csv(&note, &body(&["torso", "leg"])).is_ok());
}

#[test]
fn commands_are_written_where_there_are_any_and_read_again() {
    let mut told = recording();
    let mut before = Command::default();
    for (step, snapshot) in told.snapshots.iter_mut().enumerate() {
        let speed = if step < 10 { 0.0 } else { 1.0 / 3.0 };
        before = before.then(speed, (5..8).contains(&step), snapshot.time, 0.02);
        snapshot.command = before;
    }
    let text = written(&told);
    assert!(text.lines().next().is_some_and(|header| header.ends_with(",commanded_body_lengths_per_s,told_to_jump")));
    let read = read_csv(&text, &odd()).expect("what was written");
    assert!(read.commands_known && !read_csv(&written(&recording()), &odd()).expect("untold").commands_known);
    for (read, was) in read.snapshots.iter().zip(&told.snapshots) {
        assert_eq!((read.command.speed, read.command.jump), (was.command.speed, was.command.jump));
        assert_eq!(read.command.stride_began, was.command.stride_began);
        let (read, was) = (read.command.since_press, was.command.since_press);
        assert!(read == was || (read - was).abs() < 1e-5, "{read} {was}");
    }
    let header = format!("{},commanded_body_lengths_per_s,told_to_jump\n", HEADER.trim_end());
    let with = |ends: [&str; 4]| {
        header.clone() + &GOOD.lines().zip(ends).map(|(row, end)| format!("{row},{end}\n")).collect::<String>()
    };
    assert_eq!(
        refusal(&with(["0,0", "0,0", "fast,0", "1,0"])),
        "line 4: commanded_body_lengths_per_s is \"fast\", expected a finite number"
    );
    assert_eq!(refusal(&with(["0,0", "0,0", "1,2", "1,0"])), "line 4: told_to_jump is \"2\", expected 0 or 1");
    assert_eq!(
        refusal(&with(["0,0", "0,0", "1,0", "2,0"])),
        "line 5: another command than in the rows before of step 1"
    );
    assert!(refusal(&header.replace(",told_to_jump", "")).contains("the column \"told_to_jump\" is missing"));
}
