//! A table that is written and read back has the same bits.

use files::table::{CellValue, MixedTable, Table, TableError};

/// The generator splitmix64 (Steele, Lea, Flood 2014).
fn splitmix(state: &mut u64) -> u64 {
    *state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
    let z = (*state ^ (*state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

fn bits(table: &Table) -> Vec<u64> {
    table.rows().flatten().map(|number| number.to_bits()).collect()
}

fn assert_round_trip(numbers: &[f64]) {
    let mut table = Table::new(&["a", "b"]);
    numbers.chunks_exact(2).for_each(|row| table.push(row));
    let again = Table::parse(&table.to_csv()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(bits(&again), bits(&table));
    assert_eq!(again.columns, table.columns);
    assert_eq!(again.to_csv(), table.to_csv());
}

#[test]
fn random_bits_come_back() {
    let mut state = 1;
    let numbers: Vec<f64> = std::iter::repeat_with(|| f64::from_bits(splitmix(&mut state)))
        .filter(|number| number.is_finite())
        .take(200_000)
        .collect();
    assert_round_trip(&numbers);
}

#[test]
fn the_ends_of_every_range_come_back() {
    let two_53 = 9_007_199_254_740_992.0;
    let edges = [
        0.0,
        -0.0,
        f64::from_bits(1),
        f64::MIN_POSITIVE.next_down(),
        f64::MIN_POSITIVE,
        f64::MAX,
        f64::MIN,
        f64::EPSILON,
        two_53 - 1.0,
        two_53,
        two_53 + 2.0,
        -two_53,
        1e15,
        1e16,
        1e17,
        1e22,
        0.1,
        1.0 / 3.0,
    ];
    let mut numbers: Vec<f64> = edges.iter().flat_map(|&edge| [edge, -edge]).collect();
    // whole numbers, halves and quarters about powers of 2
    for power in 0..60 {
        let middle = (1_u64 << power) as f64;
        numbers.extend([middle - 0.25, middle, middle + 0.5, -middle]);
    }
    assert_round_trip(&numbers);
}

#[test]
fn numbers_are_written_in_their_shortest_form() {
    let mut table = Table::new(&["t", "v"]);
    table.push(&[1.0, 0.1]);
    table.push(&[-0.0, 1e-300]);
    table.push(&[-3000.0, 2.5]);
    table.push(&[0.0, 1e300]);
    table.push(&[9_007_199_254_740_991.0, 9_007_199_254_740_992.0]);
    let csv = String::from_utf8(table.to_csv()).expect("text");
    assert_eq!(csv, "t,v\n1,0.1\n-0.0,1e-300\n-3000,2.5\n0,1e300\n9007199254740991,9007199254740992.0\n");
}

#[test]
fn tables_know_their_columns_and_rows() {
    let mut table = Table::new(&["t", "n", "x"]);
    assert!(table.is_empty());
    assert_eq!(table.to_csv(), b"t,n,x\n");
    assert_eq!(Table::parse(b"t,n,x\n").expect("a header"), table);
    table.push(&[0.0, 1.0, 2.0]);
    table.push(&[3.0, 4.0, 5.0]);
    assert_eq!((table.len(), table.is_empty()), (2, false));
    assert_eq!(table.column("n").expect("n"), [1.0, 4.0]);
    assert_eq!(table.column("v").expect_err("no v").to_string(), "no column v; the table has t, n, x");
    assert_eq!(table.rows().nth(1), Some(&[3.0, 4.0, 5.0][..]));
}

#[test]
#[should_panic(expected = "a row of [\"t\", \"n\"]")]
fn a_row_of_another_length_is_an_error_of_the_program() {
    Table::new(&["t", "n"]).push(&[1.0]);
}

#[test]
fn malformed_lines_are_named() {
    let cases: [(&[u8], u64, &str); 8] = [
        (b"t,v\n1,2\n3,x\n", 3, "\"x\" is not a finite number"),
        (b"t,v\n1,\n", 2, "\"\" is not a finite number"),
        (b"t,v\nnan,2\n", 2, "\"nan\" is not a finite number"),
        (b"t,v\n1,2\n1,inf\n", 3, "\"inf\" is not a finite number"),
        (b"t,v\n1,-1e999\n", 2, "\"-1e999\" is not a finite number"),
        (b"t,v\n1, 2\n", 2, "\" 2\" is not a finite number"),
        (b"t,v\n1,\xff\n", 2, "0xff is not UTF-8"),
        (b"t,v\n1,2\n3,4,5\n", 3, "expected 2 cells, found 3"),
    ];
    for (text, line, words) in cases {
        let error = Table::parse(text).expect_err("malformed");
        let TableError::Malformed { line: found, .. } = &error else { panic!("{error}") };
        assert_eq!(*found, line, "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
    let headers: [(&[u8], &str); 6] = [
        (b"", "there is no header"),
        (b"t,\"v\n1\"\n", "\"v\\n1\" is not a name of a column; valid: small letters, digits and _"),
        (b"t,\xff\n", "0xff is not UTF-8"),
        (b"t,,v\n", "\"\" is not a name"),
        (b"t,V\n", "\"V\" is not a name"),
        (b"t,v,t\n1,2,3\n", "the column t appears twice"),
    ];
    for (text, words) in headers {
        let error = Table::parse(text).expect_err("malformed");
        assert!(matches!(error, TableError::Malformed { line: 1, .. }), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
    assert!(matches!(Table::parse(b"t,v\n1,2\n3\n"), Err(TableError::Malformed { line: 3, .. })));
}

#[test]
fn a_missing_file_is_named() {
    let error = Table::read(std::path::Path::new("no/such/table.csv")).expect_err("there is none");
    assert!(error.to_string().starts_with("no/such/table.csv: "), "{error}");
}

#[test]
fn what_other_programs_write_is_named() {
    let cases: [(&[u8], u64, &str); 10] = [
        (b"t;v\n1;2\n", 1, "semicolons"),
        (b"t\tv\n1\t2\n", 1, "tabs"),
        (b"t|v\n1|2\n", 1, "pipes (|)"),
        (b"\"\",\"t\",\"v\"\n\"1\",0,1\n", 1, "row names of R"),
        (b"t,v\n\"1\",0,1\n", 2, "row names of R"),
        (b"t,v\n1,2\n\"3,5\",4\n", 3, "decimal comma; write 3.5"),
        (b"t,v\n1,5,2,5\n", 2, "decimal commas"),
        ("t,v\n1,2\n3,\u{2212}4.5\n".as_bytes(), 3, "typographic minus sign; write -4.5"),
        (b"\xff\xfet\0,\0", 0, "UTF-16"),
        (b"t,v\n1,2\n3,4\0\n", 3, "UTF-16"),
    ];
    for (bytes, line, words) in cases {
        let error = Table::parse(bytes).expect_err("malformed");
        let TableError::Malformed { line: found, problem, .. } = &error else { panic!("{error}") };
        assert_eq!(*found, line, "{error}");
        assert!(problem.contains(words), "{error}");
    }
    let marked = Table::parse("\u{feff}t,v\n1,2\n".as_bytes()).expect("a mark is no part of the first name");
    assert_eq!(marked.columns, ["t", "v"]);
}

#[test]
fn a_malformed_file_is_named_with_its_line() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("std.csv");
    std::fs::write(&file, "t,v\n0,1\n1,NaN\n").expect("a file");
    let error = Table::read(&file).expect_err("NaN").to_string();
    assert!(error.starts_with(&format!("{}:3: ", file.display())) && error.contains("\"NaN\""), "{error}");
}

#[test]
fn sheets_keep_numbers_words_and_nothing_apart() {
    let mut sheet = MixedTable::new(&["method", "error", "note"]);
    sheet.push(&["heun".into(), 0.1.into(), CellValue::Empty]);
    sheet.push(&["a, b".into(), CellValue::Empty, "say \"x\"".into()]);
    let csv = sheet.to_csv();
    assert_eq!(csv, b"method,error,note\nheun,0.1,\n\"a, b\",,\"say \"\"x\"\"\"\n");
    assert_eq!(MixedTable::parse(&csv).expect("a sheet"), sheet);
    let cells = MixedTable::parse(b"a,b,c\nnan,inf,1e999\n").expect("words");
    assert!(cells.rows().flatten().all(|cell| matches!(cell, CellValue::Word(_))), "{cells:?}");
    let chosen = sheet.select(&[("method", "heun")], &["error"]).expect("columns");
    assert_eq!(chosen.column("error").expect("a column"), [0.1]);
    assert_eq!(sheet.select(&[], &["error"]).expect("columns").len(), 1);
    assert!(sheet.select(&[("nothing", "x")], &[]).is_err());
}
