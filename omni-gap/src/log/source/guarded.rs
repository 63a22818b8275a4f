//! Readers of other libraries, some of which panic on files that are broken in ways nobody thought of.

use std::cell::Cell;
use std::panic::{self, AssertUnwindSafe, catch_unwind};
use std::sync::Once;

thread_local! {
    static WITHIN: Cell<bool> = const { Cell::new(false) };
}

/// Does what a panic may end, and says that it did; nothing of it is told on the terminal. What the work was given is not to be
/// used after that.
pub(super) fn guarded<T>(work: impl FnOnce() -> T) -> Option<T> {
    quiet_within();
    let before = WITHIN.replace(true);
    let done = catch_unwind(AssertUnwindSafe(work));
    WITHIN.set(before);
    done.ok()
}

/// What a panic is told by otherwise is asked only where none is waited for.
fn quiet_within() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = panic::take_hook();
        panic::set_hook(Box::new(move |panic| {
            if !WITHIN.get() {
                usual(panic);
            }
        }));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_panics_is_told_and_what_does_not_is_handed_over() {
        assert_eq!(guarded(|| 7), Some(7));
        assert_eq!(guarded(|| -> i32 { panic!("a library's own") }), None);
        assert_eq!(guarded(|| guarded(|| -> i32 { panic!("within") }).is_none()), Some(true));
        assert!(!WITHIN.get());
    }
}
