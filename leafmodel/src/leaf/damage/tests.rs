use super::*;
use crate::blade::frame::UvFrame;
use crate::leaf::{Leaf, LeafPlan};
use crate::optics::Constituent;
use crate::species::find;

/// A small leaf with a net, much eaten.
fn eaten() -> LeafPlan {
    let mut plan = find("tertiary").expect("a preset").plan();
    plan.map_size = 300;
    plan.damage = Some(Damage {
        holes: 9,
        hole_mm: 4.0,
        bites: 3,
        bite_mm: 9.0,
        mines: 1,
        blotches: 1,
        ..Damage::default()
    });
    plan
}

#[test]
fn holes_are_holes_of_the_mesh_and_no_vein_leads_through_them() {
    let plan = eaten();
    let leaf = Leaf::grow(&plan).expect("a good plan");
    let lamina = &leaf.lamina;
    assert_eq!(lamina.holes().len(), 9);
    assert_eq!(leaf.mesh.validate_holed(lamina.area(), 9), Ok(()));
    assert_eq!(lamina.network.validate(), Ok(()));
    for vein in lamina.network.segments() {
        for hole in lamina.holes() {
            assert!(!touches(hole, vein.from, vein.to), "{vein:?}");
        }
    }
    let whole = LeafPlan {
        damage: None,
        ..plan.clone()
    };
    let whole = Leaf::grow(&whole).expect("a good plan");
    assert!(whole.lamina.network.edges().len() > lamina.network.edges().len() + 20);
    assert_eq!(lamina.intact(), &whole.lamina.outline);
    assert_eq!(leaf.frame, whole.frame);
    assert_eq!(Leaf::grow(&plan).expect("a good plan"), leaf);
}

#[test]
fn bites_take_area_from_the_margin_and_leave_both_ends() {
    let mut plan = eaten();
    plan.damage = Some(Damage {
        bites: 4,
        ..Damage::default()
    });
    let lamina = plan.grow_lamina().expect("a good plan");
    let (bitten, intact) = (&lamina.outline, lamina.intact());
    let lost = intact.area() - bitten.area();
    // About half discs of 9 mm, some smaller and some greater.
    assert!((40.0..300.0).contains(&lost), "{lost} mm²");
    assert_eq!(
        (bitten.base(), bitten.apex()),
        (intact.base(), intact.apex())
    );
    for node in lamina.network.nodes() {
        let p = node.position;
        assert!(
            bitten.contains(p) || bitten.distance_to_margin(p) < 1e-6,
            "{p}"
        );
    }
}

#[test]
fn tissue_about_holes_and_in_mines_is_dead() {
    let plan = eaten();
    let leaf = Leaf::grow(&plan).expect("a good plan");
    let frame = UvFrame::around(leaf.lamina.intact().points());
    let at = |p: DVec2| {
        let uv = frame.uv(p);
        let map = &leaf.contents;
        let column = (uv.x * f64::from(map.width)) as usize;
        let row = (uv.y * f64::from(map.height)) as usize;
        map.texels[row * map.width as usize + column]
    };
    let green = plan.tissue.lamina.to_texel()[Constituent::Chlorophyll];
    for hole in leaf.lamina.holes() {
        let texel = at(hole[0]);
        assert!(texel[Constituent::Chlorophyll] < 0.5 * green);
        assert!(texel[Constituent::Brown] > 0.3);
    }
    let wounds = leaf.lamina.wounds.as_ref().expect("wounds");
    // A rim for each hole and bite; mines where there is room.
    let rims = leaf.lamina.holes().len() + 3;
    assert!((rims + 1..=rims + 2).contains(&wounds.stains.len()));
}

#[test]
fn without_damage_nothing_changes_and_bad_numbers_are_refused() {
    let mut plan = eaten();
    plan.damage = None;
    let whole = plan.grow_lamina().expect("a good plan");
    plan.damage = Some(Damage::default());
    let lamina = plan.grow_lamina().expect("a good plan");
    assert_eq!(lamina.outline, whole.outline);
    assert_eq!(lamina.network, whole.network);
    plan.damage = Some(Damage {
        bite_mm: -1.0,
        ..Damage::default()
    });
    let message = plan.grow_lamina().expect_err("a bad number").to_string();
    assert_eq!(message, "damage: bite_mm is -1, outside 0.2 to 200");
}
