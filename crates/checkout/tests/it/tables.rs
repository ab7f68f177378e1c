//! Tables of events.

use checkout::events;

#[test]
fn an_event_file_of_another_form_is_refused_with_its_line() {
    assert!(events::parse("f", "event,t\n").expect_err("header").text().starts_with("f:1:"));
    assert!(events::parse("f", "event,t,n\noverlap,12\n").expect_err("cells").text().starts_with("f:2:"));
    for line in ["overlap,inf,1", "overlap,2e999,1", "overlap,nan,1", "overlap,1,1\r"] {
        let failure = events::parse("f", &format!("event,t,n\n{line}")).expect_err(line);
        assert!(failure.text().starts_with("f:2:"), "{failure:?}");
        let failure = events::parse_all("f", &format!("{}\nfig04,{line},0", events::HEADER)).expect_err(line);
        assert!(failure.text().starts_with("f:2:"), "{failure:?}");
    }
    assert!(events::parse("f", "event,t,n\noverlap,soon,1\n").expect_err("time").text().starts_with("f:2:"));
}
