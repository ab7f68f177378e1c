//! Rooted trees and the weights of a Runge-Kutta method on them (Hairer, Norsett & Wanner, *Solving ODEs I*, II.2).
//!
//! A method has order `p` if for every rooted tree of at most `p` vertices its elementary weight is `1 / density`.

/// A rooted tree: the indices of the trees that hang from its root, in the list it belongs to.
pub struct Tree {
    pub children: Vec<usize>,
    /// The number of vertices.
    pub order: usize,
    /// The product over all vertices of the size of the tree above each.
    pub density: f64,
}

/// All trees with at most `order` vertices, children before parents.
pub fn trees(order: usize) -> Vec<Tree> {
    let mut trees = vec![Tree { children: Vec::new(), order: 1, density: 1.0 }];
    for size in 2..=order {
        let mut forests = Vec::new();
        grow(&trees, size - 1, 0, &mut Vec::new(), &mut forests);
        for children in forests {
            let density = size as f64 * children.iter().map(|&child| trees[child].density).product::<f64>();
            trees.push(Tree { children, order: size, density });
        }
    }
    trees
}

/// Collects the multisets of trees from index `least` on with `vertices` vertices together.
fn grow(trees: &[Tree], vertices: usize, least: usize, forest: &mut Vec<usize>, forests: &mut Vec<Vec<usize>>) {
    if vertices == 0 {
        forests.push(forest.clone());
    }
    for index in least..trees.len() {
        if trees[index].order <= vertices {
            forest.push(index);
            grow(trees, vertices - trees[index].order, index, forest, forests);
            forest.pop();
        }
    }
}

/// `weights[tree][i]`: the elementary weight of stage `i`, the product over the children of `sum_j a_ij (child's j)`.
pub fn stage_weights(trees: &[Tree], coefficients: &[Vec<f64>]) -> Vec<Vec<f64>> {
    let mut weights: Vec<Vec<f64>> = Vec::new();
    for tree in trees {
        let of_stage = |row: &Vec<f64>| {
            let sums = tree.children.iter().map(|&child| dot(row, &weights[child]));
            sums.product::<f64>()
        };
        weights.push(coefficients.iter().map(of_stage).collect());
    }
    weights
}

/// The sum of the products, over the shorter length.
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn numbers_of_trees() {
    // the sequence A000081 of the Encyclopedia of Integer Sequences
    let all = trees(9);
    let counts: Vec<usize> = (1..=9).map(|order| all.iter().filter(|tree| tree.order == order).count()).collect();
    assert_eq!(counts, [1, 1, 2, 4, 9, 20, 48, 115, 286]);
}
