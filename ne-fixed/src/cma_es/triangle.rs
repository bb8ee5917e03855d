use std::ops::Range;

/// The upper triangle of a square matrix, row by row, each row from its diagonal on.
///
/// Everything here adds multiples of rows to rows: element by element, in a fixed order, so that the bits do not depend
/// on how wide the processor's vectors are. That is why this is no linear-algebra library: fast ones choose other sums,
/// or fused ones, on other processors. Rows are taken several at a time only to touch memory less often.
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

    fn range(&self, row: usize) -> Range<usize> {
        let start = row * self.size - row * row.saturating_sub(1) / 2;
        start..start + self.size - row
    }

    fn row(&self, row: usize) -> &[f64] {
        &self.elements[self.range(row)]
    }

    fn row_mut(&mut self, row: usize) -> &mut [f64] {
        let range = self.range(row);
        &mut self.elements[range]
    }

    /// For a symmetric matrix M: M ← factor · M + Σ weightᵢ · vectorᵢ vectorᵢᵀ.
    pub(super) fn add_squares(&mut self, factor: f64, vectors: &[(f64, &[f64])]) {
        for index in 0..self.size {
            let row = self.row_mut(index);
            row.iter_mut().for_each(|element| *element *= factor);
            let (blocks, rest) = vectors.as_chunks::<BLOCK>();
            for block in blocks {
                let terms = block.map(|(weight, vector)| (weight * vector[index], &vector[index..]));
                add_block(row, terms);
            }
            for (weight, vector) in rest {
                add(row, weight * vector[index], &vector[index..]);
            }
        }
    }

    /// For a symmetric matrix M: writes the triangle U with M = UᵀU (Cholesky). A pivot that is not above `least_pivot`
    /// is raised to it, so that U can always be inverted.
    pub(super) fn factorize(&self, least_pivot: f64, factor: &mut Self) {
        factor.elements.copy_from_slice(&self.elements);
        for index in 0..self.size {
            let start = factor.range(index).start;
            let (above, row) = factor.elements.split_at_mut(start);
            let row = &mut row[..self.size - index];
            let part = |other: usize| {
                let range = self.range(other);
                let part = &above[range.start + index - other..range.end];
                (-part[0], part)
            };
            let whole = index - index % BLOCK;
            for first in (0..whole).step_by(BLOCK) {
                add_block(row, std::array::from_fn(|other| part(first + other)));
            }
            for other in whole..index {
                let (weight, part) = part(other);
                add(row, weight, part);
            }
            // `max` with the pivot second: NaN becomes the least pivot as well.
            let scale = 1.0 / least_pivot.max(row[0]).sqrt();
            row[0] = 1.0 / scale;
            row[1..].iter_mut().for_each(|element| *element *= scale);
        }
    }

    /// For a triangle U: each vector v becomes Uᵀv.
    pub(super) fn multiply_transposed(&self, vectors: &mut [Vec<f64>]) {
        // From the last row up, since an element needs those before it as they were.
        let whole = self.size - self.size % BLOCK;
        for row in (whole..self.size).rev() {
            vectors.iter_mut().for_each(|vector| self.multiply_row(row, vector));
        }
        for first in (0..whole).step_by(BLOCK).rev() {
            let tails = self.tails(first);
            for vector in &mut *vectors {
                let (head, tail) = vector.split_at_mut(first + BLOCK);
                let head = &mut head[first..];
                add_block(tail, std::array::from_fn(|row| (head[row], tails[row])));
                (0..BLOCK)
                    .rev()
                    .for_each(|row| multiply_in_place(&self.row(first + row)[..BLOCK - row], &mut head[row..]));
            }
        }
    }

    fn multiply_row(&self, row: usize, vector: &mut [f64]) {
        multiply_in_place(self.row(row), &mut vector[row..]);
    }

    /// For a triangle U with a diagonal above 0: each vector v becomes U⁻ᵀv.
    pub(super) fn solve_transposed(&self, vectors: &mut [Vec<f64>]) {
        let whole = self.size - self.size % BLOCK;
        for first in (0..whole).step_by(BLOCK) {
            let tails = self.tails(first);
            for vector in &mut *vectors {
                let (head, tail) = vector.split_at_mut(first + BLOCK);
                let head = &mut head[first..];
                (0..BLOCK).for_each(|row| solve_in_place(&self.row(first + row)[..BLOCK - row], &mut head[row..]));
                add_block(tail, std::array::from_fn(|row| (-head[row], tails[row])));
            }
        }
        for row in whole..self.size {
            vectors.iter_mut().for_each(|vector| solve_in_place(self.row(row), &mut vector[row..]));
        }
    }

    /// Of a block of rows the parts behind the last one's diagonal.
    fn tails(&self, first: usize) -> [&[f64]; BLOCK] {
        std::array::from_fn(|row| &self.row(first + row)[BLOCK - row..])
    }
}

/// The first element of `vector` times a row, added to what follows it and put in its own place.
fn multiply_in_place(row: &[f64], vector: &mut [f64]) {
    let value = vector[0];
    add(&mut vector[1..], value, &row[1..]);
    vector[0] = value * row[0];
}

/// The first element of the solution, put in its place and taken out of what follows.
fn solve_in_place(row: &[f64], vector: &mut [f64]) {
    vector[0] /= row[0];
    let value = vector[0];
    add(&mut vector[1..], -value, &row[1..]);
}

fn add(target: &mut [f64], weight: f64, row: &[f64]) {
    target.iter_mut().zip(row).for_each(|(target, element)| *target += weight * element);
}

fn add_block(target: &mut [f64], terms: [(f64, &[f64]); BLOCK]) {
    let count = target.len();
    let terms = terms.map(|(weight, row)| (weight, &row[..count]));
    for (index, target) in target.iter_mut().enumerate() {
        *target = terms.iter().fold(*target, |sum, (weight, row)| sum + weight * row[index]);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn multiplied(triangle: &Triangle, vector: &[f64]) -> Vec<f64> {
        let element = |row: usize, column: usize| triangle.row(row)[column - row];
        (0..vector.len()).map(|column| (0..=column).map(|row| element(row, column) * vector[row]).sum()).collect()
    }

    fn vectors() -> impl Strategy<Value = Vec<Vec<f64>>> {
        (1..14usize)
            .prop_flat_map(|size| proptest::collection::vec(proptest::collection::vec(-2.0..2.0f64, size), 1..12))
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

    #[test]
    fn a_singular_matrix_gets_the_least_pivot() {
        let matrix = Triangle::new(2, vec![1.0, 1.0, 1.0]);
        let mut factor = Triangle::diagonal(2, 0.0);
        matrix.factorize(1e-16, &mut factor);
        assert_eq!(factor.elements(), [1.0, 1.0, 1e-8]);
    }
}
