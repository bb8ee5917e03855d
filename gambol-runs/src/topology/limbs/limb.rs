//! The limbs of a creature, and where they hang.

use crate::config::LimbPhases;
use creatures::{Blueprint, Senses, Source};
use std::f32::consts::PI;

/// A limb: what shares a copy of the net.
#[derive(Clone, Debug)]
pub(super) struct Limb {
    /// Its actuated hinges, from the body outwards.
    pub(super) hinges: Vec<usize>,
    /// Its parts.
    pub(super) parts: Vec<usize>,
    /// Where it hangs along the body, −1 (back) to 1 (front).
    pub(super) place: f32,
    /// Of its clock, rad, before genes.
    pub(super) phase: f32,
    /// −1 for a limb whose first part lies rather behind its parent than below it: the rear half of a caterpillar, the hind
    /// legs of a long body. It is a mirror image, and bends the other way, as knees do where elbows bend.
    pub(super) sign: f32,
    /// Limbs with equally many joints share a net, but for arms, which share one with arms of the same tag: which.
    pub(super) kind: usize,
    /// The tag of its first part, if it is one of the [arms](Blueprint::arms).
    pub(super) arm: Option<String>,
}

impl Limb {
    /// What limbs of its kind are called in the names of genes.
    pub(super) fn kind_name(&self) -> String {
        let joints = self.hinges.len();
        self.arm.as_ref().map_or_else(|| format!("{joints} joints"), |tag| format!("{tag} of {joints} joints"))
    }
}

/// What a limb is made of.
struct Chain {
    /// Its actuated hinges, from the body outwards; at least one.
    hinges: Vec<usize>,
    /// Its parts, passive ones among them: a foot that dangles feels the ground all the same.
    parts: Vec<usize>,
    /// Whether it is one of the [arms](Blueprint::arms).
    arm: bool,
}

/// The limbs of a creature: its legs, its arms and, each alone, the actuated hinges that are in neither; of a legless
/// creature each hinge.
pub(super) fn limbs(blueprint: &Blueprint, senses: &Senses, phases: LimbPhases) -> Vec<Limb> {
    let actuated = blueprint.actuated();
    let hinge_of = |part: usize| actuated.iter().copied().find(|&hinge| blueprint.hinges()[hinge].child == part);
    let mut chains: Vec<Chain> = Vec::new();
    let mut taken = vec![false; blueprint.hinges().len()];
    if !blueprint.is_legless() {
        let legs = blueprint.legs().iter().map(|leg| (leg, false));
        for (limb, arm) in legs.chain(blueprint.arms().iter().map(|arm| (arm, true))) {
            let hinges: Vec<usize> =
                limb.iter().filter_map(|&part| hinge_of(part)).filter(|&hinge| !taken[hinge]).collect();
            hinges.iter().for_each(|&hinge| taken[hinge] = true);
            if !hinges.is_empty() {
                chains.push(Chain { hinges, parts: limb.clone(), arm });
            }
        }
    }
    for &hinge in actuated.iter().filter(|&&hinge| !taken[hinge]) {
        chains.push(Chain { hinges: vec![hinge], parts: vec![blueprint.hinges()[hinge].child], arm: false });
    }
    let mut places = places(blueprint, &chains);
    let clock_stops = senses.probes().iter().any(|probe| matches!(probe.source, Source::StrideSine { .. }));
    if clock_stops {
        tell_apart(&mut places);
    }
    let mut kinds: Vec<(usize, Option<String>)> = Vec::new();
    let phase_of = phases_of(&places, phases, blueprint.is_legless());
    let limb = |(Chain { hinges, parts, arm }, (&place, phase)): (Chain, (&f32, f32))| {
        let arm = arm.then(|| blueprint.parts()[parts[0]].tag.clone());
        let kind = (hinges.len(), arm.clone());
        let kind = kinds.iter().position(|known| *known == kind).unwrap_or_else(|| {
            kinds.push(kind);
            kinds.len() - 1
        });
        let hinge = &blueprint.hinges()[hinges[0]];
        let (parent, child) = (&blueprint.parts()[hinge.parent], &blueprint.parts()[hinge.child]);
        let across = (child.x - parent.x).abs() > (child.y - parent.y).abs();
        let sign = if across && child.x < parent.x { -1.0 } else { 1.0 };
        Limb { hinges, parts, place, phase, sign, kind, arm }
    };
    chains.into_iter().zip(places.iter().zip(phase_of)).map(limb).collect()
}

/// Where along the body each chain's first joint is, from −1 to 1.
fn places(blueprint: &Blueprint, chains: &[Chain]) -> Vec<f32> {
    let [left, _, right, _] = blueprint.bounding_box();
    let (middle, half) = (0.5 * (left + right), 0.5 * (right - left));
    let place = |chain: &Chain| {
        let hinge = &blueprint.hinges()[chain.hinges[0]];
        let parent = &blueprint.parts()[hinge.parent];
        let [x, y] = hinge.parent_anchor;
        let anchor = parent.x + libm::cosf(parent.angle) * x - libm::sinf(parent.angle) * y;
        (anchor - middle) / half
    };
    chains.iter().map(place).collect()
}

/// Puts limbs that all hang from one place from −1 to 1 in their order. Where the clock stops nothing else tells them apart:
/// legs that all do the same have no stance, and the body falls over its feet.
fn tell_apart(places: &mut [f32]) {
    let side_by_side = places.iter().all(|place| (place - places[0]).abs() < SAME_PLACE);
    if side_by_side && places.len() > 1 {
        let apart = 2.0 / (places.len() - 1) as f32;
        places.iter_mut().zip(0_u8..).for_each(|(place, index)| *place = f32::from(index) * apart - 1.0);
    }
}

/// Limbs that hang no farther apart, as shares of half the body's length, hang from one place.
const SAME_PLACE: f32 = 0.01;

/// The phase of each limb's clock before genes, rad: neighbours along the body and beside each other are half a turn
/// apart, or all are alike.
pub(super) fn phases_of(places: &[f32], phases: LimbPhases, legless: bool) -> Vec<f32> {
    if phases == LimbPhases::Together || legless {
        return vec![0.0; places.len()];
    }
    let mut rows: Vec<f32> = Vec::new();
    for &place in places {
        if !rows.iter().any(|row| (row - place).abs() < SAME_PLACE) {
            rows.push(place);
        }
    }
    rows.sort_by(f32::total_cmp);
    let mut met = vec![0; rows.len()];
    let phase = |&place: &f32| {
        let row = rows.iter().position(|row| (row - place).abs() < SAME_PLACE).unwrap_or(0);
        met[row] += 1;
        PI * ((row + met[row] - 1) % 2) as f32
    };
    places.iter().map(phase).collect()
}
