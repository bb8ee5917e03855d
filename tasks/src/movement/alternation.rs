use super::{
    Movement, Verdict,
    foot::{Foot, FootChange},
    playing::JUMP_SECONDS,
};
use crate::{Body, Snapshot};

/// Watches that two legs step in turn. Its value is the way the torso made, m, forwards or backwards, by steps that did not alternate:
/// the way to a landing on both feet, within 0.1 s, or on the one that landed last. With a weight below 0 a hop on both legs, or on one,
/// earns less than a walk or a run.
///
/// What a body does in the 1.5 s after it was told to jump does not count. Bodies with another number of legs than two are left
/// alone.
#[derive(Clone, Debug, Default)]
pub struct Alternation {
    /// Of two legs, or none.
    feet: Vec<Foot>,
    last: Option<Landing>,
    way: f32,
}

#[derive(Clone, Copy, Debug)]
struct Landing {
    /// Which foot came down first.
    foot: usize,
    /// Whether the other came down with it.
    both: bool,
    /// s.
    time: f32,
    /// Where the torso was, m.
    x: f32,
    /// The way since the previous landing, m; 0 once it counts.
    way: f32,
}

/// Feet that come down within this of each other land together, s.
const TOGETHER: f32 = 0.1;

impl Movement for Alternation {
    fn name(&self) -> &str {
        "alternation"
    }

    fn unit(&self) -> &str {
        "m"
    }

    fn bind(&mut self, body: &Body) {
        let feet: Vec<Foot> = body.feet().map(|part| Foot::new(body, part)).collect();
        self.feet = if body.legless || feet.len() != 2 { Vec::new() } else { feet };
    }

    fn begin(&mut self, start: &Snapshot) {
        (self.last, self.way) = (None, 0.0);
        for foot in &mut self.feet {
            foot.begin(start);
        }
    }

    fn observe(&mut self, now: &Snapshot) -> Verdict {
        let jumps = f64::from(now.command.since_press) < JUMP_SECONDS;
        if jumps {
            self.last = None;
        }
        let (time, x) = (now.time, now.torso().x);
        for (index, foot) in self.feet.iter_mut().enumerate() {
            if foot.observe(now) != Some(FootChange::CameDown) || jumps {
                continue;
            }
            match &mut self.last {
                Some(last) if last.foot != index && time - last.time < TOGETHER => {
                    last.both = true;
                    self.way += std::mem::take(&mut last.way);
                }
                last => {
                    let mut way = last.map_or(0.0, |last| (x - last.x).abs());
                    if last.is_some_and(|last| last.foot == index && !last.both) {
                        self.way += std::mem::take(&mut way);
                    }
                    *last = Some(Landing { foot: index, both: false, time, x, way });
                }
            }
        }
        Verdict::GoOn
    }

    fn value(&self) -> f64 {
        self.way.into()
    }
}
