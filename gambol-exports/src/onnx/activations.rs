//! Activations as operations of ONNX: those that `ne_net::Activation` computes, in their order, so that they give its bits. The
//! functions that ONNX has of its own differ from program to program.

use super::graph::{Graph, Kind};
use ne_net::Activation;
use std::f32::consts::LOG2_E;

/// The operations of an activation; the name of their result.
pub(crate) fn activate(graph: &mut Graph, activation: Activation, sums: &str) -> String {
    match activation {
        Activation::Logistic => logistic(graph, sums),
        Activation::Tanh => tanh(graph, sums),
        Activation::Relu => graph.apply("Relu", &[sums]),
        Activation::Linear => sums.into(),
        Activation::Sine => sine(graph, sums),
        Activation::SteepLogistic => {
            let steep = graph.times(sums, 4.9);
            logistic(graph, &steep)
        }
        Activation::SteepTanh => {
            let steep = graph.times(sums, 2.45);
            tanh(graph, &steep)
        }
        Activation::Gaussian => {
            let square = graph.apply("Mul", &[sums, sums]);
            let negative = graph.apply("Neg", &[&square]);
            exp(graph, &negative)
        }
        Activation::RationalTanh => rational_tanh(graph, sums),
    }
}

impl Graph {
    fn with(&mut self, kind: &str, input: &str, number: f32) -> String {
        let number = self.number(number);
        self.apply(kind, &[input, &number])
    }

    fn times(&mut self, input: &str, number: f32) -> String {
        self.with("Mul", input, number)
    }

    fn limited(&mut self, input: &str, [low, high]: [f32; 2]) -> String {
        let [low, high] = [low, high].map(|limit| self.number(limit));
        self.apply("Clip", &[input, &low, &high])
    }

    /// An operation whose first input is a number.
    fn number_and(&mut self, number: f32, kind: &str, input: &str) -> String {
        let number = self.number(number);
        self.apply(kind, &[&number, input])
    }
}

/// a(27 + a²) / (27 + 9a²), where a is at most 3 from 0.
fn rational_tanh(graph: &mut Graph, sums: &str) -> String {
    let a = graph.limited(sums, [-3.0, 3.0]);
    let square = graph.apply("Mul", &[&a, &a]);
    let sum = graph.number_and(27.0, "Add", &square);
    let above = graph.apply("Mul", &[&a, &sum]);
    let nine = graph.times(&square, 9.0);
    let below = graph.number_and(27.0, "Add", &nine);
    let ratio = graph.apply("Div", &[&above, &below]);
    graph.limited(&ratio, [-1.0, 1.0])
}

/// 1 / (1 + e⁻ᵃ).
fn logistic(graph: &mut Graph, sums: &str) -> String {
    let negative = graph.apply("Neg", &[sums]);
    let power = exp(graph, &negative);
    let below = graph.number_and(1.0, "Add", &power);
    graph.number_and(1.0, "Div", &below)
}

fn exp(graph: &mut Graph, x: &str) -> String {
    let x = graph.limited(x, [-87.0, 87.0]);
    let (power, small) = exp_parts(graph, &x);
    graph.apply("Add", &[&power, &small])
}

/// (1 - e⁻²ᵃ) / (1 + e⁻²ᵃ), for a from 0 to 10; then with the sign of a.
fn tanh(graph: &mut Graph, x: &str) -> String {
    let size = graph.apply("Abs", &[x]);
    let size = graph.limited(&size, [0.0, 10.0]);
    let double = graph.times(&size, -2.0);
    let (power, small) = exp_parts(graph, &double);
    let less = graph.number_and(1.0, "Sub", &power);
    let above = graph.apply("Sub", &[&less, &small]);
    let more = graph.number_and(1.0, "Add", &power);
    let below = graph.apply("Add", &[&more, &small]);
    let ratio = graph.apply("Div", &[&above, &below]);
    let sign = graph.apply("Sign", &[x]);
    graph.apply("Mul", &[&ratio, &sign])
}

/// The powers of 2 that `exp_parts` may need.
const POWERS: i32 = 126;

