//! temporary
use ne_core::{Evaluation, Seed, Strategy};
use ne_fixed::*;
fn main() {
    let settings = CmaEsSettings { population: Some(50), ..Default::default() };
    let mut s = CmaEs::new(settings, ne_net::DenseShape::new(9, vec![10], 8)).expect("x");
    let e: Vec<_> = (0..50).map(|i| Evaluation::new((i * 7919 % 1009) as f64)).collect();
    for g in 0..4000 { let seed = Seed::of_run(1).generation(g); s.ask(seed); s.tell(&e, seed); }
}
