//! What docs/python.md lists is what can be imported: `KINEMARK_BLESS=1` writes the list again.

use std::fmt::Write as _;

const BEGIN: &str = "<!-- numpy names: begin -->\n";
const END: &str = "<!-- numpy names: end -->";

#[test]
fn the_page_lists_every_name() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../../docs/python.md");
    let page = std::fs::read_to_string(path).expect("the page");
    let (before, rest) = page.split_once(BEGIN).expect("the beginning of the list");
    let (_, after) = rest.split_once(END).expect("the end of the list");
    let mut list = String::new();
    for (module, names) in kinemark_python_numpy::names() {
        let names: Vec<String> = names
            .iter()
            .filter(|name| !name.starts_with('_'))
            .map(|name| format!("`{name}`"))
            .collect();
        // into a string: nothing can fail
        let _ = writeln!(list, "\n**`{module}`**: {}.", names.join(" "));
    }
    let wanted = format!("{before}{BEGIN}{list}\n{END}{after}");
    if std::env::var_os("KINEMARK_BLESS").is_some() {
        std::fs::write(path, &wanted).expect("the page is written");
    }
    assert!(page == wanted, "run this test with KINEMARK_BLESS=1");
}
