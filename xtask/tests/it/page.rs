//! The page is made from verified figures only. A browser tests its display (`checks/browser`).

use crate::shop::{self, Shop};

#[test]
fn figures_that_do_not_verify_make_no_page() {
    let shop = Shop::new("page-stale");
    shop.xtask(&["report"]).expect(3);
    let shop = shop::blessed("page-differs");
    shop.edit("figures/fig05-exponential-map/fig05.svg", "<svg", "<svg ");
    let ended = shop.xtask(&["report"]).expect(1);
    assert!(ended.err.contains("fig05.svg"), "{}", ended.err);
    assert!(!shop.has("paper/report.html"));
}

#[test]
fn a_page_without_a_ledger_is_refused() {
    let shop = shop::blessed("page-ledger");
    let ended = shop.xtask(&["report"]).expect(3);
    assert!(ended.err.contains("ledger.json"), "{}", ended.err);
}

#[test]
fn a_line_of_a_list_of_sums_is_put_beside_the_others() {
    let shop = Shop::new("page-sums");
    let (one, two) = ("a".repeat(64), "b".repeat(64));
    shop.write("paper/SHA256SUMS", &format!("{one}  paper/a.pdf\n{one}  paper/report.html\n"));
    let list = shop.root.join("paper/SHA256SUMS");
    checkout::sums::record(&list, "paper/report.html", &two).expect("written");
    assert_eq!(shop.read("paper/SHA256SUMS"), format!("{one}  paper/a.pdf\n{two}  paper/report.html\n"));
}
