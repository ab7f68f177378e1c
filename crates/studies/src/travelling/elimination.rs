//! Solves a dense system of linear equations.

/// Solves `matrix x = right`, row by row, by elimination with partial pivoting; `None` if the matrix is singular.
pub(super) fn solve(mut matrix: Vec<f64>, mut right: Vec<f64>) -> Option<Vec<f64>> {
    let size = right.len();
    for column in 0..size {
        let entry = |row: usize| matrix[row * size + column].abs();
        let pivot = (column..size).fold(column, |best, row| if entry(row) > entry(best) { row } else { best });
        if matrix[pivot * size + column] == 0.0 {
            return None;
        }
        if pivot != column {
            (column..size).for_each(|i| matrix.swap(pivot * size + i, column * size + i));
            right.swap(pivot, column);
        }
        let (above, below) = matrix.split_at_mut((column + 1) * size);
        let above = &above[column * size..];
        for (offset, row) in below.chunks_exact_mut(size).enumerate() {
            let factor = row[column] / above[column];
            if factor != 0.0 {
                row[column..].iter_mut().zip(&above[column..]).for_each(|(entry, pivot)| *entry -= factor * pivot);
                right[column + 1 + offset] -= factor * right[column];
            }
        }
    }
    for row in (0..size).rev() {
        let known: f64 = (row + 1..size).map(|column| matrix[row * size + column] * right[column]).sum();
        right[row] = (right[row] - known) / matrix[row * size + row];
    }
    right.iter().all(|x| x.is_finite()).then_some(right)
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn a_system_that_needs_its_rows_exchanged_is_solved_and_a_singular_one_is_not() {
        let matrix = vec![0.0, 2.0, 1.0, 1.0, 1.0, 0.0, 3.0, 0.0, -1.0];
        let x = solve(matrix, vec![7.0, 3.0, 0.0]).expect("a solution");
        for (found, expected) in x.iter().zip([1.0, 2.0, 3.0]) {
            assert!((found - expected).abs() < 1e-14, "{x:?}");
        }
        assert_eq!(solve(vec![1.0, 2.0, 2.0, 4.0], vec![1.0, 2.0]), None);
    }
}
