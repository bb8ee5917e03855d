//! Settings of sensors.

use super::numbers::{check as check_number, check_count};
use crate::bounds::{CLOCK_PERIOD, COMMANDED_TOP, GAP_SIGHT, MOST_RAYS, MOST_SENSORS, RAY_ANGLE, RAY_LENGTH};
use crate::{Problem, Sensor};

/// Checks the sensors of a creature, or those a run gives it instead.
pub(crate) fn check(sensors: &[Sensor], has_feet: bool, problems: &mut Vec<Problem>) {
    if !check_count(|| "sensors".to_owned(), "sensors", sensors.len(), (1, MOST_SENSORS), problems) {
        return;
    }
    for (index, sensor) in sensors.iter().enumerate() {
        let path = format!("sensors[{index}]");
        if let Some(first) = sensors[..index].iter().position(|earlier| earlier == sensor) {
            problems.push(Problem::DuplicateSensor { path: path.clone(), sensor: sensor.name(), first });
        }
        match sensor {
            Sensor::Rangefinder { angles, length } => {
                let path = format!("{path}.rangefinder");
                let list = || format!("{path}.angles");
                if check_count(list, "angles", angles.len(), (1, MOST_RAYS), problems) {
                    for (ray, angle) in angles.iter().enumerate() {
                        check_number(|| format!("{path}.angles[{ray}]"), *angle, RAY_ANGLE, problems);
                    }
                }
                check_number(|| format!("{path}.length"), *length, RAY_LENGTH, problems);
            }
            Sensor::Clock { period } => {
                check_number(|| format!("{path}.clock.period"), *period, CLOCK_PERIOD, problems);
            }
            Sensor::LandingClock { period } => {
                check_number(|| format!("{path}.landing-clock.period"), *period, CLOCK_PERIOD, problems);
            }
            Sensor::NextGap { length } => {
                check_number(|| format!("{path}.next-gap.length"), *length, GAP_SIGHT, problems);
            }
            Sensor::CommandedSpeed { top } => {
                check_number(|| format!("{path}.commanded-speed.top"), *top, COMMANDED_TOP, problems);
            }
            Sensor::StrideClock { period, top } => {
                check_number(|| format!("{path}.stride-clock.period"), *period, CLOCK_PERIOD, problems);
                check_number(|| format!("{path}.stride-clock.top"), *top, COMMANDED_TOP, problems);
            }
            Sensor::JumpClock { period } => {
                check_number(|| format!("{path}.jump-clock.period"), *period, CLOCK_PERIOD, problems);
            }
            Sensor::FootContacts | Sensor::FootSlip if !has_feet => {
                problems.push(Problem::NoFeet { path, sensor: sensor.name() });
            }
            Sensor::TorsoRotation
            | Sensor::JointAngles
            | Sensor::JointSpeeds
            | Sensor::TorsoVelocity
            | Sensor::TorsoHeight
            | Sensor::TorsoSpin
            | Sensor::FootContacts
            | Sensor::HeightAboveGround
            | Sensor::FootSlip
            | Sensor::JumpCommand
            | Sensor::Custom(_) => {}
        }
    }
}
