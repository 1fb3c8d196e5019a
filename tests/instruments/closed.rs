//! Smooth bodies under instruments: what they take in is what their surface takes in.

use super::{NORMAL, figures, of, rays};
use renderer::instruments::Direction;

/// A smooth sphere of so many segments under an integrating sphere.
fn ball(segments: u32, material: &str) -> String {
    format!(
        "[meshes.ball.sphere]\nradius_m = 0.05\nsegments = {segments}\n{material}\n\
         [objects.ball]\nmesh = \"ball\"\nmaterial = \"skin\"\n\
         [instruments.ball.sphere]\nobject = \"ball\"\nwavelengths_nm = [550]\n\
         faces = \"adaxial\"\n"
    )
}

#[test]
fn a_convex_body_absorbs_what_its_surface_absorbs() {
    for segments in [8, 16, 64] {
        for (name, material, expected) in [
            (
                "diffuse",
                "[materials.skin.diffuse]\nreflectance = 0.8",
                0.2,
            ),
            ("white", "[materials.skin.diffuse]\nreflectance = 1", 0.0),
            (
                "lossless leaf",
                "[materials.skin.leaf]\nabaxial_ratio = 1\n\
                 [materials.skin.leaf.measured]\nreflectance = 0.6\ntransmittance = 0.4",
                0.0,
            ),
        ] {
            let rows = figures(&ball(segments, material), &rays(1 << 15));
            let rows = rows.expect("it can be measured");
            for light in [NORMAL, Direction::Diffuse] {
                let row = of(&rows, "absorptance", light, 550.0).next();
                let row = row.expect("it is measured");
                assert!(
                    (row.value - expected).abs() < 4.0 * row.error + 2e-4,
                    "{name}, {segments} segments: {row:?}"
                );
            }
        }
    }
}
