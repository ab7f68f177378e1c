//! The overall verdict from the four levels.

use crate::judgement::Judgement;
use crate::tables::{Against, Compared};
use checkout::sums::State;

/// The verdict on one figure, from the levels of bytes, numbers and pixels. In this order, from harmless to grave.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Verdict {
    /// Every file has its committed bytes, every event its committed time.
    Same,
    /// Tables and pixels are the committed ones; the bytes of a PNG are not: another encoder.
    OtherFile,
    /// Tables are the committed ones, to the byte; a picture shows something else, or its SVG is another text.
    OtherRendering,
    /// Every number is the committed one, to the bit; the text of a table is not (order, ends of lines, digits).
    OtherText,
    /// Numbers are others, all within the tolerances of `data/tolerances.toml`: another machine, compiler or method.
    OtherBits,
    /// The bytes of a table are others, none of the committed samples is, and the whole committed table is not at hand:
    /// the rows between the samples cannot be judged.
    Unlocated,
    /// The committed files contradict each other: a table has its committed sum but differs from its committed sample.
    Contradiction,
    /// A table or a picture is missing, new, cut short, or cannot be read; all numbers that can be compared are within.
    Broken,
    /// A number is beyond its tolerance, or an event did not occur, or is new.
    OtherPhysics,
}

impl Verdict {
    /// Every verdict.
    pub const ALL: [Verdict; 9] = [
        Verdict::Same,
        Verdict::OtherFile,
        Verdict::OtherRendering,
        Verdict::OtherText,
        Verdict::OtherBits,
        Verdict::Unlocated,
        Verdict::Contradiction,
        Verdict::Broken,
        Verdict::OtherPhysics,
    ];

    /// The verdict on a figure: the gravest that applies.
    pub fn of(judgement: &Judgement) -> Verdict {
        Verdict::ALL.into_iter().rev().find(|verdict| verdict.applies(judgement)).unwrap_or(Verdict::Same)
    }

    fn applies(self, judgement: &Judgement) -> bool {
        let compared = || judgement.tables.iter().filter_map(|(name, table)| Some((name, table.as_ref().ok()?)));
        let bytes_of = |table: &str| {
            let end = format!("/{table}");
            let mine = |(name, _): &(&String, &State)| name.starts_with("data/") && name.ends_with(&end);
            judgement.files.iter().find(mine).map(|(_, &state)| state)
        };
        let data_are_same = || {
            let mut tables = judgement.files.iter().filter(|(name, _)| name.ends_with(".csv"));
            judgement.events.is_empty() && tables.all(|(_, &state)| state == State::Same)
        };
        let same_numbers = judgement.numbers_are_same();
        match self {
            Verdict::Same => judgement.bytes_are_same() && same_numbers,
            Verdict::OtherFile => data_are_same() && judgement.pictures.values().any(|one| one.is_other_file()),
            Verdict::OtherRendering => data_are_same() && judgement.pictures.values().any(|one| !one.is_other_file()),
            Verdict::OtherText => !data_are_same() && same_numbers,
            Verdict::OtherBits => !same_numbers,
            Verdict::Unlocated => compared().any(|(name, table)| {
                bytes_of(name) == Some(State::Differs) && table.against == Against::Sample && table.is_same()
            }),
            Verdict::Contradiction => judgement.tables.iter().any(|(name, table)| {
                bytes_of(name) == Some(State::Same) && !table.as_ref().is_ok_and(Compared::is_same)
            }),
            Verdict::Broken => {
                let lost = |state: &State| matches!(state, State::Missing | State::New);
                let cut = compared().any(|(_, table)| table.distance.unmatched > 0);
                let unread = judgement.tables.values().any(Result::is_err);
                let unseen = judgement.pictures.values().any(|one| one.problem().is_some());
                let agrees = !Verdict::Contradiction.applies(judgement);
                agrees && (cut || unread || unseen || judgement.files.values().any(lost))
            }
            Verdict::OtherPhysics => {
                let beyond =
                    compared().any(|(name, table)| table.distance.beyond > 0 && bytes_of(name) != Some(State::Same));
                beyond || judgement.events.iter().any(|moved| !moved.within)
            }
        }
    }

    /// The word for JSON.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Same => "same",
            Verdict::OtherFile => "other_file",
            Verdict::OtherRendering => "other_rendering",
            Verdict::OtherText => "other_text",
            Verdict::OtherBits => "other_bits",
            Verdict::Unlocated => "unlocated",
            Verdict::Contradiction => "contradiction",
            Verdict::Broken => "broken",
            Verdict::OtherPhysics => "other_physics",
        }
    }

    /// What it means, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Verdict::Same => "the same bytes",
            Verdict::OtherFile => "same data, same pixels, other file",
            Verdict::OtherRendering => "same data, other rendering",
            Verdict::OtherText => "same numbers, written differently",
            Verdict::OtherBits => "same numbers within tolerance, other bits",
            Verdict::Unlocated => "other bits, not at the committed samples: distance unknown",
            Verdict::Contradiction => "the committed files contradict each other",
            Verdict::Broken => "missing, new, cut short or unreadable",
            Verdict::OtherPhysics => "other physics: beyond tolerance",
        }
    }

    /// Whether numbers are within their tolerances wherever they are defined: what `--tolerant` accepts.
    pub fn is_within(self) -> bool {
        self <= Verdict::OtherBits
    }
}
