use crate::{Ground, GroundShape};
use creatures::{Blueprint, BodySizes, Direction, DrawnObstacle, ObstacleKind, ObstacleSizes, Terrain};
use ne_core::{Purpose, RandomStream, Seed};
use rand::RngExt;

const LAYOUT: Purpose = Purpose::new("terrain layout");

/// Steps of a flight of stairs.
const FLIGHT: i32 = 5;
/// Width of the top of a hill, as a share of the width of its slopes: half a body length.
const HILLTOP: f32 = 1.0 / 6.0;
/// Blocks of a stretch of rough ground.
const BLOCKS: usize = 8;
/// The blocks are as many heights apart from the level ground at most, so that no two differ by a hair: feet sink into the
/// ground, and would be stopped by the buried side of a block that is hardly higher.
const HEIGHTS: u32 = 4;
/// How much narrower and wider than their mean the blocks of rough ground are, as a share.
const BLOCK_WIDTHS: f32 = 0.5;
/// What is smaller than this, m or degrees, is no obstacle.
const LEAST: f32 = 1e-3;
/// Level ground behind the start and beyond the last obstacle, m.
const BEHIND: f32 = 50.0;
const BEYOND: f32 = 500.0;
/// Level ground goes on under what rises from it, m, so that there is no edge where they meet.
const UNDER: f32 = 0.5;
/// Where a slope meets level ground that is no lower, a disc of this radius, m, covers their edges...
const BROW: f32 = 0.25;
/// ...by this much, m: more than feet sink into the ground.
const COVER: f32 = 0.02;
/// How thick slanted ground is, and how deep hurdles stand in the ground, m.
const THICKNESS: f32 = 1.0;
const ROOTS: f32 = 0.3;

/// A terrain laid out for a body: what it moves on, and what on it is an obstacle.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Landscape {
    /// The shapes: a floor under all, what is side by side from left to right, then what stands on it.
    pub ground: Ground,
    /// From left to right. None of ground that was not made from a terrain.
    pub obstacles: Vec<Obstacle>,
}

/// A stretch of ground that is not level.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Obstacle {
    /// What it is.
    pub kind: ObstacleKind,
    /// Where it begins, m.
    pub from: f32,
    /// Where it ends, m.
    pub to: f32,
}

impl From<Ground> for Landscape {
    /// Without obstacles, whatever the ground.
    fn from(ground: Ground) -> Self {
        Self { ground, obstacles: Vec::new() }
    }
}

impl Landscape {
    /// Lays out a terrain for a creature. The terrain must be valid. `seed` takes the place of the terrain's own.
    ///
    /// Level ground at height 0 reaches 50 m back and up to the first obstacle; behind the last it goes on for 500 m.
    /// Ground without any obstacle, also because all would be smaller than a millimetre, is [flat](Ground::flat).
    pub fn new(terrain: &Terrain, seed: u64, blueprint: &Blueprint) -> Self {
        let body = BodySizes::of(blueprint);
        let pit = (1.5 * body.body_length).max(1.0);
        if let Some(first) = terrain.drawn.first() {
            let mut relief = Relief::new(body.back.min(0.0) - BEHIND, first.reach(&body)[0]);
            terrain.drawn.iter().for_each(|obstacle| relief.add_drawn(obstacle, &body));
            relief.level(BEYOND);
            return Self { ground: relief.ground(pit), obstacles: relief.obstacles };
        }
        let kinds: Vec<ObstacleSizes> =
            terrain.obstacles.iter().map(|obstacles| obstacles.sizes(terrain.difficulty, &body)).collect();
        if kinds.iter().all(|kind| kind.main < LEAST) {
            return Self::default();
        }
        let mut stream = Seed::of_run(seed).stream(LAYOUT);
        let first = body.front + terrain.run_up_of(&body);
        let mut relief = Relief::new(body.back.min(0.0) - BEHIND, first);
        let mut turns = kinds.iter().cycle();
        while relief.x <= terrain.length
            && let Some(kind) = turns.next()
        {
            if kind.main >= LEAST {
                relief.add(kind, &mut stream);
            }
            let factor = 1.0 + terrain.jitter * (2.0 * stream.random::<f32>() - 1.0);
            relief.level(kind.spacing * factor);
        }
        relief.level(BEYOND);
        Self { ground: relief.ground(pit), obstacles: relief.obstacles }
    }

