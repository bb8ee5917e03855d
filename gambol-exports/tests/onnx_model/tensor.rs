//! Lists of numbers with a shape, and the operations on them.

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Single,
    Double,
    Whole,
}

impl Kind {
    pub(super) fn of(number: u64) -> Self {
        match number {
            1 => Self::Single,
            7 => Self::Whole,
            11 => Self::Double,
            other => panic!("kind {other} of numbers"),
        }
    }
}

/// Every number of 32 bits, and every whole number there is, is one of 64 bits.
#[derive(Clone, Debug)]
pub(super) struct Tensor {
    pub(super) kind: Kind,
    pub(super) shape: Vec<usize>,
    pub(super) numbers: Vec<f64>,
}

impl Tensor {
    pub(super) fn row(numbers: &[f32]) -> Self {
        let shape = vec![1, numbers.len()];
        Self { kind: Kind::Single, shape, numbers: numbers.iter().map(|&number| number.into()).collect() }
    }

    pub(super) fn singles(&self) -> Vec<f32> {
        self.numbers.iter().map(|&number| number as f32).collect()
    }

    /// With the precision of its kind. What was computed with 64 bits from numbers of 32 is rounded as if computed with 32.
    fn rounded(kind: Kind, shape: Vec<usize>, numbers: impl Iterator<Item = f64>) -> Self {
        let round = |number: f64| if kind == Kind::Single { f64::from(number as f32) } else { number };
        let numbers: Vec<f64> = numbers.map(round).collect();
        assert_eq!(numbers.len(), shape.iter().product::<usize>());
        Self { kind, shape, numbers }
    }

    fn map(&self, function: impl Fn(f64) -> f64) -> Self {
        Self::rounded(self.kind, self.shape.clone(), self.numbers.iter().map(|&number| function(number)))
    }

    /// Shapes are compared from their ends; a side of 1 is repeated.
    fn with(&self, other: &Self, function: impl Fn(f64, f64) -> f64) -> Self {
        assert_eq!(self.kind, other.kind, "numbers of one kind");
        let sides = self.shape.len().max(other.shape.len());
        let padded = |shape: &[usize]| [vec![1; sides - shape.len()], shape.to_vec()].concat();
        let (one, two) = (padded(&self.shape), padded(&other.shape));
        let shape: Vec<usize> = one.iter().zip(&two).map(|(&one, &two)| one.max(two)).collect();
        for (side, (one, two)) in shape.iter().zip(one.iter().zip(&two)) {
            assert!([1, *side].contains(one) && [1, *side].contains(two), "{:?} and {:?}", self.shape, other.shape);
        }
        let place = |of: &[usize], mut index: usize| {
            let (mut place, mut stride) = (0, 1);
            for (&side, &own) in shape.iter().zip(of).rev() {
                place += stride * if own == 1 { 0 } else { index % side };
                (index, stride) = (index / side, stride * own);
            }
            place
        };
        let numbers = (0..shape.iter().product())
            .map(|index| function(self.numbers[place(&one, index)], other.numbers[place(&two, index)]));
        let numbers: Vec<f64> = numbers.collect();
        Self::rounded(self.kind, shape, numbers.into_iter())
    }

    /// How many lists are before an axis, how long it is, and how many numbers each of its places has.
    fn sides(&self, axis: usize) -> [usize; 3] {
        let product = |sides: &[usize]| sides.iter().product();
        [product(&self.shape[..axis]), self.shape[axis], product(&self.shape[axis + 1..])]
    }

    fn gathered(&self, indices: &Self, axis: usize) -> Self {
        assert_eq!(indices.kind, Kind::Whole);
        let [before, length, after] = self.sides(axis);
        let taken = |list: usize| {
            indices.numbers.iter().flat_map(move |&index| {
                assert!(index >= 0.0 && (index as usize) < length);
                let start = (list * length + index as usize) * after;
                self.numbers[start..start + after].iter().copied()
            })
        };
        let shape = [&self.shape[..axis], &indices.shape, &self.shape[axis + 1..]].concat();
        Self::rounded(self.kind, shape, (0..before).flat_map(taken))
    }

    fn joined(tensors: &[&Self], axis: usize) -> Self {
        let mut shape = tensors[0].shape.clone();
        shape[axis] = tensors.iter().map(|tensor| tensor.shape[axis]).sum();
        let [before, ..] = tensors[0].sides(axis);
        let numbers = (0..before).flat_map(|list| {
            tensors.iter().flat_map(move |tensor| {
                let [_, length, after] = tensor.sides(axis);
                tensor.numbers[list * length * after..(list + 1) * length * after].iter().copied()
            })
        });
        Self::rounded(tensors[0].kind, shape, numbers)
    }

    /// Each place is the sum of those up to it, added one after the other.
    fn summed_up(&self, axis: usize) -> Self {
        let [_, length, after] = self.sides(axis);
        let mut sums = self.clone();
        for place in 0..sums.numbers.len() {
            if !(place / after).is_multiple_of(length) {
                sums.numbers[place] = f64::from((sums.numbers[place - after] + sums.numbers[place]) as f32);
            }
        }
        assert_eq!(self.kind, Kind::Single);
        sums
    }

    fn single_number(&self) -> f64 {
        assert_eq!(self.numbers.len(), 1);
        self.numbers[0]
    }
}

pub(super) fn compute(kind: &str, inputs: &[&Tensor], attribute: Option<(&str, u64)>) -> Tensor {
    let first = inputs[0];
    let axis = || match attribute {
        Some(("axis", axis)) => axis as usize,
        other => panic!("{kind} has no {other:?}"),
    };
    match kind {
        "Concat" => Tensor::joined(inputs, axis()),
        "Gather" => first.gathered(inputs[1], axis()),
        "CumSum" => first.summed_up(inputs[1].single_number() as usize),
        "Cast" => match attribute {
            Some(("to", to)) => Tensor::rounded(Kind::of(to), first.shape.clone(), first.numbers.iter().copied()),
            other => panic!("a cast with {other:?}"),
        },
        "Identity" => first.clone(),
        "Clip" => first.map(|number| number.clamp(inputs[1].single_number(), inputs[2].single_number())),
        "Relu" => first.map(|a| a.max(0.0)),
        "Neg" => first.map(|a| -a),
        "Abs" => first.map(f64::abs),
        "Sign" => first.map(|a| if a == 0.0 { 0.0 } else { a.signum() }),
        "Round" => first.map(f64::round_ties_even),
        "Floor" => first.map(f64::floor),
        "Mul" => first.with(inputs[1], |a, b| a * b),
        "Add" => first.with(inputs[1], |a, b| a + b),
        "Sub" => first.with(inputs[1], |a, b| a - b),
        "Div" => first.with(inputs[1], |a, b| a / b),
        other => panic!("{other} is not known"),
    }
}
