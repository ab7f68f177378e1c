//! The ledger's tables and the expressions over them: two lines with a condition and an expression, then a table.

use claims::expression::{Binding, Condition, Expression};
use claims::requirement::Requirement;
use claims::sheet::{LedgerTable, Stated};

/// Tries one.
pub fn read(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let mut lines = text.splitn(3, '\n');
    let (condition, expression) = (lines.next().unwrap_or(""), lines.next().unwrap_or(""));
    let requirement = Requirement::parse(expression);
    let table = lines.next().unwrap_or("").as_bytes();
    let Ok(cells) = files::table::MixedTable::parse(table) else { return };
    let sheet = LedgerTable::new(cells, &|name| name.starts_with('e').then_some(Stated::OfRange(1e-9)));
    let binding = Binding { sheet: &sheet, errors: None };
    let condition = Condition::parse(condition).and_then(|condition| condition.bind(&binding));
    let expression = Expression::parse(expression).and_then(|expression| expression.bind(&binding));
    for row in 0..sheet.rows() {
        if let Ok(condition) = &condition {
            let _ = condition.holds(&sheet, row);
        }
        if let Ok(Ok(Some(value))) = expression.as_ref().map(|expression| expression.value(&sheet, row)) {
            // not below itself, however uncertain
            assert!(value.error.is_nan() || value.error >= 0.0, "{value:?}");
            if let Ok(requirement) = requirement {
                let _ = requirement.judge(value);
            }
        }
    }
    let names: Vec<String> = sheet.names().iter().take(1).cloned().collect();
    if let Ok(both) = sheet.beside(&sheet, &names) {
        assert!(both.rows() <= sheet.rows() && both.names().len() + names.len() == 2 * sheet.names().len());
    }
    if let Some(name) = sheet.names().last()
        && let Ok(next) = sheet.next(name, &names)
    {
        assert!(next.rows() < sheet.rows() || sheet.rows() == 0);
    }
}