    /// Where the gaps are: from and to, m, from left to right.
    pub fn gaps(&self) -> impl Iterator<Item = [f32; 2]> + '_ {
        self.obstacles.iter().filter(|one| one.kind == ObstacleKind::Gaps).map(|gap| [gap.from, gap.to])
    }
}

/// The outline of the ground, from left to right, as it is laid out.
struct Relief {
    pieces: Vec<Piece>,
    /// What stands on the outline.
    hurdles: Vec<GroundShape>,
    obstacles: Vec<Obstacle>,
    /// How far it has come, m.
    x: f32,
    /// How high it is there, m.
    height: f32,
}

/// A piece of the outline, m.
#[derive(Clone, Copy, Debug)]
enum Piece {
    Level { from: f32, to: f32, height: f32 },
    Slope { from: [f32; 2], to: [f32; 2] },
    Gap,
}

impl Relief {
    fn new(from: f32, to: f32) -> Self {
        let start = Piece::Level { from, to, height: 0.0 };
        Self { pieces: vec![start], hurdles: Vec::new(), obstacles: Vec::new(), x: to, height: 0.0 }
    }

    /// An obstacle, beginning where the outline ends.
    fn add(&mut self, sizes: &ObstacleSizes, stream: &mut RandomStream) {
        let ObstacleSizes { kind, main, tread, direction, .. } = *sizes;
        let (from, base) = (self.x, self.height);
        match kind {
            ObstacleKind::Gaps => {
                self.pieces.push(Piece::Gap);
                self.x += main;
            }
            ObstacleKind::Hurdles => {
                self.level(tread);
                self.hurdles.push(block([from, self.x], base - ROOTS, base + main));
            }
            ObstacleKind::Stairs => {
                for height in climb(direction, FLIGHT) {
                    self.height = base + height as f32 * main;
                    self.level(tread);
                }
            }
            ObstacleKind::Slopes => {
                let rise = tread * libm::tanf(main.to_radians());
                for (index, height) in climb(direction, 1).enumerate() {
                    if index > 0 {
                        self.level(tread * HILLTOP);
                    }
                    let start = [self.x, self.height];
                    self.x += tread;
                    self.height = base + height as f32 * rise;
                    self.pieces.push(Piece::Slope { from: start, to: [self.x, self.height] });
                }
            }
            ObstacleKind::Rough => {
                for _ in 0..BLOCKS {
                    self.height = base + main / HEIGHTS as f32 * stream.random_range(0..=HEIGHTS) as f32;
                    self.level(tread * (1.0 + BLOCK_WIDTHS * (2.0 * stream.random::<f32>() - 1.0)));
                }
                self.height = base;
            }
        }
        self.obstacles.push(Obstacle { kind, from, to: self.x });
    }

    /// An obstacle in its place, with level ground before it.
    fn add_drawn(&mut self, obstacle: &DrawnObstacle, body: &BodySizes) {
        let [from, to] = obstacle.reach(body);
        self.level_to(from);
        match *obstacle {
            DrawnObstacle::Box { height, .. } => {
                let base = self.height;
                self.height = base + height;
                self.level_to(to);
                self.height = base;
            }
            DrawnObstacle::Gap { .. } => {
                self.pieces.push(Piece::Gap);
                self.x = to;
            }
            DrawnObstacle::Slope { rise, .. } => {
                let start = [self.x, self.height];
                (self.x, self.height) = (to, self.height + rise);
                self.pieces.push(Piece::Slope { from: start, to: [self.x, self.height] });
            }
        }
        self.obstacles.push(Obstacle { kind: obstacle.kind(), from, to });
    }

    /// Level ground of this width, as high as the outline is now.
    fn level(&mut self, width: f32) {
        self.level_to(self.x + width);
    }

