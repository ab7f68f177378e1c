//! Options of `verify`: budget, report, attestation, costs.

use crate::shop::blessed;
use checkout::paths::Paths;
use std::collections::BTreeMap;
use verify::attest;

#[test]
fn a_budget_takes_the_cheapest_figures_and_lists_the_others() {
    let shop = blessed("verify-budget");
    // seconds of the last runs: 3 for each run of figure 4, half a second for figures 5 and 6, nothing known of the
    // others
    let times: BTreeMap<&str, f64> = [
        ("fig04 run stable", 3.0),
        ("fig04 run unstable", 3.0),
        ("fig04-growth", 1.0),
        ("fig05-exponential-map", 0.5),
        ("fig06-exponential-sway", 0.5),
    ]
    .into();
    shop.write("target/xtask/times.json", &serde_json::to_string(&times).expect("JSON"));
    // what is not known here is known from elsewhere
    shop.write(
        "data/costs.csv",
        "node,cpu_seconds,peak_mib,kib_written\nfig11 run main,2.000,5.0,9\nfig11-trajectories,1.000,5.0,9\n",
    );
    let verify = |budget: &str| {
        let json = shop.xtask(&["verify", "--json", "--jobs", "1", "--budget", budget]).expect(0).json();
        let names = |list: &str| -> Vec<String> {
            let list = json[list].as_array().expect("a list").clone();
            list.iter().filter_map(|one| one["figure"].as_str().map(str::to_owned)).collect()
        };
        (names("figures"), names("left_out"))
    };
    let strings = |names: &[&str]| names.iter().map(|&name| name.to_owned()).collect::<Vec<_>>();
    assert_eq!(verify("1s"), (strings(&["fig05", "fig06"]), strings(&["fig04", "fig11", "fig12"])));
    assert_eq!(verify("4"), (strings(&["fig05", "fig06", "fig11"]), strings(&["fig04", "fig12"])));
    assert_eq!(verify("2m"), (strings(&["fig04", "fig05", "fig06", "fig11"]), strings(&["fig12"])));
    let ended = shop.xtask(&["verify", "--jobs", "1", "--budget", "5s"]).expect(0);
    assert!(ended.out.contains("left out by the budget: fig04 (7 s), fig12 (not known)"), "{}", ended.out);
    shop.xtask(&["verify", "--budget", "soon"]).expect(2);
}

#[test]
fn an_attestation_is_written_once_and_names_nobody() {
    let shop = blessed("verify-attest");
    shop.xtask(&["verify", "--attest"]).expect(0);
    let text = shop.read("data/attestations.jsonl");
    shop.xtask(&["verify", "--attest"]).expect(0);
    assert_eq!(shop.read("data/attestations.jsonl"), text);
    let line: serde_json::Value = serde_json::from_str(&text).expect("one line of JSON");
    assert_eq!(line["verdict"].as_str(), Some("same"));
    let said = shop.xtask(&["verify", "--json"]).expect(0).json();
    assert_eq!(line["sums"], said["sums"]);
    let host = std::process::Command::new("uname").arg("-n").output();
    let host = host.map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned()).unwrap_or_default();
    assert!(!text.contains(&*shop.root.to_string_lossy()), "{text}");
    assert!(host.len() < 4 || !text.contains(&host), "{text}");
    // other bits are another line
    shop.write("spoil", "fig04 ulp 4000\n");
    shop.xtask(&["verify", "--attest"]).expect(1);
    assert_eq!(shop.read("data/attestations.jsonl").lines().count(), 2);
    let paths = Paths::find(Some(shop.root.clone())).expect("a checkout");
    let same: Vec<bool> = attest::compared(&paths).expect("two lines").into_iter().map(|(_, same)| same).collect();
    assert_eq!(same, [true, false]);
    shop.xtask(&["verify", "4", "--attest"]).expect(2);
}

#[test]
fn the_page_shows_what_differs_and_who_got_the_same_bits() {
    let shop = blessed("verify-page");
    shop.xtask(&["verify", "--attest"]).expect(0);
    shop.xtask(&["verify", "--report", "out/page.html"]).expect(0);
    let page = shop.read("out/page.html");
    assert!(page.contains("Everything is as committed.") && page.contains("the same as here"), "{page}");
    assert!(!page.contains("<img"));
    shop.write("spoil", "fig04 colours\n");
    shop.xtask(&["verify", "--report", "out/page.html"]).expect(1);
    let page = shop.read("out/page.html");
    assert!(page.contains("<h2>fig04: same data, other rendering</h2>") && page.contains("others than here"), "{page}");
    for side in ["expected", "actual", "difference"] {
        assert!(page.contains(&format!("<figcaption>{side}</figcaption>")), "{side}");
    }
    assert_eq!(page.matches("src=\"data:image/png;base64,").count(), 3);
    // nothing is fetched from anywhere
    assert!(!page.contains("http") && !page.contains("src=\"figures"));
}

#[test]
fn costs_are_measured_and_listed() {
    let shop = blessed("verify-costs");
    shop.write("slow", "");
    shop.xtask(&["verify", "--costs"]).expect(0);
    if !std::path::Path::new("/proc/self/schedstat").exists() {
        eprintln!("skipped: this system does not tell what a program uses");
        return;
    }
    let text = shop.read("data/costs.csv");
    let nodes: Vec<&str> = text.lines().skip(1).filter_map(|line| line.split(',').next()).collect();
    assert_eq!(nodes.len(), 8, "{text}");
    let ended = shop.xtask(&["list", "--costs"]).expect(0);
    assert!(ended.out.contains("| fig04 | `cargo xtask figures fig04` |"), "{}", ended.out);
    assert_eq!(ended.out.lines().count(), 7, "{}", ended.out);
}
