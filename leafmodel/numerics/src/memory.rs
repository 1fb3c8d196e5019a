//! Memory for large arrays.
//!
//! In pages of 2 MiB it costs one page fault where small pages cost 512, and random access to a
//! large tree or map costs fewer page-table walks.
#![cfg_attr(
    target_os = "linux",
    allow(unsafe_code, reason = "a hint to the kernel about memory of our own")
)]

/// An empty vector with this capacity, in pages of 2 MiB if the system has them.
pub fn room_for<T>(count: usize) -> Vec<T> {
    untouched(Vec::with_capacity(count))
}

/// As many copies of an element, in such pages.
pub fn filled<T: Clone>(element: T, count: usize) -> Vec<T> {
    let mut elements = room_for(count);
    elements.resize(count, element);
    elements
}

/// The same elements; what nobody has read or written yet will come in such pages, as all of
/// `vec![0.0; n]` does.
pub fn untouched<T>(elements: Vec<T>) -> Vec<T> {
    ask_for_huge_pages(&elements);
    elements
}

/// Bytes of a huge page.
#[cfg(target_os = "linux")]
const HUGE_PAGE: usize = 1 << 21;

#[cfg(target_os = "linux")]
fn ask_for_huge_pages<T>(room: &Vec<T>) {
    let start = (room.as_ptr() as usize).next_multiple_of(HUGE_PAGE);
    let end = room.as_ptr() as usize + room.capacity() * size_of::<T>();
    if let Some(bytes) = end.checked_sub(start).filter(|&bytes| bytes >= HUGE_PAGE) {
        // SAFETY: the range lies within the vector's memory, and the advice changes neither its
        // contents nor its ownership. A refusal does no harm.
        unsafe {
            libc::madvise(start as *mut libc::c_void, bytes, libc::MADV_HUGEPAGE);
        }
    }
}

#[cfg(not(target_os = "linux"))]
fn ask_for_huge_pages<T>(_: &Vec<T>) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_room_and_it_holds_what_is_put_in() {
        for count in [0_u32, 1, 1000, 3_000_000] {
            let mut room: Vec<u32> = room_for(count as usize);
            assert!(room.is_empty() && room.capacity() >= count as usize);
            room.extend(0..count);
            assert!(room.iter().copied().eq(0..count));
            assert!(
                untouched(vec![0_u32; count as usize])
                    .iter()
                    .all(|&n| n == 0)
            );
            assert!(filled(7_u32, count as usize).iter().all(|&n| n == 7));
        }
    }
}
