//! `hairs.NAME`: one kind of hair on a leaf.

use super::contents::changed_contents;
use crate::blade::hairs::{HairPlace, HairPlan};
use crate::document::keys::{Keys, NamedList};
use crate::document::limits::Limits;
use crate::document::value_kind::{Degrees, Number, Word};
use crate::optics::{Constituent, Contents};

/// The wall of a dry hair, which is filled with air: white.
const DRY_WALL: Contents = Contents::NOTHING;

/// All kinds of hair of a leaf.
pub(super) fn hairs(hairs: &mut Vec<HairPlan>, keys: &mut Keys<'_>) {
    let list = NamedList {
        required: false,
        new: &|name: &str| usual(name),
        name_of: |hair: &HairPlan| &hair.name,
    };
    let about = "Hairs of one kind.";
    keys.named("hairs", hairs, &list, about, hair);
}

/// Hairs of which nothing is said: there are none.
pub(super) fn usual(name: &str) -> HairPlan {
    HairPlan {
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
        contents: DRY_WALL.with(&[(Constituent::Structure, 1.5)]),
    }
}

fn hair(hair: &mut HairPlan, keys: &mut Keys<'_>) {
    let density = Number(Limits::closed(0.0, 1000.0));
    let about = "Hairs per mm² of the adaxial face. A blade has at most 400 000 of one kind.";
    keys.key("adaxial_per_mm2", &mut hair.adaxial_per_mm2, density, about);
    let about = "Hairs per mm² of the abaxial face.";
    keys.key("abaxial_per_mm2", &mut hair.abaxial_per_mm2, density, about);
    let about = "Hairs per mm of the margin, which point outwards.";
    keys.key("fringe_per_mm", &mut hair.fringe_per_mm, density, about);
    let places = [
        ("all", HairPlace::All),
        ("veins", HairPlace::Veins),
        ("between", HairPlace::Between),
    ];
    let about = "Where on the faces: everywhere, on the veins that the mesh has, or between them.";
    keys.key("place", &mut hair.place, Word(&places), about);
    let limits = Number(Limits::closed(0.005, 50.0));
    keys.key("hair_mm", &mut hair.length_mm, limits, "Mean length.");
    let limits = Number(Limits::closed(0.0, 1.0));
    let about = "Share by which lengths vary to either side.";
    keys.key("length_spread", &mut hair.length_spread, limits, about);
    let limits = Number(Limits::closed(1.0, 500.0));
    let about = "Diameter at the foot; hairs taper to a point.";
    keys.key("diameter_um", &mut hair.diameter_um, limits, about);
    let limits = Degrees(Limits::closed(0.0, 89.0));
    let about = "Angle at the foot from upright (at the margin, from straight outwards) towards \
        the apex.";
    keys.key("lean_deg", &mut hair.lean, limits, about);
    let limits = Degrees(Limits::closed(0.0, 120.0));
    let about = "Angle through which a hair bends further; it never bends into the face.";
    keys.key("bend_deg", &mut hair.bend, limits, about);
    let limits = Degrees(Limits::closed(0.0, 180.0));
    let about = "How far the direction of lean strays from that to the apex: 180 is any.";
    keys.key("stray_deg", &mut hair.stray, limits, about);
    let held = &mut hair.contents;
    let about = "What the wall of a hair holds; left out, nothing: dry hairs are white.";
    keys.block("contents", about, |keys| changed_contents(held, keys));
}