    /// Level ground up to here, as high as the outline is now; none if the outline is there already.
    fn level_to(&mut self, to: f32) {
        if to <= self.x {
            return;
        }
        let from = self.x;
        self.x = to;
        match self.pieces.last_mut() {
            Some(Piece::Level { to, height, .. }) if *height == self.height => *to = self.x,
            _ => self.pieces.push(Piece::Level { from, to: self.x, height: self.height }),
        }
    }

    /// The shapes. `pit`: how far the floor is below the lowest level, m.
    fn ground(&self, pit: f32) -> Ground {
        let height = |piece: &Piece| match *piece {
            Piece::Level { height, .. } => height,
            Piece::Slope { from, to } => from[1].min(to[1]),
            Piece::Gap => 0.0,
        };
        let floor = self.pieces.iter().map(height).fold(0.0, f32::min) - pit;
        let mut shapes = vec![GroundShape::Floor { y: floor }];
        for (index, piece) in self.pieces.iter().enumerate() {
            match *piece {
                Piece::Level { from, to, height } => {
                    let before = index.checked_sub(1).map(|before| &self.pieces[before]);
                    let left = from - before.map_or(0.0, |before| room_under(before, height, false));
                    let right = to + self.pieces.get(index + 1).map_or(0.0, |after| room_under(after, height, true));
                    shapes.push(block([left, right], floor, height));
                }
                Piece::Slope { from, to } => shapes.extend([slab(from, to), brow(from, to)]),
                Piece::Gap => {}
            }
        }
        shapes.extend(&self.hurdles);
        Ground { shapes }
    }
}

/// How high stairs or slopes are after each step, in steps against where they begin.
fn climb(direction: Direction, steps: i32) -> impl Iterator<Item = i32> {
    let (up, down) = match direction {
        Direction::Up => (0..steps, 0..0),
        Direction::Down => (0..0, -steps..0),
        Direction::UpAndDown => (0..steps, 0..steps),
    };
    up.map(|step| step + 1).chain(down.rev())
}

/// How far level ground of this height goes on under its neighbour, m.
fn room_under(neighbour: &Piece, height: f32, is_right: bool) -> f32 {
    match *neighbour {
        Piece::Level { from, to, height: other } if other > height => UNDER.min(to - from),
        Piece::Slope { from, to } => {
            let (near, far) = if is_right { (from, to) } else { (to, from) };
            if far[1] > near[1] { UNDER.min(to[0] - from[0]) } else { 0.0 }
        }
        Piece::Level { .. } | Piece::Gap => 0.0,
    }
}

fn block([left, right]: [f32; 2], bottom: f32, top: f32) -> GroundShape {
    GroundShape::Box { x: 0.5 * (left + right), y: 0.5 * (bottom + top), width: right - left, height: top - bottom }
}

/// What covers the upper end of a slope.
fn brow(from: [f32; 2], to: [f32; 2]) -> GroundShape {
    let corner = if to[1] > from[1] { to } else { from };
    // Between the directions that slope and level ground face.
    let (sin, cos) = libm::sincosf(0.5 * libm::atan2f(to[1] - from[1], to[0] - from[0]));
    let depth = BROW - COVER;
    GroundShape::Circle { x: corner[0] + depth * sin, y: corner[1] - depth * cos, radius: BROW }
}

/// Slanted ground whose surface goes from one point to another, and a little further down into the ground.
fn slab(from: [f32; 2], to: [f32; 2]) -> GroundShape {
    let [run, rise] = [to[0] - from[0], to[1] - from[1]];
    let length = libm::hypotf(run, rise);
    let (cos, sin) = (run / length, rise / length);
    // The end that is lower.
    let (back, ahead) = if rise > 0.0 { (UNDER, 0.0) } else { (0.0, UNDER) };
    let shift = 0.5 * (ahead - back);
    let middle = [0.5 * (from[0] + to[0]) + shift * cos, 0.5 * (from[1] + to[1]) + shift * sin];
    GroundShape::Slab {
        x: middle[0] + 0.5 * THICKNESS * sin,
        y: middle[1] - 0.5 * THICKNESS * cos,
        width: length + UNDER,
        height: THICKNESS,
        angle: libm::atan2f(rise, run),
    }
}
