//! How many of a terrain's obstacles a creature has passed.

use creatures::ObstacleKind;
use envs_core::Landscape;
use serde::Serialize;
use std::collections::BTreeMap;
use tasks::Snapshot;

/// How many obstacles of a kind were passed: those whose end the torso's centre has been beyond.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct ObstaclesPassed {
    /// Which.
    pub kind: ObstacleKind,
    /// How many were passed.
    pub passed: usize,
    /// How many there are.
    pub of: usize,
}

impl ObstaclesPassed {
    /// One entry for each kind that the landscape has.
    pub fn count(landscape: &Landscape, snapshots: &[Snapshot]) -> Vec<Self> {
        let farthest = snapshots.iter().map(|snapshot| snapshot.torso().x).fold(f32::NEG_INFINITY, f32::max);
        let mut kinds: BTreeMap<ObstacleKind, [usize; 2]> = BTreeMap::new();
        for obstacle in &landscape.obstacles {
            let [passed, of] = kinds.entry(obstacle.kind).or_default();
            *passed += usize::from(farthest > obstacle.to);
            *of += 1;
        }
        kinds.into_iter().map(|(kind, [passed, of])| Self { kind, passed, of }).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use envs_core::Obstacle;
    use tasks::PartState;

    #[test]
    fn an_obstacle_is_passed_once_the_torso_has_been_beyond_its_end() {
        let obstacle = |kind, from| Obstacle { kind, from, to: from + 1.0 };
        let (gaps, rough) = (ObstacleKind::Gaps, ObstacleKind::Rough);
        let obstacles = vec![obstacle(gaps, 2.0), obstacle(rough, 4.0), obstacle(gaps, 6.0)];
        let landscape = Landscape { obstacles, ..Landscape::default() };
        let at = |x| Snapshot { parts: vec![PartState { x, ..PartState::default() }], ..Snapshot::default() };
        let counts = |places: &[f32]| {
            let snapshots: Vec<Snapshot> = places.iter().map(|&x| at(x)).collect();
            ObstaclesPassed::count(&landscape, &snapshots)
        };
        let told = |passed: [usize; 2]| {
            vec![
                ObstaclesPassed { kind: gaps, passed: passed[0], of: 2 },
                ObstaclesPassed { kind: rough, passed: passed[1], of: 1 },
            ]
        };
        assert_eq!(counts(&[0.0, 2.9]), told([0, 0]));
        assert_eq!(counts(&[0.0, 3.1]), told([1, 0]));
        // It need not stay there.
        assert_eq!(counts(&[0.0, 5.1, 1.0]), told([1, 1]));
        assert_eq!(counts(&[7.1]), told([2, 1]));
        assert_eq!(ObstaclesPassed::count(&Landscape::default(), &[at(9.0)]), []);
    }
}
