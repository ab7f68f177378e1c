//! HTML from templates.

use minijinja::{Value, context};
use verify::html::environment;

#[test]
fn text_is_escaped_and_html_is_not() {
    let html = Value::from_safe_string("<b>1 & 2</b>".to_owned());
    let context = context! { text => "a < \"b\" & 'c'", html };
    let page = environment().render_str("<p title=\"{{ text }}\">{{ html }}</p>\n", context);
    assert_eq!(page.expect("a page"), "<p title=\"a &lt; &quot;b&quot; &amp; 'c'\"><b>1 & 2</b></p>\n");
}

#[test]
fn a_name_without_a_value_is_an_error_that_says_where() {
    let told = environment().render_str("a\n{{ lost }}", context! {}).expect_err("no value").to_string();
    assert!(told.contains("undefined") && told.contains(":2"), "{told}");
}
