//! Which functions are what, by their names.

/// True for a function that panics, or that only ever leads to a panic.
pub fn panics(name: &str) -> bool {
    const SIGNS: [&str; 8] = [
        "core::panicking::",
        "rust_begin_unwind",
        "rust_panic",
        "panic_",
        "_fail",
        "unwrap_failed",
        "expect_failed",
        "core::slice::index::slice_",
    ];
    SIGNS.iter().any(|sign| name.contains(sign))
}

/// True for a function that allocates memory.
pub fn allocates(name: &str) -> bool {
    ["__rust_alloc", "__rust_realloc", "__rust_dealloc", "__rg_alloc", "__rdl_alloc", "alloc::alloc::"]
        .iter()
        .any(|sign| name.contains(sign))
        || name == "malloc"
}

/// True for a routine of arithmetic in double precision, which this processor has no instructions for: the run-time
/// names of the Arm (RTABI, 4.1.2: `__aeabi_d…` and conversions to double) and the compiler's own.
pub fn double_precision(name: &str) -> bool {
    let conversion = ["f2d", "i2d", "ui2d", "l2d", "ul2d"];
    name.starts_with("__aeabi_d") && !["__aeabi_divmod"].contains(&name)
        || name.strip_prefix("__aeabi_").is_some_and(|rest| conversion.contains(&rest))
        || name.strip_prefix("__").is_some_and(|rest| {
            ["df2", "df3", "df", "dfsf2", "dfsi", "dfdi"].iter().any(|end| rest.ends_with(end)) && !rest.contains("::")
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_apart() {
        for name in [
            "core::panicking::panic_fmt",
            "__rustc::rust_begin_unwind",
            "core::option::unwrap_failed",
            "core::panicking::panic_bounds_check",
            "core::slice::index::slice_index_fail",
            "core::cell::panic_already_borrowed",
        ] {
            assert!(panics(name), "{name}");
        }
        assert!(!panics("model_core::control::current_loop::CurrentLoop::field_oriented") && !panics("ADC"));
        for name in ["__aeabi_dadd", "__aeabi_dcmplt", "__aeabi_d2f", "__aeabi_f2d", "__adddf3", "__extendsfdf2"] {
            assert!(double_precision(name), "{name}");
        }
        for name in ["__aeabi_fadd", "__aeabi_memcpy", "__aeabi_uldivmod", "__aeabi_f2iz", "__addsf3", "__udivmoddi4"] {
            assert!(!double_precision(name), "{name}");
        }
        assert!(allocates("__rust_alloc") && allocates("__rustc::__rust_alloc") && !allocates("firmware::allot"));
    }
}
