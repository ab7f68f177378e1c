//! Which rows of two tables belong together.

use files::pairs::pairs;
use files::table::{MixedTable, Table};

/// The rows of the first table that have a partner, with the last cell of each, and the number of rows without one.
fn sheets(one: &str, other: &str) -> (Vec<(usize, String)>, usize) {
    let [one, other] = [one, other].map(|text| MixedTable::parse(text.as_bytes()).expect("a table"));
    let (rows, unmatched) = pairs(&one, &other);
    let last = |row: &[files::table::CellValue]| row.last().map(ToString::to_string).unwrap_or_default();
    (rows.into_iter().map(|(row, _, partner)| (row, last(partner))).collect(), unmatched)
}

#[test]
fn a_missing_row_moves_no_other_even_where_a_key_is_in_no_order() {
    let (one, other) = ("law,n,v\na,67,1\nb,12,2\na,40,3\n", "law,n,v\nb,12,2\na,40,3.5\n");
    assert_eq!(sheets(one, other), (vec![(1, "2".to_owned()), (2, "3.5".to_owned())], 1));
}

#[test]
fn another_word_is_a_difference_in_a_row() {
    let (rows, unmatched) = sheets("law,v\na,1\nb,2\n", "law,v\na,1\nc,2\n");
    assert_eq!((rows.len(), unmatched), (2, 0));
}

#[test]
fn rows_of_one_name_belong_together_in_their_order() {
    let (rows, unmatched) = sheets("t,v\n1,10\n1,11\n2,12\n", "t,v\n1,20\n2,22\n1,21\n1,23\n");
    assert_eq!(rows, [(0, "20".to_owned()), (1, "21".to_owned()), (2, "22".to_owned())]);
    assert_eq!(unmatched, 1);
}

#[test]
fn tables_without_names_are_compared_row_by_row() {
    let [one, other] =
        ["a,phi\n0,1\n1,2\n", "a,phi\n0,1\n"].map(|text| Table::parse(text.as_bytes()).expect("a table"));
    let (rows, unmatched) = pairs(&one, &other);
    assert_eq!((rows.len(), unmatched), (1, 1));
    let minus = Table::parse(b"t,v\n-0.0,1\n").expect("a table");
    assert_eq!(pairs(&minus, &Table::parse(b"t,v\n0,1\n").expect("a table")).1, 0);
}
