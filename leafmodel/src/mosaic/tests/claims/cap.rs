//! Fig. 13: the cap of a fly agaric.

use glam::{DVec2, DVec3};

use crate::mosaic::shapes::lathe::lathe;

use super::super::statistics::neighbourhood;
use super::{Row, Seen, surface};
use crate::mosaic::{ControlImage, CylinderControl, Mosaic, MosaicPlan, Steered};

/// The warts' cells divide every 6, 8 and 20 days.
const CAP: Row = Row {
    cells: 6000,
    days: 20.0,
    radius_weight: 3.0,
    adhesion: [0.7, 0.9],
    division: [8.0, 8.0],
    foreground: 0.025,
    switching: 0.0,
};

/// Height up to which the lip of the rim is masked, mm.
const LIP: f64 = -1.5;
/// Greatest distance from the axis and greatest height of the underside, mm.
const UNDERSIDE: [f64; 2] = [54.0, 3.0];

#[test]
#[ignore = "deep: 10 s"]
fn a_cap_has_warts_on_its_upper_side_only_and_more_of_them_the_oftener_they_divide() {
    let profile = [
        (0.0, 1.0),
        (18.0, 1.5),
        (46.0, -1.5),
        (55.0, -3.0),
        (57.5, -1.0),
        (56.0, 7.0),
        (48.0, 19.0),
        (32.0, 29.0),
        (0.0, 36.0),
    ];
    let cap = surface(lathe(&profile.map(DVec2::from), 1.5).expect("a good profile"));
    let mut shares = Vec::new();
    for days in [6.0, 8.0, 20.0] {
        let row = Row {
            division: [days, 8.0],
            ..CAP
        };
        let mask = |radius_mm, height| CylinderControl {
            from: DVec3::Z * -10.0,
            to: DVec3::Z * height,
            radius_mm,
            image: ControlImage::Constant(1.0),
            steers: Steered::Blocked,
        };
        let masked = MosaicPlan {
            controls: vec![mask(None, LIP), mask(Some(UNDERSIDE[0]), UNDERSIDE[1])],
            ..row.plan()
        };
        let mosaic = Mosaic::grow(&cap, &masked, 1).expect("a good plan");
        for at in mosaic.positions() {
            let below = at.z < UNDERSIDE[1] && at.truncate().length() < UNDERSIDE[0];
            assert!(at.z > LIP && !below, "a cell at {at} mm");
        }
        let seen = Seen::of(&mosaic);
        shares.push(seen.share());
        if days > CAP.division[1] {
            // Warts whose cells hardly divide are single cells without neighbours of their own.
            continue;
        }
        let alike = neighbourhood(&seen.voronoi, &seen.kinds, 5, 1);
        assert!(
            alike.alike > alike.by_chance + 5.0 * alike.deviation,
            "{alike:?}"
        );
    }
    assert!(shares[0] > shares[1] && shares[1] > shares[2], "{shares:?}");
}
