//! A panic ends the call with its words and its place: through the hook of the standard library, or the panic handler without it.

#[cfg(all(
    target_arch = "wasm32",
    any(feature = "std", feature = "panic-handler")
))]
fn report(place: Option<&core::panic::Location<'_>>, words: core::fmt::Arguments<'_>) -> ! {
    use crate::text::Text;
    use core::fmt::Write as _;

    let mut text = Text::new();
    // what does not fit is cut
    let _ = match place {
        Some(place) => write!(text, "panicked at {place}: {words}"),
        None => write!(text, "panicked: {words}"),
    };
    crate::host::fail(text.as_str())
}

/// Sets the hook. A module calls it before anything of its author's runs.
pub(crate) fn watch() {
    #[cfg(all(target_arch = "wasm32", feature = "std"))]
    std::panic::set_hook(std::boxed::Box::new(|panic| {
        let payload = panic.payload();
        let words = match payload.downcast_ref::<&str>() {
            Some(words) => words,
            None => payload
                .downcast_ref::<std::string::String>()
                .map_or("", |words| words),
        };
        report(panic.location(), format_args!("{words}"))
    }));
}

#[cfg(all(
    target_arch = "wasm32",
    feature = "panic-handler",
    not(feature = "std")
))]
#[panic_handler]
fn handle(panic: &core::panic::PanicInfo<'_>) -> ! {
    report(panic.location(), format_args!("{}", panic.message()))
}
