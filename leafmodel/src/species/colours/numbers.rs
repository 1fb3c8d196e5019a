//! The sources of the numbers of coloured leaves.

use super::super::leaf_traits::sources::{ANGERS_LEAVES, by_eye, estimate};
use super::super::leaf_traits::{Provenance, Quantity, Source};

/// Contents fitted to the spectra of one leaf of a related species.
const FITTED: Source = Source {
    key: "noda2014",
    says: "to reflectance and transmittance of one yellow leaf of a relative in Japan; range ours, 30 % about the fit",
};

/// Reason given for pigments chosen by eye.
const LOOKS: &str = "so much that it looks like the plant; nothing per area was found";

/// The remaining chlorophyll of a leaf that has turned, among the lowest values of ANGERS.
pub(super) const fn last_chlorophyll(value: f64) -> Quantity {
    estimate(value, [0.8, 10.0], ANGERS_LEAVES)
}

/// Carotenoids of a leaf that has turned.
pub(super) const fn last_carotenoids(value: f64) -> Quantity {
    estimate(value, [0.0, 25.3], ANGERS_LEAVES)
}

/// Anthocyanins, which no source at hand gives per area of an autumn leaf.
pub(super) const fn red(value: f64, range: [f64; 2]) -> Quantity {
    by_eye(value, range, LOOKS)
}

/// Betaxanthins, which no source at hand gives per area or weight of a leaf.
pub(super) const fn betaxanthin(value: f64) -> Quantity {
    by_eye(value, [1.0, 20.0], LOOKS)
}

/// Brown pigments of living tissue; without them a yellow leaf looks lemon yellow.
pub(super) const fn browned(value: f64) -> Quantity {
    by_eye(
        value,
        [0.0, 0.37],
        "up to what was fitted to yellow leaves of birch and oak; less where leaves are clear",
    )
}

/// Fitted to measured spectra.
pub(super) const fn fitted(value: f64) -> Quantity {
    Quantity {
        value,
        range: [0.7 * value, 1.3 * value],
        from: Provenance::Fitted(FITTED),
    }
}

/// Measured on one such leaf.
pub(super) const fn one_leaf(value: f64, says: &'static str) -> Quantity {
    Quantity {
        value,
        range: [0.8 * value, 1.2 * value],
        from: Provenance::Measured(Source {
            key: "angers2003",
            says,
        }),
    }
}

/// Chosen within the range of ANGERS.
pub(super) const fn angers(value: f64, range: [f64; 2]) -> Quantity {
    estimate(value, range, ANGERS_LEAVES)
}

/// Betacyanins per area.
pub(super) const fn betacyanin(value: f64) -> Quantity {
    estimate(
        value,
        [1.2, 34.0],
        Source {
            key: "cai2001",
            says: "0.08 to 1.36 mg of betacyanins per g of fresh weight over 37 species of Amaranthaceae; 15 to 25 mg of that per cm² assumed",
        },
    )
}

/// Contents of litter.
pub(super) const fn litter(value: f64, range: [f64; 2]) -> Quantity {
    by_eye(value, range, "a dry leaf; no figure for the species")
}

/// Days of ageing, by eye.
pub(super) const fn days(value: f64, range: [f64; 2]) -> Quantity {
    by_eye(value, range, "so that the leaf looks like the plant")
}
