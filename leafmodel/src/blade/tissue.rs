//! Contents of the tissue at every point of the lamina.

use super::vein_body::VeinBody;
use super::vein_cover::VeinCover;
use crate::document::{Keys, Limits, Number, RangeError};
use crate::optics::contents_keys::contents;
use crate::optics::{Constituent, Contents, VeinFactors};

/// Contents between veins, and factors on them in veins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tissue {
    /// Contents of the lamina between veins.
    pub lamina: Contents,
    /// Factors on these contents in veins; structure stays at least 1.
    pub vein_factors: VeinFactors,
    /// What thick veins are made of. Without it the surplus of structure, water and dry matter
    /// follows from the factors and grows with the radius over `full_vein_radius_mm`.
    pub vein_body: Option<VeinBody>,
    /// Radius, mm, from which a vein counts as fully developed. The factors act only partly on
    /// finer veins.
    pub full_vein_radius_mm: f64,
    /// Width, mm, over which a vein's edge (bundle sheath extension) blends into the lamina, > 0.
    pub sheath_width_mm: f64,
    /// Share by which chlorophyll and carotenoids vary from patch to patch, 0 to 1.
    pub mottle: f64,
    /// Size of those patches, mm, > 0.
    pub mottle_scale_mm: f64,
}

impl Tissue {
    /// Default size of patches, mm.
    pub const MOTTLE_SCALE_MM: f64 = 1.0;

    /// Tissue with these contents, the usual veins and no mottle.
    pub fn of(lamina: Contents) -> Self {
        Self {
            lamina,
            vein_factors: VeinFactors::default(),
            vein_body: None,
            full_vein_radius_mm: 0.06,
            sheath_width_mm: 0.1,
            mottle: 0.0,
            mottle_scale_mm: Self::MOTTLE_SCALE_MM,
        }
    }
}

/// What the mottle varies, and what makes tissue green.
const GREENS: [Constituent; 2] = [Constituent::Chlorophyll, Constituent::Carotenoids];

impl Tissue {
    /// The keys of `veins` and `mottle`.
    pub(crate) fn keys_of_veins(&mut self, keys: &mut Keys<'_>) {
        let tissue = self;
        let about = "Factors on the contents over the middle of a thick vein.";
        keys.block("veins", about, |keys| {
        let limits = Number(Limits::closed(0.0, VeinFactors::MOST));
        for (constituent, factor) in tissue.vein_factors.iter_mut() {
            let about = "Factor on this content over a fully developed vein.";
            keys.key(constituent.name(), factor, limits, about);
        }
        let limits = Number(Limits::closed(0.001, 100.0));
        let about = "Radius from which a vein has the whole factors; finer ones take part of \
            them.";
        keys.key(
            "full_radius_mm",
            &mut tissue.full_vein_radius_mm,
            limits,
            about,
        );
        let limits = Number(Limits::closed(0.001, 5.0));
        let about = "Width over which a vein blends into the lamina.";
        keys.key(
            "sheath_width_mm",
            &mut tissue.sheath_width_mm,
            limits,
            about,
        );
        let about = "What thick veins are made of: a vein thicker than the blade holds this for \
            each thickness of the blade that it is thicker. Left out, the surplus follows from the \
            factors.";
        let body = &mut tissue.vein_body;
        keys.optional_block(
            "body",
            body,
            || VeinBody::USUAL,
            about,
            |body, keys| {
                let limits = Number(Limits::closed(0.0, VeinBody::MOST));
                for (constituent, share) in body.shares.iter_mut() {
                    let about =
                        "Share of what the blade between veins holds in the same thickness.";
                    keys.key(constituent.name(), share, limits, about);
                }
            },
        );
    });
        let mut mottle = (tissue.mottle != 0.0
            || tissue.mottle_scale_mm != Tissue::MOTTLE_SCALE_MM)
            .then_some((tissue.mottle, tissue.mottle_scale_mm));
        let new = || (0.0, Tissue::MOTTLE_SCALE_MM);
        let about = "Chlorophyll and carotenoids vary from patch to patch.";
        keys.optional_block(
            "mottle",
            &mut mottle,
            new,
            about,
            |(share, scale_mm), keys| {
                let limits = Number(Limits::closed(0.0, 1.0));
                keys.required("share", share, limits, "How far they vary.");
                let limits = Number(Limits::closed(0.01, 1000.0));
                keys.key("scale_mm", scale_mm, limits, "Size of patches.");
            },
        );
        (tissue.mottle, tissue.mottle_scale_mm) = mottle.unwrap_or(new());
    }

