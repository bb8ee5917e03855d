//! What the strategies over weights promise, conventional neuroevolution aside.

mod baselines;
mod cma_es;
mod cma_es_convergence;
mod common;
mod cosyne;
mod growing;
mod nsga2;
mod open_es;
mod poles;
