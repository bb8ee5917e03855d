//! A creature that has been checked and resolved.

use crate::body_part::{BodyPart, Hinge};
use crate::symmetry::{Asymmetry, SymmetryHinge, SymmetryPart, twins};
use crate::{Creature, CreatureError, Problem, check, legs, parse};

/// A checked creature in the form engines want: SI units, radians, indices for names, anchors in the parts' own
/// frames. Its users need not validate anything.
#[derive(Clone, Debug, PartialEq)]
pub struct Blueprint {
    creature: Creature,
    parts: Vec<BodyPart>,
    hinges: Vec<Hinge>,
    actuated: Vec<usize>,
    feet: Vec<usize>,
    legs: Vec<Vec<usize>>,
    arms: Vec<Vec<usize>>,
    /// Left, bottom, right and top of the start pose, m.
    bounding_box: [f32; 4],
}

impl Blueprint {
    /// Checks a creature and resolves it.
    ///
    /// # Errors
    /// [`CreatureError::Invalid`] with every problem found; [`CreatureError::NotACreature`] and
    /// [`CreatureError::Version`] for a creature whose header was changed.
    pub fn new(creature: Creature) -> Result<Self, CreatureError> {
        parse::check_header(&creature)?;
        let problems = check::check(&creature);
        if !problems.is_empty() {
            return Err(CreatureError::Invalid(problems));
        }
        let blueprint = Self::resolve(creature);
        match blueprint.symmetry().filter(|_| blueprint.creature.symmetric) {
            Some(asymmetry) => Err(CreatureError::Invalid(vec![blueprint.problem_of(asymmetry)])),
            None => Ok(blueprint),
        }
    }

    /// Why it does not look the same from both sides; `None` if it does.
    pub fn symmetry(&self) -> Option<Asymmetry> {
        let part = |part: &BodyPart| SymmetryPart {
            shape: part.shape,
            x: part.x,
            y: part.y,
            angle: part.angle,
            density: part.density,
            friction: part.friction,
        };
        let hinge = |hinge: &Hinge| SymmetryHinge {
            parent: hinge.parent,
            child: hinge.child,
            parent_anchor: hinge.parent_anchor,
            child_anchor: hinge.child_anchor,
            limits: hinge.limits,
            motor: hinge.motor.map(|motor| [motor.top_speed, motor.top_torque]),
            actuated: hinge.actuated,
        };
        let parts: Vec<SymmetryPart> = self.parts.iter().map(part).collect();
        let hinges: Vec<SymmetryHinge> = self.hinges.iter().map(hinge).collect();
        twins(&parts, &hinges).err()
    }

    fn problem_of(&self, asymmetry: Asymmetry) -> Problem {
        let (part, what) = match asymmetry {
            Asymmetry::Part(part) => (part, "the mirror image"),
            Asymmetry::Hinge(part) => (part, "the hinge of the mirror image"),
        };
        Problem::NotSymmetric { part: self.parts[part].name.clone(), what }
    }

    /// Reads, checks and resolves a creature file.
    ///
    /// # Errors
    /// Those of [`Creature::from_json`] and [`Blueprint::new`].
    pub fn from_json(text: &str) -> Result<Self, CreatureError> {
        Self::new(Creature::from_json(text)?)
    }

    /// The creature must have been checked.
    fn resolve(creature: Creature) -> Self {
        let parts: Vec<BodyPart> = creature
            .parts
            .iter()
            .map(|part| BodyPart {
                name: part.name.clone(),
                tag: part.tag.clone(),
                shape: part.shape,
                density: part.density,
                friction: part.friction,
                x: part.position[0],
                y: part.position[1],
                angle: part.angle.to_radians(),
                actuated: creature.actuated_tags.contains(&part.tag),
                leg: part.leg,
            })
            .collect();
        let index_of = |name: &str| parts.iter().position(|part| part.name == name);
        let hinges: Vec<Hinge> = creature
            .joints
            .iter()
            .filter_map(|joint| {
                // Both are found: the check has looked.
                let (parent, child) = (index_of(&joint.parent)?, index_of(&joint.child)?);
                Some(Hinge {
                    parent,
                    child,
                    parent_anchor: parts[parent].to_local(joint.anchor),
                    child_anchor: parts[child].to_local(joint.anchor),
                    limits: joint.limits.map(f32::to_radians),
                    motor: joint.motor,
                    actuated: joint.motor.is_some() && parts[child].actuated,
                })
            })
            .collect();
        let actuated = (0..hinges.len()).filter(|&hinge| hinges[hinge].actuated).collect();
        let limbs = legs::limbs(&parts, &hinges).into_iter();
        let (legs, arms): (Vec<_>, Vec<_>) = limbs.partition(|limb| legs::is_leg(&parts, limb));
        let feet = legs.iter().filter_map(|leg| leg.last().copied()).collect();
        let bounding_box = bounding_box(&parts);
        Self { creature, parts, hinges, actuated, feet, legs, arms, bounding_box }
    }

