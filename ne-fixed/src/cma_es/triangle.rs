use pulp::{Arch, Simd, WithSimd};
use std::ops::Range;

/// The upper triangle of a square matrix, row by row, each row from its diagonal on.
///
/// Everything here adds multiples of rows to rows: element by element, in a fixed order, so that the bits do not depend
/// on how wide the processor's vectors are, and the widest can be used. That is why this is no linear-algebra library:
/// fast ones choose other sums, or fused ones, on other processors. Rows are taken several at a time only to touch memory
/// less often.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Triangle {
    size: usize,
    elements: Vec<f64>,
}

/// How many rows are taken at once.
const BLOCK: usize = 4;

impl Triangle {
    /// The number of elements of the triangle of a matrix with `size` rows.
    pub(super) fn element_count(size: usize) -> usize {
        size * (size + 1) / 2
    }

    /// `variance` times the identity.
    pub(super) fn diagonal(size: usize, variance: f64) -> Self {
        let mut triangle = Self { size, elements: vec![0.0; Self::element_count(size)] };
        (0..size).for_each(|row| triangle.row_mut(row)[0] = variance);
        triangle
    }

    /// The symmetric matrix with this diagonal and these elements above it, by row and column.
    pub(super) fn of(size: usize, diagonal: &[f64], above: impl Fn(usize, usize) -> f64) -> Self {
        let mut triangle = Self { size, elements: Vec::with_capacity(Self::element_count(size)) };
        for (row, &first) in diagonal.iter().enumerate() {
            triangle.elements.push(first);
            triangle.elements.extend((row + 1..size).map(|column| above(row, column)));
        }
        triangle
    }

    /// An element of the symmetric matrix.
    pub(super) fn element(&self, row: usize, column: usize) -> f64 {
        self.row(row.min(column))[row.abs_diff(column)]
    }

    /// The triangle of these elements, of which there are [`element_count`](Self::element_count).
    pub(super) fn new(size: usize, elements: Vec<f64>) -> Self {
        debug_assert_eq!(elements.len(), Self::element_count(size));
        Self { size, elements }
    }

    pub(super) fn elements(&self) -> &[f64] {
        &self.elements
    }

