//! What strategies ask for, as other languages' bindings must have it too: `asked.json` is compared with the Python package as well.
//!
//! `GAMBOL_FIXTURES=write cargo test -p gambol-runs --test asked` writes it anew.

use gambol_runs::{Registry, strategies::NetStrategy};
use ne_core::{Evaluation, Seed};
use ne_fixed::{Ars, CmaEs, ConventionalNe, Cosyne, HillClimbing, Nsga2, OpenEs, RandomSearch, WeightVector};
use ne_neat::{Neat, NeatGenome};
use ne_net::{DenseShape, Topology};
use serde_json::{Map, Value, json};
use std::{fs, path::Path, sync::Arc};

type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Of a net of these layers.
const LAYERS: [usize; 3] = [3, 2, 1];
const SEED: u64 = 7;
const POPULATION: usize = 12;
const GENERATIONS: u64 = 6;

/// The last generation asked, where the fitness of an individual depends on its place alone.
fn asked<S: NetStrategy>(write: impl Fn(&S::Genome) -> Value) -> Result<(String, Value), Box<dyn std::error::Error>> {
    let registry = Registry::default();
    let mut settings = registry.strategies.find(S::NAME).ok_or("it is registered")?.settings();
    settings.set("population", json!(POPULATION));
    let settings = settings.of::<S::Settings>(S::NAME).ok_or("they are its own")?;
    let [inputs, hidden, outputs] = LAYERS;
    let topology = Topology::Dense(Arc::new(DenseShape::new(inputs, vec![hidden], outputs)));
    let mut strategy = S::build(&settings, &topology)?;
    let mut last = Value::Null;
    for generation in 1..=GENERATIONS {
        let seed = Seed::of_run(SEED).generation(generation);
        let genomes: Vec<Value> = strategy.ask(seed).iter().map(&write).collect();
        let count = genomes.len();
        last = genomes.into();
        let evaluation = |place: usize| {
            let fitness = ((7 * place + 3) % count) as f64;
            Evaluation { objectives: vec![fitness, -fitness], ..Evaluation::new(fitness) }
        };
        let evaluations: Vec<Evaluation> = (0..count).map(evaluation).collect();
        strategy.tell(&evaluations, seed);
    }
    Ok((S::NAME.to_owned(), last))
}

fn weights(genome: &WeightVector) -> Value {
    json!(genome.weights())
}

#[test]
fn strategies_ask_for_what_the_file_has() -> Outcome {
    let strategies: Map<String, Value> = [
        asked::<Ars>(weights)?,
        asked::<CmaEs>(weights)?,
        asked::<ConventionalNe>(weights)?,
        asked::<Cosyne>(weights)?,
        asked::<HillClimbing>(weights)?,
        asked::<Nsga2>(weights)?,
        asked::<OpenEs>(weights)?,
        asked::<RandomSearch>(weights)?,
        // As a genome's own text has its numbers.
        asked::<Neat>(|genome| serde_json::from_str(&json_of(genome)).unwrap_or_default())?,
    ]
    .into_iter()
    .collect();
    let found = json!({
        "layers": LAYERS, "seed": SEED, "population": POPULATION, "generations": GENERATIONS, "asked_last": &strategies,
    });
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/asked.json");
    if std::env::var("GAMBOL_FIXTURES").is_ok_and(|what| what == "write") {
        fs::write(&path, format!("{found:#}\n"))?;
    }
    let kept: Value = serde_json::from_str(&fs::read_to_string(&path)?)?;
    for (name, asked) in strategies {
        assert!(kept["asked_last"][&name] == asked, "{name} asks for something else than asked.json has");
    }
    Ok(())
}

fn json_of(genome: &NeatGenome) -> String {
    serde_json::to_string(genome).unwrap_or_default()
}
