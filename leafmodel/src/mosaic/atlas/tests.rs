use glam::DVec3;

use crate::mosaic::shapes::lathe::lathe;

use super::*;
use crate::mosaic::shapes::{Shape, rounded_cube, sheet, sphere};
use crate::shape::outline::Outline;

fn surface(shape: Shape) -> Surface {
    Surface::new(shape.positions, shape.faces).expect("shapes are surfaces")
}

/// Bilinear look-up in a painted atlas.
fn look_up(atlas: &Atlas, painted: &[f64], uv: DVec2) -> f64 {
    let at = uv * f64::from(atlas.texels()) - 0.5;
    let low = at.floor();
    let share = at - low;
    let texel = |dx: f64, dy: f64| {
        let last = f64::from(atlas.texels() - 1);
        let column = (low.x + dx).clamp(0.0, last) as usize;
        let row = (low.y + dy).clamp(0.0, last) as usize;
        painted[row * atlas.texels() as usize + column]
    };
    let row = |dy| texel(0.0, dy) * (1.0 - share.x) + texel(1.0, dy) * share.x;
    row(0.0) * (1.0 - share.y) + row(1.0) * share.y
}

/// A smooth function over space whose second derivatives are at most 1 / (49 mm²) along any
/// direction.
fn smooth(p: DVec3) -> f64 {
    libm::sin(p.x / 7.0) + libm::cos(p.y / 7.0) + libm::sin(p.z / 7.0)
}

/// Checks that look-ups along all edges agree on both sides and with the function itself.
fn check_seamless(surface: &Surface, texels: u32) -> Atlas {
    let atlas = Atlas::new(surface, texels, 2).expect("an atlas");
    let painted: Vec<f64> = (0..texels)
        .flat_map(|row| (0..texels).map(move |column| (column, row)))
        .map(|(column, row)| {
            let shown = atlas.shown(column, row);
            shown.map_or(f64::NAN, |point| smooth(surface.position(&point)))
        })
        .collect();
    // Bilinear interpolation errs by the curvature times the texel's side squared over 8 in each
    // direction; a texel on a slanted face is at most 1 / 0.766 longer, and the surface's own bend
    // over a texel is of the same order.
    let texel = 1.0 / atlas.texels_per_mm() / AGREE;
    let mut tolerance = 3.0 * texel * texel / 49.0 / 8.0 * 4.0 + 0.1 * texel / 7.0;
    let open = (0..surface.faces().len() as u32)
        .any(|face| (0..3).any(|edge| surface.neighbour(face, edge).is_none()));
    if open {
        // Beyond a margin there is no surface: texels repeat its nearest point, half a texel's
        // slope off.
        tolerance += 0.5 * texel * 1.5 / 7.0;
    }
    let mut worst: f64 = 0.0;
    for (corners, face) in atlas.uvs().iter().zip(0..) {
        for edge in 0..3 {
            for step in 0..=4 {
                let share = f64::from(step) / 4.0;
                let uv = corners[edge].lerp(corners[(edge + 1) % 3], share);
                let ids = surface.faces()[face as usize];
                let [p, q] =
                    [ids[edge], ids[(edge + 1) % 3]].map(|id| surface.positions()[id as usize]);
                let found = look_up(&atlas, &painted, uv);
                assert!(!found.is_nan(), "a look-up at face {face} finds nothing");
                worst = worst.max((found - smooth(p.lerp(q, share))).abs());
            }
        }
    }
    assert!(
        worst <= tolerance,
        "off by {worst}, texels of {texel} mm allow {tolerance}"
    );
    atlas
}

#[test]
fn a_sphere_is_laid_flat_without_seams_and_evenly() {
    let ball = surface(sphere(30.0, 3.0).expect("good sizes"));
    let atlas = check_seamless(&ball, 256);
    assert!(atlas.charts() <= 40, "{} charts", atlas.charts());
    let [low, high] = atlas.density_range(&ball);
    assert!(low > 0.75 && high < 1.3, "{low} {high}");
    assert!(atlas.filled() > 0.4, "{}", atlas.filled());
}

#[test]
fn a_rounded_cube_and_a_fruit_are_laid_flat_without_seams() {
    let cube = surface(rounded_cube(50.0, 8.0, 3.0).expect("good sizes"));
    check_seamless(&cube, 256);
    let profile = [
        (0.0, 8.0),
        (8.0, 2.0),
        (25.0, 20.0),
        (16.0, 46.0),
        (0.0, 40.0),
    ];
    let fruit = lathe(&profile.map(DVec2::from), 2.5).expect("a good profile");
    check_seamless(&surface(fruit), 256);
}

#[test]
fn a_sheet_is_one_chart_and_both_its_faces_are_two() {
    let corners = [(0.0, 0.0), (15.0, 20.0), (0.0, 60.0), (-15.0, 20.0)];
    let outline = Outline::new(
        corners.map(DVec2::from).to_vec(),
        DVec2::ZERO,
        DVec2::new(0.0, 60.0),
    )
    .expect("a simple outline");
    let blade = surface(sheet(&outline, 3.0).expect("good sizes"));
    let atlas = check_seamless(&blade, 128);
    assert_eq!(atlas.charts(), 1);
    let [low, high] = atlas.density_range(&blade);
    assert!(high / low < 1.0 + 1e-6);
}

#[test]
fn a_ramp_that_winds_over_itself_is_cut() {
    // Two turns of a shallow spiral ramp, drawn over one another when seen from above.
    let mut positions = Vec::new();
    for step in 0..=48 {
        let angle = std::f64::consts::TAU * f64::from(step) / 24.0;
        for radius in [10.0, 20.0] {
            positions.push(DVec3::new(
                radius * libm::cos(angle),
                radius * libm::sin(angle),
                0.2 * f64::from(step),
            ));
        }
    }
    let faces = (0..48)
        .flat_map(|i| [[2 * i, 2 * i + 1, 2 * i + 3], [2 * i, 2 * i + 3, 2 * i + 2]])
        .collect();
    let ramp = Surface::new(positions, faces).expect("a ramp");
    let atlas = check_seamless(&ramp, 256);
    assert!(atlas.charts() >= 2);
}

#[test]
fn atlases_that_are_too_small_are_refused() {
    let ball = surface(sphere(30.0, 3.0).expect("good sizes"));
    let few = Atlas::new(&ball, 8, 2).expect_err("too few texels");
    assert!(few.to_string().contains("of 8 texels"), "{few}");
    let small = Atlas::new(&ball, 16, 8).expect_err("no room for gutters");
    assert!(small.to_string().contains("do not fit"));
}
