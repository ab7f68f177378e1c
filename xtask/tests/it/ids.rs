//! Names of figures.

use crate::shop::Shop;
use checkout::figure::{self, Figure, edits};
use checkout::paths::Paths;

fn figures(name: &str) -> Vec<Figure> {
    let paths = Paths::find(Some(Shop::new(name).root)).expect("a root");
    figure::discover(&paths).expect("figures")
}

#[test]
fn every_form_of_a_name_finds_the_figure() {
    let figures = figures("ids-forms");
    for name in ["fig04", "fig4", "4", "04", "fig:stdv_rec", "growth", "gro", "fig04-growth", "fig04-g"] {
        assert_eq!(figure::find(&figures, name).expect(name).id, "fig04", "{name}");
    }
    assert_eq!(figure::find(&figures, "s01").expect("s01").id, "s01");
    assert_eq!(figure::find(&figures, "s1").expect("s1").id, "s01");
}

#[test]
fn an_unknown_name_gets_the_closest_and_the_valid_ones() {
    let failure = figure::find(&figures("ids-unknown"), "fig:jamz").expect_err("no such figure");
    assert_eq!(failure.code(), 2);
    assert!(failure.text().contains("did you mean fig:jams?"), "{}", failure.text());
    assert!(failure.text().contains("fig04 fig05 fig06 fig11 fig12 s01"), "{}", failure.text());
}

#[test]
fn a_prefix_of_two_figures_is_refused_with_both() {
    let failure = figure::find(&figures("ids-both"), "exponential").expect_err("ambiguous");
    assert!(failure.text().contains("fig05-exponential-map, fig06-exponential-sway"), "{}", failure.text());
}

#[test]
fn an_empty_name_is_unknown() {
    assert_eq!(figure::find(&figures("ids-empty"), "").expect_err("no name").code(), 2);
}

#[test]
fn without_names_the_supplements_stay_out() {
    let figures = figures("ids-default");
    let ids = |all| -> Vec<String> {
        figure::select(&figures, &[], all).expect("figures").iter().map(|figure| figure.id.clone()).collect()
    };
    assert_eq!(ids(false), ["fig04", "fig05", "fig06", "fig11", "fig12"]);
    assert_eq!(ids(true).last().map(String::as_str), Some("s01"));
}

#[test]
fn edits_count_single_letters() {
    assert_eq!(edits("kitten", "sitting"), 3);
    assert_eq!(edits("", "abc"), 3);
    assert_eq!(edits("abc", "abc"), 0);
}
