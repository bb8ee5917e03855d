//! What one page sees: it answers what the page asks, and tells it what is new.

use crate::{
    Arena, Entrant, Member, Scene, Shown, World, choice,
    judging::judge_champions,
    library::Library,
    population::Population,
    protocol::{Choice, Event, Opened, Request, RobustnessState, RunState, Verdict, Who},
    robustness,
    session::Session,
    training,
};
use creatures::{Creature, Terrain};
use gambol_runs::champion::Champion;
use ne_core::{Seed, field_path};
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
    /// The generation that was shown last, without the nets of its members.
    population: Option<Population>,
    /// The run whose champion is in the second arena, and what the page knows of its verdict.
    beside: Option<(Arc<Session>, Option<Verdict>)>,
    told: Told,
    arenas: [Option<(u32, Arena)>; 2],
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
    robustness: Option<RobustnessState>,
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
        let (session, guest, shown, population, beside) = (None, None, None, None, None);
        let (arenas, number, shows_scenes) = ([None, None], 0, false);
        Self { library, session, look, guest, shown, population, beside, told, arenas, number, shows_scenes }
    }

    /// For a page whose creatures move elsewhere: it is sent the [scene](Scene) that is to be shown, and lets another viewer
    /// [enter](Request::Enter) it.
    #[must_use]
    pub fn of_scenes(self) -> Self {
        Self { shows_scenes: true, ..self }
    }

    /// Answers a message.
    pub fn answer(&mut self, message: &str) -> Vec<Reply> {
        let request: Request = match field_path::from_str(message) {
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
        let mut news: Vec<Reply> = self.news_beside().into_iter().collect();
        let Some(session) = self.session.clone() else { return news };
        session.refresh();
        let (rows, stages) = session.since(self.told.rows, self.told.stages);
        self.told.stages += stages.len();
        news.extend(stages.into_iter().map(|(row, name)| Event::Stage { name, row }.into()));
        self.told.rows += rows.len();
        news.extend(rows.chunks(ROWS).map(|rows| Event::Generations { rows: rows.to_vec() }.into()));
        if let Some(verdict) = session.verdict().filter(|verdict| self.told.verdict.as_ref() != Some(verdict)) {
            self.told.verdict = Some(verdict.clone());
            news.push(Event::Verdict(verdict).into());
        }
        if let Some(state) = session.robustness().filter(|state| self.told.robustness.as_ref() != Some(state)) {
            self.told.robustness = Some(state.clone());
            news.push(Event::Robustness(state).into());
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
        let catalogue = || Event::Catalogue(Box::new(library.catalogue()));
        let event = match request {
            Request::Look => catalogue(),
            #[cfg(feature = "schema")]
            Request::Schema => Event::Schema { schema: gambol_runs::schema::json_schema(library.registry()) },
            #[cfg(not(feature = "schema"))]
            Request::Schema => return Err("the schema is a file beside the page".into()),
            Request::Describe { choice } => Event::Described(Box::new(library.describe(&choice))),
            Request::Check { creature, number } => Event::Checked { number, problems: choice::check(&creature) },
            Request::Keep { creature } => {
                let creature: Creature = field_path::from_value(&creature)?;
                library.keep(&creature)?;
                catalogue()
            }
            Request::CheckTerrain { terrain, number } => {
                Event::Checked { number, problems: choice::check_terrain(&terrain) }
            }
            Request::KeepTerrain { name, terrain } => {
                let terrain: Terrain = field_path::from_value(&terrain)?;
                library.keep_terrain(&name, &terrain)?;
                catalogue()
            }
            Request::Remove { run } => {
                library.remove(&run)?;
                if self.session.as_ref().is_some_and(|session| session.name() == run) {
                    (self.session, self.population, self.told) = (None, None, Told::default());
                }
                catalogue()
            }
            Request::RemoveCreature { name } => {
                library.remove_creature(&name)?;
                catalogue()
            }
            Request::RemoveTerrain { name } => {
                library.remove_terrain(&name)?;
                catalogue()
            }
            Request::Film { run } => library.film(&run),
            Request::Robustness => {
                robustness::replay(self.session()?, &Arc::downgrade(&self.look))?;
                return Ok(self.news());
            }
            Request::Train { choice } => return Ok(self.open(library.train(&choice)?)),
            Request::Open { run } => return Ok(self.open(library.open(&run)?)),
            Request::OpenLatest => {
                let session = library.latest().map_or_else(|| library.train(&Choice::first()), Ok)?;
                return Ok(self.open(session));
            }
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
            Request::Show { who, arena, run: Some(run), .. } => return self.show_beside(&run, who, arena),
            Request::Show { family_of: Some(place), arena, .. } => {
                let scene = self.family(place)?;
                self.show(scene, arena)?
            }
            Request::Show { who, arena, terrain, friction, .. } => {
                let scene = self.scene(who, terrain.as_deref(), friction)?;
                self.show(scene, arena)?
            }
            Request::Enter { scene, arena } => self.enter(field_path::from_value(&scene)?, arena)?,
            Request::Leave { arena } => {
                self.leave(arena);
                return Ok(Vec::new());
            }
            Request::Advance { steps, arena, number: meant } => {
                let (number, arena) = self.arena(arena)?;
                if meant.is_some_and(|meant| meant != number) {
                    return Ok(Vec::new());
                }
                arena.advance(steps);
                return Ok(vec![Reply::Frame(arena.frame(number))]);
            }
            Request::Tell(told) => {
                self.arena(0)?.1.tell(told);
                return Ok(Vec::new());
            }
            Request::Push { part, velocity } => return self.meddle(|arena| Ok(arena.push(part, velocity)?)),
            Request::Tilt { angle, factor } => return self.meddle(|arena| Ok(arena.tilt(angle, factor)?)),
            Request::PutBox { x, width, height } => {
                let (_, arena) = self.arena(0)?;
                arena.put_box(x, width, height)?;
                Event::Ground { ground: arena.ground_data() }
            }
        };
        Ok(vec![event.into()])
    }

    fn open(&mut self, session: Arc<Session>) -> Vec<Reply> {
        // What worked for the run that was open may end.
        (self.look, self.shown, self.population, self.beside) = (Arc::new(()), None, None, None);
        judge_champions(&session, &Arc::downgrade(&self.look));
        let opened = session.opened();
        (self.session, self.guest, self.arenas, self.told) = (Some(session), None, [None, None], Told::default());
        self.told.state = Some(opened.state.clone());
        let mut replies = vec![Event::Opened(Box::new(opened)).into()];
        replies.extend(self.news());
        replies
    }

    /// Opens a champion that a page has read from a file.
    fn open_champion(&mut self, champion: Champion) -> Result<Vec<Reply>, Refusal> {
        let registry = self.library.registry();
        let config =
            registry.config(&registry.presets.first().name, champion.creature.clone(), &champion.movement.name)?;
        let unit = registry.movements.build(&champion.movement)?.unit().to_owned();
        let state = RunState::Ended { reason: format!("a champion of generation {}", champion.generation) };
        let opened = Opened { run: String::new(), config, unit, command: String::new(), state };
        let verdict = Event::Verdict(Verdict::of(&champion, registry));
        let replies = vec![Event::Opened(Box::new(opened)).into(), verdict.into()];
        (self.session, self.guest, self.arenas) = (None, Some(Box::new(champion)), [None, None]);
        (self.look, self.shown) = (Arc::new(()), None);
        (self.population, self.beside) = (None, None);
        Ok(replies)
    }

    /// What is to be shown.
    fn scene(&mut self, who: Who, terrain: Option<&str>, friction: Option<f32>) -> Result<Scene, Refusal> {
        let terrain = terrain.map(|name| self.library.registry_with_drawn().terrains.terrain(name)).transpose()?;
        let session = self.session.clone();
        let population = match (who, &session) {
            (Who::Population, Some(session)) => session.population(),
            _ => None,
        };
        if let Some(mut population) = population {
            let config = &mut population.config;
            config.terrain = terrain.unwrap_or_else(|| config.terrain.clone());
            config.physics.ground_friction = friction.unwrap_or(config.physics.ground_friction);
            let entrants = std::mem::take(&mut population.entrants);
            let scene = scene_of(&population, Shown::Population, entrants);
            self.population = Some(population);
            return Ok(scene);
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
        Ok(judged_scene(generation, champion, entrants))
    }

    /// One of the generation that was shown last, and its parents.
    fn family(&self, place: usize) -> Result<Scene, Refusal> {
        let population = self.population.as_ref().ok_or("no generation is shown")?;
        let entrants = population.family(place).ok_or("nothing is known of its parents")?;
        Ok(scene_of(population, Shown::Family, entrants))
    }

    /// Shows the champion of another run.
    fn show_beside(&mut self, run: &str, who: Who, arena: usize) -> Result<Vec<Reply>, Refusal> {
        if who == Who::Population {
            return Err("only the champion of another run can be shown".into());
        }
        let session = self.library.open(run)?;
        let champion = session.champion().ok_or("there is no champion yet")?;
        judge_champions(&session, &Arc::downgrade(&self.look));
        let entrants = vec![entrant(&champion)];
        let event = self.show(judged_scene(champion.generation, champion, entrants), arena)?;
        let beside = beside(&session, session.verdict());
        self.beside = Some((Arc::clone(&session), session.verdict()));
        Ok(vec![beside, event.into()])
    }

    fn news_beside(&mut self) -> Option<Reply> {
        let (session, told) = self.beside.as_mut()?;
        let verdict = session.verdict().filter(|verdict| told.as_ref() != Some(verdict))?;
        *told = Some(verdict.clone());
        Some(beside(session, Some(verdict)))
    }

    /// Shows a scene, or tells it to a page whose arena is elsewhere.
    fn show(&mut self, scene: Scene, arena: usize) -> Result<Event, Refusal> {
        match self.shows_scenes {
            true => Ok(Event::Scene { scene: Box::new(scene), arena }),
            false => self.enter(scene, arena),
        }
    }

    /// Builds an arena, in place of the one that was.
    fn enter(&mut self, mut scene: Scene, place: usize) -> Result<Event, Refusal> {
        // Each has a world of its own.
        scene.entrants.truncate(MOST_ENTRANTS);
        let arena = Arena::of(&scene, self.library.registry())?;
        let room = self.arenas.get_mut(place).ok_or("there are two arenas, 0 and 1")?;
        self.number += 1;
        let data = Box::new(arena.data());
        *room = Some((self.number, arena));
        let Scene { who, generation, entrants, .. } = scene;
        let members = entrants.into_iter().map(|entrant| entrant.member).collect();
        Ok(Event::Arena { arena: place, number: self.number, who, generation, members, data })
    }

    fn leave(&mut self, place: usize) {
        if let Some(room) = self.arenas.get_mut(place) {
            *room = None;
        }
        if place == 1 {
            self.beside = None;
        }
    }

    fn session(&self) -> Result<&Arc<Session>, Refusal> {
        self.session.as_ref().ok_or_else(|| "no run is open".into())
    }

    /// What is in an arena, and the number that it goes by.
    fn arena(&mut self, place: usize) -> Result<(u32, &mut Arena), Refusal> {
        let shown = self.arenas.get_mut(place).and_then(Option::as_mut);
        shown.map(|(number, arena)| (*number, arena)).ok_or_else(|| "nothing is shown".into())
    }

    fn control(&mut self, act: impl FnOnce(&Session)) -> Result<Vec<Reply>, Refusal> {
        act(self.session()?);
        Ok(self.news())
    }

    fn meddle(&mut self, act: impl FnOnce(&mut Arena) -> Result<(), Refusal>) -> Result<Vec<Reply>, Refusal> {
        act(self.arena(0)?.1)?;
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
    let member = Member { fitness: Some(champion.fitness), ..Member::default() };
    Entrant { network: champion.network.clone(), member }
}

/// A generation, or some of it, in the first of its trials.
fn scene_of(population: &Population, who: Shown, entrants: Vec<Entrant>) -> Scene {
    let world = World::Training(Box::new(population.config.clone()));
    Scene { who, generation: population.generation, world, entrants, seed: population.seed.trial(0) }
}

/// A champion, perhaps with its ghost, where it is judged.
fn judged_scene(generation: u64, champion: Champion, entrants: Vec<Entrant>) -> Scene {
    let world = World::Judged(Box::new(champion));
    Scene { who: Shown::Champion, generation, world, entrants, seed: Seed::of_run(0) }
}

fn beside(session: &Session, verdict: Option<Verdict>) -> Reply {
    let Opened { run, config, unit, .. } = session.opened();
    let creature = if config.creature.title.is_empty() { config.creature.name } else { config.creature.title };
    Event::Beside { run, creature, movement: config.movement.name, unit, verdict }.into()
}
