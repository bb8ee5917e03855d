//! What one page sees: it answers what the page asks, and tells it what is new.

use crate::{
    Arena, Entrant, Scene, World, choice,
    judging::judge_champions,
    library::Library,
    protocol::{Event, Opened, Request, RunState, Verdict, Who},
    session::{Population, Session},
    training,
};
use creatures::Creature;
use gambol_runs::champion::Champion;
use ne_core::Seed;
use serde_json::Value;
use std::{path::Path, sync::Arc};

/// What a page is sent.
#[derive(Clone, Debug)]
pub enum Reply {
    /// A message.
    Event(Box<Event>),
    /// What is to be seen: see [`Arena::frame`].
    Frame(Vec<u8>),
}

/// One page.
pub struct Viewer {
    library: Arc<Library>,
    session: Option<Arc<Session>>,
    /// Goes with this viewer: what works for it ends then.
    look: Arc<()>,
    /// A champion that was opened from a file, in place of a run.
    guest: Option<Box<Champion>>,
    /// The champion that was shown last.
    shown: Option<Box<Champion>>,
    told: Told,
    arena: Option<Arena>,
    number: u32,
    shows_scenes: bool,
}

/// What the page knows of the open run.
#[derive(Default)]
struct Told {
    rows: usize,
    stages: usize,
    state: Option<RunState>,
    verdict: Option<Verdict>,
}

/// What is wrong, in words for the page.
type Refusal = Box<dyn std::error::Error>;

/// The most that are shown at once, the best of a generation.
const MOST_ENTRANTS: usize = 1000;

/// Lengths of history are sent in pieces of so many generations.
const ROWS: usize = 2000;

impl From<Event> for Reply {
    fn from(event: Event) -> Self {
        Self::Event(Box::new(event))
    }
}

impl Viewer {
    /// A page that sees nothing yet.
    pub fn new(library: Arc<Library>) -> Self {
        let (look, told) = (Arc::new(()), Told::default());
        let (session, guest, shown, arena, number, shows_scenes) = (None, None, None, None, 0, false);
        Self { library, session, look, guest, shown, told, arena, number, shows_scenes }
    }

    /// For a page whose creatures move elsewhere: it is sent the [scene](Scene) that is to be shown, and lets another viewer
    /// [enter](Request::Enter) it.
    #[must_use]
    pub fn of_scenes(self) -> Self {
        Self { shows_scenes: true, ..self }
    }

    /// Answers a message.
    pub fn answer(&mut self, message: &str) -> Vec<Reply> {
        let request: Request = match serde_json::from_str(message) {
            Ok(request) => request,
            Err(error) => return vec![refused("", &error)],
        };
        let name = name_of(message);
        match self.handle(request) {
            Ok(replies) => replies,
            Err(error) => vec![refused(&name, &*error)],
        }
    }

    /// What is new in the open run.
    pub fn news(&mut self) -> Vec<Reply> {
        let Some(session) = self.session.clone() else { return Vec::new() };
        session.refresh();
        let mut news: Vec<Reply> = Vec::new();
        let (rows, stages) = session.since(self.told.rows, self.told.stages);
        self.told.stages += stages.len();
        news.extend(stages.into_iter().map(|(row, name)| Event::Stage { name, row }.into()));
        self.told.rows += rows.len();
        news.extend(rows.chunks(ROWS).map(|rows| Event::Generations { rows: rows.to_vec() }.into()));
        if let Some(verdict) = session.verdict().filter(|verdict| self.told.verdict.as_ref() != Some(verdict)) {
            self.told.verdict = Some(verdict.clone());
            news.push(Event::Verdict(verdict).into());
        }
        // The state comes last: a page that hears of the end has then heard of all generations.
        let state = session.state();
        if self.told.state.as_ref() != Some(&state) {
            self.told.state = Some(state.clone());
            news.push(Event::State(state).into());
        }
        news
    }

    fn handle(&mut self, request: Request) -> Result<Vec<Reply>, Refusal> {
        let library = Arc::clone(&self.library);
        let event = match request {
            Request::Look => Event::Catalogue(Box::new(library.catalogue())),
            Request::Schema => Event::Schema { schema: gambol_runs::schema::json_schema(library.registry()) },
            Request::Describe { choice } => {
                let described = choice.describe(&library.registry_with_drawn(), &library.kept());
                Event::Described(Box::new(described))
            }
            Request::Check { creature, number } => Event::Checked { number, problems: choice::check(&creature) },
            Request::Keep { creature } => {
                let creature: Creature = serde_json::from_value(creature)?;
                library.keep(&creature)?;
                Event::Catalogue(Box::new(library.catalogue()))
            }
            Request::Train { choice } => return Ok(self.open(library.train(&choice)?)),
            Request::Open { run } => return Ok(self.open(library.open(&run)?)),
            Request::OpenChampion { name, text } => {
                return self.open_champion(Champion::from_text(Path::new(&name), &text)?);
            }
            Request::Pause => return self.control(|session| session.pause()),
            Request::Step => return self.control(|session| session.step()),
            Request::Stop => return self.control(|session| session.stop()),
            Request::GoOn { generations } => {
                training::go_on(self.session()?, generations)?;
                return Ok(self.news());
            }
            Request::Show { who, terrain, friction } => {
                let scene = self.scene(who, terrain.as_deref(), friction)?;
                match self.shows_scenes {
                    true => Event::Scene { scene: Box::new(scene) },
                    false => self.enter(scene)?,
                }
            }
            Request::Enter { scene } => self.enter(*scene)?,
            Request::Advance { steps } => {
                let number = self.number;
                let arena = self.arena()?;
                arena.advance(steps);
                return Ok(vec![Reply::Frame(arena.frame(number))]);
            }
            Request::Tell(told) => {
                self.arena()?.tell(told);
                return Ok(Vec::new());
            }
            Request::Push { part, velocity } => return self.meddle(|arena| Ok(arena.push(part, velocity)?)),
            Request::Tilt { angle, factor } => return self.meddle(|arena| Ok(arena.tilt(angle, factor)?)),
            Request::PutBox { x, width, height } => {
                let arena = self.arena()?;
                arena.put_box(x, width, height)?;
                Event::Ground { ground: arena.ground_data() }
            }
        };
        Ok(vec![event.into()])
    }

