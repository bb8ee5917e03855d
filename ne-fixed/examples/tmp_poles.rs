//! temporary
use ne_core::{Genome, Seed, Strategy};
use ne_fixed::*;
use ne_net::{Activation, GraphNeuron, GraphShape};
use tasks::*;

fn single(inputs: usize, bias: bool, a: Activation) -> GraphShape {
    let n = GraphNeuron { activation: a, bias, sources: (0..inputs).collect() };
    GraphShape { inputs, recurrent: false, neurons: vec![n], outputs: vec![inputs] }
}
fn full(inputs: usize, neurons: usize, bias: bool, a: Activation) -> GraphShape {
    let n = GraphNeuron { activation: a, bias, sources: (0..inputs + neurons).collect() };
    GraphShape { inputs, recurrent: true, neurons: vec![n; neurons], outputs: vec![inputs + neurons-1] }
}
fn solve<S: Strategy<Genome = WeightVector>>(mut s: S, task: &dyn Benchmark, run: u64, limit: u64) -> (Option<u64>, u64) {
    let mut count = 0;
    for g in 1.. {
        let seed = Seed::of_run(run).generation(g);
        let mut e = Vec::new();
        for genome in s.ask(seed).to_vec() {
            let mut p = genome.express();
            let ev = task.evaluate(&mut p, seed);
            count += 1;
            if task.is_candidate(&ev) && task.is_solved(&mut p, &ev) { return (Some(count), 0); }
            e.push(ev);
            if count >= limit { return (None, count); }
        }
        s.tell(&e, seed);
    }
    unreachable!()
}
fn report<S: Strategy<Genome = WeightVector>>(name: &str, make: impl Fn() -> S, task: &dyn Benchmark, runs: u64, limit: u64) {
    let mut v: Vec<u64> = Vec::new(); let mut fails = 0;
    let t = std::time::Instant::now();
    for r in 1..=runs { match solve(make(), task, r, limit).0 { Some(c) => v.push(c), None => fails += 1 } }
    v.sort_unstable();
    let mean = v.iter().sum::<u64>() as f64 / v.len().max(1) as f64;
    println!("{name}: mean {mean:.0} median {} max {} unsolved {fails}/{runs}  {:.1}s", v.get(v.len()/2).unwrap_or(&0), v.last().unwrap_or(&0), t.elapsed().as_secs_f64());
}
fn cma(step: f64, pop: Option<usize>, restart: Restart, init: f64, shape: &GraphShape) -> CmaEs {
    CmaEs::new(CmaEsSettings { step_size: step, population: pop, restart, initial_mean: Initialization::Uniform{limit: init}, ..Default::default() }, shape.clone()).expect("ok")
}
fn main() {
    let which = std::env::args().nth(1).expect("arg");
    let task: Box<dyn Benchmark> = match which.as_bytes()[0] {
        b'1' => Box::new(CartPole::new(CartPoleSettings::default()).expect("ok")),
        b'2' => Box::new(DoublePole::new(DoublePoleSettings::with_velocities()).expect("ok")),
        _ => Box::new(DoublePole::new(DoublePoleSettings::without_velocities()).expect("ok")),
    };
    let runs: u64 = std::env::args().nth(3).and_then(|x| x.parse().ok()).unwrap_or(20);
    let limit: u64 = std::env::args().nth(4).and_then(|x| x.parse().ok()).unwrap_or(20000);
    let method = std::env::args().nth(2).expect("arg");
    for bias in [false, true] {
        for act in [Activation::Logistic, Activation::SteepLogistic] {
            for h in [3usize, 4] {
            let shape = match which.as_bytes()[0] { b'1' => single(4, bias, act), b'2' => single(6, bias, act), _ => full(3, h, bias, act) };
            if which.as_bytes()[0] != b'3' && h == 4 { continue; }
            if method == "cma" {
                for step in [1.0, 3.0, 10.0, 30.0] { for pop in [None, Some(4), Some(6)] {
                    report(&format!("cma {which} bias {bias} {act:?} h {h} step {step} pop {pop:?}"), || cma(step, pop, Restart::None, 0.0, &shape), &*task, runs, limit);
                } }
            } else {
                for limit_w in [1.0, 5.0, 10.0, 30.0] { for pop in [16, 24, 40] { for perm in [Permutation::All, Permutation::ByFitness] { for (rate, scale) in [(0.2, 0.3), (0.5, 1.0)] {
                    let s = CosyneSettings { population: pop, permutation: perm, mutation_rate: rate, mutation_scale: scale*limit_w, initialization: Initialization::Uniform{limit: limit_w}, ..Default::default() };
                    report(&format!("cosyne {which} bias {bias} {act:?} h {h} init {limit_w} pop {pop} {perm:?} rate {rate} scale {scale}"), || Cosyne::new(s.clone(), shape.clone()).expect("ok"), &*task, runs, limit);
                } } } }
            }
            }
        }
    }
}
