//! An allocator for a program of one thread: small pieces come from a list of free ones of their size, everything else from the allocator
//! below.
//!
//! A Python program takes and returns small pieces all the time, and the interpreter of WebAssembly pays for each instruction of the
//! allocator: here it is a dozen. Memory that was a small piece once stays one of its size.

use std::alloc::{GlobalAlloc, Layout};
use std::cell::UnsafeCell;
use std::ptr;

/// Sizes of small pieces are multiples of this many bytes, which is how they are aligned, too.
const STEP: usize = 8;
/// Bytes of the largest small piece.
const LARGEST: usize = 512;
const SIZES: usize = LARGEST / STEP;
/// Bytes that are taken from the allocator below at once.
const CHUNK: usize = 64 << 10;

/// A piece that is free: its first bytes say which one is next.
struct Free {
    next: *mut Free,
}

struct State {
    /// The free pieces of `STEP`, 2 `STEP`, ... bytes.
    free: [*mut Free; SIZES],
    /// What is left of the last chunk.
    rest: *mut u8,
    rest_bytes: usize,
}

/// The allocator.
pub struct Pools<Below> {
    state: UnsafeCell<State>,
    below: Below,
}

// SAFETY: whoever makes one has one thread, as `new` says
unsafe impl<Below> Sync for Pools<Below> {}

impl<Below> Pools<Below> {
    /// An allocator that has nothing yet.
    ///
    /// # Safety
    /// All calls come from one thread.
    pub const unsafe fn new(below: Below) -> Self {
        Self {
            state: UnsafeCell::new(State {
                free: [ptr::null_mut(); SIZES],
                rest: ptr::null_mut(),
                rest_bytes: 0,
            }),
            below,
        }
    }
}

/// The place of a layout among the sizes; nothing if it is not small.
#[inline]
const fn size_of_layout(layout: Layout) -> Option<usize> {
    if layout.align() > STEP || layout.size() > LARGEST || layout.size() == 0 {
        return None;
    }
    Some((layout.size() - 1) / STEP)
}

impl<Below: GlobalAlloc> Pools<Below> {
    /// A piece of a size of which none is free.
    #[cold]
    #[inline(never)]
    fn fresh(&self, size: usize) -> *mut u8 {
        // SAFETY: one thread, and the reference ends with this function
        let state = unsafe { &mut *self.state.get() };
        let bytes = (size + 1) * STEP;
        if state.rest_bytes < bytes {
            if state.rest_bytes > 0 {
                // a multiple of the step, and smaller than a piece: it is one of a smaller size
                let left = state.rest.cast::<Free>();
                let list = &mut state.free[state.rest_bytes / STEP - 1];
                // SAFETY: nobody has this piece, and it has room for a pointer at its alignment
                unsafe { left.write(Free { next: *list }) };
                *list = left;
                state.rest_bytes = 0;
            }
            const { assert!(CHUNK.is_multiple_of(STEP) && CHUNK >= LARGEST) };
            let Ok(layout) = Layout::from_size_align(CHUNK, STEP) else {
                return ptr::null_mut();
            };
            // SAFETY: the layout is not empty
            let chunk = unsafe { self.below.alloc(layout) };
            if chunk.is_null() {
                return chunk;
            }
            state.rest = chunk;
            state.rest_bytes = CHUNK;
        }
        let piece = state.rest;
        // SAFETY: the chunk has so many bytes left
        state.rest = unsafe { piece.add(bytes) };
        state.rest_bytes -= bytes;
        piece
    }
}