    fn open(&mut self, session: Arc<Session>) -> Vec<Reply> {
        // What worked for the run that was open may end.
        (self.look, self.shown) = (Arc::new(()), None);
        judge_champions(&session, &Arc::downgrade(&self.look));
        let opened = session.opened();
        (self.session, self.guest, self.arena, self.told) = (Some(session), None, None, Told::default());
        self.told.state = Some(opened.state.clone());
        let mut replies = vec![Event::Opened(Box::new(opened)).into()];
        replies.extend(self.news());
        replies
    }

    /// Opens a champion that a page has read from a file.
    fn open_champion(&mut self, champion: Champion) -> Result<Vec<Reply>, Refusal> {
        let registry = self.library.registry();
        let config =
            registry.config(registry.presets.first().name, champion.creature.clone(), &champion.movement.name)?;
        let unit = registry.movements.build(&champion.movement)?.unit().to_owned();
        let state = RunState::Ended { reason: format!("a champion of generation {}", champion.generation) };
        let opened = Opened { run: String::new(), config, unit, command: String::new(), state };
        let verdict = Event::Verdict(Verdict::of(&champion, registry));
        let replies = vec![Event::Opened(Box::new(opened)).into(), verdict.into()];
        (self.session, self.guest, self.arena) = (None, Some(Box::new(champion)), None);
        Ok(replies)
    }

    /// What is to be shown.
    fn scene(&mut self, who: Who, terrain: Option<&str>, friction: Option<f32>) -> Result<Scene, Refusal> {
        let terrain = terrain.map(|name| self.library.registry().terrains.terrain(name)).transpose()?;
        let session = self.session.clone();
        let population = match (who, &session) {
            (Who::Population, Some(session)) => session.population(),
            _ => None,
        };
        if let Some(Population { generation, seed, entrants, mut config }) = population {
            config.terrain = terrain.unwrap_or(config.terrain);
            config.physics.ground_friction = friction.unwrap_or(config.physics.ground_friction);
            return Ok(Scene { generation, world: World::Training(Box::new(config)), entrants, seed: seed.trial(0) });
        }
        let champion = self.guest.as_deref().cloned().or_else(|| session?.champion());
        let mut champion = champion.ok_or("there is no champion yet")?;
        let mut entrants = vec![entrant(&champion)];
        if who == Who::Champions {
            let is_ghost = |before: &&Champion| {
                let fits = before.inputs == champion.inputs && before.outputs == champion.outputs;
                fits && before.generation != champion.generation
            };
            let before = self.shown.as_deref().filter(is_ghost);
            entrants.extend(before.map(entrant));
            self.shown = Some(Box::new(champion.clone()));
        }
        champion.terrain = terrain.unwrap_or(champion.terrain);
        champion.physics.ground_friction = friction.unwrap_or(champion.physics.ground_friction);
        let generation = champion.generation;
        Ok(Scene { generation, world: World::Judged(Box::new(champion)), entrants, seed: Seed::of_run(0) })
    }

    /// Builds an arena, in place of the one that was.
    fn enter(&mut self, mut scene: Scene) -> Result<Event, Refusal> {
        // Each has a world of its own.
        scene.entrants.truncate(MOST_ENTRANTS);
        let arena = Arena::of(&scene, self.library.registry())?;
        self.number += 1;
        let fitness = scene.entrants.iter().map(|entrant| entrant.fitness.map(|fitness| fitness.get())).collect();
        let who = match scene.world {
            World::Training(_) => "population",
            World::Judged(_) => "champion",
        };
        let (number, generation) = (self.number, scene.generation);
        let event = Event::Arena { number, who, generation, fitness, data: Box::new(arena.data()) };
        self.arena = Some(arena);
        Ok(event)
    }

    fn session(&self) -> Result<&Arc<Session>, Refusal> {
        self.session.as_ref().ok_or_else(|| "no run is open".into())
    }

    fn arena(&mut self) -> Result<&mut Arena, Refusal> {
        self.arena.as_mut().ok_or_else(|| "nothing is shown".into())
    }

    fn control(&mut self, act: impl FnOnce(&Session)) -> Result<Vec<Reply>, Refusal> {
        act(self.session()?);
        Ok(self.news())
    }

    fn meddle(&mut self, act: impl FnOnce(&mut Arena) -> Result<(), Refusal>) -> Result<Vec<Reply>, Refusal> {
        act(self.arena()?)?;
        Ok(Vec::new())
    }
}

fn refused(request: &str, error: &dyn std::fmt::Display) -> Reply {
    Event::Refused { request: request.to_owned(), reason: error.to_string() }.into()
}

/// The name of what a message asks for.
fn name_of(message: &str) -> String {
    let value: Value = serde_json::from_str(message).unwrap_or_default();
    value["do"].as_str().unwrap_or_default().to_owned()
}

fn entrant(champion: &Champion) -> Entrant {
    Entrant { network: champion.network.clone(), fitness: Some(champion.fitness) }
}
