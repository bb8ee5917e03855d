//! The terms that pay for a jump and for what comes after it.

use super::{Pose, puppet, script, sine, value};
use tasks::{Body, Jumping, Landing, Leap, PartState, Snapshot};

#[test]
fn leap_is_the_rise_in_a_flight_that_all_legs_begin_together() {
    /// From `up` to `down` nothing touches the ground, and the torso rises to 0.3 m and back; the left leg left the
    /// ground `earlier` seconds before.
    fn jump(up: f32, down: f32, earlier: f32) -> Vec<Snapshot> {
        script(3.0, move |time| {
            let share = ((time - up) / (down - up)).clamp(0.0, 1.0);
            let flies = time > up && time < down;
            let lifted = |flies: bool| if flies { 0.1 } else { 0.0 };
            let rise = 1.2 * share * (1.0 - share);
            Pose { rise, lifted: [lifted(time > up - earlier && time < down), lifted(flies)], ..Pose::default() }
        })
    }
    let body = puppet();
    let leap = |script: &[Snapshot]| value(Leap::default(), &body, script);
    let high = leap(&jump(1.0, 1.5, 0.0));
    // It rises by 0.366 m, the legs besides; a quarter counts of what is beyond half of the start height.
    assert!((high - (0.25 + 0.25 * 0.116)).abs() < 0.01, "{high}");
    let lasts =
        |seconds: f32| jump(1.0, 1.5, 0.0).into_iter().take_while(|now| now.time < 1.5 + seconds).collect::<Vec<_>>();
    assert_eq!((leap(&lasts(0.4)), leap(&lasts(0.2))), (high, 0.25 * high), "a quarter for a landing not survived");
    // A foot that leaves the ground for a moment is no leap.
    let mut bounces = lasts(0.2);
    let aloft = bounces.iter().position(|now| now.aloft()).expect("it leaps");
    let (index, aloft) = (bounces.len() - 5, bounces[aloft].parts.clone());
    let touching = |parts: &[PartState]| parts.iter().map(|part| part.touching).collect::<Vec<_>>();
    for (part, &touches) in bounces[index].parts.iter_mut().zip(&touching(&aloft)) {
        part.touching = touches;
    }
    assert_eq!(leap(&bounces), 0.25 * high, "nor is a bounce a landing that is survived");
    assert!((leap(&jump(1.0, 1.5, 0.09)) - high).abs() < 1e-6);
    let uneven = leap(&jump(1.0, 1.5, 0.2));
    assert!(uneven > 0.05 && uneven < 0.4 * high, "{uneven}");
    assert_eq!(leap(&jump(1.0, 1.5, 0.45)), 0.0, "one leg after the other");
    assert_eq!(leap(&jump(1.0, 1.14, 0.0)), 0.0, "a stumble");
    // Two leaps: the higher one counts, and landing in between ends the first.
    let twice: Vec<Snapshot> = jump(1.0, 1.5, 0.0).into_iter().chain(jump(1.0, 1.3, 0.3)).collect();
    assert_eq!(leap(&twice), high);
    let stretches = script(2.0, |time| Pose { rise: 0.3 * sine(0.5, time), ..Pose::default() });
    assert_eq!(leap(&stretches), 0.0);
    assert!(value(Jumping::default(), &body, &stretches) > 0.29);
    let on_its_belly = script(2.0, |_| Pose { lifted: [0.1; 2], rise: 0.3, torso_touches: true, ..Pose::default() });
    assert_eq!(leap(&on_its_belly), 0.0);
    let legless = Body { legless: true, ..puppet() };
    let crawler = value(Leap::default(), &legless, &jump(1.0, 1.5, 0.5));
    assert!(
        (crawler - 0.366).abs() < 0.01,
        "{crawler}: it has no legs to push off, and rises by less than 0.4 body lengths"
    );
}

#[test]
fn landing_is_the_time_after_a_leap_and_less_of_it_where_the_body_leaps_on_tilted() {
    // In the air from 1 to 1.6 s, the torso turned from 0.9 s on.
    let leaps = |degrees: f32, until: f32| {
        script(until, move |time| {
            let share = ((time - 1.0) / 0.6).clamp(0.0, 1.0);
            let lifted = if share > 0.0 && share < 1.0 { 0.1 } else { 0.0 };
            let turn = if time > 0.9 { degrees.to_radians() } else { 0.0 };
            Pose { rise: 1.2 * share * (1.0 - share), turn, lifted: [lifted; 2], ..Pose::default() }
        })
    };
    let body = puppet();
    let landing = |degrees: f32, until: f32| value(Landing::default(), &body, &leaps(degrees, until));
    // It is a leap after 0.22 s, and from its end on the next has 1.2 s.
    let on = landing(0.0, 2.75);
    assert!((on - 1.53).abs() < 0.03, "{on}");
    assert!((landing(0.0, 4.0) - on - 1.25).abs() < 0.03, "then it stands");
    for (degrees, share) in [(22.5, 0.75), (-45.0, 0.0), (90.0, 0.0)] {
        let tilted = landing(degrees, 2.75);
        assert!((tilted / on - share).abs() < 1e-3, "{degrees}°: {tilted} of {on}");
    }
    assert!((landing(22.5, 4.0) - landing(22.5, 2.75)).abs() < 0.1, "what is tilted does not stand");
    // A hop of 0.24 s that is no leap, from 2 s on: the body stands after it.
    let hops = script(3.4, move |time| {
        let share = ((time - 1.0) / 0.6).clamp(0.0, 1.0);
        let hop = ((time - 2.0) / 0.26).clamp(0.0, 1.0);
        let aloft = (share > 0.0 && share < 1.0) || (hop > 0.0 && hop < 1.0);
        let rise = 1.2 * share * (1.0 - share) + 0.2 * hop * (1.0 - hop);
        Pose { rise, lifted: [if aloft { 0.1 } else { 0.0 }; 2], ..Pose::default() }
    });
    let hopped = value(Landing::default(), &body, &hops);
    assert!(hopped > landing(0.0, 3.4) - 0.45, "{hopped} of {}", landing(0.0, 3.4));
    let legless = Body { legless: true, ..puppet() };
    let turned = value(Landing::default(), &legless, &leaps(45.0, 2.75));
    assert!((turned - on).abs() < 0.1, "{turned}: a body without legs may turn");
}