    /// Checks that every field is in its range. Upper limits are far above the values of leaves;
    /// they keep results finite in single precision and the search for veins local.
    ///
    /// # Errors
    ///
    /// [`RangeError`] for the first field out of range.
    pub fn validate(&self) -> Result<(), RangeError> {
        let mut own = *self;
        let errors = Keys::check(|keys| {
            let held = &mut own.lamina;
            keys.block("contents", "", |keys| contents(held, keys));
            own.keys_of_veins(keys);
        });
        if let Some(error) = errors.into_iter().next() {
            return Err(error);
        }
        let blade_mm = self.vein_body.map_or(0.2, |body| body.blade_mm);
        let valid = (0.001..=10.0).contains(&blade_mm);
        RangeError::unless(valid, "vein_body.blade_mm", blade_mm, "0.001 to 10")
    }

    /// Contents where veins cover the lamina as `cover` says and the mottle has the value `mottle`,
    /// in [−1, 1].
    ///
    /// Each of the contents is `C (1 + (f − 1) w)`, with its value `C` between veins, its factor
    /// `f` and the veins' weight `w`. Structure, water and dry matter with `f > 1` are
    /// `C (1 + (f − 1)(w + e))`: their surplus grows with a vein's thickness, so with its radius
    /// (`e`, [`VeinCover::excess`]), whereas pigment contents do not. With a [`VeinBody`] it is
    /// `C (1 + (f − 1) w + b e)` for all of them, with the body's share `b`. Chlorophyll and carotenoids
    /// have [`VeinCover::greens`] for `w` and are multiplied by `1 + mottle share × mottle`. Structure
    /// is at least 1, the others at least 0.
    #[must_use]
    pub fn contents(&self, cover: VeinCover, mottle: f64) -> Contents {
        self.contents_of(self.lamina, cover, mottle)
    }

