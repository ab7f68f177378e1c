//! Events that differ from the committed ones.

use crate::numbers;
use checkout::events::{Event, partner};
use serde::Serialize;

/// An event that is not as committed.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Moved {
    /// The scene.
    pub scene: String,
    /// The kind of event.
    pub event: String,
    /// The pedestrian, from 0, as written.
    pub n: String,
    /// The committed time as written; `None` for an event that is not in the table.
    pub committed: Option<String>,
    /// The time found as written; `None` for an event that did not occur.
    pub found: Option<String>,
    /// |committed - found|, if there are both.
    pub absolute: Option<f64>,
    /// The number of doubles from one to the other, if there are both. 0 when only the text is another one.
    pub ulp: Option<u64>,
    /// Whether there are both, no further apart than the tolerance.
    pub within: bool,
}

/// The events of a scene that are not as committed; `tolerance` is how far times may be apart. The k-th of a kind at a
/// pedestrian is compared with the k-th.
pub fn compare(scene: &str, committed: &[Event], found: &[Event], tolerance: f64) -> Vec<Moved> {
    let moved = |one: &Event, committed: Option<&Event>, found: Option<&Event>| Moved {
        scene: scene.to_owned(),
        event: one.event.clone(),
        n: one.n.clone(),
        committed: committed.map(|event| event.t_text.clone()),
        found: found.map(|event| event.t_text.clone()),
        absolute: committed.zip(found).map(|(a, b)| (a.t - b.t).abs()),
        ulp: committed.zip(found).map(|(a, b)| numbers::ulps(a.t, b.t)),
        within: committed.zip(found).is_some_and(|(a, b)| (a.t - b.t).abs() <= tolerance),
    };
    let expected = committed.iter().enumerate().filter_map(|(index, event)| {
        let partner = partner(committed, index, found);
        let same = partner.is_some_and(|partner| partner.t_text == event.t_text);
        (!same).then(|| moved(event, Some(event), partner))
    });
    let new = found.iter().enumerate().filter(|&(index, _)| partner(found, index, committed).is_none());
    expected.chain(new.map(|(_, event)| moved(event, None, Some(event)))).collect()
}
