//! What messages about modules say to do: for what compilers and their users get wrong.

use super::*;

fn refusal_with_help(bytes: Vec<u8>) -> String {
    match PluginController::open(&opening(bytes)) {
        Err(Stop::DidNotBuild(mistake)) => {
            format!("{}; {}", mistake.message, mistake.help.unwrap_or_default())
        }
        Err(other) => panic!("{other:?}"),
        Ok(_) => panic!("it opens"),
    }
}

#[test]
fn what_c_programs_call_and_is_not_there_has_something_instead() {
    for (name, wanted) in [
        ("printf", "km_log"),
        ("malloc", "arrays of a fixed size"),
        ("_Znwm", "arrays of a fixed size"),
        ("__addtf3", "use double"),
        ("__trunctfdf2", "use double"),
        ("fma", "a * b + c"),
        ("sinf", "without the f"),
        ("rand", "every run is the same"),
        ("exit", "km_fail"),
        ("km_jacobian", "include kinemark.h"),
        ("sinn", "did you mean `sin`"),
        ("zzzzzz", "define it in your own code"),
        ("__wasm_call_ctors", "an object file"),
    ] {
        let text = format!("(import \"env\" \"{name}\" (func (param i32) (result i32)))");
        let refused = refusal_with_help(module(&text));
        assert!(refused.contains(wanted), "{refused}, not {wanted}");
    }
    let object = "(import \"env\" \"__stack_pointer\" (global (mut i32)))";
    assert!(refusal_with_help(module(object)).contains("leave out -c"));
}

#[test]
fn a_function_of_another_type_is_shown_as_c_declares_it() {
    let refused = refusal_with_help(module("(func (export \"km_control\") (param f64))"));
    assert_eq!(
        refused,
        "the module exports `km_control` as (f64) -> (), it is called as (i32, i32) -> (); \
         in C declare it as void km_control(const km_observation *observation, double *command)"
    );
    let refused = refusal_with_help(module(
        "(func (export \"km_jacobian\") (param i32 i32 i32))",
    ));
    assert!(
        refused.ends_with(
            "km_u32 km_jacobian(const km_robot *robot, const double *q, double *matrix)"
        )
    );
    let mut own = opening(module("(func (export \"km_own\") (param i32))"));
    own.function = Some(asked("own"));
    let Err(Stop::DidNotBuild(mistake)) = PluginController::open(&own) else {
        panic!("it opens")
    };
    assert_eq!(
        mistake.help.as_deref(),
        Some("in C declare it as void km_own(const km_map *given, km_answer *answer)")
    );
}

/// A panic of the Rust crate: the words come from the machinery of panics, which is not named.
#[test]
fn a_panic_has_its_own_place() {
    let words = "panicked at src/lib.rs:4:9: no";
    let text = format!(
        "(import \"kinemark\" \"fail\" (func $fail (param i32 i32))) (data (i32.const 8) \"{words}\")
         (func $rust_begin_unwind (call $fail (i32.const 8) (i32.const {}))) {}",
        words.len(),
        body("(call $rust_begin_unwind)")
    );
    assert_eq!(mistake(control(&text)).0, words);
}

#[test]
fn names_of_rust_are_shown_as_they_are_written() {
    for name in [
        "_ZN10submission6follow17h0123456789abcdefE",
        "_RNvCs1234_10submission6follow",
        "submission::follow::h0123456789abcdef",
    ] {
        let text = format!(
            "(func $\"{name}\" unreachable) {}",
            body(&format!("(call $\"{name}\")"))
        );
        assert_eq!(
            mistake(control(&text)).0,
            "`km_control` stops itself, in the function `submission::follow`"
        );
    }
}

#[test]
fn memory_of_64_bits_is_refused_with_the_target_to_use() {
    let bytes = wat::parse_str(
        "(module (memory (export \"memory\") i64 2)
            (func (export \"km_version\") (result i32) i32.const 1)
            (func (export \"km_buffer\") (param i32) (result i32) i32.const 1024))",
    );
    assert!(refusal_with_help(bytes.unwrap()).contains("wasm32, not for wasm64"));
}