    pub(super) fn diagonal_elements(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.size).map(|row| self.row(row)[0])
    }

    #[inline(always)]
    fn range(&self, row: usize) -> Range<usize> {
        self.range_from(row, row)
    }

    /// A row from this column on, which is not before its diagonal.
    #[inline(always)]
    fn range_from(&self, row: usize, column: usize) -> Range<usize> {
        let start = row * self.size - row * row.saturating_sub(1) / 2;
        start + column - row..start + self.size - row
    }

    #[inline(always)]
    fn row(&self, row: usize) -> &[f64] {
        &self.elements[self.range(row)]
    }

    #[inline(always)]
    fn row_mut(&mut self, row: usize) -> &mut [f64] {
        let range = self.range(row);
        &mut self.elements[range]
    }

    /// For a symmetric matrix M: M ← factor · M + Σ weightᵢ · vectorᵢ vectorᵢᵀ.
    pub(super) fn add_squares(&mut self, factor: f64, vectors: &[(f64, &[f64])]) {
        Arch::new().dispatch(Operation::AddSquares { matrix: self, factor, vectors });
    }

    #[inline(always)]
    fn add_squares_with<S: Simd>(&mut self, simd: S, factor: f64, vectors: &[(f64, &[f64])]) {
        for element in &mut self.elements {
            *element *= factor;
        }
        let (blocks, rest) = vectors.as_chunks::<BLOCK>();
        for &[a, b, c, d] in blocks {
            for index in 0..self.size {
                let weights = [a.0 * a.1[index], b.0 * b.1[index], c.0 * c.1[index], d.0 * d.1[index]];
                let vectors = [&a.1[index..], &b.1[index..], &c.1[index..], &d.1[index..]];
                add_block(simd, self.row_mut(index), weights, vectors);
            }
        }
        for (weight, vector) in rest {
            for index in 0..self.size {
                add(self.row_mut(index), weight * vector[index], &vector[index..]);
            }
        }
    }

    /// For a symmetric matrix M: writes the triangle U with M = UᵀU (Cholesky). A pivot that is not above `least_pivot`
    /// is raised to it, so that U can always be inverted.
    pub(super) fn factorize(&self, least_pivot: f64, factor: &mut Self) {
        Arch::new().dispatch(Operation::Factorize { matrix: self, least_pivot, factor });
    }

    #[inline(always)]
    fn factorize_with<S: Simd>(&self, simd: S, least_pivot: f64, factor: &mut Self) {
        factor.elements.copy_from_slice(&self.elements);
        for first in (0..self.size).step_by(BLOCK) {
            let behind = self.size.min(first + BLOCK);
            for index in first..behind {
                let (above, row) = factor.elements.split_at_mut(self.range(index).start);
                let row = &mut row[..self.size - index];
                for other in first..index {
                    let part = &above[self.range_from(other, index)];
                    add(row, -part[0], part);
                }
                // `max` with the pivot second: NaN becomes the least pivot as well.
                let scale = 1.0 / least_pivot.max(row[0]).sqrt();
                row[0] = 1.0 / scale;
                for element in &mut row[1..] {
                    *element *= scale;
                }
            }
            for index in behind..self.size {
                let (above, row) = factor.elements.split_at_mut(self.range(index).start);
                let part = |other| &above[self.range_from(other, index)];
                let parts = [part(first), part(first + 1), part(first + 2), part(first + 3)];
                let [a, b, c, d] = parts;
                add_block(simd, &mut row[..self.size - index], [-a[0], -b[0], -c[0], -d[0]], parts);
            }
        }
    }

    /// For a triangle U: each vector v becomes Uᵀv.
    pub(super) fn multiply_transposed(&self, vectors: &mut [Vec<f64>]) {
        Arch::new().dispatch(Operation::MultiplyTransposed { triangle: self, vectors });
    }

    #[inline(always)]
    fn multiply_transposed_with<S: Simd>(&self, simd: S, vectors: &mut [Vec<f64>]) {
        // From the last row up, since an element needs those before it as they were.
        let whole = self.size - self.size % BLOCK;
        for row in (whole..self.size).rev() {
            for vector in &mut *vectors {
                multiply_in_place(self.row(row), &mut vector[row..]);
            }
        }
        for first in (0..whole).step_by(BLOCK).rev() {
            let (tops, tails) = self.block(first);
            for vector in &mut *vectors {
                let (head, tail) = vector.split_at_mut(first + BLOCK);
                let head = &mut head[first..];
                add_block(simd, tail, [head[0], head[1], head[2], head[3]], tails);
                for row in (0..BLOCK).rev() {
                    multiply_in_place(&tops[row][..BLOCK - row], &mut head[row..]);
                }
            }
        }
    }

    /// For a triangle U with a diagonal above 0: each vector v becomes U⁻ᵀv.
    pub(super) fn solve_transposed(&self, vectors: &mut [Vec<f64>]) {
        Arch::new().dispatch(Operation::SolveTransposed { triangle: self, vectors });
    }

    #[inline(always)]
    fn solve_transposed_with<S: Simd>(&self, simd: S, vectors: &mut [Vec<f64>]) {
        let whole = self.size - self.size % BLOCK;
        for first in (0..whole).step_by(BLOCK) {
            let (tops, tails) = self.block(first);
            for vector in &mut *vectors {
                let (head, tail) = vector.split_at_mut(first + BLOCK);
                let head = &mut head[first..];
                for row in 0..BLOCK {
                    solve_in_place(&tops[row][..BLOCK - row], &mut head[row..]);
                }
                add_block(simd, tail, [-head[0], -head[1], -head[2], -head[3]], tails);
            }
        }
        for row in whole..self.size {
            for vector in &mut *vectors {
                solve_in_place(self.row(row), &mut vector[row..]);
            }
        }
    }

    /// A block of rows: of each what stands up to the last one's diagonal, and what stands behind it.
    #[inline(always)]
    fn block(&self, first: usize) -> ([&[f64]; BLOCK], [&[f64]; BLOCK]) {
        let (mut tops, mut tails) = ([[].as_slice(); BLOCK], [[].as_slice(); BLOCK]);
        for row in 0..BLOCK {
            (tops[row], tails[row]) = self.row(first + row).split_at(BLOCK - row);
        }
        (tops, tails)
    }
}