/// 2ⁿ and 2ⁿ(eʳ - 1) with n the integer nearest to x / ln 2 and x = n ln 2 + r, for |x| ≤ 87.
fn exp_parts(graph: &mut Graph, x: &str) -> (String, String) {
    let n = graph.times(x, LOG2_E);
    let n = graph.apply("Round", &[&n]);
    let upper = graph.times(&n, 355.0 / 512.0);
    let r = graph.apply("Sub", &[x, &upper]);
    let lower = graph.times(&n, -2.121_944_4e-4);
    let r = graph.apply("Sub", &[&r, &lower]);
    let square = graph.apply("Mul", &[&r, &r]);
    // Two terms of the series, the first of which is a number.
    let mut pair = |first: f32, second: f32| {
        let second = graph.times(&r, second);
        graph.number_and(first, "Add", &second)
    };
    let pairs = [pair(1.0 / 2.0, 1.0 / 6.0), pair(1.0 / 24.0, 1.0 / 120.0), pair(1.0 / 720.0, 1.0 / 5_040.0)];
    let last = graph.apply("Mul", &[&square, &pairs[2]]);
    let last = graph.apply("Add", &[&pairs[1], &last]);
    let rest = graph.apply("Mul", &[&square, &last]);
    let rest = graph.apply("Add", &[&pairs[0], &rest]);
    let rest = graph.apply("Mul", &[&square, &rest]);
    let rest = graph.apply("Add", &[&r, &rest]);
    let place = graph.with("Add", &n, POWERS as f32);
    let place = graph.cast(&place, Kind::Whole);
    let powers = graph.powers_of_two(POWERS);
    let power = graph.along(0, "Gather", &[&powers, &place]);
    let small = graph.apply("Mul", &[&power, &rest]);
    (power, small)
}

/// With 64 bits: less half turns, by a series.
fn sine(graph: &mut Graph, x: &str) -> String {
    let size = graph.apply("Abs", &[x]);
    let size = graph.limited(&size, [0.0, 4_294_967_296.0]);
    let size = graph.cast(&size, Kind::Double);
    let with = |graph: &mut Graph, kind: &str, input: &str, number: f64| {
        let number = graph.double(number);
        graph.apply(kind, &[input, &number])
    };
    let turns = with(graph, "Mul", &size, std::f64::consts::FRAC_1_PI);
    let turns = graph.apply("Round", &[&turns]);
    let upper = with(graph, "Mul", &turns, 3.141_592_653_468_251_2);
    let r = graph.apply("Sub", &[&size, &upper]);
    let lower = with(graph, "Mul", &turns, 1.215_420_109_760_201e-10);
    let r = graph.apply("Sub", &[&r, &lower]);
    let square = graph.apply("Mul", &[&r, &r]);
    let mut series = graph.double(1.0 / 6_227_020_800.0);
    for number in [-1.0 / 39_916_800.0, 1.0 / 362_880.0, -1.0 / 5_040.0, 1.0 / 120.0, -1.0 / 6.0] {
        let product = graph.apply("Mul", &[&square, &series]);
        series = with(graph, "Add", &product, number);
    }
    let cube = graph.apply("Mul", &[&r, &square]);
    let rest = graph.apply("Mul", &[&cube, &series]);
    let sine = graph.apply("Add", &[&r, &rest]);
    let sine = graph.cast(&sine, Kind::Single);
    // An odd number of half turns flips the sign, and so does a negative x: 1 - 2(n - 2⌊n / 2⌋).
    let half = with(graph, "Mul", &turns, 0.5);
    let whole = graph.apply("Floor", &[&half]);
    let even = with(graph, "Mul", &whole, 2.0);
    let odd = graph.apply("Sub", &[&turns, &even]);
    let odd = graph.cast(&odd, Kind::Single);
    let flips = graph.times(&odd, -2.0);
    let flips = graph.with("Add", &flips, 1.0);
    let sine = graph.apply("Mul", &[&sine, &flips]);
    let sign = graph.apply("Sign", &[x]);
    graph.apply("Mul", &[&sine, &sign])
}
