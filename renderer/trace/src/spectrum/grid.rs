//! The wavelengths of paths, and the sets of them from which a picture draws.

/// Number of sets of wavelengths from which the paths of a picture choose; of each group of bands.
pub const ROWS: usize = 256;

/// Marks wavelengths that are in no row of the picture's grid.
const NO_ROW: u32 = u32::MAX;

/// The wavelengths of one path, nm.
#[derive(Clone, Copy, Debug)]
pub struct Wavelengths<const N: usize> {
    /// A vacuum wavelength for each lane, nm.
    pub nm: [f32; N],
    pub(super) row: u32,
}

impl<const N: usize> Wavelengths<N> {
    /// Arbitrary wavelengths, nm, at which spectra are evaluated directly, not looked up.
    pub fn new(nm: [f32; N]) -> Self {
        Self { nm, row: NO_ROW }
    }

    /// Their row in the picture's grid; a number beyond all rows if they are not of the grid.
    #[inline]
    pub(super) fn row(&self) -> usize {
        self.row as usize
    }
}

/// A wavelength and the part of the range that it represents.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// The wavelength, nm.
    pub nm: f32,
    /// Where its part begins and ends, nm; both are the same if it represents itself alone.
    pub edges_nm: [f64; 2],
}

impl Share {
    /// A wavelength that represents itself alone, nm.
    pub fn only(nm: f32) -> Self {
        Self {
            nm,
            edges_nm: [f64::from(nm); 2],
        }
    }

    /// A wavelength in the middle of a part of this width, nm.
    pub fn around(nm: f64, width_nm: f64) -> Self {
        Self {
            nm: nm as f32,
            edges_nm: [nm - 0.5 * width_nm, nm + 0.5 * width_nm],
        }
    }
}

/// The sets of wavelengths of a picture, or of instruments.
#[derive(Clone, Debug)]
pub struct WavelengthGrid {
    pub(super) lanes: usize,
    /// Wavelengths by row and lane, nm.
    pub(super) nm: Box<[f32]>,
    /// Ends of the part of the range that each represents, nm; empty if each represents itself.
    edges_nm: Box<[[f64; 2]]>,
}

impl WavelengthGrid {
    pub(super) fn new(
        lanes: usize,
        groups: usize,
        mut share: impl FnMut(usize, usize) -> Share,
    ) -> Self {
        let places = (0..groups * ROWS).flat_map(|row| (0..lanes).map(move |lane| (row, lane)));
        let shares: Vec<Share> = places.map(|(row, lane)| share(row, lane)).collect();
        Self {
            lanes,
            nm: shares.iter().map(|share| share.nm).collect(),
            edges_nm: shares.iter().map(|share| share.edges_nm).collect(),
        }
    }

    /// A wavelength with the part of the range that it represents.
    pub fn share(&self, row: usize, lane: usize) -> Share {
        let place = row * self.lanes + lane;
        let nm = self.nm[place];
        let edges_nm = self.edges_nm.get(place);
        edges_nm.map_or(Share::only(nm), |&edges_nm| Share { nm, edges_nm })
    }

    /// Sets of given wavelengths, nm, of `lanes` each; their number is a multiple of `lanes`.
    pub(super) fn of_sets(lanes: usize, nm: Vec<f32>) -> Self {
        debug_assert!(nm.len().is_multiple_of(lanes), "sets are whole");
        Self {
            lanes,
            nm: nm.into(),
            edges_nm: Box::default(),
        }
    }

    /// All wavelengths with the parts of the range that they represent, row by row.
    pub fn shares(&self) -> impl Iterator<Item = Share> + '_ {
        let places = 0..self.nm.len();
        places.map(|place| self.share(place / self.lanes, place % self.lanes))
    }

    /// The set with this number.
    ///
    /// # Panics
    ///
    /// If `N` is not the number of lanes, or there is no such set.
    #[inline]
    pub fn set<const N: usize>(&self, row: usize) -> Wavelengths<N> {
        assert_eq!(
            N, self.lanes,
            "paths carry as many wavelengths as the grid has lanes"
        );
        let mut nm = [0.0; N];
        nm.copy_from_slice(&self.nm[row * N..][..N]);
        Wavelengths {
            nm,
            row: row as u32,
        }
    }

    /// Number of sets.
    pub fn rows(&self) -> usize {
        self.nm.len() / self.lanes
    }

    /// Number of wavelengths in a set.
    pub fn lanes(&self) -> usize {
        self.lanes
    }

    /// The wavelengths, row by row, nm.
    pub fn nm(&self) -> &[f32] {
        &self.nm
    }
}