// SAFETY: pieces are of the size and alignment that are asked for, and nobody else's until they come back
unsafe impl<Below: GlobalAlloc> GlobalAlloc for Pools<Below> {
    #[inline]
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let Some(size) = size_of_layout(layout) else {
            // SAFETY: as the caller promises
            return unsafe { self.below.alloc(layout) };
        };
        // SAFETY: one thread, and a piece in a list is a `Free` that nobody has
        unsafe {
            let list = &raw mut (*self.state.get()).free[size];
            let piece = *list;
            if piece.is_null() {
                return self.fresh(size);
            }
            *list = (*piece).next;
            piece.cast()
        }
    }

    #[inline]
    unsafe fn dealloc(&self, piece: *mut u8, layout: Layout) {
        let Some(size) = size_of_layout(layout) else {
            // SAFETY: a piece of this layout came from there
            return unsafe { self.below.dealloc(piece, layout) };
        };
        // SAFETY: one thread, and the caller gives the piece back
        unsafe {
            let list = &raw mut (*self.state.get()).free[size];
            let piece = piece.cast::<Free>();
            piece.write(Free { next: *list });
            *list = piece;
        }
    }

    #[inline]
    unsafe fn realloc(&self, piece: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        // SAFETY: the caller promises that the size goes with the alignment
        let new = unsafe { Layout::from_size_align_unchecked(new_size, layout.align()) };
        match (size_of_layout(layout), size_of_layout(new)) {
            // SAFETY: a piece of this layout came from there
            (None, None) => unsafe { self.below.realloc(piece, layout, new_size) },
            (Some(now), Some(then)) if now == then => piece,
            // SAFETY: both pieces have the bytes that are copied, and are not the same
            _ => unsafe {
                let moved = self.alloc(new);
                if !moved.is_null() {
                    ptr::copy_nonoverlapping(piece, moved, layout.size().min(new_size));
                    self.dealloc(piece, layout);
                }
                moved
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::alloc::System;

    /// Pieces in use, each filled with a byte of its own.
    struct InUse {
        pools: Pools<System>,
        pieces: Vec<(*mut u8, Layout, u8)>,
    }

    impl InUse {
        fn new() -> Self {
            Self {
                // SAFETY: a test has one thread
                pools: unsafe { Pools::new(System) },
                pieces: Vec::new(),
            }
        }

        fn take(&mut self, layout: Layout, mark: u8) {
            let piece = unsafe { self.pools.alloc(layout) };
            assert!(!piece.is_null() && (piece as usize).is_multiple_of(layout.align()));
            unsafe { piece.write_bytes(mark, layout.size()) };
            self.pieces.push((piece, layout, mark));
        }

        fn check(&self, which: usize) {
            let (piece, layout, mark) = self.pieces[which];
            let bytes = unsafe { std::slice::from_raw_parts(piece, layout.size()) };
            assert!(bytes.iter().all(|byte| *byte == mark));
        }

        fn give_back(&mut self, which: usize) {
            self.check(which);
            let (piece, layout, _) = self.pieces.swap_remove(which);
            unsafe { self.pools.dealloc(piece, layout) };
        }

        fn resize(&mut self, which: usize, size: usize) {
            self.check(which);
            let (piece, layout, mark) = self.pieces[which];
            let piece = unsafe { self.pools.realloc(piece, layout, size) };
            let kept = unsafe { std::slice::from_raw_parts(piece, layout.size().min(size)) };
            assert!(kept.iter().all(|byte| *byte == mark));
            unsafe { piece.write_bytes(mark, size) };
            let layout = Layout::from_size_align(size, layout.align()).unwrap();
            self.pieces[which] = (piece, layout, mark);
        }
    }

    #[test]
    fn no_piece_is_in_use_twice() {
        let mut in_use = InUse::new();
        // xorshift: any sequence does, and it is the same each time
        let mut state = 0x9e37_79b9_7f4a_7c15_u64;
        let mut draw = |below: usize| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            (state >> 33) as usize % below
        };
        for step in 0..200_000 {
            let count = in_use.pieces.len();
            match draw(5) {
                0 | 1 if count > 0 => in_use.give_back(draw(count)),
                2 if count > 0 => in_use.resize(draw(count), 1 + draw(700)),
                _ if count < 3000 => {
                    let align = 1 << draw(7);
                    let size = 1 + draw(if step % 7 == 0 { 5000 } else { 600 });
                    in_use.take(
                        Layout::from_size_align(size, align).unwrap(),
                        draw(256) as u8,
                    );
                }
                _ => in_use.give_back(draw(count)),
            }
        }
        while !in_use.pieces.is_empty() {
            in_use.give_back(0);
        }
    }

    #[test]
    fn a_piece_that_came_back_is_the_next_of_its_size() {
        let mut in_use = InUse::new();
        let layout = |size| Layout::from_size_align(size, 8).unwrap();
        in_use.take(layout(24), 1);
        let first = in_use.pieces[0].0;
        in_use.give_back(0);
        in_use.take(layout(32), 2);
        in_use.take(layout(17), 3);
        assert_ne!(in_use.pieces[0].0, first);
        assert_eq!(in_use.pieces[1].0, first);
    }

    #[test]
    fn the_rest_of_a_chunk_is_not_lost() {
        let mut in_use = InUse::new();
        // 63 steps: 8192 steps of a chunk leave 2
        let layout = Layout::from_size_align(504, 8).unwrap();
        for _ in 0..131 {
            in_use.take(layout, 7);
        }
        let (last_of_the_first, ..) = in_use.pieces[129];
        in_use.take(Layout::from_size_align(16, 8).unwrap(), 8);
        let (rest, ..) = in_use.pieces[131];
        assert_eq!(rest as usize, last_of_the_first as usize + 504);
    }
}
