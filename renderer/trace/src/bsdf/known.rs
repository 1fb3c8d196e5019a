//! Tables that are worked out once in a process.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What is known so far, by key.
pub(super) struct Known<K, V>(Mutex<Vec<(K, Arc<V>)>>);

impl<K: Copy + PartialEq, V> Known<K, V> {
    pub(super) const fn new() -> Self {
        Self(Mutex::new(Vec::new()))
    }

    /// The value of a key, made if it is not known.
    ///
    /// Nothing is locked while it is made: a thread that waits for others takes up their work, and
    /// may come here again. So two threads may make the same at the same time.
    pub(super) fn get(&self, key: K, make: impl FnOnce() -> V) -> Arc<V> {
        self.find(key).unwrap_or_else(|| {
            let made = Arc::new(make());
            self.entries().push((key, Arc::clone(&made)));
            made
        })
    }

    fn find(&self, key: K) -> Option<Arc<V>> {
        let entries = self.entries();
        let entry = entries.iter().find(|(known, _)| *known == key);
        entry.map(|(_, value)| Arc::clone(value))
    }

    /// A list of finished values is valid even if a thread panicked while it held the lock.
    fn entries(&self) -> MutexGuard<'_, Vec<(K, Arc<V>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::*;

    #[test]
    fn a_value_is_made_while_threads_that_wait_ask_for_it() {
        static KNOWN: Known<usize, usize> = Known::new();
        let pool = rayon::ThreadPoolBuilder::new().num_threads(2).build();
        pool.expect("two threads").install(|| {
            (0..64_usize).into_par_iter().for_each(|number| {
                let sum = KNOWN.get(number % 2, || {
                    // Other items are taken up inside.
                    (0..1000).into_par_iter().with_max_len(1).sum()
                });
                assert_eq!(*sum, 499_500);
            });
        });
        assert_eq!(*KNOWN.get(0, || 7), 499_500, "not made again");
    }
}
