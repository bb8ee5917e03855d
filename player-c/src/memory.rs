//! Memory for callers that share it with the library and have none of their own there: WebAssembly.

use alloc::{boxed::Box, vec};
use core::ptr;

/// `count` numbers of 32 bits, all 0; null for none. Given back by [`gambol_memory_free`].
#[unsafe(no_mangle)]
pub extern "C" fn gambol_memory_new(count: usize) -> *mut u32 {
    /// 64 MiB: no caller needs more, and an absurd count must not end the program.
    const MOST: usize = 1 << 24;
    if count == 0 || count > MOST { ptr::null_mut() } else { Box::into_raw(vec![0; count].into_boxed_slice()).cast() }
}

/// Gives them back. Null is allowed.
///
/// # Safety
/// `memory` is null, or is from [`gambol_memory_new`] with this count and not given back.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn gambol_memory_free(memory: *mut u32, count: usize) {
    if !memory.is_null() {
        // SAFETY: the caller promises it.
        drop(unsafe { Box::from_raw(ptr::slice_from_raw_parts_mut(memory, count)) });
    }
}
