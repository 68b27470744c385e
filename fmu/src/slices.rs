//! Slices that an importer hands over.

use std::slice;

/// Of pointers and counts that an importer hands over.
pub(crate) const NULL: &str = "a pointer is null";

/// A slice that an importer hands over.
///
/// # Safety
/// `first` is null, or the first of `count` values that are there while the slice is used.
pub(crate) unsafe fn slice_of<'s, T>(first: *const T, count: usize) -> Result<&'s [T], String> {
    match (count, first.is_null()) {
        (0, _) => Ok(&[]),
        (_, true) => Err(NULL.to_owned()),
        // SAFETY: as above.
        _ => Ok(unsafe { slice::from_raw_parts(first, count) }),
    }
}

/// As [`slice_of`], to be written.
///
/// # Safety
/// As there; nothing else reads or writes them meanwhile.
pub(crate) unsafe fn slice_for<'s, T>(first: *mut T, count: usize) -> Result<&'s mut [T], String> {
    match (count, first.is_null()) {
        (0, _) => Ok(&mut []),
        (_, true) => Err(NULL.to_owned()),
        // SAFETY: as above.
        _ => Ok(unsafe { slice::from_raw_parts_mut(first, count) }),
    }
}
