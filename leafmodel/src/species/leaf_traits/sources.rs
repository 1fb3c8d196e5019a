//! The publications that the table uses. Each was read at the place named; of a paper that is often
//! its abstract.

use super::{Provenance, Quantity, Source, Span};

/// A data set of 276 leaves of 47 taxa; ranges are the extremes of its table of contents.
const ANGERS: &str = "angers2003";

pub(in crate::species) const ANGERS_LEAVES: Source = Source {
    key: ANGERS,
    says: "range of 276 leaves of 47 taxa (ANGERS)",
};

/// Structure of the mesophyll.
pub(super) const fn structure(value: f64) -> Quantity {
    estimate(value, [1.05, 2.71], ANGERS_LEAVES)
}

/// Chlorophyll, chosen by eye.
pub(super) const fn chlorophyll(value: f64) -> Quantity {
    estimate(value, [0.8, 106.7], ANGERS_LEAVES)
}

/// Carotenoids of a green leaf from its chlorophyll: `1.13 + 0.222 C` (r 0.95 over the green leaves
/// of ANGERS).
pub(super) const fn carotenoids(chlorophyll: Quantity) -> Quantity {
    let value = 1.13 + 0.222 * chlorophyll.value;
    Quantity {
        value,
        range: [0.7 * value, 1.3 * value],
        from: Provenance::Fitted(Source {
            key: ANGERS,
            says: "1.13 + 0.222 chlorophyll, a fit to the green leaves of ANGERS (r 0.95); range ours",
        }),
    }
}

pub(super) const fn water(value: f64) -> Quantity {
    estimate(value, [0.0044, 0.034], ANGERS_LEAVES)
}

pub(super) const fn dry_matter(value: f64) -> Quantity {
    estimate(value, [0.0017, 0.033], ANGERS_LEAVES)
}

/// Anthocyanins of a green leaf.
pub(super) const LITTLE_ANTHOCYANIN: Quantity = by_eye(
    0.5,
    [0.0, 2.0],
    "green summer leaves hold little; no figure for the species",
);

pub(in crate::species) const fn estimate(value: f64, range: [f64; 2], source: Source) -> Quantity {
    Quantity {
        value,
        range,
        from: Provenance::Estimate(source),
    }
}

pub(in crate::species) const fn by_eye(value: f64, range: [f64; 2], why: &'static str) -> Quantity {
    Quantity {
        value,
        range,
        from: Provenance::ByEye(why),
    }
}

pub(super) const fn measured(
    value: f64,
    range: [f64; 2],
    key: &'static str,
    says: &'static str,
) -> Quantity {
    Quantity {
        value,
        range,
        from: Provenance::Measured(Source { key, says }),
    }
}

pub(super) const fn related(
    value: f64,
    range: [f64; 2],
    key: &'static str,
    says: &'static str,
) -> Quantity {
    Quantity {
        value,
        range,
        from: Provenance::Relative(Source { key, says }),
    }
}

pub(super) const fn flora(value: f64, range: [f64; 2], source: Source) -> Quantity {
    Quantity {
        value,
        range,
        from: Provenance::Flora(source),
    }
}

pub(super) const fn flora_span(range: [f64; 2], source: Source) -> Span {
    Span {
        range,
        from: Provenance::Flora(source),
    }
}

pub(super) const fn width_by_eye(range: [f64; 2], why: &'static str) -> Span {
    Span {
        range,
        from: Provenance::ByEye(why),
    }
}

/// The thickness of leaves of 64 forest species of the southern Appalachians.
pub(super) const fn thickness(value: f64) -> Quantity {
    estimate(
        value,
        [0.117, 0.474],
        Source {
            key: "appalachian1981",
            says: "range of the leaves of 64 forest species",
        },
    )
}

