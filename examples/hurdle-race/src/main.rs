//! The window: what is drawn, and the keys.

use hurdle_race::{
    pilot,
    race::{FRAME, HURDLES, LENGTH, Race, Runner},
};
use macroquad::prelude::*;
use player::{Character, Command, Shape};
use std::sync::Arc;

/// The seven, in the order of their lanes.
const CHARACTERS: [(&str, &[u8], Color); 7] = [
    ("apod", include_bytes!("../characters/apod.player"), Color::new(0.85, 0.35, 0.35, 1.0)),
    ("biped-1", include_bytes!("../characters/biped-1.player"), Color::new(0.90, 0.58, 0.20, 1.0)),
    ("biped-2", include_bytes!("../characters/biped-2.player"), Color::new(0.80, 0.70, 0.18, 1.0)),
    ("tetrapod-1", include_bytes!("../characters/tetrapod-1.player"), Color::new(0.38, 0.66, 0.30, 1.0)),
    ("tetrapod-2", include_bytes!("../characters/tetrapod-2.player"), Color::new(0.20, 0.62, 0.62, 1.0)),
    ("decapod-1", include_bytes!("../characters/decapod-1.player"), Color::new(0.30, 0.46, 0.85, 1.0)),
    ("decapod-2", include_bytes!("../characters/decapod-2.player"), Color::new(0.60, 0.38, 0.78, 1.0)),
];
/// The fastest they have learned, body lengths/s.
const TOP: f32 = 1.5;
/// How fast the stick moves while an arrow is held, body lengths/s².
const STICK: f32 = 3.0;
/// The lane behind another is drawn this much higher, m.
const LANE: f32 = 0.32;
/// Longer than this the game does not catch up, s.
const LONGEST_LAG: f32 = 0.1;

fn window() -> Conf {
    Conf { window_title: "Hurdles".into(), window_width: 1100, window_height: 620, sample_count: 4, ..Conf::default() }
}

#[macroquad::main(window)]
async fn main() {
    let characters: Result<Vec<Arc<Character>>, _> =
        CHARACTERS.iter().map(|(_, bytes, _)| Character::from_bytes(bytes).map(Arc::new)).collect();
    let race = characters.and_then(|characters| Race::new(&characters).map(|race| (characters, race)));
    let (characters, mut race) = match race {
        Ok(race) => race,
        Err(error) => return report(&error.to_string()).await,
    };
    let (mut yours, mut running, mut stick, mut lag) = (4, false, 0.0, 0.0);
    loop {
        if is_key_pressed(KeyCode::Escape) {
            break;
        }
        if let Some(key) = (0..CHARACTERS.len()).find(|&lane| is_key_pressed(NUMBERS[lane])).filter(|_| !running) {
            yours = key;
        }
        if is_key_pressed(KeyCode::Enter) {
            running = true;
        }
        if is_key_pressed(KeyCode::R)
            && let Ok(anew) = Race::new(&characters)
        {
            (race, running, stick) = (anew, false, 0.0);
        }
        if running {
            let towards = if is_key_down(KeyCode::Right) { TOP } else { 0.0 };
            lag = (lag + get_frame_time()).min(LONGEST_LAG);
            while lag >= FRAME {
                lag -= FRAME;
                let change = STICK * FRAME;
                stick += (towards - stick).clamp(-change, change);
                let jump = is_key_down(KeyCode::Up) || is_key_down(KeyCode::Space);
                race.frame(|lane, runner| match lane == yours {
                    true => Command { speed: stick, jump: jump.into() },
                    false => pilot::command(TOP, runner.pace, runner.ahead()),
                });
            }
        }
        draw(&race, yours, running);
        next_frame().await;
    }
}

const NUMBERS: [KeyCode; 7] =
    [KeyCode::Key1, KeyCode::Key2, KeyCode::Key3, KeyCode::Key4, KeyCode::Key5, KeyCode::Key6, KeyCode::Key7];

async fn report(what: &str) {
    while !is_key_pressed(KeyCode::Escape) {
        clear_background(WHITE);
        draw_text(what, 20.0, 40.0, 28.0, BLACK);
        next_frame().await;
    }
}

/// From metres to pixels.
struct View {
    scale: f32,
    left: f32,
    ground: f32,
}

impl View {
    fn at(&self, x: f32, y: f32) -> Vec2 {
        vec2((x - self.left) * self.scale, self.ground - y * self.scale)
    }

    /// The same, of a lane.
    fn of_lane(&self, lane: usize) -> Self {
        let back = (CHARACTERS.len() - 1 - lane) as f32;
        Self { ground: self.ground - back * LANE * self.scale, ..*self }
    }
}

