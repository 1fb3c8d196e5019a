//! `damage`: what has been eaten or torn of a leaf, and what has died.

use crate::document::keys::Keys;
use crate::document::limits::Limits;
use crate::document::value_kind::{Integer, Number};
use crate::leaf::damage::{Damage, Dieback};

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
    let about = "Median length of tears; less where a thick vein stops them.";
    number("tear_mm", &mut damage.tear_mm, 0.5, 500.0, about);
    let about = "Width of their mouths over their length.";
    number("tear_gape", &mut damage.tear_gape, 0.005, 0.5, about);
    let about = "Height by which one lip stands above the blade at the mouth, and the other below \
        it, over their length.";
    number("tear_lift", &mut damage.tear_lift, 0.0, 0.3, about);
    let about = "Width of the brown rim about holes, bites and tears.";
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
    let about = "Tears from the margin inwards along the veins; fewer where there is no room.";
    count("tears", &mut damage.tears, 100, about);
    let about = "Tissue that has died from the margin inwards.";
    keys.optional_block(
        "dieback",
        &mut damage.dieback,
        Dieback::default,
        about,
        dieback,
    );
}

/// The keys of `damage.dieback`.
fn dieback(value: &mut Dieback, keys: &mut Keys<'_>) {
    let number = |least, most| Number(Limits::closed(least, most));
    let about = "Share of the blade that is dead.";
    keys.required("share", &mut value.share, number(0.0, 0.95), about);
    let about = "Where it began: 0 alike along the margin, 1 at the tip alone.";
    keys.key("from_tip", &mut value.from_tip, number(0.0, 2.0), about);
    let about = "Speed of the front in veins of the first two orders over that between them: below \
        1 green is left along the veins, above 1 the brown runs ahead in them.";
    keys.key(
        "vein_speed",
        &mut value.vein_speed,
        number(0.1, 10.0),
        about,
    );
    let about = "How uneven the front is.";
    keys.key("unevenness", &mut value.unevenness, number(0.0, 1.0), about);
    let about = "Width of the yellow rim ahead of it.";
    keys.key("rim_mm", &mut value.rim_mm, number(0.0, 20.0), about);
}