    /// As [`Tissue::contents`] where the tissue between veins holds `lamina`.
    #[must_use]
    pub(crate) fn contents_of(&self, lamina: Contents, cover: VeinCover, mottle: f64) -> Contents {
        let patch = 1.0 + self.mottle * mottle;
        let mut contents = lamina;
        for (constituent, value) in contents.iter_mut() {
            let factor = self.vein_factors[constituent];
            let thick = constituent.is_bulk() && factor > 1.0;
            let is_green = GREENS.contains(&constituent);
            let weight = if is_green { cover.greens } else { cover.weight };
            let body = self.vein_body.as_ref();
            *value *= if let Some(body) = body {
                1.0 + (factor - 1.0) * weight + body.shares[constituent] * cover.excess
            } else {
                let share = weight + if thick { cover.excess } else { 0.0 };
                1.0 + (factor - 1.0) * share
            };
            if is_green {
                *value *= patch;
            }
            // A factor of 0 at full weight may round to slightly below 0.
            *value = value.max(constituent.least());
        }
        contents
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    /// A thin green broad leaf, bright veins.
    pub(in crate::blade) const GREEN: Tissue = Tissue {
        lamina: Contents::of(&[
            (Constituent::Structure, 1.5),
            (Constituent::Chlorophyll, 40.0),
            (Constituent::Carotenoids, 9.0),
            (Constituent::Anthocyanins, 0.5),
            (Constituent::Brown, 0.01),
            (Constituent::Water, 0.01),
            (Constituent::DryMatter, 0.006),
        ]),
        vein_factors: VeinFactors::of(&[
            (Constituent::Structure, 1.3),
            (Constituent::Chlorophyll, 0.25),
            (Constituent::Carotenoids, 0.25),
            (Constituent::Water, 2.0),
            (Constituent::DryMatter, 2.5),
        ]),
        vein_body: None,
        full_vein_radius_mm: 0.25,
        sheath_width_mm: 0.1,
        mottle: 0.0,
        mottle_scale_mm: 1.0,
    };

    const LAMINA_ONLY: VeinCover = VeinCover::NONE;
    const FULL: VeinCover = VeinCover::of(1.0, 0.0);

    #[test]
    fn each_field_out_of_range_is_refused_by_name() {
        type Set = fn(&mut Tissue, f64);
        let others: [(&str, Set, [f64; 2]); 4] = [
            (
                "veins.full_radius_mm",
                |t, x| t.full_vein_radius_mm = x,
                [0.0, 101.0],
            ),
            (
                "veins.sheath_width_mm",
                |t, x| t.sheath_width_mm = x,
                [0.0, 5.001],
            ),
            ("mottle.share", |t, x| t.mottle = x, [-0.01, 1.01]),
            (
                "mottle.scale_mm",
                |t, x| t.mottle_scale_mm = x,
                [0.0, 1001.0],
            ),
        ];
        let mut broken = Vec::new();
        for (field, set, [low, high]) in others {
            for bad in [low, high, f64::NAN, f64::INFINITY] {
                let mut tissue = GREEN;
                set(&mut tissue, bad);
                broken.push((tissue, field.to_owned()));
            }
        }
        for constituent in Constituent::ALL {
            for bad in [-0.001, 1e7, f64::NAN, f64::INFINITY] {
                let mut tissue = GREEN;
                tissue.lamina[constituent] = bad;
                broken.push((tissue, format!("contents.{}", constituent.key())));
                let mut tissue = GREEN;
                tissue.vein_factors[constituent] = bad;
                broken.push((tissue, format!("veins.{}", constituent.name())));
            }
        }
        assert_eq!(GREEN.validate(), Ok(()));
        for (tissue, field) in broken {
            let error = tissue.validate().expect_err("a field is out of range");
            assert_eq!(error.path, field, "{error}");
        }
    }

    #[test]
    fn a_refusal_names_field_value_and_range() {
        let tissue = Tissue {
            sheath_width_mm: -0.5,
            ..GREEN
        };
        let message = tissue.validate().expect_err("negative").to_string();
        assert_eq!(message, "veins.sheath_width_mm is -0.5, outside 0.001 to 5");
    }

    #[test]
    fn between_veins_there_is_exactly_the_lamina() {
        assert_eq!(GREEN.contents(LAMINA_ONLY, 0.7), GREEN.lamina);
    }

    #[test]
    fn a_full_vein_holds_the_lamina_times_its_factors() {
        for (constituent, value) in *GREEN.contents(FULL, 0.0) {
            let expected = GREEN.lamina[constituent] * GREEN.vein_factors[constituent];
            assert!(
                (value - expected).abs() <= 1e-15 * expected,
                "{value} {expected}"
            );
        }
    }

    #[test]
    fn thickness_adds_bulk_and_leaves_pigments_alone() {
        let thick = VeinCover::of(1.0, 3.0);
        let (full, thick) = (GREEN.contents(FULL, 0.0), GREEN.contents(thick, 0.0));
        let surplus = |contents: Contents| {
            contents[Constituent::DryMatter] - GREEN.lamina[Constituent::DryMatter]
        };
        assert!((surplus(thick) - 4.0 * surplus(full)).abs() < 1e-15);
        assert!(
            thick[Constituent::Water] > full[Constituent::Water]
                && thick[Constituent::Structure] > full[Constituent::Structure]
        );
        assert_eq!(
            thick[Constituent::Chlorophyll],
            full[Constituent::Chlorophyll]
        );
        // Contents with a factor below 1 do not become negative in thick veins.
        let mut dry = GREEN;
        dry.vein_factors[Constituent::Water] = 0.0;
        let drained = dry.contents(VeinCover::of(1.0, 3.0), 0.0);
        assert_eq!(drained[Constituent::Water], 0.0);
    }

    #[test]
    fn a_body_adds_its_share_of_everything_for_each_layer() {
        let tissue = Tissue {
            vein_body: Some(VeinBody::USUAL),
            ..GREEN
        };
        let thick = VeinCover::of(1.0, 3.0);
        let (full, thick) = (tissue.contents(FULL, 0.0), tissue.contents(thick, 0.0));
        assert_eq!(full, GREEN.contents(FULL, 0.0));
        for (constituent, share) in VeinBody::USUAL.shares {
            let added = thick[constituent] - full[constituent];
            let expected = 3.0 * share * GREEN.lamina[constituent];
            assert!((added - expected).abs() < 1e-12, "{constituent:?}");
        }
    }

    #[test]
    fn fewer_plates_than_one_become_one() {
        let mut tissue = GREEN;
        tissue.vein_factors[Constituent::Structure] = 0.0;
        assert_eq!(tissue.contents(FULL, 0.0)[Constituent::Structure], 1.0);
    }

    #[test]
    fn the_mottle_varies_chlorophyll_and_carotenoids_alone() {
        let tissue = Tissue {
            mottle: 0.2,
            ..GREEN
        };
        let patch = tissue.contents(LAMINA_ONLY, -0.5);
        let mut expected = GREEN.lamina;
        expected[Constituent::Chlorophyll] *= 0.9;
        expected[Constituent::Carotenoids] *= 0.9;
        assert_eq!(patch, expected);
    }
}