pub(super) const FNA_POPULUS: Source = Source {
    key: "fna7",
    says: "blade broadly triangular-ovate, 3–9 (–14) × 3–9 (–16.5) cm, width 4/5 to 6/5 of the length",
};
pub(super) const ASPEN_FLORA: Source = Source {
    key: "gleason1991",
    says: "Populus tremuloides: 3–10 cm, rotund-ovate to reniform-cordate, shortly acuminate to apiculate",
};
pub(super) const ACER: Source = Source {
    key: "turkeyflora",
    says: "Acer platanoides: blade 5-lobed, 6–13 × 8–14 cm",
};
pub(super) const QUERCUS_ALBA: Source = Source {
    key: "ps4910",
    says: "obovate to oblong-obovate, 4–8.5 × 2–4.5 inches, 5–9 oblong obtuse lobes",
};
pub(super) const QUERCUS_RUBRA: Source = Source {
    key: "gleason1991",
    says: "10–20 cm, 7–11-lobed, lobes bristle-tipped with a few lateral teeth",
};
pub(super) const GINKGO_FLORA: Source = Source {
    key: "ginkgoweb",
    says: "fan-shaped, 5–8 cm wide at the upper margin (up to 13 × 15 cm on young trees)",
};
pub(super) const BETULA: Source = Source {
    key: "turkeyflora",
    says: "Betula pendula: 3–7 × 2.5–5.5 cm, ovate-deltoid, sharply twice serrate, 6–7 pairs of lateral veins",
};
pub(super) const SALIX: Source = Source {
    key: "gleason1991",
    says: "narrowly lanceolate to lanceolate, 4–10 (–15) × 1–2.5 cm, 7–10 teeth to a centimetre of margin",
};
pub(super) const PRUNUS: Source = Source {
    key: "foc9",
    says: "ovate-elliptic to obovate-elliptic, 2–7 × 1–3.5 cm, 4–7 secondary veins a side",
};
pub(super) const LIQUIDAMBAR: Source = Source {
    key: "britton1913",
    says: "broader than long, 3–9 inches wide, deeply 3–7-lobed, sharply and finely serrate",
};
pub(super) const ALCHEMILLA_FLORA: Source = Source {
    key: "foc9",
    says: "Alchemilla glabra: cordate-orbicular, 3–5 × 6–8 cm, 7–9-lobed and serrulate",
};
pub(super) const HEDERA: Source = Source {
    key: "agrobase",
    says: "shallowly palmately 3–5-lobed, 3–10 cm long and wide",
};
pub(super) const MAGNOLIA_FLORA: Source = Source {
    key: "kpuplants",
    says: "12–25 (–30) × 6–12 cm, ovate-elliptic, thick, glossy",
};
pub(super) const PHRAGMITES: Source = Source {
    key: "sydneyeflora",
    says: "blades 1–3 cm wide (a piece of a blade, as long as it takes)",
};
pub(super) const TRILLIUM_FLORA: Source = Source {
    key: "agstrillium",
    says: "petals 3–8 cm long, broad, white",
};
pub(super) const CODIAEUM: Source = Source {
    key: "foc11",
    says: "very variable, linear to elliptic and obovate, 5–30 × 0.5–8 cm",
};
pub(super) const ACER_SACCHARUM: Source = Source {
    key: "vtdendro",
    says: "Acer saccharum: 3 to 6 inches long, 5 lobes, margin entire",
};
pub(super) const ACER_RUBRUM: Source = Source {
    key: "vtdendro",
    says: "Acer rubrum: 2 to 4 inches long, 3 to 5 lobes, margin serrate, sinuses shallow",
};
pub(super) const COTINUS: Source = Source {
    key: "cotinusfoc",
    says: "broadly elliptic to obovate, 3–8 × 2.5–6 cm, entire, 6–11 pairs of lateral veins",
};
pub(super) const ACER_NEGUNDO: Source = Source {
    key: "hortflora",
    says: "3–5 (7–9) oval, saw-toothed leaflets, each 5–10 cm long",
};
pub(super) const AMARANTHUS: Source = Source {
    key: "amaranthfoc",
    says: "ovate, ovate-rhombic or lanceolate, 4–10 × 2–7 cm, entire or undulate",
};
