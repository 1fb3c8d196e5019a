//! What hairs a leaf has.

use crate::document::{Declared, Keys, NamedList, Words};
use crate::optics::contents_keys::changed_contents;
use crate::optics::{Constituent, Contents};

/// Where on a face hairs stand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Words)]
pub enum HairPlace {
    /// Everywhere.
    All,
    /// On the veins that have relief in the mesh.
    Veins,
    /// Between those veins.
    Between,
}

/// One kind of hair on a leaf. Angles are radians.
#[derive(Clone, Debug, Declared, PartialEq)]
pub struct HairPlan {
    /// Its name in the file.
    pub name: String,
    /// Hairs per mm² of the adaxial face. A blade has at most 400 000 of one kind.
    #[key("adaxial_per_mm2", 0.0..=1000.0)]
    pub adaxial_per_mm2: f64,
    /// Hairs per mm² of the abaxial face.
    #[key("abaxial_per_mm2", 0.0..=1000.0)]
    pub abaxial_per_mm2: f64,
    /// Hairs per mm of the margin, which point outwards.
    #[key("fringe_per_mm", 0.0..=1000.0)]
    pub fringe_per_mm: f64,
    /// Where on the faces: everywhere, on the veins that the mesh has, or between them.
    #[key("place", word)]
    pub place: HairPlace,
    /// Mean length.
    #[key("hair_mm", 0.005..=50.0)]
    pub length_mm: f64,
    /// Share by which lengths vary to either side.
    #[key("length_spread", 0.0..=1.0)]
    pub length_spread: f64,
    /// Diameter at the foot; hairs taper to a point.
    #[key("diameter_um", 1.0..=500.0)]
    pub diameter_um: f64,
    /// Angle at the foot from upright (at the margin, from straight outwards) towards the apex.
    ///
    /// Radians.
    #[key("lean_deg", degrees(0.0..=89.0))]
    pub lean: f64,
    /// Angle through which a hair bends further; it never bends into the face.
    ///
    /// Radians.
    #[key("bend_deg", degrees(0.0..=120.0))]
    pub bend: f64,
    /// How far the direction of lean strays from that to the apex: 180 is any.
    ///
    /// Radians.
    #[key("stray_deg", degrees(0.0..=180.0))]
    pub stray: f64,
    /// What the wall of a hair holds; left out, nothing: dry hairs are white.
    #[key("contents", block, with = changed_contents)]
    pub contents: Contents,
}

impl HairPlan {
    /// The default: no hairs.
    pub(crate) fn usual(name: &str) -> Self {
        // The wall of a dry hair, which is filled with air: white.
        let dry = Contents::NOTHING.with(&[(Constituent::Structure, 1.5)]);
        Self {
            name: name.to_owned(),
            adaxial_per_mm2: 0.0,
            abaxial_per_mm2: 0.0,
            fringe_per_mm: 0.0,
            place: HairPlace::All,
            length_mm: 0.5,
            length_spread: 0.3,
            diameter_um: 15.0,
            lean: 45_f64.to_radians(),
            bend: 20_f64.to_radians(),
            stray: 30_f64.to_radians(),
            contents: dry,
        }
    }

    /// All kinds of hair of a leaf.
    pub(crate) fn kinds(hairs: &mut Vec<Self>, keys: &mut Keys<'_>) {
        let list = NamedList {
            required: false,
            new: &Self::usual,
            name_of: |hair: &Self| &hair.name,
        };
        let about = "Hairs of one kind.";
        keys.named("hairs", hairs, &list, about, Self::declare);
    }
}
