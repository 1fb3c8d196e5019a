//! Which random numbers belong to which decision of a walk.
//!
//! A [`Stream`](super::stream::Stream) gives sets of four numbers. Each kind of decision owns a range
//! of sets, used or not, so that no decision shifts or repeats the numbers of another. All ranges are
//! listed here. A walk that begins within another one, as that of light which excites fluorescence,
//! has a stream of its own ([`Stream::nested`](super::stream::Stream::nested)), in which all sets are
//! free again.

/// Most events of a walk that `integrator.max_events` may allow.
pub const MOST_EVENTS: u32 = 1_000_000;
/// Faces of one leaf of layers that have sets of their own; later ones share those of the last.
pub const FACES: u32 = 64;

/// A range of sets of random numbers: `each` of them for each of `count` decisions.
#[derive(Clone, Copy, Debug)]
pub struct Sets {
    first: u32,
    each: u32,
    count: u32,
}

impl Sets {
    const fn new(first: u32, each: u32, count: u32) -> Self {
        Self { first, each, count }
    }

    /// The first set of decision number `number`. Decisions beyond the last one share its sets.
    #[inline]
    pub fn of(self, number: u32) -> u32 {
        self.first + self.each * number.min(self.count - 1)
    }
}

/// Declares the ranges of a kind of walk: first set, sets for each decision, number of decisions.
macro_rules! ranges {
    ($(#[$of:meta])* $walk:ident: $($(#[$about:meta])* $name:ident = $first:expr, $each:expr, $count:expr;)*) => {
        $(#[$of])*
        pub mod $walk {
            #[allow(unused_imports, reason = "not every walk has events without end, or faces")]
            use super::{FACES, MOST_EVENTS, Sets};

            $($(#[$about])* pub const $name: Sets = Sets::new($first, $each, $count);)*

            #[cfg(test)]
            pub(super) const ALL: &[(&str, Sets)] = &[$((stringify!($name), $name)),*];
        }
    };
}

ranges! {
    /// Walks from the camera on.
    picture:
    /// The place on the film, and that on the lens or the wavelengths.
    PLACE = 0, 1, 1;
    /// The wavelengths, if the place on a lens has taken their number.
    WAVELENGTHS = 1, 1, 1;
    /// Suns at the first vertex, if paths may branch there.
    FIRST_SUNS = 2, 1, 1;
    /// A vertex: one set for the bounce, one for the chosen light.
    VERTEX = 3, 2, MOST_EVENTS;
    /// A flight through a medium.
    FLIGHT = 1 << 24, 1, 1 << 24;
    /// Lights at a face of a leaf of layers that a walk meets from inside, by the numbers of its
    /// vertex and of the face: as those of a vertex.
    FACE = 1 << 30, 2, FACES * MOST_EVENTS;
}

ranges! {
    /// The beginning of walks of light that excites fluorescence, at the leaf: in place of the
    /// camera's sets. Behind it their sets are those of a picture.
    excitation:
    /// Whether there is one, its wavelengths and the face that is lit.
    START = 0, 1, 1;
    /// The bounce and the chosen light at the leaf.
    LEAF = 1, 2, 1;
}

ranges! {
    /// Walks from the light of an instrument on, and those of light that a leaf emits in it.
    instrument:
    /// The ray with which it starts.
    START = 0, 1, 1;
    /// What scatters it on a surface.
    EVENT = 1, 1, MOST_EVENTS;
    /// A flight to the next surface or event in a medium, and the roulette there.
    FLIGHT = 1 << 24, 2, 1 << 23;
    /// What a detector sees of an event.
    DETECTOR = 1 << 25, 1, MOST_EVENTS;
    /// Which wavelengths of a spectrum the light has.
    PACKET = 1 << 30, 1, 1;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_set_of_random_numbers_belongs_to_two_kinds_of_decisions() {
        let behind = |sets: &Sets| sets.first >= picture::VERTEX.first;
        let behind = picture::ALL.iter().filter(|(_, sets)| behind(sets));
        let excitation: Vec<_> = excitation::ALL.iter().chain(behind).copied().collect();
        for walk in [picture::ALL, &excitation, instrument::ALL] {
            let mut ranges: Vec<(u64, u64, &str)> = walk
                .iter()
                .map(|(name, sets)| {
                    let first = u64::from(sets.first);
                    let length = u64::from(sets.each) * u64::from(sets.count);
                    (first, first + length, *name)
                })
                .collect();
            ranges.sort_unstable();
            for pair in ranges.windows(2) {
                assert!(pair[0].1 <= pair[1].0, "{} and {}", pair[0].2, pair[1].2);
            }
            let (_, end, name) = ranges.last().expect("a walk takes random numbers");
            assert!(*end <= 1 << 32, "{name} goes beyond the last set");
        }
    }

    #[test]
    fn decisions_beyond_the_last_share_its_sets() {
        let sets = Sets::new(10, 2, 3);
        assert_eq!(
            [0, 1, 2, 3, u32::MAX].map(|number| sets.of(number)),
            [10, 12, 14, 14, 14]
        );
    }
}
