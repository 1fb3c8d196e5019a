//! `damage`: what has been eaten of a leaf.

use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Integer, Number};
use crate::leaf::damage::Damage;

/// The keys of `damage`.
pub(super) fn damage(damage: &mut Damage, keys: &mut Keys<'_>) {
    let mut number = |name, value: &mut f64, least, most, about| {
        keys.key(name, value, Number(Limits::closed(least, most)), about);
    };
    let about = "Median diameter of holes.";
    number("hole_mm", &mut damage.hole_mm, 0.1, 100.0, about);
    let about = "Median width of bites.";
    number("bite_mm", &mut damage.bite_mm, 0.2, 200.0, about);
    let about = "Median width of winding mines at their end; they begin at a fifth of it.";
    number("mine_mm", &mut damage.mine_mm, 0.1, 20.0, about);
    let about = "Median length of winding mines; less where there is no room.";
    number(
        "mine_length_mm",
        &mut damage.mine_length_mm,
        1.0,
        1000.0,
        about,
    );
    let about = "Median diameter of blotch mines.";
    number("blotch_mm", &mut damage.blotch_mm, 0.2, 100.0, about);
    let about = "Width of the brown rim about holes and bites.";
    number("rim_mm", &mut damage.rim_mm, 0.0, 10.0, about);
    let mut count = |name, value: &mut u32, most, about| {
        keys.key(name, value, Integer::within(0, most), about);
    };
    let about = "Holes between the larger veins; fewer where there is no room.";
    count("holes", &mut damage.holes, 200, about);
    let about = "Bites from the margin.";
    count("bites", &mut damage.bites, 100, about);
    let about = "Winding mines: tissue eaten between the two faces.";
    count("mines", &mut damage.mines, 50, about);
    count("blotches", &mut damage.blotches, 50, "Blotch mines.");
}
