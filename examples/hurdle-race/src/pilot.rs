//! What the computer tells its runners.

use player::Command;

/// From the press to the highest point of a jump, s, near enough for all of them.
const UNTIL_HIGHEST: f32 = 0.58;

/// What a runner is told whose torso moves at `speed` m/s and is `ahead` m before the next hurdle: to go as fast as it can, and to
/// jump so that it is highest above the hurdle.
pub fn command(top: f32, speed: f32, ahead: f32) -> Command {
    let near = speed.max(0.2) * UNTIL_HIGHEST;
    Command { speed: top, jump: u32::from((0.0..near).contains(&ahead) && ahead > near - 0.25) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presses_once_before_a_hurdle() {
        let mut presses = 0;
        let mut held = 0;
        for frame in 0..300 {
            let now = command(1.5, 1.5, 4.0 - 1.5 * frame as f32 / 60.0).jump;
            presses += u32::from(now == 1 && held == 0);
            held = now;
        }
        assert_eq!(presses, 1);
    }
}
