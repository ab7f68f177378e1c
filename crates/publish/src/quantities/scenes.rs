//! Parameters: every number in every scene, and what follows from them by arithmetic.

use super::{Quantities, Source};
use checkout::figure::Figure;
use checkout::paths::Paths;
use files::reader::{Section, Value};
use std::collections::BTreeMap;

/// Adds the numbers of all scenes: `fig04.ring.length` where all panels share it, else `fig04.stable.law.mu`.
pub fn collect(source: &Source<'_>, all: &mut Quantities) {
    for figure in source.figures {
        let from = Paths::scene(&figure.slug);
        let panels = panels(figure);
        for (panel, numbers) in &panels {
            for (key, &value) in numbers {
                let is_shared = panels.values().all(|other| other.get(key) == Some(&value));
                let name =
                    if is_shared { format!("{}.{key}", figure.id) } else { format!("{}.{panel}.{key}", figure.id) };
                // the wave number's axis ends at pi: sixteen digits of it say less than three
                match value == std::f64::consts::PI {
                    true => all.rounded(&name, value, 3, &format!("{from}: {key}")),
                    false => all.exact(&name, value, &format!("{from}: {key}")),
                }
            }
        }
        arithmetic(figure, &panels, all);
    }
}

/// Headway and room of each ring, and the critical strength of the algebraic force for its room.
fn arithmetic(figure: &Figure, panels: &BTreeMap<String, BTreeMap<String, f64>>, all: &mut Quantities) {
    let Some(numbers) = panels.values().next() else { return };
    let (Some(length), Some(pedestrians)) = (numbers.get("ring.length"), numbers.get("ring.pedestrians")) else {
        return;
    };
    let from = format!("{}: arithmetic", Paths::scene(&figure.slug));
    let (headway, room) = (length / pedestrians, length / pedestrians - 2.0);
    all.rounded(&format!("{}.headway", figure.id), headway, 5, &from);
    all.rounded(&format!("{}.room", figure.id), room, 3, &from);
    if numbers.get("law.q") == Some(&2.0) {
        // mu_cr = sqrt(d'^3 / 4), from 2 phi = 1 with phi = q mu^2 / d'^(q+1)
        all.rounded(&format!("{}.critical", figure.id), (room * room * room / 4.0).sqrt(), 3, &from);
    }
}

fn panels(figure: &Figure) -> BTreeMap<String, BTreeMap<String, f64>> {
    let panels = figure.scene_file.as_ref().map_or(&[][..], |scene_file| &scene_file.panels);
    let flat = |section: &Section| {
        let mut numbers = BTreeMap::new();
        flatten(section, "", &mut numbers);
        numbers
    };
    panels.iter().map(|panel| (panel.name.clone(), flat(&panel.tables))).collect()
}

fn flatten(section: &Section, prefix: &str, numbers: &mut BTreeMap<String, f64>) {
    for (key, entry) in &section.entries {
        match &entry.value {
            Value::Number(number) => {
                numbers.insert(format!("{prefix}{key}"), *number);
            }
            Value::Section(inner) => flatten(inner, &format!("{prefix}{key}."), numbers),
            Value::Text(_) | Value::Flag(_) | Value::Other(_) => {}
        }
    }
}
