//! The ledger as the verbs judge it.

use crate::shop::{Shop, blessed};
use checkout::paths::{Paths, Scheme};
use std::collections::BTreeSet;

/// Claims on the shop's map: figure 5 is as it is, figure 6 and the committed events are others'.
const CLAIMS: &str = r#"
[[claim]]
id = "map-is-positive"
label = "fig:sfm"
says = "positive"
verdict = "holds"
finding = "{least}"
[[claim.test]]
name = "least"
take = "least"
of = "phi"
table = "fig05/left"
is = "> 0"

[[claim]]
id = "map-is-large"
label = "fig:avsfm"
says = "large"
verdict = "does not hold"
finding = ""
[[claim.test]]
take = "largest"
of = "phi"
table = "fig06/left"
is = "> 1e6"

[[claim]]
id = "somebody-overlaps"
label = "fig:jams"
says = "somebody does"
verdict = "holds"
finding = ""
[[claim.test]]
take = "count"
table = "events"
where = ["event = overlap"]
is = "> 0"
"#;

fn shop(name: &str) -> Shop {
    let shop = blessed(name);
    shop.write("paper/claims.toml", CLAIMS);
    shop.xtask(&["bless"]).expect(0);
    shop
}

#[test]
fn bless_writes_the_ledger_and_verify_judges_it() {
    let shop = shop("ledger-same");
    let text = shop.read("data/ledger.json");
    let value: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    assert_eq!(value["schema_version"], 1);
    assert_eq!(value["claims"][0]["verdict_found"], "holds");
    assert_eq!(value["claims"][1]["tests"][0]["outcome"], "false");
    let ended = shop.xtask(&["verify"]).expect(0);
    assert!(ended.out.contains("3 claims: holds 2, does not hold 1"), "{}", ended.out);
    shop.edit("data/ledger.json", "holds", "stands");
    shop.xtask(&["figures", "--force"]).expect(0);
    assert!(shop.read("data/ledger.json") != text, "figures leave it alone");
    shop.write("data/ledger.json", &text);
    shop.edit("data/ledger.json", "\"holds\"", "\"does not hold\"");
    assert!(shop.xtask(&["verify"]).expect(1).out.contains("differs: data/ledger.json"));
    assert_eq!(shop.read("data/ledger.json"), text, "it is written as it was found, once that has been told");
    let ended = shop.xtask(&["verify", "--json"]).expect(0).json();
    assert_eq!((&ended["claims"]["verdict"], &ended["claims"]["ledger"]), (&"same".into(), &"same".into()));
}

#[test]
fn a_part_is_judged_by_the_figures_it_reads() {
    let shop = shop("ledger-part");
    let ids = |arguments: &[&str]| {
        let claims = shop.xtask(arguments).expect(0).json()["claims"]["claims"].clone();
        let id = |claim: &serde_json::Value| claim["id"].as_str().unwrap_or("").to_owned();
        claims.as_array().expect("claims").iter().map(id).collect::<BTreeSet<_>>()
    };
    assert_eq!(ids(&["verify", "5", "--json"]), BTreeSet::from(["map-is-positive".to_owned()]));
    assert_eq!(ids(&["verify", "4", "--json"]), BTreeSet::new());
    assert_eq!(ids(&["verify", "--json"]).len(), 3);
}

#[test]
fn a_changed_verdict_fails_and_no_other_claim_with_it() {
    let shop = shop("ledger-changed");
    shop.edit(
        "paper/claims.toml",
        "is = \"> 0\"\n\n[[claim]]\nid = \"map-is-large\"",
        "is = \"< 0\"\n\n[[claim]]\nid = \"map-is-large\"",
    );
    let ended = shop.xtask(&["verify"]).expect(1);
    assert!(ended.err.contains("not as committed: claims"), "{}", ended.err);
    assert!(ended.out.contains("claim map-is-positive: recorded \"holds\", found \"does not hold\""), "{}", ended.out);
    assert!(ended.out.contains("least phi in data/fig05/left.csv"), "{}", ended.out);
    assert!(
        !ended.out.contains("claim map-is-large") && !ended.out.contains("claim somebody-overlaps"),
        "{}",
        ended.out
    );
    assert!(ended.out.contains("differs: data/ledger.json"), "{}", ended.out);
    let ended = shop.xtask(&["bless"]).expect(1);
    assert!(ended.out.contains("claim map-is-positive") && ended.err.contains("nothing written"), "{}", ended.err);
    shop.edit(
        "paper/claims.toml",
        "verdict = \"holds\"\nfinding = \"{least}\"",
        "verdict = \"does not hold\"\nfinding = \"{least}\"",
    );
    shop.xtask(&["bless"]).expect(0);
    shop.xtask(&["verify"]).expect(0);
}

#[test]
fn a_flipped_sign_in_a_table_changes_a_verdict() {
    let shop = shop("ledger-flipped");
    // the figure is made from its scene: another one gives another table
    let table = shop.read("data/fig05/left.csv");
    let flipped: String = table.lines().enumerate().map(|(index, line)| flip(index, line)).collect();
    shop.write("data/fig05/left.csv", &flipped);
    let paths = Paths {
        base: shop.root.clone(),
        target: shop.root.join("target"),
        root: shop.root.clone(),
        scheme: Scheme::Adaptive,
    };
    let verdicts = claims::judge(&paths, &paths, None).expect("verdicts");
    let changed: Vec<&str> = verdicts.changed().map(|claim| claim.id.as_str()).collect();
    assert_eq!(changed, ["map-is-positive"]);
    assert!(!verdicts.is_same());
}

/// The line with its last number negated; the header as it is.
fn flip(index: usize, line: &str) -> String {
    match line.rsplit_once(',') {
        Some((keys, value)) if index > 0 => format!("{keys},-{value}\n"),
        _ => format!("{line}\n"),
    }
}

#[test]
fn a_claim_is_explained() {
    let shop = shop("ledger-explain");
    let ended = shop.xtask(&["explain", "map-is-large"]).expect(0);
    for part in ["fig:avsfm", "verdict: does not hold", "largest phi in data/fig06/left.csv", "must be > 1e6: false"] {
        assert!(ended.out.contains(part), "{part}: {}", ended.out);
    }
    let value = shop.xtask(&["explain", "map-is-large", "--json"]).expect(0).json();
    assert_eq!(value["claim"]["tests"][0]["tables"][0], "data/fig06/left.csv");
    let list = shop.xtask(&["list", "--claims"]).expect(0);
    assert!(list.out.contains("map-is-positive") && list.out.contains("does not hold"), "{}", list.out);
    shop.xtask(&["explain", "nothing-of-the-kind"]).expect(2);
}

#[test]
fn bad_claims_end_with_code_2() {
    let shop = shop("ledger-bad");
    shop.edit("paper/claims.toml", "of = \"phi\"\ntable = \"fig05/left\"", "of = \"psi\"\ntable = \"fig05/left\"");
    let ended = shop.xtask(&["verify"]).expect(2);
    assert!(ended.err.contains("paper/claims.toml, map-is-positive, test 1, of: no column psi"), "{}", ended.err);
    shop.edit("paper/claims.toml", "of = \"psi\"", "col = \"phi\"");
    let ended = shop.xtask(&["verify"]).expect(2);
    assert!(ended.err.contains("unknown field `col`"), "{}", ended.err);
}