/// What is compiled for each width of vectors. What it calls must be `#[inline(always)]` to be compiled so, too.
enum Operation<'a> {
    AddSquares { matrix: &'a mut Triangle, factor: f64, vectors: &'a [(f64, &'a [f64])] },
    Factorize { matrix: &'a Triangle, least_pivot: f64, factor: &'a mut Triangle },
    MultiplyTransposed { triangle: &'a Triangle, vectors: &'a mut [Vec<f64>] },
    SolveTransposed { triangle: &'a Triangle, vectors: &'a mut [Vec<f64>] },
}

impl WithSimd for Operation<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        match self {
            Self::AddSquares { matrix, factor, vectors } => matrix.add_squares_with(simd, factor, vectors),
            Self::Factorize { matrix, least_pivot, factor } => matrix.factorize_with(simd, least_pivot, factor),
            Self::MultiplyTransposed { triangle, vectors } => triangle.multiply_transposed_with(simd, vectors),
            Self::SolveTransposed { triangle, vectors } => triangle.solve_transposed_with(simd, vectors),
        }
    }
}

/// The first element of `vector` times a row, added to what follows it and put in its own place.
#[inline(always)]
fn multiply_in_place(row: &[f64], vector: &mut [f64]) {
    let value = vector[0];
    add(&mut vector[1..], value, &row[1..]);
    vector[0] = value * row[0];
}

/// The first element of the solution, put in its place and taken out of what follows.
#[inline(always)]
fn solve_in_place(row: &[f64], vector: &mut [f64]) {
    vector[0] /= row[0];
    let value = vector[0];
    add(&mut vector[1..], -value, &row[1..]);
}

#[inline(always)]
fn add(target: &mut [f64], weight: f64, row: &[f64]) {
    for (target, element) in target.iter_mut().zip(row) {
        *target += weight * element;
    }
}

