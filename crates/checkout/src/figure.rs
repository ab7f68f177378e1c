//! The figures in the checkout, and the names by which a user selects them.

use crate::disk;
use crate::failure::Failure;
use crate::paths::Paths;
use files::scene_file::{self, Kind, Panel, SceneFile};

/// A folder `figNN-slug` (or `sNN-slug`: a supplement) with a scene.
#[derive(Clone, Debug)]
pub struct Figure {
    /// Name of the folder and of the binary: `fig04-stable-unstable`.
    pub slug: String,
    /// The part before the first hyphen: `fig04`.
    pub id: String,
    /// The scene, or what is wrong with it.
    pub scene_file: Result<SceneFile, String>,
}

impl Figure {
    /// Whether it is a supplement, which the paper does not have.
    pub fn is_supplement(&self) -> bool {
        self.id.starts_with('s')
    }

    /// The paper's label, `fig:stdv_rec`; empty for a scene without one or one that cannot be read.
    pub fn label(&self) -> &str {
        let source = self.scene_file.as_ref().map_or("", |scene_file| scene_file.source.as_str());
        let (first, rest) = source.split_once(' ').unwrap_or((source, ""));
        // "not in the paper" begins with no label
        let is_label = rest.is_empty() || first.contains(':') || first.ends_with(',');
        if is_label { first.trim_end_matches([',', ':']) } else { "" }
    }

    /// What it shows, in words.
    pub fn title(&self) -> &str {
        self.scene_file.as_ref().map_or("", |scene_file| scene_file.title.as_str())
    }

    /// Panels that need a simulation in time; none for a scene that cannot be read.
    pub fn runs(&self) -> impl Iterator<Item = &Panel> {
        let panels = self.scene_file.as_ref().map_or(&[][..], |scene_file| &scene_file.panels);
        panels.iter().filter(|panel| panel.kind == Kind::Run)
    }

    /// The names by which a user may mean this figure, the fixed ones first.
    fn names(&self) -> [&str; 4] {
        [&self.slug, &self.id, self.label(), self.words()]
    }

    /// The slug without the number: `stable-unstable`.
    fn words(&self) -> &str {
        self.slug.split_once('-').map_or("", |(_, words)| words)
    }

    fn is_named(&self, wanted: &str) -> bool {
        let numbered = number(wanted).is_some_and(|wanted| number(&self.id) == Some(wanted));
        // a supplement without a label has an empty name
        numbered || (!wanted.is_empty() && self.names()[..3].contains(&wanted))
    }
}

/// Every figure of the checkout: those of the paper in order, then the supplements.
///
/// # Errors
/// The folder of the figures cannot be read.
pub fn discover(paths: &Paths) -> Result<Vec<Figure>, Failure> {
    let mut figures = Vec::new();
    for slug in disk::names(&paths.figures())? {
        let Some((id, _)) = slug.split_once('-') else { continue };
        if !is_id(id) {
            continue;
        }
        let scene = Paths::scene(&slug);
        let scene_file = match disk::read_text(&paths.root.join(&scene))? {
            Some(text) => scene_file::parse(&scene, &text).map_err(|error| error.to_string()),
            None => Err(format!("{scene}: no such file")),
        };
        figures.push(Figure { id: id.to_owned(), slug, scene_file });
    }
    Ok(figures)
}

/// The figures that the user names, in the order of [`discover`]; without a name those of the paper, with `all` the
/// supplements too.
///
/// # Errors
/// Usage: a name that fits no figure (with the names that do, and the closest), one that fits several, or a scene that
/// cannot be read.
pub fn select<'a>(figures: &'a [Figure], wanted: &[String], all: bool) -> Result<Vec<&'a Figure>, Failure> {
    let mut chosen: Vec<&str> = Vec::new();
    for name in wanted {
        chosen.push(&find(figures, name)?.slug);
    }
    let default = |figure: &Figure| wanted.is_empty() && (all || !figure.is_supplement());
    let selected: Vec<&Figure> =
        figures.iter().filter(|figure| default(figure) || chosen.contains(&figure.slug.as_str())).collect();
    for figure in &selected {
        if let Err(problem) = &figure.scene_file {
            return Err(Failure::Usage(problem.clone()));
        }
    }
    Ok(selected)
}

/// The one figure that `wanted` means: `fig04`, `4`, the label, or a prefix of the slug.
///
/// # Errors
/// Usage: none or several.
pub fn find<'a>(figures: &'a [Figure], wanted: &str) -> Result<&'a Figure, Failure> {
    if let Some(figure) = figures.iter().find(|figure| figure.is_named(wanted)) {
        return Ok(figure);
    }
    let fits = |figure: &&Figure| {
        !wanted.is_empty() && (figure.words().starts_with(wanted) || figure.slug.starts_with(wanted))
    };
    let fitting: Vec<&Figure> = figures.iter().filter(fits).collect();
    match fitting[..] {
        [figure] => Ok(figure),
        [] => Err(unknown(figures, wanted)),
        _ => {
            let slugs: Vec<&str> = fitting.iter().map(|figure| figure.slug.as_str()).collect();
            Err(Failure::Usage(format!("{wanted} fits several figures: {}", slugs.join(", "))))
        }
    }
}

fn unknown(figures: &[Figure], wanted: &str) -> Failure {
    let names = figures.iter().flat_map(Figure::names).filter(|name| !name.is_empty());
    let closest = names.min_by_key(|name| edits(name, wanted));
    let guess = closest.map_or(String::new(), |name| format!("; did you mean {name}?"));
    let ids: Vec<&str> = figures.iter().map(|figure| figure.id.as_str()).collect();
    Failure::Usage(format!("no figure {wanted}{guess}\nvalid: {}", ids.join(" ")))
}

/// Whether a supplement is meant, and its number: from `fig04`, `fig4`, `4`, `s01`.
fn number(name: &str) -> Option<(bool, u32)> {
    let digits = name.strip_prefix("fig").or_else(|| name.strip_prefix('s')).unwrap_or(name);
    let all_digits = digits.bytes().all(|byte| byte.is_ascii_digit());
    all_digits.then(|| digits.parse().ok())?.map(|number| (name.starts_with('s'), number))
}

/// `fig` or `s` and two digits.
fn is_id(id: &str) -> bool {
    let digits = id.strip_prefix("fig").or_else(|| id.strip_prefix('s')).unwrap_or("");
    digits.len() == 2 && digits.bytes().all(|byte| byte.is_ascii_digit())
}

/// The least number of insertions, removals and replacements that turn `a` into `b` (Levenshtein).
pub fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, letter) in a.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, &other) in b.iter().enumerate() {
            let replaced = diagonal + usize::from(letter != other);
            diagonal = row[j + 1];
            row[j + 1] = replaced.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[b.len()]
}
