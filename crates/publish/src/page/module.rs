//! The WebAssembly module inside the page: compressed, as base64, in an element of its own. The committed sum is that
//! of the page without the module, whose bytes depend on the compiler.

use super::pack::packed;
use checkout::failure::Failure;

/// The element without a module.
const EMPTY: &str = "<script type=\"text/plain\" id=\"module\"></script>";

/// A page with a module in the place of none.
///
/// # Errors
/// The page has no place for it, or several.
pub fn embed(page: &str, module: &[u8]) -> Result<String, Failure> {
    let [before, after] = page.split(EMPTY).collect::<Vec<&str>>()[..] else {
        return Err(Failure::failed(format!("the page has not one place for a module: {EMPTY}")));
    };
    let (open, close) = EMPTY.split_at(EMPTY.len() - "</script>".len());
    Ok([before, open, &packed(module)?, close, after].concat())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_module_has_one_place() {
        let page = format!("a{EMPTY}b");
        let with = embed(&page, b"module").expect("a place");
        assert!(with.starts_with("a<script") && with.ends_with("</script>b") && with.len() > page.len() + 20);
        assert!(embed("ab", b"module").is_err() && embed(&format!("{page}{page}"), b"module").is_err());
    }
}
