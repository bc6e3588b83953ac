//! Who runs the command: the login that the book's history names.

/// The login, as the system has it.
pub(crate) fn operator() -> String {
    let names = ["USER", "LOGNAME", "USERNAME"];
    let known = names.iter().find_map(|name| std::env::var(name).ok());
    known
        .filter(|name| !name.trim().is_empty())
        .unwrap_or_else(|| "somebody".to_owned())
}