fn draw(race: &Race, yours: usize, running: bool) {
    clear_background(Color::new(0.80, 0.89, 0.96, 1.0));
    let scale = screen_width() / 9.0;
    let view = View { scale, left: race.runners[yours].distance() - 3.0, ground: screen_height() - 0.35 * scale };
    track(&view);
    for (lane, (runner, (_, _, color))) in race.runners.iter().zip(CHARACTERS).enumerate() {
        let view = view.of_lane(lane);
        hurdles(runner, &view);
        character(runner, &view, color, lane == yours);
    }
    standings(race, yours);
    let told = match (running, race.runners[yours].finished) {
        (false, _) => "1 to 7: choose yours     Enter: go".into(),
        (true, None) if race.time < 0.0 => "ready".into(),
        (true, None) => format!("{:.1} s     right: run     up or space: jump     R: anew", race.time),
        (true, Some(time)) => format!("{time:.2} s, penalties included     R: anew"),
    };
    draw_text(&told, 16.0, screen_height() - 12.0, 26.0, DARKGRAY);
}

fn track(view: &View) {
    let back = view.of_lane(0).ground - LANE * view.scale;
    draw_rectangle(0.0, back, screen_width(), screen_height() - back, Color::new(0.80, 0.52, 0.40, 1.0));
    for lane in 0..=CHARACTERS.len() {
        let y = view.ground + (0.5 - lane as f32) * LANE * view.scale;
        draw_line(0.0, y, screen_width(), y, 2.0, Color::new(1.0, 1.0, 1.0, 0.6));
    }
    for x in 0..=LENGTH as usize {
        let at = view.at(x as f32, 0.0).x;
        if x % 5 == 0 {
            draw_text(format!("{x} m"), at + 4.0, back - 6.0, 22.0, GRAY);
        }
    }
    for x in [0.0, LENGTH] {
        let at = view.at(x, 0.0).x;
        draw_line(at, back, at, view.ground + 0.5 * LANE * view.scale, 5.0, WHITE);
    }
}

fn hurdles(runner: &Runner, view: &View) {
    for (x, &knocked) in HURDLES.iter().zip(&runner.knocked) {
        let (foot, height) = (view.at(*x, 0.0), runner.hurdle_height() * view.scale);
        let top = if knocked { foot + vec2(height, -3.0) } else { foot - vec2(0.0, height) };
        draw_line(foot.x, foot.y, top.x, top.y, 4.0, if knocked { GRAY } else { DARKBLUE });
        draw_line(foot.x - 6.0, foot.y, foot.x + 6.0, foot.y, 3.0, DARKGRAY);
    }
}

fn character(runner: &Runner, view: &View, color: Color, is_yours: bool) {
    let shade = |color: Color, by: f32| Color::new(color.r * by, color.g * by, color.b * by, 1.0);
    let parts = runner.body.parts().iter().zip(&runner.body.character().parts);
    // The torso last: legs of both sides are drawn behind it.
    for (index, (state, part)) in parts.enumerate().collect::<Vec<_>>().into_iter().rev() {
        let fill = shade(color, if index == 0 { 1.0 } else { 0.75 + 0.05 * (index % 3) as f32 });
        let outline = if is_yours { BLACK } else { shade(color, 0.55) };
        let at =
            |x: f32, y: f32| view.at(state.x + state.cos * x - state.sin * y, state.y + state.sin * x + state.cos * y);
        let round = |y: f32, radius: f32| {
            let centre = at(0.0, y);
            draw_circle(centre.x, centre.y, radius * view.scale, fill);
        };
        let (width, height) = match part.shape {
            Shape::Box { width, height } => (width, height),
            Shape::Circle { radius } => {
                round(0.0, radius);
                continue;
            }
            Shape::Capsule { length, radius } => {
                round(-length / 2.0, radius);
                round(length / 2.0, radius);
                (2.0 * radius, length)
            }
        };
        let (w, h) = (width / 2.0, height / 2.0);
        let corners = [at(-w, -h), at(w, -h), at(w, h), at(-w, h)];
        draw_triangle(corners[0], corners[1], corners[2], fill);
        draw_triangle(corners[0], corners[2], corners[3], fill);
        for (from, to) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            draw_line(from.x, from.y, to.x, to.y, if is_yours { 2.5 } else { 1.5 }, outline);
        }
    }
}

fn standings(race: &Race, yours: usize) {
    for (place, lane) in race.standings().into_iter().enumerate() {
        let (runner, (name, _, color)) = (&race.runners[lane], CHARACTERS[lane]);
        let y = 26.0 + 24.0 * place as f32;
        let figure = match runner.finished {
            Some(time) => format!("{time:.2} s"),
            None => format!("{:.1} m", runner.distance().max(0.0)),
        };
        let marks = if lane == yours { ">" } else { "" };
        draw_text(marks, 6.0, y, 24.0, BLACK);
        draw_rectangle(20.0, y - 14.0, 16.0, 16.0, color);
        let knocked = runner.penalty();
        let penalty = if knocked > 0.0 { format!("  +{knocked:.0} s") } else { String::new() };
        draw_text(format!("{} {name}  {figure}{penalty}", lane + 1), 44.0, y, 24.0, BLACK);
    }
}
