use super::{Movement, Verdict};
use crate::{Body, BodyPart, PartState, Snapshot};

/// How far feet slide over the ground, as a mean over all feet, beyond 0.2 m for each metre of way, m; at most half of the
/// way, so that to get ahead on sliding feet is still worth more than to stand. Weigh it negatively, from −1 to 0.
///
/// The lowest point of a foot counts, while the foot touches the ground. Legless bodies are left alone.
#[derive(Clone, Debug, Default)]
pub struct Slip {
    feet: Vec<Foot>,
    start: f32,
    x: f32,
    slid: f64,
}

#[derive(Clone, Debug, Default)]
struct Foot {
    index: usize,
    part: BodyPart,
    before: PartState,
}

/// m of slip a metre of way.
const FREE: f64 = 0.2;
/// The same.
const MOST: f64 = 0.5;

impl Movement for Slip {
    fn name(&self) -> &str {
        "slip"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        let foot = |index: usize| Foot { index, part: body.parts[index].clone(), ..Foot::default() };
        self.feet = if body.legless { Vec::new() } else { body.feet().map(foot).collect() };
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.start, self.x, self.slid) = (start.torso().x, start.torso().x, 0.0);
        for foot in &mut self.feet {
            foot.before = start.parts[foot.index];
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        self.x = now.torso().x;
        for foot in &mut self.feet {
            let after = now.parts[foot.index];
            if after.touching && foot.before.touching {
                self.slid += f64::from(foot.slid(&after).abs());
            }
            foot.before = after;
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        if self.feet.is_empty() {
            return 0.0;
        }
        let way = f64::from((self.x - self.start).abs());
        (self.slid / self.feet.len() as f64 - FREE * way).clamp(0.0, MOST * way)
    }
}

impl Foot {
    /// How far its lowest point moved forwards in a step, m; a round foot that rolls does not slide.
    fn slid(&self, after: &PartState) -> f32 {
        let height = |[x, y]: &[f32; 2]| after.sin * x + after.cos * y;
        let lowest = self.part.corners.iter().min_by(|one, other| height(one).total_cmp(&height(other)));
        let Some(&[x, y]) = lowest else { return 0.0 };
        let place = |state: &PartState| state.x + state.cos * x - state.sin * y;
        let turn = self.before.cos * after.sin - self.before.sin * after.cos;
        place(after) - place(&self.before) + turn * self.part.radius
    }
}
