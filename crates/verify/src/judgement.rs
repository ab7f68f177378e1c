//! The judgement of one figure.

use crate::moved::Moved;
use crate::pictures::Picture;
use crate::reference::Reference;
use crate::states::Parted;
use crate::tables::Compared;
use crate::verdict::Verdict;
use checkout::failure::Failure;
use checkout::figure::Figure;
use checkout::paths::Paths;
use checkout::request::MadeFigure;
use checkout::sums::State;
use std::collections::BTreeMap;
use std::path::Path;

/// Everything that was found of one figure.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Judgement {
    /// The figure: `fig04`.
    pub id: String,
    /// The paper's label.
    pub label: String,
    /// Bytes: a state for each output.
    pub files: BTreeMap<String, State>,
    /// Numbers: the distance of each table from the committed one, by file name, or the reason why it is unknown.
    pub tables: BTreeMap<String, Result<Compared, String>>,
    /// Numbers: events of the figure's runs that are not as committed.
    pub events: Vec<Moved>,
    /// Numbers: runs whose state parts from the committed one.
    pub parted: Vec<Parted>,
    /// Pixels: the pictures whose bytes are not as committed, by name.
    pub pictures: BTreeMap<String, Picture>,
}

/// Judges what a figure has below `made`. Pictures that differ are written into `folder`, if one is given.
///
/// # Errors
/// A file cannot be read or written.
pub fn judge(
    paths: &Paths,
    made: &Paths,
    survey: &MadeFigure<'_>,
    reference: &Reference,
    folder: Option<&Path>,
) -> Result<Judgement, Failure> {
    let figure: &Figure = survey.figure;
    let files = reference.sums.judge(made, figure, &survey.outputs);
    Ok(Judgement {
        id: figure.id.clone(),
        label: figure.label().to_owned(),
        tables: crate::tables::judge(paths, made, figure, reference)?,
        events: reference.moved_events(made, survey)?,
        parted: crate::states::judge(paths, made, survey, reference)?,
        pictures: crate::pictures::judge(paths, made, figure, reference, &files, folder)?,
        files,
    })
}

impl Judgement {
    /// What the levels say together.
    pub fn verdict(&self) -> Verdict {
        Verdict::of(self)
    }

    /// Whether every byte and every number is as committed.
    pub fn is_same(&self) -> bool {
        self.verdict() == Verdict::Same
    }

    /// Whether every file and every event is as committed, to the byte.
    pub fn bytes_are_same(&self) -> bool {
        self.files.values().all(|&state| state == State::Same) && self.events.is_empty()
    }

    /// Whether no picture shows anything else.
    pub fn pixels_are_same(&self) -> bool {
        self.pictures.values().all(Picture::is_other_file)
    }

    /// Whether every number that can be compared is the committed one, to the bit.
    pub fn numbers_are_same(&self) -> bool {
        let same = |table: &Result<Compared, String>| table.as_ref().is_ok_and(Compared::is_same);
        self.parted.is_empty() && self.tables.values().all(same) && self.events.iter().all(|moved| moved.ulp == Some(0))
    }
}
