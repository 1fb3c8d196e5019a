//! Memory for large arrays with random access.
#![cfg_attr(
    target_os = "linux",
    allow(unsafe_code, reason = "a hint to the kernel about memory of our own")
)]

/// An empty vector with this capacity, in pages of 2 MiB if the system has them. With small pages
/// most accesses to a large tree or map also cost a page-table walk.
pub(crate) fn room_for<T>(count: usize) -> Vec<T> {
    let room = Vec::with_capacity(count);
    ask_for_huge_pages(&room);
    room
}

/// The same elements in such memory, if they fill two of these pages.
pub(crate) fn settled<T: Copy>(elements: Vec<T>) -> Box<[T]> {
    if size_of_val(&elements[..]) < 2 * HUGE_PAGE {
        return elements.into();
    }
    let mut room = room_for(elements.len());
    room.extend_from_slice(&elements);
    room.into()
}

/// Bytes of a huge page.
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
        for count in [0, 1, 1000, 3_000_000] {
            let mut room: Vec<u32> = room_for(count as usize);
            assert!(room.is_empty() && room.capacity() >= count as usize);
            room.extend(0..count);
            assert!(room.iter().copied().eq(0..count));
            assert_eq!(settled(room.clone())[..], room[..]);
        }
    }
}