    /// The creature as its file says it, looks included.
    pub fn creature(&self) -> &Creature {
        &self.creature
    }

    /// Its short name.
    pub fn name(&self) -> &str {
        &self.creature.name
    }

    /// Its parts; the first is the torso.
    pub fn parts(&self) -> &[BodyPart] {
        &self.parts
    }

    /// Its hinges, in the order of the file's joints; one for each part but the torso.
    pub fn hinges(&self) -> &[Hinge] {
        &self.hinges
    }

    /// Indices into [`hinges`](Self::hinges) of those a net moves, in the order of its outputs; at least one.
    pub fn actuated(&self) -> &[usize] {
        &self.actuated
    }

    /// Indices of the feet, the last segments of the legs: actuated parts on which nothing hangs, but for those of
    /// [`arms`](Self::arms). In the order of the parts; the two end segments of a chain whose torso is in the middle.
    pub fn feet(&self) -> &[usize] {
        &self.feet
    }

    /// The legs, one a foot and in the order of [`feet`](Self::feet): indices of the parts from hip to foot. A leg
    /// starts below the torso or below the last part that is not actuated; where legs branch, they share their upper
    /// parts. The chains that hang on the torso of an apod count as legs here: see [`is_legless`](Self::is_legless).
    pub fn legs(&self) -> &[Vec<usize>] {
        &self.legs
    }

    /// The actuated chains that are no legs, because one of their parts [says so](crate::Part::leg): arms and tails, each from
    /// the body outwards. In the order of their last parts; none in most creatures.
    pub fn arms(&self) -> &[Vec<usize>] {
        &self.arms
    }

    /// Whether no foot reaches lower than the torso in the start pose (by at least 1 cm): the creature lies on the
    /// ground and crawls, like an apod. So does one without feet, whose chains are all [`arms`](Self::arms). Its gait is told
    /// by its joints rather than by its footfalls.
    pub fn is_legless(&self) -> bool {
        let torso = self.parts[0].lowest_point() - 0.01;
        self.feet.iter().all(|&foot| self.parts[foot].lowest_point() > torso)
    }

    /// The longer side of the bounding box in the start pose, m.
    pub fn body_length(&self) -> f32 {
        let [left, bottom, right, top] = self.bounding_box;
        (right - left).max(top - bottom)
    }

    /// Left, bottom, right and top of the creature in the start pose, m.
    pub fn bounding_box(&self) -> [f32; 4] {
        self.bounding_box
    }

    /// Height of the torso's centre above the creature's lowest point in the start pose, m; positive.
    pub fn start_height(&self) -> f32 {
        self.parts[0].y - self.bounding_box[1]
    }

    /// How far the lowest point of the longest leg is below the joint it hangs on, in the start pose, m; for a creature
    /// that [has no legs](Self::is_legless) its start height. Positive.
    pub fn leg_length(&self) -> f32 {
        let length = |leg: &Vec<usize>| {
            let (first, last) = (leg.first()?, leg.last()?);
            let hip = self.hinges.iter().position(|hinge| hinge.child == *first)?;
            Some(self.creature.joints.get(hip)?.anchor[1] - self.parts[*last].lowest_point())
        };
        let longest = self.legs.iter().filter_map(length).fold(0.0, f32::max);
        if self.is_legless() || longest <= 0.0 { self.start_height() } else { longest }
    }

    /// Mass of all parts together, kg.
    pub fn mass(&self) -> f32 {
        self.parts.iter().map(BodyPart::mass).sum()
    }

    /// Whether its parts collide with each other.
    pub fn self_collision(&self) -> bool {
        self.creature.self_collision
    }
}

fn bounding_box(parts: &[BodyPart]) -> [f32; 4] {
    let empty = [f32::INFINITY, f32::INFINITY, f32::NEG_INFINITY, f32::NEG_INFINITY];
    parts.iter().fold(empty, |[left, bottom, right, top], part| {
        let [x, y] = part.shape.half_extents(libm::cosf(part.angle), libm::sinf(part.angle));
        [left.min(part.x - x), bottom.min(part.y - y), right.max(part.x + x), top.max(part.y + y)]
    })
}