/// Adds multiples of rows, the first one first.
#[inline(always)]
fn add_block<S: Simd>(simd: S, target: &mut [f64], weights: [f64; BLOCK], rows: [&[f64]; BLOCK]) {
    let [a, b, c, d] = rows.map(|row| S::as_simd_f64s(&row[..target.len()]));
    let weights = weights.map(|weight| simd.splat_f64s(weight));
    let sum = |target, rows: [S::f64s; BLOCK]| {
        let mut sum = target;
        for term in 0..BLOCK {
            sum = simd.add_f64s(sum, simd.mul_f64s(weights[term], rows[term]));
        }
        sum
    };
    let (targets, rest) = S::as_mut_simd_f64s(target);
    for ((((target, &a), &b), &c), &d) in targets.iter_mut().zip(a.0).zip(b.0).zip(c.0).zip(d.0) {
        *target = sum(*target, [a, b, c, d]);
    }
    if !rest.is_empty() {
        let load = |rest: &[f64]| simd.partial_load_f64s(rest);
        let sums = sum(load(rest), [load(a.1), load(b.1), load(c.1), load(d.1)]);
        simd.partial_store_f64s(rest, sums);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use pulp::Scalar;

    fn multiplied(triangle: &Triangle, vector: &[f64]) -> Vec<f64> {
        let element = |row: usize, column: usize| triangle.row(row)[column - row];
        (0..vector.len()).map(|column| (0..=column).map(|row| element(row, column) * vector[row]).sum()).collect()
    }

    fn vectors() -> impl Strategy<Value = Vec<Vec<f64>>> {
        vectors_of(1..14)
    }

    fn vectors_of(sizes: Range<usize>) -> impl Strategy<Value = Vec<Vec<f64>>> {
        sizes.prop_flat_map(|size| proptest::collection::vec(proptest::collection::vec(-2.0..2.0f64, size), 1..12))
    }

    fn close(found: &[f64], expected: &[f64]) -> bool {
        found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9 * (1.0 + expected.abs()))
    }

    proptest! {
        #[test]
        fn squares_are_added_and_taken_apart_again(vectors in vectors()) {
            let size = vectors[0].len();
            let mut matrix = Triangle::diagonal(size, 2.0);
            let weighted: Vec<_> = vectors.iter().map(|vector| (0.5, vector.as_slice())).collect();
            matrix.add_squares(0.5, &weighted);
            for row in 0..size {
                for column in row..size {
                    let sum: f64 = vectors.iter().map(|vector| 0.5 * vector[row] * vector[column]).sum();
                    let expected = sum + if row == column { 1.0 } else { 0.0 };
                    prop_assert!((matrix.row(row)[column - row] - expected).abs() < 1e-12);
                }
            }
            let mut factor = Triangle::diagonal(size, 0.0);
            matrix.factorize(1e-300, &mut factor);
            // Row by row, UᵀU is M.
            for row in 0..size {
                let column: Vec<f64> = (0..=row).map(|above| factor.row(above)[row - above]).collect();
                let column = [column, vec![0.0; size - row - 1]].concat();
                prop_assert!(close(&multiplied(&factor, &column)[row..], matrix.row(row)));
            }
        }

        #[test]
        fn multiplying_and_solving_undo_each_other(vectors in vectors()) {
            let size = vectors[0].len();
            let mut matrix = Triangle::diagonal(size, 1.0);
            matrix.add_squares(1.0, &[(1.0, &vectors[0])]);
            let mut factor = matrix.clone();
            matrix.factorize(1e-300, &mut factor);
            let mut products = vectors.clone();
            factor.multiply_transposed(&mut products);
            for (product, vector) in products.iter().zip(&vectors) {
                prop_assert!(close(product, &multiplied(&factor, vector)));
            }
            factor.solve_transposed(&mut products);
            products.iter().zip(&vectors).for_each(|(found, vector)| assert!(close(found, vector)));
        }
    }

    proptest! {
        #[test]
        fn the_bits_are_those_of_a_processor_without_vectors(vectors in vectors_of(1..40)) {
            let size = vectors[0].len();
            let weighted: Vec<_> = vectors.iter().map(|vector| (0.5, vector.as_slice())).collect();
            let (mut wide, mut narrow) = (Triangle::diagonal(size, 2.0), Triangle::diagonal(size, 2.0));
            wide.add_squares(0.5, &weighted);
            narrow.add_squares_with(Scalar, 0.5, &weighted);
            prop_assert_eq!(&wide, &narrow);
            let (mut wide_factor, mut narrow_factor) = (wide.clone(), wide.clone());
            wide.factorize(1e-300, &mut wide_factor);
            narrow.factorize_with(Scalar, 1e-300, &mut narrow_factor);
            prop_assert_eq!(&wide_factor, &narrow_factor);
            let (mut wide, mut narrow) = (vectors.clone(), vectors);
            wide_factor.multiply_transposed(&mut wide);
            narrow_factor.multiply_transposed_with(Scalar, &mut narrow);
            prop_assert_eq!(&wide, &narrow);
            wide_factor.solve_transposed(&mut wide);
            narrow_factor.solve_transposed_with(Scalar, &mut narrow);
            prop_assert_eq!(&wide, &narrow);
        }
    }

    #[test]
    fn a_singular_matrix_gets_the_least_pivot() {
        let matrix = Triangle::new(2, vec![1.0, 1.0, 1.0]);
        let mut factor = Triangle::diagonal(2, 0.0);
        matrix.factorize(1e-16, &mut factor);
        assert_eq!(factor.elements(), [1.0, 1.0, 1e-8]);
    }
}
